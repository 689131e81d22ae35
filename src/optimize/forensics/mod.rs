//! Which rule for the derivative can have produced a printed search.
//!
//! Where a search is x_{i+1} = x_i − η f′(x_i) with a known η, two printed iterates give the derivative that was used
//! between them. The printed digits make it an interval, whose ends are exact fractions:
//!
//! ```text
//! s_i = −(x_{i+1} − x_i)/η,   x_i in x̄_i ± half a unit of its last place,   f_i = (y_i − target)²
//! ```
//!
//! A [`Hypothesis`] is a [`Rule`] for s_i and the way in which y was printed. It is refuted where its interval and the
//! implied one share no number; that is a proof, and no double takes part in it. That it survives proves nothing: see
//! [`PrintedSearch::scrambled`] for how much it is worth.
//!
//! | file | holds |
//! |---|---|
//! | `exact.rs` | fractions and intervals |
//! | `printed.rs` | a table of iterates, and what its digits say |
//! | `rules.rs` | the hypotheses |
//! | `examine.rs` | a hypothesis against a table |
//! | `one_h.rs` | differences of whole numbers over one h |
//! | `parts.rs` | the real y of a secant: where it was, and whether it counts parts of its unit |

mod exact;
mod examine;
mod one_h;
mod parts;
mod printed;
mod rules;
#[cfg(test)]
mod tests;

pub use exact::{Ratio, Span};
pub use examine::{Examined, Verdict, examine};
pub use one_h::{Differences, shared_by};
pub use parts::{f_of_secants, parts_that_fit};
pub use printed::{Decimal, ForensicsError, PrintedSearch, Printing};
pub use rules::{Hypothesis, Rule, Side};
