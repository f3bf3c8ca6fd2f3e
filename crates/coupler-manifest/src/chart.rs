//! Reads the `chart` of a family.

use std::collections::HashSet;

use crate::names::FamilyNames;
use coupler_curves::expression::{CompiledExpression, Scope};
use coupler_curves::family::{MAX_CELLS, MEASURES, ParameterSpace};
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema, one_or_more};
use coupler_curves::measure::Measure;
use coupler_curves::problem::{Problem, Span, suggestion_among};
use coupler_curves::template::Template;
use coupler_drawing::chart::{self, Chart, PointSource, Quantity};

/// The `chart` table of a family.
pub(crate) static CHART: TableSchema = TableSchema::new(
    "`chart`",
    &[
        KeySchema::required(
            "x",
            QUANTITY_FORM,
            "The horizontal axis: an expression over the family's names and the measures, or input_deg or arc.",
        ),
        KeySchema::required(
            "y",
            ValueSchema::OneOrMore(&QUANTITY_FORM, 1),
            "The vertical axis: a chart for each expression.",
        ),
        KeySchema::new(
            "by",
            ValueSchema::OneOrMore(&ValueSchema::Text, 0),
            "The names whose values separate the lines; by default the other axes of the grid.",
        ),
        KeySchema::new("log", ValueSchema::OneOrMore(&ValueSchema::Text, 0), "Which of x and y have logarithmic axes."),
        KeySchema::new(
            "range",
            ValueSchema::Map(&ValueSchema::List(&ValueSchema::Number, [2, 2])),
            "The least and the greatest value of an axis, by the expression of x or y.",
        ),
        KeySchema::new(
            "title",
            ValueSchema::Map(&ValueSchema::Text),
            "The words for a quantity, by the expression of x or y; by default those of its measures.",
        ),
    ],
);

const QUANTITY_FORM: ValueSchema = ValueSchema::WithExamples(&ValueSchema::Text, numeric_measures);

/// The names of the measures for which `is_included` holds, of any linkage: those of lengths follow all others.
pub(crate) fn measure_names(is_included: fn(&Measure) -> bool) -> Vec<&'static str> {
    let included = || MEASURES.iter().filter(|measure| is_included(measure));
    included().map(|measure| measure.name).chain(included().filter_map(|measure| measure.length_name)).collect()
}

/// The names of the measures that are numbers, of any linkage.
pub(crate) fn numeric_measures() -> Vec<&'static str> {
    measure_names(|measure| !measure.is_word)
}

const EXAMPLE: &str = "chart = { x = \"p\", y = \"straight_length\" }";

/// What a chart is read for: the linkage of a family and its names.
type ChartedFamily<'a> = (&'a Template, &'a FamilyNames);

