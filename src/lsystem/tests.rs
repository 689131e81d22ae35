//! Counts that are known, and walks that close.

use super::*;
use nalgebra::Point3;

const PAPER: &str = "F[+F]F[-F][F]";

fn plain(angle: f64) -> Turtle {
    let (draws, moves) = ("F".to_owned(), "f".to_owned());
    Turtle { angle, step: 1.0, width: 1.0, thinner: 0.7, draws, moves }
}

fn paper(steps: u32) -> Structure {
    let word = LSystem::simple("F", 'F', PAPER).unwrap().derive(steps, Seed(1)).unwrap();
    plain(20.0).draw(&word).unwrap()
}

#[test]
fn the_papers_tree_has_its_counts() {
    for n in 1..=5_u32 {
        let tree = paper(n);
        assert_eq!(tree.links(), 5_usize.pow(n));
        assert_eq!(tree.nodes.len(), 5_usize.pow(n) + 1);
        assert_eq!(tree.tips(), 3 * 5_usize.pow(n - 1));
        assert_eq!(tree.longest_chain(), 2_usize.pow(n + 1) - 1);
        assert!((tree.height() - f64::from(2_u32.pow(n + 1) - 1)).abs() < 1e-9);
    }
}

/// Links that lie on another, by looking at all pairs.
fn coincident_by_pairs(tree: &Structure) -> usize {
    let same = |a: Point3<f64>, b: Point3<f64>| (a - b).norm() < 1e-6;
    let ends = |node: &Node| Some((node.place, tree.nodes[node.parent?].place));
    let links: Vec<_> = tree.nodes.iter().filter_map(ends).collect();
    let earlier = |k: usize| links[..k].iter().any(|l| same(l.0, links[k].0) && same(l.1, links[k].1));
    (0..links.len()).filter(|k| earlier(*k)).count()
}

#[test]
fn some_links_of_the_papers_tree_coincide_and_merge() {
    for (n, expected) in [(1, 0), (2, 3)] {
        assert_eq!(paper(n).coincident(), expected, "n {n}");
    }
    for n in 1..=4 {
        let tree = paper(n);
        assert_eq!(tree.coincident(), coincident_by_pairs(&tree), "n {n}");
        let merged = tree.merged();
        assert_eq!((merged.coincident(), merged.links()), (0, tree.links() - tree.coincident()));
        assert_eq!(merged.longest_chain(), tree.longest_chain());
        assert!(merged.nodes.iter().enumerate().all(|(k, node)| node.parent.is_none_or(|p| p < k)));
    }
}

#[test]
fn a_mirrored_word_draws_the_mirror_image_bit_for_bit() {
    let word = LSystem::simple("F", 'F', "F[+F]F[-F--F]+[F]").unwrap().derive(4, Seed(1)).unwrap();
    let mirrored: String = word
        .chars()
        .map(|c| match c {
            '+' => '-',
            '-' => '+',
            c => c,
        })
        .collect();
    let (a, b) = (plain(17.3).draw(&word).unwrap(), plain(17.3).draw(&mirrored).unwrap());
    for (a, b) in a.nodes.iter().zip(&b.nodes) {
        assert_eq!((a.place.x, a.place.y), (-b.place.x, b.place.y));
    }
}

