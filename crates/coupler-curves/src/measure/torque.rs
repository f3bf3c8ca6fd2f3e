//! The input torque against a load, by virtual work, and its extremes over a circuit.
//!
//! On each piece of a circuit the position of the joint and the input are polynomials of one parameter, and the velocity by the input is a
//! quotient of their derivatives. The extremes of the torque are where the numerator of its derivative is zero, at the ends of pieces, and
//! at limits of the input; the values there are computed from the pose itself.

use super::budget::{MAX_PARTS, Steps, TooManySteps};
use super::curve::{Arc, SmoothCurve};
use super::features::InputTorque;
use super::{Measure, Subject, TracedCurve, Value, start_input};
use crate::geometry::{Chebyshev, TERMS, Vector, in_rising_order, trig};
use crate::linkage::{Input, Linkage, Load};
use crate::motion::{InputMap, JointDerivatives, Pass};

/// The measure `torque_peak`.
pub const TORQUE_PEAK: Measure = Measure::number(
    "torque_peak",
    "greatest input torque",
    "",
    "greatest magnitude of the input torque against the load, without friction and masses: its force times a length; inf at a limit that its joint passes",
    |curve| torque_value(curve, |torque| torque.peak),
)
.of(Subject::WithLoad);

/// The measure `torque_peak_deg`.
pub const TORQUE_PEAK_INPUT: Measure = Measure::number(
    "torque_peak_deg",
    "input at the greatest input torque",
    "deg",
    "input at which the input torque is greatest; of several the first on the circuit",
    |curve| torque_value(curve, |torque| start_input(curve, torque.peak_input)),
)
.at_input()
.or_length("torque_peak_length")
.of(Subject::WithLoad);

/// The measure `torque_min`.
pub const TORQUE_MIN: Measure = Measure::number(
    "torque_min",
    "least input torque",
    "",
    "least input torque: negative where the load drives the input; -inf at a limit",
    |curve| torque_value(curve, |torque| torque.range[0]),
)
.of(Subject::WithLoad);

/// The measure `torque_max`.
pub const TORQUE_MAX: Measure = Measure::number(
    "torque_max",
    "greatest input torque in the direction of the input",
    "",
    "greatest input torque in the direction in which the input rises; inf at a limit",
    |curve| torque_value(curve, |torque| torque.range[1]),
)
.of(Subject::WithLoad);

/// The torque with which the drive holds or moves a linkage against its load in a pose of a pass, or its force where the input is a length,
/// positive in the direction in which the input rises; `None` without a load. At a limit that its joint passes it is infinite.
pub fn input_torque(linkage: &Linkage, pass: &Pass, derivatives: &JointDerivatives) -> Option<f64> {
    let load = linkage.load?;
    let rounding = SPEED_ROUNDING * derivatives.greatest_speed();
    Some(load.torque(derivatives.velocity(load.joint), rounding, linkage.placement, pass.input_direction()))
}

/// The rounding of a velocity, relative to the fastest joint of the linkage: across the straight lines of inversors it is up to 5e-16 of it far from
/// limits, and between 1e-12 and 1e-11 at the samples next to them.
const SPEED_ROUNDING: f64 = 1e-11;

/// A value of a linkage with a load; missing for others.
fn torque_value(curve: &TracedCurve, value: impl Fn(&InputTorque) -> f64) -> Value {
    curve.input_torque().ok().flatten().map_or(Value::Missing, |torque| Value::Number(value(&torque)))
}

impl TracedCurve<'_> {
    /// The extremes of the input torque; `None` without a load, and where the position of its joint is undefined somewhere.
    ///
    /// # Errors
    /// The search takes too many steps.
    pub(super) fn input_torque(&self) -> Result<Option<InputTorque>, TooManySteps> {
        *self.circuit_results.0.input_torque.get_or_init(|| match self.linkage.load {
            Some(load) => TorqueSearch::new(self, load).extremes(),
            None => Ok(None),
        })
    }
}

/// A place on a circuit: the index of a piece, and the parameter on it.
type Place = (usize, f64);

/// The search for the extremes of the torque.
struct TorqueSearch<'a> {
    curve: &'a TracedCurve<'a>,
    load: Load,
    /// Of a load that keeps its direction.
    force: Option<Vector>,
    /// The curve of its joint.
    path: SmoothCurve,
}

