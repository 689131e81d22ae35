//! Fig. 7: a ray through a flake, drawn from a ray through a flake.

mod drawing;

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
}
