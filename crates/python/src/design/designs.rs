//! What a search by wishes has found.

use std::sync::Arc;

use coupler_atlas::design::{self, describe};
use coupler_curves::measure::Measure;
use coupler_find::{DesignAnswer, WishValue, Wishes};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::linkage::{Linkage, MotionChoice, into_object};
use crate::reduce::{Reduced, Remake, reduced};
use crate::results::{Results, ResultsRecord, Shown};

/// The linkages that meet wishes: a sequence of designs, the best first.
#[pyclass(frozen, extends = Results, module = "coupler_atlas")]
pub struct Designs(DesignsRecord);

/// What is recorded of a search by wishes.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct DesignsRecord {
    linkage: String,
    searched: Vec<String>,
    /// The wishes that are not met while the others are, each with the nearest linkage.
    misses: Vec<(String, Py<Design>)>,
    is_any_assembled: bool,
    is_size_unbounded: bool,
}

impl Designs {
    pub(super) fn make(
        py: Python,
        (linkage, own_text): (String, Option<String>),
        wishes: &Wishes,
        found: design::Designs,
        shown: Shown,
    ) -> PyResult<Py<Designs>> {
        let own_text: Option<Arc<str>> = own_text.map(Into::into);
        let design = |answer| Py::new(py, Design(DesignRecord::new(py, &answer, wishes, own_text.clone())?));
        let designs: Vec<Py<Design>> = found.answers.into_iter().map(design).collect::<PyResult<_>>()?;
        let miss = |miss: coupler_find::DesignMiss| Ok((wishes.wishes[miss.wish].text(), design(miss.nearest)?));
        let record = DesignsRecord {
            linkage,
            searched: found.searched,
            misses: found.misses.into_iter().map(miss).collect::<PyResult<_>>()?,
            is_any_assembled: found.is_any_assembled,
            is_size_unbounded: found.is_size_unbounded,
        };
        Designs::recorded(py, Results::new(py, &designs, shown)?, record)
    }

    fn recorded(py: Python, results: Results, record: DesignsRecord) -> PyResult<Py<Designs>> {
        Py::new(py, PyClassInitializer::from(results).add_subclass(Designs(record)))
    }
}

impl Remake for Designs {
    type State = (ResultsRecord, DesignsRecord);

    fn remake(py: Python, (results, record): Self::State) -> PyResult<Py<PyAny>> {
        Ok(Designs::recorded(py, Results::recorded(results), record)?.into_any())
    }
}

#[pymethods]
impl Designs {
    /// The names of the parameters that were varied.
    #[getter]
    fn searched(&self) -> Vec<String> {
        self.0.searched.clone()
    }

    /// Where no linkage meets all wishes: for each wish without which the others can be met, the linkage that comes nearest to it and meets
    /// them. Empty also where leaving out one wish is not enough.
    #[getter]
    fn misses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        self.0.misses.iter().try_for_each(|(wish, design)| found.set_item(wish, design))?;
        Ok(found)
    }

    /// Whether any linkage within the ranges can be assembled.
    #[getter]
    fn assembled(&self) -> bool {
        self.0.is_any_assembled
    }

    /// Whether nothing holds the size of the linkages, and better ones are smaller or greater without end: give a length a value or a range, or
    /// `max_link`.
    #[getter]
    fn unbounded(&self) -> bool {
        self.0.is_size_unbounded
    }

    fn __repr__(this: &Bound<Designs>) -> String {
        let (py, own, results) = (this.py(), &this.get().0, this.as_super().get());
        let shown = match results.first::<Design>(py) {
            Some(best) => format!("{}, the best with {}", results.count(py), best.get().0.described),
            None if !own.is_any_assembled => "none within the ranges can be assembled".to_owned(),
            None => {
                let miss = |(wish, design): &(String, Py<Design>)| format!("{wish}: {}", design.get().0.described);
                let misses: Vec<String> = own.misses.iter().map(miss).collect();
                format!("none meets the wishes; nearest without {{{}}}", misses.join("; "))
            }
        };
        format!("<coupler_atlas.Designs of {}: {shown}>", own.linkage)
    }

    fn __reduce__<'py>(this: &Bound<'py, Designs>) -> PyResult<Reduced<'py>> {
        reduced::<Designs>(this.py(), (this.as_super().get().record(), &this.get().0))
    }
}

/// A linkage that meets wishes, or comes nearest to them.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Design(DesignRecord);

