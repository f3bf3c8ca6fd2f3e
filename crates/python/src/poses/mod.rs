//! Linkages that guide a body through poses.

mod found;

pub use found::{FoundPoses, PoseAnswer};

use std::path::PathBuf;

use coupler_atlas::find::{
    self, Notation, PoseFindingsRecord, PoseReading, PoseRequest, Request, Searched, draw_poses, read_poses,
};
use coupler_curves::geometry::{Point, trig};
use coupler_find::{BodyPose, Options, PoseSet, poses_manifest};
use numpy::ndarray::ArrayView2;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::file::read_bytes;
use crate::keywords::Unread;
use crate::results::Shown;
use crate::task::{self, Task};

/// Find the four-bars, slider-cranks and inverted slider-cranks whose coupler takes given poses: two to five exactly, more as near as can be.
///
/// Parameters
/// ----------
/// poses : array or path
///     The poses in the order in which they are to be passed, an array of shape (n, 3): the place of a point of the body, in any unit, and the
///     angle of the body, in degrees; or a file with a table of them.
/// radians : bool
///     Whether the angles of the array are in radians. Those of a file are after the name of their column.
/// outline : str or int, optional
///     The table to take of a file that has several: its id or, from 1, its number.
/// where : str, optional
///     A condition, as in ``where`` of a manifest: ``"mu_worst_deg >= 40 and is_crank_rocker"``.
/// full_turn : bool
///     Whether the crank must turn fully.
/// any_order, any_circuit : bool
///     Whether the poses may be passed in another order, or on several circuits or branches.
/// max_link : float
///     The greatest distance of two joints of a link, in sizes S of the poses; may be infinite.
/// pivots : (float, float, float, float), optional
///     The box in which all fixed pivots must be: least x, least y, greatest x, greatest y.
/// pivot : list of (float, float), optional
///     One or two fixed pivots that the linkages must have, of two or three poses.
/// top : int
///     How many linkages to find at most, 1 to 100.
/// effort : {"quick", "normal", "thorough"}
///     How many linkages are tried.
/// seed : int
///     A number that changes which linkages are tried near those that have been found.
/// progress : bool or callable, optional
///     None shows a bar in notebooks and terminals, True always, False never; a function is called with (done, total, name).
///
/// Returns
/// -------
/// FoundPoses
///     The answers, the best transmission angle first; of more than five poses the nearest first.
///
/// Raises
/// ------
/// ValueError
///     Poses are too few, the same or no numbers, or an argument is out of its range.
#[pyfunction]
#[pyo3(
    name = "find_poses",
    signature = (poses, **keywords),
    text_signature = "(poses, *, radians=False, outline=None, where=None, full_turn=True, any_order=False, any_circuit=False, max_link=10.0, \
                      pivots=None, pivot=None, top=10, effort='normal', seed=1, progress=None)"
)]
pub fn find_guides(py: Python, poses: Bound<PyAny>, keywords: Option<&Bound<PyDict>>) -> PyResult<Py<FoundPoses>> {
    let keywords = Unread::new(py, "find_poses", keywords)?;
    let radians = keywords.take("radians")?.unwrap_or(false);
    let outline = keywords.take_outline()?;
    let condition: Option<String> = keywords.take_optional("where")?;
    let progress: Option<Bound<PyAny>> = keywords.take_optional("progress")?;
    let default = Options::default();
    let request = Request {
        notation: Notation::Python,
        searched: Searched::Poses,
        is_timed: false,
        is_fixed: false,
        index: None,
        pivots: keywords.take_optional("pivots")?,
        condition: condition.as_deref(),
        options: Options {
            full_turn: keywords.take("full_turn")?.unwrap_or(default.full_turn),
            max_link: keywords.take("max_link")?.unwrap_or(default.max_link),
            most: keywords.take_whole("top")?.unwrap_or(default.most),
            seed: keywords.take_whole("seed")?.map_or(default.seed, |seed| seed as u64),
            effort: keywords.take_effort()?.unwrap_or(default.effort),
            ..default
        },
    };
    let any_order = keywords.take("any_order")?.unwrap_or(false);
    let any_circuit = keywords.take("any_circuit")?.unwrap_or(false);
    let pivots: Option<Vec<[f64; 2]>> = keywords.take_optional("pivot")?;
    let given_pivots = pivots.unwrap_or_default().into_iter().map(|[x, y]| Point::new(x, y)).collect();
    keywords.finish()?;
    let options = PoseRequest { request, any_order, any_circuit, given_pivots }.check();
    let options = options.map_err(|problems| PyValueError::new_err(problems.join("\n")))?;
    let (name, PoseReading { poses, taken }) = read(py, &poses, radians, outline.as_deref())?;
    find::check_given_pivots(Notation::Python, &poses, &options).map_err(PyValueError::new_err)?;
    let own = poses.clone();
    let found = task::run(py, progress.as_ref(), move |task: &Task| {
        task.begin("find", 0);
        find::find_poses(&own, &options, &task.interrupt)
    })?;
    let found = found.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let record = PoseFindingsRecord::new(&found.findings, &poses);
    let shown = Shown {
        records: serde_json::to_string(&record.results),
        manifest: poses_manifest(&name, &poses, &found.findings.answers),
        drawing: Some(draw_poses(&name, &poses, &found.findings.answers)),
    };
    let read = Some(taken).filter(|taken| !taken.is_empty());
    FoundPoses::make(py, (poses, read), found, serde_json::to_string(&record), shown)
}

