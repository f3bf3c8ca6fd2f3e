//! The names of a family: what `grid`, `cases`, `let` and the linkage's defaults give them.

use super::{chart, grid};
use coupler_curves::expression::{Bound, Caption, Expression, Kind};
use coupler_curves::family::{Axis, Case, Family, MAX_CELLS, Space, derivation};
use coupler_curves::notation::{self, Fields, Reader, Value};
use coupler_curves::problem::{Problem, Span, nearest};
use coupler_curves::template::Template;

/// The names of a family and where their values come from.
pub(super) struct Names {
    pub all: Vec<String>,
    pub space: Space,
    pub derived: Vec<(usize, Bound)>,
    pub filter: Option<Bound>,
    pub sort: Option<Bound>,
    pub captions: [Option<Caption>; 2],
    /// Where each name is given a value.
    pub spans: Vec<Option<Span>>,
}

pub(super) fn names<'t>(template: &Template, fields: &Fields<'_, 't>, reader: &mut Reader<'t>) -> Option<Names> {
    let lets = match fields.get("let") {
        None => Vec::new(),
        Some(value) => Fields::open(value, "`let`", reader)?.entries().collect(),
    };
    let given = given(fields, reader);
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
        read_expressions(fields, reader);
        return None;
    };
    let space = given.space(&mut slot_of);
    let let_slots: Vec<usize> = lets.iter().map(|(name, span, _)| slot_of(name, span)).collect();
    for (slot, name) in all.iter().enumerate() {
        if Family::is_column(name) {
            let problem = Problem::error(
                spans[slot].clone().unwrap_or(fields.span.clone()),
                format!("`{name}` is a column of its own"),
            );
            reader.note(problem.help("`coupler-atlas list measures` names those that are taken: use another name"));
        }
    }
    let scope: Vec<(&str, Kind)> = all.iter().map(|name| (name.as_str(), Kind::Number)).collect();
    let mut sources: Vec<(usize, Expression, Span)> = Vec::new();
    let mut read_all = true;
    for ((name, span, value), &slot) in lets.iter().zip(&let_slots) {
        notation::check_name(name, span.clone(), reader);
        if (0..space.count().min(MAX_CELLS)).any(|k| space.gives(k, slot)) {
            let problem = Problem::error(span.clone(), format!("`{name}` is given in the grid or a case, and derived"));
            reader.note(problem.help("keep one of the two"));
            read_all = false;
        }
        let expression = reader.expression(value).filter(|expression| {
            let bound = expression.bind(&scope, Kind::Number);
            reader.placed(value, bound).is_some()
        });
        read_all &= expression.is_some();
        sources.extend(expression.map(|expression| (slot, expression, span.clone())));
    }
    let always_given = |slot: usize| (0..space.count().min(MAX_CELLS)).all(|k| space.gives(k, slot));
    for (slot, parameter) in template.parameters.iter().enumerate() {
        if let (Some(default), false) = (&parameter.default, always_given(slot) || let_slots.contains(&slot)) {
            let span = fields.get("linkage").map_or(fields.span.clone(), Value::span);
            sources.push((slot, default.clone(), span));
        }
    }
    let filter = fields.get("where").and_then(|value| filter(value, &all, reader));
    read_all &= filter.is_some() == fields.get("where").is_some();
    let sort = fields.get("sort").filter(|value| !asks_a_word(value, reader));
    let sort = sort.and_then(|value| reader.bound(value, &Family::scope(&all)));
    read_all &= sort.is_some() == fields.get("sort").is_some();
    let line = |key: &str, own: &Option<Caption>, reader: &mut Reader<'t>| match fields.get(key) {
        None => own.clone(),
        Some(value) => reader.caption(value, &Family::scope(&all), &Family::words().collect::<Vec<_>>()),
    };
    let captions = [line("caption", &template.caption, reader), line("note", &template.note, reader)];
    let in_chart = chart::used_names(fields);
    let derived = in_order(sources, &all, &scope, reader)?;
    for (slot, name) in all.iter().enumerate().skip(template.parameters.len()) {
        let in_filter = filter.iter().chain(&sort).any(|bound| bound.slots().contains(&slot));
        let in_filter = in_filter || captions.iter().flatten().any(|caption| caption.uses(name));
        // Where an expression could not be read, it may have been the one that uses the name.
        let in_chart = in_chart.as_ref().is_none_or(|used| used.contains(name));
        if read_all && !in_filter && !in_chart && !derived.iter().any(|(_, bound)| bound.slots().contains(&slot)) {
            unused(name, spans[slot].clone().unwrap_or_default(), template, reader);
        }
    }
    read_all.then_some(())?;
    Some(Names { all, space, derived, filter, sort, captions, spans })
}

