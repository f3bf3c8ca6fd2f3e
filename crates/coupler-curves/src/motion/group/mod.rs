//! The motion of a linkage with a group of links that no dyads solve.
//!
//! The coordinates of the group's joints and the input are a curve on which the equations of its closed loops hold. It
//! is followed by steps each of which is proven to be on one curve, however close another is ([`step`]). Its nodes are
//! what poses are found from by Newton's method ([`track`]). Where two parts of the curve cross, a change point, the motion goes on smoothly, which is not
//! proven but tested: as its cubic does. At a limit the derivatives of the equations with respect to
//! the unknowns are singular: the group takes the place of a dyad there, whose side is the sign of their determinant.

mod equations;
mod follow;
mod homotopy;
mod intervals;
mod step;
mod track;
mod turn;
mod turn_poses;

pub(super) use intervals::{GroupIntervals, NamedPose, find_intervals};
pub use track::GroupTrack;
pub use turn::follow_full_turn;
