//! What a lens does to what it is not focused on.

use rayon::prelude::*;

/// A picture out of focus: spread by three even spreads in rows and in columns, nearly Gauss's bell, whose standard
/// deviation is `share` of the picture's width. What would leave the picture is thrown back into it, so that its mean
/// stays.
pub fn defocused(light: &[[f32; 3]], [width, height]: [usize; 2], share: f64) -> Vec<[f32; 3]> {
    let deviation = share.max(0.0) * width as f64;
    let spread = Spread::new(deviation * deviation / 3.0);
    let across = spread.rows(light, width);
    transposed(&spread.rows(&transposed(&across, width), height), height)
}

/// The mean of a pixel and as many on both sides as are whole; the two beyond count in part.
struct Spread {
    whole: i64,
    part: f64,
}

impl Spread {
    /// Of a variance.
    fn new(variance: f64) -> Self {
        // n whole ones on both sides have the variance n (n + 1) / 3; the part is what is missing.
        let n = libm::floor(libm::sqrt(3.0 * variance + 0.25) - 0.5);
        let part =
            (2.0 * n + 1.0) * (variance - n * (n + 1.0) / 3.0) / (2.0 * ((n + 1.0) * (n + 1.0) - variance));
        Self { whole: n as i64, part: part.max(0.0) }
    }

    /// Each row spread three times.
    fn rows(&self, light: &[[f32; 3]], width: usize) -> Vec<[f32; 3]> {
        let mut all = light.to_vec();
        all.par_chunks_mut(width).for_each(|row| (0..3).for_each(|_| self.once(row)));
        all
    }

    fn once(&self, row: &mut [[f32; 3]]) {
        let (count, whole, part) = (row.len() as i64, self.whole, self.part);
        let per = 1.0 / (2.0 * (whole as f64 + part) + 1.0);
        let before = row.to_vec();
        let at = |k: i64| {
            let k = k.rem_euclid(2 * count);
            before[k.min(2 * count - 1 - k) as usize].map(f64::from)
        };
        let mut sum = [0.0; 3];
        for k in -whole..=whole {
            let light = at(k);
            sum = [0, 1, 2].map(|c| sum[c] + light[c]);
        }
        for (k, pixel) in (0..).zip(row) {
            let (left, right) = (at(k - whole - 1), at(k + whole + 1));
            *pixel = [0, 1, 2].map(|c| ((sum[c] + part * (left[c] + right[c])) * per) as f32);
            let last = at(k - whole);
            sum = [0, 1, 2].map(|c| sum[c] + right[c] - last[c]);
        }
    }
}

/// Columns as rows.
fn transposed(light: &[[f32; 3]], width: usize) -> Vec<[f32; 3]> {
    let height = light.len() / width;
    let mut all = vec![[0.0; 3]; light.len()];
    all.par_chunks_mut(height).enumerate().for_each(|(column, turned)| {
        for (row, pixel) in turned.iter_mut().enumerate() {
            *pixel = light[row * width + column];
        }
    });
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_becomes_a_bell_of_its_width_and_the_mean_stays() {
        let size = [60, 40];
        for (share, place) in [(0.01, [30, 20]), (0.05, [30, 20]), (0.05, [0, 39]), (0.4, [13, 2])] {
            let mut light = vec![[0.0; 3]; 60 * 40];
            light[place[1] * 60 + place[0]] = [1.0, 2.0, 0.5];
            let blurred = defocused(&light, size, share);
            let sum = |of: fn(f64) -> f64, c: usize| {
                let pixels = blurred.iter().enumerate();
                pixels.map(|(k, light)| f64::from(light[c]) * of((k % 60) as f64 - 30.0)).sum::<f64>()
            };
            for (c, known) in [1.0, 2.0, 0.5].into_iter().enumerate() {
                assert!((sum(|_| 1.0, c) / known - 1.0).abs() < 1e-5);
            }
            if place == [30, 20] {
                let (variance, known) = (sum(|x| x * x, 0), share * share * 3600.0);
                assert!((variance / known - 1.0).abs() < 0.01, "{variance} for {known}");
            }
        }
    }

    #[test]
    fn in_focus_nothing_changes() {
        let light: Vec<[f32; 3]> = (0..35_u8).map(|k| [f32::from(k % 11); 3]).collect();
        assert_eq!(defocused(&light, [7, 5], 0.0), light);
    }
}
