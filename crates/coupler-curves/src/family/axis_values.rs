//! The values of an axis of a grid: a list, or a range whose values are computed when they are needed.

/// The values of an axis; those of a range take no memory, however many there are.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisValues {
    /// Values one by one.
    List(Vec<f64>),
    /// Values with a constant difference.
    Steps {
        /// The first value.
        from: f64,
        /// The difference of consecutive values.
        step: f64,
        /// The number of values.
        count: usize,
    },
    /// Values with a constant difference, given as exact fractions: the `k`-th value, from 0, is the nearest number to
    /// `(from + step k) / divisor * 10^exponent`.
    DecimalSteps {
        /// The numerator of the first value; `from + step count` must not overflow.
        from: i128,
        /// The difference of consecutive numerators.
        step: i128,
        /// The common denominator, at least 1.
        divisor: u64,
        /// The power of ten that all values are multiplied by.
        exponent: i32,
        /// The number of values.
        count: usize,
    },
    /// Evenly spaced values, including both ends; `to` if there is only one. The ends are exact, and the values between
    /// them have a rounding error of a few units in the last place.
    Even {
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// The number of values.
        count: usize,
    },
}

impl AxisValues {
    /// The number of values.
    pub fn len(&self) -> usize {
        match self {
            AxisValues::List(list) => list.len(),
            AxisValues::Steps { count, .. }
            | AxisValues::DecimalSteps { count, .. }
            | AxisValues::Even { count, .. } => *count,
        }
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The `k`-th value, from 0; `None` if there is none.
    pub fn get(&self, k: usize) -> Option<f64> {
        (k < self.len()).then(|| match *self {
            AxisValues::List(ref list) => list[k],
            AxisValues::Steps { from, step, .. } => from + step * k as f64,
            AxisValues::DecimalSteps { from, step, divisor, exponent, .. } => {
                nearest_number(from + step * k as i128, divisor, exponent)
            }
            AxisValues::Even { to, count, .. } if k + 1 == count => to,
            AxisValues::Even { from, to, count } => from + (to - from) * (k as f64 / (count - 1) as f64),
        })
    }

    /// All values, in order.
    pub fn iter(&self) -> impl Iterator<Item = f64> {
        (0..self.len()).filter_map(|k| self.get(k))
    }
}

impl From<Vec<f64>> for AxisValues {
    fn from(list: Vec<f64>) -> AxisValues {
        AxisValues::List(list)
    }
}

/// The nearest number to `numerator / divisor * 10^exponent`; of two equally near ones that with an even last bit.
fn nearest_number(numerator: i128, divisor: u64, exponent: i32) -> f64 {
    let power = 10i128.checked_pow(exponent.unsigned_abs());
    let (dividend, divided_by) = match power {
        Some(power) if exponent < 0 => (Some(numerator), power.checked_mul(i128::from(divisor))),
        Some(power) => (numerator.checked_mul(power), Some(i128::from(divisor))),
        None => (None, None),
    };
    let exactly = |n: i128| Some(n as f64).filter(|x| *x as i128 == n && n != i128::MAX);
    // The quotient of two exact numbers is rounded once.
    if let (Some(dividend), Some(divided_by)) = (dividend.and_then(exactly), divided_by.and_then(exactly)) {
        return dividend / divided_by;
    }
    // A decimal number is parsed to the nearest number. The digits are those of a long division; a number half-way
    // between two others has fewer than 770, so that of further digits only matters whether all of them are 0.
    const DIGITS: usize = 800;
    let (size, divisor) = (numerator.unsigned_abs(), u128::from(divisor));
    let mut digits = format!("{}{}.", if numerator < 0 { "-" } else { "" }, size / divisor);
    let mut remainder = size % divisor;
    for _ in 0..DIGITS {
        if remainder == 0 {
            break;
        }
        remainder *= 10;
        digits.push(char::from(b'0' + (remainder / divisor) as u8));
        remainder %= divisor;
    }
    let last = if remainder == 0 { '0' } else { '1' };
    format!("{digits}{last}e{exponent}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_computed_one_by_one() {
        let steps = AxisValues::Steps { from: 1.0, step: -0.5, count: 3 };
        assert_eq!(steps.iter().collect::<Vec<_>>(), [1.0, 0.5, 0.0]);
        let decimals = AxisValues::DecimalSteps { from: 1, step: 1, divisor: 1, exponent: -1, count: usize::MAX };
        assert_eq!(decimals.get(2), Some(0.3));
        assert_eq!(decimals.get(999_999_999_999), Some(1e11));
        let even = AxisValues::Even { from: 2.0, to: 3.0, count: 3 };
        assert_eq!(even.iter().collect::<Vec<_>>(), [2.0, 2.5, 3.0]);
        assert_eq!(AxisValues::Even { from: 2.0, to: 3.0, count: 1 }.get(0), Some(3.0));
        assert_eq!((even.get(3), AxisValues::from(vec![]).is_empty()), (None, true));
    }

    #[test]
    fn halves_are_rounded_to_even_and_tiny_remainders_count() {
        // 2^53 + 1 is half-way between two numbers.
        let half_way = (1i128 << 53) + 1;
        assert_eq!(nearest_number(half_way, 1, 0), 9_007_199_254_740_992.0);
        assert_eq!(nearest_number(half_way * 1000 + 1, 1000, 0), 9_007_199_254_740_994.0);
        assert_eq!(nearest_number(half_way * 1000 - 1, 1000, 0), 9_007_199_254_740_992.0);
        assert_eq!(nearest_number(half_way * 3 + 1, 3, 0), 9_007_199_254_740_994.0, "digits without end");
        assert_eq!(nearest_number(-3, 1, -1), -0.3);
        assert_eq!(nearest_number(3, 1, -300), 3e-300);
        assert_eq!(nearest_number(20, 3, 299), 2e300 / 3.0);
        assert_eq!(nearest_number(0, 7, -400), 0.0);
    }
}
