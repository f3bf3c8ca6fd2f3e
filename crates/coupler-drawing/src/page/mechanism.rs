//! The linkage of a figure: links as lines and plates, pivots, gears, sliders with their guides, slots, actuators.

use super::plot::Plot;
use super::theme::Theme;
use crate::mechanism::{Block, Mechanism};
use crate::scene::{Circle, Color, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Bounds, Point, Vector, left_normal, trig};
use coupler_curves::linkage::{JointId, JointKind, LinkOutline, Linkage, is_plate};

/// A linkage in a pose.
pub(super) struct PosedMechanism<'a> {
    pub linkage: &'a Linkage,
    pub mechanism: Mechanism,
    /// The positions of all joints.
    pub pose: Vec<Point>,
}

impl<'a> PosedMechanism<'a> {
    /// A linkage with its parts in a pose.
    pub fn new(linkage: &'a Linkage, mechanism: Mechanism, pose: Vec<Point>) -> PosedMechanism<'a> {
        PosedMechanism { linkage, mechanism, pose }
    }

    /// The ink of a link between these joints, if it is that of a chain and not of the theme.
    fn link_ink(&self, joints: &[JointId], theme: &Theme) -> Option<Color> {
        let is_between = |chain: &Vec<JointId>| joints.iter().all(|joint| chain.contains(joint));
        self.linkage.chains.iter().position(is_between).map(|chain| chain_ink(chain, theme))
    }

    /// Whether a joint that is drawn is drawn as a pin: one that is, or that is traced.
    pub fn is_pin(&self, joint: JointId) -> bool {
        self.linkage.is_pin(joint) || self.linkage.traced.contains(&joint)
    }

    /// Whether a joint is that of a yoke.
    pub fn is_yoke(&self, joint: JointId) -> bool {
        matches!(self.linkage.joints[joint].kind, JointKind::Yoke { .. })
    }

    /// The directions of input 0 and of input 90 degrees in the plane: the axes of the frame that the linkage is defined in,
    /// which may move in the pose. `None` if it has no two fixed joints apart.
    pub fn input_axes(&self) -> Option<(Vector, Vector)> {
        let fixed = |joint: JointId| match self.linkage.joints[joint].kind {
            JointKind::Fixed(position) => Some((position, self.pose[joint])),
            _ => None,
        };
        let mut fixed = self.linkage.joint_ids().filter_map(fixed);
        let (first, first_posed) = fixed.next()?;
        let (other, other_posed) = fixed.find(|(other, _)| (other - first).norm() > 0.0)?;
        let [defined, posed] = [other - first, other_posed - first_posed];
        let handedness = self.linkage.placement.handedness();
        // Of the x-axis relative to the line between the joints, which a mirror image reverses.
        let unit = defined.normalize();
        let (cos, sin) = (unit.x, -unit.y * handedness);
        let posed = posed.try_normalize(0.0)?;
        let zero = posed * cos + left_normal(posed) * sin;
        Some((zero, left_normal(zero) * handedness))
    }

    /// The joints that are drawn, each once.
    pub fn drawn_joints(&self) -> Vec<JointId> {
        self.mechanism.drawn_joints(self.linkage)
    }

    /// The bounds of everything that is drawn of the linkage.
    pub fn bounds(&self) -> Bounds {
        self.mechanism.bounds(&self.pose)
    }

    /// The items under the curves: the bodies of plates, the frame as a hairline, pitch circles and guides.
    pub fn underlay_items(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        let at = |joint: &JointId| plot.page_from_plane.apply(self.pose[*joint]);
        let mut items = Vec::new();
        for LinkOutline { joints, .. } in &self.mechanism.links {
            let points: Vec<Point> = joints.iter().map(at).collect();
            if is_plate(&points) {
                let body = self.link_ink(joints, theme).map_or(theme.hairline, |ink| theme.faded(ink));
                let fill = Some(theme.faded(theme.faded(body)));
                items.push(Item::Path(Path {
                    polylines: vec![Polyline { points, is_closed: true }],
                    stroke: None,
                    fill,
                }));
            }
        }
        let points: Vec<Point> = self.mechanism.pivots.iter().map(at).collect();
        if points.len() > 1 {
            let stroke = Some(theme.stroke(theme.hairline, theme.hair_width));
            // A frame with three pivots is a plate, as any other link.
            let closed = is_plate(&points);
            items.push(Item::Path(Path {
                polylines: vec![Polyline { points, is_closed: closed }],
                stroke,
                fill: None,
            }));
        }
        for gear in &self.mechanism.gears {
            let centre = plot.page_from_plane.apply(gear.centre_in(&self.pose));
            let radius = gear.radius * plot.page_from_plane.scale();
            let stroke = Some(theme.stroke(theme.grey, theme.hair_width));
            items.push(Item::Circle(Circle { centre, radius, stroke, fill: None }));
        }
        for guide in &self.mechanism.guides {
            let [a, b] = guide.ends.map(|p| plot.page_from_plane.apply(p));
            let along = (b - a).try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0));
            let over = along * (2.4 * theme.joint_radius);
            let line = |off: Vector| Polyline { points: vec![a - over + off, b + over + off], is_closed: false };
            // A yoke moves between two rails, a block on one.
            let polylines = match self.is_yoke(guide.joint) {
                true => [1.0, -1.0].map(|side| line(left_normal(along) * (side * 1.2 * theme.joint_radius))).to_vec(),
                false => vec![line(Vector::zeros())],
            };
            // Not as dark as the curve that a slider may trace on it.
            let stroke = Some(theme.stroke(theme.grey, theme.fine_width));
            items.push(Item::Path(Path { polylines, stroke, fill: None }));
        }
        items
    }

    /// The linkage in fine light lines.
    pub fn ghost_items(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        let outlines = self.mechanism.links.iter().map(|outline| &outline.joints[..]);
        let lines = outlines.chain(self.mechanism.actuators.iter().map(|joints| &joints[..]));
        let polylines = lines.map(|joints| {
            let points: Vec<Point> = joints.iter().map(|&joint| plot.page_from_plane.apply(self.pose[joint])).collect();
            let is_closed = is_plate(&points);
            Polyline { points, is_closed }
        });
        let stroke = Some(theme.stroke(theme.hairline, theme.fine_width));
        vec![Item::Path(Path { polylines: polylines.collect(), stroke, fill: None })]
    }

    /// The items over the curves: links, blocks and joints; `ink` is the colour of a joint.
    pub fn linkage_items(&self, plot: &Plot, theme: &Theme, ink: impl Fn(JointId) -> Color) -> Vec<Item> {
        let on_page = |p: Point| plot.page_from_plane.apply(p);
        let at = |joint: JointId| on_page(self.pose[joint]);
        let mut items = Vec::new();
        let heavy = Stroke { has_round_ends: true, ..theme.stroke(theme.ink, theme.link_width) };
        for &[pivot, joint] in &self.mechanism.actuators {
            let offset = match self.linkage.joints[joint].kind {
                JointKind::Piston { offset, .. } => offset * plot.page_from_plane.scale(),
                _ => 0.0,
            };
            items.extend(actuator_items(at(pivot), at(joint), offset, theme));
        }
        for LinkOutline { joints, .. } in &self.mechanism.links {
            let points: Vec<Point> = joints.iter().map(|&joint| at(joint)).collect();
            let closed = is_plate(&points);
            let stroke = Some(Stroke { color: self.link_ink(joints, theme).unwrap_or(theme.ink), ..heavy });
            items.push(Item::Path(Path {
                polylines: vec![Polyline { points, is_closed: closed }],
                stroke,
                fill: None,
            }));
        }
        let (yokes, sliders): (Vec<&Block>, Vec<&Block>) =
            self.mechanism.blocks.iter().partition(|block| self.is_yoke(block.joint));
        let placed = |Block { joint, line: [p, q] }: &Block| (at(*joint), at(*q) - at(*p));
        let mut blocks: Vec<(Point, Vector)> = sliders.into_iter().map(placed).collect();
        for (centre, line) in yokes.into_iter().map(placed) {
            // The stem of a yoke is one piece with its slot.
            let along = line.try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0)) * (3.0 * theme.joint_radius);
            items.push(Item::Path(Path::stroked(vec![centre - along, centre + along], heavy)));
        }
        for slot in &self.mechanism.slots {
            let ends = slot.ends_in(&self.pose).map(on_page);
            items.push(Item::Path(Path::stroked(vec![at(slot.foot), ends[0], ends[1]], heavy)));
            items.push(slot_item(ends, theme));
            // A slider in it has its block already.
            if self.mechanism.blocks.iter().all(|block| block.joint != slot.through) {
                blocks.push((at(slot.through), ends[1] - ends[0]));
            }
        }
        items.extend(blocks.into_iter().map(|(centre, along)| block_item(centre, along, theme)));
        let circle = |centre, radius, color| {
            let stroke = Some(theme.stroke(color, theme.fine_width));
            Item::Circle(Circle { centre, radius, stroke, fill: Some(theme.paper) })
        };
        let crank_pivot = self.linkage.crank().map(|[pivot, _]| pivot);
        for joint in self.drawn_joints().into_iter().filter(|joint| self.is_pin(*joint)) {
            if self.mechanism.pivots.contains(&joint) {
                items.extend(pivot_items(at(joint), crank_pivot == Some(joint), ink(joint), theme));
            } else {
                items.push(circle(at(joint), theme.joint_radius, ink(joint)));
            }
        }
        items
    }
}

