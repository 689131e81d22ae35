//! A smooth one-to-one warp of the plane that a lattice lies in. Beyond the page: no paper has it.
//!
//! On one lattice the arms of all starts are parallel, which no window shows. A rule that knows only neighbours does not
//! see where its cells lie, so the cells may lie anywhere: growth is the same, and the arms bend.
//!
//! With t = (z - centre) / radius, places as complex numbers, the warp takes a place z of the disc |t| <= 1 to
//!
//! w(z) = centre + radius ∫₀ᵗ exp(g(s)) ds,  g(t) = a₁t + a₂t² + a₃t³.
//!
//! It is conformal: near any place a turn by Im g and a scaling by exp(Re g), so that the six arms of a start keep 60
//! degrees between them. Where |Im g| < 90° on the disc, Re w' > 0 there, and on a convex set that makes w one-to-one
//! (Noshiro 1934, Warschawski 1935). Im g is harmonic and so greatest on the circle, where it is made the angle that was
//! asked for, [`MOST_DEGREES`] at the most. At the centre, and as a mean of Im g and of Re g over the disc, the lattice
//! is as it was.

use nalgebra::{Point2, point};

use super::SketchError;
use crate::rng::Seed;

/// The largest turn, in degrees, that is accepted: at 90 two places may become one.
pub const MOST_DEGREES: f64 = 84.0;
/// Degree of g.
const DEGREE: usize = 3;
/// Places on the circle at which extremes are looked for. Between them a g of this degree exceeds the greatest one by
/// 3 parts in a million at the most.
const ROUND: usize = 4096;
/// The most terms of the power series.
const MOST_TERMS: usize = 120;
/// Terms smaller than this are left out: with all that follow they are less than a millionth of a cell.
const LEAST_TERM: f64 = 1e-15;

/// A complex number.
type Complex = [f64; 2];

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn plus(a: Complex, b: Complex) -> Complex {
    [a[0] + b[0], a[1] + b[1]]
}

fn size(a: Complex) -> f64 {
    libm::sqrt(a[0] * a[0] + a[1] * a[1])
}

/// The polynomial with these coefficients, the constant first.
fn polynomial(coefficients: &[Complex], t: Complex) -> Complex {
    coefficients.iter().rev().fold([0.0; 2], |sum, c| plus(times(sum, t), *c))
}

/// How a sketch's lattice is to be warped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The largest turn of the lattice on the disc around the paint, in degrees, 0 to [`MOST_DEGREES`].
    pub degrees: f64,
    /// Decides which way it turns where: stream `conformal`.
    pub seed: Seed,
}

/// A conformal one-to-one map of a disc, from the plane of the lattice to that of the sketch.
#[derive(Clone, Debug, PartialEq)]
pub struct Warp {
    centre: Complex,
    radius: f64,
    g: Vec<Complex>,
    // Power series in t of (w - centre) / radius and of w'.
    series: Vec<Complex>,
    slope: Vec<Complex>,
}

impl Warp {
    /// The warp under which a disc covers the box between two corners.
    ///
    /// # Errors
    ///
    /// An angle that is no number from 0 to [`MOST_DEGREES`].
    pub fn around(least: Point2<f64>, greatest: Point2<f64>, bend: Bend) -> Result<Self, SketchError> {
        if !(0.0..=MOST_DEGREES).contains(&bend.degrees) {
            return Err(SketchError::Bend(bend.degrees));
        }
        let centre = nalgebra::center(&least, &greatest);
        let moment = bend.seed.stream("conformal").at(0);
        let mut g = vec![[0.0; 2]];
        for k in 1..=DEGREE {
            let mut random = moment.place(k as i32, 0, 0);
            let (turn, strength) =
                (2.0 * std::f64::consts::PI * random.uniform(), 0.6 + 0.4 * random.uniform());
            // Falling with k: broad sweeps before ripples.
            let strength = strength / (k * k) as f64;
            g.push([strength * libm::cos(turn), strength * libm::sin(turn)]);
        }
        let greatest_turn = circle().map(|t| polynomial(&g, t)[1].abs()).fold(0.0, f64::max);
        let scale = bend.degrees.to_radians() / greatest_turn;
        for c in &mut g {
            *c = [c[0] * scale, c[1] * scale];
        }
        let slope = exponential(&g);
        let mut series = vec![[0.0; 2]];
        series.extend(slope.iter().enumerate().map(|(n, c)| [c[0] / (n + 1) as f64, c[1] / (n + 1) as f64]));
        // A one-to-one map of the disc covers the disc that its circle stays out of.
        let covered = circle().map(|t| size(polynomial(&series, t))).fold(f64::INFINITY, f64::min);
        let radius = 1.01 * 0.5 * (greatest - least).norm() / covered;
        Ok(Self { centre: [centre.x, centre.y], radius, g, series, slope })
    }

