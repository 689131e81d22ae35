//! The layer of droplets between the surface and the face that cuts it off: §3.2.

use super::light::{Cut, Passage, lost};
use super::raster::Raster;
use super::surface::{Corner, Surface, centroid};
use super::view::{Fineness, Overhead, Window};

/// Droplets of even density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Where they end below.
    pub cut: Cut,
    /// What L is.
    pub passage: Passage,
    /// What of the light they take away, per unit of the plan.
    pub gamma: f64,
}

impl Layer {
    /// L of a triangle, from its centroid along the vertical: Eq. (3).
    pub fn length(&self, corners: &[Corner; 3]) -> f64 {
        let [x, y, z] = centroid(corners);
        self.passage.length(z, self.cut.height([x, y]))
    }

    /// f of a triangle: Eq. (5).
    pub fn lost(&self, corners: &[Corner; 3]) -> f64 {
        let length = self.length(corners);
        if length == 0.0 { 0.0 } else { lost(self.gamma, length) }
    }

    /// f of every pixel, seen from above.
    pub fn seen_from_above(&self, surface: &Surface, window: &Window, fineness: Fineness) -> Raster<1> {
        window.show(surface, fineness, |corners| [self.lost(corners)])
    }

    /// f of every pixel of a layer overhead. L stays that along the vertical, as in the paper.
    pub fn seen_from_below(&self, surface: &Surface, view: &Overhead, pixels: f64) -> Raster<1> {
        view.show(surface, pixels, |corners| [self.lost(corners)])
    }
}
