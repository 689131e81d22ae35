//! Against quadrature by brute force: tiny steps, trilinear by definition, marching to the light from each.

use super::*;

/// A field by definition, apart from all that is tested.
struct Naive<'a> {
    samples: &'a [f32],
    n: usize,
}

impl Naive<'_> {
    fn at(&self, place: [f64; 3]) -> f64 {
        let n = self.n;
        if place.iter().any(|x| *x < 0.0 || *x > 1.0) {
            return 0.0;
        }
        let mut low = [0; 3];
        let mut rest = [0.0; 3];
        for axis in 0..3 {
            let q = (place[axis] * n as f64 - 0.5).max(0.0).min((n - 1) as f64);
            low[axis] = (q as usize).min(n - 2);
            rest[axis] = q - low[axis] as f64;
        }
        let sample = |x, y, z| f64::from(self.samples[((low[2] + z) * n + low[1] + y) * n + low[0] + x]);
        let row = |y, z| (1.0 - rest[0]) * sample(0, y, z) + rest[0] * sample(1, y, z);
        let plane = |z| (1.0 - rest[1]) * row(0, z) + rest[1] * row(1, z);
        (1.0 - rest[2]) * plane(0) + rest[2] * plane(1)
    }

    /// Midpoints of equal steps, as long as `step` or a little less, from a place to where the unit box ends.
    fn depth(&self, origin: [f64; 3], to: [f64; 3], step: f64) -> f64 {
        let end = inside(origin, to)[1];
        let number = (end / step).ceil();
        let at = |k: f64| [0, 1, 2].map(|axis| origin[axis] + (k + 0.5) / number * end * to[axis]);
        (0..number as u32).map(|k| self.at(at(f64::from(k)))).sum::<f64>() * end / number
    }
}

/// Where a ray is within the unit box.
fn inside(origin: [f64; 3], to: [f64; 3]) -> [f64; 2] {
    let (mut from, mut end) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let [a, b] = [0.0, 1.0].map(|face| (face - origin[axis]) / to[axis]);
        (from, end) = (from.max(a.min(b)), end.min(a.max(b)));
    }
    [from, end.max(from)]
}

/// Root mean squares of transmittance's and radiance's differences from brute force, over pixels, and the mean radiance.
fn differences(field: &Density, pixels: usize, extinction: f64, steps: [f64; 2]) -> [f64; 3] {
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let (view, to_sun) = (unit([0.3, 0.9, -0.35]), unit([-0.6, -0.2, 0.9]));
    let naive = Naive { samples: field.values(), n: field.counts()[0] };
    let camera = Camera::orthographic(field, view, [0.0, 0.0, 1.0], [pixels; 2]).unwrap();
    // As much sun as makes a white Lambertian surface's radiance 1.
    let sun = [std::f64::consts::PI; 3];
    let white = Shading::Single(Single { albedo: 1.0, g: 0.0, to_sun, sun });
    let picture = render(field, extinction, &camera, &white, 1).unwrap();
    let [step, sun_step] = steps.map(|parts| field.voxel() / parts);
    let (mut squares, mut mean) = ([0.0; 2], 0.0);
    for k in 0..pixels * pixels {
        let ray = camera.sample([k % pixels, k / pixels], [0, 0], 1);
        let (mut depth, mut radiance) = (0.0, 0.0);
        let [from, end] = inside(ray.origin, ray.direction);
        let number = ((end - from) / step).ceil();
        let step = if number > 0.0 { (end - from) / number } else { step };
        for j in 0..number as u32 {
            let place = ray.place(from + (f64::from(j) + 0.5) * step);
            let part = extinction * step * naive.at(place);
            if part > 0.0 {
                let light = extinction * naive.depth(place, to_sun, sun_step);
                radiance += 0.25 * part * libm::exp(-(depth + 0.5 * part) - light);
                depth += part;
            }
        }
        let off = [
            f64::from(picture.transmittance[k]) - libm::exp(-depth),
            f64::from(picture.radiance[k][0]) - radiance,
        ];
        (0..2).for_each(|which| squares[which] += off[which] * off[which]);
        mean += radiance / (pixels * pixels) as f64;
    }
    let [absorbed, scattered] = squares.map(|sum| (sum / (pixels * pixels) as f64).sqrt());
    [absorbed, scattered, mean]
}

/// Random billows eight voxels apart, with holes between them.
fn billows(n: usize) -> Density {
    Density::sampled([n; 3], 1.0 / n as f64, |place| {
        let (mut low, mut rest) = ([0; 3], [0.0; 3]);
        for axis in 0..3 {
            let along = place[axis] * n as f64 / 8.0;
            low[axis] = along as u64;
            let x = along - low[axis] as f64;
            rest[axis] = x * x * (3.0 - 2.0 * x);
        }
        let value: f64 = (0..8)
            .map(|k: u64| {
                let bit = [k & 1, k >> 1 & 1, k >> 2];
                let part = |axis: usize| if bit[axis] == 1 { rest[axis] } else { 1.0 - rest[axis] };
                let at = [0, 1, 2].map(|axis| low[axis] + bit[axis]);
                part(0) * part(1) * part(2) * noise(at[0] + 100 * at[1] + 10_000 * at[2])
            })
            .sum();
        (2.0 * value - 0.6).max(0.0)
    })
    .unwrap()
}

/// 1e-3 of a white surface's radiance in the same sun, which eight bits do not show. Samples that have nothing to do with
/// one another are the worst there are for depths that are linear between lattice points, and the more so the more light
/// one voxel takes away.
const BOUND: f64 = 1e-3;

fn agrees(field: &Density, pixels: usize, extinctions: &[f64], steps: [f64; 2]) {
    for &extinction in extinctions {
        let [absorbed, scattered, mean] = differences(field, pixels, extinction, steps);
        println!("{:?}, {extinction}: {absorbed:.1e} {scattered:.1e} of {mean:.3}", field.counts());
        assert!(absorbed <= BOUND && scattered <= BOUND, "{absorbed} {scattered}");
    }
}

/// 12 and 24 take away as much a voxel here as 24 and 48 on 64.
#[test]
fn brute_force_agrees_within_a_thousandth() {
    agrees(&random(32), 10, &[2.0, 12.0], [4.0, 3.0]);
    agrees(&billows(32), 10, &[6.0, 24.0], [4.0, 3.0]);
}

#[test]
#[ignore = "64 cells a side: seconds in release, `cargo test --release -- --include-ignored`"]
fn brute_force_of_64_agrees_within_a_thousandth() {
    let all = [2.0, 6.0, 10.0, 20.0, 40.0];
    for field in [random(64), ragged(64), billows(64)] {
        agrees(&field, 32, &all, [8.0, 4.0]);
    }
}
