//! What no single file of the module can show.

mod ends;
mod vapour;

use super::*;
use crate::frost::measure::asymmetry;
use crate::rng::Place;

const GIVEN: Parameters = Parameters {
    alpha: 1.0,
    beta: 0.25,
    gamma: 0.005,
    threshold: 0.0,
    steps_per_frame: 12,
    inflow: Inflow::ReiterGated,
    redraw: Redraw::Frame,
    edge: Edge::Reflecting,
    ring_touching_ice: RingTouchingIce::Zero,
};
const NINE_TENTHS: EndRule = EndRule { share: 0.9, of: EndOf::AllCells };

fn one_of<T: Copy>(place: &mut Place, of: &[T]) -> T {
    of[(place.next_u64() % of.len() as u64) as usize]
}

/// A small region with holes and pieces, up to three starts in it, and parameters.
fn any_case(case: u64) -> (Region, Vec<Axial>, Parameters) {
    let mut place = Seed(1).stream("cases").at(case).place(0, 0, 0);
    let (columns, rows) = (1 + place.next_u64() as i32 % 14, 1 + place.next_u64() as i32 % 9);
    let (columns, rows) = (columns.abs() + 1, rows.abs() + 1);
    let density = one_of(&mut place, &[0.3, 0.8, 0.95, 1.0]);
    let mut cells = vec![Axial::new(one_of(&mut place, &[-40, 0, 7]), 3)];
    for r in 0..rows {
        for q in 0..columns {
            if place.uniform() < density {
                cells.push(Axial::new(q - 5, r - 2));
            }
        }
    }
    let region = Region::new(cells).unwrap();
    let starts = (0..place.next_u64() % 4).map(|_| one_of(&mut place, region.cells())).collect();
    let parameters = Parameters {
        alpha: one_of(&mut place, &[0.0, 0.3, 1.0, 2.0]),
        beta: one_of(&mut place, &[0.0, 0.1, 0.4, 0.95, 1.2]),
        gamma: one_of(&mut place, &[0.0, 0.01, 0.15]),
        threshold: one_of(&mut place, &[0.0, 0.3, 0.8, 1.0]),
        steps_per_frame: one_of(&mut place, &[1, 3]),
        inflow: one_of(&mut place, &Inflow::ALL),
        redraw: one_of(&mut place, &Redraw::ALL),
        edge: one_of(&mut place, &Edge::ALL),
        ring_touching_ice: one_of(&mut place, &RingTouchingIce::ALL),
    };
    (region, starts, parameters)
}

fn bits(frost: &Frost) -> Vec<u64> {
    frost.field().into_iter().map(f64::to_bits).collect()
}

#[test]
fn the_fast_form_gives_the_bits_of_the_plain_form() {
    let mut grown = 0;
    for case in 0..1200 {
        let (region, starts, mut parameters) = any_case(case);
        parameters.inflow = if case % 3 == 0 { Inflow::OnlyIceHidden } else { Inflow::ReiterGated };
        let mut fast = Frost::new(&region, &starts, parameters, Seed(case)).unwrap();
        let mut plain = Frost::plain(&region, &starts, parameters, Seed(case)).unwrap();
        let at_first = fast.ice();
        for step in 0..40 {
            assert_eq!(bits(&fast), bits(&plain), "case {case}, step {step}: {parameters:?}");
            for ordinal in 0..region.len() {
                assert_eq!(fast.state(ordinal), plain.state(ordinal), "case {case}, step {step}");
                assert_eq!(fast.frozen_at_step(ordinal), plain.frozen_at_step(ordinal), "case {case}");
                assert_eq!(fast.is_ice(ordinal), fast.state(ordinal) == State::Ice, "case {case}");
            }
            assert_eq!(fast.ice(), plain.ice());
            fast.step();
            plain.step();
        }
        grown += usize::from(fast.ice() > at_first);
    }
    assert!(grown > 300, "only {grown} cases grew: they show little");
}

