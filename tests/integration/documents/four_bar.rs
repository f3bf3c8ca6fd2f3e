//! The labelled drawing of a four-bar in docs/terms.md: a plate without its texts, with the names of the parts.

use coupler_curves::geometry::{Point, Similarity, Vector, distance_to_segment, left_normal, trig};
use coupler_curves::motion;
use coupler_curves::{CouplerCurve, FourBar};
use coupler_drawing::page::{self, Heading, Layout, Options, Panel, PanelPage, PanelScale, Paper, PoseChoice, Theme};
use coupler_drawing::render::{self, TextMode};
use coupler_drawing::scene::{Anchor, Item, Path, Polyline, Scene, Shape, Text, TextRun};

use super::document;
use crate::recorded::assert_recorded;

const PAPER: Paper = Paper { width: 144.0, height: 100.0 };
const INPUT_DEG: f64 = 60.0;
const ALONG: f64 = 1.2;
const ACROSS: f64 = 1.8;
const LETTER_SIZE: f64 = 3.4;

fn coupler_curve() -> CouplerCurve {
    let four_bar = FourBar { frame: 4.0, crank: 1.3, coupler: 3.2, rocker: 3.4 };
    let FourBar { frame, crank, coupler, rocker } = four_bar;
    let stated =
        format!("four-bar frame={frame} crank={crank} coupler={coupler} rocker={rocker} along={ALONG} across={ACROSS}");
    assert!(document("docs/terms.md").blocks.iter().any(|block| block.text.contains(&stated)), "{stated}");
    four_bar.coupler_curve(ALONG, ACROSS).unwrap()
}

/// The drawing, and where its labels must not be: lines, by their ends.
struct Drawing {
    scene: Scene,
    theme: Theme,
    page_from_plane: Similarity,
    lines: Vec<[Point; 2]>,
}

impl Drawing {
    /// The curve and the linkage in a pose, as on a plate.
    fn new(curve: &CouplerCurve, pose: &[Point]) -> Drawing {
        let solved = curve.selected().solved;
        let options = Options::for_paper(PAPER);
        let page = PanelPage {
            heading: Heading::new("The four-bar"),
            layout: Layout::Panels { columns: 1, rows: 1 },
            panels: vec![Panel::new(&solved).with_pose(PoseChoice::Fixed(pose.to_vec()))],
            scale: PanelScale::Panel,
            key: None,
        };
        let mut scene = page::compose_panels(&page, &options);
        let panel = scene.items.iter().find_map(|item| match item {
            Item::Group(group) if group.class == "panel" => Some(group.items.clone()),
            _ => None,
        });
        scene.items = panel.unwrap();
        scene.items.retain(|item| match item {
            Item::Group(group) => ["underlay", "curve", "linkage", "coupler-point"].contains(&group.class),
            _ => false,
        });
        let drawn = scene.items.iter().find_map(|item| match item {
            Item::Group(group) if group.class == "curve" => Some(group),
            _ => None,
        });
        let value = |name: &str| &drawn.unwrap().data.iter().find(|(key, _)| *key == name).unwrap().1;
        let origin: Vec<f64> = value("origin").split(' ').map(|number| number.parse().unwrap()).collect();
        let scale = value("scale").parse().unwrap();
        let page_from_plane = Similarity::with_y_down(scale, Point::new(origin[0], origin[1]));
        let theme = options.theme.for_paper(PAPER);
        let mut drawing = Drawing { scene, theme, page_from_plane, lines: Vec::new() };
        let points: Vec<Point> = curve.points().collect();
        let [o, c, a, b, m] = <[Point; 5]>::try_from(pose).unwrap();
        let links = [[o, c], [o, a], [a, b], [b, c], [a, m], [b, m]];
        let chords = points.windows(2).map(|pair| [pair[0], pair[1]]);
        drawing.lines = links.into_iter().chain(chords).map(|line| line.map(|p| page_from_plane.apply(p))).collect();
        drawing
    }

    /// A point of the plane on the page, shifted by millimetres to the right and up.
    fn at(&self, p: Point, [right, up]: [f64; 2]) -> Point {
        self.page_from_plane.apply(p) + Vector::new(right, -up)
    }

    /// A fine line through points on the page.
    fn line(&mut self, points: Vec<Point>) {
        self.lines.extend(points.windows(2).map(|pair| [pair[0], pair[1]]));
        let stroke = self.theme.stroke(self.theme.grey, self.theme.fine_width);
        self.scene.items.push(Item::Path(Path::stroked(points, stroke)));
    }

    /// An arc about a point of the plane, counter-clockwise from one direction in degrees to another, with an arrow head at its end.
    fn arc(&mut self, centre: Point, radius: f64, [from, to]: [f64; 2], has_head: bool) {
        const STEPS: usize = 24;
        let at = |deg: f64| {
            let (cos, sin) = trig::cos_sin_deg(deg);
            self.at(centre, [radius * cos, radius * sin])
        };
        let points: Vec<Point> = (0..=STEPS).map(|k| at(from + (to - from) * k as f64 / STEPS as f64)).collect();
        if has_head {
            let tip = points[STEPS];
            let back = (points[STEPS - 2] - tip).normalize() * 2.2;
            let side = left_normal(back) * 0.35;
            let head = Polyline { points: vec![tip, tip + back + side, tip + back - side], is_closed: true };
            let fill = Some(self.theme.grey);
            self.scene.items.push(Item::Path(Path { polylines: vec![head], stroke: None, fill }));
        }
        self.line(points);
    }

