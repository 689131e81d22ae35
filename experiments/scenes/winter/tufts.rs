//! What a shoot looks like near by: needles, and snow on it.

use super::canvas::{Sheaf, Stroke};

/// Half a width in pixels beyond which a shoot is drawn needle by needle.
pub const SPRAYED: f64 = 1.7;

/// A number of 0 to 1 that looks random, one of many for one that is.
fn another(own: f64, k: usize) -> f32 {
    let x = own * 977.0 + k as f64 * 0.618_033_988_749_895;
    (x - libm::floor(x)) as f32
}

/// A shoot as tufts of needles, which point forward on both sides.
pub fn spray(shoot: Stroke, own: f64, sheaf: &mut Sheaf) {
    let [dx, dy] = [0, 1].map(|k| shoot.to[k] - shoot.from[k]);
    let length = (dx * dx + dy * dy).sqrt().max(1e-3);
    let long = 1.75 * shoot.radius[0];
    let (way, count) = ([dx / length, dy / length], ((length / (0.42 * long)) as usize).clamp(2, 16));
    let mut core = Stroke { radius: shoot.radius.map(|radius| 0.42 * radius), ..shoot };
    core.light = core.light.map(|light| 0.75 * light);
    sheaf.lay(core);
    for k in 0..2 * count {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let part = (k as f32 + 1.0 + another(own, k)) / (2 * count) as f32;
        let (ahead, aside) =
            (0.55 + 0.35 * another(own, k + 40), side * (0.45 + 0.45 * another(own, k + 80)));
        let from = [0, 1].map(|k| shoot.from[k] + part * [dx, dy][k]);
        let to = [
            from[0] + long * (ahead * way[0] - aside * way[1]),
            from[1] + long * (ahead * way[1] + aside * way[0]),
        ];
        let tone = 0.75 + 0.7 * another(own, k + 120);
        let radius = [0.22 * shoot.radius[0], 0.12 * shoot.radius[0]];
        sheaf.lay(Stroke {
            from,
            to,
            radius,
            light: shoot.light.map(|light| tone * light),
            soft: 0.0,
            ..shoot
        });
    }
}

/// Snow along a shoot: cushions of several sizes, more level than the shoot is, for it does not lie along what is
/// steep.
pub fn cushions(snow: Stroke, own: f64, sheaf: &mut Sheaf) {
    let [dx, dy] = [0, 1].map(|k| snow.to[k] - snow.from[k]);
    let length = (dx * dx + dy * dy).sqrt();
    let radius = snow.radius[0];
    let count = ((length / (0.85 * radius.max(1.4))) as usize).clamp(1, 12);
    for k in 0..count {
        let middle = 1.0 - (2.0 * (k as f32 + 0.5) / count as f32 - 1.0).abs();
        let size = radius * (0.30 + 0.45 * another(own, k + 7) + 0.35 * middle);
        let part = (k as f32 + another(own, k + 31)) / count as f32;
        let half = size * (0.3 + 0.8 * another(own, k + 57));
        let up = 0.9 * radius * (another(own, k + 101) - 0.45);
        let at = [snow.from[0] + part * dx, snow.from[1] + part * dy - up];
        let lean = 0.65 * half * (dy / length.max(1e-3)) * if dx < 0.0 { -1.0 } else { 1.0 };
        // What lies higher gets more light.
        let tone = 0.80 + 0.20 * another(own, k + 83) + 0.12 * up / radius.max(1e-3);
        sheaf.lay(Stroke {
            from: [at[0] - half, at[1] - lean],
            to: [at[0] + half, at[1] + lean],
            radius: [size, (0.5 + 0.5 * another(own, k + 127)) * size],
            light: snow.light.map(|light| tone * light),
            ..snow
        });
    }
}
