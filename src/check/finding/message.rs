//! The messages of changes.

use std::fmt;

use super::super::outdated::{is_later, redefined_since};
use super::change::Change;
use coupler_curves::text::pluralize;

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Change::Damaged { message } => write!(f, "{message}"),
            Change::Outdated { recorded, current } if is_later(recorded, current) => {
                write!(f, "recorded by version {recorded}, but this is {current}: check the atlas with that version")
            }
            Change::Outdated { recorded, current } => {
                write!(
                    f,
                    "recorded by version {recorded}; this is {current}: drawings, the gallery and new columns are not compared"
                )?;
                let redefined = redefined_since(recorded).unwrap_or_default();
                let names: Vec<String> = redefined
                    .iter()
                    .map(|start| if start.ends_with('_') { format!("{start}…") } else { (*start).to_owned() })
                    .collect();
                if !names.is_empty() {
                    write!(f, ", nor what is defined anew: {}", names.join(", "))?;
                }
                write!(f, "; `render` renews the atlas")
            }
            Change::Altered => write!(f, "is not the file that was recorded"),
            Change::Rewritten => write!(f, "has other line endings or a byte order mark; nothing else has changed"),
            Change::FamilyAdded => write!(f, "the family is not recorded"),
            Change::FamilyRemoved => write!(f, "the recorded family is no longer in the manifest"),
            Change::FamilyChanged { what, recorded, current } => write!(f, "{what}: was {recorded}, is {current}"),
            Change::CellAdded => write!(f, "the cell is not recorded"),
            Change::CellRemoved => write!(f, "the recorded cell no longer exists"),
            Change::CellRenumbered { recorded } => write!(f, "the cell is recorded as cell {recorded}"),
            Change::Parameter { name, recorded, current } => write!(f, "{name} was {recorded} and is {current}"),
            Change::Status { recorded, current } => write!(f, "status was {recorded} and is {current}"),
            Change::Class { recorded, current } => write!(f, "the linkage was a {recorded} and is a {current}"),
            Change::CircuitSplit { into } => write!(f, "the circuit has split into circuits {}", comma_separated(into)),
            Change::CircuitJoined { from } => write!(f, "circuits {} have joined", comma_separated(from)),
            Change::CircuitLost => write!(f, "the recorded circuit no longer exists"),
            Change::CircuitAdded => write!(f, "the circuit is not recorded"),
            Change::CircuitReversed => write!(f, "the circuit is recorded in the opposite direction"),
            Change::CircuitShifted { by } => {
                write!(f, "the circuit is recorded from another first sample, shifted by {}", pluralize(*by, "sample"))
            }
            Change::CircuitRenumbered { recorded } => write!(f, "the circuit is recorded as circuit {recorded}"),
            Change::Samples { recorded, current, missing, hausdorff_distance } => {
                match recorded == current {
                    true => write!(f, "{current} samples at other inputs")?,
                    false => write!(f, "{} recorded, {current} now", pluralize(*recorded, "sample"))?,
                }
                if !missing.is_empty() {
                    write!(f, " (missing: {})", comma_separated(missing))?;
                }
                write!(f, "; Hausdorff distance of the curves {}", format_distance(*hausdorff_distance))
            }
            Change::Branch { sample, input, samples, recorded, current } => {
                write!(
                    f,
                    "{} on branch {current} instead of {recorded}, from sample {sample} at input {input}",
                    pluralize(*samples, "sample")
                )
            }
            Change::Moved(displacement) => write!(
                f,
                "moved by {:.3e} ({:.1e} of its size) at sample {}, input {}; {} of {} samples moved; \
                 Hausdorff distance of the curves {}",
                displacement.distance,
                displacement.relative,
                displacement.sample,
                displacement.input,
                displacement.moved_samples,
                displacement.total_samples,
                format_distance(displacement.hausdorff_distance)
            ),
            Change::Column { name, sample, recorded, current } => {
                write!(f, "{name} was {recorded} and is {current} at sample {sample}")
            }
            Change::Measure { name, recorded, current, relative } => {
                let value = |text: &str| if text.is_empty() { "missing".to_owned() } else { text.to_owned() };
                write!(f, "{name} was {} and is {}", value(recorded), value(current))?;
                if relative.is_finite() { write!(f, ", a relative change of {relative:.1e}") } else { Ok(()) }
            }
            Change::Drawing => write!(f, "would be drawn differently now, but its curves have not changed"),
            Change::Pages { recorded, current } => {
                write!(f, "{} recorded, {current} now", pluralize(*recorded, "page"))
            }
            Change::DrawnOff { distance_mm } => {
                write!(f, "the curve is drawn {distance_mm:.3} mm from its recorded points")
            }
        }
    }
}

fn comma_separated(numbers: &[usize]) -> String {
    numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// The distance of two curves, in a few digits.
fn format_distance(distance: f64) -> String {
    if distance == 0.0 { "0".to_owned() } else { format!("{distance:.3e}") }
}
