//! Displaced triangles a second, depth first and level by level, and a cloud of 1920 x 1080 pixels.
//!
//! No mesh is stored: every triangle is summed up as it comes. `cargo bench --bench clouds -- --quick`.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rayon::prelude::*;
use snowglobe::contour_cloud::{
    Amplitude, Contour, Corner, Cut, Displacement, EdgeLength, Fineness, Layer, Levels, Passage, Patches,
    Piece, Plateau, Relief, Smooth, Surface, Tile, Window,
};
use snowglobe::rng::Seed;

/// Divisions of a patch: a tile's and those above it.
const TILE: u32 = 5;
const ABOVE: u32 = 4;

fn surface() -> Surface {
    let ring = |level: f64, radius: f64| {
        let at = |k: i32| libm::sincos(f64::from(k) * std::f64::consts::TAU / 32.0);
        let points = (0..32).map(|k| [1.6 * radius * at(k).1, radius * at(k).0]).collect();
        Contour { name: format!("{level}"), level, dimension: 2.3, points, closed: true }
    };
    let contours = [ring(0.0, 10.0), ring(1.0, 7.0), ring(2.0, 4.0)];
    let displacement = Displacement {
        amplitude: Amplitude::ThreeMinusD,
        edge_length: EdgeLength::Original,
        gain: 0.2,
        moment: Seed(1).stream("Gauss").at(0),
    };
    let patches = Patches::new(&contours, Plateau::Raised).expect("contours that do not meet");
    Surface { patches, relief: Relief::Patches, displacement }
}

/// A number that every corner's height enters.
fn take(sum: &mut f64, corners: &[Corner; 3]) {
    *sum += corners[0].height() + corners[1].height() + corners[2].height();
}

fn by_depth(surface: &Surface, patch: usize) -> f64 {
    let piece = surface.piece(patch, |_, _| TILE + ABOVE);
    let mut sum = 0.0;
    surface.visit(&piece, 0, &Levels, &|_| true, &mut |leaf| take(&mut sum, leaf));
    sum
}

fn by_level(surface: &Surface, patch: usize) -> f64 {
    fn descend(surface: &Surface, piece: &Piece, n: u32, tile: &mut Tile, sum: &mut f64) {
        if n == ABOVE {
            tile.fill(surface, piece, n);
            tile.triangles(&mut |leaf| take(sum, leaf));
            return;
        }
        for part in &surface.divide(piece, n, [true; 3]) {
            descend(surface, part, n + 1, tile, sum);
        }
    }
    let mut sum = 0.0;
    let piece = surface.piece(patch, |_, _| TILE + ABOVE);
    descend(surface, &piece, 0, &mut Tile::new(TILE), &mut sum);
    sum
}

type Way = fn(&Surface, usize) -> f64;

fn triangles(c: &mut Criterion) {
    let surface = surface();
    let patches = 16;
    let ways: [(&str, Way); 2] = [("depth first", by_depth), ("level by level", by_level)];
    let (a, b) = (by_depth(&surface, 3), by_level(&surface, 3));
    assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    let mut group = c.benchmark_group("displaced triangles");
    group.throughput(Throughput::Elements(patches as u64 * 4_u64.pow(TILE + ABOVE)));
    for (name, way) in ways {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            group.bench_function(format!("{name}, {threads} threads"), |bench| {
                bench.iter(|| {
                    pool.install(|| {
                        (0..patches).into_par_iter().map(|k| black_box(way(&surface, k))).collect::<Vec<_>>()
                    })
                });
            });
        }
    }
    group.finish();
}

fn pictures(c: &mut Criterion) {
    let printed = surface();
    let relief = Relief::Smooth(Smooth::new(&printed.patches, 129, 2));
    let smooth = Surface { relief, ..printed.clone() };
    let layer = Layer { cut: Cut::Level { h: 0.3 }, passage: Passage::Above, gamma: 0.8 };
    let mut group = c.benchmark_group("a cloud of 1920 x 1080");
    group.sample_size(10);
    for (name, surface) in [("patches", &printed), ("smooth", &smooth)] {
        let window = Window::around(surface.patches.bounds(), [1920, 1080]);
        let laid = layer.seen_from_above(surface, &window, Fineness::Pixels(1.0)).triangles;
        group.throughput(Throughput::Elements(laid));
        group.bench_function(name, |bench| {
            bench.iter(|| layer.seen_from_above(surface, &window, Fineness::Pixels(1.0)));
        });
    }
    group.finish();
}

criterion_group!(benches, triangles, pictures);
criterion_main!(benches);
