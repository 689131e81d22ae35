//! Artifacts: what a run leaves for people to look at.

use super::error::{Error, Result};
use super::heatmap::HeatMap;
use super::plot::{Panels, Plot};
use super::record::Signs;
use super::table::Table;
use crate::image::{self, CodeValues, Exposure, Photograph, Picture, ToneCurve, Vitals};
use crate::mesh::{Motion, Part, glb};

/// Something that a run leaves.
pub enum Artifact {
    /// A table: CSV.
    Table(Table),
    /// A plot: SVG.
    Plot(Plot),
    /// Plots side by side: SVG.
    Panels(Panels),
    /// A drawing of lines and text: SVG.
    Svg(String),
    /// A drawing of cells: PNG.
    Drawing(Picture),
    /// A scene as a camera sees it: PNG. Fails if over 1 % is clipped or a value is not finite.
    Photograph(Photograph, Exposure, ToneCurve),
    /// A film as a camera sees it: a PNG for each frame, below `large/<name>/`, judged as a photograph each.
    Film(Vec<Photograph>, Exposure, ToneCurve),
    /// A picture whose equation gives the pixel: PNG without curve or transfer.
    CodeValues(CodeValues),
    /// Text files under one roof, (path, text): ZIP, without compression.
    Archive(Vec<(String, String)>),
    /// Bodies: glTF, below `large/`.
    Bodies(Vec<Part>),
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
from!(Table(Table), Plot(Plot), Panels(Panels), Svg(String), Drawing(Picture), CodeValues(CodeValues));

/// A file, ready to be written.
pub(crate) struct Made {
    pub file: String,
    pub bytes: Vec<u8>,
    pub vitals: Option<Signs>,
}

/// The largest file that is committed.
pub(crate) const LARGEST: usize = 1_000_000;

impl From<HeatMap> for Artifact {
    fn from(map: HeatMap) -> Self {
        Artifact::Svg(map.to_svg())
    }
}

impl Artifact {
    /// Makes the files: one, or one for each frame of a film; `name` has no extension.
    pub(crate) fn make(self, name: &str) -> Result<Vec<Made>> {
        let plain =
            |extension: &str, bytes| Made { file: format!("{name}.{extension}"), bytes, vitals: None };
        Ok(vec![match self {
            Artifact::Film(frames, exposure, curve) => {
                let frame = |(number, photograph): (usize, &Photograph)| {
                    photograph_file(&format!("large/{name}/frame-{number:05}"), photograph, exposure, curve)
                };
                return frames.iter().enumerate().map(frame).collect();
            }
            Artifact::Table(table) => plain("csv", table.to_csv()?),
            Artifact::Plot(plot) => plain("svg", plot.to_svg()?.into_bytes()),
            Artifact::Panels(panels) => plain("svg", panels.to_svg()?.into_bytes()),
            Artifact::Svg(svg) => plain("svg", svg.into_bytes()),
            Artifact::Drawing(picture) => picture_file(name, &picture, image::Kind::Drawing, 0)?,
            Artifact::Photograph(photograph, exposure, curve) => {
                photograph_file(name, &photograph, exposure, curve)?
            }
            Artifact::CodeValues(values) => {
                picture_file(name, &values.picture(), image::Kind::CodeValues, values.non_finite())?
            }
            Artifact::Archive(files) => {
                let bytes = archive(&files);
                plain("zip", bytes.map_err(|cause| Error::broken("cannot pack").at(name).because(cause))?)
            }
            Artifact::Bodies(parts) => Made {
                file: format!("large/{name}.glb"),
                bytes: glb(&parts, &Motion::default()),
                vitals: None,
            },
            Artifact::Animation { frames, frames_per_second } => Made {
                file: format!("large/{name}.png"),
                bytes: image::encode_animation(&frames, frames_per_second)
                    .map_err(|cause| Error::broken("cannot make an animation").at(name).because(cause))?,
                vitals: None,
            },
        }])
    }
}

/// The same bytes for the same files: no date but the format's first.
fn archive(files: &[(String, String)]) -> zip::result::ZipResult<Vec<u8>> {
    use std::io::Write;
    let options = zip::write::SimpleFileOptions::default()
        .compression_method(zip::CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::default())
        .unix_permissions(0o644);
    let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (path, text) in files {
        writer.start_file(path.as_str(), options)?;
        writer.write_all(text.as_bytes())?;
    }
    Ok(writer.finish()?.into_inner())
}

fn photograph_file(
    name: &str,
    photograph: &Photograph,
    exposure: Exposure,
    curve: ToneCurve,
) -> Result<Made> {
    let picture = photograph.develop(exposure, curve);
    picture_file(name, &picture, image::Kind::Photograph, photograph.non_finite())
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

#[cfg(test)]
mod tests {
    use super::*;

    fn photograph(bright: f32) -> Artifact {
        let mut pixels = vec![[0.2, 0.3, 0.4]; 1000];
        pixels[..20].fill([bright; 3]);
        Artifact::Photograph(
            Photograph::new(50, 20, pixels).unwrap(),
            Exposure { stops: 0.0 },
            ToneCurve::Linear,
        )
    }

    #[test]
    fn a_photograph_that_is_clipped_or_not_finite_fails() {
        let sound = photograph(0.5).make("a").unwrap().remove(0);
        let signs = sound.vitals.unwrap();
        assert_eq!((sound.file.as_str(), signs.kind.as_str(), signs.white), ("a.png", "photograph", 0.0));
        assert!(photograph(4.0).make("a").is_err(), "two in a hundred are white");
        assert!(photograph(f32::NAN).make("a").is_err());
    }

    #[test]
    fn code_values_are_written_as_they_are() {
        let values = CodeValues::new(3, 1, vec![0.0, 127.4, 255.0]).unwrap();
        let made = Artifact::CodeValues(values).make("c").unwrap().remove(0);
        let pixels = image::decode(&made.bytes).unwrap().rgba;
        assert_eq!(pixels.iter().map(|p| p[0]).collect::<Vec<_>>(), [0, 127, 255]);
        let broken = CodeValues::new(1, 1, vec![f64::NAN]).unwrap();
        assert!(Artifact::CodeValues(broken).make("c").is_err());
    }

    #[test]
    fn an_archive_is_a_zip_of_its_files_and_always_the_same() {
        let files =
            || vec![("a/b.json".to_owned(), "{}".to_owned()), ("a/c/d.dat".to_owned(), "1 2\n".to_owned())];
        let make = || Artifact::Archive(files()).make("large/ioh").unwrap().remove(0);
        let made = make();
        assert_eq!((made.file.as_str(), made.bytes == make().bytes), ("large/ioh.zip", true));
        let mut zip = zip::ZipArchive::new(std::io::Cursor::new(made.bytes)).unwrap();
        let text = std::io::read_to_string(zip.by_name("a/c/d.dat").unwrap()).unwrap();
        assert_eq!((zip.len(), text.as_str()), (2, "1 2\n"));
    }

    #[test]
    fn a_film_is_a_picture_for_each_frame_and_one_bad_frame_fails_it() {
        let frame = |value: f32| Photograph::new(20, 10, vec![[value; 3]; 200]).unwrap();
        let film = |last| {
            Artifact::Film(vec![frame(0.2), frame(last)], Exposure { stops: 0.0 }, ToneCurve::Linear)
                .make("f")
        };
        let files: Vec<String> = film(0.3).unwrap().into_iter().map(|made| made.file).collect();
        assert_eq!(files, ["large/f/frame-00000.png", "large/f/frame-00001.png"]);
        assert!(film(9.0).is_err() && film(f32::INFINITY).is_err());
    }
}
