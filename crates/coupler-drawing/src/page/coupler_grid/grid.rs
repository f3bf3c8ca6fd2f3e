//! Grids of traced points: hairlines through the points, and the line of the two joints they are placed from.

use super::super::plot::Plot;
use super::super::theme::Theme;
use crate::scene::{Item, Path, Polyline};
use coupler_curves::geometry::{Bounds, Point, Vector, cross, left_normal};
use coupler_curves::linkage::{JointId, JointKind, Linkage};

/// The grids of a linkage, one for each base or sliding body that traced points are placed on.
pub(super) struct PointGrids {
    grids: Vec<PointGrid>,
}

/// The grid of the points of one link.
struct PointGrid {
    /// The joint of the link that the coordinates are measured from.
    origin: JointId,
    axes: GridAxes,
    /// The coordinates of its lines along the axis and to the left of it, ascending.
    coordinates: [Vec<f64>; 2],
}

/// How the axis of a grid lies in a pose.
#[derive(Clone, Copy)]
enum GridAxes {
    /// Towards a second joint of the link; coordinates are multiples of its distance.
    Base(JointId),
    /// On a link that slides, in the direction in which one of its points has these coordinates, which are lengths.
    Sliding(JointId, Vector),
}

impl PointGrids {
    /// The grids that some traced joints lie on, except joints that are part of the outline of a link.
    pub fn from_joints(linkage: &Linkage, joints: impl Iterator<Item = JointId>) -> PointGrids {
        let outlined: Vec<JointId> = linkage.link_outlines().into_iter().flat_map(|outline| outline.joints).collect();
        let mut grids: Vec<PointGrid> = Vec::new();
        for joint in joints.filter(|joint| !outlined.contains(joint)) {
            let (origin, axes, [along, across]) = match linkage.joints[joint].kind {
                JointKind::Rigid { base: [origin, to], along, across } => (origin, GridAxes::Base(to), [along, across]),
                JointKind::Aligned { from, along, across, .. } => {
                    (from, GridAxes::Sliding(joint, Vector::new(along, across)), [along, across])
                }
                _ => continue,
            };
            let known = grids.iter().position(|grid| grid.origin == origin && grid.axes.is_of_link(axes));
            let index = known.unwrap_or_else(|| {
                grids.push(PointGrid { origin, axes, coordinates: [Vec::new(), Vec::new()] });
                grids.len() - 1
            });
            grids[index].axes = grids[index].axes.more_exact(axes);
            for (values, value) in grids[index].coordinates.iter_mut().zip([along, across]) {
                if !values.contains(&value) {
                    values.push(value);
                }
            }
        }
        for values in grids.iter_mut().flat_map(|grid| &mut grid.coordinates) {
            values.sort_by(f64::total_cmp);
        }
        PointGrids { grids }
    }

    /// The ends of all lines in a pose.
    pub fn line_ends(&self, pose: &[Point]) -> Vec<Point> {
        self.grids.iter().flat_map(|grid| grid.lines(pose)).flatten().collect()
    }

    /// The lines in a pose.
    pub fn items(&self, pose: &[Point], plot: &Plot, theme: &Theme) -> Vec<Item> {
        let on_page = |ends: [Point; 2]| Polyline {
            points: ends.map(|p| plot.page_from_plane.apply(p)).to_vec(),
            is_closed: false,
        };
        let lines: Vec<Polyline> = self.grids.iter().flat_map(|grid| grid.lines(pose)).map(on_page).collect();
        let stroke = Some(theme.stroke(theme.hairline, theme.hair_width));
        if lines.is_empty() { Vec::new() } else { vec![Item::Path(Path { polylines: lines, stroke, fill: None })] }
    }
}

impl PointGrid {
    /// The lines through the points of each coordinate, along and across the base, and its axis. Lines across start on
    /// the axis, which extends over the points and to the nearer end of the base if they are all beyond it.
    fn lines(&self, pose: &[Point]) -> Vec<[Point; 2]> {
        let origin = pose[self.origin];
        let unit = self.axes.unit(pose, origin);
        let at = |along: f64, across: f64| origin + unit * along + left_normal(unit) * across;
        let span = |values: &[f64]| {
            let bounds = Bounds::from_points(values.iter().map(|s| Point::from(Vector::new(*s, 0.0))));
            [bounds.min.x, bounds.max.x]
        };
        let [alongs, acrosses] = &self.coordinates;
        let ([first, last], [low, high]) = (span(alongs), span(acrosses));
        let (low, high) = (low.min(0.0), high.max(0.0));
        let axis = [at(first.min(self.axes.end()), 0.0), at(last.max(0.0), 0.0)];
        let along =
            acrosses.iter().filter(|across| **across != 0.0).map(|&across| [at(first, across), at(last, across)]);
        let across = alongs.iter().map(|&along| [at(along, low), at(along, high)]);
        across.chain(along).chain([axis]).filter(|[a, b]| a != b).collect()
    }
}

impl GridAxes {
    /// Whether other axes with the same origin are those of the same link.
    fn is_of_link(self, other: GridAxes) -> bool {
        match (self, other) {
            (GridAxes::Base(to), GridAxes::Base(other)) => to == other,
            (GridAxes::Sliding(..), GridAxes::Sliding(..)) => true,
            _ => false,
        }
    }

    /// Of two points that tell the direction of a link, the one that is further from its origin.
    fn more_exact(self, other: GridAxes) -> GridAxes {
        match (self, other) {
            (GridAxes::Sliding(_, own), GridAxes::Sliding(_, at)) if at.norm() > own.norm() => other,
            _ => self,
        }
    }

    /// A step of 1 along the axis in a pose.
    fn unit(self, pose: &[Point], origin: Point) -> Vector {
        match self {
            GridAxes::Base(to) => pose[to] - origin,
            GridAxes::Sliding(joint, at) => {
                let placed = pose[joint] - origin;
                Vector::new(placed.dot(&at), cross(at, placed)) / at.norm_squared().max(f64::MIN_POSITIVE)
            }
        }
    }

    /// The coordinate of the far end of the base; a link that slides has none.
    fn end(self) -> f64 {
        if matches!(self, GridAxes::Base(_)) { 1.0 } else { 0.0 }
    }
}
