//! Hexagons in the plane: data on the lattice drawn so that a disc is round.
//!
//! Every pixel is sampled on a square grid, a sample takes the colour of the hexagon that contains it, and the samples
//! of a pixel are averaged as light. A [`LatticeRaster`] remembers which cells a pixel meets, so that the frames of an
//! animation are only looked up.

use nalgebra::{Point2, point};
use rayon::prelude::*;

use super::transfer::mean_light;
use super::{ImageError, Kind, Picture, pixel_count};
use crate::hexgrid::{Axial, Region};

/// From the centre of a hexagon to the middle of its sides, which stand left and right.
const INRADIUS: f64 = 0.5;

/// From the centre of a hexagon to its corners, two of which are its top and bottom: 1/√3.
const CIRCUMRADIUS: f64 = 0.577_350_269_189_625_8;

/// The most samples of a pixel along each axis.
pub const MOST_SAMPLES: u32 = 16;

/// A window on the plane of the lattice: what a picture shows, and how large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticeView {
    centre: Point2<f64>,
    pixels_per_unit: f64,
    width: u32,
    height: u32,
}

impl LatticeView {
    /// A picture of `width` by `height` pixels with `centre` in its middle, in which neighbouring points of the lattice
    /// are `pixels_per_unit` pixels apart. Refused are sizes that are not handled and scales that are not positive.
    pub fn new(
        centre: Point2<f64>,
        pixels_per_unit: f64,
        width: u32,
        height: u32,
    ) -> Result<Self, ImageError> {
        pixel_count(width, height)?;
        if !(pixels_per_unit.is_finite() && pixels_per_unit > 0.0) {
            return Err(ImageError::Scale(pixels_per_unit));
        }
        Ok(Self { centre, pixels_per_unit, width, height })
    }

    /// All hexagons of a region in a picture `width` pixels wide, with at least `margin` empty pixels on each side;
    /// the height follows. Refused when the margins leave no room, or the picture is too large.
    pub fn around(region: &Region, width: u32, margin: u32) -> Result<Self, ImageError> {
        let (least, greatest) = extent(region);
        let room = f64::from(width) - 2.0 * f64::from(margin);
        let pixels_per_unit = room / (greatest.x - least.x);
        let height = libm::ceil((greatest.y - least.y) * pixels_per_unit) + 2.0 * f64::from(margin);
        let centre = nalgebra::center(&least, &greatest);
        Self::new(centre, pixels_per_unit, width, height as u32)
    }

    /// Width of the picture in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height of the picture in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Pixels between neighbouring points of the lattice.
    pub fn pixels_per_unit(&self) -> f64 {
        self.pixels_per_unit
    }

    /// The corners of the picture in the plane: least x and y, greatest x and y.
    pub fn bounds(&self) -> (Point2<f64>, Point2<f64>) {
        (
            self.place_of(point![0.0, 0.0]),
            self.place_of(point![f64::from(self.width), f64::from(self.height)]),
        )
    }

    /// The place of the plane at a place of the picture, in pixels from its top left corner; the middle of the first
    /// pixel is (0.5, 0.5).
    pub fn place_of(&self, pixel: Point2<f64>) -> Point2<f64> {
        self.centre + (pixel - self.middle()) / self.pixels_per_unit
    }

    /// The place of the picture, in pixels, at a place of the plane; the inverse of [`place_of`](Self::place_of).
    pub fn pixel_of(&self, place: Point2<f64>) -> Point2<f64> {
        self.middle() + (place - self.centre) * self.pixels_per_unit
    }

    fn middle(&self) -> Point2<f64> {
        point![0.5 * f64::from(self.width), 0.5 * f64::from(self.height)]
    }

