//! What coarser voxels do to the opacity of a flake.

use snowglobe::lab::{Axis, Draw, Lab, Plot, Result, Series, Table, average};
use snowglobe::snow::Cubes;
use snowglobe::snow::flake::Flake;
use snowglobe::snow::still::Body;

use super::super::setup::broken;
use super::{DIRECTIONS, MEAN, OPACITY};

/// Directions by chance.
fn directions(lab: &Lab) -> Vec<[f64; 3]> {
    let stream = lab.stream("directions");
    (0..lab.pick(DIRECTIONS, 3))
        .map(|k| {
            let mut chance = stream.at(k).place(0, 0, 0);
            let z = 2.0 * chance.uniform() - 1.0;
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * chance.uniform());
            let r = (1.0 - z * z).sqrt();
            [r * cosine, r * sine, z]
        })
        .collect()
}

/// By how much opacity differs from that of the finest level, mean over directions.
pub fn compare(lab: &mut Lab, flakes: &[Flake], cubes: &[Cubes], bodies: &[Body], tau: f64) -> Result<()> {
    let directions = directions(lab);
    let rays = lab.pick(3000, 200);
    let mut table = Table::new(["crystals", "voxels", "side_um", "mean_bias", "largest_bias"]);
    let mut worst = 0.0_f64;
    let mut means = [0.0_f64; 2];
    let mut series = Vec::new();
    for (flake, body) in flakes.iter().zip(bodies) {
        let fine: Vec<f64> = lab.each(&directions, |direction| body.opacity(0, *direction, rays));
        let mut bias = |name: &str, side: f64, of: &(dyn Fn(&[f64; 3]) -> f64 + Sync)| -> f64 {
            let found = lab.each(&directions, |direction| of(direction));
            let off: Vec<f64> = found.iter().zip(&fine).map(|(a, b)| a / b - 1.0).collect();
            let size: Vec<f64> = off.iter().map(|off| off.abs()).collect();
            let largest = off.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0);
            table.row([
                flake.members.len().into(),
                name.into(),
                (1e6 * side).into(),
                average(&off).into(),
                largest.into(),
            ]);
            average(&size)
        };
        let mut points = [Vec::new(), Vec::new()];
        for level in 1..body.levels() {
            let of = |direction: &[f64; 3]| body.opacity(level, *direction, rays);
            let off = bias("levels that keep opacity", body.side(level), &of);
            worst = worst.max(off);
            points[0].push((1e6 * body.side(level), 100.0 * off));
        }
        for per_side in [2, 4, 8] {
            let mean = Body::new(flake, cubes, per_side, tau).map_err(broken)?;
            let of = |direction: &[f64; 3]| mean.opacity(0, *direction, rays);
            let off = bias("means of density", mean.side(0), &of);
            if per_side == 8 {
                means = [means[0] + off, means[1] + 1.0];
            }
            points[1].push((1e6 * mean.side(0), 100.0 * off));
        }
        let [keeps, printed] = points;
        let name = |what: &str| format!("{what}, {} crystals", flake.members.len());
        series.push(Series::new(name("keeping opacity"), Draw::Joined, keeps));
        series.push(Series::new(name("means of density"), Draw::Printed, printed));
    }
    lab.found(&OPACITY, worst);
    lab.found(&MEAN, means[0] / means[1]);
    lab.count("rays", (rays * directions.len() * 9) as u64);
    lab.keep("opacity", "Opacity of flakes in coarser voxels against the finest", table)?;
    lab.keep(
        "bias",
        "How far the opacity of a flake is from that in voxels of 20 µm, mean size over directions",
        Plot {
            title: "What coarser voxels do to opacity".to_owned(),
            x: Axis::log("side of a voxel (µm)", 30.0, 1500.0),
            y: Axis::of("bias of opacity (%)"),
            series,
            bands: vec![("allowed".to_owned(), 0.0, 2.0)],
        },
    )
}
