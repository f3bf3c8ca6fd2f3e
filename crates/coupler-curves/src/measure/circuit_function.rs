//! Smooth functions of the pose along a circuit: their stationary values, extremes and levels.
//!
//! On the pieces of a circuit the positions of all joints are polynomials in a parameter in which the motion is regular,
//! through limits and change points. A function of these positions is interpolated on the same pieces, which are halved
//! until its polynomials have converged, too. Stationary values are those where the derivatives of the polynomials are
//! zero.

use std::rc::Rc;

use super::TracedCurve;
use crate::geometry::{Chebyshev, Point, TERMS, in_rising_order, trig};
use crate::linkage::{AssemblyMode, Input, JointId, Linkage};
use crate::motion::{CircuitPiece, InputMap, JointDerivatives, Pass};

/// The last coefficients of a polynomial that has converged, relative to the greatest value of the function.
const TOLERANCE: f64 = 1e-14;

/// Last coefficients that halving no longer makes smaller are rounding errors if they are below this, relative to the
/// greatest value of the function.
const GREATEST_ROUNDING: f64 = 1e-10;

/// A piece is halved no more often than this: then its ends are nearly one input.
const MAX_DEPTH: usize = 40;

/// Zeros closer than this part of a piece are one.
const NARROW: f64 = 8e-9;

/// A function of the pose that is smooth along every pass.
pub(super) trait Quantity {
    /// The joints that the value is computed from.
    fn joints(&self) -> Vec<JointId>;

    /// The value in a pose.
    fn value(&self, pose: &Pose) -> f64;

    /// The difference of values that are the same pose, 2 pi for an angle; `None` if there is none.
    fn period(&self) -> Option<f64> {
        None
    }
}

/// The joints of a quantity in a pose.
pub(super) struct Pose<'a> {
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

