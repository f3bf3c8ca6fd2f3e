//! Kinematics of planar linkages: coupler curves, their analysis and their measures.
//!
//! Data flows one way; the modules are in reading order, and none imports one that comes after it:
//!
//! ```text
//! linkage format -> template -> family x cell -> linkage -> motion -> measures -> solved cell -> exchange formats
//! ```
//!
//! A four-bar and its coupler curve, without a manifest:
//!
//! ```
//! use coupler_curves::linkage::{FourBar, FourBarClass, LinkageBuilder, MotionOptions, Side};
//! use coupler_curves::motion::{Motion, Sampler, Sampling};
//!
//! let mut builder = LinkageBuilder::default();
//! let o = builder.fixed("O", [0.0, 0.0].into());
//! let c = builder.fixed("C", [4.0, 0.0].into());
//! let a = builder.crank("A", o, 1.0)?;
//! let b = builder.dyad("B", [a, c], [3.0, 3.5], Side::Left)?;
//! let m = builder.point("M", [a, b], 1.5, 1.0)?;
//! let linkage = builder.build(vec![m], None, MotionOptions::default())?;
//!
//! assert_eq!(FourBar::from_linkage(&linkage).map(FourBar::class), Some(FourBarClass::CrankRocker));
//! let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(2.0)));
//! assert_eq!(motion.circuits[0].points(m).count(), 180);
//! # Ok::<(), coupler_curves::linkage::Error>(())
//! ```

pub mod geometry;
pub mod problem;

pub mod expression;

pub mod linkage;

pub mod motion;

pub mod measure;
pub mod template;

pub mod linkage_format;

pub mod catalogue;
pub mod family;

pub mod solve;

pub mod exchange;
