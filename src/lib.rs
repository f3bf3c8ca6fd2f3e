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
//! A four-bar and its coupler curve, without a manifest:
//!
//! ```
//! use coupler_atlas::linkage::{Assembly, FourBar, Class, Side, Travel};
//! use coupler_atlas::motion::{Motion, Sampler, Sampling};
//!
//! let mut assembly = Assembly::default();
//! let o = assembly.fixed("O", [0.0, 0.0].into());
//! let c = assembly.fixed("C", [4.0, 0.0].into());
//! let a = assembly.crank("A", o, 1.0)?;
//! let b = assembly.dyad("B", [a, c], [3.0, 3.5], Side::Left)?;
//! let m = assembly.point("M", [a, b], 1.5, 1.0)?;
//! let linkage = assembly.finish(vec![m], None, Travel::default())?;
//!
//! assert_eq!(FourBar::of(&linkage).map(FourBar::class), Some(Class::CrankRocker));
//! let motion = Motion::of(&linkage, &Sampler::new(Sampling::Step(2.0)));
//! assert_eq!(motion.circuits[0].points(m).count(), 180);
//! # Ok::<(), coupler_atlas::linkage::Error>(())
//! ```

pub mod geometry;
pub mod problem;

pub mod expression;
pub mod linkage;
pub mod motion;

pub mod measure;
pub mod template;

pub mod catalogue;
pub mod family;
pub mod notation;

pub mod sweep;

pub mod chart;

pub mod design;

pub mod page;
pub mod render;
pub mod scene;

pub mod manifest;
pub mod record;

pub mod export;
pub mod press;

pub mod gallery;

pub mod build;
pub mod check;
