//! Whether the renderer does what Eq. (11) to (16) say: closed forms, bounds, and what voxels cost.

mod conserved;
mod opacity;

use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use snowglobe::lab::{Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table, average};
use snowglobe::rng::Seed;
use snowglobe::snow::flake::{Assembly, Flake, Joining, Template};
use snowglobe::snow::still::{Body, Camera, Placed, Scene, picture};
use snowglobe::snow::{Cubes, Voxels};
use snowglobe::volume::{Bricks, Density, Himeno, Ray, Work};

use super::joined::{four_types, onto};
use super::setup::{assumed, broken};

pub const OPTICS: Experiment = Experiment {
    id: "optics",
    title: "What voxels do to light",
    source: "§2, Eq. (11) to (16)",
    says: "Light on its way through voxels whose density is the share of elements in them.",
    claims: &[&PRINTED, &EXACT, &ELEMENTS, &DENSITY, &LOST, &BOUND, &EMPTY, &OPACITY, &MEAN, &CONSERVED],
    run,
    mutant: Mutant {
        changes: "tau of the slab, 1/m",
        to: 2.0e3,
        why: "half as dense a slab lets more through than the closed form of the dense one",
        turns_red: &["himeno/optics/exact"],
    },
};

static PRINTED: Claim = Claim {
    id: "himeno/optics/printed",
    source: "Eq. (11), (16)",
    says: "the printed sum over a uniform slab has a closed form",
    expect: Expect::AtMost(1e-12),
    statistic: Statistic::Each,
    reason: "geometric series of ambient light over 24 samples, relative: roundings",
    known: &[],
};
static EXACT: Claim = Claim {
    id: "himeno/optics/exact",
    source: "Eq. (11)",
    says: "exact per cell a slab takes away 1 - exp(-tau d)",
    expect: Expect::AtMost(1e-6),
    statistic: Statistic::Each,
    reason: "coverage and ambient light of a slab seen face on, absolute: single precision",
    known: &[],
};
static ELEMENTS: Claim = Claim {
    id: "himeno/optics/elements",
    source: "Eq. (12) to (15)",
    says: "no element is lost: the densities of all voxels, times their volume, are the elements",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "elements less the sum of b_s, of a flake in voxels of 1 to 12 elements along a side: whole numbers",
    known: &[],
};
static DENSITY: Claim = Claim {
    id: "himeno/optics/density",
    source: "Eq. (12)",
    says: "density is from 0 to 1",
    expect: Expect::Between(0.5, 1.0),
    statistic: Statistic::Each,
    reason: "most elements of a voxel over its capacity, of a crystal on its own grid, where nothing is cut off; half is reached in a solid \
             one. Elements of turned crystals may be too many for a voxel (voxels.csv), which then holds no more than its volume",
    known: &[],
};
static LOST: Claim = Claim {
    id: "himeno/optics/lost",
    source: "Eq. (14)",
    says: "elements that are rounded to a grid after their crystal was turned fall together",
    expect: Expect::Between(0.05, 0.20),
    statistic: Statistic::Each,
    reason: "share that is lost, mean of twenty turns of a dendrite: 8 to 15 % for bodies as thick as wide; thin ones differ. Here crystals keep \
             their pose and centres are counted, so none is",
    known: &[],
};
static BOUND: Claim = Claim {
    id: "himeno/optics/bound",
    source: "Eq. (11)",
    says: "no flake is brighter than its lights",
    expect: Expect::AtMost(1.0),
    statistic: Statistic::Each,
    reason: "largest radiance of flakes before darkness over I_0 (k_d + k_s) + k_a I_a: with tau in front a bound",
    known: &[],
};
static EMPTY: Claim = Claim {
    id: "himeno/optics/empty",
    source: "Eq. (11)",
    says: "without flakes the picture is the one behind",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "channels that differ, bit for bit: none",
    known: &[],
};
static OPACITY: Claim = Claim {
    id: "himeno/optics/opacity",
    source: "Eq. (12)",
    says: "coarser voxels leave a flake as opaque as it is",
    expect: Expect::AtMost(0.02),
    statistic: Statistic::Each,
    reason: "opacity of a level against the finest, relative, mean over twenty directions and flakes of 1, 3 and 12 crystals, the worst level",
    known: &[],
};
static MEAN: Claim = Claim {
    id: "himeno/optics/mean",
    source: "Eq. (12)",
    says: "as means of density, as printed, they do not",
    expect: Expect::AtLeast(0.05),
    statistic: Statistic::Each,
    reason: "the same of voxels of 8 elements along a side whose density is the share of elements in them: by Jensen's inequality opacity changes, by \
             a tenth or so",
    known: &[],
};
static CONSERVED: Claim = Claim {
    id: "himeno/optics/conserved",
    source: "ours",
    says: "out of focus or moving, a flake is as bright in all",
    expect: Expect::AtMost(0.01),
    statistic: Statistic::Each,
    reason: "sum of coverage against that of the same flake sharp and still, relative, the furthest of flakes of 24, 6 and 1 pixels",
    known: &[],
};

