//! What has been computed of a linkage.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coupler_curves::family::{Family, MEASURES, Sampling};
use coupler_curves::linkage::{Input, PlacedFourBar};
use coupler_curves::measure::Value;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::{SolvedCell, solve_cell, solve_measuring};
use coupler_drawing::page::{Options, PoseChoice};
use coupler_drawing::plate::{self, PAPER};
use coupler_drawing::render::{self, TextMode};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::LinkageError;

/// A sampler; the last one is kept, for its table of sines takes as long as the samples of a linkage.
pub(super) fn sampler(sampling: Sampling) -> Arc<Sampler> {
    static LAST: Mutex<Option<(Sampling, Arc<Sampler>)>> = Mutex::new(None);
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    match &*last {
        Some((known, sampler)) if *known == sampling => sampler.clone(),
        _ => {
            let sampler = Arc::new(Sampler::new(sampling));
            *last = Some((sampling, sampler.clone()));
            sampler
        }
    }
}

/// A linkage with what has been computed of it.
pub struct Solution {
    pub(super) family: Family,
    pub(super) source: String,
    pub(super) number: Option<usize>,
    /// Without measures, which take most of the time.
    moved: OnceLock<Option<SolvedCell>>,
    measured: OnceLock<Option<SolvedCell>>,
}

impl Solution {
    pub(super) fn new(family: Family, source: String, number: Option<usize>) -> Solution {
        Solution { family, source, number, moved: OnceLock::new(), measured: OnceLock::new() }
    }

    /// Its circuits and curves, without measures.
    pub(super) fn moved(&self) -> PyResult<&SolvedCell> {
        let solve = || solve_measuring(&self.family, &sampler(self.family.sampling), 0, &[false; MEASURES.len()]);
        self.moved.get_or_init(solve).as_ref().ok_or_else(|| self.no_linkage())
    }

    /// Its circuits and curves with all measures.
    pub(super) fn measured(&self, py: Python) -> PyResult<&SolvedCell> {
        let solve = || solve_cell(&self.family, &sampler(self.family.sampling), 0);
        let measured = py.detach(|| self.measured.get_or_init(solve).as_ref());
        measured.ok_or_else(|| self.no_linkage())
    }

    pub(super) fn no_linkage(&self) -> PyErr {
        LinkageError::new_err(format!("{}: there is no linkage with these parameters", self.family.id))
    }

    /// The index of a curve among those of the linkage, by the numbers of its trace and its circuit.
    pub(super) fn curve_index(&self, trace: usize, circuit: usize) -> PyResult<usize> {
        let solved = self.moved()?;
        if !solved.motion.is_assembled() {
            return Err(LinkageError::new_err(format!("{}: {}", self.family.id, solved.reason())));
        }
        let index = solved.curves.iter().position(|curve| [curve.trace, curve.circuit] == [trace, circuit]);
        index.ok_or_else(|| {
            let (traces, circuits) = (solved.linkage.traced.len(), solved.motion.circuits.len());
            PyValueError::new_err(format!(
                "trace={trace}, circuit={circuit}: `{}` has traces 1 to {traces} and circuits 1 to {circuits}",
                self.family.id
            ))
        })
    }

    pub(super) fn placed(&self, trace: usize) -> PyResult<PlacedFourBar> {
        let solved = self.moved()?;
        let id = &self.family.id;
        let Some(&joint) = trace.checked_sub(1).and_then(|k| solved.linkage.traced.get(k)) else {
            let count = solved.linkage.traced.len();
            return Err(PyValueError::new_err(format!("trace={trace}: `{id}` traces joints 1 to {count}")));
        };
        PlacedFourBar::from_linkage(&solved.linkage, joint)
            .map_err(|error| LinkageError::new_err(format!("{id}: {error}; {}", error.help())))
    }

    /// The linkage as SVG, with all its curves.
    pub(super) fn svg(&self, pose: impl FnOnce(&SolvedCell) -> PoseChoice, py: Python) -> PyResult<String> {
        let solved = self.measured(py)?;
        if !solved.motion.is_assembled() {
            return Err(LinkageError::new_err(format!("{}: {}", self.family.id, solved.reason())));
        }
        let scene = plate::compose_cell(&self.family, solved, pose(solved), &Options::for_paper(PAPER));
        Ok(into_text(render::svg(&scene, TextMode::Text)))
    }
}

pub(super) fn into_text(bytes: Vec<u8>) -> String {
    String::from_utf8_lossy(&bytes).into_owned()
}

pub(super) fn measures_of<'py>(py: Python<'py>, solution: &Solution, index: usize) -> PyResult<Bound<'py, PyDict>> {
    let solved = solution.measured(py)?;
    let is_driven_by_length = solved.linkage.input() == Input::Length;
    let found = PyDict::new(py);
    for (measure, value) in MEASURES.iter().zip(&solved.curves[index].values) {
        let name = measure.name_for(is_driven_by_length);
        match value {
            Value::Number(number) => found.set_item(name, number)?,
            Value::Word(word) => found.set_item(name, word)?,
            Value::Missing => found.set_item(name, py.None())?,
        }
    }
    Ok(found)
}
