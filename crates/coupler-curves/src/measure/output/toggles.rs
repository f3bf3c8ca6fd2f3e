//! Toggle positions.

use super::motion::OutputMotion;
use super::output_value;
use crate::measure::{Measure, Subject};
use crate::motion::JointDerivatives;

/// The measure `toggles`.
pub const TOGGLES: Measure = Measure::number(
    "toggles",
    "number of toggle positions",
    "",
    "number of toggle positions of the circuit: poses in which the output is at rest while the input moves, and the mechanical advantage is infinite (Norton, Design of Machinery, 6.6)",
    |curve| output_value(curve, |output| Some(output.toggle_count() as f64)),
).of(Subject::WithOutput);

impl OutputMotion {
    /// The number of toggle positions; none of an output that does not move at all.
    pub(super) fn toggle_count(&self) -> usize {
        *self.toggle_count.get_or_init(|| {
            let coordinate = &self.coordinate;
            let rate = |derivatives: &JointDerivatives| coordinate.quantity().rate(derivatives);
            if self.is_at_rest() { 0 } else { coordinate.confirmed_stationary_places(rate).len() }
        })
    }
}
