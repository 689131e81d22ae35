//! A crystal in the making: columns by whole layers, plates by shoots.

use std::cmp::Ordering;

use crate::hexgrid::Axial;
use crate::rng::Seed;

use super::axes::{Air, Axes};
use super::habit::{ICE, deposition_density, growth_ratio};
use super::shoots::Shoots;
use super::twelfth::{Layer, steps_out};
use super::{Branching, SnowError};

/// The most layers on either side of the middle one, and the longest arms, in cells.
const MOST: f64 = 1000.0;

/// A crystal in the making.
#[derive(Clone, Debug)]
pub(super) struct Growth<'a> {
    branching: &'a Branching,
    pub shoots: Shoots,
    // Of the plate on its end, if it was a column that grew caps.
    axes: Axes,
    // Half the length of that column, less what the plate began with, m.
    stem: f64,
    // Whether it is still a six-sided prism.
    is_prism: bool,
    // Of each layer of a column, the steps from the middle within which it is hollow.
    funnels: Vec<i32>,
}

/// Refuses a crystal that is too large.
pub(super) fn check(axes: &Axes, element: f64) -> Result<(), SnowError> {
    for (name, axis) in [("half the width", axes.a), ("half the length", axes.c)] {
        // Not-a-number is not at most MOST.
        if !matches!((axis / element).partial_cmp(&MOST), Some(Ordering::Less | Ordering::Equal)) {
            return Err(SnowError::TooLarge { name, cells: axis / element });
        }
    }
    Ok(())
}

impl<'a> Growth<'a> {
    pub fn new(branching: &'a Branching, seed: Seed) -> Self {
        let streams = ["branches", "layers"].map(|name| seed.stream(name));
        let mut growth = Self {
            branching,
            shoots: Shoots::new(streams),
            axes: Axes::sphere(branching.parameters().seed_radius),
            stem: 0.0,
            is_prism: true,
            funnels: Vec::new(),
        };
        growth.lay(1.0);
        growth
    }

    /// Grows for a time in s, in parts in which neither axis grows by more than half a cell.
    pub fn pass(&mut self, air: &Air, seconds: f64) -> Result<(), SnowError> {
        let element = self.branching.parameters().element;
        let (mut left, mut part) = (seconds, seconds);
        while left > 0.0 {
            part = part.min(left);
            let axes = self.axes.grown(air, part);
            let most = (axes.a - self.axes.a).max(axes.c - self.axes.c);
            if most > 0.5 * element {
                part *= 0.5;
                continue;
            }
            check(&axes, element)?;
            self.step(axes, air, part);
            left -= part;
        }
        Ok(())
    }

    fn step(&mut self, axes: Axes, air: &Air, seconds: f64) {
        let element = self.branching.parameters().element;
        let fill = deposition_density(air.temperature, air.supersaturation) / ICE;
        let grown = [axes.a - self.axes.a, axes.c - self.axes.c].map(|along| along / element);
        let plates = growth_ratio(air.temperature) < 1.0;
        if plates && self.is_prism {
            self.open();
            // The axes may be others now.
            return self.step(self.axes.grown(air, seconds), air, seconds);
        }
        self.axes = axes;
        if self.is_prism {
            return self.lay(fill);
        }
        let manner = self.branching.parameters().manner();
        if plates {
            let vigour = self.branching.vigour(fill);
            let top = self.shoots.lead.max(self.layers_wanted());
            self.shoots.grow(grown, seconds, top, &vigour, &manner);
        } else {
            // What has branched goes on as a plate without holes, and rises along its rim.
            self.shoots.grow(
                grown,
                seconds,
                self.shoots.layers.len() - 1,
                &self.branching.vigour(1.0),
                &manner,
            );
            self.raise(fill);
        }
    }

    /// Layers above the middle one: c over the element, since all of them are 2c over it, Eq. (2).
    fn layers_wanted(&self) -> usize {
        (self.axes().c / self.branching.parameters().element) as usize
    }

    /// The spheroid around all of it.
    pub fn axes(&self) -> Axes {
        Axes { c: self.axes.c + self.stem, ..self.axes }
    }

    fn radius(&self) -> i32 {
        (self.axes.a / self.branching.parameters().element) as i32
    }

    /// A prism's sides and ends. Its ends are hollow, such that a new layer fills its share of the hexagon.
    fn lay(&mut self, fill: f64) {
        let radius = self.radius();
        while self.shoots.layers.len() <= self.layers_wanted() {
            self.shoots.layers.push(Layer::default());
            let hollow = f64::from(radius) * (1.0 - fill).max(0.0).sqrt();
            // Ice grows on ice: what is hollow beneath is not bridged.
            let beneath = self.funnels.last().copied().unwrap_or(0);
            self.funnels.push(beneath.max(libm::round(hollow) as i32));
        }
        let step = self.shoots.step();
        for (layer, funnel) in self.shoots.layers.iter_mut().zip(&self.funnels) {
            for q in 0..=radius {
                for r in 0..=q.min(radius - q) {
                    let at = Axial::new(q, r);
                    if steps_out(at) >= *funnel {
                        layer.set(at, step);
                    }
                }
            }
        }
    }

    /// A prism begins to grow shoots: at its middle if it is flat, at its ends, which stand out furthest, if it is long.
    fn open(&mut self) {
        let radius = self.radius();
        let rest = self.axes.a / self.branching.parameters().element - f64::from(radius);
        let top = self.shoots.layers.len() - 1;
        let lead = if self.axes.c > self.axes.a {
            // Each end grows as a crystal of its own, which begins as a sphere as wide as the column.
            self.stem = self.axes.c - self.axes.a;
            self.axes.c = self.axes.a;
            top
        } else {
            0
        };
        for layer in lead + 1..=top {
            self.shoots.begin(layer);
        }
        self.shoots.open(lead, radius, rest);
        self.is_prism = false;
    }

    /// New layers on the rim of what has branched: cells amid ice stay behind, as in a hollow column.
    fn raise(&mut self, fill: f64) {
        while self.shoots.layers.len() <= self.layers_wanted() {
            let step = self.shoots.step();
            let below = &self.shoots.layers[self.shoots.layers.len() - 1];
            let mut layer = Layer::default();
            for at in below.twelfth().filter(|at| fill >= 1.0 || below.density(*at) < 1.0) {
                layer.set(at, step);
            }
            self.shoots.layers.push(layer);
        }
    }
}
