//! A manifest that renders the linkages.

use std::fmt::Write;

use crate::answer::Answer;
use crate::four_bar::mechanism::Mechanism;
use crate::report::significant::{format_length, format_relative};
use coupler_curves::linkage::Side;
use coupler_curves::linkage_format::quoted;

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

/// A complete manifest that renders answers, for a path with a name and a size; of none, one that says so.
pub fn answers_manifest(name: &str, size: f64, answers: &[Answer]) -> String {
    let rest = match answers {
        [] => "\n# No linkage meets the constraints.\n".to_owned(),
        _ => answer_families(name, size, answers),
    };
    manifest_head("find", &title_for(name)) + &rest
}

/// The beginning of a manifest that renders what a command has found, up to the linkages and families.
pub fn manifest_head(command: &str, title: &str) -> String {
    format!(
        "# Linkages found by `coupler-atlas {command}`; `coupler-atlas render` draws them.\n\n[atlas]\ntitle = {}\n\
         formats = [\"svg\"]\n\n[page]\npaper = \"a4\"\n",
        quoted(title)
    )
}

/// The linkages of answers with their pivots where they are on the path, and families with a case for each answer, in order of rank.
pub fn answer_families(name: &str, size: f64, answers: &[Answer]) -> String {
    let mut out = String::new();
    for form in FORMS {
        let ranked = (1..).zip(answers).filter(|(_, answer)| form_of(&answer.mechanism) == form);
        let ranked: Vec<(usize, &Answer)> = ranked.collect();
        let title = match form {
            _ if ranked.len() == answers.len() => title_for(name),
            ROCKING => format!("{}, the crank does not turn fully", title_for(name)),
            side => format!("{}, rocker pin on the {side}", title_for(name)),
        };
        if !ranked.is_empty() {
            append_family((form, &title), &ranked, size, &mut out);
        }
    }
    out
}

/// The title of an atlas and of its families, for a path with a name.
pub fn title_for(name: &str) -> String {
    format!("Linkages for {name}")
}

fn append_family((form, title): (&str, &str), ranked: &[(usize, &Answer)], size: f64, out: &mut String) {
    let id = &Mechanism::template().id;
    let mut linkage = Mechanism::TEMPLATE_TOML.replace(&format!("id = \"{id}\""), &format!("id = \"{id}-{form}\""));
    if form != ROCKING {
        linkage = linkage.replace("circuits = \"all\"", "circuits = \"start\"");
        linkage = linkage.replace("side = \"left\"", &format!("side = \"{form}\""));
    }
    let columns = ranked.len().min(3);
    let rows = ranked.len().div_ceil(columns).min(3);
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "\n{linkage}\n[[family]]\nid = \"found-{form}\"\nlinkage = \"{id}-{form}\"\ntitle = {}\npanels = [{columns}, {rows}]\n\
         caption = \"{{rank:.0}}: E = {{deviation:.4}} S\"\ncases = [\n",
        quoted(title)
    );
    for (rank, answer) in ranked {
        let values = answer.mechanism.parameters().map(|(name, value)| format!("{name} = {}", rounded(value, size)));
        let [rms, relative] =
            [format_length(answer.deviation.rms, size), format_relative(answer.deviation.rms_relative)];
        let values = values.join(", ");
        let _ = writeln!(out, "    {{ rank = {rank}, deviation = {relative}, {values} }}, # E = {rms} = {relative} S");
    }
    out.push_str("]\n");
}

/// A dimension, rounded to a ten-thousandth of a millionth of the path: a linkage near a change point hardly bears more.
pub(crate) fn rounded(value: f64, size: f64) -> f64 {
    // "2.5e-3" has the exponent -3.
    let exponent: i32 = format!("{size:e}").split('e').nth(1).and_then(|exponent| exponent.parse().ok()).unwrap_or(0);
    let digits = (10 - exponent).clamp(0, 300) as usize;
    format!("{value:.digits$}").parse().unwrap_or(value) + 0.0
}
