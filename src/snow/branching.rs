//! p1 of Eq. (4) from the habit: condition 2 of §1.1.3.
//!
//! "The nearer to plate the higher, the nearer to dendrite the lower"; no number is printed. Here the first layer fills as
//! much of its hexagon as the deposition density asks for, [`Parameters::relief`] considered. For dendrites p1 sees to
//! that. From there it rises to 1, which is a plate of six fans, and the part of its sector that a fan is sees to it.

use crate::rng::Seed;

use super::shoots::{Shoots, Vigour};
use super::twelfth::steps_out;
use super::{Form, Parameters, SnowError};

/// p1 and sector for a share of ice, found by growing layers on trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Branching {
    // At shares of 0, 1/16, ... 1.
    nodes: [Vigour; NODES + 1],
    parameters: Parameters,
}

const NODES: usize = 16;
/// Length of the arms of a layer on trial, m, and the fewest and most cells of it.
const TRIAL: (f64, f64, f64) = (0.8e-3, 40.0, 100.0);
/// Layers on trial for each p1; all seeds of crystals share them.
const TRIALS: u64 = 4;
/// Halvings of the interval that is searched, to a part in 256.
const HALVINGS: u32 = 8;

impl Branching {
    /// Grows layers on trial of these parameters.
    ///
    /// # Errors
    ///
    /// As [`Parameters::check`].
    pub fn new(parameters: &Parameters) -> Result<Self, SnowError> {
        parameters.check()?;
        let loose = halved(|p1| {
            let vigour = Vigour { branching: p1, ..Self::of_form(parameters.loose, parameters) };
            trial_fill(&vigour, parameters) < parameters.layer_fill(parameters.loose)
        });
        let nodes = std::array::from_fn(|node| {
            let fill = node as f64 / NODES as f64;
            let wanted = parameters.layer_fill(fill);
            let vigour = Self::of_form(fill, parameters);
            if fill <= parameters.loose {
                let with = |branching| Vigour { branching, ..vigour };
                return with(halved(|p1| trial_fill(&with(p1), parameters) < wanted));
            }
            let part = parameters.part(fill);
            let branching = loose + (1.0 - loose) * part;
            let with = |sector| Vigour { branching, form: Form { sector, ..vigour.form }, ..vigour };
            let most = with(parameters.plate.sector);
            if trial_fill(&most, parameters) <= wanted {
                return most;
            }
            with(
                parameters.plate.sector
                    * halved(|sector| {
                        trial_fill(&with(parameters.plate.sector * sector), parameters) < wanted
                    }),
            )
        });
        Ok(Self { nodes, parameters: *parameters })
    }

    /// The same p1 and sectors for elements of another side, m: a preview that costs no trial.
    ///
    /// # Errors
    ///
    /// As [`Parameters::check`].
    pub fn with_element(&self, element: f64) -> Result<Self, SnowError> {
        let parameters = Parameters { element, ..self.parameters };
        parameters.check()?;
        Ok(Self { parameters, ..self.clone() })
    }

    /// With p1 = 1.
    fn of_form(fill: f64, parameters: &Parameters) -> Vigour {
        Vigour { branching: 1.0, form: parameters.form(fill), plate: fill }
    }

    /// How shoots grow where ice fills such a share of what is deposited.
    pub fn vigour(&self, fill: f64) -> Vigour {
        let fill = fill.clamp(0.0, 1.0);
        let along = fill * NODES as f64;
        let low = (along as usize).min(NODES - 1);
        let rest = along - low as f64;
        let [a, b] = [&self.nodes[low], &self.nodes[low + 1]];
        let mix = |a: f64, b: f64| (1.0 - rest) * a + rest * b;
        let sector = mix(a.form.sector, b.form.sector);
        let form = Form { sector, ..self.parameters.form(fill) };
        Vigour { branching: mix(a.branching, b.branching), form, plate: fill }
    }

    /// The parameters it was found for.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }
}

