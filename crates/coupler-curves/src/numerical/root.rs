//! Where a function changes its sign, and where a condition ceases to hold.

/// Two places between which a function changes its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    places: [f64; 2],
    values: [f64; 2],
}

impl Bracket {
    /// The bracket of two places, in any order, with the values of the function there. `None` if a number or the distance of the
    /// places is not finite, or if the values do not differ in being negative: zero counts as positive.
    pub fn new(places: [f64; 2], values: [f64; 2]) -> Option<Bracket> {
        let is_finite = (places[1] - places[0]).is_finite() && values.iter().all(|value| value.is_finite());
        (is_finite && (values[0] < 0.0) != (values[1] < 0.0)).then_some(Bracket { places, values })
    }

    /// A place no further than `accuracy` from one at which the function changes its sign, or than four units in the last
    /// place of it where that is more. A jump counts as a change, and a value that is no number as positive.
    ///
    /// A smooth function is evaluated about nine times, any other no more than three times for each halving of the bracket
    /// that the accuracy takes.
    ///
    /// # Source
    /// T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function without using
    /// derivatives, *Advances in Engineering Software* 28 (1997): the step is inverse quadratic interpolation where the last
    /// three points say that it converges, or else bisection. Here the first step is linear interpolation, of which linear functions need one
    /// more at most, and it is bisection also after two steps in which the bracket has not become half as wide.
    pub fn zero(self, accuracy: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        const PATIENCE: usize = 2;
        // The last place and the other end of the bracket.
        let ([mut a, mut b], [mut fa, mut fb]) = (self.places, self.values);
        let (mut part, mut width, mut slow) = (fa / (fa - fb), (b - a).abs(), 0);
        loop {
            let (best, value) = if fa.abs() <= fb.abs() { (a, fa) } else { (b, fb) };
            let least = (accuracy / 2.0).max(f64::EPSILON * best.abs()) / (b - a).abs();
            if value == 0.0 || least > 0.5 {
                return best;
            }
            let is_end = |place: f64| place == a || place == b;
            let mut place = a + part.max(least).min(1.0 - least) * (b - a);
            if is_end(place) {
                place = a + (b - a) / 2.0;
            }
            if is_end(place) {
                return best;
            }
            let value = f(place);
            // The end that is left.
            let (c, fc);
            if (value < 0.0) == (fa < 0.0) {
                (c, fc) = (a, fa);
            } else {
                (c, fc) = (b, fb);
                (b, fb) = (a, fa);
            }
            (a, fa) = (place, value);
            slow += 1;
            if (b - a).abs() <= width / 2.0 {
                (width, slow) = ((b - a).abs(), 0);
            }
            let (x, y) = ((a - b) / (c - b), (fa - fb) / (fc - fb));
            let converges = y * y < x && (1.0 - y) * (1.0 - y) < 1.0 - x;
            part = if converges && slow < PATIENCE {
                fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
            } else {
                0.5
            };
        }
    }
}

