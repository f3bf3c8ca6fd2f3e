//! The linkage of a figure: links as lines and plates, pivots, gears, sliders with their guides, slots, actuators.

use super::plot::Plot;
use super::theme::Theme;
use crate::scene::{Circle, Color, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Bounds, Point, Vector, cross, left_normal, trig};
use coupler_curves::linkage::{JointId, JointKind, LinkId, LinkOutline, Linkage, is_plate};
use coupler_curves::motion::Circuit;

/// A linkage in a pose.
pub(super) struct Mechanism<'a> {
    linkage: &'a Linkage,
    /// The positions of all joints.
    pub pose: Vec<Point>,
    /// The ends of the guides of sliders on the frame, of each the part that the slider uses.
    guides: Vec<[Point; 2]>,
    slots: Vec<Slot>,
    /// The links drawn in the ink of a curve: index of the link, index of the ink.
    link_inks: &'a [(LinkId, usize)],
}

/// A slot in a moving link: the part of the line that the joint in it uses.
struct Slot {
    /// The ends of the slot.
    ends: [Point; 2],
    /// The foot of the line, or the joint of the yoke.
    foot: Point,
    /// The joint that slides in it.
    block: Point,
}

impl<'a> Mechanism<'a> {
    /// A linkage in one pose of a circuit, with some links in the inks of curves.
    pub fn new(
        linkage: &'a Linkage,
        circuit: &Circuit,
        pose: Vec<Point>,
        inks: &'a [(LinkId, usize)],
    ) -> Mechanism<'a> {
        let guides = linkage.joint_ids().filter_map(|joint| find_guide(linkage, circuit, joint)).collect();
        let slots = linkage.joint_ids().filter_map(|joint| find_slot(linkage, circuit, &pose, joint)).collect();
        Mechanism { linkage, pose, guides, slots, link_inks: inks }
    }

    /// The ink of a link, if it is not the ink of the theme.
    fn link_ink(&self, link: LinkId, theme: &Theme) -> Option<Color> {
        self.link_inks.iter().find(|(inked, _)| *inked == link).map(|&(_, ink)| theme.curve_ink(ink))
    }

    /// The pitch circles of gears, centred on the pivots of both cranks. Gears that turn in the same direction mesh
    /// over an idler, which is not drawn, so there is a gap between them.
    fn pitch_circles(&self) -> Vec<(Point, f64)> {
        let joints = &self.linkage.joints;
        let crank = joints.iter().find_map(|joint| match joint.kind {
            JointKind::Crank { pivot, .. } => Some(pivot),
            _ => None,
        });
        let mut circles = Vec::new();
        for joint in joints {
            if let (JointKind::Gear { pivot, ratio: [turns, crank_turns], .. }, Some(first)) = (joint.kind, crank) {
                let distance = (self.pose[pivot] - self.pose[first]).norm();
                let filled_part = if turns < 0 { 1.0 } else { 0.8 };
                // The slower gear is the larger one.
                let [own, other] = [crank_turns.abs() as f64, turns.abs() as f64]
                    .map(|n| filled_part * distance * n / (turns.abs() + crank_turns.abs()) as f64);
                circles.extend([(self.pose[pivot], own), (self.pose[first], other)]);
            }
        }
        circles
    }

    /// The bounds of everything that is drawn of the linkage.
    pub fn bounds(&self) -> Bounds {
        let gears = self
            .pitch_circles()
            .into_iter()
            .flat_map(|(centre, radius)| [centre - Vector::repeat(radius), centre + Vector::repeat(radius)]);
        let joints =
            self.linkage.link_outlines().into_iter().flat_map(|outline| outline.joints).chain(self.linkage.pivots());
        let joints = joints.map(|joint| self.pose[joint]);
        let slots = self.slots.iter().flat_map(|slot| slot.ends);
        Bounds::from_points(joints.chain(self.guides.iter().flatten().copied()).chain(gears).chain(slots))
    }

    /// The items under the curves: the bodies of plates, the frame as a hairline, pitch circles and guides.
    pub fn underlay_items(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        let at = |joint: &JointId| plot.page_from_plane.apply(self.pose[*joint]);
        let mut items = Vec::new();
        for LinkOutline { link, joints } in self.linkage.link_outlines() {
            let points: Vec<Point> = joints.iter().map(at).collect();
            if is_plate(&points) {
                let body = self.link_ink(link, theme).map_or(theme.hairline, |ink| theme.faded(ink));
                let fill = Some(theme.faded(theme.faded(body)));
                items.push(Item::Path(Path {
                    polylines: vec![Polyline { points, is_closed: true }],
                    stroke: None,
                    fill,
                }));
            }
        }
        let points: Vec<Point> = self.linkage.pivots().iter().map(at).collect();
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
        for (centre, radius) in self.pitch_circles() {
            let (centre, radius) = (plot.page_from_plane.apply(centre), radius * plot.page_from_plane.scale);
            let stroke = Some(theme.stroke(theme.grey, theme.hair_width));
            items.push(Item::Circle(Circle { centre, radius, stroke, fill: None }));
        }
        for guide in &self.guides {
            let [a, b] = guide.map(|p| plot.page_from_plane.apply(p));
            let over = (b - a).try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0)) * (2.4 * theme.joint_radius);
            items.push(Item::Path(Path::stroked(vec![a - over, b + over], theme.stroke(theme.ink, theme.fine_width))));
        }
        items
    }

    /// The items over the curves: links, blocks and joints; `ink` is the colour of a joint.
    pub fn linkage_items(&self, plot: &Plot, theme: &Theme, ink: impl Fn(JointId) -> Color) -> Vec<Item> {
        let on_page = |p: Point| plot.page_from_plane.apply(p);
        let at = |joint: JointId| on_page(self.pose[joint]);
        let ground = self.linkage.pivots();
        let mut items = Vec::new();
        let links = self.linkage.link_outlines();
        let heavy = Stroke { has_round_ends: true, ..theme.stroke(theme.ink, theme.link_width) };
        let mut blocks = Vec::new();
        for (id, joint) in self.linkage.joint_ids().zip(&self.linkage.joints) {
            match joint.kind {
                JointKind::Slide { line: [p, q], .. } => blocks.push((at(id), at(q) - at(p))),
                JointKind::Yoke { line: [p, q], .. } => blocks.push((at(id), at(q) - at(p))),
                JointKind::Piston { base: [pivot, _], .. } => items.extend(actuator_items(at(pivot), at(id), theme)),
                _ => {}
            }
        }
        for LinkOutline { link, joints } in &links {
            let points: Vec<Point> = joints.iter().map(|&joint| at(joint)).collect();
            let closed = is_plate(&points);
            let stroke = Some(Stroke { color: self.link_ink(*link, theme).unwrap_or(theme.ink), ..heavy });
            items.push(Item::Path(Path {
                polylines: vec![Polyline { points, is_closed: closed }],
                stroke,
                fill: None,
            }));
        }
        for Slot { ends, foot, block } in &self.slots {
            let ends = ends.map(on_page);
            items.push(Item::Path(Path::stroked(vec![on_page(*foot), ends[0], ends[1]], heavy)));
            items.push(slot_item(ends, theme));
            blocks.push((on_page(*block), ends[1] - ends[0]));
        }
        items.extend(blocks.into_iter().map(|(centre, along)| block_item(centre, along, theme)));
        let mut joints: Vec<JointId> = links.iter().flat_map(|outline| outline.joints.iter().copied()).collect();
        joints.extend(&ground);
        joints.sort_unstable();
        joints.dedup();
        // The foot of a slot without offset is its pivot, which is drawn already.
        joints.retain(|&joint| !matches!(self.linkage.joints[joint].kind, JointKind::Slot { offset: 0.0, .. }));
        let circle = |centre, radius, color| {
            let stroke = Some(theme.stroke(color, theme.fine_width));
            Item::Circle(Circle { centre, radius, stroke, fill: Some(theme.paper) })
        };
        for joint in joints {
            if ground.contains(&joint) {
                items.push(circle(at(joint), 1.5 * theme.joint_radius, ink(joint)));
                items.push(circle(at(joint), 0.7 * theme.joint_radius, ink(joint)));
            } else {
                items.push(circle(at(joint), theme.joint_radius, ink(joint)));
            }
        }
        items
    }
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

