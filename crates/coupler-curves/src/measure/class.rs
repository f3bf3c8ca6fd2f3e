use super::{Measure, Subject, TracedCurve, Value};
use crate::linkage::FourBar;

/// The measure `class`.
pub const CLASS: Measure = Measure::word(
    "class",
    "class of the four-bar",
    "Grashof's class of a four-bar with respect to its frame (Natesan, table 3.1); crank-rocker if the crank is shortest, rocker-crank if the rocker is",
    |curve: &TracedCurve| match FourBar::from_linkage(curve.linkage) {
        Some(four_bar) => Value::Word(four_bar.class().name()),
        None => Value::Missing,
    },
).of(Subject::FourBar);
