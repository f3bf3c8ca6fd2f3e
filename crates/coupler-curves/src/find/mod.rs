//! The four-bar whose coupler curve is nearest to a path.
//!
//! # The metric
//!
//! The size of a target with points p is S = sqrt(mean |p - p̄|²). The deviation of a curve C from it is
//! E = sqrt(mean d(p, C(t))²), the distances of the points from the continuous curve, where the t of the points are in their order
//! along one circuit within one turn, in either direction. An answer for a closed target is valid only if its curve is at most 1.15 times
//! as long as the target, and one for a part if its portion is; otherwise curves with detours between the points would win. The
//! length of a target is that of its lowest harmonics: its noise has none.
//!
//! A timed target has an angle for each point: the curve's point is that at which the crank has turned by it since the first, in
//! either direction, and the t are not free but for a common offset.
//!
//! # The search
//!
//! An [`Index`] has the shapes of many four-bars' curves. Those most like the target, or with a portion most like an open one, in any
//! position, size, direction, reflection and with any start, are placed on it and refined by Levenberg and Marquardt's method on
//! nine parameters, with the distances across the curve and derivatives that are regular at limits of the input. The constraints
//! are kept in each step. The best begin again from their cognates (Roberts and Chebyshev). All of it is in steps of bounded work.
//!
//! # Given curves
//!
//! Those of an atlas, of any linkages, are looked up by their shapes in a [`CurveIndex`], and placed on the target by a [`CurveFitter`],
//! with the same metric.
//!
//! # Other linkages
//!
//! A [`LinkageSearch`] finds the dimensions of any linkage, of the parameters of a [`LinkageSpace`]: the curves of samples are looked up by
//! their shapes, placed and refined by differences of solved curves, with the same metric.

mod answer;
mod close_portion;
mod complex;
mod constraints;
mod curve_alignment;
mod curve_fit;
mod curve_fit_options;
mod curve_index;
mod curve_path;
mod fitting;
mod index;
mod linkage;
mod lookup;
mod manifest;
mod matching;
mod mechanism;
mod nearest_pose;
mod options;
mod parameters;
mod portion;
mod pose;
mod query;
mod ranking;
mod record;
mod refinement;
mod relaxation;
mod scatter;
mod search;
mod sequence;
mod shape;
mod significant;
mod spectrum;
mod synthesis;
mod target;
mod timing;

pub use answer::{Answer, MAX_LENGTH_RATIO, Quality};
pub use curve_fit::{CurveFit, CurveFitter, Placement};
pub use curve_fit_options::CurveFitOptions;
pub use curve_index::{CurveIndex, CurveLookup, CurveShape};
pub use index::{Index, IndexPart};
pub use linkage::{
    LinkageFit, LinkageRefinement, LinkageSearch, LinkageSpace, LinkageSpaceError, SampleCurve, SampleIndex,
    SampleShape, is_scalable, longest_link, pivots_of, scaled_values,
};
pub use manifest::{answer_families, answers_manifest, manifest_head};
pub use mechanism::{Condition, Mechanism, placed_parameters};
pub use options::{Effort, Options};
pub use ranking::Ranking;
pub use record::{AnswerRecord, FitRecord};
pub use relaxation::{Constraint, nearest_miss, nearest_miss_by};
pub use search::Search;
pub use significant::{format_length, format_relative};
pub use target::{PathKind, Target, TargetError};
