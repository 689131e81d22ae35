//! Fronds: the flat boughs of spruces, which an L-system grows.

use snowglobe::lab::{Error, Result};
use snowglobe::lsystem::{LSystem, LSystemError, Production, Turtle};
use snowglobe::rng::Seed;

/// A segment of a frond, in lengths of the frond.
#[derive(Clone, Copy, Debug)]
pub struct Twig {
    /// Along the frond and aside, at both ends.
    pub ends: [[f64; 2]; 2],
    /// 0 on the axis, 1 on a twig, 2 a shoot of one.
    pub level: usize,
    /// Random: of itself, and of all that grows from the same place of the axis.
    pub own: f64,
    pub shared: f64,
}

/// A flat bough.
#[derive(Clone, Debug)]
pub struct Frond {
    /// As they grew: each comes after what it grows from.
    pub twigs: Vec<Twig>,
}

/// Internodes of the least and the greatest frond.
const SIZES: [u32; 2] = [3, 13];
/// Fronds of each size.
const KINDS: usize = 3;
/// Length of an internode, m.
const INTERNODE: f64 = 0.19;
/// All fronds that there are.
#[derive(Clone, Debug)]
pub struct Fronds(Vec<Frond>);

impl Fronds {
    /// Grows them.
    pub fn new(seed: Seed) -> Result<Self> {
        let system = frond().map_err(broken)?;
        let (draws, moves) = ("FG".to_owned(), String::new());
        let turtle = Turtle { angle: 47.0, step: 1.0, width: 1.0, thinner: 1.0, draws, moves };
        let stream = seed.stream("winter: twigs");
        let mut all = Vec::new();
        for size in SIZES[0]..=SIZES[1] {
            for kind in 0..KINDS {
                let number = all.len() as u64;
                let dice = stream.at(number);
                // A seed of its own, or all would begin alike.
                let word =
                    system.derive(size, Seed(dice.place(-1, 0, kind as i32).next_u64())).map_err(broken)?;
                let drawn = turtle.draw(&word).map_err(broken)?;
                let scale = 1.0 / drawn.height();
                let mut axis = vec![0; drawn.nodes.len()];
                let mut twigs = Vec::new();
                for (k, node) in drawn.nodes.iter().enumerate() {
                    let Some(parent) = node.parent else { continue };
                    axis[k] = if node.depth == 0 { k } else { axis[parent] };
                    let side = i32::from(node.place.x > 0.0);
                    let place = |k: usize| {
                        let mut moved = dice.place(k as i32, 3, 0);
                        let mut off =
                            || 0.55 * (moved.uniform() - 0.5) * f64::from(u8::from(drawn.nodes[k].depth > 0));
                        let [along, aside] = [drawn.nodes[k].place.y + off(), drawn.nodes[k].place.x + off()];
                        // Twigs bend forward.
                        let out = aside.abs() * scale;
                        [along * scale + 0.5 * out * out, aside * scale * (1.0 - 0.45 * out)]
                    };
                    twigs.push(Twig {
                        ends: [place(parent), place(k)],
                        level: node.depth.min(2),
                        own: dice.place(k as i32, 0, 0).uniform(),
                        shared: dice.place(axis[k] as i32, 1 + side, 0).uniform(),
                    });
                }
                all.push(Frond { twigs });
            }
        }
        Ok(Self(all))
    }

    /// A frond of about a length, m.
    pub fn of(&self, length: f64, kind: usize) -> &Frond {
        let size = libm::round(length / INTERNODE).clamp(f64::from(SIZES[0]), f64::from(SIZES[1])) as usize;
        &self.0[(size - SIZES[0] as usize) * KINDS + kind % KINDS]
    }
}

/// The axis grows by an internode a step and has a twig on either side; twigs grow half as fast and have shoots.
fn frond() -> std::result::Result<LSystem, LSystemError> {
    let rule = |from, to: &str, weight| Production { from, to: to.to_owned(), weight };
    LSystem::new(
        "FA",
        vec![
            rule('A', "F[+B][-B]A", 0.8),
            rule('A', "F[+B]A", 0.1),
            rule('A', "F[-B]A", 0.1),
            rule('B', "F[+G][-G]C", 0.7),
            rule('B', "F[+G]C", 0.12),
            rule('B', "F[-G]C", 0.12),
            rule('B', "F", 0.06),
            rule('C', "B", 0.85),
            rule('C', "F[+G][-G]C", 0.15),
        ],
    )
}

fn broken(cause: LSystemError) -> Error {
    Error::broken(cause.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fronds_grow_with_their_length_and_taper() {
        let fronds = Fronds::new(Seed(1)).unwrap();
        let [small, great] = [0.5, 2.4].map(|length| fronds.of(length, 1));
        assert!(small.twigs.len() > 5 && great.twigs.len() > 8 * small.twigs.len());
        let wide = |from: f64, to: f64| {
            let within =
                great.twigs.iter().map(|twig| twig.ends[1]).filter(|end| end[0] > from && end[0] < to);
            within.map(|end| end[1].abs()).fold(0.0, f64::max)
        };
        assert!(wide(0.2, 0.7) > 0.1 && wide(0.2, 0.7) > 1.5 * wide(0.96, 1.01));
    }
}
