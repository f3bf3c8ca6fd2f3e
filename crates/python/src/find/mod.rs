//! Linkages for a path.

mod found;
mod path;

pub use found::{Answer, Found};

use std::path::PathBuf;
use std::sync::Arc;

use coupler_atlas::find::{
    self, AtlasQuery, MAX_CURVES, ReadOptions, draw_four_bars, find_in_atlas, find_linkage, load_index,
};
use coupler_atlas::manifest;
use coupler_atlas::record::{check_families, manifest_of};
use coupler_curves::expression;
use coupler_curves::geometry::{Bounds, Point};
use coupler_find::{
    Condition, Effort, Index, LinkageSearch, LinkageSpace, Options, Search, Target, answers_manifest, nearest_miss_by,
};
use numpy::{AllowTypeChange, PyArrayLike1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::natural;
use crate::atlas::ManifestArgument;
use crate::error::{LinkageError, OutputError};
use crate::linkage::{into_text, named_template};
use crate::manifest::Manifest;
use crate::task::{self, Task};
use found::Entry;
use path::Path;

/// The greatest `top`.
const MAX_TOP: usize = 100;

fn wrong<T>(message: String) -> PyResult<T> {
    Err(PyValueError::new_err(message))
}

/// What `outline` names.
#[derive(FromPyObject)]
pub enum OutlineName {
    /// A number, from 1.
    Number(i64),
    /// An id.
    Id(String),
}

impl OutlineName {
    fn into_text(self) -> String {
        match self {
            OutlineName::Number(number) => number.to_string(),
            OutlineName::Id(id) => id,
        }
    }
}

/// A linkage whose dimensions are searched.
struct Sought {
    space: LinkageSpace,
    /// Its text, if it is of a manifest.
    own_text: Option<String>,
}

/// Find the linkages whose coupler curves are nearest to a path: four-bars, the linkages of an atlas, or the dimensions of any linkage.
///
/// Parameters
/// ----------
/// path : array, Curve or path
///     The points of the path, an array of shape (n, 2) in any unit; a curve; or a file with a table of points, JSON or a drawing in SVG or DXF.
/// outline : str or int, optional
///     The path to take of a file that has several: its id or, from 1, its number.
/// closed : bool, optional
///     Whether the path is closed; by default it is if the gap between its ends is like the steps beside it.
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
///     How many four-bars to look the path up in; the index of each number is kept in the user's cache folder. With `linkage`, the number of
///     its parameter sets, which are not kept.
/// refine : bool
///     Whether linkages are moved towards the path, or only placed on it.
/// effort : {"quick", "normal", "thorough"}
///     How many linkages are tried.
/// atlas : path or Atlas, optional
///     Look the path up in the curves of an atlas, of any linkages: its manifest, or the folder of a rendered one with the manifest beside
///     it. Four-bars are refined, others only placed on the path.
/// fixed : bool
///     With `atlas`, compare its curves where they are: position, size and rotation count.
/// linkage : str, optional
///     Search the dimensions of a linkage, of the catalogue or of `manifest`, in place of a four-bar.
/// manifest : path, optional
///     A manifest whose linkages `linkage` can name, too.
/// keep : list of str or dict, optional
///     With `linkage`, the parameters that keep their defaults, ``["s"]``, or have values or expressions, ``{"k": 2, "a": "2 * k"}``.
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
///     The path has too few points or no extent, an argument is out of its range, or two do not go together.
/// ManifestError
///     The manifest of `atlas` or `linkage` has errors.
#[pyfunction]
#[pyo3(name = "find", signature = (
    path, *, outline=None, closed=None, part=false, angles=None, timed=false, r#where=None, full_turn=true, max_link=10.0, pivots=None, top=10, index=None,
    refine=true, effort="normal", atlas=None, fixed=false, linkage=None, manifest=None, keep=None, seed=1, progress=None
))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn find_linkages(
    py: Python,
    path: Bound<PyAny>,
    outline: Option<OutlineName>,
    closed: Option<bool>,
    part: bool,
    angles: Option<PyArrayLike1<f64, AllowTypeChange>>,
    timed: bool,
    r#where: Option<&str>,
    full_turn: bool,
    max_link: f64,
    pivots: Option<[f64; 4]>,
    top: i64,
    index: Option<i64>,
    refine: bool,
    effort: &str,
    atlas: Option<ManifestArgument>,
    fixed: bool,
    linkage: Option<&str>,
    manifest: Option<PathBuf>,
    keep: Option<Bound<PyAny>>,
    seed: i64,
    progress: Option<Bound<PyAny>>,
) -> PyResult<Found> {
    let is_timed = timed || angles.is_some();
    let [top, seed] = [natural("top", top)?, natural("seed", seed)?];
    let index = index.map(|index| natural("index", index)).transpose()?;
    let sought = match (&atlas, linkage) {
        (Some(_), Some(_)) => return wrong("atlas and linkage are two ways to search: give one of them".to_owned()),
        (None, _) if fixed => {
            return wrong("fixed=True compares the curves of an atlas where they are: give atlas=…".to_owned());
        }
        (Some(_), None) if is_timed => {
            return wrong("the curves of an atlas are compared by their shape: leave out timed and angles".to_owned());
        }
        (Some(_), None) if index.is_some() => {
            return wrong(
                "index is a number of random four-bars, and the curves of the atlas take their place: leave it out"
                    .to_owned(),
            );
        }
        (_, None) if manifest.is_some() || keep.is_some() => {
            return wrong("manifest and keep are about a linkage: give linkage=…".to_owned());
        }
        (_, None) => None,
        (None, Some(name)) => sought(py, name, manifest, keep, is_timed)?,
    };
    if max_link.is_nan() || max_link <= 0.0 {
        return wrong(format!("max_link={max_link}: give a positive number of sizes of the path, or inf"));
    }
    if !(1..=MAX_TOP).contains(&top) {
        return wrong(format!("top={top}: give a number from 1 to {MAX_TOP}"));
    }
    let most_looked_up = if sought.is_some() { LinkageSearch::MAX_SAMPLES } else { MAX_CURVES };
    if let Some(count) = index.filter(|count| !(1..=most_looked_up).contains(count)) {
        return wrong(format!("index={count}: give a number from 1 to {most_looked_up}"));
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
    // The names of an atlas's linkages are known to the search only.
    let own_condition = r#where.filter(|_| atlas.is_none());
    let condition = own_condition.map(|text| condition(text, sought.as_ref())).transpose()?;
    let options = Options { full_turn, max_link, pivots, condition, effort, refine, seed: seed as u64, most: top };

    let outline = outline.map(OutlineName::into_text);
    let mut path = Path::read(
        py,
        &path,
        &ReadOptions { is_timed: timed, outline: outline.as_deref(), outline_option: "outline=" },
    )?;
    let kind = path.kind(closed, part)?;
    let target = match path.angles(kind, angles, timed)? {
        Some(angles) => Target::timed(&path.outline.points, kind, &angles),
        None => Target::new(&path.outline.points, kind),
    };
    let target = target.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let read = Some(path.outline.reading.taken).filter(|taken| !taken.is_empty());
    let found = match (atlas, sought) {
        (Some(atlas), _) => search_atlas(py, atlas, (path.name, target), (options, r#where, fixed), progress.as_ref()),
        (None, Some(sought)) => search_linkage(py, sought, (path.name, target), options, index, progress.as_ref()),
        (None, None) => search_four_bars(py, (path.name, target), options, index, progress.as_ref()),
    };
    found.map(|found| Found { read, ..found })
}

/// The condition of `where`, on a four-bar or another linkage.
fn condition(text: &str, sought: Option<&Sought>) -> PyResult<Condition> {
    let condition = match sought {
        Some(sought) => Condition::new(sought.space.template(), text),
        None => Condition::new(&coupler_find::Mechanism::template(), text),
    };
    condition.map_err(|error: expression::Error| {
        let help = if error.help.is_empty() { String::new() } else { format!("; {}", error.help) };
        PyValueError::new_err(format!("where={text:?}: {error}{help}"))
    })
}

/// The linkage that the arguments name; `None` for the search of four-bars.
fn sought(
    py: Python,
    name: &str,
    manifest: Option<PathBuf>,
    keep: Option<Bound<PyAny>>,
    is_timed: bool,
) -> PyResult<Option<Sought>> {
    let (template, text) = named_template(py, name, manifest.as_deref())?;
    let kept = keep.as_ref().map(kept_parameters).transpose()?.unwrap_or_default();
    if find::is_free_four_bar(&template, &kept) {
        return Ok(None);
    }
    if is_timed && template.is_driven_by_length() {
        return wrong(format!("the input of `{name}` is a length: leave out timed and angles"));
    }
    let space = LinkageSpace::new(template, &kept).map_err(|errors| {
        let errors: Vec<String> = errors.iter().map(|error| format!("{name}: {error}")).collect();
        LinkageError::new_err(errors.join("\n"))
    })?;
    let own_text = text.and_then(|text| manifest::linkage_text(&text, name));
    Ok(Some(Sought { space, own_text }))
}

/// The parameters that are not searched, each with its value if it has another than its default.
fn kept_parameters(keep: &Bound<PyAny>) -> PyResult<Vec<(String, Option<String>)>> {
    if let Ok(values) = keep.cast::<PyDict>() {
        return values
            .iter()
            .map(|(name, value)| {
                let value = if value.is_none() { None } else { Some(value.str()?.to_string()) };
                Ok((name.extract()?, value))
            })
            .collect();
    }
    // A string is a sequence of its letters.
    let names = keep.extract::<Vec<String>>().ok().filter(|_| keep.extract::<String>().is_err());
    let Some(names) = names else {
        let kind = keep.get_type().name()?;
        let message = format!("keep: give a list of names or a dict of names and values, and not a {kind}");
        return Err(PyTypeError::new_err(message));
    };
    Ok(names.into_iter().map(|name| (name, None)).collect())
}

fn search_four_bars(
    py: Python,
    (name, target): (String, Target),
    options: Options,
    index: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Found> {
    let sought = target.clone();
    let (answers, nearest_miss) = task::run(py, progress, move |task: &Task| {
        task.begin("index", 0);
        let index = load_index(index.unwrap_or(Index::DEFAULT_COUNT));
        task.begin("find", 0);
        let search = |target: &Target, options: &Options| {
            let mut search = Search::new(target, options.clone());
            while !task.is_interrupted() && search.step(&index) {
                task.advance(1);
            }
            // Nobody waits for the answers of an interrupted search.
            if task.is_interrupted() { Vec::new() } else { search.answers() }
        };
        let answers = search(&sought, &options);
        let nearest = |target: &Target, options: &Options| search(target, options).into_iter().next();
        let miss =
            answers.is_empty().then(|| nearest_miss_by(&sought, &options, nearest, |answer| answer.rms)).flatten();
        (answers, miss)
    })?;
    let manifest = answers_manifest(&name, target.size(), &answers);
    let drawing = into_text(draw_four_bars(&name, &target, &answers));
    let entry = |answer| Arc::new(Entry::of_four_bar(answer));
    Ok(Found {
        answers: answers.into_iter().map(entry).collect(),
        nearest_miss: nearest_miss.map(|(constraints, answer)| (constraints, entry(answer))),
        target,
        manifest,
        drawing,
        read: None,
    })
}

fn search_atlas(
    py: Python,
    atlas: ManifestArgument,
    (name, target): (String, Target),
    (options, condition, is_fixed): (Options, Option<&str>, bool),
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Found> {
    let Manifest { plan, .. } = read_atlas(py, atlas)?;
    let condition = condition.map(str::to_owned);
    let (sought, own_plan) = (target.clone(), plan.clone());
    let findings = task::run(py, progress, move |task: &Task| {
        task.begin("find", 0);
        let query = AtlasQuery { options: &options, condition: condition.as_deref(), is_fixed };
        find_in_atlas(&own_plan, &sought, &query, &task.interrupt)
    })?;
    let findings = findings.map_err(|error| PyValueError::new_err(format!("where: {error}")))?;
    let manifest = findings.manifest(&name, &target, &plan);
    let drawing = into_text(findings.drawing(&name, &target, &plan));
    let entry = |answer| Entry::of_atlas(&plan, answer).map(Arc::new);
    Ok(Found {
        answers: findings.answers.into_iter().filter_map(entry).collect(),
        nearest_miss: findings.nearest_miss.and_then(|(constraints, answer)| Some((constraints, entry(answer)?))),
        target,
        manifest,
        drawing,
        read: None,
    })
}

/// The manifest of an atlas, or that beside the folder of a rendered one.
fn read_atlas(py: Python, atlas: ManifestArgument) -> PyResult<Manifest> {
    let folder = match &atlas {
        ManifestArgument::Path(path) if path.is_dir() => path.clone(),
        _ => return atlas.read_for_tables(py),
    };
    let (path, run) = manifest_of(&folder).map_err(|error| OutputError::new_err(error.to_string()))?;
    let manifest = ManifestArgument::Path(path).read_for_tables(py)?;
    check_families(&folder, &manifest.path, &manifest.plan, &run).map_err(OutputError::new_err)?;
    Ok(manifest)
}

fn search_linkage(
    py: Python,
    Sought { space, own_text }: Sought,
    (name, target): (String, Target),
    options: Options,
    samples: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Found> {
    let (sought, own_space) = (target.clone(), space.clone());
    let findings = task::run(py, progress, move |task: &Task| {
        task.begin("find", 0);
        find_linkage(&own_space, &sought, &options, samples, &task.interrupt)
    })?;
    let findings = findings.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let manifest = findings.manifest(&name, &target, own_text.as_deref());
    let drawing = into_text(findings.drawing(&name, &target, &space));
    let entry = |answer| Arc::new(Entry::of_linkage(answer));
    Ok(Found {
        answers: findings.answers.into_iter().map(entry).collect(),
        nearest_miss: findings.nearest_miss.map(|(constraints, answer)| (constraints, entry(answer))),
        target,
        manifest,
        drawing,
        read: None,
    })
}
