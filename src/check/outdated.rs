//! Atlases that another version of the program has recorded.
//!
//! Drawings may change with the version, and measures whose definition does. These are not compared, and one notice says so; curves, and the measures that
//! both versions define alike, are compared as always. An atlas of a later version may have anything that is not known here: only its curves are compared.

use super::finding::{Change, Finding, Location};
use crate::record::{FORMAT_VERSION, FileError, RUN_FILE_NAME, ReadError, RunRecord};

/// The finding on the version that recorded an atlas, if it is not this one.
pub(super) fn check_version(record: &RunRecord) -> Option<Finding> {
    let current = env!("CARGO_PKG_VERSION");
    let change = Change::Outdated { recorded: record.version.clone(), current: current.to_owned() };
    (record.version != current).then(|| Location::default().with_file(RUN_FILE_NAME).finding(change))
}

/// The measures that a version has defined anew, by the beginnings of their names: of atlases that were recorded before it they are not compared.
const REDEFINED: [(&str, &[&str]); 1] = [(
    "0.2.0",
    &[
        "symmetry",
        "curvature_max",
        "straight_",
        "dwell_",
        "speed_ratio",
        "cusps",
        "crunodes",
        "inflections",
        "output_swing",
        "time_ratio",
    ],
)];

/// The beginnings of the names of measures that are not defined as they were in a version; `None` of a later one, of which that is not known.
pub(super) fn redefined_since(version: &str) -> Option<Vec<&'static str>> {
    if is_later(version, env!("CARGO_PKG_VERSION")) {
        return None;
    }
    let since = REDEFINED.iter().filter(|(redefined, _)| is_later(redefined, version));
    Some(since.flat_map(|(_, names)| names.iter().copied()).collect())
}

/// Whether a finding on an atlas of another version says something about its curves or files, or about what both versions define alike.
pub(super) fn is_comparable(finding: &Finding, version: &str) -> bool {
    let redefined = redefined_since(version);
    match &finding.change {
        Change::Damaged { message } => *message == FileError::NotFound.to_string(),
        Change::FamilyChanged { what, .. } => what != "columns",
        Change::Altered | Change::Rewritten | Change::Moved(_) | Change::Samples { .. } | Change::Branch { .. } => true,
        Change::CellAdded | Change::CellRemoved | Change::CellRenumbered { .. } | Change::Parameter { .. } => true,
        Change::Class { .. } => redefined.is_some(),
        Change::Measure { name, .. } => {
            redefined.is_some_and(|names| names.iter().all(|start| !name.starts_with(start)))
        }
        change => change.kind().starts_with("circuit-"),
    }
}

/// What to do about a record that cannot be read.
pub(super) fn record_remedy(error: &ReadError) -> &'static str {
    match error {
        ReadError::UnsupportedFormat { format, .. } if is_older(format) => {
            "render the atlas again with this version, or check it with the version that recorded it"
        }
        ReadError::UnsupportedFormat { .. } => "check the atlas with the version that recorded it",
        ReadError::File(FileError::NotFound) => "name the folder of an atlas, or render one there",
        error if error.is_damage() => {
            "`coupler-atlas render --repair` rebuilds it from the files of the atlas, or restore it"
        }
        error if error.is_system_failure() => "run it again",
        _ => "render the atlas again, or restore the file",
    }
}

fn is_older(format: &str) -> bool {
    format.parse().is_ok_and(|format: u32| format < FORMAT_VERSION)
}

/// Whether a version comes after another, number by number; a text that is not a version does not.
pub(super) fn is_later(version: &str, other: &str) -> bool {
    let numbers = |text: &str| text.split('.').map(|number| number.parse().ok()).collect::<Option<Vec<u32>>>();
    numbers(version).zip(numbers(other)).is_some_and(|(version, other)| version > other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_by_their_numbers() {
        for (version, other, expected) in [
            ("0.10.0", "0.9.1", true),
            ("0.9.1", "0.10.0", false),
            ("1.0.0", "1.0.0", false),
            ("1.0.1", "1.0.0", true),
            ("nonsense", "1.0.0", false),
        ] {
            assert_eq!(is_later(version, other), expected, "{version} {other}");
        }
    }
}