    /// The picture of a colour for every hexagon, of `samples` (1 to [`MOST_SAMPLES`]) a pixel along each axis.
    pub fn draw(&self, samples: u32, colour_of: impl Fn(Axial) -> [u8; 3] + Sync) -> Picture {
        let sampler = self.sampler(samples);
        Picture::painted(self.width, self.height, Kind::Drawing, |y, row| {
            let mut parts = Vec::new();
            for (x, pixel) in row.iter_mut().enumerate() {
                sampler.sample(x, y, &colour_of, &mut parts);
                *pixel = blended(&parts);
            }
        })
    }

    /// Which cells of a region every pixel meets, by `samples` (1 to [`MOST_SAMPLES`]) a pixel along each axis.
    pub fn raster(&self, region: &Region, samples: u32) -> LatticeRaster {
        LatticeRaster::sampled(self.width, self.height, region, &self.sampler(samples))
    }

    fn sampler(&self, samples: u32) -> Sampler<impl Fn(Point2<f64>) -> Point2<f64> + Sync> {
        let half_diagonal = std::f64::consts::FRAC_1_SQRT_2 / self.pixels_per_unit;
        let inside = (INRADIUS - half_diagonal).max(0.0);
        Sampler { inside: inside * inside, ..Sampler::new(|pixel| self.place_of(pixel), samples) }
    }
}

/// Least and greatest x and y of the hexagons of a region.
fn extent(region: &Region) -> (Point2<f64>, Point2<f64>) {
    let infinite = Point2::new(f64::INFINITY, f64::INFINITY);
    let (least, greatest) = region
        .cells()
        .iter()
        .map(|cell| cell.position())
        .fold((infinite, -infinite), |(least, greatest), at| (least.inf(&at), greatest.sup(&at)));
    let reach = nalgebra::vector![INRADIUS, CIRCUMRADIUS];
    (least - reach, greatest + reach)
}

/// The samples of a pixel.
struct Sampler<F> {
    // The place of the plane at a place of the picture.
    place_of: F,
    samples: u32,
    // A pixel whose middle is nearer than this to the centre of its hexagon lies inside it, squared.
    inside: f64,
}

impl<F: Fn(Point2<f64>) -> Point2<f64>> Sampler<F> {
    /// Takes all samples of every pixel.
    fn new(place_of: F, samples: u32) -> Self {
        Self { place_of, samples: samples.clamp(1, MOST_SAMPLES), inside: 0.0 }
    }

    /// What a pixel meets, each thing once with the number of samples that met it.
    fn sample<T: PartialEq>(&self, x: usize, y: usize, what: impl Fn(Axial) -> T, parts: &mut Vec<(T, u16)>) {
        parts.clear();
        let (x, y) = (x as f64, y as f64);
        let middle = (self.place_of)(point![x + 0.5, y + 0.5]);
        let cell = Axial::containing(middle);
        if (middle - cell.position()).norm_squared() < self.inside {
            parts.push((what(cell), 1));
            return;
        }
        let step = 1.0 / f64::from(self.samples);
        let offset = |sample: u32| (f64::from(sample) + 0.5) * step;
        for row in 0..self.samples {
            for column in 0..self.samples {
                let place = (self.place_of)(point![x + offset(column), y + offset(row)]);
                let met = what(Axial::containing(place));
                match parts.iter_mut().find(|part| part.0 == met) {
                    Some(part) => part.1 += 1,
                    None => parts.push((met, 1)),
                }
            }
        }
    }
}

fn blended(parts: &[([u8; 3], u16)]) -> [u8; 3] {
    match parts {
        [(colour, _)] => *colour,
        _ => mean_light(parts.iter().copied()),
    }
}

/// The ordinal of what is no cell of the region.
const OUTSIDE: u32 = (1 << 31) - 1;

/// The bit that marks a pixel of several cells; the others number it among its row's.
const MIXED: u32 = 1 << 31;

/// Which cells of a region every pixel of a view meets.
#[derive(Clone, Debug)]
pub struct LatticeRaster {
    width: u32,
    height: u32,
    cells: usize,
    rows: Vec<RasterRow>,
}

