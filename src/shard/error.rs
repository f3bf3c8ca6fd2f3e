//! The errors of making and gathering shards.

use std::path::PathBuf;

use crate::output;

/// An error of making or gathering shards.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read or written.
    #[error(transparent)]
    Output(#[from] output::Error),
    /// The run was interrupted.
    #[error("interrupted: shards that are complete are kept, and the next run makes this one again")]
    Interrupted,
    /// Tables are to be written into what is no folder.
    #[error("{} is not a folder: name another with -o", .0.display())]
    NotAFolder(PathBuf),
    /// The expression that orders curves cannot be used.
    #[error("{origin}: {message}")]
    Expression {
        /// What has it: `--by` with the expression, or the family whose `sort` it is.
        origin: String,
        /// Why.
        message: String,
    },
    /// A file of another sweep has the name of one to be written.
    #[error("{} is not to be replaced: {reason}; write to another folder with -o, or replace it with --force", path.display())]
    OtherShard {
        /// The file.
        path: PathBuf,
        /// What it is, as a clause.
        reason: String,
    },
    /// The system failed to read some of the shards.
    #[error("{}", .0.join("\n"))]
    Unreadable(Vec<String>),
    /// The shards cannot be gathered.
    #[error("{}", .0.join("\n"))]
    Problems(Vec<String>),
}

impl Error {
    /// What is wrong with the expression of `--by`.
    pub(super) fn by(text: &str, message: String) -> Error {
        Error::Expression { origin: format!("--by: `{text}`"), message }
    }
}
