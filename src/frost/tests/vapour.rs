//! Vapour that differs from cell to cell.

use argmin::core::CostFunction;

use super::super::standstill::Watch;
use super::*;

/// One of a few kinds of vapour in each cell: almost ice, and ice, among them.
fn any_vapour(region: &Region, case: u64) -> Vec<f64> {
    let stream = Seed(7).stream("vapour").at(case);
    let kinds = [-0.0, 0.05, 0.3, 0.6, 0.95, 1.0 - 1e-16, 1.0, 1.7];
    let most = [1.0, 0.9, 0.7][case as usize % 3];
    let of_cell = |at: &Axial| {
        let mut place = stream.place(at.r, at.q, 0);
        let kind = (place.uniform() * most * kinds.len() as f64) as usize;
        if place.uniform() < 0.5 { kinds[kind] } else { kinds[kind] * place.uniform() }
    };
    region.cells().iter().map(of_cell).collect()
}

fn plain(region: &Region, starts: &[Axial], parameters: Parameters, seed: Seed, vapour: &[f64]) -> Frost {
    Frost::begin(region, starts, parameters, seed, Some(vapour), false).unwrap()
}

fn assert_same(a: &Frost, b: &Frost, case: u64) {
    assert_eq!(bits(a), bits(b), "case {case}, step {}: {:?}", a.step_count(), a.parameters());
    for ordinal in 0..a.region().len() {
        assert_eq!(a.state(ordinal), b.state(ordinal), "case {case}");
        assert_eq!(a.frozen_at_step(ordinal), b.frozen_at_step(ordinal), "case {case}");
    }
    assert_eq!(a.ice(), b.ice());
}

#[test]
fn the_same_vapour_in_all_cells_is_beta() {
    for case in 0..600 {
        let (region, starts, parameters) = any_case(case);
        let vapour = vec![parameters.beta; region.len()];
        // What the edge holds is beta; else no beta may matter.
        let beta = if parameters.edge == Edge::Held { parameters.beta } else { 0.77 };
        let other = Parameters { beta, ..parameters };
        let mut one = Frost::new(&region, &starts, parameters, Seed(case)).unwrap();
        let mut all = Frost::with_vapour(&region, &starts, other, Seed(case), &vapour).unwrap();
        let mut slow = plain(&region, &starts, other, Seed(case), &vapour);
        for _ in 0..25 {
            assert_same(&one, &all, case);
            assert_same(&one, &slow, case);
            one.step();
            all.step();
            slow.step();
        }
    }
}

#[test]
fn the_fast_form_gives_the_bits_of_the_plain_form_with_any_vapour() {
    let mut grown = 0;
    for case in 0..900 {
        let (region, starts, mut parameters) = any_case(case);
        parameters.inflow = if case % 2 == 0 { Inflow::OnlyIceHidden } else { Inflow::ReiterGated };
        let vapour = any_vapour(&region, case);
        let mut fast = Frost::with_vapour(&region, &starts, parameters, Seed(case), &vapour).unwrap();
        let mut slow = plain(&region, &starts, parameters, Seed(case), &vapour);
        let at_first = fast.ice();
        for _ in 0..30 {
            assert_same(&fast, &slow, case);
            fast.step();
            slow.step();
        }
        grown += usize::from(fast.ice() > at_first);
    }
    assert!(grown > 300, "only {grown} cases grew: they show little");
}

#[test]
fn vapour_that_no_cell_can_hold_is_named_with_its_cell() {
    let region = Region::hexagon(1);
    let refused = |vapour: &[f64]| {
        let frost = Frost::with_vapour(&region, &[Axial::ORIGIN], GIVEN, Seed(1), vapour);
        frost.map(|_| ()).unwrap_err().to_string()
    };
    let mut vapour = [0.3; 7];
    for (value, said) in [(-0.1, "-0.1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf"), (1.1e6, "1100000")] {
        vapour[5] = value;
        assert_eq!(
            refused(&vapour),
            format!("the vapour of the cell -1,1 is {said}; 0 to 1000000 is handled")
        );
    }
    assert_eq!(refused(&[0.3; 6]), "6 numbers are given; 7 are needed, one for each cell");
}

