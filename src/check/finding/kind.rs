//! The kinds of changes, and their order.

use super::super::outdated::is_later;
use super::change::Change;

impl Change {
    /// Whether the change makes the check fail; otherwise it is only reported.
    pub fn is_difference(&self) -> bool {
        match self {
            Change::Rewritten => false,
            Change::Outdated { recorded, current } => is_later(recorded, current),
            _ => true,
        }
    }

    /// The kind of the change, as in reports: `moved`, `drawn-off`.
    pub fn kind(&self) -> &'static str {
        match self {
            Change::Damaged { .. } => "damaged",
            Change::Outdated { .. } => "outdated",
            Change::Altered => "altered",
            Change::Rewritten => "rewritten",
            Change::FamilyAdded => "family-added",
            Change::FamilyRemoved => "family-removed",
            Change::FamilyChanged { .. } => "family-changed",
            Change::CellAdded => "cell-added",
            Change::CellRemoved => "cell-removed",
            Change::CellRenumbered { .. } => "cell-renumbered",
            Change::Parameter { .. } => "parameter",
            Change::Status { .. } => "status",
            Change::Class { .. } => "class",
            Change::CircuitSplit { .. } => "circuit-split",
            Change::CircuitJoined { .. } => "circuit-joined",
            Change::CircuitLost => "circuit-lost",
            Change::CircuitAdded => "circuit-added",
            Change::CircuitReversed => "circuit-reversed",
            Change::CircuitShifted { .. } => "circuit-shifted",
            Change::CircuitRenumbered { .. } => "circuit-renumbered",
            Change::Samples { .. } => "samples",
            Change::Branch { .. } => "branch",
            Change::Moved(_) => "moved",
            Change::Column { .. } => "column",
            Change::Measure { .. } => "measure",
            Change::Drawing => "drawing",
            Change::Pages { .. } => "pages",
            Change::DrawnOff { .. } => "drawn-off",
        }
    }

    /// The key by which findings are sorted, the worst first.
    ///
    /// The rank is that of the kind: what prevents a comparison, what was added or removed, the configuration of the
    /// linkage, its points, its measures, its drawings. Within a rank, the greater change comes first.
    pub fn sort_key(&self) -> (usize, f64) {
        const ORDER: [&[&str]; 9] = [
            &["damaged", "outdated"],
            &["family-removed", "family-added", "family-changed"],
            &["cell-removed", "cell-added", "pages"],
            &["parameter", "status", "class"],
            &["circuit-lost", "circuit-added", "circuit-split", "circuit-joined", "circuit-reversed", "branch"],
            &["moved", "samples", "drawn-off"],
            &["measure", "column", "circuit-renumbered", "circuit-shifted", "cell-renumbered"],
            &["altered", "drawing"],
            &["rewritten"],
        ];
        let rank = ORDER.iter().position(|kinds| kinds.contains(&self.kind())).unwrap_or(ORDER.len());
        let size = match self {
            Change::Moved(displacement) => displacement.relative,
            Change::Measure { relative, .. } => *relative,
            Change::DrawnOff { distance_mm } => *distance_mm,
            Change::Samples { hausdorff_distance, .. } => *hausdorff_distance,
            _ => 0.0,
        };
        (rank, -size)
    }
}
