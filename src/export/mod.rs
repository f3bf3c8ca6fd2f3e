//! Taking a curve away: as a drawing, still or moving, for CAD, as a table, as JSON, and as a piece of a manifest.

use coupler_curves::exchange::SelectedCurve;
use coupler_drawing::page::{self, PoseChoice};
use coupler_drawing::plate;
use coupler_drawing::render::{self, PngError, TextMode};

/// What one curve is taken away as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// A plate of the curve with its linkage.
    Svg,
    /// The same, moving by itself.
    MovingSvg,
    /// The plate as an image.
    Png,
    /// A drawing for CAD, in the language of AutoCAD R12.
    Dxf,
    /// Its rows of `points.csv`.
    Csv,
    /// Linkage, parameters, circuits, points and measures.
    Json,
    /// A piece of a manifest, of all curves together.
    Toml,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 7] =
        [Format::Svg, Format::MovingSvg, Format::Png, Format::Dxf, Format::Csv, Format::Json, Format::Toml];

    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::MovingSvg => "moving-svg",
            Format::Png => "png",
            Format::Dxf => "dxf",
            Format::Csv => "csv",
            Format::Json => "json",
            Format::Toml => "toml",
        }
    }

    /// How the names of its files end.
    pub fn file_suffix(self) -> &'static str {
        if self == Format::MovingSvg { "-moving.svg" } else { self.extension() }
    }

    fn extension(self) -> &'static str {
        match self {
            Format::Svg | Format::MovingSvg => ".svg",
            Format::Png => ".png",
            Format::Dxf => ".dxf",
            Format::Csv => ".csv",
            Format::Json => ".json",
            Format::Toml => ".toml",
        }
    }
}

/// How curves are taken away.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What plates look like; their paper too.
    pub page: page::Options,
    /// How text stands in SVG.
    pub text_mode: TextMode,
    /// The resolution of images, in pixels to the inch.
    pub dpi: f64,
    /// How far a chord of a DXF polyline may be from its curve, in parts of the curve's extent: the longer side of the box
    /// round its samples.
    pub chord_tolerance: f64,
}

impl Options {
    /// The chord's distance where nothing else is asked for.
    pub const DEFAULT_CHORD_TOLERANCE: f64 = 1e-4;

    /// The paper of plates.
    pub const PLATE_PAPER: page::Paper = plate::PAPER;
}

/// The bytes of a curve in a format, a piece of a manifest of it alone among them.
///
/// # Errors
/// An image of too many pixels.
pub fn bytes(chosen: &SelectedCurve, format: Format, options: &Options) -> Result<Vec<u8>, PngError> {
    let still = || plate::compose(chosen, PoseChoice::Clearest, &options.page);
    Ok(match format {
        Format::Svg => render::svg(&still(), options.text_mode),
        Format::MovingSvg => {
            let view = plate::moving_view(&chosen.solved.linkage, chosen.circuit(), chosen.curve().circuit);
            render::svg(&plate::compose(chosen, view, &options.page), options.text_mode)
        }
        Format::Png => render::png(&still(), options.dpi)?,
        Format::Dxf => chosen.to_dxf(options.chord_tolerance).into_bytes(),
        Format::Csv => chosen.to_csv(),
        Format::Json => chosen.to_json().into_bytes(),
        Format::Toml => chosen.to_toml().into_bytes(),
    })
}

/// The name of a curve's file in a format: `evans-12-1-1.dxf`, `evans-12-1-1-p-2.5.dxf`.
pub fn file_name(chosen: &SelectedCurve, format: Format) -> String {
    format!("{}{}", chosen.file_stem(), format.file_suffix())
}
