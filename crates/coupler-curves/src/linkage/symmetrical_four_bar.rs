//! Four-bars with a symmetrical coupler curve, and the lengths for which it is straight at its axis (Natesan's thesis,
//! chapter 8).

use super::{FourBar, Sextic, length_tolerance};
use crate::geometry::{Point, Vector};
use crate::numerical::Bracket;

/// The symmetrical linkages of Natesan's chapter 8, given by three lengths: the frame p, one short link, and two
/// or three long ones of equal length. The origin is the crank's pivot, x towards the rocker's; the axis of the curve
/// is perpendicular to the frame.
///
/// | | short | long | coupler point | axis |
/// |---|---|---|---|---|
/// | Evans | the crank, r | coupler and rocker, a = s | 2 a from the crank pin | x = p |
/// | Chebyshev, Watt | the coupler, 2 a | crank and rocker, r = s | in its middle | x = p / 2 |
///
/// With the same three lengths their curves are similar, Evans's twice as large: they are cognates.
///
/// # Source
/// Natesan, chapter 8: (8.1) to (8.10) for Evans, (8.11) to (8.19) for Chebyshev and Watt. Here the general sextic is
/// differentiated instead, because the equations have misprints:
///
/// - (8.1): `- 2 p^4 x` is `- 2 p r^4 x`; in the sine before it the second term is added;
/// - (8.4): `36 p x y^2` is `36 p x^2 y^2`; (8.7) and (8.13) are right;
/// - before (8.11) sine and cosine are those of Evans: with E1 = x^2 + y^2 + a^2 - r^2 and
///   E2 = (x - p)^2 + y^2 + a^2 - r^2, cos theta is (E1 + E2) / 2 a p, and sin theta is (E1 / 2 a - x cos theta) / y;
/// - the equation after (8.14), also numbered (8.14), lacks six terms of the factor of y'', and has `- 24 x^4 y` for
///   `+ 24 x^4 y`: the factor is that of y' in (8.13).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymmetricalFourBar {
    /// The crank is short; figure 8.1.
    Evans,
    /// The coupler is short; figure 8.2. Watt's linkage differs only in its proportions.
    Chebyshev,
}

impl SymmetricalFourBar {
    /// The four-bar of these lengths, and its coupler point: along the coupler from the crank pin, and to its left.
    pub fn four_bar(self, frame: f64, short: f64, long: f64) -> (FourBar, Vector) {
        match self {
            SymmetricalFourBar::Evans => {
                (FourBar { frame, crank: short, coupler: long, rocker: long }, Vector::new(2.0 * long, 0.0))
            }
            SymmetricalFourBar::Chebyshev => {
                (FourBar { frame, crank: long, coupler: short, rocker: long }, Vector::new(short / 2.0, 0.0))
            }
        }
    }

    /// The form of a four-bar and its coupler point, with its frame, short and long length, as [`Self::four_bar`] takes
    /// them; lengths that agree to within a few ulps count as equal. `None` for other proportions.
    ///
    /// The link called short is that in the role of the short one, whatever its length.
    pub fn from_four_bar(four_bar: FourBar, point: Vector) -> Option<(SymmetricalFourBar, [f64; 3])> {
        let FourBar { frame, crank, coupler, rocker } = four_bar;
        let tolerance = length_tolerance(frame + crank + coupler + rocker);
        let forms = [
            (SymmetricalFourBar::Evans, [frame, crank, rocker]),
            (SymmetricalFourBar::Chebyshev, [frame, coupler, rocker]),
        ];
        forms.into_iter().find(|(form, [frame, short, long])| {
            let (expected, expected_point) = form.four_bar(*frame, *short, *long);
            let differences = [expected.crank - crank, expected.coupler - coupler, (expected_point - point).norm()];
            differences.iter().all(|difference| difference.abs() <= tolerance)
        })
    }

    /// The x-coordinate of the axis of symmetry.
    pub fn axis_x(self, frame: f64) -> f64 {
        frame * self.curve_scale()
    }

    /// The points, other than the pivots, where the curve crosses its axis above the frame: the one further from the
    /// frame, then the nearer one; `None` for one that does not exist.
    ///
    /// # Source
    /// Natesan (8.3) and (8.12), with the radicands factored.
    pub fn axis_crossings(self, frame: f64, short: f64, long: f64) -> [Option<Point>; 2] {
        [frame - short, frame + short].map(|base| {
            let square = (2.0 * long - base) * (2.0 * long + base);
            (square > 0.0).then(|| Point::new(self.axis_x(frame), self.curve_scale() * square.sqrt()))
        })
    }

    /// dy/dx and d2y/dx2 of the curve at the nearer crossing, from the curve's equation; `None` where there is no
    /// crossing.
    ///
    /// The slope is 0 there up to rounding (8.5, 8.14); where the second derivative is negative the curve is concave
    /// towards the frame.
    pub fn crossing_derivatives(self, frame: f64, short: f64, long: f64) -> Option<[f64; 2]> {
        let [_, crossing] = self.axis_crossings(frame, short, long);
        let (four_bar, point) = self.four_bar(frame, short, long);
        let derivatives = Sextic::from_four_bar(four_bar, point)?.y_derivatives(crossing?);
        derivatives.iter().all(|value| value.is_finite()).then_some(derivatives)
    }

    /// The long length at which dy/dx and d2y/dx2 are both 0 at the nearer crossing, so that the curve is straight
    /// there to the third order; computed as the root of d2y/dx2 as a function of the long length.
    ///
    /// It equals sqrt((frame + short)^3 / short) / 2, Natesan (8.8) and (8.16); with a short length of 1 that is
    /// (8.10) and (8.19), (1 + p)^1.5 / 2. Its precision is that of the sextic: about 13 digits for a frame of up to
    /// ten short lengths.
    ///
    /// `None` for lengths that are not positive, or where d2y/dx2 does not change sign for long links of up to 2^20
    /// times the least at which the curve crosses its axis.
    pub fn straight_long_length(self, frame: f64, short: f64) -> Option<f64> {
        if !(frame > 0.0 && short > 0.0 && (frame + short).is_finite()) {
            return None;
        }
        // With a shorter long link there is no nearer crossing; at this length the curvature there is greatest.
        let least = (frame + short) / 2.0;
        let second_derivative = |long: f64| self.crossing_derivatives(frame, short, long).map(|[_, second]| second);
        let mut from = least * (1.0 + 1e-9);
        let mut start = second_derivative(from)?;
        let lengths = (0..50).map(|k: i32| least * (1.0 + 1e-9 * (2u64 << k) as f64));
        for to in lengths.take_while(|to| *to < least * 1_048_576.0) {
            let end = second_derivative(to)?;
            if let Some(bracket) = Bracket::new([from, to], [start, end]) {
                return Some(bracket.zero(0.0, |long| second_derivative(long).unwrap_or(f64::NAN)));
            }
            (from, start) = (to, end);
        }
        None
    }

    /// The size of its curve relative to that of Evans's linkage of the same lengths.
    fn curve_scale(self) -> f64 {
        match self {
            SymmetricalFourBar::Evans => 1.0,
            SymmetricalFourBar::Chebyshev => 0.5,
        }
    }
}
