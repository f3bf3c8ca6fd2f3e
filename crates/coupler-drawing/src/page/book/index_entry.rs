//! The index entry of a cell.

use coupler_curves::measure::{Symmetry, Value};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The index entry of a cell: its best curve by each measure of the index.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexEntry {
    /// The index of the chapter.
    pub(super) chapter: usize,
    pub(super) caption: String,
    /// The greatest fraction of the length of a curve that is its straight portion.
    pub(super) straightness: Option<IndexValue>,
    /// The worst transmission angle, in degrees from 0 to 90.
    pub(super) transmission_angle: Option<IndexValue>,
    /// The least deviation of a curve from its mirror image, relative to its greatest extent.
    pub(super) asymmetry: Option<IndexValue>,
}

/// A value with its curve and page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IndexValue {
    pub value: f64,
    /// The number of the traced point, if there are several.
    pub curve: Option<usize>,
    /// The number of the page of the atlas, from 1.
    pub page: usize,
}

impl IndexEntry {
    /// The index entry of a solved cell.
    ///
    /// `chapter` is the index of its family among the chapters of the atlas; `page(k)` is the number of the page of the
    /// atlas, from 1, that shows the k-th curve.
    pub fn from_solved_cell(
        solved: &SolvedCell,
        chapter: usize,
        caption: &str,
        page: impl Fn(usize) -> usize,
    ) -> IndexEntry {
        let has_many = solved.linkage.traced.len() > 1;
        let index_value = |value: f64, k: usize, curve: &MeasuredCurve| {
            value.is_finite().then(|| IndexValue { value, curve: has_many.then_some(curve.trace), page: page(k) })
        };
        let best = |value: fn(&MeasuredCurve) -> Option<f64>, is_better: fn(f64, f64) -> bool| {
            let values = solved.curves.iter().enumerate().filter_map(|(k, curve)| index_value(value(curve)?, k, curve));
            // Of equal values the first is kept.
            values.reduce(|best, other| if is_better(other.value, best.value) { other } else { best })
        };
        IndexEntry {
            chapter,
            caption: caption.to_owned(),
            straightness: best(straightness, |a, b| a > b),
            // The transmission angle is the same for all points of a linkage.
            transmission_angle: best(|curve| number_measure(curve, "mu_worst_deg"), |a, b| a > b)
                .map(|value| IndexValue { curve: None, ..value }),
            asymmetry: best(asymmetry, |a, b| a < b),
        }
    }
}

/// The straight portion of a curve as a fraction of its length.
fn straightness(curve: &MeasuredCurve) -> Option<f64> {
    let (length, whole) = (number_measure(curve, "straight_length")?, number_measure(curve, "length")?);
    (length > 0.0 && whole > 0.0).then(|| length / whole)
}

/// The deviation of a curve from its mirror image relative to its greatest extent, rounded to multiples of
/// [`Symmetry::TOLERANCE`], so that all symmetrical curves are equal. `None` for a circle, which has no particular
/// axis.
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
