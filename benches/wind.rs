//! A step of the computed wind, and its pressure by the direct solve beside relaxation to the same residual.
//!
//! `cargo bench --bench wind`. The rate is in cells a second. Before the pressure is timed, both answers are checked
//! to be the same.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use snowglobe::navier_stokes::{Convection, Domain, Flow, Poisson, Sides, Staggered, relax};

/// The cavity at Reynolds 1000, some way from rest.
fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("wind-step");
    for cells in [64, 128, 256, 512, 1024] {
        let domain = Domain { size: [1.0, 1.0], cells: [cells, cells] };
        let mut flow = Staggered::new(domain, Sides::cavity(1.0), 1e-3, Convection::Central).expect("sound");
        let dt = 0.8 * flow.largest_step();
        for _ in 0..20 {
            flow.step(dt).expect("stable");
        }
        group.throughput(Throughput::Elements((cells * cells) as u64)).sample_size(20);
        group.bench_function(BenchmarkId::new("staggered", cells), |bencher| {
            bencher.iter(|| flow.step(dt).expect("stable"));
        });
    }
}

fn pressure(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("wind-pressure");
    for cells in [64, 128] {
        let h = 1.0 / cells as f64;
        let mut rhs: Vec<f64> =
            (0..cells * cells).map(|c| ((c * 7919 + 5) % 1009) as f64 / 1009.0 - 0.5).collect();
        let mut poisson = Poisson::new(cells, cells, h, h);
        poisson.defect(&mut rhs);
        let mut direct = rhs.clone();
        poisson.solve(&mut direct);
        let factor = 2.0 - 2.0 * std::f64::consts::PI / cells as f64;
        let target = 1e-10;
        let relaxed = || {
            let mut phi = vec![0.0; rhs.len()];
            let end = relax(&mut phi, &rhs, cells, [h, h], factor, target, 100_000);
            assert!(end.residual <= target, "{end:?}");
            phi
        };
        let phi = relaxed();
        let mean = phi.iter().sum::<f64>() / phi.len() as f64;
        for (a, b) in phi.iter().zip(&direct) {
            assert!((a - mean - b).abs() < 1e-8, "both forms agree: {a} {b}");
        }
        group.throughput(Throughput::Elements((cells * cells) as u64)).sample_size(10);
        group.bench_function(BenchmarkId::new("cosine", cells), |bencher| {
            bencher.iter(|| {
                direct.copy_from_slice(&rhs);
                poisson.solve(&mut direct);
            });
        });
        group.bench_function(BenchmarkId::new("relaxed", cells), |bencher| bencher.iter(relaxed));
    }
}

criterion_group!(benches, steps, pressure);
criterion_main!(benches);
