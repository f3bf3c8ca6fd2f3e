//! A `[[family]]` table.

use std::sync::Arc;

use super::{PlannedFamily, Templates, grid, settings};
use crate::expression::{Bound, Dimension, Expression, Kind};
use crate::family::{Axis, Case, CellError, Family, MAX_CELLS, MAX_SAMPLES, Sampling, Space};
use crate::notation::{self, Fields, Reader, Value};
use crate::page::{Layout, Paper};
use crate::problem::{Problem, Span, nearest};
use crate::render::Format;
use crate::template::Template;

const KEYS: [&str; 15] = [
    "id",
    "linkage",
    "title",
    "source",
    "layout",
    "panels",
    "sampling",
    "grid",
    "cases",
    "let",
    "where",
    "formats",
    "limit",
    "circuits",
    "continuation",
];

/// The id of a table and its place, if it has one.
pub(super) fn id(value: &Value) -> Option<(String, Span)> {
    let id = value.get_ref().as_table()?.get("id")?;
    Some((id.get_ref().as_str()?.to_owned(), id.span()))
}

pub(super) fn read<'t>(
    value: &Value<'t>,
    templates: &Templates,
    (formats, paper): (&[Format], Option<Paper>),
    reader: &mut Reader<'t>,
) -> Option<PlannedFamily> {
    let fields = Fields::of(value, "a [[family]]", &KEYS, reader)?;
    let id = fields.required("id", "id = \"evans\"", reader).and_then(|value| notation::slug(value, reader));
    let template =
        fields.required("linkage", "linkage = \"evans\"", reader).and_then(|value| templates.find(value, reader));
    let template = template.map(|template| overridden(template, &fields, reader));
    let text = |key: &str, reader: &mut Reader<'t>| fields.get(key).and_then(|value| reader.text(value));
    let (title, source) = (text("title", reader), text("source", reader));
    let formats = match fields.get("formats") {
        None => Some(formats.to_vec()),
        Some(value) => settings::formats(value, reader),
    };
    let sampling = fields
        .required("sampling", "sampling = { step = \"2 deg\" }", reader)
        .and_then(|value| sampling(value, template.as_deref(), reader));
    let layout = layout(&fields, paper, reader);
    let names = match &template {
        Some(template) => names(template, &fields, reader),
        None => {
            read_without_linkage(&fields, reader);
            None
        }
    };
    let (id, template, names, sampling) = (id?, template?, names?, sampling?);
    let family = Family {
        title: title.unwrap_or_else(|| id.clone()),
        id,
        template,
        names: names.all,
        space: names.space,
        derived: names.derived,
        sampling,
        filter: names.filter,
    };
    check_cells(&family, &fields, &names.spans, reader);
    let legend = [&family.template.source, &family.template.legend].map(String::as_str);
    let source =
        source.unwrap_or_else(|| legend.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · "));
    let filter_span = fields.get("where").map(Value::span);
    Some(PlannedFamily { family, layout: layout?, formats: formats?, source, filter_span })
}

/// What can be said of a family whose linkage is not known: whether its values and expressions can be read.
fn read_without_linkage<'t>(fields: &Fields<'_, 't>, reader: &mut Reader<'t>) {
    given(fields, reader);
    if let Some(lets) = fields.get("let").and_then(|value| Fields::open(value, "`let`", reader)) {
        for (name, span, value) in lets.entries() {
            notation::check_name(name, span, reader);
            reader.expression(value);
        }
    }
    if let Some(value) = fields.get("where") {
        reader.expression(value);
    }
}

/// The template with what the family says otherwise.
fn overridden<'t>(template: Arc<Template>, fields: &Fields<'_, 't>, reader: &mut Reader<'t>) -> Arc<Template> {
    let circuits = fields.get("circuits").and_then(|value| reader.word(value, &notation::CIRCUITS));
    let continuation = fields.get("continuation").and_then(|value| reader.word(value, &notation::CONTINUATIONS));
    if circuits.is_none() && continuation.is_none() {
        return template;
    }
    let mut own = Template::clone(&template);
    own.circuits = circuits.unwrap_or(own.circuits);
    own.continuation = continuation.unwrap_or(own.continuation);
    Arc::new(own)
}

