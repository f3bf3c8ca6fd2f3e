//! Linkages that guide a body, as they have been found.

use std::collections::BTreeMap;

use coupler_atlas::find;
use coupler_find::{Guide, PoseSet};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::Error;
use crate::linkage::{FourBar, Linkage, MotionChoice, into_object};
use crate::reduce::{Reduced, Remake, reduced};
use crate::results::{Results, ResultsRecord, Shown, from_json};

/// The linkages found for poses: a sequence of answers, the best first.
#[pyclass(frozen, extends = Results, module = "coupler_atlas")]
pub struct FoundPoses(FoundPosesRecord);

/// What is recorded of a search for poses.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct FoundPosesRecord {
    poses: Vec<[f64; 3]>,
    size: f64,
    /// What of a file was taken.
    read: Option<String>,
    /// The JSON of all that has been found.
    findings: String,
    left_out: BTreeMap<String, usize>,
    /// The arguments without which there are linkages, and the best of these.
    relaxed: Option<(Vec<String>, Py<PoseAnswer>)>,
}

impl FoundPoses {
    pub(super) fn make(
        py: Python,
        (poses, read): (PoseSet, Option<String>),
        found: find::FoundPoses,
        findings: serde_json::Result<String>,
        shown: Shown,
    ) -> PyResult<Py<FoundPoses>> {
        let size = poses.size();
        let answer = |inner| Py::new(py, PoseAnswer(PoseAnswerRecord::new(py, inner, size)?));
        let left_out = found.findings.left_out.iter();
        let left_out = left_out.map(|(misfit, count)| (misfit.name().to_owned(), *count)).collect();
        let answers: Vec<Py<PoseAnswer>> = found.findings.answers.into_iter().map(answer).collect::<PyResult<_>>()?;
        let relaxed = found.relaxed.and_then(|relaxed| {
            let best = relaxed.findings.answers.into_iter().next()?;
            Some((relaxed.options.into_iter().map(str::to_owned).collect(), best))
        });
        let relaxed = relaxed.map(|(options, best)| Ok::<_, PyErr>((options, answer(best)?))).transpose()?;
        let findings = findings.map_err(|error| Error::new_err(error.to_string()))?;
        let poses = poses.poses().iter().map(|pose| [pose.point.x, pose.point.y, pose.angle_deg]).collect();
        let record = FoundPosesRecord { poses, size, read, findings, left_out, relaxed };
        FoundPoses::recorded(py, Results::new(py, &answers, shown)?, record)
    }

    fn recorded(py: Python, results: Results, record: FoundPosesRecord) -> PyResult<Py<FoundPoses>> {
        Py::new(py, PyClassInitializer::from(results).add_subclass(FoundPoses(record)))
    }
}

impl Remake for FoundPoses {
    type State = (ResultsRecord, FoundPosesRecord);

    fn remake(py: Python, (results, record): Self::State) -> PyResult<Py<PyAny>> {
        Ok(FoundPoses::recorded(py, Results::recorded(results), record)?.into_any())
    }
}

#[pymethods]
impl FoundPoses {
    /// The poses: an array of shape (n, 3), with angles in degrees.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::rows(py, self.0.poses.as_flattened().to_vec(), 3)
    }

    /// The size S of the poses: the root of the mean square of the distances of their points from the centroid.
    #[getter]
    fn size(&self) -> f64 {
        self.0.size
    }

    /// What was taken of a file: which columns, in what unit; None of an array.
    #[getter]
    fn read(&self) -> Option<&str> {
        self.0.read.as_deref()
    }

    /// The dyads that pass five poses, or come near more, as dictionaries: the ``pivot`` and the ``pin`` at the first pose, of which a
    /// slider has no pivot and a slot of the body no pin, but the direction of their lines as ``line_deg``. None where there are infinitely many.
    #[getter]
    fn dyads<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let dyads = from_json(py, &self.0.findings)?.cast_into::<PyDict>()?.get_item("dyads")?;
        Ok(dyads)
    }

    /// How many pairs of a crank and another dyad were left out, by the reason, as the command names it.
    #[getter]
    fn left_out(&self) -> BTreeMap<String, usize> {
        self.0.left_out.clone()
    }

    /// Where no linkage is as asked for, the best one without the arguments in `relax`; otherwise None.
    #[getter]
    fn nearest_miss(&self, py: Python) -> Option<Py<PoseAnswer>> {
        self.0.relaxed.as_ref().map(|(_, answer)| answer.clone_ref(py))
    }

    /// The arguments to relax where no linkage was found; otherwise empty.
    #[getter]
    fn relax(&self) -> Vec<&str> {
        self.0.relaxed.iter().flat_map(|(options, _)| options.iter().map(String::as_str)).collect()
    }

    fn __repr__(this: &Bound<FoundPoses>) -> String {
        let (py, results) = (this.py(), this.as_super().get());
        let shown = match (results.first::<PoseAnswer>(py), &this.get().relax()[..]) {
            (Some(best), _) => {
                let deviation = best.get().deviation();
                format!("linkages: {}, the best within {deviation:.3e} S", results.count(py))
            }
            (None, []) => "no linkage passes the poses".to_owned(),
            (None, relax) => format!("no linkage; relax {}", relax.join(", ")),
        };
        format!("<coupler_atlas.FoundPoses: {shown}>")
    }

    fn __reduce__<'py>(this: &Bound<'py, FoundPoses>) -> PyResult<Reduced<'py>> {
        reduced::<FoundPoses>(this.py(), (this.as_super().get().record(), &this.get().0))
    }
}

