//! Reports measures and columns that the linkage of a family cannot have.

use coupler_curves::expression::{Caption, Expression};
use coupler_curves::linkage_format::{Fields, TomlParser, TomlValue, one_or_more};
use coupler_curves::measure::{self, BOOLEANS, Measure, Subject};
use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::{Linkage, Template};

/// Reports each measure and column that a family names and its linkage cannot have: in `measures`, `columns`, `where`,
/// `sort`, `caption`, `note` and `chart`.
///
/// Expressions that cannot be parsed are reported elsewhere.
pub(crate) fn check(template: &Template, fields: &Fields, parser: &mut TomlParser) {
    // What is wrong with the joints is reported with the linkage.
    let Ok(structure) = template.structure() else { return };
    let gives = |key: &str| fields.get(key).is_some();
    let linkage = CheckedLinkage { template, structure: &structure, given: [gives("load"), gives("tolerance")] };
    for (key, quantities) in [("measures", Quantities::Measures), ("columns", Quantities::Columns)] {
        for item in fields.get(key).map_or(&[][..], one_or_more) {
            linkage.check_name(item.get_ref().as_str().unwrap_or_default(), quantities, item.span(), parser);
        }
    }
    let check_expression = |value: &TomlValue, quantities: Quantities, parser: &mut TomlParser| {
        let Some(expression) = value.get_ref().as_str().and_then(|text| Expression::parse(text).ok()) else { return };
        for name in expression.names().iter().filter(|name| !is_own_name(name, fields)) {
            linkage.check_name(name, quantities, parser.expression_span(value, expression.name_span(name)), parser);
        }
    };
    for value in ["where", "sort"].into_iter().filter_map(|key| fields.get(key)) {
        check_expression(value, Quantities::Measures, parser);
    }
    let chart = fields.get("chart").and_then(|value| value.get_ref().as_table());
    for value in ["x", "y"].into_iter().filter_map(|key| chart?.get(key)) {
        one_or_more(value).iter().for_each(|item| check_expression(item, Quantities::InCharts, parser));
    }
    for value in ["caption", "note"].into_iter().filter_map(|key| fields.get(key)) {
        let (caption, _) = Caption::parse_partly(value.get_ref().as_str().unwrap_or_default());
        for (expression, start) in caption.expressions() {
            for name in expression.names().iter().filter(|name| !is_own_name(name, fields)) {
                let span = expression.name_span(name).map(|span| start + span.start..start + span.end);
                linkage.check_name(name, Quantities::InCaptions, parser.expression_span(value, span), parser);
            }
        }
    }
}

/// What a name may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantities {
    Measures,
    Columns,
    /// Numbers, of which some are columns; words are unknown there.
    InCharts,
    /// Measures; booleans that are no words are unknown there.
    InCaptions,
}

/// A linkage, and one with the same joints.
struct CheckedLinkage<'a> {
    template: &'a Template,
    structure: &'a Linkage,
    /// Whether the family gives it a load, and a tolerance, which may be ones that cannot be read.
    given: [bool; 2],
}

impl CheckedLinkage<'_> {
    fn check_name(&self, name: &str, quantities: Quantities, span: Span, parser: &mut TomlParser) {
        let measure = find_measure(name);
        let column = measure::find_column(name).map(|column| column.subject);
        let is_boolean = BOOLEANS.iter().any(|boolean| boolean.name == name);
        let measures = quantities != Quantities::Columns;
        let subject = match quantities {
            Quantities::Columns => column,
            Quantities::Measures => measure.map(|measure| measure.subject),
            Quantities::InCaptions => measure.filter(|_| !is_boolean).map(|measure| measure.subject),
            Quantities::InCharts => {
                measure.filter(|measure| !measure.is_word).map(|measure| measure.subject).or(column)
            }
        };
        let [has_load, has_tolerance] = self.given;
        let is_included = |subject: &Subject| match subject {
            Subject::WithLoad if has_load => true,
            Subject::WithTolerance if has_tolerance => true,
            subject => subject.includes(self.structure),
        };
        let Some(subject) = subject.filter(|subject| !is_included(subject)) else { return };
        let id = &self.template.id;
        let message = format!("`{id}` has no `{name}`, which is defined for {} only", subject.description());
        // Only a column has this name.
        let measures = measures && measure.is_some();
        let key = match subject {
            Subject::WithLoad => {
                Some("give the family a load, as in load = { joint = \"C\", force = 100, direction = \"-90 deg\" }")
            }
            Subject::WithTolerance => Some("give the family a tolerance of its lengths, as in tolerance = 0.1"),
            _ => None,
        };
        if let Some(help) = key {
            parser.report(Problem::error(span, message).with_help(help));
            return;
        }
        let of_linkage = if measures { self.own_measures() } else { self.own_columns() };
        let help = match (of_linkage.is_empty(), measures) {
            (true, true) => format!("`{id}` has the measures of a curve, such as `length`"),
            (false, true) => format!(
                "`{id}` has {}, and the measures of a curve, such as `length`: `coupler-atlas list measures` lists them",
                of_linkage.join(", ")
            ),
            (_, false) => format!("`{id}` has {}", of_linkage.join(", ")),
        };
        parser.report(Problem::error(span, message).with_help(help));
    }

    /// The measures that not every linkage has, but this one.
    fn own_measures(&self) -> Vec<&'static str> {
        let is_driven_by_length = self.template.is_driven_by_length();
        let is_own = |subject: Subject| subject != Subject::Any && subject.includes(self.structure);
        let measures = measure::ALL.iter().filter(|measure| is_own(measure.subject));
        measures.map(|measure| measure.name_for(is_driven_by_length)).collect()
    }

    fn own_columns(&self) -> Vec<&'static str> {
        let columns = measure::COLUMNS.iter().filter(|column| column.subject.includes(self.structure));
        columns.map(|column| column.name).collect()
    }
}

/// The measure of a name, which may be that of a boolean.
fn find_measure(name: &str) -> Option<&'static Measure> {
    let measure = BOOLEANS.iter().find(|boolean| boolean.name == name).map_or(name, |boolean| boolean.measure);
    Measure::find(measure)
}

/// Whether the family gives the name itself a value.
fn is_own_name(name: &str, fields: &Fields) -> bool {
    let has_key = |value: &TomlValue| value.get_ref().as_table().is_some_and(|table| table.contains_key(name));
    ["grid", "let"].into_iter().filter_map(|key| fields.get(key)).any(has_key)
        || fields.get("cases").is_some_and(|cases| one_or_more(cases).iter().any(has_key))
}
