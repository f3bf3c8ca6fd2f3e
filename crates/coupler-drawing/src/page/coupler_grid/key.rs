//! The key: a small drawing of the linkage in its pose, with the names of its joints and links, the sense of the input
//! and one of the page's points with its coordinates.

use super::super::area::Area;
use super::super::direction::DirectionMarks;
use super::super::element::{Drawing, TextLine};
use super::super::labels::{self, LabelBox, LabelPlacer, Obstacles};
use super::super::mechanism::{PosedMechanism, pivot_items};
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{CouplerGridPage, LinkLabel};
use super::shown_curve::ShownCurve;
use crate::scene::{Anchor, Circle, Color, Item, Path, Polyline, Text};
use coupler_curves::expression::displayed_name;
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector, cross, left_normal};
use coupler_curves::linkage::{JointId, JointKind, Linkage, is_plate};

/// Draws the key in a frame.
pub(super) fn draw(
    area: &impl Area,
    frame: Rect,
    page: &CouplerGridPage,
    mechanism: &PosedMechanism,
    shown: &[ShownCurve],
    theme: &Theme,
) {
    let key = Key::new(frame, page, mechanism, shown, theme);
    let mut items = key.link_items();
    items.extend(key.coordinate_items());
    items.extend(key.directions.items(theme));
    items.extend(key.joint_items());
    let mut obstacles = Obstacles::default();
    obstacles.add(&items, false);
    area.record(Drawing { class: "key", title: String::new(), items });

    let mut placed = Vec::new();
    for (name, spot) in key.link_labels(&obstacles) {
        area.record(name);
        placed.push(spot);
    }
    let mut placer = LabelPlacer::new(&obstacles, frame, theme).with_placed(placed, key.label_gap());
    let items = key.point_labels().into_iter().filter_map(|(at, text)| placer.place_at_point(at, text)).collect();
    area.record(Drawing { class: "key", title: String::new(), items });
}

/// The font size of names, in ems of a note, and the greatest width of one as a part of the key. The roles of links in the description,
/// with the joints at their ends, say what has no name here.
const LETTER: f64 = 1.1;
const MAX_NAME_PART: f64 = 0.3;

fn name_width(name: &str, theme: &Theme) -> f64 {
    let size = LETTER * theme.note_size;
    theme.text_line(name, Point::origin(), Anchor::Start, size, theme.grey).text.width()
}

fn is_short(width: f64, frame: Rect) -> bool {
    width <= MAX_NAME_PART * frame.size.x
}

struct Key<'a> {
    frame: Rect,
    page: &'a CouplerGridPage<'a>,
    linkage: &'a Linkage,
    mechanism: &'a PosedMechanism<'a>,
    /// One of the points of the page, which shows what its coordinates are.
    point: Option<&'a ShownCurve<'a>>,
    page_from_plane: Similarity,
    /// The directions of input and output, on the page.
    directions: DirectionMarks,
    /// The middle of the linkage on the page.
    centre: Point,
    /// The font size of names.
    letter: f64,
    theme: &'a Theme,
}

/// A key at a size.
struct Fit {
    page_from_plane: Similarity,
    /// The middle of the linkage on the page.
    centre: Point,
    /// The least radius of arrows in the plane.
    least_radius: f64,
    directions: DirectionMarks,
}

/// How often a key is made smaller for its arrows, which are then longer in it.
const MOST_FITS: usize = 4;