/// A linkage that guides a body through poses, in their unit and axes.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct PoseAnswer(PoseAnswerRecord);

/// What is recorded of an answer for poses.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct PoseAnswerRecord {
    linkage: Py<PyAny>,
    /// Those of the crank, and the others.
    pins: [Vec<[f64; 2]>; 2],
    inputs: Vec<f64>,
    errors: Vec<[f64; 2]>,
    deviation: f64,
    circuit: usize,
    one_branch: bool,
    in_order: bool,
    full_turn: bool,
    class: Option<String>,
    /// From the first pose to the last, and over the whole circuit.
    mu_worst_deg: [f64; 2],
    longest_link: f64,
}

impl PoseAnswerRecord {
    /// An answer for poses of a size.
    fn new(py: Python, answer: coupler_find::PoseAnswer, size: f64) -> PyResult<PoseAnswerRecord> {
        let linkage = match &answer.guide {
            Guide::FourBar(four_bar) => FourBar::placed(py, four_bar)?.into_any(),
            guide => {
                let values = guide.parameters().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
                let text = Some(guide.template_toml().into());
                into_object(py, Linkage::of_template(guide.template(), text, values, MotionChoice::DEFAULT)?)?
            }
        };
        let pins = |which: usize| answer.pins.iter().map(|pins| [pins[which].x, pins[which].y]).collect();
        Ok(PoseAnswerRecord {
            linkage,
            pins: [pins(0), pins(1)],
            errors: answer.errors.iter().map(|error| [error.distance, error.angle_deg]).collect(),
            deviation: answer.rms(size) / size,
            circuit: answer.circuit,
            one_branch: answer.on_one_branch,
            in_order: answer.in_order,
            full_turn: answer.is_full_turn,
            class: Some(answer.class.to_owned()).filter(|class| !class.is_empty()),
            mu_worst_deg: answer.mu_worst_deg,
            longest_link: answer.longest_link,
            inputs: answer.inputs_deg,
        })
    }
}

impl Remake for PoseAnswer {
    type State = PoseAnswerRecord;

    fn remake(py: Python, record: PoseAnswerRecord) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, PoseAnswer(record))?.into_any())
    }
}

#[pymethods]
impl PoseAnswer {
    /// The linkage where it is among the poses: a four-bar, a slider-crank or an inverted one, whose traced joint is the point of the body.
    #[getter]
    fn linkage(&self, py: Python) -> Py<PyAny> {
        self.0.linkage.clone_ref(py)
    }

    /// The crank's pin at each pose: an array of shape (n, 2).
    #[getter]
    fn crank_pins<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::rows(py, self.0.pins[0].as_flattened().to_vec(), 2)
    }

    /// The pin of the rocker, the slider, or the foot of the perpendicular from the block's pivot to the coupler's line, at each pose: an array of shape
    /// (n, 2).
    #[getter]
    fn other_pins<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::rows(py, self.0.pins[1].as_flattened().to_vec(), 2)
    }

    /// The angle of the crank from the x-axis at each pose, in degrees, continuous along the motion.
    #[getter]
    fn inputs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::column(py, self.0.inputs.clone())
    }

    /// How far the body is from each pose: an array of shape (n, 2), the distance of its point, and the angle in degrees.
    #[getter]
    fn errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::rows(py, self.0.errors.as_flattened().to_vec(), 2)
    }

    /// E, relative to the size of the poses: the root of the mean square of the errors, angles in radians times S, divided by S.
    #[getter]
    fn deviation(&self) -> f64 {
        self.0.deviation
    }

    /// The number of the circuit at the first pose, from 1.
    #[getter]
    fn circuit(&self) -> usize {
        self.0.circuit
    }

    /// Whether all poses are on one branch of one circuit.
    #[getter]
    fn one_branch(&self) -> bool {
        self.0.one_branch
    }

    /// Whether the poses are passed in their order.
    #[getter]
    fn in_order(&self) -> bool {
        self.0.in_order
    }

    /// Whether the crank turns fully.
    #[getter]
    fn full_turn(&self) -> bool {
        self.0.full_turn
    }

    /// The class of a four-bar: ``crank-rocker`` and so on; None for the others.
    #[getter]
    fn class_(&self) -> Option<&str> {
        self.0.class.as_deref()
    }

    /// The worst transmission angle from the first pose to the last, in degrees, 0 to 90.
    #[getter]
    fn mu_worst_poses_deg(&self) -> f64 {
        self.0.mu_worst_deg[0]
    }

    /// The worst transmission angle over the whole circuit, in degrees, 0 to 90; None where there is none.
    #[getter]
    fn mu_worst_deg(&self) -> Option<f64> {
        Some(self.0.mu_worst_deg[1]).filter(|angle| angle.is_finite())
    }

    /// The greatest distance of two joints of a link.
    #[getter]
    fn longest_link(&self) -> f64 {
        self.0.longest_link
    }

    fn _repr_svg_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.0.linkage.bind(py).call_method0("_repr_svg_")
    }

    fn __repr__(&self, py: Python) -> PyResult<String> {
        let linkage = self.0.linkage.bind(py).repr()?;
        let (worst, deviation) = (self.0.mu_worst_deg[0], self.deviation());
        Ok(format!(
            "<coupler_atlas.PoseAnswer: mu worst {worst:.1}° at the poses, within {deviation:.3e} S: {linkage}>"
        ))
    }
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<PoseAnswer>(py, &self.0)
    }
}
