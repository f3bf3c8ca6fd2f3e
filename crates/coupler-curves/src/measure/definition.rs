//! What a measure is, and its value for a curve.

use std::marker::PhantomData;

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
    /// Whether more of it is better, as of a transmission angle, and not less; false also where neither is.
    pub is_more_better: bool,
    /// Whether it is a position of the input: of a crank that turns fully, an angle of at least 0 and less than its period.
    pub is_input_position: bool,
    /// The linkages that have it.
    pub subject: Subject,
    /// Its definition, as printed by `list measures`.
    pub definition: &'static str,
    /// Computes it.
    pub compute: fn(&TracedCurve) -> Value,
}

/// A measure to ask a curve for, as [`Measure::MU_WORST`]; its values are of the type `T`, [`f64`] for a number or `&'static str` for a
/// word. It can be used as a reference to the [`Measure`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeasureKey<T> {
    pub(super) index: usize,
    value: PhantomData<fn() -> T>,
}

impl<T: MeasureValue> MeasureKey<T> {
    /// The key of the measure at an index.
    ///
    /// # Panics
    /// Its values are of another type.
    pub(super) const fn new(index: usize, measure: &Measure) -> MeasureKey<T> {
        assert!(measure.is_word == T::IS_WORD);
        MeasureKey { index, value: PhantomData }
    }

    /// Its value among those of all measures, in the order of [`ALL`](super::ALL); `None` if it is missing.
    pub fn value_in(self, values: &[Value]) -> Option<T> {
        values.get(self.index).and_then(|value| T::from_value(*value))
    }
}

/// What the value of a measure can be.
pub trait MeasureValue: Copy {
    /// Whether it is a word.
    const IS_WORD: bool;

    /// The value; `None` if it is missing or of another type.
    fn from_value(value: Value) -> Option<Self>;
}

impl MeasureValue for f64 {
    const IS_WORD: bool = false;

    fn from_value(value: Value) -> Option<f64> {
        if let Value::Number(number) = value { Some(number) } else { None }
    }
}

impl MeasureValue for &'static str {
    const IS_WORD: bool = true;

    fn from_value(value: Value) -> Option<&'static str> {
        if let Value::Word(word) = value { Some(word) } else { None }
    }
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
        Measure {
            name,
            title,
            length_name: None,
            unit,
            is_word: false,
            is_more_better: false,
            is_input_position: false,
            subject: Subject::Any,
            definition,
            compute,
        }
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

    /// The same measure, of which more is better.
    pub(super) const fn more_is_better(self) -> Measure {
        Measure { is_more_better: true, ..self }
    }

    /// The same measure, which is an input, with its name where the input is a length.
    pub(super) const fn or_length(self, length_name: &'static str) -> Measure {
        Measure { length_name: Some(length_name), ..self }
    }

    /// The same measure, which is a position of the input.
    pub(super) const fn at_input(self) -> Measure {
        Measure { is_input_position: true, ..self }
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