/// Directions over which opacity is compared.
const DIRECTIONS: u64 = 20;

fn run(lab: &mut Lab) -> Result<()> {
    slabs(lab)?;
    let branching = assumed(lab, 20e-6)?;
    let tau = lab.assume("tau, 1/m", 1e5, "as in himeno/figure-8");
    let templates = four_types(&branching, lab.seed().0)?;
    let cubes = templates.iter().map(|t| Cubes::new(t.crystal(), 1).map_err(broken));
    let cubes = cubes.collect::<Result<Vec<_>>>()?;
    let flakes = [vec![0], vec![0, 2, 3], vec![0, 0, 1, 0, 2, 0, 0, 3, 0, 2, 0, 0]];
    let flakes = flakes.map(|chosen| {
        Flake::assemble(&templates, &chosen, Assembly::OneByOne, &Joining::assumed(), lab.seed())
            .map_err(broken)
    });
    let flakes = flakes.into_iter().collect::<Result<Vec<_>>>()?;
    elements(lab, &flakes[1], &templates, &cubes)?;
    let bodies = flakes.iter().map(|flake| Body::new(flake, &cubes, 1, tau).map_err(broken));
    let bodies = bodies.collect::<Result<Vec<_>>>()?;
    opacity::compare(lab, &flakes, &cubes, &bodies, tau)?;
    lights(lab, &bodies, tau)?;
    conserved::compare(lab, &bodies, tau)
}

/// Ambient light alone.
fn ambient() -> Himeno {
    Himeno {
        diffuse: 0.0,
        specular: 0.0,
        power: 1,
        ambient: 1.0,
        to_light: [0.0, 1.0, 0.0],
        light: [0.0; 3],
        ambient_light: [1.0; 3],
    }
}

fn slabs(lab: &mut Lab) -> Result<()> {
    let wrong = |cause: snowglobe::volume::VolumeError| Error::broken(cause.to_string());
    // 24 samples of density one half. The sum: tau of a sample t, e^-(t/2) + e^-(2 t/2) + ..., each times the density.
    let (samples, rho, t) = (24_usize, 0.5, 0.3);
    let field = Density::new([samples, 3, 3], 1.0, vec![rho as f32; samples * 9]).map_err(wrong)?;
    let ray = Ray::new([-1.0, 1.5, 1.5], [1.0, 0.0, 0.0]).map_err(wrong)?;
    let bricks = Bricks::new(&field);
    let seen = ambient().as_printed(&bricks, t, &ray, &mut Work::default()).map_err(wrong)?;
    let q = libm::exp(-t * rho);
    let closed = rho * q * (1.0 - libm::exp(-t * rho * samples as f64)) / (1.0 - q);
    lab.found(&PRINTED, (seen.radiance[0] / closed - 1.0).abs());

    let tau = lab.assume("tau of the slab, 1/m", 4.0e3, "so that some of the light is left");
    let side = 20e-6;
    let body = Body::of_density([24, 24, 12], side, &[1.0; 24 * 24 * 12], 4.0e3).map_err(broken)?;
    let placed = Placed {
        template: 0,
        at: Point3::new(0.0, 0.0, -10.0),
        turn: onto(&Vector3::z(), &Vector3::z()),
        scale: 1.0,
        velocity: Vector3::zeros(),
    };
    let scene = Scene { bodies: &[body], flakes: &[placed], extinction: tau, light: ambient() };
    // The middle of its face, far away: rays are parallel but for 1e-5.
    let camera = Camera::onto(10.0, 6.0 * side, 9).map_err(broken)?;
    let seen = picture(&scene, &camera, &vec![[0.0; 3]; 81], 4, Seed(1)).map_err(broken)?;
    let closed = 1.0 - libm::exp(-4.0e3 * 12.0 * side);
    let off = [f64::from(seen.coverage[40]), f64::from(seen.radiance[40][0])].map(|x| (x - closed).abs());
    lab.found(&EXACT, off[0].max(off[1]));
    Ok(())
}

