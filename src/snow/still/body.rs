//! What a flake looks like: its voxels, and coarser cells for those that are far.

use nalgebra::{Isometry3, Point3, Translation3, Vector3};

use crate::volume::exp;

use super::super::flake::{Flake, Template};
use super::super::{Cubes, SnowError, Voxels, within};
use super::fit::{self, Fit, Logarithms, NORMALS, Plane, spread};
use super::grid::Grid;
use super::levels::{self, Voxel};
use super::prisms;

/// Levels end where a body has at most so many cells along its longest axis.
const FEWEST: usize = 8;
/// Along these a density may be seen edge on.
const AXES: [[f64; 3]; NORMALS] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// The most voxels along an axis.
const MOST_ALONG: usize = 1 << 13;

/// One look of a flake, shared by all flakes that look so: voxels and coarser levels of cells, around its centre of mass.
///
/// Level 0 has the voxels, each next one cells of twice the side, to 5 to 8 along the longest axis. All have the opacity of
/// the voxels, seen as a whole: within 2 % on average over directions, within 5 % in nearly all; where a crystal is seen edge on
/// or crystals hide in a row, levels of few cells may be a tenth off.
#[derive(Clone, Debug)]
pub struct Body {
    pub(super) levels: Vec<(Grid, Fit)>,
    /// The lowest corner of the grids, from the centre of mass, m.
    pub(super) corner: [f64; 3],
    pub(super) radius: f64,
    pub(super) extinction: f64,
}

impl Body {
    /// The body of a flake: Eq. (7) and (12) to (15).
    ///
    /// `cubes` are the elements of the crystals that the flake's members name, `per_side` of them along a voxel. Coarser
    /// levels keep the opacity that `extinction`, tau in 1/m, gives; others from a fourth to four times that are allowed for.
    ///
    /// Elements of crystals that are turned lie on no grid and leave pinholes in plates one element thick; elements three
    /// times as fine with 3 to a voxel leave none.
    ///
    /// # Errors
    ///
    /// A member that names no crystal; what [`Voxels::new`] refuses; tau not 1e-6 to 1e12; more than 8192 voxels along an
    /// axis.
    pub fn new(flake: &Flake, cubes: &[Cubes], per_side: u32, extinction: f64) -> Result<Self, SnowError> {
        Self::of_flake(flake, None, cubes, per_side, extinction)
    }

    /// The same, but as opaque as the prisms of its crystals are in the mean over directions: voxels as large as an element
    /// blur what lies askew, and alone would hide a tenth and more too much. `crystals` and `cubes` are named by the same
    /// numbers.
    ///
    /// # Errors
    ///
    /// As [`Body::new`].
    pub fn true_to(
        flake: &Flake,
        crystals: &[Template],
        cubes: &[Cubes],
        per_side: u32,
        extinction: f64,
    ) -> Result<Self, SnowError> {
        within("the number of crystals", crystals.len() as f64, cubes.len() as f64, cubes.len() as f64)?;
        Self::of_flake(flake, Some(crystals), cubes, per_side, extinction)
    }

    fn of_flake(
        flake: &Flake,
        crystals: Option<&[Template]>,
        cubes: &[Cubes],
        per_side: u32,
        extinction: f64,
    ) -> Result<Self, SnowError> {
        let (mut sum, mut count) = (Vector3::zeros(), 0.0);
        for member in &flake.members {
            within("the number of a crystal", member.template as f64, 0.0, cubes.len() as f64 - 1.0)?;
            // Crystals are symmetric: their middle is their centre.
            let elements = cubes[member.template].count() as f64;
            sum += member.pose.translation.vector * elements;
            count += elements;
        }
        if count == 0.0 {
            return Err(SnowError::NoElements);
        }
        let centre = sum / count;
        let posed: Vec<(&Cubes, Isometry3<f64>)> =
            flake.members.iter().map(|member| (&cubes[member.template], member.pose)).collect();
        let voxels = Voxels::new(&posed, per_side)?;
        let full = voxels.capacity();
        let filled = voxels.elements().iter().enumerate().filter(|(_, count)| **count > 0);
        let filled = filled.map(|(at, count)| (at, (*count).min(full) as f32 / full as f32));
        let corner = Vector3::from(voxels.origin()) - centre;
        // Of many crystals none stands out.
        let mut normals = [[0.0; 3]; NORMALS];
        if flake.members.len() <= 2 * NORMALS {
            let mut largest: Vec<_> = flake.members.iter().collect();
            largest.sort_by_key(|member| std::cmp::Reverse(cubes[member.template].count()));
            for (normal, member) in normals.iter_mut().zip(largest) {
                *normal = (member.pose.rotation * Vector3::z()).into();
            }
        }
        let thinner = |grid: &Grid, corner: [f64; 3]| {
            crystals.map_or([0.0; 3], |crystals| {
                prisms::thinner(grid, Vector3::from(corner) + centre, flake, crystals, extinction)
            })
        };
        Self::made(voxels.counts(), voxels.side(), filled, corner, extinction, normals, thinner)
    }

