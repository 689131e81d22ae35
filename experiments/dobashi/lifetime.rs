//! The lifetime of clouds, T_ext (§2.2).

use snowglobe::automaton_cloud::{Lock, Packed, Rules};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table, smallest_rise,
};
use snowglobe::reading::Reading;

use super::setup::{MENDED, broken, uniform};

pub const LIFETIME: Experiment = Experiment {
    id: "lifetime",
    title: "The lifetime of clouds",
    source: "§2.2",
    says: "Clouds that come and go in short periods look unnatural; so a cell that has become cloud does not change for T_ext steps.",
    claims: &[&KEPT, &LONGER],
    run,
    mutant: Mutant {
        changes: "longest T_ext",
        to: 0.0,
        why: "without a lifetime cloud may go in the next step",
        turns_red: &["dobashi/lifetime/kept"],
    },
};

static KEPT: Claim = Claim {
    id: "dobashi/lifetime/kept",
    source: "§2.2",
    says: "cloud stays for T_ext steps",
    expect: Expect::AtLeast(16.0),
    statistic: Statistic::Each,
    reason: "the shortest time that any cell is cloud, T_ext = 16; runs that the film's end cuts are left out",
    known: &[],
};
static LONGER: Claim = Claim {
    id: "dobashi/lifetime/longer",
    source: "§2.2",
    says: "the longer the lifetime, the more cloud there is",
    expect: Expect::Between(0.001, 1.0),
    statistic: Statistic::Each,
    reason: "smallest rise of the mean cover from one T_ext to the next of 0, 4, 8 and 16; a thousandth of all cells is more than \
             the same run with another seed differs by",
    known: &[],
};

const SEEDS: u64 = 4;

/// What a run showed.
struct Runs {
    cover: f64,
    /// The shortest and the mean time that a cell is cloud, and that it is none between two clouds.
    on: [f64; 2],
    off: [f64; 2],
}

fn run(lab: &mut Lab) -> Result<()> {
    let vapour = lab.assume("probability of vapour, each step", 0.02, "not given");
    let active = lab.assume("probability of activation, each step", 0.001, "not given");
    let vanishing = lab.assume(
        "probability of extinction, each step",
        0.005,
        "not given; ext must come while there is cloud",
    );
    let longest = lab.assume("longest T_ext", 16.0, "not given; 0, a quarter, half and all of it") as u8;
    let steps = lab.pick(160, 40);
    let counts = lab.pick([48, 48, 24], [12, 12, 8]);
    let seeds = lab.seeds(SEEDS);
    let lifetimes = [0, longest / 4, longest / 2, longest];
    let mut table = Table::new([
        "lock",
        "t_ext",
        "seed",
        "mean_cover",
        "shortest_on",
        "mean_on",
        "shortest_off",
        "mean_off",
    ]);
    let mut series = Vec::new();
    for lock in lab.readings::<Lock>() {
        let measured = lab.each(&seeds, |seed| -> Result<Vec<Runs>> {
            let of = |lifetime: &u8| {
                let rules = Rules { lock, lifetime: *lifetime, ..MENDED };
                film(counts, rules, *seed, [vapour, active, vanishing], steps)
            };
            lifetimes.iter().map(of).collect()
        });
        let measured = measured.into_iter().collect::<Result<Vec<_>>>()?;
        lab.reading(lock);
        for (seed, runs) in seeds.iter().zip(&measured) {
            lab.found_with(&KEPT, *seed, runs[3].on[0]);
            let covers: Vec<f64> = runs.iter().map(|run| run.cover).collect();
            lab.found_with(&LONGER, *seed, smallest_rise(&covers));
            for (lifetime, run) in lifetimes.iter().zip(runs) {
                table.row([
                    lock.name().into(),
                    u64::from(*lifetime).into(),
                    (*seed).into(),
                    run.cover.into(),
                    run.on[0].into(),
                    run.on[1].into(),
                    run.off[0].into(),
                    run.off[1].into(),
                ]);
            }
        }
        for (name, of) in [("on", 0), ("off", 1)] {
            let mean = |k: usize| {
                let sum: f64 = measured.iter().map(|runs| [runs[k].on[1], runs[k].off[1]][of]).sum();
                (f64::from(lifetimes[k]), sum / measured.len() as f64)
            };
            let points: Vec<(f64, f64)> = (0..4).map(mean).collect();
            series.push(Series::new(format!("{name}, lock {}", lock.name()), Draw::Joined, points));
        }
    }
    lab.keep("runs", "How long cells are cloud, and are none between two clouds", table)?;
    lab.keep(
        "lengths",
        "The lifetime bounds the time that a cell is cloud; how long it is none it bounds only by the way",
        Plot {
            title: "How long do cells stay as they are?".to_owned(),
            x: Axis::of("T_ext (steps)"),
            y: Axis::of("mean run (steps)"),
            series,
            bands: Vec::new(),
        },
    )
}

fn film(counts: [usize; 3], rules: Rules, seed: u64, chances: [f64; 3], steps: usize) -> Result<Runs> {
    let mut clouds = Packed::new(counts, rules).map_err(broken)?;
    clouds.inject(&uniform(seed, [0.4, chances[1], 0.0]));
    let later = uniform(seed, chances);
    // When each cell last changed; none before its first change, for that run began before the film.
    let mut since: Vec<Option<usize>> = vec![None; counts.iter().product()];
    let mut before = clouds.cld();
    let mut cover = 0.0;
    // Of off and on: number, sum and shortest of all runs.
    let mut runs = [(0_u64, 0_u64, u64::MAX); 2];
    for t in 1..=steps {
        clouds.step();
        clouds.inject(&later);
        cover += clouds.cover();
        let now = clouds.cld();
        for cell in 0..now.len() {
            if now[cell] == before[cell] {
                continue;
            }
            if let Some(from) = since[cell] {
                let (number, sum, shortest) = &mut runs[usize::from(before[cell])];
                let length = (t - from) as u64;
                (*number, *sum, *shortest) = (*number + 1, *sum + length, length.min(*shortest));
            }
            since[cell] = Some(t);
        }
        before = now;
    }
    let of = |(number, sum, shortest): (u64, u64, u64)| {
        if number == 0 { [0.0; 2] } else { [shortest as f64, sum as f64 / number as f64] }
    };
    Ok(Runs { cover: cover / steps as f64, off: of(runs[0]), on: of(runs[1]) })
}
