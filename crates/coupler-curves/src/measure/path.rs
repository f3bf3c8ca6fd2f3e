use super::annulus::GOLDEN_SECTION;
use super::sampled_curve::SampledCurve;
use super::{Measure, TracedCurve, Value};
use crate::geometry::Vector;
use crate::linkage::{JointId, Linkage};
use crate::motion::{self, Circuit, Pass};

/// The length of the path.
pub const LENGTH: Measure = Measure {
    name: "length",
    unit: "",
    is_word: false,
    definition: "length of the path over the circuit, in the manifest's unit",
    compute: |subject: &TracedCurve| Value::Number(subject.sampled_curve().arc_lengths().iter().sum()),
};

/// The area inside it.
pub const AREA: Measure = Measure {
    name: "area",
    unit: "",
    is_word: false,
    definition: "area the path goes round, in the manifest's unit squared: positive counter-clockwise; empty where it does not close",
    compute: |subject: &TracedCurve| subject.sampled_curve().area().map_or(Value::Missing, Value::Number),
};

/// The box round it.
pub const BOUNDING_BOX: [Measure; 4] = [
    Measure {
        name: "bbox_x_min",
        unit: "",
        is_word: false,
        definition: "least x of the curve",
        compute: |subject: &TracedCurve| extent_measure(subject, Vector::new(-1.0, 0.0)),
    },
    Measure {
        name: "bbox_x_max",
        unit: "",
        is_word: false,
        definition: "greatest x of the curve",
        compute: |subject: &TracedCurve| extent_measure(subject, Vector::new(1.0, 0.0)),
    },
    Measure {
        name: "bbox_y_min",
        unit: "",
        is_word: false,
        definition: "least y of the curve",
        compute: |subject: &TracedCurve| extent_measure(subject, Vector::new(0.0, -1.0)),
    },
    Measure {
        name: "bbox_y_max",
        unit: "",
        is_word: false,
        definition: "greatest y of the curve",
        compute: |subject: &TracedCurve| extent_measure(subject, Vector::new(0.0, 1.0)),
    },
];

fn extent_measure(subject: &TracedCurve, direction: Vector) -> Value {
    let trail = subject.sampled_curve();
    let Some(top) = trail.furthest_sample(direction) else { return Value::Missing };
    // About a limit samples lie far apart: there the linkage itself is asked.
    let reach = match is_near_limit(subject, top) {
        true => direction.dot(&trail.points[top].coords).max(extent_by_poses(subject, direction, top)),
        false => trail.max_extent(direction, top),
    };
    // The least is the furthest the other way.
    Value::Number(if direction.x + direction.y < 0.0 { -reach } else { reach })
}

/// Whether a limit is no more than two samples away.
fn is_near_limit(subject: &TracedCurve, i: usize) -> bool {
    let trail = subject.sampled_curve();
    let ends =
        || subject.circuit.passes.iter().flat_map(|pass| [pass.from, pass.to]).filter(|end| !end.flat_dyads.is_empty());
    let is_limit =
        |off: isize| trail.neighbour(i, off).is_some_and(|k| ends().any(|end| end.input.value == trail.inputs[k]));
    (-2..=2).any(is_limit)
}

/// The greatest extent in a direction between a sample and its neighbours, by the poses there.
fn extent_by_poses(subject: &TracedCurve, direction: Vector, top: usize) -> f64 {
    let (trail, circuit) = (subject.sampled_curve(), subject.circuit);
    let (linkage, joint) = subject.single_point_linkage();
    let mut most = f64::NEG_INFINITY;
    for (from, to) in [(trail.neighbour(top, -1), Some(top)), (Some(top), trail.neighbour(top, 1))] {
        let (Some(from), Some(to)) = (from, to) else { continue };
        // The way to a sample has the sides that it has itself, be it the end of a pass.
        let (low, high) = (trail.inputs[from].min(trail.inputs[to]), trail.inputs[from].max(trail.inputs[to]));
        let is_way = |pass: &&Pass| {
            let [first, last] = pass.input_range();
            pass.mode == circuit.mode_at(trail.sample_indices[to]) && first <= low && high <= last
        };
        let Some(pass) = circuit.passes.iter().find(is_way) else { continue };
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

/// The length of a joint's path from its first sample to each sample, and, where it closes, to the first again at the
/// end; not a number where the joint has no place. The last of them is the measure `length`.
pub fn cumulative_lengths(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Vec<f64> {
    let [trail, fine] =
        [circuit, circuit.refined(linkage)].map(|circuit| SampledCurve::from_circuit(circuit, joint, linkage.input()));
    let mut out = vec![f64::NAN; circuit.len() + usize::from(trail.is_closed)];
    let mut lengths = vec![0.0];
    for length in fine.arc_lengths() {
        lengths.push(lengths[lengths.len() - 1] + length);
    }
    for (k, &sample) in trail.sample_indices.iter().enumerate() {
        out[sample] = fine.length_at(trail.points[k], trail.input_travel[k], &lengths);
    }
    if let (true, Some(last)) = (trail.is_closed && !trail.sample_indices.is_empty(), out.last_mut()) {
        *last = lengths[lengths.len() - 1];
    }
    out
}
