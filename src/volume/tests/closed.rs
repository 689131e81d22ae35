//! Absorption and emission where the integral is known. 1e-6: samples and weights are single precision, 6e-8 each.

use super::*;

#[test]
fn a_slab() {
    let slab = uniform([5, 4, 16], 0.25, 0.75);
    let camera = Camera::orthographic(&slab, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [9, 7]).unwrap();
    let picture = render(&slab, 0.6, &camera, &Shading::Emission([2.0, 1.0, 0.0]), 2).unwrap();
    let known = libm::exp(-0.6 * 0.75 * 4.0);
    for (radiance, transmittance) in picture.radiance.iter().zip(&picture.transmittance) {
        is(f64::from(*transmittance), known, 1e-6);
        is(f64::from(radiance[0]), 2.0 * (1.0 - known), 1e-6);
        assert_eq!(radiance[2], 0.0);
    }
    // 5 voxels are one brick across: 17 cells each way, and no more.
    assert_eq!(picture.work, Work { rays: 9 * 7 * 4, cells: 9 * 7 * 4 * 17, skipped: 0 });
}

/// What linear interpolation adds to an exponential is h^2 / 12 H^2 of it, 3e-7 here; the flat ends an eighth of h^2 / H^2.
#[test]
fn an_exponential_atmosphere() {
    let (scale, top) = (0.125, 1.0);
    let air = Density::sampled([1, 1, 4096], top / 4096.0, |[_, _, z]| libm::exp(-z / scale)).unwrap();
    let known = scale * (1.0 - libm::exp(-top / scale));
    for extinction in [1.0, 8.0, 20.0] {
        let middle = 0.5 / 4096.0;
        let seen = see(&air, extinction, &DARK, [middle, middle, -1.0], [0.0, 0.0, 1.0]);
        is(seen.transmittance, libm::exp(-extinction * known), 1e-6);
    }
}

/// The flat ends add at one end what they take away at the other.
#[test]
fn a_linear_ramp() {
    let ramp = Density::sampled([8, 8, 32], 0.125, |[_, _, z]| 0.3 * z).unwrap();
    let seen = see(&ramp, 1.0, &DARK, [0.4, 0.4, 5.0], [0.0, 0.0, -1.0]);
    is(seen.transmittance, libm::exp(-0.3 * 8.0), 1e-6);
    // Slanted, between two places of the inside: the mean of the density at both, times the length.
    let ray = Ray::new([0.1, 0.15, 0.5], [0.2, 0.1, 1.0]).unwrap();
    let bricks = Bricks::new(&ramp);
    let to = ray.place(2.0);
    let rest = Ray { origin: to, direction: ray.direction };
    let known = 2.0 * 0.5 * 0.3 * (0.5 + to[2]);
    is(bricks.depth(&ray) - bricks.depth(&rest), known, 1e-6);
}

/// Sums of samples of a Gaussian are its integral, to all digits: along an axis through centres the field is such a sum.
#[test]
fn a_gaussian_ball() {
    let (n, sigma) = (48, 0.08);
    let centre = (0.5 * n as f64 + 0.5) / n as f64;
    let ball = Density::sampled([n; 3], 1.0 / n as f64, |place| {
        let square: f64 = place.iter().map(|x| (x - centre) * (x - centre)).sum();
        libm::exp(-0.5 * square / (sigma * sigma))
    })
    .unwrap();
    let bricks = Bricks::new(&ball);
    for (dx, dy) in [(0, 0), (3, -2), (7, 5)] {
        let [x, y] = [dx, dy].map(|d| f64::from(d) / n as f64);
        let known =
            sigma * (2.0 * std::f64::consts::PI).sqrt() * libm::exp(-0.5 * (x * x + y * y) / (sigma * sigma));
        for (origin, to) in [
            ([centre + x, centre + y, -1.0], [0.0, 0.0, 1.0]),
            ([centre + x, -1.0, centre + y], [0.0, 1.0, 0.0]),
            ([2.0, centre + x, centre + y], [-1.0, 0.0, 0.0]),
        ] {
            is(bricks.depth(&Ray::new(origin, to).unwrap()), known, 1e-6);
        }
    }
}

/// A block of ones is one voxel's ramp softer at either end than its edges; along an axis that is as long.
#[test]
fn a_hard_edged_box() {
    let inside = |x: f64, low: f64, high: f64| x > low && x < high;
    let block = Density::sampled([40, 40, 40], 0.1, |[x, y, z]| {
        f64::from(inside(x, 1.0, 3.0) && inside(y, 1.5, 2.5) && inside(z, 0.7, 1.9))
    })
    .unwrap();
    for (origin, to, known) in [
        ([2.0, 2.0, -1.0], [0.0, 0.0, 1.0], 1.2),
        ([9.0, 2.0, 1.3], [-1.0, 0.0, 0.0], 2.0),
        ([2.0, -3.0, 1.3], [0.0, 2.0, 0.0], 1.0),
        ([0.5, 2.0, -1.0], [0.0, 0.0, 1.0], 0.0),
    ] {
        is(see(&block, 0.8, &DARK, origin, to).transmittance, libm::exp(-0.8 * known), 1e-6);
    }
}

