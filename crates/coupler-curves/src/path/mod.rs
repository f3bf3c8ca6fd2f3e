//! The path that a joint traces on a circuit: as splines, as a whole and in dashes of equal input; and as a polyline.
//!
//! Splines are fitted to the pieces of the circuit ([`crate::motion::CircuitPieces`]), on which positions are
//! polynomials in a parameter in which the motion is regular: positions and tangents are known everywhere, also at
//! limits of the input.

mod dashes;
mod fit;
mod polyline;
mod quintic;
mod retraced;
mod trajectory;

pub use dashes::DashPattern;
pub use polyline::joint_polyline;

use crate::geometry::Spline;
use crate::linkage::{JointId, Linkage};
use crate::motion::Circuit;
use dashes::{DashRange, dash_ranges};
use trajectory::Trajectory;

/// A dash: the path that a joint traces while the input goes from one value to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Dash {
    /// The path.
    pub spline: Spline,
    /// Whether it belongs to the arc shown in the figure of the linkage's source; true if no arc is given.
    pub is_in_figure: bool,
}

/// The path that a joint traces on a circuit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointPath {
    /// The whole path, from the circuit's beginning to its end; in several parts where positions are undefined or jump.
    pub whole: Vec<Spline>,
    /// The dashes.
    pub dashes: Vec<Dash>,
    /// The stretches of the circuit that are drawn in dashes, if not all are: each by the input travelled from the
    /// circuit's beginning, forward and backward, to its ends.
    pub dashed_travel: Option<Vec<[f64; 2]>>,
}

/// The whole path of a joint on a circuit, as [`JointPath::whole`] has it.
pub fn joint_splines(linkage: &Linkage, circuit: &Circuit, joint: JointId, tolerance: f64) -> Vec<Spline> {
    whole(&Trajectory::new(linkage, circuit, joint, tolerance), tolerance)
}

/// The whole path, which is fitted ten times as closely as the dashes on it.
fn whole(trajectory: &Trajectory, tolerance: f64) -> Vec<Spline> {
    if trajectory.curve.arcs.is_empty() {
        return Vec::new();
    }
    trajectory.splines(trajectory.range(), 0.1 * tolerance)
}

/// The path of a joint on a circuit.
///
/// No point of the curve is further than `tolerance` (in the plane's unit) from the splines. They have the tangents of the
/// curve at the ends of their segments; parts that are straight to a tenth of the tolerance, and dashes that are straight
/// to the tolerance, are lines. Where positions are undefined or jump, a spline ends and another one begins, and a dash,
/// too.
///
/// A stretch of the circuit on which the joint traces again what it has traced before, to rounding, has no dashes: at
/// other inputs, they would fill the gaps. A linkage whose source shows an arc has all dashes, for those traced first
/// may be outside the arc.
pub fn joint_path(
    linkage: &Linkage,
    circuit: &Circuit,
    joint: JointId,
    pattern: DashPattern,
    tolerance: f64,
) -> JointPath {
    let trajectory = Trajectory::new(linkage, circuit, joint, tolerance);
    if trajectory.curve.arcs.is_empty() {
        return JointPath::default();
    }
    let first_traced = match linkage.motion_options.figure_arc {
        Some(_) => vec![trajectory.range()],
        None => trajectory.first_traced_ranges(),
    };
    let ranges = dash_ranges(&trajectory, pattern);
    let mut dashes = Vec::with_capacity(ranges.len());
    for DashRange { range, is_in_figure } in ranges {
        for part in first_traced.iter().filter_map(|stretch| intersection(range, *stretch)) {
            let splines = trajectory.splines(part, tolerance);
            dashes.extend(splines.into_iter().map(|spline| Dash { spline, is_in_figure }));
        }
    }
    // Stretches that are next to each other may overlap by the rounding of the travel.
    let mut travelled = 0.0f64;
    let travel = |stretch: &[f64; 2]| {
        stretch.map(|t| {
            travelled = travelled.max(trajectory.travel(t));
            travelled
        })
    };
    JointPath {
        whole: whole(&trajectory, tolerance),
        dashes,
        dashed_travel: (first_traced != [trajectory.range()]).then(|| first_traced.iter().map(travel).collect()),
    }
}

/// The range that two ranges share; `None` if it has no length.
fn intersection([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Option<[f64; 2]> {
    let shared = [a.max(c), b.min(d)];
    (shared[0] < shared[1]).then_some(shared)
}
