//! The `chart` of a family.

use super::names::FamilyNames;
use super::schema::numeric_measures;
use coupler_curves::expression::{CompiledExpression, Expression};
use coupler_curves::family::{MAX_CELLS, ParameterSpace};
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::problem::{Problem, suggestion};
use coupler_curves::template::Template;
use coupler_drawing::chart::{self, Chart, PointSource, Quantity};

/// The `chart` of a family.
pub(super) static CHART: TableSchema = TableSchema::new(
    "`chart`",
    &[
        KeySchema::required(
            "x",
            QUANTITY_FORM,
            "What it is drawn over: an expression over the family's names and the measures, or input_deg or arc.",
        ),
        KeySchema::required(
            "y",
            ValueSchema::OneOrMore(&QUANTITY_FORM, 1),
            "What is drawn: a chart for each expression.",
        ),
        KeySchema::new(
            "by",
            ValueSchema::OneOrMore(&ValueSchema::Text, 0),
            "The names that tell lines apart; the other axes of the grid where left out.",
        ),
        KeySchema::new("log", ValueSchema::OneOrMore(&ValueSchema::Text, 0), "Which of x and y have logarithmic axes."),
        KeySchema::new(
            "range",
            ValueSchema::Map(&ValueSchema::List(&ValueSchema::Number, [2, 2])),
            "How far axes go: of x or y, the least and the greatest value.",
        ),
    ],
);

const QUANTITY_FORM: ValueSchema = ValueSchema::WithExamples(&ValueSchema::Text, numeric_measures);
const EXAMPLE: &str = "chart = { x = \"p\", y = \"straight_length\" }";

/// The names that a chart's expressions use, whatever else is wrong with it; `None` where one cannot be read.
pub(super) fn used_names(fields: &Fields) -> Option<Vec<String>> {
    let Some(chart) = fields.get("chart").and_then(|value| value.get_ref().as_table()) else { return Some(Vec::new()) };
    let mut found = Vec::new();
    for value in ["x", "y", "by"].into_iter().filter_map(|key| chart.get(key)) {
        let items = value.get_ref().as_array().map_or(std::slice::from_ref(value), |list| &list[..]);
        for text in items.iter().filter_map(|item| item.get_ref().as_str()) {
            found.extend(Expression::parse(text).ok()?.names().iter().cloned());
        }
    }
    Some(found)
}

/// What can be said of a chart when the names it may use are not known: whether its expressions can be read.
pub(super) fn check_expression_syntax<'t>(fields: &Fields<'_, 't>, reader: &mut TomlParser<'t>) {
    let Some(fields) = fields.get("chart").and_then(|value| Fields::from_value(value, &CHART, reader)) else {
        return;
    };
    for value in ["x", "y"].into_iter().filter_map(|key| fields.get(key)) {
        for item in one_or_more(value) {
            if let Some(text) = reader.text(item) {
                let parsed = Expression::parse(&text);
                reader.ok_or_report(item, parsed);
            }
        }
    }
}

/// Reads the chart of a family.
pub(super) fn read<'t>(
    value: &TomlValue<'t>,
    template: &Template,
    names: &FamilyNames,
    reader: &mut TomlParser<'t>,
) -> Option<Chart> {
    let fields = Fields::from_value(value, &CHART, reader)?;
    let x = fields.required("x", EXAMPLE, reader);
    let y = fields.required("y", EXAMPLE, reader);
    let x = x.and_then(|value| quantity(value, template, names, reader));
    let y = y.and_then(|value| quantities(value, template, names, reader));
    let by = match fields.get("by") {
        None => None,
        Some(value) => Some(series_slots(value, names, reader)?),
    };
    let (mut x, mut y) = (x?, y?);
    let over = sample_or_curve_points(&x, &y, &fields, names, reader)?;
    read_log(&fields, &mut x, &mut y, reader)?;
    read_ranges(&fields, &mut x, &mut y, reader)?;
    if names.space.count() > MAX_CELLS {
        let problem = Problem::error(value.span(), format!("a chart is drawn of {MAX_CELLS} cells at most"));
        reader.report(problem.with_help("take fewer values, or leave the chart to a family of its own"));
        return None;
    }
    let is_own = |slot: &usize| *slot < names.all.len();
    let in_order_of_x = over == PointSource::Curves && x.expression.slots().iter().all(is_own);
    let by = by.unwrap_or_else(|| default_series_slots(&x.expression, over, names));
    Some(Chart { point_source: over, x, y, group_by: by, is_ordered_by_x: in_order_of_x })
}