#[test]
fn slanted_rays_through_a_uniform_box() {
    let counts = [20, 33, 9];
    let block = uniform(counts, 0.1, 0.8);
    let bricks = Bricks::new(&block);
    let mut hit = 0;
    for k in 0..500 {
        let r = |j: u64| 2.0 * noise(k * 8 + j) - 1.0;
        let ray =
            Ray::new([1.0 + 2.0 * r(0), 1.6 + 2.0 * r(1), 0.4 + 2.0 * r(2)], [r(3), r(4), r(5)]).unwrap();
        let (mut from, mut to) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let a = -ray.origin[axis] / ray.direction[axis];
            let b = (block.extent()[axis] - ray.origin[axis]) / ray.direction[axis];
            (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
        }
        let known = (to - from).max(0.0);
        hit += u32::from(known > 0.0);
        is(bricks.depth(&ray), 0.8_f32 as f64 * known, 1e-6);
        is(bricks.inside(&ray).map_or(0.0, |[from, to]| to - from), known, 1e-12);
    }
    assert!(hit > 50, "{hit}");
    // From within, along its faces, and past them.
    let depth = |origin, to| bricks.depth(&Ray::new(origin, to).unwrap());
    is(depth([0.5, 0.5, 0.5], [1.0, 0.0, 0.0]), 1.2, 1e-6);
    is(depth([-1.0, 3.3, 0.9], [1.0, 0.0, 0.0]), 1.6, 1e-6);
    assert_eq!(depth([-1.0, 3.300_1, 0.9], [1.0, 0.0, 0.0]), 0.0);
}

/// Through corners of cells, where several planes are passed at once.
#[test]
fn rays_along_diagonals() {
    let block = uniform([16; 3], 1.0, 1.0);
    let bricks = Bricks::new(&block);
    for turn in 0..8 {
        let sign = [0, 1, 2].map(|axis| if turn >> axis & 1 == 1 { -1.0 } else { 1.0 });
        let origin = sign.map(|s| 8.0 - 20.0 * s);
        is(bricks.depth(&Ray::new(origin, sign).unwrap()), 16.0 * 3.0_f64.sqrt(), 1e-5);
        let flat = [origin[0], origin[1], 3.5];
        is(bricks.depth(&Ray::new(flat, [sign[0], sign[1], 0.0]).unwrap()), 16.0 * 2.0_f64.sqrt(), 1e-5);
    }
}

/// Chords of a sphere whose voxels are full or empty: an end is wrong by up to a voxel, at the rim by more in a rim that is
/// as much narrower, so the error's root mean square is of order 1 in the voxel.
#[test]
fn a_hard_sphere_converges() {
    let error = |n: usize| {
        let radius = 0.4;
        let square = |place: [f64; 3]| place.iter().map(|x| (x - 0.5) * (x - 0.5)).sum::<f64>();
        let ball =
            Density::sampled([n; 3], 1.0 / n as f64, |place| f64::from(square(place) < radius * radius))
                .unwrap();
        let bricks = Bricks::new(&ball);
        let camera = Camera::orthographic(&ball, [0.3, 0.5, 0.8], [0.0, 0.0, 1.0], [60, 60]).unwrap();
        let mut sum = 0.0;
        for k in 0..3600 {
            let ray = camera.sample([k % 60, k / 60], [0, 0], 1);
            let along: f64 = (0..3).map(|axis| (0.5 - ray.origin[axis]) * ray.direction[axis]).sum();
            let chord = 2.0 * (radius * radius - square(ray.place(along))).max(0.0).sqrt();
            let off = bricks.depth(&ray) - chord;
            sum += off * off;
        }
        (sum / 3600.0).sqrt()
    };
    let errors = [16, 32, 64].map(error);
    for pair in errors.windows(2) {
        let order = libm::log2(pair[0] / pair[1]);
        assert!((0.7..=1.6).contains(&order), "{errors:?}");
    }
    assert!(errors[2] < 0.5 / 64.0, "{errors:?}");
}

/// Emission and a background of the same radiance are that radiance: exactly in double, to a rounding in the picture.
#[test]
fn a_white_furnace() {
    let field = ragged(24);
    let white = Shading::Emission([1.0; 3]);
    let camera =
        Camera::pinhole([-0.7, 1.2, 0.4], [1.0, -0.5, 0.1], [0.0, 0.0, 1.0], 50.0, [30, 20]).unwrap();
    let renderer = Renderer::new(&field, 30.0, &white).unwrap();
    let picture = renderer.picture(&camera, 2).unwrap();
    let mut least = 1.0_f32;
    for (radiance, transmittance) in picture.radiance.iter().zip(&picture.transmittance) {
        assert!((radiance[1] + transmittance - 1.0).abs() <= f32::EPSILON);
        least = least.min(*transmittance);
    }
    assert!(least < 1e-3);
    for k in 0..600 {
        let seen = renderer.see(&camera.sample([k % 30, k / 30], [0, 0], 1), &mut Work::default());
        assert_eq!(seen.radiance[0] + seen.transmittance, 1.0);
    }
}

#[test]
fn nothing_is_seen_in_nothing() {
    let empty = uniform([9, 10, 30], 0.3, 0.0);
    let camera = Camera::orthographic(&empty, [1.0, 1.0, 1.0], [0.0, 0.0, 1.0], [20, 10]).unwrap();
    let octaves = octaves::lit(0.5, 0.5, false);
    for shading in [Shading::Emission([1.0; 3]), isotropic([1.0, 0.0, 0.2]), Shading::Octaves(octaves)] {
        let picture = render(&empty, 5.0, &camera, &shading, 1).unwrap();
        assert!(picture.radiance.iter().flatten().all(|value| value.to_bits() == 0));
        assert!(picture.transmittance.iter().all(|value| value.to_bits() == 1.0_f32.to_bits()));
        assert_eq!(picture.work, Work { rays: 200, ..Work::default() });
    }
}
