//! Curves of traced joints.

use std::sync::Arc;

use coupler_curves::exchange::SelectedCurve;
use coupler_curves::linkage::{DyadId, JointId};
use coupler_curves::motion;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_drawing::curve_file::{self, CurveFormat, FileOptions};
use coupler_drawing::page::Options;
use coupler_drawing::plate::PAPER;
use coupler_drawing::render::TextMode;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

use super::limits_of;
use super::solution::{Solution, into_text, measures_of};
use crate::arrays;

/// The curve of a traced joint on a circuit.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Curve {
    solution: Arc<Solution>,
    index: usize,
    points: PyOnceLock<Py<PyArray2<f64>>>,
    inputs: PyOnceLock<Py<PyArray1<f64>>>,
    branches: PyOnceLock<Py<PyArray2<i8>>>,
    velocities: PyOnceLock<Py<PyArray2<f64>>>,
}

impl Curve {
    pub(super) fn new(solution: Arc<Solution>, index: usize) -> Curve {
        Curve {
            solution,
            index,
            points: PyOnceLock::new(),
            inputs: PyOnceLock::new(),
            branches: PyOnceLock::new(),
            velocities: PyOnceLock::new(),
        }
    }

    /// Its curve and its circuit. They have been solved, or there would be no curve.
    fn parts(&self) -> PyResult<(&SolvedCell, &MeasuredCurve, &motion::Circuit)> {
        let solved = self.solution.moved()?;
        let curve = &solved.curves[self.index];
        Ok((solved, curve, solved.circuit(curve)))
    }

    /// Its points and inputs, and whether it is closed.
    pub fn path(&self) -> PyResult<(Vec<coupler_curves::geometry::Point>, Vec<f64>, bool)> {
        let (_, curve, circuit) = self.parts()?;
        Ok((circuit.points(curve.joint).collect(), circuit.inputs.clone(), circuit.is_closed))
    }

    fn file(&self, py: Python, format: CurveFormat) -> PyResult<String> {
        let Solution { family, source, number, .. } = &*self.solution;
        let mut solved = self.solution.measured(py)?.clone();
        solved.cell.number = number.unwrap_or(solved.cell.number);
        let selected = SelectedCurve::all_from_cell(family, source, &[], &solved);
        let options = FileOptions {
            page: Options::for_paper(PAPER),
            text_mode: TextMode::Text,
            chord_tolerance: FileOptions::DEFAULT_CHORD_TOLERANCE,
        };
        let selected = selected.get(self.index).ok_or_else(|| self.solution.no_linkage())?;
        Ok(into_text(curve_file::bytes(selected, format, &options)))
    }
}

#[pymethods]
impl Curve {
    /// The number of the traced joint, from 1.
    #[getter]
    fn trace(&self) -> PyResult<usize> {
        Ok(self.parts()?.1.trace)
    }

    /// The number of the circuit, from 1.
    #[getter]
    fn circuit(&self) -> PyResult<usize> {
        Ok(self.parts()?.1.circuit)
    }

    /// The name of the traced joint.
    #[getter]
    fn joint(&self) -> PyResult<&str> {
        let (solved, curve, _) = self.parts()?;
        Ok(&solved.linkage.joints[curve.joint].name)
    }

    /// Whether it ends where it begins; the first point is not repeated.
    #[getter]
    fn closed(&self) -> PyResult<bool> {
        Ok(self.parts()?.2.is_closed)
    }

    /// Whether the input turns fully.
    #[getter]
    fn full_turn(&self) -> PyResult<bool> {
        Ok(self.parts()?.2.is_full_turn())
    }

    /// The least and the greatest input, in degrees or units of length; None where the input turns fully.
    #[getter]
    fn limits(&self) -> PyResult<Option<(f64, f64)>> {
        Ok(limits_of(self.parts()?.2))
    }