/// Reads the chart of a family; if that is not known, it is only checked as far as it can be.
pub(crate) fn read<'t>(
    value: &TomlValue<'t>,
    family: Option<ChartedFamily>,
    parser: &mut TomlParser<'t>,
) -> Option<Chart> {
    let fields = Fields::from_value(value, &CHART, parser)?;
    let x = fields.required("x", EXAMPLE, parser);
    let y = fields.required("y", EXAMPLE, parser);
    let [x, y] = [x.map_or(&[][..], std::slice::from_ref), y.map_or(&[][..], one_or_more)];
    let items: Vec<&TomlValue<'t>> = x.iter().chain(y).collect();
    let mut quantities = match family {
        Some(family) => quantities((&items, x.len()), family, parser),
        None => parser.with_unknown_names(|parser| {
            items.iter().for_each(|item| drop(quantity(item, &chart::scope(&[], false), None, parser)));
            vec![None; items.len()]
        }),
    };
    if let Some(value) = fields.get("y").filter(|_| y.is_empty()) {
        let problem = Problem::error(value.span(), "`y` is empty");
        parser.report(problem.with_help("name a measure, as in y = \"straight_length\""));
    }
    let by = fields.get("by").map(|value| series_slots(value, family.map(|(_, names)| names), parser));
    let mut axes = Axes {
        texts: items.iter().zip(&quantities).map(|(item, quantity)| written_text(item, quantity.as_ref())).collect(),
        are_known: !x.is_empty() && !y.is_empty(),
        quantities: &mut quantities,
    };
    let before = parser.problem_count();
    read_log(&fields, &mut axes, parser);
    read_ranges(&fields, &mut axes, parser);
    read_titles(&fields, &mut axes, parser);
    let are_axes_read = parser.problem_count() == before;
    let (_, names) = family?;
    if names.space.count() > MAX_CELLS {
        let problem = Problem::error(value.span(), format!("a chart can have at most {MAX_CELLS} cells"));
        parser.report(problem.with_help("use fewer values, or put the chart in a separate family"));
        return None;
    }
    let mut read = quantities.into_iter();
    let x = read.next().filter(|_| !x.is_empty())??;
    let point_source = sample_or_curve_points(&x, read.as_slice(), y, names, parser);
    let y = read.collect::<Option<Vec<Quantity>>>().filter(|_| are_axes_read)?;
    let by = match by {
        None => None,
        Some(by) => Some(by?),
    };
    let point_source = point_source?;
    let is_name = |slot: &usize| *slot < names.all.len();
    let is_ordered_by_x = point_source == PointSource::Curves && x.expression.slots().iter().all(is_name);
    let by = by.unwrap_or_else(|| default_series_slots(&x.expression, point_source, names));
    (!y.is_empty()).then_some(Chart { point_source, x, y, group_by: by, is_ordered_by_x })
}

/// Reads the quantities of x, none if it is missing, and of y, of which each is given once.
fn quantities<'t>(
    (items, x_count): (&[&TomlValue<'t>], usize),
    (template, names): ChartedFamily,
    parser: &mut TomlParser<'t>,
) -> Vec<Option<Quantity>> {
    let scope = chart::scope(&names.all, template.is_driven_by_length());
    let mut texts = HashSet::new();
    let mut found = Vec::new();
    for (k, item) in items.iter().enumerate() {
        let quantity = quantity(item, &scope, Some((template, names)), parser);
        if let Some(Quantity { text, .. }) = quantity.as_ref().filter(|_| k >= x_count)
            && !texts.insert(text.clone())
        {
            let problem = Problem::error(item.span(), format!("`{}` is named twice", text.escape_debug()));
            parser.report(problem.with_help("name it once"));
        }
        found.push(quantity);
    }
    found
}

/// Reads an expression over names and measures; without a family it is only checked.
fn quantity<'t>(
    value: &TomlValue<'t>,
    scope: &Scope,
    family: Option<ChartedFamily>,
    parser: &mut TomlParser<'t>,
) -> Option<Quantity> {
    let text = parser.text(value)?.trim().to_owned();
    let expression = parser.numeric_expression(value, scope)?;
    let (template, names) = family?;
    let title = chart::title(&expression, &names.all, template);
    let unit = chart::unit(&expression, &names.all, template);
    Some(Quantity { text, title, unit, expression, is_log: false, range: None })
}

/// Whether the chart has a point for each sample or for each curve; reports a `y` that does not match `x`.
fn sample_or_curve_points<'t>(
    x: &Quantity,
    y: &[Option<Quantity>],
    items: &[TomlValue<'t>],
    names: &FamilyNames,
    parser: &mut TomlParser<'t>,
) -> Option<PointSource> {
    let is_per_sample = |quantity: &Quantity| chart::is_per_sample(&quantity.expression, &names.all);
    if is_per_sample(x) {
        return Some(PointSource::Samples);
    }
    let mut is_consistent = true;
    for (quantity, item) in y.iter().zip(items) {
        if let Some(quantity) = quantity.as_ref().filter(|quantity| is_per_sample(quantity)) {
            let (x, y) = (x.text.escape_debug(), quantity.text.escape_debug());
            let message = format!("`{y}` has a value for each sample, and `{x}` one for each curve");
            let help = "draw it over x = \"input_deg\" or x = \"arc\", or draw a measure of the curve";
            parser.report(Problem::error(item.span(), message).with_help(help));
            is_consistent = false;
        }
    }
    is_consistent.then_some(PointSource::Curves)
}

