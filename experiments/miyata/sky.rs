//! A clear sky by single scattering in air.

use snowglobe::image::{Exposure, ImageError, Photograph, Picture, ToneCurve};

/// Optical depth of air from the ground straight up, red, green and blue (Rayleigh, 650, 532 and 450 nm).
const AIR: [f64; 3] = [0.049, 0.112, 0.221];
/// Of haze, grey.
const HAZE: f64 = 0.005;

/// A sky with the sun somewhere behind the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// The sun's height in degrees.
    pub sun: f64,
    /// The elevation at the top of the picture, degrees.
    pub top: f64,
    /// The elevation at the bottom, degrees.
    pub bottom: f64,
    /// Stops.
    pub exposure: f64,
}

impl Sky {
    /// By day.
    pub const DAY: Self = Self { sun: 50.0, top: 60.0, bottom: 12.0, exposure: 0.9 };

    /// The light of the sky at this elevation in degrees.
    pub fn light(&self, elevation: f64) -> [f64; 3] {
        let (along, sun) = (air_mass(elevation), air_mass(self.sun));
        AIR.map(|depth| {
            let depth = depth + HAZE;
            let sunlight = libm::exp(-0.8 * depth * sun);
            sunlight * -libm::expm1(-depth * along)
        })
    }

    /// The light of a row.
    pub fn row(&self, row: f64, height: f64) -> [f64; 3] {
        self.light(self.top + (self.bottom - self.top) * row / height)
    }

    /// The picture of it.
    ///
    /// # Errors
    ///
    /// A size that no picture has.
    pub fn picture(&self, width: u32, height: u32) -> Result<Picture, ImageError> {
        let rows = (0..height).flat_map(|row| {
            let light = self.row(f64::from(row) + 0.5, f64::from(height)).map(|x| x as f32);
            (0..width).map(move |_| light)
        });
        let photograph = Photograph::new(width, height, rows.collect())?;
        Ok(photograph.develop(Exposure { stops: self.exposure }, ToneCurve::Linear))
    }
}

/// How many times the air straight up lies along a direction (Kasten & Young 1989).
fn air_mass(elevation: f64) -> f64 {
    let (sine, _) = libm::sincos(elevation.to_radians());
    1.0 / (sine + 0.50572 * libm::pow(elevation + 6.07995, -1.6364))
}
