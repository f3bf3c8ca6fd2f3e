//! A linkage whose dimensions are searched.

use std::path::Path;

use coupler_atlas::find::SearchedLinkage;
use coupler_atlas::manifest;
use pyo3::prelude::*;

use super::templates::named_template;

/// A linkage whose dimensions are searched, with its text if it is of a manifest.
pub struct NamedLinkage {
    pub searched: SearchedLinkage,
    pub own_text: Option<String>,
}

impl NamedLinkage {
    /// The linkage with a name, of a manifest and of the catalogue, of which some parameters are kept.
    ///
    /// # Errors
    /// There is none, or the manifest has errors.
    pub fn find(
        py: Python,
        name: &str,
        manifest: Option<&Path>,
        kept: Vec<(String, Option<String>)>,
    ) -> PyResult<NamedLinkage> {
        let (template, text) = named_template(py, name, manifest)?;
        let own_text = text.and_then(|text| manifest::linkage_text(&text, name));
        Ok(NamedLinkage { searched: SearchedLinkage { template, kept }, own_text })
    }
}
