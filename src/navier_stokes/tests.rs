//! Solvers against flows that are known; the tolerances stand beside them and were written before the first run.

use std::f64::consts::PI;

use super::exact::{Exact, Poiseuille, TaylorGreen};
use super::*;

const SLIP: Sides = Sides { left: Side::Slip, right: Side::Slip, bottom: Side::Slip, top: Side::Slip };

/// Greatest error of u and relative error of the decay rate of kinetic energy, after 1 s at nu = 0.05.
fn taylor_green(cells: usize) -> (f64, f64, f64) {
    let exact = TaylorGreen { viscosity: 0.05 };
    let domain = Domain { size: [PI, PI], cells: [cells, cells] };
    let mut flow = Staggered::new(domain, SLIP, exact.viscosity, Convection::Central).unwrap();
    flow.fill(|place| exact.velocity(place, 0.0));
    let before = flow.kinetic_energy();
    // dt falls with the square of the spacing, so that space decides.
    let steps = cells * cells / 8;
    for _ in 0..steps {
        flow.step(1.0 / steps as f64).unwrap();
    }
    let (at, u) = flow.u();
    let mut error: f64 = 0.0;
    for j in 1..=cells {
        for i in 0..=cells {
            let there = exact.velocity(at.place([i, j]), 1.0)[0];
            error = error.max((u[at.index([i, j])] - there).abs());
        }
    }
    let decay = -libm::log(flow.kinetic_energy() / before);
    (error, decay / exact.decay() - 1.0, flow.divergence())
}

#[test]
fn taylor_green_is_of_second_order_and_decays_at_four_nu() {
    let errors: Vec<(f64, f64, f64)> = [32, 64, 128].map(taylor_green).to_vec();
    for pair in errors.windows(2) {
        let order = libm::log2(pair[0].0 / pair[1].0);
        assert!(order >= 1.9, "{order} of {errors:?}");
    }
    assert!(errors.iter().all(|(_, _, divergence)| *divergence < 1e-12), "{errors:?}");
    assert!(errors[2].1.abs() < 1e-3, "{errors:?}");
}

#[test]
fn an_inflow_becomes_poiseuilles() {
    let exact = Poiseuille { height: 1.0, mean: 1.0 };
    let walls = Side::Wall(0.0);
    let sides = Sides { left: Side::Inflow(1.0), right: Side::Outflow, bottom: walls, top: walls };
    let mut errors = Vec::new();
    for cells in [16, 32] {
        let domain = Domain { size: [3.0, 1.0], cells: [3 * cells, cells] };
        let mut flow = Staggered::new(domain, sides, 0.1, Convection::Central).unwrap();
        let dt = 0.5 * flow.largest_step();
        for _ in 0..(4.0 / dt) as usize {
            flow.step(dt).unwrap();
        }
        let (at, u) = flow.u();
        let mut error: f64 = 0.0;
        for j in 1..=cells {
            let node = [3 * cells - cells / 2, j];
            error = error.max((u[at.index(node)] - exact.velocity(at.place(node), 0.0)[0]).abs());
        }
        errors.push(error);
    }
    // A second-order wall: half the cells across, about four times the error.
    assert!(errors[1] < 5e-3 && errors[0] / errors[1] > 3.0, "{errors:?}");
}

fn cavity(convection: Convection) -> Staggered {
    let domain = Domain { size: [1.0, 1.0], cells: [24, 24] };
    Staggered::new(domain, Sides::cavity(1.0), 0.01, convection).unwrap()
}

#[test]
fn a_step_beyond_the_bound_is_refused_with_both_numbers() {
    let mut flow = cavity(Convection::Central);
    let most = flow.largest_step();
    flow.step(most).unwrap();
    let before = flow.clone();
    let error = flow.step(1.01 * most).unwrap_err();
    assert!(
        error.to_string().contains(&most.to_string())
            && error.to_string().contains(&(1.01 * most).to_string())
    );
    assert_eq!((flow.u().1, flow.time()), (before.u().1, before.time()), "nothing has changed");
    assert!(flow.step(f64::NAN).is_err() && flow.step(0.0).is_err() && flow.step(-1.0).is_err());
}