/// Reads `by`: the names whose values separate the lines.
fn series_slots<'t>(
    value: &TomlValue<'t>,
    names: Option<&FamilyNames>,
    parser: &mut TomlParser<'t>,
) -> Option<Vec<usize>> {
    let scope = Scope::from_numbers(names.iter().flat_map(|names| &names.all).map(String::as_str));
    let mut found = Vec::new();
    let mut all_read = true;
    for item in one_or_more(value) {
        let slot = parser.text(item).map(|name| (scope.index_of(&name), name));
        match slot {
            Some((Some(slot), _)) => found.push(slot),
            Some((None, _)) if names.is_none() => all_read = false,
            Some((None, name)) => {
                let problem = Problem::error(item.span(), format!("there is no `{}`", name.escape_debug()));
                parser.report(problem.with_help(suggestion_among(&name, scope.names(), scope.len())));
                all_read = false;
            }
            None => all_read = false,
        }
    }
    all_read.then_some(found)
}

/// The default of `by`. For a grid: the axes that x does not depend on, or all but the last if it depends on none. For
/// cases: the names they give, if each point is a sample; otherwise none, and all points are on one line.
fn default_series_slots(x: &CompiledExpression, point_source: PointSource, names: &FamilyNames) -> Vec<usize> {
    match &names.space {
        ParameterSpace::Grid(axes) => {
            let slots: Vec<usize> = axes.iter().map(|axis| axis.slot).collect();
            if point_source == PointSource::Samples {
                return slots;
            }
            let x_slots = dependencies(x, names);
            let others: Vec<usize> = slots.iter().copied().filter(|slot| !x_slots.contains(slot)).collect();
            if others.len() < slots.len() { others } else { slots[..slots.len() - 1].to_vec() }
        }
        ParameterSpace::Cases(cases) if point_source == PointSource::Samples => {
            let mut slots: Vec<usize> = cases.iter().flatten().map(|(slot, _)| *slot).collect();
            slots.sort_unstable();
            slots.dedup();
            slots
        }
        ParameterSpace::Table { slots, .. } if point_source == PointSource::Samples => {
            let mut slots = slots.clone();
            slots.sort_unstable();
            slots
        }
        ParameterSpace::Cases(_) | ParameterSpace::Table { .. } => Vec::new(),
    }
}

/// The slots that an expression uses, and those they are derived from.
fn dependencies(value: &CompiledExpression, names: &FamilyNames) -> HashSet<usize> {
    let mut found: HashSet<usize> = value.slots().iter().copied().collect();
    // Each derived value comes after those it uses.
    for (slot, expression) in names.derived.iter().rev() {
        if found.contains(slot) {
            found.extend(expression.slots());
        }
    }
    found
}

/// The text of a quantity, also of one that cannot be read.
fn written_text(item: &TomlValue, quantity: Option<&Quantity>) -> Option<String> {
    quantity.map(|quantity| quantity.text.clone()).or_else(|| Some(item.get_ref().as_str()?.trim().to_owned()))
}

/// The quantities of the axes of a chart, x before those of y, as far as they can be read, and their texts.
struct Axes<'q> {
    texts: Vec<Option<String>>,
    /// Whether both axes have quantities.
    are_known: bool,
    quantities: &'q mut [Option<Quantity>],
}

