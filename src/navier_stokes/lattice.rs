//! Between the nodes: reading and leaving values with the weights of Eq. (19).

/// Nodes in rows and columns, the same distance on both sides of x = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Nodes along x and y.
    pub counts: [usize; 2],
    /// Distance of neighbours along x and y, m.
    pub spacing: [f64; 2],
    /// y of the lowest row, m.
    pub bottom: f64,
}

/// The four nodes around a place: lower left, lower right, upper left, upper right, and their weights.
///
/// A weight is the area of the opposite corner over that of the cell: `S_4, S_3, S_2, S_1 / (dx dy)` in Eq. (19).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners {
    /// Column and row of the lower left node.
    pub node: [usize; 2],
    /// The weights; they sum to 1.
    pub weights: [f64; 4],
}

impl Lattice {
    /// The nodes around a place; none outside. A place on an edge or on a node belongs to a cell beside it, and what
    /// the others would have is 0.
    pub fn corners(&self, place: [f64; 2]) -> Option<Corners> {
        // From the middle outwards, so that a mirrored place has the mirrored weights bit for bit.
        let steps = place[0].abs() / self.spacing[0];
        let middle = 0.5 * (self.counts[0] - 1) as f64;
        let outward = steps + (middle - libm::floor(middle));
        let whole = libm::floor(outward);
        let (far, near) = (outward - whole, 1.0 - (outward - whole));
        // Columns counted from the middle (or from the column left of it) outwards.
        let column = whole + libm::floor(middle);
        let beyond = (self.counts[0] - 1) as f64;
        let (left, weights_x) =
            if place[0] < 0.0 { (beyond - column - 1.0, [far, near]) } else { (column, [near, far]) };
        let (left, weights_x) = within(left, weights_x, self.counts[0])?;
        let up = (place[1] - self.bottom) / self.spacing[1];
        let row = libm::floor(up);
        let (row, weights_y) = within(row, [1.0 - (up - row), up - row], self.counts[1])?;
        let [w, e] = weights_x;
        let [s, n] = weights_y;
        Some(Corners { node: [left, row], weights: [w * s, e * s, w * n, e * n] })
    }

    /// Index of a node in a field that is stored row by row.
    pub fn index(&self, node: [usize; 2]) -> usize {
        node[1] * self.counts[0] + node[0]
    }

    /// Where a node is, m.
    pub fn place(&self, node: [usize; 2]) -> [f64; 2] {
        let middle = 0.5 * (self.counts[0] - 1) as f64;
        [(node[0] as f64 - middle) * self.spacing[0], self.bottom + node[1] as f64 * self.spacing[1]]
    }

    /// A field's value at a place, Eq. (19).
    pub fn read(&self, field: &[f64], place: [f64; 2]) -> Option<f64> {
        let Corners { node, weights: [sw, se, nw, ne] } = self.corners(place)?;
        let low = self.index(node);
        let high = low + self.counts[0];
        Some((field[low] * sw + field[low + 1] * se) + (field[high] * nw + field[high + 1] * ne))
    }

    /// Adds an amount to the four nodes around a place, by their weights (§5.2); false outside.
    pub fn spread(&self, field: &mut [f64], place: [f64; 2], amount: f64) -> bool {
        let Some(Corners { node, weights: [sw, se, nw, ne] }) = self.corners(place) else { return false };
        let low = self.index(node);
        let high = low + self.counts[0];
        field[low] += amount * sw;
        field[low + 1] += amount * se;
        field[high] += amount * nw;
        field[high + 1] += amount * ne;
        true
    }
}

/// The first of two neighbouring nodes, moved by one where a place lies exactly on the last node.
fn within(first: f64, weights: [f64; 2], count: usize) -> Option<(usize, [f64; 2])> {
    let last = count as f64 - 1.0;
    match first {
        first if first >= 0.0 && first < last => Some((first as usize, weights)),
        first if first == last && weights == [1.0, 0.0] => Some((count - 2, [0.0, 1.0])),
        first if first == -1.0 && weights == [0.0, 1.0] => Some((0, [1.0, 0.0])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const NODES: Lattice = Lattice { counts: [33, 17], spacing: [0.3125, 0.5], bottom: 0.0 };

    #[test]
    fn on_a_node_on_an_edge_and_outside() {
        let at = |x: f64, y: f64| NODES.corners([x, y]);
        for node in [[0, 0], [32, 16], [32, 0], [0, 16], [16, 8], [3, 16]] {
            let corners = at(NODES.place(node)[0], NODES.place(node)[1]).unwrap();
            let heaviest = corners.weights.iter().position(|w| *w == 1.0).unwrap();
            assert_eq!([corners.node[0] + heaviest % 2, corners.node[1] + heaviest / 2], node);
        }
        let edge = at(0.0, 0.25).unwrap();
        assert_eq!(edge.weights.iter().filter(|w| **w == 0.5).count(), 2);
        for (x, y) in [(5.01, 1.0), (-5.01, 1.0), (0.0, -0.01), (0.0, 8.01), (f64::NAN, 1.0), (1e300, 1.0)] {
            assert_eq!(at(x, y), None, "{x} {y}");
        }
    }

    proptest! {
        #[test]
        fn weights_sum_to_one_and_give_the_place_back(x in -5.0..5.0f64, y in 0.0..8.0f64, odd in 0..2usize) {
            let nodes = Lattice { counts: [33 - odd, 17], ..NODES };
            prop_assume!(x.abs() < nodes.place([nodes.counts[0] - 1, 0])[0]);
            let corners = nodes.corners([x, y]).unwrap();
            prop_assert!((corners.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            prop_assert!(corners.weights.iter().all(|w| *w >= 0.0));
            let field: Vec<f64> = (0..nodes.counts[0] * nodes.counts[1])
                .map(|c| { let p = nodes.place([c % nodes.counts[0], c / nodes.counts[0]]); 3.0 * p[0] - p[1] })
                .collect();
            prop_assert!((nodes.read(&field, [x, y]).unwrap() - (3.0 * x - y)).abs() < 1e-12);
            let mut spread = vec![0.0; field.len()];
            prop_assert!(nodes.spread(&mut spread, [x, y], -2.0));
            prop_assert!((spread.iter().sum::<f64>() + 2.0).abs() < 1e-14);
        }

        #[test]
        fn a_mirrored_place_has_mirrored_weights(x in 0.0..4.8f64, y in 0.0..8.0f64, odd in 0..2usize) {
            let nodes = Lattice { counts: [33 - odd, 17], ..NODES };
            let (right, left) = (nodes.corners([x, y]).unwrap(), nodes.corners([-x, y]).unwrap());
            let [sw, se, nw, ne] = right.weights;
            if x != 0.0 && sw + nw < 1.0 {
                prop_assert_eq!(left.weights, [se, sw, ne, nw]);
                prop_assert_eq!(left.node[0] + right.node[0] + 2, nodes.counts[0]);
            }
        }
    }
}
