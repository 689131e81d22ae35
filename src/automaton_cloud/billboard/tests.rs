//! One ball, two, and many.

use super::*;
use crate::volume::{Density, Ray, Shading, render};

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn lit(extinction: f64) -> Billboards {
    let sun = [4.0 * std::f64::consts::PI; 3];
    Billboards { extinction, g: 0.0, to_sun: [0.0, 0.0, 1.0], sun, shadow: [256, 256] }
}

fn cloud(number: u64) -> Vec<Metaball> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64
    };
    let mut ball = |_| {
        let centre = [0, 1, 2].map(|_| 0.3 + 0.4 * next());
        Metaball { centre, density: 0.2 + 0.8 * next(), radius: 0.2 + 0.05 * next() }
    };
    (0..number).map(&mut ball).collect()
}

#[test]
fn the_integral_is_that_of_the_polynomial() {
    let ball = Metaball { centre: [0.0; 3], density: 0.7, radius: 1.5 };
    for b in [0.0, 0.3, 0.9, 1.2, 1.49] {
        let (mut sum, n) = (0.0, 4000);
        for k in 0..n {
            let t = 1.5 * (2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0);
            let r = (b * b + t * t) / 2.25;
            let wyvill = 1.0 - 4.0 / 9.0 * r * r * r + 17.0 / 9.0 * r * r - 22.0 / 9.0 * r;
            if r < 1.0 {
                assert!((ball.at(b * b + t * t) - 0.7 * wyvill).abs() < 1e-14);
                sum += 0.7 * wyvill * 3.0 / f64::from(n);
            }
        }
        // Midpoints of 4000 parts: the square of a part.
        assert!((ball.depth(b * b) - sum).abs() < 1e-6, "{b}");
    }
    assert_eq!((ball.at(2.25), ball.depth(2.25), ball.depth(9.0)), (0.0, 0.0, 0.0));
}

/// 1e-6: the picture is single precision.
#[test]
fn one_ball_is_its_closed_form() {
    let ball = Metaball { centre: [1.0, 2.0, 3.0], density: 0.8, radius: 0.5 };
    let around = [[0.4, 1.4, 2.4], [1.6, 2.6, 3.6]];
    let camera = Camera::parallel(around, [0.2, 1.0, -0.3], UP, [40, 30]).unwrap();
    let shown = lit(3.0).show(&[ball], &camera).unwrap();
    let mut on = 0;
    for k in 0..1200 {
        let ray = camera.sample([k % 40, k / 40], [0, 0], 1);
        let to = [0, 1, 2].map(|axis| ball.centre[axis] - ray.origin[axis]);
        let along: f64 = (0..3).map(|axis| to[axis] * ray.direction[axis]).sum();
        let square: f64 = to.iter().map(|x| x * x).sum::<f64>() - along * along;
        let left = libm::exp(-3.0 * ball.depth(square));
        on += u64::from(square < 0.25);
        assert!((f64::from(shown.transmittance[k]) - left).abs() < 1e-6);
        assert!((f64::from(shown.radiance[k][1]) - (1.0 - left)).abs() < 1e-6);
    }
    assert_eq!(shown.shadows, [1.0]);
    assert_eq!((shown.work.splats, shown.work.pixels[1]), ([1, 1], on));
    assert!(shown.work.pixels[0] > 10_000 && on > 300);
}

/// The one nearer to the sun shades the other, in whatever order they are given, and the one nearer to the eye is before
/// the other. 1e-2: the shadow is that of a pixel's middle, half a pixel of 256 from the centre.
#[test]
fn two_balls_have_an_order() {
    let upper = Metaball { centre: [0.0, 0.0, 2.0], density: 1.0, radius: 0.6 };
    let lower = Metaball { centre: [0.0, 0.0, 0.0], density: 1.0, radius: 0.8 };
    let look = lit(4.0);
    let dark = libm::exp(-4.0 * upper.depth(0.0));
    let depth = |ball: &Metaball| libm::exp(-4.0 * ball.depth(0.0));
    let around = [[-1.0, -1.0, -1.0], [1.0, 1.0, 3.0]];
    for (balls, shaded) in [([upper, lower], 1), ([lower, upper], 0)] {
        let below = Camera::parallel(around, [0.0, 0.0, 1.0], UP, [101, 101]).unwrap();
        let above = Camera::parallel(around, [0.0, 0.0, -1.0], UP, [101, 101]).unwrap();
        let [from_below, from_above] = [below, above].map(|camera| look.show(&balls, &camera).unwrap());
        let shadow = from_below.shadows[shaded];
        assert!((shadow - dark).abs() < 1e-2 && from_below.shadows[1 - shaded] == 1.0, "{shadow} {dark}");
        let middle = 50 * 101 + 50;
        let [a, b] = [depth(&upper), depth(&lower)];
        let known = [shadow * (1.0 - b) + b * (1.0 - a), (1.0 - a) + a * shadow * (1.0 - b)];
        for (shown, known) in [&from_below, &from_above].into_iter().zip(known) {
            assert!((f64::from(shown.radiance[middle][0]) - known).abs() < 1e-6);
            assert!((f64::from(shown.transmittance[middle]) - a * b).abs() < 1e-6);
        }
    }
}

