//! Figure 2: the algorithm on a small lattice.

use snowglobe::frost::{Edge, Frost, Inflow, Parameters, Redraw, RingTouchingIce, State, algorithm};
use snowglobe::hexgrid::{Axial, Region};
use snowglobe::lab::{Artifact, Claim, Expect, Experiment, Known, Lab, Mutant, Result, Statistic, Table};

use super::setup::{Readings, Reconstruction, START};

pub const FIGURE_2: Experiment = Experiment {
    id: "figure-2",
    title: "Figure 2: the algorithm on a small lattice",
    source: "Fig. 2, §3.2",
    says: "Cells are ice, neighbours of ice, or neither. Ice and its neighbours gain gamma, the vapour of the others \
           diffuses with ice and its neighbours as 0, and the two fields add up to the next one.",
    claims: &[&STATES, &SUM, &NEIGHBOUR, &OTHER],
    run,
    mutant: Mutant {
        changes: "alpha",
        to: 0.5,
        why: "half the diffusion brings half the vapour",
        turns_red: &["amano/figure-2/neighbour", "amano/figure-2/other"],
    },
};

const ROUNDING: f64 = 1e-12;

static STATES: Claim = Claim {
    id: "amano/figure-2/states",
    source: "Fig. 2, left",
    says: "around one start, six cells are its neighbours",
    expect: Expect::Near { value: 6.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "a count",
    known: &[],
};
static SUM: Claim = Claim {
    id: "amano/figure-2/sum",
    source: "Fig. 2, right",
    says: "the two fields add up to the next state",
    expect: Expect::AtMost(0.0),
    statistic: Statistic::Each,
    reason: "the largest difference over all cells and ten steps; a sum of two numbers is exact to the bit",
    known: &[],
};
static NEIGHBOUR: Claim = Claim {
    id: "amano/figure-2/neighbour",
    source: "§3.2 with [2]",
    says: "a neighbour of the start keeps its vapour, gains gamma, and what three cells give it",
    expect: Expect::Near { value: 0.4425, within: ROUNDING },
    statistic: Statistic::Each,
    reason: "by hand: beta + gamma + alpha/12 of the vapour of the three neighbours that are neither ice nor beside it",
    known: &[
        Known {
            reading: "inflow=as-printed",
            evidence: "Eq. (1) as printed adds gamma alone, so the cell gets 0.355",
        },
        Known {
            reading: "inflow=only-ice-hidden",
            evidence: "under this reading five neighbours show their vapour, so the cell gets 0.355 + 5/12 of 0.35",
        },
    ],
};
static OTHER: Claim = Claim {
    id: "amano/figure-2/other",
    source: "§3.2",
    says: "two cells from the start, in a row with it, vapour flows to one receptive cell only",
    expect: Expect::Near { value: 0.320_833_333_333_333_3, within: ROUNDING },
    statistic: Statistic::Each,
    reason: "by hand: beta (1 - alpha/2) + alpha/12 of the vapour of five neighbours, the sixth shows 0",
    known: &[Known {
        reading: "inflow=only-ice-hidden",
        evidence: "under this reading only ice shows 0, and this cell touches none: it keeps 0.35",
    }],
};

fn run(lab: &mut Lab) -> Result<()> {
    let alpha = lab.assume("alpha", 1.0, "not given; 1 is Reiter's value for all his figures");
    let beta = lab.printed("beta", 0.35, "§4, for the pictures");
    let gamma = lab.printed("gamma", 0.005, "§4, for the pictures");
    let radius = lab.assume("radius", 3.0, "small enough to print numbers in the cells");
    let region = Region::hexagon(radius as u16);
    for inflow in lab.readings::<Inflow>() {
        let readings = Readings { inflow, ..Readings::DEFAULT };
        readings.tell(lab, Reconstruction::DEFAULT);
        let parameters = Parameters {
            alpha,
            beta,
            gamma,
            threshold: 0.0,
            steps_per_frame: 1,
            inflow,
            redraw: Redraw::Frame,
            edge: Edge::Reflecting,
            ring_touching_ice: RingTouchingIce::Zero,
        };
        let mut frost = Frost::new(&region, &START, parameters, lab.seed())?;
        let count = |state: State| (0..region.len()).filter(|i| frost.state(*i) == state).count();
        lab.found(&STATES, count(State::Neighbour) as f64);
        if readings == Readings::DEFAULT {
            lab.keep(
                "algorithm",
                "Fig. 2 from running code: (a) the three states and u, (b) the receptive cells, (c) the diffusing vapour, \
                 (d) their sum, which is the next u; alpha 1, beta 0.35, gamma 0.005",
                Artifact::Svg(algorithm(&frost)),
            )?;
            lab.keep("cells", "The same in numbers", numbers(&frost))?;
        }
        let mut largest: f64 = 0.0;
        for step in 0..10 {
            let addends = frost.addends();
            frost.step();
            for i in 0..region.len() {
                largest = largest.max((addends.receptive[i] + addends.diffusing[i] - frost.u(i)).abs());
            }
            if step == 0 {
                let u = |at| region.ordinal(at).map(|i| frost.u(i));
                lab.found(&NEIGHBOUR, u(Axial::new(1, 0)));
                lab.found(&OTHER, u(Axial::new(2, 0)));
            }
        }
        lab.found(&SUM, largest);
    }
    Ok(())
}

fn numbers(frost: &Frost) -> Table {
    let mut table = Table::new(["q", "r", "state", "u", "receptive", "diffusing"]);
    let addends = frost.addends();
    for (i, cell) in frost.region().cells().iter().enumerate() {
        let state = match frost.state(i) {
            State::Ice => "ice",
            State::Neighbour => "neighbour",
            State::Other => "other",
        };
        table.row([
            cell.q.into(),
            cell.r.into(),
            state.into(),
            frost.u(i).into(),
            addends.receptive[i].into(),
            addends.diffusing[i].into(),
        ]);
    }
    table
}
