//! Reports names of a family that nothing uses.

use std::collections::BTreeSet;

use crate::parameter_sets::TableColumns;
use coupler_curves::expression::Caption;
use coupler_curves::linkage_format::{Fields, TomlParser, TomlValue, identifier_error, one_or_more};
use coupler_curves::problem::{Problem, Span, list_words, nearest_word};
use coupler_curves::template::Template;

/// Reports each of the `names` with a value, in a table or elsewhere, of which the parameters of the linkage are the first, that is no parameter
/// and that no expression of the family uses. `is_known` says of other words whether expressions may use them.
///
/// Expressions with errors count as well: a name is not reported if one uses a word that may be the name misspelt.
///
/// Returns the parameters that the reported names may be, misspelt.
pub(crate) fn report<'n>(
    template: &Template,
    (names, table): (impl Iterator<Item = (&'n str, Span)>, Option<&TableColumns>),
    is_known: impl Fn(&str) -> bool,
    fields: &Fields,
    parser: &mut TomlParser,
) -> Vec<String> {
    /// The most words that names are compared with.
    const MAX_UNKNOWN: usize = 50;
    let used = used_words(fields);
    let unknown: Vec<&str> = used.iter().map(String::as_str).filter(|word| !is_known(word)).take(MAX_UNKNOWN).collect();
    let parameters: Vec<&str> = template.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let mut meant = Vec::new();
    for (name, span) in names.skip(parameters.len()) {
        let may_be_misspelt = || unknown.iter().any(|word| nearest_word(word, [name]).is_some());
        // That no expression can use it has been reported.
        if used.contains(name) || may_be_misspelt() || identifier_error(name).is_some() {
            continue;
        }
        let place = table.map_or(String::new(), |table| table.place_of(name));
        let message = format!("{place}`{name}` is not a parameter of `{}`, and no expression uses it", template.id);
        let near = nearest_word(name, parameters.iter().copied());
        meant.extend(near.map(str::to_owned));
        let help = match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("its parameters are {}", list_words(&parameters)),
        };
        parser.report(Problem::error(span, message).with_help(help));
    }
    meant
}

/// The words in all expressions of a family: those of `let`, `where`, `sort`, `chart`, `caption` and `note`.
fn used_words(fields: &Fields) -> BTreeSet<String> {
    let mut used = BTreeSet::new();
    let mut add = |text: &str| used.extend(words(text).map(str::to_owned));
    let text = |value: &TomlValue| value.get_ref().as_str().unwrap_or_default().to_owned();
    let lets = fields.get("let").and_then(|value| value.get_ref().as_table());
    lets.into_iter().flat_map(|lets| lets.iter()).for_each(|(_, value)| add(&text(value)));
    ["where", "sort"].into_iter().filter_map(|key| fields.get(key)).for_each(|value| add(&text(value)));
    let chart = fields.get("chart").and_then(|value| value.get_ref().as_table());
    for value in ["x", "y", "by"].into_iter().filter_map(|key| chart?.get(key)) {
        one_or_more(value).iter().for_each(|item| add(&text(item)));
    }
    for value in ["caption", "note"].into_iter().filter_map(|key| fields.get(key)) {
        match Caption::parse(&text(value)) {
            Ok(caption) => {
                caption.expressions().flat_map(|(expression, _)| expression.names()).for_each(|name| add(name))
            }
            Err(_) => add(&text(value)),
        }
    }
    used
}

/// The words of an expression, names of functions among them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    text.split(move |c| !is_of_word(c)).filter(|word| word.starts_with(|c: char| c.is_alphabetic() || c == '_'))
}
