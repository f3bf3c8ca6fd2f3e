//! Exports single curves: as a drawing, still or animated, as DXF for CAD, as a table, as JSON, and as manifest text.

use coupler_curves::exchange::SelectedCurve;
use coupler_drawing::page::{self, PoseChoice};
use coupler_drawing::plate;
use coupler_drawing::render::{self, PngError, TextMode};

/// The format of an exported curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// A plate of the curve with its linkage.
    Svg,
    /// An animated plate of the curve with its linkage.
    MovingSvg,
    /// The plate as a PNG image.
    Png,
    /// A drawing for CAD, as DXF of AutoCAD R12.
    Dxf,
    /// Its rows of `points.csv`.
    Csv,
    /// Linkage, parameters, circuits, points and measures.
    Json,
    /// Manifest text that reproduces the curve; the curves of an export are in one file.
    Toml,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 7] =
        [Format::Svg, Format::MovingSvg, Format::Png, Format::Dxf, Format::Csv, Format::Json, Format::Toml];

    /// Its name on the command line.
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

    /// The end of its file names.
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

/// Options for exporting curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The paper and the appearance of plates.
    pub page: page::Options,
    /// How text is written in SVG.
    pub text_mode: TextMode,
    /// The resolution of images, in pixels per inch.
    pub dpi: f64,
    /// How far a chord of a DXF polyline may be from its curve, relative to the longer side of the bounding box of its
    /// samples.
    pub chord_tolerance: f64,
}

impl Options {
    /// The default of `chord_tolerance`.
    pub const DEFAULT_CHORD_TOLERANCE: f64 = 1e-4;
}

/// Renders a curve in a format; as manifest text, this curve alone.
///
/// # Errors
/// The image would have too many pixels.
pub fn bytes(curve: &SelectedCurve, format: Format, options: &Options) -> Result<Vec<u8>, PngError> {
    let plate = || plate::compose(curve, PoseChoice::Clearest, &options.page);
    Ok(match format {
        Format::Svg => render::svg(&plate(), options.text_mode),
        Format::MovingSvg => {
            let pose = plate::moving_view(&curve.solved.linkage, curve.circuit(), curve.curve().circuit);
            render::svg(&plate::compose(curve, pose, &options.page), options.text_mode)
        }
        Format::Png => render::png(&plate(), options.dpi)?,
        Format::Dxf => curve.to_dxf(options.chord_tolerance).into_bytes(),
        Format::Csv => curve.to_csv(),
        Format::Json => curve.to_json().into_bytes(),
        Format::Toml => curve.to_toml().into_bytes(),
    })
}

/// The file name of a curve in a format, such as `evans-12-1-1.dxf` or `evans-12-1-1-p-2.5.dxf`.
pub fn file_name(curve: &SelectedCurve, format: Format) -> String {
    format!("{}{}", curve.file_stem(), format.file_suffix())
}
