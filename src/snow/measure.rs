//! The box dimension of a layer, and the mismatch of a crystal with its turned and mirrored images.

use std::collections::BTreeSet;

use crate::hexgrid::Axial;

use super::{Crystal, Layer};

/// Box dimension of a layer: the slope of log N over log 1/side, by least squares over boxes of 1, 2, 4, ... up to an
/// eighth of the layer's width, in cells. Boxes are rhombs along two of the six directions. None if fewer than three
/// sides fit.
pub fn box_dimension(layer: &Layer) -> Option<f64> {
    let cells: Vec<Axial> = layer.cells().collect();
    let reach = cells.iter().map(|at| at.q.abs().max(at.r.abs())).max()?;
    let mut points = Vec::new();
    let mut side = 1;
    while side <= (2 * reach + 1) / 8 {
        let boxes: BTreeSet<(i32, i32)> =
            cells.iter().map(|at| (at.q.div_euclid(side), at.r.div_euclid(side))).collect();
        points.push((libm::log(f64::from(side)), libm::log(boxes.len() as f64)));
        side *= 2;
    }
    if points.len() < 3 {
        return None;
    }
    let n = points.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let (xx, xy) = (mean(&|p| (p.0 - x) * (p.0 - x)), mean(&|p| (p.0 - x) * (p.1 - y)));
    Some(-xy / xx)
}

/// How many elements of a crystal have no image in it: after a turn by 60 degrees, and after a mirror. Counted over all
/// elements, not over a twelfth.
pub fn symmetry_mismatch(crystal: &Crystal) -> [usize; 2] {
    let all: BTreeSet<(Axial, i32)> = crystal.elements().collect();
    let missing = |image: &dyn Fn(Axial) -> Axial| {
        all.iter().filter(|(at, z)| !all.contains(&(image(*at), *z))).count()
    };
    [missing(&Axial::rotated), missing(&Axial::mirrored)]
}