#[test]
fn long_rows_and_whole_frames_give_the_same_bits_too() {
    let region = Region::disc(576);
    for (inflow, threshold) in [(Inflow::ReiterGated, 0.8), (Inflow::OnlyIceHidden, 0.0)] {
        let parameters = Parameters { inflow, threshold, gamma: 0.023, ..GIVEN };
        let mut fast = Frost::new(&region, &[Axial::ORIGIN], parameters, Seed(3)).unwrap();
        let mut plain = Frost::plain(&region, &[Axial::ORIGIN], parameters, Seed(3)).unwrap();
        for _ in 0..40 {
            fast.frame();
            plain.frame();
        }
        assert!(fast.ice() > 100);
        assert_eq!(bits(&fast), bits(&plain));
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_seed_others() {
    let parameters = Parameters { threshold: 0.8, gamma: 0.023, ..GIVEN };
    let run = |seed| {
        let mut frost = Frost::new(&Region::disc(150), &[Axial::ORIGIN], parameters, Seed(seed)).unwrap();
        (0..30).for_each(|_| frost.frame());
        bits(&frost)
    };
    assert_eq!(run(5), run(5));
    assert_ne!(run(5), run(6));
}

/// Centre ice, six neighbours, twelve ring points that hold beta: one step by hand.
#[test]
fn one_step_on_seven_cells_by_hand() {
    let (a, b, g) = (0.6 / 12.0, 0.5, 0.01);
    let keep = 1.0 - 0.6 / 2.0;
    for (inflow, threshold, centre, around) in [
        (Inflow::AsPrinted, 0.0, 1.0 + g, b + g),
        (Inflow::AsPrinted, 1.0, 1.0 + g, b + a * (1.0 - b)),
        (Inflow::ReiterGated, 0.0, 1.0 + g, b + g + a * (3.0 * b)),
        (Inflow::ReiterGated, 1.0, 1.0 + g, b + a * (3.0 * b)),
        (Inflow::PassiveIsVapour, 0.0, 1.0 + g, b + g + a * (3.0 * b)),
        (Inflow::PassiveIsVapour, 1.0, 1.0 + g, b * keep + a * (3.0 * b)),
        (Inflow::PassiveDiffuses, 0.0, 1.0 + g, b + g + a * (3.0 * b)),
        (Inflow::PassiveDiffuses, 1.0, 1.0 + g, b * keep + a * (1.0 + 5.0 * b)),
        (Inflow::OnlyIceHidden, 0.0, 1.0 + g + a * (6.0 * b), b + g + a * (5.0 * b)),
        (Inflow::OnlyIceHidden, 1.0, 1.0 + g + a * (6.0 * b), b + a * (5.0 * b)),
    ] {
        let parameters = Parameters { alpha: 0.6, beta: b, gamma: g, threshold, inflow, ..GIVEN };
        let region = Region::hexagon(1);
        let mut frost = Frost::new(&region, &[Axial::ORIGIN], parameters, Seed(1)).unwrap();
        frost.step();
        for (ordinal, cell) in region.cells().iter().enumerate() {
            let expected = if *cell == Axial::ORIGIN { centre } else { around };
            let seen = frost.u(ordinal);
            assert!((seen - expected).abs() < 1e-15, "{inflow} {threshold} {cell:?}: {seen}, not {expected}");
        }
    }
}

/// A corner of 19 cells sees one receptive neighbour, two vapour cells and three ring points.
#[test]
fn vapour_diffuses_and_the_edge_holds_what_it_should() {
    let corner = Axial::new(2, 0);
    let (a, b) = (1.0 / 12.0, 0.4);
    for (edge, ring_touching_ice, starts, expected) in [
        (Edge::Reflecting, RingTouchingIce::Zero, vec![Axial::ORIGIN], 0.5 * b + a * (5.0 * b)),
        (Edge::Held, RingTouchingIce::Zero, vec![Axial::ORIGIN], 0.5 * b + a * (5.0 * b)),
        // Ice in the next corner but one; the ring is not touched near this corner.
        (Edge::Reflecting, RingTouchingIce::Zero, vec![Axial::new(-2, 0)], 0.5 * b + a * (6.0 * b)),
    ] {
        let parameters = Parameters { beta: b, edge, ring_touching_ice, ..GIVEN };
        let region = Region::hexagon(2);
        let mut frost = Frost::new(&region, &starts, parameters, Seed(1)).unwrap();
        frost.step();
        assert!((frost.u(region.ordinal(corner).unwrap()) - expected).abs() < 1e-15);
    }
    // One cell beside a start: the two ring points that touch both show 0, their mean 0.7, or beta.
    let pair = Region::new([Axial::new(0, 0), Axial::new(1, 0)]).unwrap();
    for (edge, ring_touching_ice, shared) in [
        (Edge::Reflecting, RingTouchingIce::Zero, 0.0),
        (Edge::Reflecting, RingTouchingIce::Mean, 0.7),
        (Edge::Held, RingTouchingIce::Zero, b),
    ] {
        let parameters = Parameters { beta: b, edge, ring_touching_ice, ..GIVEN };
        let mut frost = Frost::new(&pair, &[Axial::new(0, 0)], parameters, Seed(1)).unwrap();
        frost.step();
        let expected = b + GIVEN.gamma + a * (3.0 * b + 2.0 * shared);
        assert!((frost.u(1) - expected).abs() < 1e-15, "{edge} {ring_touching_ice}: {}", frost.u(1));
    }
}

#[test]
fn figure_2_adds_up_to_the_next_step() {
    for case in 0..200 {
        let (region, starts, parameters) = any_case(case);
        let mut frost = Frost::new(&region, &starts, parameters, Seed(case)).unwrap();
        (0..7).for_each(|_| frost.step());
        let Addends { receptive, diffusing } = frost.addends();
        let states: Vec<State> = (0..region.len()).map(|ordinal| frost.state(ordinal)).collect();
        frost.step();
        for ordinal in 0..region.len() {
            assert_eq!((receptive[ordinal] + diffusing[ordinal]).to_bits(), frost.u(ordinal).to_bits());
            assert!(states[ordinal] != State::Other || receptive[ordinal] == 0.0);
        }
    }
}

#[test]
fn without_a_threshold_ice_is_a_snow_crystal_to_the_last_frame() {
    for beta in [0.25, 0.295_357] {
        let parameters = Parameters { beta, ..GIVEN };
        let mut film =
            Film::new(&Region::disc(576), &[Axial::ORIGIN], parameters, Seed(1), NINE_TENTHS, 400).unwrap();
        while film.ending().is_none() {
            film.advance();
            assert_eq!(asymmetry(&film.frost().ice_cells(), Axial::ORIGIN), 0.0, "frame {}", film.frame());
        }
        assert!(film.frame() > 20);
    }
}

#[test]
fn as_printed_has_no_new_ice_before_gamma_alone_has_made_it() {
    let parameters = Parameters { beta: 0.35, inflow: Inflow::AsPrinted, ..GIVEN };
    let mut frost = Frost::new(&Region::disc(100), &[Axial::ORIGIN], parameters, Seed(1)).unwrap();
    while frost.ice() == 1 {
        frost.step();
    }
    let by_arithmetic = ((1.0 - 0.35) / 0.005) as u64;
    assert!((by_arithmetic..=by_arithmetic + 1).contains(&frost.step_count()), "{}", frost.step_count());
}

#[test]
fn a_threshold_stops_its_share_of_gamma() {
    // All cells wait, none touches vapour: with alpha 0 what has come is gamma times the draws above r_th.
    let parameters = Parameters { alpha: 0.0, beta: 0.0, gamma: 1e-6, threshold: 0.8, ..GIVEN };
    let region = Region::hexagon(1);
    for (redraw, least, most) in
        [(Redraw::Step, 0.15, 0.25), (Redraw::Frame, 0.1, 0.3), (Redraw::Cell, 0.0, 1.0)]
    {
        let mut frost =
            Frost::new(&region, &[Axial::ORIGIN], Parameters { redraw, ..parameters }, Seed(2)).unwrap();
        (0..1200).for_each(|_| frost.step());
        let gains = |ordinal| frost.u(ordinal) / 1e-6;
        let share = (0..7).filter(|&i| !frost.is_ice(i)).map(gains).sum::<f64>() / (6.0 * 1200.0);
        assert!((least..=most).contains(&share), "{redraw}: {share}");
        let held = (0..7).filter(|&i| !frost.is_ice(i)).all(|i| (gains(i) / 1200.0).fract() < 1e-6);
        assert_eq!(held, redraw == Redraw::Cell, "{redraw}");
    }
}

#[test]
fn steps_frames_and_updates_are_counted() {
    let parameters = Parameters { beta: 0.9, steps_per_frame: 5, ..GIVEN };
    let region = Region::hexagon(2);
    let mut frost = Frost::new(&region, &[Axial::ORIGIN, Axial::ORIGIN], parameters, Seed(1)).unwrap();
    assert_eq!((frost.ice(), frost.updates()), (1, 0));
    (0..20).for_each(|_| frost.frame());
    assert_eq!((frost.step_count(), frost.updates()), (100, 1900));
    for ordinal in 0..region.len() {
        let (step, frame) = (frost.frozen_at_step(ordinal).unwrap(), frost.frozen_in_frame(ordinal).unwrap());
        assert!(frame * 5 >= step && (frame == 0 || (frame - 1) * 5 < step));
    }
    assert_eq!(frost.frozen_at_step(region.ordinal(Axial::ORIGIN).unwrap()), Some(0));
}

#[test]
fn numbers_that_cannot_be_run_with_are_named() {
    let refused = |parameters: Parameters| {
        Frost::new(&Region::hexagon(1), &[], parameters, Seed(1)).map(|_| ()).unwrap_err().to_string()
    };
    assert_eq!(
        refused(Parameters { alpha: 2.5, ..GIVEN }),
        "alpha is 2.5; the explicit step is stable from 0 to 2 only"
    );
    assert_eq!(refused(Parameters { alpha: f64::NAN, ..GIVEN }), "alpha is NaN; a finite number is needed");
    assert_eq!(refused(Parameters { beta: -0.1, ..GIVEN }), "beta is -0.1; 0 to 1000000 is handled");
    assert_eq!(refused(Parameters { gamma: 2e6, ..GIVEN }), "gamma is 2000000; 0 to 1000000 is handled");
    assert_eq!(refused(Parameters { threshold: 1.1, ..GIVEN }), "threshold is 1.1; 0 to 1 is handled");
    assert_eq!(
        refused(Parameters { steps_per_frame: 0, ..GIVEN }),
        "steps_per_frame is 0; 1 to 100000 is handled"
    );
    let outside = Frost::new(&Region::hexagon(1), &[Axial::new(2, 0)], GIVEN, Seed(1));
    assert_eq!(outside.map(|_| ()), Err(FrostError::StartOutside(2, 0)));
}

#[test]
fn a_negative_zero_is_a_zero() {
    let parameters = Parameters { alpha: -0.0, beta: -0.0, gamma: -0.0, ..GIVEN };
    let mut frost = Frost::new(&Region::hexagon(2), &[Axial::ORIGIN], parameters, Seed(1)).unwrap();
    (0..3).for_each(|_| frost.step());
    assert_eq!((0..19).filter(|&i| frost.state(i) == State::Neighbour).count(), 6);
}
