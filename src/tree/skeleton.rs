//! The tree at rest: nodes, links, and Eq. (1) and (2).

use std::f64::consts::PI;

use super::{TreeError, Vector};
use crate::lsystem::{LSystem, LSystemError, Structure, Turtle};
use crate::rng::Seed;

/// Nodes and links at rest; node 0 is the root, which does not move.
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    pub(super) parent: Vec<Option<usize>>,
    pub(super) children: Vec<Vec<usize>>,
    pub(super) place: Vec<Vector>,
    length: Vec<f64>,
    radius: Vec<f64>,
}

/// The paper's tree (§2.2, Fig. 1) as it is derived: 25 links, of which some coincide; a segment is 1 long.
///
/// # Errors
///
/// None, in fact.
pub fn papers_tree() -> Result<Structure, LSystemError> {
    let word = LSystem::simple("F", 'F', "F[+F]F[-F][F]")?.derive(2, Seed(1))?;
    let (draws, moves) = ("F".to_owned(), String::new());
    Turtle { angle: 20.0, step: 1.0, width: 1.0, thinner: 1.0, draws, moves }.draw(&word)
}

impl Skeleton {
    /// The most nodes that are handled.
    pub const MOST_NODES: usize = 20_000;

    /// A drawn structure, made `height` m high; the radius falls evenly from `radii[0]` outside of brackets to
    /// `radii[1]` within the most of them.
    ///
    /// # Errors
    ///
    /// Numbers that are not above 0; a structure that is not one tree, leaves its plane or does not rise.
    pub fn new(structure: &Structure, height: f64, radii: [f64; 2]) -> Result<Self, TreeError> {
        for (name, value) in [("height", height), ("radius", radii[0]), ("radius at the tips", radii[1])] {
            if !(1e-6..=1e4).contains(&value) {
                return Err(TreeError::OutOfRange { name, value, least: 1e-6, most: 1e4 });
            }
        }
        let nodes = &structure.nodes;
        if nodes.len() > Self::MOST_NODES {
            let (name, value, most) = ("the number of nodes", nodes.len() as f64, Self::MOST_NODES as f64);
            return Err(TreeError::OutOfRange { name, value, least: 2.0, most });
        }
        if nodes.iter().filter(|node| node.parent.is_none()).count() != 1 {
            return Err(TreeError::Shape("the structure is not one tree: it moves without drawing"));
        }
        if nodes.iter().any(|node| node.place.z.abs() > 1e-9 * structure.step) {
            return Err(TreeError::Shape("the structure leaves its plane; the model is planar"));
        }
        if structure.height() < 0.5 * structure.step {
            return Err(TreeError::Shape("the structure does not rise above its root"));
        }
        let scale = height / structure.height();
        let deepest = nodes.iter().map(|node| node.depth).max().unwrap_or(0).max(1) as f64;
        let mut children = vec![Vec::new(); nodes.len()];
        for (number, node) in nodes.iter().enumerate() {
            if let Some(parent) = node.parent {
                children[parent].push(number);
            }
        }
        let radius = |depth: usize| radii[0] - (radii[0] - radii[1]) * (depth as f64 / deepest);
        Ok(Self {
            parent: nodes.iter().map(|node| node.parent).collect(),
            children,
            place: nodes.iter().map(|node| scale * node.place.coords.xy()).collect(),
            length: nodes.iter().map(|node| node.parent.map_or(0.0, |_| scale * structure.step)).collect(),
            radius: nodes.iter().map(|node| node.parent.map_or(0.0, |_| radius(node.depth))).collect(),
        })
    }

    /// How many nodes there are, the root included.
    pub fn nodes(&self) -> usize {
        self.parent.len()
    }

    /// The node at the other end of a node's link; none for the root.
    pub fn parent(&self, node: usize) -> Option<usize> {
        self.parent[node]
    }

    /// Where a node is at rest, m.
    pub fn place(&self, node: usize) -> Vector {
        self.place[node]
    }

    /// l_P, length of the link that ends in a node, m; 0 for the root.
    pub fn length(&self, node: usize) -> f64 {
        self.length[node]
    }

    /// r_P, its radius, m.
    pub fn radius(&self, node: usize) -> f64 {
        self.radius[node]
    }

    /// m_P, its mass, kg: Eq. (1).
    pub fn mass(&self, node: usize, density: f64) -> f64 {
        PI * self.radius[node] * self.radius[node] * self.length[node] * density
    }

    /// s_P, its surface, m2: Eq. (2).
    pub fn surface(&self, node: usize) -> f64 {
        2.0 * PI * self.radius[node] * self.length[node]
    }

    /// The highest node at rest, the first of several.
    pub fn tip(&self) -> usize {
        (1..self.nodes()).fold(0, |tip, node| if self.place[node].y > self.place[tip].y { node } else { tip })
    }

    /// A node's link at rest, from its parent, m; zero for the root.
    pub(super) fn link(&self, node: usize) -> Vector {
        self.parent[node].map_or_else(Vector::zeros, |parent| self.place[node] - self.place[parent])
    }

    /// The mirror image, x to -x.
    pub fn mirrored(&self) -> Self {
        let place = self.place.iter().map(|place| Vector::new(-place.x, place.y)).collect();
        Self { place, ..self.clone() }
    }
}
