//! The linkages whose coupler curves are nearest to a path.
//!
//! ```
//! use coupler_find::{Options, Target};
//!
//! let at = |k: i32| f64::from(6 * k).to_radians();
//! let points: Vec<_> = (0..60).map(at).map(|t| [4.0 * t.cos(), t.sin() + 0.5 * (2.0 * t).sin()].into()).collect();
//! let answers = Target::closed(&points)?.search(&Options::default());
//! println!("{:.4} of the path's size", answers[0].deviation.rms_relative);
//! # assert!(answers[0].deviation.rms_relative < 0.05, "{}", answers[0].deviation.rms_relative);
//! # Ok::<(), coupler_find::TargetError>(())
//! ```
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
//! # Functions
//!
//! [`generate_function`] finds four-bars and slider-cranks whose output is a wanted function of their input, at precision points or over a whole
//! range.
//!
//! # Other linkages
//!
//! A [`LinkageSearch`] finds the dimensions of any linkage, of the parameters of a [`LinkageSpace`]: the curves of samples are looked up by
//! their shapes, placed and refined by differences of solved curves, with the same metric.
//!
//! # Wishes
//!
//! A [`DesignSearch`] finds the dimensions of any linkage, within the ranges of a [`DesignSpace`], that meet [`Wishes`] on its measures.
//!
//! # Guided bodies
//!
//! [`exact_guides`] finds the four-bars, slider-cranks and inverted slider-cranks whose coupler passes 2 to 5 poses of a [`PoseSet`], by
//! Burmester's theory, and [`nearest_guides`] those that pass near more, by least squares of the distances in the space of place and angle.

mod complex;
mod even_sequence;
mod scatter;
mod workers;

mod condition;
mod curve_fit_options;
mod options;

mod descent;
mod matching;
mod timing;

mod shape;
mod target;

mod hindrance;

mod query;

mod quality;

mod deviation;
mod distinct;

mod curve;
mod four_bar;
mod function;
mod linkage;

mod design;

mod answer;
mod search;

mod report;

mod poses;

pub use answer::Answer;
pub use condition::Condition;
pub use curve::{CurveFit, CurveFitter, CurveIndex, CurveLookup, CurveShape};
pub use curve_fit_options::CurveFitOptions;
pub use design::{
    DesignAnswer, DesignMiss, DesignOptions, DesignSearch, DesignSpace, DesignSpaceError, Direction, Goal,
    RangeRequest, Wish, WishError, WishValue, Wishes,
};
pub use deviation::Deviation;
pub use distinct::distinct;
pub use four_bar::{Index, IndexPart, Mechanism, placed_parameters};
pub use function::{
    Defect, FunctionAnswer, FunctionFindings, FunctionMethod, FunctionOptions, FunctionTarget, FunctionTargetError,
    GeneratorKind, Law, LawError, LeftOut, OutputFunction, StructuralError, generate_function,
};
pub use hindrance::Hindrance;
pub use linkage::{
    FollowedOutput, JAM_DEG, LinkageAnswer, LinkageFunctionAnswer, LinkageFunctionError, LinkageFunctionOptions,
    LinkageIndex, LinkageIndexPart, LinkageSampler, LinkageSearch, LinkageSpace, LinkageSpaceError, PlacedCurve,
    Searched, generate_function_by, is_scalable, most_precision_points, ranked, scaled_values, simpler_spaces,
    six_bar_spaces,
};
pub use options::{Effort, Options};
pub use poses::{
    BodyPose, Freedom, Guide, Misfit, PairLeftOut, PassedPose, PlacedDyad, PlacedInvertedSliderCrank,
    PlacedSliderCrank, PoseAnswer, PoseCondition, PoseDeviation, PoseError, PoseFindings, PoseOptions, PoseSet,
    burmester_curves, burmester_dyads, exact_guides, nearest_guides, passed_poses, poles, poses_manifest,
};
pub use quality::Quality;
pub use report::{
    AnswerRecord, FitRecord, answer_families, answers_manifest, format_drawn_length, format_length, format_relative,
    manifest_head, title_for,
};
pub use search::{Constraint, Ranking, Search, nearest_miss, nearest_miss_by};
pub use target::{MAX_LENGTH_RATIO, PathKind, Target, TargetError};
pub use workers::{OneAtATime, Workers};
