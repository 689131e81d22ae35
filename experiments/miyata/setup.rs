//! What the experiments share: contours of our own (the paper's are lost), and surfaces of them.

use snowglobe::contour_cloud::{
    Amplitude, Contour, ContourError, Displacement, EdgeLength, Patches, Plateau, Relief, Surface,
    feature_points,
};
use snowglobe::lab::{Error, Lab, Result};
use snowglobe::rng::Seed;

/// A line of equal density as it was drawn.
#[derive(Clone, Debug)]
pub struct Drawn {
    pub level: f64,
    pub points: Vec<[f64; 2]>,
}

/// Width and height of the drawing, in its own unit, in which levels are too.
pub const PAPER_SIZE: [f64; 2] = [960.0, 640.0];

/// Points along each side of the frame.
const FRAME_POINTS: usize = 10;

/// Contours of two hills joined by a saddle, each line of `count` points, waves of several lengths along it; the frame
/// is the lowest.
pub fn hills(lab: &mut Lab, count: usize) -> Vec<Drawn> {
    lab.assume_that("contours", "two hills joined by a saddle, drawn by us", "the paper's drawings are lost");
    let [width, height] = PAPER_SIZE;
    // Points along the frame, so that patches at it are no longer than those between contours.
    let along = |from: [f64; 2], to: [f64; 2]| {
        (0..FRAME_POINTS).map(move |k| {
            let share = k as f64 / FRAME_POINTS as f64;
            [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))
        })
    };
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    let frame = (0..4).flat_map(|k| along(corners[k], corners[(k + 1) % 4])).collect();
    let mut all = vec![Drawn { level: -60.0, points: frame }];
    for level in [0.0, 40.0] {
        // Cassini's ovals hold both hills.
        let radius = 1.0 - 0.2 * level / 40.0;
        all.push(Drawn { level, points: ring([480.0, 320.0], [390.0 * radius, 240.0 * radius], count, 1.0) });
    }
    for (k, level) in [80.0, 120.0].into_iter().enumerate() {
        let radius = 1.0 - 0.45 * k as f64;
        all.push(Drawn { level, points: ring([350.0, 310.0], [112.0 * radius, 98.0 * radius], count, 2.0) });
        all.push(Drawn { level, points: ring([630.0, 340.0], [104.0 * radius, 92.0 * radius], count, 3.0) });
    }
    all
}

/// A closed line around a centre, with waves.
pub fn ring(centre: [f64; 2], radii: [f64; 2], count: usize, phase: f64) -> Vec<[f64; 2]> {
    let point = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / count as f64;
        let wave = |n: f64, size: f64| size * libm::sin(n * angle + phase * n);
        let radius =
            1.0 + wave(2.0, 0.06) + wave(3.0, 0.05) + wave(5.0, 0.035) + wave(9.0, 0.015) + wave(17.0, 0.008);
        let (sine, cosine) = libm::sincos(angle);
        [centre[0] + radii[0] * radius * cosine, centre[1] + radii[1] * radius * sine]
    };
    (0..count).map(point).collect()
}

/// The contours through their feature points; the first is the frame.
pub fn contours(drawn: &[Drawn], distance: f64, dimension: f64) -> Vec<Contour> {
    let contour = |(number, line): (usize, &Drawn)| {
        // The frame's points are ours already.
        let kept = if number == 0 {
            (0..line.points.len()).collect()
        } else {
            feature_points(&line.points, true, distance)
        };
        let points = kept.iter().map(|k| line.points[*k]).collect();
        Contour { name: format!("{}", number + 1), level: line.level, dimension, points, closed: true }
    };
    drawn.iter().enumerate().map(contour).collect()
}

/// The surface as the paper makes it.
pub fn surface(
    contours: &[Contour],
    (amplitude, edge_length): (Amplitude, EdgeLength),
    gain: f64,
    seed: Seed,
) -> Result<Surface> {
    Ok(Surface {
        patches: Patches::new(contours, Plateau::AsPrinted).map_err(broken)?,
        relief: Relief::Patches,
        displacement: displacement((amplitude, edge_length), gain, seed),
    })
}

/// Eq. (1) under these readings.
pub fn displacement(
    (amplitude, edge_length): (Amplitude, EdgeLength),
    gain: f64,
    seed: Seed,
) -> Displacement {
    Displacement { amplitude, edge_length, gain, moment: seed.stream("miyata: Gauss").at(0) }
}

/// The default readings of Eq. (1).
pub const CORRECTED: (Amplitude, EdgeLength) = (Amplitude::ThreeMinusD, EdgeLength::Original);

pub fn broken(cause: ContourError) -> Error {
    Error::broken(cause.to_string())
}