/// ABOP Fig. 1.24: segments after n steps, counted through the numbers of F and X alone.
#[test]
fn abops_bracketed_systems_have_as_many_segments_as_their_letters_say() {
    for (axiom, rules, steps) in [
        ("F", vec![('F', "F[+F]F[-F]F")], 5),
        ("F", vec![('F', "F[+F]F[-F][F]")], 5),
        ("F", vec![('F', "FF-[-F+F+F]+[+F-F-F]")], 4),
        ("X", vec![('X', "F[+X]F[-X]+X"), ('F', "FF")], 7),
        ("X", vec![('X', "F[+X][-X]FX"), ('F', "FF")], 7),
        ("X", vec![('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")], 5),
    ] {
        let count = |word: &str, letter: char| word.chars().filter(|c| *c == letter).count();
        let mut letters = [count(axiom, 'F'), count(axiom, 'X')];
        for _ in 0..steps {
            let mut next = [0, 0];
            for (k, from) in ['F', 'X'].into_iter().enumerate() {
                let to =
                    rules.iter().find(|(f, _)| *f == from).map_or(String::from(from), |r| r.1.to_owned());
                next[0] += letters[k] * count(&to, 'F');
                next[1] += letters[k] * count(&to, 'X');
            }
            letters = next;
        }
        let production =
            |(from, to): &(char, &str)| Production { from: *from, to: to.to_string(), weight: 1.0 };
        let system = LSystem::new(axiom, rules.iter().map(production).collect()).unwrap();
        let word = system.derive(steps, Seed(1)).unwrap();
        assert_eq!(count(&word, 'F'), letters[0], "{axiom} {rules:?}");
        assert_eq!(plain(25.7).draw(&word).unwrap().links(), letters[0]);
    }
}

/// ABOP Fig. 1.6.
#[test]
fn the_quadratic_koch_island_closes() {
    let system = LSystem::simple("F-F-F-F", 'F', "F-F+F+FF-F-F+F").unwrap();
    let island = plain(90.0).draw(&system.derive(3, Seed(1)).unwrap()).unwrap();
    assert_eq!(island.links(), 4 * 512);
    assert_eq!(island.nodes.last().unwrap().place, Point3::origin());
}

/// ABOP Fig. 1.19: Hilbert's curve in space goes through every point of its cube once.
#[test]
fn hilberts_curve_fills_its_cube() {
    let rules = [
        ('A', "B-F+CFC+F-D&F^D-F+&&CFC+F+B//"),
        ('B', "A&F^CFB^F^D^^-F-D^|F^B|FC^F^A//"),
        ('C', "|D^|F^B-F+C^F^A&&FA&F^C+F+B^F^D//"),
        ('D', "|CFB-F+B|FA&F^A&&FB-F+B|FC//"),
    ];
    let production = |(from, to): (char, &str)| Production { from, to: to.to_owned(), weight: 1.0 };
    let system = LSystem::new("A", rules.map(production).to_vec()).unwrap();
    for n in 1..=3_u32 {
        let curve = plain(90.0).draw(&system.derive(n, Seed(1)).unwrap()).unwrap();
        let points = 8_usize.pow(n);
        let mut places: Vec<[i64; 3]> = curve
            .nodes
            .iter()
            .map(|node| [node.place.x, node.place.y, node.place.z].map(|x| libm::round(x) as i64))
            .collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!((curve.nodes.len(), places.len()), (points, points), "n {n}");
        for axis in 0..3 {
            let along = places.iter().map(|place| place[axis]);
            let side = along.clone().max().unwrap() - along.min().unwrap();
            assert_eq!(side, (1 << n) - 1, "n {n} axis {axis}");
        }
    }
}

/// ABOP Fig. 1.27: a third each.
#[test]
fn choices_follow_their_weights_and_their_addresses() {
    let rules = [("F[+F]F[-F]F", 1.0), ("F[+F]F", 1.0), ("F[-F]F", 2.0)];
    let production = |(to, weight): (&str, f64)| Production { from: 'F', to: to.to_owned(), weight };
    let system = LSystem::new(&"F".repeat(40_000), rules.map(production).to_vec()).unwrap();
    let word = system.derive(1, Seed(1)).unwrap();
    let (fives, all) = (word.matches("[+F]F[-F]").count(), 40_000.0);
    let deviation = libm::sqrt(all * 0.25 * 0.75);
    assert!((fives as f64 - all / 4.0).abs() < 4.0 * deviation, "{fives}");
    assert_eq!(word, system.derive(1, Seed(1)).unwrap());
    assert_ne!(word, system.derive(1, Seed(2)).unwrap());
    // A shorter axiom is a beginning of the longer one, and so are its choices.
    let short = LSystem::new(&"F".repeat(100), rules.map(production).to_vec()).unwrap();
    assert!(word.starts_with(&short.derive(1, Seed(1)).unwrap()));
}

#[test]
fn a_long_walk_keeps_its_axes_square() {
    let word = "+&/".repeat(4000) + "F" + &"^\\-".repeat(4000) + "F+F&F";
    let tree = plain(31.7).draw(&word).unwrap();
    let step = |k: usize| tree.nodes[k].place - tree.nodes[k - 1].place;
    assert!((1..=4).all(|k| (step(k).norm() - 1.0).abs() < 1e-12));
    assert!((step(2).dot(&step(3)) - libm::cos(31.7_f64.to_radians())).abs() < 1e-12);
}

#[test]
fn what_cannot_be_is_refused_and_early() {
    let refuse = |axiom: &str, to: &str, weight| {
        LSystem::new(axiom, vec![Production { from: 'F', to: to.to_owned(), weight }]).unwrap_err()
    };
    assert_eq!(refuse("", "F", 1.0), LSystemError::NoAxiom);
    assert!(matches!(refuse("F", "F[", 1.0), LSystemError::Brackets(_)));
    assert!(matches!(refuse("]F[", "F", 1.0), LSystemError::Brackets(_)));
    assert!(matches!(refuse("F F", "F", 1.0), LSystemError::Blank(_)));
    assert!(matches!(refuse("F", "F", f64::NAN), LSystemError::Weight { .. }));
    let doubling = LSystem::simple("F", 'F', "FF").unwrap();
    let error = doubling.derive(10_000, Seed(1)).unwrap_err();
    assert_eq!(error, LSystemError::TooLong { step: 23, length: 2 * MOST_SYMBOLS });
    assert!(matches!(plain(20.0).draw("XYZ").unwrap_err(), LSystemError::NothingDrawn { .. }));
    assert!(plain(f64::INFINITY).draw("F").is_err());
    assert!(Turtle { step: 0.0, ..plain(20.0) }.draw("F").is_err());
}

#[test]
fn a_file_is_read_and_its_faults_are_named() {
    let text = "axiom = 'F'\nsteps = 2\nangle = 20\nproductions = [{ from = 'F', to = 'F[+F]F[-F][F]' }]";
    let spec: Spec = toml::from_str(text).unwrap();
    let word = spec.system().unwrap().derive(spec.steps, Seed(1)).unwrap();
    assert_eq!(spec.turtle(1.0).draw(&word).unwrap(), paper(2));
    let error = toml::from_str::<Spec>(&text.replace("angle", "angel")).unwrap_err();
    assert!(error.to_string().contains("angel"));
}
