//! Fig. 2: Nakaya's diagram, as a map of crystals that were grown.

use snowglobe::image::{Face, ImageError, Picture, draw_text, text_width};
use snowglobe::lab::{
    Axis, Claim, Draw, Error, Expect, Experiment, HeatMap, Known, Lab, Mutant, Plot, Result, Series,
    Statistic, Table, maybe,
};
use snowglobe::reading::Reading;
use snowglobe::snow::{
    Air, Axes, Branching, Crystal, Habit, HabitLimits, History, Light, Over, Relief, saturation,
};

use super::bands::{Band, band_at, bands};
use super::setup::{assumed, broken, grown};
use super::slide::{INK, ground, monochrome, room, suited, unmarked, view_of};

pub const FIGURE_2: Experiment = Experiment {
    id: "figure-2",
    title: "Nakaya's diagram",
    source: "§1, §1.1.3, Fig. 2, Eq. (8)",
    says: "The shape of a crystal, and how fast it grows, follow from temperature and supersaturation.",
    claims: &[&PRIMARY, &HUMID, &DENDRITES, &COLD, &A_AXIS, &C_AXIS, &SPEED, &DRIER],
    run,
    mutant: Mutant {
        changes: "temperature is off by, C",
        to: 8.0,
        why: "then plates grow where columns should",
        turns_red: &["himeno/figure-2/primary", "himeno/figure-2/a-axis"],
    },
};

