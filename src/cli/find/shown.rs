//! What a search has found, in the form that is asked for.

use coupler_curves::family::Family;

use super::super::{Failure, Outcome, files, print, print_bytes, print_stderr};
use super::Arguments;
use super::notes::{self, Best};

/// What a search has found, in the forms in which it is shown.
pub(super) trait Shown {
    /// The path and the curves on one page, as SVG.
    fn drawing(&self) -> Vec<u8>;
    fn json(&self) -> Result<String, Failure>;
    /// A manifest that renders the linkages.
    fn manifest(&self) -> String;
    fn text(&self) -> String;
    /// The best answer, if there is one that notes say something of.
    fn best(&self) -> Option<Best> {
        None
    }
    /// The family of the nearest miss and the index of its cell, if there is one that does not meet the condition.
    fn miss(&self) -> Option<(Family, usize)> {
        None
    }
    /// What to know of the answers, a line each.
    fn notes(&self, arguments: &Arguments) -> String {
        self.best().map_or(String::new(), |best| notes::notes(&best, arguments))
    }
}

/// Writes the drawing that the arguments ask for, and prints what they ask for unless that is the drawing.
pub(super) fn show(report: &impl Shown, arguments: &Arguments, is_drawing_printed: bool) -> Result<Outcome, Failure> {
    let mut notes = report.notes(arguments);
    if let Some(((family, cell), condition)) = report.miss().zip(arguments.condition.as_deref()) {
        notes += &notes::unmet(family, cell, condition);
    }
    if let Some(path) = &arguments.svg {
        files::write(path, &report.drawing())?;
        if is_drawing_printed {
            print_stderr(&notes);
            return Ok(Outcome::Done);
        }
    }
    if !arguments.json && !arguments.toml {
        print(&(report.text() + &notes))?;
        return Ok(Outcome::Done);
    }
    print_bytes(if arguments.json { report.json()? } else { report.manifest() }.as_bytes())?;
    print_stderr(&notes);
    Ok(Outcome::Done)
}
