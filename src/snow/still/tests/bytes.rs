//! The same bytes, whoever asks.

use super::*;

fn made(camera: &Camera, flakes: &[Placed], bodies: &[Body], threads: usize) -> Picture {
    let [width, height] = camera.made();
    let [left, top, ..] = camera.window;
    let sky = |at: usize| {
        let [x, y] = [left + at % width, top + at / width];
        [0.1 + 0.001 * x as f32, 0.2, 0.3 - 0.001 * y as f32]
    };
    let background: Vec<[f32; 3]> = (0..width * height).map(sky).collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| picture(&scene(bodies, flakes), camera, &background, 4, Seed(4)).unwrap())
}

#[test]
fn threads_and_windows_change_no_bit() {
    let (bodies, flakes) = (bodies(), many(80));
    let camera = camera(64.0, 0.4, 3e-4, [150, 110]);
    let whole = made(&camera, &flakes, &bodies, 1);
    let work = whole.work;
    assert!(work.traced > 5 && work.laid > 20 && work.cells > 300, "{work:?}");
    for threads in [2, 7] {
        assert_eq!(made(&camera, &flakes, &bodies, threads), whole);
    }
    for window in [[0, 0, 40, 40], [37, 21, 64, 50], [149, 109, 1, 1], [10, 0, 3, 110]] {
        let part = made(&camera.window(window).unwrap(), &flakes, &bodies, 2);
        assert_eq!(part.visible, whole.visible);
        let [left, top, width, _] = window;
        for at in 0..part.coverage.len() {
            let from = (top + at / width) * 150 + left + at % width;
            assert_eq!(part.radiance[at], whole.radiance[from], "{window:?} {at}");
            assert_eq!(part.coverage[at], whole.coverage[from], "{window:?} {at}");
        }
    }
    // Debug and release agree to the last bit: FNV-1a over the picture.
    let numbers = whole.radiance.as_flattened().iter().chain(&whole.coverage);
    let digest =
        numbers.flat_map(|x| x.to_bits().to_le_bytes()).fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
    assert_eq!(digest, 0x8238_9abf_cf7c_647f, "{digest:#x}");
}
