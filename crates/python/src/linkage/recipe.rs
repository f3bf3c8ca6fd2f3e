//! What a linkage was made from: by that it is compared, and made again from a pickle.

use std::path::PathBuf;
use std::sync::Arc;

use coupler_curves::family::Sampling;
use coupler_curves::motion::MAX_SAMPLES;
use coupler_curves::template::{CircuitSelection, Template};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// What a linkage was made from.
#[derive(Clone, Debug, PartialEq)]
pub enum Recipe {
    /// The arguments of `linkage`.
    Linkage {
        name: String,
        /// The text of the manifest that has it; `None` for one of the catalogue, and for a four-bar at its place.
        manifest: Option<Arc<str>>,
        motion: MotionChoice,
        values: Vec<(String, f64)>,
    },
    /// A cell of an atlas, by the path and the text of its manifest, its family, and its number. If the manifest names tables, the text is that of the
    /// family alone, see [`coupler_atlas::manifest::PlannedFamily::excerpt`], and the values are given that the cell has. The number is 0 of one with
    /// other values than any cell.
    Cell { path: PathBuf, text: Arc<str>, family: String, number: usize, values: Option<Vec<(String, f64)>> },
}

/// What of its motion a linkage has, and how it is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionChoice {
    pub sampling: Sampling,
    /// `start` or `all`; `None` for what the linkage says.
    pub circuits: Option<String>,
    /// The range of the input in degrees, on all circuits, in place of the linkage's own.
    pub range_deg: Option<[f64; 2]>,
}

impl MotionChoice {
    /// As many samples of each circuit as are taken where nothing is said, as in `inspect`.
    pub const DEFAULT: MotionChoice = MotionChoice::samples(360);

    /// So many samples of each circuit.
    pub const fn samples(count: usize) -> MotionChoice {
        MotionChoice { sampling: Sampling::Samples(count), circuits: None, range_deg: None }
    }

    /// A linkage with this motion.
    ///
    /// # Errors
    /// There are too few samples, or too many; the circuits are neither `start` nor `all`.
    pub fn apply(&self, mut template: Arc<Template>) -> PyResult<Arc<Template>> {
        if let Sampling::Samples(samples) = self.sampling {
            checked_samples(samples)?;
        }
        match self.circuits.as_deref() {
            None => {}
            Some("start") => Arc::make_mut(&mut template).circuits = CircuitSelection::Start,
            Some("all") => Arc::make_mut(&mut template).circuits = CircuitSelection::All,
            Some(other) => {
                return Err(PyValueError::new_err(format!("circuits={other:?}: give \"start\" or \"all\"")));
            }
        }
        Ok(self.range_deg.map_or(Arc::clone(&template), |range_deg| Arc::new(template.over(range_deg))))
    }
}

pub(super) fn checked_samples(samples: usize) -> PyResult<usize> {
    match samples {
        2..=MAX_SAMPLES => Ok(samples),
        _ => Err(PyValueError::new_err(format!("samples={samples}: a circuit has from 2 to {MAX_SAMPLES} samples"))),
    }
}

/// A recipe in a pickle.
#[derive(FromPyObject, IntoPyObject)]
pub enum PickledRecipe {
    /// The name, the text of the manifest, the motion and the values.
    Linkage(String, Option<String>, PickledMotion, Vec<(String, f64)>),
    /// The path, the text, the family, the number and the values.
    Cell(PathBuf, String, String, usize, Option<Vec<(String, f64)>>),
}

/// The name and the number of the sampling, the circuits, and the range of the input.
type PickledMotion = (String, f64, Option<String>, Option<[f64; 2]>);

impl Recipe {
    /// It in a pickle.
    pub fn pickled(&self) -> PickledRecipe {
        match self {
            Recipe::Linkage { name, manifest, motion, values } => {
                let MotionChoice { sampling, circuits, range_deg } = motion;
                let (kind, number) = match *sampling {
                    Sampling::Step(step) => ("step", step),
                    Sampling::Samples(count) => ("samples", count as f64),
                    Sampling::DenseAtLimits(count) => ("dense at limits", count as f64),
                    Sampling::ArcLength(count) => ("arc length", count as f64),
                };
                let text = manifest.as_ref().map(|text| text.to_string());
                let motion = (kind.to_owned(), number, circuits.clone(), *range_deg);
                PickledRecipe::Linkage(name.clone(), text, motion, values.clone())
            }
            Recipe::Cell { path, text, family, number, values } => {
                PickledRecipe::Cell(path.clone(), text.to_string(), family.clone(), *number, values.clone())
            }
        }
    }
}
