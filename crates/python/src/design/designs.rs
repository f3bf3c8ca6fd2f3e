//! What a search by wishes has found.

use std::sync::Arc;

use coupler_atlas::design::{self, describe};
use coupler_curves::measure::Measure;
use coupler_find::{DesignAnswer, WishValue, Wishes};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::linkage::{DEFAULT_SAMPLES, Linkage, into_object};
use crate::results::{Results, Shown};

/// The linkages that meet wishes: a sequence of designs, the best first.
#[pyclass(frozen, extends = Results, module = "coupler_atlas")]
pub struct Designs {
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
        let goals: Vec<String> = wishes.goals.iter().map(|goal| goal.text.clone()).collect();
        let own_text: Option<Arc<str>> = own_text.map(Into::into);
        let design = |answer| Py::new(py, Design { answer, goals: goals.clone(), own_text: own_text.clone() });
        let designs: Vec<Py<Design>> = found.answers.into_iter().map(design).collect::<PyResult<_>>()?;
        let miss = |miss: coupler_find::DesignMiss| Ok((wishes.wishes[miss.wish].text(), design(miss.nearest)?));
        let misses = found.misses.into_iter().map(miss).collect::<PyResult<_>>()?;
        let own = Designs {
            linkage,
            searched: found.searched,
            misses,
            is_any_assembled: found.is_any_assembled,
            is_size_unbounded: found.is_size_unbounded,
        };
        Py::new(py, PyClassInitializer::from(Results::new(py, &designs, shown)?).add_subclass(own))
    }
}

#[pymethods]
impl Designs {
    /// The names of the parameters that were varied.
    #[getter]
    fn searched(&self) -> Vec<String> {
        self.searched.clone()
    }

    /// Where no linkage meets all wishes: for each wish without which the others can be met, the linkage that comes nearest to it and meets
    /// them. Empty also where leaving out one wish is not enough.
    #[getter]
    fn misses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        self.misses.iter().try_for_each(|(wish, design)| found.set_item(wish, design))?;
        Ok(found)
    }

    /// Whether any linkage within the ranges can be assembled.
    #[getter]
    fn assembled(&self) -> bool {
        self.is_any_assembled
    }

    /// Whether nothing holds the size of the linkages, and better ones are smaller or greater without end: give a length a value or a range, or
    /// `max_link`.
    #[getter]
    fn unbounded(&self) -> bool {
        self.is_size_unbounded
    }

    fn __repr__(this: &Bound<Designs>) -> String {
        let (py, own, results) = (this.py(), this.get(), this.as_super().get());
        let shown = match results.first::<Design>(py) {
            Some(best) => format!("{}, the best with {}", results.count(py), describe(&best.get().answer)),
            None if !own.is_any_assembled => "none within the ranges can be assembled".to_owned(),
            None => {
                let miss =
                    |(wish, design): &(String, Py<Design>)| format!("{wish}: {}", describe(&design.get().answer));
                let misses: Vec<String> = own.misses.iter().map(miss).collect();
                format!("none meets the wishes; nearest without {{{}}}", misses.join("; "))
            }
        };
        format!("<coupler_atlas.Designs of {}: {shown}>", own.linkage)
    }
}

/// A linkage that meets wishes, or comes nearest to them.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Design {
    answer: DesignAnswer,
    /// The goals as they were given.
    goals: Vec<String>,
    /// The text of the linkage, if it is of a manifest.
    own_text: Option<Arc<str>>,
}

impl Design {
    /// A method of the linkage, of the curve whose measures are wished for.
    fn of_curve<'py>(&self, py: Python<'py>, method: &str) -> PyResult<Bound<'py, PyAny>> {
        let keywords = PyDict::new(py);
        keywords.set_item("trace", self.trace())?;
        keywords.set_item("circuit", self.circuit())?;
        self.linkage(py)?.call_method(py, method, (), Some(&keywords)).map(|found| found.into_bound(py))
    }
}

#[pymethods]
impl Design {
    /// The linkage.
    #[getter]
    fn linkage(&self, py: Python) -> PyResult<Py<PyAny>> {
        let DesignAnswer { family, values, .. } = &self.answer;
        let names = family.template.parameters.iter().map(|parameter| parameter.name.clone());
        let values = names.zip(values.iter().copied()).collect();
        let own_text = self.own_text.clone();
        into_object(py, Linkage::of_template(family.template.clone(), own_text, values, (DEFAULT_SAMPLES, None))?)
    }

    /// The values of its parameters by name, in the order in which they are declared.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        let DesignAnswer { family, values, .. } = &self.answer;
        for (parameter, value) in family.template.parameters.iter().zip(values) {
            found.set_item(&parameter.name, value)?;
        }
        Ok(found)
    }

    /// The values of the goals, by their texts.
    #[getter]
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for (text, (_, value)) in self.goals.iter().zip(&self.answer.goals) {
            found.set_item(text, value)?;
        }
        Ok(found)
    }

    /// What the conditions compare, by its text: numbers; of a condition that is no comparison whether it is met.
    #[getter]
    fn wishes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for WishValue { text, value, is_met } in &self.answer.wishes {
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
        self.answer.solved.curves[0].trace
    }

    /// The number of the circuit, from 1.
    #[getter]
    fn circuit(&self) -> usize {
        self.answer.solved.curves[0].circuit
    }

    /// The class of a four-bar: ``crank-rocker`` and so on; None for other linkages.
    #[getter]
    fn class_(&self) -> Option<&'static str> {
        self.answer.solved.curves[0].measure(Measure::CLASS)
    }

    /// The worst transmission angle, in degrees, 0 to 90; None where there is none.
    #[getter]
    fn mu_worst_deg(&self) -> Option<f64> {
        self.answer.mu_worst_deg()
    }

    /// The greatest distance of two joints of a link.
    #[getter]
    fn longest_link(&self) -> f64 {
        self.answer.longest_link
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
        self.linkage(py)?.call_method0(py, "_repr_svg_")
    }

    fn __repr__(&self) -> String {
        let parameters = design::parameters(&self.answer);
        format!("<coupler_atlas.Design: {}: {parameters}>", describe(&self.answer))
    }
}