impl<'a> TorqueSearch<'a> {
    fn new(curve: &'a TracedCurve<'a>, load: Load) -> TorqueSearch<'a> {
        let path = SmoothCurve::new(curve.circuit.pieces(curve.linkage), load.joint, curve.circuit.is_closed);
        TorqueSearch { curve, load, force: load.vector(curve.linkage.placement), path }
    }

    fn extremes(&self) -> Result<Option<InputTorque>, TooManySteps> {
        /// A difference that is rounding, relative to the greatest.
        const ROUNDING: f64 = 1e-10;
        if self.path.arcs.len() < self.curve.circuit.pieces(self.curve.linkage).len() {
            return Ok(None);
        }
        let steps = Steps::new(MAX_PARTS);
        let mut places: Vec<Place> = Vec::new();
        for (piece, arc) in self.path.arcs.iter().enumerate() {
            places.extend([-1.0, 1.0].map(|u| (piece, u)));
            places.extend(self.limit(piece).map(|u| (piece, u)));
            self.find_stationary(piece, ([-1.0, 1.0], arc.clone()), &mut places, &steps)?;
        }
        // Parameters are between -1 and 1.
        let places = in_rising_order(places, |&(piece, u)| 4.0 * piece as f64 + u);
        let torques: Vec<(f64, f64)> = places
            .into_iter()
            .flat_map(|(piece, u)| {
                let input = self.path.pieces[piece].map.input(u);
                self.torques_at((piece, u)).map(|torque| (torque, input))
            })
            .collect();
        let range = torques.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], (t, _)| [l.min(*t), h.max(*t)]);
        let peak = range[0].abs().max(range[1].abs());
        let is_peak = |torque: f64| torque.abs() >= peak * (1.0 - ROUNDING);
        let first = torques.iter().find(|(torque, _)| is_peak(*torque));
        Ok(first.map(|&(_, peak_input)| InputTorque { range, peak, peak_input }))
    }

    /// The parameter of the limit of the input on a piece, if there is one.
    fn limit(&self, piece: usize) -> Option<f64> {
        match self.path.pieces[piece].map {
            InputMap::Root { middle, half, .. } if middle.abs() <= half * (1.0 + 1e-9) => {
                Some((-middle / half).clamp(-1.0, 1.0))
            }
            _ => None,
        }
    }

    /// Adds the places on a part of a piece at which the torque is stationary.
    fn find_stationary(
        &self,
        piece: usize,
        ([from, to], arc): ([f64; 2], Arc),
        places: &mut Vec<Place>,
        steps: &Steps,
    ) -> Result<(), TooManySteps> {
        /// The last terms of a series that is resolved, relative to all.
        const RESOLVED: f64 = 1e-10;
        /// The least part of a piece.
        const LEAST: f64 = 1e-6;
        /// Zeros closer than this part of a piece are one.
        const NARROW: f64 = 8e-9;
        steps.take(1)?;
        let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
        let map = self.path.pieces[piece].map;
        let [velocity, acceleration, _] = arc.derivatives_at_nodes();
        let [first, second] = [-1.0, 1.0].map(|u| map.input_rate(middle + half * u) * half);
        let input_acceleration = (second - first) / 2.0;
        // With P the position, t the input and u the parameter: t'^3 d(F.P')/dt = F.P'' t' - F.P' t'', and half of t'^4 times the derivative
        // of the square of the speed with P' for F.
        let numerator = |j: usize| {
            let along = self.force.unwrap_or(velocity[j]);
            let input_rate = map.input_rate(middle + half * Chebyshev::nodes()[j]) * half;
            along.dot(&acceleration[j]) * input_rate - along.dot(&velocity[j]) * input_acceleration
        };
        let series = Chebyshev::from_values(&std::array::from_fn(numerator));
        let [_, second_rounding, _] = self.path.derivative_rounding();
        let greatest = velocity.iter().map(Vector::norm).fold(0.0, f64::max);
        let input_rate = first.abs().max(second.abs());
        let rounding = self.force.map_or(greatest, |force| force.norm()) * second_rounding * input_rate;
        let tail = series.0[TERMS - 2].abs().max(series.0[TERMS - 1].abs());
        if tail <= (RESOLVED * series.bound()).max(rounding) || half < LEAST {
            let zeros = series.zeros(rounding, NARROW);
            places.extend(zeros.places.into_iter().chain(zeros.doubtful).map(|u| (piece, middle + half * u)));
            return Ok(());
        }
        let [left, right] = arc.halves();
        self.find_stationary(piece, ([from, middle], left), places, steps)?;
        self.find_stationary(piece, ([middle, to], right), places, steps)
    }

    /// The torques before and after a place: from the derivatives of the pose, or, where these are not defined or have few exact digits, as
    /// next to a change point, from the polynomials; infinite at a limit that the joint passes.
    fn torques_at(&self, (k, u): Place) -> [f64; 2] {
        /// The difference, relative to both, above which the derivatives of the pose are not exact.
        const DIFFERENT: f64 = 1e-6;
        let (linkage, piece) = (self.curve.linkage, &self.path.pieces[k]);
        let arc = &self.path.arcs[k];
        let passes = &self.curve.circuit.passes;
        let velocity = Vector::new(arc.velocity[0].at(u), arc.velocity[1].at(u));
        let torque = |velocity: Vector, rounding: f64, direction: f64| {
            self.load.torque(velocity, rounding, linkage.placement, direction)
        };
        let is_close = |exact: &Vector, found: &Vector| (exact - found).norm() <= DIFFERENT * found.norm();
        let per_input = |velocity: Vector| match linkage.input() {
            Input::Length => velocity,
            Input::Angle { .. } => velocity.map(trig::degrees),
        };
        if self.is_at_limit(k, u) {
            let InputMap::Root { direction, half, .. } = piece.map else { return [f64::NAN; 2] };
            // Before the limit the input moves in its direction; a piece that ends there has one side of it.
            let senses = match u {
                -1.0 => [-direction; 2],
                1.0 => [direction; 2],
                _ => [direction, -direction],
            };
            let passed = match self.force {
                Some(force) => force.dot(&velocity).abs() / force.norm(),
                None => velocity.norm(),
            };
            // A derivative of a polynomial amplifies the rounding of its values by up to the square of its degree; the limit itself is known
            // to the root of the rounding of an input.
            let noise = self.path.derivative_rounding()[0].max(1e-7 * arc.greatest_speed());
            if passed > noise {
                return senses.map(|sense| torque(velocity * sense, 0.0, sense).signum() * f64::INFINITY);
            }
            let second = arc.velocity.each_ref().map(|series| series.derivative().at(u));
            let scale = -2.0 * direction * half * half;
            let velocity = per_input(Vector::new(second[0], second[1]) / scale);
            let exact = self.velocity_at_limit(&passes[piece.pass_at(u)], piece.map.input(u));
            if is_close(&exact, &velocity) {
                let rounding = SPEED_ROUNDING * exact.norm();
                return senses.map(|sense| torque(exact, rounding, sense));
            }
            let across = self.force.map_or(velocity, |force| {
                let unit = force.normalize();
                unit * unit.dot(&velocity)
            });
            let rounding = per_input(Vector::new(self.path.derivative_rounding()[1] / scale, 0.0)).norm();
            return senses.map(|sense| torque(across, rounding, sense));
        }
        let pass = &passes[piece.pass_at(u)];
        let sense = pass.input_direction();
        let interpolated = per_input(velocity / piece.map.input_rate(u));
        let derivatives = JointDerivatives::on_pass(linkage, pass, piece.map.input(u));
        let exact = derivatives.velocity(self.load.joint);
        if is_close(&exact, &interpolated) {
            return [torque(exact, SPEED_ROUNDING * derivatives.greatest_speed(), sense); 2];
        }
        let rounding = Vector::new(self.path.derivative_rounding()[0] / piece.map.input_rate(u), 0.0);
        [torque(interpolated, per_input(rounding).norm(), sense); 2]
    }

    /// The velocity of the joint by the input at the end of a pass that is nearest to an input; not finite if the joint passes the limit there.
    fn velocity_at_limit(&self, pass: &Pass, input: f64) -> Vector {
        let distance = |end: &f64| (end - input).abs();
        let [from, to] = [pass.from, pass.to].map(|end| end.input.value);
        let end = if distance(&from) < distance(&to) { from } else { to };
        JointDerivatives::on_pass(self.curve.linkage, pass, end).velocity(self.load.joint)
    }

    /// Whether a place is at a limit of the input.
    fn is_at_limit(&self, piece: usize, u: f64) -> bool {
        const NEAR: f64 = 1e-7;
        match self.path.pieces[piece].map {
            InputMap::Root { middle, half, .. } => {
                let pass = &self.curve.circuit.passes[self.path.pieces[piece].pass_at(u)];
                (middle + half * u).abs() <= NEAR * pass.input_length().sqrt()
            }
            InputMap::Linear { .. } => false,
        }
    }
}
