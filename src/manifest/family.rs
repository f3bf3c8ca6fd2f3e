//! A `[[family]]` table.

use std::sync::Arc;

use super::names::{check_expression_syntax, read_names, read_space};
use super::schema::{FAMILY, MIN_TOLERANCE, PLACE, SAMPLING, SPACINGS, STRAIGHT, Spacing};
use super::{ManifestInputs, PlannedFamily, Templates, chart, settings, tolerance};
use coupler_curves::expression::Dimension;
use coupler_curves::family::{COLUMNS, CellError, Column, Family, MAX_SAMPLES, MEASURES, Sampling, StraightCriterion};
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::problem::{Problem, Span, suggestion};
use coupler_curves::template::{Orientation, Template};
use coupler_drawing::page::{Layout, Options};
use coupler_drawing::render::Format;

/// The id of a table and its place, if it has one.
pub(super) fn id_and_span(value: &TomlValue) -> Option<(String, Span)> {
    let id = value.get_ref().as_table()?.get("id")?;
    Some((id.get_ref().as_str()?.to_owned(), id.span()))
}

pub(super) fn read<'t>(
    value: &TomlValue<'t>,
    templates: &Templates,
    (formats, page): (&[Format], Option<&Options>),
    reader: &mut TomlParser<'t>,
) -> Option<PlannedFamily> {
    let fields = Fields::from_value(value, &FAMILY, reader)?;
    let id =
        fields.required("id", "id = \"evans\"", reader).and_then(|value| linkage_format::parse_slug(value, reader));
    let template =
        fields.required("linkage", "linkage = \"evans\"", reader).and_then(|value| templates.find(value, reader));
    let template = template.map(|template| apply_overrides(template, &fields, reader));
    let text = |key: &str, reader: &mut TomlParser<'t>| fields.get(key).and_then(|value| reader.text(value));
    let (title, source) = (text("title", reader), text("source", reader));
    let formats = match fields.get("formats") {
        None => Some(formats.to_vec()),
        Some(value) => settings::formats(value, reader),
    };
    let sampling = fields
        .required("sampling", "sampling = { step = \"2 deg\" }", reader)
        .and_then(|value| sampling(value, template.as_deref(), reader));
    let columns = fields.get("columns").map_or(Some(Vec::new()), |value| columns(value, reader));
    let straight = match fields.get("straight") {
        None => Some(StraightCriterion::default()),
        Some(value) => straight(value, template.as_deref(), reader),
    };
    let measures = fields.get("measures").map_or(Some(vec![true; MEASURES.len()]), |value| measures(value, reader));
    let tolerances = tolerance::read(fields.get("check"), &tolerance::FAMILY_CHECK, reader);
    let names = match &template {
        Some(template) => read_names(template, &fields, reader),
        None => {
            read_space(&fields, reader);
            check_expression_syntax(&fields, reader);
            None
        }
    };
    let chart = match (fields.get("chart"), &template, &names) {
        (None, ..) => Some(None),
        (Some(value), Some(template), Some(names)) => chart::read(value, template, names, reader).map(Some),
        (Some(_), ..) => {
            chart::check_expression_syntax(&fields, reader);
            None
        }
    };
    let charts = chart.as_ref().and_then(Option::as_ref).map_or(1, |chart| chart.y.len());
    let layout = layout(&fields, page, charts, reader);
    let (id, template, names, sampling, columns, straight) = (id?, template?, names?, sampling?, columns?, straight?);
    let mut family = Family {
        title: title.unwrap_or_else(|| id.clone()),
        id,
        template,
        names: names.all,
        space: names.space,
        derived: names.derived,
        sampling,
        columns,
        straight,
        is_computed: measures?,
        filter: names.filter,
        sort: names.sort,
        captions: names.captions,
    };
    // What something asks for is taken, named or not.
    for k in 0..MEASURES.len() {
        let of_charts = chart.iter().flatten().flat_map(|chart| std::iter::once(&chart.x).chain(&chart.y));
        let is_charted = of_charts.into_iter().any(|quantity| family.expression_uses(&quantity.expression, k));
        family.is_computed[k] |= family.filter_or_sort_uses(k) || family.captions_use(k) || is_charted;
    }
    check_cells(&family, &fields, &names.spans, reader);
    let legend = [&family.template.source, &family.template.legend].map(String::as_str);
    let source =
        source.unwrap_or_else(|| legend.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · "));
    let filter_span = fields.get("where").map(TomlValue::span);
    let (layout, chart, formats) = (layout?, chart?, formats?);
    let inputs = ManifestInputs::default();
    Some(PlannedFamily {
        family,
        layout,
        chart,
        formats,
        source,
        manifest_inputs: inputs,
        tolerances,
        span: value.span(),
        filter_span,
    })
}

/// The template with what the family says otherwise.
fn apply_overrides<'t>(template: Arc<Template>, fields: &Fields<'_, 't>, reader: &mut TomlParser<'t>) -> Arc<Template> {
    let circuits = fields.get("circuits").and_then(|value| reader.word(value, &linkage_format::CIRCUIT_SELECTIONS));
    let continuation = fields.get("continuation").and_then(|value| reader.word(value, &linkage_format::CONTINUATIONS));
    let coincident = fields.get("coincident").and_then(|value| reader.word(value, &linkage_format::COINCIDENT_DYADS));
    let placement = fields.get("place").and_then(|value| placement(value, reader));
    if circuits.is_none() && continuation.is_none() && coincident.is_none() && placement.is_none() {
        return template;
    }
    let mut own = Template::clone(&template);
    own.circuits = circuits.unwrap_or(own.circuits);
    own.continuation = continuation.unwrap_or(own.continuation);
    own.coincident = coincident.unwrap_or(own.coincident);
    own.orientation = placement.unwrap_or(own.orientation);
    Arc::new(own)
}

