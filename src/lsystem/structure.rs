//! What a turtle drew: nodes, each linked to the one it was drawn from.

use std::collections::BTreeMap;

use nalgebra::Point3;

/// The end of a segment, or a place where drawing began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Where it is, m.
    pub place: Point3<f64>,
    /// The node at the other end of its segment, always one before it; none where drawing began.
    pub parent: Option<usize>,
    /// Brackets around the symbol that drew it.
    pub depth: usize,
    /// Width of its segment, m.
    pub width: f64,
}

/// Nodes and links, in the order in which they were drawn; the first node is the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// The nodes.
    pub nodes: Vec<Node>,
    /// Length of a segment, m.
    pub step: f64,
}

/// Places nearer to each other than this part of a step are the same.
const SAME: f64 = 1e-6;

impl Structure {
    /// How many links there are.
    pub fn links(&self) -> usize {
        self.nodes.iter().filter(|node| node.parent.is_some()).count()
    }

    /// Nodes at the end of a link from which no other begins.
    pub fn tips(&self) -> usize {
        let mut has_child = vec![false; self.nodes.len()];
        self.nodes.iter().filter_map(|node| node.parent).for_each(|parent| has_child[parent] = true);
        self.nodes.iter().zip(has_child).filter(|(node, has)| node.parent.is_some() && !has).count()
    }

    /// Links between the origin and the node that is furthest along them.
    pub fn longest_chain(&self) -> usize {
        let mut links: Vec<usize> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            links.push(node.parent.map_or(0, |parent| links[parent] + 1));
        }
        links.into_iter().max().unwrap_or(0)
    }

    /// The greatest y of a node, m.
    pub fn height(&self) -> f64 {
        self.nodes.iter().map(|node| node.place.y).fold(0.0, f64::max)
    }

    /// Links that lie exactly on one that was drawn before.
    pub fn coincident(&self) -> usize {
        self.firsts().iter().enumerate().filter(|(node, first)| node != *first).count()
    }

    /// The same with coincident links drawn once: what was drawn from a second one begins at the first.
    pub fn merged(&self) -> Self {
        let first = self.firsts();
        let mut kept = vec![usize::MAX; self.nodes.len()];
        let mut nodes = Vec::new();
        for (number, node) in self.nodes.iter().enumerate().filter(|(number, _)| first[*number] == *number) {
            kept[number] = nodes.len();
            nodes.push(Node { parent: node.parent.map(|parent| kept[first[parent]]), ..*node });
        }
        Self { nodes, step: self.step }
    }

    /// For each node the first that has its place and whose parent has its parent's place.
    fn firsts(&self) -> Vec<usize> {
        let key = |place: &Point3<f64>| {
            let of = |x: f64| libm::round(x / (self.step * SAME)) as i64;
            [of(place.x), of(place.y), of(place.z)]
        };
        let mut seen = BTreeMap::new();
        let mut first = Vec::with_capacity(self.nodes.len());
        for (number, node) in self.nodes.iter().enumerate() {
            let link = (key(&node.place), node.parent.map(|parent| key(&self.nodes[parent].place)));
            first.push(if node.parent.is_some() { *seen.entry(link).or_insert(number) } else { number });
        }
        first
    }
}
