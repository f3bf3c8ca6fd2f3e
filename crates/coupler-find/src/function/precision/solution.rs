//! What a solution of the equations of precision points is: a linkage, or none.

use crate::complex::Complex;
use crate::function::elimination::{LinearForm, Row};
use crate::function::generator::Generator;

/// What is given besides the points: the input and the output at the first one.
pub(in crate::function) type GivenStarts = [Option<f64>; 2];

/// The linkages of some precision points.
#[derive(Clone, Debug, Default)]
pub(in crate::function) struct Exact {
    /// Those that are real.
    pub linkages: Vec<Generator>,
    /// How many would have links of imaginary length.
    pub imaginary: usize,
    /// How many would have links of infinite length.
    pub infinite: usize,
    /// Whether the points leave a dimension of linkages.
    pub is_degenerate: bool,
}

/// A solution that is not a linkage.
pub(super) enum NoLinkage {
    /// Of which a length would be infinite or zero.
    Infinite,
    /// Of which a length would be imaginary.
    Imaginary,
}

/// What is 0 of a solution relative to its size, but for rounding: links would be ten thousand million times as long as others.
pub(super) const NOTHING: f64 = 1e-10;

impl Exact {
    /// The points have no isolated solutions.
    pub(super) fn degenerate() -> Exact {
        Exact { is_degenerate: true, ..Exact::default() }
    }

    pub(super) fn collect(solutions: impl IntoIterator<Item = Result<Generator, NoLinkage>>) -> Exact {
        let mut exact = Exact::default();
        for solution in solutions {
            match solution {
                Ok(linkage) => exact.linkages.push(linkage),
                Err(NoLinkage::Imaginary) => exact.imaginary += 1,
                Err(NoLinkage::Infinite) => exact.infinite += 1,
            }
        }
        exact
    }
}

/// Parts of a solution vector as complex numbers that are linear in the basis, each of one number, which is real, or of two.
pub(super) fn forms<const N: usize>(basis: &[Row; 2], parts: [&[usize]; N]) -> [LinearForm; N] {
    let part = |vector: &Row, indices: &[usize]| {
        Complex::new(vector[indices[0]], indices.get(1).map_or(0.0, |second| vector[*second]))
    };
    parts.map(|indices| [part(&basis[0], indices), part(&basis[1], indices)])
}

/// The value of a form in a direction.
pub(super) fn value(form: &LinearForm, [u, v]: [f64; 2]) -> Complex {
    form[0] * u + form[1] * v
}

/// The real form of one number of a solution vector in a direction.
pub(super) fn number(basis: &[Row; 2], index: usize, [u, v]: [f64; 2]) -> f64 {
    basis[0][index] * u + basis[1][index] * v
}

pub(super) fn conjugate(form: LinearForm) -> LinearForm {
    form.map(|part| part.conj())
}

pub(super) fn times(form: LinearForm, factor: Complex) -> LinearForm {
    form.map(|part| part * factor)
}
