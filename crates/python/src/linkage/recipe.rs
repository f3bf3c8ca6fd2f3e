//! What a linkage was made from: by that it is compared, and made again from a pickle, see [`crate::pickle`].

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// What a linkage was made from.
#[derive(Clone, Debug, PartialEq)]
pub enum Recipe {
    /// The arguments of `linkage`.
    Linkage {
        name: String,
        /// The text of the manifest that has it; `None` for one of the catalogue, and for a four-bar at its place.
        manifest: Option<Arc<str>>,
        samples: usize,
        circuits: Option<String>,
        values: Vec<(String, f64)>,
    },
    /// A cell of an atlas, by the path and the text of its manifest, its family, and its number. If the manifest names tables, the text is that of the
    /// family alone, see [`coupler_atlas::manifest::PlannedFamily::excerpt`], and the values are given that the cell has. The number is 0 of one with
    /// other values than any cell.
    Cell { path: PathBuf, text: Arc<str>, family: String, number: usize, values: Option<Vec<(String, f64)>> },
    /// A linkage that was found and placed, or over a range of its input: it is equal to itself only.
    Found,
}

/// The arguments of `make_linkage_again`.
type Arguments = (Option<PathBuf>, Option<String>, String, usize, Option<String>, Option<Vec<(String, f64)>>);

impl Recipe {
    /// The arguments from which `make_linkage_again` makes the same linkage.
    ///
    /// # Errors
    /// It cannot be made from a few texts.
    pub fn arguments(&self) -> PyResult<Arguments> {
        match self {
            Recipe::Linkage { name, manifest, samples, circuits, values } => {
                let text = manifest.as_ref().map(|text| text.to_string());
                Ok((None, text, name.clone(), *samples, circuits.clone(), Some(values.clone())))
            }
            Recipe::Cell { path, text, family, number, values } => {
                Ok((Some(path.clone()), Some(text.to_string()), family.clone(), *number, None, values.clone()))
            }
            Recipe::Found => Err(PyTypeError::new_err(
                "a linkage that a search has found and placed cannot be pickled: take the cell of its atlas, or keep the manifest that toml() writes",
            )),
        }
    }
}
