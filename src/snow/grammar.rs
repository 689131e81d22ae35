//! Eq. (3) to (6) and (10) as an L-system, in both readings of the brackets.
//!
//! The word of one branch; [`branch`] draws it, and by Eq. (10) a layer is six of them. Crystals do not grow from these
//! words, since a word knows neither occupied cells nor speeds: they grow from tips that obey the same rules on the lattice.

use crate::lsystem::{LSystem, LSystemError, Production, Structure, Turtle};

use super::{Brackets, Elongation, Third};

/// The angle of a turn, degrees: Eq. (10).
pub const TURN: f64 = 60.0;

/// Eq. (4) with probability p1, and with the rest of it Eq. (5), or, where lengths are linear, a tip that goes one segment
/// on. Symbols: `F` a segment, `A` the tip of a branch under [`Elongation::Linear`], `f` a segment that is not drawn.
///
/// As printed one of the three alternatives is taken, or none, each as likely as the others; with push and pop one of
/// them, together with its mirror image.
///
/// # Errors
///
/// A p1 that is not 0 to 1.
pub fn system(
    brackets: Brackets,
    third: Third,
    elongation: Elongation,
    p1: f64,
) -> Result<LSystem, LSystemError> {
    if !(0.0..=1.0).contains(&p1) {
        return Err(LSystemError::OutOfRange { name: "p1", value: p1, accepted: "0 to 1" });
    }
    let (tip, on) = match elongation {
        Elongation::Doubling => ("F", "FF"),
        Elongation::Linear => ("A", "FA"),
    };
    // The rule's last F is the branch itself, which goes on.
    let last = if elongation == Elongation::Doubling { "F" } else { "FA" };
    let alternatives = ["+", "f+", if third == Third::AsPrinted { "f++" } else { "f-" }];
    let branched: Vec<String> = match brackets {
        // Zero or one of the alternatives; what was in brackets is then part of the chain.
        Brackets::AsPrinted => {
            let taken = alternatives.iter().map(|alternative| format!("{alternative}{tip}{last}"));
            taken.chain([last.to_owned()]).collect()
        }
        Brackets::PushPop => {
            let swapped = |word: &str| word.replace('+', "*").replace('-', "+").replace('*', "-");
            let pair = |word: &&str| format!("[{word}{tip}][{}{tip}]{last}", swapped(word));
            alternatives.iter().map(pair).collect()
        }
    };
    let share = p1 / branched.len() as f64;
    let from = if elongation == Elongation::Doubling { 'F' } else { 'A' };
    let mut productions: Vec<Production> =
        branched.into_iter().map(|to| Production { from, to, weight: share }).collect();
    productions.push(Production { from, to: on.to_owned(), weight: 1.0 - p1 });
    // A weight of 0 is none.
    productions.retain(|production| production.weight > 0.0);
    LSystem::new(tip, productions)
}

/// Draws the word of a branch; a segment is one unit long. A tip of no length is not drawn.
///
/// # Errors
///
/// A word without a segment.
pub fn branch(word: &str) -> Result<Structure, LSystemError> {
    let (draws, moves) = ("F".to_owned(), "f".to_owned());
    Turtle { angle: TURN, step: 1.0, width: 1.0, thinner: 1.0, draws, moves }.draw(word)
}

/// Nodes from which more than one segment begins: the joints of Fig. 4.
pub fn joints(drawn: &Structure) -> usize {
    let mut begins = vec![0_u32; drawn.nodes.len()];
    drawn.nodes.iter().filter_map(|node| node.parent).for_each(|parent| begins[parent] += 1);
    begins.iter().filter(|begun| **begun > 1).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::Reading;
    use crate::rng::Seed;

    /// As printed the rule makes a chain, whatever p1 and the third alternative: no node has two segments, and no bracket
    /// is opened.
    #[test]
    fn as_printed_it_turns_and_never_branches() {
        for third in Third::ALL {
            for elongation in Elongation::ALL {
                for p1 in [0.3, 1.0] {
                    let system = system(Brackets::AsPrinted, *third, *elongation, p1).unwrap();
                    for seed in 0..10 {
                        let word = system.derive(6, Seed(seed)).unwrap();
                        assert!(!word.contains('['));
                        assert_eq!(joints(&branch(&word).unwrap()), 0, "{word}");
                    }
                }
            }
        }
        let word = system(Brackets::AsPrinted, Third::AsPrinted, Elongation::Linear, 1.0)
            .unwrap()
            .derive(8, Seed(1))
            .unwrap();
        assert!(word.contains('+'), "it turns: {word}");
    }

    /// With p1 = 1 a tip becomes three in each step, and every segment but the last ends in a joint: 3^n tips that have
    /// grown by (3^n - 1) / 2 segments, by counting.
    #[test]
    fn with_push_and_pop_it_branches_in_mirrored_pairs() {
        let system = system(Brackets::PushPop, Third::Mirrored, Elongation::Linear, 1.0).unwrap();
        for steps in 1..=5_u32 {
            let word = system.derive(steps, Seed(1)).unwrap();
            assert_eq!(word.matches('A').count(), 3_usize.pow(steps));
            assert_eq!(word.matches('F').count(), (3_usize.pow(steps) - 1) / 2);
            assert_eq!(word.matches('+').count(), word.matches('-').count());
        }
        let drawn = branch(&system.derive(4, Seed(1)).unwrap()).unwrap();
        assert!(joints(&drawn) > 0);
        let mirrored = |x: f64| drawn.nodes.iter().any(|node| (node.place.x + x).abs() < 1e-12);
        assert!(drawn.nodes.iter().all(|node| mirrored(node.place.x)));
    }

    /// Eq. (5) doubles, Eq. (6) with a constant dl adds one.
    #[test]
    fn doubling_is_not_linear() {
        for (elongation, length) in [(Elongation::Doubling, 64), (Elongation::Linear, 6)] {
            let system = system(Brackets::PushPop, Third::Mirrored, elongation, 0.0).unwrap();
            let word = system.derive(6, Seed(1)).unwrap();
            assert_eq!(word.matches('F').count(), length);
        }
    }

    #[test]
    fn a_p1_that_is_none_is_refused() {
        for p1 in [-0.1, 1.1, f64::NAN] {
            assert!(system(Brackets::PushPop, Third::Mirrored, Elongation::Linear, p1).is_err());
        }
    }
}
