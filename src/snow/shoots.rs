//! The tips of branches, which grow along the six directions of Eq. (10) and branch by Eq. (4), on layers of the lattice.
//!
//! Only the twelfth 0 <= r <= q is grown, the half of the sector of an arm along +q; the rest is its image.

use std::collections::BTreeSet;

use crate::hexgrid::{Axial, STEPS};
use crate::rng::{Moment, Stream};

use super::twelfth::{Layer, steps_out};
use super::{Form, Tally};

/// The end of a branch F(t).
#[derive(Clone, Copy, Debug)]
struct Tip {
    at: Axial,
    // s of Eq. (10).
    heading: usize,
    order: usize,
    layer: usize,
    // What of l(t) is not yet a whole cell.
    progress: f64,
}

/// How shoots grow at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vigour {
    /// p1 of Eq. (4): the probability that an arm branches in a new cell; and that a branch goes on beside another.
    pub branching: f64,
    /// Speed, sparing, widening and sector of branches.
    pub form: Form,
    /// How near to plate the habit is, 0 to 1: ice's share of what is deposited.
    pub plate: f64,
}

/// Assumptions on shoots that do not change with the weather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    /// How far to its sides a tip feels other branches, cells.
    pub spacing: i32,
    /// Half the width of a slender branch from which its sides move at less than half of their speed, cells.
    pub width: f64,
    /// The highest order of branch that is grown.
    pub most_order: usize,
    /// Speed of arms on the second layer and above.
    pub ridge: f64,
    /// p1 on the second layer and above where the layer below has branched: condition 6.
    pub above_branch: f64,
    /// By what p1 is multiplied there where it has not.
    pub above_none: f64,
    /// Chance of a cell amid ice to begin the next layer while c grows by a layer, in a plate: condition 5.
    pub births: f64,
    /// The power of the share of ice around with which that falls.
    pub births_power: i32,
}

/// Layers and the tips that grow them.
#[derive(Clone, Debug)]
pub(super) struct Shoots {
    pub layers: Vec<Layer>,
    /// The layer that the arms are on; those above are relief.
    pub lead: usize,
    pub tally: Tally,
    tips: Vec<Tip>,
    streams: [Stream; 2],
    step: u32,
    // Growth of arms since sides last grew, cells, and of c since layers last began, layers.
    owed: [f64; 2],
}

/// Arms grow by so much, in cells, between two moves of the sides of branches.
const SIDES_EVERY: f64 = 0.25;
/// And c by so much, in layers, between two chances to begin one.
const BIRTHS_EVERY: f64 = 0.25;

impl Shoots {
    pub fn new(streams: [Stream; 2]) -> Self {
        let (layers, tips) = (Vec::new(), Vec::new());
        Self { layers, lead: 0, tally: Tally::default(), tips, streams, step: 0, owed: [0.0; 2] }
    }

    pub fn step(&self) -> u32 {
        self.step
    }

    /// Makes a layer a whole hexagon, with arms and branches as if it had grown from p1 = 1; `rest` is what of the arms'
    /// length is not yet a cell.
    pub fn open(&mut self, layer: usize, radius: i32, rest: f64) {
        self.lead = layer;
        for q in 0..=radius {
            for r in 0..=q.min(radius - q) {
                self.layers[layer].set(Axial::new(q, r), self.step);
            }
        }
        let tip =
            |q, heading, order| Tip { at: Axial::new(q, radius - q), heading, order, layer, progress: rest };
        self.tips.push(tip(radius, 0, 0));
        self.tips.extend((0..radius).filter(|q| radius - q <= *q).map(|q| tip(q, 1, 1)));
    }

    /// An upper layer begins in the middle, `C -> L[L]`, unless the one below is hollow there: ice grows on ice.
    pub fn begin(&mut self, layer: usize) {
        if layer > 0 && !self.layers[layer - 1].is_ice(Axial::ORIGIN) {
            return;
        }
        self.layers[layer].set(Axial::ORIGIN, self.step);
        self.tips.push(Tip { at: Axial::ORIGIN, heading: 0, order: 0, layer, progress: 0.0 });
    }

