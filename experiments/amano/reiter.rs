//! Reiter's own crystals, on which the paper builds: his pairs of beta and gamma, and the map between them.

use snowglobe::frost::{
    Edge, Frost, GROUND, Inflow, Painter, Parameters, Redraw, RingTouchingIce, measure, titled,
};
use snowglobe::hexgrid::{Axial, Region};
use snowglobe::image::Picture;
use snowglobe::lab::{Claim, Expect, Experiment, HeatMap, Lab, Mutant, Result, Statistic, Table};

use super::setup::START;

pub const REITER: Experiment = Experiment {
    id: "reiter",
    title: "Reiter's crystals",
    source: "§3.2; Reiter 2005",
    says: "The paper's rule is Reiter's with randomness added. His own crystals grow from one cell of ice over a \
           hexagon whose edge is held at beta, without randomness; beta and gamma decide between dendrites, stars, \
           sectors and plates.",
    claims: &[&SIX_FOLD, &PLATE, &DIVERSE],
    run,
    mutant: Mutant {
        changes: "reach",
        to: 0.0,
        why: "what is not let grow has one form only",
        turns_red: &["amano/reiter/diverse"],
    },
};

static SIX_FOLD: Claim = Claim {
    id: "amano/reiter/six-fold",
    source: "Reiter 2005",
    says: "his crystals have the symmetry of the lattice",
    expect: Expect::AtMost(0.0),
    statistic: Statistic::Each,
    reason: "the rule and the hexagon have the six turns and mirrors exactly, so every crystal must have them to the cell",
    known: &[],
};
static PLATE: Claim = Claim {
    id: "amano/reiter/plate",
    source: "Reiter 2005, beta 0 and gamma 1",
    says: "with beta 0 and gamma 1 a full hexagon grows by one cell a step",
    expect: Expect::AtMost(0.0),
    statistic: Statistic::Each,
    reason: "every receptive cell becomes ice at once: after n steps the ice is the hexagon of radius n; measured is \
             the number of cells that differ, over the first 40 steps",
    known: &[],
};
static DIVERSE: Claim = Claim {
    id: "amano/reiter/diverse",
    source: "Reiter 2005, abstract",
    says: "two parameters are enough for forms from dendrites to plates",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "the fullest of his five crystals over the most open, by the share of the surrounding hexagon that is ice: \
             a dendrite leaves more than half of it open, a plate less",
    known: &[],
};
/// His pairs of beta and gamma.
const PAIRS: [(f64, f64); 5] = [(0.35, 0.0), (0.4, 0.001), (0.4, 0.002), (0.8, 0.002), (0.95, 0.0)];
/// The plate whose form is known beforehand.
const FULL: (f64, f64) = (0.0, 1.0);
/// Radii of the hexagon, the one of the pictures first; 400 for those that grow in a thousand steps.
const RADII: [(u16, usize); 3] = [(200, 0), (100, 0), (400, 3)];
/// Steps after which a crystal that has not reached its edge is left.
const MOST_STEPS: u64 = 30_000;
/// Of the radius, where growth is stopped.
const REACH: f64 = 0.9;
/// The map.
const BETAS: [f64; 7] = [0.3, 0.35, 0.4, 0.5, 0.65, 0.8, 0.95];
const GAMMAS: [f64; 7] = [0.0, 0.0001, 0.0003, 0.001, 0.002, 0.005, 0.02];
const MAP_RADIUS: u16 = 70;

/// A crystal and how far it got.
struct Crystal {
    frost: Frost,
    fill: f64,
}

fn run(lab: &mut Lab) -> Result<()> {
    let alpha = lab.assume("alpha", 1.0, "Reiter's, for all his crystals");
    let reach = lab.assume(
        "reach",
        REACH,
        "the share of the radius at which growth is stopped, short of the edge held at beta",
    );
    let radii = lab.pick(&RADII[..], &[(20, 0)]);
    let jobs: Vec<(u16, (f64, f64))> = radii
        .iter()
        .flat_map(|(radius, first)| PAIRS[*first..].iter().map(move |pair| (*radius, *pair)))
        .collect();
    let crystals = lab.each(&jobs, |(radius, (beta, gamma))| grow(*radius, reach, alpha, *beta, *gamma));
    let crystals = crystals.into_iter().collect::<Result<Vec<Crystal>>>()?;
    let largest = &crystals[..PAIRS.len()];
    lab.reading(Edge::Held);

    let asymmetries = crystals.iter().map(|c| measure::asymmetry(&c.frost.ice_cells(), START[0]));
    lab.found(&SIX_FOLD, asymmetries.fold(0.0, f64::max));
    lab.found(&PLATE, plate(alpha)? as f64);
    let fills: Vec<f64> = largest.iter().map(|c| c.fill).collect();
    let (least, most) = fills.iter().fold((f64::MAX, 0.0), |(a, b): (f64, f64), f| (a.min(*f), b.max(*f)));
    lab.found(&DIVERSE, Some(most / least).filter(|_| largest.iter().all(|c| c.frost.ice() > 7)));
    lab.count("cell updates", crystals.iter().map(|c| c.frost.updates()).sum());

    if !lab.keeps() {
        return Ok(());
    }
    table(lab, &jobs, &crystals)?;
    let full = grow(jobs[0].0, reach, alpha, FULL.0, FULL.1)?;
    let shown = PAIRS.iter().zip(largest).chain([(&FULL, &full)]);
    let painted = shown
        .map(|((beta, gamma), crystal)| titled(&portrait(crystal, 270)?, &format!("β {beta}, γ {gamma}")))
        .collect::<std::result::Result<Vec<Picture>, _>>()?;
    lab.keep(
        "crystals",
        "Reiter's pairs of β and γ on the hexagon of radius 200, each when it reaches nine tenths of the radius; the \
         later a cell froze, the lighter",
        Picture::grid(&painted.iter().collect::<Vec<_>>(), 3, 8, GROUND)?,
    )?;
    map(lab, alpha)
}

