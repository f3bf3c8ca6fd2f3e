//! `export --parts`: what is asked for, checked, and its files.

use clap::Args;
use coupler_curves::exchange::{PartFormat, SelectedCurve};
use coupler_curves::parts::{GivenSizes, PartsError};
use coupler_drawing::curve_file::CurveFormat;

use super::super::Failure;
use super::selection::CurveSelection;
use crate::export::Format;

/// What `--parts` is asked for.
#[derive(Debug, Args)]
pub(super) struct PartArguments {
    /// Export the parts of the linkage for a workshop, as dxf (AutoCAD 2000) or svg at true size: a drawing of the assembly, and one
    /// of each part with its holes, slots and outline.
    #[arg(long)]
    parts: bool,
    /// With --parts, the diameter of holes and the width of slots, in the unit of the linkage [default: half the width of the links, or less
    /// where two holes are near each other or a gear is small].
    #[arg(long, value_name = "X", requires = "parts", value_parser = |text: &str| parse_size(text, "--hole 6"))]
    hole: Option<f64>,
    /// With --parts, the width of links, in the unit of the linkage [default: a tenth of the longest distance of two holes of a link, to one digit].
    #[arg(long, value_name = "X", requires = "parts", value_parser = |text: &str| parse_size(text, "--width 20"))]
    width: Option<f64>,
}

fn parse_size(text: &str, example: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0);
    value.ok_or_else(|| format!("expected a length greater than 0 in the unit of the linkage, as in {example}"))
}

impl PartArguments {
    /// The sizes that are given; `None` if no parts are asked for.
    ///
    /// # Errors
    /// A format that parts are not drawn in.
    pub fn sizes(&self, formats: &[Format]) -> Result<Option<GivenSizes>, Failure> {
        if !self.parts {
            return Ok(None);
        }
        match formats.iter().find(|format| part_format(**format).is_none()) {
            Some(format) => {
                let message = format!("parts are drawn as dxf or svg, not as {}: give --format dxf", format.name());
                Err(Failure::input(message))
            }
            None => Ok(Some(GivenSizes { hole: self.hole, width: self.width })),
        }
    }
}

/// The format of the files of parts.
fn part_format(format: Format) -> Option<PartFormat> {
    match format {
        Format::Text(CurveFormat::Dxf) => Some(PartFormat::Dxf),
        Format::Text(CurveFormat::Svg) => Some(PartFormat::Svg),
        _ => None,
    }
}

/// The number of files of the parts of some selections in each format.
///
/// # Errors
/// Sizes with which the parts of a linkage cannot be made, or a linkage that has none.
pub(super) fn count_files(selections: &[CurveSelection], sizes: GivenSizes) -> Result<usize, Failure> {
    let mut count = 0;
    for selection in selections {
        let count_parts = |solved| {
            let selected =
                |curve: &SelectedCurve| Ok(curve.parts(sizes).map_err(|error| failure(curve, &error))?.parts.len() + 1);
            selection.selected_curves(solved).iter().map(selected).sum::<Result<usize, Failure>>()
        };
        selection.solve_cells(false, count_parts, |files| {
            count += files?;
            Ok::<(), Failure>(())
        })?;
    }
    Ok(count)
}

/// The files of the parts of a curve's linkage, in a format that parts are drawn in: their names and bytes.
///
/// # Errors
/// Sizes with which the parts cannot be made, or a linkage that has none.
pub(super) fn files(
    curve: &SelectedCurve,
    format: Format,
    (sizes, chord): (GivenSizes, f64),
) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let parts = curve.parts(sizes).map_err(|error| failure(curve, &error))?;
    let files = part_format(format).map(|format| curve.part_files(&parts, format, chord)).unwrap_or_default();
    let stem = curve.file_stem();
    Ok(files.into_iter().map(|(name, text)| (format!("{stem}-{name}"), text.into_bytes())).collect())
}

/// Why there are no parts, with the remedy.
fn failure(curve: &SelectedCurve, error: &PartsError) -> Failure {
    let remedy = match error {
        PartsError::HoleTooWide { .. } => "give a smaller --hole, or a larger --width",
        PartsError::HolesOverlap { .. } | PartsError::GearTooSmall { .. } => "give a smaller --hole",
        PartsError::NoGuide { .. } => "export it without --parts",
    };
    Failure::input(format!("{}: {error}: {remedy}", curve.name()))
}