impl Axes<'_> {
    /// The quantity with this text, if it could be read; reports a text that no quantity has.
    fn find(&mut self, text: &str, place: Span, parser: &mut TomlParser) -> Option<&mut Quantity> {
        let found = self.texts.iter().position(|known| known.as_deref() == Some(text.trim()));
        if found.is_none() && self.are_known && self.texts.iter().all(Option::is_some) {
            let problem = Problem::error(place, format!("the chart has no quantity `{}`", text.escape_debug()));
            let texts = self.texts.iter().flatten().map(String::as_str);
            parser.report(problem.with_help(suggestion_among(text, texts, self.texts.len())));
        }
        self.quantities.get_mut(found?)?.as_mut()
    }
}

/// Reads `log`: which quantities have logarithmic axes.
fn read_log<'t>(fields: &Fields<'_, 't>, axes: &mut Axes, parser: &mut TomlParser<'t>) {
    for item in fields.get("log").map_or(&[][..], one_or_more) {
        let Some(text) = parser.text(item) else { continue };
        if let Some(quantity) = axes.find(&text, item.span(), parser) {
            quantity.is_log = true;
        }
    }
}

/// Reads `range`: the ends of the axes.
fn read_ranges<'t>(fields: &Fields<'_, 't>, axes: &mut Axes, parser: &mut TomlParser<'t>) {
    let table = fields.get("range").and_then(|value| Fields::with_any_keys(value, "`range`", parser));
    for (text, span, value) in table.iter().flat_map(Fields::entries) {
        let range = parser.pair(value, "[1, 2]").map(|pair| pair.map(|end| parser.constant(end)));
        let quantity = axes.find(text, span, parser);
        let Some([Some(low), Some(high)]) = range else { continue };
        let error = if !(low < high && high - low < f64::INFINITY) {
            Some((format!("[{low}, {high}] is not a range"), "give the lower end first, as in [0, 3]"))
        } else if quantity.as_ref().is_some_and(|quantity| quantity.is_log) && low <= 0.0 {
            Some((format!("a logarithmic axis cannot begin at {low}"), "begin it above 0"))
        } else {
            None
        };
        match (error, quantity) {
            (Some((message, help)), _) => parser.report(Problem::error(value.span(), message).with_help(help)),
            (None, Some(quantity)) => quantity.range = Some([low, high]),
            (None, None) => {}
        }
    }
}

/// Reads `title`: the words for quantities, after which the unit is printed if there is one.
fn read_titles<'t>(fields: &Fields<'_, 't>, axes: &mut Axes, parser: &mut TomlParser<'t>) {
    let table = fields.get("title").and_then(|value| Fields::with_any_keys(value, "`title`", parser));
    for (text, span, value) in table.iter().flat_map(Fields::entries) {
        let title = parser.text(value);
        if let (Some(quantity), Some(title)) = (axes.find(text, span, parser), title) {
            quantity.title = title;
        }
    }
}

/// Checks that a family has a `chart` if and only if its layout is `chart`.
pub(crate) fn check_layout<'t>(fields: &Fields<'_, 't>, is_chart: bool, parser: &mut TomlParser<'t>) {
    match (is_chart, fields.get("chart"), fields.get("layout")) {
        (true, None, Some(layout)) => {
            let problem = Problem::error(layout.span(), "the layout is `chart`, but there is no `chart`");
            parser.report(problem.with_help(format!("name its quantities: {EXAMPLE}")));
        }
        (false, Some(chart), _) => {
            let problem = Problem::error(chart.span(), "there is a `chart`, but the layout is not `chart`");
            parser.report(problem.with_help("set layout = \"chart\", or leave `chart` out"));
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::expression::{Expression, Kind};

    #[test]
    fn measures_of_samples_and_of_curves_are_distinguished() {
        let scope = chart::scope(&[], false);
        let compiled = Expression::parse("mu_deg + mu_min_deg").unwrap().compile(&scope, Kind::Number).unwrap();
        assert!(chart::is_per_sample(&compiled, &[]));
        let compiled = Expression::parse("mu_min_deg").unwrap().compile(&scope, Kind::Number).unwrap();
        assert!(!chart::is_per_sample(&compiled, &[]));
    }
}
