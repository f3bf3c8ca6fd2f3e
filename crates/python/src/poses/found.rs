//! Linkages that guide a body, as they have been found.

use std::collections::BTreeMap;

use coupler_atlas::find;
use coupler_find::{Guide, PoseSet};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::Error;
use crate::linkage::{DEFAULT_SAMPLES, FourBar, Linkage, into_object};
use crate::results::{Results, Shown, from_json};

/// The linkages found for poses: a sequence of answers, the best first.
#[pyclass(frozen, extends = Results, module = "coupler_atlas")]
pub struct FoundPoses {
    poses: PoseSet,
    /// What of a file was taken.
    read: Option<String>,
    /// The JSON of all that has been found.
    findings: String,
    left_out: BTreeMap<&'static str, usize>,
    /// The arguments without which there are linkages, and the best of these.
    relaxed: Option<(Vec<&'static str>, Py<PoseAnswer>)>,
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
        let answer = |inner| Py::new(py, PoseAnswer { inner, size });
        let left_out = found.findings.left_out.iter().map(|(misfit, count)| (misfit.name(), *count)).collect();
        let answers: Vec<Py<PoseAnswer>> = found.findings.answers.into_iter().map(answer).collect::<PyResult<_>>()?;
        let relaxed = found.relaxed.and_then(|relaxed| {
            let best = relaxed.findings.answers.into_iter().next()?;
            Some((relaxed.options, best))
        });
        let relaxed = relaxed.map(|(options, best)| Ok::<_, PyErr>((options, answer(best)?))).transpose()?;
        let findings = findings.map_err(|error| Error::new_err(error.to_string()))?;
        let results = Results::new(py, &answers, shown)?;
        let own = FoundPoses { poses, read, findings, left_out, relaxed };
        Py::new(py, PyClassInitializer::from(results).add_subclass(own))
    }
}

#[pymethods]
impl FoundPoses {
    /// The poses: an array of shape (n, 3), with angles in degrees.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values = self.poses.poses().iter().flat_map(|pose| [pose.point.x, pose.point.y, pose.angle_deg]).collect();
        arrays::rows(py, values, 3)
    }

    /// The size S of the poses: the root of the mean square of the distances of their points from the centroid.
    #[getter]
    fn size(&self) -> f64 {
        self.poses.size()
    }

    /// What was taken of a file: which columns, in what unit; None of an array.
    #[getter]
    fn read(&self) -> Option<&str> {
        self.read.as_deref()
    }

    /// The dyads that pass five poses, or come near more, as dictionaries: the ``pivot`` and the ``pin`` at the first pose, of which a
    /// slider has no pivot and a slot of the body no pin, but the direction of their lines as ``line_deg``. None where there are infinitely many.
    #[getter]
    fn dyads<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let dyads = from_json(py, &self.findings)?.cast_into::<PyDict>()?.get_item("dyads")?;
        Ok(dyads)
    }

    /// How many pairs of a crank and another dyad were left out, by the reason, as the command names it.
    #[getter]
    fn left_out(&self) -> BTreeMap<&'static str, usize> {
        self.left_out.clone()
    }

    /// Where no linkage is as asked for, the best one without the arguments in `relax`; otherwise None.
    #[getter]
    fn nearest_miss(&self, py: Python) -> Option<Py<PoseAnswer>> {
        self.relaxed.as_ref().map(|(_, answer)| answer.clone_ref(py))
    }

    /// The arguments to relax where no linkage was found; otherwise empty.
    #[getter]
    fn relax(&self) -> Vec<&'static str> {
        self.relaxed.as_ref().map_or(Vec::new(), |(options, _)| options.clone())
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
}

/// A linkage that guides a body through poses, in their unit and axes.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct PoseAnswer {
    inner: coupler_find::PoseAnswer,
    /// The size of the poses.
    size: f64,
}

impl PoseAnswer {
    fn pins<'py>(&self, py: Python<'py>, which: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let pins = &self.inner.pins;
        arrays::points(py, pins.iter().map(|pins| pins[which]), pins.len())
    }
}

#[pymethods]
impl PoseAnswer {
    /// The linkage where it is among the poses: a four-bar, a slider-crank or an inverted one, whose traced joint is the point of the body.
    #[getter]
    fn linkage<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        if let Guide::FourBar(four_bar) = &self.inner.guide {
            return Ok(FourBar::placed(py, four_bar)?.into_bound(py).into_any());
        }
        let guide = &self.inner.guide;
        let values = guide.parameters().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        let text = Some(guide.template_toml().into());
        let linkage = Linkage::of_template(guide.template(), text, values, (DEFAULT_SAMPLES, None))?;
        Ok(into_object(py, linkage)?.into_bound(py))
    }

    /// The crank's pin at each pose: an array of shape (n, 2).
    #[getter]
    fn crank_pins<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.pins(py, 0)
    }

    /// The pin of the rocker, the slider, or the foot of the perpendicular from the block's pivot to the coupler's line, at each pose: an array of shape
    /// (n, 2).
    #[getter]
    fn other_pins<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.pins(py, 1)
    }

    /// The angle of the crank from the x-axis at each pose, in degrees, continuous along the motion.
    #[getter]
    fn inputs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::column(py, self.inner.inputs_deg.clone())
    }

    /// How far the body is from each pose: an array of shape (n, 2), the distance of its point, and the angle in degrees.
    #[getter]
    fn errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let errors = self.inner.errors.iter().flat_map(|error| [error.distance, error.angle_deg]);
        arrays::rows(py, errors.collect(), 2)
    }

    /// E, relative to the size of the poses: the root of the mean square of the errors, angles in radians times S, divided by S.
    #[getter]
    fn deviation(&self) -> f64 {
        self.inner.rms(self.size) / self.size
    }

    /// The number of the circuit at the first pose, from 1.
    #[getter]
    fn circuit(&self) -> usize {
        self.inner.circuit
    }

    /// Whether all poses are on one branch of one circuit.
    #[getter]
    fn one_branch(&self) -> bool {
        self.inner.on_one_branch
    }

    /// Whether the poses are passed in their order.
    #[getter]
    fn in_order(&self) -> bool {
        self.inner.in_order
    }

    /// Whether the crank turns fully.
    #[getter]
    fn full_turn(&self) -> bool {
        self.inner.is_full_turn
    }

    /// The class of a four-bar: ``crank-rocker`` and so on; None for the others.
    #[getter]
    fn class_(&self) -> Option<&'static str> {
        Some(self.inner.class).filter(|class| !class.is_empty())
    }

    /// The worst transmission angle from the first pose to the last, in degrees, 0 to 90.
    #[getter]
    fn mu_worst_poses_deg(&self) -> f64 {
        self.inner.mu_worst_deg[0]
    }

    /// The worst transmission angle over the whole circuit, in degrees, 0 to 90; None where there is none.
    #[getter]
    fn mu_worst_deg(&self) -> Option<f64> {
        Some(self.inner.mu_worst_deg[1]).filter(|angle| angle.is_finite())
    }

    /// The greatest distance of two joints of a link.
    #[getter]
    fn longest_link(&self) -> f64 {
        self.inner.longest_link
    }

    fn _repr_svg_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.linkage(py)?.call_method0("_repr_svg_")
    }

    fn __repr__(&self, py: Python) -> PyResult<String> {
        let linkage = self.linkage(py)?.repr()?;
        let (worst, deviation) = (self.inner.mu_worst_deg[0], self.deviation());
        Ok(format!(
            "<coupler_atlas.PoseAnswer: mu worst {worst:.1}° at the poses, within {deviation:.3e} S: {linkage}>"
        ))
    }
}
