use std::f64::consts::PI;

use nalgebra::point;
use proptest::prelude::*;

use super::*;
use crate::hexgrid::ROW_HEIGHT;

const DATA: [(&str, &[u8]); 5] = [
    ("window-pane.svg", include_bytes!("../../experiments/data/window-pane.svg")),
    ("leaf.svg", include_bytes!("../../experiments/data/leaf.svg")),
    ("word.svg", include_bytes!("../../experiments/data/word.svg")),
    ("mitten.png", include_bytes!("../../experiments/data/mitten.png")),
    ("night-window.svg", include_bytes!("../../experiments/data/night-window.svg")),
];

fn drawn(body: &str, placement: Placement) -> Result<Sketch, SketchError> {
    read_svg(format!("<svg xmlns='http://www.w3.org/2000/svg'>{body}</svg>").as_bytes(), placement)
}

fn count(body: &str) -> usize {
    drawn(body, Placement::Spacing(1.0)).map_or(0, |sketch| sketch.region.len())
}

fn area(sketch: &Sketch) -> f64 {
    sketch.region.len() as f64 * sketch.spacing * sketch.spacing * ROW_HEIGHT
}

fn picture(width: u32, height: u32, colour: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let samples: Vec<u8> =
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).flat_map(|(x, y)| colour(x, y)).collect();
    encoded(width, height, ::png::ColorType::Rgba, ::png::BitDepth::Eight, &[], &[], &samples)
}

fn encoded(
    width: u32,
    height: u32,
    colour: ::png::ColorType,
    depth: ::png::BitDepth,
    palette: &[u8],
    clear: &[u8],
    samples: &[u8],
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if !palette.is_empty() {
        encoder.set_palette(palette);
    }
    if !clear.is_empty() {
        encoder.set_trns(clear);
    }
    encoder.write_header().unwrap().write_image_data(samples).unwrap();
    bytes
}

const CLEAR: [u8; 4] = [0; 4];
const BLUE: [u8; 4] = [40, 90, 200, 255];
const RED: [u8; 4] = [255, 0, 0, 255];

#[test]
fn a_disc_is_the_same_drawn_or_painted() {
    let drawing = drawn("<circle cx='200' cy='200' r='150' fill='blue'/>", Placement::Across(80)).unwrap();
    let disc = |x: u32, y: u32| {
        let (x, y) = (f64::from(x) - 199.5, f64::from(y) - 199.5);
        if x * x + y * y <= 150.0 * 150.0 { BLUE } else { CLEAR }
    };
    let painting = read_png(&picture(400, 400, disc), Placement::Across(80)).unwrap();
    assert_eq!(drawing.spacing, 3.75);
    assert_eq!(painting.spacing, 3.75);
    assert_eq!((drawing.origin, painting.origin), (point![200.0, 200.0], point![200.0, 200.0]));
    let border = drawing.region.border().len();
    assert!(drawing.region.len().abs_diff(painting.region.len()) < border / 4);
    assert!((area(&drawing) / (PI * 150.0 * 150.0) - 1.0).abs() < 0.01);
    assert!(drawing.starts.is_empty());
    // The disc of the lattice itself: q² + qr + r² <= 40².
    assert!(drawing.region.len().abs_diff(Region::disc(1600).len()) <= 12);
}

#[test]
fn so_many_points_are_placed_as_were_asked_for() {
    let disc = "<circle r='37' transform='rotate(10)'/>";
    // Points that lie evenly about the middle come six at a time.
    for number in [1, 2, 7, 100, 2000, 50_000] {
        let found = drawn(disc, Placement::Points(number)).unwrap().region.len();
        assert!(found.abs_diff(number) <= (number / 100).max(6), "{found} of {number}");
    }
    let thin = drawn("<path d='M0 0L1000 900 1000 901z'/>", Placement::Points(500)).unwrap().region.len();
    assert!(thin.abs_diff(500) < 25, "{thin}");
    assert_eq!(drawn(disc, Placement::Points(0)), Err(SketchError::Points(0)));
}

