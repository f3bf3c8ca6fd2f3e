use super::{Measure, TracedCurve, Value};
use crate::geometry::trig;
use crate::linkage::FourBar;

/// The measure `time_ratio`.
pub const TIME_RATIO: Measure = Measure {
    name: "time_ratio",
    unit: "",
    is_word: false,
    definition: "time ratio of a crank-rocker: crank angle of the rocker's slower stroke divided by that of its faster one; 1 or more",
    compute: |curve: &TracedCurve| ratio(curve).map_or(Value::Missing, Value::Number),
};

fn ratio(curve: &TracedCurve) -> Option<f64> {
    let bar = FourBar::from_linkage(curve.linkage).filter(|_| curve.linkage.seen_from.is_none())?;
    let FourBar { frame, crank, coupler, rocker } = bar;
    // The rocker reverses where crank and coupler are collinear; the crank angles there are from triangles.
    let is_full_turn = curve.circuit.is_closed && curve.circuit.passes.len() == 1;
    if bar.mccarthy_type() != "crank-rocker" || !is_full_turn {
        return None;
    }
    let angle = |reach: f64| {
        trig::acos(((frame * frame + reach * reach - rocker * rocker) / (2.0 * frame * reach)).clamp(-1.0, 1.0))
    };
    // Where crank and coupler are stretched the crank points towards the rocker's pin, where they are folded away from
    // it.
    let between = 180.0 + trig::degrees(angle((coupler - crank).abs()) - angle(coupler + crank));
    let slower = between.max(360.0 - between);
    Some(slower / (360.0 - slower))
}
