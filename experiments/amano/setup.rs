//! What the paper's experiments share: its printed numbers, what must be assumed, and one run of the simulation.

use snowglobe::frost::{
    Edge, EndFrame, EndOf, EndRule, Inflow, Parameters, Redraw, RingTouchingIce, end_frame,
};
use snowglobe::hexgrid::{Axial, Region};
use snowglobe::lab::{Error, Lab, Result, Table};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

use super::shape::Shape;

/// Where growth starts: the centre.
pub const START: [Axial; 1] = [Axial::ORIGIN];

/// Frames after which a run of a table counts as endless: twice the target, far beyond any tolerance.
pub const ENDLESS: u64 = 260;

/// A named set of what the paper does not print but its tables need. The experiment `reconstruction` finds them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reconstruction {
    /// A hexagon, 9 steps of the solver in a frame, and a gamma that keeps its mean when the threshold rises.
    Hexagon1387,
    /// A disc, one step in a frame, one gamma.
    Disc5239,
}

impl Reading for Reconstruction {
    const QUANTITY: &'static str = "reconstruction";
    const ALL: &'static [Self] = &[Self::Hexagon1387, Self::Disc5239];

    fn name(self) -> &'static str {
        match self {
            Self::Hexagon1387 => "hexagon-1387",
            Self::Disc5239 => "disc-5239",
        }
    }
}

impl Reconstruction {
    /// The one that assumes least and yet gives all eight rows.
    pub const DEFAULT: Self = Self::Hexagon1387;

    /// The reading of Eq. (1) for which this set was found.
    pub fn readings(self) -> Readings {
        let inflow = match self {
            Self::Hexagon1387 => Inflow::ReiterGated,
            Self::Disc5239 => Inflow::OnlyIceHidden,
        };
        Readings { inflow, ..Readings::DEFAULT }
    }

    /// What it assumes.
    pub fn assumed(self) -> Assumed {
        match self {
            Self::Hexagon1387 => Assumed {
                shape: Shape::Hexagon,
                size: 21.0,
                steps_per_frame: 9,
                gamma: 0.005,
                gamma_rule: GammaRule::MeanKept,
            },
            Self::Disc5239 => Assumed {
                shape: Shape::Disc,
                size: 38.0,
                steps_per_frame: 1,
                gamma: 0.005,
                gamma_rule: GammaRule::Same,
            },
        }
    }
}

/// What a reconstruction assumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumed {
    /// Shape of the sketch.
    pub shape: Shape,
    /// Half its width, in spacings of the lattice.
    pub size: f64,
    /// Steps of the solver in a frame.
    pub steps_per_frame: u32,
    /// gamma at threshold 0.
    pub gamma: f64,
    /// gamma at another threshold.
    pub gamma_rule: GammaRule,
}

/// What becomes of gamma where a threshold withholds it from some of the cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GammaRule {
    /// Nothing: the cells gain less in the mean.
    Same,
    /// It is divided by 1 - r_th, the share of the cells that gain it: they gain as much in the mean.
    MeanKept,
    /// It is a number of its own, to be fitted.
    Free,
}

impl GammaRule {
    /// `same`, `mean-kept`, `free`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::MeanKept => "mean-kept",
            Self::Free => "free",
        }
    }

    /// gamma at a threshold; a free one starts from what it is at 0.
    pub fn gamma(self, gamma: f64, threshold: f64) -> f64 {
        match self {
            // In tenths, since 1 - 0.8 is not 0.2 to the last bit.
            Self::MeanKept => gamma * (10.0 / (10.0 - 10.0 * threshold)),
            Self::Same | Self::Free => gamma,
        }
    }
}

/// One way to run the model: a sketch and its parameters, beta and threshold still open.
#[derive(Clone)]
pub struct Setup {
    /// The sketch.
    pub region: Region,
    /// File with its cells, for commands.
    pub cells: String,
    /// Parameters; beta and threshold are set by [`Setup::with`].
    pub parameters: Parameters,
    /// When the film ends.
    pub rule: EndRule,
}

impl Setup {
    /// The setup of a reconstruction for the tables, under the readings at hand.
    pub fn of_tables(
        lab: &mut Lab,
        reconstruction: Reconstruction,
        threshold: f64,
        readings: Readings,
    ) -> Self {
        let Assumed { gamma, gamma_rule, .. } = reconstruction.assumed();
        let name = |what: &str| format!("{what} ({})", reconstruction.name());
        let gamma = lab.assume(&name("gamma"), gamma, "not given for the tables; that of the pictures (§4)");
        if gamma_rule == GammaRule::MeanKept {
            lab.assume_that(
                &name("gamma at a threshold"),
                "gamma / (1 - r_th)",
                "not given for the tables; with this rule the cells that touch ice gain as much in the mean as at r_th 0",
            );
        }
        let gamma = gamma_rule.gamma(gamma, threshold);
        Self::new(lab, reconstruction, gamma, threshold, readings)
    }