/// The ink of the links of a chain, from 0.
pub(super) fn chain_ink(chain: usize, theme: &Theme) -> Color {
    /// The first two inks are for circuits, of which a linkage rarely has more.
    const FIRST_INK: usize = 2;
    theme.curve_ink(FIRST_INK + chain)
}

/// A fixed pivot: a double circle, filled in its middle if it is the crank's.
pub(super) fn pivot_items(centre: Point, is_of_crank: bool, color: Color, theme: &Theme) -> Vec<Item> {
    let stroke = Some(theme.stroke(color, theme.fine_width));
    let circle = |radius: f64, fill| Item::Circle(Circle { centre, radius: radius * theme.joint_radius, stroke, fill });
    vec![circle(1.5, Some(theme.paper)), circle(0.7, Some(if is_of_crank { color } else { theme.paper }))]
}

/// The two joints on the line of a slot, yoke or actuator, if `joint` is placed by one.
pub(super) fn sliding_line(linkage: &Linkage, joint: JointId) -> Option<[JointId; 2]> {
    match linkage.joints[joint].kind {
        JointKind::Slot { base: [_, through], .. } => Some([joint, through]),
        JointKind::Piston { base: [pivot, _], .. } => Some([pivot, joint]),
        JointKind::Yoke { from, .. } => Some([joint, from]),
        _ => None,
    }
}