fn sampling<'t>(value: &Value<'t>, template: Option<&Template>, reader: &mut Reader<'t>) -> Option<Sampling> {
    let fields = Fields::of(value, "`sampling`", &["step", "samples"], reader)?;
    match (fields.get("step"), fields.get("samples")) {
        (Some(value), None) if template.is_some_and(Template::is_driven_by_length) => {
            let step = reader.constant(value)?;
            if step > 0.0 {
                return Some(Sampling::Step(step));
            }
            let problem = Problem::error(value.span(), format!("a step of {step} never ends"));
            reader.note(problem.help("give a length of more than 0, as in step = 0.05"));
            None
        }
        (Some(value), None) => {
            let step = reader.measure(value, Dimension::Angle)?;
            let least = 360.0 / MAX_SAMPLES as f64;
            let problem = match step {
                0.0 => Problem::error(value.span(), "a step of 0 never ends"),
                step if step < least || step > 360.0 => {
                    Problem::error(value.span(), format!("a step of {step} deg is out of range"))
                }
                _ => return Some(Sampling::Step(step)),
            };
            reader.note(problem.help(format!("give {least} to 360 deg, as in step = \"2 deg\"")));
            None
        }
        (None, Some(value)) => reader.count(value, 2, MAX_SAMPLES).map(Sampling::Samples),
        (step, _) => {
            let message = if step.is_some() {
                "sampling is by step or by samples, not both"
            } else {
                "sampling needs a step or a number of samples"
            };
            reader.note(Problem::error(value.span(), message).help("write { step = \"2 deg\" } or { samples = 180 }"));
            None
        }
    }
}

fn layout<'t>(fields: &Fields<'_, 't>, paper: Option<Paper>, reader: &mut Reader<'t>) -> Option<Layout> {
    if let Some(value) = fields.get("layout") {
        let words = Layout::ALL.map(|(name, _)| (name, ()));
        reader.word(value, &words)?;
    }
    let [most_columns, most_rows] = paper.map_or([1, 1], Layout::most_panels);
    let Some(value) = fields.get("panels") else {
        return Some(Layout::Panels { columns: most_columns.min(5), rows: most_rows.min(3) });
    };
    let [columns, rows] = reader.pair(value)?;
    let most = paper.map_or([100, 100], Layout::most_panels);
    let (columns, rows) = (reader.count(columns, 1, most[0]), reader.count(rows, 1, most[1]));
    Some(Layout::Panels { columns: columns?, rows: rows? })
}

/// The names of a family and where their values come from.
struct Names {
    all: Vec<String>,
    space: Space,
    derived: Vec<(usize, Bound)>,
    filter: Option<Bound>,
    /// Where each name is given a value.
    spans: Vec<Option<Span>>,
}

fn names<'t>(template: &Template, fields: &Fields<'_, 't>, reader: &mut Reader<'t>) -> Option<Names> {
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
        for (_, _, value) in &lets {
            reader.expression(value);
        }
        if let Some(value) = fields.get("where") {
            reader.expression(value);
        }
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
    let derived = in_order(sources, &all, &scope, reader)?;
    for (slot, name) in all.iter().enumerate().skip(template.parameters.len()) {
        let in_filter = filter.as_ref().is_some_and(|filter| filter.slots().contains(&slot));
        // Where an expression could not be read, it may have been the one that uses the name.
        if read_all && !in_filter && !derived.iter().any(|(_, bound)| bound.slots().contains(&slot)) {
            unused(name, spans[slot].clone().unwrap_or_default(), template, reader);
        }
    }
    read_all.then_some(())?;
    Some(Names { all, space, derived, filter, spans })
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

fn filter<'t>(value: &Value<'t>, names: &[String], reader: &mut Reader<'t>) -> Option<Bound> {
    if !value.get_ref().is_str() {
        let problem = Problem::error(value.span(), "`where` is a condition in quotes");
        reader.note(problem.help("write where = \"a < 5 and is_crank_rocker\""));
        return None;
    }
    let expression = reader.expression(value)?;
    let bound = expression.bind(&Family::scope(names), Kind::Truth);
    reader.placed(value, bound)
}

