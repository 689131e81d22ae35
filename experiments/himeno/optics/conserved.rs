//! Whether focus and motion leave a flake's light as it is.

use nalgebra::{Point3, Vector3};
use snowglobe::lab::{Lab, Result, Table};
use snowglobe::snow::still::{Body, Camera, Lens, Picture, Scene, picture};

use super::super::setup::broken;
use super::{CONSERVED, at, lit};

/// The same flake sharp and still, out of focus, moving, and both.
pub fn compare(lab: &mut Lab, bodies: &[Body], tau: f64) -> Result<()> {
    let side = lab.pick(160, 32);
    let samples = lab.pick(256, 4);
    let mut table = Table::new(["pixels_across", "lens", "coverage", "brightness", "against_sharp"]);
    let mut worst = 0.0_f64;
    for pixels in [24.0, 6.0, 1.0] {
        let depth = 0.5;
        let radius = bodies[1].radius();
        // So long a lens that the flake is so many pixels across.
        let focal = 0.1;
        let sensor = side as f64 / pixels * 2.0 * radius * focal / (depth - focal);
        let lens = |number: f64, focus: f64| Lens { focal, number, focus, sensor, shutter: 4e-3 };
        let blur = 30.0 / side as f64 * sensor;
        // Sharp at the flake; then focused so that it is 30 pixels wide. The picture is as large: what is far is closer to the lens.
        let ways = [
            ("sharp and still", lens(f64::INFINITY, depth), 0.0),
            ("out of focus", lens(focal / (2.0 * blur), 2.0 * depth), 0.0),
            ("moving", lens(f64::INFINITY, depth), 6.0 * radius / 4e-3),
            ("both", lens(focal / (2.0 * blur), 2.0 * depth), 6.0 * radius / 4e-3),
        ];
        let mut sharp = [None; 2];
        for (name, lens, speed) in ways {
            // A sensor as far behind for every focus, so that the flake is as large.
            let image = |focus: f64| focal * focus / (focus - focal);
            let lens = Lens { sensor: lens.sensor * image(lens.focus) / image(depth), ..lens };
            let camera = Camera::new(Point3::origin(), -Vector3::z(), Vector3::y(), lens, [side; 2])
                .map_err(broken)?;
            let mut placed = at(1, depth, 1);
            placed.velocity = Vector3::new(speed, 0.4 * speed, 0.0);
            let scene = Scene { bodies, flakes: &[placed], extinction: tau, light: lit() };
            let dark = vec![[0.0; 3]; side * side];
            let seen = picture(&scene, &camera, &dark, samples, lab.seed()).map_err(broken)?;
            let sums = sums(&seen);
            let against = [0, 1].map(|k| sums[k] / *sharp[k].get_or_insert(sums[k]) - 1.0);
            worst = worst.max(against[0].abs()).max(against[1].abs());
            table.row([pixels.into(), name.into(), sums[0].into(), sums[1].into(), against[0].into()]);
            lab.count("samples", seen.work.samples);
        }
    }
    lab.found(&CONSERVED, worst);
    lab.keep(
        "conserved",
        "One flake, sharp, out of focus, and moving: what it covers in all, in pixels",
        table,
    )
}

/// Coverage and green light of all pixels.
fn sums(seen: &Picture) -> [f64; 2] {
    let covered = seen.coverage.iter().map(|coverage| f64::from(*coverage)).sum();
    [covered, seen.radiance.iter().map(|light| f64::from(light[1])).sum()]
}