/// Eq. (12) to (15) in whole numbers.
fn elements(lab: &mut Lab, flake: &Flake, templates: &[Template], cubes: &[Cubes]) -> Result<()> {
    let posed: Vec<_> = flake.members.iter().map(|m| (&cubes[m.template], m.pose)).collect();
    let all: usize = posed.iter().map(|(cubes, _)| cubes.count()).sum();
    let mut table =
        Table::new(["elements_along_a_voxel", "voxels", "elements", "overfull", "largest_density"]);
    let mut missing = 0_i64;
    for per_side in [1, 2, 3, 4, 6, 8, 12] {
        let voxels = Voxels::new(&posed, per_side).map_err(broken)?;
        let counted: u64 = voxels.elements().iter().map(|count| u64::from(*count)).sum();
        let most = voxels.density().into_iter().fold(0.0, f32::max);
        missing += all as i64 - counted as i64;
        table.row([
            per_side.into(),
            voxels.counts().iter().product::<usize>().into(),
            counted.into(),
            voxels.overfull().into(),
            most.into(),
        ]);
    }
    lab.found(&ELEMENTS, missing as f64);
    // A column, as solid as any.
    let own = Voxels::new(&[(&cubes[3], Isometry3::identity())], 3).map_err(broken)?;
    let most = own.elements().iter().copied().max().unwrap_or(0);
    lab.found(&DENSITY, f64::from(most) / f64::from(own.capacity()));
    lab.keep("voxels", "A flake of three crystals, counted into voxels", table)?;
    let stream = lab.stream("turns");
    let shares: Vec<f64> = (0..DIRECTIONS)
        .map(|k| {
            let mut chance = stream.at(k).place(0, 0, 0);
            let [to, roll] = [0, 1].map(|_| Vector3::from([0; 3].map(|_| chance.uniform() - 0.5)));
            let turn = onto(&Vector3::z(), &to) * onto(&Vector3::x(), &Vector3::new(roll.x, roll.y, 0.0));
            let pose = Isometry3::from_parts(Translation3::identity(), turn);
            let cubes = &cubes[0];
            let mut places: Vec<[i64; 3]> = cubes
                .places()
                .iter()
                .map(|place| {
                    let centre = cubes.centre(*place, &pose);
                    [centre.x, centre.y, centre.z].map(|along| libm::round(along / cubes.side()) as i64)
                })
                .collect();
            places.sort_unstable();
            places.dedup();
            1.0 - places.len() as f64 / cubes.count() as f64
        })
        .collect();
    lab.found(&LOST, average(&shares));
    lab.count("elements", (all * 7 + templates.len()) as u64);
    Ok(())
}

fn lit() -> Himeno {
    Himeno {
        diffuse: 0.7,
        specular: 0.3,
        power: 10,
        ambient: 0.35,
        to_light: [0.3, 0.8, 0.6],
        light: [1.0, 0.95, 0.9],
        ambient_light: [0.8, 0.9, 1.0],
    }
}

/// A flake at a distance, turned by a number.
fn at(template: usize, depth: f64, k: u64) -> Placed {
    let to = Vector3::new(0.3 + 0.2 * k as f64, -0.5, 0.8 - 0.3 * k as f64);
    Placed {
        template,
        at: Point3::new(0.0, 0.0, -depth),
        turn: onto(&Vector3::z(), &to),
        scale: 1.0,
        velocity: Vector3::zeros(),
    }
}

fn lights(lab: &mut Lab, bodies: &[Body], tau: f64) -> Result<()> {
    let side = lab.pick(96, 16);
    let himeno = lit();
    let mut brightest = 0.0_f64;
    for k in 0..6_u64 {
        let placed = at(k as usize % 3, 10.0, k);
        let camera = Camera::onto(10.0, bodies[placed.template].radius(), side).map_err(broken)?;
        let scene = Scene { bodies, flakes: &[placed], extinction: tau, light: himeno };
        let seen = picture(&scene, &camera, &vec![[0.0; 3]; side * side], 4, Seed(k)).map_err(broken)?;
        for pixel in &seen.radiance {
            for (channel, light) in pixel.iter().enumerate() {
                let most = himeno.light[channel] * (himeno.diffuse + himeno.specular)
                    + himeno.ambient * himeno.ambient_light[channel];
                brightest = brightest.max(f64::from(*light) / most);
            }
        }
        lab.count("cells", seen.work.cells);
    }
    lab.found(&BOUND, brightest);
    let behind: Vec<[f32; 3]> = (0..side * side).map(|k| [0.1, 0.3 + k as f32 * 1e-5, 0.7]).collect();
    let nothing = Scene { bodies, flakes: &[], extinction: tau, light: himeno };
    let camera = Camera::onto(10.0, 1e-2, side).map_err(broken)?;
    let seen = picture(&nothing, &camera, &behind, 4, Seed(1)).map_err(broken)?;
    let differ = seen.radiance.as_flattened().iter().zip(behind.as_flattened());
    lab.found(&EMPTY, differ.filter(|(a, b)| a.to_bits() != b.to_bits()).count() as f64);
    Ok(())
}
