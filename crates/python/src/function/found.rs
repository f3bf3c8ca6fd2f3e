//! Linkages that generate a function, as they have been found.

use std::sync::Arc;

use coupler_atlas::find::function::method_name;
use coupler_curves::template::Template;
use coupler_find::{FollowedOutput, FunctionMethod, GeneratorKind, LinkageFunctionAnswer, StructuralError};
use numpy::{AllowTypeChange, PyArray1, PyArrayLike1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::wanted::Wanted;
use crate::arrays;
use crate::error::LinkageError;
use crate::linkage::{Linkage, MotionChoice, into_object, template_of_text};
use crate::reduce::{Reduced, Remake, reduced};
use crate::results::{Results, ResultsRecord, Shown};

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
pub struct FoundFunction(FoundFunctionRecord);

/// What is recorded of a search for a function.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct FoundFunctionRecord {
    method: String,
    points: Option<usize>,
    solutions: Option<usize>,
    left_out: String,
    is_length: bool,
}

impl FoundFunction {
    pub(super) fn make(
        py: Python,
        Wanted { target, .. }: Wanted,
        Method { name, points, solutions, left_out }: Method,
        answers: impl Iterator<Item = PyResult<FunctionAnswer>>,
        shown: Shown,
    ) -> PyResult<Py<FoundFunction>> {
        let answer = |answer: PyResult<FunctionAnswer>| Py::new(py, answer?);
        let answers: Vec<Py<FunctionAnswer>> = answers.map(answer).collect::<PyResult<_>>()?;
        let is_length = target.is_length();
        let record = FoundFunctionRecord { method: name.to_owned(), points, solutions, left_out, is_length };
        FoundFunction::recorded(py, Results::new(py, &answers, shown)?, record)
    }

    fn recorded(py: Python, results: Results, record: FoundFunctionRecord) -> PyResult<Py<FoundFunction>> {
        Py::new(py, PyClassInitializer::from(results).add_subclass(FoundFunction(record)))
    }
}

impl Remake for FoundFunction {
    type State = (ResultsRecord, FoundFunctionRecord);

    fn remake(py: Python, (results, record): Self::State) -> PyResult<Py<PyAny>> {
        Ok(FoundFunction::recorded(py, Results::recorded(results), record)?.into_any())
    }
}

#[pymethods]
impl FoundFunction {
    /// How the linkages were found: ``points``, ``least-squares`` or ``minimax``.
    #[getter]
    fn method(&self) -> &str {
        &self.0.method
    }

    /// The number of precision points; None of a fit.
    #[getter]
    fn precision_points(&self) -> Option<usize> {
        self.0.points
    }

    /// How many linkages are exact at the precision points, with those that are left out; None where they are infinitely many.
    #[getter]
    fn solutions(&self) -> Option<usize> {
        self.0.solutions
    }

    /// What is left out and why, in words, or why there is no linkage; empty if nothing is.
    #[getter]
    fn left_out(&self) -> &str {
        &self.0.left_out
    }

    /// Whether the output is a length, and not an angle.
    #[getter]
    fn output_is_length(&self) -> bool {
        self.0.is_length
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
        format!("<coupler_atlas.FoundFunction by {}: {shown}>", this.get().0.method)
    }

    fn __reduce__<'py>(this: &Bound<'py, FoundFunction>) -> PyResult<Reduced<'py>> {
        reduced::<FoundFunction>(this.py(), (this.as_super().get().record(), &this.get().0))
    }
}

/// A linkage whose output is near a function of its input.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct FunctionAnswer {
    record: FunctionAnswerRecord,
    output_function: OutputFunction,
}

/// What a linkage generates.
enum OutputFunction {
    /// That of a four-bar or a slider-crank.
    Closed(coupler_find::OutputFunction),
    /// That of any linkage.
    Followed(Box<FollowedOutput>),
}

