//! Linkages that guide a body through poses: four-bars, slider-cranks and inverted slider-cranks whose coupler is the body.

mod answer;
mod body;
mod centre_curve;
mod condition;
mod curves;
mod difference;
mod dyad;
mod dyad_space;
mod findings;
mod five;
mod guide;
mod manifest;
mod near;
mod near_guide;
mod pair;
mod passed;
mod search;

pub use answer::{PoseAnswer, PoseDeviation};
pub use body::{BodyPose, PoseError, PoseSet};
pub use condition::PoseCondition;
pub use curves::{burmester_curves, burmester_dyads, poles};
pub use dyad_space::Freedom;
pub use findings::{PairLeftOut, PlacedDyad, PoseFindings, PoseOptions};
pub use guide::{Guide, PlacedInvertedSliderCrank, PlacedSliderCrank};
pub use manifest::poses_manifest;
pub use near::nearest_guides;
pub use pair::Misfit;
pub use passed::{PassedPose, passed_poses};
pub use search::exact_guides;
