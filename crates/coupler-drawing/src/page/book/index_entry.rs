//! The index entry of a cell.

use super::super::{Layout, circuit_words};
use super::linkage_identity::linkage_identity;
use coupler_curves::measure::{Measure, Symmetry};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The index entry of a cell: its best curve by each measure of the index.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexEntry {
    /// The index of the chapter.
    pub(super) chapter: usize,
    pub(super) caption: String,
    /// What the linkage of the best transmission angle is recognized by, whatever points it has.
    pub(super) linkage: u64,
    /// The number of its figure on the page, if that has several.
    pub(super) figure: Option<usize>,
    /// The greatest fraction of the length of a curve that is its straight portion.
    pub(super) straightness: Option<IndexValue>,
    /// The worst transmission angle, in degrees from 0 to 90.
    pub(super) transmission_angle: Option<IndexValue>,
    /// The least deviation of a curve from its mirror image, relative to its greatest extent.
    pub(super) asymmetry: Option<IndexValue>,
}

/// A value with its curve and page.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct IndexValue {
    pub value: f64,
    /// What the curve is called, if there are several.
    pub curve: Option<String>,
    /// The number of the page of the atlas, from 1.
    pub page: usize,
}

impl IndexEntry {
    /// The index entry of a solved cell on pages of a layout, whose chapter and first page are not known yet.
    ///
    /// `page(k)` is the number of the page that shows the k-th curve, from 0 for the first page of the cell.
    pub fn from_solved_cell(
        (solved, layout): (&SolvedCell, Layout),
        caption: &str,
        page: impl Fn(usize) -> usize,
    ) -> IndexEntry {
        let index_value = |value: f64, k: usize, curve: &MeasuredCurve| {
            value.is_finite().then(|| IndexValue { value, curve: layout.curve_words(solved, curve), page: page(k) })
        };
        let best = |value: &dyn Fn(&MeasuredCurve) -> Option<f64>, is_better: fn(f64, f64) -> bool| {
            let values = solved.curves.iter().enumerate().filter_map(|(k, curve)| index_value(value(curve)?, k, curve));
            // Of equal values the first is kept.
            values.reduce(|best, other| if is_better(other.value, best.value) { other } else { best })
        };
        // The path of a slider on its guide is straight, and so symmetrical, by construction.
        let is_of_slider = |curve: &MeasuredCurve| solved.linkage.slider_line(curve.joint).is_some();
        let of_path = |value: fn(&MeasuredCurve) -> Option<f64>| {
            move |curve: &MeasuredCurve| value(curve).filter(|_| !is_of_slider(curve))
        };
        let best_of_linkage = best(&|curve| curve.measure(Measure::MU_WORST), |a, b| a > b);
        let of_best = best_of_linkage
            .as_ref()
            .and_then(|best| solved.curves.iter().find(|curve| curve.measure(Measure::MU_WORST) == Some(best.value)));
        let best_of_linkage = best_of_linkage
            .map(|value| IndexValue { curve: of_best.and_then(|curve| circuit_words(solved, curve)), ..value });
        IndexEntry {
            chapter: 0,
            linkage: of_best.map_or(0, |curve| linkage_identity(solved, curve)),
            caption: caption.to_owned(),
            figure: layout.figure_number(&solved.cell),
            straightness: best(&of_path(straightness), |a, b| a > b),
            // The transmission angle is the same for all points of a linkage on a circuit.
            transmission_angle: best_of_linkage,
            asymmetry: best(&of_path(asymmetry), |a, b| a < b),
        }
    }

    /// The entry of a cell in a chapter, by its index among those of the atlas, whose first page has a number in the atlas.
    pub fn placed(self, chapter: usize, first_page: usize) -> IndexEntry {
        let placed =
            |value: Option<IndexValue>| value.map(|value| IndexValue { page: first_page + value.page, ..value });
        IndexEntry {
            chapter,
            linkage: self.linkage,
            caption: self.caption,
            figure: self.figure,
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
