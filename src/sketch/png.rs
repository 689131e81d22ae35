//! Painted pictures.

use nalgebra::{Point2, point};

use super::place::{Grid, Paint, lay};
use super::{Bend, MOST_STARTS, Placement, Sketch, SketchError, one_line};
use crate::image::{self, ImageError};

const BARE: u8 = 0;
const PAINT: u8 = 1;
const RED: u8 = 2;

/// Reads a PNG picture of any colour type and depth; sketch units are pixels, and pixel (i, j) covers the square
/// [i, i + 1) x [j, j + 1).
///
/// Opaque pixels (alpha at least 128 of 255) that are not white are paint. Pure red, opaque pixels (255, 0, 0) are paint
/// too, and each 8-connected blob of them is a start at its centroid or, where the centroid is not on the blob, at its
/// pixel nearest to it; starts are counted in page order of their first pixels. Depths of 16 bits are rounded to 8.
///
/// # Errors
/// A picture that cannot be decoded, has more than [`image::MOST_PIXELS`] pixels or no paint, or whose placement cannot be had.
pub fn read_png(bytes: &[u8], placement: Placement) -> Result<Sketch, SketchError> {
    read_png_bent(bytes, placement, None)
}

/// The same on a lattice that is bent, if it is.
///
/// # Errors
/// As [`read_png`], and an angle that is not accepted.
pub fn read_png_bent(bytes: &[u8], placement: Placement, bend: Option<Bend>) -> Result<Sketch, SketchError> {
    let mut picture = decode(bytes)?;
    let starts = picture.take_blobs()?;
    lay(&picture, &starts, placement, bend)
}

#[derive(Debug)]
struct Picture {
    width: usize,
    // Row by row.
    pixels: Vec<u8>,
    least: Point2<f64>,
    greatest: Point2<f64>,
}

fn decode(bytes: &[u8]) -> Result<Picture, SketchError> {
    let decoded = image::decode(bytes).map_err(|cause| match cause {
        ImageError::TooLarge { width, height } => SketchError::TooManyPixels { width, height },
        other => SketchError::Png { what: one_line(other) },
    })?;
    let kind = |[red, green, blue, alpha]: [u8; 4]| match [red, green, blue] {
        _ if alpha < 128 => BARE,
        [255, 0, 0] => RED,
        [255, 255, 255] => BARE,
        _ => PAINT,
    };
    let pixels: Vec<u8> = decoded.rgba.into_iter().map(kind).collect();
    let width = decoded.width as usize;
    let painted = || pixels.iter().enumerate().filter(|(_, p)| **p != BARE).map(|(i, _)| i);
    let (Some(first), Some(last)) = (painted().next(), painted().next_back()) else {
        return Err(SketchError::NoPaint {
            expected: "at least one opaque pixel (alpha 128 or more) that is not white",
        });
    };
    let (left, right) = painted().map(|i| i % width).fold((width, 0), |(l, r), x| (l.min(x), r.max(x + 1)));
    let least = point![left as f64, (first / width) as f64];
    let greatest = point![right as f64, (last / width + 1) as f64];
    Ok(Picture { width, pixels, least, greatest })
}

impl Picture {
    /// The starts; red becomes ordinary paint.
    fn take_blobs(&mut self) -> Result<Vec<Point2<f64>>, SketchError> {
        let mut starts = Vec::new();
        for first in 0..self.pixels.len() {
            if self.pixels[first] != RED {
                continue;
            }
            if starts.len() == MOST_STARTS {
                return Err(SketchError::TooManyStarts);
            }
            let blob = self.take_blob(first);
            starts.push(self.centre(&blob));
        }
        Ok(starts)
    }

    fn take_blob(&mut self, first: usize) -> Vec<u32> {
        let (width, height) = (self.width, self.pixels.len() / self.width);
        self.pixels[first] = PAINT;
        let mut blob = vec![first as u32];
        let mut next = 0;
        while let Some(&at) = blob.get(next) {
            next += 1;
            let (x, y) = (at as usize % width, at as usize / width);
            for j in y.saturating_sub(1)..(y + 2).min(height) {
                for i in x.saturating_sub(1)..(x + 2).min(width) {
                    let near = j * width + i;
                    if self.pixels[near] == RED {
                        self.pixels[near] = PAINT;
                        blob.push(near as u32);
                    }
                }
            }
        }
        blob
    }

    fn centre(&self, blob: &[u32]) -> Point2<f64> {
        let place = |at: u32| (u64::from(at) % self.width as u64, u64::from(at) / self.width as u64);
        let (x, y) = blob.iter().map(|at| place(*at)).fold((0, 0), |(a, b), (x, y)| (a + x, b + y));
        let count = blob.len() as f64;
        let centroid = point![x as f64 / count + 0.5, y as f64 / count + 0.5];
        let pixel = (centroid.x as u64, centroid.y as u64);
        if blob.iter().any(|at| place(*at) == pixel) {
            return centroid;
        }
        let middle = |at: u32| point![place(at).0 as f64 + 0.5, place(at).1 as f64 + 0.5];
        let away = |at: u32| (middle(at) - centroid).norm_squared();
        let nearest = blob.iter().copied().min_by(|a, b| away(*a).total_cmp(&away(*b)).then(a.cmp(b)));
        nearest.map_or(centroid, middle)
    }
}

impl Paint for Picture {
    fn bounds(&self) -> (Point2<f64>, Point2<f64>) {
        (self.least, self.greatest)
    }

    fn covers(&self, place: Point2<f64>) -> Result<bool, SketchError> {
        let (x, y) = (libm::floor(place.x), libm::floor(place.y));
        let inside = x >= self.least.x && x < self.greatest.x && y >= self.least.y && y < self.greatest.y;
        Ok(inside && self.pixels[y as usize * self.width + x as usize] != BARE)
    }

    fn fill(&self, grid: &mut Grid) -> Result<(), SketchError> {
        for row in 0..grid.rows() {
            for column in 0..grid.columns() {
                if self.covers(grid.position(row, column))? {
                    grid.set(row, column..column + 1, true);
                }
            }
        }
        Ok(())
    }
}
