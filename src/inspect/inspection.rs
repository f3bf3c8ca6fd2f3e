//! What is known of one linkage.

use std::sync::Arc;

use coupler_curves::family::Family;
use coupler_curves::solve::SolvedCell;
use coupler_curves::template::{CircuitSelection, Template};

use super::cognate_set::CognateSet;
use super::equation::Equation;
use super::pose::Pose;
use super::tolerance::{self, Tolerance};
use crate::notation::Notation;

/// What is asked of a linkage, in addition to what is always said.
#[derive(Clone, Debug)]
pub struct Options {
    /// How messages name options.
    pub notation: Notation,
    /// The input of the poses that are described, finite: in degrees, or a length.
    pub at: Option<f64>,
    /// Only the poses with the first two-valued joint on this side, 1 left or -1 right, of all circuits.
    pub branch: Option<i8>,
    /// A force on a joint, as `"100 on C at -90 deg"`, in place of the linkage's own load.
    pub load: Option<String>,
    /// How far each length may be off, in place of what the linkage says.
    pub tolerance: Option<f64>,
    /// Whether the text has the coefficients of the equations of coupler curves.
    pub sextic: bool,
    /// The number of the traced joint, from 1, whose cognates are found.
    pub cognates: Option<usize>,
}

impl Options {
    /// Nothing in addition.
    pub fn new(notation: Notation) -> Options {
        Options { notation, at: None, branch: None, load: None, tolerance: None, sextic: false, cognates: None }
    }

    /// Gives a linkage what they say of it.
    ///
    /// # Errors
    /// The load is wrong, the tolerance is not positive, or no length of the linkage can be off by itself.
    pub fn apply(&self, template: &mut Arc<Template>) -> Result<(), String> {
        if let Some(text) = &self.load {
            let load = template.parse_load(text);
            let load = load.map_err(|error| format!("{}: {}: {error}", self.notation.name("load"), template.id))?;
            Arc::make_mut(template).load = Some(load);
        }
        if let Some(tolerance) = self.tolerance {
            tolerance::check(template, tolerance, self.notation)?;
            Arc::make_mut(template).tolerance = Some(tolerance);
        }
        if self.branch.is_some() {
            // The other branch may be on another circuit than that of the start.
            Arc::make_mut(template).circuits = CircuitSelection::All;
        }
        Ok(())
    }
}

/// A linkage with what is known of it: its class, limits, transmission angle and straight portion; its circuits, and what was asked for.
pub struct Inspection {
    pub(super) family: Family,
    pub(super) solved: SolvedCell,
    /// The requested input.
    pub(super) input: Option<f64>,
    /// The poses at that input.
    pub(super) poses: Vec<Pose>,
    /// The equations of the coupler curves, and whether to print their coefficients.
    pub(super) equations: Vec<Equation>,
    pub(super) has_coefficients: bool,
    /// The tolerances of its lengths, if requested.
    pub(super) tolerance: Option<Tolerance>,
    /// The cognates, if requested.
    pub(super) cognates: Option<CognateSet>,
}