    /// The setup of a reconstruction with a gamma that is known.
    pub fn new(
        lab: &mut Lab,
        reconstruction: Reconstruction,
        gamma: f64,
        threshold: f64,
        readings: Readings,
    ) -> Self {
        let Assumed { shape, size, steps_per_frame, .. } = reconstruction.assumed();
        let name = |what: &str| format!("{what} ({})", reconstruction.name());
        let share = lab.printed("share", 0.9, "§3.4");
        let alpha = lab.assume("alpha", 1.0, "not given; 1 is Reiter's value for all his figures");
        lab.assume_that("start", "0,0", "one start is printed, its place is not: the centre");
        lab.assume_that(&name("shape of the sketch"), &shape.name(), "not given (see amano/reconstruction)");
        let size = lab.assume(
            &name("half the sketch's width, in cells"),
            size,
            "not given; fitted to the tables (see amano/reconstruction)",
        );
        let steps = lab.assume(
            &name("steps per frame"),
            f64::from(steps_per_frame),
            match steps_per_frame {
                1 => "not given; t is called the frame's number, and a step is the least that a frame can be",
                _ => {
                    "not given, but for the frame's time width, said to be set for 24 a second; fitted to the tables \
                     (see amano/reconstruction)"
                }
            },
        );
        let region = shape.region(size);
        Self {
            cells: format!("{}-{}", shape.name(), region.len()),
            region,
            parameters: Parameters {
                alpha,
                beta: 0.25,
                gamma,
                threshold,
                steps_per_frame: steps as u32,
                inflow: readings.inflow,
                redraw: readings.redraw,
                edge: Edge::Reflecting,
                ring_touching_ice: readings.ring,
            },
            rule: EndRule { share, of: EndOf::AllCells },
        }
    }

    /// The parameters with an initial value.
    pub fn at(&self, beta: f64) -> Parameters {
        Parameters { beta, ..self.parameters }
    }

    /// The end frame with an initial value; none if ice does not reach the share.
    pub fn end_frame(&self, beta: f64, seed: u64) -> Result<Option<EndFrame>> {
        end_frame(&self.region, &START, self.at(beta), Seed(seed), self.rule, ENDLESS)
            .map_err(|cause| Error::broken("cannot grow frost").because(cause))
    }

    /// The command that grows the same frost.
    pub fn command(&self, experiment: &str, beta: f64, seed: u64) -> String {
        let p = self.parameters;
        let mut command = format!(
            "snowglobe frost --cells results/amano/{experiment}/{}.csv --start 0,0 --beta {beta} --gamma {} --threshold {}",
            self.cells, p.gamma, p.threshold
        );
        // What the command does anyway is left out: alpha 1, share 0.9, the reflecting edge.
        for (flag, value, default) in [
            ("--steps-per-frame", p.steps_per_frame.to_string(), "12"),
            ("--reading", p.inflow.name().to_owned(), "reiter-gated"),
            ("--redraw", p.redraw.name().to_owned(), "frame"),
            ("--ring-touching-ice", p.ring_touching_ice.name().to_owned(), "zero"),
            ("--seed", seed.to_string(), "1"),
        ] {
            if value != default {
                command += &format!(" {flag} {value}");
            }
        }
        command
    }
}

/// The readings of one run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Readings {
    /// Of Eq. (1).
    pub inflow: Inflow,
    /// Of r.
    pub redraw: Redraw,
    /// Of the points outside that touch ice.
    pub ring: RingTouchingIce,
}

impl Readings {
    /// What the evidence supports.
    pub const DEFAULT: Self =
        Self { inflow: Inflow::ReiterGated, redraw: Redraw::Frame, ring: RingTouchingIce::Zero };

    /// From here on, the lab's findings are made under these readings and this reconstruction.
    pub fn tell(self, lab: &mut Lab, reconstruction: Reconstruction) {
        lab.reading(self.inflow);
        lab.reading(self.redraw);
        lab.reading(self.ring);
        lab.reading(reconstruction);
    }
}

/// Whether a table's row, which begins with reconstruction and reading of Eq. (1), is of the reading for which that
/// reconstruction was found, with the ring at 0.
pub fn is_own_reading(row: &[String]) -> bool {
    let own = Reconstruction::named(&row[0]).map(|reconstruction| reconstruction.readings().inflow.name());
    own == Some(row[1].as_str()) && row.iter().any(|cell| cell == RingTouchingIce::Zero.name())
}

/// The cells of a region, as `snowglobe frost --cells` reads them.
pub fn cells_table(region: &Region) -> Table {
    let mut table = Table::new(["q", "r"]);
    for cell in region.cells() {
        table.row([cell.q.into(), cell.r.into()]);
    }
    table
}

/// Keeps the cells of both reconstructions, so that the commands of the findings work.
pub fn keep_cells<'s>(lab: &mut Lab, setups: impl IntoIterator<Item = &'s Setup>) -> Result<()> {
    let mut kept: Vec<&str> = Vec::new();
    for setup in setups {
        if !kept.contains(&setup.cells.as_str()) {
            kept.push(&setup.cells);
            lab.keep(
                &setup.cells,
                "The cells of the region, in axial coordinates",
                cells_table(&setup.region),
            )?;
        }
    }
    Ok(())
}
