//! The sheets on which pages are printed, and their units.

use krilla::geom::Rect;
use krilla::page::PageSettings;

use coupler_curves::geometry::Point;

/// A length in PDF points.
pub(super) fn mm_to_points(mm: f64) -> f32 {
    (mm * POINTS_PER_MM) as f32
}

pub(super) const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// The sheets on which pages are printed, in millimetres; the default adds nothing to a page.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sheet {
    /// The width of the gutter at the inner edge, which is added to that of a page.
    pub binding: f64,
    /// How far beyond its edges a page is printed, which is cut off.
    pub bleed: f64,
}

impl Sheet {
    /// The sheet of a page, with its boxes; `None` if the page has no area.
    pub(super) fn settings(&self, width: f64, height: f64) -> Option<PageSettings> {
        let [page_width, page_height] = [width + self.binding, height];
        let whole = [page_width + 2.0 * self.bleed, page_height + 2.0 * self.bleed].map(mm_to_points);
        // A negative side and a gutter are no page.
        PageSettings::from_wh(mm_to_points(width), mm_to_points(height))?;
        let settings = PageSettings::from_wh(whole[0], whole[1])?;
        if self.bleed == 0.0 {
            return Some(settings);
        }
        let [left, top, right, bottom] =
            [self.bleed, self.bleed, self.bleed + page_width, self.bleed + page_height].map(mm_to_points);
        let trim = Rect::from_ltrb(left, top, right, bottom)?;
        Some(settings.with_trim_box(Some(trim)).with_bleed_box(Rect::from_xywh(0.0, 0.0, whole[0], whole[1])))
    }

    /// The upper left corner of what is drawn of a page, on its sheet.
    pub(super) fn page_corner(&self, is_right_hand: bool) -> Point {
        Point::new(self.bleed + if is_right_hand { self.binding } else { 0.0 }, self.bleed)
    }
}
