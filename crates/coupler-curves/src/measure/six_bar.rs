use super::{Measure, Subject, TracedCurve, Value};
use crate::linkage::KinematicChain;

/// The measure `six_bar`.
pub const SIX_BAR: Measure = Measure::word(
    "six_bar",
    "kind of six-bar",
    "kind of a six-bar: Watt I or II, Stephenson I, II or III (Norton 2.12), by which links the links with three joints and the ground are; a slider is a joint",
    |curve: &TracedCurve| {
        let six_bar = KinematicChain::from_linkage(curve.linkage).and_then(|chain| chain.six_bar());
        six_bar.map_or(Value::Missing, |six_bar| Value::Word(six_bar.name()))
    },
).of(Subject::SixBar);
