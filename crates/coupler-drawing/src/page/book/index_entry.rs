//! The index entry of a cell.

use coupler_curves::measure::{Measure, Symmetry};
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
    /// The index entry of a solved cell, whose chapter and first page are not known yet.
    ///
    /// `page(k)` is the number of the page that shows the k-th curve, from 0 for the first page of the cell.
    pub fn from_solved_cell(solved: &SolvedCell, caption: &str, page: impl Fn(usize) -> usize) -> IndexEntry {
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
            chapter: 0,
            caption: caption.to_owned(),
            straightness: best(straightness, |a, b| a > b),
            // The transmission angle is the same for all points of a linkage.
            transmission_angle: best(|curve| curve.measure(Measure::MU_WORST), |a, b| a > b)
                .map(|value| IndexValue { curve: None, ..value }),
            asymmetry: best(asymmetry, |a, b| a < b),
        }
    }

    /// The entry of a cell in a chapter, by its index among those of the atlas, whose first page has a number in the atlas.
    pub fn placed(self, chapter: usize, first_page: usize) -> IndexEntry {
        let placed =
            |value: Option<IndexValue>| value.map(|value| IndexValue { page: first_page + value.page, ..value });
        IndexEntry {
            chapter,
            caption: self.caption,
            straightness: placed(self.straightness),
            transmission_angle: placed(self.transmission_angle),
            asymmetry: placed(self.asymmetry),
        }
    }
}

/// The straight portion of a curve as a fraction of its length.
fn straightness(curve: &MeasuredCurve) -> Option<f64> {
    let (length, whole) = (curve.measure(Measure::STRAIGHT_LENGTH)?, curve.measure(Measure::LENGTH)?);
    (length > 0.0 && whole > 0.0).then(|| length / whole)
}

/// The deviation of a curve from its mirror image relative to its greatest extent, rounded to multiples of
/// [`Symmetry::TOLERANCE`], so that all symmetrical curves are equal. `None` for a circle, which has no particular
/// axis, and for a curve that is nearly one.
fn asymmetry(curve: &MeasuredCurve) -> Option<f64> {
    /// The area relative to that of a circle of the same length from which a curve is nearly a circle.
    const NEARLY_A_CIRCLE: f64 = 0.95;
    if let (Some(area), Some(length)) = (curve.measure(Measure::AREA), curve.measure(Measure::LENGTH))
        && 4.0 * std::f64::consts::PI * area.abs() > NEARLY_A_CIRCLE * length * length
    {
        return None;
    }
    let symmetry = curve.symmetry.as_ref().filter(|symmetry| symmetry.axis.is_some())?;
    Some((symmetry.residual / Symmetry::TOLERANCE).round() * Symmetry::TOLERANCE)
}
