//! The end of a film, and films without one.

use super::super::tally::needed;
use super::*;

fn film(region: &Region, starts: &[Axial], parameters: Parameters, rule: EndRule, limit: u64) -> Film {
    Film::new(region, starts, parameters, Seed(1), rule, limit).unwrap()
}

#[test]
fn seven_of_ten_are_seven_tenths() {
    assert_eq!(needed(0.7, 10), 7);
    for n in 1..60 {
        for k in 1..=n {
            assert_eq!(needed(k as f64 / n as f64, n), k);
        }
        assert_eq!(needed(1e-300, n), 1);
    }
    assert_eq!(needed(0.9, 2083), 1875);
}

#[test]
fn the_end_frame_is_the_first_with_enough_and_the_crossing_lies_before_it() {
    let region = Region::disc(150);
    let end = film(&region, &[Axial::ORIGIN], GIVEN, NINE_TENTHS, 400).run().reached().unwrap();
    let counts = growth(&region, &[Axial::ORIGIN], GIVEN, Seed(1), end.frame).unwrap();
    let enough = needed(0.9, region.len());
    assert_eq!(counts.iter().position(|&count| count >= enough), Some(end.frame as usize));
    let (before, now) = (counts[end.frame as usize - 1] as f64, counts[end.frame as usize] as f64);
    let part = end.interpolated - (end.frame - 1) as f64;
    assert!(part > 0.0 && part <= 1.0);
    assert!((before + part * (now - before) - 0.9 * region.len() as f64).abs() < 1e-9);
}

#[test]
fn the_border_is_another_end() {
    let region = Region::disc(150);
    let border = EndRule { share: 0.5, of: EndOf::Border };
    let mut by_border = film(&region, &[Axial::ORIGIN], GIVEN, border, 400);
    let end = by_border.run().reached().unwrap();
    let ice = region.border().into_iter().filter(|&i| by_border.frost().is_ice(i)).count();
    assert_eq!((ice, by_border.counting()), (by_border.counted(), region.border().len()));
    assert!(2 * ice >= region.border().len() && end.frame > 0);
}

#[test]
fn several_ends_of_one_film_are_those_of_each() {
    let rules = [(0.5, EndOf::Border), (0.9, EndOf::AllCells), (1.0, EndOf::AllCells), (1.0, EndOf::Border)]
        .map(|(share, of)| EndRule { share, of });
    let apart = Region::new((0..10).map(|q| Axial::new(q, 0)).chain([Axial::new(20, 0)])).unwrap();
    for (region, threshold, limit) in [
        (Region::disc(150), 0.0, 400),
        (Region::disc(60), 0.8, 400),
        (Region::disc(60), 0.4, 12),
        (apart, 0.0, 400),
    ] {
        let parameters = Parameters { threshold, ..GIVEN };
        let start = [Axial::ORIGIN];
        let together = end_frames(&region, &start, parameters, Seed(3), &rules, limit).unwrap();
        for (rule, end) in rules.into_iter().zip(together) {
            assert_eq!(
                end,
                end_frame(&region, &start, parameters, Seed(3), rule, limit).unwrap(),
                "{rule:?}"
            );
        }
    }
}

#[test]
fn what_is_ice_at_once_ends_in_frame_0() {
    let at_once = Some(Ending::Reached(EndFrame { frame: 0, interpolated: 0.0 }));
    let one = Region::hexagon(0);
    assert_eq!(film(&one, &[Axial::ORIGIN], GIVEN, NINE_TENTHS, 0).ending(), at_once);
    let all = Parameters { beta: 1.0, ..GIVEN };
    assert_eq!(film(&Region::hexagon(3), &[], all, NINE_TENTHS, 0).ending(), at_once);
}

#[test]
fn pieces_without_a_start_stay_vapour() {
    let cells: Vec<Axial> = (0..10).map(|q| Axial::new(q, 0)).chain([Axial::new(20, 0)]).collect();
    let region = Region::new(cells).unwrap();
    let start = [Axial::ORIGIN];
    let all = EndRule { share: 1.0, of: EndOf::AllCells };
    assert_eq!(film(&region, &start, GIVEN, all, u64::MAX).ending(), Some(Ending::Unreachable));
    assert!(film(&region, &start, GIVEN, NINE_TENTHS, 10_000).run().reached().is_some());
    assert_eq!(film(&region, &[], GIVEN, NINE_TENTHS, u64::MAX).ending(), Some(Ending::Unreachable));
}

#[test]
fn a_film_that_has_run_dry_ends_without_a_limit() {
    let start = [Axial::ORIGIN];
    let dry = |parameters| {
        let mut film = film(&Region::disc(100), &start, parameters, NINE_TENTHS, u64::MAX);
        assert_eq!(film.run(), Ending::Unreachable);
        film.frame()
    };
    assert!(dry(Parameters { gamma: 0.0, beta: 0.05, ..GIVEN }) <= 1000);
    assert!(dry(Parameters { gamma: 0.0, ..GIVEN }) < 1000);
    assert!(dry(Parameters { threshold: 1.0, ..GIVEN }) < 1000);
    assert!(dry(Parameters { threshold: 0.8, redraw: Redraw::Cell, ..GIVEN }) < 2000);
    // No vapour at all: a frame that changes nothing.
    for inflow in Inflow::ALL {
        assert!(dry(Parameters { gamma: 0.0, beta: 0.0, alpha: 0.0, inflow, ..GIVEN }) < 100);
    }
    for edge in Edge::ALL {
        let all_diffuse = Parameters { threshold: 1.0, inflow: Inflow::PassiveIsVapour, edge, ..GIVEN };
        assert!(dry(all_diffuse) <= 16);
    }
}

#[test]
fn a_limit_is_not_a_verdict() {
    let mut film = film(&Region::disc(100), &[Axial::ORIGIN], GIVEN, NINE_TENTHS, 3);
    assert_eq!((film.run(), film.frame()), (Ending::Limit, 3));
}

/// What is called unreachable is not reached by going on.
#[test]
fn unreachable_is_never_said_too_soon() {
    let mut at_work = 0;
    for case in 0..1500 {
        let (region, starts, parameters) = any_case(case);
        let rule = EndRule { share: 0.8, of: EndOf::AllCells };
        let mut film = film(&region, &starts, parameters, rule, 300);
        if film.run() == Ending::Unreachable {
            let (said, ice) = (film.frame(), film.frost().ice());
            (0..200).for_each(|_| film.advance());
            assert!(film.counted() < film.needed(), "case {case}: {parameters:?}");
            assert!(said == 0 || film.frost().ice() == ice, "case {case}: {parameters:?}");
            at_work += usize::from(said > 0);
        }
    }
    assert!(at_work > 50, "only {at_work} cases ran dry: they show little");
}

#[test]
fn shares_that_are_none_are_refused() {
    for share in [0.0, -1.0, 1.01, f64::NAN] {
        let rule = EndRule { share, of: EndOf::AllCells };
        let error = Film::new(&Region::hexagon(1), &[], GIVEN, Seed(1), rule, 1).map(|_| ()).unwrap_err();
        assert!(matches!(error, FrostError::Share(_)));
    }
}