/// What `grid` or `cases` gives, by name.
enum Given {
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

fn given<'t>(fields: &Fields<'_, 't>, reader: &mut Reader<'t>) -> Option<Given> {
    let limit = match fields.get("limit") {
        None => MAX_CELLS,
        Some(value) => reader.count(value, 1, 1_000_000_000)?,
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
    let mut waiting: Vec<(usize, Bound, Span)> = Vec::new();
    for (slot, expression, span) in sources {
        // Each was bound to these very names when it was read.
        waiting.push((slot, expression.bind(scope, Kind::Number).ok()?, span));
    }
    let mut done = Vec::new();
    while !waiting.is_empty() {
        let is_free = |bound: &Bound| !bound.slots().iter().any(|slot| waiting.iter().any(|(w, ..)| w == slot));
        match waiting.iter().position(|(_, bound, _)| is_free(bound)) {
            Some(next) => {
                let (slot, bound, _) = waiting.remove(next);
                done.push((slot, bound));
            }
            None => {
                let cycle = cycle(&waiting);
                let words: Vec<String> = cycle.iter().map(|&slot| format!("`{}`", names[slot])).collect();
                let span = waiting.iter().find(|(slot, ..)| *slot == cycle[0]).map(|w| w.2.clone()).unwrap_or_default();
                let problem = Problem::error(span, format!("{} is derived from itself", words[0]));
                reader.note(problem.help(format!("the cycle is {}: give one of them a value", words.join(" -> "))));
                return None;
            }
        }
    }
    Some(done)
}

/// The names of a cycle, the first once more at the end.
fn cycle(waiting: &[(usize, Bound, Span)]) -> Vec<usize> {
    let mut path = vec![waiting[0].0];
    loop {
        let at = path[path.len() - 1];
        let uses = waiting.iter().find(|(slot, ..)| *slot == at).map_or(&[][..], |(_, bound, _)| bound.slots());
        let next = uses.iter().copied().find(|slot| waiting.iter().any(|(w, ..)| w == slot)).unwrap_or(path[0]);
        if let Some(first) = path.iter().position(|&slot| slot == next) {
            path.drain(..first);
            path.push(next);
            return path;
        }
        path.push(next);
    }
}

/// Every cell's values and linkage; the first cell of each kind of problem is named, and the others counted.
fn check_cells(family: &Family, fields: &Fields, spans: &[Option<Span>], reader: &mut Reader) {
    struct Finding {
        key: String,
        span: Span,
        message: String,
        help: String,
        cells: usize,
    }
    let mut findings: Vec<Finding> = Vec::new();
    for k in 0..family.cells() {
        let cell = family.cell(k);
        for error in family.objections(&cell) {
            let (key, slot, help) = match &error {
                CellError::Missing(name) => (name.clone(), None, "give it in the grid, the cases or `let`"),
                CellError::Value { slot, .. } => (slot.to_string(), Some(*slot), "change the values it comes from"),
                CellError::Template(_) => {
                    ("linkage".to_owned(), None, "change the values it comes from, or leave the cell out")
                }
            };
            if let Some(found) = findings.iter_mut().find(|finding| finding.key == key) {
                found.cells += 1;
                continue;
            }
            let span = case_span(fields, k).or_else(|| spans.get(slot?).cloned().flatten());
            let span = span.or_else(|| fields.get("grid").map(Value::span)).unwrap_or_else(|| fields.span.clone());
            let given: Vec<String> = family
                .names
                .iter()
                .zip(&cell.values)
                .filter(|(_, v)| v.is_finite())
                .map(|(n, v)| format!("{n} = {v}"))
                .collect();
            let message = format!("in cell {} ({}), {error}", cell.number, given.join(", "));
            findings.push(Finding { key, span, message, help: help.to_owned(), cells: 1 });
        }
    }
    for finding in findings {
        let help = match finding.cells {
            1 => finding.help,
            n => format!("{}; the same is wrong in {} more cells", finding.help, n - 1),
        };
        reader.note(Problem::error(finding.span, finding.message).help(help));
    }
}

fn case_span(fields: &Fields, k: usize) -> Option<Span> {
    Some(fields.get("cases")?.get_ref().as_array()?.get(k)?.span())
}
