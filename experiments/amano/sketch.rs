//! Section 3: sketches as input, each optimised to end in frame 130.

use snowglobe::frost::{
    Aim, Edge, EndFrameObjective, EndOf, EndRule, Frost, GROUND, Inflow, Painter, Parameters, Redraw,
    RingTouchingIce, TSim, titled,
};
use snowglobe::image::Picture;
use snowglobe::lab::{
    Artifact, Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table, maybe,
};
use snowglobe::optimize::Derivative;
use snowglobe::rng::Seed;
use snowglobe::sketch::{Placement, Sketch, read_png, read_svg};

use super::setup::{Readings, Reconstruction};

pub const SKETCH: Experiment = Experiment {
    id: "sketch",
    title: "Sketches that fill by frame 130",
    source: "§3.1 and §3.4",
    says: "A user paints any region and marks starts, and asks for the frame in which the film shall end. These \
           sketches are ours; the paper's is not printed.",
    claims: &[&PANE, &LEAF, &WORD, &MITTEN],
    run,
    mutant: Mutant {
        changes: "target",
        to: 200.0,
        why: "a film that is asked to end in frame 200 does not end in frame 130",
        turns_red: &[
            "amano/sketch/window-pane",
            "amano/sketch/leaf",
            "amano/sketch/word",
            "amano/sketch/mitten",
        ],
    },
};

const fn claim(id: &'static str) -> Claim {
    Claim {
        id,
        source: "§3.4",
        says: "the initial value of any sketch can be optimised so that its film ends in the frame asked for",
        expect: Expect::Near { value: 130.0, within: 4.0 },
        statistic: Statistic::Each,
        reason: "the paper's target and tolerance, on a sketch of ours; where descent by Eq. (3) fails, bisection goes on",
        known: &[],
    }
}

static PANE: Claim = claim("amano/sketch/window-pane");
static LEAF: Claim = claim("amano/sketch/leaf");
static WORD: Claim = claim("amano/sketch/word");
static MITTEN: Claim = claim("amano/sketch/mitten");

/// A sketch of ours.
struct Ours {
    name: &'static str,
    file: &'static str,
    bytes: &'static [u8],
    threshold: f64,
    /// Cells across, relative to the others.
    finer: f64,
    claim: &'static Claim,
}

static SKETCHES: [Ours; 4] = [
    Ours {
        name: "window-pane",
        file: "window-pane.svg",
        bytes: include_bytes!("../data/window-pane.svg"),
        threshold: 0.4,
        finer: 1.0,
        claim: &PANE,
    },
    Ours {
        name: "leaf",
        file: "leaf.svg",
        bytes: include_bytes!("../data/leaf.svg"),
        threshold: 0.0,
        finer: 1.0,
        claim: &LEAF,
    },
    Ours {
        name: "word",
        file: "word.svg",
        bytes: include_bytes!("../data/word.svg"),
        threshold: 0.4,
        finer: 2.0,
        claim: &WORD,
    },
    Ours {
        name: "mitten",
        file: "mitten.png",
        bytes: include_bytes!("../data/mitten.png"),
        threshold: 0.0,
        finer: 1.0,
        claim: &MITTEN,
    },
];

const FRAMES: [u64; 4] = [20, 50, 90, 130];

