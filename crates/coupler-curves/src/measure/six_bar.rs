use super::{Measure, TracedCurve, Value};
use crate::linkage::KinematicChain;

/// The measure `six_bar`.
pub const SIX_BAR: Measure = Measure {
    name: "six_bar",
    unit: "",
    is_word: true,
    definition: "kind of a six-bar: Watt I or II, Stephenson I, II or III (Norton 2.12), by which links the links with three joints and the ground are; a slider is a joint",
    compute: |curve: &TracedCurve| {
        let six_bar = KinematicChain::from_linkage(curve.linkage).and_then(|chain| chain.six_bar());
        six_bar.map_or(Value::Missing, |six_bar| Value::Word(six_bar.name()))
    },
};
