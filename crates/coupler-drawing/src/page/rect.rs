//! Rectangles of an area.

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

    /// Whether a point is in it.
    pub fn contains(&self, p: &Point) -> bool {
        let far = p - self.corner;
        (0.0..=self.size.x).contains(&far.x) && (0.0..=self.size.y).contains(&far.y)
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
