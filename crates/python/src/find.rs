//! Linkages for a path.

use std::path::PathBuf;
use std::sync::Arc;

use coupler_atlas::find::{MAX_CURVES, MAX_POINTS, load_index, parse_outline};
use coupler_atlas::output;
use coupler_curves::find::{
    self, Condition, Constraint, Effort, Index, Mechanism, Options, PathKind, Search, Target, answers_manifest,
    nearest_miss_by,
};
use coupler_curves::geometry::{Bounds, Point};
use numpy::{AllowTypeChange, PyArrayLike1, PyArrayLike2};
use pyo3::exceptions::{PyIndexError, PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays;
use crate::error::OutputError;
use crate::linkage::{Curve, FourBar};
use crate::task::{self, Task};

/// The greatest `top`.
const MAX_TOP: usize = 100;

/// The linkages found for a path: a sequence of answers, the nearest first.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Found {
    target: Target,
    name: String,
    answers: Vec<Arc<find::Answer>>,
    nearest_miss: Option<(Vec<Constraint>, Arc<find::Answer>)>,
}

#[pymethods]
impl Found {
    /// The points of the path: an array of shape (n, 2).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
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

    /// Where no linkage meets the constraints, the nearest one without those in `relax`; otherwise None.
    #[getter]
    fn nearest_miss(&self) -> Option<Answer> {
        self.nearest_miss.as_ref().map(|(_, answer)| Answer { inner: answer.clone() })
    }

    /// The arguments to relax where no linkage was found; otherwise empty.
    #[getter]
    fn relax(&self) -> Vec<&'static str> {
        let argument = |constraint: &Constraint| match constraint {
            Constraint::Condition => "where",
            Constraint::Pivots => "pivots",
            Constraint::MaxLink => "max_link",
            Constraint::FullTurn => "full_turn",
        };
        self.nearest_miss.iter().flat_map(|(constraints, _)| constraints.iter().map(argument)).collect()
    }

    /// A manifest that renders the linkages, as TOML.
    fn toml(&self) -> String {
        let answers: Vec<find::Answer> = self.answers.iter().map(|answer| (**answer).clone()).collect();
        answers_manifest(&self.name, self.target.size(), &answers)
    }

    fn __len__(&self) -> usize {
        self.answers.len()
    }

    fn __getitem__(&self, index: isize) -> PyResult<Answer> {
        let count = self.answers.len();
        let from_start = if index < 0 { index + count as isize } else { index };
        let found = usize::try_from(from_start).ok().and_then(|index| self.answers.get(index));
        let inner = found
            .ok_or_else(|| PyIndexError::new_err(format!("there is no answer of index {index}: there are {count}")))?;
        Ok(Answer { inner: inner.clone() })
    }

    fn __repr__(&self) -> String {
        match self.answers.first() {
            Some(best) => format!(
                "<coupler_atlas.Found: {} linkages, the nearest within {:.3e} S>",
                self.answers.len(),
                best.rms_relative
            ),
            None => format!("<coupler_atlas.Found: no linkage; relax {}>", self.relax().join(", ")),
        }
    }
}

/// A linkage whose coupler curve is near a path.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Answer {
    inner: Arc<find::Answer>,
}

#[pymethods]
impl Answer {
    /// The four-bar to build, where it is on the path.
    #[getter]
    fn linkage(&self, py: Python) -> PyResult<Py<FourBar>> {
        FourBar::placed(py, &self.inner.mechanism.four_bar)
    }

    /// Its cognates, which trace the same curve; none if the coupler point is a pin.
    #[getter]
    fn cognates(&self, py: Python) -> PyResult<Vec<Py<FourBar>>> {
        self.inner.cognates.iter().map(|mechanism| FourBar::placed(py, &mechanism.four_bar)).collect()
    }

