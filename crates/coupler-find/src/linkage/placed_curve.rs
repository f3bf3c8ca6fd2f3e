//! A curve of any linkage where it is on a path.

use super::aim::{longest_link, pivots_of};
use crate::curve::CurveFit;
use crate::distinct::OUTLINE_POINTS;
use coupler_curves::family::Family;
use coupler_curves::geometry::{Point, Similarity, Vector};
use coupler_curves::linkage::{FourBar, JointId, Linkage, PlacedFourBar};
use coupler_curves::measure::{Measure, MeasureSet};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// A curve near a target, and its linkage.
#[derive(Clone, Debug)]
pub struct PlacedCurve {
    /// The numbers of its trace and circuit, from 1.
    pub numbers: [usize; 2],
    /// The name of the traced joint.
    pub joint: String,
    /// Where it is on the target, and how near.
    pub fit: CurveFit,
    /// The values of the template's parameters, in the unit of the linkage's own plane.
    pub values: Vec<f64>,
    /// Whether the linkage is as many times greater if all its lengths are.
    pub is_scalable: bool,
    /// The joints of the frame on which links turn, where they are on the target.
    pub pivots: Vec<(String, Point)>,
    /// The greatest distance of two joints of a link, in the unit of the target.
    pub longest_link: f64,
    /// The class; empty if it is no four-bar.
    pub class: &'static str,
    /// The worst transmission angle in degrees, NaN if there is none.
    pub mu_worst_deg: f64,
    /// Whether the input turns fully.
    pub is_full_turn: bool,
    /// The four-bar on the target, if it is one.
    pub four_bar: Option<PlacedFourBar>,
    /// Some points of the curve on the target, in their order.
    pub outline: Vec<Point>,
}

impl PlacedCurve {
    /// The measures that it has of its curve.
    pub const MEASURES: MeasureSet = MeasureSet::EMPTY.with(Measure::CLASS).with(Measure::MU_WORST);

    /// The curve of a solved cell where it fits the target. It is not yet known whether the linkage is scalable.
    pub fn new(family: &Family, solved: &SolvedCell, curve: &MeasuredCurve, fit: CurveFit) -> PlacedCurve {
        let circuit = solved.circuit(curve);
        let name = |joint: JointId| solved.linkage.joints[joint.index()].name.clone();
        let pivots = pivots_of(&solved.linkage)
            .map(|joint| (name(joint), fit.placement.apply(circuit.positions.point(joint, 0))));
        let step = circuit.len().div_ceil(OUTLINE_POINTS).max(1);
        PlacedCurve {
            numbers: [curve.trace, curve.circuit],
            joint: name(curve.joint),
            values: family.parameter_values(&solved.cell).to_vec(),
            is_scalable: false,
            pivots: pivots.collect(),
            longest_link: fit.placement.scale() * longest_link(&solved.linkage),
            class: curve.measure(Measure::CLASS).unwrap_or(""),
            mu_worst_deg: curve.measure(Measure::MU_WORST).unwrap_or(f64::NAN),
            is_full_turn: circuit.is_full_turn(),
            four_bar: placed_four_bar(&solved.linkage, curve.joint, &fit.placement),
            outline: circuit.points(curve.joint).step_by(step).map(|p| fit.placement.apply(p)).collect(),
            fit,
        }
    }
}

/// The four-bar in a linkage on the target; none if it is seen from a moving link.
fn placed_four_bar(linkage: &Linkage, joint: JointId, placement: &Similarity) -> Option<PlacedFourBar> {
    let PlacedFourBar { pivots, lengths: FourBar { frame, crank, coupler, rocker }, coupler_point } =
        PlacedFourBar::from_linkage(linkage, joint).ok().filter(|_| linkage.seen_from.is_none())?;
    let scale = placement.scale();
    let across = if placement.is_mirrored { -coupler_point.y } else { coupler_point.y };
    Some(PlacedFourBar {
        pivots: pivots.map(|pivot| placement.apply(pivot)),
        lengths: FourBar {
            frame: scale * frame,
            crank: scale * crank,
            coupler: scale * coupler,
            rocker: scale * rocker,
        },
        coupler_point: Vector::new(scale * coupler_point.x, scale * across),
    })
}
