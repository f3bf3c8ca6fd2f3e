//! Curves of traced joints.

use std::path::PathBuf;
use std::sync::Arc;

use coupler_atlas::export::{self, DEFAULT_DPI, Format};
use coupler_curves::exchange::SelectedCurve;
use coupler_curves::geometry::Vector;
use coupler_curves::linkage::{DyadId, JointId, Linkage};
use coupler_curves::measure::input_torque;
use coupler_curves::motion;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_drawing::curve_file::{CurveFormat, FileOptions};
use coupler_drawing::page::Options;
use coupler_drawing::plate::PAPER;
use coupler_drawing::render::TextMode;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

use super::sensitivity;
use super::solution::{Solution, into_text, limits_of, measures_of};
use crate::arrays;
use crate::error::Error;
use crate::file::save;
use crate::reduce::{Reduced, reduced};

/// The curve of a traced joint on a circuit.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Curve {
    solution: Arc<Solution>,
    index: usize,
    points: PyOnceLock<Py<PyArray2<f64>>>,
    inputs: PyOnceLock<Py<PyArray1<f64>>>,
    branches: PyOnceLock<Py<PyArray2<i8>>>,
    velocities: PyOnceLock<Py<PyArray2<f64>>>,
    accelerations: PyOnceLock<Py<PyArray2<f64>>>,
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
            accelerations: PyOnceLock::new(),
        }
    }

    /// Its curve and its circuit. They have been solved, or there would be no curve.
    fn parts(&self) -> PyResult<(&SolvedCell, &MeasuredCurve, &motion::Circuit)> {
        let solved = self.solution.moved()?;
        let curve = &solved.curves[self.index];
        Ok((solved, curve, solved.circuit(curve)))
    }

    /// The numbers of its trace and its circuit, from 1.
    pub fn numbers(&self) -> PyResult<[usize; 2]> {
        let (_, curve, _) = self.parts()?;
        Ok([curve.trace, curve.circuit])
    }

    /// Its points and inputs, and whether it is closed.
    pub fn path(&self) -> PyResult<(Vec<coupler_curves::geometry::Point>, Vec<f64>, bool)> {
        let (_, curve, circuit) = self.parts()?;
        Ok((circuit.points(curve.joint).collect(), circuit.inputs.clone(), circuit.is_closed))
    }

    fn file(&self, py: Python, format: Format) -> PyResult<Vec<u8>> {
        let Solution { family, source, .. } = &*self.solution;
        let mut solved = self.solution.measured(py)?.clone();
        solved.cell.number = self.solution.number().unwrap_or(solved.cell.number);
        let selected = SelectedCurve::all_from_cell(family, source, &[], &solved);
        let file = FileOptions {
            page: Options::for_paper(PAPER),
            text_mode: TextMode::Text,
            chord_tolerance: FileOptions::DEFAULT_CHORD_TOLERANCE,
        };
        let selected = selected.get(self.index).ok_or_else(|| self.solution.no_linkage())?;
        let bytes = py.detach(|| export::bytes(selected, format, &export::Options { file, dpi: DEFAULT_DPI.into() }));
        bytes.map_err(|error| Error::new_err(error.to_string()))
    }

    fn text(&self, py: Python, format: CurveFormat) -> PyResult<String> {
        self.file(py, Format::Text(format)).map(into_text)
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
            let values = py.detach(|| rates_of(solved, circuit, curve.joint, motion::JointDerivatives::velocity));
            Ok::<_, PyErr>(arrays::rows(py, values, 2)?.unbind())
        };
        Ok(own.velocities.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The accelerations at the points for a constant rate of the input: an array of shape (n, 2), in units of length per radian squared, or
    /// unit of length squared, of the input; infinite at limits.
    #[getter]
    fn accelerations(this: &Bound<Curve>) -> PyResult<Py<PyArray2<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let (solved, curve, circuit) = own.parts()?;
            let rate = motion::JointDerivatives::acceleration;
            let values = py.detach(|| rates_of(solved, circuit, curve.joint, rate));
            Ok::<_, PyErr>(arrays::rows(py, values, 2)?.unbind())
        };
        Ok(own.accelerations.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The input torques against a load at the points: an array of shape (n,), the force times a length, or forces where the input is a length;
    /// infinite at limits that the joint of the load passes. Friction and masses are left out.
    ///
    /// Parameters
    /// ----------
    /// load : str, optional
    ///     A force on a joint, ``"100 on C at -90 deg"``, or ``"100 on C"`` against the motion of C; by default the linkage's own, which its
    ///     manifest gives it.
    #[pyo3(signature = (load=None))]
    fn torques<'py>(&self, py: Python<'py>, load: Option<&str>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (solved, _, circuit) = self.parts()?;
        let (id, template) = (&self.solution.family.id, &self.solution.family.template);
        let load = match load {
            Some(text) => {
                let load = template.parse_load(text);
                let load = load.map_err(|error| PyValueError::new_err(format!("load={text:?}: {error}")))?;
                solved.linkage.find_joint(&template.joints[load.joint].name).map(|joint| load.map_joint(|_| joint))
            }
            None => solved.linkage.load,
        };
        let load = load.ok_or_else(|| {
            PyValueError::new_err(format!("{id}: it has no load: give one, as in torques(\"100 on C at -90 deg\")"))
        })?;
        let linkage = Linkage { load: Some(load), ..solved.linkage.clone() };
        let torque = |sample: usize| {
            let pass = &circuit.passes[circuit.pass_at(sample)];
            input_torque(&linkage, pass, &circuit.derivatives(&linkage, sample)).unwrap_or(f64::NAN)
        };
        let values = py.detach(|| (0..circuit.len()).map(torque).collect());
        Ok(arrays::column(py, values))
    }

    /// The measures of the curve by name, as of ``Linkage.measures``: all, or ``only=["length"]``, which takes the time of these alone.
    #[pyo3(signature = (*, only=None))]
    fn measures<'py>(&self, py: Python<'py>, only: Option<Vec<String>>) -> PyResult<Bound<'py, PyDict>> {
        measures_of(py, &self.solution, self.index, only)
    }

    /// How far the curve moves, across itself, where every length of the linkage is off by `error`: a dictionary with the `worst_case` and the
    /// `root_sum_square`, and by the names of the lengths `sensitivities`, the greatest move for a unit of each, and `straight_sensitivities`, the
    /// change of the straight portion's length. None for a point that stands still, and at a change point.
    #[pyo3(signature = (error=1.0))]
    fn tolerance<'py>(&self, py: Python<'py>, error: f64) -> PyResult<Option<Bound<'py, PyDict>>> {
        if !(error > 0.0 && error.is_finite()) {
            return Err(PyValueError::new_err(format!("error={error}: give a positive length, as in tolerance(0.1)")));
        }
        sensitivity::tolerance(py, &self.solution, self.index, error)
    }

    /// A plate of the curve with its linkage, as SVG.
    fn svg(&self, py: Python) -> PyResult<String> {
        self.text(py, CurveFormat::Svg)
    }

    /// The manifest of a family with this linkage, as TOML.
    pub(super) fn toml(&self, py: Python) -> PyResult<String> {
        self.text(py, CurveFormat::Toml)
    }

    /// A drawing for CAD, as DXF.
    fn dxf(&self, py: Python) -> PyResult<String> {
        self.text(py, CurveFormat::Dxf)
    }

    /// The rows of ``points.csv``.
    fn csv(&self, py: Python) -> PyResult<String> {
        self.text(py, CurveFormat::Csv)
    }

    /// Linkage, parameters, circuits, points and measures, as JSON.
    fn json(&self, py: Python) -> PyResult<String> {
        self.text(py, CurveFormat::Json)
    }

    /// Write the curve to a file, in the format of its name: a plate as ``.svg`` or ``.png``, a drawing for CAD as ``.dxf``, its points as
    /// ``.csv``, everything as ``.json``, or a manifest as ``.toml``.
    fn save(&self, py: Python, path: PathBuf) -> PyResult<()> {
        let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_lowercase()).unwrap_or_default();
        let format = Format::ALL.into_iter().find(|format| format.name() == suffix).ok_or_else(|| {
            let names: Vec<&str> =
                Format::ALL.iter().map(|format| format.name()).filter(|name| !name.contains('-')).collect();
            PyValueError::new_err(format!("{}: give a name that ends in .{}", path.display(), names.join(", .")))
        })?;
        save(&path, &self.file(py, format)?)
    }

    /// The plate that a notebook shows.
    fn _repr_svg_(&self, py: Python) -> PyResult<String> {
        self.svg(py)
    }

    /// The number of points.
    fn __len__(&self) -> PyResult<usize> {
        Ok(self.parts()?.2.len())
    }

    /// Whether the other is the same curve of the same linkage.
    fn __eq__(&self, other: &Bound<PyAny>) -> bool {
        let other = other.cast::<Curve>();
        other.is_ok_and(|other| {
            self.index == other.get().index && Solution::are_same(&self.solution, &other.get().solution)
        })
    }

    fn __hash__(&self) -> u64 {
        self.solution.hash() ^ self.index as u64
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Curve>(py, (self.solution.recipe.pickled(), self.index))
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

/// The linkage without the traced points but a joint, if it is one of them, and the joint in it.
pub(super) fn linkage_of_joint(solved: &SolvedCell, joint: JointId) -> (Linkage, JointId) {
    match solved.linkage.traced.contains(&joint) {
        true => solved.linkage.with_one_point(joint),
        false => (solved.linkage.clone(), joint),
    }
}

/// The derivatives of the positions of a joint with respect to the input that a function takes: components x and y in turn.
pub(super) fn rates_of(
    solved: &SolvedCell,
    circuit: &motion::Circuit,
    joint: JointId,
    rate: impl Fn(&motion::JointDerivatives, JointId) -> Vector,
) -> Vec<f64> {
    let (linkage, joint) = linkage_of_joint(solved, joint);
    let rates = |sample| {
        let rate = rate(&circuit.derivatives(&linkage, sample), joint);
        [rate.x, rate.y]
    };
    (0..circuit.len()).flat_map(rates).collect()
}
