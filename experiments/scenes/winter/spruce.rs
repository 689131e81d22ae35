//! Spruces: whorls of boughs around a trunk, each a frond, sagging and with hanging shoots.

use std::f64::consts::TAU;

use snowglobe::rng::Seed;

use super::air;
use super::canvas::{Sheaf, Stroke, stroke};
use super::frond::{Fronds, Twig};
use super::ground::SNOW;
use super::tufts::{SPRAYED, cushions, spray};
use super::view::View;

/// Half the width of a shoot with its needles, m.
const NEEDLES: f64 = 0.021;
/// Radiance of needles under the open sky.
const GREEN: [f64; 3] = [0.029, 0.039, 0.034];
/// Of bark.
const BARK: [f64; 3] = [0.050, 0.043, 0.039];

/// A bough of a spruce.
#[derive(Clone, Copy, Debug)]
struct Bough {
    /// Where it leaves the trunk, m over the foot.
    height: f64,
    /// Its direction: cosine and sine, in x and z.
    way: [f64; 2],
    length: f64,
    /// How it rises from the trunk, and how it sags.
    rise: f64,
    sag: f64,
    kind: usize,
    /// Where along it snow begins, in parts of a turn.
    patch: f64,
    /// The share of it on which snow lies.
    snow: f64,
    /// The share of the sky's light that its root and its tip get.
    light: [f64; 2],
}

/// A spruce.
#[derive(Clone, Debug)]
pub struct Spruce {
    /// Where it stands, with the eye in the origin, m.
    pub foot: [f64; 3],
    /// m.
    pub height: f64,
    /// Of the crown at its widest, m.
    pub radius: f64,
    /// Its needles under the open sky.
    green: [f64; 3],
    boughs: Vec<Bough>,
}

impl Spruce {
    /// A tree of a height; `bare` is the share of it without boughs, `snow` the share of snow on the others.
    pub fn new(number: u64, foot: [f64; 3], height: f64, bare: f64, snow: f64, seed: Seed) -> Self {
        let dice = seed.stream("winter: boughs").at(number);
        let mut of_tree = dice.place(-1, 0, 0);
        let radius = (0.35 + 0.155 * height) * (0.85 + 0.3 * of_tree.uniform());
        let slim = 0.75 + 0.25 * of_tree.uniform();
        let (pale, warm) = (0.72 + 0.62 * of_tree.uniform(), 0.20 * (of_tree.uniform() - 0.25));
        let green = [pale * (1.0 + warm), pale, pale * (1.0 - warm)];
        let green = [0, 1, 2].map(|k| GREEN[k] * green[k]);
        let between = 0.17 + 0.014 * height;
        let mut boughs = Vec::new();
        let (mut at, mut whorl) = (bare * height + 0.1 * between, 0);
        while at < height - 0.12 {
            let share = at / height;
            let mut of_whorl = dice.place(whorl, 0, 0);
            let count = if share > 0.9 { 4 } else { 5 + (of_whorl.uniform() * 2.0) as i32 };
            let turn = of_whorl.uniform();
            let full = radius * libm::pow(1.0 - share, slim) * (0.8 + 0.2 * (share / 0.12).min(1.0));
            for k in 1..=count {
                let mut of_bough = dice.place(whorl, k, 0);
                let mut random = || of_bough.uniform();
                let angle = TAU * (turn + (f64::from(k) + 0.55 * (random() - 0.5)) / f64::from(count));
                let (sine, cosine) = libm::sincos(angle);
                let length = (full * (0.72 + 0.42 * random())).max(0.10);
                let young = libm::pow(share, 1.6);
                boughs.push(Bough {
                    height: at + between * (random() - 0.5),
                    way: [cosine, sine],
                    length,
                    rise: -0.32 + 1.25 * young + 0.22 * (random() - 0.5),
                    sag: 0.32 * (1.0 - 0.7 * share) * (0.6 + 0.8 * random()),
                    kind: (3.0 * random()) as usize,
                    patch: random(),
                    snow: (snow * (0.35 + 1.3 * random()) * (0.75 + 0.5 * share)).min(0.95),
                    light: [0.12 + 0.25 * share, (0.72 + 0.55 * share) * (0.75 + 0.5 * random())],
                });
            }
            at += between * (0.75 + 0.5 * of_whorl.uniform()) * (1.0 - 0.35 * share);
            whorl += 1;
        }
        // The farthest first.
        boughs.sort_by(|a, b| (b.way[1] * b.length).total_cmp(&(a.way[1] * a.length)));
        Self { foot, height, radius, green, boughs }
    }

    /// Two corners of the picture between which it is.
    pub fn frame(&self, view: &View) -> ([f64; 2], [f64; 2]) {
        let [x, y, z] = self.foot;
        let near = (z - self.radius).max(0.5);
        let corner = |side: f64, up: f64| view.seen([x + side * 1.3 * self.radius, y + up, near]).0;
        let ([left, top], [right, bottom]) = (corner(-1.0, 1.05 * self.height), corner(1.0, -0.8));
        let (far, _) = view.seen([x, y + 1.05 * self.height, z + self.radius]);
        ([left.min(far[0]), top.min(far[1])], [right.max(far[0]), bottom.max(far[1])])
    }

