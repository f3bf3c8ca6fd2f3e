//! A drawing as the text of a manifest.

use std::fmt::Write;

use coupler_curves::linkage_format::{quoted, toml_key, toml_number};
use coupler_curves::text::is_control_or_directional;

use super::drawing::{Drawing, DrawingInput};

/// The id of the family and of the linkage.
const ID: &str = "imported";

/// A manifest with a family of one cell, and with the linkage of a drawing.
pub fn manifest_text(drawing: &Drawing) -> String {
    let mut out = String::new();
    let _ = write_comment(&mut out, &format!("Imported from {}.", drawing.origin));
    if let Some(unit) = &drawing.unit {
        let _ = write_comment(&mut out, &format!("Unit of lengths: {unit}."));
    }
    for note in &drawing.notes {
        let _ = write_comment(&mut out, &format!("Note: {note}."));
    }
    let title = drawing.title.as_deref().map(one_line).filter(|title| !title.is_empty());
    let title = quoted(title.as_deref().unwrap_or("Imported linkage"));
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "\n[atlas]\ntitle = {title}\n\n[[family]]\nid = \"{ID}\"\nlinkage = \"{ID}\"\ncases = [{{}}]\n\n[[linkage]]\nid = \"{ID}\"\n{}",
        linkage_text(drawing)
    );
    out
}

/// The keys of a `[[linkage]]` but its id: the traced joints and the drawing.
pub fn linkage_text(drawing: &Drawing) -> String {
    let name = |joint: usize| quoted(&drawing.joints[joint].0);
    let list =
        |joints: &[usize]| format!("[{}]", joints.iter().map(|&joint| name(joint)).collect::<Vec<_>>().join(", "));
    let line = |joints: [usize; 2]| quoted(&joints.map(|joint| drawing.joints[joint].0.as_str()).join(" "));
    let input = match drawing.input {
        DrawingInput::Line(joints) => line(joints),
        DrawingInput::Slider(joint) => format!("{{ slider = {} }}", name(joint)),
        DrawingInput::Distance(joints) => format!("{{ distance = {} }}", list(&joints)),
        DrawingInput::Between(lines) => format!("{{ between = [{}] }}", lines.map(line).join(", ")),
    };
    let links: Vec<String> = drawing.links.iter().map(|link| list(link)).collect();
    let mut out = format!("trace = {}\n", list(&drawing.trace));
    if let Some([from, to]) = &drawing.range {
        let _ = writeln!(out, "input = {{ from = {from}, to = {to} }}");
    }
    let _ = write!(
        out,
        "\n[linkage.drawing]\nframe = {}\nlinks = [{}]\ninput = {input}\n\n[linkage.drawing.joints]\n",
        list(&drawing.frame),
        links.join(", ")
    );
    for (joint, position) in &drawing.joints {
        // Without a minus where it is zero.
        let [x, y] = position.map(|c| toml_number(c + 0.0));
        let _ = writeln!(out, "{} = [{x}, {y}]", toml_key(joint));
    }
    if !drawing.slides.is_empty() {
        out.push_str("\n[linkage.drawing.slides]\n");
    }
    for (joint, line) in &drawing.slides {
        let _ = writeln!(out, "{} = {}", toml_key(&drawing.joints[*joint].0), list(line));
    }
    out
}

/// Writes a comment of lines that can be read without scrolling.
fn write_comment(out: &mut String, text: &str) -> std::fmt::Result {
    /// The most characters of a line.
    const MAX_WIDTH: usize = 120;
    let mut line = String::from("#");
    for word in one_line(text).split_whitespace() {
        if line.len() + 1 + word.len() > MAX_WIDTH && line.len() > 1 {
            writeln!(out, "{line}")?;
            line = "#  ".to_owned();
        }
        line.push(' ');
        line.push_str(word);
    }
    writeln!(out, "{line}")
}

/// A text without control characters and line breaks.
fn one_line(text: &str) -> String {
    let text: String = text.chars().map(|c| if is_control_or_directional(c) { ' ' } else { c }).collect();
    text.trim().to_owned()
}
