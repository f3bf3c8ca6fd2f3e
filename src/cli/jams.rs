//! The note on a linkage that jams.

use super::printable;
use crate::format::angle;

/// The worst transmission angle below which a linkage is said to jam, in degrees.
const JAMS_BELOW_DEG: f64 = 10.0;

/// A note that the best answer to a search with a condition jams, if it does, with the condition that leaves such linkages out.
pub(super) fn jams(mu_worst_deg: f64, condition: Option<&str>) -> String {
    // One that is not a number is none.
    if mu_worst_deg >= JAMS_BELOW_DEG || mu_worst_deg.is_nan() {
        return String::new();
    }
    let condition = match condition {
        None => "mu_worst_deg >= 30".to_owned(),
        Some(condition) => format!("({condition}) and mu_worst_deg >= 30"),
    };
    format!(
        "note: the best linkage jams, or nearly so: its worst transmission angle is {}; leave such linkages out: --where \"{}\"\n",
        angle(mu_worst_deg),
        printable(condition)
    )
}
