//! What must hold of any tree, whatever the numbers.

use super::*;
use crate::reading::Reading;

fn skeleton() -> Skeleton {
    Skeleton::new(&papers_tree().unwrap(), 6.67, [0.05, 0.02]).unwrap()
}

const AIR: Setting = Setting { size: [10.0, 10.0], cells: [32, 32], viscosity: 1.5e-5, wind: 5.0, dt: 0.002 };

/// What the physical set is run with: a restoring coefficient above its critical one.
fn given(readings: Readings) -> Parameters {
    match readings {
        Readings::PHYSICAL => Parameters { restoring: 1e6, ..Parameters::PRINTED },
        _ => Parameters::PRINTED,
    }
}

fn sway(readings: Readings, setting: Setting) -> Sway {
    Sway::new(Tree::new(skeleton(), given(readings), readings).unwrap(), setting).unwrap()
}

fn after(mut sway: Sway, steps: u32) -> Sway {
    for _ in 0..steps {
        sway.step().unwrap();
    }
    sway
}

#[test]
fn the_papers_tree_has_its_masses() {
    let tree = skeleton();
    let l = 6.67 / 7.0;
    assert_eq!((tree.nodes(), tree.tip()), (26, (1..26).find(|n| tree.place(*n).y > 6.66).unwrap()));
    assert!((tree.place(tree.tip()).y - 6.67).abs() < 1e-12);
    assert!((tree.length(1) - l).abs() < 1e-12);
    let radii: Vec<f64> = (1..26).map(|node| tree.radius(node)).collect();
    for radius in [0.05, 0.035, 0.02] {
        assert!(radii.iter().any(|r| (r - radius).abs() < 1e-12), "{radii:?}");
    }
    assert!((tree.mass(1, 230.0) - std::f64::consts::PI * 0.0025 * l * 230.0).abs() < 1e-12);
}

#[test]
fn links_keep_their_lengths() {
    for set in ReadingSet::ALL {
        let sway = after(sway(set.readings(), Setting { wind: 10.0, ..AIR }), 500);
        let (tree, rest) = (sway.tree(), skeleton());
        for node in 1..26 {
            let link = tree.place(node) - tree.place(rest.parent(node).unwrap());
            assert!((link.norm() / rest.length(node) - 1.0).abs() < 1e-12, "{set:?} {node}");
        }
        assert!(tree.bend().tip.norm() > 1e-3, "{set:?} moves");
    }
}

#[test]
fn without_wind_and_gravity_nothing_moves() {
    for set in ReadingSet::ALL {
        let readings = Readings { gravity: super::readings::Gravity::RestPose, ..set.readings() };
        let sway = after(sway(readings, Setting { wind: 0.0, ..AIR }), 200);
        let bend = sway.tree().bend();
        assert!(bend.tip.norm() < 1e-9 && bend.mean_angle < 1e-9, "{set:?} {bend:?}");
    }
}

#[test]
fn a_mirrored_tree_in_the_opposite_wind_is_the_mirror_image_bit_for_bit() {
    for set in ReadingSet::ALL {
        let readings = set.readings();
        let there = after(sway(readings, AIR), 400);
        let mirrored = Tree::new(skeleton().mirrored(), given(readings), readings).unwrap();
        let back = after(Sway::new(mirrored, Setting { wind: -5.0, ..AIR }).unwrap(), 400);
        for node in 0..26 {
            let (a, b) = (there.tree().place(node), back.tree().place(node));
            assert_eq!((a.x, a.y), (-b.x, b.y), "{set:?} {node}");
        }
        assert!(there.tree().bend().tip.x.abs() > 1e-3);
    }
}

#[test]
fn momentum_balances_in_the_consistent_exchange_only() {
    for (exchange, balances) in
        [(Exchange::Consistent, true), (Exchange::Speed, false), (Exchange::Force, false)]
    {
        let readings = Readings { exchange, ..Readings::PAPER };
        let (on_tree, on_air) = after(sway(readings, AIR), 100).exchanged();
        let misses = (on_tree + on_air).norm() / on_tree.norm();
        assert_eq!(misses < 1e-12, balances, "{exchange:?}: {on_tree} {on_air}");
    }
}

#[test]
fn nodes_outside_of_the_air_are_counted_and_feel_nothing() {
    let small = Setting { size: [10.0, 5.0], cells: [32, 16], ..AIR };
    let sway = after(sway(Readings::PAPER, small), 3);
    let above = (1..26).filter(|node| skeleton().place(*node).y > 5.0).count() as u64;
    assert_eq!(sway.counted(), Counted { inside: 3 * (25 - above), outside: 3 * above });
    assert!(above > 0 && sway.felt().iter().filter(|felt| felt.is_none()).count() as u64 == above + 1);
}

#[test]
fn a_step_beyond_the_trees_bound_is_refused_and_the_bound_is_sharp() {
    let readings = Readings { exchange: Exchange::OneWay, ..Readings::PAPER };
    let stiff = Parameters { restoring: 1e6, ..Parameters::PRINTED };
    let most = Linearised::new(&skeleton(), stiff, readings).unwrap().largest_step();
    let build =
        |dt| Sway::new(Tree::new(skeleton(), stiff, readings).unwrap(), Setting { dt, wind: 0.0, ..AIR });
    let error = build(1.01 * most).err().unwrap();
    assert_eq!(error, TreeError::Unstable { dt: 1.01 * most, most });
    // Just below the bound a small push dies away, just above it grows.
    for (dt, grows) in [(0.97 * most, false), (1.03 * most, true)] {
        let mut tree = Tree::new(skeleton(), stiff, readings).unwrap();
        tree.turn_link(25, 1e-6);
        let still = vec![Vector::zeros(); 26];
        for _ in 0..2000 {
            tree.step(dt, &still);
        }
        let now = tree.bend().mean_angle;
        assert_eq!(now > 1e-3, grows, "{dt} {now}");
    }
}

#[test]
fn gravity_fells_the_tree_below_the_critical_restoring_coefficient() {
    let readings = Readings::PHYSICAL;
    let critical =
        Linearised::critical_restoring(&skeleton(), Parameters::PRINTED, readings).unwrap().unwrap();
    for (factor, stands) in [(0.99, false), (1.01, true)] {
        let given = Parameters { restoring: factor * critical, ..Parameters::PRINTED };
        assert_eq!(Linearised::new(&skeleton(), given, readings).unwrap().stands(), stands);
    }
}

#[test]
fn half_the_step_and_twice_the_cells_change_little() {
    let tip = |dt: f64, cells: usize| {
        let setting = Setting { dt, cells: [cells, cells], ..AIR };
        after(sway(Readings::PAPER, setting), libm::round(1.0 / dt) as u32).tree().bend().tip.x
    };
    let (coarse, fine) = (tip(0.002, 32), tip(0.001, 32));
    assert!((fine / coarse - 1.0).abs() < 0.005, "{coarse} {fine}");
}
