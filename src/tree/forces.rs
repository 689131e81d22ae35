//! The forces on a node: Eq. (3) to (6).

use std::f64::consts::PI;

use super::readings::{Drag, Target};
use super::{Parameters, Skeleton, Vector};

/// The turn from one direction to another: (cosine, sine); none from or to nothing.
fn turn(from: Vector, to: Vector) -> (f64, f64) {
    let (along, across) = (from.x * to.x + from.y * to.y, from.x * to.y - from.y * to.x);
    let size = libm::sqrt(along * along + across * across);
    if size > 0.0 { (along / size, across / size) } else { (1.0, 0.0) }
}

fn rotate(vector: Vector, (cosine, sine): (f64, f64)) -> Vector {
    Vector::new(cosine * vector.x - sine * vector.y, sine * vector.x + cosine * vector.y)
}

/// F_w of a node in N, Eq. (3), from the velocity of the air that passes it, m/s.
pub(super) fn wind(tree: &Skeleton, given: &Parameters, drag: Drag, node: usize, passing: Vector) -> Vector {
    match drag {
        Drag::AsPrinted => given.wind * tree.surface(node) * passing,
        Drag::Quadratic => {
            let shadow = 2.0 * tree.radius(node) * tree.length(node);
            let speed = libm::sqrt(passing.x * passing.x + passing.y * passing.y);
            0.5 * given.air_density * given.drag * shadow * speed * passing
        }
    }
}

/// F_r of every node in N, Eq. (5), for nodes at `place`.
pub(super) fn restoring(
    tree: &Skeleton,
    given: &Parameters,
    target: Target,
    place: &[Vector],
) -> Vec<Vector> {
    (0..tree.nodes())
        .map(|node| {
            let Some(parent) = tree.parent(node) else { return Vector::zeros() };
            let rest = tree.link(node);
            // The parent's link has turned since it was at rest, and takes the target with it (§3.4.2).
            let aim = match (target, tree.parent(parent)) {
                (Target::Rotated, Some(before)) => {
                    rotate(rest, turn(tree.link(parent), place[parent] - place[before]))
                }
                _ => rest,
            };
            let (r, l) = (tree.radius(node), tree.length(node));
            PI * r * r / l * given.restoring * (place[parent] + aim - place[node])
        })
        .collect()
}

/// F_d of every node in N, Eq. (6): on a parent, opposite to its children's F_r.
///
/// From the grandparent i the child's F_r has the moment `l_ik F_r cos(theta)`, theta being the angle between F_r and
/// the normal of P_i P_k; on the parent, l_j away, it takes `l_ik cos(theta) / l_j F_r`. It is not passed on.
pub(super) fn reaction(
    tree: &Skeleton,
    strength: f64,
    place: &[Vector],
    restoring: &[Vector],
) -> Vec<Vector> {
    (0..tree.nodes())
        .map(|node| {
            let Some(before) = tree.parent(node) else { return Vector::zeros() };
            let mut sum = Vector::zeros();
            for &child in &tree.children[node] {
                let reach = place[child] - place[before];
                let distance = libm::sqrt(reach.x * reach.x + reach.y * reach.y);
                if distance > 0.0 {
                    let normal = Vector::new(-reach.y, reach.x) / distance;
                    let across = restoring[child].x * normal.x + restoring[child].y * normal.y;
                    sum -= strength * (distance / tree.length(node)) * across * normal;
                }
            }
            sum
        })
        .collect()
}
