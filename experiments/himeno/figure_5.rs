//! Fig. 5: which crystals join to which, and how, asked for against realised.

use snowglobe::lab::{Claim, Expect, Experiment, HeatMap, Lab, Mutant, Result, Statistic, Table, average};
use snowglobe::rng::Seed;
use snowglobe::snow::flake::{Assembly, Attachment, Flake, Joining, Template, Weights};
use snowglobe::snow::{Cubes, Voxels};

use super::joined::{KINDS, four_types, kind_name};
use super::setup::{assumed, broken};

pub const FIGURE_5: Experiment = Experiment {
    id: "figure-5",
    title: "Which crystals join, and how",
    source: "§1.2, Fig. 5, 6",
    says: "Two crystals join in one of seven ways, each as often as the types of both have it.",
    claims: &[&AS_ASKED, &FORBIDDEN, &ONE_PIECE, &RIGID, &TANGLE],
    run,
    mutant: Mutant {
        changes: "weight of point to point",
        to: 4.0,
        why: "then points meet more often than all ways alike would have it",
        turns_red: &["himeno/figure-5/as-asked"],
    },
};

/// Ways that geometry allows, less one for each pair of types: 6 of two dendrites, 5 of a dendrite and a plate, 5 of two plates,
/// 4 of each with a needle or a column, 2 of each pair of these.
const FREEDOM: f64 = 38.0;

