use super::*;
use crate::frost::{Edge, Inflow, Parameters, Redraw, RingTouchingIce};
use crate::image::{Kind, Vitals};
use crate::sketch::{Bend, Placement, Sketch, read_svg_bent};

const DRAWING: &[u8] =
    br#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 160 90"><rect width="160" height="90"/>
    <circle class="start" cx="30" cy="60" r="2"/><circle class="start" cx="120" cy="30" r="2"/></svg>"#;

fn grown(degrees: f64, steps: usize) -> (Sketch, Frost) {
    let parameters = Parameters {
        alpha: 1.0,
        beta: 0.45,
        gamma: 0.001,
        threshold: 0.3,
        steps_per_frame: 10,
        inflow: Inflow::ReiterGated,
        redraw: Redraw::Frame,
        edge: Edge::Reflecting,
        ring_touching_ice: RingTouchingIce::Zero,
    };
    let bend = (degrees > 0.0).then_some(Bend { degrees, seed: Seed(1) });
    let sketch = read_svg_bent(DRAWING, Placement::Points(4000), bend).unwrap();
    let mut frost = Frost::new(&sketch.region, &sketch.starts, parameters, Seed(1)).unwrap();
    for _ in 0..steps {
        frost.step();
    }
    (sketch, frost)
}

fn pane(sketch: &Sketch, last: &Frost, width: u32) -> Pane {
    Pane::new(Chart::filled(sketch, width, width * 9 / 16).unwrap(), last, Seed(1))
}

fn luminance(light: [f32; 3]) -> f32 {
    0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2]
}

#[test]
fn the_same_photograph_on_any_number_of_threads() {
    let (sketch, frost) = grown(40.0, 600);
    let photograph = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| pane(&sketch, &frost, 320).photograph(&Thickness::of(&frost)).unwrap())
    };
    let one = photograph(1);
    assert_eq!(one.non_finite(), 0);
    assert_eq!(one, photograph(5));
}

#[test]
fn nothing_is_clipped_and_frost_is_lighter_than_the_night() {
    let (sketch, frost) = grown(0.0, 800);
    let pane = pane(&sketch, &frost, 480);
    let bare = pane.photograph(&Thickness(vec![0.0; sketch.region.len()])).unwrap();
    let iced = pane.photograph(&Thickness::of(&frost)).unwrap();
    for photograph in [&bare, &iced] {
        let vitals = Vitals::of(&photograph.develop(EXPOSURE, CURVE), photograph.non_finite());
        assert_eq!(vitals.fault(Kind::Photograph), None, "{vitals:?}");
    }
    let mean = |photograph: &Photograph| {
        let sum: f32 = photograph.pixels().iter().map(|light| luminance(*light)).sum();
        sum / photograph.pixels().len() as f32
    };
    assert!(mean(&iced) > 2.0 * mean(&bare), "{} {}", mean(&iced), mean(&bare));
}

/// Where there is no ice, and none near, the photograph does not change: a film does not flicker.
#[test]
fn bare_glass_shows_the_same_scene_in_every_frame() {
    let (sketch, young) = grown(0.0, 60);
    let (_, old) = grown(0.0, 900);
    let pane = pane(&sketch, &old, 320);
    let bare = pane.photograph(&Thickness(vec![0.0; sketch.region.len()])).unwrap();
    let first = pane.photograph(&Thickness::of(&young)).unwrap();
    let same = bare.pixels().iter().zip(first.pixels()).filter(|(a, b)| a == b).count();
    let share = same as f64 / bare.pixels().len() as f64;
    assert!(share > 0.8 && share < 1.0, "{share}");
}

/// Milk: of even ice the thicker hides more of what is behind, and all of it in the end.
#[test]
fn thick_ice_hides_the_lamps() {
    let (sketch, frost) = grown(0.0, 800);
    let mut pane = pane(&sketch, &frost, 320);
    pane.leans.fill([0.0; 2]);
    let contrast = |u: f32| {
        let even = pane.photograph(&Thickness(vec![u; sketch.region.len()])).unwrap();
        let row = &even.pixels()[320 * 108..320 * 110]; // where the lamps are
        let light: Vec<f32> = row.iter().map(|light| luminance(*light)).collect();
        let mean = light.iter().sum::<f32>() / light.len() as f32;
        light.iter().map(|l| (l - mean).abs()).sum::<f32>() / light.len() as f32 / mean
    };
    let all = [0.0, 1.0, 2.0, 4.0].map(contrast);
    assert!(all.is_sorted_by(|a, b| a > b), "{all:?}");
}

#[test]
fn branches_lean_each_its_own_way_and_cells_of_one_lean_alike() {
    let (sketch, frost) = grown(0.0, 900);
    let leans = branch::leans(&frost, Seed(1));
    assert_eq!(leans, branch::leans(&frost, Seed(1)));
    assert_ne!(leans, branch::leans(&frost, Seed(2)));
    let mut own: Vec<[u32; 2]> = (0..leans.len())
        .filter(|cell| frost.is_ice(*cell))
        .map(|cell| leans[cell].map(f32::to_bits))
        .collect();
    let cells = own.len();
    own.sort_unstable();
    own.dedup();
    assert!(own.len() > 20 && own.len() * 4 < cells, "{} branches of {cells} cells", own.len());
    assert!(leans.iter().flatten().all(|lean| lean.abs() < 0.6), "slopes are small");
    assert!((0..sketch.region.len()).all(|cell| frost.is_ice(cell) || leans[cell] == [0.0; 2]));
}

#[test]
fn thickness_is_u_of_the_ice() {
    let (_, frost) = grown(0.0, 900);
    let thickness = Thickness::of(&frost);
    for cell in 0..frost.region().len() {
        let expected = if frost.is_ice(cell) { frost.u(cell) as f32 } else { 0.0 };
        assert_eq!(thickness.0[cell], expected);
    }
    assert!(thickness.quantile(0.0) >= 1.0 && thickness.quantile(0.95) < thickness.quantile(1.0));
    assert_eq!(Thickness(vec![0.0; 3]).quantile(0.95), 1.0);
}
