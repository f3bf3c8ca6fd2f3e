//! The findings of a check: where an atlas differs from its record, and how.

mod change;
mod kind;
mod location;
mod message;

pub use change::{Change, Displacement};
pub use location::Location;

use serde::Serialize;

/// One difference between a fresh run and the recorded atlas.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Where it is.
    #[serde(flatten)]
    pub location: Location,
    /// What has changed.
    #[serde(flatten)]
    pub change: Change,
}

impl Location {
    /// A change found at this location.
    pub fn finding(&self, change: Change) -> Finding {
        Finding { location: self.clone(), change }
    }
}
