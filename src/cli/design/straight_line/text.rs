//! The table of designs, and the message when there are none.

use std::fmt::Write;

use crate::design::{
    Design, DrivenLinkage, Driver, LinkageKind, ProportionOrigin, RejectedLinkage, Relaxation, Requirement,
};

use super::super::super::aligned_table::AlignedTable;
use super::format::{format_ratio, proportions};
use super::report::{Report, option_name};
use super::trade_offs::trade_offs;
use crate::format::format_significant;

/// A table of the designs, each row followed by its proportions and trade-offs, then the rejected linkages.
pub(super) fn text(report: &Report) -> String {
    const HEAD: [(&str, bool); 10] = [
        ("linkage", true),
        ("straight", false),
        ("deviation", false),
        ("input", false),
        ("mu min", false),
        ("size", false),
        ("out:back", false),
        ("speed", false),
        ("class", true),
        ("driven by", true),
    ];
    let designs = &report.results.designs;
    let rows: Vec<[String; 10]> = designs.iter().map(row).collect();
    let table = AlignedTable::new(2, &HEAD, rows.iter().map(|row| &row[..]));
    let mut out = table.line("", HEAD.map(|(name, _)| name));
    for (k, (design, row)) in designs.iter().zip(&rows).enumerate() {
        out += &table.line(&(k + 1).to_string(), row);
        // Writing to a string cannot fail.
        let _ = writeln!(out, "    {} ({})", proportions(design), origin(design));
        let _ = writeln!(out, "    {}", trade_offs(designs, k));
    }
    out + &describe_rejected(&report.results.rejected)
}

fn row(design: &Design) -> [String; 10] {
    let performance = &design.performance;
    [
        design.driven_linkage.kind.id().to_owned(),
        format_significant(design.straight.length, 5),
        format_significant(design.straight.deviation, 3),
        format!("{:.1}°", design.swing),
        format!("{:.1}°", performance.mu_min),
        format_significant(performance.size, 5),
        design.time_ratio().map_or("1:1".to_owned(), |time| format!("1:{}", format_ratio(1.0 / time))),
        format_ratio(design.speed_ratio),
        design.class.to_owned(),
        driver(design),
    ]
}

fn driver(design: &Design) -> String {
    let prefix = match design.driven_linkage.input {
        Driver::Motor => "motor on the ",
        Driver::Rocker => "",
    };
    format!("{prefix}{}", design.performance.input_link.name())
}

fn origin(design: &Design) -> String {
    match design.origin {
        ProportionOrigin::Search => "searched".to_owned(),
        ProportionOrigin::ClosedCondition => format!("by {}", design.driven_linkage.kind.closed_condition()),
    }
}

fn driven_linkage_name(driven_linkage: DrivenLinkage) -> String {
    match driven_linkage {
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Motor } => {
            "chebyshev by a motor on its coupler".to_owned()
        }
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Rocker } => "chebyshev by a rocker".to_owned(),
        DrivenLinkage { kind, .. } => kind.id().to_owned(),
    }
}

/// One line for each reason, with the linkages that were rejected for it.
fn describe_rejected(rejected_linkages: &[RejectedLinkage]) -> String {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for rejected in rejected_linkages {
        let condition = if rejected.is_closed_form {
            format!(" by {}", rejected.driven_linkage.kind.closed_condition())
        } else {
            String::new()
        };
        let name = format!("{}{condition}", driven_linkage_name(rejected.driven_linkage));
        match reasons.iter_mut().find(|(reason, _)| *reason == rejected.reason) {
            Some((_, names)) => names.push(name),
            None => reasons.push((&rejected.reason, vec![name])),
        }
    }
    reasons.iter().map(|(reason, names)| format!("left out: {}: {reason}\n", names.join(", "))).collect()
}

/// The message when no design meets the requirements: the rejected linkages, and how each requirement could be relaxed.
pub(super) fn no_design_message(report: &Report) -> String {
    let results = &report.results;
    let mut out = "no linkage meets these requirements\n".to_owned();
    out += &describe_rejected(&results.rejected);
    for relaxation in &results.relaxations {
        out += &format!("hint: {}\n", hint(report, relaxation));
    }
    if results.relaxations.is_empty() {
        out += "hint: relaxing one requirement is not enough; relax two of them\n";
    }
    out.trim_end().to_owned()
}

/// "with --mu-min 38.2 instead of 45, evans meets the other requirements: p = …".
fn hint(report: &Report, relaxation: &Relaxation) -> String {
    let Relaxation { requirement, value: relaxed, design } = relaxation;
    let requirements = &report.requirements;
    let is_deviation = *requirement == Requirement::Tolerance && report.is_deviation_given;
    let half_length = requirements.length.unwrap_or(1.0) / 2.0;
    let (option, factor) = if is_deviation { ("--deviation", half_length) } else { (option_name(*requirement), 1.0) };
    let given = match requirement {
        Requirement::P => requirements.p,
        Requirement::Length => requirements.length,
        Requirement::Tolerance => Some(requirements.tolerance),
        Requirement::Size => requirements.size,
        Requirement::MuMin => Some(requirements.mu_min),
        Requirement::Input | Requirement::DoublePoint | Requirement::QuickReturn | Requirement::Kinds => None,
    };
    let change = match (relaxed, given) {
        (Some(relaxed), Some(given)) => {
            format!(
                "with {option} {} instead of {}",
                format_significant(relaxed * factor, 6),
                format_significant(given * factor, 6)
            )
        }
        _ => format!("without {option}"),
    };
    let name = driven_linkage_name(design.driven_linkage);
    format!("{change}, {name} meets the other requirements: {}", proportions(design))
}
