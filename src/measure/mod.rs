//! Numbers read off a motion, one measure a file; each is a column of `cells.csv` and a name in `where`.

mod class;
mod column;
mod input_range;

pub use column::{COLUMNS, Column, column, take_columns};

use crate::linkage::{Class, JointId, Linkage};
use crate::motion::{Circuit, Motion};

/// What a measure is taken of: a traced joint on a circuit.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The linkage.
    pub linkage: &'a Linkage,
    /// All that it does.
    pub motion: &'a Motion,
    /// The circuit.
    pub circuit: &'a Circuit,
    /// The traced joint.
    pub joint: JointId,
}

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word.
    Word(&'static str),
    /// It does not apply.
    Missing,
}

/// A measure.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Its column.
    pub name: &'static str,
    /// Its unit; empty for a word or a pure number.
    pub unit: &'static str,
    /// Whether it is a word and not a number: a word cannot be compared in `where`.
    pub is_word: bool,
    /// What it is.
    pub definition: &'static str,
    /// How it is taken.
    pub take: fn(&Subject) -> Value,
}

/// Every measure, in the order of the columns.
pub const ALL: [Measure; 3] = [class::CLASS, input_range::INPUT_MIN, input_range::INPUT_MAX];

/// A name that is true or false of a curve: `is_crank_rocker` and its like, by the word it asks for.
pub const TRUTHS: [(&str, &str); 5] = [
    ("is_crank_rocker", "crank-rocker"),
    ("is_drag_link", "drag-link"),
    ("is_double_rocker", "double-rocker"),
    ("is_triple_rocker", "triple-rocker"),
    ("is_change_point", "change-point"),
];

/// Whether one of [`TRUTHS`] holds, 1 or 0; not a number where there is no class.
pub fn truth(word: &str, values: &[Value]) -> f64 {
    match ALL.iter().zip(values).find(|(measure, _)| measure.name == class::CLASS.name) {
        Some((_, Value::Word(class))) => f64::from(u8::from(*class == word)),
        _ => f64::NAN,
    }
}

/// Every measure of a subject, in the order of [`ALL`].
pub fn take(subject: &Subject) -> Vec<Value> {
    ALL.iter().map(|measure| (measure.take)(subject)).collect()
}

const _: () = assert!(TRUTHS.len() == Class::ALL.len());

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_has_its_truth() {
        for class in Class::ALL {
            let truth =
                TRUTHS.iter().find(|(_, word)| *word == class.name()).unwrap_or_else(|| panic!("{}", class.name()));
            assert_eq!(truth.0, format!("is_{}", class.name().replace('-', "_")));
        }
    }
}