#[test]
fn a_lattice_point_is_a_cell_if_it_lies_in_the_paint() {
    let body =
        "<path d='M0 0H10V10H0Z M3 3H7V7H3Z' fill-rule='evenodd'/><circle class='start' cx='1' cy='2'/>";
    let sketch = drawn(body, Placement::Spacing(0.37)).unwrap();
    assert_eq!((sketch.origin, sketch.starts.as_slice()), (point![1.0, 2.0], &[Axial::ORIGIN][..]));
    for r in -10..40 {
        for q in -30..40 {
            let place = sketch.position(Axial::new(q, r));
            let within = |low: f64, high: f64| [place.x, place.y].iter().all(|v| (low..high).contains(v));
            let inside = within(0.0, 10.0) && !within(3.0, 7.0);
            assert_eq!(sketch.region.contains(Axial::new(q, r)), inside, "{place}");
        }
    }
}

#[test]
fn fill_rules_holes_and_the_painters_order() {
    let square = count("<rect width='40' height='40'/>");
    let ring = "d='M0 0H40V40H0Z M10 10H30V30H10Z'";
    let (whole, hollow) =
        (count(&format!("<path {ring}/>")), count(&format!("<path fill-rule='evenodd' {ring}/>")));
    assert_eq!(whole, square);
    assert!((hollow as f64 / square as f64 - 0.75).abs() < 0.02);
    assert_eq!(count(&format!("<g style='fill-rule:evenodd'><path {ring}/></g>")), hollow);
    assert_eq!(count("<path d='M0 0H40V40H0Z M10 10V30H30V10Z'/>"), hollow);
    let base = "<rect width='40' height='40'/>";
    for white in ["white", "#fff", "#ffffff", "rgb(255,255,255)", "White", "rgb(100%,100%,100%)"] {
        assert_eq!(
            count(&format!("{base}<rect x='10' y='10' width='20' height='20' fill='{white}'/>")),
            hollow
        );
        assert_eq!(
            count(&format!("<rect x='10' y='10' width='20' height='20' fill='{white}'/>{base}")),
            square
        );
    }
}

#[test]
fn what_is_hidden_is_not_paint_and_styles_are_inherited() {
    let r = "<rect id='i' class='a b' width='9' height='9'/>";
    let all = count(r);
    assert!(all > 80);
    for seen in [
        format!("<g fill='none'><g style='fill: url(#x)'>{r}</g></g>"),
        format!("<g fill='currentColor' opacity='.5'>{r}</g>"),
        format!("<g visibility='hidden'><g visibility='visible'>{r}</g></g>"),
        format!("<style>g *{{fill:none}} .c{{fill:none}} circle{{fill:none}}</style>{r}"),
        format!(
            "<style>/* .a{{fill:none}} */ @media print {{ .a{{fill:none}} }} .a.b{{fill:red}} .b{{fill:none}}</style>{r}"
        ),
        format!("<style>@import 'x'; rect{{fill:none}} #i{{fill:red !important}}</style>{r}"),
        format!("<a><switch><svg>{r}</svg></switch></a>"),
        format!("<defs><g id='d'>{r}</g></defs><use href='#d'/>"),
        format!("<symbol id='d'>{r}</symbol><use href='#d' x='3' y='4'/>"),
        format!("<use xmlns:l='http://www.w3.org/1999/xlink' l:href='#i'/><defs>{r}</defs>"),
        format!("<g fill='nonsense'>{r}</g>"),
    ] {
        assert!(count(&seen).abs_diff(all) <= 12, "{seen}");
    }
    for bare in [
        format!("<g fill='none'>{r}</g>"),
        format!("<g fill='transparent'>{r}</g>"),
        format!("<g fill='rgba(9,9,9,0)'>{r}</g>"),
        format!("<g fill='white'>{r}</g>"),
        format!("<g style='fill-opacity:0%'>{r}</g>"),
        format!("<g opacity='0'><g opacity='1'>{r}</g></g>"),
        format!("<g display='none'>{r}</g>"),
        format!("<g style='visibility:hidden'>{r}</g>"),
        format!("<style>.b, nav{{fill:none}}</style>{r}"),
        format!("<style><![CDATA[rect#i.a{{display:none}}]]></style>{r}"),
        format!("<style>.a{{fill:red}}</style><g>{}</g>", r.replace("id", "style='fill:none' id")),
        format!(
            "<defs>{r}</defs><clipPath>{r}</clipPath><mask>{r}</mask><symbol>{r}</symbol><pattern>{r}</pattern>"
        ),
        format!("<x:g xmlns:x='urn:x'>{r}</x:g>"),
        "<path d='M0 0H9' stroke='red'/><text>no</text>".into(),
    ] {
        let error = drawn(&bare, Placement::Spacing(1.0)).unwrap_err();
        assert!(matches!(error, SketchError::NoPaint { .. }), "{bare}: {error}");
    }
}

