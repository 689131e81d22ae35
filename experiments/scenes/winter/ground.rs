//! Snow on the ground: drifts by Miyata's fractional midpoint displacement, which the wind has smoothed, under an
//! overcast sky.

use rayon::prelude::*;
use snowglobe::lab::Result;
use snowglobe::rng::Seed;

use super::canvas::Reach;
use super::lattice::{Lattice, Rough};
use super::view::View;

/// Snow on the ground.
#[derive(Clone, Debug)]
pub struct Ground {
    height: Lattice,
    /// What of the sky is seen from the snow, between trees and out of hollows.
    open: Lattice,
    /// Crusts and ripples of a few centimetres, repeated.
    crust: Lattice,
}

/// Width of the lattice of drifts, m; it begins at 2 m before the camera.
const WIDE: f64 = 48.0;
/// Width of the lattice of the crust, m.
const CRUST: f64 = 4.0;
/// The eye's height over the snow beneath it, m.
pub const EYE: f64 = 1.5;
/// How far the ground can be told from the horizon, m.
const FAR: f64 = 400.0;

impl Ground {
    /// The ground among trees: the place, radius and height of each.
    pub fn new(trees: &[[f64; 4]], seed: Seed) -> Result<Self> {
        let rough = Rough { name: "winter: drifts", dimension: 2.08, side: 5.0, gain: 0.075, levels: 6 };
        let low = [-0.5 * WIDE, 2.0];
        let drifts = Lattice::fractal(low, WIDE, 601, rough, seed)?.smoothed(9);
        let height = drifts.changed(|place, rough| rough + falls(place) as f32);
        // A hollow lies lower than the snow around.
        let near = height.smoothed(24);
        let wide = near.thinned(6).smoothed(4);
        let wood = Lattice::level(low, WIDE, 97).changed(|place, _| sky_over(trees, place) as f32);
        // Exposed for the snow in front.
        let front =
            (0..25).map(|k| wood.at([f64::from(k % 5) - 2.0, 5.0 + f64::from(k / 5)])[0]).sum::<f32>();
        let open = height.clone().changed(|place, own| {
            let deep = 2.2 * (near.at(place)[0] - own) + 1.3 * (wide.at(place)[0] - own);
            (1.0 - deep.clamp(-0.10, 0.35)) * wood.at(place)[0] * 25.0 / front
        });
        let rough = Rough { name: "winter: crust", dimension: 2.25, side: 0.5, gain: 0.035, levels: 5 };
        let crust = Lattice::fractal([0.0; 2], CRUST, 257, rough, seed)?.smoothed(1);
        Ok(Self { height, open, crust })
    }

    /// Height of the snow under a place, m below or above the snow at the camera; the eye is the origin.
    pub fn height(&self, place: [f64; 2]) -> f64 {
        f64::from(self.height.at(place)[0]) - EYE
    }

    /// How far the ground is in each pixel.
    pub fn reaches(&self, view: &View) -> Vec<Reach> {
        let [width, height] = view.size;
        let columns: Vec<Vec<Reach>> =
            (0..width).into_par_iter().map(|column| self.column(view, column)).collect();
        let mut reaches = vec![Reach::even(f32::INFINITY); width * height];
        reaches.par_chunks_mut(width).enumerate().for_each(|(row, reaches)| {
            for (reach, column) in reaches.iter_mut().zip(&columns) {
                *reach = column[row];
            }
        });
        reaches
    }

    /// A column of them: marches away from the camera, and up the picture.
    fn column(&self, view: &View, column: usize) -> Vec<Reach> {
        let [width, height] = view.size;
        let slope = (column as f64 + 0.5 - 0.5 * width as f64) / view.focal;
        let below = |part: usize| {
            let row = (part as f64 + 0.5) / PARTS as f64;
            (0.5 * height as f64 - row) / view.focal
        };
        let mut depths = vec![f32::INFINITY; PARTS * height];
        let mut part = depths.len();
        let mut z = 2.0;
        let mut last = self.height([slope * z, z]) / z;
        while z < FAR && part > 0 {
            let next = z * 1.004;
            let rises = self.height([slope * next, next]) / next;
            while part > 0 && below(part - 1) <= rises {
                let share = ((below(part - 1) - last) / (rises - last)).clamp(0.0, 1.0);
                depths[part - 1] = (z + share * (next - z)) as f32;
                part -= 1;
            }
            (z, last) = (next, rises);
        }
        depths.chunks_exact(PARTS).map(reach).collect()
    }

