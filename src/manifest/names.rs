//! The names of a family: what `grid`, `cases`, `let` and the linkage's defaults give them.

use super::{chart, grid};
use coupler_curves::expression::{Caption, CompiledExpression, Expression, Kind};
use coupler_curves::family::{Axis, Case, Family, MAX_CELLS, ParameterSpace, sort_by_dependency};
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::problem::{Problem, Span, nearest_word};
use coupler_curves::template::Template;

/// The names of a family and where their values come from.
pub(super) struct FamilyNames {
    pub all: Vec<String>,
    pub space: ParameterSpace,
    pub derived: Vec<(usize, CompiledExpression)>,
    pub filter: Option<CompiledExpression>,
    pub sort: Option<CompiledExpression>,
    pub captions: [Option<Caption>; 2],
    /// Where each name is given a value.
    pub spans: Vec<Option<Span>>,
}

pub(super) fn read_names<'t>(
    template: &Template,
    fields: &Fields<'_, 't>,
    reader: &mut TomlParser<'t>,
) -> Option<FamilyNames> {
    let lets = match fields.get("let") {
        None => Vec::new(),
        Some(value) => Fields::with_any_keys(value, "`let`", reader)?.entries().collect(),
    };
    let given = read_space(fields, reader);
    let mut all: Vec<String> = template.parameters.iter().map(|parameter| parameter.name.clone()).collect();
    let mut spans: Vec<Option<Span>> = vec![None; all.len()];
    let mut slot_of = |name: &str, span: &Span| match all.iter().position(|n| n == name) {
        Some(slot) => {
            spans[slot].get_or_insert(span.clone());
            slot
        }
        None => {
            all.push(name.to_owned());
            spans.push(Some(span.clone()));
            all.len() - 1
        }
    };
    let Some(given) = given else {
        check_expression_syntax(fields, reader);
        return None;
    };
    let space = given.into_space(&mut slot_of);
    let let_slots: Vec<usize> = lets.iter().map(|(name, span, _)| slot_of(name, span)).collect();
    for (slot, name) in all.iter().enumerate() {
        if Family::is_column_name(name) {
            let problem = Problem::error(
                spans[slot].clone().unwrap_or(fields.span.clone()),
                format!("`{name}` is a column of its own"),
            );
            reader.report(
                problem.with_help("`coupler-atlas list measures` names those that are taken: use another name"),
            );
        }
    }
    let scope: Vec<(&str, Kind)> = all.iter().map(|name| (name.as_str(), Kind::Number)).collect();
    let mut sources: Vec<(usize, Expression, Span)> = Vec::new();
    let mut read_all = true;
    for ((name, span, value), &slot) in lets.iter().zip(&let_slots) {
        linkage_format::check_identifier(name, span.clone(), reader);
        if (0..space.count().min(MAX_CELLS)).any(|k| space.assigns(k, slot)) {
            let problem = Problem::error(span.clone(), format!("`{name}` is given in the grid or a case, and derived"));
            reader.report(problem.with_help("keep one of the two"));
            read_all = false;
        }
        let expression = reader.expression(value).filter(|expression| {
            let bound = expression.compile(&scope, Kind::Number);
            reader.ok_or_report(value, bound).is_some()
        });
        read_all &= expression.is_some();
        sources.extend(expression.map(|expression| (slot, expression, span.clone())));
    }
    let always_given = |slot: usize| (0..space.count().min(MAX_CELLS)).all(|k| space.assigns(k, slot));
    for (slot, parameter) in template.parameters.iter().enumerate() {
        if let (Some(default), false) = (&parameter.default, always_given(slot) || let_slots.contains(&slot)) {
            let span = fields.get("linkage").map_or(fields.span.clone(), TomlValue::span);
            sources.push((slot, default.clone(), span));
        }
    }
    let filter = fields.get("where").and_then(|value| read_filter(value, &all, reader));
    read_all &= filter.is_some() == fields.get("where").is_some();
    let sort = fields.get("sort").filter(|value| !uses_text_measure(value, reader));
    let sort = sort.and_then(|value| reader.numeric_expression(value, &Family::scope(&all)));
    read_all &= sort.is_some() == fields.get("sort").is_some();
    let line = |key: &str, own: &Option<Caption>, reader: &mut TomlParser<'t>| match fields.get(key) {
        None => own.clone(),
        Some(value) => reader.caption(value, &Family::scope(&all), &Family::word_measure_names().collect::<Vec<_>>()),
    };
    let captions = [line("caption", &template.caption, reader), line("note", &template.note, reader)];
    let in_chart = chart::used_names(fields);
    let derived = in_dependency_order(sources, &all, &scope, reader)?;
    for (slot, name) in all.iter().enumerate().skip(template.parameters.len()) {
        let in_filter = filter.iter().chain(&sort).any(|bound| bound.slots().contains(&slot));
        let in_filter = in_filter || captions.iter().flatten().any(|caption| caption.uses(name));
        // Where an expression could not be read, it may have been the one that uses the name.
        let in_chart = in_chart.as_ref().is_none_or(|used| used.contains(name));
        if read_all && !in_filter && !in_chart && !derived.iter().any(|(_, bound)| bound.slots().contains(&slot)) {
            report_unused_name(name, spans[slot].clone().unwrap_or_default(), template, reader);
        }
    }
    read_all.then_some(())?;
    Some(FamilyNames { all, space, derived, filter, sort, captions, spans })
}

