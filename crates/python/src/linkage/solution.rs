//! What has been computed of a linkage.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coupler_curves::family::{Family, MEASURES, Sampling};
use coupler_curves::linkage::{Input, PlacedFourBar};
use coupler_curves::measure::{BOOLEANS, MeasureSet, Value};
use coupler_curves::motion::{Circuit, Sampler};
use coupler_curves::problem::suggestion;
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_drawing::page::{Options, PoseChoice};
use coupler_drawing::plate::{self, PAPER};
use coupler_drawing::render::{self, TextMode};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::recipe::Recipe;
use crate::argument::natural;
use crate::error::LinkageError;

/// A sampler; the last one is kept, for its table of sines takes as long as the samples of a linkage.
pub(super) fn sampler(sampling: Sampling) -> Sampler {
    static LAST: Mutex<Option<(Sampling, Sampler)>> = Mutex::new(None);
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    match &*last {
        Some((known, sampler)) if *known == sampling => sampler.clone(),
        _ => {
            let sampler = Sampler::new(sampling);
            *last = Some((sampling, sampler.clone()));
            sampler
        }
    }
}

/// A linkage with what has been computed of it.
pub struct Solution {
    pub(super) family: Family,
    pub(super) source: String,
    pub(super) recipe: Recipe,
    /// Without measures, which take most of the time.
    moved: OnceLock<Option<SolvedCell>>,
    measured: OnceLock<Option<SolvedCell>>,
}

impl Solution {
    pub(super) fn new(family: Family, source: String, recipe: Recipe) -> Solution {
        Solution { family, source, recipe, moved: OnceLock::new(), measured: OnceLock::new() }
    }

    /// The number of its cell, if it is one of an atlas.
    pub(super) fn number(&self) -> Option<usize> {
        if let Recipe::Cell { number: number @ 1.., .. } = &self.recipe { Some(*number) } else { None }
    }

    /// Whether two are the same linkage.
    pub(super) fn are_same(one: &Arc<Solution>, other: &Arc<Solution>) -> bool {
        Arc::ptr_eq(one, other) || one.recipe == other.recipe
    }

    /// The same of two that are the same.
    pub(super) fn hash(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        format!("{:?}", self.recipe).hash(&mut hasher);
        hasher.finish()
    }

    /// Why it cannot be assembled, if that is known already.
    pub(super) fn known_reason(&self) -> Option<String> {
        let solved = self.moved.get()?.as_ref()?;
        (!solved.motion.is_assembled()).then(|| solved.reason())
    }

    fn solver(&self) -> Solver<'_> {
        Solver::with_sampler(&self.family, sampler(self.family.sampling))
    }

    /// Its circuits and curves, without measures.
    pub(super) fn moved(&self) -> PyResult<&SolvedCell> {
        let solve = || self.solver().measuring(MeasureSet::EMPTY).solve(0);
        self.moved.get_or_init(solve).as_ref().ok_or_else(|| self.no_linkage())
    }

    /// Its circuits and curves with all measures.
    pub(super) fn measured(&self, py: Python) -> PyResult<&SolvedCell> {
        let solve = || self.solver().solve(0);
        let measured = py.detach(|| self.measured.get_or_init(solve).as_ref());
        measured.ok_or_else(|| self.no_linkage())
    }

    pub(super) fn no_linkage(&self) -> PyErr {
        LinkageError::new_err(format!("{}: there is no linkage with these parameters", self.family.id))
    }

    /// The index of a curve among those of the linkage, by the numbers of its trace and its circuit.
    pub(super) fn curve_index(&self, trace: i64, circuit: i64) -> PyResult<usize> {
        let [trace, circuit] = [natural("trace", trace)?, natural("circuit", circuit)?];
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

    pub(super) fn placed(&self, trace: i64) -> PyResult<PlacedFourBar> {
        let trace = natural("trace", trace)?;
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

/// A text as the program wrote it.
pub fn into_text(bytes: Vec<u8>) -> String {
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The measures of a curve by name: all of them, or `only` those of these names, in the order of the table.
///
/// # Errors
/// A name is that of no measure.
pub(super) fn measures_of<'py>(
    py: Python<'py>,
    solution: &Solution,
    index: usize,
    only: Option<Vec<String>>,
) -> PyResult<Bound<'py, PyDict>> {
    let only = match only {
        Some(names) => {
            names.iter().try_for_each(|name| known_measure("only", name))?;
            Some(MeasureSet::of(|measure| measure.names().any(|own| names.iter().any(|name| name == own))))
        }
        None => None,
    };
    // Few measures take less than all by far, and are not kept.
    let some = match (only, solution.measured.get()) {
        (Some(only), None) => py.detach(|| solution.solver().measuring(only).solve(0)),
        _ => None,
    };
    let solved = match &some {
        Some(solved) => solved,
        None => solution.measured(py)?,
    };
    let is_driven_by_length = solved.linkage.input() == Input::Length;
    let found = PyDict::new(py);
    for (k, (measure, value)) in MEASURES.iter().zip(&solved.curves[index].values).enumerate() {
        if only.is_some_and(|only| !only.contains(k)) {
            continue;
        }
        let name = measure.name_for(is_driven_by_length);
        match value {
            Value::Number(number) => found.set_item(name, number)?,
            // A table has words for a measure that is a boolean in conditions.
            Value::Word(word) => match BOOLEANS.iter().find(|boolean| boolean.name == measure.name) {
                Some(boolean) => found.set_item(name, *word == boolean.word)?,
                None => found.set_item(name, word)?,
            },
            Value::Missing => found.set_item(name, py.None())?,
        }
    }
    Ok(found)
}

/// Checks that a name is that of a measure.
///
/// # Errors
/// It is not; `argument` has it.
pub fn known_measure(argument: &str, name: &str) -> PyResult<()> {
    if MEASURES.iter().any(|measure| measure.names().any(|own| own == name)) {
        return Ok(());
    }
    let known: Vec<&str> = MEASURES.iter().flat_map(|measure| measure.names()).collect();
    Err(PyValueError::new_err(format!("{argument}: unknown measure `{name}`: {}", suggestion(name, &known))))
}

pub(super) fn limits_of(circuit: &Circuit) -> Option<(f64, f64)> {
    let range = || circuit.passes.iter().map(|pass| pass.input_range());
    let [least, greatest] =
        [range().map(|[low, _]| low).reduce(f64::min), range().map(|[_, high]| high).reduce(f64::max)];
    least.zip(greatest).filter(|_| !circuit.is_full_turn())
}