    /// Light of the snow seen at a depth, with so many metres across a pixel.
    pub fn light(&self, [x, z]: [f64; 2], view: &View) -> [f32; 3] {
        let [_, mut along_x, mut along_z] = self.height.at([x, z]);
        let mut grain = 0.0;
        // The crust, as long as a pixel does not hold all of it: seen flat, a pixel is longer than wide.
        let long = z * z / (EYE * view.focal);
        for (scale, strength) in [(1.0_f64, 0.42_f32), (0.31, 0.45)] {
            let fine = (1.0_f64 - long / (0.12 * scale)).clamp(0.0, 1.0) as f32;
            if fine > 0.0 {
                let wrap = |a: f64| libm::fmod(a / scale + 4000.0, CRUST);
                let [value, dx, dz] = self.crust.at([wrap(x), wrap(z)]);
                along_x += fine * strength * dx;
                along_z += fine * strength * dz;
                grain += fine * strength * value;
            }
        }
        let up = 1.0 / (1.0 + along_x * along_x + along_z * along_z).sqrt();
        // The sky is brightest above the camera's left shoulder, where behind the clouds the sun is.
        let towards = (0.80 + 0.64 * along_x + 0.46 * along_z) * up / 0.80;
        let open = (self.open.at([x, z])[0] + 0.5 * grain).clamp(0.0, 1.25);
        let lit = open * (0.26 + 0.74 * towards.max(0.0));
        shade(lit)
    }
}

/// Parts of a pixel, one over the other, of which each has its distance.
const PARTS: usize = 4;

/// The distances in a pixel, the farthest first, as two where they leap: what lies between is hidden.
fn reach(depths: &[f32]) -> Reach {
    let nearer = |depth: f32| depths.iter().filter(|other| **other < depth).count();
    let Some(edge) = depths.windows(2).find(|pair| pair[0] > LEAP * pair[1]).map(|pair| nearer(pair[0]))
    else {
        return Reach::even(depths[PARTS / 2]);
    };
    let mean = |depths: &[f32]| depths.iter().sum::<f32>() / depths.len() as f32;
    let (far, near) = depths.split_at(PARTS - edge);
    Reach { near: mean(near), far: mean(far), share: edge as f32 / PARTS as f32 }
}

/// By how much distances leap over an edge.
const LEAP: f32 = 1.02;

/// The slope from the camera's rise to the clearing, m.
fn falls([x, z]: [f64; 2]) -> f64 {
    let t = ((z - 3.0) / 17.0).clamp(0.0, 1.0);
    let rise = ((z - 18.0) / 40.0).max(0.0);
    -1.30 * t * t * (3.0 - 2.0 * t) + 0.004 * x * x * t + 1.2 * rise.min(1.0)
}

/// Directions in which the height of the wood is looked up.
const DIRECTIONS: usize = 32;

/// What trees leave of the light of an overcast sky on the ground.
fn sky_over(trees: &[[f64; 4]], [x, z]: [f64; 2]) -> f64 {
    let mut tops = [0.0_f64; DIRECTIONS];
    let part = DIRECTIONS as f64 / std::f64::consts::TAU;
    for [tx, tz, radius, height] in trees {
        let [dx, dz] = [tx - x, tz - z];
        let square = dx * dx + dz * dz + 0.4 * radius * radius;
        // A crown tapers: it is as wide as it is hidden at half its height.
        let half = (0.7 * radius / square.sqrt()).min(1.2) * part;
        let tall = 0.8 * height / (square + 0.64 * height * height).sqrt();
        let middle = libm::atan2(dz, dx) * part + DIRECTIONS as f64;
        let (from, to) = (middle - half, middle + half);
        for direction in libm::floor(from) as usize..=libm::floor(to) as usize {
            let covered = (to.min(direction as f64 + 1.0) - from.max(direction as f64)).clamp(0.0, 1.0);
            let top = &mut tops[direction % DIRECTIONS];
            *top = top.max(covered.sqrt() * tall);
        }
    }
    // The sky of a height whose sine is s is as bright as 1 + 2 s; snow takes it by that sine.
    let left = |s: f64| (3.0 * (1.0 - s * s) + 4.0 * (1.0 - s * s * s)) / 7.0;
    tops.into_iter().map(left).sum::<f64>() / DIRECTIONS as f64
}

/// Snow that gets this share of the open sky's light: what is in shade is lit by blue forward light only.
fn shade(lit: f32) -> [f32; 3] {
    let lit = lit.max(0.0);
    let dark = (1.0 - lit).max(0.0);
    // The brightest snow is not much brighter.
    let over = (lit - 1.0).max(0.0);
    let bright = SNOW * (lit.min(1.0) + 0.2 * over / (1.0 + over));
    [bright * (0.99 - 0.24 * dark), bright * (1.0 - 0.08 * dark), bright * (1.015 + 0.12 * dark)]
}

/// Radiance of level snow under the open sky.
pub const SNOW: f32 = 0.925;
