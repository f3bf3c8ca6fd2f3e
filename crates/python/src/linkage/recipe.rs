//! What a linkage was made from: by that it is compared, and made again from a pickle, see [`crate::pickle`].

use std::path::PathBuf;
use std::sync::Arc;

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
    /// A linkage that was found and placed, or over a range of its input: it is equal to itself only, and pickled as the manifest that its curves export.
    Found,
}

/// The arguments of `make_linkage_again`.
pub type Arguments = (Option<PathBuf>, Option<String>, String, usize, Option<String>, Option<Vec<(String, f64)>>);

impl Recipe {
    /// The arguments from which `make_linkage_again` makes the same linkage; `None` of one that a search has found.
    pub fn arguments(&self) -> Option<Arguments> {
        match self {
            Recipe::Linkage { name, manifest, samples, circuits, values } => {
                let text = manifest.as_ref().map(|text| text.to_string());
                Some((None, text, name.clone(), *samples, circuits.clone(), Some(values.clone())))
            }
            Recipe::Cell { path, text, family, number, values } => {
                Some((Some(path.clone()), Some(text.to_string()), family.clone(), *number, None, values.clone()))
            }
            Recipe::Found => None,
        }
    }
}
