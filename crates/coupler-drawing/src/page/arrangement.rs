//! The arrangement of curve and linkage in a panel: one figure of both, or a large curve with the linkage as its key.

use coupler_curves::geometry::{Bounds, Point, Vector};

/// A rectangle of an area, in millimetres from its upper left corner, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub corner: Point,
    pub size: Vector,
}

impl Rect {
    pub fn centre(&self) -> Point {
        self.corner + self.size / 2.0
    }

    /// The scale at which `bounds` fills the rectangle, in millimetres to a unit; 1 if `bounds` is a single point.
    pub fn fit_scale(&self, bounds: Bounds) -> f64 {
        let size = bounds.size();
        let across = if size.x > 0.0 { self.size.x / size.x } else { f64::INFINITY };
        let down = if size.y > 0.0 { self.size.y / size.y } else { f64::INFINITY };
        match across.min(down) {
            scale if scale.is_finite() => scale,
            _ => 1.0,
        }
    }

    /// Equal parts of the rectangle, side by side along its longer side.
    pub fn divide(&self, count: usize) -> Vec<Rect> {
        let is_wide = self.size.x >= self.size.y;
        let part = 1.0 / count as f64;
        let step = if is_wide { Vector::new(part * self.size.x, 0.0) } else { Vector::new(0.0, part * self.size.y) };
        let size = if is_wide { Vector::new(step.x, self.size.y) } else { Vector::new(self.size.x, step.y) };
        (0..count).map(|k| Rect { corner: self.corner + step * k as f64, size }).collect()
    }

    /// The rectangle without a border of `width`, at most a third of its size on each side.
    pub fn inset(&self, width: f64) -> Rect {
        let border = Vector::new(width.min(self.size.x / 3.0), width.min(self.size.y / 3.0));
        Rect { corner: self.corner + border, size: self.size - border * 2.0 }
    }
}

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
    fn curve_scale(&self, rect: Rect, gap: f64) -> f64 {
        let frames = rect.divide(self.curves.len());
        let scales = frames.into_iter().zip(&self.curves).map(|(frame, bounds)| frame.inset(gap).fit_scale(*bounds));
        scales.fold(f64::INFINITY, f64::min)
    }
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
    fn merit(self, whole: Rect, gap: f64, extents: &Extents) -> f64 {
        let best = whole.inset(gap);
        let greatest = extents.curves.iter().map(|bounds| best.fit_scale(*bounds)).fold(f64::INFINITY, f64::min);
        let [curve, key] = self.rects(whole);
        let key = key.inset(gap).fit_scale(extents.linkage);
        // One figure is easier to read than two, so a small gain is not enough to divide it.
        let curve = if self == Arrangement::Combined { return 1.25 * key / greatest } else { curve };
        extents.curve_scale(curve, gap) / greatest * (key / best.fit_scale(extents.linkage)).sqrt()
    }

    /// The enlargement of the curves relative to their key.
    fn enlargement(self, whole: Rect, gap: f64, extents: &Extents) -> f64 {
        let [curve, key] = self.rects(whole);
        extents.curve_scale(curve, gap) / key.inset(gap).fit_scale(extents.linkage)
    }

    /// The arrangement of a panel: this one if it enlarges the curve to at least twice the size it has in its key,
    /// otherwise a single figure.
    pub fn if_enlarging(self, whole: Rect, gap: f64, extents: &Extents) -> Arrangement {
        const MIN_ENLARGEMENT: f64 = 2.0;
        if self.enlargement(whole, gap, extents) >= MIN_ENLARGEMENT { self } else { Arrangement::Combined }
    }

    /// The arrangement for the panels of a page: the one with the greatest least merit, of those that enlarge the curves
    /// of at least half of the panels.
    pub fn best(whole: Rect, gap: f64, panels: &[Extents]) -> Arrangement {
        const PARTS: [f64; 7] = [0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55];
        let divided = PARTS.map(Arrangement::Stacked).into_iter().chain(PARTS.map(Arrangement::SideBySide));
        let of_panel = |arrangement: Arrangement, extents: &Extents| arrangement.if_enlarging(whole, gap, extents);
        let is_worthwhile = |candidate: &Arrangement| {
            let enlarged = panels.iter().filter(|extents| of_panel(*candidate, extents) == *candidate);
            2 * enlarged.count() >= panels.len()
        };
        let worst = |arrangement: Arrangement| {
            let merit = |extents| of_panel(arrangement, extents).merit(whole, gap, extents);
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

    fn bounds(x: f64, y: f64, w: f64, h: f64) -> Bounds {
        Bounds::from_points([Point::new(x, y), Point::new(x + w, y + h)])
    }

    #[test]
    fn a_small_curve_is_separated_from_its_linkage_and_a_large_one_is_not() {
        let whole = Rect { corner: Point::origin(), size: Vector::new(76.0, 90.0) };
        // Evans at p = 6: 4 wide and 0.4 high on a linkage of 8 by 20.
        let small = Extents { curves: vec![bounds(2.0, 19.0, 4.0, 0.4)], linkage: bounds(-1.0, 0.0, 8.0, 20.0) };
        assert!(matches!(Arrangement::best(whole, 2.0, &[small]), Arrangement::Stacked(_)));
        let large = Extents { curves: vec![bounds(0.0, -2.0, 3.0, 4.0)], linkage: bounds(-1.0, -2.0, 5.0, 4.0) };
        assert_eq!(Arrangement::best(whole, 2.0, &[large]), Arrangement::Combined);
    }

    #[test]
    fn small_curves_far_from_each_other_are_enlarged_in_frames_of_their_own() {
        let whole = Rect { corner: Point::origin(), size: Vector::new(76.0, 90.0) };
        let linkage = bounds(0.0, 0.0, 10.0, 10.0);
        let apart = [bounds(0.0, 0.0, 0.01, 0.01), bounds(9.0, 9.0, 0.01, 0.01)];
        let arrange = |curves: Vec<Bounds>| Arrangement::best(whole, 2.0, &[Extents { curves, linkage }]);
        assert_eq!(arrange(vec![apart[0].union(apart[1])]), Arrangement::Combined);
        assert_ne!(arrange(apart.to_vec()), Arrangement::Combined);
    }
}