/// Directions that are given up are not reached by going on.
#[test]
fn no_direction_is_given_up_too_soon() {
    let (mut at_work, mut given_up) = (0, 0);
    for case in 0..1500 {
        let (region, starts, parameters) = any_case(case);
        let vapour = any_vapour(&region, case);
        let sectors = Sectors::around(&region, region.cells()[0], 1 + case as usize % 9).unwrap();
        let directions = Directions::new(&region, &sectors, 0.7).unwrap();
        let frost = Frost::with_vapour(&region, &starts, parameters, Seed(case), &vapour).unwrap();
        let seen = arrivals(frost, &directions, 200).unwrap();
        let mut slow = plain(&region, &starts, parameters, Seed(case), &vapour);
        (0..200).for_each(|_| slow.frame());
        for arrival in seen {
            assert_eq!(
                arrival.end.map(|end| end.frame),
                by_counting(&slow, &sectors, arrival, 0.7),
                "{case}"
            );
            at_work += usize::from(arrival.end.is_some_and(|end| end.frame > 0));
            given_up += usize::from(arrival.end.is_none());
        }
    }
    assert!(at_work > 300 && given_up > 300, "{at_work} and {given_up}: they show little");
}

/// beta counts where the edge holds it and nowhere else; then the greatest vapour does.
#[test]
fn ice_out_of_nothing_is_reckoned_with_where_it_may_come() {
    let region = Region::hexagon(3);
    for (edge, beta, most, may) in [
        (Edge::Reflecting, 1.2, 0.3, false),
        (Edge::Held, 1.2, 0.3, true),
        (Edge::Held, 0.2, 0.3, false),
        (Edge::Reflecting, 0.2, 1.0 - 1e-12, true),
    ] {
        let parameters = Parameters { beta, edge, ..GIVEN };
        let mut vapour = vec![0.1; region.len()];
        vapour[20] = most;
        let mut frost = Frost::with_vapour(&region, &[], parameters, Seed(1), &vapour).unwrap();
        let watch = Watch::new(&frost);
        assert!((0..region.len()).all(|i| watch.may_freeze(i) == may), "{edge} {beta} {most}");
        (0..50).for_each(|_| frost.frame());
        assert!(may || frost.ice() == 0);
        assert_eq!(frost.ice() > 0, beta > 1.0 && edge == Edge::Held);
    }
}

/// The frame of an arrival, from when every cell of the border in its direction froze.
fn by_counting(grown: &Frost, sectors: &Sectors, arrival: Arrival, share: f64) -> Option<u64> {
    let border = grown.region().border().into_iter().filter(|&i| sectors.of(i) == arrival.direction);
    let mut frozen: Vec<u64> = border.map(|i| grown.frozen_in_frame(i).unwrap_or(u64::MAX)).collect();
    frozen.sort_unstable();
    assert_eq!(frozen.len(), arrival.border);
    let enough = (1..=frozen.len()).find(|k| *k as f64 / frozen.len() as f64 >= share).unwrap();
    Some(frozen[enough - 1]).filter(|frame| *frame <= 200)
}

const START: [Axial; 1] = [Axial::new(-6, 2)];

fn objective(region: &Region, count: usize, threshold: f64) -> SectorObjective<'_> {
    let sectors = |count| Sectors::around(region, START[0], count).unwrap();
    SectorObjective {
        region,
        starts: &START,
        parameters: Parameters { threshold, gamma: 0.005 / (1.0 - threshold), ..GIVEN },
        seed: Seed(5),
        sectors: sectors(count),
        directions: Directions::new(region, &sectors(Directions::USUAL), 0.9).unwrap(),
        target: 70.0,
        t_sim: TSim::Interpolated,
        frame_limit: 200,
    }
}

#[test]
fn arrivals_are_the_frames_in_which_the_border_froze() {
    let region = Region::rectangle(9.0, 7.0);
    let betas = [0.5, 0.25, 0.3, 0.2, 0.45, 0.35];
    for threshold in [0.0, 0.8] {
        let objective = objective(&region, 6, threshold);
        let misses = objective.misses(&betas).unwrap();
        let vapour = objective.sectors.field(&betas).unwrap();
        let mut slow = plain(&region, &START, objective.parameters, Seed(5), &vapour);
        (0..200).for_each(|_| slow.frame());
        let sectors = Sectors::around(&region, START[0], 12).unwrap();
        assert_eq!(objective.directions.numbers().count(), 12);
        let mut sum = 0.0;
        for (arrival, residual) in misses.arrivals.iter().zip(&misses.residuals) {
            let end = arrival.end.unwrap();
            assert_eq!(Some(end.frame), by_counting(&slow, &sectors, *arrival, 0.9));
            assert!(end.interpolated > end.frame as f64 - 1.0 && end.interpolated <= end.frame as f64);
            assert_eq!(*residual, end.interpolated - 70.0);
            sum += residual * residual;
        }
        assert_eq!(objective.cost(&betas.to_vec()).unwrap(), sum / 12.0);
        assert_eq!(misses.root_mean_square(), (sum / 12.0).sqrt());
        assert!(misses.residuals.iter().any(|miss| miss.abs() == misses.greatest()));
    }
}