    /// The points: an array of shape (n, 2), in the unit of the lengths.
    #[getter]
    pub(super) fn points(this: &Bound<Curve>) -> PyResult<Py<PyArray2<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let (_, curve, circuit) = own.parts()?;
            Ok::<_, PyErr>(arrays::points(py, circuit.points(curve.joint), circuit.len())?.unbind())
        };
        Ok(own.points.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The inputs at the points: an array of shape (n,), in degrees, continuous and never wrapped, or in units of length.
    #[getter]
    fn inputs(this: &Bound<Curve>) -> PyResult<Py<PyArray1<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || Ok::<_, PyErr>(arrays::column(py, own.parts()?.2.inputs.clone()).unbind());
        Ok(own.inputs.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The side of the first two-valued joint at the points: an array of shape (n,), 1 left, -1 right, and 1 where there is no such joint.
    #[getter]
    fn branch<'py>(this: &Bound<'py, Curve>) -> PyResult<Bound<'py, PyAny>> {
        let index = (pyo3::types::PySlice::full(this.py()), 0);
        Curve::branches(this)?.bind(this.py()).get_item(index)
    }

    /// The sides of all two-valued joints at the points: an array of shape (n, joints), and (n, 1) where there is none.
    #[getter]
    fn branches(this: &Bound<Curve>) -> PyResult<Py<PyArray2<i8>>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let (solved, _, circuit) = own.parts()?;
            Ok::<_, PyErr>(branches_of(py, solved, circuit)?.unbind())
        };
        Ok(own.branches.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The velocities at the points: an array of shape (n, 2), in units of length per radian, or unit of length, of the input; infinite at
    /// limits.
    #[getter]
    fn velocities(this: &Bound<Curve>) -> PyResult<Py<PyArray2<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let (solved, curve, circuit) = own.parts()?;
            let values = py.detach(|| velocities_of(solved, circuit, curve.joint));
            Ok::<_, PyErr>(arrays::rows(py, values, 2)?.unbind())
        };
        Ok(own.velocities.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// All measures of the curve by name, as of ``Linkage.measures``.
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        measures_of(py, &self.solution, self.index)
    }

    /// A plate of the curve with its linkage, as SVG.
    fn svg(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Svg)
    }

    /// The manifest of a family with this linkage, as TOML.
    fn toml(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Toml)
    }

    /// A drawing for CAD, as DXF.
    fn dxf(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Dxf)
    }

    /// The rows of ``points.csv``.
    fn csv(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Csv)
    }

    /// Linkage, parameters, circuits, points and measures, as JSON.
    fn json(&self, py: Python) -> PyResult<String> {
        self.file(py, CurveFormat::Json)
    }

    /// The plate that a notebook shows.
    fn _repr_svg_(&self, py: Python) -> PyResult<String> {
        self.svg(py)
    }

    /// The number of points.
    fn __len__(&self) -> PyResult<usize> {
        Ok(self.parts()?.2.len())
    }

    fn __repr__(&self) -> PyResult<String> {
        let (_, curve, circuit) = self.parts()?;
        let kind = if circuit.is_closed { "closed" } else { "open" };
        let (id, joint) = (&self.solution.family.id, self.joint()?);
        Ok(format!(
            "<coupler_atlas.Curve of {id}: {joint} on circuit {}, {} points, {kind}>",
            curve.circuit,
            circuit.len()
        ))
    }
}

pub(super) fn branches_of<'py>(
    py: Python<'py>,
    solved: &SolvedCell,
    circuit: &motion::Circuit,
) -> PyResult<Bound<'py, PyArray2<i8>>> {
    let dyads = solved.linkage.dyad_count().max(1);
    let side = |k| move |dyad| if circuit.mode_at(k).sign(DyadId::new(dyad)) > 0 { 1 } else { -1 };
    arrays::rows(py, (0..circuit.len()).flat_map(|k| (0..dyads).map(side(k))).collect(), dyads)
}

/// Components x and y in turn.
pub(super) fn velocities_of(solved: &SolvedCell, circuit: &motion::Circuit, joint: JointId) -> Vec<f64> {
    let (linkage, joint) = match solved.linkage.traced.contains(&joint) {
        true => solved.linkage.with_one_point(joint),
        false => (solved.linkage.clone(), joint),
    };
    let velocity = |sample| {
        let velocity = circuit.derivatives(&linkage, sample).velocity(joint);
        [velocity.x, velocity.y]
    };
    (0..circuit.len()).flat_map(velocity).collect()
}