#[test]
fn transforms_take_shapes_and_starts_along() {
    let start = |transform: &str| {
        let body = format!(
            "<g transform='{transform}'><rect x='-9' y='-9' width='40' height='40'/>\
             <circle class='big start' cx='3' cy='4' r='2' fill='none'/></g>"
        );
        let sketch = drawn(&body, Placement::Spacing(0.5)).unwrap();
        (sketch.origin.x, sketch.origin.y, area(&sketch))
    };
    for (transform, x, y, scale) in [
        ("", 3.0, 4.0, 1.0),
        ("translate(5)", 8.0, 4.0, 1.0),
        ("rotate(90)", -4.0, 3.0, 1.0),
        ("rotate(-90)", 4.0, -3.0, 1.0),
        ("rotate(180 3 4)", 3.0, 4.0, 1.0),
        ("scale(2) translate(1,1)", 8.0, 10.0, 4.0),
        ("scale(-1 .5)", -3.0, 2.0, 0.5),
        ("matrix(1 0 .5 2 7 8)", 12.0, 16.0, 2.0),
        ("skewX(45)", 7.0, 4.0, 1.0),
        ("skewY(45)", 3.0, 7.0, 1.0),
    ] {
        let (found_x, found_y, area) = start(transform);
        assert!((found_x - x).abs() + (found_y - y).abs() < 1e-12, "{transform}");
        assert!((area / (1600.0 * scale) - 1.0).abs() < 0.04, "{transform}: {area}");
    }
    let turned =
        |degrees: u32| count(&format!("<rect rx='9' width='60' height='40' transform='rotate({degrees})'/>"));
    let rounded = (2400.0 - (4.0 - PI) * 81.0) / ROW_HEIGHT;
    assert!((0..360).step_by(7).all(|d| (f64::from(turned(d) as u32) / rounded - 1.0).abs() < 0.03));
}

#[test]
fn starts_snap_to_the_region_or_are_refused() {
    let both = |x: &str| {
        let body = format!(
            "<rect width='20' height='20'/><rect x='19.9' y='10.5' width='2.6' height='.3'/>\
             <circle class='start' cx='0' cy='0'/><circle class='start' cx='{x}' cy='10.6'/><circle class='start'/>"
        );
        drawn(&body, Placement::Spacing(1.0))
    };
    // In the paint, though its lattice point is not: the nearest cell, in the square, is taken.
    let snapped = both("20.9").unwrap();
    assert_eq!(snapped.starts.len(), 2);
    assert!((snapped.position(snapped.starts[1]) - point![20.9, 10.6]).norm() <= 2.0);
    // In the paint, but too far from every cell; and not in the paint at all.
    for x in ["22.4", "23"] {
        let error = both(x).unwrap_err();
        assert!(matches!(error, SketchError::StartOutside { number: 2, .. }), "{error}");
    }
    let hole = "<path fill-rule='evenodd' d='M0 0H40V40H0Z M10 10H30V30H10Z'/><circle class='start' cx='20' cy='20'/>";
    for placement in [Placement::default(), Placement::Spacing(500.0), Placement::Points(9)] {
        assert!(matches!(drawn(hole, placement), Err(SketchError::StartOutside { number: 1, .. })));
    }
}

#[test]
fn red_blobs_are_starts() {
    let red = |x: u32, y: u32| {
        let dot = (10..14).contains(&x) && (20..23).contains(&y);
        // An arch, whose centroid lies beneath it, touching only at corners.
        let arch = (5..15).contains(&y) && (y + 30 == x || x + y == 40);
        if dot || arch { RED } else { BLUE }
    };
    let sketch = read_png(&picture(60, 40, red), Placement::Spacing(1.0)).unwrap();
    assert_eq!(sketch.starts.len(), 2);
    // Red is paint too; a row or a column more or less depends on where the lattice lies.
    assert!((area(&sketch) / 2400.0 - 1.0).abs() < 0.03);
    // The arch comes first in page order; the dot's centroid is its middle.
    let dot = point![12.0, 21.5];
    assert!((sketch.position(sketch.starts[1]) - dot).norm() <= 0.58);
    let (x, y) = (sketch.origin.x - 0.5, sketch.origin.y - 0.5);
    assert_eq!(red(x as u32, y as u32), RED);
    assert_eq!((x.fract(), y.fract()), (0.0, 0.0));
}