/// So that more sectors can never do worse.
#[test]
fn sectors_that_agree_are_one_sector() {
    let region = Region::rectangle(9.0, 7.0);
    for threshold in [0.0, 0.8] {
        let of = |betas: &[f64]| objective(&region, betas.len(), threshold).misses(betas).unwrap();
        let two = [0.4, 0.28];
        let repeated = |count: usize| -> Vec<f64> { (0..count).map(|k| two[k * 2 / count]).collect() };
        for count in [6, 12] {
            assert_eq!(of(&two), of(&repeated(count)));
        }
        let mut one = objective(&region, 1, threshold);
        one.parameters.beta = 0.35;
        let mut paper = Frost::new(&region, &START, one.parameters, Seed(5)).unwrap();
        let mut frost = one.frost(&[0.35]).unwrap();
        (0..40).for_each(|_| paper.frame());
        (0..40).for_each(|_| frost.frame());
        assert_eq!(bits(&paper), bits(&frost));
        assert_eq!(of(&[0.35]), of(&[0.35; 12]));
    }
}

#[test]
fn ice_that_does_not_arrive_counts_as_the_last_frame_that_is_allowed() {
    let region = Region::rectangle(9.0, 7.0);
    let mut objective = objective(&region, 1, 0.0);
    objective.frame_limit = 10;
    let late = objective.misses(&[0.2]).unwrap();
    assert!(late.arrivals.iter().all(|arrival| arrival.end.is_none()));
    assert!(late.residuals.iter().all(|miss| *miss == -60.0));
    objective.parameters.gamma = 0.0;
    objective.frame_limit = u64::MAX;
    assert!(objective.cost(&vec![0.05]).unwrap().is_finite(), "a standstill ends it");
    // Ice everywhere at once arrives in frame 0.
    assert_eq!(objective.misses(&[1.0]).unwrap().greatest(), 70.0);
    assert!(objective.cost(&vec![-0.1]).is_err());
}

#[test]
fn directions_of_another_region_are_refused() {
    let (large, small) = (Region::hexagon(4), Region::hexagon(3));
    let sectors = Sectors::around(&large, Axial::ORIGIN, 12).unwrap();
    assert!(matches!(Directions::new(&small, &sectors, 0.9), Err(FrostError::Count { .. })));
    assert!(matches!(Directions::new(&large, &sectors, 0.0), Err(FrostError::Share(_))));
    let directions = Directions::new(&large, &sectors, 0.9).unwrap();
    let frost = Frost::new(&small, &[Axial::ORIGIN], GIVEN, Seed(1)).unwrap();
    assert!(matches!(arrivals(frost, &directions, 10), Err(FrostError::Count { .. })));
    // One direction of many: the others have no border.
    let line = Region::new((0..9).map(|q| Axial::new(q, 0))).unwrap();
    let sectors = Sectors::around(&line, Axial::ORIGIN, 12).unwrap();
    assert_eq!(Directions::new(&line, &sectors, 0.9).unwrap().numbers().collect::<Vec<_>>(), [0]);
}

#[test]
fn six_betas_bring_ice_to_the_border_together_where_one_cannot() {
    let region = Region::disc(170);
    let start = [Axial::new(-5, 0)];
    let miss = |betas: &[f64]| {
        let sectors = |count| Sectors::around(&region, start[0], count).unwrap();
        let objective = SectorObjective {
            starts: &start,
            sectors: sectors(betas.len()),
            directions: Directions::new(&region, &sectors(Directions::USUAL), 0.9).unwrap(),
            target: 80.0,
            frame_limit: 600,
            ..objective(&region, 1, 0.0)
        };
        objective.misses(betas).unwrap().root_mean_square()
    };
    let best_of_one = (1..=48).map(|k| miss(&[0.02 * f64::from(k)])).fold(f64::INFINITY, f64::min);
    let six = miss(&[0.422, 0.275, 0.07, 0.086, 0.255, 0.365]);
    assert!(best_of_one > 20.0 && six < 5.0, "{best_of_one} and {six} frames");
}
