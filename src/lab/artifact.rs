//! Artifacts: what a run leaves for people to look at.

use super::error::{Error, Result};
use super::plot::Plot;
use super::record::Signs;
use super::table::Table;
use crate::image::{self, CodeValues, Exposure, Photograph, Picture, ToneCurve, Vitals};

/// Something that a run leaves.
pub enum Artifact {
    /// A table: CSV.
    Table(Table),
    /// A plot: SVG.
    Plot(Plot),
    /// A drawing of lines and text: SVG.
    Svg(String),
    /// A drawing of cells: PNG.
    Drawing(Picture),
    /// A scene as a camera sees it: PNG. Fails if over 1 % is clipped or a value is not finite.
    Photograph(Photograph, Exposure, ToneCurve),
    /// A picture whose equation gives the pixel: PNG without curve or transfer.
    CodeValues(CodeValues),
    /// A moving drawing: animated PNG, below `large/`.
    Animation {
        /// The frames, all of one size.
        frames: Vec<Picture>,
        /// How many of them a second.
        frames_per_second: u16,
    },
}

macro_rules! from {
    ($($kind:ident($type:ty)),*) => { $(
        impl From<$type> for Artifact {
            fn from(value: $type) -> Self { Artifact::$kind(value) }
        }
    )* };
}
from!(Table(Table), Plot(Plot), Svg(String), Drawing(Picture), CodeValues(CodeValues));

/// A file, ready to be written.
pub(crate) struct Made {
    pub file: String,
    pub bytes: Vec<u8>,
    pub vitals: Option<Signs>,
}

/// The largest file that is committed.
pub(crate) const LARGEST: usize = 1_000_000;

impl Artifact {
    /// Makes the file; `name` has no extension.
    pub(crate) fn make(self, name: &str) -> Result<Made> {
        let plain =
            |extension: &str, bytes| Made { file: format!("{name}.{extension}"), bytes, vitals: None };
        Ok(match self {
            Artifact::Table(table) => plain("csv", table.to_csv()?),
            Artifact::Plot(plot) => plain("svg", plot.to_svg()?.into_bytes()),
            Artifact::Svg(svg) => plain("svg", svg.into_bytes()),
            Artifact::Drawing(picture) => picture_file(name, &picture, image::Kind::Drawing, 0)?,
            Artifact::Photograph(photograph, exposure, curve) => {
                let picture = photograph.develop(exposure, curve);
                picture_file(name, &picture, image::Kind::Photograph, photograph.non_finite())?
            }
            Artifact::CodeValues(values) => {
                picture_file(name, &values.picture(), image::Kind::CodeValues, values.non_finite())?
            }
            Artifact::Animation { frames, frames_per_second } => Made {
                file: format!("large/{name}.png"),
                bytes: image::encode_animation(&frames, frames_per_second)
                    .map_err(|cause| Error::broken("cannot make an animation").at(name).because(cause))?,
                vitals: None,
            },
        })
    }
}

fn picture_file(name: &str, picture: &Picture, kind: image::Kind, non_finite: u64) -> Result<Made> {
    let vitals = Vitals::of(picture, non_finite);
    if let Some(fault) = vitals.fault(kind) {
        return Err(Error::broken(fault).at(name));
    }
    let signs = Signs {
        kind: kind.name().to_owned(),
        black: vitals.black,
        white: vitals.white,
        p01: vitals.p01,
        p99: vitals.p99,
        non_finite: vitals.non_finite,
    };
    Ok(Made { file: format!("{name}.png"), bytes: image::encode(picture), vitals: Some(signs) })
}
