//! Linkages whose output is a function of their input.

mod found;
mod wanted;

pub use found::{FoundFunction, FunctionAnswer};

use std::path::PathBuf;

use coupler_atlas::find::Notation;
use coupler_atlas::find::function::words::{
    details_in_words, findings_in_words, linkage_details_in_words, none_in_words,
};
use coupler_atlas::find::function::{
    FunctionAttempt, FunctionFit, FunctionLinkage, FunctionRecord, FunctionRequest, FunctionSearch,
    LinkageFunctionRecord, draw_function, draw_linkage_function, find_function, find_function_by, function_manifest,
    linkage_function_manifest,
};
use coupler_find::{FunctionMethod, FunctionOptions, LinkageFunctionOptions, LinkageSpace, Options};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::Error;
use crate::keywords::Unread;
use crate::linkage::NamedLinkage;
use crate::results::Shown;
use crate::task::{self, Task};
use found::Method;
use wanted::Wanted;

/// Find the linkages whose output is a function of their input: four-bars, slider-cranks, or any linkage with an output.
///
/// Parameters
/// ----------
/// function : str, array or path
///     A formula with its ranges, ``"y = log10(x) for x = 1..10 over 60 deg of input and 90 deg of output"``; an array of shape (n, 2) of inputs
///     and outputs, in degrees from any zeros; or a file with a table of them. The output of a slider-crank is a length.
/// radians : bool
///     Whether the angles of the array are in radians. Those of a file are after the names of their columns.
/// linkage : str, optional
///     ``"four-bar"`` or ``"slider-crank"``, which are solved in closed form; or another linkage, of the catalogue or of `manifest`, whose
///     dimensions are searched. By default the one whose output is an angle, or a length, as that of the function is.
/// manifest : path, optional
///     A manifest whose linkages `linkage` can name, too.
/// keep : list of str or dict, optional
///     With `linkage`, the parameters that keep their defaults, ``["s"]``, or have values or expressions, ``{"k": 2, "a": "2 * k"}``.
/// fit : {"points", "least-squares", "minimax"}, optional
///     Exact at precision points, or with the least error everywhere, in the mean square or the greatest; by default points for a formula and
///     tables of few rows, and otherwise least squares.
/// points : int, optional
///     The number of precision points of a formula, 3 to 5, in Chebyshev's spacing; by default the most that have an answer.
/// input_start, output_start : float, optional
///     The input, in degrees from the frame or the slider's line, and the output, in degrees or as a length, at the start.
/// full_turn : bool
///     Whether the crank must turn fully.
/// max_link : float, optional
///     How many times the longest link is as long as the shortest at most; by default 20.
/// where : str, optional
///     A condition, as in ``where`` of a manifest: ``"mu_worst_deg >= 40"``.
/// top : int
///     How many linkages to find at most, 1 to 100.
/// effort : {"quick", "normal", "thorough"}, optional
///     How many linkages are tried, with `linkage`.
/// seed : int, optional
///     A number that changes which linkages are tried, with `linkage`.
/// progress : bool or callable, optional
///     None shows a bar in notebooks and terminals, True always, False never; a function is called with (done, total, name).
///
/// Returns
/// -------
/// FoundFunction
///     The answers, the least error first.
///
/// Raises
/// ------
/// ValueError
///     The function or an argument is wrong, or two do not go together.
/// ManifestError
///     The manifest has errors.
#[pyfunction]
#[pyo3(
    name = "find_function",
    signature = (function, **keywords),
    text_signature = "(function, *, radians=False, linkage=None, manifest=None, keep=None, fit=None, points=None, input_start=None, \
                      output_start=None, full_turn=False, max_link=None, where=None, top=10, effort=None, seed=None, progress=None)"
)]
pub fn find_generators(
    py: Python,
    function: Bound<PyAny>,
    keywords: Option<&Bound<PyDict>>,
) -> PyResult<Py<FoundFunction>> {
    let keywords = Unread::new(py, "find_function", keywords)?;
    let radians = keywords.take("radians")?.unwrap_or(false);
    let name: Option<String> = keywords.take_optional("linkage")?;
    let manifest: Option<PathBuf> = keywords.take_optional("manifest")?;
    let kept = keywords.take_kept("keep")?;
    let condition: Option<String> = keywords.take_optional("where")?;
    let progress: Option<Bound<PyAny>> = keywords.take_optional("progress")?;
    if name.is_none() && !kept.is_empty() {
        return Err(PyValueError::new_err("keep is about a linkage: give linkage=…"));
    }
    let named = name.map(|name| NamedLinkage::find(py, &name, manifest.as_deref(), kept)).transpose()?;
    let (searched, own_text) = named.map(|named| (named.searched, named.own_text)).unzip();
    let linkage = FunctionLinkage::of(searched, manifest.is_some());
    let fits = [
        ("points", FunctionFit::Points),
        ("least-squares", FunctionFit::LeastSquares),
        ("minimax", FunctionFit::Minimax),
    ];
    let (fit, points, top) =
        (keywords.take_choice("fit", &fits)?, keywords.take_optional_whole("points")?, keywords.take_whole("top")?);
    let (effort, seed) = (keywords.take_effort()?, keywords.take_optional_whole("seed")?);
    let starts = [keywords.take_optional("input_start")?, keywords.take_optional("output_start")?];
    let (full_turn, max_link) = (keywords.take("full_turn")?, keywords.take_optional("max_link")?);
    keywords.finish()?;
    let wanted = Wanted::read(py, &function, radians, linkage.is_length())?;
    let request = FunctionRequest {
        notation: Notation::Python,
        target: &wanted.target,
        linkage,
        has_manifest: manifest.is_some(),
        fit,
        points,
        input_start_deg: starts[0],
        output_start: starts[1],
        full_turn: full_turn.unwrap_or(false),
        max_link,
        condition: condition.as_deref(),
        effort,
        seed: seed.map(|seed| seed as u64),
        most: top.unwrap_or(Options::default().most),
    };
    let search = request.check().map_err(|problems| PyValueError::new_err(problems.join("\n")))?;
    let progress = progress.as_ref();
    match search {
        FunctionSearch::Closed(options, methods) => search_closed(py, wanted, options, methods, progress),
        FunctionSearch::Any(space, options) => search_any(py, wanted, (space, own_text.flatten()), options, progress),
    }
}

