//! Length, area and bounding box of the path.

use super::curve::{ArcLength, Place, SmoothCurve};
use super::{Measure, TracedCurve, Value, without_rounding};
use crate::geometry::Vector;
use crate::linkage::{JointId, Linkage};
use crate::motion::Circuit;

/// The measure `length`.
pub const LENGTH: Measure = Measure::number(
    "length",
    "length of the curve",
    "",
    "length of the path over the circuit, in the manifest's unit",
    |curve: &TracedCurve| {
        let length = Some(curve.arc_length()).filter(|length| length.is_known());
        length.map_or(Value::Missing, |length| Value::Number(length.total()))
    },
);

/// The measure `area`.
pub const AREA: Measure = Measure::number(
    "area",
    "area enclosed by the curve",
    "",
    "area enclosed by the path, in the manifest's unit squared: positive counter-clockwise; empty if it is not closed",
    |curve: &TracedCurve| {
        let rounding = ROUNDING * curve.extent() * curve.extent();
        curve.smooth().area().map_or(Value::Missing, |area| Value::Number(without_rounding(area, rounding)))
    },
);

/// The accuracy of coordinates relative to the extent, and of areas relative to its square.
const ROUNDING: f64 = 1e-12;

/// The measures `bbox_x_min`, `bbox_x_max`, `bbox_y_min` and `bbox_y_max`.
pub const BOUNDING_BOX: [Measure; 4] = [
    Measure::number("bbox_x_min", "least x of the curve", "", "least x of the curve", |curve: &TracedCurve| {
        extent_measure(curve, Vector::new(-1.0, 0.0))
    }),
    Measure::number("bbox_x_max", "greatest x of the curve", "", "greatest x of the curve", |curve: &TracedCurve| {
        extent_measure(curve, Vector::new(1.0, 0.0))
    }),
    Measure::number("bbox_y_min", "least y of the curve", "", "least y of the curve", |curve: &TracedCurve| {
        extent_measure(curve, Vector::new(0.0, -1.0))
    }),
    Measure::number("bbox_y_max", "greatest y of the curve", "", "greatest y of the curve", |curve: &TracedCurve| {
        extent_measure(curve, Vector::new(0.0, 1.0))
    }),
];

/// The measures `bbox_width` and `bbox_height`.
pub const SIZE: [Measure; 2] = [
    Measure::number(
        "bbox_width",
        "width of the curve",
        "",
        "greatest less least x of the curve: of the foot of a leg that walks along x its stride",
        |curve: &TracedCurve| size_measure(curve, Vector::new(1.0, 0.0)),
    ),
    Measure::number(
        "bbox_height",
        "height of the curve",
        "",
        "greatest less least y of the curve: of the foot of a leg that walks along x its lift",
        |curve: &TracedCurve| size_measure(curve, Vector::new(0.0, 1.0)),
    ),
];

fn size_measure(curve: &TracedCurve, direction: Vector) -> Value {
    let ends = [direction, -direction].map(|direction| curve.smooth().furthest(direction));
    let [Some((most, _)), Some((least, _))] = ends else { return Value::Missing };
    Value::Number(without_rounding(most + least, ROUNDING * curve.extent()))
}

fn extent_measure(curve: &TracedCurve, direction: Vector) -> Value {
    let Some((reach, _)) = curve.smooth().furthest(direction) else { return Value::Missing };
    let reach = without_rounding(reach, ROUNDING * curve.extent());
    // The least coordinate is the negative of the greatest in the opposite direction.
    Value::Number(if direction.x + direction.y < 0.0 { -reach } else { reach })
}

/// The length of a joint's path from its first sample to each sample and, if the path is closed, back to the first; NaN
/// where the joint's position is undefined, and everywhere if the length is too close to tell. The last value is the measure `length`.
pub fn cumulative_lengths(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Vec<f64> {
    let pieces = circuit.pieces(linkage);
    let curve = SmoothCurve::new(pieces, joint, circuit.is_closed);
    let lengths = ArcLength::measure(&curve);
    let mut out = vec![f64::NAN; circuit.len() + usize::from(circuit.is_closed)];
    if !lengths.is_known() {
        return out;
    }
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
