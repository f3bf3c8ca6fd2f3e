//! Smooth functions of the pose along a circuit: their stationary values, extremes and levels.
//!
//! On the pieces of a circuit the positions of all joints are polynomials in a parameter in which the motion is regular,
//! through limits and change points. A function of these positions is interpolated on the same pieces, which are halved
//! until its polynomials have converged, too. Stationary values are those where the derivatives of the polynomials are
//! zero.

mod monotonic;
mod places;
mod squared_distance;

pub(super) use monotonic::MonotonicPart;
pub(super) use places::Extreme;
pub(crate) use squared_distance::SquaredDistance;

use std::rc::Rc;

use super::budget::MAX_PARTS;
use crate::geometry::{Chebyshev, Point, TERMS, in_rising_order};
use crate::linkage::{AssemblyMode, JointId, Linkage};
use crate::motion::{Circuit, CircuitPiece, JointDerivatives, Pass};

/// The last coefficients of a polynomial that has converged, relative to the greatest value of the function.
const TOLERANCE: f64 = 1e-14;

/// Last coefficients that halving no longer makes smaller are rounding errors if they are below this, relative to the
/// greatest value of the function.
const GREATEST_ROUNDING: f64 = 1e-10;

/// A piece is halved no more often than this: then its ends are nearly one input.
const MAX_DEPTH: usize = 40;

/// Zeros closer than this part of a piece are one.
const NARROW: f64 = 8e-9;

/// The rounding of coordinates relative to the greatest of all joints.
const POSITION_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The error of a function's values, relative to the greatest, above which it is not told from rounding: an angle is known to
/// a thousandth of a degree, or not at all.
const GREATEST_ERROR: f64 = 1e-5;

/// A function of the pose that is smooth along every pass.
pub(crate) trait Quantity {
    /// The joints that the value is computed from.
    fn joints(&self) -> Vec<JointId>;

    /// The value in a pose.
    fn value(&self, pose: &Pose) -> f64;

    /// How much the value changes at most where one of its joints moves, per unit of length: how rounding of positions is
    /// magnified.
    fn sensitivity(&self, pose: &Pose) -> f64;

    /// The difference of values that are the same pose, 2 pi for an angle; `None` if there is none.
    fn period(&self) -> Option<f64> {
        None
    }
}

/// One function along a circuit serves the quantities of which only the range is needed.
impl Quantity for &dyn Quantity {
    fn joints(&self) -> Vec<JointId> {
        (**self).joints()
    }

    fn value(&self, pose: &Pose) -> f64 {
        (**self).value(pose)
    }

    fn sensitivity(&self, pose: &Pose) -> f64 {
        (**self).sensitivity(pose)
    }

    fn period(&self) -> Option<f64> {
        (**self).period()
    }
}

/// The joints of a quantity in a pose.
pub(crate) struct Pose<'a> {
    positions: &'a [(JointId, Point)],
    /// The assembly mode.
    pub mode: AssemblyMode,
}

impl Pose<'_> {
    /// The position of a joint.
    ///
    /// # Panics
    /// If the joint is not one of the quantity's.
    pub fn at(&self, joint: JointId) -> Point {
        let found = self.positions.iter().find(|(other, _)| *other == joint);
        found.map(|(_, point)| *point).expect("a joint of the quantity")
    }
}

/// The least and the greatest value of a quantity over a circuit of a linkage, also between samples; that of the samples where the quantity is undefined
/// at some place or too close to tell, such as one that does not change. `None` if it is nowhere defined.
pub(crate) fn range_over(circuit: &Circuit, linkage: &Linkage, quantity: &dyn Quantity) -> Option<[f64; 2]> {
    if let Ok(function) = CircuitFunction::new(circuit, [linkage; 2], quantity) {
        return Some(function.range());
    }
    let value = |sample: usize| {
        let position = |joint: JointId| (joint, circuit.positions.point(joint, sample));
        let positions: Vec<(JointId, Point)> = quantity.joints().into_iter().map(position).collect();
        quantity.value(&Pose { positions: &positions, mode: circuit.mode_at(sample) })
    };
    let values = || (0..circuit.len()).map(value).filter(|value| value.is_finite());
    Some([values().reduce(f64::min)?, values().reduce(f64::max)?])
}

