//! Reports measures and columns that the linkage of a family cannot have.

use coupler_curves::expression::{Caption, Expression};
use coupler_curves::linkage_format::{Fields, TomlParser, TomlValue};
use coupler_curves::measure::{self, BOOLEANS, Subject};
use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::{Linkage, Template};

/// Reports each measure and column that a family names and its linkage cannot have: in `measures`, `columns`, `where`,
/// `sort`, `caption`, `note` and `chart`.
///
/// Expressions that cannot be parsed are reported elsewhere.
pub(crate) fn check(template: &Template, fields: &Fields, parser: &mut TomlParser) {
    // What is wrong with the joints is reported with the linkage.
    let Ok(structure) = template.structure() else { return };
    let linkage = CheckedLinkage { template, structure: &structure };
    for (key, quantities) in [("measures", Quantities::Measures), ("columns", Quantities::Columns)] {
        for item in fields.get(key).map_or(&[][..], items) {
            linkage.check_name(item.get_ref().as_str().unwrap_or_default(), quantities, item.span(), parser);
        }
    }
    let mut check_expression = |text: &str, quantities: Quantities, span: Span| {
        let expression = Expression::parse(text).ok();
        for name in expression.iter().flat_map(Expression::names).filter(|name| !is_own_name(name, fields)) {
            linkage.check_name(name, quantities, span.clone(), parser);
        }
    };
    for value in ["where", "sort"].into_iter().filter_map(|key| fields.get(key)) {
        check_expression(value.get_ref().as_str().unwrap_or_default(), Quantities::Measures, value.span());
    }
    let chart = fields.get("chart").and_then(|value| value.get_ref().as_table());
    for value in ["x", "y"].into_iter().filter_map(|key| chart?.get(key)) {
        for item in items(value) {
            check_expression(item.get_ref().as_str().unwrap_or_default(), Quantities::MeasuresAndColumns, item.span());
        }
    }
    for value in ["caption", "note"].into_iter().filter_map(|key| fields.get(key)) {
        let Ok(caption) = Caption::parse(value.get_ref().as_str().unwrap_or_default()) else { continue };
        for name in caption.expressions().flat_map(|(expression, _)| expression.names()) {
            if !is_own_name(name, fields) {
                linkage.check_name(name, Quantities::Measures, value.span(), parser);
            }
        }
    }
}

/// What a name may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantities {
    Measures,
    Columns,
    MeasuresAndColumns,
}

/// A linkage, and one with the same joints.
struct CheckedLinkage<'a> {
    template: &'a Template,
    structure: &'a Linkage,
}

impl CheckedLinkage<'_> {
    fn check_name(&self, name: &str, quantities: Quantities, span: Span, parser: &mut TomlParser) {
        let (measures, columns) = (quantities != Quantities::Columns, quantities != Quantities::Measures);
        let subject = measure_subject(name).filter(|_| measures).or_else(|| column_subject(name).filter(|_| columns));
        let Some(subject) = subject.filter(|subject| !subject.includes(self.structure)) else { return };
        let id = &self.template.id;
        let message = format!("`{id}` has no `{name}`, which is defined for {} only", subject.description());
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

/// The linkages that have the measure or the boolean of a name.
fn measure_subject(name: &str) -> Option<Subject> {
    let measure = BOOLEANS.iter().find(|boolean| boolean.name == name).map_or(name, |boolean| boolean.measure);
    measure::ALL.iter().find(|m| m.name == measure || m.length_name == Some(measure)).map(|measure| measure.subject)
}

/// The linkages that have the column of a name.
fn column_subject(name: &str) -> Option<Subject> {
    measure::find_column(name).map(|column| column.subject)
}

/// Whether the family gives the name itself a value.
fn is_own_name(name: &str, fields: &Fields) -> bool {
    let has_key = |value: &TomlValue| value.get_ref().as_table().is_some_and(|table| table.contains_key(name));
    ["grid", "let"].into_iter().filter_map(|key| fields.get(key)).any(has_key)
        || fields.get("cases").is_some_and(|cases| items(cases).iter().any(has_key))
}

/// The items of a list, or the value itself if it is not a list.
fn items<'v, 't>(value: &'v TomlValue<'t>) -> &'v [TomlValue<'t>] {
    value.get_ref().as_array().map_or(std::slice::from_ref(value), |list| &list[..])
}