    /// The points of its curve on the circuit that follows the path: an array of shape (n, 2), in the unit of the path.
    fn curve<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let solved = self.inner.mechanism.solved();
        let points: Vec<Point> = solved
            .iter()
            .flat_map(|solved| solved.curves.iter().flat_map(|curve| solved.circuit(curve).points(curve.joint)))
            .collect();
        let count = points.len();
        arrays::points(py, points.into_iter(), count)
    }

    /// E, relative to the size of the path: the root of the mean square of the distances of its points from the curve, divided by S.
    #[getter]
    fn deviation(&self) -> f64 {
        self.inner.rms_relative
    }

    /// E in the unit of the path.
    #[getter]
    fn rms(&self) -> f64 {
        self.inner.rms
    }

    /// The greatest of the distances, in the unit of the path.
    #[getter]
    fn greatest(&self) -> f64 {
        self.inner.greatest
    }

    /// How near the curve is, in a word: ``exact``, ``close``, ``fair`` or ``poor``.
    #[getter]
    fn quality(&self) -> &'static str {
        self.inner.quality().name()
    }

    /// Whether the points of the curve that are nearest to those of the path are in their order.
    #[getter]
    fn in_order(&self) -> bool {
        self.inner.is_in_order
    }

    /// The length of the curve, or of its part, relative to that of the path.
    #[getter]
    fn length_ratio(&self) -> f64 {
        self.inner.length_ratio
    }

    /// The number of the circuit that follows the path, from 1.
    #[getter]
    fn circuit(&self) -> usize {
        self.inner.mechanism.circuit
    }

    /// The angle from the x-axis to the crank at the first and at the last point of the path, in degrees.
    #[getter]
    fn input_deg(&self) -> (f64, f64) {
        let [from, to] = self.inner.mechanism.input_deg;
        (from, to)
    }

    /// The class of the linkage: ``crank-rocker`` and so on.
    #[getter]
    fn class_(&self) -> &'static str {
        self.inner.mechanism.class
    }

    /// The worst transmission angle, in degrees, 0 to 90.
    #[getter]
    fn mu_worst_deg(&self) -> f64 {
        self.inner.mechanism.mu_worst_deg
    }

    fn _repr_svg_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.linkage(py)?.bind(py).call_method0("_repr_svg_")
    }

    fn __repr__(&self) -> String {
        let Mechanism { four_bar, class, .. } = &self.inner.mechanism;
        let lengths = four_bar.lengths;
        format!(
            "<coupler_atlas.Answer: {class}, frame {:.4}, crank {:.4}, coupler {:.4}, rocker {:.4}, within {:.3e} S>",
            lengths.frame, lengths.crank, lengths.coupler, lengths.rocker, self.inner.rms_relative
        )
    }
}

/// A path with the angles of the crank, and whether it is closed as far as it says so itself.
struct Path {
    name: String,
    points: Vec<Point>,
    angles_deg: Option<Vec<f64>>,
    is_closed: bool,
}

fn read_path(py: Python, path: &Bound<PyAny>, is_timed: bool) -> PyResult<Path> {
    if let Ok(curve) = path.cast::<Curve>() {
        let (points, inputs, is_closed) = curve.get().path()?;
        return Ok(Path { name: "curve".to_owned(), points, angles_deg: Some(inputs), is_closed });
    }
    if let Ok(array) = path.extract::<PyArrayLike2<f64, AllowTypeChange>>() {
        let array = array.as_array();
        if array.ncols() != 2 {
            let message =
                format!("path: an array of points has the shape (n, 2), and this one has {:?}", array.shape());
            return Err(PyValueError::new_err(message));
        }
        let points: Vec<Point> = array.rows().into_iter().map(|row| Point::new(row[0], row[1])).collect();
        let outline = coupler_atlas::find::Outline { points, angles_deg: None, is_closed: None };
        let is_closed = outline.looks_closed();
        return Ok(Path { name: "path".to_owned(), points: outline.points, angles_deg: None, is_closed });
    }
    let Ok(file) = path.extract::<PathBuf>() else {
        let kind = path.get_type().name()?;
        return Err(PyTypeError::new_err(format!(
            "path: give an array of points of shape (n, 2), a curve, or the path of a file, and not a {kind}"
        )));
    };
    let name = file.display().to_string();
    let text = py.detach(|| output::read_text(&file)).map_err(|error| OutputError::new_err(error.to_string()))?;
    let outline = parse_outline(&text, is_timed).map_err(|problems| {
        PyValueError::new_err(
            problems.iter().map(|problem| format!("{name}: {problem}")).collect::<Vec<_>>().join("\n"),
        )
    })?;
    let is_closed = outline.is_closed.unwrap_or_else(|| outline.looks_closed());
    Ok(Path { name, points: outline.points, angles_deg: outline.angles_deg, is_closed })
}

