//! Where a function is greatest.

/// The golden section, `(sqrt(5) - 1) / 2`.
const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;

/// Where a function is greatest, and its value there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maximum {
    /// The place.
    pub place: f64,
    /// The value.
    pub value: f64,
}

/// The greatest value of a function that rises and then falls between two places, in any order, by golden section: no further than
/// `accuracy` from the maximum, or than the values tell, which of a smooth function is about the root of their rounding.
///
/// The ends are not evaluated, and there are no places that differ by less than 1e-15 of the ends. Of two equal values the search
/// goes on towards the second end, as of two that are not comparable. If the function rises again, this is the greatest of the
/// values that were computed.
pub fn maximum([mut a, mut b]: [f64; 2], accuracy: f64, mut f: impl FnMut(f64) -> f64) -> Maximum {
    let accuracy = accuracy.max(4.0 * f64::EPSILON * a.abs().max(b.abs()));
    let mut best = Maximum { place: f64::NAN, value: f64::NAN };
    let mut at = |place: f64| {
        let here = Maximum { place, value: f(place) };
        if best.value.is_nan() || here.value > best.value {
            best = here;
        }
        here
    };
    let [mut c, mut d] = [at(b - GOLDEN_SECTION * (b - a)), at(a + GOLDEN_SECTION * (b - a))];
    loop {
        let is_before = c.value > d.value;
        if is_before {
            (b, d) = (d.place, c);
        } else {
            (a, c) = (c.place, d);
        }
        match (b - a).abs() > accuracy {
            true if is_before => c = at(b - GOLDEN_SECTION * (b - a)),
            true => d = at(a + GOLDEN_SECTION * (b - a)),
            false => return best,
        }
    }
}

/// The greatest value of a function between two places and at them, of which one that rises and then falls is searched for by
/// [`maximum`] between the neighbours of the best of the ends and the middle, unless all three are negative infinity.
pub fn maximum_with_ends([from, to]: [f64; 2], accuracy: f64, mut f: impl FnMut(f64) -> f64) -> Maximum {
    let half = (to - from) / 2.0;
    let greater = |a: Maximum, b: Maximum| if b.value > a.value { b } else { a };
    let of_three = [0.0, 1.0, 2.0].map(|k| from + half * k).map(|place| Maximum { place, value: f(place) });
    let [first, middle, last] = of_three;
    let best = greater(greater(first, middle), last);
    if best.value == f64::NEG_INFINITY {
        return best;
    }
    greater(best, maximum([(best.place - half).max(from), (best.place + half).min(to)], accuracy, f))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The maximum of a function, and how often it is evaluated.
    fn count(ends: [f64; 2], accuracy: f64, f: impl Fn(f64) -> f64) -> (Maximum, usize) {
        let mut count = 0;
        let found = maximum(ends, accuracy, |x| {
            count += 1;
            f(x)
        });
        (found, count)
    }

    #[test]
    fn a_smooth_maximum_is_found_to_the_root_of_rounding_and_a_sharp_one_to_rounding() {
        let (smooth, evaluations) = count([0.0, 3.0], 1e-9, libm::sin);
        assert!((smooth.place - std::f64::consts::FRAC_PI_2).abs() < 1e-7 && smooth.value == 1.0, "{smooth:?}");
        assert!(evaluations <= 47, "{evaluations}");
        let (sharp, evaluations) = count([-1.0, 2.0], 0.0, |x| -(x - 0.3).abs());
        assert!((sharp.place - 0.3).abs() < 4e-15, "{sharp:?}");
        assert!(evaluations < 80, "{evaluations}");
        assert!((maximum([0.0, 1.0], 1e-6, |x| x).place - 1.0).abs() <= 1e-6, "it rises up to the end");
        assert_eq!(maximum_with_ends([0.0, 1.0], 1e-6, |x| x), Maximum { place: 1.0, value: 1.0 });
        assert_eq!(maximum_with_ends([0.0, 1.0], 1e-6, |x| -x), Maximum { place: 0.0, value: 0.0 });
        let inner = maximum_with_ends([0.0, 1.0], 1e-9, |x| -(x - 0.3).abs());
        assert!((inner.place - 0.3).abs() < 1e-9, "{inner:?}");
    }

    #[test]
    fn the_search_ends_for_any_function() {
        // Of equal values towards the second end.
        for ends in [[0.0, 1.0], [1.0, 0.0]] {
            let mut last = f64::NAN;
            maximum(ends, 1e-3, |x| {
                last = x;
                if x == ends[0] { 1.0 } else { 0.0 }
            });
            assert!((last - ends[1]).abs() < 2e-3, "{last}");
        }
        assert!(maximum([0.0, 1.0], 0.0, |_| f64::NAN).value.is_nan());
        let nothing =
            maximum_with_ends([0.0, 1.0], 0.0, |x| if (0.1..0.4).contains(&x) { 1.0 } else { f64::NEG_INFINITY });
        assert_eq!(nothing.value, f64::NEG_INFINITY);
        let partly = maximum([0.0, 1.0], 1e-6, |x| if x < 0.5 { f64::NAN } else { 1.0 - x });
        assert!((partly.place - 0.5).abs() < 0.2 && partly.value == 1.0 - partly.place, "{partly:?}");
        assert_eq!(count([2.0, 2.0], 0.0, |x| x), (Maximum { place: 2.0, value: 2.0 }, 2));
        for ends in [[0.0, f64::INFINITY], [f64::NAN, 0.0], [-1.7e308, 1.7e308]] {
            assert!(count(ends, 0.0, |x| x).1 < 100);
        }
    }

    proptest! {
        #[test]
        fn the_peak_of_a_function_that_rises_and_falls_is_found(
            at in -5.0..5.0f64, low in 1e-3..9.0f64, high in 1e-3..9.0f64, slopes in [0.1..10.0f64, 0.1..10.0f64], digits in 1i32..13,
        ) {
            let accuracy = libm::pow(10.0, f64::from(-digits));
            let f = |x: f64| if x < at { slopes[0] * (x - at) } else { slopes[1] * (at - x) };
            let (found, evaluations) = count([at - low, at + high], accuracy, f);
            prop_assert!((found.place - at).abs() <= accuracy.max(1e-14), "{:?}", found);
            let sections = (libm::log((low + high) / accuracy) / -libm::log(GOLDEN_SECTION)).ceil().max(0.0);
            prop_assert!(evaluations <= 2 + sections as usize, "{}", evaluations);
        }
    }
}