    /// Lets arms grow by `length` and c by `height` cells, at most 1 each, with relief up to layer `top`.
    pub fn grow(
        &mut self,
        [length, height]: [f64; 2],
        seconds: f64,
        top: usize,
        vigour: &Vigour,
        manner: &Manner,
    ) {
        self.step += 1;
        let [branches, births] = self.streams.each_ref().map(|stream| stream.at(u64::from(self.step)));
        while self.layers.len() <= top {
            self.layers.push(Layer::default());
            self.begin(self.layers.len() - 1);
        }
        self.lengthen(length, seconds, vigour, manner, &branches);
        self.owed[0] += length;
        if self.owed[0] >= SIDES_EVERY {
            self.widen(self.owed[0], &vigour.form, manner.width);
            self.owed[0] = 0.0;
        }
        self.owed[1] += height;
        if self.owed[1] >= BIRTHS_EVERY {
            let chance = self.owed[1] * manner.births * vigour.plate;
            self.begin_layers(chance, manner.births_power, &births);
            self.owed[1] = 0.0;
        }
    }

    /// Eq. (6), then Eq. (4) for tips in a new cell. All look at the lattice as it was.
    fn lengthen(&mut self, length: f64, seconds: f64, vigour: &Vigour, manner: &Manner, moment: &Moment) {
        // Of each order.
        let powers = |of: f64| -> Vec<f64> {
            (0..=manner.most_order)
                .scan(1.0, |power, _| Some(std::mem::replace(power, *power * of)))
                .collect()
        };
        let (slower, sparser) = (powers(vigour.form.slowing), powers(vigour.form.sparing));
        let mut kept = Vec::with_capacity(self.tips.len());
        let mut ice = Vec::new();
        // Of two tips that come to a cell at once the one of lower order goes on.
        let mut taken = BTreeSet::new();
        self.tips.sort_by_key(|tip| tip.order);
        for mut tip in std::mem::take(&mut self.tips) {
            let lag = if tip.layer > self.lead { manner.ridge } else { 1.0 };
            tip.progress += length * lag * slower[tip.order];
            let relief = tip.layer > self.lead;
            if !relief {
                self.tally.lived(tip.order, seconds);
            }
            if tip.progress < 1.0 {
                kept.push(tip);
                continue;
            }
            let (dq, dr) = STEPS[tip.heading];
            let to = Axial::new(tip.at.q + dq, tip.at.r + dr);
            if relief && !self.layers[tip.layer - 1].is_ice(to) {
                // It waits for the layer below.
                tip.progress = 1.0;
                kept.push(tip);
                continue;
            }
            // A branch stops at the edges of its sector and on ice.
            let inside = 0 <= to.r && f64::from(to.r) <= vigour.form.sector * f64::from(to.q);
            let is_ice = self.layers[tip.layer].is_ice(to);
            if !inside || (is_ice && tip.order > 0) || !taken.insert((tip.layer, to)) {
                continue;
            }
            tip.at = to;
            tip.progress -= 1.0;
            if !relief {
                self.tally.advanced(tip.order);
            }
            let mut place = moment.place(to.q, to.r, (tip.layer * STEPS.len() + tip.heading) as i32);
            let (lives, branches) = (place.uniform(), place.uniform());
            let layer = &self.layers[tip.layer];
            if tip.order == 0 || lives < vigour.branching || !is_crowded(layer, tip, manner.spacing) {
                kept.push(tip);
            }
            let mut branched = false;
            if tip.order < manner.most_order {
                let below = relief && self.layers[tip.layer - 1].is_branched(to);
                let p1 = vigour.branching * sparser[tip.order];
                let probability = match (relief, below) {
                    (false, _) => p1,
                    (true, true) => manner.above_branch,
                    (true, false) => manner.above_none * p1,
                };
                branched = branches < probability;
                if relief {
                    self.tally.tried(below, branched);
                }
            }
            if branched {
                // Always the mirrored pair; on an arm one of the two is the other's image.
                let turns: &[usize] = if tip.order == 0 { &[1] } else { &[1, 5] };
                kept.extend(turns.iter().map(|turn| Tip {
                    heading: (tip.heading + turn) % STEPS.len(),
                    order: tip.order + 1,
                    ..tip
                }));
            }
            ice.push((tip.layer, to, branched));
        }
        for (layer, at, branched) in ice {
            self.layers[layer].set(at, self.step);
            if branched {
                self.layers[layer].set_branched(at);
            }
        }
        self.tips = kept;
    }

