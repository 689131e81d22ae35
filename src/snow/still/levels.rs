//! A body's voxels, and coarser cells of twice the side again and again.
//!
//! A cell of mean density would let less or more light through than its voxels do. So a cell keeps the box that its voxels
//! lie in, which a thin plate fills and its cell does not, and for each axis the optical depth that lets the box's mean
//! transmittance through. How voxels of neighbouring cells hide each other is left to [`super::fit`].

use crate::volume::exp;

use super::grid::{Cell, Grid, code};

/// A voxel with density, from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Voxel {
    code: u64,
    place: [u16; 3],
    density: f32,
}

impl Voxel {
    pub fn new(place: [u16; 3], density: f32) -> Self {
        Self { code: code(place.map(u32::from)), place, density }
    }

    /// Its place among all voxels of a body, such that those of any coarser cell follow each other.
    pub fn code(&self) -> u64 {
        self.code
    }
}

/// Cells of `1 << level` voxels along a side. `full` is the optical depth along a voxel of density 1, `side` its side in m,
/// `counts` voxels along each axis.
pub(super) fn cells(voxels: &[Voxel], level: u32, full: f64, side: f64, counts: [usize; 3]) -> Grid {
    let block = 1_u32 << level;
    let (mut places, mut cells, mut densities) = (Vec::new(), Vec::new(), Vec::new());
    let mut columns = Columns::new(block as usize);
    let volume = f64::from(block) * f64::from(block) * f64::from(block);
    for run in voxels.chunk_by(|a, b| a.code >> (3 * level) == b.code >> (3 * level)) {
        places.push(run[0].place.map(|x| x >> level));
        let sum: f64 = run.iter().map(|voxel| f64::from(voxel.density)).sum();
        densities.push((sum / volume) as f32);
        cells.push(if level == 0 {
            let depth = (full * f64::from(run[0].density)) as f32;
            Cell { depth: [depth; 3], slopes: [[0; 2]; 3], low: [0; 3], high: [1; 3] }
        } else {
            columns.cell(run, full)
        });
    }
    let extent = counts.map(|count| count as f64 / f64::from(block));
    let mut grid = Grid::new(side * f64::from(block), block, extent, places, cells);
    for number in 0..grid.cells.len() {
        grid.cells[number].slopes = slopes(&grid, &densities, number);
    }
    grid
}

/// Optical depths of the columns of voxels within a cell, along each axis.
struct Columns {
    block: usize,
    depths: [Vec<f64>; 3],
}

impl Columns {
    fn new(block: usize) -> Self {
        Self { block, depths: [0; 3].map(|_| vec![0.0; block * block]) }
    }

    fn cell(&mut self, run: &[Voxel], full: f64) -> Cell {
        let block = self.block;
        let offset = |voxel: &Voxel| voxel.place.map(|x| usize::from(x) & (block - 1));
        let column = |at: [usize; 3], axis: usize| at[(axis + 1) % 3] * block + at[(axis + 2) % 3];
        let (mut low, mut high) = ([block; 3], [0; 3]);
        for voxel in run {
            let at = offset(voxel);
            for axis in 0..3 {
                low[axis] = low[axis].min(at[axis]);
                high[axis] = high[axis].max(at[axis] + 1);
                self.depths[axis][column(at, axis)] += full * f64::from(voxel.density);
            }
        }
        let length = [0, 1, 2].map(|axis| (high[axis] - low[axis]) as f64);
        let depth = [0, 1, 2].map(|axis| {
            let area = length[(axis + 1) % 3] * length[(axis + 2) % 3];
            let mut taken = 0.0;
            for voxel in run {
                let depth = &mut self.depths[axis][column(offset(voxel), axis)];
                if *depth > 0.0 {
                    taken += 1.0 - exp(-*depth);
                    *depth = 0.0;
                }
            }
            let through = (1.0 - taken / area).max(1e-30);
            (-libm::log(through) * block as f64 / length[axis]) as f32
        });
        Cell { depth, slopes: [[0; 2]; 3], low: low.map(|x| x as u8), high: high.map(|x| x as u8) }
    }
}

/// The change of density towards both neighbours along each axis, over nine cells of each of three planes, weighted as
/// Sobel does; of a unit that is the cell's own.
fn slopes(grid: &Grid, densities: &[f32], number: usize) -> [[i8; 2]; 3] {
    let place = grid.places[number].map(i32::from);
    // Sums over planes: along which axis, at which of three places.
    let mut planes = [[0.0_f32; 3]; 3];
    for z in 0..3_usize {
        for y in 0..3_usize {
            for x in 0..3_usize {
                let near = [place[0] + x as i32 - 1, place[1] + y as i32 - 1, place[2] + z as i32 - 1];
                let Some(other) = grid.number(near) else { continue };
                let off = [x, y, z];
                for axis in 0..3 {
                    let weight = |k: usize| if off[k] == 1 { 2.0 } else { 1.0 };
                    planes[axis][off[axis]] +=
                        densities[other] * weight((axis + 1) % 3) * weight((axis + 2) % 3);
                }
            }
        }
    }
    let change = planes.map(|[lower, own, higher]| [own - lower, higher - own]);
    let most = change.as_flattened().iter().fold(0.0_f32, |most, x| most.max(x.abs()));
    if most == 0.0 {
        return [[0; 2]; 3];
    }
    // Half up, so that no rounding of the processor is asked for.
    change.map(|pair| pair.map(|x| ((x / most + 2.0) * 127.0 + 0.5) as i32 - 254).map(|x| x as i8))
}
