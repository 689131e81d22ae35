//! Bare trees: Sakai's L-system, whose productions are drawn by chance, with snow on what lies flat enough.

use snowglobe::lab::{Error, Result};
use snowglobe::lsystem::{LSystem, Production, Turtle};
use snowglobe::rng::Seed;
use snowglobe::tree::Skeleton;

use super::air;
use super::canvas::{Sheaf, stroke};
use super::ground::SNOW;
use super::view::View;

/// How a bare tree is to be.
#[derive(Clone, Copy, Debug)]
pub struct Habit {
    /// Where it stands, with the eye in the origin, m.
    pub foot: [f64; 3],
    /// m.
    pub height: f64,
    /// Steps of the L-system.
    pub steps: u32,
    /// Half the width of the trunk and of the last twigs, m.
    pub radii: [f64; 2],
    /// Radiance of its bark under the open sky.
    pub bark: [f64; 3],
    /// Thickness of the snow, m.
    pub snow: f64,
}

/// A branch: both ends, m, and half its width there.
#[derive(Clone, Copy, Debug)]
struct Link {
    ends: [[f64; 2]; 2],
    radius: [f64; 2],
    /// Random.
    own: f64,
}

/// A tree without leaves, in the plane across the view.
#[derive(Clone, Debug)]
pub struct Bare {
    habit: Habit,
    links: Vec<Link>,
}

/// How many twigs of one thickness a branch is as thick as, by Leonardo's rule: r^2.2 adds up.
const LEONARDO: f64 = 2.2;
/// The most that a link is turned away from where the L-system has it, radians.
const CROOKED: f64 = 0.22;

impl Bare {
    /// Grows it.
    pub fn new(number: u64, habit: Habit, seed: Seed) -> Result<Self> {
        let dice = seed.stream("winter: bare trees").at(number);
        let own = Seed(dice.place(-1, 0, 0).next_u64());
        let rule = |to: &str, weight| Production { from: 'F', to: to.to_owned(), weight };
        // The paper's production, and what becomes of it where buds fail.
        let rules = vec![
            rule("F[+F]F[-F][F]", 0.46),
            rule("F[+F]F[-F]F", 0.22),
            rule("F[-F]F[+F]F", 0.22),
            rule("FF", 0.10),
        ];
        let system = LSystem::new("F", rules).map_err(|cause| Error::broken(cause.to_string()))?;
        let word = system.derive(habit.steps, own).map_err(|cause| Error::broken(cause.to_string()))?;
        let (draws, moves) = ("F".to_owned(), String::new());
        let turtle = Turtle { angle: 24.0, step: 1.0, width: 1.0, thinner: 1.0, draws, moves };
        let drawn = turtle.draw(&word).map_err(|cause| Error::broken(cause.to_string()))?.merged();
        let tree = Skeleton::new(&drawn, habit.height, habit.radii)
            .map_err(|cause| Error::broken(cause.to_string()))?;
        // Thickness from the tips down: a parent always comes before its children.
        let nodes = tree.nodes();
        let mut load = vec![0.0; nodes];
        for node in (1..nodes).rev() {
            if load[node] == 0.0 {
                load[node] = 1.0;
            }
            if let Some(parent) = tree.parent(node) {
                load[parent] += load[node];
            }
        }
        let all = load[0];
        let thick = |load: f64| {
            let share = libm::pow(load / all, 1.0 / LEONARDO);
            habit.radii[1].max(habit.radii[0] * share)
        };
        let mut place = vec![[0.0; 2]; nodes];
        let mut turned = vec![0.0; nodes];
        let mut links = Vec::new();
        for node in 1..nodes {
            let Some(parent) = tree.parent(node) else { continue };
            let mut random = dice.place(node as i32, 0, 0);
            let stiff = 1.0 - 0.75 * libm::pow(load[node] / all, 0.3);
            turned[node] = turned[parent] * 0.8 + CROOKED * stiff * 2.0 * (random.uniform() - 0.5);
            let link = tree.place(node) - tree.place(parent);
            let (sine, cosine) = libm::sincos(turned[node]);
            let longer = 0.75 + 0.5 * random.uniform();
            let way = [link.x * cosine - link.y * sine, link.x * sine + link.y * cosine];
            place[node] = [0, 1].map(|axis| place[parent][axis] + longer * way[axis]);
            let before = if parent == 0 { 1.25 * thick(load[node]) } else { thick(load[parent]) };
            links.push(Link {
                ends: [place[parent], place[node]],
                radius: [before.min(1.4 * thick(load[node])), thick(load[node])],
                own: random.uniform(),
            });
        }
        Ok(Self { habit, links })
    }

    /// Its distance, m.
    pub fn depth(&self) -> f64 {
        self.habit.foot[2]
    }

    /// Its strokes.
    pub fn strokes(&self, view: &View) -> Sheaf {
        let mut sheaf = Sheaf::new(view);
        let [x, y, z] = self.habit.foot;
        let (_, scale) = view.seen(self.habit.foot);
        let bark = air(self.habit.bark, z);
        let snow = f64::from(SNOW);
        let snow = air([0.70 * snow, 0.75 * snow, 0.82 * snow], z);
        let ends = |link: &Link, lift: f64| link.ends.map(|[u, v]| view.seen([x + u, y + v + lift, z]).0);
        for link in &self.links {
            let mut laid = stroke(ends(link, 0.0), link.radius.map(|radius| radius * scale), bark, z);
            laid.dark = if link.radius[0] > 0.03 { [0.62, 0.0] } else { [0.0, 0.3] };
            sheaf.lay(laid);
        }
        for link in &self.links {
            if link.radius[1] > 0.025 {
                // The wind has blown some against the trunk.
                let side = 0.75 * link.radius[1] * scale;
                let ends = ends(link, 0.0).map(|[u, v]| [u - side, v]);
                let wide = [0, 1].map(|end| {
                    let wave = libm::sin(2.3 * link.ends[end][1] + x) + libm::sin(5.1 * link.ends[end][1]);
                    (0.05 + 0.05 * wave).max(0.0) * link.radius[end] * scale
                });
                let mut laid = stroke(ends, wide, snow.map(|light| 0.75 * light), z);
                laid.soft = 0.8;
                sheaf.lay(laid);
            }
            let [dx, dy] = [0, 1].map(|axis| link.ends[1][axis] - link.ends[0][axis]);
            let flat = dx.abs() / (dx * dx + dy * dy).sqrt().max(1e-9);
            let thick = self.habit.snow * (flat - 0.2).max(0.0) * (0.1 + 1.3 * link.own);
            if thick > 0.001 {
                let mut laid = stroke(
                    ends(link, link.radius[1] + 0.4 * thick),
                    [thick * scale, 0.7 * thick * scale],
                    snow,
                    z,
                );
                laid.dark = [0.0, 0.3];
                sheaf.lay(laid);
            }
        }
        sheaf
    }
}
