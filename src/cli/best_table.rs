//! The best curves of a table of `sweep`, for people.

use coupler_curves::expression::Expression;
use coupler_curves::family::MEASURES;

use super::aligned_table::AlignedTable;
use crate::format::format_significant;
use crate::shard::Gathered;

/// The significant digits of numbers.
const DIGITS: usize = 6;

/// A table of the best curves of a family: their names, the value by which they are the best, the parameters of their linkages, and the
/// measures in play, which are those of the expression, of `where`, `sort` and captions, and the named ones.
pub(super) fn best_table(gathered: &Gathered, measures: &[String]) -> String {
    let Some((plan, _)) = gathered.families.first() else { return String::new() };
    let family = &plan.families[0].family;
    let is_driven_by_length = family.template.is_driven_by_length();
    let expressions: Vec<Expression> = gathered.by.iter().filter_map(|by| Expression::parse(by).ok()).collect();
    let used = family.selection_measures() | family.caption_measures();
    let is_measure_shown = |name: &String| {
        let is_used = || {
            let mut all = MEASURES.iter().enumerate();
            all.any(|(k, measure)| used.contains(k) && measure.name_for(is_driven_by_length) == name)
        };
        expressions.iter().any(|expression| expression.names().contains(name)) || measures.contains(name) || is_used()
    };
    let is_parameter = |name: &String| family.template.parameters.iter().any(|parameter| parameter.name == *name);
    let is_shown = |name: &String| is_parameter(name) || is_measure_shown(name);
    let columns = gathered.columns.iter().enumerate().filter(|(_, name)| is_shown(name));
    let shown: Vec<(usize, &str)> = columns.map(|(k, name)| (k, name.as_str())).collect();
    let number = |value: f64| format_significant(value, DIGITS);
    let mut has_words = vec![false; shown.len()];
    let mut rows: Vec<Vec<String>> = Vec::new();
    for curve in &gathered.best {
        let mut row = vec![curve.name(&gathered.families), number(curve.key)];
        for ((k, _), has_words) in shown.iter().zip(&mut has_words) {
            let text = curve.fields.get(*k).unwrap_or_default();
            let value = text.parse().map(number);
            *has_words |= value.is_err() && !text.is_empty();
            row.push(value.unwrap_or_else(|_| text.to_owned()));
        }
        rows.push(row);
    }
    let own = shown.iter().zip(has_words).map(|((_, name), has_words)| (*name, has_words));
    let head: Vec<(&str, bool)> = [("curve", true), ("by", false)].into_iter().chain(own).collect();
    let table = AlignedTable::new(3, &head, rows.iter().map(Vec::as_slice));
    let mut out = table.line("", head.iter().map(|(name, _)| name));
    for (rank, row) in (1..).zip(&rows) {
        out += &table.line(&rank.to_string(), row);
    }
    out
}