/// Why there is no function along a circuit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoFunction {
    /// It is undefined somewhere.
    Undefined,
    /// It is too close to tell: its values are rounding, or it has more than [`MAX_PARTS`] parts.
    TooCloseToTell,
}

/// A function along a circuit.
#[derive(Clone, Debug)]
pub(super) struct CircuitFunction<Q> {
    /// The linkage without other traced points: its derivatives are faster to compute.
    linkage: Rc<Linkage>,
    quantity: Q,
    passes: Vec<Pass>,
    is_closed: bool,
    /// A bound of the rounding of coordinates.
    position_rounding: f64,
    /// In the order of the circuit; each continues the one before it.
    spans: Vec<FunctionSpan>,
}

/// A polynomial on a part of a circuit.
#[derive(Clone, Debug)]
struct FunctionSpan {
    piece: CircuitPiece,
    series: Chebyshev,
    /// Its derivative with respect to the parameter of the piece.
    slope: Chebyshev,
    /// The error of its values.
    noise: f64,
    /// The stationary points.
    roots: Vec<f64>,
    /// The input covered before it.
    input_before: f64,
    /// Whether the function may have a corner at its beginning.
    is_corner: bool,
}

/// A place on a circuit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// The index of the span.
    span: usize,
    /// The parameter on it, from -1 to 1.
    u: f64,
}

/// The coordinates of a quantity's joints on a part of a piece.
type JointSeries = Vec<(JointId, [Chebyshev; 2])>;

impl<Q: Quantity> CircuitFunction<Q> {
    /// A quantity along a circuit of a linkage, which is given also without other traced points.
    ///
    /// # Errors
    /// It is undefined somewhere, or too close to tell.
    pub fn new(
        circuit: &Circuit,
        [linkage, single_point_linkage]: [&Linkage; 2],
        quantity: Q,
    ) -> Result<CircuitFunction<Q>, NoFunction> {
        let pieces = circuit.pieces(linkage);
        let joints = quantity.joints();
        let mut function = CircuitFunction {
            linkage: Rc::new(single_point_linkage.clone()),
            passes: circuit.passes.clone(),
            is_closed: circuit.is_closed,
            position_rounding: POSITION_ROUNDING * pieces.positions().greatest_coordinate(),
            spans: Vec::with_capacity(pieces.len()),
            quantity,
        };
        let mut greatest = if function.quantity.period().is_some() { 1.0 } else { 0.0 };
        let mut input_before = 0.0;
        for (k, piece) in pieces.pieces.iter().enumerate() {
            let series: JointSeries = joints.iter().map(|&joint| (joint, pieces.series(k, joint))).collect();
            let first = function.spans.len();
            function.append(*piece, &series, f64::INFINITY, MAX_DEPTH, &mut greatest)?;
            function.spans[first].is_corner = pieces.corners[k];
            for span in &mut function.spans[first..] {
                span.input_before = input_before;
                input_before += span.piece.input_travel();
            }
        }
        if function.spans.is_empty() {
            // The input moves by less than a rounding from one limit to the other.
            return Err(NoFunction::TooCloseToTell);
        }
        for span in &mut function.spans {
            // A derivative of a polynomial amplifies the error of its values by up to the square of its degree.
            let zeros = span.slope.zeros(span.noise * (TERMS * TERMS) as f64, NARROW);
            // Where the function only pauses, the derivative touches zero.
            let mut roots = zeros.places;
            roots.extend(zeros.doubtful);
            span.roots = in_rising_order(roots, |u| *u);
            span.roots.dedup_by(|b, a| *b - *a <= 4.0 * NARROW);
        }
        Ok(function)
    }

