//! Frost as a drawing: cells coloured by the frame in which they froze, over the vapour that is left.

use super::Frost;
use crate::hexgrid::Region;
use crate::image::colour::{FROST, ORANGE};
use crate::image::{Face, ImageError, LatticeRaster, LatticeView, Picture, draw_text};
use crate::sketch::{Chart, Sketch};

/// Outside the sketch.
pub const GROUND: [u8; 3] = [16, 18, 24];
const INK: [u8; 3] = [236, 240, 245];
/// Colours of the ice: the first frame's and the last's, on the map.
const OLDEST: f64 = 0.46;
const NEWEST: f64 = 1.0;
/// Colours of the vapour: none, and as much as at first.
const EMPTY: f64 = 0.02;
const FULL: f64 = 0.22;

/// Draws frost on one sketch, again and again.
pub struct Painter {
    raster: LatticeRaster,
    horizon: f64,
    beta: f64,
}

impl Painter {
    /// Pictures `width` pixels wide of a sketch; ice that froze in frame `horizon` or later has the newest colour, and
    /// vapour of `beta` the fullest. Refused are pictures that are too large.
    pub fn new(region: &Region, width: u32, horizon: u64, beta: f64) -> Result<Self, ImageError> {
        let margin = (width / 40).max(1);
        let raster = LatticeView::around(region, width, margin)?.raster(region, 3);
        Ok(Self { raster, horizon: (horizon.max(1)) as f64, beta })
    }

    /// The same of a sketch whose lattice may be bent.
    pub fn of_sketch(sketch: &Sketch, width: u32, horizon: u64, beta: f64) -> Result<Self, ImageError> {
        if sketch.warp.is_none() {
            return Self::new(&sketch.region, width, horizon, beta);
        }
        let chart = Chart::around(sketch, width, (width / 40).max(1))?;
        let place_of = |pixel| chart.place_of(pixel);
        let raster = LatticeRaster::through(chart.width(), chart.height(), &sketch.region, 3, place_of)?;
        Ok(Self { raster, horizon: (horizon.max(1)) as f64, beta })
    }

    /// The frost with the vapour around it.
    pub fn draw(&self, frost: &Frost) -> Picture {
        let colour = |ordinal| match frost.frozen_in_frame(ordinal) {
            Some(frozen) => self.ice(frozen),
            None => self.vapour(frost, ordinal),
        };
        self.raster.draw(colour, GROUND)
    }

    /// The frost, and what is not ice yet in orange.
    pub fn draw_unfinished(&self, frost: &Frost) -> Picture {
        let colour = |ordinal| frost.frozen_in_frame(ordinal).map_or(ORANGE, |frozen| self.ice(frozen));
        self.raster.draw(colour, GROUND)
    }

    /// The frost alone: a film of such pictures changes only where something freezes, and is small.
    pub fn draw_ice(&self, frost: &Frost) -> Picture {
        self.draw_ice_at(frost, u64::MAX)
    }

    /// The frost alone as it was in an earlier frame.
    pub fn draw_ice_at(&self, frost: &Frost, frame: u64) -> Picture {
        let frozen = |ordinal| frost.frozen_in_frame(ordinal).filter(|frozen| *frozen <= frame);
        self.raster.draw(|ordinal| frozen(ordinal).map_or(FROST.at(FULL), |frozen| self.ice(frozen)), GROUND)
    }

    fn ice(&self, frozen: u64) -> [u8; 3] {
        let age = frozen as f64 / self.horizon;
        FROST.at(OLDEST + (NEWEST - OLDEST) * age.min(1.0))
    }

    fn vapour(&self, frost: &Frost, ordinal: usize) -> [u8; 3] {
        let full = if self.beta > 0.0 { (frost.u(ordinal) / self.beta).min(1.0) } else { 0.0 };
        FROST.at(EMPTY + (FULL - EMPTY) * full)
    }
}

/// Puts a line of text above a picture.
pub fn titled(picture: &Picture, text: &str) -> Result<Picture, ImageError> {
    let size = (f64::from(picture.width()) / 22.0).clamp(12.0, 22.0);
    let band = libm::ceil(1.9 * size) as u32;
    let mut whole = Picture::new(picture.width(), picture.height() + band, GROUND)?;
    whole.paste(picture, 0, band as i32);
    draw_text(&mut whole, 0.6 * size, 1.35 * size, size, INK, text, Face::Regular);
    Ok(whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frost::{Edge, Inflow, Parameters, Redraw, RingTouchingIce};
    use crate::hexgrid::Axial;
    use crate::rng::Seed;

    #[test]
    fn ice_is_lighter_than_vapour_and_vapour_than_nothing() {
        let region = Region::hexagon(6);
        let parameters = Parameters {
            alpha: 1.0,
            beta: 0.5,
            gamma: 0.01,
            threshold: 0.0,
            steps_per_frame: 1,
            inflow: Inflow::ReiterGated,
            redraw: Redraw::Frame,
            edge: Edge::Reflecting,
            ring_touching_ice: RingTouchingIce::Zero,
        };
        let frost = Frost::new(&region, &[Axial::ORIGIN], parameters, Seed(1)).unwrap();
        let painter = Painter::new(&region, 200, 10, 0.5).unwrap();
        let picture = painter.draw(&frost);
        let light = |x: u32, y: u32| picture.get(x, y).unwrap().iter().map(|c| u32::from(*c)).sum::<u32>();
        let (middle, beside) = (light(100, picture.height() / 2), light(140, picture.height() / 2));
        assert!(middle > beside && beside > 0, "{middle} {beside}");
    }
}
