//! What holds of bodies and pictures.

mod bytes;
mod closed;
mod conserved;
mod opacity;

use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

use super::*;
use crate::snow::flake::{Assembly, Flake, Joining, Template};
use crate::snow::{Branching, Crystal, Cubes, History, Layers, Parameters};

const TAU: f64 = 1e5;

/// A dendrite, a plate and a column, of elements of 20 um.
fn templates() -> Vec<Template> {
    let branching = Branching::new(&Parameters { element: 20e-6, ..Parameters::ASSUMED }).unwrap();
    [(-15.0, 15.0), (-11.0, 30.0), (-8.0, 30.0)]
        .into_iter()
        .map(|(temperature, minutes)| {
            let history = History::saturated(temperature, minutes).unwrap();
            Template::new(Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).unwrap())
        })
        .collect()
}

fn body(templates: &[Template], chosen: &[usize], seed: u64) -> Body {
    let joining = Joining::assumed();
    let flake = Flake::assemble(templates, chosen, Assembly::OneByOne, &joining, Seed(seed)).unwrap();
    let cubes: Vec<Cubes> = templates.iter().map(|t| Cubes::new(t.crystal(), 1).unwrap()).collect();
    Body::new(&flake, &cubes, 1, TAU).unwrap()
}

fn light() -> Himeno {
    Himeno {
        diffuse: 0.7,
        specular: 0.3,
        power: 10,
        ambient: 0.35,
        to_light: [0.5, 0.7, 0.5],
        light: [1.6, 1.5, 1.4],
        ambient_light: [0.8, 0.9, 1.0],
    }
}

fn scene<'a>(bodies: &'a [Body], flakes: &'a [Placed]) -> Scene<'a> {
    Scene { bodies, flakes, extinction: TAU, light: light() }
}

/// A camera that looks along -z at what is 0.4 m away, sharp at `focus`.
fn camera(number: f64, focus: f64, shutter: f64, size: [usize; 2]) -> Camera {
    let lens = Lens { focal: 0.1, number, focus, sensor: FULL_FRAME, shutter };
    Camera::new(Point3::origin(), -Vector3::z(), Vector3::y(), lens, size).unwrap()
}

fn placed(template: usize, at: [f64; 3], k: u64) -> Placed {
    let mut numbers = Seed(k).stream("placed").at(0).place(0, 0, 0);
    let turn = [0; 4].map(|_| numbers.uniform() - 0.5);
    Placed {
        template,
        at: Point3::from(at),
        turn: UnitQuaternion::from_quaternion(Quaternion::new(turn[0], turn[1], turn[2], turn[3])),
        scale: 1.0,
        velocity: Vector3::zeros(),
    }
}

/// Flakes near and far, sharp, blurred and small.
fn many(count: usize) -> Vec<Placed> {
    (0..count)
        .map(|k| {
            let mut numbers = Seed(9).stream("many").at(0).place(k as i32, 0, 0);
            let mut within = |low: f64, high: f64| low + (high - low) * numbers.uniform();
            let z = within(0.12, 1.5);
            let at = [within(-0.15, 0.15) * z, within(-0.12, 0.12) * z, -z];
            let velocity = Vector3::new(0.1, within(-1.0, -0.2), 0.1);
            Placed { velocity, scale: within(0.6, 1.5), ..placed(k % 3, at, k as u64) }
        })
        .collect()
}

fn bodies() -> Vec<Body> {
    let templates = templates();
    [&[0][..], &[1, 0, 2], &[0, 0]].iter().map(|chosen| body(&templates, chosen, 5)).collect()
}
