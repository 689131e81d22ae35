//! A crystal: `C -> L[L]`, Eq. (2), grown from the weather by the six conditions of §1.1.3.

use crate::hexgrid::Axial;
use crate::rng::Seed;

use super::axes::{Air, Axes};
use super::growth::{self, Growth};
use super::habit::{Habit, ICE};
use super::shoots::Shoots;
use super::twelfth::{Layer, multiplicity, steps_out};
use super::{Branching, History, Layers, SnowError, Tally};

/// A snow crystal: layers of hexagonal cells, alike above and below the middle one.
///
/// Layer k stands for the two layers at z = k and -k times the element, layer 0 for the one at z = 0. An element is a cell
/// of a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Crystal {
    element: f64,
    layers: Vec<Layer>,
    lead: usize,
    axes: Axes,
    habits: Vec<(Habit, f64)>,
    tally: Tally,
}

impl Crystal {
    /// Grows a crystal through a history. The same seed gives the same crystal; `branching` holds the parameters.
    ///
    /// # Errors
    ///
    /// Weather that [`Air::check`] refuses; a crystal of more than 1000 cells or layers from its middle.
    pub fn grow(
        history: &History,
        branching: &Branching,
        layers: Layers,
        seed: Seed,
    ) -> Result<Self, SnowError> {
        let parameters = branching.parameters();
        let mut habits: Vec<(Habit, f64)> = Vec::new();
        let mut moments = Vec::new();
        let mut axes = Axes::sphere(parameters.seed_radius);
        let (mut second, end) = (0.0, 60.0 * history.minutes());
        while second < end {
            let seconds = parameters.step.min(end - second);
            let (temperature, supersaturation) = history.at((second + 0.5 * seconds) / 60.0);
            let (pressure, ventilation) = (parameters.pressure, parameters.ventilation);
            let air = Air { temperature, supersaturation, pressure, ventilation };
            air.check()?;
            // What will be too large is refused before it is grown.
            axes = axes.grown(&air, seconds);
            growth::check(&axes, parameters.element)?;
            let habit = Habit::grown(temperature, supersaturation, &parameters.habits);
            match habits.last_mut() {
                Some((last, time)) if *last == habit => *time += seconds,
                _ => habits.push((habit, seconds)),
            }
            moments.push((air, seconds));
            second += seconds;
        }
        let mut growth = Growth::new(branching, seed);
        for (air, seconds) in moments {
            growth.pass(&air, seconds)?;
        }
        let (element, axes) = (parameters.element, growth.axes());
        let Shoots { layers: mut grown, lead, tally, .. } = growth.shoots;
        if layers == Layers::Extruded {
            let first = grown[lead].clone();
            grown[lead..].fill(first);
        }
        Ok(Self { element, layers: grown, lead, axes, habits, tally })
    }

    /// b_min, m.
    pub fn element(&self) -> f64 {
        self.element
    }

    /// The layers from the middle upwards, at least one.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Which of them the arms grew on: 0 of plates, the last of a column that grew caps, of which the layers above are
    /// relief.
    pub fn lead(&self) -> usize {
        self.lead
    }

    /// Whether it is a column that grew caps: its ends are wider than its middle.
    pub fn is_capped(&self) -> bool {
        let reach = |layer: &Layer| layer.twelfth().map(steps_out).max().unwrap_or(0);
        self.lead > 0 && reach(&self.layers[self.lead]) > reach(&self.layers[0])
    }

    /// What it is called: `capped-column`, or the habit that it grew in for longest.
    pub fn name(&self) -> &'static str {
        if self.is_capped() {
            return "capped-column";
        }
        let longest = |habit: &Habit| {
            let of = self.habits.iter().filter(|(other, _)| other == habit);
            of.map(|(_, seconds)| seconds).sum::<f64>()
        };
        let most = Habit::ALL.into_iter().max_by(|a, b| longest(a).total_cmp(&longest(b)));
        if self.habits.is_empty() { "none" } else { most.map_or("none", Habit::name) }
    }

    /// The spheroid that the growth was computed for.
    pub fn axes(&self) -> &Axes {
        &self.axes
    }

    /// Habits in the order in which the weather asked for them, each with its time in s.
    pub fn habits(&self) -> &[(Habit, f64)] {
        &self.habits
    }

    /// What its shoots did while they grew.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Whether the element at a cell of the layer at `z` times the element is ice.
    pub fn is_ice(&self, at: Axial, z: i32) -> bool {
        self.layers.get(z.unsigned_abs() as usize).is_some_and(|layer| layer.is_ice(at))
    }

    /// All elements of ice: the cell, and z in elements. Ordered by z.
    pub fn elements(&self) -> impl Iterator<Item = (Axial, i32)> {
        let top = self.layers.len() as i32 - 1;
        (-top..=top).flat_map(|z| self.layers[z.unsigned_abs() as usize].cells().map(move |at| (at, z)))
    }

    /// How many elements are ice.
    pub fn count(&self) -> usize {
        let counts = self.layers.iter().map(Layer::count);
        2 * counts.sum::<usize>() - self.layers[0].count()
    }

    /// How many elements of ice lie over and under each other at a cell.
    pub fn thickness(&self, at: Axial) -> usize {
        let above = self.layers[1..].iter().filter(|layer| layer.is_ice(at)).count();
        2 * above + usize::from(self.layers[0].is_ice(at))
    }

    /// Steps from the centre to the furthest cell.
    pub fn radius(&self) -> i32 {
        self.layers.iter().flat_map(Layer::twelfth).map(steps_out).max().unwrap_or(0)
    }

    /// From one corner to the opposite one, m.
    pub fn diameter(&self) -> f64 {
        f64::from(2 * self.radius() + 1) * self.element
    }

    /// From the lowest layer to the highest, m.
    pub fn height(&self) -> f64 {
        (2 * self.layers.len() - 1) as f64 * self.element
    }

    /// Mass of the elements, kg: hexagonal prisms one element high whose centres are one apart, at the density of ice.
    pub fn mass(&self) -> f64 {
        let cell = crate::hexgrid::ROW_HEIGHT * self.element * self.element * self.element;
        self.count() as f64 * cell * ICE
    }

    /// The share of ice in the hexagon around the layer of the arms.
    pub fn fill(&self) -> f64 {
        let layer = &self.layers[self.lead];
        super::layer_fill(layer, layer.twelfth().map(steps_out).max().unwrap_or(0))
    }

    /// The correlation of "the second layer is there" with the share of ice around, over the cells of the first: condition
    /// 5. Both are of the arms. None if there is no second layer, or it is everywhere.
    pub fn correlation_with_density(&self) -> Option<f64> {
        let (first, second) = (&self.layers[self.lead], self.layers.get(self.lead + 1)?);
        let mut sums = [0.0; 6];
        for at in first.twelfth() {
            let (x, y) = (first.density(at), f64::from(u8::from(second.is_ice(at))));
            let n = multiplicity(at) as f64;
            for (sum, term) in sums.iter_mut().zip([1.0, x, y, x * x, y * y, x * y]) {
                *sum += n * term;
            }
        }
        let [n, x, y, xx, yy, xy] = sums;
        let spread = (n * xx - x * x) * (n * yy - y * y);
        (spread > 0.0).then(|| (n * xy - x * y) / spread.sqrt())
    }
}
