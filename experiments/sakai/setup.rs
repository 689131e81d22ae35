//! What the experiments share: the numbers of §6, what is assumed beside them, and a tree in its wind.

use snowglobe::lab::{Error, Lab, Result};
use snowglobe::tree::{
    Bend, Parameters, ReadingSet, Readings, Setting, Skeleton, Sway, Tree, TreeError, papers_tree,
};

/// The numbers of §6 and the assumptions.
#[derive(Clone)]
pub struct Setup {
    pub parameters: Parameters,
    /// Restoring coefficient of the physical set, N/m2.
    pub physical: f64,
    pub height: f64,
    /// Radius of the stem and of the last branches, m.
    pub radii: [f64; 2],
    pub air: Setting,
}

impl Setup {
    /// Tells the lab what is printed and what is assumed.
    pub fn new(lab: &mut Lab) -> Self {
        let height = lab.printed("height", 6.67, "§6");
        let parameters = Parameters {
            density: lab.printed("density", 230.0, "§6"),
            restoring: lab.printed("restoring coefficient", 10_000.0, "§6"),
            wind: lab.printed("wind coefficient", 0.08, "§6"),
            branch_on_wind: lab.printed("branch-on-wind coefficient", 0.1, "§6"),
            damping: lab.printed("damping", 0.83, "§6"),
            reaction: lab.printed("reaction of the restoring force", 0.8, "§6"),
            ..Parameters::PRINTED
        };
        let radii = [lab.printed("greatest radius", 0.05, "§6"), lab.printed("least radius", 0.02, "§6")];
        lab.assume_that(
            "course of the radius",
            "by bracket depth",
            "its ends are given, not how it runs between them",
        );
        lab.assume_that("plane", "branches and wind in one plane", "the grid of Eq. (19) is planar");
        let physical = lab.assume(
            "restoring coefficient of the physical set",
            480_000.0,
            "twice the critical one (sakai/stability), to two digits: the printed one cannot hold the tree up",
        );
        let dt =
            lab.assume("time step", 0.002, "not given; a third of the largest stable one (sakai/stability)");
        let size = lab.assume("size of the air", 10.0, "not given; leaves room above and beside the tree");
        let cells =
            lab.assume("cells of air along each side", 32.0, "not given; 33 nodes (sakai/convergence)");
        let viscosity = lab.assume("viscosity of air", 1.5e-5, "air at 15 degrees, m2/s");
        lab.assume_that(
            "convection",
            "first-order upwind",
            "not given; centred differences need a step of microseconds",
        );
        lab.assume_that("first wind", "the inflow's, everywhere but on the ground", "not given");
        lab.assume_that(
            "top and outlet",
            "as next to them",
            "4.2.1 says so of the outlet; the top is not mentioned",
        );
        let air = Setting { size: [size; 2], cells: [cells as usize; 2], viscosity, wind: 0.0, dt };
        Self { parameters, physical, height, radii, air }
    }

    /// The numbers that a set is run with.
    pub fn given(&self, set: ReadingSet) -> Parameters {
        match set {
            ReadingSet::Physical => Parameters { restoring: self.physical, ..self.parameters },
            ReadingSet::Paper | ReadingSet::Literal => self.parameters,
        }
    }

    pub fn skeleton(&self) -> Result<Skeleton> {
        let structure = papers_tree().map_err(|cause| Error::broken(cause.to_string()))?;
        Skeleton::new(&structure, self.height, self.radii).map_err(broken)
    }

    /// A tree at rest in a wind that blows with `wind` m/s.
    pub fn sway(&self, set: ReadingSet, wind: f64) -> Result<Sway> {
        self.sway_read(set.readings(), self.given(set), wind)
    }

    /// The same under any readings, with any numbers.
    pub fn sway_read(&self, readings: Readings, given: Parameters, wind: f64) -> Result<Sway> {
        let tree = Tree::new(self.skeleton()?, given, readings).map_err(broken)?;
        Sway::new(tree, Setting { wind, ..self.air }).map_err(broken)
    }

    /// Steps in so many seconds.
    pub fn steps(&self, seconds: f64) -> u64 {
        libm::round(seconds / self.air.dt) as u64
    }

    /// How far the tree is from its rest after so many seconds in a wind.
    pub fn bend(&self, set: ReadingSet, wind: f64, seconds: f64) -> Result<Bend> {
        let mut sway = self.sway(set, wind)?;
        blow(&mut sway, self.steps(seconds))?;
        Ok(sway.tree().bend())
    }
}

/// So many steps.
pub fn blow(sway: &mut Sway, steps: u64) -> Result<()> {
    for _ in 0..steps {
        sway.step().map_err(broken)?;
    }
    Ok(())
}

pub fn broken(cause: TreeError) -> Error {
    Error::broken(cause.to_string())
}

/// How much a bend in the wind exceeds that without: tip in m, mean angle in degrees, centre of mass in m.
pub fn beyond(bend: &Bend, still: &Bend) -> [f64; 3] {
    [
        (bend.tip - still.tip).norm(),
        bend.mean_angle - still.mean_angle,
        (bend.centroid - still.centroid).norm(),
    ]
}
