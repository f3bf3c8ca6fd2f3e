//! The curves of the samples of a search, by their shape.

use crate::curve::index::{CurveIndex, CurveShape};

/// A curve of the samples of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct SampleCurve {
    /// The number of the linkage among those that are searched, from 0.
    pub linkage: u32,
    /// The number of the parameter set, from 0.
    pub sample: u32,
    /// The number of the traced joint, from 0.
    pub trace: u32,
    /// The number of the circuit, from 0.
    pub circuit: u32,
}

/// How a curve of a sample is described for comparison.
#[derive(Clone, Copy)]
pub(super) enum SampleShape {
    /// Its shape.
    Free(CurveShape),
    /// Of a timed target, the sum of the squares of the distances at the inputs of some points, where it is least.
    Timed(f64),
}

/// The shapes of a search's curves, and which they are.
#[derive(Default)]
pub(super) struct SampleIndex {
    pub(super) curves: Vec<SampleCurve>,
    pub(super) shapes: CurveIndex,
    /// Of a timed target the sums of squares, and the numbers of their curves.
    pub(super) sums: Vec<(f64, usize)>,
}

impl SampleIndex {
    /// Adds curves.
    pub fn extend(&mut self, found: impl IntoIterator<Item = (SampleCurve, SampleShape)>) {
        for (curve, shape) in found {
            match shape {
                SampleShape::Free(shape) => self.shapes.push_shape(shape),
                SampleShape::Timed(sum) => self.sums.push((sum, self.curves.len())),
            }
            self.curves.push(curve);
        }
    }

    /// The number of curves.
    pub fn len(&self) -> usize {
        self.curves.len()
    }
}
