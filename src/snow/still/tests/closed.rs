//! What is known in closed form.

use super::*;
use crate::volume::exp;

/// One pixel that sees along an axis, by a ray that is bent from it by 5e-6.
fn narrow() -> Camera {
    let lens = Lens { focal: 1.0, number: f64::INFINITY, focus: 1e6, sensor: 1e-4, shutter: 0.0 };
    Camera::new(Point3::origin(), -Vector3::z(), Vector3::y(), lens, [10, 10]).unwrap()
}

/// A block seen face on takes away 1 - exp(-tau d), and shows k_a I_a of that.
#[test]
fn a_block_is_exact() {
    for (rho, scale) in [(0.02, 1.0), (0.3, 1.0), (1.0, 0.5)] {
        let body = Body::of_density([40, 40, 12], 20e-6, &vec![rho; 40 * 40 * 12], TAU).unwrap();
        let flakes = [Placed { scale, turn: UnitQuaternion::identity(), ..placed(0, [0.0, 0.0, -0.5], 1) }];
        let mut scene = Scene { bodies: &[body], flakes: &flakes, extinction: 0.4 * TAU, light: light() };
        scene.light.light = [0.0; 3];
        let picture = picture(&scene, &narrow(), &[[0.0; 3]; 100], 4, Seed(1)).unwrap();
        let known = 1.0 - exp(-0.4 * TAU * f64::from(rho) * 12.0 * 20e-6 * scale);
        for (coverage, radiance) in picture.coverage.iter().zip(&picture.radiance) {
            assert!((f64::from(*coverage) - known).abs() < 1e-6, "{coverage} {known}");
            assert!((f64::from(radiance[1]) - 0.35 * 0.9 * known).abs() < 1e-6);
        }
        assert_eq!(picture.work.traced, 1);
    }
}

#[test]
fn where_no_flake_is_the_background_stays_as_it_is() {
    let bodies = bodies();
    let camera = camera(8.0, 0.4, 0.004, [40, 30]);
    let background: Vec<[f32; 3]> = (0..1200).map(|k| [k as f32 * 0.01, 1e-30, 1e20]).collect();
    let empty = picture(&scene(&bodies, &[]), &camera, &background, 4, Seed(1)).unwrap();
    assert_eq!((empty.visible, &empty.radiance), (0, &background));
    assert!(empty.coverage.iter().all(|coverage| coverage.to_bits() == 0));
    // One flake in a corner, one behind.
    let flakes = [placed(1, [-0.045, 0.03, -0.4], 3), placed(1, [0.0, 0.0, 0.4], 3)];
    let one = picture(&scene(&bodies, &flakes), &camera, &background, 4, Seed(1)).unwrap();
    assert_eq!(one.visible, 1);
    let touched = one.coverage.iter().filter(|coverage| **coverage > 0.0).count();
    assert!((2..400).contains(&touched), "{touched}");
    for (at, behind) in background.iter().enumerate() {
        assert!(one.coverage[at] > 0.0 || one.radiance[at] == *behind, "{at}");
    }
}

/// No flake is brighter than I_0 (k_d + k_s) + k_a I_a.
#[test]
fn radiance_is_bounded() {
    let (bodies, flakes) = (bodies(), many(60));
    let size = [160, 120];
    for to_light in [[0.5, 0.7, 0.5], [0.0, 0.0, 1.0], [0.1, 0.0, -1.0]] {
        let mut scene = scene(&bodies, &flakes);
        scene.light.to_light = to_light;
        let camera = camera(8.0, 0.4, 0.002, size);
        let picture = picture(&scene, &camera, &[[0.0; 3]; 160 * 120], 4, Seed(1)).unwrap();
        let brightest = [0, 1, 2].map(|c| {
            let most = scene.light.light[c] + 0.35 * scene.light.ambient_light[c];
            picture.radiance.iter().map(|radiance| f64::from(radiance[c]) / most).fold(0.0, f64::max)
        });
        assert!(brightest.iter().all(|share| *share <= 1.0 && *share > 0.1), "{brightest:?}");
        assert!(picture.coverage.iter().all(|coverage| (0.0..=1.0).contains(coverage)));
    }
}

#[test]
fn what_is_no_picture_is_refused() {
    let bodies = bodies();
    let camera = camera(8.0, 0.4, 0.004, [4, 3]);
    let flake = placed(0, [0.0, 0.0, -0.4], 1);
    let background = [[0.0; 3]; 12];
    let refuse = |flake: Placed, light: Himeno, background: &[[f32; 3]], samples: usize| {
        let flakes = [flake];
        let scene = Scene { bodies: &bodies, flakes: &flakes, extinction: TAU, light };
        let refused = picture(&scene, &camera, background, samples, Seed(1)).unwrap_err().to_string();
        assert_eq!(refused.lines().count(), 1, "{refused}");
    };
    refuse(Placed { template: 3, ..flake }, light(), &background, 1);
    refuse(Placed { scale: f64::NAN, ..flake }, light(), &background, 1);
    refuse(Placed { at: Point3::new(0.0, f64::INFINITY, 0.0), ..flake }, light(), &background, 1);
    refuse(flake, Himeno { to_light: [0.0; 3], ..light() }, &background, 1);
    refuse(flake, Himeno { ambient: -1.0, ..light() }, &background, 1);
    refuse(flake, light(), &background[1..], 1);
    refuse(flake, light(), &background, 0);
    refuse(flake, light(), &background, 4097);
    for refused in [
        Body::of_density([2, 2, 2], 1e-5, &[0.5; 7], TAU),
        Body::of_density([1, 1, 1], 1e-5, &[1.5], TAU),
        Body::of_density([1, 1, 1], 1e-5, &[0.0], TAU),
        Body::of_density([1, 1, 1], 0.0, &[1.0], TAU),
        Body::of_density([1, 1, 1], 1e-5, &[1.0], f64::NAN),
        Body::new(&Flake { members: Vec::new() }, &[], 1, TAU),
    ] {
        assert_eq!(refused.unwrap_err().to_string().lines().count(), 1);
    }
}
