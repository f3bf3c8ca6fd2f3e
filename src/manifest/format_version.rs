//! The version of the language a manifest is written in.

use coupler_curves::linkage_format::{TomlParser, TomlValue};
use coupler_curves::problem::Problem;

/// The version of the language of manifests that this program reads.
pub const FORMAT_VERSION: usize = 1;

/// Whether a manifest is written in this language; if not, what is wrong is said.
///
/// Nothing else can then be said of it: what is no key in this format may be one in the other.
pub(super) fn is_supported<'t>(document: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> bool {
    let atlas = document.get_ref().as_table().and_then(|root| root.get("atlas")?.get_ref().as_table());
    let Some(value) = atlas.and_then(|atlas| atlas.get("format")) else { return true };
    let is_number = value.get_ref().is_integer() || value.get_ref().is_float();
    let number = reader.decimal_digits(value).filter(|_| is_number).and_then(|written| written.parse::<f64>().ok());
    let problem = match number {
        Some(number) if number == FORMAT_VERSION as f64 => return true,
        Some(number) if number > FORMAT_VERSION as f64 && number.fract() == 0.0 => {
            let version = env!("CARGO_PKG_VERSION");
            let message = format!(
                "the manifest has format {number}, and this is version {version}, which reads format {FORMAT_VERSION}"
            );
            Problem::error(value.span(), message).with_help(format!(
                "use a newer version; or write format = {FORMAT_VERSION} if the manifest has nothing newer in it"
            ))
        }
        _ => Problem::error(value.span(), "there is no such format")
            .with_help(format!("write format = {FORMAT_VERSION}, or leave it out, which means the same")),
    };
    reader.report(problem);
    false
}
