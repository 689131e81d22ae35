//! What `snowglobe frost` writes.

use std::fmt::Write;

use nalgebra::{Point2, point};
use ndarray::Array2;
use ndarray_npy::WriteNpyExt;
use rayon::prelude::*;
use serde_json::json;
use snowglobe::frost::{Ending, Frost, Painter};
use snowglobe::hexgrid::Axial;
use snowglobe::image::{self, Grey16Alpha, LatticeView};
use snowglobe::lab::{Cell, Error, Result, Table, maybe};
use snowglobe::sketch::Chart;

use super::{Args, Grown};

/// Frames an animation has at the most; a longer film skips some.
const MOST_ANIMATED: u64 = 300;
/// The largest animation in pixels across.
const WIDEST_ANIMATION: u32 = 480;

type File = (String, Vec<u8>);

/// All files, `summary.json` last.
pub(super) fn of(grown: &Grown, args: &Args) -> Result<Vec<File>> {
    let frost = grown.film.frost();
    let mut files = vec![("growth.csv".to_owned(), growth(grown).to_csv()?)];
    if let Some(search) = &grown.search {
        let mut table = Table::new(["rule", "step", "beta", "end_frame", "end_frame_interpolated"]);
        for i in &search.iterates {
            let (frame, crossing) = (i.end.map(|end| end.frame), i.end.map(|end| end.interpolated));
            table.row([i.rule.name().into(), i.step.into(), i.beta.into(), maybe(frame), maybe(crossing)]);
        }
        files.push(("iterates.csv".to_owned(), table.to_csv()?));
    }
    files.push(("age.npy".to_owned(), age_array(frost)?));
    files.push(("age.png".to_owned(), age_picture(grown, args.width)?));
    files.push(("points.ply".to_owned(), points(grown).into_bytes()));
    files.extend(frames(grown, args.width)?);
    let summary = serde_json::to_vec_pretty(&summary(grown, args))?;
    files.push(("summary.json".to_owned(), summary));
    Ok(files)
}

/// Ice in each frame, from 0.
fn growth(grown: &Grown) -> Table {
    let mut table = Table::new(["frame", "ice", "cells"]);
    for (frame, ice) in grown.counts.iter().enumerate() {
        table.row([Cell::from(frame), (*ice).into(), grown.sketch.region.len().into()]);
    }
    table
}

/// The frame in which each cell froze, `[r][q]` from the least coordinates on; -1 for none, -2 outside the region.
fn age_array(frost: &Frost) -> Result<Vec<u8>> {
    let bounds = frost.region().bounds();
    let ages = Array2::from_shape_fn((bounds.rows(), bounds.columns()), |(row, column)| {
        let at = Axial::new(bounds.least.q + column as i32, bounds.least.r + row as i32);
        match frost.region().ordinal(at) {
            Some(ordinal) => frost.frozen_in_frame(ordinal).map_or(-1, |frame| frame as i32),
            None => -2,
        }
    });
    let mut bytes = Vec::new();
    ages.write_npy(&mut bytes).map_err(|cause| Error::broken(cause.to_string()).at("age.npy"))?;
    Ok(bytes)
}

/// The same as a picture: grey is the frame's number, as it is, and what is not ice is transparent.
fn age_picture(grown: &Grown, width: u32) -> Result<Vec<u8>> {
    let (frost, region, margin) = (grown.film.frost(), &grown.sketch.region, (width / 40).max(1));
    if grown.sketch.warp.is_some() {
        let chart = Chart::around(&grown.sketch, width, margin)?;
        return ages(frost, chart.width(), chart.height(), |pixel| chart.place_of(pixel));
    }
    let view = LatticeView::around(region, width, margin)?;
    ages(frost, view.width(), view.height(), |pixel| view.place_of(pixel))
}

