//! The class of linkages, and what makes them.

use std::sync::Arc;

use coupler_curves::family::Family;
use coupler_curves::problem::suggestion;
use coupler_curves::template::Template;
use coupler_find::Mechanism;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

use super::recipe::{MotionChoice, Recipe};
use super::solution::Solution;
use super::templates::template_of_text;
use crate::error::LinkageError;

/// A linkage with numeric dimensions.
///
/// Lengths are in the unit in which they were given, inputs in degrees (or that unit, of an actuator), rates per radian (or unit) of the
/// input. Arrays are computed once, share their memory, and cannot be written to: copy one to change it. Circuits and traces are numbered
/// from 1, as in tables.
#[pyclass(frozen, subclass, module = "coupler_atlas")]
pub struct Linkage {
    pub(super) solution: Arc<Solution>,
    pub(super) curves: PyOnceLock<Py<PyTuple>>,
    pub(super) circuits: PyOnceLock<Py<PyTuple>>,
}

impl Linkage {
    /// The linkage of a family with a single cell.
    pub fn new(family: Family, source: String, recipe: Recipe) -> Linkage {
        let solution = Arc::new(Solution::new(family, source, recipe));
        Linkage { solution, curves: PyOnceLock::new(), circuits: PyOnceLock::new() }
    }

    /// A linkage by its parameters; `manifest` is the text of the manifest that has it, if it is none of the catalogue.
    pub fn of_template(
        template: Arc<Template>,
        manifest: Option<Arc<str>>,
        values: Vec<(String, f64)>,
        motion: MotionChoice,
    ) -> PyResult<Linkage> {
        // A zero without a sign, so that what is equal has the same hash.
        let values: Vec<(String, f64)> = values.into_iter().map(|(name, value)| (name, value + 0.0)).collect();
        let template = motion.apply(template)?;
        let (source, name) = (template.source_line(), template.id.clone());
        // What messages call a four-bar at its place, which is none of the catalogue.
        let id = if name == Mechanism::template().id { "four-bar" } else { &name };
        let family = Family::single_cell(template, &values, motion.sampling)
            .map_err(|errors| LinkageError::new_err(format!("{id}: {}", errors.to_string().replace('\n', "; "))))?;
        Ok(Linkage::new(family, source, Recipe::Linkage { name, manifest, motion, values }))
    }

    /// The same by the values of all its parameters, in their order.
    pub fn by_values(
        template: Arc<Template>,
        manifest: Option<Arc<str>>,
        values: &[f64],
        motion: MotionChoice,
    ) -> PyResult<Linkage> {
        let names = template.parameters.iter().map(|parameter| parameter.name.clone());
        let values = names.zip(values.iter().copied()).collect();
        Linkage::of_template(template, manifest, values, motion)
    }

    /// Its family, of this linkage only.
    pub fn family(&self) -> &Family {
        &self.solution.family
    }

    /// The linkage at any input, if it was made over a range of it.
    pub fn at_any_input(&self) -> PyResult<coupler_curves::linkage::Linkage> {
        let Solution { family, recipe, .. } = &*self.solution;
        let template = match recipe {
            Recipe::Linkage { name, manifest, .. } => template_of_text(name, manifest.as_deref())?,
            Recipe::Cell { .. } => family.template.clone(),
        };
        template
            .linkage(family.parameter_values(&family.cell(0)))
            .map_err(|error| LinkageError::new_err(error.to_string()))
    }

    /// What it was made from.
    pub fn recipe(&self) -> &Recipe {
        &self.solution.recipe
    }

    /// The same with other values of some of its parameters, or of other names of its family.
    pub(super) fn with_values(&self, given: Vec<(String, f64)>) -> PyResult<Linkage> {
        let Solution { family, source, recipe, .. } = &*self.solution;
        let replaced = |values: &[(String, f64)]| -> Vec<(String, f64)> {
            // In the same order, so that equal linkages are equal.
            let mut values = values.to_vec();
            for (name, value) in &given {
                match values.iter_mut().find(|(own, _)| own == name) {
                    Some(own) => own.1 = *value,
                    None => values.push((name.clone(), *value)),
                }
            }
            values
        };
        let (path, text, own_family) = match recipe {
            Recipe::Linkage { name, manifest, motion, values } => {
                let template = template_of_text(name, manifest.as_deref())?;
                return Linkage::of_template(template, manifest.clone(), replaced(values), motion.clone());
            }
            Recipe::Cell { path, text, family, .. } => (path.clone(), text.clone(), family.clone()),
        };
        let id = &family.id;
        let slot = |name: &str| {
            let known: Vec<&str> = family.names.iter().map(String::as_str).collect();
            known.iter().position(|own| *own == name).ok_or_else(|| {
                LinkageError::new_err(format!("{id}: there is no parameter `{name}`: {}", suggestion(name, &known)))
            })
        };
        let own: Vec<(String, f64)> =
            family.case(0).into_iter().map(|(slot, value)| (family.names[slot].clone(), value)).collect();
        let values = replaced(&own);
        let case = values.iter().map(|(name, value)| Ok((slot(name)?, *value))).collect::<PyResult<_>>()?;
        let changed = family.with_case(case);
        if let Some(error) = changed.cell_errors(&changed.cell(0)).first() {
            return Err(LinkageError::new_err(format!("{id}: {error}")));
        }
        let recipe = Recipe::Cell { path, text, family: own_family, number: 0, values: Some(values) };
        Ok(Linkage::new(changed, source.clone(), recipe))
    }

    /// Its parameters, and why it cannot be assembled if it cannot.
    pub(super) fn described(&self) -> PyResult<String> {
        let family = &self.solution.family;
        let values = family.template.parameters.iter().zip(family.cell(0).values);
        let values: Vec<String> = values.map(|(parameter, value)| format!("{}={value:?}", parameter.name)).collect();
        // What has not been solved is not solved for this.
        let reason = self.solution.known_reason().map_or(String::new(), |reason| format!("; {reason}"));
        Ok(values.join(", ") + &reason)
    }

    pub(super) fn parameter(&self, name: &str) -> Option<f64> {
        let family = &self.solution.family;
        let slot = family.names.iter().position(|known| known == name)?;
        family.cell(0).values.get(slot).copied()
    }
}