/// A linear actuator: its rod, and its cylinder on the half near `from`.
fn actuator_items(from: Point, to: Point, theme: &Theme) -> [Item; 2] {
    let along = to - from;
    let across = left_normal(along).try_normalize(0.0).unwrap_or(Vector::zeros()) * (1.2 * theme.joint_radius);
    let (near, far) = (from + along * 0.1, from + along * 0.6);
    let points = vec![near - across, far - across, far + across, near + across];
    let stroke = Some(theme.stroke(theme.ink, theme.fine_width));
    let rod = Path::stroked(vec![from, to], theme.stroke(theme.ink, theme.link_width));
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

/// The ends of the part of a line on the frame that a slider uses.
fn find_guide(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Option<[Point; 2]> {
    let (JointKind::Slide { line, .. } | JointKind::Yoke { line, .. }) = linkage.joints[joint].kind else {
        return None;
    };
    let along = fixed_line_direction(linkage, circuit, line)?;
    let by = |a: &Point, b: &Point| along.dot(&a.coords).total_cmp(&along.dot(&b.coords));
    Some([circuit.points(joint).min_by(by)?, circuit.points(joint).max_by(by)?])
}

/// The slot that has `joint` as its foot or yoke, in a pose.
fn find_slot(linkage: &Linkage, circuit: &Circuit, pose: &[Point], joint: JointId) -> Option<Slot> {
    // The line turns with a base: the pivot and the foot of a slot, the guide of a yoke, or the line itself of a slot
    // without offset.
    let ([from, to], through) = match linkage.joints[joint].kind {
        JointKind::Slot { base: [pivot, through], offset: 0.0, .. } => ([pivot, through], through),
        JointKind::Slot { base: [pivot, through], .. } => ([pivot, joint], through),
        JointKind::Yoke { from, line, .. } => (line, from),
        _ => return None,
    };
    let in_base = |base: Vector, arm: Vector| Vector::new(base.dot(&arm), cross(base, arm)) / base.norm();
    let point = |joint, sample| circuit.positions.point(joint, sample);
    let arm = |i: usize| in_base(point(to, i) - point(from, i), point(through, i) - point(joint, i));
    let arms: Vec<Vector> = (0..circuit.len()).map(arm).filter(|arm| arm.x.is_finite() && arm.y.is_finite()).collect();
    let longest = arms.iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    let by = |a: &&Vector, b: &&Vector| longest.dot(a).total_cmp(&longest.dot(b));
    let unit = (pose[to] - pose[from]).normalize();
    let at = |arm: &Vector| pose[joint] + unit * arm.x + left_normal(unit) * arm.y;
    let ends = [at(arms.iter().min_by(by)?), at(arms.iter().max_by(by)?)];
    Some(Slot { ends, foot: pose[joint], block: pose[through] })
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

/// The direction of a line through two joints; `None` if it is not on the frame.
fn fixed_line_direction(linkage: &Linkage, circuit: &Circuit, [p, q]: [JointId; 2]) -> Option<Vector> {
    let ground = linkage.ground();
    (ground.position(p).is_some() && ground.position(q).is_some()).then_some(())?;
    Some(circuit.positions.point(q, 0) - circuit.positions.point(p, 0))
}
