//! The table of an atlas's curves.

use std::fmt::Write;

use crate::find::description::{self, dimensions};
use crate::find::{AtlasAnswer, Findings};
use coupler_find::{Deviation, format_length as number, format_relative as relative};

use super::super::text::{describe_target, options_of, place};
use super::AtlasReport;
use coupler_curves::text::pluralize;

/// The answers, each with its cell, where it is placed or what was refined from it.
pub(super) fn text(report: &AtlasReport) -> String {
    let AtlasReport { name, target, findings: Findings { curves, answers, nearest_miss }, .. } = report;
    let size = target.size();
    let mut out = format!("{}; {} of the atlas\n", describe_target(name, target), pluralize(*curves, "curve"));
    for (rank, answer) in (1..).zip(answers) {
        out += &entry(&rank.to_string(), answer, size);
    }
    if answers.is_empty() {
        match nearest_miss {
            Some((relax, nearest)) => {
                let _ = writeln!(
                    out,
                    "no curve meets the constraints; the nearest miss is an answer without {}:",
                    options_of(relax).join(", ")
                );
                out += &entry("-", nearest, size);
            }
            None => out += "no curve of the atlas is like the path\n",
        }
    }
    out
}

fn entry(rank: &str, AtlasAnswer { curve, name, refined, .. }: &AtlasAnswer, size: f64) -> String {
    let fit = &curve.fit;
    let line = |deviation: &Deviation| {
        let Deviation { rms, rms_relative, greatest, .. } = *deviation;
        let quality = deviation.quality().name();
        format!(
            "E = {} S = {}, greatest {}, {quality}",
            relative(rms_relative),
            number(rms, size),
            number(greatest, size)
        )
    };
    match refined {
        Some(answer) => format!(
            "{rank:>3}  {}, refined from {} (E = {} S)\n     {}\n     {}\n",
            line(&answer.deviation),
            name,
            relative(fit.deviation.rms_relative),
            dimensions(&answer.mechanism, |value| number(value, size)),
            place(&answer.mechanism, size)
        ),
        None => {
            let deviation = line(&fit.deviation);
            let class = if curve.class.is_empty() { String::new() } else { format!(", {}", curve.class) };
            format!("{rank:>3}  {deviation}, {}{class}\n     {}\n", name, description::placement(curve, size))
        }
    }
}
