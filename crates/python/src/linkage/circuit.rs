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
use pyo3::types::PyDict;

use super::curve::{branches_of, linkage_of_joint, rates_of};
use super::sensitivity::{neighbours, position_rates};
use super::solution::{Solution, limits_of};
use crate::argument::is_number;
use crate::arrays;
use crate::reduce::{Reduced, reduced};

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
        at: Option<Bound<'py, PyAny>>,
        rate: impl Fn(&motion::JointDerivatives, JointId) -> Vector + Send + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (joint, (solved, circuit)) = (self.joint(joint)?, self.parts()?);
        match at {
            Some(at) => {
                let (linkage, joint) = linkage_of_joint(solved, joint);
                self.at(&at, |pass, input| rate(&motion::JointDerivatives::on_pass(&linkage, pass, input), joint))
            }
            None => Ok(arrays::rows(py, py.detach(|| rates_of(solved, circuit, joint, rate)), 2)?.into_any()),
        }
    }

    /// Vectors at inputs: of a single one of shape (2,), and of an array of shape (n, 2).
    fn at<'py>(
        &self,
        at: &Bound<'py, PyAny>,
        vector: impl Fn(&motion::Pass, f64) -> Vector,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (is_single, places) = self.places(at)?;
        let values = |place: Option<(&motion::Pass, f64)>| {
            let found = place.map(|(pass, input)| vector(pass, input));
            found.map_or([f64::NAN; 2], |vector| [vector.x, vector.y])
        };
        vectors(at.py(), is_single, places.into_iter().flat_map(values).collect())
    }

    /// The passes and inputs of a single input, or of several, with whether it is a single one.
    fn places(&self, at: &Bound<PyAny>) -> PyResult<(bool, Vec<Place<'_>>)> {
        let (solved, circuit) = self.parts()?;
        let turn = match solved.linkage.input() {
            Input::Angle { turns } => Some(360.0 * f64::from(turns)),
            Input::Length => None,
        };
        let place = |input: f64| pass_at(circuit, input, turn);
        if is_number(at) {
            return Ok((true, vec![place(at.extract()?)]));
        }
        let Ok(inputs) = at.extract::<PyArrayLike1<f64, AllowTypeChange>>() else {
            return Err(PyTypeError::new_err("at: give a number, or a list or an array of inputs, as in at=[0, 30]"));
        };
        Ok((false, inputs.as_array().iter().map(|input| place(*input)).collect()))
    }
}

/// A pass and an input of it; `None` beyond the limits.
type Place<'a> = Option<(&'a motion::Pass, f64)>;

/// Vectors, x and y in turn: a single one of shape (2,), and several of shape (n, 2).
fn vectors(py: Python, is_single: bool, values: Vec<f64>) -> PyResult<Bound<PyAny>> {
    Ok(if is_single { arrays::column(py, values).into_any() } else { arrays::rows(py, values, 2)?.into_any() })
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
    /// at : float or array, optional
    ///     The inputs, in degrees or units of length, in place of those of the samples; of a single one the array has the shape (2,). Between limits
    ///     the circuit passes an input on several branches: the position is that of the first pass. Beyond the limits it is NaN.
    #[pyo3(signature = (joint, at=None))]
    fn positions<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
        at: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (joint, (solved, circuit)) = (self.joint(joint)?, self.parts()?);
        let Some(at) = at else { return Ok(arrays::points(py, circuit.points(joint), circuit.len())?.into_any()) };
        self.at(&at, |pass, input| {
            let point = motion::pose(&solved.linkage, pass, input)[joint];
            Vector::new(point.x, point.y)
        })
    }

    /// The velocities of a joint, by its name: an array of shape (n, 2), per radian, or unit of length, of the input; infinite at limits. With `at`
    /// they are those at other inputs, as of `positions`.
    #[pyo3(signature = (joint, at=None))]
    fn velocities<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
        at: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.rates(py, joint, at, motion::JointDerivatives::velocity)
    }

    /// The accelerations of a joint for a constant rate of the input, by its name: an array of shape (n, 2), per radian squared, or unit of
    /// length squared, of the input; infinite at limits. With `at` they are those at other inputs, as of `positions`.
    #[pyo3(signature = (joint, at=None))]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
        at: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.rates(py, joint, at, motion::JointDerivatives::acceleration)
    }

    /// The derivatives of the position of a joint by each length of the linkage, at the same input: a dictionary of arrays of shape (n, 2) by the names of
    /// the lengths, as AB, or M along. They are in closed form, infinite at limits that the joint passes and NaN at change points. With `at` they
    /// are those at other inputs, as of `positions`.
    #[pyo3(signature = (joint, at=None))]
    fn sensitivities<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
        at: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (joint, (solved, circuit)) = (self.joint(joint)?, self.parts()?);
        let neighbours = neighbours(&self.solution, solved)?;
        let (is_single, places) = match &at {
            Some(at) => self.places(at)?,
            None => {
                let place = |k: usize| Some((&circuit.passes[circuit.pass_at(k)], circuit.inputs[k]));
                (false, (0..circuit.len()).map(place).collect())
            }
        };
        let rates = |place: Place| match place {
            Some(place) => position_rates(solved, &neighbours, joint, place),
            None => vec![[f64::NAN; 2]; neighbours.pairs.len()],
        };
        let rates: Vec<Vec<[f64; 2]>> = py.detach(|| places.into_iter().map(rates).collect());
        let table = PyDict::new(py);
        for (k, name) in neighbours.names.iter().enumerate() {
            let values = rates.iter().flat_map(|own| own[k]).collect();
            table.set_item(name, vectors(py, is_single, values)?)?;
        }
        Ok(table)
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

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Circuit>(py, (self.solution.recipe.pickled(), self.index))
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
