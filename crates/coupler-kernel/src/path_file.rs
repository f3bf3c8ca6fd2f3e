//! The path in a file that is chosen, dropped or pasted.

use serde_json::{Value, json};

use coupler_paths::{ReadOptions, parse_outline};

use crate::response::Numbers;

/// The path in the bytes of a file as `find` reads it: its points, whether it is closed, and what of the file was taken. Of several outlines
/// that with an id or number, or the most likely.
///
/// # Errors
/// Every problem of the file, in a line each.
pub(crate) fn path_file_json(bytes: &[f64], outline: Option<&str>, numbers: &mut Numbers) -> Result<Value, String> {
    let bytes: Vec<u8> = bytes.iter().map(|byte| *byte as u8).collect();
    let options = ReadOptions { outline, outline_option: "outline ", ..ReadOptions::default() };
    let mut outline = parse_outline(&bytes, &options).map_err(|problems| problems.join("\n"))?;
    let is_closed = outline.decide_closed();
    Ok(json!({ "points": numbers.points(outline.points), "closed": is_closed, "taken": outline.reading.taken }))
}
