//! Circuits: motions of a whole linkage.

use std::sync::Arc;

use coupler_curves::linkage::JointId;
use coupler_curves::motion;
use coupler_curves::problem::suggestion;
use coupler_curves::solve::SolvedCell;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

use super::curve::{branches_of, velocities_of};
use super::limits_of;
use super::solution::Solution;
use crate::arrays;

/// A circuit: a motion of the whole linkage without disassembly.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Circuit {
    pub(super) solution: Arc<Solution>,
    pub(super) index: usize,
    pub(super) inputs: PyOnceLock<Py<PyArray1<f64>>>,
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
    fn positions<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (joint, (_, circuit)) = (self.joint(joint)?, self.parts()?);
        arrays::points(py, circuit.points(joint), circuit.len())
    }

    /// The velocities of a joint, by its name: an array of shape (n, 2), per radian, or unit of length, of the input; infinite at limits.
    fn velocities<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (joint, (solved, circuit)) = (self.joint(joint)?, self.parts()?);
        arrays::rows(py, py.detach(|| velocities_of(solved, circuit, joint)), 2)
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
