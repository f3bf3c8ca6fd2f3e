//! A linkage with numeric dimensions: its joints, how each is placed, its links, input and traced points.
//!
//! A planar linkage of one degree of freedom is a list of [`Joint`]s, each placed by a [`JointKind`] from joints before
//! it. Joints at constant distances from one another form a [`Link`]. The [`MotionOptions`] are the start of a motion,
//! its input range and its circuits.
//!
//! A joint of a dyad can lie on either side of a line for the same input. The sides of all dyads together are the
//! [`AssemblyMode`].

mod assembly_mode;
mod builder;
mod cognate;
mod default_output;
mod dwell_band;
mod error;
mod four_bar;
mod group;
mod helper;
mod id;
mod input;
mod joint;
mod kinematic_chain;
mod link;
mod load;
mod motion_options;
mod outline;
mod output_link;
mod planar_linkage;
mod position_analysis;
mod sextic;
mod symmetrical_four_bar;

pub use assembly_mode::{AssemblyMode, Side};
pub use builder::LinkageBuilder;
pub use cognate::{Cognate, CognateError, Cognates, MovingLink, PlacedFourBar};
pub use error::Error;
pub(crate) use four_bar::length_tolerance;
pub use four_bar::{FourBar, FourBarClass};
pub use id::{DyadId, JointId, LinkId};
pub use input::Input;
pub use joint::{Joint, JointKind, LineDirection};
pub use kinematic_chain::SixBar;
pub use link::Link;
pub use motion_options::{BranchArc, CircuitSelection, CoincidentDyads, Continuation, MotionOptions};
pub use output_link::OutputLink;
pub use planar_linkage::Linkage;
pub(crate) use planar_linkage::gcd;
pub use sextic::{DoublePoint, DoublePointKind, Sextic};

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    assembly_mode::{DyadSet, MAX_DYADS},
    dwell_band::DwellBand,
    group::{Closure, Group},
    kinematic_chain::KinematicChain,
    load::Load,
    outline::{LinkOutline, is_plate},
    position_analysis::InvertedSliderCrank,
    symmetrical_four_bar::SymmetricalFourBar,
};

pub use crate::geometry::Orientation;