fn parameters(alpha: f64, beta: f64, gamma: f64) -> Parameters {
    Parameters {
        alpha,
        beta,
        gamma,
        threshold: 0.0,
        steps_per_frame: 1,
        inflow: Inflow::ReiterGated,
        redraw: Redraw::Frame,
        edge: Edge::Held,
        ring_touching_ice: RingTouchingIce::Zero,
    }
}

/// Grows a crystal until one of its arms, which lie on the axes of the lattice, is as long as it may be.
fn grow(radius: u16, reach: f64, alpha: f64, beta: f64, gamma: f64) -> Result<Crystal> {
    let region = Region::hexagon(radius);
    let mut frost = Frost::new(&region, &START, parameters(alpha, beta, gamma), snowglobe::rng::Seed(1))?;
    let reach = libm::floor(reach * f64::from(radius)) as i32;
    let tip = region.ordinal(Axial::new(reach, 0)).unwrap_or(0);
    while !frost.is_ice(tip) && frost.step_count() < MOST_STEPS {
        frost.step();
    }
    let length = frost.ice_cells().iter().map(|at| steps_from_centre(*at)).max().unwrap_or(0);
    let fill = frost.ice() as f64 / Region::hexagon(length as u16).len() as f64;
    Ok(Crystal { frost, fill })
}

fn steps_from_centre(at: Axial) -> i32 {
    at.q.abs().max(at.r.abs()).max((at.q + at.r).abs())
}

/// Cells in which the crystal of beta 0 and gamma 1 differs from the hexagon that it must be, over 40 steps.
fn plate(alpha: f64) -> Result<usize> {
    let region = Region::hexagon(42);
    let mut frost = Frost::new(&region, &START, parameters(alpha, 0.0, 1.0), snowglobe::rng::Seed(1))?;
    let mut differing = 0;
    for step in 1..=40 {
        frost.step();
        let cells = region.cells().iter().enumerate();
        differing += cells.filter(|(i, at)| frost.is_ice(*i) != (steps_from_centre(**at) <= step)).count();
    }
    Ok(differing)
}

fn table(lab: &mut Lab, jobs: &[(u16, (f64, f64))], crystals: &[Crystal]) -> Result<()> {
    let mut table = Table::new([
        "radius",
        "beta",
        "gamma",
        "steps",
        "ice",
        "filled_share",
        "raggedness",
        "box_dimension",
    ]);
    for ((radius, (beta, gamma)), crystal) in jobs.iter().zip(crystals) {
        let ice = crystal.frost.ice_cells();
        table.row([
            radius.into(),
            beta.into(),
            gamma.into(),
            crystal.frost.step_count().into(),
            ice.len().into(),
            crystal.fill.into(),
            measure::raggedness(&ice).into(),
            snowglobe::lab::maybe(measure::box_dimension(&ice)),
        ]);
    }
    lab.keep(
        "crystals",
        "Each crystal: its steps, its ice, the share of the surrounding hexagon that it fills, its boundary over the \
         root of its area, and the box dimension of its boundary",
        table,
    )
}

fn portrait(crystal: &Crystal, width: u32) -> std::result::Result<Picture, snowglobe::image::ImageError> {
    let frost = &crystal.frost;
    let beta = frost.parameters().beta;
    Ok(Painter::new(frost.region(), width, frost.step_count(), beta)?.draw(frost))
}

/// A crystal for each pair of beta and gamma.
fn map(lab: &mut Lab, alpha: f64) -> Result<()> {
    let betas = lab.pick(&BETAS[..], &BETAS[..1]);
    let gammas = lab.pick(&GAMMAS[..], &GAMMAS[..2]);
    let radius = lab.pick(MAP_RADIUS, 20);
    let jobs: Vec<(f64, f64)> =
        betas.iter().flat_map(|beta| gammas.iter().map(move |gamma| (*beta, *gamma))).collect();
    let crystals = lab.each(&jobs, |(beta, gamma)| {
        let crystal = grow(radius, REACH, alpha, *beta, *gamma)?;
        let picture = titled(&portrait(&crystal, 104)?, &format!("β {beta} γ {gamma}"))?;
        Ok((crystal, picture))
    });
    let crystals = crystals.into_iter().collect::<Result<Vec<_>>>()?;
    lab.count("cell updates", crystals.iter().map(|(c, _)| c.frost.updates()).sum());
    lab.keep(
        "map",
        "A crystal for each pair of β (down) and γ (across), on the hexagon of radius 70, when it reaches nine tenths of \
         the radius or after 30,000 steps",
        Picture::grid(&crystals.iter().map(|(_, p)| p).collect::<Vec<_>>(), gammas.len(), 4, GROUND)?,
    )?;
    lab.keep(
        "map",
        "The share of the surrounding hexagon that each crystal of the map fills: dark is full",
        HeatMap {
            title: "Share of the surrounding hexagon that is ice".to_owned(),
            x: ("γ per step".to_owned(), gammas.iter().map(f64::to_string).collect()),
            y: ("β".to_owned(), betas.iter().map(f64::to_string).collect()),
            cells: crystals
                .chunks(gammas.len())
                .map(|row| row.iter().map(|(c, _)| Some(c.fill)).collect())
                .collect(),
            darkest: 1.0,
            accepted: None,
            digits: 2,
        },
    )
}
