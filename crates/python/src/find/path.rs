//! The path of a search.

use std::ffi::CString;
use std::path::PathBuf;

use coupler_atlas::find::{MAX_POINTS, Outline, ReadOptions, parse_outline};
use coupler_curves::geometry::Point;
use coupler_find::PathKind;
use numpy::ndarray::ArrayView2;
use numpy::{AllowTypeChange, PyArrayLike1};
use pyo3::exceptions::{PyTypeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;

use crate::arrays;
use crate::file::read_bytes;
use crate::linkage::Curve;

/// A path with its name, and with the angles of the crank if it has any.
pub(super) struct Path {
    pub name: String,
    pub outline: Outline,
}

impl Path {
    /// Reads a path from an array, a curve or a file.
    ///
    /// # Errors
    /// It is none of these, or a file that cannot be read.
    pub(super) fn read(py: Python, path: &Bound<PyAny>, options: &ReadOptions) -> PyResult<Path> {
        if let Some(outline) = options.outline.filter(|_| path.extract::<PathBuf>().is_err()) {
            let message = format!("outline={outline:?} chooses from the paths in a file: give the path of a file");
            return Err(PyValueError::new_err(message));
        }
        if let Ok(curve) = path.cast::<Curve>() {
            let (points, inputs, is_closed) = curve.get().path()?;
            let outline = Outline::new(points, Some(inputs), Some(is_closed));
            return Ok(Path { name: "curve".to_owned(), outline });
        }
        if let Some(array) = arrays::real_rows(path) {
            return Ok(Path { name: "path".to_owned(), outline: outline_of(array.as_array(), options.is_timed)? });
        }
        let Ok(file) = path.extract::<PathBuf>() else {
            let kind = arrays::described(path)?;
            let message =
                format!("path: give real numbers of shape (n, 2), a curve, or the path of a file, and not {kind}");
            return Err(PyTypeError::new_err(message));
        };
        let shown = file.display().to_string();
        let bytes = read_bytes(py, &file)?;
        let outline = parse_outline(&bytes, options).map_err(|problems| {
            let problems: Vec<String> = problems.iter().map(|problem| format!("{shown}: {problem}")).collect();
            PyValueError::new_err(problems.join("\n"))
        })?;
        if outline.reading.has_unused_angles {
            let message =
                format!("the angles in {shown} are not used: with timed=True each point is reached at its own");
            let message = CString::new(message.replace('\0', " ")).unwrap_or_default();
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), &message, 1)?;
        }
        let name = file.file_name().map_or(shown, |name| name.to_string_lossy().into_owned());
        Ok(Path { name, outline })
    }

    /// What its curve has in common with it, after the arguments `closed` and `part`.
    ///
    /// # Errors
    /// They contradict each other, or it has too many points.
    pub(super) fn kind(&mut self, closed: Option<bool>, part: bool) -> PyResult<PathKind> {
        let outline = &mut self.outline;
        let count = outline.points.len();
        if count > MAX_POINTS {
            let message = format!("the path has {count} points, and at most {MAX_POINTS} can be searched for");
            return Err(PyValueError::new_err(message));
        }
        match closed {
            Some(true) if part => {
                let message = "closed=True, part=True: a part of a curve is an open path; leave one out";
                Err(PyValueError::new_err(message))
            }
            _ if part => Ok(PathKind::Part),
            Some(true) => Ok(PathKind::Closed),
            Some(false) => Ok(PathKind::Open),
            None if outline.decide_closed() => Ok(PathKind::Closed),
            None => Ok(PathKind::Open),
        }
    }

    /// The angles of the crank at its points, after the arguments `angles` and `timed`.
    ///
    /// # Errors
    /// It is open and timed, and has none.
    pub(super) fn angles(
        &mut self,
        kind: PathKind,
        angles: Option<PyArrayLike1<f64, AllowTypeChange>>,
        timed: bool,
    ) -> PyResult<Option<Vec<f64>>> {
        match angles {
            Some(angles) => Ok(Some(angles.as_array().iter().copied().collect())),
            None if timed => self.outline.take_timing(kind).map(Some).ok_or_else(|| {
                let message = "timed=True needs an angle of the crank for each point of an open path: give angles=…";
                PyValueError::new_err(message)
            }),
            None => Ok(None),
        }
    }
}

/// The path of an array of points, and of the angles of the crank if it has them as a third column.
fn outline_of(array: ArrayView2<f64>, is_timed: bool) -> PyResult<Outline> {
    let columns = array.ncols();
    if columns != 2 && !(columns == 3 && is_timed) {
        let [rows, columns] = [array.nrows(), columns];
        let message = format!(
            "path: an array of points has the shape (n, 2), or (n, 3) with angles and timed=True, and this one has ({rows}, {columns})"
        );
        return Err(PyValueError::new_err(message));
    }
    let points: Vec<Point> = array.rows().into_iter().map(|row| Point::new(row[0], row[1])).collect();
    let angles_deg = (columns == 3).then(|| array.column(2).to_vec());
    Ok(Outline::new(points, angles_deg, None))
}