/// A list, or the one thing that is in its place.
fn one_or_more<'v, 't>(value: &'v TomlValue<'t>) -> &'v [TomlValue<'t>] {
    value.get_ref().as_array().map_or(std::slice::from_ref(value), |list| &list[..])
}

fn quantities<'t>(
    value: &TomlValue<'t>,
    template: &Template,
    names: &FamilyNames,
    reader: &mut TomlParser<'t>,
) -> Option<Vec<Quantity>> {
    let items = one_or_more(value);
    if items.is_empty() {
        let problem = Problem::error(value.span(), "there is nothing to draw");
        reader.report(problem.with_help("name a measure, as in y = \"straight_length\""));
        return None;
    }
    let mut found: Vec<Quantity> = Vec::new();
    let mut all_read = true;
    for item in items {
        let Some(quantity) = quantity(item, template, names, reader) else {
            all_read = false;
            continue;
        };
        if found.iter().any(|other| other.text == quantity.text) {
            let problem = Problem::error(item.span(), format!("`{}` is named twice", quantity.text.escape_debug()));
            reader.report(problem.with_help("name it once"));
            all_read = false;
        }
        found.push(quantity);
    }
    all_read.then_some(found)
}

fn quantity<'t>(
    value: &TomlValue<'t>,
    template: &Template,
    names: &FamilyNames,
    reader: &mut TomlParser<'t>,
) -> Option<Quantity> {
    let text = reader.text(value)?.trim().to_owned();
    let is_driven_by_length = template.is_driven_by_length();
    let value = reader.numeric_expression(value, &chart::scope(&names.all, is_driven_by_length))?;
    let unit = chart::unit(&text, is_driven_by_length);
    let definition = chart::definition(&text, &names.all);
    Some(Quantity { text, unit, definition, expression: value, is_log: false, range: None })
}

/// What there is a point for.
fn sample_or_curve_points<'t>(
    x: &Quantity,
    y: &[Quantity],
    fields: &Fields<'_, 't>,
    names: &FamilyNames,
    reader: &mut TomlParser<'t>,
) -> Option<PointSource> {
    let is_of_samples = |quantity: &Quantity| chart::is_per_sample(&quantity.expression, &names.all);
    if is_of_samples(x) {
        return Some(PointSource::Samples);
    }
    let mut is_good = true;
    for (quantity, item) in y.iter().zip(fields.get("y").map_or(&[][..], one_or_more)) {
        if is_of_samples(quantity) {
            let (x, y) = (x.text.escape_debug(), quantity.text.escape_debug());
            let message = format!("`{y}` has a value for each sample, and `{x}` one for each curve");
            let help = "draw it over x = \"input_deg\" or x = \"arc\", or draw a measure of the curve";
            reader.report(Problem::error(item.span(), message).with_help(help));
            is_good = false;
        }
    }
    is_good.then_some(PointSource::Curves)
}

/// The names that tell lines apart.
fn series_slots<'t>(value: &TomlValue<'t>, names: &FamilyNames, reader: &mut TomlParser<'t>) -> Option<Vec<usize>> {
    let known: Vec<&str> = names.all.iter().map(String::as_str).collect();
    let mut found = Vec::new();
    let mut all_read = true;
    for item in one_or_more(value) {
        let slot = reader.text(item).map(|name| (names.all.iter().position(|known| *known == name), name));
        match slot {
            Some((Some(slot), _)) => found.push(slot),
            Some((None, name)) => {
                let problem = Problem::error(item.span(), format!("there is no `{}`", name.escape_debug()));
                reader.report(problem.with_help(suggestion(&name, &known)));
                all_read = false;
            }
            None => all_read = false,
        }
    }
    all_read.then_some(found)
}

/// Of a grid, the axes that x does not rest on; where it rests on none, all but the last. Of cases, what they give, for
/// the lines of samples; their points make one line.
fn default_series_slots(x: &CompiledExpression, over: PointSource, names: &FamilyNames) -> Vec<usize> {
    match &names.space {
        ParameterSpace::Grid(axes) => {
            let slots: Vec<usize> = axes.iter().map(|axis| axis.slot).collect();
            if over == PointSource::Samples {
                return slots;
            }
            let resting = dependencies(x, names);
            let others: Vec<usize> = slots.iter().copied().filter(|slot| !resting.contains(slot)).collect();
            if others.len() < slots.len() { others } else { slots[..slots.len() - 1].to_vec() }
        }
        ParameterSpace::Cases(cases) if over == PointSource::Samples => {
            let mut slots: Vec<usize> = cases.iter().flatten().map(|(slot, _)| *slot).collect();
            slots.sort_unstable();
            slots.dedup();
            slots
        }
        ParameterSpace::Cases(_) => Vec::new(),
    }
}

