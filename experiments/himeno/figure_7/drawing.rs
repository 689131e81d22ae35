//! The drawing of the ray.

use std::fmt::Write;

use snowglobe::volume::Density;

use super::{Drawn, dot};

impl Drawn<'_> {
    /// The drawing: the plane of the ray, its density, and the vectors at the place with the largest term.
    pub fn svg(&self, field: &Density) -> String {
        let [width, height] = [960.0, 640.0];
        let extent = field.extent();
        let scale = 640.0 / extent[0].max(1.3 * extent[1]);
        let z = self.ray.place(0.0)[2];
        let x_of = |x: f64| 150.0 + scale * x;
        let y_of = |y: f64| 0.5 * height - 10.0 - scale * (y - 0.5 * extent[1]);
        let mut svg = format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" xmlns=\"http://www.w3.org/2000/svg\">\n\
             <title>A ray through a flake</title><style>text{{font-family:system-ui,sans-serif;font-size:17px;fill:#16202c}}</style>\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#f4f7fb\"/>\n\
             <defs><marker id=\"tip\" markerWidth=\"9\" markerHeight=\"9\" refX=\"7\" refY=\"3.5\" orient=\"auto\"><path d=\"M0 0L8 3.5L0 7z\"/></marker></defs>\n"
        );
        let voxel = field.voxel();
        let side = scale * voxel;
        let [nx, ny, _] = field.counts();
        let densest = field.values().iter().copied().fold(0.0, f32::max);
        for j in 0..ny {
            for i in 0..nx {
                let centre = [(i as f64 + 0.5) * voxel, (j as f64 + 0.5) * voxel, z];
                let density = field.at(centre);
                if density > 0.005 {
                    let (x, y) = (x_of(centre[0]) - 0.5 * side, y_of(centre[1]) - 0.5 * side);
                    let _ = writeln!(
                        svg,
                        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{side:.1}\" height=\"{side:.1}\" fill=\"#4a78a8\" fill-opacity=\"{:.2}\"/>",
                        (density / f64::from(densest)).min(1.0)
                    );
                }
            }
        }
        let places = self.places(400);
        let chosen = places.iter().filter(|place| place.cosine > 0.0);
        let w = chosen.max_by(|a, b| a.term.total_cmp(&b.term)).map_or(0.0, |place| place.at);
        let at = |along: f64| {
            let place = self.ray.place(along);
            [x_of(place[0]), y_of(place[1])]
        };
        let place = self.ray.place(self.near + w);
        let from = [x_of(place[0]), y_of(place[1])];
        let towards = |direction: [f64; 3], length: f64| {
            [from[0] + length * direction[0], from[1] - length * direction[1]]
        };
        // Where the way to the light leaves the flake.
        let mut out = 0.0;
        for k in 1..4000 {
            let length = 0.05 * voxel * f64::from(k);
            let there = [0, 1, 2].map(|axis| place[axis] + length * self.to_light[axis]);
            if self.bricks.at(there).0 > 0.0 {
                out = length;
            }
        }
        let entry = towards(self.to_light, scale * out);
        let mut line = |a: [f64; 2], b: [f64; 2], colour: &str, more: &str| {
            let _ = writeln!(
                svg,
                "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{colour}\" stroke-width=\"2.4\" {more}/>",
                a[0], a[1], b[0], b[1]
            );
        };
        let tip = "marker-end=\"url(#tip)\"";
        line(at(1.25 * extent[0]), [40.0, from[1]], "#16202c", tip);
        let far_light = towards(self.to_light, scale * out + 90.0);
        line(far_light, from, "#d55e00", tip);
        let vectors = self.vectors(w);
        if let Some([normal, mirrored]) = vectors {
            line(from, towards(normal, 110.0), "#009e73", tip);
            line(from, towards(mirrored, 110.0), "#cc79a7", tip);
        }
        let mut dot_at = |[x, y]: [f64; 2], colour: &str| {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5.5\" fill=\"{colour}\"/>");
        };
        dot_at(at(self.near), "#16202c");
        dot_at(at(self.far), "#16202c");
        dot_at(from, "#e69f00");
        dot_at(entry, "#d55e00");
        let mut words = |[x, y]: [f64; 2], text: &str| {
            let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\">{text}</text>");
        };
        let beside = |[x, y]: [f64; 2], dx: f64, dy: f64| [x + dx, y + dy];
        words(beside(at(self.near), -58.0, 26.0), "t_near");
        words(beside(at(self.far), 6.0, 26.0), "t_far");
        words(beside(from, 8.0, 24.0), "w");
        words(beside(entry, 10.0, 0.0), "L_in");
        words([40.0, from[1] - 10.0], "I_e, to the eye");
        words(beside(far_light, 10.0, 12.0), "light I_0");
        if let Some([normal, mirrored]) = vectors {
            words(beside(towards(normal, 122.0), 0.0, 0.0), "normal");
            words(beside(towards(mirrored, 122.0), -60.0, 0.0), "mirrored");
            let phi = libm::acos(dot(normal, self.to_light).clamp(-1.0, 1.0)).to_degrees();
            let zeta =
                libm::acos(dot(mirrored, self.ray.direction.map(|x| -x)).clamp(-1.0, 1.0)).to_degrees();
            words(
                [40.0, height - 52.0],
                &format!(
                    "phi = {phi:.0}°, between normal and light; zeta = {zeta:.0}°, between mirrored light and eye"
                ),
            );
            words(
                [40.0, height - 24.0],
                "normal and mirrored light lean out of the plane of the drawing: they are shown as seen from above it",
            );
        }
        words(
            [40.0, height - 76.0],
            "A flake in the plane of the ray, darker is denser; what Eq. (11) needs at w",
        );
        svg + "</svg>\n"
    }
}
