//! Places on a circuit at which a function is extreme, stationary or steepest.

use super::{CircuitFunction, FunctionSpan, NARROW, Place, Quantity};
use crate::geometry::{Chebyshev, TERMS, in_rising_order, trig};
use crate::linkage::Input;
use crate::motion::{InputMap, JointDerivatives};
use crate::numerical::Bracket;

/// An extreme value, and the places at which it is reached.
#[derive(Clone, Debug)]
pub(in crate::measure) struct Extreme {
    pub value: f64,
    pub places: Vec<Place>,
}

impl<Q: Quantity> CircuitFunction<Q> {
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

    /// The least and the greatest value.
    pub fn range(&self) -> [f64; 2] {
        self.extremes().map(|extreme| extreme.value)
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
        let ends = [near(place.u - NEAR), near(place.u + NEAR)];
        let at = |input: f64| rate(&JointDerivatives::on_pass(&self.linkage, pass, input));
        Bracket::new(ends, ends.map(at)).map_or_else(|| self.input(place), |bracket| bracket.zero(0.0, at))
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
}