static PRIMARY: Claim = Claim {
    id: "himeno/figure-2/primary",
    source: "Fig. 2",
    says: "plates grow from 0 to -4 and from -10 to -22 C, columns from -4 to -10 C and below -22 C",
    expect: Expect::AtLeast(0.9),
    statistic: Statistic::Each,
    reason: "share of the crystals of the map that are wider than high where the classic bands have plates, and not elsewhere: the table of \
             growth ratios is 1 at -4.4, -9.5 and -20.6 C, so that some 2.4 of 40 degrees differ",
    known: &[],
};
static HUMID: Claim = Claim {
    id: "himeno/figure-2/humid",
    source: "Fig. 2",
    says: "in humid air these are thin plates, needles, hollow columns, sectored plates and dendrites, each in its band",
    expect: Expect::AtLeast(0.7),
    statistic: Statistic::Each,
    reason: "share of temperatures from 0 to -40 C, half a degree apart, at which saturation over water grows the habit of the classic band: \
             edges of six bands within a degree on either side are 12 of 40. The limits between habits are fitted to such bands, so this is \
             no prediction",
    known: &[Known {
        reading: "",
        evidence: "0.675 (confusion.svg): below -32 C columns are solid, and needles grow from -5.5 to -7.3 C, where the table of growth \
                   ratios peaks, not from -4 to -6 C",
    }],
};
static DENDRITES: Claim = Claim {
    id: "himeno/figure-2/dendrites",
    source: "Fig. 2",
    says: "dendrites grow from -12 to -16 C, in humid air",
    expect: Expect::AtMost(1.5),
    statistic: Statistic::Each,
    reason: "how far the ends of their range at saturation over water are from these, C, the further: bands are rounded to a degree or two; \
             fitted, as above",
    known: &[],
};
static COLD: Claim = Claim {
    id: "himeno/figure-2/cold",
    source: "Bailey & Hallett 2009",
    says: "plates grow down to -40 C, against the classic diagram",
    expect: Expect::AtLeast(0.9),
    statistic: Statistic::Each,
    reason: "share of the map's crystals between -22 and -40 C that are wider than high",
    known: &[Known {
        reading: "",
        evidence: "the table of growth ratios (Chen & Lamb 1994) is above 1 below -20.6 C: it has columns, as the paper's diagram does",
    }],
};
static A_AXIS: Claim = Claim {
    id: "himeno/figure-2/a-axis",
    source: "Takahashi & Fukuta 1988",
    says: "the a axis grows fastest at -15 C",
    expect: Expect::Near { value: -15.0, within: 0.5 },
    statistic: Statistic::Each,
    reason: "two sources; after 10 minutes at saturation over water, in steps of 0.1 C: the table behind it has whole degrees",
    known: &[],
};
static C_AXIS: Claim = Claim {
    id: "himeno/figure-2/c-axis",
    source: "Takahashi & Fukuta 1988",
    says: "the c axis grows fastest at -5.5 C",
    expect: Expect::Near { value: -5.5, within: 0.5 },
    statistic: Statistic::Each,
    reason: "as above",
    known: &[],
};
static SPEED: Claim = Claim {
    id: "himeno/figure-2/speed",
    source: "§1.1.3, condition 1",
    says: "branches grow as fast as the diagram says",
    expect: Expect::AtMost(0.02),
    statistic: Statistic::Each,
    reason: "mean speed of the tips of arms against that of the a axis, relative, the furthest of ten temperatures of plates: arms are \
             whole cells, a hundred of them",
    known: &[],
};
static DRIER: Claim = Claim {
    id: "himeno/figure-2/drier",
    source: "Fig. 2",
    says: "at -15 C plates grow where it is dry, dendrites where it is humid",
    expect: Expect::Near { value: 2.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "of crystals at 5 and 15 %, a plate and a dendrite: both",
    known: &[Known {
        reading: "supersaturation-over=water",
        evidence: "5 % over water are 22 % over ice at -15 C: everything above saturation over water is a dendrite",
    }],
};

/// Rows of the map, per cent.
const HUMIDITIES: [f64; 6] = [20.0, 16.0, 12.0, 8.0, 5.0, 2.0];
/// A crystal of the map, pixels.
const THUMB: usize = 56;

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 10e-6)?;
    let off = lab.assume("temperature is off by, C", 0.0, "a check of the claims' power");
    let minutes = lab.assume("minutes of growth", 12.0, "not printed; all of the map grow as long");
    let step = lab.pick(2, 8);
    let temperatures: Vec<f64> = (0..40).step_by(step).map(|k| -1.0 - f64::from(k)).collect();
    let bands = bands()?;
    lab.assume_that(
        "limits between habits",
        "0.25, 0.6 and 0.9 of ice, growth ratio 1.95",
        "fitted: to dendrites from -12.7 to -17.1 C at saturation over water (Bailey & Hallett 2009), and by eye",
    );
    let mut table = Table::new([
        "over",
        "temperature_c",
        "supersaturation_pct",
        "over_ice_pct",
        "grown",
        "classic_primary",
        "bailey_hallett_primary",
        "bailey_hallett_confirmed",
        "diameter_mm",
        "height_mm",
        "fill",
    ]);
    for over in lab.readings::<Over>() {
        lab.reading(over);
        let map = Map::grown(lab, &branching, &temperatures, over, minutes, off)?;
        let platelike: Vec<bool> = map.crystals.iter().map(|c| c.diameter() > c.height()).collect();
        let agrees = |k: usize| -> Option<bool> {
            Some(band_at(&bands, "classic", map.air[k].0)?.platelike == platelike[k])
        };
        let judged: Vec<bool> = (0..platelike.len()).filter_map(agrees).collect();
        lab.found(&PRIMARY, share(&judged));
        let cold: Vec<bool> =
            (0..platelike.len()).filter(|k| map.air[*k].0 < -22.0).map(|k| platelike[k]).collect();
        lab.found(&COLD, share(&cold));
        lab.found(&DRIER, f64::from(dry_and_humid(&branching, over)?));
        for (k, crystal) in map.crystals.iter().enumerate() {
            let (temperature, per_cent) = map.air[k];
            let ice = saturation::to_ice(per_cent / 100.0, over, temperature);
            let word = |band: Option<&Band>| band.map(|band| if band.platelike { "plate" } else { "column" });
            let modern = band_at(&bands, "bh2009", temperature);
            table.row([
                over.name().into(),
                temperature.into(),
                per_cent.into(),
                (100.0 * ice).into(),
                crystal.name().into(),
                maybe(word(band_at(&bands, "classic", temperature))),
                maybe(word(modern)),
                maybe(modern.map(|band| if band.confirmed { "two sources" } else { "one source" })),
                (1e3 * crystal.diameter()).into(),
                (1e3 * crystal.height()).into(),
                crystal.fill().into(),
            ]);
            lab.count("elements", crystal.count() as u64);
        }
        if lab.keeps() {
            let title = format!("Supersaturation over {} (%)", over.name());
            let name = format!("map-over-{}", over.name());
            lab.keep(
                &name,
                &format!("Crystals grown for {minutes} minutes in each kind of air"),
                map.picture(&title)?,
            )?;
        }
    }
    lab.default_reading();
    lab.keep("map", "Crystals of the map, and what two schemes have there", table)?;
    at_saturation(lab, &bands, off)?;
    axes(lab, off)?;
    lab.found(&SPEED, tips(&branching)?);
    Ok(())
}

