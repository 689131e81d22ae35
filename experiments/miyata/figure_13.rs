//! Figure 13: the same contours with D = 2.41 and 2.19.

use snowglobe::contour_cloud::{
    Amplitude, Corner, Cut, EdgeLength, Fineness, Grid, Layer, Passage, Surface, Window, spectral_dimension,
};
use snowglobe::lab::{
    Axis, Claim, Draw, Error, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

use super::figure_12::picture;
use super::setup::{Drawn, PAPER_SIZE, contours, hills, surface};

pub const FIGURE_13: Experiment = Experiment {
    id: "figure-13",
    title: "Figure 13: the same contours with D = 2.41 and 2.19",
    source: "§4, Fig. 13",
    says: "With a greater fractal dimension the layer's shape changes more abruptly, and the cloud looks rougher.",
    claims: &[&AREA, &CONTRAST, &SPECTRUM],
    run,
    mutant: Mutant {
        changes: "D of (b)",
        to: 2.1,
        why: "a surface of lower D must not come out as the rougher",
        turns_red: &["miyata/figure-13/area", "miyata/figure-13/contrast", "miyata/figure-13/spectrum"],
    },
};

pub const REVERSED: &[Known] = &[
    Known {
        reading: "amplitude=as-printed",
        evidence: "in 2^(-(n+1)(D-1)) a greater D makes displacements smaller, whichever L is taken (order.csv)",
    },
    Known {
        reading: "amplitude=line-dimension",
        evidence: "with the D of a line, one less, a greater D still makes displacements smaller (order.csv)",
    },
];

const fn rougher(id: &'static str, says: &'static str, reason: &'static str) -> Claim {
    Claim {
        id,
        source: "§4, Fig. 13",
        says,
        expect: Expect::AtLeast(1.0),
        statistic: Statistic::Share(1.0),
        reason,
        known: REVERSED,
    }
}

static AREA: Claim = rougher(
    "miyata/figure-13/area",
    "the surface of D = 2.41 is the rougher: it has more area",
    "area of the surface of (b) over that of (c), five divisions, every one of 12 seeds",
);
static CONTRAST: Claim = rougher(
    "miyata/figure-13/contrast",
    "the cloud of D = 2.41 is the rougher: neighbours differ more",
    "root mean square of what f of the four triangles of one differ from their mean, of (b) over that of (c), five \
     divisions, every one of 12 seeds",
);
static SPECTRUM: Claim = rougher(
    "miyata/figure-13/spectrum",
    "the surface of D = 2.41 is the rougher: its spectrum falls off more slowly",
    "spectral dimension of the displacement of (b) over that of (c), rows of 257 heights, every one of 12 seeds",
);

const SEEDS: u64 = 12;
const DIVISIONS: u32 = 5;

/// How rough a surface is, in three ways.
struct Rough {
    area: f64,
    contrast: f64,
    spectral: f64,
}

fn run(lab: &mut Lab) -> Result<()> {
    let drawn = hills(lab, 800);
    let dimensions = [lab.printed("D of (b)", 2.41, "Fig. 13"), lab.printed("D of (c)", 2.19, "Fig. 13")];
    let gain = lab.assume("gain", 0.35, "at 1, as printed, displacement hides the contours");
    let gamma = lab.assume("gamma", 0.02, "as in Fig. 12");
    let layer = Layer { cut: Cut::Level { h: 0.0 }, passage: Passage::Above, gamma };
    let mut table =
        Table::new(["amplitude", "edge_length", "seed", "d", "area_ratio", "contrast", "spectral_dimension"]);
    let seeds = lab.seeds(lab.pick(SEEDS, 2));
    let mut series = Vec::new();
    for amplitude in lab.readings::<Amplitude>() {
        for edge_length in lab.readings::<EdgeLength>() {
            let how = (amplitude, edge_length);
            let measured = lab.each(&seeds, |seed| -> Result<[Rough; 2]> {
                let of =
                    |k: usize| rough(&of_dimension(&drawn, dimensions[k], how, gain, Seed(*seed))?, &layer);
                Ok([of(0)?, of(1)?])
            });
            let measured = measured.into_iter().collect::<Result<Vec<_>>>()?;
            lab.reading(amplitude);
            lab.reading(edge_length);
            let mut ratios = Vec::new();
            for (seed, [b, c]) in seeds.iter().zip(&measured) {
                lab.found_with(&AREA, *seed, b.area / c.area);
                lab.found_with(&CONTRAST, *seed, b.contrast / c.contrast);
                lab.found_with(&SPECTRUM, *seed, b.spectral / c.spectral);
                ratios.push((*seed as f64, b.contrast / c.contrast));
                for (d, rough) in dimensions.iter().zip([b, c]) {
                    table.row([
                        amplitude.name().into(),
                        edge_length.name().into(),
                        (*seed).into(),
                        (*d).into(),
                        rough.area.into(),
                        rough.contrast.into(),
                        rough.spectral.into(),
                    ]);
                }
            }
            let name = format!("{}, {} edge", amplitude.name(), edge_length.name());
            series.push(Series::new(name, Draw::Joined, ratios));
            if lab.keeps() && edge_length == EdgeLength::Original && amplitude != Amplitude::LineDimension {
                pictures(lab, &drawn, dimensions, how, gain, &layer)?;
            }
        }
    }
    lab.keep("order", "Roughness of both surfaces; area over that of the undisplaced surface", table)?;
    lab.keep(
        "contrast",
        "Which of the two is the rougher: above 1 the one with the greater D, as the paper says",
        Plot {
            title: "Contrast of D = 2.41 over that of D = 2.19".to_owned(),
            x: Axis::of("seed"),
            y: Axis::log("ratio of contrast", 0.1, 10.0),
            series,
            bands: Vec::new(),
        },
    )
}

fn of_dimension(
    drawn: &[Drawn],
    dimension: f64,
    how: (Amplitude, EdgeLength),
    gain: f64,
    seed: Seed,
) -> Result<Surface> {
    surface(&contours(drawn, 8.0, dimension), how, gain, seed)
}

fn rough(surface: &Surface, layer: &Layer) -> Result<Rough> {
    let (mut area, mut plain) = (0.0, 0.0);
    let (mut spread, mut groups, mut four) = (0.0, 0_u64, Vec::with_capacity(4));
    surface.triangles(DIVISIONS, &mut |corners| {
        area += size(corners, Corner::height);
        plain += size(corners, |corner| corner.base);
        four.push(layer.lost(corners));
        // Depth first, the four triangles of one follow each other.
        if four.len() == 4 {
            let mean = 0.25 * four.iter().sum::<f64>();
            spread += four.iter().map(|f| (f - mean) * (f - mean)).sum::<f64>();
            groups += 4;
            four.clear();
        }
    });
    let grid = Grid { low: [0.0; 2], high: PAPER_SIZE, counts: [257, 33] };
    let broken = |cause: snowglobe::contour_cloud::Outside| Error::broken(cause.to_string());
    let heights = grid.heights(surface, DIVISIONS).map_err(broken)?;
    let mut still = surface.clone();
    still.displacement.gain = 0.0;
    let ground = grid.heights(&still, 0).map_err(broken)?;
    let added: Vec<f64> = heights.iter().zip(&ground).map(|(height, ground)| height - ground).collect();
    let spectral = spectral_dimension(&added, 257)
        .ok_or_else(|| Error::broken("a surface without displacement has no spectrum"))?;
    Ok(Rough { area: area / plain, contrast: libm::sqrt(spread / groups as f64), spectral })
}

fn size(corners: &[Corner; 3], height: impl Fn(&Corner) -> f64) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|k| [corners[k].place[0], corners[k].place[1], height(&corners[k])]);
    let (p, q) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let across = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    0.5 * libm::sqrt(across.iter().map(|x| x * x).sum())
}

fn pictures(
    lab: &mut Lab,
    drawn: &[Drawn],
    dimensions: [f64; 2],
    how: (Amplitude, EdgeLength),
    gain: f64,
    layer: &Layer,
) -> Result<()> {
    let window = Window { low: [0.0; 2], high: PAPER_SIZE, size: [480, 320] };
    for (letter, d) in ["b", "c"].into_iter().zip(dimensions) {
        let surface = of_dimension(drawn, d, how, gain, lab.seed())?;
        let cloud = layer.seen_from_above(&surface, &window, Fineness::Pixels(1.0));
        lab.keep(
            &format!("{}-{letter}", how.0.name()),
            &format!("Fig. 13({letter}) re-run: D = {d}, Eq. (1) read as {}", how.0.name()),
            picture(&cloud, window.size, |f| f)?,
        )?;
    }
    Ok(())
}
