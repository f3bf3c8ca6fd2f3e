//! Limits in closed form: an extent that goes with the cosine of the input.

use crate::geometry::{Vector, cross, trig};
use crate::linkage::length_tolerance;
use crate::motion::circuit::InputPosition;
use crate::motion::interval::{EndCause, IntervalEnd, Span};

/// An extent that goes with the cosine of the input: with the angle measured from `towards`, it is at one end of its
/// range at 0 degrees and at the other at 180.
pub(super) struct SinusoidalExtent {
    /// The input's direction at which the near bound may be met.
    near_direction: Vector,
    /// The least and the greatest extent.
    pub range: [f64; 2],
    /// What is left to the bounds at 0 and at 180 degrees; negative where they are passed.
    margins: [f64; 2],
    /// 1 - cos and 1 + cos of the input where the bound near 0 degrees is met, and where that near 180 is.
    versines: [[f64; 2]; 2],
    /// What is left to the other bound at 0 and at 180 degrees: where there is none, the dyad closes nowhere.
    opposite_margins: [f64; 2],
    /// Lengths closer than this are equal.
    tolerance: f64,
    /// Whether the base may vanish at 0 degrees.
    base_can_vanish: bool,
}

impl SinusoidalExtent {
    /// The length of a base with one end on an arm and the other fixed, `to_fixed` from the arm's pivot.
    pub fn from_base_length(on_arm: Vector, to_fixed: Vector, [low, high]: [f64; 2]) -> SinusoidalExtent {
        let (fixed, arm) = (to_fixed.norm(), on_arm.norm());
        let (nearest, furthest) = ((fixed - arm).abs(), fixed + arm);
        let product = 2.0 * fixed * arm;
        let finite = if high.is_finite() { high } else { low };
        let tolerance = length_tolerance(furthest + finite);
        SinusoidalExtent {
            near_direction: quotient(to_fixed, on_arm),
            range: [nearest, furthest],
            margins: [nearest - low, high - furthest],
            // Differences of squares are taken apart: exact factors, and accurate when small.
            versines: [low, if high.is_finite() { high } else { furthest }].map(|bound| {
                [(bound - nearest) * (bound + nearest) / product, (furthest - bound) * (furthest + bound) / product]
            }),
            opposite_margins: [high - nearest, furthest - low],
            tolerance,
            base_can_vanish: nearest <= tolerance,
        }
    }

    /// `beside` less the projection of an arm on a fixed direction.
    pub fn from_projection(on_arm: Vector, normal: Vector, beside: f64, [low, high]: [f64; 2]) -> SinusoidalExtent {
        let arm = on_arm.norm();
        let (least, greatest) = (beside - arm, beside + arm);
        SinusoidalExtent {
            near_direction: quotient(normal, on_arm),
            range: [least, greatest],
            margins: [least - low, high - greatest],
            versines: [low, high].map(|bound| [(bound - least) / arm, (greatest - bound) / arm]),
            opposite_margins: [high - least, greatest - low],
            tolerance: length_tolerance(beside.abs() + arm + high),
            base_can_vanish: false,
        }
    }

    /// The input whose angle from `towards` has this cosine and sine.
    fn input_position(&self, cos: f64, sin: f64) -> InputPosition {
        let t = self.near_direction;
        // Both angles are exact where the arm starts on the frame line.
        let deg = trig::degrees(trig::atan2(t.y, t.x)) + trig::degrees(trig::atan2(sin, cos));
        InputPosition { value: deg, cos: t.x * cos - t.y * sin, sin: t.y * cos + t.x * sin }
    }