fn share(of: &[bool]) -> Option<f64> {
    (!of.is_empty()).then(|| of.iter().filter(|agrees| **agrees).count() as f64 / of.len() as f64)
}

/// Crystals on a grid of temperature and supersaturation.
struct Map {
    temperatures: Vec<f64>,
    /// Of each crystal, C and per cent.
    air: Vec<(f64, f64)>,
    crystals: Vec<Crystal>,
}

impl Map {
    fn grown(
        lab: &Lab,
        branching: &Branching,
        temperatures: &[f64],
        over: Over,
        minutes: f64,
        off: f64,
    ) -> Result<Self> {
        let air: Vec<(f64, f64)> =
            HUMIDITIES.iter().flat_map(|s| temperatures.iter().map(|t| (*t, *s))).collect();
        let crystals = lab.each(&air, |(temperature, per_cent)| {
            let history = History::constant((temperature + off).min(0.0), per_cent / 100.0, over, minutes);
            let history = history.map_err(broken)?;
            // As fine as a picture of it: some sixty elements along it.
            let (temperature, supersaturation) = history.at(0.0);
            let air = Air { temperature, supersaturation, pressure: 1e5, ventilation: 1.0 };
            let axes = Axes::sphere(Axes::SEED).grown(&air, 60.0 * minutes);
            let element = (2.0 * axes.a.max(axes.c) / lab.pick(110.0, 20.0)).clamp(2e-6, 1e-4);
            grown(&branching.with_element(element).map_err(broken)?, &history, 1)
        });
        Ok(Self {
            temperatures: temperatures.to_vec(),
            air,
            crystals: crystals.into_iter().collect::<Result<_>>()?,
        })
    }

    /// Each crystal as large as fits its place: what is compared is the shape.
    fn picture(&self, title: &str) -> Result<Picture> {
        let broken = |cause: ImageError| Error::broken(cause.to_string());
        let (left, top) = (64, 34);
        let (columns, rows) = (self.temperatures.len(), HUMIDITIES.len());
        let thumb = THUMB as u32;
        let (width, height) = (left + columns as u32 * thumb + 10, top + rows as u32 * thumb + 56);
        let mut sheet = Picture::new(width, height, ground()).map_err(broken)?;
        for (k, crystal) in self.crystals.iter().enumerate() {
            let (view, long) = view_of(crystal);
            let relief = Relief::of(crystal, view, room(crystal, long), THUMB)
                .map_err(|cause| Error::broken(cause.to_string()))?;
            let (column, row) = (k % columns, k / columns);
            sheet.paste(
                &unmarked(&relief, Light::BrightField(suited(&relief)))?,
                left as i32 + column as i32 * THUMB as i32,
                top as i32 + row as i32 * THUMB as i32,
            );
        }
        let size = 15.0;
        let mut words = |x: f64, y: f64, text: &str| {
            let from = x - 0.5 * text_width(size, text, Face::Regular);
            draw_text(&mut sheet, from.max(2.0), y, size, INK, text, Face::Regular);
        };
        let middle = |k: usize| (k as f64 + 0.5) * f64::from(thumb);
        for (row, per_cent) in HUMIDITIES.iter().enumerate() {
            words(32.0, f64::from(top) + middle(row) + 5.0, &format!("{per_cent} %"));
        }
        let below = f64::from(top) + rows as f64 * f64::from(thumb);
        for (column, temperature) in self.temperatures.iter().enumerate() {
            words(f64::from(left) + middle(column), below + 20.0, &format!("{temperature}"));
        }
        words(0.5 * f64::from(width), below + 44.0, "temperature (°C)");
        draw_text(&mut sheet, 12.0, 22.0, size, INK, title, Face::Regular);
        monochrome(&sheet)
    }
}

/// How many of a plate at 5 % and a dendrite at 15 % grow at -15 C.
fn dry_and_humid(branching: &Branching, over: Over) -> Result<i32> {
    let of = |per_cent: f64| -> Result<&'static str> {
        let history = History::constant(-15.0, per_cent / 100.0, over, 8.0).map_err(broken)?;
        Ok(grown(branching, &history, 1)?.name())
    };
    Ok(i32::from(of(5.0)? == "plate") + i32::from(of(15.0)? == "dendrite"))
}

