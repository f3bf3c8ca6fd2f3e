//! Circuits: motions of a whole linkage.

use std::sync::Arc;

use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::{Input, JointId};
use coupler_curves::measure::transmission_angle;
use coupler_curves::motion;
use coupler_curves::problem::suggestion;
use coupler_curves::solve::SolvedCell;
use numpy::{AllowTypeChange, PyArray1, PyArray2, PyArrayLike1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

use super::curve::{branches_of, rates_of};
use super::solution::{Solution, limits_of};
use crate::arrays;

/// A circuit: a motion of the whole linkage without disassembly.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Circuit {
    pub(super) solution: Arc<Solution>,
    pub(super) index: usize,
    pub(super) inputs: PyOnceLock<Py<PyArray1<f64>>>,
}

/// The first pass of a circuit over an input, with the input in its range, from which it may differ by whole periods: by those of the circuit
/// where the input turns fully, and otherwise by those after which every joint is back at its position.
fn pass_at(circuit: &motion::Circuit, input: f64, turn: Option<f64>) -> Option<(&motion::Pass, f64)> {
    let ranges = || circuit.passes.iter().map(motion::Pass::input_range);
    let [least, greatest] =
        [ranges().map(|[low, _]| low).reduce(f64::min)?, ranges().map(|[_, high]| high).reduce(f64::max)?];
    let period = turn.map(|turn| if circuit.is_full_turn() { greatest - least } else { turn });
    let shifted = period.map_or(input, |period| least + (input - least).rem_euclid(period));
    circuit.passes.iter().find_map(|pass| {
        let [low, high] = pass.input_range();
        (low <= shifted && shifted <= high).then_some((pass, shifted))
    })
}

impl Circuit {
    fn parts(&self) -> PyResult<(&SolvedCell, &motion::Circuit)> {
        let solved = self.solution.moved()?;
        Ok((solved, &solved.motion.circuits[self.index]))
    }

    fn joint(&self, name: &str) -> PyResult<JointId> {
        let linkage = &self.parts()?.0.linkage;
        let found = linkage.joint_ids().find(|joint| linkage.joints[*joint].name == name);
        found.ok_or_else(|| {
            let mut names: Vec<&str> = linkage.joints.iter().map(|joint| joint.name.as_str()).collect();
            names.dedup();
            PyValueError::new_err(format!("there is no joint `{name}`: {}", suggestion(name, &names)))
        })
    }

    fn rates<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
        rate: impl Fn(&motion::JointDerivatives, JointId) -> Vector + Send + Sync,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (joint, (solved, circuit)) = (self.joint(joint)?, self.parts()?);
        arrays::rows(py, py.detach(|| rates_of(solved, circuit, joint, rate)), 2)
    }
}

#[pymethods]
impl Circuit {
    /// Its number, from 1.
    #[getter]
    fn number(&self) -> usize {
        self.index + 1
    }

    /// Whether it ends where it begins; the first sample is not repeated.
    #[getter]
    fn closed(&self) -> PyResult<bool> {
        Ok(self.parts()?.1.is_closed)
    }

    /// Whether the input turns fully.
    #[getter]
    fn full_turn(&self) -> PyResult<bool> {
        Ok(self.parts()?.1.is_full_turn())
    }

    /// The least and the greatest input, in degrees or units of length; None where the input turns fully.
    #[getter]
    fn limits(&self) -> PyResult<Option<(f64, f64)>> {
        Ok(limits_of(self.parts()?.1))
    }

    /// The inputs of the samples: an array of shape (n,), in degrees, continuous and never wrapped, or in units of length.
    #[getter]
    fn inputs(this: &Bound<Circuit>) -> PyResult<Py<PyArray1<f64>>> {
        let (py, own) = (this.py(), this.get());
        let make = || Ok::<_, PyErr>(arrays::column(py, own.parts()?.1.inputs.clone()).unbind());
        Ok(own.inputs.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The sides of all two-valued joints at the samples: an array of shape (n, joints), 1 left, -1 right, and (n, 1) where there is none.
    #[getter]
    fn branches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i8>>> {
        let (solved, circuit) = self.parts()?;
        branches_of(py, solved, circuit)
    }

    /// The positions of a joint, by its name: an array of shape (n, 2), in the unit of the lengths.
    ///
    /// Parameters
    /// ----------
    /// joint : str
    ///     Its name, one of `Linkage.joints`.
    /// at : array, optional
    ///     The inputs, in degrees or units of length, in place of those of the samples. Between limits the circuit passes an input on several
    ///     branches: the position is that of the first pass. Beyond the limits it is NaN.
    #[pyo3(signature = (joint, at=None))]
    fn positions<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
        at: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (joint, (solved, circuit)) = (self.joint(joint)?, self.parts()?);
        let Some(at) = at else { return arrays::points(py, circuit.points(joint), circuit.len()) };
        let turn = match solved.linkage.input() {
            Input::Angle { turns } => Some(360.0 * f64::from(turns)),
            Input::Length => None,
        };
        let Ok(at) = at.extract::<PyArrayLike1<f64, AllowTypeChange>>() else {
            return Err(PyTypeError::new_err("at: give a list or an array of inputs, as in at=[0, 30]"));
        };
        let inputs: Vec<f64> = at.as_array().iter().copied().collect();
        let points: Vec<Point> = inputs
            .iter()
            .map(|input| match pass_at(circuit, *input, turn) {
                Some((pass, input)) => motion::pose(&solved.linkage, pass, input)[joint],
                None => Point::new(f64::NAN, f64::NAN),
            })
            .collect();
        arrays::points(py, points.into_iter(), inputs.len())
    }

    /// The velocities of a joint, by its name: an array of shape (n, 2), per radian, or unit of length, of the input; infinite at limits.
    fn velocities<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rates(py, joint, motion::JointDerivatives::velocity)
    }

    /// The accelerations of a joint for a constant rate of the input, by its name: an array of shape (n, 2), per radian squared, or unit of
    /// length squared, of the input; infinite at limits.
    fn accelerations<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.rates(py, joint, motion::JointDerivatives::acceleration)
    }

    /// The transmission angles of a four-bar at the samples: an array of shape (n,), in degrees from 0 to 180; NaN of other linkages.
    #[getter]
    fn transmission_angles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let (solved, circuit) = self.parts()?;
        let linkage = &solved.linkage;
        let angle = |sample| {
            let pose: Vec<Point> = linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect();
            transmission_angle(linkage, &pose).unwrap_or(f64::NAN)
        };
        Ok(arrays::column(py, (0..circuit.len()).map(angle).collect()))
    }

    /// The number of samples.
    fn __len__(&self) -> PyResult<usize> {
        Ok(self.parts()?.1.len())
    }

    fn __repr__(&self) -> PyResult<String> {
        let kind = if self.full_turn()? { "a full turn" } else { "between limits" };
        Ok(format!(
            "<coupler_atlas.Circuit {} of {}: {kind}, {} samples>",
            self.number(),
            self.solution.family.id,
            self.__len__()?
        ))
    }
}
