//! The table of linkages with their dimensions.

use std::fmt::Write;

use crate::find::description::{branch, deviation, parameters, placement};
use crate::find::{Findings, simplest};
use coupler_find::{LinkageAnswer, format_length as number, format_relative as relative};

use super::super::text::{describe_target, relaxed};
use super::LinkageReport;
use crate::format::angle;
use coupler_curves::text::pluralize;

/// The answers, each with its dimensions and its place.
pub(super) fn text(report: &LinkageReport) -> String {
    let LinkageReport { name, target, linkage, searched, findings, .. } = report;
    let Findings { curves, answers, nearest_miss } = findings;
    let size = target.size();
    let free = searched.as_ref().map(|free| {
        let count = pluralize(free.len(), "parameter");
        format!(", {count} searched: {}", free.join(", "))
    });
    let mut out = format!(
        "{}; {linkage}{}; {}\n",
        describe_target(name, target),
        free.unwrap_or_default(),
        pluralize(*curves, "curve")
    );
    let is_one = searched.is_some();
    if !is_one && !answers.is_empty() {
        let fits = simplest(answers).into_iter().map(|answer| {
            let part = relative(answer.curve.fit.deviation.rms_relative);
            format!("{} to {part} S", answer.family.template.id)
        });
        let _ = writeln!(out, "the simplest first: {}", fits.collect::<Vec<_>>().join(", "));
    }
    for (rank, answer) in (1..).zip(answers) {
        out += &entry(&rank.to_string(), answer, is_one, size);
    }
    if !answers.is_empty() {
        return out;
    }
    let Some((constraints, answer)) = nearest_miss else {
        return out
            + "no linkage was found: no curve is about as long as the path and near it; try --effort thorough, or a larger --index\n";
    };
    let relax = relaxed(constraints, answer.curve.longest_link / size);
    let _ = writeln!(out, "no linkage meets the constraints; the nearest miss is an answer with {relax}:");
    out + &entry("-", answer, is_one, size)
}

/// An answer; it names its linkage unless that is the only one.
fn entry(rank: &str, answer: &LinkageAnswer, is_one: bool, size: f64) -> String {
    let template = &answer.family.template;
    let own = if is_one { String::new() } else { format!("{}, ", template.id) };
    let curve = &answer.curve;
    let fit = &curve.fit;
    let [trace, circuit] = curve.numbers;
    let class = if curve.class.is_empty() { String::new() } else { format!(", {}", curve.class) };
    let mu = if curve.mu_worst_deg.is_finite() {
        format!(", mu worst {}", angle(curve.mu_worst_deg))
    } else {
        String::new()
    };
    let order = if fit.deviation.is_in_order { "in order" } else { "not in order" };
    let mut out = format!(
        "{rank:>3}  {own}{}, greatest {}, {order}, {}{class}{mu}, longest link {} = {:.2} S\n     {}\n",
        deviation(&fit.deviation, size),
        number(fit.deviation.greatest, size),
        if fit.is_reversed { "backward" } else { "forward" },
        number(curve.longest_link, size),
        curve.longest_link / size,
        parameters(template, curve, size)
    );
    let pivots: Vec<String> =
        curve.pivots.iter().map(|(name, p)| format!("{name} ({}, {})", number(p.x, size), number(p.y, size))).collect();
    let pivots = if pivots.is_empty() { String::new() } else { format!("pivots {}; ", pivots.join(", ")) };
    let is_length = template.is_driven_by_length();
    let [from, to] = answer.inputs.map(|input| if is_length { number(input, input.abs()) } else { angle(input) });
    let _ = writeln!(
        out,
        "     {} (trace {trace}) on circuit {circuit}, branch {} at first, input from {from} to {to}",
        curve.joint,
        branch(answer)
    );
    let _ = writeln!(out, "     {pivots}{}", placement(curve, size));
    out
}