/// Habits at saturation over water against the classic bands: the confusion matrix.
fn at_saturation(lab: &mut Lab, bands: &[Band], off: f64) -> Result<()> {
    let mut counts = [[0_u32; 6]; 6];
    let mut range: Option<(f64, f64)> = None;
    for k in 0..80 {
        let temperature = -0.25 - 0.5 * f64::from(k);
        let air = (temperature + off).min(0.0);
        let found = Habit::grown(air, saturation::water_saturation(air), &HabitLimits::ASSUMED);
        if found == Habit::Dendrite {
            let (warm, _) = range.unwrap_or((temperature, temperature));
            range = Some((warm, temperature));
        }
        let band = band_at(bands, "classic", temperature).and_then(|band| band.habit(true));
        if let Some(known) = band {
            counts[known as usize][found as usize] += 1;
        }
    }
    let all: u32 = counts.as_flattened().iter().sum();
    let agreed: u32 = (0..6).map(|k| counts[k][k]).sum();
    lab.found(&HUMID, f64::from(agreed) / f64::from(all));
    // Between two of the temperatures it may end anywhere: a quarter of a degree is in the middle.
    let off = range.map(|(warm, cold)| ((warm + 0.25) + 12.0).abs().max(((cold - 0.25) + 16.0).abs()));
    lab.found(&DENDRITES, off);
    let names: Vec<String> = Habit::ALL.iter().map(|habit| habit.name().to_owned()).collect();
    let short = |name: &String| name.replace("sectored-plate", "sector").replace("-column", "");
    lab.keep(
        "confusion",
        "Habits at saturation over water, 0 to -40 C, half a degree apart: how many the classic bands have as the row says and the model grows as the column says",
        HeatMap {
            title: "Classic bands against what grows".to_owned(),
            x: ("grown".to_owned(), names.iter().map(short).collect()),
            y: ("classic band".to_owned(), names.iter().map(short).collect()),
            cells: counts.iter().map(|row| row.iter().map(|n| Some(f64::from(*n))).collect()).collect(),
            darkest: 36.0,
            accepted: None,
            digits: 0,
        },
    )
}

/// The axes after 10 minutes.
fn axes(lab: &mut Lab, off: f64) -> Result<()> {
    let temperatures: Vec<f64> = (1..=400).map(|k| -0.1 * f64::from(k)).collect();
    let grown = |temperature: &f64| {
        let temperature = (temperature + off).min(0.0);
        let supersaturation = saturation::water_saturation(temperature);
        let air = Air { temperature, supersaturation, pressure: 1e5, ventilation: 1.0 };
        Axes::sphere(Axes::SEED).grown(&air, 600.0)
    };
    let axes: Vec<Axes> = temperatures.iter().map(grown).collect();
    let best = |of: &dyn Fn(&Axes) -> f64| {
        let most = (0..axes.len()).max_by(|a, b| of(&axes[*a]).total_cmp(&of(&axes[*b])));
        most.map(|k| temperatures[k])
    };
    lab.found(&A_AXIS, best(&|axes| axes.a));
    lab.found(&C_AXIS, best(&|axes| axes.c));
    let series = |name: &str, of: &dyn Fn(&Axes) -> f64| {
        let points = temperatures.iter().zip(&axes).map(|(t, axes)| (*t, 2e6 * of(axes)));
        Series::new(name, Draw::Line, points)
    };
    lab.keep(
        "axes",
        "Axes of crystals after 10 minutes at saturation over water",
        Plot {
            title: "How large crystals are after ten minutes".to_owned(),
            x: Axis::within("temperature (°C)", -40.0, 0.0),
            y: Axis::log("axis (µm)", 30.0, 3000.0),
            series: vec![series("across (2a)", &|axes| axes.a), series("along (2c)", &|axes| axes.c)],
            bands: Vec::new(),
        },
    )
}

/// By how much tips of arms are faster or slower than the a axis, relative, at worst.
fn tips(branching: &Branching) -> Result<f64> {
    let mut worst = 0.0_f64;
    for k in 0..10 {
        let temperature = -11.0 - f64::from(k);
        let history = History::saturated(temperature, 15.0).map_err(broken)?;
        let (_, supersaturation) = history.at(0.0);
        let air = Air { temperature, supersaturation, pressure: 1e5, ventilation: 1.0 };
        let element = Axes::sphere(Axes::SEED).grown(&air, 60.0 * history.minutes()).a / 100.0;
        let crystal = grown(&branching.with_element(element).map_err(broken)?, &history, 1)?;
        let wanted = (crystal.axes().a - Axes::SEED) / (60.0 * history.minutes());
        let Some(cells) = crystal.tally().tip_speed(0) else { continue };
        worst = worst.max((cells * crystal.element() / wanted - 1.0).abs());
    }
    Ok(worst)
}
