//! Figure 5: the tree at 5 m/s after 0, 1, 2 and 3 s, and at 7 and 10 m/s after 3 s.

use snowglobe::image::Picture;
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic,
    Table, smallest_rise,
};
use snowglobe::reading::Reading;
use snowglobe::tree::{Bend, Frame, ReadingSet};

use super::setup::{Setup, beyond, blow};

pub const FIGURE_5: Experiment = Experiment {
    id: "figure-5",
    title: "Figure 5: the tree in winds of 5, 7 and 10 m/s",
    source: "Fig. 5, §6",
    says: "(a) to (d): a wind of 5 m/s at the start and after 1, 2 and 3 s; (e), (f): 7 and 10 m/s after 3 s. The tree \
           bends the more, the stronger the wind.",
    claims: &[&GROWS, &BENDS_MORE, &LEEWARD, &LINKS_KEPT],
    run,
    mutant: Mutant {
        changes: "wind coefficient",
        to: 0.0,
        why: "a wind that does not push does not bend",
        turns_red: &["sakai/figure-5/grows", "sakai/figure-5/bends-more", "sakai/figure-5/leeward"],
    },
};

static GROWS: Claim = Claim {
    id: "sakai/figure-5/grows",
    source: "Fig. 5 (a) to (d)",
    says: "at 5 m/s the bend grows from second to second",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "mean bend in degrees after 0, 1, 2 and 3 s, each less that of the same second without wind",
    known: &[Known {
        reading: "set=literal",
        evidence: "the tree has fallen within the first second, with wind or without (bend.csv)",
    }],
};
static BENDS_MORE: Claim = Claim {
    id: "sakai/figure-5/bends-more",
    source: "Fig. 5 (d) to (f), §6",
    says: "after 3 s the tree is bent more at 7 than at 5 m/s, and more at 10 than at 7",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "mean bend in degrees, less that without wind",
    known: &[],
};
static LEEWARD: Claim = Claim {
    id: "sakai/figure-5/leeward",
    source: "Fig. 5 (d)",
    says: "the tree leans the way that the wind blows",
    expect: Expect::AtLeast(0.01),
    statistic: Statistic::Each,
    reason: "displacement of the tip along a wind of 5 m/s after 3 s, less that without wind, m: a centimetre is the \
             least that shows in a picture of ten metres",
    known: &[],
};
static LINKS_KEPT: Claim = Claim {
    id: "sakai/figure-5/links-kept",
    source: "§3.6, Eq. (11)",
    says: "links keep their lengths",
    expect: Expect::AtMost(1e-12),
    statistic: Statistic::Each,
    reason: "largest relative change of a link in the six frames: a length is divided out and multiplied in, so only \
             rounding is left",
    known: &[],
};

/// Wind in m/s and time in s of each frame of the figure.
const FRAMES: [(&str, f64, f64); 6] = [
    ("(a)", 5.0, 0.0),
    ("(b)", 5.0, 1.0),
    ("(c)", 5.0, 2.0),
    ("(d)", 5.0, 3.0),
    ("(e)", 7.0, 3.0),
    ("(f)", 10.0, 3.0),
];
const FILM: f64 = 10.0;
const FRAMES_PER_SECOND: u16 = 25;

/// One of the six.
struct Shown {
    frame: Frame,
    bend: Bend,
    still: Bend,
    stretch: f64,
}

