//! Atlases of coupler curves: families of planar linkages, solved and drawn as pages, with their point sets.
//!
//! Data goes one way:
//!
//! ```text
//! manifest -> families x grid -> linkage -> motion -> measures -> pages -> scene -> svg / png / pdf
//!                                              \-> points.csv, cells.csv, run.json -> check, index.html
//! ```
//!
//! The modules stand here in reading order; none imports one that comes after it. Each stage is one public function:
//! [`manifest::load`], [`sweep::run`], [`design::straight_line`], [`page::compose`], [`render::svg`], [`render::png`], [`build::run`],
//! [`check::run`].
//!

pub mod sweep;

pub mod design;

pub mod manifest;
pub mod record;

pub mod export;
pub mod press;

pub mod gallery;

pub mod build;
pub mod check;