/// What is recorded of an answer for a function.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct FunctionAnswerRecord {
    linkage: Py<PyAny>,
    inputs: [f64; 2],
    outputs: [f64; 2],
    greatest: f64,
    greatest_at: f64,
    rms: f64,
    zeros: Vec<f64>,
    side: Option<String>,
    class: Option<String>,
    mu_worst_deg: Option<f64>,
    is_length: bool,
    output_function: OutputFunctionRecord,
}

/// What an [`OutputFunction`] is made again from.
#[derive(FromPyObject, IntoPyObjectRef)]
enum OutputFunctionRecord {
    /// The numbers of a four-bar's or a slider-crank's.
    Closed([f64; 9]),
    /// The circuit and the pass of the linkage, and the input and the output at the start.
    Followed([usize; 2], [f64; 2]),
}

impl FunctionAnswer {
    /// A four-bar or a slider-crank.
    pub(super) fn closed(
        py: Python,
        answer: coupler_find::FunctionAnswer,
        is_length: bool,
    ) -> PyResult<FunctionAnswer> {
        /// Of the range of the input.
        const SAMPLES: usize = 180;
        let text = answer.template_toml();
        let template = template_of_text(&answer.linkage_id(), Some(&text))?;
        let motion = MotionChoice::samples(SAMPLES);
        let linkage = Linkage::of_template(template, Some(text.into()), answer.parameters(), motion)?;
        let output_function = answer.output_function;
        let record = FunctionAnswerRecord {
            side: Some(answer.side.to_owned()),
            class: Some(answer.class.to_owned()),
            ..FunctionAnswerRecord::new(
                into_object(py, linkage)?,
                [answer.input_deg, answer.output],
                answer.error,
                (answer.mu_worst_deg, is_length),
                OutputFunctionRecord::Closed(output_function.to_numbers()),
            )
        };
        Ok(FunctionAnswer { record, output_function: OutputFunction::Closed(output_function) })
    }

    /// Any linkage, with the linkage whose dimensions were searched and its text if it is of a manifest.
    pub(super) fn followed(
        py: Python,
        answer: LinkageFunctionAnswer,
        (template, own_text): (&Arc<Template>, Option<&str>),
        is_length: bool,
    ) -> PyResult<FunctionAnswer> {
        let motion = MotionChoice {
            sampling: answer.family.sampling,
            range_deg: Some(answer.input_deg),
            ..MotionChoice::DEFAULT
        };
        let own_text = own_text.map(Into::into);
        let linkage = Linkage::by_values(template.clone(), own_text, &answer.values, motion)?;
        let (place, starts) = answer.output_function.place();
        let record = FunctionAnswerRecord::new(
            into_object(py, linkage)?,
            [answer.input_deg, answer.output],
            answer.error,
            (answer.mu_worst_deg, is_length),
            OutputFunctionRecord::Followed(place, starts),
        );
        let output_function = OutputFunction::Followed(Box::new(answer.output_function));
        Ok(FunctionAnswer { record, output_function })
    }

    fn error_in_words(&self) -> String {
        let unit = if self.record.is_length { "" } else { "°" };
        format!("errors up to {:.3e}{unit}", self.record.greatest.abs())
    }
}

impl FunctionAnswerRecord {
    fn new(
        linkage: Py<PyAny>,
        [inputs, outputs]: [[f64; 2]; 2],
        StructuralError { greatest, at, rms, zeros }: StructuralError,
        (mu_worst_deg, is_length): (f64, bool),
        output_function: OutputFunctionRecord,
    ) -> FunctionAnswerRecord {
        FunctionAnswerRecord {
            linkage,
            inputs,
            outputs,
            greatest,
            greatest_at: at,
            rms,
            zeros,
            side: None,
            class: None,
            mu_worst_deg: Some(mu_worst_deg).filter(|angle| angle.is_finite()),
            is_length,
            output_function,
        }
    }
}

impl Remake for FunctionAnswer {
    type State = FunctionAnswerRecord;

