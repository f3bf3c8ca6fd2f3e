//! Linkages, their circuits and their curves.

mod animation;
mod catalogue;
mod circuit;
mod curve;
mod explorer;
mod four_bar;
mod named;
mod numeric_linkage;
mod recipe;
mod sensitivity;
mod sextic;
mod solution;
mod templates;

pub use animation::Animation;
pub use catalogue::{linkages, make_linkage};
pub use circuit::Circuit;
pub use curve::Curve;
pub use explorer::Explorer;
pub use four_bar::{FourBar, into_object};
pub use named::NamedLinkage;
pub use numeric_linkage::Linkage;
pub use recipe::{MotionChoice, PickledRecipe, Recipe};
pub use sextic::Sextic;
pub use solution::{into_text, known_measure};
pub use templates::{named_template, template_of_text};

use std::path::PathBuf;

use coupler_atlas::gallery;
use coupler_atlas::manifest::{self, PlannedFamily};
use coupler_curves::family::Sampling;
use coupler_curves::linkage::Cognates;
use coupler_curves::motion::{self};
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::PoseChoice;
use coupler_drawing::plate::moving_view;
use numpy::PyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};

use crate::argument::natural;
use crate::arrays;
use crate::error::{Error, LinkageError};
use crate::file::save_svg;
use crate::reduce::{Reduced, reduced};
use catalogue::given_values;
use recipe::checked_samples;
use solution::{Solution, limits_of, measures_of, sampler};

#[pymethods]
impl Linkage {
    /// The id of the linkage, or of its family.
    #[getter]
    fn id(&self) -> &str {
        &self.solution.family.id
    }

    /// The number of its cell in its family, from 1; None for a linkage by itself.
    #[getter]
    fn number(&self) -> Option<usize> {
        self.solution.number()
    }

