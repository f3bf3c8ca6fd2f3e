//! What a measure is, and its value for a curve.

use super::subject::Subject;
use super::traced_curve::TracedCurve;

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word.
    Word(&'static str),
    /// The measure does not apply.
    Missing,
}

/// A measure.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Measure {
    /// Its name: a column of `cells.csv` and a variable in `where`.
    pub name: &'static str,
    /// What it is in a few words, as on charts: "length of the straight portion".
    pub title: &'static str,
    /// Its name for a linkage driven by an actuator, if it is an input: there it is a length.
    pub length_name: Option<&'static str>,
    /// Its unit; empty for a word or a pure number.
    pub unit: &'static str,
    /// Whether it is a word and not a number: a word cannot be compared in `where`.
    pub is_word: bool,
    /// The linkages that have it.
    pub subject: Subject,
    /// Its definition, as printed by `list measures`.
    pub definition: &'static str,
    /// Computes it.
    pub compute: fn(&TracedCurve) -> Value,
}

impl Measure {
    /// A measure that is a number.
    pub(super) const fn number(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        definition: &'static str,
        compute: fn(&TracedCurve) -> Value,
    ) -> Measure {
        Measure { name, title, length_name: None, unit, is_word: false, subject: Subject::Any, definition, compute }
    }

    /// A measure that is a word.
    pub(super) const fn word(
        name: &'static str,
        title: &'static str,
        definition: &'static str,
        compute: fn(&TracedCurve) -> Value,
    ) -> Measure {
        Measure { is_word: true, ..Measure::number(name, title, "", definition, compute) }
    }

    /// The same measure, of these linkages only.
    pub(super) const fn of(self, subject: Subject) -> Measure {
        Measure { subject, ..self }
    }

    /// The same measure, which is an input, with its name where the input is a length.
    pub(super) const fn or_length(self, length_name: &'static str) -> Measure {
        Measure { length_name: Some(length_name), ..self }
    }

    /// Its names for all linkages: that of a length follows that of an angle.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        std::iter::once(self.name).chain(self.length_name)
    }

    /// Its name for a linkage: an input is in degrees, or the length of an actuator.
    pub fn name_for(&self, is_driven_by_length: bool) -> &'static str {
        self.length_name.filter(|_| is_driven_by_length).unwrap_or(self.name)
    }
}
