use super::{Measure, Subject, TracedCurve, Value};
use crate::linkage::FourBar;

/// The measure `type`.
pub const TYPE: Measure = Measure::word(
    "type",
    "type of the four-bar",
    "McCarthy's type of a four-bar (Geometric Design of Linkages, table 2.2): 0 and π are the directions that a rocker swings through",
    |curve: &TracedCurve| {
        FourBar::from_linkage(curve.linkage).map_or(Value::Missing, |bar| Value::Word(bar.mccarthy_type()))
    },
).of(Subject::FourBar);

/// The measure `shortest`.
pub const SHORTEST: Measure = Measure::word(
    "shortest",
    "shortest link",
    "shortest link of a four-bar with respect to its frame; if several are equal, the first of frame, crank, coupler, rocker",
    |curve: &TracedCurve| {
        let Some(FourBar { frame, crank, coupler, rocker }) = FourBar::from_linkage(curve.linkage) else {
            return Value::Missing;
        };
        let links = [("frame", frame), ("crank", crank), ("coupler", coupler), ("rocker", rocker)];
        let least = links.into_iter().reduce(|best, link| if link.1 < best.1 { link } else { best });
        least.map_or(Value::Missing, |(name, _)| Value::Word(name))
    },
).of(Subject::FourBar);
