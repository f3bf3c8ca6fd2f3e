//! What a search has found.

use coupler_atlas::find::AtlasAnswer;
use coupler_atlas::manifest::Plan;
use coupler_curves::family::Family;
use coupler_curves::geometry::Point;
use coupler_curves::geometry::Similarity;
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_find::{Constraint, Deviation, LinkageAnswer, PlacedCurve, Target};
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::arrays;
use crate::linkage::{FourBar, Linkage, Recipe, into_object};
use crate::results::{Results, Shown};

/// The linkages found for a path: a sequence of answers, the nearest first.
#[pyclass(frozen, extends = Results, module = "coupler_atlas")]
pub struct Found {
    target: Target,
    nearest_miss: Option<(Vec<Constraint>, Py<Answer>)>,
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
        answers: impl IntoIterator<Item = Entry>,
        nearest_miss: Option<(Vec<Constraint>, Entry)>,
        shown: Shown,
    ) -> PyResult<Py<Found>> {
        let answer = |entry| Py::new(py, Answer(entry));
        let answers: Vec<Py<Answer>> = answers.into_iter().map(answer).collect::<PyResult<_>>()?;
        let nearest_miss = match nearest_miss {
            Some((constraints, entry)) => Some((constraints, answer(entry)?)),
            None => None,
        };
        let results = Results::new(py, &answers, shown)?;
        Py::new(py, PyClassInitializer::from(results).add_subclass(Found { target, nearest_miss, read }))
    }
}

#[pymethods]
impl Found {
    /// The points of the path: an array of shape (n, 2).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::points(py, self.target.points().iter().copied(), self.target.points().len())
    }

    /// The size S of the path: the root of the mean square of the distances of its points from their centroid.
    #[getter]
    fn size(&self) -> f64 {
        self.target.size()
    }

    /// What the curve has in common with the path: ``closed``, ``open`` or ``part``.
    #[getter]
    fn kind(&self) -> &'static str {
        self.target.kind().name()
    }

    /// What was taken of a file, which columns, or which outline of how many, in what unit, and why the path is closed or open; None of an
    /// array or a curve.
    #[getter]
    fn read(&self) -> Option<&str> {
        self.read.as_deref()
    }

    /// Where no linkage meets the constraints, the nearest one without those in `relax`; otherwise None.
    #[getter]
    fn nearest_miss(&self, py: Python) -> Option<Py<Answer>> {
        self.nearest_miss.as_ref().map(|(_, answer)| answer.clone_ref(py))
    }

    /// The arguments to relax where no linkage was found; otherwise empty.
    #[getter]
    fn relax(&self) -> Vec<&'static str> {
        let argument = |constraint: &Constraint| match constraint {
            Constraint::Condition => "where",
            Constraint::Pivots => "pivots",
            Constraint::MaxLink => "max_link",
            Constraint::FullTurn => "full_turn",
            Constraint::Detours => "closed",
        };
        self.nearest_miss.iter().flat_map(|(constraints, _)| constraints.iter().map(argument)).collect()
    }

    fn __repr__(this: &Bound<Found>) -> String {
        let (py, results) = (this.py(), this.as_super().get());
        match (results.first::<Answer>(py), &this.get().relax()[..]) {
            (Some(best), _) => {
                let count = results.count(py);
                let deviation = best.get().0.deviation().rms_relative;
                format!("<coupler_atlas.Found: linkages: {count}, the nearest within {deviation:.3e} S>")
            }
            (None, []) => "<coupler_atlas.Found: no linkage is like the path>".to_owned(),
            (None, relax) => format!("<coupler_atlas.Found: no linkage; relax {}>", relax.join(", ")),
        }
    }
}

/// A linkage whose curve is near a path.
pub(super) struct Entry {
    /// The name of its curve in an atlas.
    name: Option<String>,
    mechanism: Mechanism,
}

enum Mechanism {
    /// A four-bar where it is on the path.
    FourBar(Box<coupler_find::Answer>),
    /// Any linkage, which a similarity brings to the path.
    Placed(Box<Placed>),
}

struct Placed {
    /// Of the linkage only, as large as on the path if its dimensions scale.
    family: Family,
    /// From the plane of the family to that of the path.
    placement: Similarity,
    curve: PlacedCurve,
    /// The inputs at the first and the last point of the path, where they are known.
    inputs: Option<[f64; 2]>,
}