/// Where the linkages of a family are laid.
fn placement<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Orientation> {
    let fields = Fields::from_value(value, &PLACE, reader)?;
    let mirror = fields.get("mirror").map_or(Some(false), |value| reader.boolean(value));
    let rotate = fields.get("rotate").map_or(Some(0.0), |value| reader.constant_quantity(value, Dimension::Angle));
    Some(Orientation::new(mirror?, rotate?))
}

fn sampling<'t>(value: &TomlValue<'t>, template: Option<&Template>, reader: &mut TomlParser<'t>) -> Option<Sampling> {
    let fields = Fields::from_value(value, &SAMPLING, reader)?;
    let spacing = match fields.get("spacing") {
        None => Spacing::Even,
        Some(value) => reader.word(value, &SPACINGS)?,
    };
    if let (Some(_), Some(value)) = (fields.get("step"), fields.get("spacing")) {
        let problem = Problem::error(value.span(), "samples by step are even in the input");
        reader.report(problem.with_help("write { samples = 180, spacing = \"smooth\" }"));
    }
    match (fields.get("step"), fields.get("samples")) {
        // Of a linkage that cannot be read it is not known what drives it.
        (Some(value), None) if template.is_none() && value.get_ref().as_str().is_none() => None,
        (Some(value), None) if template.is_some_and(Template::is_driven_by_length) => {
            let step = reader.input_length(value, &[])?.evaluate(|_| f64::NAN);
            let step = reader.require_finite(value, step)?;
            if step > 0.0 {
                return Some(Sampling::Step(step));
            }
            let problem = Problem::error(value.span(), format!("a step of {step} never ends"));
            reader.report(problem.with_help("give a length of more than 0, as in step = 0.05"));
            None
        }
        (Some(value), None) => {
            let step = reader.constant_quantity(value, Dimension::Angle)?;
            let least = 360.0 / MAX_SAMPLES as f64;
            let problem = match step {
                0.0 => Problem::error(value.span(), "a step of 0 never ends"),
                step if step < least || step > 360.0 => {
                    Problem::error(value.span(), format!("a step of {step} deg is out of range"))
                }
                _ => return Some(Sampling::Step(step)),
            };
            reader.report(problem.with_help(format!("give {least} to 360 deg, as in step = \"2 deg\"")));
            None
        }
        (None, Some(value)) => reader.integer(value, 2, MAX_SAMPLES).map(|n| match spacing {
            Spacing::Even => Sampling::Samples(n),
            Spacing::Smooth => Sampling::DenseAtLimits(n),
            Spacing::Arc => Sampling::ArcLength(n),
        }),
        (step, _) => {
            let message = if step.is_some() {
                "sampling is by step or by samples, not both"
            } else {
                "sampling needs a step or a number of samples"
            };
            reader.report(
                Problem::error(value.span(), message).with_help("write { step = \"2 deg\" } or { samples = 180 }"),
            );
            None
        }
    }
}