/// What can be said of `let` and `where` when the names they may use are not known: whether they can be read.
pub(super) fn read_expressions<'t>(fields: &Fields<'_, 't>, reader: &mut Reader<'t>) {
    if let Some(lets) = fields.get("let").and_then(|value| Fields::open(value, "`let`", reader)) {
        for (name, span, value) in lets.entries() {
            notation::check_name(name, span, reader);
            reader.expression(value);
        }
    }
    for value in ["where", "sort"].into_iter().filter_map(|key| fields.get(key)) {
        reader.expression(value);
    }
}

fn unused(name: &str, span: Span, template: &Template, reader: &mut Reader) {
    let parameters: Vec<&str> = template.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let message = format!("`{name}` is no parameter of `{}`, and nothing uses it", template.id);
    let help = match nearest(name, parameters.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("its parameters are {}", parameters.join(", ")),
    };
    reader.note(Problem::error(span, message).help(help));
}

/// Whether a condition or an order rests on a measure that is a word, which is said.
fn asks_a_word<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> bool {
    let Some(expression) = value.get_ref().as_str().and_then(|text| Expression::parse(text).ok()) else { return false };
    let word = Family::words().find(|word| expression.names().iter().any(|name| name == word));
    if let Some(word) = word {
        let problem = Problem::error(value.span(), format!("`{word}` is a word, and cannot be reckoned with"));
        reader.note(
            problem
                .help("ask `is_crank_rocker` and its like of the class; numbers of the rest, as `symmetry_residual`"),
        );
    }
    word.is_some()
}

fn filter<'t>(value: &Value<'t>, names: &[String], reader: &mut Reader<'t>) -> Option<Bound> {
    if !value.get_ref().is_str() {
        let problem = Problem::error(value.span(), "`where` is a condition in quotes");
        reader.note(problem.help("write where = \"a < 5 and is_crank_rocker\""));
        return None;
    }
    if asks_a_word(value, reader) {
        return None;
    }
    let expression = reader.expression(value)?;
    let bound = expression.bind(&Family::scope(names), Kind::Truth);
    reader.placed(value, bound)
}

/// The most cells that `limit` may allow.
pub(super) const MAX_LIMIT: usize = 1_000_000_000;

/// What `grid` or `cases` gives, by name.
pub(super) enum Given {
    Grid(Vec<(String, Span, Vec<f64>)>),
    Cases(Vec<Vec<(String, Span, f64)>>),
}

impl Given {
    fn space(self, slot_of: &mut impl FnMut(&str, &Span) -> usize) -> Space {
        match self {
            Given::Grid(axes) => {
                let axis = |(name, span, values): (String, Span, _)| Axis { slot: slot_of(&name, &span), values };
                Space::Grid(axes.into_iter().map(axis).collect())
            }
            Given::Cases(cases) => {
                let mut case = |case: Vec<(String, Span, f64)>| -> Case {
                    case.into_iter().map(|(name, span, value)| (slot_of(&name, &span), value)).collect()
                };
                Space::Cases(cases.into_iter().map(&mut case).collect())
            }
        }
    }
}

