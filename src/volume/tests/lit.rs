//! Light scattered once, where the integral is known.

use super::*;

#[test]
fn henyey_greenstein_has_integral_1_and_mean_cosine_g() {
    for g in [-0.6, 0.0, 0.3, 0.85] {
        // Simpson's rule with 20000 parts: 1e-9 for the steepest of these.
        let (mut whole, mut mean) = (0.0, 0.0);
        for k in 0..=20_000 {
            let cosine = f64::from(k) * 1e-4 - 1.0;
            let weight = if k == 0 || k == 20_000 {
                1.0
            } else if k % 2 == 1 {
                4.0
            } else {
                2.0
            };
            let value = weight * 1e-4 / 3.0 * 2.0 * std::f64::consts::PI * henyey_greenstein(g, cosine);
            whole += value;
            mean += value * cosine;
        }
        is(whole, 1.0, 1e-7);
        is(mean, g, 1e-7);
    }
    is(henyey_greenstein(0.0, 0.3), 0.25 / std::f64::consts::PI, 1e-16);
}

/// A ray along z through a slab of depth D. From before: (1 - exp(-2 D)) / 2; from behind: D exp(-D); from aside, a deep:
/// exp(-a) (1 - exp(-D)).
#[test]
fn a_slab_lit_along_an_axis() {
    let slab = uniform([24, 20, 32], 0.125, 0.5);
    let (extinction, place) = (1.3, [1.11, 0.93, -2.0]);
    let depth = extinction * 0.5 * 4.0;
    let lit = |to_sun| see(&slab, extinction, &isotropic(to_sun), place, [0.0, 0.0, 1.0]).radiance[0];
    let aside = |length: f64| libm::exp(-extinction * 0.5 * length) * (1.0 - libm::exp(-depth));
    is(lit([0.0, 0.0, -1.0]), 0.5 * (1.0 - libm::exp(-2.0 * depth)), 1e-6);
    is(lit([0.0, 0.0, 2.0]), depth * libm::exp(-depth), 1e-6);
    is(lit([-1.0, 0.0, 0.0]), aside(1.11), 1e-6);
    is(lit([1.0, 0.0, 0.0]), aside(3.0 - 1.11), 1e-6);
    is(lit([0.0, -1.0, 0.0]), aside(0.93), 1e-6);
    is(lit([0.0, 1.0, 0.0]), aside(2.5 - 0.93), 1e-6);
}

/// With m the cosine between light and the normal: (1 - exp(-D (1 + 1 / m))) / (1 + 1 / m), where the light comes through
/// the face, and slanted rays alike.
#[test]
fn a_slab_lit_aslant() {
    let slab = uniform([96, 96, 16], 0.0625, 0.75);
    let extinction = 2.0;
    let depth = extinction * 0.75;
    for to_sun in [[0.5, 0.3, -1.0], [-0.4, 0.9, -1.0], [0.8, -0.8, -1.0]] {
        let length: f64 = to_sun.iter().map(|x| x * x).sum::<f64>().sqrt();
        for to in [[0.0, 0.0, 1.0], [0.3, -0.2, 1.0]] {
            let view: f64 = to.iter().map(|x| x * x).sum::<f64>().sqrt();
            let origin = [3.0 - to[0], 3.0 - to[1], -1.0];
            let x = view + length;
            let known = view / x * (1.0 - libm::exp(-depth * x));
            is(see(&slab, extinction, &isotropic(to_sun), origin, to).radiance[0], known, 1e-6);
        }
        // From behind: exp(-D m') between D and 0, seen through what is before it.
        let from_behind = to_sun.map(|x| -x);
        let x = 1.0 - length;
        let known = libm::exp(-depth * length) * (1.0 - libm::exp(-depth * x)) / x;
        let seen = see(&slab, extinction, &isotropic(from_behind), [3.0, 3.0, -1.0], [0.0, 0.0, 1.0]);
        is(seen.radiance[0], known, 1e-6);
    }
}

/// With the sun behind the eye, what is before a place is the same for both, whatever the field: (1 - T^2) / 2.
#[test]
fn any_field_with_the_sun_behind_the_eye() {
    let field = random(24);
    let renderer = Renderer::new(&field, 3.0, &isotropic([0.0, 0.0, -1.0])).unwrap();
    for k in 0..200 {
        let ray = Ray::new([noise(2 * k), noise(2 * k + 1), -0.5], [0.0, 0.0, 1.0]).unwrap();
        let seen = renderer.see(&ray, &mut Work::default());
        is(seen.radiance[0], 0.5 * (1.0 - seen.transmittance * seen.transmittance), 1e-6);
    }
}

/// Light from everywhere, as many suns, with an albedo of 1, is not more than it was: each sun's light that is scattered
/// once is a part of what it would be without extinction.
#[test]
fn scattered_light_is_bounded() {
    let field = ragged(16);
    for k in 0..6 {
        let r = |j: u64| 2.0 * noise(50 + 3 * k + j) - 1.0;
        let renderer = Renderer::new(&field, 20.0, &isotropic([r(0), r(1), r(2)])).unwrap();
        let camera = Camera::orthographic(&field, [0.3, 1.0, 0.2], [0.0, 0.0, 1.0], [24, 24]).unwrap();
        for j in 0..576 {
            let seen = renderer.see(&camera.sample([j % 24, j / 24], [0, 0], 1), &mut Work::default());
            assert!(seen.radiance[0] >= 0.0 && seen.radiance[0] <= 1.0 - seen.transmittance + 1e-12);
        }
    }
}

/// Along the edge of what is there: a part of depth 0, over which the depth to the light changes much.
#[test]
fn nothing_is_gathered_along_an_edge() {
    let field = Density::sampled([8; 3], 1.0, |[x, _, z]| f64::from(x > 4.0 && z as u32 % 2 == 1)).unwrap();
    let seen = see(&field, 100.0, &isotropic([1.0, 0.1, 0.0]), [3.5, 4.2, -1.0], [0.0, 0.0, 1.0]);
    assert_eq!((seen.radiance, seen.transmittance), ([0.0; 3], 1.0));
}

#[test]
fn numbers_that_make_no_picture_are_refused() {
    let field = uniform([2; 3], 1.0, 1.0);
    let refused =
        |extinction, shading: Shading| Renderer::new(&field, extinction, &shading).unwrap_err().to_string();
    assert_eq!(refused(-1.0, DARK), "the extinction, 1/m, is -1; 0 to 1e30 is handled");
    let Shading::Single(single) = isotropic([0.0; 3]) else { unreachable!() };
    assert_eq!(
        refused(1.0, Shading::Single(single)),
        "the direction to the sun is (0, 0, 0), which is no direction; one of finite length above 0 is handled"
    );
    assert_eq!(
        refused(1.0, Shading::Single(Single { albedo: 1.5, ..single })),
        "the albedo is 1.5; 0 to 1 is handled"
    );
    let camera = Camera::orthographic(&field, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [2, 3]).unwrap();
    assert_eq!(
        render(&field, 1.0, &camera, &DARK, 0).unwrap_err().to_string(),
        "a picture of 2 x 3 pixels with 0 x 0 samples; 1 to 32768 each way and 1 to 64 samples are handled"
    );
}
