//! The linkages that guide a body, in words.

use std::fmt::Write;

use coupler_curves::geometry::{Point, trig};
use coupler_curves::text::pluralize;
use coupler_find::{
    Freedom, Guide, PairLeftOut, PlacedDyad, PoseAnswer, PoseFindings, PoseSet, format_length as number,
    format_relative as relative,
};

use super::report::{PoseReport, options_of};
use crate::find::Relaxed;
use crate::format::angle;

/// The answers, each with its dimensions and its place; then what was left out.
pub(super) fn text(report: &PoseReport) -> String {
    let PoseReport { name, poses, found, .. } = report;
    let findings = &found.findings;
    let size = poses.size();
    let count = poses.poses().len();
    let mut out = format!(
        "{name}: {}, S = {}; {}; {} of a crank and another dyad, {} shown\n",
        pluralize(count, "pose"),
        number(size, size),
        dyad_count(findings),
        pluralize(findings.pairs, "pair"),
        pluralize(findings.answers.len(), "linkage")
    );
    for (rank, answer) in (1..).zip(&findings.answers) {
        out += &entry(&rank.to_string(), answer, poses);
    }
    if findings.freedom == Freedom::Points {
        for (k, dyad) in (1..).zip(&findings.dyads) {
            let _ = writeln!(out, "     dyad {k}: {}", describe_dyad(dyad, size));
        }
    }
    out += &left_out(findings);
    if findings.answers.is_empty() {
        out += &nothing_found(found.relaxed.as_ref(), poses);
    }
    out
}

fn dyad_count(findings: &PoseFindings) -> String {
    match (findings.freedom, findings.dyads.len()) {
        (Freedom::Points, 0) => "no real dyad".to_owned(),
        (Freedom::Points, count) => pluralize(count, "dyad"),
        (Freedom::None, count) => format!("{} near them", pluralize(count, "dyad")),
        (freedom, count) => format!("{}: {}", freedom.description(), pluralize(count, "sample")),
    }
}

fn point(p: &Point, size: f64) -> String {
    format!("({}, {})", number(p.x, size), number(p.y, size))
}

fn describe_dyad(dyad: &PlacedDyad, size: f64) -> String {
    let [pivot, pin] = [dyad.pivot, dyad.pin].map(|place| place.map_or(String::new(), |p| point(&p, size)));
    match dyad.line_deg.map(angle) {
        None => format!("pivot {pivot}, pin {pin} at pose 1"),
        Some(line) if dyad.pivot.is_none() => format!("slider on a line at {line}, pin {pin} at pose 1"),
        Some(line) => format!("slot on a block, pivot {pivot}, its line at {line} at pose 1"),
    }
}

