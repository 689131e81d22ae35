//! Who takes part: a solver with its settings.

use argmin::core::Error;

use super::oracle::Oracle;

/// What a solver works with, by which solvers are grouped in plots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Derivatives, taken as differences.
    Gradient,
    /// An interval around a minimum or a root.
    Bracket,
    /// Costs alone, without chance.
    Direct,
    /// Costs and chance.
    Random,
}

impl Family {
    /// All of them, in the order of plots.
    pub const ALL: [Self; 4] = [Self::Gradient, Self::Bracket, Self::Direct, Self::Random];

    /// `gradient`, `bracket`, `direct`, `random`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gradient => "gradient",
            Self::Bracket => "bracket",
            Self::Direct => "direct",
            Self::Random => "random",
        }
    }
}

type Solve = dyn Fn(&Oracle<'_>) -> Result<String, Error> + Send + Sync;

/// A solver with its settings: it is handed an [`Oracle`], asks, and says why it stopped.
pub struct Entrant {
    /// Its name in kebab-case, unique among the entrants.
    pub name: String,
    /// What it works with.
    pub family: Family,
    /// Its settings, for people.
    pub settings: String,
    one_dimension: bool,
    solve: Box<Solve>,
}

impl Entrant {
    /// A solver for any number of dimensions.
    ///
    /// The closure asks the oracle until it has enough or an error comes, which it passes on; the text that it returns
    /// says why it stopped.
    pub fn new(
        name: &str,
        family: Family,
        settings: &str,
        solve: impl Fn(&Oracle<'_>) -> Result<String, Error> + Send + Sync + 'static,
    ) -> Self {
        Self {
            name: name.to_owned(),
            family,
            settings: settings.to_owned(),
            one_dimension: false,
            solve: Box::new(solve),
        }
    }

    /// The same solver, for one dimension only.
    #[must_use]
    pub fn in_one_dimension(mut self) -> Self {
        self.one_dimension = true;
        self
    }

    /// Whether it can take part in so many dimensions.
    pub fn applies(&self, dimension: usize) -> bool {
        dimension == 1 || !self.one_dimension
    }

    pub(super) fn solve(&self, oracle: &Oracle<'_>) -> Result<String, Error> {
        (self.solve)(oracle)
    }
}
