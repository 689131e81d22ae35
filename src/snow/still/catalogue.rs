//! Flakes of all sizes to choose from, and the crystals that they are made of.

use crate::rng::Seed;

use super::super::flake::{Assembly, Flake, Joining, Template};
use super::super::{
    Air, Axes, Branching, Crystal, Cubes, History, Layers, Over, Parameters, SnowError, within,
};
use super::Body;

/// Flakes among which one is chosen by chance, those of the most like diameter.
const LIKE: usize = 6;
/// Minutes that crystals of a catalogue have grown for.
const MINUTES: [f64; 2] = [10.0, 28.0];
/// The widest that they may become, m: what is larger takes minutes to grow and to join, and is not observed.
const WIDEST: f64 = 10e-3;
/// Half the range of their temperatures, C.
const SPREAD: f64 = 1.0;

/// Crystals that have grown in much the same air, `count` of them: for 10 to 28 minutes, within a degree of `temperature`, C, at a
/// supersaturation over ice or water, as a share.
///
/// # Errors
///
/// Air in which nothing can be grown, see [`Crystal::grow`], or crystals of more than a centimetre; none, or more than 1000.
pub fn crystals_in(
    temperature: f64,
    supersaturation: f64,
    over: Over,
    count: usize,
    branching: &Branching,
    seed: Seed,
) -> Result<Vec<Crystal>, SnowError> {
    within("the number of crystals", count as f64, 1.0, 1000.0)?;
    within("the temperature, C,", temperature, -60.0, 0.0)?;
    let stream = seed.stream("crystals of flakes");
    let grown = |number: usize| {
        let mut chance = stream.at(number as u64).place(0, 0, 0);
        let minutes = MINUTES[0] + (MINUTES[1] - MINUTES[0]) * chance.uniform();
        let temperature = (temperature + SPREAD * (2.0 * chance.uniform() - 1.0)).clamp(-60.0, 0.0);
        let history = History::constant(temperature, supersaturation, over, minutes)?;
        let Parameters { pressure, ventilation, seed_radius, .. } = *branching.parameters();
        let (_, supersaturation) = history.at(0.0);
        let air = Air { temperature, supersaturation, pressure, ventilation };
        air.check()?;
        let axes = Axes::sphere(seed_radius).grown(&air, 60.0 * minutes);
        within("the width of the crystals of this air, m,", 2.0 * axes.a.max(axes.c), 0.0, WIDEST)?;
        Crystal::grow(&history, branching, Layers::Dense, Seed(seed.0.wrapping_add(number as u64)))
    };
    use rayon::prelude::*;
    (0..count).into_par_iter().map(grown).collect()
}

/// Flakes of all sizes.
#[derive(Clone, Debug)]
pub struct Catalogue {
    crystals: Vec<Template>,
    flakes: Vec<Flake>,
    bodies: Vec<Body>,
    diameters: Vec<f64>,
}

impl Catalogue {
    /// Assembles a flake for each of `numbers`, of so many crystals that are drawn from those given, and makes them visible at
    /// `extinction`, tau in 1/m.
    ///
    /// # Errors
    ///
    /// No crystals, no numbers, or what [`Flake::assemble`] and [`Body::new`] refuse.
    pub fn assembled(
        crystals: Vec<Crystal>,
        numbers: &[usize],
        assembly: Assembly,
        joining: &Joining,
        extinction: f64,
        seed: Seed,
    ) -> Result<Self, SnowError> {
        use rayon::prelude::*;
        within("the number of crystals", crystals.len() as f64, 1.0, 1e6)?;
        within("the number of flakes", numbers.len() as f64, 1.0, 1e6)?;
        let crystals: Vec<Template> = crystals.into_par_iter().map(Template::new).collect();
        // Elements of turned crystals lie on no grid: three times as fine they leave no pinholes.
        let cubes = crystals.par_iter().map(|template| Cubes::new(template.crystal(), FINER));
        let cubes = cubes.collect::<Result<Vec<_>, _>>()?;
        let stream = seed.stream("crystals of each flake");
        let made = numbers.par_iter().enumerate().map(|(flake, number)| {
            let mut chance = stream.at(flake as u64).place(0, 0, 0);
            let chosen: Vec<usize> =
                (0..*number).map(|_| (chance.uniform() * crystals.len() as f64) as usize).collect();
            let seed = Seed(seed.0.wrapping_add(flake as u64));
            let flake = Flake::assemble(&crystals, &chosen, assembly, joining, seed)?;
            let body = Body::true_to(&flake, &crystals, &cubes, FINER, extinction)?;
            let diameter = flake.diameter(&crystals);
            Ok((flake, body, diameter))
        });
        let made = made.collect::<Result<Vec<_>, SnowError>>()?;
        let (mut flakes, mut bodies, mut diameters) = (Vec::new(), Vec::new(), Vec::new());
        for (flake, body, diameter) in made {
            flakes.push(flake);
            bodies.push(body);
            diameters.push(diameter);
        }
        Ok(Self { crystals, flakes, bodies, diameters })
    }

