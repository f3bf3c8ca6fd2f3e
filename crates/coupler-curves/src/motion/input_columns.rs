//! Values of the input by columns.

use std::ops::Range;

use super::pass::InputPosition;
use crate::linkage::Input;

/// Values of the input, in borrowed columns.
#[derive(Clone, Copy, Debug)]
pub struct InputSlices<'a> {
    /// The angles in degrees, or the lengths.
    pub values: &'a [f64],
    /// The cosines of the angles; not used for lengths.
    pub cos: &'a [f64],
    /// The sines of the angles; not used for lengths.
    pub sin: &'a [f64],
}

impl InputSlices<'_> {
    /// The value at one index.
    pub(super) fn at(&self, i: usize) -> InputSlices<'_> {
        let one = i..i + 1;
        InputSlices { values: &self.values[one.clone()], cos: &self.cos[one.clone()], sin: &self.sin[one] }
    }
}

/// Values of the input, in owned columns.
#[derive(Clone, Debug, Default)]
pub struct InputColumns {
    values: Vec<f64>,
    cos: Vec<f64>,
    sin: Vec<f64>,
}

impl InputColumns {
    pub(super) fn new(inputs: &[InputPosition]) -> InputColumns {
        InputColumns {
            values: inputs.iter().map(|input| input.value).collect(),
            cos: inputs.iter().map(|input| input.cos).collect(),
            sin: inputs.iter().map(|input| input.sin).collect(),
        }
    }

    /// Those of values of an input: angles in degrees, or lengths.
    pub fn from_values(input: Input, values: impl IntoIterator<Item = f64>) -> InputColumns {
        let positions: Vec<InputPosition> = values.into_iter().map(|value| InputPosition::new(input, value)).collect();
        InputColumns::new(&positions)
    }

    /// The angles in degrees, or the lengths.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    pub(super) fn slice(&self, range: Range<usize>) -> InputSlices<'_> {
        InputSlices { values: &self.values[range.clone()], cos: &self.cos[range.clone()], sin: &self.sin[range] }
    }

    /// All of them, borrowed.
    pub fn as_slices(&self) -> InputSlices<'_> {
        self.slice(0..self.values.len())
    }
}