    /// Where a place of the lattice's plane comes to lie.
    pub fn apply(&self, place: Point2<f64>) -> Point2<f64> {
        let w = polynomial(&self.series, self.inward(place));
        point![self.centre[0] + self.radius * w[0], self.centre[1] + self.radius * w[1]]
    }

    /// The place that comes to lie here; `near` is a guess at it.
    ///
    /// Newton's method; of places that the disc does not reach, a place near its edge.
    pub fn invert(&self, place: Point2<f64>, near: Point2<f64>) -> Point2<f64> {
        let goal = self.inward(place);
        let mut t = self.inward(near);
        for _ in 0..40 {
            let miss = plus(polynomial(&self.series, t), [-goal[0], -goal[1]]);
            if size(miss) < 1e-14 {
                break;
            }
            let slope = polynomial(&self.slope, t);
            let over = times(miss, [slope[0], -slope[1]]);
            let norm = slope[0] * slope[0] + slope[1] * slope[1];
            // A step at a time: a long one could leave the disc, where nothing is known of the map.
            let step = [over[0] / norm, over[1] / norm];
            let shortened = (0.5 / size(step)).min(1.0);
            t = [t[0] - shortened * step[0], t[1] - shortened * step[1]];
            let out = size(t);
            if out > 1.05 {
                t = [1.05 * t[0] / out, 1.05 * t[1] / out];
            }
        }
        point![self.centre[0] + self.radius * t[0], self.centre[1] + self.radius * t[1]]
    }

    /// By how much the lattice is turned at a place of its plane, in radians, from x towards y.
    pub fn turn(&self, place: Point2<f64>) -> f64 {
        polynomial(&self.g, self.inward(place))[1]
    }

    /// By how much it is enlarged there.
    pub fn scale(&self, place: Point2<f64>) -> f64 {
        libm::exp(polynomial(&self.g, self.inward(place))[0])
    }

    /// The least and the greatest enlargement on the disc.
    pub fn scales(&self) -> (f64, f64) {
        let log = circle().map(|t| polynomial(&self.g, t)[0]);
        let (least, greatest) = log.fold((0.0, 0.0), |(a, b): (f64, f64), x| (a.min(x), b.max(x)));
        (libm::exp(least), libm::exp(greatest))
    }

    fn inward(&self, place: Point2<f64>) -> Complex {
        [(place.x - self.centre[0]) / self.radius, (place.y - self.centre[1]) / self.radius]
    }
}

/// Places on the unit circle.
fn circle() -> impl Iterator<Item = Complex> {
    (0..ROUND).map(|k| {
        let angle = 2.0 * std::f64::consts::PI * k as f64 / ROUND as f64;
        [libm::cos(angle), libm::sin(angle)]
    })
}

