//! The tree near its rest, linearised: whether it can stand, how long a step may be, how fast it falls.

use nalgebra::{DMatrix, Schur};

use super::readings::Position;
use super::{Parameters, Readings, Skeleton, Tree, TreeError, Vector};
use crate::navier_stokes::larger_root;

/// Angle by which a link is turned to see what follows, rad.
const TURN: f64 = 1e-5;
/// Parts of its neighbours below which an entry is nothing, for one try after the other: coincident branches give equal
/// eigenvalues, on which an iteration to the last bit may turn in circles.
const PRECISIONS: [f64; 4] = [1e-14, 1e-12, 1e-10, 1e-8];
/// Sweeps of a try.
const SWEEPS: usize = 3000;
/// Links up to which the eigenvalues themselves are computed; beyond, a bound takes their place.
const MOST_LINKS: usize = 400;

/// An eigenvalue of the linearised force, 1/s2: of an angular acceleration in proportion to an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Below 0 where the tree is pulled back.
    pub real: f64,
    /// Other than 0 where two modes mix: the reaction of Eq. (6) is not that of a potential.
    pub imaginary: f64,
}

/// The angular accelerations of the links, linear in their angles about the pose at rest.
///
/// The state is the angle of each link. A node's acceleration (Eq. 4 to 8) is taken to that of its link as Eq. (11)
/// does it, from the root outwards: the part along the normal of the link, less what the parent does.
#[derive(Clone, Debug)]
pub struct Linearised {
    modes: Vec<Mode>,
    tree: Tree,
}

impl Linearised {
    /// Linearises; no wind blows.
    ///
    /// # Errors
    ///
    /// What [`Parameters::check`] refuses.
    pub fn new(skeleton: &Skeleton, given: Parameters, readings: Readings) -> Result<Self, TreeError> {
        let tree = Tree::new(skeleton.clone(), given, readings)?;
        let modes = eigenvalues(&jacobian(&tree));
        Ok(Self { modes, tree })
    }

    /// The eigenvalues, the most unstable first.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// Whether every mode is pulled back.
    pub fn stands(&self) -> bool {
        self.modes.iter().all(|mode| mode.real < 0.0)
    }

    /// The largest step in s at which no mode grows that is pulled back; infinite where nothing limits it.
    pub fn largest_step(&self) -> f64 {
        let sound: Vec<Mode> = self.modes.iter().copied().filter(|mode| mode.real < 0.0).collect();
        let stable = |dt: f64| sound.iter().all(|mode| self.growth(*mode, dt) <= 1.0 + 1e-9);
        if sound.is_empty() || stable(1e3) {
            return f64::INFINITY;
        }
        let (mut least, mut most) = (0.0, 1e3);
        for _ in 0..80 {
            let dt = 0.5 * (least + most);
            if stable(dt) { least = dt } else { most = dt }
        }
        least
    }

    /// Time in s in which the fastest falling mode grows by e, in steps of `dt`; none where none falls.
    pub fn e_folding(&self, dt: f64) -> Option<f64> {
        let growth = self.modes.iter().filter(|mode| mode.real >= 0.0).map(|mode| self.growth(*mode, dt));
        let fastest = growth.fold(1.0, f64::max);
        (fastest > 1.0).then(|| dt / libm::log(fastest))
    }

    /// By what a mode grows in a step: the larger root of `z^2 - (1 + k + s mu) z + k = 0`, k being what is left of a
    /// velocity and s what a step makes of an acceleration.
    fn growth(&self, mode: Mode, dt: f64) -> f64 {
        let kept = self.tree.kept(dt);
        let s = match self.tree.readings().position {
            Position::AsPrinted => dt,
            Position::TimesDt => dt * dt,
        };
        larger_root((1.0 + kept + s * mode.real, s * mode.imaginary), (-kept, 0.0))
    }

    /// The restoring coefficient above which the tree stands, in N/m2; 0 if it always does, none if it never does.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn critical_restoring(
        skeleton: &Skeleton,
        given: Parameters,
        readings: Readings,
    ) -> Result<Option<f64>, TreeError> {
        let of = |restoring: f64| Tree::new(skeleton.clone(), Parameters { restoring, ..given }, readings);
        // The force is linear in it.
        let without = jacobian(&of(0.0)?);
        let with = jacobian(&of(1.0)?) - &without;
        let stands =
            |restoring: f64| eigenvalues(&(&without + &with * restoring)).iter().all(|mode| mode.real < 1e-9);
        if stands(0.0) {
            return Ok(Some(0.0));
        }
        let (mut least, mut most) = (0.0, 1e9);
        if !stands(most) {
            return Ok(None);
        }
        while most - least > 1e-9 * most {
            let middle = 0.5 * (least + most);
            if stands(middle) { most = middle } else { least = middle }
        }
        Ok(Some(most))
    }
}

/// Angular acceleration of each link, rad/s2, in the tree's present pose.
fn angular(tree: &Tree) -> Vec<f64> {
    let skeleton = tree.skeleton();
    let place: Vec<Vector> = (0..skeleton.nodes()).map(|node| tree.place(node)).collect();
    let free = tree.acceleration(&place);
    let mut bound = vec![Vector::zeros(); place.len()];
    let mut angular = Vec::with_capacity(place.len());
    for node in 0..place.len() {
        let Some(parent) = skeleton.parent(node) else { continue };
        let link = (place[node] - place[parent]) / skeleton.length(node);
        let normal = Vector::new(-link.y, link.x);
        let relative = free[node] - bound[parent];
        let across = relative.x * normal.x + relative.y * normal.y;
        bound[node] = bound[parent] + across * normal;
        angular.push(across / skeleton.length(node));
    }
    angular
}

/// Its derivative by the angle of each link, by central differences.
fn jacobian(tree: &Tree) -> DMatrix<f64> {
    let skeleton = tree.skeleton();
    let links: Vec<usize> = (0..skeleton.nodes()).filter(|node| skeleton.parent(*node).is_some()).collect();
    let mut matrix = DMatrix::zeros(links.len(), links.len());
    for (column, node) in links.iter().enumerate() {
        let turned = |angle: f64| {
            let mut turned = tree.clone();
            // The link alone: what grows from it keeps its own direction.
            turned.turn_link(*node, angle);
            for child in skeleton.children[*node].clone() {
                turned.turn_link(child, -angle);
            }
            angular(&turned)
        };
        let (forth, back) = (turned(TURN), turned(-TURN));
        for row in 0..links.len() {
            matrix[(row, column)] = (forth[row] - back[row]) / (2.0 * TURN);
        }
    }
    matrix
}

fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Mode> {
    // No eigenvalue is larger than the largest sum of a row.
    let bound = || {
        let sum = |row: usize| matrix.row(row).iter().map(|x| x.abs()).sum::<f64>();
        let largest = (0..matrix.nrows()).map(sum).fold(0.0, f64::max);
        vec![Mode { real: -largest, imaginary: 0.0 }]
    };
    if matrix.nrows() > MOST_LINKS {
        return bound();
    }
    let attempt = |precision: &f64| Schur::try_new(matrix.clone(), *precision, SWEEPS);
    let Some(schur) = PRECISIONS.iter().find_map(attempt) else { return bound() };
    let mode = |z: &nalgebra::Complex<f64>| Mode { real: z.re, imaginary: z.im };
    let mut modes: Vec<Mode> = schur.complex_eigenvalues().iter().map(mode).collect();
    modes.sort_by(|a, b| b.real.total_cmp(&a.real).then(b.imaginary.total_cmp(&a.imaginary)));
    modes
}
