//! The arrangement of curve and linkage in a panel: one figure of both, or a large curve with the linkage as its key.

use super::plot::{Plot, SCALE_ROUNDING};
use super::rect::Rect;
use super::theme::Theme;
use coupler_curves::geometry::{Bounds, Vector};

/// The division of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Arrangement {
    /// Curve and linkage on one figure, at one scale.
    Combined,
    /// The curve above its key, with this fraction of the height.
    Stacked(f64),
    /// The curve to the left of its key, with this fraction of the width.
    SideBySide(f64),
}

/// The bounds of what a panel shows, in the plane of the linkage.
#[derive(Clone, Debug)]
pub(super) struct Extents {
    /// The curves that are drawn in one frame each if they are apart from the linkage; at least one.
    pub curves: Vec<Bounds>,
    /// The linkage in its poses, with the curves.
    pub linkage: Bounds,
}

impl Extents {
    /// The scale at which each of the curves fits a frame of its own, all of which together are `rect`.
    fn curve_scale(&self, rect: Rect, theme: &Theme) -> f64 {
        let frames = rect.divide(self.curves.len()).into_iter();
        frames.zip(&self.curves).map(|(frame, bounds)| fit_scale(frame, *bounds, theme)).fold(f64::INFINITY, f64::min)
    }
}

/// The scale at which `bounds` is drawn in a frame, which has a scale bar.
fn fit_scale(frame: Rect, bounds: Bounds, theme: &Theme) -> f64 {
    Plot::new(frame, theme).fitted_to(bounds).page_from_plane.scale()
}

impl Arrangement {
    /// The rectangles of the curve and of the key; both are the whole if they are combined.
    pub fn rects(self, whole: Rect) -> [Rect; 2] {
        let (corner, size) = (whole.corner, whole.size);
        let part = |x: f64, y: f64, w: f64, h: f64| Rect {
            corner: corner + Vector::new(x * size.x, y * size.y),
            size: Vector::new(w * size.x, h * size.y),
        };
        match self {
            Arrangement::Combined => [whole, whole],
            Arrangement::Stacked(f) => [part(0.0, 0.0, 1.0, f), part(0.0, f, 1.0, 1.0 - f)],
            Arrangement::SideBySide(f) => [part(0.0, 0.0, f, 1.0), part(f, 0.0, 1.0 - f, 1.0)],
        }
    }

    /// The merit of an arrangement: the scale of the curve relative to the largest possible one, times the square root
    /// of the same ratio for the key.
    fn merit(self, whole: Rect, theme: &Theme, extents: &Extents) -> f64 {
        let greatest =
            extents.curves.iter().map(|bounds| fit_scale(whole, *bounds, theme)).fold(f64::INFINITY, f64::min);
        let [curve, key] = self.rects(whole);
        let key = fit_scale(key, extents.linkage, theme);
        // One figure is easier to read than two, so a small gain is not enough to divide it.
        let curve = if self == Arrangement::Combined { return 1.25 * key / greatest } else { curve };
        extents.curve_scale(curve, theme) / greatest * (key / fit_scale(whole, extents.linkage, theme)).sqrt()
    }

    /// The arrangement of a panel: this one if it shows each curve at least twice as large as in its key, which keeps the
    /// scale of the page, and has room for the labels of its scales; otherwise a single figure. The themes are those of
    /// the curves and of the key.
    pub fn if_enlarging(
        self,
        whole: Rect,
        page_scale: Option<f64>,
        [of_curve, of_key]: [&Theme; 2],
        extents: &Extents,
    ) -> Arrangement {
        const MIN_ENLARGEMENT: f64 = 2.0;
        /// The least size of a linkage apart from its curves, in ems of a note: its joints are then distinct.
        const MIN_LINKAGE: f64 = 7.0;
        let [curve, key] = self.rects(whole);
        let key_scale = fit_scale(key, extents.linkage, of_key);
        if page_scale.is_some_and(|scale| key_scale < scale * (1.0 - SCALE_ROUNDING)) {
            return Arrangement::Combined;
        }
        let enlargement = extents.curve_scale(curve, of_curve) / page_scale.unwrap_or(key_scale);
        let narrowest = curve.divide(extents.curves.len()).into_iter().chain([key]).map(|frame| frame.size.x);
        // At the scale of the page the linkage is as large on a single figure.
        let is_seen =
            page_scale.is_some() || key_scale * extents.linkage.size().max() >= MIN_LINKAGE * of_key.note_size;
        let is_legible = narrowest.fold(f64::INFINITY, f64::min) >= Plot::min_width(of_curve) && is_seen;
        if enlargement >= MIN_ENLARGEMENT && is_legible { self } else { Arrangement::Combined }
    }

