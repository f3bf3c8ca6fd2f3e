use super::annulus::GOLDEN;
use super::trail::Trail;
use super::{Measure, Subject, Value};
use crate::geometry::Vector;
use crate::linkage::{JointId, Linkage};
use crate::motion::{self, Circuit, Pass};

/// The length of the path.
pub const LENGTH: Measure = Measure {
    name: "length",
    unit: "",
    is_word: false,
    definition: "length of the path over the circuit, in the manifest's unit",
    take: |subject: &Subject| Value::Number(subject.trail().lengths().iter().sum()),
};

/// The area inside it.
pub const AREA: Measure = Measure {
    name: "area",
    unit: "",
    is_word: false,
    definition: "area the path goes round, in the manifest's unit squared: positive counter-clockwise; empty where it does not close",
    take: |subject: &Subject| subject.trail().area().map_or(Value::Missing, Value::Number),
};

/// The box round it.
pub const BOX: [Measure; 4] = [
    Measure {
        name: "bbox_x_min",
        unit: "",
        is_word: false,
        definition: "least x of the curve",
        take: |subject: &Subject| reach(subject, Vector::new(-1.0, 0.0)),
    },
    Measure {
        name: "bbox_x_max",
        unit: "",
        is_word: false,
        definition: "greatest x of the curve",
        take: |subject: &Subject| reach(subject, Vector::new(1.0, 0.0)),
    },
    Measure {
        name: "bbox_y_min",
        unit: "",
        is_word: false,
        definition: "least y of the curve",
        take: |subject: &Subject| reach(subject, Vector::new(0.0, -1.0)),
    },
    Measure {
        name: "bbox_y_max",
        unit: "",
        is_word: false,
        definition: "greatest y of the curve",
        take: |subject: &Subject| reach(subject, Vector::new(0.0, 1.0)),
    },
];

fn reach(subject: &Subject, direction: Vector) -> Value {
    let trail = subject.trail();
    let Some(top) = trail.top(direction) else { return Value::Missing };
    // About a limit samples lie far apart: there the linkage itself is asked.
    let reach = match at_limit(subject, top) {
        true => direction.dot(&trail.points[top].coords).max(posed(subject, direction, top)),
        false => trail.reach(direction, top),
    };
    // The least is the furthest the other way.
    Value::Number(if direction.x + direction.y < 0.0 { -reach } else { reach })
}

/// Whether a limit is no more than two samples away.
fn at_limit(subject: &Subject, i: usize) -> bool {
    let trail = subject.trail();
    let ends = || subject.circuit.passes.iter().flat_map(|pass| [pass.from, pass.to]).filter(|end| !end.flat.is_none());
    let is_limit = |off: isize| trail.at(i, off).is_some_and(|k| ends().any(|end| end.stop.at == trail.inputs[k]));
    (-2..=2).any(is_limit)
}

/// The greatest extent in a direction between a sample and its neighbours, by the poses there.
fn posed(subject: &Subject, direction: Vector, top: usize) -> f64 {
    let (trail, circuit) = (subject.trail(), subject.circuit);
    let (linkage, joint) = subject.alone();
    let mut most = f64::NEG_INFINITY;
    for (from, to) in [(trail.at(top, -1), Some(top)), (Some(top), trail.at(top, 1))] {
        let (Some(from), Some(to)) = (from, to) else { continue };
        // The way to a sample has the sides that it has itself, be it the end of a pass.
        let (low, high) = (trail.inputs[from].min(trail.inputs[to]), trail.inputs[from].max(trail.inputs[to]));
        let is_way = |pass: &&Pass| {
            let [first, last] = pass.range();
            pass.signs == circuit.signs(trail.samples[to]) && first <= low && high <= last
        };
        let Some(pass) = circuit.passes.iter().find(is_way) else { continue };
        let height = |input: f64| {
            let at = motion::poses(linkage, pass, &[input]).point(joint, 0);
            direction.dot(&at.coords)
        };
        let (mut a, mut b) = (low, high);
        for _ in 0..30 {
            let (c, d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
            if height(c) > height(d) { b = d } else { a = c }
        }
        most = most.max(height((a + b) / 2.0));
    }
    most
}

/// The length of a joint's path from its first sample to each sample, and, where it closes, to the first again at the
/// end; not a number where the joint has no place. The last of them is the measure `length`.
pub fn lengths_from_start(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Vec<f64> {
    let [trail, fine] = [circuit, circuit.finely(linkage)].map(|circuit| Trail::of(circuit, joint, linkage.input()));
    let mut out = vec![f64::NAN; circuit.len() + usize::from(trail.closed)];
    let mut lengths = vec![0.0];
    for length in fine.lengths() {
        lengths.push(lengths[lengths.len() - 1] + length);
    }
    for (k, &sample) in trail.samples.iter().enumerate() {
        out[sample] = fine.length_up_to(trail.points[k], trail.travel[k], &lengths);
    }
    if let (true, Some(last)) = (trail.closed && !trail.samples.is_empty(), out.last_mut()) {
        *last = lengths[lengths.len() - 1];
    }
    out
}
