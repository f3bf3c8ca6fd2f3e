use super::trail::Trail;
use super::{Measure, Subject, Value};
use crate::geometry::Vector;
use crate::linkage::{JointId, Linkage};
use crate::motion::Circuit;

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
    let reach = subject.trail().reach(direction);
    // The least is the furthest the other way.
    Value::Number(if direction.x + direction.y < 0.0 { -reach } else { reach })
}

/// The length of a joint's path from its first sample to each sample, and, where it closes, to the first again at the
/// end; not a number where the joint has no place. The last of them is the measure `length`.
pub fn lengths_from_start(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Vec<f64> {
    let trail = Trail::of(circuit, joint, linkage.input());
    let mut out = vec![f64::NAN; circuit.len() + usize::from(trail.closed)];
    let mut length = 0.0;
    let lengths = trail.lengths();
    for (k, &sample) in trail.samples.iter().enumerate() {
        out[sample] = length;
        length += lengths.get(k).copied().unwrap_or(0.0);
    }
    if let (true, Some(last)) = (trail.closed && !trail.samples.is_empty(), out.last_mut()) {
        *last = length;
    }
    out
}
