//! The files of a single curve that are text: drawings, tables, and manifest text.

use coupler_curves::exchange::SelectedCurve;

use crate::page::{self, PoseChoice};
use crate::plate;
use crate::render::{self, TextMode};

/// The format of a curve's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CurveFormat {
    /// A plate of the curve with its linkage.
    Svg,
    /// An animated plate of the curve with its linkage.
    MovingSvg,
    /// A drawing for CAD, as DXF of AutoCAD R12.
    Dxf,
    /// Its rows of `points.csv`.
    Csv,
    /// Linkage, parameters, circuits, points and measures.
    Json,
    /// Manifest text that reproduces the curve.
    Toml,
}

impl CurveFormat {
    /// Every format.
    pub const ALL: [CurveFormat; 6] = [
        CurveFormat::Svg,
        CurveFormat::MovingSvg,
        CurveFormat::Dxf,
        CurveFormat::Csv,
        CurveFormat::Json,
        CurveFormat::Toml,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            CurveFormat::Svg => "svg",
            CurveFormat::MovingSvg => "moving-svg",
            CurveFormat::Dxf => "dxf",
            CurveFormat::Csv => "csv",
            CurveFormat::Json => "json",
            CurveFormat::Toml => "toml",
        }
    }

    /// The end of its file names.
    pub fn file_suffix(self) -> &'static str {
        match self {
            CurveFormat::Svg => ".svg",
            CurveFormat::MovingSvg => "-moving.svg",
            CurveFormat::Dxf => ".dxf",
            CurveFormat::Csv => ".csv",
            CurveFormat::Json => ".json",
            CurveFormat::Toml => ".toml",
        }
    }

    /// The file name of a curve, such as `evans-12-1-1.dxf` or `evans-12-1-1-p-2.5.dxf`.
    pub fn file_name(self, curve: &SelectedCurve) -> String {
        format!("{}{}", curve.file_stem(), self.file_suffix())
    }
}

/// How a curve's file is written.
#[derive(Clone, Debug, PartialEq)]
pub struct FileOptions {
    /// The paper and the appearance of plates.
    pub page: page::Options,
    /// How text is written in SVG.
    pub text_mode: TextMode,
    /// How far a chord of a DXF polyline may be from its curve, relative to the longer side of the bounding box of its
    /// samples.
    pub chord_tolerance: f64,
}

impl FileOptions {
    /// The default of `chord_tolerance`.
    pub const DEFAULT_CHORD_TOLERANCE: f64 = 1e-4;
}

/// A curve in a format, in UTF-8; as manifest text, this curve alone.
pub fn bytes(curve: &SelectedCurve, format: CurveFormat, options: &FileOptions) -> Vec<u8> {
    let svg = |pose| render::svg(&plate::compose(curve, pose, &options.page), options.text_mode);
    match format {
        CurveFormat::Svg => svg(PoseChoice::Clearest),
        CurveFormat::MovingSvg => {
            svg(plate::moving_view(&curve.solved.linkage, curve.circuit(), curve.curve().circuit))
        }
        CurveFormat::Dxf => curve.to_dxf(options.chord_tolerance).into_bytes(),
        CurveFormat::Csv => curve.to_csv(),
        CurveFormat::Json => curve.to_json().into_bytes(),
        CurveFormat::Toml => curve.to_toml().into_bytes(),
    }
}
