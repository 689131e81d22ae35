//! A step of the frost, fast form beside plain form, and T_sim of the disc of 2083 cells.
//!
//! `cargo bench --bench frost`. The rate is in cells a second. Both forms are checked for the same bits before either
//! is timed, in the state that is timed.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use snowglobe::frost::{Edge, EndOf, EndRule, Frost, Inflow, Parameters, Redraw, RingTouchingIce, end_frame};
use snowglobe::hexgrid::{Axial, Region};
use snowglobe::rng::Seed;

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

fn parallelogram(side: i32) -> Region {
    Region::new((0..side).flat_map(|r| (0..side).map(move |q| Axial::new(q, r))))
        .expect("a few million cells")
}

/// Both forms after `steps` steps, which must agree in every bit.
fn both(region: &Region, start: Axial, parameters: Parameters, steps: usize) -> [(&'static str, Frost); 2] {
    let mut fast = Frost::new(region, &[start], parameters, Seed(1)).expect("sound parameters");
    let mut plain = Frost::plain(region, &[start], parameters, Seed(1)).expect("sound parameters");
    for _ in 0..steps {
        fast.step();
        plain.step();
    }
    for ordinal in 0..region.len() {
        assert_eq!(fast.u(ordinal).to_bits(), plain.u(ordinal).to_bits(), "cell {ordinal}");
        assert_eq!(fast.is_ice(ordinal), plain.is_ice(ordinal), "cell {ordinal}");
    }
    [("fast", fast), ("plain", plain)]
}

fn steps(criterion: &mut Criterion) {
    let parameters = Parameters { beta: 0.4, gamma: 0.001, ..GIVEN };
    for (side, before, samples) in [(80, 200, 50), (400, 200, 30), (3200, 5, 10)] {
        let region = parallelogram(side);
        for (name, parameters) in [
            ("reiter-gated", parameters),
            ("reiter-gated-0.8", Parameters { threshold: 0.8, ..parameters }),
            ("only-ice-hidden", Parameters { inflow: Inflow::OnlyIceHidden, ..parameters }),
        ] {
            if side == 3200 && name != "reiter-gated" {
                continue;
            }
            let mut group = criterion.benchmark_group(format!("frost-step/{name}"));
            group.throughput(Throughput::Elements(region.len() as u64)).sample_size(samples);
            for (form, frost) in &mut both(&region, Axial::new(side / 2, side / 2), parameters, before) {
                group.bench_function(BenchmarkId::new(*form, side), |bencher| bencher.iter(|| frost.step()));
            }
        }
    }
}

fn t_sim(criterion: &mut Criterion) {
    let region = Region::disc(576);
    let rule = EndRule { share: 0.9, of: EndOf::AllCells };
    let mut group = criterion.benchmark_group("frost-t-sim");
    for (threshold, gamma) in [(0.0, 0.005), (0.8, 0.023)] {
        let parameters = Parameters { threshold, gamma, ..GIVEN };
        let run = || end_frame(&region, &[Axial::ORIGIN], parameters, Seed(1), rule, 1000);
        let end = run().expect("sound parameters").expect("it fills");
        both(&region, Axial::ORIGIN, parameters, 12 * end.frame as usize);
        group.throughput(Throughput::Elements(12 * end.frame * region.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(threshold), |bencher| {
            bencher.iter(|| black_box(run()))
        });
    }
}

criterion_group!(benches, steps, t_sim);
criterion_main!(benches);