/// What is recorded of a design.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct DesignRecord {
    linkage: Py<PyAny>,
    /// The goals as they were given, with their values.
    goals: Vec<(String, f64)>,
    /// The conditions, what each compares with its value, and whether it is met.
    wishes: Vec<WishRecord>,
    trace: usize,
    circuit: usize,
    class: Option<String>,
    mu_worst_deg: Option<f64>,
    longest_link: f64,
    /// What is wished and what it has, and its dimensions, in words.
    described: String,
    dimensions: String,
}

/// A condition, what it compares with its value, and whether it is met.
type WishRecord = (String, Option<(String, f64)>, bool);

impl DesignRecord {
    /// The record of an answer; `own_text` is the text of the linkage, if it is of a manifest.
    fn new(py: Python, answer: &DesignAnswer, wishes: &Wishes, own_text: Option<Arc<str>>) -> PyResult<DesignRecord> {
        let DesignAnswer { family, values, .. } = answer;
        let linkage = Linkage::by_values(family.template.clone(), own_text, values, MotionChoice::DEFAULT)?;
        let goals = wishes.goals.iter().zip(&answer.goals).map(|(goal, (_, value))| (goal.text.clone(), *value));
        let wish = |WishValue { text, value, is_met }: &WishValue| (text.clone(), value.clone(), *is_met);
        let curve = &answer.solved.curves[0];
        let class: Option<&'static str> = curve.measure(Measure::CLASS);
        Ok(DesignRecord {
            linkage: into_object(py, linkage)?,
            goals: goals.collect(),
            wishes: answer.wishes.iter().map(wish).collect(),
            trace: curve.trace,
            circuit: curve.circuit,
            class: class.map(str::to_owned),
            mu_worst_deg: answer.mu_worst_deg(),
            longest_link: answer.longest_link,
            described: describe(answer),
            dimensions: design::parameters(answer),
        })
    }
}

impl Remake for Design {
    type State = DesignRecord;

    fn remake(py: Python, record: DesignRecord) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, Design(record))?.into_any())
    }
}

impl Design {
    /// A method of the linkage, of the curve whose measures are wished for.
    fn of_curve<'py>(&self, py: Python<'py>, method: &str) -> PyResult<Bound<'py, PyAny>> {
        let keywords = PyDict::new(py);
        keywords.set_item("trace", self.0.trace)?;
        keywords.set_item("circuit", self.0.circuit)?;
        self.0.linkage.bind(py).call_method(method, (), Some(&keywords))
    }
}

#[pymethods]
impl Design {
    /// The linkage.
    #[getter]
    fn linkage(&self, py: Python) -> Py<PyAny> {
        self.0.linkage.clone_ref(py)
    }

    /// The values of its parameters by name, in the order in which they are declared.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.0.linkage.bind(py).getattr("parameters")
    }

    /// The values of the goals, by their texts.
    #[getter]
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        self.0.goals.iter().try_for_each(|(text, value)| found.set_item(text, value))?;
        Ok(found)
    }

    /// What the conditions compare, by its text: numbers; of a condition that is no comparison whether it is met.
    #[getter]
    fn wishes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for (text, value, is_met) in &self.0.wishes {
            match value {
                Some((subject, value)) => found.set_item(subject, value)?,
                None => found.set_item(text, is_met)?,
            }
        }
        Ok(found)
    }

    /// The number of the traced joint whose measures are wished for, from 1.
    #[getter]
    fn trace(&self) -> usize {
        self.0.trace
    }

    /// The number of the circuit, from 1.
    #[getter]
    fn circuit(&self) -> usize {
        self.0.circuit
    }

    /// The class of a four-bar: ``crank-rocker`` and so on; None for other linkages.
    #[getter]
    fn class_(&self) -> Option<&str> {
        self.0.class.as_deref()
    }

    /// The worst transmission angle, in degrees, 0 to 90; None where there is none.
    #[getter]
    fn mu_worst_deg(&self) -> Option<f64> {
        self.0.mu_worst_deg
    }

    /// The greatest distance of two joints of a link.
    #[getter]
    fn longest_link(&self) -> f64 {
        self.0.longest_link
    }

    /// All measures of the curve by name, as `Linkage.measures` has them.
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(self.of_curve(py, "measures")?.cast_into()?)
    }

    /// The points of the curve: an array of shape (n, 2), in the unit of the lengths.
    fn curve<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Ok(self.of_curve(py, "curve")?.cast_into()?)
    }

    fn _repr_svg_(&self, py: Python) -> PyResult<Py<PyAny>> {
        self.0.linkage.call_method0(py, "_repr_svg_")
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Design: {}: {}>", self.0.described, self.0.dimensions)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Design>(py, &self.0)
    }
}