/// Find the four-bars whose coupler curves are nearest to a path.
///
/// Parameters
/// ----------
/// path : array, Curve or path
///     The points of the path, an array of shape (n, 2) in any unit; a curve; or a file with a table of points, JSON or a drawing in SVG.
/// closed : bool, optional
///     Whether the path is closed; by default it is if the gap between its ends is at most 1.5 times the median distance of its points.
/// part : bool
///     The path is a part of the curve, and that part is as long as the path.
/// angles : array, optional
///     The angles of the crank at the points, in degrees from any zero and in either direction.
/// timed : bool
///     The crank reaches the points at the angles that the file or curve has or, of a closed path without angles, in equal steps of a turn.
/// where : str, optional
///     A condition, as in ``where`` of a manifest: ``"mu_worst_deg >= 40 and is_crank_rocker"``.
/// full_turn : bool
///     Whether the crank must turn fully.
/// max_link : float
///     The greatest distance of two joints of a link, in sizes S of the path; may be infinite.
/// pivots : (float, float, float, float), optional
///     The box in which both fixed pivots must be: least x, least y, greatest x, greatest y.
/// top : int
///     How many linkages to find at most, 1 to 100.
/// index : int, optional
///     How many four-bars to look the path up in; the index of each number is kept in the user's cache folder.
/// refine : bool
///     Whether linkages are moved towards the path, or only placed on it.
/// effort : {"quick", "normal", "thorough"}
///     How many linkages are tried.
/// seed : int
///     A number that changes which linkages are tried near those that have been found.
/// progress : bool or callable, optional
///     None shows a bar in notebooks and terminals, True always, False never; a function is called with (done, total, name).
///
/// Returns
/// -------
/// Found
///     The answers, the nearest first.
///
/// Raises
/// ------
/// ValueError
///     The path has too few points or no extent, or an argument is out of its range.
#[pyfunction]
#[pyo3(name = "find", signature = (
    path, *, closed=None, part=false, angles=None, timed=false, r#where=None, full_turn=true, max_link=10.0, pivots=None, top=10, index=None,
    refine=true, effort="normal", seed=1, progress=None
))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn find_linkages(
    py: Python,
    path: Bound<PyAny>,
    closed: Option<bool>,
    part: bool,
    angles: Option<PyArrayLike1<f64, AllowTypeChange>>,
    timed: bool,
    r#where: Option<&str>,
    full_turn: bool,
    max_link: f64,
    pivots: Option<[f64; 4]>,
    top: usize,
    index: Option<usize>,
    refine: bool,
    effort: &str,
    seed: u64,
    progress: Option<Bound<PyAny>>,
) -> PyResult<Found> {
    let wrong = |message: String| Err(PyValueError::new_err(message));
    if max_link.is_nan() || max_link <= 0.0 {
        return wrong(format!("max_link={max_link}: give a positive number of sizes of the path, or inf"));
    }
    if !(1..=MAX_TOP).contains(&top) {
        return wrong(format!("top={top}: give a number from 1 to {MAX_TOP}"));
    }
    let count = index.unwrap_or(Index::DEFAULT_COUNT);
    if !(1..=MAX_CURVES).contains(&count) {
        return wrong(format!("index={count}: give a number from 1 to {MAX_CURVES}"));
    }
    let effort = match effort {
        "quick" => Effort::Quick,
        "normal" => Effort::Normal,
        "thorough" => Effort::Thorough,
        other => return wrong(format!("effort={other:?}: give \"quick\", \"normal\" or \"thorough\"")),
    };
    let pivots = match pivots {
        None => None,
        Some([x_min, y_min, x_max, y_max])
            if x_min < x_max && y_min < y_max && [x_min, y_min, x_max, y_max].iter().all(|v| v.is_finite()) =>
        {
            Some(Bounds::from_points([Point::new(x_min, y_min), Point::new(x_max, y_max)]))
        }
        Some(given) => return wrong(format!("pivots={given:?}: give least x, least y, greatest x, greatest y")),
    };
    let condition = r#where.map(Condition::new).transpose().map_err(|error| {
        let help = if error.help.is_empty() { String::new() } else { format!("; {}", error.help) };
        PyValueError::new_err(format!("where={:?}: {error}{help}", r#where.unwrap_or_default()))
    })?;
    let mut read = read_path(py, &path, timed)?;
    if read.points.len() > MAX_POINTS {
        return wrong(format!(
            "the path has {} points, and at most {MAX_POINTS} can be searched for",
            read.points.len()
        ));
    }
    let kind = match closed {
        Some(true) if part => {
            return wrong("closed=True, part=True: a part of a curve is an open path; leave one out".to_owned());
        }
        _ if part => PathKind::Part,
        Some(true) => PathKind::Closed,
        Some(false) => PathKind::Open,
        None if read.is_closed => PathKind::Closed,
        None => PathKind::Open,
    };
    let angles = match (angles, timed) {
        (Some(angles), _) => Some(angles.as_array().iter().copied().collect()),
        (None, false) => None,
        (None, true) => Some(match read.angles_deg {
            Some(angles) => angles,
            None if kind == PathKind::Closed => {
                while read.points.len() > 1 && read.points.first() == read.points.last() {
                    read.points.pop();
                }
                let count = read.points.len();
                (0..count).map(|k| 360.0 * k as f64 / count as f64).collect()
            }
            None => {
                return wrong(
                    "timed=True needs an angle of the crank for each point of an open path: give angles=…".to_owned(),
                );
            }
        }),
    };
    let target = match &angles {
        Some(angles) => Target::timed(&read.points, kind, angles),
        None => Target::new(&read.points, kind),
    };
    let target = target.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let options = Options { full_turn, max_link, pivots, condition, effort, refine, seed, most: top };
    let sought = target.clone();
    let (answers, nearest_miss) = task::run(py, progress.as_ref(), move |task: &Task| {
        task.begin("index", 0);
        let index = load_index(count);
        task.begin("find", 0);
        let search = |options: &Options| {
            let mut search = Search::new(&sought, options.clone());
            while !task.is_interrupted() && search.step(&index) {
                task.advance(1);
            }
            // Nobody waits for the answers of an interrupted search.
            if task.is_interrupted() { Vec::new() } else { search.answers() }
        };
        let answers = search(&options);
        let nearest = |options: &Options| search(options).into_iter().next();
        let miss = answers.is_empty().then(|| nearest_miss_by(&options, nearest, |answer| answer.rms)).flatten();
        (answers, miss)
    })?;
    Ok(Found {
        target,
        name: PathBuf::from(&read.name)
            .file_name()
            .map_or(read.name.clone(), |name| name.to_string_lossy().into_owned()),
        answers: answers.into_iter().map(Arc::new).collect(),
        nearest_miss: nearest_miss.map(|(constraints, answer)| (constraints, Arc::new(answer))),
    })
}