/// The power series of exp(g) for a polynomial g without a constant: from E' = g' E.
fn exponential(g: &[Complex]) -> Vec<Complex> {
    let mut series: Vec<Complex> = vec![[1.0, 0.0]];
    while series.len() < MOST_TERMS {
        let n = series.len();
        let mut next = [0.0; 2];
        for (k, a) in g.iter().enumerate().skip(1).take(n) {
            let weight = k as f64 / n as f64;
            let term = times(*a, series[n - k]);
            next = plus(next, [weight * term[0], weight * term[1]]);
        }
        series.push(next);
        if series.iter().rev().take(DEGREE).all(|c| size(*c) < LEAST_TERM) {
            break;
        }
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;

    fn warp(degrees: f64, seed: u64) -> Warp {
        Warp::around(point![-3.0, 10.0], point![97.0, 66.0], Bend { degrees, seed: Seed(seed) }).unwrap()
    }

    /// Places all over the box.
    fn places() -> impl Iterator<Item = Point2<f64>> {
        (0..=20)
            .flat_map(|j| (0..=20).map(move |i| point![-3.0 + 5.0 * f64::from(i), 10.0 + 2.8 * f64::from(j)]))
    }

    #[test]
    fn every_place_of_the_box_is_reached_and_comes_back() {
        for (degrees, seed) in [(10.0, 1), (50.0, 2), (84.0, 3), (84.0, 4)] {
            let warp = warp(degrees, seed);
            let mut near = point![47.0, 38.0];
            for place in places() {
                near = warp.invert(place, near);
                assert!(size(warp.inward(near)) <= 1.0, "outside the disc");
                assert!((warp.apply(near) - place).norm() < 1e-9, "{degrees} {seed} {place}");
                // The same from afar.
                assert!((warp.invert(place, point![47.0, 38.0]) - near).norm() < 1e-8);
            }
        }
    }

    #[test]
    fn no_two_places_become_one() {
        let warp = warp(84.0, 5);
        let all: Vec<_> = places().map(|place| (place, warp.apply(place))).collect();
        for (i, (a, to_a)) in all.iter().enumerate() {
            for (b, to_b) in &all[i + 1..] {
                // Re w' > 0: what lies to the right stays to the right along any line.
                assert!((to_b - to_a).dot(&(b - a)) > 0.0, "{a} {b}");
            }
        }
    }

    #[test]
    fn it_turns_and_scales_as_it_says_and_the_turn_is_what_was_asked_for() {
        let warp = warp(50.0, 7);
        let (least, greatest) = warp.scales();
        assert!(least > 0.2 && least < 1.0 && greatest > 1.0 && greatest < 5.0, "{least} {greatest}");
        for place in places() {
            let h = 1e-5;
            let along = (warp.apply(place + nalgebra::vector![h, 0.0]) - warp.apply(place)) / h;
            assert!((libm::atan2(along.y, along.x) - warp.turn(place)).abs() < 1e-5);
            assert!((along.norm() / warp.scale(place) - 1.0).abs() < 1e-5);
            assert!(warp.turn(place).abs() <= 50f64.to_radians() + 1e-9);
        }
        let on_circle = circle().map(|t| polynomial(&warp.g, t)[1].abs()).fold(0.0, f64::max);
        assert!((on_circle.to_degrees() - 50.0).abs() < 1e-9);
        assert!(warp.turn(point![47.0, 38.0]).abs() < 1e-12, "the centre is not turned");
    }

    #[test]
    fn no_degrees_move_nothing_and_too_many_are_refused() {
        let still = warp(0.0, 1);
        for place in places() {
            assert!((still.apply(place) - place).norm() < 1e-12);
        }
        for degrees in [-1.0, 84.5, f64::NAN] {
            let refused = Warp::around(point![0.0, 0.0], point![1.0, 1.0], Bend { degrees, seed: Seed(1) });
            assert!(matches!(refused, Err(SketchError::Bend(_))));
        }
    }

    #[test]
    fn the_seed_decides() {
        assert_eq!(warp(40.0, 1), warp(40.0, 1));
        assert_ne!(warp(40.0, 1), warp(40.0, 2));
    }
}
