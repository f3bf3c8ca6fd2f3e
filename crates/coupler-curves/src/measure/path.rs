//! Length, area and bounding box of the path.

use super::curve::{ArcLength, Place, SmoothCurve};
use super::{Measure, TracedCurve, Value};
use crate::geometry::Vector;
use crate::linkage::{JointId, Linkage};
use crate::motion::Circuit;

/// The measure `length`.
pub const LENGTH: Measure = Measure {
    name: "length",
    unit: "",
    is_word: false,
    definition: "length of the path over the circuit, in the manifest's unit",
    compute: |curve: &TracedCurve| Value::Number(curve.arc_length().total()),
};

/// The measure `area`.
pub const AREA: Measure = Measure {
    name: "area",
    unit: "",
    is_word: false,
    definition: "area enclosed by the path, in the manifest's unit squared: positive counter-clockwise; empty if it is not closed",
    compute: |curve: &TracedCurve| curve.smooth().area().map_or(Value::Missing, Value::Number),
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
    let Some((reach, _)) = curve.smooth().furthest(direction) else { return Value::Missing };
    // The least coordinate is the negative of the greatest in the opposite direction.
    Value::Number(if direction.x + direction.y < 0.0 { -reach } else { reach })
}

/// The length of a joint's path from its first sample to each sample and, if the path is closed, back to the first; NaN
/// where the joint's position is undefined. The last value is the measure `length`.
pub fn cumulative_lengths(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Vec<f64> {
    let pieces = circuit.pieces(linkage);
    let curve = SmoothCurve::new(pieces, joint, circuit.is_closed);
    let lengths = ArcLength::measure(&curve);
    let mut out = vec![f64::NAN; circuit.len() + usize::from(circuit.is_closed)];
    let mut from = 0;
    for (sample, point) in circuit.points(joint).enumerate() {
        if !(point.x.is_finite() && point.y.is_finite()) {
            continue;
        }
        // The first sample of a closed circuit is at the end of its last pass.
        let place = match sample {
            0 => Some(Place { piece: 0, u: -1.0 }),
            _ => curve.find(circuit.pass_at(sample), circuit.inputs[sample], from),
        };
        if let Some(place) = place {
            from = place.piece;
            out[sample] = lengths.at(place);
        }
    }
    if let (true, Some(last)) = (circuit.is_closed, out.last_mut()) {
        *last = lengths.total();
    }
    out
}