/// Poses with their name.
fn read(py: Python, poses: &Bound<PyAny>, radians: bool, outline: Option<&str>) -> PyResult<(String, PoseReading)> {
    let wrong = |message: String| Err(PyValueError::new_err(message));
    if let Some(array) = arrays::real_rows(poses) {
        if let Some(outline) = outline {
            return wrong(format!("outline={outline:?} chooses from the tables in a file: give the path of a file"));
        }
        let poses = poses_of(array.as_array(), radians)?;
        return Ok(("poses".to_owned(), PoseReading { poses, taken: String::new() }));
    }
    let Ok(file) = poses.extract::<PathBuf>() else {
        let kind = arrays::described(poses)?;
        let message = format!("poses: give real numbers of shape (n, 3), or the path of a file, and not {kind}");
        return Err(PyTypeError::new_err(message));
    };
    let shown = file.display().to_string();
    if radians {
        return wrong(format!("{shown}: radians is of arrays: in a file, name the column of the angles angle_rad"));
    }
    let bytes = read_bytes(py, &file)?;
    let reading = read_poses(&bytes, outline).map_err(|problems| {
        let problems: Vec<String> = problems.iter().map(|problem| format!("{shown}: {problem}")).collect();
        PyValueError::new_err(problems.join("\n"))
    })?;
    let name = file.file_name().map_or(shown, |name| name.to_string_lossy().into_owned());
    Ok((name, reading))
}

/// The poses of an array of places and angles.
fn poses_of(array: ArrayView2<f64>, radians: bool) -> PyResult<PoseSet> {
    let [rows, columns] = [array.nrows(), array.ncols()];
    if columns != 3 {
        let message = format!(
            "poses: an array of poses has the shape (n, 3), x, y and the angle of the body, and this one has ({rows}, {columns})"
        );
        return Err(PyValueError::new_err(message));
    }
    let angle_deg = |angle: f64| if radians { trig::degrees(angle) } else { angle };
    let pose = |row: numpy::ndarray::ArrayView1<f64>| BodyPose {
        point: Point::new(row[0], row[1]),
        angle_deg: angle_deg(row[2]),
    };
    let poses: Vec<BodyPose> = array.rows().into_iter().map(pose).collect();
    PoseSet::new(&poses).map_err(|errors| {
        let errors: Vec<String> = errors.iter().map(|error| format!("poses: {error}")).collect();
        PyValueError::new_err(errors.join("\n"))
    })
}
