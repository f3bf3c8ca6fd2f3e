//! Kinematics of planar linkages: coupler curves, their analysis and their measures.
//!
//! Data flows one way; the modules are listed in reading order, and none imports a later one:
//!
//! ```text
//! linkage format -> template -> family x cell -> linkage -> motion -> measures -> solved cell -> exchange formats
//! ```
//!
//! What is public only for the other crates of this workspace is not documented here, and may change with them.
//!
//! A template is a linkage whose dimensions are expressions in parameters; a family is a template with its parameter
//! sets, the cells. A cell turns the template into a linkage with numeric dimensions.
//!
//! A four-bar, its class, one of its coupler curves and the longest straight portion of the curve:
//!
//! ```
//! use coupler_curves::FourBar;
//!
//! let four_bar = FourBar { frame: 2.0, crank: 1.0, coupler: 2.5, rocker: 2.5 }; // Hoeken
//! let curve = four_bar.coupler_curve(5.0, 0.0)?;
//! println!("{}: {} points", four_bar.class(), curve.points().count());
//! if let Some(straight) = curve.straight_portion() {
//!     println!("straight over {:.3}", straight.length); // a circle, for one, has no straight portion
//! }
//! # assert_eq!(four_bar.class().to_string(), "crank-rocker");
//! # assert!(curve.straight_portion().is_some_and(|straight| (1.1..1.2).contains(&straight.length)));
//! # assert!(four_bar.coupler_curve(0.0, 0.0)?.straight_portion().is_none());
//! # Ok::<(), coupler_curves::CurveError>(())
//! ```
//!
//! Any other linkage of one degree of freedom is built joint by joint with [`linkage::LinkageBuilder`], solved with
//! [`motion::Motion::solve`] and measured with [`measure::TracedCurve::measure`]; or taken from the [`catalogue`] with
//! [`family::Family::single_cell`], and solved and measured with a [`solve::Solver`]:
//!
//! ```
//! use coupler_curves::linkage::{LinkageBuilder, MotionOptions, Side};
//! use coupler_curves::measure::{Measure, TracedCurve};
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
//! let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(2.0)));
//! assert_eq!(motion.circuits[0].points(m).count(), 180);
//!
//! let curve = TracedCurve::all(&linkage, &motion).next().expect("M has a curve on a circuit");
//! let worst = curve.measure(Measure::MU_WORST).expect("a four-bar has a transmission angle");
//! // It is that where the crank is on the line of the frame, by the law of cosines.
//! assert!((worst - ((9.0_f64 + 12.25 - 9.0) / 21.0).acos().to_degrees()).abs() < 1e-9);
//! # Ok::<(), coupler_curves::linkage::Error>(())
//! ```

// For the other crates of the workspace only.
#[doc(hidden)]
pub mod numerical;
#[doc(hidden)]
pub mod text;

pub mod geometry;
pub mod problem;

pub mod expression;

pub mod linkage;

pub mod motion;

pub mod measure;
pub mod path;
pub mod template;

pub mod linkage_format;

pub mod catalogue;
pub mod family;

pub mod solve;

// For the other crates of the workspace only.
#[doc(hidden)]
pub mod parts;

pub mod exchange;

mod coupler_curve;

pub use coupler_curve::{CouplerCurve, CurveError};
pub use linkage::{FourBar, FourBarClass};
