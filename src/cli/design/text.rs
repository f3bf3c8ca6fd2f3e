use std::fmt::Write;

use coupler_atlas::design::{
    Design, DrivenLinkage, Driver, LinkageKind, ProportionOrigin, RejectedLinkage, Relaxation, Requirement,
};

use super::trade_offs::{format_ratio, trade_offs};
use super::{Report, option_name};

/// A number to read, with so many significant digits.
pub(super) fn format_significant(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    match rounded {
        0.0 => "0".to_owned(),
        x if x.is_finite() && !(1e-5..1e7).contains(&x.abs()) => format!("{x:e}"),
        x => x.to_string(),
    }
}

/// For people: a table, under each row its proportions and its trade-offs, and what is left out.
pub(super) fn text(report: &Report) -> String {
    const HEAD: [&str; 10] =
        ["linkage", "straight", "deviation", "input", "mu min", "size", "out:back", "speed", "class", "driven by"];
    let designs = &report.results.designs;
    let rows: Vec<[String; 10]> = designs.iter().map(row).collect();
    let widths: Vec<usize> = (0..HEAD.len())
        .map(|k| rows.iter().map(|row| row[k].chars().count()).chain([HEAD[k].len()]).max().unwrap_or(0))
        .collect();
    let line = |number: &str, cells: &[&str]| {
        let mut line = format!("{number:>2}");
        for (k, (cell, width)) in cells.iter().zip(&widths).enumerate() {
            // Words stand left, numbers right.
            let pad = " ".repeat(width - cell.chars().count());
            line += &if matches!(k, 0 | 8 | 9) { format!("  {cell}{pad}") } else { format!("  {pad}{cell}") };
        }
        format!("{}\n", line.trim_end())
    };
    let mut out = line("", &HEAD);
    for (k, (design, row)) in designs.iter().zip(&rows).enumerate() {
        out += &line(&(k + 1).to_string(), &row.each_ref().map(String::as_str));
        // Writing to a string cannot fail.
        let _ = writeln!(out, "    {} ({})", proportions(design), origin(design));
        let _ = writeln!(out, "    {}", trade_offs(designs, k));
    }
    out + &left_out(&report.results.rejected)
}

fn row(design: &Design) -> [String; 10] {
    let figures = &design.performance;
    [
        design.driven_linkage.kind.id().to_owned(),
        format_significant(design.straight.length, 5),
        format_significant(design.straight.deviation, 3),
        format!("{:.1}°", design.swing),
        format!("{:.1}°", figures.mu_min),
        format_significant(figures.size, 5),
        design.time_ratio().map_or("1:1".to_owned(), |time| format!("1:{}", format_ratio(1.0 / time))),
        format_ratio(design.speed_ratio),
        design.class.to_owned(),
        driver(design),
    ]
}

fn driver(design: &Design) -> String {
    let by = match design.driven_linkage.input {
        Driver::Motor => "motor on the ",
        Driver::Rocker => "",
    };
    format!("{by}{}", design.performance.input_link.name())
}

/// The parameters of a design, those that follow from others too.
pub(super) fn proportions(design: &Design) -> String {
    let parameters = design.family.template.parameters.iter();
    let values = parameters
        .map(|parameter| format!("{} = {}", parameter.name, format_significant(design.parameter(&parameter.name), 6)));
    values.collect::<Vec<_>>().join(", ")
}

fn origin(design: &Design) -> String {
    match design.origin {
        ProportionOrigin::Search => "searched".to_owned(),
        ProportionOrigin::ClosedCondition => format!("by {}", design.driven_linkage.kind.closed_condition()),
    }
}

fn arrangement_name(arrangement: DrivenLinkage) -> String {
    match arrangement {
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Motor } => {
            "chebyshev by a motor on its coupler".to_owned()
        }
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Rocker } => "chebyshev by a rocker".to_owned(),
        DrivenLinkage { kind, .. } => kind.id().to_owned(),
    }
}

/// A sentence for each that is left out; those left out for one reason together.
fn left_out(all: &[RejectedLinkage]) -> String {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for one in all {
        let condition = if one.is_closed_form {
            format!(" by {}", one.driven_linkage.kind.closed_condition())
        } else {
            String::new()
        };
        let name = format!("{}{condition}", arrangement_name(one.driven_linkage));
        match reasons.iter_mut().find(|(why, _)| *why == one.reason) {
            Some((_, names)) => names.push(name),
            None => reasons.push((&one.reason, vec![name])),
        }
    }
    reasons.iter().map(|(why, names)| format!("left out: {}: {why}\n", names.join(", "))).collect()
}

/// Where nothing meets the wishes: what is left out, and what each wish would have to be.
pub(super) fn no_design_message(report: &Report) -> String {
    let found = &report.results;
    let mut out = "nothing meets these wishes\n".to_owned();
    out += &left_out(&found.rejected);
    for relaxation in &found.relaxations {
        out += &format!("hint: {}\n", hint(report, relaxation));
    }
    if found.relaxations.is_empty() {
        out += "hint: no one of the wishes is to blame alone; relax two of them\n";
    }
    out.trim_end().to_owned()
}

/// "with --mu-min 38.2 instead of 45, evans meets the rest: p = …".
fn hint(report: &Report, relaxation: &Relaxation) -> String {
    let Relaxation { requirement: wish, value: to, design } = relaxation;
    let wishes = &report.requirements;
    let by_deviation = *wish == Requirement::Tolerance && report.is_deviation_given;
    let half = wishes.length.unwrap_or(1.0) / 2.0;
    let (option, unit) = if by_deviation { ("--deviation", half) } else { (option_name(*wish), 1.0) };
    let asked = match wish {
        Requirement::P => wishes.p,
        Requirement::Length => wishes.length,
        Requirement::Tolerance => Some(wishes.tolerance),
        Requirement::Size => wishes.size,
        Requirement::MuMin => Some(wishes.mu_min),
        Requirement::Input | Requirement::DoublePoint | Requirement::QuickReturn | Requirement::Kinds => None,
    };
    let change = match (to, asked) {
        (Some(to), Some(asked)) => {
            format!(
                "with {option} {} instead of {}",
                format_significant(to * unit, 6),
                format_significant(asked * unit, 6)
            )
        }
        _ => format!("without {option}"),
    };
    format!("{change}, {} meets the rest: {}", arrangement_name(design.driven_linkage), proportions(design))
}
