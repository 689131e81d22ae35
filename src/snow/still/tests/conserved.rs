//! Blur moves a flake's light and loses none.

use super::*;

/// Sums over all pixels: radiance, coverage.
fn sums(bodies: &[Body], flake: Placed, camera: &Camera, samples: usize) -> ([f64; 2], Work) {
    let [width, height] = camera.size();
    let background = vec![[0.0; 3]; width * height];
    let made = picture(&scene(bodies, &[flake]), camera, &background, samples, Seed(1)).unwrap();
    let radiance = made.radiance.iter().map(|radiance| f64::from(radiance[0])).sum();
    ([radiance, made.coverage.iter().map(|x| f64::from(*x)).sum()], made.work)
}

fn agree(a: [f64; 2], b: [f64; 2], what: &str) {
    for (a, b) in a.iter().zip(b) {
        assert!((a / b - 1.0).abs() < 0.01, "{what}: {a} {b}");
    }
}

/// The focus is beyond the flake; the lens and the speed decide how much it is blurred.
#[test]
fn a_flake_keeps_its_light() {
    let bodies = bodies();
    let size = [480, 360];
    for (at, least) in [([0.004, -0.003, -0.4], 4.0), ([0.05, 0.03, -0.4], 4.0), ([0.3, 0.3, -4.0], 0.0)] {
        let flake = placed(1, at, 2);
        let moving = Placed { velocity: Vector3::new(0.4, -0.9, 0.0), ..flake };
        let focus = 2.0;
        let (sharp, work) = sums(&bodies, flake, &camera(f64::INFINITY, focus, 0.004, size), 512);
        assert!(sharp[1] > least && (work.traced == 1) == (least > 0.0), "{sharp:?}");
        for (number, flake, traced) in
            [(f64::INFINITY, moving, false), (2.8, flake, false), (8.0, moving, false), (250.0, flake, true)]
        {
            let (blurred, work) = sums(&bodies, flake, &camera(number, focus, 0.004, size), 512);
            assert_eq!(work.traced == 1, traced && least > 0.0, "{at:?} f/{number}");
            agree(blurred, sharp, &format!("{at:?} f/{number}"));
        }
    }
}

/// By rays, as one part, and in parts it is as opaque: to what is left of levels' errors and of rays.
#[test]
fn ways_to_draw_agree() {
    let bodies = bodies();
    for k in 0..4 {
        let flake = placed(1, [0.01, 0.02, -0.5], k);
        let sum = |size: usize| {
            let camera = camera(f64::INFINITY, 0.5, 0.0, [size, size]);
            let (sums, work) = sums(&bodies, flake, &camera, 64);
            (sums.map(|sum| sum / (size * size) as f64), work)
        };
        let ((large, rays), (small, part)) = (sum(256), sum(32));
        assert_eq!((rays.traced, part.laid), (1, 1));
        assert!((large[1] / small[1] - 1.0).abs() < 0.07, "{large:?} {small:?}");
        assert!((large[0] / small[0] - 1.0).abs() < 0.2, "{large:?} {small:?}");
    }
}
