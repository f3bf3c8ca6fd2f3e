//! A linkage that generates a function, and why others are none, in words.

use coupler_curves::text::pluralize;
use coupler_find::{
    Defect, FunctionAnswer, FunctionFindings, FunctionMethod, FunctionTarget, GeneratorKind, LeftOut, LinkageSpace,
    format_length, format_relative,
};

use crate::notation::Notation;

/// An output with its unit: degrees, or a length.
pub fn linkage_output_in_words(is_length: bool, value: f64) -> String {
    if is_length { format_length(value, 1.0) } else { degrees(value) }
}

/// The same of a linkage in closed form.
pub fn output_in_words(kind: GeneratorKind, value: f64) -> String {
    linkage_output_in_words(kind == GeneratorKind::SliderCrank, value)
}

/// An angle in degrees, to a hundredth.
pub fn degrees(value: f64) -> String {
    // Without the sign of -0.0.
    format!("{:.2}°", (100.0 * value).round() / 100.0 + 0.0)
}

/// An error of an output in three significant digits with its unit; 0 for what is rounding.
pub fn error_value(is_length: bool, value: f64) -> String {
    /// Degrees, or lengths.
    const ROUNDING: f64 = 1e-9;
    let unit = if is_length { "" } else { "°" };
    let shown = if value.abs() < ROUNDING { "0".to_owned() } else { format_relative(value) };
    format!("{shown}{unit}")
}

/// The error of a linkage: "greatest error 0.0827° at input 21.16°, root mean square 0.0581°".
pub fn error_in_words(answer: &FunctionAnswer) -> String {
    let [greatest, rms] = [answer.error.greatest, answer.error.rms]
        .map(|value| error_value(answer.kind == GeneratorKind::SliderCrank, value));
    format!("greatest error {greatest} at input {}, root mean square {rms}", degrees(answer.error.at))
}

/// The dimensions of a linkage in six significant digits.
pub fn dimensions_in_words(answer: &FunctionAnswer) -> String {
    let size = answer.dimensions.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max);
    let shown = answer.dimensions.iter().map(|(name, value)| format!("{name} = {}", format_length(*value, size)));
    shown.collect::<Vec<_>>().join(", ")
}

/// How linkages are found.
pub fn method_in_words(method: FunctionMethod) -> String {
    match method {
        FunctionMethod::Points(count) => format!("{count} precision points"),
        FunctionMethod::LeastSquares => "least squares".to_owned(),
        FunctionMethod::Minimax => "least greatest error".to_owned(),
    }
}

/// What is searched, and how: "four-bars, 5 precision points".
pub fn details_in_words(target: &FunctionTarget, kind: GeneratorKind, method: Option<FunctionMethod>) -> String {
    let kind = match kind {
        GeneratorKind::FourBar => "four-bars",
        GeneratorKind::SliderCrank => "slider-cranks",
    };
    let rows = target.row_count().map(|rows| pluralize(rows, "row"));
    let parts = [rows, Some(kind.to_owned()), method.map(method_in_words)];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// The same of any linkage, with the names of the parameters that are searched.
pub fn linkage_details_in_words(space: &LinkageSpace) -> String {
    let free: Vec<&str> = space.free_names().collect();
    format!("{}, parameters searched: {}", space.template().id, free.join(", "))
}

/// Why so many linkages are left out.
fn left_out_in_words(why: LeftOut, count: usize, notation: Notation) -> String {
    let verb = |one: &str, many: &str| if count == 1 { one.to_owned() } else { many.to_owned() };
    let what = match why {
        LeftOut::Defect(Defect::Branch([a, b])) => {
            format!("{} branch between points {a} and {b}", verb("changes", "change"))
        }
        LeftOut::Defect(Defect::Limit([a, b])) => {
            format!("{} a limit of the input between points {a} and {b}", verb("passes", "pass"))
        }
        LeftOut::Defect(Defect::Turns([a, b])) => {
            format!("{} the other way round between points {a} and {b}", verb("turns its output", "turn their output"))
        }
        LeftOut::Defect(Defect::Range) => {
            format!("{} a limit of the input before the end of its range", verb("has", "have"))
        }
        LeftOut::Imaginary => format!("{} a link of imaginary length", verb("has", "have")),
        LeftOut::Infinite => format!("{} links of infinite length", verb("has", "have")),
        LeftOut::MaxRatio => {
            format!("{} longer links than {} allows", verb("has", "have"), notation.name("max_link"))
        }
        LeftOut::FullTurn => format!("{} a crank that does not turn fully", verb("has", "have")),
        LeftOut::Condition => format!("{} not meet {}", verb("does", "do"), notation.name("where")),
    };
    format!("{count} {what}")
}

/// What is left out, in a line: "of 3 solutions, 2 are left out: 1 changes branch between points 2 and 3, …"; empty if there is nothing to say.
pub fn findings_in_words(findings: &FunctionFindings, notation: Notation) -> String {
    if findings.is_degenerate {
        return "the points do not determine a linkage: their equations depend on each other, as where the output is the input".to_owned();
    }
    let reasons = || {
        let all = findings.left_out.iter().map(|(why, count)| left_out_in_words(*why, *count, notation));
        all.collect::<Vec<_>>().join(", ")
    };
    let left_out: usize = findings.left_out.iter().map(|(_, count)| count).sum();
    match findings.solutions {
        Some(1) if left_out == 1 => format!("the only solution is left out: it {}", reasons().trim_start_matches("1 ")),
        Some(0) => "the points have no real solution".to_owned(),
        Some(all) if left_out > 0 => {
            let are = if left_out == 1 { "is" } else { "are" };
            format!("of {}, {left_out} {are} left out: {}", pluralize(all, "solution"), reasons())
        }
        Some(_) => String::new(),
        None if findings.answers.is_empty() && left_out > 0 => format!("of the nearest linkages, {}", reasons()),
        None => String::new(),
    }
}

/// Why there is no answer.
pub fn none_in_words(findings: &FunctionFindings, notation: Notation) -> String {
    let said = findings_in_words(findings, notation);
    if said.is_empty() { "none can be assembled over the whole range".to_owned() } else { said }
}
