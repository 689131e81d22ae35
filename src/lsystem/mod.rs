//! Lindenmayer systems: an axiom, productions, a derivation, and a turtle that draws the word.
//!
//! Prusinkiewicz & Lindenmayer 1990, *The Algorithmic Beauty of Plants* (ABOP), chapter 1: deterministic, bracketed and
//! stochastic systems without context.
//!
//! | to | open |
//! |---|---|
//! | rewrite a word | [`LSystem`] |
//! | draw it, in the plane or in space | [`Turtle`] |
//! | ask what was drawn | [`Structure`] |
//! | read a system from a file | [`Spec`] |

mod spec;
mod structure;
#[cfg(test)]
mod tests;
mod turtle;

pub use spec::Spec;
pub use structure::{Node, Structure};
pub use turtle::Turtle;

use crate::rng::Seed;

/// The longest word that is handled, in symbols.
pub const MOST_SYMBOLS: usize = 4 << 20;

/// The most steps that are taken.
const MOST_STEPS: u32 = 10_000;

/// A production: what a symbol is replaced by.
#[derive(Clone, Debug, PartialEq)]
pub struct Production {
    /// The symbol.
    pub from: char,
    /// The word that takes its place.
    pub to: String,
    /// How likely it is among the productions of the same symbol, as a weight above 0.
    pub weight: f64,
}

/// Why there is no word, or no drawing of it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LSystemError {
    /// There is nothing to begin with.
    #[error("the axiom is empty; at least one symbol is needed")]
    NoAxiom,
    /// A word has a blank in it.
    #[error("the word `{0}` has a blank in it; symbols only are accepted")]
    Blank(String),
    /// Brackets do not pair.
    #[error("the brackets of `{0}` do not pair; each [ needs its ]")]
    Brackets(String),
    /// A bracket is rewritten.
    #[error("`{0}` cannot be rewritten: a production of a bracket would unbalance the word")]
    BracketRewritten(char),
    /// A weight cannot be one.
    #[error("the weight of `{from}` -> `{to}` is {weight}; above 0 and finite is accepted")]
    Weight {
        /// The symbol.
        from: char,
        /// Its word.
        to: String,
        /// The weight.
        weight: f64,
    },
    /// The word grows too long.
    #[error("after {step} steps the word has {length} symbols; up to {most} are handled", most = MOST_SYMBOLS)]
    TooLong {
        /// Which step, counted from 1.
        step: u32,
        /// Its length.
        length: usize,
    },
    /// A number of the turtle cannot be used.
    #[error("{name} is {value}; {accepted} is accepted")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would be.
        accepted: &'static str,
    },
    /// The word draws nothing.
    #[error("the word draws no segment; symbols that draw are `{draws}`")]
    NothingDrawn {
        /// Those symbols.
        draws: String,
    },
}

/// An axiom and its productions.
#[derive(Clone, Debug, PartialEq)]
pub struct LSystem {
    axiom: String,
    productions: Vec<Production>,
}

impl LSystem {
    /// A symbol without production stays as it is; several of one symbol are drawn from by their weights.
    ///
    /// # Errors
    ///
    /// No axiom, blanks, brackets that do not pair, a weight that is none.
    pub fn new(axiom: &str, productions: Vec<Production>) -> Result<Self, LSystemError> {
        if axiom.is_empty() {
            return Err(LSystemError::NoAxiom);
        }
        for word in std::iter::once(axiom).chain(productions.iter().map(|p| p.to.as_str())) {
            if word.chars().any(char::is_whitespace) {
                return Err(LSystemError::Blank(word.to_owned()));
            }
            if !is_balanced(word) {
                return Err(LSystemError::Brackets(word.to_owned()));
            }
        }
        for Production { from, to, weight } in &productions {
            if matches!(from, '[' | ']') || from.is_whitespace() {
                return Err(LSystemError::BracketRewritten(*from));
            }
            if !(weight.is_finite() && *weight > 0.0) {
                return Err(LSystemError::Weight { from: *from, to: to.clone(), weight: *weight });
            }
        }
        Ok(Self { axiom: axiom.to_owned(), productions })
    }

    /// One production, which is always taken.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn simple(axiom: &str, from: char, to: &str) -> Result<Self, LSystemError> {
        Self::new(axiom, vec![Production { from, to: to.to_owned(), weight: 1.0 }])
    }

    /// The word after so many steps, in each of which all symbols are replaced at once. A choice is drawn for its step
    /// and the symbol's place in the word, so that it depends on no other choice.
    ///
    /// # Errors
    ///
    /// A word that would be too long, before it is made.
    pub fn derive(&self, steps: u32, seed: Seed) -> Result<String, LSystemError> {
        if steps > MOST_STEPS {
            let (name, value) = ("the number of steps", f64::from(steps));
            return Err(LSystemError::OutOfRange { name, value, accepted: "up to 10000" });
        }
        let stream = seed.stream("lsystem");
        let mut word = self.axiom.clone();
        for step in 1..=steps {
            let mut draws = None;
            let chosen: Vec<(char, Option<&str>)> = word
                .chars()
                .enumerate()
                .map(|(place, symbol)| {
                    let number = || {
                        let moment = draws.get_or_insert_with(|| stream.at(u64::from(step)));
                        moment.place(place as i32, 0, 0).uniform()
                    };
                    (symbol, self.choose(symbol, number))
                })
                .collect();
            let length = chosen.iter().map(|(_, to)| to.map_or(1, str::len)).sum();
            if length > MOST_SYMBOLS {
                return Err(LSystemError::TooLong { step, length });
            }
            let mut next = String::with_capacity(length);
            for (symbol, to) in chosen {
                match to {
                    Some(to) => next.push_str(to),
                    None => next.push(symbol),
                }
            }
            word = next;
        }
        Ok(word)
    }

    fn choose(&self, symbol: char, number: impl FnOnce() -> f64) -> Option<&str> {
        let mut of_symbol = self.productions.iter().filter(|p| p.from == symbol);
        let first = of_symbol.next()?;
        if of_symbol.next().is_none() {
            return Some(&first.to);
        }
        let of_symbol = || self.productions.iter().filter(|p| p.from == symbol);
        let mut left = number() * of_symbol().map(|p| p.weight).sum::<f64>();
        for production in of_symbol() {
            left -= production.weight;
            if left < 0.0 {
                return Some(&production.to);
            }
        }
        of_symbol().next_back().map(|p| p.to.as_str())
    }
}

fn is_balanced(word: &str) -> bool {
    let mut open = 0_i64;
    for symbol in word.chars() {
        open += match symbol {
            '[' => 1,
            ']' => -1,
            _ => 0,
        };
        if open < 0 {
            return false;
        }
    }
    open == 0
}