fn entry(rank: &str, answer: &PoseAnswer, poses: &PoseSet) -> String {
    let size = poses.size();
    let count = poses.poses().len();
    let class = if answer.class.is_empty() { String::new() } else { format!(", {}", answer.class) };
    let [at_poses, worst] = answer.mu_worst_deg;
    let span = if answer.on_one_branch && answer.in_order {
        format!("from pose 1 to {count}")
    } else {
        "at the poses".to_owned()
    };
    let on_circuit = if worst.is_finite() { format!(", {} on the circuit", angle(worst)) } else { String::new() };
    let error = answer.greatest_error();
    let rms = answer.rms(size);
    let mut notes = String::new();
    if !answer.in_order && answer.on_one_branch {
        notes += ", in another order";
    }
    if !answer.on_one_branch {
        notes += ", on several branches or circuits";
    }
    let turn = if answer.is_full_turn { "turns fully" } else { "does not turn fully" };
    let mut out = format!(
        "{rank:>3}  {}{class}, mu worst {} {span}{on_circuit}, longest link {} = {:.2} S{notes}\n     E = {} S, greatest error {} and {}°\n",
        answer.guide.name(),
        angle(at_poses),
        number(answer.longest_link, size),
        answer.longest_link / size,
        relative(rms / size),
        error_text(error.distance, size),
        error_text(error.angle_deg, 1.0),
    );
    let place = ["x", "y", "turn"];
    let values = answer.guide.parameters().into_iter().filter(|(name, _)| !place.contains(name));
    let values: Vec<String> = values.map(|(name, value)| format!("{name} = {}", number(value, size))).collect();
    let _ = writeln!(out, "     {}", values.join(", "));
    let [a, b] = answer.pins[0];
    let (fixed, other) = match &answer.guide {
        Guide::FourBar(four_bar) => {
            let [crank, rocker] = four_bar.pivots.map(|p| point(&p, size));
            let side = if answer.branch > 0 { "left" } else { "right" };
            (
                format!("crank pivot {crank}, rocker pivot {rocker}"),
                format!("rocker pin {}, on the {side}", point(&b, size)),
            )
        }
        Guide::SliderCrank(slider) => {
            let line = angle(slider.turn_deg);
            (
                format!("crank pivot {}, slider's line at {line}", point(&slider.pivot, size)),
                format!("slider {}", point(&b, size)),
            )
        }
        Guide::InvertedSliderCrank(inverted) => {
            let [crank, block] = inverted.pivots.map(|p| point(&p, size));
            let from_crank = angle(trig::degrees(trig::atan2(b.y - a.y, b.x - a.x)));
            (format!("crank pivot {crank}, block pivot {block}"), format!("coupler's line at {from_crank}"))
        }
    };
    let _ = writeln!(out, "     {fixed}; at pose 1 crank pin {}, {other}", point(&a, size));
    // Of many poses the first and the last.
    const SHOWN: usize = 8;
    let inputs: Vec<String> = answer.inputs_deg.iter().map(|input| angle(*input)).collect();
    let inputs = match &inputs[..] {
        [first, .., last] if inputs.len() > SHOWN => format!("from {first} to {last}"),
        all => format!("at {}", all.join(", ")),
    };
    let _ = writeln!(out, "     crank {inputs}; it {turn}");
    out
}

/// An error in two digits: of a linkage that passes the poses exactly it is the rounding.
fn error_text(value: f64, size: f64) -> String {
    if value < 1e-9 * size { format!("{value:.0e}") } else { number(value, size) }
}

/// The pairs that were left out: each of a few, or how many for each reason.
fn left_out(findings: &PoseFindings) -> String {
    let total: usize = findings.left_out.values().sum();
    if total == 0 {
        return String::new();
    }
    if findings.freedom == Freedom::Points {
        let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
        for PairLeftOut { dyads: [crank, other], misfit, order } in &findings.pairs_left_out {
            let order: Vec<String> = order.iter().map(usize::to_string).collect();
            let order = if order.is_empty() { String::new() } else { format!(", {}", order.join(" ")) };
            let reason = misfit.description().to_owned() + &order;
            let pair = format!("{crank}-{other}");
            match reasons.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, pairs)) => pairs.push(pair),
                None => reasons.push((reason, vec![pair])),
            }
        }
        let reasons: Vec<String> =
            reasons.iter().map(|(reason, pairs)| format!("{}: {reason}", pairs.join(", "))).collect();
        return format!("     left out, by their dyads, that of the crank first: {}\n", reasons.join("; "));
    }
    let reasons = findings.left_out.iter().map(|(misfit, count)| format!("{count}: {}", misfit.description()));
    let reasons: Vec<String> = reasons.collect();
    format!("     left out: {}\n", reasons.join("; "))
}

fn nothing_found(relaxed: Option<&Relaxed>, poses: &PoseSet) -> String {
    let Some(relaxed) = relaxed else {
        const NO_TURN: &str =
            "; the body does not turn: the links of parallelograms move it so, and pass only points of one circle";
        let why = if poses.is_translation() { NO_TURN } else { "" };
        return format!("no linkage was found that passes the poses, whatever the options{why}\n");
    };
    let answers = &relaxed.findings.answers;
    let best = answers.first().map_or(String::new(), |best| entry("-", best, poses));
    format!(
        "no linkage passes the poses as asked for; with {} there {}, the best of them:\n{best}",
        options_of(relaxed).join(" and "),
        match answers.len() {
            1 => "is 1".to_owned(),
            count => format!("are {count}"),
        }
    )
}