/// One row of pixels.
#[derive(Clone, Debug, Default)]
struct RasterRow {
    // The ordinal of the one cell there, or OUTSIDE, or MIXED and a position in `ends`.
    pixels: Vec<u32>,
    // Where the parts of each mixed pixel end; they begin where those of the last end.
    ends: Vec<u32>,
    // Ordinals with numbers of samples.
    parts: Vec<(u32, u16)>,
}

impl RasterRow {
    fn push(&mut self, parts: &[(u32, u16)]) {
        if let [(ordinal, _)] = parts {
            self.pixels.push(*ordinal);
        } else {
            self.pixels.push(MIXED | self.ends.len() as u32);
            self.parts.extend_from_slice(parts);
            self.ends.push(self.parts.len() as u32);
        }
    }

    fn mixture(&self, number: usize) -> &[(u32, u16)] {
        let start = if number == 0 { 0 } else { self.ends[number - 1] };
        &self.parts[start as usize..self.ends[number] as usize]
    }
}

impl LatticeRaster {
    /// Which cells of a region every pixel meets where the lattice does not lie straight in the picture: `place_of` has
    /// the place of the lattice's plane at a place of the picture, in pixels from its top left corner. Refused are
    /// sizes that are not handled.
    pub fn through(
        width: u32,
        height: u32,
        region: &Region,
        samples: u32,
        place_of: impl Fn(Point2<f64>) -> Point2<f64> + Sync,
    ) -> Result<Self, ImageError> {
        pixel_count(width, height)?;
        Ok(Self::sampled(width, height, region, &Sampler::new(place_of, samples)))
    }

    fn sampled<F>(width: u32, height: u32, region: &Region, sampler: &Sampler<F>) -> Self
    where
        F: Fn(Point2<f64>) -> Point2<f64> + Sync,
    {
        let ordinal = |at| region.ordinal(at).map_or(OUTSIDE, |ordinal| ordinal as u32);
        let row = |y| {
            let (mut row, mut parts) = (RasterRow::default(), Vec::new());
            for x in 0..width as usize {
                sampler.sample(x, y, ordinal, &mut parts);
                row.push(&parts);
            }
            row
        };
        let rows = (0..height as usize).into_par_iter().map(row).collect();
        Self { width, height, cells: region.len(), rows }
    }