/// The last place at which a condition holds and the first at which it does not, between one `inside` at which it holds and one
/// `outside` at which it does not: no further apart than `accuracy`, or neighbouring numbers.
///
/// The condition is evaluated once for each halving, and not at the ends. Where it does not cease to hold just once, this is one
/// of the places at which it does; if it holds nowhere or everywhere between the ends, it is next to an end. Ends without a
/// finite distance are returned as they are.
pub fn border([mut inside, mut outside]: [f64; 2], accuracy: f64, mut holds: impl FnMut(f64) -> bool) -> [f64; 2] {
    while (outside - inside).abs() > accuracy {
        let middle = inside + (outside - inside) / 2.0;
        if middle == inside || middle == outside || !middle.is_finite() {
            break;
        }
        if holds(middle) { inside = middle } else { outside = middle }
    }
    [inside, outside]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The zero of a function between two places, and how often the function is evaluated after its ends.
    fn zero(places: [f64; 2], accuracy: f64, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut count = 0;
        let bracket = Bracket::new(places, places.map(&f)).expect("a change of sign");
        let zero = bracket.zero(accuracy, |x| {
            count += 1;
            f(x)
        });
        (zero, count)
    }

    #[test]
    fn zeros_of_smooth_functions_are_found_to_their_last_digits_in_few_evaluations() {
        let (sqrt_2, e) = (std::f64::consts::SQRT_2, std::f64::consts::E);
        let found = [
            (zero([0.0, 3.0], 0.0, |x| x * x - 2.0), sqrt_2),
            (zero([3.0, 0.0], 0.0, |x| 2.0 - x * x), sqrt_2),
            (zero([1.0, 4.0], 0.0, |x| libm::log(x) - 1.0), e),
            (zero([-1.0, 2.0], 0.0, |x| 3.0 * x - 1.0), 1.0 / 3.0),
            (zero([-1e6, 1e6], 0.0, |x| (x - 2.5e-3) * (1.0 + 1e-7 * x)), 2.5e-3),
        ];
        for ((zero, count), expected) in found {
            assert!((zero - expected).abs() <= 4.0 * f64::EPSILON * expected, "{zero} for {expected}");
            assert!(count <= 11, "{zero}: {count}");
        }
    }

    #[test]
    fn a_zero_is_found_where_a_function_is_flat_jumps_or_has_no_value() {
        let flat = zero([-1.0, 1.5], 1e-9, |x| x * x * x * x * x);
        assert!(flat.0.abs() <= 1e-9 && flat.1 <= 3 * 32, "{flat:?}");
        let (jump, count) = zero([0.0, 1.0], 0.0, |x| if x < 0.7 { -1.0 } else { 1e9 });
        assert!((jump - 0.7).abs() <= 4.0 * f64::EPSILON && count <= 3 * 53, "{jump}: {count}");
        let (border, _) = zero([0.0, 1.0], 0.0, |x| if x < 0.7 || x == 1.0 { x - 0.8 } else { f64::NAN });
        assert!((border - 0.7).abs() <= 4.0 * f64::EPSILON, "{border}");
        let (pole, count) = zero([-1.0, 2.0], 0.0, |x| 1.0 / x);
        assert!(pole.abs() <= f64::MIN_POSITIVE && count < 3 * 1100, "{pole}: {count}");
        assert_eq!(zero([0.0, 1.0], 0.0, |x| -x), (0.0, 0));
    }

    #[test]
    fn there_is_no_bracket_without_a_change_of_sign() {
        for (places, values) in [
            ([0.0, 1.0], [1.0, 2.0]),
            ([0.0, 1.0], [-1.0, -2.0]),
            ([0.0, 1.0], [0.0, 1.0]),
            ([0.0, 1.0], [-1.0, f64::NAN]),
            ([0.0, 1.0], [f64::NEG_INFINITY, 1.0]),
            ([0.0, f64::INFINITY], [-1.0, 1.0]),
            ([-1e308, 1e308], [-1.0, 1.0]),
        ] {
            assert_eq!(Bracket::new(places, values), None, "{places:?} {values:?}");
        }
        // Values that cannot be.
        assert_eq!(Bracket::new([3.0, 3.0], [-1.0, 1.0]).map(|bracket| bracket.zero(0.0, |x| x)), Some(3.0));
    }

    #[test]
    fn a_border_is_between_neighbouring_numbers_or_as_close_as_asked() {
        let [inside, outside] = border([1.0, 2.0], 0.0, |x| x * x < 2.0);
        assert!(inside * inside < 2.0 && outside * outside >= 2.0 && outside == inside.next_up());
        let [inside, outside] = border([2.0, -1.0], 1e-3, |x| x > 0.3);
        assert!(inside > 0.3 && outside <= 0.3 && inside - outside <= 1e-3);
        assert_eq!(border([1.0, 2.0], 0.0, |_| true), [2f64.next_down(), 2.0]);
        assert_eq!(border([1.0, 2.0], 0.0, |_| false), [1.0, 1f64.next_up()]);
        assert_eq!(border([5.0, 5.0], 0.0, |_| true), [5.0, 5.0]);
        for ends in [[0.0, f64::INFINITY], [f64::NEG_INFINITY, 0.0], [-1.7e308, 1.7e308]] {
            assert_eq!(border(ends, 0.0, |_| true), ends);
        }
        assert!(border([f64::NAN, 1.0], 0.0, |_| true)[0].is_nan());
    }

    proptest! {
        /// Functions with a zero at a known place: a product of it and what is positive.
        #[test]
        fn a_zero_of_any_function_is_as_close_as_asked_and_takes_three_evaluations_for_each_halving_at_most(
            at in -1.0..1.0f64, low in 1e-6..9.0f64, high in 1e-6..9.0f64, power in 0u8..4, steep in -30.0..30.0f64,
            digits in 1i32..15, is_falling: bool,
        ) {
            let accuracy = libm::pow(10.0, f64::from(-digits));
            let f = |x: f64| {
                let odd = (0..power).fold(x - at, |odd, _| odd * (x - at) * (x - at));
                odd * libm::exp(steep * (x - at)) * if is_falling { -1.0 } else { 1.0 }
            };
            let places = [at - low, at + high];
            let (zero, count) = zero(places, accuracy, f);
            let halvings = libm::log2((low + high) / accuracy).ceil().max(0.0) as usize + 1;
            prop_assert!((zero - at).abs() <= accuracy.max(4.0 * f64::EPSILON * at.abs()), "{} {}", zero, at);
            prop_assert!(count <= 3 * halvings + 1, "{} for {} halvings", count, halvings);
        }
    }
}
