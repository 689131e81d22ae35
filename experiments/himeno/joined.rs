//! What flakes are made of, and how they are measured.

use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};
use snowglobe::lab::Result;
use snowglobe::snow::flake::{Flake, Kind, Template};
use snowglobe::snow::{Branching, History, Over};

use super::setup::{broken, grown, saturated};

/// One crystal of each of the four types, in the order of [`Kind`]: where they grow, small.
pub fn four_types(branching: &Branching, seed: u64) -> Result<Vec<Template>> {
    let plate = History::constant(-15.0, 0.045, Over::Ice, 60.0).map_err(broken)?;
    let column = History::constant(-8.0, 0.045, Over::Ice, 40.0).map_err(broken)?;
    [saturated(-15.0, 12.0)?, saturated(-6.0, 15.0)?, plate, column]
        .iter()
        .map(|history| Ok(Template::new(grown(branching, history, seed)?)))
        .collect()
}

pub const KINDS: [Kind; 4] = [Kind::Dendrite, Kind::Needle, Kind::Plate, Kind::Column];

pub fn kind_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Dendrite => "dendrite",
        Kind::Needle => "needle",
        Kind::Plate => "plate",
        Kind::Column => "column",
    }
}

/// The shortest of three axes of a flake over the longest: roots of the moments of its surface elements.
pub fn aspect_ratio(flake: &Flake, templates: &[Template]) -> f64 {
    let places: Vec<Point3<f64>> = flake.places(templates).collect();
    let n = places.len() as f64;
    let middle = places.iter().fold(nalgebra::Vector3::zeros(), |sum, place| sum + place.coords) / n;
    let mut moments = Matrix3::zeros();
    for place in &places {
        let off = place.coords - middle;
        moments += off * off.transpose();
    }
    let [least, _, most] = eigenvalues(&(moments / n));
    (least.max(0.0) / most).sqrt()
}

/// The eigenvalues of a symmetric matrix, rising: the roots of its cubic by a cosine.
fn eigenvalues(m: &Matrix3<f64>) -> [f64; 3] {
    let mean = m.trace() / 3.0;
    let rest = m - Matrix3::identity() * mean;
    let spread = (rest.iter().map(|x| x * x).sum::<f64>() / 6.0).sqrt();
    if spread == 0.0 {
        return [mean; 3];
    }
    let third = (0.5 * (rest / spread).determinant()).clamp(-1.0, 1.0);
    let angle = libm::acos(third) / 3.0;
    let at = |k: f64| mean + 2.0 * spread * libm::cos(angle + k * std::f64::consts::TAU / 3.0);
    [at(1.0), at(2.0), at(0.0)]
}

/// The slope of ln y over ln x, by least squares, and its standard error.
pub fn log_slope(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (libm::log(*x), libm::log(*y))).collect();
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let (xx, xy) = (mean(&|p| (p.0 - x) * (p.0 - x)), mean(&|p| (p.0 - x) * (p.1 - y)));
    if xx == 0.0 || points.len() < 3 {
        return None;
    }
    let slope = xy / xx;
    let left = mean(&|p| {
        let off = p.1 - y - slope * (p.0 - x);
        off * off
    });
    Some((slope, (left / ((n - 2.0) * xx)).sqrt()))
}

/// The shortest turn from one direction to another, neither of no length: nalgebra's own goes through an angle, whose bits
/// depend on the processor.
pub fn onto(from: &Vector3<f64>, to: &Vector3<f64>) -> UnitQuaternion<f64> {
    let unit = |v: &Vector3<f64>| v / v.norm_squared().sqrt();
    let (from, to) = (unit(from), unit(to));
    let (w, axis) = (1.0 + from.dot(&to), from.cross(&to));
    // Half a turn: about anything across.
    let across = if from.x.abs() < 0.6 { from.cross(&Vector3::x()) } else { from.cross(&Vector3::y()) };
    let (w, axis) = if w > 1e-12 { (w, axis) } else { (0.0, across) };
    let norm = (w * w + axis.norm_squared()).sqrt();
    UnitQuaternion::new_unchecked(Quaternion::from_parts(w / norm, axis / norm))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_are_those_of_a_turned_diagonal() {
        let (sine, cosine) = libm::sincos(0.7);
        let turn = Matrix3::new(cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0);
        let m = turn * Matrix3::from_diagonal(&nalgebra::vector![3.0, 0.5, 1.25]) * turn.transpose();
        for (found, known) in eigenvalues(&m).iter().zip([0.5, 1.25, 3.0]) {
            assert!((found - known).abs() < 1e-12, "{found}");
        }
    }

    #[test]
    fn a_turn_ends_where_it_should() {
        let from = nalgebra::vector![0.3, -2.0, 0.7];
        for to in [nalgebra::vector![1.0, 0.0, 0.0], -from, from, nalgebra::vector![-0.2, 0.9, 5.0]] {
            let turned = onto(&from, &to) * from * (to.norm_squared() / from.norm_squared()).sqrt();
            assert!((turned - to).norm_squared() < 1e-20, "{to}");
        }
    }

    #[test]
    fn a_power_has_its_slope() {
        let points: Vec<(f64, f64)> = (1..9).map(|k| (f64::from(k), 3.0 * f64::from(k * k))).collect();
        let (slope, error) = log_slope(&points).unwrap();
        assert!((slope - 2.0).abs() < 1e-12 && error < 1e-7);
    }
}
