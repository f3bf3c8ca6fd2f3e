//! The version of the manifest format.

use coupler_curves::linkage_format::{TomlParser, TomlValue};
use coupler_curves::problem::Problem;

/// The version of the manifest format that this program reads.
pub const FORMAT_VERSION: usize = 1;

/// Whether a manifest is in this format; reports a problem if it is not.
///
/// Nothing else can be checked then: what is an unknown key in this format may be a key in the other.
pub(crate) fn is_supported<'t>(document: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> bool {
    let atlas = document.get_ref().as_table().and_then(|root| root.get("atlas")?.get_ref().as_table());
    let Some(value) = atlas.and_then(|atlas| atlas.get("format")) else { return true };
    let is_number = value.get_ref().is_integer() || value.get_ref().is_float();
    let number = parser.decimal_digits(value).filter(|_| is_number).and_then(|written| written.parse::<f64>().ok());
    let problem = match number {
        Some(number) if number == FORMAT_VERSION as f64 => return true,
        Some(number) if number > FORMAT_VERSION as f64 && number.fract() == 0.0 => {
            let version = env!("CARGO_PKG_VERSION");
            let message = format!(
                "the manifest has format {number}, but this is version {version}, which reads format {FORMAT_VERSION}"
            );
            Problem::error(value.span(), message).with_help(format!(
                "use a newer version; or write format = {FORMAT_VERSION} if the manifest uses nothing newer"
            ))
        }
        _ => Problem::error(value.span(), "unknown format version")
            .with_help(format!("write format = {FORMAT_VERSION}, or leave it out, which means the same")),
    };
    parser.report(problem);
    false
}
