//! The table of linkages, and what to relax when there are none.

use std::fmt::Write;

use coupler_find::{Answer, Constraint, Mechanism, Target, format_length as number, format_relative as relative};

use crate::find::description::dimensions;

use super::super::aligned_table::AlignedTable;
use super::Report;
use crate::format::angle;
use coupler_curves::text::pluralize;

/// A table of the answers, each row followed by its dimensions and its cognates.
pub(super) fn text(report: &Report) -> String {
    const HEAD: [(&str, bool); 9] = [
        ("E/S", false),
        ("E", false),
        ("greatest", false),
        ("fit", true),
        ("class", true),
        ("mu worst", false),
        ("longest link", false),
        ("in order", true),
        ("direction", true),
    ];
    let Report { name, target, answers, .. } = report;
    let size = target.size();
    let mut out = describe_target(name, target) + "\n";
    if answers.is_empty() {
        return out + &nothing_found(report);
    }
    let rows: Vec<[String; 9]> = answers.iter().map(|answer| row(answer, size)).collect();
    let table = AlignedTable::new(3, &HEAD, rows.iter().map(|row| &row[..]));
    out += &table.line("", HEAD.map(|(name, _)| name));
    for (k, (answer, row)) in answers.iter().zip(&rows).enumerate() {
        out += &table.line(&(k + 1).to_string(), row);
        let _ = writeln!(out, "     {}", dimensions(&answer.mechanism, |value| number(value, size)));
        let _ = writeln!(out, "     {}", place(&answer.mechanism, size));
        for cognate in &answer.cognates {
            let _ = writeln!(
                out,
                "     cognate, {}: {}",
                summary(cognate),
                dimensions(cognate, |value| number(value, size))
            );
        }
    }
    out
}

/// The path in a few words.
pub(super) fn describe_target(name: &str, target: &Target) -> String {
    let points = pluralize(target.points().len(), "point");
    let timed = if target.angles_deg().is_some() { ", timed" } else { "" };
    format!("{name}: {points}, {}{timed}, S = {}", target.kind().name(), number(target.size(), target.size()))
}

fn row(answer: &Answer, size: f64) -> [String; 9] {
    let mechanism = &answer.mechanism;
    let longest = mechanism.longest_link();
    [
        relative(answer.deviation.rms_relative),
        number(answer.deviation.rms, size),
        number(answer.deviation.greatest, size),
        answer.deviation.quality().name().to_owned(),
        mechanism.class.to_owned(),
        angle(mechanism.mu_worst_deg),
        format!("{} = {:.2} S", number(longest, size), longest / size),
        if answer.deviation.is_in_order { "yes" } else { "no" }.to_owned(),
        mechanism.direction().to_owned(),
    ]
}

/// Where a four-bar is, and how it moves along the path.
pub(super) fn place(mechanism: &Mechanism, size: f64) -> String {
    let [crank, rocker] = mechanism.four_bar.pivots.map(|p| format!("({}, {})", number(p.x, size), number(p.y, size)));
    let [from, to] = mechanism.input_deg.map(angle);
    let rocker_pin = format!("rocker pin on the {}", mechanism.side_name());
    format!("crank pivot {crank}, rocker pivot {rocker}; crank from {from} to {to}, {rocker_pin} at first")
}

/// A cognate in a few words.
fn summary(mechanism: &Mechanism) -> String {
    let constraints = if mechanism.meets_constraints { "" } else { ", outside the constraints" };
    format!("{}, mu worst {}{constraints}", mechanism.class, angle(mechanism.mu_worst_deg))
}

/// The message when no linkage meets the constraints: the nearest one, and what to relax for it.
fn nothing_found(report: &Report) -> String {
    let Some((constraints, answer)) = &report.nearest_miss else {
        return "no linkage was found: no curve in the index is about as long as the path and near it; try --effort thorough, or a \
                larger --index\n"
            .to_owned();
    };
    let size = report.target.size();
    let relax = relaxed(constraints, answer.mechanism.longest_link() / size);
    format!(
        "no linkage meets the constraints; the nearest miss has E = {} ({} S, {}), and is an answer with {relax}:\n     {}\n     {}\n     {}\n",
        number(answer.deviation.rms, size),
        relative(answer.deviation.rms_relative),
        answer.deviation.quality().name(),
        summary(&answer.mechanism),
        dimensions(&answer.mechanism, |value| number(value, size)),
        place(&answer.mechanism, size)
    )
}

/// What to change for the nearest miss, whose longest link is so many sizes of the path long.
pub(super) fn relaxed(constraints: &[Constraint], longest_link: f64) -> String {
    let options = options_of(constraints);
    match constraints {
        [Constraint::MaxLink] => format!("a greater --max-link ({longest_link:.2} or more)"),
        [Constraint::FullTurn] => "--input any".to_owned(),
        [Constraint::Detours] => "--open, which allows detours between the points".to_owned(),
        [_] => format!("another {}", options[0]),
        _ => format!("{} together", options.join(", ")),
    }
}

/// The options that set constraints.
pub(super) fn options_of(constraints: &[Constraint]) -> Vec<&'static str> {
    let option = |constraint: &Constraint| match constraint {
        Constraint::Condition => "--where",
        Constraint::Pivots => "--pivots",
        Constraint::MaxLink => "--max-link",
        Constraint::FullTurn => "--input",
        Constraint::Detours => "--open",
    };
    constraints.iter().map(option).collect()
}
