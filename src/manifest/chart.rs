//! The `chart` of a family.

use super::names::Names;
use super::table::measures;
use coupler_curves::expression::{Bound, Expression};
use coupler_curves::family::{MAX_CELLS, Space};
use coupler_curves::notation::{Fields, Form, Key, Reader, Table, Value};
use coupler_curves::problem::{Problem, nearest_or_all};
use coupler_curves::template::Template;
use coupler_drawing::chart::{self, Chart, Over, Quantity};

/// The `chart` of a family.
pub(super) static CHART: Table = Table::new(
    "`chart`",
    &[
        Key::required(
            "x",
            QUANTITY,
            "What it is drawn over: an expression over the family's names and the measures, or input_deg or arc.",
        ),
        Key::required("y", Form::OneOrMore(&QUANTITY, 1), "What is drawn: a chart for each expression."),
        Key::new(
            "by",
            Form::OneOrMore(&Form::Text, 0),
            "The names that tell lines apart; the other axes of the grid where left out.",
        ),
        Key::new("log", Form::OneOrMore(&Form::Text, 0), "Which of x and y have logarithmic axes."),
        Key::new(
            "range",
            Form::Entries(&Form::List(&Form::Number, [2, 2])),
            "How far axes go: of x or y, the least and the greatest value.",
        ),
    ],
);

const QUANTITY: Form = Form::Like(&Form::Text, measures);
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
pub(super) fn read_expressions<'t>(fields: &Fields<'_, 't>, reader: &mut Reader<'t>) {
    let Some(fields) = fields.get("chart").and_then(|value| Fields::of(value, &CHART, reader)) else {
        return;
    };
    for value in ["x", "y"].into_iter().filter_map(|key| fields.get(key)) {
        for item in one_or_more(value) {
            if let Some(text) = reader.text(item) {
                let parsed = Expression::parse(&text);
                reader.placed(item, parsed);
            }
        }
    }
}

/// Reads the chart of a family.
pub(super) fn read<'t>(
    value: &Value<'t>,
    template: &Template,
    names: &Names,
    reader: &mut Reader<'t>,
) -> Option<Chart> {
    let fields = Fields::of(value, &CHART, reader)?;
    let x = fields.required("x", EXAMPLE, reader);
    let y = fields.required("y", EXAMPLE, reader);
    let x = x.and_then(|value| quantity(value, template, names, reader));
    let y = y.and_then(|value| quantities(value, template, names, reader));
    let by = match fields.get("by") {
        None => None,
        Some(value) => Some(by(value, names, reader)?),
    };
    let (mut x, mut y) = (x?, y?);
    let over = over(&x, &y, &fields, names, reader)?;
    read_log(&fields, &mut x, &mut y, reader)?;
    read_ranges(&fields, &mut x, &mut y, reader)?;
    if names.space.count() > MAX_CELLS {
        let problem = Problem::error(value.span(), format!("a chart is drawn of {MAX_CELLS} cells at most"));
        reader.note(problem.help("take fewer values, or leave the chart to a family of its own"));
        return None;
    }
    let is_own = |slot: &usize| *slot < names.all.len();
    let in_order_of_x = over == Over::Curves && x.value.slots().iter().all(is_own);
    let by = by.unwrap_or_else(|| default_by(&x.value, over, names));
    Some(Chart { over, x, y, by, in_order_of_x })
}

/// A list, or the one thing that is in its place.
fn one_or_more<'v, 't>(value: &'v Value<'t>) -> &'v [Value<'t>] {
    value.get_ref().as_array().map_or(std::slice::from_ref(value), |list| &list[..])
}

fn quantities<'t>(
    value: &Value<'t>,
    template: &Template,
    names: &Names,
    reader: &mut Reader<'t>,
) -> Option<Vec<Quantity>> {
    let items = one_or_more(value);
    if items.is_empty() {
        let problem = Problem::error(value.span(), "there is nothing to draw");
        reader.note(problem.help("name a measure, as in y = \"straight_length\""));
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
            reader.note(problem.help("name it once"));
            all_read = false;
        }
        found.push(quantity);
    }
    all_read.then_some(found)
}

fn quantity<'t>(value: &Value<'t>, template: &Template, names: &Names, reader: &mut Reader<'t>) -> Option<Quantity> {
    let text = reader.text(value)?.trim().to_owned();
    let is_driven_by_length = template.is_driven_by_length();
    let value = reader.bound(value, &chart::scope(&names.all, is_driven_by_length))?;
    let unit = chart::unit(&text, is_driven_by_length);
    let definition = chart::definition(&text, &names.all);
    Some(Quantity { text, unit, definition, value, is_log: false, range: None })
}

/// What there is a point for.
fn over<'t>(
    x: &Quantity,
    y: &[Quantity],
    fields: &Fields<'_, 't>,
    names: &Names,
    reader: &mut Reader<'t>,
) -> Option<Over> {
    let is_of_samples = |quantity: &Quantity| chart::is_of_samples(&quantity.value, &names.all);
    if is_of_samples(x) {
        return Some(Over::Samples);
    }
    let mut is_good = true;
    for (quantity, item) in y.iter().zip(fields.get("y").map_or(&[][..], one_or_more)) {
        if is_of_samples(quantity) {
            let (x, y) = (x.text.escape_debug(), quantity.text.escape_debug());
            let message = format!("`{y}` has a value for each sample, and `{x}` one for each curve");
            let help = "draw it over x = \"input_deg\" or x = \"arc\", or draw a measure of the curve";
            reader.note(Problem::error(item.span(), message).help(help));
            is_good = false;
        }
    }
    is_good.then_some(Over::Curves)
}

