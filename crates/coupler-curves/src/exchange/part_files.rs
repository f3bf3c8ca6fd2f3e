//! The files of the parts of a linkage: one of the assembly, and one of each part.

use super::SelectedCurve;
use super::part_drawing::PartDrawing;
use super::{part_dxf, part_svg};
use crate::parts::{GivenSizes, Parts, PartsError};

/// The format of the files of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartFormat {
    /// DXF of AutoCAD 2000.
    Dxf,
    /// SVG, at true size where the unit of lengths is known.
    Svg,
}

impl SelectedCurve<'_> {
    /// The parts of the linkage, with slots as long as the curve's circuit needs, and a hole at the traced joint.
    ///
    /// # Errors
    /// Sizes with which they cannot be made, or a slider on the line of no part.
    #[doc(hidden)]
    pub fn parts(&self, given: GivenSizes) -> Result<Parts, PartsError> {
        Parts::new((&self.solved.linkage, self.circuit()), &[self.curve().joint], given)
    }

    /// The files of the linkage's parts, each with the end of its name: `assembly.dxf` of all in the drawn pose with the curve, `OA.dxf` of a link.
    /// `chord` is that of [`SelectedCurve::to_dxf`].
    #[doc(hidden)]
    pub fn part_files(&self, parts: &Parts, format: PartFormat, chord: f64) -> Vec<(String, String)> {
        let assembly = (ASSEMBLY.to_owned(), PartDrawing::of_assembly(self, parts, chord));
        let of_part = |(k, part)| (part_file_name(parts, k), PartDrawing::of_part(part, parts.sizes));
        let drawings = std::iter::once(assembly).chain(parts.parts.iter().enumerate().map(of_part));
        let document = |(name, drawing): (String, PartDrawing)| match format {
            PartFormat::Dxf => (format!("{name}.dxf"), part_dxf::document(&drawing, self.family.unit)),
            PartFormat::Svg => (format!("{name}.svg"), part_svg::document(&drawing, self.family.unit)),
        };
        drawings.map(document).collect()
    }
}

/// The file name of the drawing of all parts.
const ASSEMBLY: &str = "assembly";

/// The file name of a part, without what a file name cannot have, and with its number where another would have the same name.
fn part_file_name(parts: &Parts, index: usize) -> String {
    let allowed = |c: char| if c.is_alphanumeric() || c == '_' { c } else { '-' };
    let plain = |name: &str| name.chars().map(allowed).collect::<String>();
    let own = plain(&parts.parts[index].name);
    let is_own = |name: &str| name.to_lowercase() == own.to_lowercase();
    let is_taken = is_own(ASSEMBLY) || parts.parts[..index].iter().any(|part| is_own(&plain(&part.name)));
    if is_taken { format!("{own}-part-{}", index + 1) } else { own }
}
