//! Length, area and bounding box of the path.

use super::annulus::GOLDEN_SECTION;
use super::sampled_curve::SampledCurve;
use super::{Measure, TracedCurve, Value};
use crate::geometry::Vector;
use crate::linkage::{JointId, Linkage};
use crate::motion::{self, Circuit, Pass};

/// The measure `length`.
pub const LENGTH: Measure = Measure {
    name: "length",
    unit: "",
    is_word: false,
    definition: "length of the path over the circuit, in the manifest's unit",
    compute: |curve: &TracedCurve| Value::Number(curve.sampled_curve().arc_lengths().iter().sum()),
};

/// The measure `area`.
pub const AREA: Measure = Measure {
    name: "area",
    unit: "",
    is_word: false,
    definition: "area enclosed by the path, in the manifest's unit squared: positive counter-clockwise; empty if it is not closed",
    compute: |curve: &TracedCurve| curve.sampled_curve().area().map_or(Value::Missing, Value::Number),
};

/// The measures `bbox_x_min`, `bbox_x_max`, `bbox_y_min` and `bbox_y_max`.
pub const BOUNDING_BOX: [Measure; 4] = [
    Measure {
        name: "bbox_x_min",
        unit: "",
        is_word: false,
        definition: "least x of the curve",
        compute: |curve: &TracedCurve| extent_measure(curve, Vector::new(-1.0, 0.0)),
    },
    Measure {
        name: "bbox_x_max",
        unit: "",
        is_word: false,
        definition: "greatest x of the curve",
        compute: |curve: &TracedCurve| extent_measure(curve, Vector::new(1.0, 0.0)),
    },
    Measure {
        name: "bbox_y_min",
        unit: "",
        is_word: false,
        definition: "least y of the curve",
        compute: |curve: &TracedCurve| extent_measure(curve, Vector::new(0.0, -1.0)),
    },
    Measure {
        name: "bbox_y_max",
        unit: "",
        is_word: false,
        definition: "greatest y of the curve",
        compute: |curve: &TracedCurve| extent_measure(curve, Vector::new(0.0, 1.0)),
    },
];

fn extent_measure(curve: &TracedCurve, direction: Vector) -> Value {
    let samples = curve.sampled_curve();
    let Some(top) = samples.furthest_sample(direction) else { return Value::Missing };
    // Around a limit samples are far apart: poses of the linkage are computed there.
    let reach = match is_near_limit(curve, top) {
        true => direction.dot(&samples.points[top].coords).max(extent_by_poses(curve, direction, top)),
        false => samples.max_extent(direction, top),
    };
    // The least coordinate is the negative of the greatest in the opposite direction.
    Value::Number(if direction.x + direction.y < 0.0 { -reach } else { reach })
}

/// Whether a limit is at most two samples away.
fn is_near_limit(curve: &TracedCurve, i: usize) -> bool {
    let samples = curve.sampled_curve();
    let ends =
        || curve.circuit.passes.iter().flat_map(|pass| [pass.from, pass.to]).filter(|end| !end.flat_dyads.is_empty());
    let is_limit = |offset: isize| {
        samples.neighbour(i, offset).is_some_and(|k| ends().any(|end| end.input.value == samples.inputs[k]))
    };
    (-2..=2).any(is_limit)
}

/// The greatest extent in a direction between a sample and its neighbours, from poses of the linkage.
fn extent_by_poses(curve: &TracedCurve, direction: Vector, top: usize) -> f64 {
    let (samples, circuit) = (curve.sampled_curve(), curve.circuit);
    let (linkage, joint) = curve.single_point_linkage();
    let mut most = f64::NEG_INFINITY;
    for (from, to) in [(samples.neighbour(top, -1), Some(top)), (Some(top), samples.neighbour(top, 1))] {
        let (Some(from), Some(to)) = (from, to) else { continue };
        // The interval before a sample has the assembly mode of that sample, also if it is the end of a pass.
        let (low, high) = (samples.inputs[from].min(samples.inputs[to]), samples.inputs[from].max(samples.inputs[to]));
        let has_interval = |pass: &&Pass| {
            let [first, last] = pass.input_range();
            pass.mode == circuit.mode_at(samples.sample_indices[to]) && first <= low && high <= last
        };
        let Some(pass) = circuit.passes.iter().find(has_interval) else { continue };
        let height = |input: f64| {
            let at = motion::poses(linkage, pass, &[input]).point(joint, 0);
            direction.dot(&at.coords)
        };
        let (mut a, mut b) = (low, high);
        for _ in 0..30 {
            let (c, d) = (b - GOLDEN_SECTION * (b - a), a + GOLDEN_SECTION * (b - a));
            if height(c) > height(d) { b = d } else { a = c }
        }
        most = most.max(height((a + b) / 2.0));
    }
    most
}

/// The length of a joint's path from its first sample to each sample and, if the path is closed, back to the first; NaN
/// where the joint's position is undefined. The last value is the measure `length`.
pub fn cumulative_lengths(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Vec<f64> {
    let [curve, fine] =
        [circuit, circuit.refined(linkage)].map(|circuit| SampledCurve::from_circuit(circuit, joint, linkage.input()));
    let mut out = vec![f64::NAN; circuit.len() + usize::from(curve.is_closed)];
    let mut lengths = vec![0.0];
    for length in fine.arc_lengths() {
        lengths.push(lengths[lengths.len() - 1] + length);
    }
    for (k, &sample) in curve.sample_indices.iter().enumerate() {
        out[sample] = fine.length_at(curve.points[k], curve.input_travel[k], &lengths);
    }
    if let (true, Some(last)) = (curve.is_closed && !curve.sample_indices.is_empty(), out.last_mut()) {
        *last = lengths[lengths.len() - 1];
    }
    out
}
