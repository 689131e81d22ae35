//! The automaton's step: packed against the form that reads like the rules, with injection, and on one core and two.
//!
//! `cargo bench --bench automaton -- --quick`. The states are compared first. Beside them stands what bounds the step: all four
//! fields read once and written once, as a copy of as many bytes; and a step of the computed wind, which the paper's page
//! calls heavier. A step is 61 operations on words of 64 cells (counted in `kernel.rs`), about one to a cell, and one byte
//! of traffic; the wind's works on numbers of 64 bits.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use snowglobe::automaton_cloud::{
    Activation, Brackets, Cells, Chance, Field, Injection, Lock, Metaballs, Packed, Rules,
};
use snowglobe::navier_stokes::{Convection, Domain, Flow, Sides, Staggered};
use snowglobe::rng::Seed;

const RULES: Rules =
    Rules { activation: Activation::Negated, brackets: Brackets::Mended, lock: Lock::Cld, lifetime: 0 };
const SPARSE: [f64; 3] = [1e-4, 1e-4, 1e-4];

/// A state in the midst of its growth.
fn begun(side: usize) -> Packed {
    let mut packed = Packed::new([side; 3], RULES).expect("cells");
    packed.inject(&Injection { seed: Seed(1), chance: Chance::Uniform([0.4, 1e-3, 0.0]) });
    for _ in 0..4 {
        packed.step();
    }
    packed
}

fn as_cells(packed: &Packed) -> Cells {
    let mut cells = Cells::new(packed.counts()).expect("cells");
    for field in Field::ALL {
        cells.set(field, &packed.field(field)).expect("zeros and ones");
    }
    cells.cld = packed.cld();
    cells
}

fn on<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(run)
}

fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("automaton");
    group.sample_size(10);
    let side = 128;
    let (mut packed, cells) = (begun(side), as_cells(&begun(side)));
    packed.step();
    assert!(cells.step(&RULES).cld == packed.cld(), "one step, two ways");
    group.throughput(Throughput::Elements((side * side * side) as u64));
    group.bench_function("a byte a variable, 128", |bench| bench.iter(|| cells.step(&RULES)));
    for side in [256_usize, 512] {
        group.throughput(Throughput::Elements((side * side * side) as u64));
        for threads in [1, 2] {
            let mut packed = begun(side);
            group.bench_function(BenchmarkId::new(format!("packed, {threads} threads"), side), |bench| {
                on(threads, || bench.iter(|| packed.step()));
            });
        }
    }
    for side in [256_usize, 512] {
        // A bit a cell of four fields.
        let from = vec![0x5a_u64; side * side * side / 64 * 4];
        let mut to = vec![0; from.len()];
        group.throughput(Throughput::Elements((side * side * side) as u64));
        group.bench_function(BenchmarkId::new("bound: four fields copied", side), |bench| {
            bench.iter(|| std::hint::black_box(&mut to).copy_from_slice(&from));
        });
    }
    let domain = Domain { size: [1.0, 1.0], cells: [512, 512] };
    let mut flow = Staggered::new(domain, Sides::cavity(1.0), 1e-3, Convection::Central).expect("sound");
    let dt = 0.8 * flow.largest_step();
    group.throughput(Throughput::Elements(512 * 512));
    group.bench_function("a step of the computed wind (two dimensions), 512", |bench| {
        on(1, || bench.iter(|| flow.step(dt).expect("stable")));
    });
    let mut locked = Packed::new([256; 3], Rules { lifetime: 8, ..RULES }).expect("cells");
    locked.inject(&Injection { seed: Seed(1), chance: Chance::Uniform([0.4, 1e-3, 0.0]) });
    group.throughput(Throughput::Elements(256 * 256 * 256));
    group.bench_function("packed, lifetime 8, 1 threads/256", |bench| {
        on(1, || bench.iter(|| locked.step()));
    });
    let injection = Injection { seed: Seed(1), chance: Chance::Uniform(SPARSE) };
    let mut packed = begun(256);
    group.bench_function("packed and injected, 1 threads/256", |bench| {
        on(1, || {
            bench.iter(|| {
                packed.step();
                packed.inject(&injection);
            })
        });
    });
    group.finish();
}

fn density(c: &mut Criterion) {
    let mut group = c.benchmark_group("density");
    group.sample_size(10);
    let cld = begun(128).cld();
    let balls = Metaballs { counts: [128; 3], radius: 3.0 };
    group.throughput(Throughput::Elements(128 * 128 * 128));
    group.bench_function("Eq. (7) and (6), D = 3, 128", |bench| {
        bench.iter(|| balls.density(&balls.central(&cld)));
    });
    group.finish();
}

criterion_group!(benches, steps, density);
criterion_main!(benches);
