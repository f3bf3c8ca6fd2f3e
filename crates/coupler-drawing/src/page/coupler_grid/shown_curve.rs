//! A curve on a page.

use super::super::theme::Theme;
use crate::scene::{Color, Stroke};
use coupler_curves::solve::MeasuredCurve;

/// A curve on the page, which shares its ink with its coupler point and its row in the table.
pub(super) struct ShownCurve<'a> {
    pub curve: &'a MeasuredCurve,
    /// The index of its traced point on the page.
    pub point_index: usize,
}

impl ShownCurve<'_> {
    /// Whether the line under the dashes is in full ink and the point is filled: a page has more points than inks, so
    /// each ink is used a second time.
    pub fn has_underline(&self, theme: &Theme) -> bool {
        self.point_index / theme.curve_inks.len() % 2 == 1
    }

    pub fn ink(&self, theme: &Theme) -> Color {
        theme.curve_ink(self.point_index)
    }

    /// The ink of texts that belong to the curve.
    pub fn text_ink(&self, theme: &Theme) -> Color {
        theme.text_ink(self.ink(theme))
    }

    /// The stroke of the line under the dashes.
    pub fn hairline(&self, theme: &Theme) -> Stroke {
        if self.has_underline(theme) {
            theme.stroke(self.ink(theme), 0.6 * theme.fine_width)
        } else {
            theme.stroke(theme.faded(self.ink(theme)), theme.hair_width)
        }
    }
}
