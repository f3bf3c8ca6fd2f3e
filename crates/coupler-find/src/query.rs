//! What curves are compared with.

use crate::complex::Complex;
use crate::shape::close_portion::CloseStroke;
use crate::shape::spectrum::{Extent, Spectrum, Transform};
use crate::shape::stroke::Stroke;
use crate::target::PathKind;

/// A path, described for comparison with the curves of an index.
pub(crate) enum Query {
    /// A closed path: its spectrum, with the extent that goes with it.
    Whole(Box<Spectrum>, Extent),
    /// A path that is like a portion of a curve, for a first comparison and for a closer one.
    Portion(Box<Stroke>, Box<CloseStroke>),
}

impl Query {
    /// The description of a path of a kind.
    pub fn new(kind: PathKind, points: &[Complex]) -> Query {
        match kind {
            PathKind::Closed => {
                let (spectrum, extent) = Transform::new().spectrum(points);
                Query::Whole(Box::new(spectrum), extent)
            }
            PathKind::Open | PathKind::Part => {
                Query::Portion(Box::new(Stroke::new(points)), Box::new(CloseStroke::new(points)))
            }
        }
    }
}