fn run(lab: &mut Lab) -> Result<()> {
    let setup = Setup::new(lab);
    let mut table = Table::new([
        "set",
        "frame",
        "wind_m_s",
        "time_s",
        "tip_x",
        "tip_y",
        "mean_bend_deg",
        "still_tip_x",
        "still_mean_bend_deg",
    ]);
    let mut curves = Vec::new();
    for set in lab.readings::<ReadingSet>() {
        let shown = lab.each(&FRAMES, |(name, wind, seconds)| show(&setup, set, name, *wind, *seconds));
        let shown = shown.into_iter().collect::<Result<Vec<Shown>>>()?;
        let bent: Vec<f64> = shown.iter().map(|s| beyond(&s.bend, &s.still)[1]).collect();
        lab.reading(set);
        lab.found(&GROWS, smallest_rise(&bent[..4]));
        lab.found(&BENDS_MORE, smallest_rise(&bent[3..]));
        lab.found(&LEEWARD, shown[3].bend.tip.x - shown[3].still.tip.x);
        lab.found(&LINKS_KEPT, shown.iter().map(|s| s.stretch).fold(0.0, f64::max));
        lab.count("steps", FRAMES.iter().map(|(_, _, seconds)| 2 * setup.steps(*seconds)).sum());
        for ((name, wind, seconds), s) in FRAMES.iter().zip(&shown) {
            table.row([
                set.name().into(),
                (*name).into(),
                (*wind).into(),
                (*seconds).into(),
                s.bend.tip.x.into(),
                s.bend.tip.y.into(),
                s.bend.mean_angle.into(),
                s.still.tip.x.into(),
                s.still.mean_angle.into(),
            ]);
        }
        let frames: Vec<&Frame> = shown.iter().map(|s| &s.frame).collect();
        lab.keep(
            &format!("frames-{}", set.name()),
            &format!("Fig. 5 re-run under the set `{}`; arrows are the computed wind", set.name()),
            Frame::sheet(&frames, 3, 360),
        )?;
        curves.push(film(lab, &setup, set)?);
    }
    lab.keep("bend", "Displacement of the tip and mean bend in the six frames, and without wind", table)?;
    lab.keep(
        "tip",
        "The tip at 5 m/s",
        Plot {
            title: "Displacement of the tip along the wind, 5 m/s".to_owned(),
            x: Axis::of("time (s)"),
            y: Axis::of("displacement (m)"),
            series: curves,
            bands: Vec::new(),
        },
    )
}

fn show(setup: &Setup, set: ReadingSet, name: &str, wind: f64, seconds: f64) -> Result<Shown> {
    let mut sway = setup.sway(set, wind)?;
    blow(&mut sway, setup.steps(seconds))?;
    let (tree, rest) = (sway.tree(), sway.tree().skeleton());
    let stretched = |node: usize| {
        let parent = rest.parent(node)?;
        Some(((tree.place(node) - tree.place(parent)).norm() / rest.length(node) - 1.0).abs())
    };
    let stretch = (0..rest.nodes()).filter_map(stretched).fold(0.0, f64::max);
    let frame = Frame::of(&sway, format!("{name} {wind} m/s, {seconds} s"));
    Ok(Shown { frame, bend: tree.bend(), still: setup.bend(set, 0.0, seconds)?, stretch })
}

/// Ten seconds of film at 5 m/s, and the tip's way.
fn film(lab: &mut Lab, setup: &Setup, set: ReadingSet) -> Result<Series> {
    let mut sway = setup.sway(set, 5.0)?;
    let seconds = lab.pick(FILM, 0.2);
    let per_frame = setup.steps(1.0 / f64::from(FRAMES_PER_SECOND));
    let (mut drawings, mut points) = (Vec::new(), Vec::new());
    for _ in 0..=libm::round(seconds * f64::from(FRAMES_PER_SECOND)) as u64 {
        points.push((sway.time(), sway.tree().bend().tip.x));
        if lab.keeps() {
            drawings.push(Frame::of(&sway, format!("{}, 5 m/s, {:.2} s", set.name(), sway.time())));
        }
        blow(&mut sway, per_frame)?;
    }
    let frames = lab.each(&drawings, |frame| frame.picture(420));
    let frames = frames.into_iter().collect::<std::result::Result<Vec<Picture>, _>>()?;
    if !frames.is_empty() {
        lab.keep(
            &format!("film-{}", set.name()),
            &format!("Ten seconds at 5 m/s under the set `{}`", set.name()),
            Artifact::Animation { frames, frames_per_second: FRAMES_PER_SECOND },
        )?;
    }
    Ok(Series::new(set.name(), Draw::Line, points))
}
