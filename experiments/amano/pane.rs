//! Beyond the page: frost on a whole window, photographed.

use nalgebra::Point2;
use snowglobe::frost::pane::{CURVE, EXPOSURE, Pane, Thickness};
use snowglobe::frost::{
    Edge, EndOf, EndRule, Ending, Film, GROUND, Inflow, Painter, Parameters, Redraw, RingTouchingIce, titled,
};
use snowglobe::image::Picture;
use snowglobe::lab::{
    Artifact, Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table, maybe,
};
use snowglobe::sketch::{Bend, Chart, Placement, Sketch, read_svg_bent};

use super::setup::{Readings, Reconstruction};

pub const PANE: Experiment = Experiment {
    id: "pane",
    title: "Frost on a window at night",
    source: "§3, and beyond the page",
    says: "The paper fills sketches with frost from starts that a user marks, and draws it as points. Here the sketch is \
           a whole window of 320,000 points, seen as a camera sees it; and as the rule knows only neighbours, the \
           lattice may be bent, which the paper does not do.",
    claims: &[&END, &PARALLEL, &BENT],
    run,
    mutant: Mutant {
        changes: "largest turn",
        to: 0.0,
        why: "on a lattice that is not bent the arms of all starts are parallel",
        turns_red: &["amano/pane/arms-on-a-bent-lattice"],
    },
};

static END: Claim = Claim {
    id: "amano/pane/end",
    source: "§3.4",
    says: "growth can be set so that a film ends in the frame asked for, whatever the sketch",
    expect: Expect::Near { value: 130.0, within: 4.0 },
    statistic: Statistic::Each,
    reason: "the paper's target and tolerance, for a film that ends with 45 % ice: a window with something to look \
             through; the steps in a frame were chosen so that it does, so this is fitted, not predicted",
    known: &[],
};

static PARALLEL: Claim = Claim {
    id: "amano/pane/arms-on-one-lattice",
    source: "§3.1",
    says: "points are placed evenly, in a regular hexagonal pattern: the arms of all starts have the same six directions",
    expect: Expect::AtMost(2.0),
    statistic: Statistic::Each,
    reason: "the largest angle, in degrees, between the arms of two starts; the ice of one start alone is not quite \
             symmetric where others are near",
    known: &[],
};

static BENT: Claim = Claim {
    id: "amano/pane/arms-on-a-bent-lattice",
    source: "beyond the page",
    says: "on a bent lattice each start has directions of its own",
    expect: Expect::AtLeast(20.0),
    statistic: Statistic::Each,
    reason: "the largest angle, in degrees, between the arms of two starts; as there are six arms, none is over 30",
    known: &[],
};

const WINDOW: &[u8] = include_bytes!("../data/night-window.svg");
const WORD: &[u8] = include_bytes!("../data/word.svg");

/// What is grown.
struct Grown {
    sketch: Sketch,
    film: Film,
    /// The directions of the arms of each start, in degrees from 0 to 60; none where too little is seen.
    arms: Vec<Option<f64>>,
}