    fn remake(py: Python, record: FunctionAnswerRecord) -> PyResult<Py<PyAny>> {
        let output_function = match record.output_function {
            OutputFunctionRecord::Closed(numbers) => {
                let kind = if record.is_length { GeneratorKind::SliderCrank } else { GeneratorKind::FourBar };
                OutputFunction::Closed(coupler_find::OutputFunction::from_numbers(kind, numbers))
            }
            OutputFunctionRecord::Followed(place, starts) => {
                let linkage = record.linkage.bind(py).cast::<Linkage>()?.get().at_any_input()?;
                let found = FollowedOutput::new(linkage, place, starts, record.is_length);
                let found = found.ok_or_else(|| LinkageError::new_err("the linkage has not this circuit"))?;
                OutputFunction::Followed(Box::new(found))
            }
        };
        Ok(Py::new(py, FunctionAnswer { record, output_function })?.into_any())
    }
}

#[pymethods]
impl FunctionAnswer {
    /// The linkage over the range of its input: of a four-bar the frame is 1.
    #[getter]
    fn linkage(&self, py: Python) -> Py<PyAny> {
        self.record.linkage.clone_ref(py)
    }

    /// The input at the start and at the end of the function, in degrees.
    #[getter]
    fn inputs(&self) -> (f64, f64) {
        self.record.inputs.into()
    }

    /// The output that is wanted there, in degrees or as a length.
    #[getter]
    fn outputs(&self) -> (f64, f64) {
        self.record.outputs.into()
    }

    /// The error of the greatest magnitude, with its sign: the output less the wanted one, in degrees or as a length.
    #[getter]
    fn greatest(&self) -> f64 {
        self.record.greatest
    }

    /// The input where it is, in degrees.
    #[getter]
    fn greatest_at(&self) -> f64 {
        self.record.greatest_at
    }

    /// The root of the mean square of the error over the range, or over the rows.
    #[getter]
    fn rms(&self) -> f64 {
        self.record.rms
    }

    /// The inputs at which a four-bar or slider-crank has no error, in degrees, if it is for a formula.
    #[getter]
    fn zeros<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::column(py, self.record.zeros.clone())
    }

    /// The side on which a four-bar (``left``, ``right``) or slider-crank (``ahead``, ``behind``) is assembled; None of other linkages.
    #[getter]
    fn side(&self) -> Option<&str> {
        self.record.side.as_deref()
    }

    /// The class of a four-bar, ``crank-rocker`` and so on, ``crank`` or ``rocker`` of a slider-crank; None of other linkages.
    #[getter]
    fn class_(&self) -> Option<&str> {
        self.record.class.as_deref()
    }

    /// The worst transmission angle over the range of the input, in degrees, 0 to 90; None where there is none.
    #[getter]
    fn mu_worst_deg(&self) -> Option<f64> {
        self.record.mu_worst_deg
    }

    /// The outputs at some inputs of its range, in degrees or as lengths: an array of as many. Of other linkages than four-bars and slider-cranks the
    /// inputs must go from the start towards the end.
    fn output<'py>(
        &self,
        py: Python<'py>,
        inputs: PyArrayLike1<f64, AllowTypeChange>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let ([from, _], [start, _]) = (self.record.inputs, self.record.outputs);
        let travels: Vec<f64> = inputs.as_array().iter().map(|input| input - from).collect();
        let generated = match &self.output_function {
            OutputFunction::Closed(output) => Some(travels.iter().map(|travel| output.at(*travel)).collect()),
            OutputFunction::Followed(output) => output.at(&travels),
        };
        let generated: Vec<f64> =
            generated.ok_or_else(|| PyValueError::new_err("the linkage does not reach these inputs in their order"))?;
        Ok(arrays::column(py, generated.into_iter().map(|output| start + output).collect()))
    }

    fn _repr_svg_(&self, py: Python) -> PyResult<Py<PyAny>> {
        self.record.linkage.call_method0(py, "_repr_svg_")
    }

    fn __repr__(&self, py: Python) -> PyResult<String> {
        let linkage = self.record.linkage.bind(py).repr()?;
        Ok(format!("<coupler_atlas.FunctionAnswer: {}: {linkage}>", self.error_in_words()))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<FunctionAnswer>(py, &self.record)
    }
}
