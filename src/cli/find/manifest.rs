//! A manifest that renders the linkages.

use std::fmt::Write;

use coupler_curves::find::{Answer, Mechanism};
use coupler_curves::linkage::Side;
use coupler_curves::linkage_format::quoted;

use super::Report;
use super::text::{number, relative};

/// The linkages of a manifest: a four-bar whose crank turns fully has a circuit for each side of its rocker pin, and of others all
/// circuits are drawn.
const FORMS: [&str; 3] = ["left", "right", ROCKING];

/// The form of a four-bar whose crank does not turn fully.
const ROCKING: &str = "rocking";

fn form_of(mechanism: &Mechanism) -> &'static str {
    match mechanism.side {
        _ if !mechanism.is_full_turn => ROCKING,
        Side::Left => "left",
        Side::Right => "right",
    }
}

/// A complete manifest: linkages with their pivots where they are on the path, and families with a case for each answer, in order
/// of rank.
pub(super) fn manifest(report: &Report) -> String {
    let title = quoted(&format!("Linkages for {}", report.title()));
    let mut out = format!(
        "# Linkages found by `coupler-atlas find`; `coupler-atlas render` draws them.\n\n[atlas]\ntitle = {title}\n\
         formats = [\"svg\"]\n\n[page]\npaper = \"a4\"\n"
    );
    for form in FORMS {
        let ranked = (1..).zip(&report.answers).filter(|(_, answer)| form_of(&answer.mechanism) == form);
        let ranked: Vec<(usize, &Answer)> = ranked.collect();
        if !ranked.is_empty() {
            append_family(form, &ranked, report, &mut out);
        }
    }
    if report.answers.is_empty() {
        out.push_str("\n# No linkage meets the constraints.\n");
    }
    out
}

fn append_family(form: &str, ranked: &[(usize, &Answer)], report: &Report, out: &mut String) {
    let id = &Mechanism::template().id;
    let mut linkage = Mechanism::TEMPLATE_TOML.replace(&format!("id = \"{id}\""), &format!("id = \"{id}-{form}\""));
    if form != ROCKING {
        linkage = linkage.replace("circuits = \"all\"", "circuits = \"start\"");
        linkage = linkage.replace("side = \"left\"", &format!("side = \"{form}\""));
    }
    let columns = ranked.len().min(3);
    let rows = ranked.len().div_ceil(columns).min(3);
    let title = quoted(&format!("Linkages for {}", report.title()));
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "\n{linkage}\n[[family]]\nid = \"found-{form}\"\nlinkage = \"{id}-{form}\"\ntitle = {title}\npanels = [{columns}, {rows}]\n\
         cases = [\n"
    );
    let size = report.target.size();
    for (rank, answer) in ranked {
        let values = answer.mechanism.parameters().map(|(name, value)| format!("{name} = {}", rounded(value, size)));
        let deviation = format!("E = {} = {} S", number(answer.rms, size), relative(answer.rms_relative));
        let _ = writeln!(out, "    {{ {} }}, # {rank}: {deviation}", values.join(", "));
    }
    out.push_str("]\n");
}

/// A dimension, rounded to what moves no point of the curve by more than a ten-thousandth of a millionth of the path.
fn rounded(value: f64, size: f64) -> f64 {
    // "2.5e-3" has the exponent -3.
    let exponent: i32 = format!("{size:e}").split('e').nth(1).and_then(|exponent| exponent.parse().ok()).unwrap_or(0);
    let digits = (10 - exponent).clamp(0, 300) as usize;
    format!("{value:.digits$}").parse().unwrap_or(value) + 0.0
}