fn search_closed(
    py: Python,
    wanted: Wanted,
    options: FunctionOptions,
    methods: Vec<FunctionMethod>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Py<FoundFunction>> {
    let (target, kind) = (wanted.target.clone(), options.kind);
    let attempts = task::run(py, progress, move |task: &Task| {
        task.begin("find", 0);
        find_function(&target, &options, &methods, &task.interrupt)
    })?;
    let attempts = attempts.map_err(|error| PyValueError::new_err(error.to_string()))?;
    // There is at least one method.
    let Some(FunctionAttempt { method: tried, findings }) = attempts.into_iter().last() else {
        return Err(Error::new_err("there is no method to try"));
    };
    let method = Method {
        solutions: findings.solutions,
        left_out: match findings.answers.is_empty() {
            true => none_in_words(&findings, Notation::Python),
            false => findings_in_words(&findings, Notation::Python),
        },
        ..Method::of(tried)
    };
    let answers = findings.answers;
    let records: Vec<_> = (1..).zip(&answers).map(|(rank, answer)| FunctionRecord::new(rank, answer)).collect();
    let details = details_in_words(&wanted.target, kind, Some(tried));
    let shown = Shown {
        records: serde_json::to_string(&records),
        manifest: function_manifest(&wanted.name, &answers),
        drawing: Some(draw_function(&wanted.name, &details, &wanted.target, &answers)),
    };
    let is_length = wanted.target.is_length();
    let answers = answers.into_iter().map(|answer| FunctionAnswer::closed(py, answer, is_length));
    FoundFunction::make(py, wanted, method, answers, shown)
}

fn search_any(
    py: Python,
    wanted: Wanted,
    (space, own_text): (LinkageSpace, Option<String>),
    options: LinkageFunctionOptions,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Py<FoundFunction>> {
    let method = Method::of(match options.points {
        Some(count) => FunctionMethod::Points(count),
        None if options.minimax => FunctionMethod::Minimax,
        None => FunctionMethod::LeastSquares,
    });
    let (target, own_space) = (wanted.target.clone(), space.clone());
    let found = task::run(py, progress, move |task: &Task| {
        let report_part = task.report_parts("find");
        find_function_by(&own_space, &target, &options, &task.interrupt, report_part)
    })?;
    let found = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let answers = found.map_err(PyValueError::new_err)?;
    let template = space.template();
    let record = |(rank, answer)| LinkageFunctionRecord::new(rank, answer, template);
    let records: Vec<_> = (1..).zip(&answers).map(record).collect();
    let Wanted { name, target } = &wanted;
    let shown = Shown {
        records: serde_json::to_string(&records),
        manifest: linkage_function_manifest(name, target.is_length(), &template.id, &answers, own_text.as_deref()),
        drawing: Some(draw_linkage_function(name, &linkage_details_in_words(&space), target, &answers)),
    };
    let (is_length, own) = (target.is_length(), (template, own_text.as_deref()));
    let answers: Vec<_> =
        answers.into_iter().map(|answer| FunctionAnswer::followed(py, answer, own, is_length)).collect();
    FoundFunction::make(py, wanted, method, answers.into_iter(), shown)
}