impl Entry {
    pub(super) fn of_four_bar(answer: coupler_find::Answer) -> Entry {
        Entry { name: None, mechanism: Mechanism::FourBar(Box::new(answer)) }
    }

    /// None if the cell has no linkage by itself, which does not happen.
    pub(super) fn of_atlas(plan: &Plan, answer: AtlasAnswer) -> Option<Entry> {
        let values = answer.scaled_values(plan);
        let AtlasAnswer { place: [family, _], name, curve, refined } = answer;
        if let Some(refined) = refined {
            return Some(Entry { name: Some(name), mechanism: Mechanism::FourBar(Box::new(refined)) });
        }
        let own = &plan.families[family].family;
        let names = own.template.parameters.iter().map(|parameter| parameter.name.clone());
        let values: Vec<(String, f64)> = names.zip(values).collect();
        let family = Family::single_cell(own.template.clone(), &values, own.sampling).ok()?;
        let mut placement = curve.fit.placement;
        if curve.is_scalable {
            placement.factor /= placement.scale();
        }
        Some(Entry {
            name: Some(name),
            mechanism: Mechanism::Placed(Box::new(Placed { family, placement, curve, inputs: None })),
        })
    }

    pub(super) fn of_linkage(LinkageAnswer { curve, inputs, family, .. }: LinkageAnswer) -> Entry {
        let placed = Placed { family, placement: curve.fit.placement, curve, inputs: Some(inputs) };
        Entry { name: None, mechanism: Mechanism::Placed(Box::new(placed)) }
    }

    fn deviation(&self) -> &Deviation {
        match &self.mechanism {
            Mechanism::FourBar(answer) => &answer.deviation,
            Mechanism::Placed(placed) => &placed.curve.fit.deviation,
        }
    }

    fn class(&self) -> Option<&'static str> {
        let class = match &self.mechanism {
            Mechanism::FourBar(answer) => answer.mechanism.class,
            Mechanism::Placed(placed) => placed.curve.class,
        };
        Some(class).filter(|class| !class.is_empty())
    }

    /// The linkage, solved without measures.
    fn solved(&self) -> Option<SolvedCell> {
        match &self.mechanism {
            Mechanism::FourBar(answer) => answer.mechanism.solved(),
            Mechanism::Placed(placed) => Solver::new(&placed.family).measuring(MeasureSet::EMPTY).solve(0),
        }
    }
}

/// A linkage whose curve is near a path.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Answer(Entry);