    /// The crystals.
    pub fn crystals(&self) -> &[Template] {
        &self.crystals
    }

    /// The flakes.
    pub fn flakes(&self) -> &[Flake] {
        &self.flakes
    }

    /// What the flakes look like.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Diameters of the flakes, m, see [`Flake::diameter`].
    pub fn diameters(&self) -> &[f64] {
        &self.diameters
    }

    /// A flake for a diameter in m, one of the most like in size, by a number from 0 to 1; and how many times as large it must
    /// be drawn.
    pub fn choose(&self, diameter: f64, number: f64) -> (usize, f64) {
        // As far off are half as large and twice as large.
        let off = |(flake, own): (usize, &f64)| ((own / diameter).max(diameter / own), flake);
        let mut order: Vec<(f64, usize)> = self.diameters.iter().enumerate().map(off).collect();
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let like = LIKE.min(order.len());
        let (_, chosen) = order[((number * like as f64) as usize).min(like - 1)];
        (chosen, diameter / self.diameters[chosen])
    }
}

/// Cubes along an element.
const FINER: u32 = 3;

#[cfg(test)]
mod tests {
    use super::*;

    fn catalogue(seed: u64) -> Catalogue {
        let branching = Branching::new(&Parameters { element: 40e-6, ..Parameters::ASSUMED }).unwrap();
        let crystals = crystals_in(-15.0, 0.16, Over::Ice, 3, &branching, Seed(seed)).unwrap();
        Catalogue::assembled(
            crystals,
            &[1, 1, 2, 3, 5],
            Assembly::OneByOne,
            &Joining::assumed(),
            1e5,
            Seed(seed),
        )
        .unwrap()
    }

    #[test]
    fn flakes_of_more_crystals_are_larger_and_chosen_for_larger_diameters() {
        let catalogue = catalogue(1);
        assert_eq!(catalogue.flakes().iter().map(|f| f.members.len()).collect::<Vec<_>>(), [1, 1, 2, 3, 5]);
        let diameters = catalogue.diameters();
        assert!(diameters[4] > diameters[0].max(diameters[1]));
        for (diameter, number) in [(1e-3, 0.0), (4e-3, 0.0), (2e-3, 0.999)] {
            let (flake, scale) = catalogue.choose(diameter, number);
            assert!((scale * diameters[flake] / diameter - 1.0).abs() < 1e-12);
        }
        let off = |flake: usize| libm::log(diameters[flake] / 4e-3).abs();
        let (best, _) = catalogue.choose(4e-3, 0.0);
        assert!((0..5).all(|other| off(best) <= off(other)));
    }

    #[test]
    fn the_same_seed_assembles_the_same() {
        let [a, b, c] = [1, 1, 2].map(catalogue);
        assert_eq!(a.flakes(), b.flakes());
        assert_ne!(a.flakes(), c.flakes());
    }

    /// At -3 C and 40 % over ice, ten times saturation over water, crystals would be centimetres wide.
    #[test]
    fn air_that_makes_giants_is_refused() {
        let branching = Branching::new(&Parameters { element: 40e-6, ..Parameters::ASSUMED }).unwrap();
        let giants = crystals_in(-3.0, 0.4, Over::Ice, 3, &branching, Seed(1));
        assert!(giants.unwrap_err().to_string().contains("the width of the crystals"));
    }

    #[test]
    fn nothing_to_make_flakes_of_is_refused() {
        let none = Catalogue::assembled(vec![], &[1], Assembly::OneByOne, &Joining::assumed(), 1e5, Seed(1));
        assert_eq!(none.unwrap_err().to_string().lines().count(), 1);
    }
}
