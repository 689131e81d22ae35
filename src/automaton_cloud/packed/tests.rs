use super::super::Chance;
use super::*;
use crate::reading::Reading;
use crate::rng::Seed;

fn random(counts: [usize; 3], seed: u64, name: &str, share: f64) -> Vec<u8> {
    let moment = Seed(seed).stream(name).at(0);
    let number = |k: usize| u8::from(moment.place(k as i32, 0, 0).uniform() < share);
    (0..counts.iter().product()).map(number).collect()
}

fn all_rules() -> Vec<Rules> {
    let mut all = Vec::new();
    for activation in Activation::ALL {
        for brackets in Brackets::ALL {
            for lock in Lock::ALL {
                for lifetime in [0, 1, 3, 8] {
                    all.push(Rules { activation: *activation, brackets: *brackets, lock: *lock, lifetime });
                }
            }
        }
    }
    all
}

fn assert_equal(cells: &Cells, packed: &Packed, what: &str) {
    assert!(cells.cld == packed.cld(), "cld, {what}");
    for field in Field::ALL {
        assert!(cells.field(field) == packed.field(field), "{field:?}, {what}");
    }
    assert_eq!(cells.cover(), packed.cover());
}

/// Sides below, at and above whole words, down to a single cell: every boundary.
#[test]
fn it_equals_the_rules_bit_for_bit() {
    let sizes = [[1, 1, 1], [2, 1, 5], [63, 3, 2], [64, 4, 3], [65, 2, 4], [130, 5, 3], [7, 7, 7]];
    for (number, counts) in sizes.into_iter().enumerate() {
        for rules in all_rules() {
            let seed = number as u64;
            let mut cells = Cells::new(counts).unwrap();
            let mut packed = Packed::new(counts, rules).unwrap();
            for (field, name, share) in
                [(Field::Hum, "hum", 0.7), (Field::Act, "act", 0.1), (Field::Ext, "ext", 0.05)]
            {
                let values = random(counts, seed, name, share);
                cells.set(field, &values).unwrap();
                packed.set(field, &values).unwrap();
            }
            for t in 0..12 {
                assert_equal(&cells, &packed, &format!("{counts:?} {rules:?} at {t}"));
                cells = cells.step(&rules);
                packed.step();
            }
        }
    }
}

/// The same with cells set to 1 on the way; a locked one is left alone where all variables are locked.
#[test]
fn what_is_injected_equals_too() {
    let counts = [70, 6, 5];
    for rules in all_rules() {
        let injection = Injection { seed: Seed(8), chance: Chance::Uniform([0.1, 0.02, 0.05]) };
        let mut cells = Cells::new(counts).unwrap();
        let mut packed = Packed::new(counts, rules).unwrap();
        let mut most = 0.0_f64;
        for t in 0..15 {
            cells.inject(&injection, t, &rules);
            packed.inject(&injection);
            assert_equal(&cells, &packed, &format!("{rules:?} at {t}"));
            cells = cells.step(&rules);
            packed.step();
            most = most.max(packed.cover());
        }
        assert!(most > 0.01, "{rules:?}: {most}");
    }
}

#[test]
fn threads_do_not_matter() {
    let rules =
        Rules { activation: Activation::Negated, brackets: Brackets::Mended, lock: Lock::Cld, lifetime: 5 };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut packed = Packed::new([100, 40, 50], rules).unwrap();
            let injection = Injection { seed: Seed(1), chance: Chance::Uniform([0.05, 0.001, 0.01]) };
            for _ in 0..20 {
                packed.inject(&injection);
                packed.step();
            }
            (packed.cld(), packed.field(Field::Act))
        })
    };
    let one = run(1);
    assert!(one == run(2) && one == run(7));
    assert!(one.0.contains(&1));
}
