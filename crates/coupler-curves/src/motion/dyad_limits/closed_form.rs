//! Limits in closed form, of a dyad whose extent depends on the cosine of the input.

use crate::geometry::{Vector, cross, trig};
use crate::linkage::{DyadId, length_tolerance};
use crate::motion::interval::{EndCause, IntervalEnd, Span};
use crate::motion::pass::InputPosition;

/// An extent that is a monotonic function of the cosine of the input: with the angle measured from `near_direction`, it
/// is least at 0 degrees and greatest at 180.
pub(super) struct SinusoidalExtent {
    /// The direction of the input at which the extent is least.
    near_direction: Vector,
    /// The least and the greatest extent.
    pub range: [f64; 2],
    /// The distance of the least extent from the lower bound and of the greatest from the upper bound; negative where
    /// the bound is exceeded.
    margins: [f64; 2],
    /// 1 - cos and 1 + cos of the input at which the extent equals the lower bound, and of that at the upper bound.
    versines: [[f64; 2]; 2],
    /// The distance of the least extent from the upper bound and of the greatest from the lower bound: if one is
    /// negative, the dyad closes at no input.
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
            // Differences of squares are factored: the factors are exact, and the product is accurate when small.
            versines: [low, if high.is_finite() { high } else { furthest }].map(|bound| {
                [(bound - nearest) * (bound + nearest) / product, (furthest - bound) * (furthest + bound) / product]
            }),
            opposite_margins: [high - nearest, furthest - low],
            tolerance,
            base_can_vanish: nearest <= tolerance,
        }
    }

    /// `distance` minus the projection of an arm on a fixed direction.
    pub fn from_projection(on_arm: Vector, normal: Vector, distance: f64, [low, high]: [f64; 2]) -> SinusoidalExtent {
        let arm = on_arm.norm();
        let (least, greatest) = (distance - arm, distance + arm);
        SinusoidalExtent {
            near_direction: quotient(normal, on_arm),
            range: [least, greatest],
            margins: [least - low, high - greatest],
            versines: [low, high].map(|bound| [(bound - least) / arm, (greatest - bound) / arm]),
            opposite_margins: [high - least, greatest - low],
            tolerance: length_tolerance(distance.abs() + arm + high),
            base_can_vanish: false,
        }
    }

    /// The input whose angle from `near_direction` has this cosine and sine.
    fn input_position(&self, cos: f64, sin: f64) -> InputPosition {
        let t = self.near_direction;
        // Both angles are exact if the arm is on the frame line at input 0.
        let deg = trig::degrees(trig::atan2(t.y, t.x)) + trig::degrees(trig::atan2(sin, cos));
        InputPosition { value: deg, cos: t.x * cos - t.y * sin, sin: t.y * cos + t.x * sin }
    }

    /// The spans of the whole turn on which the dyad closes.
    ///
    /// At 0 and at 180 degrees two sums of lengths are compared; if they are equal within their rounding, there is a
    /// change point.
    pub fn closing_spans(&self, dyad: DyadId, next_id: &mut usize) -> Vec<Span> {
        if self.opposite_margins.iter().any(|margin| *margin <= self.tolerance) {
            return Vec::new();
        }
        let [fold, stretch] = self.margins.map(|margin| BoundState::from_margin(margin, self.tolerance));
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
            // Both ends are within half a turn of `near_direction`; the upper one follows the lower.
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

/// The rotation from the direction of `b` to that of `a`: the normalized quotient of complex numbers.
fn quotient(a: Vector, b: Vector) -> Vector {
    let product = a.norm() * b.norm();
    if product > 0.0 { Vector::new(a.dot(&b), cross(b, a)) / product } else { Vector::new(1.0, 0.0) }
}

/// Whether the extent of a dyad reaches a bound.
#[derive(Clone, Copy, PartialEq)]
enum BoundState {
    Clear,
    /// The dyad is flat at the extreme of its extent, which equals the bound.
    Touched,
    Exceeded,
}

impl BoundState {
    fn from_margin(margin: f64, tolerance: f64) -> BoundState {
        if margin.abs() <= tolerance {
            BoundState::Touched
        } else if margin > 0.0 {
            BoundState::Clear
        } else {
            BoundState::Exceeded
        }
    }
}