#[test]
fn every_kind_of_png_is_read() {
    use ::png::{BitDepth as D, ColorType as C};
    let row = Placement::Spacing(1.0);
    let cells = |bytes: &[u8]| read_png(bytes, row).unwrap().region.len();
    // Four pixels each, of which the two in the middle are paint.
    let two = cells(&picture(4, 1, |x, _| if x % 3 == 0 { CLEAR } else { BLUE }));
    let (plain, none): (&[u8], &[u8]) = (&[255, 255, 255, 9, 9, 9], &[]);
    for (colour, depth, palette, clear, samples) in [
        (C::Grayscale, D::One, none, none, &[0b1001_0000_u8][..]),
        (C::Grayscale, D::Two, none, none, &[0b1101_1011]),
        (C::Grayscale, D::Four, none, none, &[0xf0, 0xef]),
        (C::Grayscale, D::Eight, none, &[0, 7][..], &[7, 254, 0, 255]),
        (C::Grayscale, D::Sixteen, none, none, &[255, 255, 0, 0, 254, 255, 255, 255]),
        (C::GrayscaleAlpha, D::Eight, none, none, &[0, 127, 0, 128, 254, 255, 255, 255]),
        (C::Rgb, D::Eight, none, none, &[255, 255, 255, 255, 255, 254, 0, 0, 0, 255, 255, 255]),
        (C::Indexed, D::One, plain, none, &[0b0110_0000]),
        (C::Indexed, D::Eight, plain, &[255, 255][..], &[0, 1, 1, 0]),
        (C::Indexed, D::Two, &[9, 9, 9, 8, 8, 8][..], &[0][..], &[0b0001_0100]),
    ] {
        assert_eq!(
            cells(&encoded(4, 1, colour, depth, palette, clear, samples)),
            two,
            "{colour:?} {depth:?}"
        );
    }
}

#[test]
fn the_sketches_that_are_shipped() {
    let sizes = DATA.map(|(name, bytes)| {
        let read = if name.ends_with("svg") { read_svg } else { read_png };
        let sketch = read(bytes, Placement::default()).unwrap();
        for placement in [48, 80, 120, 200].map(Placement::Across) {
            let pieces = read(bytes, placement).unwrap().region.pieces();
            assert!(pieces.iter().all(|piece| *piece == 0), "{name} is in one piece at {placement:?}");
        }
        assert_eq!(sketch.starts[0], Axial::ORIGIN);
        assert!(sketch.starts.iter().all(|start| sketch.region.contains(*start)));
        (name, sketch.starts.len(), sketch.region.len())
    });
    assert_eq!(sizes.map(|s| s.1), [1, 1, 5, 1, 13]);
    assert_eq!(
        sizes.map(|s| (s.0, s.2)),
        [
            ("window-pane.svg", 4022),
            ("leaf.svg", 1734),
            ("word.svg", 1552),
            ("mitten.png", 3944),
            ("night-window.svg", 4160)
        ]
    );
}