static AS_ASKED: Claim = Claim {
    id: "himeno/figure-5/as-asked",
    source: "Fig. 5, 6",
    says: "ways come as often as asked for",
    expect: Expect::AtMost(61.16),
    statistic: Statistic::Each,
    reason: "chi-square of realised counts against those asked for, all ten pairs of types: the 99 % quantile at 38 degrees of freedom. \
             Asked are all ways that geometry allows alike, since the figures' widths of lines are lost; never Magono's",
    known: &[],
};
static FORBIDDEN: Claim = Claim {
    id: "himeno/figure-5/forbidden",
    source: "Fig. 6",
    says: "face to face needs two plates, a face one, a tangle two dendrites",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "flakes that joined in a way that geometry forbids: none",
    known: &[],
};
static ONE_PIECE: Claim = Claim {
    id: "himeno/figure-5/one-piece",
    source: "§1.2",
    says: "a flake holds together",
    expect: Expect::Near { value: 1.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "pieces that voxels of two elements make, the most of all flakes: one",
    known: &[],
};
static RIGID: Claim = Claim {
    id: "himeno/figure-5/rigid",
    source: "§1.2",
    says: "crystals touch and do not go through each other",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "greatest share of a crystal's surface that lies in ice of another, but for tangles: none of it",
    known: &[],
};
static TANGLE: Claim = Claim {
    id: "himeno/figure-5/tangle",
    source: "§1.2.1",
    says: "dendrites tangle at the tips of their branches",
    expect: Expect::Between(1e-6, 0.05),
    statistic: Statistic::Each,
    reason: "the same of tangles, mean: more than none, at most a twentieth, beyond which branches would have broken",
    known: &[],
};

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 20e-6)?;
    let templates = four_types(&branching, lab.seed().0)?;
    let mut weights = Weights::UNIFORM;
    lab.assume_that("weights of the ways", "all alike", "the figures' frequencies are lost; configurable");
    let point = lab.assume("weight of point to point", 1.0, "as all others");
    for way in weights.0.as_flattened_mut() {
        way[Attachment::PointPoint as usize] = point;
    }
    let joining = Joining { weights, ..Joining::assumed() };
    let tries = u64::from(lab.pick(120_u32, 3));
    let pairs: Vec<[usize; 2]> = (0..4).flat_map(|a| (a..4).map(move |b| [a, b])).collect();
    let jobs: Vec<([usize; 2], u64)> =
        pairs.iter().flat_map(|pair| (0..tries).map(move |number| (*pair, number))).collect();
    let cubes = templates.iter().map(|t| Cubes::new(t.crystal(), 1).map_err(broken));
    let cubes = cubes.collect::<Result<Vec<_>>>()?;
    let seed = lab.seed().0;
    let joined = lab.each(&jobs, |([a, b], number)| -> Result<Joined> {
        // Flakes of one pair differ by their number, those of one number by their pair.
        let seed = Seed(seed + 1000 * (4 * *a as u64 + *b as u64) + 100_000 * number);
        let flake = Flake::assemble(&templates, &[*a, *b], Assembly::OneByOne, &joining, seed);
        Joined::of(&flake.map_err(broken)?, &templates, &cubes)
    });
    let joined = joined.into_iter().collect::<Result<Vec<_>>>()?;

    let mut table =
        Table::new(["first", "second", "way", "asked", "realised", "rigid_overlap", "tangle_overlap"]);
    let (mut chi_square, mut forbidden) = (0.0, 0.0);
    let mut cells = Vec::new();
    for (number, [a, b]) in pairs.iter().enumerate() {
        let of_pair = &joined[number * tries as usize..][..tries as usize];
        let allowed: Vec<f64> =
            Attachment::ALL.iter().map(|way| Weights::UNIFORM.of(KINDS[*a], KINDS[*b], *way)).collect();
        let all: f64 = allowed.iter().sum();
        let mut row = Vec::new();
        for (way, weight) in Attachment::ALL.iter().zip(&allowed) {
            let of_way: Vec<&Joined> = of_pair.iter().filter(|joined| joined.way == Some(*way)).collect();
            let (asked, realised) = (tries as f64 * weight / all, of_way.len() as f64);
            if *weight > 0.0 {
                chi_square += (realised - asked) * (realised - asked) / asked;
            } else {
                forbidden += realised;
            }
            let most = |k: usize| of_way.iter().map(|joined| joined.overlap[k]).fold(0.0, f64::max);
            table.row([
                kind_name(KINDS[*a]).into(),
                kind_name(KINDS[*b]).into(),
                way.name().into(),
                asked.into(),
                realised.into(),
                most(0).into(),
                most(1).into(),
            ]);
            row.push((*weight > 0.0).then_some(100.0 * realised / tries as f64));
        }
        cells.push(row);
    }
    lab.found(&AS_ASKED, chi_square);
    lab.found(&FORBIDDEN, forbidden);
    lab.found(&ONE_PIECE, joined.iter().map(|joined| joined.pieces).max().map(|most| most as f64));
    lab.found(&RIGID, joined.iter().map(|joined| joined.overlap[0]).fold(0.0, f64::max));
    let tangles = joined.iter().filter(|joined| joined.way == Some(Attachment::Tangle));
    let tangles: Vec<f64> = tangles.map(|joined| joined.overlap[1]).collect();
    let worst = tangles.iter().copied().fold(0.0, f64::max);
    // The mean is asked for, and none may be above.
    lab.found(&TANGLE, if worst <= joining.tangle { Some(average(&tangles)) } else { Some(worst) });
    lab.assume_that("degrees of freedom", &FREEDOM.to_string(), "ways that geometry allows, less one a pair");
    lab.count("flakes", joined.len() as u64);
    lab.keep("ways", "Ways in which crystals joined, by pairs of types: asked for and realised", table)?;
    let name = |way: &Attachment| {
        let first = |part: &str| part[..1].to_uppercase();
        way.name()
            .split_once("-to-")
            .map_or(way.name().to_owned(), |(a, b)| format!("{}–{}", first(a), first(b)))
    };
    let pair_name = |[a, b]: &[usize; 2]| format!("{} + {}", kind_name(KINDS[*a]), kind_name(KINDS[*b]));
    lab.keep(
        "realised",
        "Per cent of the flakes of a pair of types that joined in each way; empty where geometry forbids it",
        HeatMap {
            title: "How crystals joined (% of a pair's flakes)".to_owned(),
            x: ("way: F a face, L a line, P a point".to_owned(), Attachment::ALL.iter().map(name).collect()),
            y: ("pair of types".to_owned(), pairs.iter().map(pair_name).collect()),
            cells,
            darkest: 40.0,
            accepted: None,
            digits: 0,
        },
    )
}

/// How two crystals came to hold on to each other.
struct Joined {
    way: Option<Attachment>,
    overlap: [f64; 2],
    pieces: usize,
}

impl Joined {
    fn of(flake: &Flake, templates: &[Template], cubes: &[Cubes]) -> Result<Self> {
        let posed: Vec<_> = flake.members.iter().map(|m| (&cubes[m.template], m.pose)).collect();
        Ok(Self {
            way: flake.members.iter().find_map(|member| member.held).map(|(_, way)| way),
            overlap: flake.overlap(templates),
            pieces: Voxels::new(&posed, 2).map_err(broken)?.pieces(),
        })
    }
}
