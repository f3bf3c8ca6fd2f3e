use super::{Measure, TracedCurve, Value};
use crate::geometry::trig;
use crate::linkage::FourBar;

/// How much slower one stroke of a rocker is than the other.
pub const TIME_RATIO: Measure = Measure {
    name: "time_ratio",
    unit: "",
    is_word: false,
    definition: "crank angle of the rocker's slower stroke to that of its faster one, of a crank-rocker; 1 or more",
    compute: |subject: &TracedCurve| ratio(subject).map_or(Value::Missing, Value::Number),
};

fn ratio(subject: &TracedCurve) -> Option<f64> {
    let bar = FourBar::from_linkage(subject.linkage).filter(|_| subject.linkage.seen_from.is_none())?;
    let FourBar { frame, crank, coupler, rocker } = bar;
    // The rocker turns where crank and coupler are in line; by the triangles of pivots and rocker pin there.
    let turns = subject.circuit.is_closed && subject.circuit.passes.len() == 1;
    if bar.mccarthy_type() != "crank-rocker" || !turns {
        return None;
    }
    let angle = |reach: f64| {
        trig::acos(((frame * frame + reach * reach - rocker * rocker) / (2.0 * frame * reach)).clamp(-1.0, 1.0))
    };
    // Stretched the crank points at the pin, folded away from it.
    let between = 180.0 + trig::degrees(angle((coupler - crank).abs()) - angle(coupler + crank));
    let slower = between.max(360.0 - between);
    Some(slower / (360.0 - slower))
}