    /// Appends the spans of a piece.
    fn append(
        &mut self,
        piece: CircuitPiece,
        joints: &JointSeries,
        tail_before: f64,
        depth: usize,
        greatest: &mut f64,
    ) -> Result<(), NoFunction> {
        let (mut values, sensitivity) = self.values_at_nodes(&piece, joints);
        if values.iter().any(|value| !value.is_finite()) {
            return Err(NoFunction::Undefined);
        }
        if let Some(period) = self.quantity.period() {
            let before = self.spans.last().map(|span| span.series.at_end());
            let mut near = before.unwrap_or(values[0]);
            for value in &mut values {
                *value += period * ((near - *value) / period).round();
                near = *value;
            }
        }
        let series = Chebyshev::from_values(&values);
        *greatest = greatest.max(series.bound());
        let tail = series.0[TERMS - 3..].iter().fold(0.0f64, |tail, c| tail.max(c.abs()));
        let error = self.position_rounding * sensitivity;
        let is_rounding = tail <= (GREATEST_ROUNDING * *greatest).max(error) && tail > tail_before / 8.0;
        if is_rounding && tail > GREATEST_ERROR * *greatest || self.spans.len() >= MAX_PARTS {
            return Err(NoFunction::TooCloseToTell);
        }
        if tail <= TOLERANCE * *greatest || is_rounding || depth == 0 {
            self.spans.push(FunctionSpan {
                piece,
                slope: series.derivative(),
                noise: tail.max(f64::EPSILON * *greatest),
                series,
                roots: Vec::new(),
                input_before: 0.0,
                is_corner: false,
            });
            return Ok(());
        }
        let halves: Vec<(JointId, [[Chebyshev; 2]; 2])> =
            joints.iter().map(|(joint, series)| (*joint, series.each_ref().map(Chebyshev::halves))).collect();
        for (half, part) in [[-1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let of_half = halves.iter().map(|(joint, [x, y])| (*joint, [x[half], y[half]])).collect();
            self.append(piece.restricted(part), &of_half, tail, depth - 1, greatest)?;
        }
        Ok(())
    }

    /// The values at the nodes of a piece, and the greatest sensitivity there.
    fn values_at_nodes(&self, piece: &CircuitPiece, joints: &JointSeries) -> ([f64; TERMS], f64) {
        let columns: Vec<(JointId, [[f64; TERMS]; 2])> =
            joints.iter().map(|(joint, series)| (*joint, series.each_ref().map(Chebyshev::values))).collect();
        let mut positions: Vec<(JointId, Point)> = joints.iter().map(|(joint, _)| (*joint, Point::origin())).collect();
        let mut sensitivity = 0.0f64;
        let values = std::array::from_fn(|node| {
            for ((_, point), (_, [x, y])) in positions.iter_mut().zip(&columns) {
                *point = Point::new(x[node], y[node]);
            }
            let mode = self.passes[piece.pass_at(Chebyshev::nodes()[node])].mode;
            let pose = Pose { positions: &positions, mode };
            sensitivity = sensitivity.max(self.quantity.sensitivity(&pose));
            self.quantity.value(&pose)
        });
        (values, sensitivity)
    }

    /// The value at a place.
    pub fn value(&self, place: Place) -> f64 {
        self.spans[place.span].series.at(place.u)
    }

    /// The input at a place.
    pub fn input(&self, place: Place) -> f64 {
        self.spans[place.span].piece.map.input(place.u)
    }

    /// The input covered from the start of the circuit to a place, which is counted forward and backward at limits.
    pub fn covered_input(&self, place: Place) -> f64 {
        let span = &self.spans[place.span];
        span.input_before + span.piece.input_travel_to(place.u)
    }

    /// The input that the whole circuit covers.
    pub fn total_input(&self) -> f64 {
        self.passes.iter().map(Pass::input_length).sum()
    }

    /// The pass at a place.
    pub fn pass(&self, place: Place) -> &Pass {
        &self.passes[self.spans[place.span].piece.pass_at(place.u)]
    }

    /// The change of the function around the circuit: 0, or whole turns of an angle, if the circuit is closed.
    pub fn change(&self) -> f64 {
        match (self.spans.first(), self.spans.last()) {
            (Some(first), Some(last)) => last.series.at_end() - first.series.at_start(),
            _ => 0.0,
        }
    }

    /// The exact positions and derivatives of the joints at a place.
    pub fn derivatives(&self, place: Place) -> JointDerivatives {
        JointDerivatives::on_pass(&self.linkage, self.pass(place), self.input(place))
    }

    /// The quantity.
    pub fn quantity(&self) -> &Q {
        &self.quantity
    }

    /// Whether the circuit is closed.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }
}
