//! Linkages for a path.

mod found;
mod keywords;
mod path;

pub use found::{Answer, Found};

use coupler_atlas::find::{
    AtlasAnswerRecord, AtlasQuery, LinkageAnswerRecord, ReadOptions, RequestProblem, Several, draw_four_bars,
    find_among, find_in_atlas, find_linkage, load_index,
};
use coupler_atlas::record::{check_families, manifest_of};
use coupler_find::{AnswerRecord, Index, LinkageSpace, Options, Search, Target, answers_manifest, nearest_miss_by};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::atlas::ManifestArgument;
use crate::error::{LinkageError, OutputError};
use crate::manifest::Manifest;
use crate::results::Shown;
use crate::task::{self, Task};
use found::Sought;
use keywords::Keywords;
use path::Path;

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
///     Search the dimensions of a linkage, of the catalogue or of `manifest`, in place of a four-bar; or among several, ``"six-bar"`` or ``"any"``.
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
#[pyo3(
    name = "find",
    signature = (path, **keywords),
    text_signature = "(path, *, outline=None, closed=None, part=False, angles=None, timed=False, where=None, full_turn=True, max_link=10.0, \
                      pivots=None, top=10, index=None, refine=True, effort='normal', atlas=None, fixed=False, linkage=None, manifest=None, \
                      keep=None, seed=1, progress=None)"
)]
pub fn find_linkages(py: Python, path: Bound<PyAny>, keywords: Option<&Bound<PyDict>>) -> PyResult<Py<Found>> {
    let keywords = Keywords::from_dict(py, keywords)?;
    let linkage = keywords.named_linkage(py)?;
    let several = keywords.several();
    let (options, space) = keywords.request(linkage.as_ref()).check().map_err(request_error)?;
    let read_options = ReadOptions {
        is_timed: keywords.timed,
        outline: keywords.outline.as_deref(),
        outline_option: "outline=",
        ..ReadOptions::default()
    };
    let mut path = Path::read(py, &path, &read_options)?;
    let kind = path.kind(keywords.closed, keywords.part)?;
    let target = match path.angles(kind, keywords.angles, keywords.timed)? {
        Some(angles) => Target::timed(&path.outline.points, kind, &angles),
        None => Target::new(&path.outline.points, kind),
    };
    let target = target.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let read = Some(path.outline.reading.taken).filter(|taken| !taken.is_empty());
    let sought = Sought { name: path.name, target, read };
    let progress = keywords.progress.as_ref();
    match (keywords.atlas, space) {
        (Some(atlas), _) => {
            let query = (options, keywords.condition.as_deref(), keywords.fixed);
            search_atlas(py, atlas, sought, query, progress)
        }
        (None, Some(space)) => {
            let own_text = linkage.and_then(|named| named.own_text);
            search_linkage(py, (Linkages::One(space), own_text), sought, options, keywords.index, progress)
        }
        (None, None) => match several {
            Some(several) => {
                search_linkage(py, (Linkages::Several(several), None), sought, options, keywords.index, progress)
            }
            None => search_four_bars(py, sought, options, keywords.index, progress),
        },
    }
}

/// The linkages whose dimensions are searched.
enum Linkages {
    One(LinkageSpace),
    Several(Several),
}

fn request_error(problems: Vec<RequestProblem>) -> PyErr {
    let is_linkage = problems.iter().all(|problem| ["linkage", "keep"].contains(&problem.option));
    let messages: Vec<String> = problems.into_iter().map(|problem| problem.message).collect();
    let message = messages.join("\n");
    if is_linkage { LinkageError::new_err(message) } else { PyValueError::new_err(message) }
}

fn search_four_bars(
    py: Python,
    sought: Sought,
    options: Options,
    index: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Py<Found>> {
    let target = sought.target.clone();
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
        let answers = search(&target, &options);
        let nearest = |target: &Target, options: &Options| search(target, options).into_iter().next();
        let miss = answers
            .is_empty()
            .then(|| nearest_miss_by(&target, &options, nearest, |answer| answer.deviation.rms))
            .flatten();
        (answers, miss)
    })?;
    let records: Vec<_> = (1..).zip(&answers).map(|(rank, answer)| AnswerRecord::new(rank, answer)).collect();
    let shown = Shown {
        records: serde_json::to_string(&records),
        manifest: answers_manifest(&sought.name, sought.target.size(), &answers),
        drawing: Some(draw_four_bars(&sought.name, &sought.target, &answers)),
    };
    let entry = |answer: coupler_find::Answer| Answer::of_four_bar(py, &answer);
    let answers = answers.into_iter().map(entry);
    let nearest_miss = nearest_miss.map(|(constraints, answer)| (constraints, entry(answer)));
    Found::make(py, sought, answers, nearest_miss, shown)
}

fn search_atlas(
    py: Python,
    atlas: ManifestArgument,
    sought: Sought,
    (options, condition, is_fixed): (Options, Option<&str>, bool),
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Py<Found>> {
    let manifest = read_atlas(py, atlas)?;
    let plan = manifest.plan.clone();
    let condition = condition.map(str::to_owned);
    let (target, own_plan) = (sought.target.clone(), plan.clone());
    let findings = task::run(py, progress, move |task: &Task| {
        task.begin("find", 0);
        let query = AtlasQuery { options: &options, condition: condition.as_deref(), is_fixed };
        find_in_atlas(&own_plan, &target, &query, &task.interrupt)
    })?;
    let findings = findings.map_err(|error| PyValueError::new_err(format!("where: {error}")))?;
    let Sought { name, target, .. } = &sought;
    let record = |(rank, answer)| AtlasAnswerRecord::new(rank, answer, &plan);
    let records: Vec<_> = (1..).zip(&findings.answers).map(record).collect();
    let shown = Shown {
        records: serde_json::to_string(&records),
        manifest: findings.manifest(name, target, &plan),
        drawing: Some(findings.drawing(name, target, &plan)),
    };
    let entry = |answer| Answer::of_atlas(py, &manifest, answer);
    let answers = findings.answers.into_iter().map(entry);
    let nearest_miss = findings.nearest_miss.map(|(constraints, answer)| (constraints, entry(answer)));
    Found::make(py, sought, answers, nearest_miss, shown)
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
    (linkages, own_text): (Linkages, Option<String>),
    sought: Sought,
    options: Options,
    index: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Py<Found>> {
    let target = sought.target.clone();
    let linkage = match &linkages {
        Linkages::One(space) => space.template().id.clone(),
        Linkages::Several(several) => several.name().to_owned(),
    };
    let findings = task::run(py, progress, move |task: &Task| {
        let report_part = task.report_parts("find");
        match &linkages {
            Linkages::One(space) => find_linkage(space, &target, &options, index, &task.interrupt, report_part),
            Linkages::Several(several) => find_among(*several, &target, &options, index, &task.interrupt, report_part),
        }
    })?;
    let findings = findings.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let Sought { name, target, .. } = &sought;
    let records: Vec<_> =
        (1..).zip(&findings.answers).map(|(rank, answer)| LinkageAnswerRecord::new(rank, answer)).collect();
    let shown = Shown {
        records: serde_json::to_string(&records),
        manifest: findings.manifest(name, target, own_text.as_deref()),
        drawing: Some(findings.drawing(name, target, &linkage)),
    };
    let entry = |answer| Answer::of_linkage(py, answer, own_text.as_deref());
    let answers = findings.answers.into_iter().map(entry);
    let nearest_miss = findings.nearest_miss.map(|(constraints, answer)| (constraints, entry(answer)));
    Found::make(py, sought, answers, nearest_miss, shown)
}
