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
    /// Values with a constant difference, given as whole multiples of `1 / scale`: each value is the result of a single
    /// division, and so the nearest number to its decimals.
    DecimalSteps {
        /// The first value times `scale`, a whole number.
        from: f64,
        /// The difference of consecutive values times `scale`, a whole number.
        step: f64,
        /// A power of ten.
        scale: f64,
        /// The number of values.
        count: usize,
    },
    /// Evenly spaced values, including both ends; `to` if there is only one.
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
            AxisValues::DecimalSteps { from, step, scale, .. } => (from + step * k as f64) / scale,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_computed_one_by_one() {
        let steps = AxisValues::Steps { from: 1.0, step: -0.5, count: 3 };
        assert_eq!(steps.iter().collect::<Vec<_>>(), [1.0, 0.5, 0.0]);
        let decimals = AxisValues::DecimalSteps { from: 1.0, step: 1.0, scale: 10.0, count: usize::MAX };
        assert_eq!(decimals.get(2), Some(0.3));
        assert_eq!(decimals.get(999_999_999_999), Some(1e11));
        let even = AxisValues::Even { from: 2.0, to: 3.0, count: 3 };
        assert_eq!(even.iter().collect::<Vec<_>>(), [2.0, 2.5, 3.0]);
        assert_eq!(AxisValues::Even { from: 2.0, to: 3.0, count: 1 }.get(0), Some(3.0));
        assert_eq!((even.get(3), AxisValues::from(vec![]).is_empty()), (None, true));
    }
}
