//! Pictures of a density, and the paper's billboards of the same sky: time a picture, from the density or the metaballs on.
//!
//! `cargo bench --bench volume -- --quick`. The cloud of 256^3 cells has an optical depth of 30 through its core; the light
//! volume is worked out each time. Rays a second are printed as elements.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use snowglobe::automaton_cloud::{
    Activation, Billboards, Brackets, Chance, Injection, Lock, Metaball, Metaballs, Packed, Rules,
};
use snowglobe::rng::Seed;
use snowglobe::volume::{Camera, Density, Himeno, Octaves, Shading, Single, render};

const TO_SUN: [f64; 3] = [-0.55, -0.35, 0.75];
const SUN: [f64; 3] = [std::f64::consts::PI; 3];

/// Billows of waves within a ball, empty outside.
fn cloud(side: usize) -> Density {
    let middle = 0.5 * side as f64;
    Density::sampled([side; 3], 1.0, |place| {
        let from = place.map(|x| (x - middle) / middle);
        let radius = libm::sqrt(from.iter().map(|x| x * x).sum());
        let wave = from.map(|x| libm::sin(14.0 * x)).iter().product::<f64>();
        (0.8 - radius + 0.4 * wave).clamp(0.0, 0.25) * 4.0
    })
    .expect("a density")
}

fn single() -> Single {
    Single { albedo: 1.0, g: 0.3, to_sun: TO_SUN, sun: SUN }
}

fn octaves(count: usize) -> Shading {
    Shading::Octaves(Octaves {
        count,
        attenuation: 0.5,
        contribution: 0.5,
        eccentricity: 0.5,
        normalised: false,
        albedo: 1.0,
        g: 0.3,
        to_sun: TO_SUN,
        sun: SUN,
        zenith: [0.0, 0.0, 1.0],
        sky: [0.16, 0.25, 0.42],
        ground: [0.1, 0.1, 0.08],
    })
}

fn on<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(run)
}

fn pictures(c: &mut Criterion) {
    let mut group = c.benchmark_group("volume");
    group.sample_size(10);
    let size = [1280, 720];
    let density = cloud(256);
    let camera = Camera::pinhole([128.0, -260.0, 90.0], [0.0, 1.0, 0.1], [0.0, 0.0, 1.0], 50.0, size)
        .expect("a camera");
    let himeno = Shading::Himeno(Himeno {
        diffuse: 0.7,
        specular: 0.1,
        power: 10,
        ambient: 0.3,
        to_light: TO_SUN,
        light: [1.0; 3],
        ambient_light: [1.0; 3],
    });
    group.throughput(Throughput::Elements((size[0] * size[1]) as u64));
    for (name, shading) in [
        ("absorption", Shading::Emission([0.0; 3])),
        ("single scattering", Shading::Single(single())),
        ("Eq. (11) of Himeno", himeno),
        ("six octaves", octaves(6)),
    ] {
        for threads in [1, 2] {
            group.bench_function(BenchmarkId::new(name, format!("256, {threads} threads")), |bench| {
                on(threads, || {
                    bench.iter(|| render(&density, 0.15, &camera, &shading, 1).expect("a picture"))
                });
            });
        }
    }
    group.finish();
}

/// The same sky by discs and by rays, by the grid.
fn displays(c: &mut Criterion) {
    let mut group = c.benchmark_group("display");
    group.sample_size(10);
    let size = [768, 432];
    for side in [40_usize, 80, 160] {
        let rules = Rules {
            activation: Activation::Negated,
            brackets: Brackets::Mended,
            lock: Lock::Cld,
            lifetime: 8,
        };
        let counts = [side, side, side / 4];
        let mut sky = Packed::new(counts, rules).expect("cells");
        let chances = Injection { seed: Seed(1), chance: Chance::Uniform([0.01, 3e-4, 2e-3]) };
        for _ in 0..36 {
            sky.inject(&chances);
            sky.step();
        }
        let cell = 160.0 / side as f64;
        let balls = Metaballs { counts, radius: 2.5 };
        let central = balls.central(&sky.cld());
        let whole = balls.whole() as f32;
        let rho = balls.density(&central).into_iter().map(|rho| rho / whole).collect();
        let density = Density::new(counts, cell, rho).expect("a density");
        let camera = Camera::pinhole([80.0, -54.0, -22.0], [0.0, 1.0, 0.3], [0.0, 0.0, 1.0], 46.0, size)
            .expect("a camera");
        let metaballs: Vec<Metaball> = (0..central.len())
            .filter(|at| central[*at] > 0.0)
            .map(|at| Metaball {
                centre: [at % side, at / side % side, at / (side * side)].map(|k| (k as f64 + 0.5) * cell),
                density: f64::from(central[at]),
                radius: 2.5 * cell,
            })
            .collect();
        let Single { g, to_sun, sun, .. } = single();
        let billboards =
            Billboards { extinction: 2.4 / balls.whole(), g, to_sun, sun, shadow: [2 * side, 2 * side] };
        group.throughput(Throughput::Elements(1));
        group.bench_function(BenchmarkId::new("billboards", side), |bench| {
            bench.iter(|| billboards.show(&metaballs, &camera).expect("a picture"));
        });
        let shading = Shading::Single(single());
        group.bench_function(BenchmarkId::new("rays", side), |bench| {
            bench.iter(|| render(&density, 2.4, &camera, &shading, 1).expect("a picture"));
        });
    }
    group.finish();
}

criterion_group!(benches, pictures, displays);
criterion_main!(benches);