    /// The body of any density: `counts` voxels of side `side`, m, along x, y and z, x fastest, each of a density from 0 to 1.
    /// Its centre is that of mass; tau in 1/m.
    ///
    /// # Errors
    ///
    /// Not one value for each voxel, one not 0 to 1, or none above 0; a side not 1e-9 to 1 m; tau not 1e-6 to 1e12; more than
    /// 8192 voxels along an axis.
    pub fn of_density(
        counts: [usize; 3],
        side: f64,
        values: &[f32],
        extinction: f64,
    ) -> Result<Self, SnowError> {
        within("the side of a voxel, m,", side, 1e-9, 1.0)?;
        let number = counts.iter().fold(1_usize, |product, count| product.saturating_mul(*count)) as f64;
        within("the number of densities", values.len() as f64, number, number)?;
        let (mut sum, mut mass) = (Vector3::zeros(), 0.0);
        for (at, value) in values.iter().enumerate() {
            within("a density", f64::from(*value), 0.0, 1.0)?;
            let place = [at % counts[0], at / counts[0] % counts[1], at / (counts[0] * counts[1])];
            sum += Vector3::from(place.map(|x| x as f64 + 0.5)) * f64::from(*value);
            mass += f64::from(*value);
        }
        if mass == 0.0 {
            return Err(SnowError::NoElements);
        }
        let filled = values.iter().copied().enumerate().filter(|(_, rho)| *rho > 0.0);
        Self::made(counts, side, filled, -(sum / mass) * side, extinction, AXES, |_, _| [0.0; 3])
    }

    fn made(
        counts: [usize; 3],
        side: f64,
        filled: impl Iterator<Item = (usize, f32)>,
        corner: Vector3<f64>,
        extinction: f64,
        normals: [[f64; 3]; NORMALS],
        thinner: impl FnOnce(&Grid, [f64; 3]) -> Logarithms,
    ) -> Result<Self, SnowError> {
        use rayon::prelude::*;
        within("the extinction, 1/m,", extinction, 1e-6, 1e12)?;
        for count in counts {
            within("the number of voxels along an axis", count as f64, 1.0, MOST_ALONG as f64)?;
        }
        let [across, rows, _] = counts;
        let place = |at: usize| [at % across, at / across % rows, at / (across * rows)].map(|x| x as u16);
        let filled: Vec<([u16; 3], f32)> = filled.map(|(at, rho)| (place(at), rho)).collect();
        let [low, high] = [u16::min, u16::max].map(|pick| {
            [0, 1, 2].map(|axis| filled.iter().map(|(place, _)| place[axis]).reduce(pick).unwrap_or(0))
        });
        let counts = [0, 1, 2].map(|axis| usize::from(high[axis] - low[axis]) + 1);
        let corner = [0, 1, 2].map(|axis| corner[axis] + f64::from(low[axis]) * side);
        let mut voxels: Vec<Voxel> = filled
            .iter()
            .map(|(place, rho)| Voxel::new([0, 1, 2].map(|axis| place[axis] - low[axis]), *rho))
            .collect();
        voxels.par_sort_unstable_by_key(Voxel::code);
        let radius = filled
            .iter()
            .map(|(place, _)| {
                let furthest = [0, 1, 2].map(|axis| {
                    let from = corner[axis] + f64::from(place[axis] - low[axis]) * side;
                    let far = from.abs().max((from + side).abs());
                    far * far
                });
                furthest[0] + furthest[1] + furthest[2]
            })
            .fold(0.0, f64::max)
            .sqrt();
        let longest = counts[0].max(counts[1]).max(counts[2]);
        let number = (0..7).find(|level| longest.div_ceil(1 << level) <= FEWEST).unwrap_or(7) + 1;
        let full = extinction * side;
        let grids: Vec<Grid> = (0..number as u32)
            .into_par_iter()
            .map(|level| levels::cells(&voxels, level, full, side, counts))
            .collect();
        let fits = fit::fits(&grids, normals, thinner(&grids[0], corner));
        Ok(Self { levels: grids.into_iter().zip(fits).collect(), corner, radius, extinction })
    }

    /// Radius of the sphere around the centre of mass that holds it, m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The corners of the box that holds it, from its centre of mass, m.
    pub fn bounds(&self) -> [Point3<f64>; 2] {
        let (voxels, _) = &self.levels[0];
        let low = Point3::from(self.corner);
        [low, Translation3::from(Vector3::from(voxels.extent) * voxels.side) * low]
    }

    /// tau that its levels are made for, 1/m.
    pub fn extinction(&self) -> f64 {
        self.extinction
    }

    /// How many levels there are, at least 1.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// The side of a level's cells, m.
    ///
    /// # Panics
    ///
    /// Of a level that there is not.
    pub fn side(&self, level: usize) -> f64 {
        self.levels[level].0.side
    }

    /// How many cells of a level have density.
    ///
    /// # Panics
    ///
    /// Of a level that there is not.
    pub fn cells(&self, level: usize) -> usize {
        self.levels[level].0.cells.len()
    }

    /// The integral of 1 - transmittance over the plane across a direction, m^2, by so many rays.
    ///
    /// # Panics
    ///
    /// Of a level that there is not.
    pub fn opacity(&self, level: usize, direction: [f64; 3], rays: usize) -> f64 {
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let direction = direction.map(|x| x / length);
        let (grid, fit) = &self.levels[level];
        let by = fit.multiplier(direction, 1.0);
        let plane = Plane::across(grid, direction);
        let taken = |k| 1.0 - exp(-by * grid.depth(&plane.ray(spread(k)), 60.0 / by));
        let sum: f64 = (0..rays).map(taken).sum();
        sum / rays as f64 * plane.area * grid.side * grid.side
    }
}
