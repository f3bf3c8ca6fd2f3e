//! What a search has found.

use coupler_atlas::find::AtlasAnswer;
use coupler_atlas::manifest;
use coupler_curves::geometry::{Complex, Point, Similarity};
use coupler_find::{Constraint, Deviation, LinkageAnswer, PlacedCurve, Target};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays;
use crate::linkage::{Curve, FourBar, Linkage, MotionChoice, into_object};
use crate::manifest::Manifest;
use crate::reduce::{Reduced, Remake, reduced};
use crate::results::{Results, ResultsRecord, Shown};

/// The linkages found for a path: a sequence of answers, the nearest first.
#[pyclass(frozen, extends = Results, module = "coupler_atlas")]
pub struct Found(FoundRecord);

/// What is recorded of a search for a path.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct FoundRecord {
    points: Vec<[f64; 2]>,
    size: f64,
    kind: String,
    /// The arguments without which there is a linkage, and the nearest of these.
    nearest_miss: Option<(Vec<String>, Py<Answer>)>,
    /// What of a file was taken.
    read: Option<String>,
}

/// A path that is searched for.
#[derive(Clone)]
pub(super) struct Sought {
    pub name: String,
    pub target: Target,
    /// What of a file was taken, if it is of one.
    pub read: Option<String>,
}

impl Found {
    /// What has been found for a path.
    pub(super) fn make(
        py: Python,
        Sought { target, read, .. }: Sought,
        answers: impl IntoIterator<Item = PyResult<Answer>>,
        nearest_miss: Option<(Vec<Constraint>, PyResult<Answer>)>,
        shown: Shown,
    ) -> PyResult<Py<Found>> {
        let answer = |answer: PyResult<Answer>| Py::new(py, answer?);
        let answers: Vec<Py<Answer>> = answers.into_iter().map(answer).collect::<PyResult<_>>()?;
        let relaxed = |(constraints, miss): (Vec<Constraint>, PyResult<Answer>)| -> PyResult<_> {
            Ok((constraints.iter().map(|constraint| argument_of(constraint).to_owned()).collect(), answer(miss)?))
        };
        let record = FoundRecord {
            points: target.points().iter().map(|point| [point.x, point.y]).collect(),
            size: target.size(),
            kind: target.kind().name().to_owned(),
            nearest_miss: nearest_miss.map(relaxed).transpose()?,
            read,
        };
        Found::recorded(py, Results::new(py, &answers, shown)?, record)
    }

    fn recorded(py: Python, results: Results, record: FoundRecord) -> PyResult<Py<Found>> {
        Py::new(py, PyClassInitializer::from(results).add_subclass(Found(record)))
    }
}

/// The argument of `find` with a constraint.
fn argument_of(constraint: &Constraint) -> &'static str {
    match constraint {
        Constraint::Condition => "where",
        Constraint::Pivots => "pivots",
        Constraint::MaxLink => "max_link",
        Constraint::FullTurn => "full_turn",
        Constraint::Detours => "closed",
    }
}

impl Remake for Found {
    type State = (ResultsRecord, FoundRecord);

    fn remake(py: Python, (results, record): Self::State) -> PyResult<Py<PyAny>> {
        Ok(Found::recorded(py, Results::recorded(results), record)?.into_any())
    }
}

#[pymethods]
impl Found {
    /// The points of the path: an array of shape (n, 2).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::rows(py, self.0.points.as_flattened().to_vec(), 2)
    }

    /// The size S of the path: the root of the mean square of the distances of its points from their centroid.
    #[getter]
    fn size(&self) -> f64 {
        self.0.size
    }

    /// What the curve has in common with the path: ``closed``, ``open`` or ``part``.
    #[getter]
    fn kind(&self) -> &str {
        &self.0.kind
    }

    /// What was taken of a file, which columns, or which outline of how many, in what unit, and why the path is closed or open; None of an
    /// array or a curve.
    #[getter]
    fn read(&self) -> Option<&str> {
        self.0.read.as_deref()
    }

    /// Where no linkage meets the constraints, the nearest one without those in `relax`; otherwise None.
    #[getter]
    fn nearest_miss(&self, py: Python) -> Option<Py<Answer>> {
        self.0.nearest_miss.as_ref().map(|(_, answer)| answer.clone_ref(py))
    }

    /// The arguments to relax where no linkage was found; otherwise empty.
    #[getter]
    fn relax(&self) -> Vec<&str> {
        self.0.nearest_miss.iter().flat_map(|(relax, _)| relax.iter().map(String::as_str)).collect()
    }

    fn __repr__(this: &Bound<Found>) -> String {
        let (py, results) = (this.py(), this.as_super().get());
        match (results.first::<Answer>(py), &this.get().relax()[..]) {
            (Some(best), _) => {
                let count = results.count(py);
                let deviation = best.get().0.rms_relative;
                format!("<coupler_atlas.Found: linkages: {count}, the nearest within {deviation:.3e} S>")
            }
            (None, []) => "<coupler_atlas.Found: no linkage is like the path>".to_owned(),
            (None, relax) => format!("<coupler_atlas.Found: no linkage; relax {}>", relax.join(", ")),
        }
    }

    fn __reduce__<'py>(this: &Bound<'py, Found>) -> PyResult<Reduced<'py>> {
        reduced::<Found>(this.py(), (this.as_super().get().record(), &this.get().0))
    }
}

