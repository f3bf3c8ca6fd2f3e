//! Synthesizes linkages for a designer's requirements: any linkage by wishes on its measures ([`by_wishes`]), and straight-line linkages
//! ([`straight_line`]) after chapter 10 of Natesan's thesis.
//!
//! *Type synthesis* (10.1.1) selects linkages by their input. A motor needs a link that turns fully: the crank of
//! Evans's and Hoeken's linkages, or the coupler of Chebyshev's. A rocker drives Watt's, Roberts's and Chebyshev's
//! linkages. *Dimensional synthesis* (10.1.2) finds the proportions: not only by the closed condition, (8.10) or
//! (8.19), but by a sweep over all free proportions, refined by the simplex method. Every quantity is measured as in
//! `cells.csv`.
//!
//! The objective depends on the requirements. If the straight length and the size are both given, the best linkage is
//! the straightest that has this length within this size; otherwise it is the one with the longest straight portion for
//! its size at the tolerance. If a motor drives, size and transmission angle are those of a whole turn; if a rocker
//! drives, those of the straight stroke, since the linkage need not move further.

mod drawing;
mod extent;
mod kind;
mod plate;
mod record;
mod relaxation;
mod request;
mod requirements;
mod result;
mod rounding;
mod scaled_design;
mod search;
mod simplex;
mod stroke;
mod synthesis;
mod trial;
mod wish_request;
mod wishes;

pub use drawing::draw_designs;
pub use kind::{DrivenLinkage, Driver, LinkageKind, P_RANGE};
pub use plate::{ShownDesign, designs_plate};
pub use record::DesignRecord;
pub use request::{WishProblem, check_wishes};
pub use requirements::{Requirement, Requirements, TOLERANCE_RANGE};
pub use result::{RejectedLinkage, Relaxation, SynthesisResult};
pub use scaled_design::{Design, ProportionOrigin};
pub use stroke::InputLink;
pub use trial::Performance;
pub use wish_request::WishRequest;
pub use wishes::{Designs, UNBOUNDED_SIZE, by_wishes, describe, parameters};

use search::Samplers;
use synthesis::synthesize_all;

/// Finds straight-line linkages that meet the requirements, whose [`Requirements::errors`] must be empty.
///
/// The result does not depend on the number of threads.
pub fn straight_line(requirements: &Requirements) -> SynthesisResult {
    let samplers = Samplers::default();
    let (mut found, short) = synthesize_all(requirements, &samplers);
    if found.designs.is_empty() {
        found.relaxations = relaxation::find_relaxations(requirements, &short, &samplers);
    }
    found
}
