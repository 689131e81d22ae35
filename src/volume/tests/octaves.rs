//! Octaves: what they are of, and how much light there may be.

use super::*;

/// White light from above and beneath, no sun.
pub fn lit(attenuation: f64, contribution: f64, normalised: bool) -> Octaves {
    Octaves {
        count: 6,
        attenuation,
        contribution,
        eccentricity: 0.5,
        normalised,
        albedo: 1.0,
        g: 0.8,
        to_sun: [0.4, -0.3, 0.7],
        sun: [0.0; 3],
        zenith: [0.0, 0.0, 1.0],
        sky: [1.0; 3],
        ground: [1.0; 3],
    }
}

/// Half of each hemisphere reaches a place, by at most all: so a source is at most 1, as printed the sum of b^i.
#[test]
fn uniform_white_light_is_never_more_than_itself() {
    let field = ragged(16);
    let camera = Camera::orthographic(&field, [0.3, 1.0, 0.2], [0.0, 0.0, 1.0], [24, 24]).unwrap();
    for (a, b) in [(0.5, 0.5), (0.25, 0.5), (0.5, 0.25), (0.0, 1.0), (1.0, 1.0)] {
        for extinction in [0.5, 10.0, 200.0] {
            for (normalised, most) in [(true, 1.0), (false, lit(a, b, false).gain())] {
                let renderer =
                    Renderer::new(&field, extinction, &Shading::Octaves(lit(a, b, normalised))).unwrap();
                for k in 0..576 {
                    let seen =
                        renderer.see(&camera.sample([k % 24, k / 24], [0, 0], 1), &mut Work::default());
                    let bound = most * (1.0 - seen.transmittance) + 1e-12;
                    assert!(seen.radiance[0] <= bound && seen.radiance[0] >= 0.0, "{a} {b} {extinction}");
                }
            }
        }
    }
}

/// So little extinction that no part of a ray is cut, which is done for single scattering alone.
#[test]
fn one_octave_of_the_sun_is_single_scattering() {
    // Of a smaller field single scattering would have finer depths.
    let field = random(86);
    let to_sun = [0.4, -0.3, 0.7];
    let single = Single { albedo: 0.9, g: 0.8, to_sun, sun: [3.0, 2.0, 1.0] };
    let octaves = Octaves {
        count: 1,
        albedo: 0.9,
        sun: [3.0, 2.0, 1.0],
        sky: [0.0; 3],
        ground: [0.0; 3],
        ..lit(0.5, 0.5, false)
    };
    let both = [Shading::Single(single), Shading::Octaves(octaves)]
        .map(|shading| Renderer::new(&field, 1.0, &shading).unwrap());
    for k in 0..100 {
        let origin = [noise(3 * k), noise(3 * k + 1), 2.0];
        let ray = Ray::new(origin, [0.2, noise(3 * k + 2) - 0.5, -1.0]).unwrap();
        let [a, b] = [0, 1].map(|which: usize| both[which].see(&ray, &mut Work::default()));
        for c in 0..3 {
            is(a.radiance[c], b.radiance[c], 1e-14);
        }
    }
}

/// The sun behind the eye: octave i gathers b^i p(c^i g) (1 - exp(-(1 + a^i) D)) / (1 + a^i). The sky the same with 1/2.
#[test]
fn octaves_of_a_slab() {
    let slab = uniform([12, 12, 16], 0.25, 0.5);
    let octaves = Octaves {
        to_sun: [0.0, 0.0, 1.0],
        sun: [2.0, 0.0, 0.0],
        sky: [0.0, 0.7, 0.0],
        ground: [0.0, 0.0, 0.3],
        ..lit(0.6, 0.4, false)
    };
    let extinction = 1.5;
    let depth = extinction * 0.5 * 4.0;
    let seen = see(&slab, extinction, &Shading::Octaves(octaves), [1.4, 1.6, 9.0], [0.0, 0.0, -1.0]);
    let [mut sun, mut sky, mut ground] = [0.0; 3];
    let [mut a, mut b, mut c] = [1.0; 3];
    for _ in 0..6 {
        let towards = (1.0 - libm::exp(-depth * (1.0 + a))) / (1.0 + a);
        let away = libm::exp(-a * depth)
            * if a == 1.0 { depth } else { (1.0 - libm::exp(-depth * (1.0 - a))) / (1.0 - a) };
        // Backwards: the light is turned round.
        sun += 2.0 * b * henyey_greenstein(c * 0.8, -1.0) * towards;
        sky += 0.7 * 0.5 * b * towards;
        ground += 0.3 * 0.5 * b * away;
        (a, b, c) = (a * 0.6, b * 0.4, c * 0.5);
    }
    is(seen.radiance[0], sun, 1e-6);
    is(seen.radiance[1], sky, 1e-6);
    is(seen.radiance[2], ground, 1e-6);
}

#[test]
fn what_are_no_octaves_is_refused() {
    let field = uniform([2; 3], 1.0, 1.0);
    let refused =
        |octaves: Octaves| Renderer::new(&field, 1.0, &Shading::Octaves(octaves)).unwrap_err().to_string();
    let good = lit(0.5, 0.5, false);
    assert_eq!(refused(Octaves { count: 9, ..good }), "the number of octaves is 9; 1 to 8 is handled");
    assert_eq!(
        refused(Octaves { contribution: 1.1, ..good }),
        "b, the contribution of octaves, is 1.1; 0 to 1 is handled"
    );
    assert!(refused(Octaves { zenith: [0.0; 3], ..good }).starts_with("the zenith is (0, 0, 0)"));
}
