//! The files of paths for `find`: what programs write is read right, or refused with what is wrong.

mod closing;
mod drawings;
mod hostile;
mod own_formats;
mod page;
mod tables;

use coupler_atlas::find::{Outline, ReadOptions, parse_outline};

/// The path in a file.
fn read(bytes: impl AsRef<[u8]>) -> Result<Outline, String> {
    parse_outline(bytes.as_ref(), &ReadOptions::default()).map_err(|problems| problems.join("\n"))
}

/// The path in a file, with the angles of the crank.
fn read_timed(bytes: impl AsRef<[u8]>) -> Result<Outline, String> {
    let options = ReadOptions { is_timed: true, ..ReadOptions::default() };
    parse_outline(bytes.as_ref(), &options).map_err(|problems| problems.join("\n"))
}

/// The outline of a file that is chosen.
fn choose(bytes: impl AsRef<[u8]>, outline: &str) -> Result<Outline, String> {
    let options = ReadOptions { outline: Some(outline), ..ReadOptions::default() };
    parse_outline(bytes.as_ref(), &options).map_err(|problems| problems.join("\n"))
}
