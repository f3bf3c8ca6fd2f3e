//! What is known of one linkage.

use coupler_atlas::find::Notation;
use coupler_atlas::inspect::{Inspection as Inspected, Options, parse_input};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyList};

use crate::argument::natural;
use crate::error::LinkageError;
use crate::html;
use crate::linkage::{Linkage, into_text};
use crate::reduce::{Reduced, Remake, reduced};
use crate::results::from_json;

/// What is known of a linkage: its class, limits, transmission angle and straight portion, its circuits, and what was asked for.
///
/// As text it is what the command ``inspect`` prints. It is a mapping with the keys of its JSON, which docs/inspect.md describes:
/// ``inspection["circuits"]``.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Inspection(InspectionRecord);

/// What is recorded of an inspection.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct InspectionRecord {
    text: String,
    json: String,
    /// A plate; none of a linkage that cannot be assembled.
    svg: Option<String>,
    /// The manifest of the four-bar and its cognates, if they were asked for.
    cognates: Option<String>,
}

impl Remake for Inspection {
    type State = InspectionRecord;

    fn remake(py: Python, record: InspectionRecord) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, Inspection(record))?.into_any())
    }
}

#[pymethods]
impl Inspection {
    /// All that is known as a dictionary, in the order of the command's JSON.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(from_json(py, &self.0.json)?.cast_into()?)
    }

    /// The JSON that the command prints with ``--json``.
    fn json(&self) -> &str {
        &self.0.json
    }

    /// The keys, in order.
    fn keys<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        Ok(self.to_dict(py)?.keys())
    }

    /// The values, in order.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        Ok(self.to_dict(py)?.values())
    }

    /// The pairs of a key and its value, in order.
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        Ok(self.to_dict(py)?.items())
    }

    /// The value of a key, or `default` if there is none.
    #[pyo3(signature = (key, default=None, /))]
    fn get<'py>(
        &self,
        py: Python<'py>,
        key: &Bound<'py, PyAny>,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        Ok(self.to_dict(py)?.get_item(key)?.or(default))
    }

    fn __contains__<'py>(&self, py: Python<'py>, key: &Bound<'py, PyAny>) -> PyResult<bool> {
        self.to_dict(py)?.contains(key)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.keys(py)?.try_iter()
    }

    fn __len__(&self, py: Python) -> PyResult<usize> {
        Ok(self.to_dict(py)?.len())
    }

    fn __getitem__<'py>(&self, py: Python<'py>, key: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.to_dict(py)?.get_item(key)?.ok_or_else(|| PyKeyError::new_err(key.clone().unbind()))
    }

    /// A plate of the linkage as SVG, in its pose at the input that was asked for or in its clearest one, with its cognates if they were asked for.
    fn svg(&self) -> PyResult<&str> {
        self.0.svg.as_deref().ok_or_else(|| LinkageError::new_err("the linkage cannot be assembled"))
    }

    /// The manifest of the four-bar and its cognates, as TOML, if they were asked for.
    fn toml(&self) -> PyResult<&str> {
        self.0
            .cognates
            .as_deref()
            .ok_or_else(|| PyValueError::new_err("the cognates were not asked for: give cognates=True"))
    }

    /// The plate, and what the command prints.
    fn _repr_html_(&self) -> String {
        let title = self.0.text.lines().next().unwrap_or_default();
        let plate = self.0.svg.as_ref().map_or(String::new(), |svg| html::picture(svg, title, 400));
        format!("{plate}<pre>{}</pre>", html::escaped(&self.0.text))
    }

    fn __str__(&self) -> &str {
        &self.0.text
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Inspection of {}>", self.0.text.lines().next().unwrap_or_default())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Inspection>(py, &self.0)
    }
}

/// An input: a number, or an expression with a unit.
#[derive(FromPyObject)]
pub enum InputArgument {
    /// In degrees, or a length.
    Number(f64),
    /// As in `0.5 rad`.
    Text(String),
}

/// Inspect a linkage: its class, limits, transmission angle and straight portion; its circuits, and what is asked for.
///
/// Parameters
/// ----------
/// linkage : Linkage
///     The linkage.
/// at : float or str, optional
///     The input of poses that are described, in degrees or as an expression with a unit, ``"0.5 rad"``, or as a length.
/// branch : {1, -1}, optional
///     With `at`, only the poses with the first two-valued joint on this side, 1 left or -1 right; those of all circuits.
/// load : str, optional
///     A force on a joint, for the torque with which the input moves it: ``"100 on C at -90 deg"``, or ``"100 on C"`` against the motion of C.
/// tolerance : float, optional
///     How far each length may be off: how far the curves move then.
/// sextic : bool
///     The text has the coefficients of the equations of the coupler curves, which the mapping has in any case.
/// cognates : bool
///     Find the two other four-bars that trace the same curve.
/// trace : int
///     With `cognates`, the number of the traced joint that is the coupler point, from 1.
///
/// Returns
/// -------
/// Inspection
///     A mapping; as text what the command prints.
///
/// Raises
/// ------
/// ValueError
///     An argument is wrong, or does not suit the linkage.
#[pyfunction]
#[pyo3(name = "inspect", signature = (linkage, *, at=None, branch=None, load=None, tolerance=None, sextic=false, cognates=false, trace=1))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn inspect_linkage(
    py: Python,
    linkage: &Bound<Linkage>,
    at: Option<InputArgument>,
    branch: Option<i8>,
    load: Option<String>,
    tolerance: Option<f64>,
    sextic: bool,
    cognates: bool,
    trace: i64,
) -> PyResult<Inspection> {
    let wrong = |message: String| PyValueError::new_err(message);
    let mut family = linkage.get().family().clone();
    let at = match at {
        Some(InputArgument::Text(text)) => {
            Some(parse_input(&text, family.template.is_driven_by_length(), "at=30").map_err(wrong)?)
        }
        Some(InputArgument::Number(at)) => Some(at),
        None => None,
    };
    if let Some(at) = at.filter(|at| !at.is_finite()) {
        return Err(wrong(format!("at={at}: give a finite number, as in at=30")));
    }
    match branch {
        Some(_) if at.is_none() => return Err(wrong("branch is about the poses at an input: give at=…".to_owned())),
        Some(1 | -1) | None => {}
        Some(branch) => return Err(wrong(format!("branch={branch}: give 1 or -1"))),
    }
    let cognates = cognates.then(|| natural("trace", trace)).transpose()?;
    let options = Options { at, branch, load, tolerance, sextic, cognates, ..Options::new(Notation::Python) };
    options.apply(&mut family.template).map_err(wrong)?;
    let record = py.detach(|| {
        let inspected = Inspected::new(family, &options)?;
        let svg = inspected.is_assembled().then(|| into_text(inspected.svg(false)));
        let json = inspected.json().map_err(|error| error.to_string())?;
        Ok(InspectionRecord { text: inspected.text(), json, svg, cognates: inspected.cognates_manifest() })
    });
    record.map(Inspection).map_err(wrong)
}
