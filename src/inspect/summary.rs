//! What one wants to know of a linkage first: its limits, its transmission angle and its straight portion.

use std::fmt::Write;

use coupler_curves::measure::Measure;
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

use super::format::{drive_word, input_unit};
use crate::format::format_significant;

/// The number of circuits that are described one by one.
const MAX_CIRCUITS: usize = 4;

/// Appends a line for each; there are none for a linkage that cannot be assembled.
pub(super) fn append_text(solved: &SolvedCell, out: &mut String) {
    let circuits = &solved.motion.circuits;
    let unit = input_unit(&solved.linkage);
    let curve = |k: usize| solved.curves.iter().find(|curve| curve.circuit == k + 1);
    let limits = per_circuit(circuits.len(), |k| Some(describe_limits(curve(k)?, &circuits[k], unit)));
    let angles = per_circuit(circuits.len(), |k| describe_transmission(curve(k)?));
    let straight = (!solved.curves.is_empty()).then(|| describe_straight(solved, unit));
    let torques = per_circuit(circuits.len(), |k| describe_torque(curve(k)?, unit));
    let torque_title = format!("input {}", drive_word(&solved.linkage));
    let lines = [
        ("limits of the input", limits),
        ("transmission angle", angles),
        (&torque_title, torques),
        ("straight portion", straight),
    ];
    for (title, line) in lines {
        if let Some(line) = line {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{title}: {line}");
        }
    }
}

/// A description for each circuit, or only one if they are all the same; `None` if there is none.
fn per_circuit(count: usize, describe: impl Fn(usize) -> Option<String>) -> Option<String> {
    let all: Vec<Option<String>> = (0..count).map(describe).collect();
    let first = all.iter().flatten().next()?.clone();
    if all.iter().all(|other| other.as_ref() == Some(&first)) {
        return Some(first);
    }
    let named = (1..).zip(&all).filter_map(|(number, text)| Some(format!("circuit {number}: {}", text.as_ref()?)));
    let mut named: Vec<String> = named.collect();
    let omitted = named.len().saturating_sub(MAX_CIRCUITS);
    named.truncate(MAX_CIRCUITS);
    if omitted > 0 {
        named.push(format!("and {omitted} more"));
    }
    Some(named.join("; "))
}

/// "none, it turns fully", "28.95502437° to 97.18075578°, where it jams", or without that where only the range ends.
fn describe_limits(curve: &MeasuredCurve, circuit: &Circuit, unit: &str) -> String {
    let jams = if circuit.limit_count() > 0 { ", where it jams" } else { "" };
    match curve.measure(Measure::INPUT_MIN).zip(curve.measure(Measure::INPUT_MAX)) {
        Some((least, most)) => {
            format!("{}{unit} to {}{unit}{jams}", format_significant(least, 10), format_significant(most, 10))
        }
        None => "none, it turns fully".to_owned(),
    }
}

/// "worst 26.57°, from 26.57° to 90°"; without the range if the linkage is not a four-bar, and `None` if no dyad
/// transmits anything.
fn describe_transmission(curve: &MeasuredCurve) -> Option<String> {
    let worst = format_significant(curve.measure(Measure::MU_WORST)?, 4);
    let range = curve
        .measure(Measure::MU_MIN)
        .zip(curve.measure(Measure::MU_MAX))
        .map(|(least, most)| format!(", from {}° to {}°", format_significant(least, 4), format_significant(most, 4)));
    Some(format!("worst {worst}°{}", range.unwrap_or_default()))
}

/// "at most 104.2, at 73.1°; from -104.2 to 104.2"; `None` without a load.
fn describe_torque(curve: &MeasuredCurve, unit: &str) -> Option<String> {
    let value = |key| curve.measure(key).map(|value| format_significant(value, 7));
    let [peak, least, most] = [Measure::TORQUE_PEAK, Measure::TORQUE_MIN, Measure::TORQUE_MAX].map(value);
    let (peak, at) = (peak?, value(Measure::TORQUE_PEAK_DEG)?);
    Some(format!("at most {peak}, at {at}{unit}; from {} to {}", least?, most?))
}

/// The straight portion of the curve on which it is longest for the size of the curve.
fn describe_straight(solved: &SolvedCell, unit: &str) -> String {
    let share = |curve: &&MeasuredCurve| curve.measure(Measure::STRAIGHT_SHARE).unwrap_or(f64::NEG_INFINITY);
    // Of equally long ones the first.
    let longest = solved.curves.iter().rev().max_by(|a, b| share(a).total_cmp(&share(b)));
    let text = longest.and_then(|curve| {
        let value = |key| curve.measure(key);
        let [length, deviation] = [value(Measure::STRAIGHT_LENGTH)?, value(Measure::STRAIGHT_DEVIATION)?]
            .map(|value| format_significant(value, 4));
        let [start, span] = [value(Measure::STRAIGHT_START)?, value(Measure::STRAIGHT_INPUT)?]
            .map(|value| format_significant(value, 4));
        let share = format_significant(100.0 * value(Measure::STRAIGHT_SHARE)?, 3);
        let twin = value(Measure::STRAIGHT_TWIN)
            .map(|twin| format!(", and again from {}{unit}", format_significant(twin, 4)))
            .unwrap_or_default();
        let whose = match solved.curves.len() {
            1 => String::new(),
            count => format!(
                " (trace {}, circuit {}, the longest for the size of its curve among {count})",
                curve.trace, curve.circuit
            ),
        };
        Some(format!(
            "{length} long, {share} % of the curve's greatest extent, within {deviation} of its line, from \
             {start}{unit} over {span}{unit}{twin}{whose}"
        ))
    });
    text.unwrap_or_else(|| "none".to_owned())
}
