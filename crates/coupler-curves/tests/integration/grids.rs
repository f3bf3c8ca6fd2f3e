//! The values of grids against exact arithmetic.

use coupler_curves::family::AxisValues;
use proptest::prelude::*;

/// The only value of an axis that is `from / divisor * 10^exponent`.
fn nearest_number(from: i128, divisor: u64, exponent: i32) -> f64 {
    AxisValues::DecimalSteps { from, step: 0, divisor, exponent, count: 1 }.get(0).unwrap()
}

/// The distance of a number from a fraction of positive denominator, times 2^60 and the denominator.
fn scaled_distance(x: f64, [numerator, denominator]: [i128; 2]) -> i128 {
    const UNIT: f64 = (1u64 << 60) as f64;
    let scaled = x * UNIT;
    assert_eq!((scaled as i128) as f64, scaled, "{x} is a multiple of 2^-60");
    (scaled as i128 * denominator - (numerator << 60)).abs()
}

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn fractions_are_rounded_to_the_nearest_number(
        numerator in -1_000_000_000i128..1_000_000_000,
        divisor in 1u64..1_000_000,
        exponent in -4i32..=2,
    ) {
        prop_assume!(numerator.unsigned_abs() >= 1000 * u128::from(divisor));
        let found = nearest_number(numerator, divisor, exponent);
        let power = 10i128.pow(exponent.unsigned_abs());
        let fraction = if exponent < 0 {
            [numerator, i128::from(divisor) * power]
        } else {
            [numerator * power, i128::from(divisor)]
        };
        let own = scaled_distance(found, fraction);
        for neighbour in [found.next_up(), found.next_down()] {
            prop_assert!(own <= scaled_distance(neighbour, fraction), "{found} for {fraction:?}");
        }
    }

    /// Both ways to the nearest number give the same one.
    #[test]
    fn long_division_agrees_with_a_single_division(numerator in 1i128..1 << 53, divisor in 1u64..1 << 53) {
        let expected = numerator as f64 / divisor as f64;
        prop_assert_eq!(nearest_number(numerator, divisor, 0), expected);
        // With this factor few numerators are exact.
        prop_assert_eq!(nearest_number(numerator * 10i128.pow(22), divisor, -22), expected);
    }
}
