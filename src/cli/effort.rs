//! How much a search tries.

use clap::ValueEnum;
use coupler_find::Effort;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum EffortChoice {
    /// A third of the normal effort.
    Quick,
    /// What usually suffices.
    Normal,
    /// Four times the normal effort.
    Thorough,
}

impl From<EffortChoice> for Effort {
    fn from(choice: EffortChoice) -> Effort {
        match choice {
            EffortChoice::Quick => Effort::Quick,
            EffortChoice::Normal => Effort::Normal,
            EffortChoice::Thorough => Effort::Thorough,
        }
    }
}