impl<'a> Key<'a> {
    fn new(
        frame: Rect,
        page: &'a CouplerGridPage,
        mechanism: &'a PosedMechanism,
        shown: &'a [ShownCurve],
        theme: &'a Theme,
    ) -> Key<'a> {
        let linkage = &page.panel.solved_cell.linkage;
        let circuit = &page.panel.solved_cell.motion.circuits[shown.first().map_or(0, |s| s.curve.circuit - 1)];
        let letter = LETTER * theme.note_size;
        let point = nearest_point(linkage, shown);
        let on_links = linkage.link_outlines().into_iter().flat_map(|outline| outline.joints);
        let joints = on_links.chain(linkage.pivots()).chain(point.map(|s| s.curve.joint));
        let joints: Vec<Point> = joints.map(|joint| mechanism.pose[joint]).collect();
        // Names need space outside the links on all sides.
        let widths =
            page.labels.iter().map(|label| name_width(&label.text, theme)).filter(|&width| is_short(width, frame));
        let widest = widths.fold(letter, f64::max);
        let space = Vector::new(widest + 0.8 * letter, 1.3 * letter);
        let inner =
            Rect { corner: frame.corner + space, size: (frame.size - space * 2.0).sup(&Vector::repeat(letter)) };
        // Arrows are at least as far from joints as on paper, which needs more space in a small key.
        let fitted = |least_radius: f64| {
            let directions = DirectionMarks::new(mechanism, circuit, least_radius);
            let bounds = Bounds::from_points(joints.iter().copied().chain(directions.points()));
            let page_from_plane = Similarity::page_from_plane(bounds, inner.centre(), inner.fit_scale(bounds));
            let least_radius = 4.0 * theme.joint_radius / page_from_plane.scale();
            let directions = DirectionMarks::new(mechanism, circuit, least_radius).map(page_from_plane);
            Fit { page_from_plane, centre: page_from_plane.apply(bounds.centre()), least_radius, directions }
        };
        let mut fit = fitted(0.0);
        for _ in 0..MOST_FITS {
            if fit.directions.points().all(|p| frame.contains(&p)) {
                break;
            }
            fit = fitted(fit.least_radius);
        }
        let Fit { page_from_plane, centre, directions, .. } = fit;
        Key { frame, page, linkage, mechanism, point, page_from_plane, directions, centre, letter, theme }
    }

    /// The position of a joint on the page.
    fn at(&self, joint: JointId) -> Point {
        self.page_from_plane.apply(self.mechanism.pose[joint])
    }

    fn path(&self, polylines: Vec<Polyline>, color: Color, width: f64) -> Item {
        Item::Path(Path { polylines, stroke: Some(self.theme.stroke(color, width)), fill: None })
    }

    /// The moving links, and the frame as a dashed line.
    fn link_items(&self) -> Vec<Item> {
        let theme = self.theme;
        let pivots: Vec<Point> = self.linkage.pivots().into_iter().map(|joint| self.at(joint)).collect();
        let ground = pivots.windows(2).flat_map(|pair| dashed_line(pair[0], pair[1], 0.5 * self.letter)).collect();
        let link = |joints: &[JointId]| {
            let points: Vec<Point> = joints.iter().map(|&joint| self.at(joint)).collect();
            let is_closed = is_plate(&points);
            self.path(vec![Polyline { points, is_closed }], theme.grey, theme.fine_width)
        };
        let links = self.linkage.link_outlines();
        let ground = self.path(ground, theme.grey, theme.fine_width);
        std::iter::once(ground).chain(links.iter().map(|outline| link(&outline.joints))).collect()
    }

    /// The joints: fixed pivots as on the figure, the others small circles.
    fn joint_items(&self) -> Vec<Item> {
        let theme = self.theme;
        let small = |joint: JointId, ink: Color, fill: Color| {
            let stroke = Some(theme.stroke(ink, theme.fine_width));
            Item::Circle(Circle { centre: self.at(joint), radius: 0.7 * theme.joint_radius, stroke, fill: Some(fill) })
        };
        let pivots = self.linkage.pivots();
        let crank_pivot = self.linkage.crank().map(|[pivot, _]| pivot);
        let mut items = Vec::new();
        for joint in self.named_joints() {
            if pivots.contains(&joint) {
                items.extend(pivot_items(self.at(joint), Some(joint) == crank_pivot, theme.grey, theme));
            } else {
                items.push(small(joint, theme.grey, theme.paper));
            }
        }
        items.extend(self.point.map(|s| {
            let fill = if s.has_underline(theme) { s.ink(theme) } else { theme.paper };
            small(s.curve.joint, s.ink(theme), fill)
        }));
        items
    }

    /// The joints of links and of the frame, without repetition.
    fn named_joints(&self) -> Vec<JointId> {
        let mut joints = self.linkage.pivots();
        for joint in self.linkage.link_outlines().into_iter().flat_map(|outline| outline.joints) {
            if !joints.contains(&joint) && Some(joint) != self.point.map(|s| s.curve.joint) {
                joints.push(joint);
            }
        }
        joints
    }

    /// The foot of the perpendicular from the point on the line of its base, and its ends: the base's first joint and
    /// the point.
    fn coordinate_corners(&self) -> Option<[Point; 3]> {
        let joint = self.point?.curve.joint;
        let JointKind::Rigid { base: [from, to], along, .. } = self.linkage.joints[joint].kind else { return None };
        let (from, to) = (self.at(from), self.at(to));
        Some([from, from + (to - from) * along, self.at(joint)])
    }

    /// Hairlines along the base and across it to the point.
    fn coordinate_items(&self) -> Vec<Item> {
        let lines = self.coordinate_corners().map(|corners| Polyline { points: corners.to_vec(), is_closed: false });
        lines.map(|line| self.path(vec![line], self.theme.grey, self.theme.hair_width)).into_iter().collect()
    }

    /// The least distance of two names.
    fn label_gap(&self) -> f64 {
        0.25 * self.letter
    }

    /// Half the width and height of a text.
    fn half_size(&self, text: &Text) -> Vector {
        Vector::new(text.width() / 2.0, 0.36 * text.size)
    }

    /// The names of the links and of the coordinates, next to their lines. A name is left out if it would overlap another
    /// one everywhere.
    fn link_labels(&self, obstacles: &Obstacles) -> Vec<(TextLine, LabelBox)> {
        let pivots = self.linkage.pivots();
        let is_fixed = |joint: &JointId| self.linkage.ground().position(*joint).is_some();
        // On the frame, only a label between two pivots names a link.
        let is_link = |label: &&LinkLabel| {
            (!label.joints.iter().all(is_fixed) || label.joints.iter().all(|end| pivots.contains(end)))
                && is_short(name_width(&label.text, self.theme), self.frame)
        };
        let links = self.page.labels.iter().filter(is_link);
        let mut names: Vec<(String, [Point; 2], Option<Point>)> =
            links.map(|label| (displayed_name(&label.text), label.joints.map(|joint| self.at(joint)), None)).collect();
        if let Some([from, foot, point]) = self.coordinate_corners() {
            // On the other side of the point, so that it cannot be read as the name of the line across.
            let coordinates = [("across", [foot, point], None), ("along", [foot, from], Some(point))]
                .map(|(name, ends, not_beside)| (name.to_owned(), ends, not_beside));
            names.extend(coordinates.into_iter().filter(|(_, [a, b], _)| (b - a).norm() > 0.8 * self.letter));
        }
        let mut placed: Vec<(TextLine, LabelBox)> = Vec::new();
        for (name, ends, not_beside) in names {
            let line = self.theme.text_line(&name, Point::origin(), Anchor::Middle, self.letter, self.theme.grey);
            let mut line = line.with_italics(self.page.heading.symbols);
            let half = self.half_size(&line.text);
            let is_free = |spot: &LabelBox| {
                let side_of = |at: Point| cross(ends[1] - ends[0], at - ends[0]);
                spot.is_inside(self.frame)
                    && not_beside.is_none_or(|point| side_of(point) * side_of(spot.centre) < 0.0)
                    && placed.iter().all(|(_, other)| spot.distance_to_box(other) > self.label_gap())
            };
            let enough = 0.3 * self.letter;
            let clearest = |parts: &[f64], gap: f64| {
                let spots = label_boxes(ends, self.centre, half, gap * self.letter, parts).filter(is_free);
                labels::clearest_box(spots, |spot| obstacles.clearance(spot, enough))
            };
            // Beyond a short line to the point if everywhere next to it the name would touch another line: all lines count as heavy, so
            // that a quarter of the clearance is for the light ones.
            let touches = |(clearance, _): &(f64, LabelBox)| *clearance < 0.35 * enough;
            let near = clearest(&BESIDE, GAPS[0]);
            let is_clear = |spot: &(f64, LabelBox)| !touches(spot);
            let far = || {
                let beyond = not_beside.is_none().then(|| clearest(&BEYOND, GAPS[0])).flatten();
                let away = GAPS[1..].iter().filter_map(|gap| clearest(&BESIDE, *gap));
                beyond.into_iter().chain(away).find(is_clear)
            };
            if let Some((_, spot)) = near.filter(is_clear).or_else(far).or(near) {
                line.text.position = spot.centre + Vector::new(0.0, half.y);
                placed.push((line, spot));
            }
        }
        placed
    }

    /// The names of the joints, the number of the point and the input 0, each with its position.
    fn point_labels(&self) -> Vec<(Point, Text)> {
        let theme = self.theme;
        let text =
            |name: &str, color: Color| theme.text_line(name, Point::origin(), Anchor::Middle, self.letter, color).text;
        let name = |joint: JointId| self.linkage.joints[joint].name.as_str();
        let has_name = |joint: &JointId| is_short(name_width(name(*joint), theme), self.frame);
        let joints = self.named_joints().into_iter().filter(has_name);
        let mut labels: Vec<(Point, Text)> =
            joints.map(|joint| (self.at(joint), text(name(joint), theme.ink))).collect();
        labels
            .extend(self.point.map(|s| (self.at(s.curve.joint), text(&s.curve.trace.to_string(), s.text_ink(theme)))));
        let zero = self.directions.zero_end();
        labels.extend(zero.map(|zero| (zero, text("0°", theme.grey))));
        labels
    }
}