/// A bit of wind against a cylinder of forces, from the left and from the right.
fn gust(sign: f64, convection: Convection, collocated: bool) -> Vec<[f64; 2]> {
    let domain = Domain { size: [4.0, 3.0], cells: [20, 15] };
    let sides = Sides::wind(sign * 2.0);
    let mut flow: Box<dyn Flow> = if collocated {
        let mut flow =
            Collocated::new(domain, sides, 0.05, convection, WallPressure::Linear, Forcing::InsideStep)
                .unwrap();
        flow.fill(|_| [sign * 2.0, 0.0]);
        Box::new(flow)
    } else {
        let mut flow = Staggered::new(domain, sides, 0.05, convection).unwrap();
        flow.fill(|_| [sign * 2.0, 0.0]);
        Box::new(flow)
    };
    for _ in 0..50 {
        flow.release();
        for place in [[0.13, 1.0], [0.61, 1.52]] {
            assert!(flow.push([sign * place[0], place[1]], [-sign * 3.0, 0.7]));
        }
        flow.step(0.01).unwrap();
    }
    (0..80)
        .filter_map(|k| flow.velocity([sign * (-1.9 + 0.04719 * k as f64), 0.037 * k as f64 + 0.01]))
        .collect()
}

#[test]
fn a_mirrored_wind_is_mirrored_bit_for_bit() {
    for collocated in [false, true] {
        for convection in [Convection::Upwind, Convection::Central] {
            let (east, west) = (gust(1.0, convection, collocated), gust(-1.0, convection, collocated));
            assert!(east.len() > 60 && east.iter().any(|[u, v]| (u - 2.0).abs() > 0.1 && v.abs() > 0.01));
            for (a, b) in east.iter().zip(&west) {
                assert_eq!(*a, [-b[0], b[1]], "{convection:?} {collocated}");
            }
        }
    }
}

#[test]
fn uniform_wind_over_a_slippery_ground_stays_as_it_is() {
    let domain = Domain { size: [4.0, 3.0], cells: [20, 15] };
    let sides = Sides { bottom: Side::Slip, ..Sides::wind(3.0) };
    let mut flow = Staggered::new(domain, sides, 1e-3, Convection::Upwind).unwrap();
    flow.fill(|_| [3.0, 0.0]);
    for _ in 0..20 {
        flow.step(0.01).unwrap();
    }
    let wind = flow.velocity([0.3, 0.1]).unwrap();
    assert!((wind[0] - 3.0).abs() < 1e-12 && wind[1].abs() < 1e-12);
    assert_eq!(flow.velocity([2.01, 1.0]), None);
    assert!(!flow.push([0.0, -0.01], [1.0, 0.0]) && flow.u().1.iter().all(|u| (u - 3.0).abs() < 1e-12));
}

#[test]
fn nodes_conserve_mass_less_well_than_faces() {
    let domain = Domain { size: [1.0, 1.0], cells: [24, 24] };
    let mut nodes = Collocated::new(
        domain,
        Sides::cavity(1.0),
        0.01,
        Convection::Central,
        WallPressure::Linear,
        Forcing::InsideStep,
    )
    .unwrap();
    let mut faces = cavity(Convection::Central);
    for _ in 0..200 {
        nodes.step(0.01).unwrap();
        faces.step(0.01).unwrap();
    }
    assert!(faces.divergence() < 1e-12, "{}", faces.divergence());
    assert!(nodes.divergence() > 1e-3 && nodes.divergence() < 10.0, "{}", nodes.divergence());
    // Both turn the same way: the air runs back below the middle.
    let [a, b] = [nodes.velocity([0.0, 0.4]).unwrap()[0], faces.velocity([0.0, 0.4]).unwrap()[0]];
    assert!(a < -0.1 && b < -0.1 && (a - b).abs() < 0.03, "{a} {b}");
}
