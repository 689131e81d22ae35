//! Frost as a drawing: cells coloured by the frame in which they froze, over the vapour that is left.

use nalgebra::{Point2, point, vector};

use super::{Frost, Sectors};
use crate::hexgrid::Region;
use crate::image::colour::{CIVIDIS, FROST, ORANGE};
use crate::image::{Face, ImageError, LatticeRaster, LatticeView, Picture, draw_text, mean_light};
use crate::sketch::{Chart, Sketch};

/// Outside the sketch.
pub const GROUND: [u8; 3] = [16, 18, 24];
const INK: [u8; 3] = [236, 240, 245];
/// Between sectors.
const LINE: [u8; 3] = [40, 16, 24];
/// Colours of the ice: the first frame's and the last's, on the map.
const OLDEST: f64 = 0.46;
const NEWEST: f64 = 1.0;
/// Colours of the vapour: none, and as much as at first.
const EMPTY: f64 = 0.02;
const FULL: f64 = 0.22;
/// Weights of a line and of what is under it add up to this.
const OPAQUE: f64 = 64.0;

/// How the lattice lies in the picture.
enum Lie {
    Straight(LatticeView),
    Bent(Chart),
}

impl Lie {
    /// The place of the lattice's plane at a place of the picture, and the pixels between lattice points there.
    fn at(&self, pixel: Point2<f64>) -> (Point2<f64>, f64) {
        match self {
            Self::Straight(view) => (view.place_of(pixel), view.pixels_per_unit()),
            Self::Bent(chart) => (chart.place_of(pixel), chart.cell_pixels(pixel.x, pixel.y)),
        }
    }
}

/// Draws frost on one sketch, again and again.
pub struct Painter {
    raster: LatticeRaster,
    lie: Lie,
    horizon: f64,
    beta: f64,
}

impl Painter {
    /// Pictures `width` pixels wide of a sketch; ice that froze in frame `horizon` or later has the newest colour, and
    /// vapour of `beta` the fullest. Refused are pictures that are too large.
    pub fn new(region: &Region, width: u32, horizon: u64, beta: f64) -> Result<Self, ImageError> {
        let margin = (width / 40).max(1);
        let view = LatticeView::around(region, width, margin)?;
        let (raster, lie) = (view.raster(region, 3), Lie::Straight(view));
        Ok(Self { raster, lie, horizon: (horizon.max(1)) as f64, beta })
    }

    /// The same of a sketch whose lattice may be bent.
    pub fn of_sketch(sketch: &Sketch, width: u32, horizon: u64, beta: f64) -> Result<Self, ImageError> {
        if sketch.warp.is_none() {
            return Self::new(&sketch.region, width, horizon, beta);
        }
        let chart = Chart::around(sketch, width, (width / 40).max(1))?;
        let place_of = |pixel| chart.place_of(pixel);
        let raster = LatticeRaster::through(chart.width(), chart.height(), &sketch.region, 3, place_of)?;
        Ok(Self { raster, lie: Lie::Bent(chart), horizon: (horizon.max(1)) as f64, beta })
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
        self.draw_unfinished_at(frost, u64::MAX)
    }

    /// The frost as it was in an earlier frame, and what was not ice then in orange.
    pub fn draw_unfinished_at(&self, frost: &Frost, frame: u64) -> Picture {
        let frozen = |ordinal| frost.frozen_in_frame(ordinal).filter(|frozen| *frozen <= frame);
        self.raster.draw(|ordinal| frozen(ordinal).map_or(ORANGE, |frozen| self.ice(frozen)), GROUND)
    }

    /// Vapour cell by cell, by ordinal: dark blue for `range.0`, yellow for `range.1`.
    pub fn draw_vapour(&self, vapour: &[f64], range: (f64, f64)) -> Picture {
        let share = |value: f64| (value - range.0) / (range.1 - range.0);
        let colour = |ordinal| vapour.get(ordinal).map_or(GROUND, |&value| CIVIDIS.at(share(value)));
        self.raster.draw(colour, GROUND)
    }

