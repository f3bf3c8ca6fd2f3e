//! Atlases of coupler curves: families of planar linkages, solved and drawn as pages, with their point sets.
//!
//! Data flows in one direction:
//!
//! ```text
//! manifest -> families x grid -> linkage -> motion -> measures -> pages -> scene -> svg / png / pdf
//!                                              \-> points.csv, cells.csv, run.json -> check, index.html
//! ```
//!
//! The modules are declared in reading order; none imports a later one. Each stage is one public function:
//! [`manifest::parse`], [`sweep::process_groups`], [`design::straight_line`], [`design::by_wishes`],
//! [`coupler_drawing::page::compose_panels`], [`coupler_drawing::render::svg`], [`coupler_drawing::render::png`],
//! [`output::write_atlas`], [`check::check_atlas`].

/// The name and the version of the program, as files say by what they were written.
const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

mod format;
mod notation;
mod threads;

pub mod inspect;

pub mod sweep;

pub use coupler_manifest as manifest;

pub mod design;

pub mod find;

pub mod record;

pub mod import;

pub mod export;
mod pipeline;

#[doc(hidden)]
pub mod gallery;

pub mod check;
pub mod output;

pub mod shard;

pub mod manifest_files;

// For the program, and the command of the Python package.
#[doc(hidden)]
pub mod cli;