fn run(lab: &mut Lab) -> Result<()> {
    let points =
        lab.assume("points", lab.pick(320_000.0, 6_000.0), "a fern needs them; the paper has some thousand");
    let degrees =
        lab.assume("largest turn", 60.0, "beyond the page; in degrees, below the 90 at which it may fold");
    let share = lab.assume("share at the end", 0.45, "a window with something to look through");
    let parameters = Parameters {
        alpha: lab.assume("alpha", 1.0, "as in the tables"),
        beta: lab.assume("beta", 0.4, "grows ferns (Reiter's dendrites)"),
        gamma: lab.assume("gamma", 0.0003, "grows ferns: less in a step, as a frame has more of them"),
        threshold: lab.printed("threshold", 0.4, "§4, of the figures"),
        steps_per_frame: lab.assume(
            "steps per frame",
            lab.pick(STEPS, 8.0),
            "so that the film ends by frame 130",
        ) as u32,
        inflow: Inflow::ReiterGated,
        redraw: Redraw::Frame,
        edge: Edge::Reflecting,
        ring_touching_ice: RingTouchingIce::Zero,
    };
    Readings::DEFAULT.tell(lab, Reconstruction::DEFAULT);
    let seed = lab.seed();
    let bend = (degrees > 0.0).then_some(Bend { degrees, seed });
    let word = Parameters { beta: 0.6, gamma: 0.0004, ..parameters };
    let jobs = [
        (WINDOW, points, bend, parameters, share),
        (WINDOW, points, None, parameters, share),
        (WORD, 0.625 * points, bend, word, 0.9),
    ];
    let grown = lab.each(&jobs, |(svg, points, bend, parameters, share)| -> Result<Grown> {
        let sketch = read_svg_bent(svg, Placement::Points(*points as usize), *bend)?;
        let rule = EndRule { share: *share, of: EndOf::AllCells };
        let mut film = Film::new(&sketch.region, &sketch.starts, *parameters, seed, rule, 400)
            .map_err(|cause| Error::broken("cannot grow frost").because(cause))?;
        film.run();
        let places: Vec<_> = sketch.region.cells().iter().map(|cell| sketch.position(*cell)).collect();
        let around = |start| arms(&places, &film, sketch.position(start), sketch.spacing);
        let arms = sketch.starts.iter().map(|start| around(*start)).collect();
        Ok(Grown { sketch, film, arms })
    });
    let [bent, straight, word] = &grown.into_iter().collect::<Result<Vec<_>>>()?[..] else {
        return Err(Error::broken("three sketches were to be grown"));
    };
    for grown in [bent, straight, word] {
        lab.count("cell updates", grown.film.frost().updates());
    }
    let command = |degrees: f64| {
        let p = bent.film.frost().parameters();
        format!(
            "snowglobe frost --sketch experiments/data/night-window.svg --points {points} --warp {degrees} --beta {} \
             --gamma {} --threshold {} --steps-per-frame {} --share {share}",
            p.beta, p.gamma, p.threshold, p.steps_per_frame
        )
    };
    let end = bent.film.ending().and_then(Ending::reached);
    lab.found(&END, end.map(|end| end.frame as f64)).by(command(degrees));
    lab.found(&PARALLEL, spread(&straight.arms)).by(command(0.0));
    lab.found(&BENT, spread(&bent.arms)).by(command(degrees));
    arms_table(lab, bent, straight)?;
    if !lab.keeps() {
        return Ok(());
    }
    pictures(lab, bent, straight, word)
}

/// Steps in a frame of the film that ends by frame 130.
const STEPS: f64 = 55.0;

/// In which of the directions from 0 to 60 degrees the six arms of a start lie, from the ice around it.
///
/// The phase of the sum of exp(6iφ) over the ice, φ the direction from the start, less what ice evenly spread would give
/// in the part of the window that is there: six arms add up, what is round does not. Near, the start itself is round;
/// far, there is the ice of others; at the window's edge ice follows the edge; and a corner shows one arm and a half,
/// which is not enough.
fn arms(places: &[Point2<f64>], film: &Film, start: Point2<f64>, spacing: f64) -> Option<f64> {
    const RING: (f64, f64) = (12.0, 45.0);
    const EDGE: f64 = 6.0;
    const SEEN: u32 = 12;
    let (least, greatest) =
        places.iter().fold((start, start), |(least, greatest), at| (least.inf(at), greatest.sup(at)));
    let (mut of_ice, mut of_all) = (Sum::default(), Sum::default());
    for (ordinal, place) in places.iter().enumerate() {
        let away = (place - start) / spacing;
        let inside = (place - least).inf(&(greatest - place)).min() > EDGE * spacing;
        if !(inside && (RING.0..RING.1).contains(&away.norm())) {
            continue;
        }
        let direction = libm::atan2(away.y, away.x);
        of_all.add(direction);
        if film.frost().is_ice(ordinal) {
            of_ice.add(direction);
        }
    }
    if of_ice.count < 100.0 || of_all.sectors.count_ones() < SEEN {
        return None;
    }
    let share = of_ice.count / of_all.count;
    let (x, y) = (of_ice.x - share * of_all.x, of_ice.y - share * of_all.y);
    Some((libm::atan2(y, x).to_degrees() / 6.0).rem_euclid(60.0))
}