/// Where from 0 to 1 something that rises is no longer too small.
fn halved(is_too_small: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_too_small(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The mean share of its hexagon that a layer fills whose arms are `TRIAL` long.
fn trial_fill(vigour: &Vigour, parameters: &Parameters) -> f64 {
    let (length, least, most) = TRIAL;
    let radius = (length / parameters.element).clamp(least, most) as i32;
    let fill = |k| layer_fill(&grown_layer(Seed(k), radius, vigour, parameters), radius);
    (0..TRIALS).map(fill).sum::<f64>() / TRIALS as f64
}

/// One layer from a single cell, in the same weather all the time, until its arms are `radius` cells long.
pub fn grown_layer(seed: Seed, radius: i32, vigour: &Vigour, parameters: &Parameters) -> super::Layer {
    let streams = ["branches", "layers"].map(|name| seed.stream(name));
    let mut shoots = Shoots::new(streams);
    shoots.layers.push(super::Layer::default());
    shoots.open(0, 0, 0.0);
    for _ in 0..2 * radius {
        shoots.grow([0.5, 0.0], 1.0, 0, vigour, &parameters.manner());
    }
    shoots.layers.swap_remove(0)
}

/// The share of the hexagon of a radius, in cells, that is ice.
pub fn layer_fill(layer: &super::Layer, radius: i32) -> f64 {
    let radius = i64::from(radius);
    let ice = layer.cells().filter(|at| i64::from(steps_out(*at)) <= radius).count();
    ice as f64 / (3 * radius * (radius + 1) + 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The check of the readings: 3 n (n + 1) + 1 cells, and never another, at any length of the arms.
    #[test]
    fn with_p1_of_1_and_no_slowing_the_hexagon_is_full() {
        let all = Vigour { branching: 1.0, form: Parameters::ASSUMED.plate, plate: 1.0 };
        for radius in [0, 1, 2, 7, 40] {
            let layer = grown_layer(Seed(3), radius, &all, &Parameters::ASSUMED);
            assert_eq!(layer.count() as i32, 3 * radius * (radius + 1) + 1, "{radius}");
            assert_eq!(layer_fill(&layer, radius), 1.0);
        }
    }

    #[test]
    fn without_branches_there_are_six_arms() {
        let form = Form { widening: 0.0, ..Parameters::ASSUMED.plate };
        let none = Vigour { branching: 0.0, form, plate: 0.0 };
        assert_eq!(grown_layer(Seed(3), 25, &none, &Parameters::ASSUMED).count(), 6 * 25 + 1);
    }

    /// Mean of 8 seeds at the slowing and widening of a dendrite.
    #[test]
    fn fill_rises_with_p1() {
        let mut before = 0.0;
        for p1 in [0.0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0] {
            let vigour = Vigour { branching: p1, form: Parameters::ASSUMED.dendrite, plate: 0.15 };
            let fill = (0..8)
                .map(|k| layer_fill(&grown_layer(Seed(k), 60, &vigour, &Parameters::ASSUMED), 60))
                .sum::<f64>()
                / 8.0;
            assert!(fill > before, "{p1}: {fill} after {before}");
            before = fill;
        }
    }

    #[test]
    fn the_nearer_to_plate_the_likelier_it_branches() {
        let branching = Branching::new(&Parameters::ASSUMED).unwrap();
        let p1 = |fill| branching.vigour(fill).branching;
        // It reaches 1 where fans begin, and from there on the sector widens.
        let rising = [0.03, 0.1, 0.15, 0.2, 0.25, 0.3];
        assert!(rising.windows(2).all(|pair| p1(pair[0]) < p1(pair[1])), "{branching:?}");
        assert!((5..=16).all(|node| p1(f64::from(node) / 16.0) == 1.0));
        let sector = |fill| branching.vigour(fill).form.sector;
        assert!([0.32, 0.4, 0.5, 0.6, 0.7, 0.8].windows(2).all(|pair| sector(pair[0]) < sector(pair[1])));
        assert_eq!(sector(0.85), 1.0);
    }
}
