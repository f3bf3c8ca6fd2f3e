//! The table of linkages that generate a function.

use std::fmt::Write;

use crate::find::Notation;
use crate::find::function::FunctionAttempt;
use crate::find::function::words::{
    degrees, dimensions_in_words, error_value, findings_in_words, method_in_words, none_in_words, output_in_words,
};
use coupler_curves::geometry::trig;
use coupler_find::{FunctionAnswer, FunctionMethod, GeneratorKind, format_length};

use super::report::FunctionReport;
use crate::format::angle;

/// A table of the answers, each row followed by the dimensions and the places of the linkage; and what is left out.
pub(super) fn text(report: &FunctionReport) -> String {
    const HEAD: [&str; 6] = ["greatest error", "at input", "rms", "class", "mu worst", "longest/shortest"];
    let mut out = format!("{}: {}\n", report.name, report.details());
    let answers = report.answers();
    let rows: Vec<[String; 6]> = answers.iter().map(row).collect();
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).chain([HEAD[k].len()]).max().unwrap_or(0);
    let line = |rank: &str, cells: &[&str]| {
        let mut line = format!("{rank:>3}");
        for (k, cell) in cells.iter().enumerate() {
            let pad = " ".repeat(width(k) - cell.chars().count());
            // Words are aligned left, numbers right.
            line += &if k == 3 { format!("  {cell}{pad}") } else { format!("  {pad}{cell}") };
        }
        format!("{}\n", line.trim_end())
    };
    if !answers.is_empty() {
        out += &line("", &HEAD);
    }
    for (k, (answer, row)) in answers.iter().zip(&rows).enumerate() {
        out += &line(&(k + 1).to_string(), &row.each_ref().map(String::as_str));
        let _ = writeln!(out, "     {}", dimensions_in_words(answer));
        let _ = writeln!(out, "     {}{}", motion(answer), opposite(report, answer));
        out += &zeros(report, answer);
    }
    let Some(last) = report.attempts.last() else { return out };
    if answers.is_empty() {
        let why = none_in_words(&last.findings, Notation::CommandLine);
        out += &format!("no linkage was found: {why}{}\n", remedy(report, last.method));
        return out;
    }
    let said = findings_in_words(&last.findings, Notation::CommandLine);
    if !said.is_empty() {
        out += &format!("{said}\n");
    }
    out
}

fn row(answer: &FunctionAnswer) -> [String; 6] {
    let is_length = answer.kind == GeneratorKind::SliderCrank;
    [
        error_value(is_length, answer.error.greatest),
        degrees(answer.error.at),
        error_value(is_length, answer.error.rms),
        answer.class.to_owned(),
        angle(answer.mu_worst_deg),
        format!("{:.2}", answer.ratio),
    ]
}

/// How a linkage moves.
fn motion(answer: &FunctionAnswer) -> String {
    let [from, to] = answer.input_deg.map(degrees);
    let [first, last] = answer.output.map(|output| output_in_words(answer.kind, output));
    let side = match answer.kind {
        GeneratorKind::FourBar => format!("rocker pin on the {}", answer.side),
        GeneratorKind::SliderCrank => format!("slider {}", answer.side),
    };
    format!("input from {from} to {to}, output wanted from {first} to {last}; {side}")
}

/// Which links point the opposite way of what is given, as links of negative length do.
fn opposite(report: &FunctionReport, answer: &FunctionAnswer) -> String {
    let is_opposite = |given: Option<f64>, start: f64| given.is_some_and(|given| (start - given).abs() > 90.0);
    let options = &report.options;
    let crank = is_opposite(options.input_start_deg, answer.input_deg[0]);
    let rocker = is_opposite(options.output_start, answer.output[0]) && answer.kind == GeneratorKind::FourBar;
    match (crank, rocker) {
        (false, false) => String::new(),
        (true, false) => "; the crank points the opposite way of --input-start".to_owned(),
        (false, true) => "; the rocker points the opposite way of --output-start".to_owned(),
        (true, true) => "; crank and rocker point the opposite way of their starts".to_owned(),
    }
}

/// Where a linkage has no error.
fn zeros(report: &FunctionReport, answer: &FunctionAnswer) -> String {
    let Some(law) = report.target.as_law() else { return String::new() };
    if answer.error.zeros.is_empty() {
        return String::new();
    }
    let zero = |input: &f64| format_length(law.x_at(trig::radians(input - answer.input_deg[0])), 1.0);
    let zeros: Vec<String> = answer.error.zeros.iter().map(zero).collect();
    format!("     no error at {} = {}\n", law.variable(), zeros.join(", "))
}

/// What may help where precision points have no answer.
fn remedy(report: &FunctionReport, method: FunctionMethod) -> String {
    let FunctionMethod::Points(count) = method else { return String::new() };
    let options = &report.options;
    let mut remedies = Vec::new();
    if report.target.as_law().is_some() && options.input_start_deg.or(options.output_start).is_some() {
        remedies.push("other starts, or none");
    }
    if report.target.as_law().is_some() && count > 3 {
        remedies.push("fewer --points");
    }
    remedies.push("--fit least-squares");
    format!("; what may help: {}", remedies.join(", "))
}

/// A note on a method that had no answer, before another one.
pub(super) fn tried(attempt: &FunctionAttempt, next: FunctionMethod) -> String {
    let said = findings_in_words(&attempt.findings, Notation::CommandLine);
    let why = if said.is_empty() { "no linkage reaches them".to_owned() } else { said };
    format!("note: {} have no answer, {why}; so {} are taken\n", method_in_words(attempt.method), method_in_words(next))
}

/// A note on the zero of a table's few rows, whose starts are searched though their numbers may be those of the linkage.
pub(super) fn any_zero(report: &FunctionReport) -> String {
    let FunctionReport { first, options, attempts, .. } = report;
    let are_searched = options.input_start_deg.is_none() && options.output_start.is_none();
    let is_of_points = attempts.iter().any(|attempt| matches!(attempt.method, FunctionMethod::Points(..5)));
    match first {
        Some([input, output]) if are_searched && is_of_points => format!(
            "note: the rows count from any zero, and the starts are searched; as they are: --input-start={input} --output-start={output}\n"
        ),
        _ => String::new(),
    }
}