/// Of the points that are not on the line of their base, the one that is nearest to its middle: with it the key is largest.
fn nearest_point<'a>(linkage: &Linkage, shown: &'a [ShownCurve<'a>]) -> Option<&'a ShownCurve<'a>> {
    let distance = |s: &&ShownCurve| match linkage.joints[s.curve.joint].kind {
        JointKind::Rigid { along, across, .. } if across != 0.0 => Some(Vector::new(along - 0.5, across).norm()),
        _ => None,
    };
    let points = shown.iter().filter_map(|s| Some((distance(&s)?, s)));
    points.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, s)| s)
}

/// The places of a name beside a line, as parts of its length, the best first; and those beyond its end.
const BESIDE: [f64; 5] = [0.5, 0.35, 0.65, 0.2, 0.8];
const BEYOND: [f64; 4] = [1.0, 1.25, 1.5, 1.8];

/// The distances of a name from its line, in ems, the best first.
const GAPS: [f64; 3] = [0.45, 0.9, 1.4];

/// The candidate positions of a label next to a link, in the order of `parts` of its length: on the side away from
/// the `centre` of the linkage. The nearest corner or side of the box is at the distance `gap` from the link.
fn label_boxes(
    [a, b]: [Point; 2],
    centre: Point,
    half: Vector,
    gap: f64,
    parts: &[f64],
) -> impl Iterator<Item = LabelBox> {
    let normal = left_normal(b - a).try_normalize(0.0).unwrap_or(Vector::new(0.0, -1.0));
    let outward = if cross(b - a, centre - a) > 0.0 { -normal } else { normal };
    let away = outward * (half.x * outward.x.abs() + half.y * outward.y.abs() + gap);
    let spot = move |(part, away): (f64, Vector)| LabelBox { centre: a + (b - a) * part + away, half_size: half };
    parts.iter().flat_map(move |&part| [(part, away), (part, -away)]).map(spot)
}

fn line(a: Point, b: Point) -> Polyline {
    Polyline { points: vec![a, b], is_closed: false }
}

/// A dashed line that starts and ends with a dash.
fn dashed_line(a: Point, b: Point, dash: f64) -> Vec<Polyline> {
    let dashes = (((b - a).norm() / dash).ceil().clamp(1.0, 200.0) / 2.0).floor() * 2.0 + 1.0;
    let at = |k: f64| a + (b - a) * (k / dashes);
    (0..dashes as usize).step_by(2).map(|k| line(at(k as f64), at(k as f64 + 1.0))).collect()
}
