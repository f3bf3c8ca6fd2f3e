//! Lists of names that are known.

use coupler_curves::linkage_format::{TomlParser, TomlValue};
use coupler_curves::problem::{Problem, suggestion};

/// Reads a list of names, each given once, as their indices in `known`, or in the list itself if it is not known which there are; `what`
/// is what messages call them.
pub(crate) fn name_indices<'t>(
    value: &TomlValue<'t>,
    what: &str,
    known: Option<&[&str]>,
    parser: &mut TomlParser<'t>,
) -> Option<Vec<usize>> {
    let mut indices: Vec<usize> = Vec::new();
    let mut all_read = true;
    let list = parser.list(value)?;
    let given: Vec<&str> = list.iter().map(|item| item.get_ref().as_str().unwrap_or_default()).collect();
    let known = known.unwrap_or(&given);
    for item in list {
        let Some(name) = parser.text(item) else {
            all_read = false;
            continue;
        };
        let problem = match known.iter().position(|known| *known == name) {
            Some(place) if !indices.contains(&place) => {
                indices.push(place);
                continue;
            }
            Some(_) => {
                Problem::error(item.span(), format!("the {what} `{name}` is named twice")).with_help("name it once")
            }
            None => Problem::error(item.span(), format!("there is no {what} `{}`", name.escape_debug()))
                .with_help(suggestion(&name, known)),
        };
        parser.report(problem);
        all_read = false;
    }
    all_read.then_some(indices)
}
