//! Table 1: the search for an initial value at threshold 0, row by row.

use snowglobe::frost::{Inflow, Redraw, RingTouchingIce};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table, maybe,
};
use snowglobe::reading::Reading;

use super::setup::{Readings, Reconstruction, Setup, is_own_reading, keep_cells};

pub const TABLE_1: Experiment = Experiment {
    id: "table-1",
    title: "Table 1: end frames at threshold 0",
    source: "Table 1, §4",
    says: "At r_th 0, steepest descent goes from beta 0.25, whose film ends in frame 160, to 0.307597, whose film ends \
           in frame 126. Each printed initial value is run again; the target is frame 130, the tolerance 4 frames. Half the width of the sketch and the steps in a frame \
           are the two numbers that were fitted to the eight rows of both tables: these rows are fitted, not predicted.",
    claims: &[&STEP_0, &STEP_1, &STEP_2, &STEP_3, &ORDER],
    run,
    mutant: Mutant {
        changes: "gamma (hexagon-1387)",
        to: 0.02,
        why: "with four times the gamma the film ends far too early",
        turns_red: &[
            "amano/table-1/step-0",
            "amano/table-1/step-1",
            "amano/table-1/step-2",
            "amano/table-1/step-3",
        ],
    },
};

const WITHIN: &str = "the paper's own tolerance, 1/6 s at 24 frames a second (§3.4, §4)";

const fn row(id: &'static str, source: &'static str, says: &'static str, value: f64) -> Claim {
    Claim {
        id,
        source,
        says,
        expect: Expect::Near { value, within: 4.0 },
        statistic: Statistic::Each,
        reason: WITHIN,
        known: &[AS_PRINTED, SLOW_1, SLOW_2, SLOW_3, FAST],
    }
}

const AS_PRINTED: Known = Known {
    reading: "inflow=as-printed",
    evidence: "gamma alone takes (1 - 0.25)/0.005 = 150 steps for each further layer of cells: endless in 260 frames",
};
const MASS: &str = "with one step in a frame and gamma 0.005 growth lives on the vapour alone, which is too little: \
                    endless in 260 frames";
const SLOW_1: Known = Known { reading: "inflow=reiter-gated;reconstruction=disc-5239", evidence: MASS };
const SLOW_2: Known = Known { reading: "inflow=passive-is-vapour;reconstruction=disc-5239", evidence: MASS };
const SLOW_3: Known = Known { reading: "inflow=passive-diffuses;reconstruction=disc-5239", evidence: MASS };
const FAST: Known = Known {
    reading: "inflow=only-ice-hidden;reconstruction=hexagon-1387",
    evidence: "nine steps in a frame fill the sketch within ten frames: this reading wants one step in a frame",
};

static STEP_0: Claim =
    row("amano/table-1/step-0", "Table 1, step 0", "with beta 0.25 the film ends in frame 160", 160.0);
static STEP_1: Claim =
    row("amano/table-1/step-1", "Table 1, step 1", "with beta 0.261856 the film ends in frame 152", 152.0);
static STEP_2: Claim =
    row("amano/table-1/step-2", "Table 1, step 2", "with beta 0.295357 the film ends in frame 139", 139.0);
static STEP_3: Claim =
    row("amano/table-1/step-3", "Table 1, step 3", "with beta 0.307597 the film ends in frame 126", 126.0);
static ORDER: Claim = Claim {
    id: "amano/table-1/order",
    source: "Table 1",
    says: "the more vapour at first, the sooner the film ends",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "the sign of the effect, whatever the size: the smallest gain in frames from row to row is above 0",
    known: &[AS_PRINTED, SLOW_1, SLOW_2, SLOW_3, FAST],
};

/// (initial value, end frame) as printed.
pub const PRINTED: [(f64, f64); 4] =
    [(0.25, 160.0), (0.261_856, 152.0), (0.295_357, 139.0), (0.307_597, 126.0)];

fn run(lab: &mut Lab) -> Result<()> {
    let threshold = lab.printed("r_th", 0.0, "Table 1");
    let rows = [&STEP_0, &STEP_1, &STEP_2, &STEP_3];
    let betas = lab.pick(&PRINTED[..], &PRINTED[..1]);
    let mut setups = Vec::new();
    for reconstruction in lab.readings::<Reconstruction>() {
        for inflow in lab.readings::<Inflow>() {
            for ring in lab.readings::<RingTouchingIce>() {
                // At threshold 0 no r is ever drawn.
                let readings = Readings { inflow, redraw: Redraw::Frame, ring };
                setups.push((
                    reconstruction,
                    readings,
                    Setup::of_tables(lab, reconstruction, threshold, readings),
                ));
            }
        }
    }
    let films: Vec<_> =
        setups.iter().flat_map(|(_, _, s)| betas.iter().map(move |(beta, _)| (s, *beta))).collect();
    let ends = lab
        .each(&films, |(setup, beta)| setup.end_frame(*beta, 1))
        .into_iter()
        .collect::<Result<Vec<_>>>()?;

    let mut table = Table::new([
        "reconstruction",
        "inflow",
        "ring_touching_ice",
        "step",
        "beta",
        "end_frame_printed",
        "end_frame",
        "end_frame_interpolated",
    ]);
    let mut measured = Vec::new();
    for ((reconstruction, readings, setup), ends) in setups.iter().zip(ends.chunks(betas.len())) {
        readings.tell(lab, *reconstruction);
        for (step, (((beta, printed), end), claim)) in betas.iter().zip(ends).zip(rows).enumerate() {
            let command = setup.command("table-1", *beta, 1);
            lab.found(claim, end.map(|end| end.frame as f64)).by(end.map_or(String::new(), |_| command));
            table.row([
                reconstruction.name().into(),
                readings.inflow.name().into(),
                readings.ring.name().into(),
                step.into(),
                beta.into(),
                printed.into(),
                maybe(end.map(|end| end.frame)),
                maybe(end.map(|end| end.interpolated)),
            ]);
        }
        for claim in rows.into_iter().skip(betas.len()) {
            lab.found(claim, None);
        }
        let sooner: Option<Vec<f64>> = ends.iter().map(|end| end.map(|end| -(end.frame as f64))).collect();
        lab.found(&ORDER, sooner.as_deref().and_then(snowglobe::lab::smallest_rise));
        if *readings == reconstruction.readings() {
            let points = betas.iter().zip(ends).filter_map(|((b, _), end)| Some((*b, (*end)?.interpolated)));
            measured.push(Series::new(
                format!("{}, {}", reconstruction.name(), readings.inflow),
                Draw::Joined,
                points,
            ));
        }
    }
    lab.keep(
        "table-1",
        "Table 1 as printed and as measured with both reconstructions",
        table.only(is_own_reading),
    )?;
    lab.keep("end-frames", "Table 1 under every reading", table)?;
    measured.push(Series::new("Table 1 as printed", Draw::Printed, PRINTED));
    lab.keep(
        "end-frames",
        "Table 1: end frame against the initial value, printed and measured, with the tolerance around the target",
        Plot {
            title: "End frame against initial value, r_th 0".to_owned(),
            x: Axis::of("initial value β"),
            y: Axis::of("end frame"),
            series: measured,
            bands: vec![("130 ± 4".to_owned(), 126.0, 134.0)],
        },
    )?;
    keep_cells(lab, setups.iter().map(|(_, _, setup)| setup))
}