    /// A dimension between two points of the plane, at a distance to the right of the line from one to the other.
    fn dimension(&mut self, from: Point, to: Point, distance: f64) {
        let [from, to] = [from, to].map(|p| self.page_from_plane.apply(p));
        let right = left_normal((to - from).normalize());
        let across = |p: Point| vec![p + right * (distance - 1.2), p + right * (distance + 1.2)];
        self.line(vec![from + right * distance, to + right * distance]);
        self.line(across(from));
        self.line(across(to));
    }

    /// A line of text at a place on the page; what is between underscores is in italics, as names of parameters are.
    fn label(&mut self, position: Point, anchor: Anchor, text: &str) {
        let typeface = self.scene.typeface;
        let faces = [typeface.regular(), typeface.italic()].into_iter().cycle();
        let runs = text.split('_').zip(faces).filter(|(part, _)| !part.is_empty());
        let runs = runs.map(|(part, face)| TextRun::new(part, face)).collect();
        let text = Text { position, anchor, size: LETTER_SIZE, color: self.theme.ink, runs, quarter_turns: 0 };
        self.scene.items.push(Item::Text(text));
    }
}

/// The direction from a point to another, in degrees.
fn direction_deg(from: Point, to: Point) -> f64 {
    let d = to - from;
    trig::degrees(trig::atan2(d.y, d.x))
}

fn drawing() -> Drawing {
    let curve = coupler_curve();
    let pose = motion::pose(curve.linkage(), &curve.circuit().passes[0], INPUT_DEG);
    let [o, c, a, b, m] = <[Point; 5]>::try_from(&pose[..]).unwrap();
    let foot = a + (b - a).normalize() * ALONG;
    let mut drawing = Drawing::new(&curve, &pose);
    let [ba, bc] = [a, c].map(|end| direction_deg(b, end) + 360.0);
    drawing.arc(o, 9.0, [0.0, INPUT_DEG - 4.0], true);
    drawing.arc(b, 10.0, [ba, bc], false);
    drawing.dimension(a, foot, 4.0);
    // Up to the rim of the circle at the coupler point.
    let [from, to] = [foot, m].map(|p| drawing.page_from_plane.apply(p));
    drawing.line(vec![from, to + (from - to).normalize() * drawing.theme.joint_radius]);
    let middle = |a: Point, b: Point| a + (b - a) / 2.0;
    let loop_centre = o + Vector::new(-0.95, 1.5);
    let labels: [(Point, [f64; 2], Anchor, &str); 16] = [
        (o, [0.0, -6.0], Anchor::Middle, "O, crank pivot"),
        (c, [0.0, -6.0], Anchor::Middle, "C, rocker pivot"),
        (a, [6.0, -7.5], Anchor::Start, "A, crank pin"),
        (b, [3.0, 1.5], Anchor::Start, "B, rocker pin"),
        (m, [1.0, 3.0], Anchor::Start, "M, coupler point"),
        (middle(o, c), [0.0, -4.5], Anchor::Middle, "frame"),
        (middle(o, a), [-2.5, 1.0], Anchor::End, "crank"),
        (m + (b - m) * 0.62, [0.0, -5.5], Anchor::Middle, "coupler"),
        (middle(b, c), [3.0, 0.0], Anchor::Start, "rocker"),
        (middle(a, foot), [7.0, -4.0], Anchor::Start, "_along_"),
        (middle(foot, m), [3.0, 0.5], Anchor::Start, "_across_"),
        (o, [11.0, 3.0], Anchor::Start, "input angle"),
        (b, [-7.5, -20.0], Anchor::Middle, "transmission"),
        (b, [-7.5, -24.0], Anchor::Middle, "angle μ"),
        (loop_centre, [0.0, 1.0], Anchor::Middle, "coupler"),
        (loop_centre, [0.0, -3.0], Anchor::Middle, "curve"),
    ];
    for (place, shift, anchor, text) in labels {
        let position = drawing.at(place, shift);
        drawing.label(position, anchor, text);
    }
    drawing
}

/// The corners of a text, with a margin.
fn text_box(text: &Text) -> [Point; 2] {
    let start = text.start();
    [start + Vector::new(-0.3, -0.8 * text.size), start + Vector::new(text.width() + 0.3, 0.25 * text.size)]
}

#[test]
fn the_drawing_of_the_four_bar_is_recorded() {
    let Drawing { scene, lines, .. } = drawing();
    let svg = String::from_utf8(render::svg(&scene, TextMode::Text)).unwrap();
    let texts = scene.shapes().into_iter().filter_map(|shape| match shape {
        Shape::Text(text) => Some(text.clone()),
        _ => None,
    });
    let boxes: Vec<[Point; 2]> = texts.map(|text| text_box(&text)).collect();
    for (k, [least, greatest]) in boxes.iter().enumerate() {
        assert!(least.x > 0.0 && least.y > 0.0 && greatest.x < PAPER.width && greatest.y < PAPER.height, "label {k}");
        let is_apart =
            |[low, high]: &[Point; 2]| high.x < least.x || greatest.x < low.x || high.y < least.y || greatest.y < low.y;
        assert!(boxes[..k].iter().all(is_apart), "label {k} is on another");
        let middle = (least.y + greatest.y) / 2.0;
        let columns = ((greatest.x - least.x) / 0.5).ceil() as usize;
        for column in 0..=columns {
            let p = Point::new(least.x + (greatest.x - least.x) * column as f64 / columns as f64, middle);
            let gap = lines.iter().map(|[a, b]| distance_to_segment(p, *a, *b)).fold(f64::INFINITY, f64::min);
            assert!(gap > (greatest.y - least.y) / 2.0, "label {k} is on a line");
        }
    }
    assert_recorded("docs/images/four-bar.svg", &svg);
}