/// The names that an expression uses, and those they are derived from.
fn dependencies(value: &CompiledExpression, names: &FamilyNames) -> Vec<usize> {
    let mut found: Vec<usize> = value.slots().to_vec();
    let mut next = 0;
    while let Some(&slot) = found.get(next) {
        let sources = names.derived.iter().filter(|(derived, _)| *derived == slot).flat_map(|(_, bound)| bound.slots());
        for source in sources {
            if !found.contains(source) {
                found.push(*source);
            }
        }
        next += 1;
    }
    found
}

/// The quantity of a chart that is written so.
fn find_quantity<'q, 't>(
    text: &str,
    place: std::ops::Range<usize>,
    (x, y): (&'q mut Quantity, &'q mut [Quantity]),
    reader: &mut TomlParser<'t>,
) -> Option<&'q mut Quantity> {
    let known: Vec<String> = std::iter::once(&*x).chain(&*y).map(|quantity| quantity.text.clone()).collect();
    let found = std::iter::once(x).chain(y).find(|quantity| quantity.text == text.trim());
    if found.is_none() {
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let problem = Problem::error(place, format!("the chart draws no `{}`", text.escape_debug()));
        reader.report(problem.with_help(suggestion(text, &known)));
    }
    found
}

/// Which of its quantities are drawn by their logarithms.
fn read_log<'t>(
    fields: &Fields<'_, 't>,
    x: &mut Quantity,
    y: &mut [Quantity],
    reader: &mut TomlParser<'t>,
) -> Option<()> {
    let before = reader.problem_count();
    for item in fields.get("log").map_or(&[][..], one_or_more) {
        let Some(text) = reader.text(item) else { continue };
        if let Some(quantity) = find_quantity(&text, item.span(), (x, y), reader) {
            quantity.is_log = true;
        }
    }
    (reader.problem_count() == before).then_some(())
}

/// How far its quantities are drawn.
fn read_ranges<'t>(
    fields: &Fields<'_, 't>,
    x: &mut Quantity,
    y: &mut [Quantity],
    reader: &mut TomlParser<'t>,
) -> Option<()> {
    let Some(value) = fields.get("range") else { return Some(()) };
    let before = reader.problem_count();
    for (text, span, value) in Fields::with_any_keys(value, "`range`", reader)?.entries() {
        let range = reader.pair(value).map(|pair| pair.map(|end| reader.constant(end)));
        let (Some(quantity), Some([Some(low), Some(high)])) = (find_quantity(text, span, (x, y), reader), range) else {
            continue;
        };
        let wrong = if !(low < high && high - low < f64::INFINITY) {
            Some((format!("from {low} to {high} is no range"), "give the lesser end first, as in [0, 3]"))
        } else if quantity.is_log && low <= 0.0 {
            Some((format!("a logarithmic axis cannot begin at {low}"), "begin it above 0"))
        } else {
            None
        };
        match wrong {
            Some((message, help)) => reader.report(Problem::error(value.span(), message).with_help(help)),
            None => quantity.range = Some([low, high]),
        }
    }
    (reader.problem_count() == before).then_some(())
}

/// Checks that a family with a chart is laid out as one, and the other way round.
pub(super) fn check_layout<'t>(fields: &Fields<'_, 't>, is_chart: bool, reader: &mut TomlParser<'t>) {
    match (is_chart, fields.get("chart"), fields.get("layout")) {
        (true, None, Some(layout)) => {
            let problem = Problem::error(layout.span(), "the layout is chart, and there is no `chart`");
            reader.report(problem.with_help(format!("say what is drawn: {EXAMPLE}")));
        }
        (false, Some(chart), _) => {
            let problem = Problem::error(chart.span(), "there is a `chart`, and the layout is panels");
            reader.report(problem.with_help("add layout = \"chart\", or leave `chart` out"));
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::expression::Kind;

    #[test]
    fn a_measure_is_no_name_of_the_familys_own() {
        let scope = chart::scope(&[], false);
        let bound = Expression::parse("mu_deg + mu_min_deg").unwrap().compile(&scope, Kind::Number).unwrap();
        assert!(chart::is_per_sample(&bound, &[]));
        let bound = Expression::parse("mu_min_deg").unwrap().compile(&scope, Kind::Number).unwrap();
        assert!(!chart::is_per_sample(&bound, &[]));
    }
}
