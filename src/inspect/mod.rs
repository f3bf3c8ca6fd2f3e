//! What is known of one linkage, as text, as JSON and as a drawing: the answer of the command `inspect`.

mod format;
mod input;

mod cognate_set;
mod equation;
mod pose;
mod ranges;
mod summary;
mod tolerance;

mod inspection;

mod cognates;
mod json;
mod plate;
mod text;

pub use input::parse_input;
pub use inspection::{Inspection, Options};

use coupler_curves::family::Family;
use coupler_curves::solve::Solver;

use tolerance::Tolerance;

impl Inspection {
    /// Inspects the linkage of a family of one cell, to which [`Options::apply`] has given what the options say of it.
    ///
    /// # Errors
    /// There is no linkage with these parameters, or no coupler curve of a four-bar where its equation or cognates are asked for.
    pub fn new(family: Family, options: &Options) -> Result<Inspection, String> {
        let id = &family.id;
        let Some(solved) = Solver::new(&family).solve(0) else {
            return Err(format!("{id}: there is no linkage with these parameters"));
        };
        let equations = equation::coupler_equations(&solved);
        let poses = options.at.map(|at| pose::poses(&solved, at, options.branch)).unwrap_or_default();
        let cognates =
            options.cognates.map(|trace| cognates::find_cognates(&family, &solved, (options.notation, trace)));
        let cognates = cognates.transpose()?;
        if options.sextic && equations.is_empty() {
            let option = options.notation.name("sextic");
            return Err(format!("{id} has no coupler curve of a four-bar, and so no sextic: leave {option} out"));
        }
        let tolerance = solved.linkage.tolerance.and_then(|error| Tolerance::new(&family, &solved, error));
        let (input, has_coefficients) = (options.at, options.sextic);
        Ok(Inspection { family, solved, input, poses, equations, has_coefficients, tolerance, cognates })
    }

    /// Whether the linkage can be assembled at all.
    pub fn is_assembled(&self) -> bool {
        self.solved.motion.is_assembled()
    }

    /// What is known, as text: class, limits, transmission angle and straight portion first, then circuits and what was asked for.
    pub fn text(&self) -> String {
        text::text(self)
    }

    /// What is known, as indented JSON; docs/inspect.md describes it.
    ///
    /// # Errors
    /// None that can occur: the keys are strings.
    pub fn json(&self) -> serde_json::Result<String> {
        json::json(self)
    }

    /// A plate of the linkage as SVG, with its cognates if they were asked for: animated through its first circuit, or in its pose at the requested
    /// input, or in its clearest pose.
    pub fn svg(&self, is_animated: bool) -> Vec<u8> {
        plate::plate(self, is_animated)
    }

    /// A manifest of the four-bar and its cognates, if they were asked for.
    pub fn cognates_manifest(&self) -> Option<String> {
        self.cognates.as_ref().map(|cognate_set| cognates::manifest(self, cognate_set))
    }
}
