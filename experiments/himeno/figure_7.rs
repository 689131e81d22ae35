//! Fig. 7: a ray through a flake, drawn from a ray through a flake.

use std::fmt::Write;

use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic,
    Table, average,
};
use snowglobe::rng::Seed;
use snowglobe::snow::flake::{Assembly, Flake, Joining, Template};
use snowglobe::snow::{Cubes, Voxels};
use snowglobe::volume::{Bricks, Density, Himeno, Ray, Renderer, Shading, VolumeError, Work};

use super::setup::{assumed, broken, grown, saturated};

pub const FIGURE_7: Experiment = Experiment {
    id: "figure-7",
    title: "The geometry of a ray",
    source: "§2, Fig. 7, Eq. (11), (16)",
    says: "A ray enters a flake at t_near and leaves it at t_far; at w between, light comes from the entry point L_in, and the normal \
           turns it to the eye.",
    claims: &[&SUM, &ENTRY, &MIRROR, &SHADE],
    run,
    mutant: Mutant {
        changes: "steps along the ray",
        to: 5.0,
        why: "that is too coarse a sum",
        turns_red: &["himeno/figure-7/sum"],
    },
};

static SUM: Claim = Claim {
    id: "himeno/figure-7/sum",
    source: "Eq. (11), (16)",
    says: "the light that reaches the eye is the sum over w of what the figure draws",
    expect: Expect::AtMost(0.002),
    statistic: Statistic::Each,
    reason: "Eq. (11) summed step by step from density, gradient and depth to the light at each w, against the renderer's exact form, relative: the \
             sum's own error is a step over a voxel, squared, and the renderer's look-up of light 1e-3",
    known: &[],
};
static ENTRY: Claim = Claim {
    id: "himeno/figure-7/entry",
    source: "Fig. 7",
    says: "before t_near and behind t_far there is nothing of the flake",
    expect: Expect::Near { value: 0.0, within: 1e-12 },
    statistic: Statistic::Each,
    reason: "optical depth of the ray less that between the two: none",
    known: &[],
};
static MIRROR: Claim = Claim {
    id: "himeno/figure-7/mirror",
    source: "Fig. 7",
    says: "zeta is the angle between the view and the light that the normal mirrors",
    expect: Expect::Near { value: 0.0, within: 1e-12 },
    statistic: Statistic::Each,
    reason: "k_s cos^n zeta by drawn vectors, against the renderer's, the furthest of all places drawn: roundings",
    known: &[],
};

static SHADE: Claim = Claim {
    id: "himeno/figure-7/shade",
    source: "Eq. (16)",
    says: "between L_in and w some of the light is lost",
    expect: Expect::Between(0.05, 0.95),
    statistic: Statistic::Each,
    reason: "I(w) over I_0, mean along the ray: with so small a tau, and a flake so thin, neither all nor nothing",
    known: &[],
};