#[pymethods]
impl Answer {
    /// The linkage to build: a four-bar where it is on the path; another linkage in its own position, as large as on the path if its
    /// dimensions scale.
    #[getter]
    fn linkage<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match &self.0.mechanism {
            Mechanism::FourBar(answer) => {
                Ok(FourBar::placed(py, &answer.mechanism.four_bar)?.into_bound(py).into_any())
            }
            Mechanism::Placed(placed) => {
                let family = placed.family.clone();
                let source = family.template.source_line();
                Ok(into_object(py, Linkage::new(family, source, Recipe::Found))?.into_bound(py))
            }
        }
    }

    /// The similarity from the plane of `linkage` to that of the path: an array A of shape (2, 3), with ``A[:, :2] @ p + A[:, 2]`` on the path.
    #[getter]
    fn placement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let Similarity { is_mirrored, factor, shift } = match &self.0.mechanism {
            Mechanism::FourBar(_) => Similarity::IDENTITY,
            Mechanism::Placed(placed) => placed.placement,
        };
        let side = if is_mirrored { -1.0 } else { 1.0 };
        arrays::rows(py, vec![factor.re, -side * factor.im, shift.re, factor.im, side * factor.re, shift.im], 3)
    }

    /// The Roberts-Chebyshev cognates of a four-bar, which trace the same curve; none of other linkages, or if the coupler point is a pin.
    #[getter]
    fn cognates(&self, py: Python) -> PyResult<Vec<Py<FourBar>>> {
        match &self.0.mechanism {
            Mechanism::FourBar(answer) => {
                answer.cognates.iter().map(|mechanism| FourBar::placed(py, &mechanism.four_bar)).collect()
            }
            Mechanism::Placed(_) => Ok(Vec::new()),
        }
    }

    /// The points of its curve on the circuit that follows the path: an array of shape (n, 2), in the unit of the path.
    fn curve<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (numbers, placement) = match &self.0.mechanism {
            Mechanism::FourBar(_) => (None, Similarity::IDENTITY),
            Mechanism::Placed(placed) => (Some(placed.curve.numbers), placed.placement),
        };
        let solved = py.detach(|| self.0.solved());
        let is_own = |trace, circuit| numbers.is_none_or(|numbers| numbers == [trace, circuit]);
        let points: Vec<Point> = solved
            .iter()
            .flat_map(|solved| solved.curves.iter().map(move |curve| (solved, curve)))
            .filter(|(_, curve)| is_own(curve.trace, curve.circuit))
            .flat_map(|(solved, curve)| solved.circuit(curve).points(curve.joint))
            .map(|point| placement.apply(point))
            .collect();
        let count = points.len();
        arrays::points(py, points.into_iter(), count)
    }

    /// E, relative to the size of the path: the root of the mean square of the distances of its points from the curve, divided by S.
    #[getter]
    fn deviation(&self) -> f64 {
        self.0.deviation().rms_relative
    }

    /// E in the unit of the path.
    #[getter]
    fn rms(&self) -> f64 {
        self.0.deviation().rms
    }

    /// The greatest of the distances, in the unit of the path.
    #[getter]
    fn greatest(&self) -> f64 {
        self.0.deviation().greatest
    }

    /// How near the curve is, in a word: ``exact``, ``close``, ``fair`` or ``poor``.
    #[getter]
    fn quality(&self) -> &'static str {
        self.0.deviation().quality().name()
    }

    /// Whether the points of the curve that are nearest to those of the path are in their order.
    #[getter]
    fn in_order(&self) -> bool {
        self.0.deviation().is_in_order
    }

    /// The length of the curve, or of its part, relative to that of the path.
    #[getter]
    fn length_ratio(&self) -> f64 {
        self.0.deviation().length_ratio
    }

    /// The name of its curve in the atlas that was searched, ``family:cell.trace.circuit``; None without an atlas.
    #[getter]
    fn name(&self) -> Option<&str> {
        self.0.name.as_deref()
    }

    /// The number of the traced joint of `linkage`, from 1.
    #[getter]
    fn trace(&self) -> usize {
        match &self.0.mechanism {
            Mechanism::FourBar(_) => 1,
            Mechanism::Placed(placed) => placed.curve.numbers[0],
        }
    }

    /// The number of the circuit that follows the path, from 1.
    #[getter]
    fn circuit(&self) -> usize {
        match &self.0.mechanism {
            Mechanism::FourBar(answer) => answer.mechanism.circuit,
            Mechanism::Placed(placed) => placed.curve.numbers[1],
        }
    }

    /// The input at the first and at the last point of the path: for a four-bar the angle of the crank from the x-axis, in degrees; for another
    /// linkage its own input, in degrees or units of length; None for one of an atlas that was only placed.
    #[getter]
    fn inputs(&self) -> Option<(f64, f64)> {
        let inputs = match &self.0.mechanism {
            Mechanism::FourBar(answer) => Some(answer.mechanism.input_deg),
            Mechanism::Placed(placed) => placed.inputs,
        };
        inputs.map(|[from, to]| (from, to))
    }

    /// The class of a four-bar: ``crank-rocker`` and so on; None for other linkages.
    #[getter]
    fn class_(&self) -> Option<&'static str> {
        self.0.class()
    }

    /// The worst transmission angle, in degrees, 0 to 90; None where there is none.
    #[getter]
    fn mu_worst_deg(&self) -> Option<f64> {
        let angle = match &self.0.mechanism {
            Mechanism::FourBar(answer) => answer.mechanism.mu_worst_deg,
            Mechanism::Placed(placed) => placed.curve.mu_worst_deg,
        };
        Some(angle).filter(|angle| angle.is_finite())
    }

    fn _repr_svg_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.linkage(py)?.call_method0("_repr_svg_")
    }

    fn __repr__(&self, py: Python) -> PyResult<String> {
        let linkage = self.linkage(py)?.repr()?;
        let class = self.0.class().map_or(String::new(), |class| format!("{class}, "));
        Ok(format!("<coupler_atlas.Answer: {class}within {:.3e} S: {linkage}>", self.0.deviation().rms_relative))
    }
}
