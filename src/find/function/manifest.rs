//! A manifest that renders linkages over the range of their input.

use std::fmt::Write;

use coupler_curves::linkage_format::{quoted, toml_number};
use coupler_find::{FunctionAnswer, manifest_head, title_for};

use super::words::error_in_words;

/// A manifest with a linkage for each side on which some are assembled, and their cases over the range of the input, in order of rank.
pub fn function_manifest(name: &str, answers: &[FunctionAnswer]) -> String {
    let mut out = manifest_head("find", &title_for(name));
    if answers.is_empty() {
        return out + "\n# No linkage meets the constraints.\n";
    }
    let mut sides: Vec<&str> = answers.iter().map(|answer| answer.side).collect();
    sides.sort_unstable();
    sides.dedup();
    for side in &sides {
        let ranked: Vec<(usize, &FunctionAnswer)> =
            (1..).zip(answers).filter(|(_, answer)| answer.side == *side).collect();
        append_family(name, (side, sides.len() > 1), &ranked, &mut out);
    }
    out
}

fn append_family(name: &str, (side, is_named): (&str, bool), ranked: &[(usize, &FunctionAnswer)], out: &mut String) {
    let Some((_, first)) = ranked.first() else { return };
    let id = first.linkage_id();
    let title = if is_named { format!("Linkages for {name}, {side}") } else { format!("Linkages for {name}") };
    let columns = ranked.len().min(3);
    let rows = ranked.len().div_ceil(columns).min(3);
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "\n{}\n[[family]]\nid = \"found-{side}\"\nlinkage = \"{id}\"\ntitle = {}\npanels = [{columns}, {rows}]\n\
         caption = \"{{rank:.0}}: error {{error:.4}}\"\ncases = [\n",
        first.template_toml(),
        quoted(&title)
    );
    for (rank, answer) in ranked {
        let values = answer.parameters().into_iter().map(|(name, value)| format!("{name} = {}", toml_number(value)));
        let values = values.collect::<Vec<_>>().join(", ");
        let error = toml_number(answer.error.greatest.abs());
        let _ = writeln!(out, "    {{ rank = {rank}, error = {error}, {values} }}, # {}", error_in_words(answer));
    }
    out.push_str("]\n");
}
