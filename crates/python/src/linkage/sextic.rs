//! Equations of coupler curves.

use coupler_curves::geometry::Vector;
use coupler_curves::linkage::{self, FourBar};
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::arrays;
use crate::error::LinkageError;
use crate::reduce::{Reduced, Remake, reduced};

/// The equation of a coupler curve, a polynomial of degree 6 in x and y, with the crank's pivot at the origin and the x-axis towards the rocker's.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Sextic {
    inner: linkage::Sextic,
    lengths: FourBar,
    coupler_point: Vector,
}

impl Sextic {
    /// That of a four-bar with a coupler point, along the coupler and to the left of it; `None` if the point is a pin.
    pub(super) fn new(lengths: FourBar, coupler_point: Vector) -> Option<Sextic> {
        Some(Sextic { inner: linkage::Sextic::from_four_bar(lengths, coupler_point)?, lengths, coupler_point })
    }
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
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let FourBar { frame, crank, coupler, rocker } = self.lengths;
        reduced::<Sextic>(py, [frame, crank, coupler, rocker, self.coupler_point.x, self.coupler_point.y])
    }
}

impl Remake for Sextic {
    type State = [f64; 6];

    fn remake(py: Python, [frame, crank, coupler, rocker, along, across]: [f64; 6]) -> PyResult<Py<PyAny>> {
        let lengths = FourBar { frame, crank, coupler, rocker };
        let sextic = Sextic::new(lengths, Vector::new(along, across));
        let sextic = sextic.ok_or_else(|| LinkageError::new_err("the traced joint is a pin, and so has no sextic"))?;
        Ok(Py::new(py, sextic)?.into_any())
    }
}
