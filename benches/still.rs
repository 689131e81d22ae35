//! Pictures of flakes that fall: time a picture, light volumes included, of bodies made before; a body; and a crystal.
//!
//! `cargo bench --bench still -- --quick`. Samples a second are printed as elements; of 10,000 and 100,000 flakes, flakes.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};
use snowglobe::rng::Seed;
use snowglobe::snow::flake::{Assembly, Flake, Joining, Template};
use snowglobe::snow::still::{Body, Camera, FULL_FRAME, Lens, Placed, Scene, by_rays, picture};
use snowglobe::snow::{Branching, Crystal, Cubes, History, Layers, Parameters};
use snowglobe::volume::Himeno;

const TAU: f64 = 1e5;

/// Crystals of 20 um elements, and their elements.
fn crystals() -> (Vec<Template>, Vec<Cubes>) {
    let branching =
        Branching::new(&Parameters { element: 20e-6, ..Parameters::ASSUMED }).expect("parameters");
    let templates: Vec<Template> = [(-15.0, 15.0), (-15.0, 9.0), (-14.0, 12.0), (-11.0, 30.0), (-8.0, 30.0)]
        .into_iter()
        .map(|(temperature, minutes)| {
            let history = History::saturated(temperature, minutes).expect("a history");
            Template::new(Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).expect("a crystal"))
        })
        .collect();
    let cubes = templates.iter().map(|t| Cubes::new(t.crystal(), 1).expect("elements")).collect();
    (templates, cubes)
}

/// The flake of so many crystals.
fn flake(templates: &[Template], number: usize, seed: u64) -> Flake {
    let chosen: Vec<usize> = (0..number).map(|k| (k + seed as usize) % templates.len()).collect();
    Flake::assemble(templates, &chosen, Assembly::OneByOne, &Joining::assumed(), Seed(seed)).expect("a flake")
}

/// 40 bodies, half of them of one crystal and two of twelve.
fn bodies() -> Vec<Body> {
    let (templates, cubes) = crystals();
    (0..40)
        .map(|k| {
            let number = match k {
                0..20 => 1,
                20..32 => 2 + k % 2,
                32..38 => 5,
                _ => 12,
            };
            Body::new(&flake(&templates, number, k as u64), &cubes, 1, TAU).expect("a body")
        })
        .collect()
}

/// Flakes in the view, from 0.3 to 2 m away, that fall at 1 m/s.
fn falling(count: usize) -> Vec<Placed> {
    let moment = Seed(7).stream("falling").at(0);
    (0..count)
        .map(|k| {
            let mut numbers = moment.place(k as i32, 0, 0);
            let mut within = |low: f64, high: f64| low + (high - low) * numbers.uniform();
            let z = libm::cbrt(within(0.027, 8.0));
            let turn =
                Quaternion::new(within(-1.0, 1.0), within(-1.0, 1.0), within(-1.0, 1.0), within(-1.0, 1.0));
            // One in ten is of any body, others are of one crystal.
            let template = if within(0.0, 1.0) < 0.1 { within(0.0, 40.0) } else { within(0.0, 20.0) };
            Placed {
                template: template as usize,
                at: Point3::new(within(-0.48, 0.48) * z, within(-0.36, 0.36) * z, -z),
                turn: UnitQuaternion::from_quaternion(turn),
                scale: within(0.7, 1.4),
                velocity: Vector3::new(0.1, -1.0, 0.05),
            }
        })
        .collect()
}

fn camera(size: [usize; 2]) -> Camera {
    let lens = Lens { focal: 0.0375, number: 8.0, focus: 1.2, sensor: FULL_FRAME, shutter: 0.004 };
    Camera::new(Point3::origin(), -Vector3::z(), Vector3::y(), lens, size).expect("a camera")
}

fn light() -> Himeno {
    Himeno {
        diffuse: 0.7,
        specular: 0.3,
        power: 10,
        ambient: 0.35,
        to_light: [0.5, 0.7, 0.5],
        light: [1.6, 1.55, 1.45],
        ambient_light: [0.8, 0.9, 1.0],
    }
}

