//! What holds of every flake.

use std::collections::BTreeMap;

use super::super::{Branching, Crystal, Cubes, History, Layers, Parameters, Voxels};
use super::*;
use crate::reading::Reading;

/// A dendrite, a plate, a needle and a column, of elements of 20 um.
fn templates() -> Vec<Template> {
    let branching = Branching::new(&Parameters { element: 20e-6, ..Parameters::ASSUMED }).unwrap();
    [(-15.0, 15.0), (-11.0, 30.0), (-6.0, 25.0), (-8.0, 30.0)]
        .into_iter()
        .map(|(temperature, minutes)| {
            let history = History::saturated(temperature, minutes).unwrap();
            Template::new(Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).unwrap())
        })
        .collect()
}

fn pieces(flake: &Flake, templates: &[Template]) -> usize {
    let cubes: Vec<Cubes> = templates.iter().map(|t| Cubes::new(t.crystal(), 1).unwrap()).collect();
    let posed: Vec<_> = flake.members.iter().map(|member| (&cubes[member.template], member.pose)).collect();
    Voxels::new(&posed, 2).unwrap().pieces()
}

#[test]
fn the_four_types_are_told_apart() {
    let kinds: Vec<Kind> = templates().iter().map(Template::kind).collect();
    assert_eq!(kinds, [Kind::Dendrite, Kind::Plate, Kind::Needle, Kind::Column]);
}

#[test]
fn flakes_hold_together_and_do_not_overlap() {
    let templates = templates();
    for assembly in Assembly::ALL {
        for seed in 0..12 {
            let chosen: Vec<usize> = (0..6).map(|k| (k + seed as usize) % 4).collect();
            let flake =
                Flake::assemble(&templates, &chosen, *assembly, &Joining::assumed(), Seed(seed)).unwrap();
            assert_eq!(flake.members.len(), 6);
            let [rigid, tangled] = flake.overlap(&templates);
            assert_eq!(rigid, 0.0, "{assembly:?} {seed}");
            assert!(tangled <= 0.05, "{assembly:?} {seed}: {tangled}");
            assert_eq!(pieces(&flake, &templates), 1, "{assembly:?} {seed}");
            assert_eq!(flake.members.iter().filter(|member| member.held.is_none()).count(), 1);
            let unit =
                |member: &Member| (member.pose.rotation.quaternion().norm_squared() - 1.0).abs() < 1e-14;
            assert!(flake.members.iter().all(unit));
        }
    }
}

/// All seven ways between dendrites, and each as often as another: chi-square at 1 in 10,000 with 6 degrees of freedom is
/// 27.9.
#[test]
fn all_seven_ways_are_taken() {
    let templates = templates();
    let mut counts = BTreeMap::new();
    let flakes = 210;
    for seed in 0..flakes {
        let flake = Flake::assemble(&templates, &[0, 0], Assembly::OneByOne, &Joining::assumed(), Seed(seed))
            .unwrap();
        *counts.entry(flake.members[1].held.unwrap().1).or_insert(0) += 1;
    }
    let expected = flakes as f64 / 7.0;
    let chi: f64 = Attachment::ALL
        .iter()
        .map(|way| (f64::from(*counts.get(way).unwrap_or(&0)) - expected) / expected.sqrt())
        .map(|x| x * x)
        .sum();
    assert!(chi < 27.9, "{chi}: {counts:?}");
}

#[test]
fn the_same_seed_makes_the_same_flake() {
    let templates = templates();
    let make = |seed| {
        Flake::assemble(&templates, &[0, 1, 2, 3], Assembly::FlakeToFlake, &Joining::assumed(), Seed(seed))
            .unwrap()
    };
    assert_eq!(make(5), make(5));
    assert_ne!(make(5), make(6));
    // Debug and release agree to the last bit: FNV-1a over all poses.
    let numbers = |pose: &Isometry3<f64>| {
        let (at, turn) = (pose.translation.vector, pose.rotation.quaternion().coords);
        [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]
    };
    let bytes = |number: f64| number.to_bits().to_le_bytes();
    let digest = make(5)
        .members
        .iter()
        .flat_map(|member| numbers(&member.pose))
        .flat_map(bytes)
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
    assert_eq!(digest, 0xa6ba6ff3cfcbcca8, "{digest:#x}");
}

#[test]
fn what_is_no_flake_is_refused() {
    let templates = templates();
    let refuse = |chosen: &[usize], joining: &Joining| {
        Flake::assemble(&templates, chosen, Assembly::OneByOne, joining, Seed(1)).unwrap_err().to_string()
    };
    let mut none = Joining::assumed();
    none.weights.0 = [[[0.0; 7]; 4]; 4];
    for message in [
        refuse(&[], &Joining::assumed()),
        refuse(&[7], &Joining::assumed()),
        refuse(&[0, 0], &none),
        refuse(&[0], &Joining { tilt: f64::NAN, ..Joining::assumed() }),
    ] {
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}
