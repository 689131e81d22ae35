//! As opaque as the ice itself: hexagonal prisms, which voxels as large as an element blur.
//!
//! An arm an element wide that lies askew is shared among voxels side by side, each half full, and hides more than it should.
//! Rays through the prisms and through the voxels are compared, and voxels are made thinner by one number for each
//! extinction, so that the mean over directions is that of the prisms.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use super::super::flake::{Flake, Template};
use super::fit::{self, Depths, Logarithms, Plane, spread};
use super::grid::Grid;

/// Directions in which they are compared, and rays in each that meet something.
const DIRECTIONS: usize = 24;
const HITS: usize = 160;
/// The most rays.
const RAYS: usize = 2000;
/// Places on a ray, in elements.
const STEP: f64 = 0.3;
/// Layers of a crystal that is flat.
const FEW: f64 = 32.0;

/// Logarithms of what voxels are multiplied by, for each of the extinctions that are solved for. `corner` is that of the grid,
/// in the flake's own coordinates, m; `extinction` is tau, 1/m.
pub(super) fn thinner(
    grid: &Grid,
    corner: Vector3<f64>,
    flake: &Flake,
    crystals: &[Template],
    extinction: f64,
) -> Logarithms {
    let compared: Vec<[Depths; 2]> = fit::directions(DIRECTIONS)
        .into_par_iter()
        .map(|direction| {
            let plane = Plane::across(grid, direction);
            let along = Vector3::from(direction);
            let mut depths = [Depths::new(), Depths::new()];
            for k in 0..RAYS {
                let ray = plane.ray(spread(k));
                let voxels = grid.depth(&ray, 60.0);
                let from = Point3::from(corner + Vector3::from(ray.origin) * grid.side);
                let ice = extinction * ice_along(flake, crystals, &from, &along);
                for (depths, depth) in depths.iter_mut().zip([ice, voxels]) {
                    if depth > 0.0 {
                        depths.add(depth);
                    }
                }
                if depths[1].count() >= HITS {
                    break;
                }
            }
            depths
        })
        .collect();
    let mut sums = [Depths::new(), Depths::new()];
    for depths in &compared {
        sums.iter_mut().zip(depths).for_each(|(sum, depths)| sum.join(depths));
    }
    fit::agreeing(&sums[0], [0.0; 3], &sums[1])
}

/// How much ice is on a line, m; where crystals have grown into each other it counts twice.
fn ice_along(flake: &Flake, crystals: &[Template], from: &Point3<f64>, along: &Vector3<f64>) -> f64 {
    let mut sum = 0.0;
    for member in &flake.members {
        let template = &crystals[member.template];
        let (element, radius) = (template.crystal().element(), template.radius());
        let pose = member.pose.inverse();
        let (origin, line) = (pose * from, pose.rotation * along);
        // Within its sphere, and between its lowest and highest face.
        let middle = -origin.coords.dot(&line);
        let apart = (origin + line * middle).coords.norm_squared();
        if apart >= radius * radius {
            continue;
        }
        let half = (radius * radius - apart).sqrt();
        let (mut enter, mut leave) = (middle - half, middle + half);
        let height = 0.5 * template.crystal().height();
        if line.z.abs() > 1e-9 {
            let faces = [-height, height].map(|z| (z - origin.z) / line.z);
            enter = enter.max(faces[0].min(faces[1]));
            leave = leave.min(faces[0].max(faces[1]));
        } else if origin.z.abs() > height {
            continue;
        }
        if leave <= enter {
            continue;
        }
        // As many in each layer of a flat crystal: all lines cut its few layers at the same depths.
        let layers = (2 * template.crystal().layers().len() - 1) as f64;
        let each = if layers <= FEW { layers } else { 1.0 };
        let count = each * ((leave - enter) / (STEP * element * each)).ceil().max(1.0);
        let step = (leave - enter) / count;
        let is_ice = |k: usize| template.is_ice(&(origin + line * (enter + (k as f64 + 0.5) * step)));
        sum += step * (0..count as usize).filter(|k| is_ice(*k)).count() as f64;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::super::flake::{Assembly, Joining};
    use super::super::super::{Branching, Crystal, Cubes, History, Layers, Parameters};
    use super::super::Body;
    use super::*;
    use crate::rng::Seed;

    /// The mean of many lines through a crystal, times the area that they are spread over, is its volume: some 1 % of chance.
    #[test]
    fn lines_find_all_of_the_ice() {
        let (crystals, flake) = pair();
        let single = Flake { members: flake.members[..1].to_vec() };
        let reach = crystals[0].radius();
        let along = Vector3::new(0.36, 0.48, 0.8);
        let [a, b] = [Vector3::new(0.8, -0.6, 0.0), Vector3::new(-0.48, -0.64, 0.6)];
        let lines = 20_000;
        let sum: f64 = (0..lines)
            .map(|k| {
                let [u, v] = spread(k).map(|x| (2.0 * x - 1.0) * reach);
                ice_along(&single, &crystals, &Point3::from(a * u + b * v - along * (2.0 * reach)), &along)
            })
            .sum();
        let volume = sum / lines as f64 * 4.0 * reach * reach;
        let known = crystals[0].crystal().mass() / super::super::super::ICE;
        assert!((volume / known - 1.0).abs() < 0.02, "{}", volume / known);
    }

    fn pair() -> (Vec<Template>, Flake) {
        let branching = Branching::new(&Parameters { element: 25e-6, ..Parameters::ASSUMED }).unwrap();
        let history = History::saturated(-15.0, 15.0).unwrap();
        let crystal = Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).unwrap();
        let crystals = vec![Template::new(crystal)];
        let flake = Flake::assemble(&crystals, &[0, 0], Assembly::OneByOne, &Joining::assumed(), Seed(3));
        (crystals, flake.unwrap())
    }

    /// Voxels as large as an element are too opaque by a tenth and more; made true, the mean over other directions is right
    /// within 3 %: of rays that are compared there are some thousand.
    #[test]
    fn a_body_is_made_as_opaque_as_its_prisms() {
        let (crystals, flake) = pair();
        let cubes = vec![Cubes::new(crystals[0].crystal(), 3).unwrap()];
        let voxels = Body::new(&flake, &cubes, 3, 1e5).unwrap();
        let body = Body::true_to(&flake, &crystals, &cubes, 3, 1e5).unwrap();
        let centre = flake.centre(&crystals).coords;
        let (grid, _) = &body.levels[0];
        let coarse = body.levels() - 1;
        let (mut ice, mut seen) = (0.0, [0.0; 3]);
        for direction in fit::directions(9) {
            let plane = Plane::across(grid, direction);
            let rays = 3000;
            let taken = |k: usize| {
                let origin = Vector3::from(plane.ray(spread(k)).origin) * grid.side;
                let from = Point3::from(Vector3::from(body.corner) + origin + centre);
                1.0 - libm::exp(-1e5 * ice_along(&flake, &crystals, &from, &Vector3::from(direction)))
            };
            let sum: f64 = (0..rays).map(taken).sum();
            ice += sum / rays as f64 * plane.area * grid.side * grid.side;
            for (sum, (body, level)) in seen.iter_mut().zip([(&voxels, 0), (&body, 0), (&body, coarse)]) {
                *sum += body.opacity(level, direction, rays);
            }
        }
        assert!(seen[0] / ice > 1.05, "{}", seen[0] / ice);
        for seen in &seen[1..] {
            assert!((seen / ice - 1.0).abs() < 0.03, "{}", seen / ice);
        }
    }
}