/// What is asked of the straight portion.
fn straight<'t>(
    value: &TomlValue<'t>,
    template: Option<&Template>,
    reader: &mut TomlParser<'t>,
) -> Option<StraightCriterion> {
    let fields = Fields::from_value(value, &STRAIGHT, reader)?;
    let given: Vec<&str> = STRAIGHT.key_names().into_iter().filter(|key| fields.get(key).is_some()).collect();
    let [key] = given[..] else {
        let problem =
            Problem::error(value.span(), "a straight portion is asked for by one of tolerance, input and length");
        reader.report(problem.with_help("write { tolerance = 0.001 }, { input = \"120 deg\" } or { length = 2 }"));
        return None;
    };
    let value = fields.get(key)?;
    let is_driven_by_length = template.is_some_and(Template::is_driven_by_length);
    let number = match key {
        // Of a linkage that cannot be read it is not known what drives it.
        "input" if template.is_none() => return None,
        "input" if is_driven_by_length => {
            let length = reader.input_length(value, &[])?.evaluate(|_| f64::NAN);
            reader.require_finite(value, length)?
        }
        "input" => reader.constant_quantity(value, Dimension::Angle)?,
        _ => reader.constant(value)?,
    };
    let least = if key == "tolerance" { MIN_TOLERANCE } else { 0.0 };
    let (most, straight) = match key {
        "tolerance" => (1.0, StraightCriterion::Tolerance(number)),
        "input" if !is_driven_by_length => (720.0, StraightCriterion::Input(number)),
        "input" => (f64::INFINITY, StraightCriterion::Input(number)),
        _ => (f64::INFINITY, StraightCriterion::Length(number)),
    };
    if number > 0.0 && number >= least && number <= most {
        return Some(straight);
    }
    let problem = Problem::error(value.span(), format!("`{key}` is {number}, which is out of range"));
    let range = match most {
        _ if least > 0.0 => format!("give {least} to {most}"),
        most if most.is_finite() => format!("give more than 0, and {most} at most"),
        _ => "give more than 0".to_owned(),
    };
    reader.report(problem.with_help(range));
    None
}

/// The further columns of `points.csv`.
fn columns<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Vec<Column>> {
    let places = name_indices(value, "column", &COLUMNS.map(|column| column.name), reader)?;
    Some(places.into_iter().map(|place| COLUMNS[place]).collect())
}

/// Which measures are named.
fn measures<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Vec<bool>> {
    let places = name_indices(value, "measure", &MEASURES.map(|measure| measure.name), reader)?;
    Some((0..MEASURES.len()).map(|k| places.contains(&k)).collect())
}

/// The places of names, each given once, among those there are.
fn name_indices<'t>(
    value: &TomlValue<'t>,
    what: &str,
    known: &[&str],
    reader: &mut TomlParser<'t>,
) -> Option<Vec<usize>> {
    let mut out: Vec<usize> = Vec::new();
    let mut all_read = true;
    for item in reader.list(value)? {
        let Some(name) = reader.text(item) else {
            all_read = false;
            continue;
        };
        let problem = match known.iter().position(|known| *known == name) {
            Some(place) if !out.contains(&place) => {
                out.push(place);
                continue;
            }
            Some(_) => {
                Problem::error(item.span(), format!("the {what} `{name}` is named twice")).with_help("name it once")
            }
            None => Problem::error(item.span(), format!("there is no {what} `{}`", name.escape_debug()))
                .with_help(suggestion(&name, known)),
        };
        reader.report(problem);
        all_read = false;
    }
    all_read.then_some(out)
}

