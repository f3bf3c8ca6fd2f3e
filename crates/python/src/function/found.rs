//! Linkages that generate a function, as they have been found.

use coupler_atlas::find::function::method_name;
use coupler_find::{FunctionMethod, FunctionTarget, LinkageFunctionAnswer, StructuralError};
use numpy::{AllowTypeChange, PyArray1, PyArrayLike1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::wanted::Wanted;
use crate::arrays;
use crate::linkage::{Linkage, Recipe, into_object, template_of_text};
use crate::results::{Results, Shown};

/// How linkages were found.
pub(super) struct Method {
    pub name: &'static str,
    /// The number of precision points.
    pub points: Option<usize>,
    /// The number of all solutions, of precision points.
    pub solutions: Option<usize>,
    /// What is left out, in words.
    pub left_out: String,
}

impl Method {
    /// A method of which no solutions are known.
    pub(super) fn of(method: FunctionMethod) -> Method {
        let (name, points) = method_name(method);
        Method { name, points, solutions: None, left_out: String::new() }
    }
}

/// The linkages found for a function: a sequence of answers, the least error first.
#[pyclass(frozen, extends = Results, module = "coupler_atlas")]
pub struct FoundFunction {
    target: FunctionTarget,
    method: Method,
}

impl FoundFunction {
    pub(super) fn make(
        py: Python,
        Wanted { target, .. }: Wanted,
        method: Method,
        answers: impl Iterator<Item = Entry>,
        shown: Shown,
    ) -> PyResult<Py<FoundFunction>> {
        let is_length = target.is_length();
        let answer = |entry| Py::new(py, FunctionAnswer { entry, is_length });
        let answers: Vec<Py<FunctionAnswer>> = answers.map(answer).collect::<PyResult<_>>()?;
        let results = Results::new(py, &answers, shown)?;
        Py::new(py, PyClassInitializer::from(results).add_subclass(FoundFunction { target, method }))
    }
}

#[pymethods]
impl FoundFunction {
    /// How the linkages were found: ``points``, ``least-squares`` or ``minimax``.
    #[getter]
    fn method(&self) -> &'static str {
        self.method.name
    }

    /// The number of precision points; None of a fit.
    #[getter]
    fn precision_points(&self) -> Option<usize> {
        self.method.points
    }

    /// How many linkages are exact at the precision points, with those that are left out; None where they are infinitely many.
    #[getter]
    fn solutions(&self) -> Option<usize> {
        self.method.solutions
    }

    /// What is left out and why, in words, or why there is no linkage; empty if nothing is.
    #[getter]
    fn left_out(&self) -> &str {
        &self.method.left_out
    }

    /// Whether the output is a length, and not an angle.
    #[getter]
    fn output_is_length(&self) -> bool {
        self.target.is_length()
    }

    fn __repr__(this: &Bound<FoundFunction>) -> String {
        let (py, results) = (this.py(), this.as_super().get());
        let shown = match (results.first::<FunctionAnswer>(py), this.get().left_out()) {
            (Some(best), _) => {
                format!("linkages: {}, the best with {}", results.count(py), best.get().error_in_words())
            }
            (None, "") => "no linkage".to_owned(),
            (None, left_out) => format!("no linkage: {left_out}"),
        };
        format!("<coupler_atlas.FoundFunction by {}: {shown}>", this.get().method.name)
    }
}

/// A linkage of one of two kinds.
pub(super) enum Entry {
    /// A four-bar or a slider-crank.
    Closed(Box<coupler_find::FunctionAnswer>),
    /// Any linkage.
    Any(Box<LinkageFunctionAnswer>),
}

/// A linkage whose output is near a function of its input.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct FunctionAnswer {
    entry: Entry,
    is_length: bool,
}

impl FunctionAnswer {
    fn error(&self) -> &StructuralError {
        match &self.entry {
            Entry::Closed(answer) => &answer.error,
            Entry::Any(answer) => &answer.error,
        }
    }

    fn error_in_words(&self) -> String {
        let unit = if self.is_length { "" } else { "°" };
        format!("errors up to {:.3e}{unit}", self.error().greatest.abs())
    }
}