/// The names that tell lines apart.
fn by<'t>(value: &Value<'t>, names: &Names, reader: &mut Reader<'t>) -> Option<Vec<usize>> {
    let known: Vec<&str> = names.all.iter().map(String::as_str).collect();
    let mut found = Vec::new();
    let mut all_read = true;
    for item in one_or_more(value) {
        let slot = reader.text(item).map(|name| (names.all.iter().position(|known| *known == name), name));
        match slot {
            Some((Some(slot), _)) => found.push(slot),
            Some((None, name)) => {
                let problem = Problem::error(item.span(), format!("there is no `{}`", name.escape_debug()));
                reader.note(problem.help(nearest_or_all(&name, &known)));
                all_read = false;
            }
            None => all_read = false,
        }
    }
    all_read.then_some(found)
}

/// Of a grid, the axes that x does not rest on; where it rests on none, all but the last. Of cases, what they give, for
/// the lines of samples; their points make one line.
fn default_by(x: &Bound, over: Over, names: &Names) -> Vec<usize> {
    match &names.space {
        Space::Grid(axes) => {
            let slots: Vec<usize> = axes.iter().map(|axis| axis.slot).collect();
            if over == Over::Samples {
                return slots;
            }
            let resting = rests_on(x, names);
            let others: Vec<usize> = slots.iter().copied().filter(|slot| !resting.contains(slot)).collect();
            if others.len() < slots.len() { others } else { slots[..slots.len() - 1].to_vec() }
        }
        Space::Cases(cases) if over == Over::Samples => {
            let mut slots: Vec<usize> = cases.iter().flatten().map(|(slot, _)| *slot).collect();
            slots.sort_unstable();
            slots.dedup();
            slots
        }
        Space::Cases(_) => Vec::new(),
    }
}

/// The names that an expression uses, and those they are derived from.
fn rests_on(value: &Bound, names: &Names) -> Vec<usize> {
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
fn named<'q, 't>(
    text: &str,
    place: std::ops::Range<usize>,
    (x, y): (&'q mut Quantity, &'q mut [Quantity]),
    reader: &mut Reader<'t>,
) -> Option<&'q mut Quantity> {
    let known: Vec<String> = std::iter::once(&*x).chain(&*y).map(|quantity| quantity.text.clone()).collect();
    let found = std::iter::once(x).chain(y).find(|quantity| quantity.text == text.trim());
    if found.is_none() {
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let problem = Problem::error(place, format!("the chart draws no `{}`", text.escape_debug()));
        reader.note(problem.help(nearest_or_all(text, &known)));
    }
    found
}

/// Which of its quantities are drawn by their logarithms.
fn read_log<'t>(fields: &Fields<'_, 't>, x: &mut Quantity, y: &mut [Quantity], reader: &mut Reader<'t>) -> Option<()> {
    let before = reader.noted();
    for item in fields.get("log").map_or(&[][..], one_or_more) {
        let Some(text) = reader.text(item) else { continue };
        if let Some(quantity) = named(&text, item.span(), (x, y), reader) {
            quantity.is_log = true;
        }
    }
    (reader.noted() == before).then_some(())
}

/// How far its quantities are drawn.
fn read_ranges<'t>(
    fields: &Fields<'_, 't>,
    x: &mut Quantity,
    y: &mut [Quantity],
    reader: &mut Reader<'t>,
) -> Option<()> {
    let Some(value) = fields.get("range") else { return Some(()) };
    let before = reader.noted();
    for (text, span, value) in Fields::open(value, "`range`", reader)?.entries() {
        let range = reader.pair(value).map(|pair| pair.map(|end| reader.constant(end)));
        let (Some(quantity), Some([Some(low), Some(high)])) = (named(text, span, (x, y), reader), range) else {
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
            Some((message, help)) => reader.note(Problem::error(value.span(), message).help(help)),
            None => quantity.range = Some([low, high]),
        }
    }
    (reader.noted() == before).then_some(())
}

/// Checks that a family with a chart is laid out as one, and the other way round.
pub(super) fn check_layout<'t>(fields: &Fields<'_, 't>, is_chart: bool, reader: &mut Reader<'t>) {
    match (is_chart, fields.get("chart"), fields.get("layout")) {
        (true, None, Some(layout)) => {
            let problem = Problem::error(layout.span(), "the layout is chart, and there is no `chart`");
            reader.note(problem.help(format!("say what is drawn: {EXAMPLE}")));
        }
        (false, Some(chart), _) => {
            let problem = Problem::error(chart.span(), "there is a `chart`, and the layout is panels");
            reader.note(problem.help("add layout = \"chart\", or leave `chart` out"));
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
        let bound = Expression::parse("mu_deg + mu_min_deg").unwrap().bind(&scope, Kind::Number).unwrap();
        assert!(chart::is_of_samples(&bound, &[]));
        let bound = Expression::parse("mu_min_deg").unwrap().bind(&scope, Kind::Number).unwrap();
        assert!(!chart::is_of_samples(&bound, &[]));
    }
}
