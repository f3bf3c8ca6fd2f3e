//! Linkages of another size.

use std::sync::Arc;

use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::JointId;
use coupler_curves::measure::MeasureSet;
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_curves::template::{ParameterKind, Template};

/// Whether all positions are as many times greater if all parameters that are lengths are: no length is written as a number.
pub fn is_scalable(template: &Arc<Template>, values: &[f64]) -> bool {
    /// Not a power of 2, which would be exact.
    const FACTOR: f64 = 1.7;
    const ROUNDING: f64 = 1e-9;
    let solved = |factor: f64| {
        let scaled = template.parameters.iter().zip(scaled_values(template, values, factor));
        let given: Vec<(String, f64)> = scaled.map(|(parameter, value)| (parameter.name.clone(), value)).collect();
        let family = Family::single_cell(template.clone(), &given, Sampling::Samples(24)).ok()?;
        Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0)
    };
    let (Some(one), Some(other)) = (solved(1.0), solved(FACTOR)) else { return false };
    let positions = |solved: &SolvedCell| -> Vec<Point> {
        let circuits = solved.motion.circuits.iter();
        // A joint of the frame alone only gives a direction, or it gives a line that another one is on.
        let is_linked = |joint: &JointId| solved.linkage.links[1..].iter().any(|link| link.position(*joint).is_some());
        let joints = |circuit| solved.linkage.joint_ids().filter(is_linked).map(move |joint| (circuit, joint));
        let all = circuits.flat_map(joints).flat_map(|(circuit, joint): (&Circuit, _)| circuit.points(joint));
        all.collect()
    };
    let (one, other) = (positions(&one), positions(&other));
    let size = one.iter().map(|p| p.coords.norm()).filter(|norm| norm.is_finite()).fold(0.0, f64::max);
    one.len() == other.len()
        && one.iter().zip(&other).all(|(a, b)| {
            let off = (a.coords * FACTOR - b.coords).norm();
            off.is_nan() || off <= ROUNDING * size
        })
}

/// The values of parameters with the lengths among them multiplied.
pub fn scaled_values(template: &Template, values: &[f64], factor: f64) -> Vec<f64> {
    let scaled = template.parameters.iter().zip(values);
    scaled
        .map(|(parameter, value)| if parameter.kind == ParameterKind::Length { factor * value } else { *value })
        .collect()
}