/// Of exp(6iφ).
#[derive(Default)]
struct Sum {
    x: f64,
    y: f64,
    count: f64,
    /// Of the 36 sectors of ten degrees those in which there is something, as bits.
    sectors: u64,
}

impl Sum {
    fn add(&mut self, direction: f64) {
        self.x += libm::cos(6.0 * direction);
        self.y += libm::sin(6.0 * direction);
        self.count += 1.0;
        self.sectors |= 1 << (direction.to_degrees().rem_euclid(360.0) / 10.0) as u32;
    }
}

/// The largest angle between two of these directions, which are the same again after 60 degrees.
fn spread(arms: &[Option<f64>]) -> Option<f64> {
    let known: Vec<f64> = arms.iter().flatten().copied().collect();
    let apart = |a: f64, b: f64| {
        let turn = (a - b).rem_euclid(60.0);
        turn.min(60.0 - turn)
    };
    known.iter().flat_map(|a| known.iter().map(move |b| apart(*a, *b))).reduce(f64::max)
}

fn arms_table(lab: &mut Lab, bent: &Grown, straight: &Grown) -> Result<()> {
    let mut table = Table::new(["start", "x", "y", "degrees", "degrees_unbent"]);
    let rows = bent.sketch.starts.iter().zip(&bent.arms).zip(&straight.arms);
    for (number, ((start, bent_by), unbent)) in rows.enumerate() {
        let place = bent.sketch.position(*start);
        table.row([(number + 1).into(), place.x.into(), place.y.into(), maybe(*bent_by), maybe(*unbent)]);
    }
    lab.keep(
        "arms",
        "Where the arms of each start lie between 0 and 60 degrees, from the ice around it",
        table,
    )
}

fn pictures(lab: &mut Lab, bent: &Grown, straight: &Grown, word: &Grown) -> Result<()> {
    let photograph = |grown: &Grown, (width, height): (u32, u32), margin: Option<u32>| -> Result<Artifact> {
        let chart = match margin {
            Some(margin) => Chart::fitted(&grown.sketch, width, height, margin)?,
            None => Chart::filled(&grown.sketch, width, height)?,
        };
        let frost = grown.film.frost();
        let photograph = Pane::new(chart, frost, lab.seed()).photograph(&Thickness::of(frost))?;
        Ok(Artifact::Photograph(photograph, EXPOSURE, CURVE))
    };
    let (large, small) = (lab.pick((1920, 1080), (480, 270)), lab.pick((640, 360), (160, 90)));
    let smaller = lab.pick((480, 270), small);
    let kept = [
        (
            "pane",
            "The window in the film's last frame: the lattice is bent, which is beyond the page",
            bent,
            small,
            None,
        ),
        ("pane-straight", "The same window on one lattice: all arms are parallel", straight, smaller, None),
        ("word", "FROST, on a bent lattice, with 90 % ice", word, small, Some(small.0 / 24)),
        ("large/pane", "The window, 1920 x 1080 pixels", bent, large, None),
        ("large/word", "FROST, 1920 x 1080 pixels", word, large, Some(large.0 / 24)),
    ];
    let made =
        kept.map(|(name, caption, grown, size, margin)| (name, caption, photograph(grown, size, margin)));
    for (name, caption, photograph) in made {
        lab.keep(name, caption, photograph?)?;
    }
    let drawn = [("bent", bent), ("one lattice", straight)].map(|(what, grown)| -> Result<Picture> {
        let (frost, last) = (grown.film.frost(), grown.film.frame());
        let painter = Painter::of_sketch(&grown.sketch, lab.pick(340, 160), last, frost.parameters().beta)?;
        Ok(titled(&painter.draw_ice(frost), &format!("frame {last}, {what}"))?)
    });
    let [left, right] = drawn;
    lab.keep(
        "pane-age",
        "The plain pictures, coloured by the age of the ice: the bent lattice and the straight one",
        Picture::side_by_side(&[&left?, &right?], 8, GROUND)?,
    )
}
