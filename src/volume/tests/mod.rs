//! Closed forms, brute force, bytes.

mod brute;
mod bytes;
mod closed;
mod lit;
mod octaves;
mod printed;
mod towards;

use super::*;

/// A number from 0 to 1 for each k.
fn noise(k: u64) -> f64 {
    let mut z = (k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 11) as f64 / (1_u64 << 53) as f64
}

/// The same density everywhere.
fn uniform(counts: [usize; 3], voxel: f64, density: f32) -> Density {
    Density::new(counts, voxel, vec![density; counts.iter().product()]).unwrap()
}

/// Samples that have nothing to do with one another, up to 1, in a box 1 m wide, with holes; 0 in the outermost.
fn ragged(n: usize) -> Density {
    let values = (0..n * n * n).map(|k| {
        let place = [k % n, k / n % n, k / (n * n)];
        let inner = place.iter().all(|x| (1..n - 1).contains(x));
        // In a large one bricks are empty: of theirs are samples 8 b - 1 to 8 b + 7.
        let block = place.map(|x| (x + 1) / if n < 32 { 8 } else { 16 });
        let hole = noise((block[0] + 8 * block[1] + 64 * block[2]) as u64) < 0.4;
        if inner && !hole { noise(k as u64 + 1000) as f32 } else { 0.0 }
    });
    Density::new([n; 3], 1.0 / n as f64, values.collect()).unwrap()
}

/// Samples that have nothing to do with one another, up to 1, in a box 1 m wide.
fn random(n: usize) -> Density {
    let values = (0..n * n * n).map(|k| noise(k as u64) as f32);
    Density::new([n; 3], 1.0 / n as f64, values.collect()).unwrap()
}

/// The transmittance of rays from a place; and the radiance of the red channel.
fn see(density: &Density, extinction: f64, shading: &Shading, origin: [f64; 3], to: [f64; 3]) -> Seen {
    let renderer = Renderer::new(density, extinction, shading).unwrap();
    renderer.see(&Ray::new(origin, to).unwrap(), &mut Work::default())
}

const DARK: Shading = Shading::Emission([0.0; 3]);

/// Light of unit strength scattered evenly, so that radiance is the integral alone.
fn isotropic(to_sun: [f64; 3]) -> Shading {
    Shading::Single(Single { albedo: 1.0, g: 0.0, to_sun, sun: [4.0 * std::f64::consts::PI; 3] })
}

fn is(got: f64, known: f64, tolerance: f64) {
    assert!((got - known).abs() <= tolerance, "{got} for {known}");
}