fn run(lab: &mut Lab) -> Result<()> {
    let target = lab.printed("target", 130.0, "§4");
    let aim = Aim {
        start: lab.printed("first beta", 0.25, "Tables 1 and 2"),
        eta: lab.printed("eta", 1.0e-6, "§4"),
        tolerance: lab.printed("tolerance", 4.0, "§4"),
        derivative: Derivative::Secant,
        h: lab.assume("h", 0.01, "as in the descent"),
        iterations: 12,
    };
    let parameters = Parameters {
        alpha: lab.assume("alpha", 1.0, "as in the tables"),
        beta: aim.start,
        gamma: lab.printed("gamma", 0.005, "§4"),
        threshold: 0.0,
        steps_per_frame: lab.assume("steps per frame", 12.0, "as in the tables") as u32,
        inflow: Inflow::ReiterGated,
        redraw: Redraw::Frame,
        edge: Edge::Reflecting,
        ring_touching_ice: RingTouchingIce::Zero,
    };
    let across =
        lab.assume("cells across", lab.pick(80.0, 30.0), "not given; fine enough for a word to be read");
    Readings::DEFAULT.tell(lab, Reconstruction::DEFAULT);
    lab.reading(TSim::Interpolated);
    let searches = lab.each(&SKETCHES, |ours| {
        let sketch = read(ours, Placement::Across((across * ours.finer) as u32))?;
        let objective = EndFrameObjective {
            region: &sketch.region,
            starts: &sketch.starts,
            parameters: Parameters { threshold: ours.threshold, ..parameters },
            seed: Seed(1),
            rule: EndRule { share: 0.9, of: EndOf::AllCells },
            target,
            t_sim: TSim::Interpolated,
            h: aim.h,
            frame_limit: 2000,
        };
        let search = objective.aim(&aim).map_err(|cause| Error::broken(cause.to_string()))?;
        Ok((sketch, search))
    });
    let mut table = Table::new([
        "sketch",
        "cells",
        "starts",
        "threshold",
        "rule",
        "step",
        "beta",
        "end_frame",
        "interpolated",
    ]);
    for (ours, result) in SKETCHES.iter().zip(searches) {
        let (sketch, search) = result.map_err(|error: Error| error.at(ours.file))?;
        for step in &search.iterates {
            table.row([
                ours.name.into(),
                sketch.region.len().into(),
                sketch.starts.len().into(),
                ours.threshold.into(),
                step.rule.name().into(),
                step.step.into(),
                step.beta.into(),
                maybe(step.end.map(|end| end.frame)),
                maybe(step.end.map(|end| end.interpolated)),
            ]);
        }
        lab.count("films grown", search.evaluations);
        let last = search.last().map(|last| (last.beta, last.end));
        let end = last.and_then(|(_, end)| end).map(|end| end.frame as f64);
        let beta = last.map_or(aim.start, |(beta, _)| beta);
        lab.found(ours.claim, end).by(format!(
            "snowglobe frost --sketch experiments/data/{} --spacing {} --beta {beta} --threshold {}",
            ours.file, sketch.spacing, ours.threshold
        ));
        pictures(lab, ours, &sketch, Parameters { beta, threshold: ours.threshold, ..parameters })?;
    }
    lab.keep("iterates", "The search for each sketch's initial value, step by step", table)
}

fn read(ours: &Ours, placement: Placement) -> Result<Sketch> {
    let sketch = if ours.file.ends_with(".svg") {
        read_svg(ours.bytes, placement)?
    } else {
        read_png(ours.bytes, placement)?
    };
    Ok(sketch)
}

fn pictures(lab: &mut Lab, ours: &Ours, sketch: &Sketch, parameters: Parameters) -> Result<()> {
    let last = lab.pick(FRAMES[3], FRAMES[0]);
    let painter = Painter::new(&sketch.region, 340, FRAMES[3], parameters.beta)?;
    let mut frost = Frost::new(&sketch.region, &sketch.starts, parameters, lab.seed())?;
    let mut stills = Vec::new();
    let mut frames = Vec::new();
    for frame in 0..=last {
        if frame > 0 {
            frost.frame();
        }
        let title =
            format!("frame {frame}, {:.0} % ice", 100.0 * frost.ice() as f64 / sketch.region.len() as f64);
        frames.push(titled(&painter.draw_ice(&frost), &title)?);
        if FRAMES.contains(&frame) {
            stills.push(titled(&painter.draw(&frost), &title)?);
        }
    }
    let stills: Vec<&Picture> = stills.iter().collect();
    lab.keep(
        ours.name,
        &format!(
            "The {} in frames 20, 50, 90 and 130; threshold {}",
            ours.name.replace('-', " "),
            ours.threshold
        ),
        Picture::grid(&stills, 2.min(stills.len()), 8, GROUND)?,
    )?;
    lab.keep(
        &format!("{}-growth", ours.name),
        &format!("The {} filling by frame 130, 24 frames a second", ours.name.replace('-', " ")),
        Artifact::Animation { frames, frames_per_second: 24 },
    )
}
