//! The dimensions of a linkage by wishes.

mod designs;

pub use designs::{Design, Designs};

use std::path::PathBuf;

use coupler_atlas::design::{DesignRecord, WishRequest, by_wishes, draw_designs};
use coupler_atlas::find::Notation;
use coupler_find::DesignOptions;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::keywords::{Kept, Unread};
use crate::linkage::NamedLinkage;
use crate::results::Shown;
use crate::task::{self, Task};

/// One expression, or some.
#[derive(FromPyObject)]
enum Expressions {
    One(String),
    Several(Vec<String>),
}

/// The range of a parameter.
#[derive(FromPyObject)]
enum Range {
    /// As in `20..60 by 1`.
    Text(String),
    /// From a value to another one, in steps.
    Steps([f64; 3]),
    /// From a value to another one.
    Ends([f64; 2]),
}

/// Find the dimensions of a linkage by wishes on its measures.
///
/// Conditions are met and goals are as great or as small as possible, within the ranges of the parameters. docs/design.md begins from what is
/// wished.
///
/// Parameters
/// ----------
/// linkage : str
///     A linkage of the catalogue, or of `manifest`.
/// where : str, optional
///     Conditions on measures and parameters, joined by ``and``: ``"output_swing_deg == 110 +- 0.5 and mu_worst_deg >= 35"``.
/// maximize, minimize : str or list of str, optional
///     Expressions that are to be as great, or as small, as possible. Of several goals the answers are trade-offs.
/// ranges : dict, optional
///     The ranges of parameters by name, each (least, greatest), (least, greatest, step), or a text as on the command line, ``"20..60 by 1"``.
/// fix : list of str or dict, optional
///     The parameters that keep their defaults, ``["s"]``, or have values or expressions, ``{"p": 100, "a": "2 * p"}``.
/// max_link : float, optional
///     The greatest distance of two joints of a link, in the unit of the lengths; None for any.
/// manifest : path, optional
///     A manifest whose linkages `linkage` can name, too.
/// best : int
///     How many designs to find at most, 1 to 50.
/// effort : {"quick", "normal", "thorough"}
///     How much is tried.
/// seed : int
///     A number that changes which linkages are tried.
/// progress : bool or callable, optional
///     None shows a bar in notebooks and terminals, True always, False never; a function is called with (done, total, name).
///
/// Returns
/// -------
/// Designs
///     The designs, the best first. It is empty where nothing meets the wishes; its `misses` say then what each wish comes to while the others
///     are met.
///
/// Raises
/// ------
/// ValueError
///     A name, a range or an expression is wrong, wishes exclude each other, or nothing is wished.
/// ManifestError
///     The manifest has errors.
#[pyfunction]
#[pyo3(
    name = "design",
    signature = (linkage, **keywords),
    text_signature = "(linkage, *, where=None, maximize=None, minimize=None, ranges=None, fix=None, max_link=None, manifest=None, best=5, \
                      effort='normal', seed=0, progress=None)"
)]
pub fn design_linkage(py: Python, linkage: &str, keywords: Option<&Bound<PyDict>>) -> PyResult<Py<Designs>> {
    let keywords = Unread::new(py, "design", keywords)?;
    let manifest: Option<PathBuf> = keywords.take_optional("manifest")?;
    let progress: Option<Bound<PyAny>> = keywords.take_optional("progress")?;
    let fix = |(name, value): Kept| match value {
        Some(value) => format!("{name} = {value}"),
        None => name,
    };
    let fix = keywords.take_kept("fix")?.into_iter().map(fix).collect();
    let default = DesignOptions::default();
    let options = DesignOptions {
        most: keywords.take_whole("best")?.unwrap_or(default.most),
        effort: keywords.take_effort()?.unwrap_or(default.effort),
        seed: keywords.take_whole("seed")?.map_or(default.seed, |seed| seed as u64),
    };
    let condition = keywords.take_optional("where")?;
    let [maximize, minimize] = [take_expressions(&keywords, "maximize")?, take_expressions(&keywords, "minimize")?];
    let range = take_ranges(&keywords)?;
    let max_link = keywords.take_optional("max_link")?.unwrap_or(f64::INFINITY);
    keywords.finish()?;
    let NamedLinkage { searched, own_text } = NamedLinkage::find(py, linkage, manifest.as_deref(), Vec::new())?;
    let request = WishRequest {
        notation: Notation::Python,
        template: searched.template,
        condition,
        maximize,
        minimize,
        range,
        fix,
        max_link,
        options,
    };
    let (space, wishes) = request.check().map_err(|problems| PyValueError::new_err(problems.join("\n")))?;
    let (own_wishes, options) = (wishes.clone(), request.options.clone());
    let found = task::run(py, progress.as_ref(), move |task: &Task| {
        by_wishes(space, own_wishes, options, &task.interrupt, task.report_parts("design"))
    })?;
    let records: Vec<_> = (1..).zip(&found.answers).map(|(rank, answer)| DesignRecord::new(rank, answer)).collect();
    let shown = Shown {
        records: serde_json::to_string(&records),
        manifest: found.manifest(linkage, own_text.as_deref()),
        drawing: (!found.answers.is_empty()).then(|| draw_designs(linkage, request.in_words(), &found)),
    };
    Designs::make(py, (linkage.to_owned(), own_text), &wishes, found, shown)
}

fn take_expressions(keywords: &Unread, name: &str) -> PyResult<Vec<String>> {
    Ok(match keywords.take_optional::<Bound<PyAny>>(name)?.map(|given| given.extract()) {
        None => Vec::new(),
        Some(Ok(Expressions::One(text))) => vec![text],
        Some(Ok(Expressions::Several(texts))) => texts,
        Some(Err(_)) => {
            return Err(PyTypeError::new_err(format!("{name}: give an expression or a list of expressions")));
        }
    })
}

/// The ranges, as texts.
fn take_ranges(keywords: &Unread) -> PyResult<Vec<String>> {
    let Some(ranges) = keywords.take_optional::<Bound<PyDict>>("ranges")? else { return Ok(Vec::new()) };
    let range = |(name, range): (Bound<PyAny>, Bound<PyAny>)| {
        let name: String = name.extract()?;
        match range.extract() {
            Ok(Range::Text(text)) => Ok(format!("{name} = {text}")),
            Ok(Range::Ends([from, to])) => Ok(format!("{name} = {from}..{to}")),
            Ok(Range::Steps([from, to, step])) => Ok(format!("{name} = {from}..{to} by {step}")),
            Err(_) => {
                let message = "give (least, greatest), (least, greatest, step) or a text like \"20..60 by 1\"";
                Err(PyTypeError::new_err(format!("ranges: {name}: {message}")))
            }
        }
    };
    ranges.iter().map(range).collect()
}