#[pymethods]
impl FunctionAnswer {
    /// The linkage over the range of its input: of a four-bar the frame is 1.
    #[getter]
    fn linkage(&self, py: Python) -> PyResult<Py<PyAny>> {
        /// Of the range of the input.
        const SAMPLES: usize = 180;
        let linkage = match &self.entry {
            Entry::Closed(answer) => {
                let text = answer.template_toml();
                let template = template_of_text(&answer.linkage_id(), Some(&text))?;
                Linkage::of_template(template, Some(text.into()), answer.parameters(), (SAMPLES, None))?
            }
            Entry::Any(answer) => {
                let family = &answer.family;
                Linkage::new(family.clone(), family.template.source_line(), Recipe::Found)
            }
        };
        into_object(py, linkage)
    }

    /// The input at the start and at the end of the function, in degrees.
    #[getter]
    fn inputs(&self) -> (f64, f64) {
        let [from, to] = match &self.entry {
            Entry::Closed(answer) => answer.input_deg,
            Entry::Any(answer) => answer.input_deg,
        };
        (from, to)
    }

    /// The output that is wanted there, in degrees or as a length.
    #[getter]
    fn outputs(&self) -> (f64, f64) {
        let [from, to] = match &self.entry {
            Entry::Closed(answer) => answer.output,
            Entry::Any(answer) => answer.output,
        };
        (from, to)
    }

    /// The error of the greatest magnitude, with its sign: the output less the wanted one, in degrees or as a length.
    #[getter]
    fn greatest(&self) -> f64 {
        self.error().greatest
    }

    /// The input where it is, in degrees.
    #[getter]
    fn greatest_at(&self) -> f64 {
        self.error().at
    }

    /// The root of the mean square of the error over the range, or over the rows.
    #[getter]
    fn rms(&self) -> f64 {
        self.error().rms
    }

    /// The inputs at which a four-bar or slider-crank has no error, in degrees, if it is for a formula.
    #[getter]
    fn zeros<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::column(py, self.error().zeros.clone())
    }

    /// The side on which a four-bar (``left``, ``right``) or slider-crank (``ahead``, ``behind``) is assembled; None of other linkages.
    #[getter]
    fn side(&self) -> Option<&'static str> {
        match &self.entry {
            Entry::Closed(answer) => Some(answer.side),
            Entry::Any(_) => None,
        }
    }

    /// The class of a four-bar, ``crank-rocker`` and so on, ``crank`` or ``rocker`` of a slider-crank; None of other linkages.
    #[getter]
    fn class_(&self) -> Option<&'static str> {
        match &self.entry {
            Entry::Closed(answer) => Some(answer.class),
            Entry::Any(_) => None,
        }
    }

    /// The worst transmission angle over the range of the input, in degrees, 0 to 90; None where there is none.
    #[getter]
    fn mu_worst_deg(&self) -> Option<f64> {
        let angle = match &self.entry {
            Entry::Closed(answer) => answer.mu_worst_deg,
            Entry::Any(answer) => answer.mu_worst_deg,
        };
        Some(angle).filter(|angle| angle.is_finite())
    }

    /// The outputs at some inputs of its range, in degrees or as lengths: an array of as many. Of other linkages than four-bars and slider-cranks the
    /// inputs must go from the start towards the end.
    fn output<'py>(
        &self,
        py: Python<'py>,
        inputs: PyArrayLike1<f64, AllowTypeChange>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let ((from, _), (start, _)) = (self.inputs(), self.outputs());
        let travels: Vec<f64> = inputs.as_array().iter().map(|input| input - from).collect();
        let generated = match &self.entry {
            Entry::Closed(answer) => Some(travels.iter().map(|travel| answer.generated(*travel)).collect()),
            Entry::Any(answer) => answer.generated(&travels),
        };
        let generated: Vec<f64> =
            generated.ok_or_else(|| PyValueError::new_err("the linkage does not reach these inputs in their order"))?;
        Ok(arrays::column(py, generated.into_iter().map(|output| start + output).collect()))
    }

    fn _repr_svg_(&self, py: Python) -> PyResult<Py<PyAny>> {
        self.linkage(py)?.call_method0(py, "_repr_svg_")
    }

    fn __repr__(&self, py: Python) -> PyResult<String> {
        let linkage = self.linkage(py)?.bind(py).repr()?;
        Ok(format!("<coupler_atlas.FunctionAnswer: {}: {linkage}>", self.error_in_words()))
    }
}