/// The layout; of charts, of which there are that many, one in which they show well where no panels are given.
fn layout<'t>(
    fields: &Fields<'_, 't>,
    page: Option<&Options>,
    charts: usize,
    reader: &mut TomlParser<'t>,
) -> Option<Layout> {
    let words = Layout::ALL.map(|(name, _)| (name, name));
    let name = match fields.get("layout") {
        Some(value) => reader.word(value, &words)?,
        None => "panels",
    };
    let is_chart = name == "chart";
    chart::check_layout(fields, is_chart, reader);
    // Of a page that could not be read nothing is asked.
    let most = if is_chart { Layout::max_charts } else { Layout::max_panels };
    let [most_columns, most_rows] = page.map_or([100, 100], most);
    if name == "coupler-grid" {
        if let Some(value) = fields.get("panels") {
            let problem = Problem::error(value.span(), "a page of a coupler grid has one cell, and no panels");
            reader.report(problem.with_help("leave `panels` out, or write layout = \"panels\""));
        }
        return Some(Layout::CouplerGrid);
    }
    let Some(value) = fields.get("panels") else {
        return Some(match page.filter(|_| is_chart) {
            Some(page) => Layout::for_charts(page, charts),
            None => Layout::Panels { columns: most_columns.min(5), rows: most_rows.min(3) },
        });
    };
    let [columns, rows] = reader.pair(value)?;
    let (columns, rows) = (reader.integer(columns, 1, most_columns), reader.integer(rows, 1, most_rows));
    let (columns, rows) = (columns?, rows?);
    Some(if is_chart { Layout::Chart { columns, rows } } else { Layout::Panels { columns, rows } })
}

/// Every cell's values and linkage; the first cell of each kind of problem is named, and the others counted.
fn check_cells(family: &Family, fields: &Fields, spans: &[Option<Span>], reader: &mut TomlParser) {
    struct CellProblem {
        key: String,
        span: Span,
        message: String,
        help: String,
        cell_count: usize,
    }
    let mut findings: Vec<CellProblem> = Vec::new();
    for k in 0..family.cell_count() {
        let cell = family.cell(k);
        for error in family.cell_errors(&cell) {
            let (key, slot, help) = match &error {
                CellError::Missing(name) => (name.clone(), None, "give it in the grid, the cases or `let`"),
                CellError::Value { slot, .. } => (slot.to_string(), Some(*slot), "change the values it comes from"),
                CellError::Template(_) => {
                    ("linkage".to_owned(), None, "change the values it comes from, or leave the cell out")
                }
            };
            if let Some(found) = findings.iter_mut().find(|finding| finding.key == key) {
                found.cell_count += 1;
                continue;
            }
            let span = case_span(fields, k).or_else(|| spans.get(slot?).cloned().flatten());
            let span = span.or_else(|| fields.get("grid").map(TomlValue::span)).unwrap_or_else(|| fields.span.clone());
            let given: Vec<String> = family
                .names
                .iter()
                .zip(&cell.values)
                .filter(|(_, v)| v.is_finite())
                .map(|(n, v)| format!("{n} = {v}"))
                .collect();
            let message = format!("in cell {} ({}), {error}", cell.number, given.join(", "));
            findings.push(CellProblem { key, span, message, help: help.to_owned(), cell_count: 1 });
        }
    }
    for finding in findings {
        let help = match finding.cell_count {
            1 => finding.help,
            n => format!("{}; the same is wrong in {} more cells", finding.help, n - 1),
        };
        reader.report(Problem::error(finding.span, finding.message).with_help(help));
    }
}

fn case_span(fields: &Fields, k: usize) -> Option<Span> {
    Some(fields.get("cases")?.get_ref().as_array()?.get(k)?.span())
}
