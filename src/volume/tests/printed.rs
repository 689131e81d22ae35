//! Eq. (11) and (16) of Himeno, Kenmochi & Kotani.

use super::*;

fn himeno(to_light: [f64; 3]) -> Himeno {
    Himeno {
        diffuse: 0.5,
        specular: 0.3,
        power: 7,
        ambient: 0.2,
        to_light,
        light: [1.0, 0.8, 0.6],
        ambient_light: [0.5, 0.6, 0.7],
    }
}

/// N samples of one density: k_a I_a rho times a geometric row. No normal, so no more.
#[test]
fn the_printed_sum_of_a_uniform_slab() {
    let slab = uniform([8, 8, 16], 0.25, 0.75);
    let bricks = Bricks::new(&slab);
    let light = himeno([0.0, 0.0, -1.0]);
    let ray = Ray::new([1.0, 1.1, -3.0], [0.0, 0.0, 1.0]).unwrap();
    for tau in [0.01, 0.4, 3.0] {
        let mut work = Work::default();
        let seen = light.as_printed(&bricks, tau, &ray, &mut work).unwrap();
        let once = libm::exp(-tau * 0.75);
        let all = libm::exp(-tau * 0.75 * 16.0);
        for c in 0..3 {
            let known = 0.2 * light.ambient_light[c] * 0.75 * once * (1.0 - all) / (1.0 - once);
            is(seen.radiance[c], known, 1e-12);
        }
        is(seen.transmittance, all, 1e-12);
        assert_eq!((work.rays, work.cells), (1, 16));
    }
}

/// Density that grows along x and is seen along z, lit along x: the normal faces the light, and what is before a sample is
/// an arithmetic row, k = 1 to 6 in sixteenths.
#[test]
fn the_printed_sum_with_a_normal() {
    let ramp = Density::sampled([16, 8, 16], 0.5, |[x, _, _]| (x + 0.25) / 8.0).unwrap();
    let bricks = Bricks::new(&ramp);
    let light = himeno([-1.0, 0.0, 0.0]);
    // In the middle of voxel 5, of density 6 / 16.
    let ray = Ray::new([2.75, 2.25, -3.0], [0.0, 0.0, 1.0]).unwrap();
    let (tau, density) = (0.3, 6.0 / 16.0);
    let seen = light.as_printed(&bricks, tau, &ray, &mut Work::default()).unwrap();
    let before = (1.0 + 2.0 + 3.0 + 4.0 + 5.0 + 6.0) / 16.0;
    let once = libm::exp(-tau * density);
    let row = density * once * (1.0 - libm::exp(-tau * density * 16.0)) / (1.0 - once);
    for c in 0..3 {
        let lit = light.light[c] * libm::exp(-tau * before) * 0.5;
        is(seen.radiance[c], (lit + 0.2 * light.ambient_light[c]) * row, 1e-12);
    }
    assert!(light.as_printed(&bricks, -1.0, &ray, &mut Work::default()).is_err());
}

/// Pixel by pixel the sums of its ray, to all bits, on any number of threads.
#[test]
fn a_picture_as_printed_is_made_of_rays() {
    let field = ragged(20);
    let light = himeno([0.3, -1.0, 0.4]);
    let renderer = Renderer::new(&field, 8.0, &Sums::AsPrinted.shading(light)).unwrap();
    let camera = Camera::orthographic(&field, [0.1, 1.0, -0.2], [0.0, 0.0, 1.0], [21, 18]).unwrap();
    let [picture, other] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| renderer.picture(&camera, 1).unwrap())
    });
    assert_eq!(picture, other);
    let mut work = Work::default();
    for k in 0..21 * 18 {
        let ray = camera.sample([k % 21, k / 21], [0, 0], 1);
        let seen = light.as_printed(renderer.bricks(), 8.0 * field.voxel(), &ray, &mut work).unwrap();
        assert_eq!(picture.radiance[k], seen.radiance.map(|x| x as f32));
        assert_eq!(picture.transmittance[k], seen.transmittance as f32);
    }
    assert_eq!(picture.work, work);
    assert!(Renderer::new(&field, 8.0, &Shading::Printed(himeno([0.0; 3]))).is_err());
}

