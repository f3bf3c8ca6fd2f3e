//! Exports single curves: as files of text, see [`coupler_drawing::curve_file`], as images of their plates, as addresses of PMKS+,
//! and as manifests with their linkages in numbers.

mod complete;
mod drawing;
mod drawn_links;
mod pmks;

pub use complete::{CompleteFamily, ManifestForm, complete_families, complete_manifest};
pub use drawing::FormError;
pub use pmks::PmksError;

#[cfg(feature = "pdf")]
use crate::PROGRAM;
use coupler_curves::exchange::SelectedCurve;
use coupler_drawing::curve_file::{self, CurveFormat, FileOptions};
use coupler_drawing::page::PoseChoice;
use coupler_drawing::plate;
#[cfg(feature = "pdf")]
use coupler_drawing::render::pdf;
use coupler_drawing::render::{self, PngError};
#[cfg(feature = "pdf")]
use coupler_drawing::scene::PageNumber;
use coupler_drawing::scene::Scene;

/// The format of an exported curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// A file of text.
    Text(CurveFormat),
    /// The plate as a PNG image.
    Png,
    /// The plate as a page in PDF.
    Pdf,
    /// The address by which PMKS+ opens the linkage.
    Pmks,
}

impl Format {
    /// Manifest text; the curves of an export are in one file.
    pub const TOML: Format = Format::Text(CurveFormat::Toml);

    /// Every format.
    pub const ALL: [Format; 9] = [
        Format::Text(CurveFormat::Svg),
        Format::Text(CurveFormat::MovingSvg),
        Format::Png,
        Format::Pdf,
        Format::Text(CurveFormat::Dxf),
        Format::Text(CurveFormat::Csv),
        Format::Text(CurveFormat::Json),
        Format::TOML,
        Format::Pmks,
    ];

    /// Whether this build can write it.
    pub fn is_built_in(self) -> bool {
        self != Format::Pdf || cfg!(feature = "pdf")
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Format::Text(format) => format.name(),
            Format::Png => "png",
            Format::Pdf => "pdf",
            Format::Pmks => "pmks",
        }
    }

    /// The file name of a curve, such as `evans-12-1-1.dxf` or `evans-12-1-1-p-2.5.dxf`.
    pub fn file_name(self, curve: &SelectedCurve) -> String {
        match self {
            Format::Text(format) => format.file_name(curve),
            Format::Png => format!("{}.png", curve.file_stem()),
            Format::Pdf => format!("{}.pdf", curve.file_stem()),
            Format::Pmks => format!("{}.txt", curve.file_stem()),
        }
    }
}

/// The resolution of images where none is given, in pixels per inch.
pub const DEFAULT_DPI: u32 = 150;

/// Options for exporting curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// How files of text are written.
    pub file: FileOptions,
    /// The resolution of images, in pixels per inch.
    pub dpi: f64,
}

/// Why a curve cannot be exported.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The image would have too many pixels.
    #[error(transparent)]
    Png(#[from] PngError),
    /// The page cannot be written.
    #[error("{0}")]
    Pdf(String),
    /// PMKS+ does not have all that the linkage is made of.
    #[error(transparent)]
    Pmks(#[from] PmksError),
}

/// Renders a curve in a format; as manifest text, this curve alone.
///
/// # Errors
/// The image would have too many pixels, a page cannot be written, or PMKS+ cannot have the linkage.
pub fn bytes(curve: &SelectedCurve, format: Format, options: &Options) -> Result<Vec<u8>, Error> {
    let plate = || plate::compose(curve, PoseChoice::Clearest, &options.file.page);
    match format {
        Format::Text(format) => Ok(curve_file::bytes(curve, format, &options.file)),
        Format::Png => Ok(render::png(&plate(), options.dpi)?),
        Format::Pdf => pdf_page(&plate()).map_err(Error::Pdf),
        Format::Pmks => Ok(pmks::address(curve)?.into_bytes()),
    }
}

/// A page as a document.
#[cfg(feature = "pdf")]
fn pdf_page(scene: &Scene) -> Result<Vec<u8>, String> {
    let mut book = pdf::Book::new(&scene.title, PROGRAM);
    let added = book.add_page(scene, PageNumber::Arabic(1));
    added.and_then(|()| book.finish(&[])).map_err(|error| error.to_string())
}

#[cfg(not(feature = "pdf"))]
fn pdf_page(_: &Scene) -> Result<Vec<u8>, String> {
    Err("this build cannot write PDF: build the program with the feature `pdf`".to_owned())
}
