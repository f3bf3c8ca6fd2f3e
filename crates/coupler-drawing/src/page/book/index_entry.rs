use coupler_curves::measure::{Symmetry, Value};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// What an index says of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexEntry {
    /// The place of its family among the chapters, from 0.
    pub(super) chapter: usize,
    pub(super) caption: String,
    /// Its straightest curve by the part of it that is straight.
    pub(super) straightness: Option<IndexValue>,
    /// Its least transmission angle in degrees, from 0 to 90.
    pub(super) transmission_angle: Option<IndexValue>,
    /// Its most symmetrical curve by how far its mirror image is from it, by its greatest extent.
    pub(super) asymmetry: Option<IndexValue>,
}

/// A value, the curve it is of, and its page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IndexValue {
    pub value: f64,
    /// The number of the traced point, where there are several.
    pub curve: Option<usize>,
    /// The page of the atlas it is on, from 1.
    pub page: usize,
}

impl IndexEntry {
    /// What an index says of a solved cell of a family, given by its place among the chapters; `page` gives the number of
    /// the page in the atlas, from 1, that the k-th of its curves is on.
    pub fn from_solved_cell(
        solved: &SolvedCell,
        chapter: usize,
        caption: &str,
        page: impl Fn(usize) -> usize,
    ) -> IndexEntry {
        let has_many = solved.linkage.traced.len() > 1;
        let found = |value: f64, k: usize, curve: &MeasuredCurve| {
            value.is_finite().then(|| IndexValue { value, curve: has_many.then_some(curve.trace), page: page(k) })
        };
        let best = |value: fn(&MeasuredCurve) -> Option<f64>, is_better: fn(f64, f64) -> bool| {
            let values = solved.curves.iter().enumerate().filter_map(|(k, curve)| found(value(curve)?, k, curve));
            // The first of those that are equal.
            values.reduce(|best, other| if is_better(other.value, best.value) { other } else { best })
        };
        IndexEntry {
            chapter,
            caption: caption.to_owned(),
            straightness: best(straightness, |a, b| a > b),
            // It is the same for all points of a linkage.
            transmission_angle: best(min_transmission_angle, |a, b| a > b)
                .map(|found| IndexValue { curve: None, ..found }),
            asymmetry: best(asymmetry, |a, b| a < b),
        }
    }
}

/// The part of a curve's length that its straight portion is.
fn straightness(curve: &MeasuredCurve) -> Option<f64> {
    let (length, whole) = (number_measure(curve, "straight_length")?, number_measure(curve, "length")?);
    (length > 0.0 && whole > 0.0).then(|| length / whole)
}

/// The least angle between coupler and output link, whichever side of 90 degrees it is.
fn min_transmission_angle(curve: &MeasuredCurve) -> Option<f64> {
    Some(number_measure(curve, "mu_min_deg")?.min(180.0 - number_measure(curve, "mu_max_deg")?))
}

/// How far the mirror image of a curve is from it, by its greatest extent, in whole steps of what is called symmetrical: what
/// is nearer than that is alike. Nothing of a circle, which has no axis of its own.
fn asymmetry(curve: &MeasuredCurve) -> Option<f64> {
    let symmetry = curve.symmetry.as_ref().filter(|symmetry| symmetry.axis.is_some())?;
    Some((symmetry.residual / Symmetry::TOLERANCE).round() * Symmetry::TOLERANCE)
}

fn number_measure(curve: &MeasuredCurve, name: &str) -> Option<f64> {
    match curve.value(name) {
        Value::Number(value) => Some(value),
        _ => None,
    }
}
