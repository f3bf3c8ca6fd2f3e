//! The quantities of charts in words: titles and units of names, and expressions as formulas of titles.

use coupler_curves::expression::{CompiledExpression, MathText, PostfixToken, Unit, displayed_name};
use coupler_curves::measure::{self, Measure};
use coupler_curves::template::{Parameter, ParameterKind, Template};

/// The titles of the values of a sample other than the columns, by their names.
const SAMPLE_TITLES: [(&str, &str); 5] = [
    ("x", "x of the point"),
    ("y", "y of the point"),
    ("input_deg", "input angle of the crank"),
    ("input_length", "length of the actuator"),
    ("arc", "length along the curve"),
];

/// The title of a name of [`super::scope`] that is not one of the family's own.
fn title_of_name(name: &str) -> Option<&'static str> {
    let sample = || SAMPLE_TITLES.iter().find(|(known, _)| *known == name).map(|(_, title)| *title);
    let column = || measure::find_column(name).map(|column| column.title);
    Measure::find(name).map(|measure| measure.title).or_else(column).or_else(sample)
}

/// The title of an expression over [`super::scope`] with a family's names, of a linkage: that of its measure, or a
/// formula of titles.
pub fn title(expression: &CompiledExpression, names: &[String], template: &Template) -> String {
    let scope = super::scope(names, template.is_driven_by_length());
    let word = |slot: usize| match names.get(slot) {
        Some(name) => MathText::from_name(name),
        None => {
            let name = scope.names().nth(slot).unwrap_or_default();
            title_of_name(name).map_or_else(|| MathText::from_name(name), MathText::from_words)
        }
    };
    expression.to_math_text_with(word).to_string()
}

/// The unit of an expression that is only a name; empty for any other, for lengths and for pure numbers.
pub fn unit(expression: &CompiledExpression, names: &[String], template: &Template) -> &'static str {
    let [PostfixToken::Name(slot)] = expression.postfix().collect::<Vec<_>>()[..] else { return "" };
    if slot < names.len() {
        return template.parameters.get(slot).map_or("", parameter_unit);
    }
    let is_driven_by_length = template.is_driven_by_length();
    let scope = super::scope(names, is_driven_by_length);
    let Some(name) = scope.names().nth(slot) else { return "" };
    let measure = || Measure::find(name).filter(|measure| measure.name == name).map(|measure| measure.unit);
    let column = measure::find_column(name).map(|column| column.unit);
    // The derivatives with respect to a length have the units of other quantities.
    let column = column.filter(|unit| *unit == "deg" || !is_driven_by_length);
    let sample = if name == "input_deg" { "deg" } else { "" };
    measure().or(column).unwrap_or(sample)
}

/// The unit of a parameter: `deg`, `rad` or none.
pub fn parameter_unit(parameter: &Parameter) -> &'static str {
    match parameter.kind {
        ParameterKind::Angle(Unit::Rad) => "rad",
        ParameterKind::Angle(_) => "deg",
        _ => "",
    }
}

/// What the curve of the n-th traced joint, from 1, is called, in two parts: by the joint, "path of" and its name; or by the number of its point,
/// "point" and that, if another traced joint has its name, as all points of a grid have.
pub(crate) fn curve_name<'n>(mut traced: impl Iterator<Item = &'n str> + Clone, trace: usize) -> [String; 2] {
    let all = traced.clone();
    let name = traced.nth(trace.saturating_sub(1)).unwrap_or_default();
    match all.filter(|other| *other == name).count() {
        1 => ["path of".to_owned(), displayed_name(name)],
        _ => point_name(trace),
    }
}

/// What the curve of a point with a number is called, in the same two parts.
pub(crate) fn point_name(trace: usize) -> [String; 2] {
    ["point".to_owned(), trace.to_string()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::catalogue;
    use coupler_curves::expression::{Expression, Kind};

    fn words(text: &str) -> (String, &'static str) {
        let template = catalogue::find("hoeken").unwrap();
        let names = ["p".to_owned(), "a".to_owned(), "crank_angle".to_owned()];
        let scope = super::super::scope(&names, false);
        let expression = Expression::parse(text).unwrap().compile(&scope, Kind::Number).unwrap();
        (title(&expression, &names, &template), unit(&expression, &names, &template))
    }

    #[test]
    fn names_have_titles_and_units() {
        let expected = [
            ("mu_worst_deg", "worst transmission angle", "deg"),
            ("straight_length", "length of the straight portion", ""),
            ("input_deg", "input angle of the crank", "deg"),
            ("speed", "speed", "per radian"),
            ("psi_deg", "output angle", "deg"),
            ("crank_angle", "crank angle", ""),
            ("p", "p", ""),
        ];
        for (text, title, unit) in expected {
            assert_eq!(words(text), (title.to_owned(), unit), "{text}");
        }
    }

    #[test]
    fn expressions_are_formulas_of_titles() {
        let expected = [
            (
                "straight_length / straight_deviation",
                "length of the straight portion / deviation of the straight portion",
            ),
            ("(bbox_x_max - bbox_x_min) / p", "(greatest x of the curve − least x of the curve) / p"),
            ("p - (a - 2)", "p − (a − 2)"),
            ("(p - a) - 2", "p − a − 2"),
            ("p - (a + 2)", "p − (a + 2)"),
            ("p / (a * 2)", "p / (a · 2)"),
            ("p * (a / 2)", "p a / 2"),
            ("-p * -a", "−p · (−a)"),
            ("-(p + a)", "−(p + a)"),
            ("2^-1", "2^−1"),
            ("(1 + p)^1.5 / 2", "(1 + p)^1.5 / 2"),
            ("p^2 + length^2", "p^2 + (length of the curve)^2"),
            ("(p^2)^a", "(p^2)^a"),
            ("(-p)^2", "(−p)^2"),
            ("sqrt(p) + atan2(a, pi)", "√p + atan2(a, π)"),
            ("max(p - 1, a)", "max(p − 1, a)"),
        ];
        for (text, printed) in expected {
            assert_eq!(words(text).0, printed, "{text}");
        }
    }

    /// No title is an identifier, and every name has one.
    #[test]
    fn every_name_has_a_title() {
        for is_driven_by_length in [false, true] {
            for name in super::super::scope(&[], is_driven_by_length).names() {
                let is_condition = measure::BOOLEANS.iter().any(|boolean| boolean.name == name);
                let title = title_of_name(name);
                assert!(is_condition || title.is_some_and(|title| !title.contains('_')), "{name}: {title:?}");
            }
        }
    }
}