    /// The picture of a colour for every cell, by its ordinal in the region, on a ground of another colour.
    pub fn draw(&self, colour_of: impl Fn(usize) -> [u8; 3], ground: [u8; 3]) -> Picture {
        let colours: Vec<[u8; 3]> = (0..self.cells).map(colour_of).collect();
        let colour = |ordinal: u32| colours.get(ordinal as usize).copied().unwrap_or(ground);
        Picture::painted(self.width, self.height, Kind::Drawing, |y, pixels| {
            let row = &self.rows[y];
            for (pixel, met) in pixels.iter_mut().zip(&row.pixels) {
                *pixel = match met & MIXED {
                    0 => colour(*met),
                    _ => {
                        let parts = row.mixture((met ^ MIXED) as usize);
                        mean_light(parts.iter().map(|(ordinal, weight)| (colour(*ordinal), *weight)))
                    }
                };
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: [u8; 3] = [0, 0, 40];
    const ICE: [u8; 3] = [200, 230, 255];

    fn checkered(at: Axial) -> [u8; 3] {
        [(at.q * 37) as u8, (at.r * 53) as u8, ((at.q - at.r) * 11) as u8]
    }

    #[test]
    fn a_disc_is_round() {
        let disc = Region::disc(576);
        let view = LatticeView::around(&disc, 512, 8).unwrap();
        let picture = view.raster(&disc, 3).draw(|_| ICE, GROUND);
        let inked = |x: u32, y: u32| picture.get(x, y) != Some(GROUND);
        let columns: Vec<u32> =
            (0..view.width()).filter(|x| (0..view.height()).any(|y| inked(*x, y))).collect();
        let rows: Vec<u32> = (0..view.height()).filter(|y| (0..view.width()).any(|x| inked(x, *y))).collect();
        assert_eq!((columns[0], *columns.last().unwrap()), (8, 503));
        assert!(columns.len().abs_diff(rows.len()) < 12, "{} by {}", columns.len(), rows.len());
        let covered = picture.pixels().iter().filter(|p| **p == ICE).count() as f64;
        let area = 2083.0 * crate::hexgrid::ROW_HEIGHT * view.pixels_per_unit() * view.pixels_per_unit();
        assert!((covered / area - 1.0).abs() < 0.02);
    }

    #[test]
    fn the_picture_of_a_disc_is_its_own_mirror_image() {
        let disc = Region::disc(100);
        let view = LatticeView::new(point![0.0, 0.0], 13.37, 301, 299).unwrap(); // no sample on a side of a hexagon
        let picture = view.draw(3, |at| if disc.contains(at) { ICE } else { GROUND });
        assert!(picture.pixels().iter().eq(picture.pixels().iter().rev()));
    }

    #[test]
    fn the_raster_draws_what_the_view_draws() {
        let disc = Region::disc(49);
        for (width, samples) in [(40, 3), (200, 1), (333, 4), (9, 16)] {
            let view = LatticeView::around(&disc, width, 3).unwrap();
            let direct = view.draw(samples, |at| if disc.contains(at) { checkered(at) } else { GROUND });
            let looked_up = view.raster(&disc, samples).draw(|i| checkered(disc.cells()[i]), GROUND);
            assert_eq!(direct, looked_up, "{width} pixels wide");
            let (w, h) = (view.width(), view.height());
            let through = LatticeRaster::through(w, h, &disc, samples, |pixel| view.place_of(pixel)).unwrap();
            assert_eq!(through.draw(|i| checkered(disc.cells()[i]), GROUND), direct);
        }
    }

    #[test]
    fn the_short_way_through_a_pixel_changes_nothing() {
        let view = LatticeView::new(point![0.3, -0.2], 7.3, 120, 90).unwrap();
        let plain = Sampler::new(|pixel| view.place_of(pixel), 3);
        let mut parts = Vec::new();
        let picture = view.draw(3, checkered);
        for (at, pixel) in picture.pixels().iter().enumerate() {
            plain.sample(at % 120, at / 120, checkered, &mut parts);
            assert_eq!(*pixel, blended(&parts));
        }
    }

    #[test]
    fn a_pixel_shows_the_cell_at_its_place() {
        let view = LatticeView::new(point![2.0, 1.0], 20.0, 200, 100).unwrap();
        let picture = view.draw(2, checkered);
        for at in [Axial::new(0, 0), Axial::new(3, 1), Axial::new(-1, 3)] {
            let pixel = view.pixel_of(at.position());
            assert_eq!(picture.get(pixel.x as u32, pixel.y as u32), Some(checkered(at)));
            assert!((view.place_of(pixel) - at.position()).norm() < 1e-12);
        }
    }

    #[test]
    fn edges_are_averaged_as_light() {
        let one = Region::disc(0);
        let view = LatticeView::around(&one, 101, 10).unwrap();
        let picture = view.raster(&one, 2).draw(|_| [255; 3], [0; 3]);
        let edge: Vec<u8> = picture.pixels().iter().map(|p| p[0]).filter(|code| *code % 255 != 0).collect();
        assert!(edge.contains(&188) && edge.iter().all(|code| [137, 188, 225].contains(code)), "{edge:?}");
    }

    #[test]
    fn a_view_without_room_is_refused() {
        let disc = Region::disc(9);
        assert!(matches!(LatticeView::around(&disc, 20, 10), Err(ImageError::Scale(_))));
        assert!(matches!(LatticeView::around(&disc, 0, 0), Err(ImageError::Empty { .. })));
        assert!(matches!(LatticeView::around(&disc, 1 << 20, 0), Err(ImageError::TooLarge { .. })));
        assert!(matches!(LatticeView::new(point![0.0, 0.0], f64::NAN, 9, 9), Err(ImageError::Scale(_))));
    }
}
