//! The search for a function by the dimensions of any linkage, and what is shown of it.

use std::fmt::Write;
use std::sync::atomic::AtomicBool;

use coupler_curves::catalogue;
use coupler_curves::linkage_format::{quoted, toml_number};
use coupler_find::{
    FunctionTarget, LinkageFunctionAnswer, LinkageFunctionOptions, LinkageSpace, generate_function_by, manifest_head,
    title_for,
};

use super::super::Error;
use super::words::{degrees, error_value, linkage_output_in_words};
use crate::manifest;
use crate::threads::Threads;

/// Finds dimensions of a linkage for which its output is a function of its input, on all threads, with an answer that does not depend on their
/// number. `progress` is called with the part that is done.
///
/// # Errors
/// The linkage has no such output or input, in words; or `interrupt` is true.
pub fn find_function_by(
    space: &LinkageSpace,
    target: &FunctionTarget,
    options: &LinkageFunctionOptions,
    interrupt: &AtomicBool,
    progress: impl FnMut(f64),
) -> Result<Result<Vec<LinkageFunctionAnswer>, String>, Error> {
    let threads = Threads { interrupt };
    let found = generate_function_by(space, target, options, &threads, progress);
    threads.proceed()?;
    Ok(found.map_err(|error| format!("{}: {error}", space.template().id)))
}

/// The error of a linkage: "greatest error 0.08° at input 21.16°, root mean square 0.05°".
pub fn linkage_error_in_words(answer: &LinkageFunctionAnswer, is_length: bool) -> String {
    let [greatest, rms] = [answer.error.greatest, answer.error.rms].map(|value| error_value(is_length, value));
    format!("greatest error {greatest} at input {}, root mean square {rms}", degrees(answer.error.at))
}

/// Where a linkage moves: "input from 1° to 2°, output wanted from 3° to 4°".
pub fn linkage_motion_in_words(answer: &LinkageFunctionAnswer, is_length: bool) -> String {
    let [from, to] = answer.input_deg.map(degrees);
    let [first, last] = answer.output.map(|output| linkage_output_in_words(is_length, output));
    format!("input from {from} to {to}, output wanted from {first} to {last}")
}

/// A manifest with the linkage for each answer, over the range of its input and on all its circuits there. `own_linkage` is the text of the linkage, if
/// it is none of the catalogue.
pub fn linkage_function_manifest(
    name: &str,
    is_length: bool,
    id: &str,
    answers: &[LinkageFunctionAnswer],
    own_linkage: Option<&str>,
) -> String {
    let mut out = manifest_head("find", &title_for(name));
    if answers.is_empty() {
        return out + "\n# No linkage meets the constraints.\n";
    }
    let text = own_linkage.or_else(|| catalogue::source_text(id)).unwrap_or_default();
    let text = manifest::linkage_text(text, id).unwrap_or_default();
    // What is set for each linkage.
    let is_kept =
        |line: &&str| !["id =", "input =", "start =", "circuits =", "arc ="].iter().any(|key| line.starts_with(key));
    let (head, rest) = text.split_once('\n').unwrap_or((&text, ""));
    let rest: Vec<&str> = rest.lines().filter(is_kept).collect();
    for (rank, answer) in (1..).zip(answers) {
        let [a, b] = answer.input_deg;
        let [from, to] = [a.min(b), a.max(b)].map(toml_number);
        let parameters = answer.family.template.parameters.iter().zip(&answer.values);
        let values = parameters.map(|(parameter, value)| format!("{} = {}", parameter.name, toml_number(*value)));
        let values = values.collect::<Vec<_>>().join(", ");
        let words = linkage_error_in_words(answer, is_length);
        // Writing to a string cannot fail.
        let _ = write!(
            out,
            "\n{head}\nid = \"{id}-{rank}\"\ninput = {{ from = \"{from} deg\", to = \"{to} deg\" }}\nstart = \"{from} deg\"\n\
             circuits = \"all\"\n{}\n\n[[family]]\nid = \"found-{rank}\"\nlinkage = \"{id}-{rank}\"\ntitle = {}\n\
             cases = [{{ {values} }}] # {words}\n",
            rest.join("\n"),
            quoted(&format!("Linkage {rank} for {name}"))
        );
    }
    out
}