/// A function along a circuit.
#[derive(Clone, Debug)]
pub(super) struct CircuitFunction<Q> {
    /// The linkage without other traced points: its derivatives are faster to compute.
    linkage: Rc<Linkage>,
    quantity: Q,
    passes: Vec<Pass>,
    is_closed: bool,
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
    /// A quantity along the circuit of a curve; `None` if it is undefined somewhere.
    pub fn new(curve: &TracedCurve, quantity: Q) -> Option<CircuitFunction<Q>> {
        let circuit = curve.circuit;
        let pieces = circuit.pieces(curve.linkage);
        let joints = quantity.joints();
        let mut function = CircuitFunction {
            linkage: Rc::new(curve.single_point_linkage().0.clone()),
            passes: circuit.passes.clone(),
            is_closed: circuit.is_closed,
            spans: Vec::with_capacity(pieces.len()),
            quantity,
        };
        let mut greatest = if function.quantity.period().is_some() { 1.0 } else { 0.0 };
        let mut input_before = 0.0;
        for (k, piece) in pieces.pieces.iter().enumerate() {
            let series: JointSeries = joints.iter().map(|&joint| (joint, pieces.series(k, joint))).collect();
            let first = function.spans.len();
            function.append(*piece, &series, (f64::INFINITY, MAX_DEPTH), &mut greatest)?;
            function.spans[first].is_corner = pieces.corners[k];
            for span in &mut function.spans[first..] {
                span.input_before = input_before;
                input_before += span.piece.input_travel();
            }
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
        Some(function)
    }

    /// Appends the spans of a piece.
    fn append(
        &mut self,
        piece: CircuitPiece,
        joints: &JointSeries,
        (tail_before, depth): (f64, usize),
        greatest: &mut f64,
    ) -> Option<()> {
        let mut values = self.values_at_nodes(&piece, joints);
        if values.iter().any(|value| !value.is_finite()) {
            return None;
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
        let is_rounding = tail <= GREATEST_ROUNDING * *greatest && tail > tail_before / 8.0;
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
            return Some(());
        }
        let halves: Vec<(JointId, [[Chebyshev; 2]; 2])> =
            joints.iter().map(|(joint, series)| (*joint, series.each_ref().map(Chebyshev::halves))).collect();
        for (half, part) in [[-1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let of_half = halves.iter().map(|(joint, [x, y])| (*joint, [x[half], y[half]])).collect();
            self.append(piece.restricted(part), &of_half, (tail, depth - 1), greatest)?;
        }
        Some(())
    }

    fn values_at_nodes(&self, piece: &CircuitPiece, joints: &JointSeries) -> [f64; TERMS] {
        let columns: Vec<(JointId, [[f64; TERMS]; 2])> =
            joints.iter().map(|(joint, series)| (*joint, series.each_ref().map(Chebyshev::values))).collect();
        let mut positions: Vec<(JointId, Point)> = joints.iter().map(|(joint, _)| (*joint, Point::origin())).collect();
        std::array::from_fn(|node| {
            for ((_, point), (_, [x, y])) in positions.iter_mut().zip(&columns) {
                *point = Point::new(x[node], y[node]);
            }
            let mode = self.passes[piece.pass_at(Chebyshev::nodes()[node])].mode;
            self.quantity.value(&Pose { positions: &positions, mode })
        })
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

    /// The least and the greatest value, each with the places at which it is reached in the order of the circuit;
    /// values that differ by rounding are equal.
    pub fn extremes(&self) -> [Extreme; 2] {
        let mut candidates = self.span_ends();
        let roots = self.spans.iter().enumerate().flat_map(|(span, f)| f.roots.iter().map(move |&u| Place { span, u }));
        candidates.extend(roots);
        // Parameters are between -1 and 1.
        let candidates = in_rising_order(candidates, |place| 4.0 * place.span as f64 + place.u);
        let values: Vec<f64> = candidates.iter().map(|&place| self.value(place)).collect();
        let bounds = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], &v| [l.min(v), h.max(v)]);
        let rounding = 1e-11 * (bounds[1] - bounds[0]);
        bounds.map(|value| {
            let is_extreme = |(_, v): &(&Place, &f64)| (*v - value).abs() <= rounding;
            let places = candidates.iter().zip(&values).filter(is_extreme).map(|(place, _)| *place).collect();
            Extreme { value, places }
        })
    }

    /// The beginning and the end of each span.
    fn span_ends(&self) -> Vec<Place> {
        (0..self.spans.len()).flat_map(|span| [-1.0, 1.0].map(|u| Place { span, u })).collect()
    }

    /// The places at limits of the input, inside spans and at their ends.
    fn limits(&self) -> Vec<Place> {
        let limit = |(span, function): (usize, &FunctionSpan)| match function.piece.map {
            InputMap::Root { middle, half, .. } if middle.abs() <= half * (1.0 + 1e-9) => {
                Some(Place { span, u: (-middle / half).clamp(-1.0, 1.0) })
            }
            _ => None,
        };
        self.spans.iter().enumerate().filter_map(limit).collect()
    }

    /// The places at which the derivative with respect to the input is zero, in the order of the circuit, each once. At
    /// a place where the function only pauses it is zero, too; a part on which it is constant has none.
    pub fn stationary_places(&self) -> Vec<Place> {
        let mut places: Vec<Place> = Vec::new();
        for (span, function) in self.spans.iter().enumerate() {
            // A sign that changes from one span to the next, by rounding of a root at the point they share.
            if self.slope_changes_sign_before(span) {
                places.push(Place { span, u: -1.0 });
            }
            places.extend(function.roots.iter().map(|&u| Place { span, u }));
        }
        // At a limit the derivative with respect to the parameter may be zero although the one with respect to the input
        // is not.
        places.retain(|&place| !self.is_at_limit(place));
        places.dedup_by(|b, a| self.are_one(*a, *b));
        if let (true, [first, .., last]) = (self.is_closed, &places[..])
            && self.are_one_across_start(*last, *first)
        {
            places.pop();
        }
        places
    }

    /// The stationary places at which the exact derivative with respect to the input, `rate`, changes its sign, or is no
    /// more than rounding and does not: near a place where the function is flat, rounding may give its polynomials
    /// further roots.
    pub fn confirmed_stationary_places(&self, rate: impl Fn(&JointDerivatives) -> f64) -> Vec<Place> {
        const ROUNDING: f64 = 1e-9;
        let places = self.stationary_places();
        let at = |place: Place| rate(&self.derivatives(place));
        let is_confirmed = |index: usize| {
            let place = places[index];
            // Within rounding of a limit the polynomial may seem to rest.
            if at(place).is_infinite() {
                return false;
            }
            let other = |k: Option<usize>| k.and_then(|k| places.get(k)).filter(|other| other.span == place.span);
            // The nearest other roots on the span, or its ends, or the limit on it.
            let limit = self.spans[place.span].piece.split;
            let before = other(index.checked_sub(1)).map_or(-1.0, |other| other.u);
            let after = other(Some(index + 1)).map_or(1.0, |other| other.u);
            let before = if limit < place.u { before.max(limit) } else { before };
            let after = if limit > place.u { after.min(limit) } else { after };
            if place.u - before < ROUNDING || after - place.u < ROUNDING {
                return true;
            }
            let rates = [before, after].map(|u| at(Place { u: (place.u + u) / 2.0, ..place }));
            let is_touch = || at(place).abs() <= ROUNDING * rates[0].abs().min(rates[1].abs());
            (rates[0] < 0.0) != (rates[1] < 0.0) || is_touch()
        };
        (0..places.len()).filter(|&index| is_confirmed(index)).map(|index| places[index]).collect()
    }

    /// Whether the derivative has different signs at the end of the span before and at the beginning of this one, where
    /// the function is smooth.
    fn slope_changes_sign_before(&self, span: usize) -> bool {
        let before = match span.checked_sub(1) {
            Some(before) => before,
            None if self.is_closed => self.spans.len() - 1,
            None => return false,
        };
        let [before, after] = [before, span].map(|k| &self.spans[k]);
        let (a, b) = (before.slope.at_end(), after.slope.at_start());
        let is_rounding = |slope: f64, span: &FunctionSpan| slope.abs() <= 64.0 * span.noise * (TERMS * TERMS) as f64;
        !after.is_corner && (a < 0.0) != (b < 0.0) && is_rounding(a, before) && is_rounding(b, after)
    }

    /// Whether a place is at a limit of the input.
    fn is_at_limit(&self, place: Place) -> bool {
        const NEAR: f64 = 1e-7;
        match self.spans[place.span].piece.map {
            InputMap::Root { middle, half, .. } => {
                (middle + half * place.u).abs() <= NEAR * self.pass(place).input_length().sqrt()
            }
            InputMap::Linear { .. } => false,
        }
    }

    /// Whether two places are one apart from rounding.
    fn are_one(&self, a: Place, b: Place) -> bool {
        (self.covered_input(a) - self.covered_input(b)).abs() <= 1e-9 * self.total_input()
    }

    /// The same for a place at the end of a closed circuit and one at its beginning.
    fn are_one_across_start(&self, last: Place, first: Place) -> bool {
        let total = self.total_input();
        self.covered_input(first) + total - self.covered_input(last) <= 1e-9 * total
    }

    /// The places at which the derivative with respect to the input may be extreme: where the second derivative is
    /// zero, the ends of the spans, and the limits.
    pub fn steepest_places(&self) -> Vec<Place> {
        let mut places = self.span_ends();
        places.extend(self.limits());
        for (index, span) in self.spans.iter().enumerate() {
            let second = span.slope.derivative();
            // With u the parameter and t the input, t'^3 d2f/dt2 = f'' t' - f' t''; t is linear in u or in the square
            // of a root s.
            let (numerator, greatest) = match span.piece.map {
                InputMap::Linear { .. } => (second, 1.0),
                InputMap::Root { middle, half, .. } => {
                    let (f2, f1) = (second.values(), span.slope.values());
                    let value = |j: usize| f2[j] * (middle + half * Chebyshev::nodes()[j]) - f1[j] * half;
                    (Chebyshev::from_values(&std::array::from_fn(value)), middle.abs() + half)
                }
            };
            let n2 = (TERMS * TERMS) as f64;
            let zeros = numerator.zeros(span.noise * greatest * n2 * n2 / 3.0, NARROW);
            places.extend(zeros.places.into_iter().map(|u| Place { span: index, u }));
        }
        places
    }

    /// The input near a stationary place at which the exact derivative with respect to the input, `rate`, changes its
    /// sign; the input of the place itself if it does not.
    pub fn refined_input(&self, place: Place, rate: impl Fn(&JointDerivatives) -> f64) -> f64 {
        const NEAR: f64 = 1e-5;
        let pass = self.pass(place);
        let near = |u: f64| self.input(Place { u: u.clamp(-1.0, 1.0), ..place });
        let bracket = [near(place.u - NEAR), near(place.u + NEAR)];
        let at = |input: f64| rate(&JointDerivatives::on_pass(&self.linkage, pass, input));
        let ends = bracket.map(at);
        if ends.iter().all(|rate| rate.is_finite()) && (ends[0] < 0.0) != (ends[1] < 0.0) {
            return solve_between(at, bracket);
        }
        self.input(place)
    }

    /// The exact positions and derivatives of the joints at a place.
    pub fn derivatives(&self, place: Place) -> JointDerivatives {
        JointDerivatives::on_pass(&self.linkage, self.pass(place), self.input(place))
    }

    /// The quantity.
    pub fn quantity(&self) -> &Q {
        &self.quantity
    }

    /// The monotonic parts of the function, in the order of the circuit.
    pub(super) fn monotonic_parts(&self) -> Vec<MonotonicPart> {
        let mut parts = Vec::new();
        for (span, function) in self.spans.iter().enumerate() {
            let cuts: Vec<f64> = [-1.0].into_iter().chain(function.roots.iter().copied()).chain([1.0]).collect();
            for ends in cuts.windows(2).filter(|ends| ends[1] > ends[0]) {
                let values = [ends[0], ends[1]].map(|u| function.series.at(u));
                parts.push(MonotonicPart { span, ends: [ends[0], ends[1]], values });
            }
        }
        parts
    }

    /// The place in a monotonic part at which a value between those at its ends is reached.
    pub(super) fn solve_in_part(&self, part: &MonotonicPart, value: f64) -> Place {
        let series = &self.spans[part.span].series;
        let is_bracketed = (part.values[0] < value) != (part.values[1] < value);
        let u = if is_bracketed {
            solve_between(|u| series.at(u) - value, part.ends)
        } else if (part.values[0] - value).abs() < (part.values[1] - value).abs() {
            part.ends[0]
        } else {
            part.ends[1]
        };
        Place { span: part.span, u }
    }

    /// The place at a fraction of a monotonic part.
    pub(super) fn place_in_part(&self, part: &MonotonicPart, fraction: f64) -> Place {
        Place { span: part.span, u: part.ends[0] + (part.ends[1] - part.ends[0]) * fraction }
    }

    /// The fraction of a monotonic part at which a place on it is.
    pub(super) fn fraction_of_part(&self, part: &MonotonicPart, place: Place) -> f64 {
        ((place.u - part.ends[0]) / (part.ends[1] - part.ends[0])).clamp(0.0, 1.0)
    }

    /// The derivatives of the polynomial with respect to the input before and after a place, per radian of an angle; at
    /// a limit through which the function moves on they are infinite.
    pub fn interpolated_rates(&self, place: Place) -> [f64; 2] {
        let span = &self.spans[place.span];
        let slope = span.slope.at(place.u);
        let per_input = if self.is_at_limit(place) {
            let InputMap::Root { direction, half, .. } = span.piece.map else { return [f64::NAN; 2] };
            if slope.abs() <= span.noise * (TERMS * TERMS) as f64 {
                // Both are even in the root: the second derivatives count.
                [span.slope.derivative().at(place.u) / (-2.0 * direction * half * half); 2]
            } else {
                // Before the limit the input moves in its direction.
                [direction, -direction].map(|sense| slope.signum() * sense * f64::INFINITY)
            }
        } else {
            [slope / span.piece.map.input_rate(place.u); 2]
        };
        if self.linkage.input() == Input::Length { per_input } else { per_input.map(trig::degrees) }
    }

    /// Whether a place is next to a change point, where the derivatives of a pose have few exact digits.
    pub fn is_next_to_change_point(&self, place: Place) -> bool {
        const NEAR: f64 = 1e-3;
        let (pass, input) = (self.pass(place), self.input(place));
        let is_near = |end: crate::motion::PassEnd| {
            let distance = (input - end.input.value).abs() / pass.input_length();
            !end.flat_dyads.is_empty() && distance < NEAR
        };
        let is_linear = matches!(self.spans[place.span].piece.map, InputMap::Linear { .. });
        is_linear && (is_near(pass.from) || is_near(pass.to))
    }

    /// Whether the circuit is closed.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }
}

/// An extreme value, and the places at which it is reached.
#[derive(Clone, Debug)]
pub(super) struct Extreme {
    pub value: f64,
    pub places: Vec<Place>,
}

/// A part of a span on which the function is monotonic.
#[derive(Clone, Copy, Debug)]
pub(super) struct MonotonicPart {
    span: usize,
    ends: [f64; 2],
    /// The values at its ends.
    pub values: [f64; 2],
}

/// A root of a function between two points at which its signs differ, to rounding, by false position with the weights
/// of Illinois (Dowell and Jarratt 1971).
fn solve_between(f: impl Fn(f64) -> f64, [mut a, mut b]: [f64; 2]) -> f64 {
    const ROUNDS: usize = 100;
    let rounding = f64::EPSILON * a.abs().max(b.abs());
    let (mut fa, mut fb) = (f(a), f(b));
    if fa == 0.0 {
        return a;
    }
    for round in 0..ROUNDS {
        if fb == 0.0 || (b - a).abs() <= rounding {
            break;
        }
        let step = fb * (b - a) / (fb - fa);
        if step.abs() <= rounding / 2.0 {
            break;
        }
        // Every third round halves the bracket, in case the secant moves one of its ends only.
        let c = if step.is_finite() && round % 3 != 2 { b - step } else { (a + b) / 2.0 };
        let fc = f(c);
        if (fc < 0.0) == (fb < 0.0) {
            fa /= 2.0;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (c, fc);
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bracketed_root_is_found_to_rounding() {
        let root = solve_between(|x| x * x * x - 2.0, [0.0, 3.0]);
        assert!((root * root * root - 2.0).abs() < 2e-15);
        let steep = solve_between(|x| trig::atan2(x - 0.7, 1e-9), [-1.0, 1.0]);
        assert!((steep - 0.7).abs() < 1e-15);
    }
}