/// The geometric row again; 1e-7: pixels are single precision.
#[test]
fn a_picture_as_printed_of_a_uniform_slab() {
    let slab = uniform([8, 8, 16], 0.25, 0.75);
    let camera = Camera::orthographic(&slab, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [5, 4]).unwrap();
    let light = himeno([0.0, 0.0, -1.0]);
    let picture = render(&slab, 1.6, &camera, &Shading::Printed(light), 2).unwrap();
    let (once, all) = (libm::exp(-0.4 * 0.75), libm::exp(-0.4 * 0.75 * 16.0));
    for (radiance, transmittance) in picture.radiance.iter().zip(&picture.transmittance) {
        for (got, ambient) in radiance.iter().zip(light.ambient_light) {
            let known = 0.2 * ambient * 0.75 * once * (1.0 - all) / (1.0 - once);
            is(f64::from(*got), known, 1e-7);
        }
        is(f64::from(*transmittance), all, 1e-7);
    }
}

/// Density that grows along the view, with the light behind the eye: both cosines are 1 and both depths are the same, so
/// I_0 (k_d + k_s) (1 - exp(-2 D)) / 2 + k_a I_a (1 - exp(-D)). A flat end has no normal: its depth d is left out of it.
#[test]
fn exact_per_cell() {
    let (slope, extinction) = (0.4, 2.0);
    let ramp = Density::sampled([8, 8, 32], 0.0625, |[_, _, z]| slope * z).unwrap();
    let light = himeno([0.0, 0.0, -1.0]);
    let shading = Shading::Himeno(light);
    let seen = see(&ramp, extinction, &shading, [0.21, 0.33, -1.0], [0.0, 0.0, 1.0]);
    let depth = extinction * slope * 0.5 * 4.0;
    let half = 0.5 * 0.0625;
    let flat = extinction * slope * half * half;
    let last = extinction * slope * (2.0 - half) * half;
    let until = |d: f64| 0.5 * (1.0 - libm::exp(-2.0 * d));
    for c in 0..3 {
        let lit = light.light[c] * 0.8 * (until(depth - last) - until(flat));
        let known = lit + 0.2 * light.ambient_light[c] * (1.0 - libm::exp(-depth));
        is(seen.radiance[c], known, 1e-6);
    }
    // A uniform slab has no normal.
    let slab = uniform([8, 8, 32], 0.0625, 0.5);
    let seen = see(&slab, extinction, &shading, [0.21, 0.33, -1.0], [0.0, 0.0, 1.0]);
    is(seen.radiance[0], 0.2 * 0.5 * (1.0 - libm::exp(-2.0)), 1e-6);
}

#[test]
fn cosines_are_those_of_normal_and_mirror() {
    let light = himeno([0.0, 0.0, 1.0]);
    let to = |x: f64, y: f64, z: f64| {
        let length = (x * x + y * y + z * z).sqrt();
        [x / length, y / length, z / length]
    };
    let down = [0.0, 0.0, -3.0];
    // Straight down on ground that faces the light: both 1.
    is(light.reflected(down, [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]), 0.8, 1e-15);
    // The mirrored light at 45 degrees goes up on the other side.
    is(light.reflected(down, to(-1.0, 0.0, -1.0), to(-1.0, 0.0, 1.0)), 0.5 * 0.5_f64.sqrt() + 0.3, 1e-12);
    // At 0.6 radians from the mirror: cos^7.
    let eye = [-libm::sin(0.6), 0.0, -libm::cos(0.6)];
    let known = 0.5 + 0.3 * libm::pow(libm::cos(0.6), 7.0);
    is(light.reflected(down, eye, [0.0, 0.0, 1.0]), known, 1e-12);
    assert_eq!(light.reflected([0.0, 0.0, 3.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]), 0.0);
    assert_eq!(light.reflected([0.0; 3], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]), 0.0);
}

/// I_0 (k_d + k_s) + k_a I_a, of what is not background.
#[test]
fn radiance_is_bounded() {
    let field = ragged(24);
    let light = himeno([0.3, -1.0, 0.4]);
    let renderer = Renderer::new(&field, 60.0, &Shading::Himeno(light)).unwrap();
    let camera = Camera::orthographic(&field, [0.1, 1.0, -0.2], [0.0, 0.0, 1.0], [24, 24]).unwrap();
    let mut most = 0.0_f64;
    for k in 0..576 {
        let seen = renderer.see(&camera.sample([k % 24, k / 24], [0, 0], 1), &mut Work::default());
        for c in 0..3 {
            let bound = light.light[c] * 0.8 + 0.2 * light.ambient_light[c];
            assert!(
                seen.radiance[c] >= 0.0 && seen.radiance[c] <= bound * (1.0 - seen.transmittance) + 1e-12
            );
        }
        most = most.max(seen.radiance[0]);
    }
    assert!(most > 0.3, "{most}: it is lit at all");
}
