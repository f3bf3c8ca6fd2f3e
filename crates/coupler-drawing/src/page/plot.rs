//! A frame in which a figure is drawn to scale, with its scale bar.

use std::sync::LazyLock;

use super::area::Area;
use super::element::Drawing;
use super::rect::Rect;
use super::theme::Theme;
use crate::scene::{Anchor, Item, Path, Polyline, Text};
use coupler_curves::family::LengthUnit;
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector};

/// The rounding of a scale that is computed from a frame: panels of a page differ in size by a hundredth of a millimetre.
pub(super) const SCALE_ROUNDING: f64 = 1e-3;

/// Whether a scale is greater than the one that fits.
pub(super) fn is_reduced(scale: f64, fitting: f64) -> bool {
    scale > fitting * (1.0 + SCALE_ROUNDING)
}

/// What a scale bar says of a scale that is to be common to several figures and is greater than the one that fits.
pub(super) fn reduction_remark(scale: Option<f64>, fitting: f64) -> String {
    if scale.is_some_and(|scale| is_reduced(scale, fitting)) { ", reduced".to_owned() } else { String::new() }
}

/// A frame in which a figure is drawn to scale.
pub(super) struct Plot {
    rect: Rect,
    /// From the plane of the linkage to millimetres of the area.
    pub page_from_plane: Similarity,
}

impl Plot {
    /// A plot in a frame, with space for the scale bar at its foot; its scale is not set yet.
    pub fn new(frame: Rect, theme: &Theme) -> Plot {
        let foot = 1.6 * theme.note_size;
        // Even if the scale bar needs the whole frame, the plot has a positive size.
        let inner = Rect { size: Vector::new(frame.size.x, (frame.size.y - foot).max(0.2 * frame.size.y)), ..frame };
        Plot {
            rect: inner.inset(2.0 * theme.joint_radius),
            page_from_plane: Similarity::page_from_plane(Bounds::EMPTY, frame.centre(), 1.0),
        }
    }

    /// A plot that fills a frame, without space for a scale bar; its scale is not set yet.
    pub fn whole(frame: Rect) -> Plot {
        Plot { rect: frame, page_from_plane: Similarity::page_from_plane(Bounds::EMPTY, frame.centre(), 1.0) }
    }

    /// The plot with the scale at which `bounds` fills the frame, centred.
    pub fn fitted_to(self, bounds: Bounds) -> Plot {
        let scale = self.rect.fit_scale(bounds);
        Plot { page_from_plane: Similarity::page_from_plane(bounds, self.rect.centre(), scale), ..self }
    }

    /// The plot with a scale in millimetres to a unit, with `bounds` at its centre, or with the one at which they fill the frame if
    /// there is none or it is greater; and the scale at which they do.
    pub fn at_scale(self, bounds: Bounds, scale: Option<f64>) -> (Plot, f64) {
        let fitted = self.fitted_to(bounds);
        let fitting = fitted.page_from_plane.scale();
        match scale.filter(|scale| !is_reduced(*scale, fitting)) {
            Some(scale) => {
                let page_from_plane = Similarity::page_from_plane(bounds, fitted.rect.centre(), scale);
                (Plot { page_from_plane, ..fitted }, fitting)
            }
            None => (fitted, fitting),
        }
    }

    /// The frame without its foot, where the scale bar is, but with the margin around the figure.
    pub fn rect_above_scale_bar(&self, theme: &Theme) -> Rect {
        let margin = Vector::repeat(2.0 * theme.joint_radius);
        Rect { corner: self.rect.corner - margin, size: self.rect.size + margin * 2.0 }
    }

    /// The least width of a frame that has room for a scale bar and a short remark on the scale.
    pub fn min_width(theme: &Theme) -> f64 {
        10.0 * theme.small_size() + 4.0 * theme.joint_radius
    }

    /// Draws a scale bar under the frame: the largest round number of units up to a fifth of the frame's width. The first
    /// remark on the scale that fits follows its label, or else the last.
    pub fn draw_scale_bar(&self, area: &impl Area, unit: Option<LengthUnit>, remarks: &[String], theme: &Theme) {
        let scale = self.page_from_plane.scale();
        let units = round_number_below(0.2 * self.rect.size.x / scale);
        let length = units * scale;
        let label = unit.map_or(units.to_string(), |unit| format!("{units} {}", unit.symbol()));
        let size = theme.small_size();
        let at =
            Point::new(self.rect.centre().x, self.rect.corner.y + self.rect.size.y + 2.2 * theme.joint_radius + size);
        let gap = 0.4 * size;
        let text = |remark: &str| {
            theme.text_line(&format!("{label}{remark}"), Point::origin(), Anchor::Start, size, theme.grey)
        };
        let fits = |remark: &&String| length + gap + text(remark).text.width() <= self.rect.size.x;
        let text = text(remarks.iter().find(fits).or(remarks.last()).map_or("", String::as_str));
        let left = at.x - (length + gap + text.text.width()) / 2.0;
        let tick = 0.3 * size;
        let y = at.y - 0.35 * size;
        let line = |a: (f64, f64), b: (f64, f64)| Polyline {
            points: vec![Point::new(a.0, a.1), Point::new(b.0, b.1)],
            is_closed: false,
        };
        let lines = vec![
            line((left, y), (left + length, y)),
            line((left, y - tick), (left, y + tick)),
            line((left + length, y - tick), (left + length, y + tick)),
        ];
        let stroke = Some(theme.stroke(theme.grey, theme.hair_width));
        let bar = Item::Path(Path { polylines: lines, stroke, fill: None });
        let text = Item::Text(Text { position: Point::new(left + length + gap, at.y), ..text.text });
        area.record(Drawing { class: "scale", title: format!("scale bar: {label}"), items: vec![bar, text] });
    }
}

/// The greatest of 1, 2 and 5 times a power of ten that is not above `x`; 1 if `x` is not between 1e-12 and 1e12.
pub(super) fn round_number_below(x: f64) -> f64 {
    if !(1e-12..=1e12).contains(&x) {
        return 1.0;
    }
    /// In rising order.
    static ROUND: LazyLock<Vec<f64>> = LazyLock::new(|| {
        let number = |digit: i32, power: i32| format!("{digit}e{power}").parse().unwrap_or(1.0);
        (-12..=12).flat_map(|power| [1, 2, 5].map(|digit| number(digit, power))).collect()
    });
    ROUND[ROUND.partition_point(|round| *round <= x).max(1) - 1]
}

/// The greatest distance of a spline from its curve, in millimetres on paper. With the rounding to 1/1000 mm, a page can
/// be compared with its samples to 0.01 mm.
pub(super) const MAX_CURVE_ERROR: f64 = 0.009;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_are_round() {
        for (x, round) in [(1.0, 1.0), (1.9, 1.0), (0.7, 0.5), (27.0, 20.0), (0.0, 1.0), (f64::NAN, 1.0)] {
            assert_eq!(round_number_below(x), round);
        }
    }
}
