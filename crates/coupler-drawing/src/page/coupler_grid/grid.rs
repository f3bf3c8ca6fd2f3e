//! The grid of points on a link: hairlines that join its points, and its axis.

use super::super::plot::Plot;
use super::super::theme::Theme;
use crate::scene::{Item, Path, Polyline};
use coupler_curves::geometry::{Bounds, Point, Vector, left_normal};
use coupler_curves::linkage::{JointId, JointKind, Linkage};

/// The grids of a linkage: traced points by coordinates on one base.
pub(super) struct PointGrids {
    grids: Vec<PointGrid>,
}

/// The points on one base.
struct PointGrid {
    base: [JointId; 2],
    /// The coordinates that occur along the base and to its left, in parts of the base.
    coordinates: [Vec<f64>; 2],
}

impl PointGrids {
    /// The grids that some traced joints stand on; a joint that a link is drawn to needs none.
    pub fn from_joints(linkage: &Linkage, joints: impl Iterator<Item = JointId>) -> PointGrids {
        let drawn: Vec<JointId> = linkage.link_outlines().into_iter().flat_map(|outline| outline.joints).collect();
        let mut sheets: Vec<PointGrid> = Vec::new();
        for joint in joints.filter(|joint| !drawn.contains(joint)) {
            let JointKind::Rigid { base, along, across } = linkage.joints[joint].kind else { continue };
            let known = sheets.iter().position(|sheet| sheet.base == base);
            let at = known.unwrap_or_else(|| {
                sheets.push(PointGrid { base, coordinates: [Vec::new(), Vec::new()] });
                sheets.len() - 1
            });
            for (stations, value) in sheets[at].coordinates.iter_mut().zip([along, across]) {
                if !stations.contains(&value) {
                    stations.push(value);
                }
            }
        }
        for stations in sheets.iter_mut().flat_map(|sheet| &mut sheet.coordinates) {
            stations.sort_by(f64::total_cmp);
        }
        PointGrids { grids: sheets }
    }

    /// The ends of its lines in a pose.
    pub fn line_ends(&self, pose: &[Point]) -> Vec<Point> {
        self.grids.iter().flat_map(|sheet| sheet.lines(pose)).flatten().collect()
    }

    /// Its lines in a pose.
    pub fn items(&self, pose: &[Point], plot: &Plot, theme: &Theme) -> Vec<Item> {
        let on_page = |ends: [Point; 2]| Polyline {
            points: ends.map(|p| plot.page_from_plane.apply(p)).to_vec(),
            is_closed: false,
        };
        let lines: Vec<Polyline> = self.grids.iter().flat_map(|sheet| sheet.lines(pose)).map(on_page).collect();
        let stroke = Some(theme.stroke(theme.hairline, theme.hair_width));
        if lines.is_empty() { Vec::new() } else { vec![Item::Path(Path { polylines: lines, stroke, fill: None })] }
    }
}

impl PointGrid {
    /// A line through all points of a station, along and across; those across begin on the axis of the link, which is
    /// drawn as far as the points reach, and from the link to them.
    fn lines(&self, pose: &[Point]) -> Vec<[Point; 2]> {
        let (origin, unit) = (pose[self.base[0]], pose[self.base[1]] - pose[self.base[0]]);
        let at = |along: f64, across: f64| origin + unit * along + left_normal(unit) * across;
        let span = |stations: &[f64]| {
            let bounds = Bounds::from_points(stations.iter().map(|s| Point::from(Vector::new(*s, 0.0))));
            [bounds.min.x, bounds.max.x]
        };
        let [alongs, acrosses] = &self.coordinates;
        let ([first, last], [low, high]) = (span(alongs), span(acrosses));
        let (low, high) = (low.min(0.0), high.max(0.0));
        // The nearest of the link's ends where all points are beyond one of them.
        let axis = [at(first.min(1.0), 0.0), at(last.max(0.0), 0.0)];
        let along =
            acrosses.iter().filter(|across| **across != 0.0).map(|&across| [at(first, across), at(last, across)]);
        let across = alongs.iter().map(|&along| [at(along, low), at(along, high)]);
        across.chain(along).chain([axis]).filter(|[a, b]| a != b).collect()
    }
}