    /// Draws thin lines between sectors over one of these pictures; none where there is only one.
    pub fn draw_sectors(&self, picture: &mut Picture, sectors: &Sectors) {
        let turn = 2.0 * std::f64::consts::PI / sectors.count() as f64;
        let rays: Vec<(f64, f64)> = (0..sectors.count()).map(|k| libm::sincos(turn * k as f64)).collect();
        if rays.len() < 2 {
            return;
        }
        let (width, height) = (picture.width(), picture.height());
        let half_width = f64::from(width) / 700.0;
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let (place, pixels) = self.lie.at(point![f64::from(x) + 0.5, f64::from(y) + 0.5]);
            let away = (place - sectors.centre().position()) * pixels;
            let nearest = rays.iter().map(|(sin, cos)| {
                let along = away.dot(&vector![*cos, *sin]);
                if along > 0.0 { (away.y * cos - away.x * sin).abs() } else { f64::INFINITY }
            });
            let cover = (half_width + 0.5 - nearest.fold(f64::INFINITY, f64::min)).clamp(0.0, 1.0);
            let weight = libm::round(cover * OPAQUE) as u16;
            if let Some(under) = picture.get(x, y).filter(|_| weight > 0) {
                picture.set(x, y, mean_light([(LINE, weight), (under, OPAQUE as u16 - weight)]));
            }
        }
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

    fn frost(region: &Region) -> Frost {
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
        Frost::new(region, &[Axial::ORIGIN], parameters, Seed(1)).unwrap()
    }

    #[test]
    fn ice_is_lighter_than_vapour_and_vapour_than_nothing() {
        let region = Region::hexagon(6);
        let painter = Painter::new(&region, 200, 10, 0.5).unwrap();
        let picture = painter.draw(&frost(&region));
        let light = |x: u32, y: u32| picture.get(x, y).unwrap().iter().map(|c| u32::from(*c)).sum::<u32>();
        let (middle, beside) = (light(100, picture.height() / 2), light(140, picture.height() / 2));
        assert!(middle > beside && beside > 0, "{middle} {beside}");
    }

    #[test]
    fn what_was_unfinished_in_a_frame_is_what_was_unfinished_then() {
        let region = Region::hexagon(6);
        let painter = Painter::new(&region, 200, 60, 0.5).unwrap();
        let mut frost = frost(&region);
        (0..30).for_each(|_| frost.frame());
        let then = painter.draw_unfinished(&frost);
        (0..30).for_each(|_| frost.frame());
        assert_eq!(painter.draw_unfinished_at(&frost, 30), then);
        assert_ne!(painter.draw_unfinished(&frost), then);
    }

    #[test]
    fn vapour_has_a_colour_and_lines_stand_between_sectors() {
        let region = Region::hexagon(6);
        let painter = Painter::new(&region, 200, 10, 0.5).unwrap();
        let sectors = Sectors::around(&region, Axial::ORIGIN, 2).unwrap();
        let vapour = sectors.field(&[0.2, 0.6]).unwrap();
        let mut picture = painter.draw_vapour(&vapour, (0.2, 0.6));
        let middle = picture.height() / 2;
        let (below, above) = (picture.get(100, middle + 30), picture.get(100, middle - 30));
        assert_eq!((below, above), (Some(CIVIDIS.at(0.0)), Some(CIVIDIS.at(1.0))), "y runs down");
        let bare = picture.clone();
        painter.draw_sectors(&mut picture, &sectors);
        let lined: Vec<u32> =
            (0..picture.height()).filter(|&y| picture.get(40, y) != bare.get(40, y)).collect();
        assert!(!lined.is_empty() && lined.iter().all(|y| y.abs_diff(middle) <= 1), "{lined:?}");
        assert_eq!((picture.get(100, middle + 30), picture.get(100, middle - 30)), (below, above));
        let one = Sectors::around(&region, Axial::ORIGIN, 1).unwrap();
        let before = picture.clone();
        painter.draw_sectors(&mut picture, &one);
        assert_eq!(picture, before);
    }
}
