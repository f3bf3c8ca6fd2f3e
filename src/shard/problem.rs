//! Why a file is not a table of a shard that can be used.

use std::path::Path;

use crate::record::FileError;

/// Why a file is not a table of a shard that can be used, as a clause.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum FileProblem {
    /// There is none.
    Missing,
    /// A part of a table, or one that has been changed: it is made again.
    Damaged(String),
    /// No sweep of this version wrote it: it is not replaced unasked.
    Foreign(String),
    /// It cannot be read.
    Unreadable(String),
}

impl FileProblem {
    /// What is wrong with the file at a path, and what to do about it.
    pub fn describe(&self, path: &Path) -> String {
        let path = path.display();
        match self {
            FileProblem::Missing => format!("{path}: it does not exist; make the shard again"),
            FileProblem::Damaged(why) => format!("{path}: {why}; make the shard again"),
            FileProblem::Foreign(why) => format!("{path}: {why}; move it away"),
            FileProblem::Unreadable(why) => format!("{path}: {why}"),
        }
    }

    /// What is wrong, as a clause.
    pub fn into_message(self) -> String {
        match self {
            FileProblem::Damaged(why) | FileProblem::Foreign(why) | FileProblem::Unreadable(why) => why,
            FileProblem::Missing => "it does not exist".to_owned(),
        }
    }
}

impl From<FileError> for FileProblem {
    fn from(error: FileError) -> FileProblem {
        match error {
            FileError::NotFound => FileProblem::Missing,
            FileError::NotAFile(_) => FileProblem::Foreign(format!("it {error}")),
            FileError::TooLarge { .. } => FileProblem::Damaged(format!("it {error}")),
            FileError::Unreadable { .. } => FileProblem::Unreadable(format!("it {error}")),
        }
    }
}