fn on<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(run)
}

fn pictures(c: &mut Criterion) {
    let mut group = c.benchmark_group("still");
    group.sample_size(10);
    let bodies = bodies();
    for (name, count, size, samples) in [
        ("1000 flakes, 640 x 480, 16 samples", 1000, [640, 480], 16),
        ("1000 flakes, 1920 x 1080, 4 samples", 1000, [1920, 1080], 4),
        ("10,000 flakes, 640 x 480, 16 samples", 10_000, [640, 480], 16),
        ("100,000 flakes, 640 x 480, 16 samples", 100_000, [640, 480], 16),
    ] {
        let flakes = falling(count);
        let scene = Scene { bodies: &bodies, flakes: &flakes, extinction: TAU, light: light() };
        let camera = camera(size);
        let background = vec![[0.02, 0.03, 0.05]; size[0] * size[1]];
        let elements = if count > 1000 { count } else { size[0] * size[1] * samples };
        group.throughput(Throughput::Elements(elements as u64));
        for threads in [1, 2] {
            group.bench_function(BenchmarkId::new(name, format!("{threads} threads")), |bench| {
                on(threads, || {
                    bench.iter(|| picture(&scene, &camera, &background, samples, Seed(1)).expect("a picture"))
                });
            });
        }
    }
    group.finish();
}

/// Every flake followed by rays: what the swift pictures are measured by. All samples are rays where flakes are.
fn rays(c: &mut Criterion) {
    let mut group = c.benchmark_group("by rays");
    group.sample_size(10);
    let bodies = bodies();
    let (flakes, size, samples) = (falling(1000), [640, 480], 16);
    let scene = Scene { bodies: &bodies, flakes: &flakes, extinction: TAU, light: light() };
    let (camera, background) = (camera(size), vec![[0.02, 0.03, 0.05]; size[0] * size[1]]);
    let work = by_rays(&scene, &camera, &background, samples, Seed(1)).expect("a picture").work;
    println!("{} samples, {} rays near flakes, {} cells", work.samples, work.rays, work.cells);
    group.throughput(Throughput::Elements(work.rays));
    for threads in [1, 2] {
        group.bench_function(BenchmarkId::new("1000 flakes", format!("{threads} threads")), |bench| {
            on(threads, || {
                bench.iter(|| by_rays(&scene, &camera, &background, samples, Seed(1)).expect("a picture"))
            });
        });
    }
    group.finish();
}

/// A dendrite of 2 mm of elements of 10 um, and p1 for its parameters, once.
fn crystal(c: &mut Criterion) {
    let mut group = c.benchmark_group("crystal");
    group.sample_size(10);
    let branching = Branching::new(&Parameters::ASSUMED).expect("parameters");
    let history = History::saturated(-15.0, 20.0).expect("a history");
    let grow = || Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).expect("a crystal");
    let grown = grow();
    println!("{:.2} mm, {} elements", 1e3 * grown.diameter(), grown.count());
    group.throughput(Throughput::Elements(grown.count() as u64));
    group.bench_function("dendrite, 20 minutes", |bench| bench.iter(grow));
    group.throughput(Throughput::Elements(1));
    group.bench_function("p1 for its parameters", |bench| {
        bench.iter(|| Branching::new(&Parameters::ASSUMED).expect("parameters"))
    });
    group.finish();
}

fn building(c: &mut Criterion) {
    let mut group = c.benchmark_group("body");
    group.sample_size(10);
    let (templates, cubes) = crystals();
    for number in [1, 3, 12] {
        let flake = flake(&templates, number, 3);
        for threads in [1, 2] {
            group.bench_function(
                BenchmarkId::new(format!("{number} crystals"), format!("{threads} threads")),
                |bench| {
                    on(threads, || bench.iter(|| Body::new(&flake, &cubes, 1, TAU).expect("a body")));
                },
            );
        }
    }
    group.finish();
}

criterion_group!(benches, pictures, rays, building, crystal);
criterion_main!(benches);
