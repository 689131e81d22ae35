//! A system and its turtle as a file has them.

use serde::Deserialize;

use super::{LSystem, LSystemError, Production, Turtle};

/// What a TOML file says of a system: axiom, productions, the turtle's angle, and how often it is rewritten.
///
/// ```toml
/// axiom = "F"
/// steps = 2
/// angle = 20
/// productions = [{ from = "F", to = "F[+F]F[-F][F]" }]
/// ```
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spec {
    /// The word to begin with.
    pub axiom: String,
    /// The productions.
    pub productions: Vec<Rule>,
    /// How often they are applied.
    pub steps: u32,
    /// The turtle's angle, degrees.
    pub angle: f64,
    /// Symbols that draw.
    #[serde(default = "draws")]
    pub draws: String,
    /// Symbols that move without drawing.
    #[serde(default = "moves")]
    pub moves: String,
}

/// One production of a file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rule {
    /// The symbol.
    pub from: char,
    /// The word that takes its place.
    pub to: String,
    /// Its weight among those of the same symbol.
    #[serde(default = "one")]
    pub weight: f64,
}

fn draws() -> String {
    "F".to_owned()
}

fn moves() -> String {
    "f".to_owned()
}

fn one() -> f64 {
    1.0
}

impl Spec {
    /// The system.
    ///
    /// # Errors
    ///
    /// As [`LSystem::new`].
    pub fn system(&self) -> Result<LSystem, LSystemError> {
        let production =
            |rule: &Rule| Production { from: rule.from, to: rule.to.clone(), weight: rule.weight };
        LSystem::new(&self.axiom, self.productions.iter().map(production).collect())
    }

    /// The turtle, whose segments are `step` m long.
    pub fn turtle(&self, step: f64) -> Turtle {
        Turtle {
            angle: self.angle,
            step,
            width: 1.0,
            thinner: 0.7,
            draws: self.draws.clone(),
            moves: self.moves.clone(),
        }
    }
}