fn ages(
    frost: &Frost,
    width: u32,
    height: u32,
    place_of: impl Fn(Point2<f64>) -> Point2<f64>,
) -> Result<Vec<u8>> {
    let region = frost.region();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let (grey, alpha): (Vec<u16>, Vec<u16>) = pixels
        .map(|(x, y)| {
            let place = place_of(point![f64::from(x) + 0.5, f64::from(y) + 0.5]);
            let age =
                region.ordinal(Axial::containing(place)).and_then(|ordinal| frost.frozen_in_frame(ordinal));
            age.map_or((0, 0), |frame| (frame as u16, u16::MAX))
        })
        .unzip();
    Ok(image::encode_grey16_alpha(&Grey16Alpha::new(width, height, grey, alpha)?))
}

/// The cells as points in the sketch's units, y up.
fn points(grown: &Grown) -> String {
    let (sketch, frost) = (&grown.sketch, grown.film.frost());
    let mut ply = format!(
        "ply\nformat ascii 1.0\ncomment age is the frame in which the point froze, -1 for none\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\nproperty int q\nproperty int r\nproperty int age\n\
         end_header\n",
        sketch.region.len()
    );
    for (ordinal, cell) in sketch.region.cells().iter().enumerate() {
        let place = sketch.position(*cell);
        let age = frost.frozen_in_frame(ordinal).map_or(-1, |frame| frame as i64);
        let _ = writeln!(ply, "{} {} 0 {} {} {age}", place.x, 0.0 - place.y, cell.q, cell.r);
    }
    ply
}

/// A PNG for every frame and an animation.
fn frames(grown: &Grown, width: u32) -> Result<Vec<File>> {
    let (frost, last) = (grown.film.frost(), grown.film.frame());
    let painter = Painter::of_sketch(&grown.sketch, width, last, frost.parameters().beta)?;
    let mut files: Vec<File> = (0..=last)
        .into_par_iter()
        .map(|frame| {
            (format!("frames/frame-{frame:05}.png"), image::encode(&painter.draw_ice_at(frost, frame)))
        })
        .collect();
    let small =
        Painter::of_sketch(&grown.sketch, width.min(WIDEST_ANIMATION), last, frost.parameters().beta)?;
    let stride = last / MOST_ANIMATED + 1;
    let mut shown: Vec<u64> = (0..=last).step_by(stride as usize).collect();
    if shown.last() != Some(&last) {
        shown.push(last);
    }
    let pictures: Vec<_> = shown.into_par_iter().map(|frame| small.draw_ice_at(frost, frame)).collect();
    files.push(("animation.png".to_owned(), image::encode_animation(&pictures, 24)?));
    Ok(files)
}

fn summary(grown: &Grown, args: &Args) -> serde_json::Value {
    let (film, frost) = (&grown.film, grown.film.frost());
    let p = frost.parameters();
    let end = film.ending().and_then(Ending::reached);
    let ended = match film.ending() {
        Some(Ending::Reached(_)) => "reached",
        Some(Ending::Unreachable) => "unreachable",
        Some(Ending::Limit) => "frame-limit",
        None => "frames",
    };
    let border = frost.region().border();
    let border_ice = border.iter().filter(|ordinal| frost.is_ice(**ordinal)).count();
    let starts: Vec<[i32; 2]> = grown.starts.iter().map(|start| [start.q, start.r]).collect();
    let mut summary = json!({
        "t_sim": end.map(|end| end.frame),
        "t_sim_interpolated": end.map(|end| end.interpolated),
        "ended": ended,
        "cells": frost.region().len(),
        "ice": frost.ice(),
        "border_share": border_ice as f64 / border.len() as f64,
        "frames": film.frame(),
        "seed": args.seed,
        "beta": p.beta,
        "alpha": p.alpha,
        "gamma": p.gamma,
        "threshold": p.threshold,
        "steps_per_frame": p.steps_per_frame,
        "readings": {
            "inflow": p.inflow.name(), "redraw": p.redraw.name(), "edge": p.edge.name(),
            "ring-touching-ice": p.ring_touching_ice.name(),
        },
        "starts": starts,
        "spacing": grown.sketch.spacing,
        "warp_degrees": args.warp,
        "cell_updates": frost.updates(),
    });
    if let Some(search) = &grown.search {
        summary["target_reached"] = json!(search.reached);
        summary["films_grown"] = json!(search.evaluations);
        summary["search"] = json!(search.why);
    }
    summary
}
