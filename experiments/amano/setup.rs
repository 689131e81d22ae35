//! What the paper's experiments share: its printed numbers, what must be assumed, and one run of the simulation.

use snowglobe::frost::{
    Edge, EndFrame, EndOf, EndRule, Inflow, Parameters, Redraw, RingTouchingIce, end_frame,
};
use snowglobe::hexgrid::{Axial, Region};
use snowglobe::lab::{Error, Lab, Result, Table};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

/// Where growth starts: the centre.
pub const START: [Axial; 1] = [Axial::ORIGIN];

/// Frames after which a run of a table counts as endless: twice the target, far beyond any tolerance.
pub const ENDLESS: u64 = 260;

/// A named set of what the paper does not print but its tables need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reconstruction {
    /// 2083 cells, 12 steps of the solver in a frame, and a larger gamma at r_th 0.8.
    Disc2083,
    /// 5239 cells, one step in a frame, one gamma.
    Disc5239,
}

impl Reading for Reconstruction {
    const QUANTITY: &'static str = "reconstruction";
    const ALL: &'static [Self] = &[Self::Disc2083, Self::Disc5239];

    fn name(self) -> &'static str {
        match self {
            Self::Disc2083 => "disc-2083",
            Self::Disc5239 => "disc-5239",
        }
    }
}

impl Reconstruction {
    /// The reading of Eq. (1) for which this set was found.
    pub fn readings(self) -> Readings {
        let inflow = match self {
            Self::Disc2083 => Inflow::ReiterGated,
            Self::Disc5239 => Inflow::OnlyIceHidden,
        };
        Readings { inflow, ..Readings::DEFAULT }
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
        let (name, gamma, why) = match (reconstruction, threshold > 0.0) {
            (_, false) => ("gamma at r_th 0", 0.005, "not given for the tables; that of the pictures"),
            (Reconstruction::Disc2083, true) => (
                "gamma at r_th 0.8",
                0.023,
                "not given for the tables; chosen beforehand so that Table 2 comes out",
            ),
            (Reconstruction::Disc5239, true) => {
                ("gamma at r_th 0.8", 0.005, "not given for the tables; that of the pictures")
            }
        };
        let gamma = lab.assume(&format!("{name} ({})", reconstruction.name()), gamma, why);
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
        let name = |what: &str| format!("{what} ({})", reconstruction.name());
        let share = lab.printed("share", 0.9, "§3.4");
        let alpha = lab.assume("alpha", 1.0, "not given; 1 is Reiter's value for all his figures");
        lab.assume_that("start", "0,0", "one start is printed, its place is not: the centre");
        let (norm, steps) = match reconstruction {
            Reconstruction::Disc2083 => (576.0, 12.0),
            Reconstruction::Disc5239 => (1444.0, 1.0),
        };
        let norm = lab.assume(
            &name("a^2 + ab + b^2 of the disc"),
            norm,
            "no size or shape is given; chosen beforehand so that the tables come out",
        );
        let steps = lab.assume(
            &name("steps per frame"),
            steps,
            "not given; chosen beforehand so that the tables come out (the frame's time width is said to be set for 24 a second)",
        );
        let region = Region::disc(norm as u32);
        Self {
            cells: format!("disc-{}", region.len()),
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