    /// The values of its parameters by name, in the order in which they are declared.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let family = &self.solution.family;
        let (values, found) = (family.cell(0).values, PyDict::new(py));
        for (parameter, value) in family.template.parameters.iter().zip(values) {
            found.set_item(&parameter.name, value)?;
        }
        Ok(found)
    }

    /// The names of the joints.
    #[getter]
    fn joints(&self) -> PyResult<Vec<&str>> {
        Ok(self.solution.moved()?.linkage.joints.iter().map(|joint| joint.name.as_str()).collect())
    }

    /// What the input is: ``deg``, an angle, or ``length``.
    #[getter]
    fn input(&self) -> &'static str {
        if self.solution.family.template.is_driven_by_length() { "length" } else { "deg" }
    }

    /// Whether it can be assembled: ``ok``, ``partial`` over a part of the requested range, or ``none``.
    #[getter]
    fn status(&self) -> PyResult<&'static str> {
        Ok(self.solution.moved()?.status().name())
    }

    /// Why the status is not ``ok``; empty if it is.
    #[getter]
    fn reason(&self) -> PyResult<String> {
        Ok(self.solution.moved()?.reason())
    }

    /// The points of a curve: an array of shape (n, 2), in the unit of the lengths.
    ///
    /// Parameters
    /// ----------
    /// samples : int, optional
    ///     How many points the circuit has, in equal steps of the input; by default those of the linkage, 360 unless it says otherwise.
    /// trace, circuit : int
    ///     The numbers of the traced joint and of the circuit, from 1.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     A closed curve does not repeat its first point. At a point that a joint does not reach its coordinates are NaN.
    #[pyo3(signature = (samples=None, *, trace=1, circuit=1))]
    fn curve<'py>(
        this: &Bound<'py, Linkage>,
        samples: Option<i64>,
        trace: i64,
        circuit: i64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let py = this.py();
        let solution = &this.get().solution;
        let index = solution.curve_index(trace, circuit)?;
        let Some(samples) = samples else {
            let curve = Linkage::curves(this)?.bind(py).get_item(index)?.cast_into::<Curve>()?;
            return Ok(Curve::points(&curve)?.bind(py).clone());
        };
        let sampler = sampler(Sampling::Samples(checked_samples(natural("samples", samples)?)?));
        let solved = solution.moved()?;
        let curve = &solved.curves[index];
        let own = solved.circuit(curve);
        let (linkage, joint) = solved.linkage.with_one_point(curve.joint);
        let unsampled = motion::UnsampledCircuit { passes: own.passes.clone(), is_closed: own.is_closed };
        let sampled = py.detach(|| sampler.sample_circuit(&linkage, unsampled));
        arrays::points(py, sampled.points(joint), sampled.len())
    }

    /// The curves, one for each traced joint and circuit, in this order.
    #[getter]
    fn curves(this: &Bound<Linkage>) -> PyResult<Py<PyTuple>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let count = own.solution.moved()?.curves.len();
            let curve = |index| Py::new(py, Curve::new(own.solution.clone(), index));
            Ok::<_, PyErr>(PyTuple::new(py, (0..count).map(curve).collect::<PyResult<Vec<_>>>()?)?.unbind())
        };
        Ok(own.curves.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// The circuits: motions of the whole linkage without disassembly, those that start on branch 1 first, then by least input.
    #[getter]
    fn circuits(this: &Bound<Linkage>) -> PyResult<Py<PyTuple>> {
        let (py, own) = (this.py(), this.get());
        let make = || {
            let count = own.solution.moved()?.motion.circuits.len();
            let circuit =
                |index| Py::new(py, Circuit { solution: own.solution.clone(), index, inputs: PyOnceLock::new() });
            Ok::<_, PyErr>(PyTuple::new(py, (0..count).map(circuit).collect::<PyResult<Vec<_>>>()?)?.unbind())
        };
        Ok(own.circuits.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// For each circuit the least and the greatest input, in degrees or units of length, which are its limit positions; None where the input turns
    /// fully.
    #[getter]
    fn limits(&self) -> PyResult<Vec<Option<(f64, f64)>>> {
        Ok(self.solution.moved()?.motion.circuits.iter().map(limits_of).collect())
    }

    /// All measures of a curve by name: numbers, words, and None where a measure does not apply.
    ///
    /// Angles are in degrees and named so (``_deg``), lengths in the unit of the linkage, rates per radian. docs/measures.md defines them.
    /// All are computed once and kept; ``only=["length", "area"]`` takes the time of these alone.
    #[pyo3(signature = (*, trace=1, circuit=1, only=None))]
    fn measures<'py>(
        &self,
        py: Python<'py>,
        trace: i64,
        circuit: i64,
        only: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let index = self.solution.curve_index(trace, circuit)?;
        measures_of(py, &self.solution, index, only)
    }

    /// The same linkage with other values of some parameters, numbers or expressions; the others, the samples and the circuits stay. In a cell of an
    /// atlas what its family derives from them follows.
    #[pyo3(signature = (**parameters))]
    fn replace(&self, py: Python, parameters: Option<Bound<PyDict>>) -> PyResult<Py<PyAny>> {
        into_object(py, self.with_values(given_values(&self.solution.family.template, parameters)?)?)
    }

    /// The Roberts-Chebyshev cognates: the two other four-bars that trace the same curve, where they do.
    ///
    /// Parameters
    /// ----------
    /// trace : int
    ///     The number of the traced joint that is the coupler point, from 1.
    #[pyo3(signature = (*, trace=1))]
    fn cognates(&self, py: Python, trace: i64) -> PyResult<Vec<Py<FourBar>>> {
        let placed = self.solution.placed(trace)?;
        let id = &self.solution.family.id;
        let cognates = Cognates::from_four_bar(placed)
            .map_err(|error| LinkageError::new_err(format!("{id}: {error}; {}", error.help())))?;
        cognates.others.iter().map(|cognate| FourBar::placed(py, &cognate.four_bar)).collect()
    }

    /// The equation of the curve of a coupler point of a four-bar, a polynomial of degree 6.
    ///
    /// Parameters
    /// ----------
    /// trace : int
    ///     The number of the traced joint that is the coupler point, from 1.
    #[pyo3(signature = (*, trace=1))]
    fn sextic(&self, trace: i64) -> PyResult<Sextic> {
        let placed = self.solution.placed(trace)?;
        Sextic::new(placed.lengths, placed.coupler_point).ok_or_else(|| {
            let message = "the traced joint is a pin, which moves on a circle, and so has no sextic";
            LinkageError::new_err(format!("{}: {message}", self.solution.family.id))
        })
    }

    /// A plate of the linkage and its curves, as SVG.
    fn svg(&self, py: Python) -> PyResult<String> {
        self.solution.svg(|_| PoseChoice::Clearest, py)
    }

    /// Write a plate of the linkage and its curves to a file, as SVG.
    fn save(&self, py: Python, path: PathBuf) -> PyResult<()> {
        save_svg(&path, &self.svg(py)?)
    }

    /// The linkage in motion through a circuit, for a notebook or a file.
    #[pyo3(signature = (*, circuit=1))]
    fn animate(&self, py: Python, circuit: i64) -> PyResult<Animation> {
        let circuit = natural("circuit", circuit)?;
        let circuits = self.solution.moved()?.motion.circuits.len();
        if circuits > 0 && !(1..=circuits).contains(&circuit) {
            let message = format!("circuit={circuit}: `{}` has circuits 1 to {circuits}", self.solution.family.id);
            return Err(PyValueError::new_err(message));
        }
        let pose = |solved: &SolvedCell| match circuit.checked_sub(1).and_then(|k| solved.motion.circuits.get(k)) {
            Some(own) => moving_view(&solved.linkage, own, circuit),
            None => PoseChoice::Clearest,
        };
        Ok(Animation { svg: self.solution.svg(pose, py)? })
    }

    /// The plate of a curve as the gallery shows it, for a notebook or a file: the linkage in motion, with sliders for its parameters and handles on
    /// its joints. It needs no network.
    ///
    /// Parameters
    /// ----------
    /// trace, circuit : int
    ///     The numbers of the traced joint and of the circuit, from 1.
    #[pyo3(signature = (*, trace=1, circuit=1))]
    fn explore(&self, py: Python, trace: i64, circuit: i64) -> PyResult<Explorer> {
        let index = self.solution.curve_index(trace, circuit)?;
        let curve = Curve::new(self.solution.clone(), index);
        let planned = planned_family(&self.solution, &curve.toml(py)?)?;
        Ok(Explorer { html: gallery::plate_html(&planned, 1, curve.numbers()?) })
    }

    /// The plate that a notebook shows; nothing if the linkage cannot be assembled.
    fn _repr_svg_(&self, py: Python) -> PyResult<Option<String>> {
        if self.solution.moved()?.motion.is_assembled() { self.svg(py).map(Some) } else { Ok(None) }
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("<coupler_atlas.Linkage {}: {}>", self.solution.family.id, self.described()?))
    }

    /// Whether the other is the same linkage: made from the same parameters, with the same samples and circuits, or the same cell.
    fn __eq__(&self, other: &Bound<PyAny>) -> bool {
        let other = other.cast::<Linkage>();
        other.is_ok_and(|other| Solution::are_same(&self.solution, &other.get().solution))
    }

    fn __hash__(&self) -> u64 {
        self.solution.hash()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Linkage>(py, self.solution.recipe.pickled())
    }
}

/// The family of a linkage in a manifest, from its fragment for one.
fn planned_family(solution: &Solution, fragment: &str) -> PyResult<PlannedFamily> {
    let (Recipe::Linkage { manifest: Some(text), .. } | Recipe::Cell { text, .. }) = &solution.recipe else {
        return family_in(&format!("[atlas]\ntitle = \"linkage\"\n\n{fragment}"));
    };
    let own = manifest::linkage_text(text, &solution.family.template.id).unwrap_or_default();
    family_in(&format!("[atlas]\ntitle = \"linkage\"\n\n{own}\n{fragment}"))
}

fn family_in(text: &str) -> PyResult<PlannedFamily> {
    let outcome = manifest::parse(text);
    let families = outcome.plan.map(|plan| plan.families).unwrap_or_default();
    families.into_iter().next().ok_or_else(|| {
        let problems: Vec<String> = outcome.problems.iter().map(|problem| problem.message.clone()).collect();
        Error::new_err(problems.join("; "))
    })
}