    /// The arrangement for the panels of a page: the one with the greatest least merit, of those that enlarge the curves
    /// of at least half of the panels.
    pub fn best(whole: Rect, page_scale: Option<f64>, theme: &Theme, panels: &[Extents]) -> Arrangement {
        const PARTS: [f64; 7] = [0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55];
        let divided = PARTS.map(Arrangement::Stacked).into_iter().chain(PARTS.map(Arrangement::SideBySide));
        let of_panel = |arrangement: Arrangement, extents: &Extents| {
            arrangement.if_enlarging(whole, page_scale, [theme; 2], extents)
        };
        let is_worthwhile = |candidate: &Arrangement| {
            let enlarged = panels.iter().filter(|extents| of_panel(*candidate, extents) == *candidate);
            2 * enlarged.count() >= panels.len()
        };
        let worst = |arrangement: Arrangement| {
            let merit = |extents| of_panel(arrangement, extents).merit(whole, theme, extents);
            panels.iter().map(merit).fold(f64::INFINITY, f64::min)
        };
        let candidates = std::iter::once(Arrangement::Combined).chain(divided.filter(is_worthwhile));
        let mut best = (Arrangement::Combined, f64::NEG_INFINITY);
        for candidate in candidates {
            let merit = worst(candidate);
            if merit > best.1 {
                best = (candidate, merit);
            }
        }
        best.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::geometry::Point;

    fn bounds(x: f64, y: f64, w: f64, h: f64) -> Bounds {
        Bounds::from_points([Point::new(x, y), Point::new(x + w, y + h)])
    }

    #[test]
    fn a_small_curve_is_separated_from_its_linkage_and_a_large_one_is_not() {
        let whole = Rect { corner: Point::origin(), size: Vector::new(76.0, 90.0) };
        // Evans at p = 6: 4 wide and 0.4 high on a linkage of 8 by 20.
        let small = Extents { curves: vec![bounds(2.0, 19.0, 4.0, 0.4)], linkage: bounds(-1.0, 0.0, 8.0, 20.0) };
        assert!(matches!(Arrangement::best(whole, None, &Theme::default(), &[small]), Arrangement::Stacked(_)));
        let large = Extents { curves: vec![bounds(0.0, -2.0, 3.0, 4.0)], linkage: bounds(-1.0, -2.0, 5.0, 4.0) };
        assert_eq!(Arrangement::best(whole, None, &Theme::default(), &[large]), Arrangement::Combined);
    }

    #[test]
    fn small_curves_far_from_each_other_are_enlarged_in_frames_of_their_own() {
        let whole = Rect { corner: Point::origin(), size: Vector::new(76.0, 90.0) };
        let linkage = bounds(0.0, 0.0, 10.0, 10.0);
        let apart = [bounds(0.0, 0.0, 0.01, 0.01), bounds(9.0, 9.0, 0.01, 0.01)];
        let arrange =
            |curves: Vec<Bounds>| Arrangement::best(whole, None, &Theme::default(), &[Extents { curves, linkage }]);
        assert_eq!(arrange(vec![apart[0].union(apart[1])]), Arrangement::Combined);
        assert_ne!(arrange(apart.to_vec()), Arrangement::Combined);
    }
}