    /// Its strokes, the farthest first.
    pub fn strokes(&self, fronds: &Fronds, view: &View) -> Sheaf {
        let mut sheaf = Sheaf::new(view);
        let middle = [self.foot[0], self.foot[1] + 0.5 * self.height, self.foot[2]];
        if !view.sees(middle, 0.5 * self.height + self.radius) {
            return sheaf;
        }
        let mut trunk = Some(self.trunk(view));
        for bough in &self.boughs {
            if bough.way[1] < 0.0 {
                trunk.take().into_iter().for_each(|stroke| sheaf.lay(stroke));
            }
            let reach = 0.5 * bough.length;
            let centre = bough.place(self.foot, [0.5, 0.0], 0.0);
            if view.sees(centre, 1.6 * reach + 0.2) {
                bough.lay(self, fronds, view, &mut sheaf);
            }
        }
        sheaf
    }

    fn trunk(&self, view: &View) -> Stroke {
        let [x, y, z] = self.foot;
        let (from, scale) = view.seen([x, y - 0.2, z]);
        let (to, _) = view.seen([x, y + 0.97 * self.height, z]);
        let light = air(BARK.map(|light| 0.32 * light), z);
        let radius = [0.0085 * self.height * scale, 0.008 * scale];
        Stroke { dark: [0.5, 0.0], ..stroke([from, to], radius, light, z) }
    }
}

impl Bough {
    /// A place of its frond; what is aside hangs down.
    fn place(&self, foot: [f64; 3], [along, aside]: [f64; 2], hang: f64) -> [f64; 3] {
        let out = self.length * along;
        let side = self.length * aside;
        let rise = self.rise * along - self.sag * along * along * (1.6 - along);
        [
            foot[0] + out * self.way[0] - side * self.way[1],
            foot[1] + self.height + self.length * rise - hang * side.abs() * (0.6 + 1.3 * aside.abs()),
            foot[2] + out * self.way[1] + side * self.way[0],
        ]
    }

    fn lay(&self, tree: &Spruce, fronds: &Fronds, view: &View, sheaf: &mut Sheaf) {
        let foot = tree.foot;
        let frond = fronds.of(self.length, self.kind);
        let depth = foot[2] + 0.5 * self.length * self.way[1];
        let (_, scale) = view.seen([0.0, 0.0, depth]);
        // Shoots that no pixel shows make their twig wide and thin instead.
        let far = NEEDLES * scale < 0.30;
        let away = self.way[1] > 0.0;
        let count = frond.twigs.len();
        let ordered = (0..count).map(|k| &frond.twigs[if away { count - 1 - k } else { k }]);
        let hang = |twig: &Twig| [0.45, 0.75][usize::from(twig.level == 2)] + 0.5 * twig.shared;
        let ends = |twig: &Twig, lift: f64| {
            twig.ends.map(|end| {
                let mut place = self.place(foot, end, hang(twig));
                place[1] += lift;
                view.seen(place).0
            })
        };
        let seen = |twig: &&Twig| !(far && twig.level == 2);
        for twig in ordered.clone().filter(seen) {
            let share = twig.ends[1][0] * twig.ends[1][0];
            let lit = self.light[0] + (self.light[1] - self.light[0]) * share;
            // What hangs is under what does not.
            let hangs = 1.0 - 1.3 * twig.ends[1][1].abs().min(0.4);
            let tone = lit * hangs * (0.60 + 0.8 * twig.own);
            let light = air(tree.green.map(|light| light * tone), depth);
            let wide = if far && twig.level == 1 { 3.4 * NEEDLES } else { NEEDLES * (0.8 + 0.5 * twig.own) };
            let mut laid = stroke(ends(twig, 0.0), [wide * scale, 0.8 * wide * scale], light, depth);
            laid.soft = 0.7;
            laid.dark = [0.0, 0.35];
            laid.opacity = if far { 0.75 } else { 0.93 };
            if NEEDLES * scale > SPRAYED {
                spray(laid, twig.own, sheaf);
            } else {
                sheaf.lay(laid);
            }
        }
        for twig in ordered.filter(seen) {
            // Where snow has not slid off it lies on all that grows there.
            let [along, aside] = twig.ends[0];
            let kept = libm::sin(
                TAU * (self.patch + 0.75 * self.length * along + 0.3 * aside.signum() * aside.abs().sqrt()),
            );
            let lies =
                0.5 - 0.42 * kept + 0.22 * (twig.own - 0.5) + 0.16 * (twig.shared - 0.5) + 0.5 * aside.abs();
            if lies > self.snow || along < 0.06 {
                continue;
            }
            let share = twig.ends[1][0];
            let lit = (self.light[0] + (self.light[1] - self.light[0]) * share * share).min(1.0);
            let tone = f64::from(SNOW) * (0.16 + 0.72 * lit) * (0.80 + 0.3 * twig.own);
            let light = air([0.90 * tone, 0.97 * tone, 1.06 * tone], depth);
            // Much snow lies in lumps, little as dust on shoots.
            let lump = [0.042, 0.034, 0.024][twig.level] * (0.4 + 1.3 * (self.snow - lies)).min(1.0);
            let mut laid = stroke(ends(twig, 0.7 * lump), [lump * scale; 2], light, depth);
            laid.soft = 0.6;
            laid.dark = [0.0, 0.6];
            laid.opacity = 0.95;
            cushions(laid, twig.own, sheaf);
        }
    }
}
