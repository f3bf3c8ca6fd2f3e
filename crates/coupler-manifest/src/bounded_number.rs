//! Numbers that must lie in a range.

use coupler_curves::linkage_format::{TomlParser, TomlValue};
use coupler_curves::problem::Problem;

/// Reads a number that must lie in a closed range; `what` is its unit, as messages name it.
pub(crate) fn read_within<'t>(
    value: &TomlValue<'t>,
    parser: &mut TomlParser<'t>,
    read: impl Fn(&TomlValue<'t>, &mut TomlParser<'t>) -> Option<f64>,
    [least, most]: [f64; 2],
    what: &str,
) -> Option<f64> {
    let number = read(value, parser)?;
    if (least..=most).contains(&number) {
        return Some(number);
    }
    let problem = Problem::error(value.span(), format!("{number} {what} is out of range"));
    parser.report(problem.with_help(format!("give {least} to {most} {what}")));
    None
}