/// A linkage whose curve is near a path.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Answer(AnswerRecord);

/// What is recorded of an answer.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct AnswerRecord {
    /// A four-bar where it is on the path, or any linkage, which a similarity brings to the path.
    linkage: Py<PyAny>,
    is_mirrored: bool,
    factor: [f64; 2],
    shift: [f64; 2],
    cognates: Vec<Py<FourBar>>,
    rms: f64,
    rms_relative: f64,
    greatest: f64,
    is_in_order: bool,
    length_ratio: f64,
    /// The name of its curve in an atlas.
    name: Option<String>,
    trace: usize,
    circuit: usize,
    /// The inputs at the first and the last point of the path, where they are known.
    inputs: Option<[f64; 2]>,
    class: Option<String>,
    mu_worst_deg: Option<f64>,
}

impl AnswerRecord {
    /// A linkage whose curve, by the numbers of its trace and circuit, a similarity brings to the path.
    fn new(
        linkage: Py<PyAny>,
        Similarity { is_mirrored, factor, shift }: Similarity,
        deviation: &Deviation,
        [trace, circuit]: [usize; 2],
        (class, mu_worst_deg): (&str, f64),
    ) -> AnswerRecord {
        let Deviation { rms, rms_relative, greatest, is_in_order, length_ratio } = *deviation;
        AnswerRecord {
            linkage,
            is_mirrored,
            factor: [factor.re, factor.im],
            shift: [shift.re, shift.im],
            cognates: Vec::new(),
            rms,
            rms_relative,
            greatest,
            is_in_order,
            length_ratio,
            name: None,
            trace,
            circuit,
            inputs: None,
            class: Some(class.to_owned()).filter(|class| !class.is_empty()),
            mu_worst_deg: Some(mu_worst_deg).filter(|angle| angle.is_finite()),
        }
    }

    fn placement(&self) -> Similarity {
        let complex = |[re, im]: [f64; 2]| Complex::new(re, im);
        Similarity { is_mirrored: self.is_mirrored, factor: complex(self.factor), shift: complex(self.shift) }
    }

    fn deviation(&self) -> Deviation {
        let AnswerRecord { rms, rms_relative, greatest, is_in_order, length_ratio, .. } = *self;
        Deviation { rms, rms_relative, greatest, is_in_order, length_ratio }
    }
}

impl Answer {
    pub(super) fn of_four_bar(py: Python, answer: &coupler_find::Answer) -> PyResult<Answer> {
        let coupler_find::Answer { mechanism, cognates, deviation } = answer;
        let linkage = FourBar::placed(py, &mechanism.four_bar)?.into_any();
        let numbers = [1, mechanism.circuit];
        let shown = (mechanism.class, mechanism.mu_worst_deg);
        Ok(Answer(AnswerRecord {
            cognates: cognates.iter().map(|cognate| FourBar::placed(py, &cognate.four_bar)).collect::<PyResult<_>>()?,
            inputs: Some(mechanism.input_deg),
            ..AnswerRecord::new(linkage, Similarity::IDENTITY, deviation, numbers, shown)
        }))
    }

    /// That of an atlas: a four-bar that was refined, or its linkage, placed.
    pub(super) fn of_atlas(py: Python, manifest: &Manifest, answer: AtlasAnswer) -> PyResult<Answer> {
        let values = answer.scaled_values(&manifest.plan);
        let AtlasAnswer { place: [family, _], name, curve, refined } = answer;
        let name = Some(name);
        if let Some(refined) = refined {
            return Ok(Answer(AnswerRecord { name, ..Answer::of_four_bar(py, &refined)?.0 }));
        }
        let own = &manifest.plan.families[family].family;
        let motion = MotionChoice { sampling: own.sampling, ..MotionChoice::DEFAULT };
        let own_text = manifest::linkage_text(&manifest.text, &own.template.id);
        let linkage = Linkage::by_values(own.template.clone(), own_text.map(Into::into), &values, motion)?;
        let mut placement = curve.fit.placement;
        if curve.is_scalable {
            placement.factor /= placement.scale();
        }
        Ok(Answer(AnswerRecord { name, ..Answer::placed(py, linkage, placement, &curve)? }))
    }

    /// That of a linkage whose dimensions were searched, with its text if it is of a manifest.
    pub(super) fn of_linkage(py: Python, answer: LinkageAnswer, own_text: Option<&str>) -> PyResult<Answer> {
        let LinkageAnswer { curve, inputs, family, .. } = answer;
        let motion = MotionChoice { sampling: family.sampling, ..MotionChoice::DEFAULT };
        let own_text = own_text.map(Into::into);
        let linkage = Linkage::by_values(family.template.clone(), own_text, &curve.values, motion)?;
        let record = Answer::placed(py, linkage, curve.fit.placement, &curve)?;
        Ok(Answer(AnswerRecord { inputs: Some(inputs), ..record }))
    }

