//! Equations of coupler curves.

use coupler_curves::linkage;
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::arrays;

/// The equation of a coupler curve, a polynomial of degree 6 in x and y, with the crank's pivot at the origin and the x-axis towards the rocker's.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Sextic {
    pub(super) inner: linkage::Sextic,
}

#[pymethods]
impl Sextic {
    /// The coefficients: an array of shape (7, 7), of which [i, j] is that of x^i y^j; that of x^6 is 1.
    #[getter]
    fn coefficients<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        // Adding 0 turns -0 into 0.
        let coefficient = |i, j| if i + j <= 6 { self.inner.coefficient(i, j) + 0.0 } else { 0.0 };
        arrays::rows(py, (0..7).flat_map(|i| (0..7).map(move |j| coefficient(i, j))).collect(), 7)
    }

    /// The same with the origin in the middle of the two pivots.
    #[getter]
    fn centred_coefficients<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let centred = self.inner.centred_coefficients();
        arrays::rows(py, centred.iter().flatten().map(|coefficient| coefficient + 0.0).collect(), 7)
    }

    /// The real double points, each as (x, y, kind): ``crunode``, ``tacnode``, ``cusp`` or ``acnode``.
    #[getter]
    fn double_points(&self) -> Vec<(f64, f64, &'static str)> {
        let points = self.inner.double_points().into_iter();
        points.map(|double| (double.point.x, double.point.y, double.kind.name())).collect()
    }

    /// How often the curve passes through the circular points.
    #[getter]
    fn circular_points(&self) -> usize {
        self.inner.circularity()
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Sextic, real double points: {}>", self.inner.double_points().len())
    }
}