/// A linear actuator: its rod, and its cylinder on the half near `pivot`, which its line passes at a distance of `offset`.
fn actuator_items(pivot: Point, to: Point, offset: f64, theme: &Theme) -> [Item; 2] {
    let whole = to - pivot;
    // The line touches the circle of the offset about the pivot.
    let sin = offset / whole.norm();
    let is_offset = offset != 0.0 && sin.abs() < 1.0;
    let from = match is_offset {
        true => pivot + (whole * sin + left_normal(whole) * (1.0 - sin * sin).sqrt()) * sin,
        false => pivot,
    };
    let along = to - from;
    let across = left_normal(along).try_normalize(0.0).unwrap_or(Vector::zeros()) * (1.2 * theme.joint_radius);
    let (near, far) = (from + along * 0.1, from + along * 0.6);
    let points = vec![near - across, far - across, far + across, near + across];
    let stroke = Some(theme.stroke(theme.ink, theme.fine_width));
    let points_of_rod = if is_offset { vec![pivot, from, to] } else { vec![from, to] };
    let rod = Path::stroked(points_of_rod, theme.stroke(theme.ink, theme.link_width));
    let cylinder = Path { polylines: vec![Polyline { points, is_closed: true }], stroke, fill: Some(theme.paper) };
    [Item::Path(rod), Item::Path(cylinder)]
}

/// A sliding block; `along` is the direction it slides in.
fn block_item(centre: Point, along: Vector, theme: &Theme) -> Item {
    let u = along.try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0));
    let (u, n) = (u * (2.4 * theme.joint_radius), left_normal(u) * (1.5 * theme.joint_radius));
    let points = vec![centre - u - n, centre + u - n, centre + u + n, centre - u + n];
    let stroke = Some(theme.stroke(theme.ink, theme.fine_width));
    Item::Path(Path { polylines: vec![Polyline { points, is_closed: true }], stroke, fill: Some(theme.paper) })
}

/// The outline of a slot, as wide as a block, with round ends.
fn slot_item([a, b]: [Point; 2], theme: &Theme) -> Item {
    const SEGMENTS_PER_END: usize = 12;
    let radius = 1.5 * theme.joint_radius;
    let along = (b - a).try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0));
    // The slot is longer than the travel by half a block at both ends.
    let over = along * (2.4 * theme.joint_radius - radius);
    let round = |centre: Point, from: Vector| {
        (0..=SEGMENTS_PER_END).map(move |k| {
            let (cos, sin) = trig::cos_sin_deg(180.0 * k as f64 / SEGMENTS_PER_END as f64);
            centre + (from * cos + left_normal(from) * sin) * radius
        })
    };
    let normal = left_normal(along);
    let points = round(b + over, -normal).chain(round(a - over, normal)).collect();
    let stroke = Some(theme.stroke(theme.ink, theme.fine_width));
    Item::Path(Path { polylines: vec![Polyline { points, is_closed: true }], stroke, fill: Some(theme.paper) })
}