    fn placed(py: Python, linkage: Linkage, placement: Similarity, curve: &PlacedCurve) -> PyResult<AnswerRecord> {
        let shown = (curve.class, curve.mu_worst_deg);
        let linkage = into_object(py, linkage)?;
        Ok(AnswerRecord::new(linkage, placement, &curve.fit.deviation, curve.numbers, shown))
    }
}

impl Remake for Answer {
    type State = AnswerRecord;

    fn remake(py: Python, record: AnswerRecord) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, Answer(record))?.into_any())
    }
}

#[pymethods]
impl Answer {
    /// The linkage to build: a four-bar where it is on the path; another linkage in its own position, as large as on the path if its
    /// dimensions scale.
    #[getter]
    fn linkage(&self, py: Python) -> Py<PyAny> {
        self.0.linkage.clone_ref(py)
    }

    /// The similarity from the plane of `linkage` to that of the path: an array A of shape (2, 3), with ``A[:, :2] @ p + A[:, 2]`` on the path.
    #[getter]
    fn placement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let Similarity { is_mirrored, factor, shift } = self.0.placement();
        let side = if is_mirrored { -1.0 } else { 1.0 };
        arrays::rows(py, vec![factor.re, -side * factor.im, shift.re, factor.im, side * factor.re, shift.im], 3)
    }

    /// The Roberts-Chebyshev cognates of a four-bar, which trace the same curve; none of other linkages, or if the coupler point is a pin.
    #[getter]
    fn cognates(&self, py: Python) -> Vec<Py<FourBar>> {
        self.0.cognates.iter().map(|cognate| cognate.clone_ref(py)).collect()
    }

    /// The points of its curve on the circuit that follows the path: an array of shape (n, 2), in the unit of the path.
    fn curve<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let AnswerRecord { trace, circuit, .. } = self.0;
        let curves = self.0.linkage.bind(py).getattr("curves")?.cast_into::<PyTuple>()?;
        let placement = self.0.placement();
        let mut points: Vec<Point> = Vec::new();
        for curve in curves {
            let curve = curve.cast_into::<Curve>()?;
            if curve.get().numbers()? == [trace, circuit] {
                points = curve.get().path()?.0;
            }
        }
        let count = points.len();
        arrays::points(py, points.into_iter().map(|point| placement.apply(point)), count)
    }

    /// E, relative to the size of the path: the root of the mean square of the distances of its points from the curve, divided by S.
    #[getter]
    fn deviation(&self) -> f64 {
        self.0.rms_relative
    }

    /// E in the unit of the path.
    #[getter]
    fn rms(&self) -> f64 {
        self.0.rms
    }

    /// The greatest of the distances, in the unit of the path.
    #[getter]
    fn greatest(&self) -> f64 {
        self.0.greatest
    }

    /// How near the curve is, in a word: ``exact``, ``close``, ``fair`` or ``poor``.
    #[getter]
    fn quality(&self) -> &'static str {
        self.0.deviation().quality().name()
    }

    /// Whether the points of the curve that are nearest to those of the path are in their order.
    #[getter]
    fn in_order(&self) -> bool {
        self.0.is_in_order
    }

    /// The length of the curve, or of its part, relative to that of the path.
    #[getter]
    fn length_ratio(&self) -> f64 {
        self.0.length_ratio
    }

    /// The name of its curve in the atlas that was searched, ``family:cell.trace.circuit``; None without an atlas.
    #[getter]
    fn name(&self) -> Option<&str> {
        self.0.name.as_deref()
    }

    /// The number of the traced joint of `linkage`, from 1.
    #[getter]
    fn trace(&self) -> usize {
        self.0.trace
    }

    /// The number of the circuit that follows the path, from 1.
    #[getter]
    fn circuit(&self) -> usize {
        self.0.circuit
    }

    /// The input at the first and at the last point of the path: for a four-bar the angle of the crank from the x-axis, in degrees; for another
    /// linkage its own input, in degrees or units of length; None for one of an atlas that was only placed.
    #[getter]
    fn inputs(&self) -> Option<(f64, f64)> {
        self.0.inputs.map(|[from, to]| (from, to))
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

    fn _repr_svg_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.0.linkage.bind(py).call_method0("_repr_svg_")
    }

    fn __repr__(&self, py: Python) -> PyResult<String> {
        let linkage = self.0.linkage.bind(py).repr()?;
        let class = self.0.class.as_ref().map_or(String::new(), |class| format!("{class}, "));
        Ok(format!("<coupler_atlas.Answer: {class}within {:.3e} S: {linkage}>", self.0.rms_relative))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Answer>(py, &self.0)
    }
}