#[test]
fn every_fault_is_named_on_one_line() {
    let deep = "<g>".repeat(200) + &"</g>".repeat(200);
    let doubled: String =
        (0..40).map(|i| format!("<g id='g{}'><use href='#g{i}'/><use href='#g{i}'/></g>", i + 1)).collect();
    let many = "<circle class='start'/>".repeat(MOST_STARTS + 1);
    let attributes: String = (0..2000).map(|i| format!(" a{i}=''")).collect();
    let rules = ".a{}".repeat(2000);
    let saw = format!("<path d='M0 0{}z'/>", "L1e9 1e9 0 1e9 0 -1e9".repeat(1500));
    for (body, part) in [
        ("<path d='M0 0L1e'/>", "line 1, column 41, `path`: in `d`"),
        ("\n<path d='M0 0L1 2e10'/>", "line 2, column 1"),
        ("<path d='\n\n\u{7}'/>", "cannot be read"),
        ("<path d='M0 0\n\n!'/>", "in `d`"),
        ("<rect width='1e400' height='1'/>", "expected a number up to 1000000000"),
        ("<rect width='NaN' height='1'/>", "\"NaN\""),
        ("<rect width='50%' height='1'/>", "`width` is \"50%\""),
        ("<rect width='-1' height='1'/>", "expected 0 or more"),
        ("<polygon points='0 0 1'/>", "without its y"),
        ("<g transform='turn(3)'/>", "list of transforms"),
        ("<g transform='scale(1e300) scale(1e300)'/>", "not finite"),
        ("<g style='transform:none;transform : scale(2)'/>", "expected a `transform` attribute"),
        ("<g transform='scale(1e9)'><rect width='2' height='2'/></g>", "a point at (2000000000, "),
        ("<use href='other.svg#a'/>", "expected the `#id` of an element here"),
        ("<use id='u' href='#u'/>", "no `use` that draws itself"),
        (deep.as_str(), "nested deeper than 128"),
        (&format!("<g id='g0'/>{doubled}"), "more than 200000 elements drawn"),
        (&many, "more than 4096 starts"),
        (&format!("<g{attributes}/>"), "attributes on one element"),
        (&format!("<style>{rules}</style>"), "style rules"),
        ("<rect width='0' height='5'/>", "no paint"),
        ("<rect><", "cannot be read"),
    ] {
        let message = drawn(body, Placement::Spacing(100.0)).unwrap_err().to_string();
        assert!(message.contains(part) && !message.contains('\n'), "{part}: {message}");
    }
    let disc = "<circle r='5'/>";
    for (body, placement, part) in [
        (saw.as_str(), Placement::Spacing(3e5), "straight pieces or crossings"),
        (disc, Placement::Across(0), "finite number above 0"),
        (disc, Placement::Spacing(0.0), "the spacing is 0"),
        (disc, Placement::Spacing(f64::NAN), "the spacing is NaN"),
        (disc, Placement::Spacing(f64::INFINITY), "the spacing is inf"),
        (disc, Placement::Spacing(-1.0), "the spacing is -1"),
        (disc, Placement::Spacing(1e-300), "too fine"),
        (disc, Placement::Spacing(f64::MIN_POSITIVE / 8.0), "too fine"),
        (disc, Placement::Spacing(0.002), "choose a larger spacing"),
        (disc, Placement::Across(u32::MAX), "too fine"),
        (disc, Placement::Points(usize::MAX), "expected 1 to 4000000"),
        ("<path d='M0 1L2 0 3 0Z'/>", Placement::Spacing(99.0), "a smaller one is needed"),
    ] {
        let message = drawn(body, placement).unwrap_err().to_string();
        assert!(message.contains(part) && !message.contains('\n'), "{part}: {message}");
    }
    let entities = b"<!DOCTYPE svg [<!ENTITY a 'b'>]><svg/>";
    for (bytes, part) in
        [(&entities[..], "XML entities"), (b"", "SVG"), (b"<html/>", "\"html\""), (b"\xff\xfe<", "UTF-8")]
    {
        let message = read_svg(bytes, Placement::default()).unwrap_err().to_string();
        assert!(message.contains(part) && !message.contains('\n'), "{part}: {message}");
    }
    let plain = b"\xef\xbb\xbf<?xml version='1.0'?><!DOCTYPE svg PUBLIC 'a' 'b'><svg><circle r='5'/></svg>";
    assert!(read_svg(plain, Placement::default()).is_ok());
}