    /// Sides of branches move outwards while arms grow by `length` cells: a cell beside two of ice, as along a straight
    /// side, is overgrown at the speed of the form, beside one at half of it, in a hollow faster; and the slower the wider
    /// a slender branch is. Above the first layer ice keeps off edges.
    fn widen(&mut self, length: f64, form: &Form, width: f64) {
        let radius = self.radius();
        for number in self.lead..self.layers.len() {
            let mut ice = Vec::new();
            let reach = self.layers[number].reach() + 1;
            for q in 0..=reach.min(radius) {
                for r in 0..=q.min(radius - q) {
                    let at = Axial::new(q, r);
                    if self.layers[number].is_ice(at) || (number > self.lead && !self.is_amid(number - 1, at))
                    {
                        continue;
                    }
                    let layer = &self.layers[number];
                    let beside = at.neighbours().into_iter().filter(|n| layer.is_ice(*n));
                    let (count, depth) = beside.fold((0.0, u16::MAX), |(count, depth), n| {
                        (count + 1.0, depth.min(layer.depth(n).saturating_add(1)))
                    });
                    if count > 0.0 {
                        let wide = form.slender * f64::from(depth) / width;
                        let by = length * form.widening * count / (2.0 * (1.0 + wide * wide));
                        if self.layers[number].press(at, by as f32) >= 1.0 {
                            ice.push((at, depth));
                        }
                    }
                }
            }
            for (at, depth) in ice {
                self.layers[number].set(at, self.step);
                self.layers[number].set_depth(at, depth);
            }
        }
    }

    /// Condition 5 of §1.1.3: a cell begins the next layer, the likelier the denser its surroundings.
    fn begin_layers(&mut self, chance: f64, power: i32, moment: &Moment) {
        for number in self.lead + 1..self.layers.len() {
            let below = &self.layers[number - 1];
            let mut ice = Vec::new();
            for at in below.twelfth().filter(|at| !self.layers[number].is_ice(*at)) {
                let density = below.density(at);
                let probability = (0..power).fold(chance, |product, _| product * density);
                if moment.place(at.q, at.r, number as i32).uniform() < probability {
                    ice.push(at);
                }
            }
            for at in ice {
                self.layers[number].set(at, self.step);
            }
        }
    }

    /// Length of the arms on the first layer, cells.
    pub fn radius(&self) -> i32 {
        self.tips
            .iter()
            .find(|tip| tip.layer == self.lead && tip.order == 0)
            .map_or(0, |tip| steps_out(tip.at))
    }

    fn beside(&self, layer: usize, at: Axial) -> u32 {
        at.neighbours().iter().map(|n| u32::from(self.layers[layer].is_ice(*n))).sum()
    }

    fn is_amid(&self, layer: usize, at: Axial) -> bool {
        self.layers[layer].is_ice(at) && self.beside(layer, at) == 6
    }
}

/// Whether ice lies ahead of a tip to its left or right, within so many cells: what vapour there is goes there.
fn is_crowded(layer: &Layer, tip: Tip, spacing: i32) -> bool {
    [1, 5].into_iter().any(|turn| {
        let (dq, dr) = STEPS[(tip.heading + turn) % STEPS.len()];
        (1..=spacing).any(|k| layer.is_ice(Axial::new(tip.at.q + k * dq, tip.at.r + k * dr)))
    })
}