/// What can be said of `let` and `where` when the names they may use are not known: whether they can be read.
pub(super) fn check_expression_syntax<'t>(fields: &Fields<'_, 't>, reader: &mut TomlParser<'t>) {
    if let Some(lets) = fields.get("let").and_then(|value| Fields::with_any_keys(value, "`let`", reader)) {
        for (name, span, value) in lets.entries() {
            linkage_format::check_identifier(name, span, reader);
            reader.expression(value);
        }
    }
    for value in ["where", "sort"].into_iter().filter_map(|key| fields.get(key)) {
        reader.expression(value);
    }
}

fn report_unused_name(name: &str, span: Span, template: &Template, reader: &mut TomlParser) {
    let parameters: Vec<&str> = template.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let message = format!("`{name}` is no parameter of `{}`, and nothing uses it", template.id);
    let help = match nearest_word(name, parameters.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("its parameters are {}", parameters.join(", ")),
    };
    reader.report(Problem::error(span, message).with_help(help));
}

/// Whether a condition or an order rests on a measure that is a word, which is said.
fn uses_text_measure<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> bool {
    let Some(expression) = value.get_ref().as_str().and_then(|text| Expression::parse(text).ok()) else { return false };
    let word = Family::word_measure_names().find(|word| expression.names().iter().any(|name| name == word));
    if let Some(word) = word {
        let problem = Problem::error(value.span(), format!("`{word}` is a word, and cannot be reckoned with"));
        reader.report(
            problem.with_help(
                "ask `is_crank_rocker` and its like of the class; numbers of the rest, as `symmetry_residual`",
            ),
        );
    }
    word.is_some()
}

fn read_filter<'t>(value: &TomlValue<'t>, names: &[String], reader: &mut TomlParser<'t>) -> Option<CompiledExpression> {
    if !value.get_ref().is_str() {
        let problem = Problem::error(value.span(), "`where` is a condition in quotes");
        reader.report(problem.with_help("write where = \"a < 5 and is_crank_rocker\""));
        return None;
    }
    if uses_text_measure(value, reader) {
        return None;
    }
    let expression = reader.expression(value)?;
    let bound = expression.compile(&Family::scope(names), Kind::Boolean);
    reader.ok_or_report(value, bound)
}

/// The most cells that `limit` may allow.
pub(super) const MAX_LIMIT: usize = 1_000_000_000;

/// What `grid` or `cases` gives, by name.
pub(super) enum NamedSpace {
    Grid(Vec<(String, Span, Vec<f64>)>),
    Cases(Vec<Vec<(String, Span, f64)>>),
}

impl NamedSpace {
    fn into_space(self, slot_of: &mut impl FnMut(&str, &Span) -> usize) -> ParameterSpace {
        match self {
            NamedSpace::Grid(axes) => {
                let axis = |(name, span, values): (String, Span, _)| Axis { slot: slot_of(&name, &span), values };
                ParameterSpace::Grid(axes.into_iter().map(axis).collect())
            }
            NamedSpace::Cases(cases) => {
                let mut case = |case: Vec<(String, Span, f64)>| -> Case {
                    case.into_iter().map(|(name, span, value)| (slot_of(&name, &span), value)).collect()
                };
                ParameterSpace::Cases(cases.into_iter().map(&mut case).collect())
            }
        }
    }
}

