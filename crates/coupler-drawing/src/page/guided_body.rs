//! A body that a linkage is to guide, as pages show it.

use coupler_curves::geometry::{Bounds, Point, Vector, left_normal, trig};

/// A body that a linkage is to guide.
#[derive(Clone, Debug, Default)]
pub struct GuidedBody {
    /// Its poses, in the order of their numbers.
    pub poses: Vec<BodyFrame>,
    /// Where the pivots and pins of linkages that guide it can be. Lines do not widen the view.
    pub places: Vec<BodyPlaces>,
}

/// A pose of a body, as the axes that are fixed to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyFrame {
    /// The place of its point.
    pub origin: Point,
    /// The angle from the x-axis to that of the body, in degrees, counterclockwise.
    pub angle_deg: f64,
}

/// Places that belong to poses: of pivots, of pins, or poles.
#[derive(Clone, Debug, Default)]
pub struct BodyPlaces {
    /// Polylines, of short parts: those that are not in view are left out.
    pub lines: Vec<Vec<Point>>,
    /// Single places, each with its name, which may be empty.
    pub marks: Vec<(Point, String)>,
    /// What the legend says of them.
    pub label: String,
    /// Whether their lines are lighter than others.
    pub is_light: bool,
}

impl GuidedBody {
    /// Of how many poses one is drawn: axes of more would hide each other. The last is drawn in any case.
    pub(super) fn step(&self) -> usize {
        const MOST: usize = 24;
        self.poses.len().div_ceil(MOST).max(1)
    }

    /// The bounds of a drawing with the poses, and with those single places that are not far away.
    pub(super) fn bounds(&self, of_linkage: Bounds) -> Bounds {
        /// Of the size of the drawing without them.
        const FAR: f64 = 0.6;
        /// About the length of axes, of that size.
        const AXES: f64 = 0.05;
        let bounds = of_linkage.union(Bounds::from_points(self.poses.iter().map(|pose| pose.origin)));
        let length = AXES * bounds.size().max();
        let ends = |pose: &BodyFrame| {
            let (cos, sin) = trig::cos_sin_deg(pose.angle_deg.rem_euclid(360.0));
            let along = Vector::new(cos, sin) * length;
            [pose.origin + along, pose.origin + left_normal(along) * 0.6]
        };
        let bounds = bounds.union(Bounds::from_points(self.poses.iter().flat_map(ends)));
        let reach = Vector::repeat(FAR * bounds.size().max());
        let (low, high) = (bounds.min - reach, bounds.max + reach);
        let is_near = |p: &Point| p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y;
        let marks = self.places.iter().flat_map(|places| &places.marks).map(|(at, _)| *at);
        bounds.union(Bounds::from_points(marks.filter(is_near)))
    }
}
