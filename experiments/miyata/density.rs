//! Droplets of constant density, "to save computation": what is saved, and what is lost?

use snowglobe::contour_cloud::{Grid, lost};
use snowglobe::image::Picture;
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series,
    Statistic, Table,
};
use snowglobe::rng::{Moment, Seed};

use super::setup::{CORRECTED, PAPER_SIZE, contours, hills, surface};

pub const DENSITY: Experiment = Experiment {
    id: "density",
    title: "Constant or varying density",
    source: "§3.1",
    says: "Were the density of droplets not constant, the light lost would be an integral, costly to compute; so it is taken as \
           constant. Here both are computed.",
    claims: &[&COST, &DIFFERENCE],
    run,
    mutant: Mutant {
        changes: "spread of density",
        to: 3.0,
        why: "droplets that are nearly all in a few places make another picture",
        turns_red: &["miyata/density/difference"],
    },
};

static COST: Claim = Claim {
    id: "miyata/density/cost",
    source: "§3.1",
    says: "a varying density costs far more",
    expect: Expect::AtLeast(10.0),
    statistic: Statistic::Each,
    reason: "evaluations of the density to one of the constant, for a picture right to half a code value (root mean square) by \
             the midpoint rule, in powers of two: an order of magnitude",
    known: &[Known {
        reading: "",
        evidence: "where the density varies by a factor of 1.6 over a seventh of the layer's height, eight evaluations to a column \
                   are enough (samples.csv)",
    }],
};
static DIFFERENCE: Claim = Claim {
    id: "miyata/density/difference",
    source: "§3.1",
    says: "a constant density does for pictures",
    expect: Expect::AtMost(1.0),
    statistic: Statistic::Each,
    reason: "root mean square difference of the pictures with constant and with varying density over that of pictures with two \
             throws of Gauss: less than what is chance anyway",
    known: &[],
};

const SIZE: [usize; 2] = [240, 160];
const DIVISIONS: u32 = 5;
/// Samples of the integral that the others are compared with.
const FINEST: u32 = 128;

/// A density that varies: the logarithm is normal at the points of a lattice, and linear between them; its mean is 1.
struct Droplets {
    noise: Moment,
    spread: f64,
    cell: f64,
}

impl Droplets {
    fn at(&self, place: [f64; 3]) -> f64 {
        let scaled = place.map(|x| x / self.cell);
        let (low, share) = (scaled.map(libm::floor), scaled.map(|x| x - libm::floor(x)));
        let mut sum = 0.0;
        for corner in 0..8_u8 {
            let high = [0, 1, 2].map(|axis| f64::from(corner >> axis & 1));
            let weight: f64 = (0..3).map(|k| if high[k] > 0.0 { share[k] } else { 1.0 - share[k] }).product();
            let [x, y, z] = [0, 1, 2].map(|k| low[k] + high[k]);
            // A point of the lattice as one of the plane: levels lie beside each other.
            sum += weight * self.noise.normal([x + 4096.0 * z, y]);
        }
        libm::exp(self.spread * sum - 0.5 * self.spread * self.spread)
    }

    /// The mean density of a column from the ground up, by the midpoint rule.
    fn mean(&self, [x, y]: [f64; 2], height: f64, samples: u32) -> f64 {
        let at = |k: u32| self.at([x, y, height * (f64::from(k) + 0.5) / f64::from(samples)]);
        (0..samples).map(at).sum::<f64>() / f64::from(samples)
    }
}

fn run(lab: &mut Lab) -> Result<()> {
    let gamma = lab.assume("gamma", 0.02, "as in Fig. 12");
    let spread = lab.assume("spread of density", 0.5, "of its logarithm: a factor of 1.6 either way");
    let cell = lab.assume("cell of density", 20.0, "a seventh of the layer's height");
    let seed = lab.seed();
    let drawn = hills(lab, 800);
    let size = lab.pick(SIZE, [36, 24]);
    let [width, height] = PAPER_SIZE;
    let grid = Grid { low: [0.0; 2], high: [width, height], counts: size };
    let columns = |seed: Seed| -> Result<Vec<f64>> {
        let surface = surface(&contours(&drawn, 8.0, 2.3), CORRECTED, 0.3, seed)?;
        let heights = grid.heights(&surface, DIVISIONS).map_err(|cause| Error::broken(cause.to_string()))?;
        Ok(heights.into_iter().map(|z| z.max(0.0)).collect())
    };
    let lengths = columns(seed)?;
    let droplets = Droplets { noise: seed.stream("miyata: density").at(0), spread, cell };
    let rows: Vec<usize> = (0..size[1]).collect();
    let integrated = |samples: u32| -> Vec<f64> {
        let of_row = |row: &usize| -> Vec<f64> {
            let one = |column: usize| {
                let length = lengths[row * size[0] + column];
                let density =
                    if length > 0.0 { droplets.mean(grid.place(column, *row), length, samples) } else { 1.0 };
                255.0 * lost(gamma, length * density)
            };
            (0..size[0]).map(one).collect()
        };
        lab.each(&rows, of_row).concat()
    };
    let code = |lengths: &[f64]| lengths.iter().map(|length| 255.0 * lost(gamma, *length)).collect();
    let constant: Vec<f64> = code(&lengths);
    let another: Vec<f64> = code(&columns(Seed(seed.0.wrapping_add(1)))?);
    let finest = integrated(FINEST);
    let mut table = Table::new(["samples", "rms_error_code_values"]);
    let (mut needed, mut errors) = (None, Vec::new());
    let mut samples = 1;
    while samples < FINEST {
        let error = rms(&integrated(samples), &finest);
        table.row([samples.into(), error.into()]);
        errors.push((f64::from(samples), error));
        if error <= 0.5 && needed.is_none() {
            needed = Some(samples);
        }
        samples *= 2;
    }
    let (varied, thrown) = (rms(&constant, &finest), rms(&constant, &another));
    lab.found(&COST, f64::from(needed.unwrap_or(FINEST)));
    lab.found(&DIFFERENCE, varied / thrown);
    lab.keep("samples", "How exact the integral is by the number of samples in a column", table)?;
    let mut table = Table::new(["pictures", "rms_difference_code_values"]);
    table.row(["constant and varying density".into(), varied.into()]);
    table.row(["two throws of Gauss".into(), thrown.into()]);
    lab.keep("differences", "How much two pictures differ", table)?;
    lab.keep(
        "error",
        "What an integral costs: below the line its error is not seen",
        Plot {
            title: "Integrating a varying density".to_owned(),
            x: Axis::log("evaluations of the density in a column", 1.0, 64.0),
            y: Axis::log("error (code values, rms)", 0.001, 100.0),
            series: vec![
                Series::new("midpoint rule", Draw::Joined, errors),
                Series::new("half a code value", Draw::Line, vec![(1.0, 0.5), (64.0, 0.5)]),
            ],
            bands: Vec::new(),
        },
    )?;
    if lab.keeps() {
        for (name, caption, codes) in
            [("constant", "Constant density", &constant), ("varying", "Varying density", &finest)]
        {
            let grey = codes.iter().flat_map(|code| [libm::round(*code) as u8; 3]).collect();
            let picture = Picture::from_rgb(size[0] as u32, size[1] as u32, grey)
                .map_err(|cause| Error::broken(cause.to_string()))?;
            lab.keep(name, caption, Artifact::Drawing(picture))?;
        }
    }
    Ok(())
}

fn rms(a: &[f64], b: &[f64]) -> f64 {
    libm::sqrt(a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / a.len() as f64)
}