    /// The spans of the whole turn on which the dyad closes.
    ///
    /// What is compared at 0 and at 180 degrees is a sum of lengths with a sum of lengths; equal within their
    /// rounding, they make a change point.
    pub fn closing_spans(&self, dyad: usize, next_id: &mut usize) -> Vec<Span> {
        if self.opposite_margins.iter().any(|hope| *hope <= self.tolerance) {
            return Vec::new();
        }
        let [fold, stretch] = self.margins.map(|room| BoundState::from_margin(room, self.tolerance));
        // The smaller of 1 - cos and 1 + cos is the exact one, and both make the sine.
        let direction = |[minus, plus]: [f64; 2]| {
            (if minus < plus { 1.0 - minus } else { plus - 1.0 }, (minus * plus).max(0.0).sqrt())
        };
        let [inner, outer] = self.versines.map(direction);

        let (change, limit) = (EndCause::ChangePoint, EndCause::Limit);
        let mut at = |(cos, sin): (f64, f64), cause| {
            *next_id += 1;
            let end = IntervalEnd::from_flat_dyad(self.input_position(cos, sin), cause, dyad, *next_id);
            if cause == change && cos > 0.0 { end.with_flat_dyad(dyad, self.base_can_vanish) } else { end }
        };
        let arc = |lower: IntervalEnd, upper: IntervalEnd| {
            // Both ends are within half a turn of `towards`; the upper one follows the lower.
            let turn = if upper.input.value > lower.input.value { 0.0 } else { 360.0 };
            Span::Range { lower, upper: upper.shifted(turn) }
        };
        let mirrored = |(cos, sin): (f64, f64)| (cos, -sin);
        match (fold, stretch) {
            (BoundState::Clear, BoundState::Clear) => vec![Span::FullTurn],
            (BoundState::Touched, BoundState::Clear) => {
                let near = at((1.0, 0.0), change);
                vec![arc(near, near)]
            }
            (BoundState::Clear, BoundState::Touched) => {
                let far = at((-1.0, 0.0), change);
                vec![arc(far, far)]
            }
            (BoundState::Touched, BoundState::Touched) => {
                let (near, far) = (at((1.0, 0.0), change), at((-1.0, 0.0), change));
                vec![arc(near, far), arc(far, near)]
            }
            (BoundState::Exceeded, BoundState::Clear) => {
                let (lower, upper) = (at(inner, limit), at(mirrored(inner), limit));
                vec![arc(lower, upper)]
            }
            (BoundState::Clear, BoundState::Exceeded) => {
                let (lower, upper) = (at(mirrored(outer), limit), at(outer, limit));
                vec![arc(lower, upper)]
            }
            (BoundState::Touched, BoundState::Exceeded) => {
                let near = at((1.0, 0.0), change);
                let (lower, upper) = (at(mirrored(outer), limit), at(outer, limit));
                vec![arc(lower, near), arc(near, upper)]
            }
            (BoundState::Exceeded, BoundState::Touched) => {
                let far = at((-1.0, 0.0), change);
                let (lower, upper) = (at(inner, limit), at(mirrored(inner), limit));
                vec![arc(lower, far), arc(far, upper)]
            }
            (BoundState::Exceeded, BoundState::Exceeded) => {
                let up = [at(inner, limit), at(outer, limit)];
                let down = [at(mirrored(outer), limit), at(mirrored(inner), limit)];
                vec![arc(down[0], down[1]), arc(up[0], up[1])]
            }
        }
    }
}

/// The direction that turns `b` into the direction of `a`: their quotient, as of complex numbers.
fn quotient(a: Vector, b: Vector) -> Vector {
    let product = a.norm() * b.norm();
    if product > 0.0 { Vector::new(a.dot(&b), cross(b, a)) / product } else { Vector::new(1.0, 0.0) }
}

/// Whether a dyad can pass the shortest or the longest its base can be.
#[derive(Clone, Copy, PartialEq)]
enum BoundState {
    Clear,
    /// It lies flat there, and can.
    Touched,
    Exceeded,
}

impl BoundState {
    fn from_margin(room: f64, tolerance: f64) -> BoundState {
        if room.abs() <= tolerance {
            BoundState::Touched
        } else if room > 0.0 {
            BoundState::Clear
        } else {
            BoundState::Exceeded
        }
    }
}