/// Voxels of empty around the flake, so that its light and shadow are its own.
const MARGIN: usize = 5;

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 20e-6)?;
    let steps =
        lab.assume("steps along the ray", lab.pick(20_000.0, 4_000.0), "as many as the sum needs") as usize;
    let tau = lab.assume("tau, 1/m", 4e3, "not printed; so that light goes some way into the flake");
    lab.assume_that("k_d, k_s, n, k_a", "0.6, 0.2, 8, 0.3", "not printed");
    let template = Template::new(grown(&branching, &saturated(-15.0, 12.0)?, lab.seed().0)?);
    let field = field(&template, lab.seed())?;
    let himeno = Himeno {
        diffuse: 0.6,
        specular: 0.2,
        power: 8,
        ambient: 0.3,
        // In the plane of the drawing.
        to_light: [-0.45, 0.9, 0.0],
        light: [1.0; 3],
        ambient_light: [1.0; 3],
    };
    let renderer = Renderer::new(&field, tau, &Shading::Himeno(himeno)).map_err(wrong)?;
    let drawn = Drawn::new(&field, &renderer, himeno, tau)?;
    let sum = drawn.sum(steps);
    let exact = renderer.see(&drawn.ray, &mut Work::default()).radiance[1];
    lab.found(&SUM, (sum / exact - 1.0).abs());
    let whole = renderer.bricks().depth(&drawn.ray);
    lab.found(&ENTRY, whole - drawn.depth_between());
    lab.found(&MIRROR, drawn.mirrored());
    let light: Vec<f64> = drawn.places(400).iter().map(|place| place.light).collect();
    lab.found(&SHADE, average(&light));
    lab.count("steps", steps as u64);

    let mut table =
        Table::new(["w_mm", "density", "transmittance_before", "light_i_w", "cos_phi", "reflected", "term"]);
    for place in drawn.places(120) {
        table.row([
            (1e3 * place.at).into(),
            place.density.into(),
            place.before.into(),
            place.light.into(),
            place.cosine.into(),
            place.reflected.into(),
            place.term.into(),
        ]);
    }
    lab.keep("terms", "What Eq. (11) sums along the ray of the drawing", table)?;
    let places = drawn.places(400);
    let series = |name: &str, of: &dyn Fn(&Place) -> f64| {
        Series::new(name, Draw::Line, places.iter().map(|place| (1e3 * place.at, of(place))))
    };
    lab.keep(
        "along",
        "Along the ray: density, what is left of the way to the eye, and the light that comes to w",
        Plot {
            title: "What Eq. (11) sums".to_owned(),
            x: Axis::of("w (mm)"),
            y: Axis::within("share", 0.0, 1.0),
            series: vec![
                series("density rho", &|place| place.density),
                series("transmittance to the eye", &|place| place.before),
                series("light I(w) / I0", &|place| place.light),
            ],
            bands: Vec::new(),
        },
    )?;
    lab.keep(
        "figure-7",
        "The ray, its entry and exit, and at w normal, light and mirrored light",
        Artifact::Svg(drawn.svg(&field)),
    )
}

fn wrong(cause: VolumeError) -> Error {
    Error::broken(cause.to_string())
}

/// A flake of three dendrites as a field, smoothed.
fn field(template: &Template, seed: Seed) -> Result<Density> {
    let templates = [template.clone()];
    let flake = Flake::assemble(&templates, &[0, 0, 0], Assembly::OneByOne, &Joining::assumed(), seed);
    let cubes = Cubes::new(template.crystal(), 1).map_err(broken)?;
    let posed: Vec<_> = flake.map_err(broken)?.members.iter().map(|member| (&cubes, member.pose)).collect();
    let voxels = Voxels::new(&posed, 4).map_err(broken)?;
    let inner = voxels.counts();
    let counts = inner.map(|count| count + 2 * MARGIN);
    let [nx, ny, _] = counts;
    let mut values = vec![0.0_f32; counts.iter().product()];
    for (at, density) in voxels.density().into_iter().enumerate() {
        let place = [at % inner[0], at / inner[0] % inner[1], at / (inner[0] * inner[1])];
        let [x, y, z] = place.map(|along| along + MARGIN);
        values[(z * ny + y) * nx + x] = density;
    }
    // Three times along each axis: then it is smooth from voxel to voxel, which the sum of the claim needs.
    for stride in [1, nx, nx * ny].repeat(3) {
        let before = values.clone();
        for at in stride..values.len() - stride {
            values[at] = 0.25 * before[at - stride] + 0.5 * before[at] + 0.25 * before[at + stride];
        }
    }
    Density::new(counts, voxels.side(), values).map_err(wrong)
}

/// One ray in the plane of the drawing.
struct Drawn<'a> {
    bricks: &'a Bricks,
    renderer: &'a Renderer,
    himeno: Himeno,
    tau: f64,
    ray: Ray,
    /// From where to where it is in the flake, m along the ray.
    near: f64,
    far: f64,
    to_light: [f64; 3],
}