/// The product of what all balls leave; and the field of the same balls in a volume of 64^3. Its discretisation is of order
/// 2, so what it errs by is a third of what it differs from one of 32^3 by; half is let pass.
#[test]
fn many_balls_are_a_volume() {
    let balls = cloud(12);
    let view = [0.5, 0.7, -0.4];
    let field = |n: usize| {
        Density::sampled([n; 3], 1.0 / n as f64, |place| {
            let square = |ball: &Metaball| {
                (0..3).map(|k| (place[k] - ball.centre[k]) * (place[k] - ball.centre[k])).sum()
            };
            balls.iter().map(|ball| ball.at(square(ball))).sum()
        })
        .unwrap()
    };
    let fields = [32, 64].map(field);
    let camera = Camera::orthographic(&fields[0], view, UP, [48, 40]).unwrap();
    let shown = lit(5.0).show(&balls, &camera).unwrap();
    let dark = Shading::Emission([0.0; 3]);
    let volumes = fields.map(|field| render(&field, 5.0, &camera, &dark, 1).unwrap());
    let (mut least, mut worst, mut between) = (1.0_f64, [0.0_f64; 2], 0.0_f64);
    for k in 0..48 * 40 {
        let Ray { origin, direction } = camera.sample([k % 48, k / 48], [0, 0], 1);
        let depth: f64 = balls
            .iter()
            .map(|ball| {
                let to = [0, 1, 2].map(|axis| ball.centre[axis] - origin[axis]);
                let along: f64 = (0..3).map(|axis| to[axis] * direction[axis]).sum();
                ball.depth(to.iter().map(|x| x * x).sum::<f64>() - along * along)
            })
            .sum();
        let got = f64::from(shown.transmittance[k]);
        assert!((got - libm::exp(-5.0 * depth)).abs() < 1e-6);
        for (worst, volume) in worst.iter_mut().zip(&volumes) {
            *worst = worst.max((got - f64::from(volume.transmittance[k])).abs());
        }
        let [coarse, fine] = [0, 1].map(|which: usize| f64::from(volumes[which].transmittance[k]));
        between = between.max((coarse - fine).abs());
        least = least.min(got);
        assert!(f64::from(shown.radiance[k][0]) <= 1.0 - got + 1e-6);
    }
    assert!(worst[1] < 0.5 * between && worst[1] < worst[0] / 3.0, "{worst:?} {between}");
    assert!(least < 0.2, "{least}");
}

#[test]
fn threads_do_not_matter() {
    let balls = cloud(300);
    let camera = Camera::pinhole([-1.5, -1.0, 0.5], [2.0, 1.5, 0.0], UP, 40.0, [150, 101]).unwrap();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| lit(3.0).show(&balls, &camera).unwrap())
    };
    let one = with(1);
    assert!(one.transmittance.iter().any(|value| *value < 0.1));
    assert!(one.shadows.iter().any(|value| *value < 0.1));
    for threads in [2, 7] {
        assert_eq!(one, with(threads));
    }
}

#[test]
fn nothing_is_nothing_and_what_is_no_ball_is_refused() {
    let camera = Camera::pinhole([0.0; 3], [1.0, 0.0, 0.0], UP, 40.0, [9, 5]).unwrap();
    let shown = lit(3.0).show(&[], &camera).unwrap();
    assert!(shown.transmittance.iter().all(|value| *value == 1.0) && shown.work == Splats::default());
    let ball = Metaball { centre: [-1.0, 0.0, 0.0], density: 1.0, radius: 0.5 };
    let behind = lit(3.0).show(&[ball], &camera).unwrap();
    assert!(behind.radiance.iter().all(|rgb| *rgb == [0.0; 3]) && behind.work.splats == [1, 0]);
    let refused = lit(3.0).show(&[Metaball { radius: 0.0, ..ball }], &camera).unwrap_err();
    assert_eq!(refused.to_string(), "a ball's radius, m, is 0; 1e-9 to 1e9 is handled");
}