#[test]
fn pictures_that_cannot_be_used() {
    let bare = picture(9, 9, |x, _| if x % 2 == 0 { CLEAR } else { [255; 4] });
    assert!(matches!(read_png(&bare, Placement::default()), Err(SketchError::NoPaint { .. })));
    let speckled = picture(300, 300, |x, y| if x % 2 + y % 2 == 0 { RED } else { BLUE });
    assert_eq!(read_png(&speckled, Placement::default()), Err(SketchError::TooManyStarts));
    let mut huge = DATA[3].1.to_vec();
    huge[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    let message = read_png(&huge, Placement::default()).unwrap_err().to_string();
    assert!(!message.contains('\n'), "{message}");
    // A palette whose last colour is cut short, on which the decoder itself would panic.
    let short = encoded(
        4,
        1,
        ::png::ColorType::Indexed,
        ::png::BitDepth::Eight,
        &[255, 255, 255, 0, 0],
        &[],
        &[1, 0, 1, 1],
    );
    assert!(matches!(read_png(&short, Placement::default()), Err(SketchError::Png { .. })));
    for length in (0..DATA[3].1.len()).step_by(3) {
        let message = read_png(&DATA[3].1[..length], Placement::default())
            .map_or_else(|e| e.to_string(), |_| String::new());
        assert!(!message.contains('\n'), "{message}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_panic(which in 0..4_usize, places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..9)) {
        let mut bytes = DATA[which].1.to_vec();
        for (place, value) in places {
            let at = place.index(bytes.len());
            bytes[at] = value;
        }
        let _ = read_svg(&bytes, Placement::Across(20));
        let _ = read_png(&bytes, Placement::Across(20));
        let _ = read_cells(&bytes);
    }

    #[test]
    fn no_path_panics(
        data in "([MmLlTt] ?-?[0-9]{1,3} [0-9.]{1,3}|[CcQqSs]( -?[0-9]{1,10} 0){3}|[Zz]|[Hh]-[0-9]e[0-9]|\
                  [Aa] ?[0-9] [0-9] [0-9]{1,3} [01] [01] -?[0-9]e-?[0-9]{1,2} 3|[é0-9eE., -]){0,9}",
        transform in "((rotate|skewX|scale)\\(-?[0-9]{1,2}\\) ?){0,2}",
        noise in "[a-z0-9#.%()*é{}; -]{0,20}",
        power in -300..30_i32,
    ) {
        let path = format!("<path transform='{transform}' d='M1 2{data}'/>");
        for placement in [Placement::Across(30), Placement::Points(50), Placement::Spacing(libm::exp10(power.into()))] {
            let _ = drawn(&path, placement);
        }
        for body in [
            format!("<style>{noise}{{fill:red}}</style><g style='fill:{noise};{noise}'>{path}</g>"),
            format!("<polygon points='{data}'/><polyline points='{noise}'/>"),
            format!("<rect width='{noise}' height='9'/>"),
            format!("<g transform='{noise}'>{path}</g>"),
        ] {
            let _ = drawn(&body, Placement::Across(30));
        }
    }
}

/// A disc of radius 35 with a hole of radius 15, both around (50, 40).
const RING: &[u8] =
    br#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80"><path fill="blue" fill-rule="evenodd"
    d="M50 5 A35 35 0 0 1 50 75 A35 35 0 0 1 50 5 Z M50 25 A15 15 0 0 1 50 55 A15 15 0 0 1 50 25 Z"/>
    <circle class="start" cx="20" cy="40" r="2"/></svg>"#;

#[test]
fn a_bent_lattice_fills_the_same_paint() {
    use super::{Bend, read_svg_bent};
    use crate::rng::Seed;
    for seed in 1..=3 {
        let bend = Bend { degrees: 70.0, seed: Seed(seed) };
        let sketch = read_svg_bent(RING, Placement::Points(5000), Some(bend)).unwrap();
        assert!(sketch.region.len().abs_diff(5000) < 30, "{}", sketch.region.len());
        let warp = sketch.warp.as_ref().unwrap();
        let away = |at| (sketch.position(at) - nalgebra::point![50.0, 40.0]).norm();
        // Outlines are followed to a part of a spacing.
        let slack = 0.1 * sketch.spacing;
        let inside = 15.0 - slack..=35.0 + slack;
        assert!(sketch.region.cells().iter().all(|cell| inside.contains(&away(*cell))));
        let missing = 15.0 + slack..=35.0 - slack;
        assert!(sketch.region.ring().iter().all(|at| !missing.contains(&away(*at))));
        let start = sketch.position(sketch.starts[0]);
        assert!((start - nalgebra::point![20.0, 40.0]).norm() < 1e-6, "the first start is a lattice point");
        let (least, greatest) = warp.scales();
        assert!(least < 0.9 && greatest > 1.1);
    }
}

#[test]
fn no_bend_is_the_straight_lattice_and_a_picture_bends_as_a_drawing_does() {
    use super::{Bend, read_png_bent, read_svg_bent};
    use crate::rng::Seed;
    let straight = read_svg_bent(RING, Placement::Points(900), None).unwrap();
    assert_eq!(straight, read_svg(RING, Placement::Points(900)).unwrap());
    let mitten = include_bytes!("../../experiments/data/mitten.png");
    let bend = Bend { degrees: 50.0, seed: Seed(9) };
    let bent = read_png_bent(mitten, Placement::Points(3000), Some(bend)).unwrap();
    assert!(bent.region.len().abs_diff(3000) < 30 && bent.warp.is_some());
    assert_eq!(bent.region.pieces().iter().max(), Some(&0));
    let wrong = Bend { degrees: 90.0, ..bend };
    assert_eq!(read_png_bent(mitten, Placement::Points(3000), Some(wrong)), Err(SketchError::Bend(90.0)));
}