/// What there is at a place w.
struct Place {
    at: f64,
    density: f64,
    before: f64,
    light: f64,
    cosine: f64,
    reflected: f64,
    term: f64,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl<'a> Drawn<'a> {
    /// The ray along x that goes through most of the flake.
    fn new(field: &Density, renderer: &'a Renderer, himeno: Himeno, tau: f64) -> Result<Self> {
        let extent = field.extent();
        let [_, ny, nz] = field.counts();
        let bricks = renderer.bricks();
        let ray = |y: f64, z: f64| Ray::new([-0.1 * extent[0], y, z], [1.0, 0.0, 0.0]).map_err(wrong);
        let place = |k: usize| (k as f64 + 0.5) * field.voxel();
        let mut best = (ray(place(ny / 2), place(nz / 2))?, 0.0);
        for z in 0..nz {
            for y in 0..ny {
                let tried = ray(place(y), place(z))?;
                let depth = bricks.depth(&tried);
                if depth > best.1 {
                    best = (tried, depth);
                }
            }
        }
        let (ray, _) = best;
        let length = dot(himeno.to_light, himeno.to_light).sqrt();
        let to_light = himeno.to_light.map(|x| x / length);
        let mut drawn =
            Self { bricks, renderer, himeno, tau, ray, near: 0.0, far: 1.2 * extent[0], to_light };
        let step = 0.05 * field.voxel();
        let dense = |at: f64| bricks.at(ray.place(at)).0 > 0.0;
        let end = drawn.far;
        while drawn.near < end && !dense(drawn.near + step) {
            drawn.near += step;
        }
        while drawn.far > drawn.near && !dense(drawn.far - step) {
            drawn.far -= step;
        }
        Ok(drawn)
    }

    /// Eq. (11) as a sum over steps: density, gradient and light at the middle of each.
    fn sum(&self, steps: usize) -> f64 {
        self.each(steps, |_| ())
    }

    fn each(&self, steps: usize, mut visit: impl FnMut(Place)) -> f64 {
        let step = (self.far - self.near) / steps as f64;
        let (mut depth, mut sum) = (0.0, 0.0);
        for k in 0..steps {
            let at = self.near + (k as f64 + 0.5) * step;
            let place = self.ray.place(at);
            let (density, gradient) = self.bricks.at(place);
            let own = self.tau * density * step;
            let light = libm::exp(-self.renderer.light_depth(place).unwrap_or(0.0));
            let reflected = self.himeno.reflected(gradient, self.ray.direction, self.to_light);
            let before = libm::exp(-depth);
            let term = before * -libm::expm1(-own) * (light * reflected + self.himeno.ambient);
            sum += term;
            depth += own;
            visit(Place {
                at: at - self.near,
                density,
                before,
                light,
                cosine: self.cosine(gradient),
                reflected,
                term,
            });
        }
        sum
    }

    fn places(&self, steps: usize) -> Vec<Place> {
        let mut places = Vec::new();
        self.each(steps, |place| places.push(place));
        places
    }

    fn cosine(&self, gradient: [f64; 3]) -> f64 {
        let length = dot(gradient, gradient).sqrt();
        if length > 0.0 { (-dot(gradient, self.to_light) / length).max(0.0) } else { 0.0 }
    }

    /// The integral of density between near and far, a step on either side.
    fn depth_between(&self) -> f64 {
        let from = Ray::new(self.ray.place(self.near), self.ray.direction).map(|ray| self.bricks.depth(&ray));
        let beyond =
            Ray::new(self.ray.place(self.far), self.ray.direction).map(|ray| self.bricks.depth(&ray));
        from.unwrap_or(f64::NAN) - beyond.unwrap_or(f64::NAN)
    }

    /// Normal and mirrored light at a place; none where density is even.
    fn vectors(&self, at: f64) -> Option<[[f64; 3]; 2]> {
        let (_, gradient) = self.bricks.at(self.ray.place(self.near + at));
        let length = dot(gradient, gradient).sqrt();
        let normal = gradient.map(|x| -x / length);
        let cosine = dot(normal, self.to_light);
        let mirrored = [0, 1, 2].map(|k| 2.0 * cosine * normal[k] - self.to_light[k]);
        (length > 0.0).then_some([normal, mirrored])
    }

    /// By how much what the vectors of the drawing reflect differs from what the renderer has.
    fn mirrored(&self) -> f64 {
        let off = |place: &Place| {
            let Some([normal, mirrored]) = self.vectors(place.at) else { return 0.0 };
            let cosine = dot(normal, self.to_light);
            let to_eye = self.ray.direction.map(|x| -x);
            let zeta = libm::acos(dot(mirrored, to_eye).clamp(-1.0, 1.0));
            let gloss = libm::pow(libm::cos(zeta).max(0.0), f64::from(self.himeno.power));
            let known =
                if cosine > 0.0 { self.himeno.diffuse * cosine + self.himeno.specular * gloss } else { 0.0 };
            (known - place.reflected).abs()
        };
        self.places(200).iter().map(off).fold(0.0, f64::max)
    }

    /// The drawing: the plane of the ray, its density, and the vectors at the place with the largest term.
    fn svg(&self, field: &Density) -> String {
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