pub(super) fn read_space<'t>(fields: &Fields<'_, 't>, reader: &mut TomlParser<'t>) -> Option<NamedSpace> {
    let limit = match fields.get("limit") {
        None => MAX_CELLS,
        Some(value) => reader.integer(value, 1, MAX_LIMIT)?,
    };
    match (fields.get("grid"), fields.get("cases")) {
        (Some(value), None) => read_grid(value, limit, reader),
        (None, Some(value)) => read_cases(value, limit, reader),
        (grid, _) => {
            let message = if grid.is_some() {
                "a family has a grid or cases, not both"
            } else {
                "a [[family]] has no `grid` and no `cases`"
            };
            let problem = Problem::error(fields.span.clone(), message);
            reader.report(problem.with_help("write grid = { p = [2, 3, 4] } or cases = [{ p = 2 }, { p = 3 }]"));
            None
        }
    }
}

fn read_grid<'t>(value: &TomlValue<'t>, limit: usize, reader: &mut TomlParser<'t>) -> Option<NamedSpace> {
    let table = Fields::with_any_keys(value, "`grid`", reader)?;
    if table.keys().is_empty() {
        reader.report(
            Problem::error(value.span(), "the grid is empty").with_help("name a parameter, as in { p = [2, 3, 4] }"),
        );
        return None;
    }
    let mut axes = Vec::new();
    let mut all_read = true;
    for (name, span, value) in table.entries() {
        linkage_format::check_identifier(name, span.clone(), reader);
        match grid::read_values(name, value, reader) {
            Some(values) => axes.push((name.to_owned(), span, values)),
            None => all_read = false,
        }
    }
    // Counted before anything is written out.
    let cells: f64 = axes.iter().map(|(.., values)| values.count()).product();
    if cells > limit as f64 {
        let problem = Problem::error(value.span(), format!("the grid has {cells:.0} cells, and {limit} is the limit"));
        reader.report(problem.with_help("take fewer values, or allow more with `limit = N` in the family"));
        return None;
    }
    all_read.then(|| {
        NamedSpace::Grid(axes.into_iter().map(|(name, span, values)| (name, span, values.into_vec())).collect())
    })
}

fn read_cases<'t>(value: &TomlValue<'t>, limit: usize, reader: &mut TomlParser<'t>) -> Option<NamedSpace> {
    let list = reader.list(value)?;
    if list.is_empty() {
        reader.report(
            Problem::error(value.span(), "there are no cases").with_help("give at least one, as in [{ p = 2 }]"),
        );
        return None;
    }
    if list.len() > limit {
        let problem = Problem::error(value.span(), format!("there are {} cases, and {limit} is the limit", list.len()));
        reader.report(problem.with_help("take fewer, or allow more with `limit = N` in the family"));
        return None;
    }
    let mut cases = Vec::new();
    let mut all_read = true;
    for item in list {
        let Some(table) = Fields::with_any_keys(item, "a case", reader) else {
            all_read = false;
            continue;
        };
        let mut case = Vec::new();
        for (name, span, value) in table.entries() {
            linkage_format::check_identifier(name, span.clone(), reader);
            let value = reader.constant(value);
            all_read &= value.is_some();
            case.extend(value.map(|value| (name.to_owned(), span, value)));
        }
        cases.push(case);
    }
    all_read.then_some(NamedSpace::Cases(cases))
}

/// The expressions in an order in which each comes after those it uses.
fn in_dependency_order(
    sources: Vec<(usize, Expression, Span)>,
    names: &[String],
    scope: &[(&str, Kind)],
    reader: &mut TomlParser,
) -> Option<Vec<(usize, CompiledExpression)>> {
    // Each was bound to these very names when it was read.
    let bind = |(slot, expression, _): &(usize, Expression, Span)| {
        Some((*slot, expression.compile(scope, Kind::Number).ok()?))
    };
    let bound = sources.iter().map(bind).collect::<Option<Vec<_>>>()?;
    match sort_by_dependency(bound) {
        Ok(derived) => Some(derived),
        Err(cycle) => {
            let words: Vec<String> = cycle.iter().map(|&slot| format!("`{}`", names[slot])).collect();
            let span = sources.iter().find(|(slot, ..)| *slot == cycle[0]).map(|source| source.2.clone());
            let problem = Problem::error(span.unwrap_or_default(), format!("{} is derived from itself", words[0]));
            reader.report(problem.with_help(format!("the cycle is {}: give one of them a value", words.join(" -> "))));
            None
        }
    }
}