pub(super) fn given<'t>(fields: &Fields<'_, 't>, reader: &mut Reader<'t>) -> Option<Given> {
    let limit = match fields.get("limit") {
        None => MAX_CELLS,
        Some(value) => reader.count(value, 1, MAX_LIMIT)?,
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
            reader.note(problem.help("write grid = { p = [2, 3, 4] } or cases = [{ p = 2 }, { p = 3 }]"));
            None
        }
    }
}

fn read_grid<'t>(value: &Value<'t>, limit: usize, reader: &mut Reader<'t>) -> Option<Given> {
    let table = Fields::open(value, "`grid`", reader)?;
    if table.keys().is_empty() {
        reader
            .note(Problem::error(value.span(), "the grid is empty").help("name a parameter, as in { p = [2, 3, 4] }"));
        return None;
    }
    let mut axes = Vec::new();
    let mut all_read = true;
    for (name, span, value) in table.entries() {
        notation::check_name(name, span.clone(), reader);
        match grid::values(name, value, reader) {
            Some(values) => axes.push((name.to_owned(), span, values)),
            None => all_read = false,
        }
    }
    // Counted before anything is written out.
    let cells: f64 = axes.iter().map(|(.., values)| values.count()).product();
    if cells > limit as f64 {
        let problem = Problem::error(value.span(), format!("the grid has {cells:.0} cells, and {limit} is the limit"));
        reader.note(problem.help("take fewer values, or allow more with `limit = N` in the family"));
        return None;
    }
    all_read
        .then(|| Given::Grid(axes.into_iter().map(|(name, span, values)| (name, span, values.write_out())).collect()))
}

fn read_cases<'t>(value: &Value<'t>, limit: usize, reader: &mut Reader<'t>) -> Option<Given> {
    let list = reader.list(value)?;
    if list.is_empty() {
        reader.note(Problem::error(value.span(), "there are no cases").help("give at least one, as in [{ p = 2 }]"));
        return None;
    }
    if list.len() > limit {
        let problem = Problem::error(value.span(), format!("there are {} cases, and {limit} is the limit", list.len()));
        reader.note(problem.help("take fewer, or allow more with `limit = N` in the family"));
        return None;
    }
    let mut cases = Vec::new();
    let mut all_read = true;
    for item in list {
        let Some(table) = Fields::open(item, "a case", reader) else {
            all_read = false;
            continue;
        };
        let mut case = Vec::new();
        for (name, span, value) in table.entries() {
            notation::check_name(name, span.clone(), reader);
            let value = reader.constant(value);
            all_read &= value.is_some();
            case.extend(value.map(|value| (name.to_owned(), span, value)));
        }
        cases.push(case);
    }
    all_read.then_some(Given::Cases(cases))
}

/// The expressions in an order in which each comes after those it uses.
fn in_order(
    sources: Vec<(usize, Expression, Span)>,
    names: &[String],
    scope: &[(&str, Kind)],
    reader: &mut Reader,
) -> Option<Vec<(usize, Bound)>> {
    // Each was bound to these very names when it was read.
    let bind =
        |(slot, expression, _): &(usize, Expression, Span)| Some((*slot, expression.bind(scope, Kind::Number).ok()?));
    let bound = sources.iter().map(bind).collect::<Option<Vec<_>>>()?;
    match derivation(bound) {
        Ok(derived) => Some(derived),
        Err(cycle) => {
            let words: Vec<String> = cycle.iter().map(|&slot| format!("`{}`", names[slot])).collect();
            let span = sources.iter().find(|(slot, ..)| *slot == cycle[0]).map(|source| source.2.clone());
            let problem = Problem::error(span.unwrap_or_default(), format!("{} is derived from itself", words[0]));
            reader.note(problem.help(format!("the cycle is {}: give one of them a value", words.join(" -> "))));
            None
        }
    }
}
