//! Pages of coupler grids: their number and contents, and that nothing on them is cut off or overlaps.

use std::fs;

use coupler_atlas::manifest::Plan;
use coupler_atlas::sweep;
use coupler_curves::catalogue;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, Vector, distance_to_segment};
use coupler_curves::measure::Measure;
use coupler_curves::motion;
use coupler_curves::solve::{MovablePoint, SolvedCell, Solver};
use coupler_drawing::page::{
    self, CouplerGridPage, Heading, Layout, LinkLabel, Options, Panel, PanelScale, Paper, PoseChoice, Theme,
};
use coupler_drawing::scene::{Circle, Color, Curve, Group, Item, Path, Scene, Stroke, Text, group_class};

use crate::support::folder::Atlas;
use crate::support::plan::{plan, problems};
use crate::support::texts::texts as svg_texts;

/// A crank-rocker, a change point and a case that cannot be assembled, with twelve points.
const GOOD: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg"]
[[linkage]]
id = "twelve"
parameters = { g = { min = 0 } }
caption = "g = {g:.1}"
trace = ["M"]
continuation = "branch"
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["g", 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = [2, 2], side = "left" }
M = { point = ["A", "B"], along = { from = 0.5, to = 1.5, count = 3 }, across = { from = -1, to = 1, count = 4 } }
[[family]]
id = "grid"
linkage = "twelve"
layout = "coupler-grid"
sampling = { step = "10 deg" }
grid = { g = [2, 3, 9] }
"#;

/// Named papers, an upright one, and some that are small or narrow, in millimetres.
const PAPERS: [(f64, f64); 9] = [
    (297.0, 210.0),
    (279.4, 215.9),
    (431.8, 279.4),
    (420.0, 297.0),
    (200.0, 280.0),
    (148.0, 105.0),
    (100.0, 100.0),
    (100.0, 400.0),
    (400.0, 100.0),
];

fn example() -> Plan {
    plan(include_str!("../../examples/hrones-nelson.toml"))
}

fn options((width, height): (f64, f64)) -> Options {
    Options::for_paper(Paper { width, height })
}

fn labels(family: &Family, solved: &SolvedCell) -> Vec<LinkLabel> {
    let joint = |name: &str| solved.linkage.find_joint(name);
    let label =
        |(ends, text): ([&str; 2], String)| Some(LinkLabel { joints: [joint(ends[0])?, joint(ends[1])?], text });
    family.template.link_length_names().into_iter().filter_map(label).collect()
}

/// The pages of a cell, each with the indices of its curves.
fn pages(family: &Family, source: &str, solved: &SolvedCell, options: &Options) -> Vec<(Scene, Vec<usize>)> {
    let mut shown = solved.curves_by_traces(Layout::POINTS_PER_PAGE);
    if shown.is_empty() {
        shown.push(Vec::new());
    }
    let page_count = shown.len();
    let labels = labels(family, solved);
    let coordinates = |trace| {
        let point = MovablePoint::of_trace(&family.template, trace, &solved.cell.values)?;
        Some(point.coordinates.map(|coordinate| coordinate.value))
    };
    let coordinates: Vec<_> = (1..=family.template.curve_count()).map(coordinates).collect();
    let view = page::clearest_pose(solved).map_or(PoseChoice::Clearest, PoseChoice::Fixed);
    let compose = |(page, shown): (usize, Vec<usize>)| {
        let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
        let (title, symbols, source) = (family.title.as_str(), family.names.as_slice(), source.to_owned());
        let heading = Heading::new(title)
            .with_family_id(&family.id)
            .with_atlas_title("The atlas")
            .with_source(source)
            .with_symbols(symbols)
            .with_page(page, page_count);
        let facts = page::cell_facts(family, solved);
        let panel = Panel::new(solved).with_caption(caption).with_note(note).with_facts(facts).with_pose(view.clone());
        let grid_page = CouplerGridPage {
            heading,
            panel,
            scale: PanelScale::Panel,
            curve_indices: shown.clone(),
            key: None,
            coordinates: &coordinates,
            labels: &labels,
            straight_criterion: family.straight,
        };
        (page::compose_coupler_grid(&grid_page, options), shown)
    };
    (1..).zip(shown).map(compose).collect()
}

/// The solved cells of the first family of a plan, one in every `step` of them.
fn solve_cells(plan: &Plan, step: usize) -> Vec<SolvedCell> {
    let family = &plan.families[0].family;
    let solver = Solver::new(family);
    let kept = sweep::kept_cells(family);
    kept.iter().step_by(step).map(|k| solver.solve(k).unwrap()).collect()
}

/// All pages of one in every `step` cells.
fn all_pages(plan: &Plan, step: usize, options: &Options) -> Vec<Scene> {
    let planned = &plan.families[0];
    let scenes = |solved: &SolvedCell| pages(&planned.family, &planned.source, solved, options);
    solve_cells(plan, step).iter().flat_map(scenes).map(|(scene, _)| scene).collect()
}

/// The items of a page that are not groups, each with the class of its group, which is that of no figure as a whole and no title.
fn items(scene: &Scene) -> Vec<(&'static str, &Item)> {
    fn add<'s>(class: &'static str, items: &'s [Item], out: &mut Vec<(&'static str, &'s Item)>) {
        for item in items {
            match item {
                Item::Group(group) if is_whole(group) => add(class, &group.items, out),
                Item::Group(group) => add(group.class, &group.items, out),
                Item::Animation(_) => panic!("a page of a coupler grid has no animations"),
                item => out.push((class, item)),
            }
        }
    }
    let mut out = Vec::new();
    add("", &scene.items, &mut out);
    out
}

/// Whether a group is a figure as a whole, or a title.
fn is_whole(group: &Group) -> bool {
    !group.description.is_empty() || group.class == group_class::TITLE
}

fn groups<'s>(scene: &'s Scene, class: &str) -> Vec<&'s Group> {
    fn add<'s>(items: &'s [Item], found: &mut Vec<&'s Group>) {
        for item in items {
            match item {
                Item::Group(group) if is_whole(group) => add(&group.items, found),
                Item::Group(group) => found.push(group),
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    add(&scene.items, &mut found);
    found.into_iter().filter(|group| group.class == class).collect()
}

fn texts<'s>(scene: &'s Scene) -> Vec<(&'static str, &'s Text)> {
    let text =
        |(class, item): (&'static str, &'s Item)| if let Item::Text(text) = item { Some((class, text)) } else { None };
    items(scene).into_iter().filter_map(text).collect()
}

/// The characters of a text, without their faces.
fn content(text: &Text) -> String {
    text.runs.iter().map(|run| run.text.as_str()).collect()
}

fn circles<'s>(scene: &'s Scene, classes: &[&str]) -> Vec<&'s Circle> {
    let circle = |(class, item): (&str, &'s Item)| match item {
        Item::Circle(circle) if classes.contains(&class) => Some(circle),
        _ => None,
    };
    items(scene).into_iter().filter_map(circle).collect()
}

fn paths<'s>(scene: &'s Scene, classes: &[&str]) -> Vec<&'s Path> {
    let path = |(class, item): (&str, &'s Item)| match item {
        Item::Path(path) if classes.contains(&class) => Some(path),
        _ => None,
    };
    items(scene).into_iter().filter_map(path).collect()
}

/// The path and the dashes of each curve.
fn curves(scene: &Scene) -> Vec<[&Curve; 2]> {
    fn parts(group: &Group) -> [&Curve; 2] {
        match &group.items[..] {
            [Item::Curve(whole), Item::Curve(dashes)] => [whole, dashes],
            _ => panic!("a curve is its path and its dashes: {group:?}"),
        }
    }
    groups(scene, "curve").into_iter().map(parts).collect()
}

#[derive(Clone, Copy, Debug)]
struct Rect {
    low: Point,
    high: Point,
}

impl Rect {
    /// The box of a text that extends by these distances above and below its baseline, in ems.
    fn from_text(text: &Text, [above, below]: [f64; 2]) -> Rect {
        assert_eq!(text.quarter_turns, 0);
        let start = text.start();
        let [above, below] = [above * text.size, below * text.size];
        Rect { low: start - Vector::new(0.0, above), high: start + Vector::new(text.width(), below) }
    }

    /// The box of a text with the ascent and descent of its face.
    fn from_face(text: &Text) -> Rect {
        let (above, below) = text.runs[0].face.ascent_and_descent();
        Rect::from_text(text, [above, below])
    }

    fn is_in(&self, outer: &Rect) -> bool {
        self.low.x >= outer.low.x
            && self.low.y >= outer.low.y
            && self.high.x <= outer.high.x
            && self.high.y <= outer.high.y
    }

    fn meets(&self, other: &Rect) -> bool {
        self.low.x < other.high.x && other.low.x < self.high.x && self.low.y < other.high.y && other.low.y < self.high.y
    }

    fn distance(&self, p: Point) -> f64 {
        let off = |p: f64, low: f64, high: f64| (low - p).max(p - high).max(0.0);
        Vector::new(off(p.x, self.low.x, self.high.x), off(p.y, self.low.y, self.high.y)).norm()
    }

    /// The distance of a segment from the box; 0 if it passes through.
    fn distance_to_segment(&self, a: Point, b: Point) -> f64 {
        let [p, q] = [Point::new(self.low.x, self.high.y), Point::new(self.high.x, self.low.y)];
        let crosses = |[c, d]: [Point; 2]| {
            let side = |o: Point, u: Point, v: Point| (u - o).perp(&(v - o));
            side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
        };
        // A segment that passes through a box crosses one of its diagonals.
        if [[self.low, self.high], [p, q]].into_iter().any(crosses) {
            return 0.0;
        }
        let corners = [self.low, p, q, self.high].map(|corner| distance_to_segment(corner, a, b));
        corners.into_iter().chain([self.distance(a), self.distance(b)]).fold(f64::INFINITY, f64::min)
    }
}

/// The box of the middle of the border's line, which is drawn first.
fn border(scene: &Scene) -> Rect {
    let Some((_, Item::Path(path))) = items(scene).into_iter().next() else { panic!("the first item is not a border") };
    let points = &path.polylines[0].points;
    let extent = |coordinate: fn(&Point) -> f64| {
        points.iter().map(coordinate).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)])
    };
    let ([left, right], [top, bottom]) = (extent(|p| p.x), extent(|p| p.y));
    Rect { low: Point::new(left, top), high: Point::new(right, bottom) }
}

/// The items of a page that are not inside its border, with half the widths of their strokes.
fn outside(scene: &Scene) -> Vec<String> {
    let inner = border(scene);
    let mut out = Vec::new();
    for (class, item) in items(scene).into_iter().skip(1) {
        let around = |p: Point, margin: f64| Rect { low: p - Vector::repeat(margin), high: p + Vector::repeat(margin) };
        let half = |stroke: Option<coupler_drawing::scene::Stroke>| stroke.map_or(0.0, |stroke| stroke.width / 2.0);
        let is_in = match item {
            Item::Circle(circle) => around(circle.centre, circle.radius + half(circle.stroke)).is_in(&inner),
            Item::Text(text) => text.runs.is_empty() || Rect::from_face(text).is_in(&inner),
            Item::Path(path) => path.polylines.iter().flat_map(|line| &line.points).all(|p| {
                assert!(p.x.is_finite() && p.y.is_finite(), "{class}");
                around(*p, half(path.stroke)).is_in(&inner)
            }),
            Item::Curve(curve) => curve.splines.iter().flat_map(|spline| spline.flatten(1e-3)).all(|p| {
                assert!(p.x.is_finite() && p.y.is_finite(), "{class}");
                around(p, curve.stroke.width / 2.0).is_in(&inner)
            }),
            Item::Group(_) | Item::Animation(_) => unreachable!("`items` descends into groups"),
        };
        if !is_in {
            out.push(if let Item::Text(text) = item {
                format!("{class}: {}", content(text))
            } else {
                class.to_owned()
            });
        }
    }
    out
}

/// The texts of a page that overlap.
fn overlaps(scene: &Scene) -> Vec<String> {
    // Room for capitals, figures and descenders: no letters with accents are on these pages.
    let below = |class: &str| if class == "number" { 0.0 } else { 0.22 };
    let boxed =
        |(class, text): (&'static str, &Text)| (class, content(text), Rect::from_text(text, [0.73, below(class)]));
    let texts: Vec<(&str, String, Rect)> = texts(scene).into_iter().map(boxed).collect();
    let mut out = Vec::new();
    for (k, (class, a, rect)) in texts.iter().enumerate() {
        for (other, b, _) in texts[..k].iter().filter(|(_, _, other)| other.meets(rect)) {
            out.push(format!("{class} {a} and {other} {b}"));
        }
    }
    out
}

#[test]
#[ignore = "thorough"]
fn everything_is_inside_the_border_and_no_texts_overlap() {
    let plan = example();
    for paper in PAPERS {
        // Fewer of the pages on the papers that are rarely used.
        let step = if paper.0.min(paper.1) > 200.0 { 9 } else { 23 };
        for (k, scene) in all_pages(&plan, step, &options(paper)).iter().enumerate() {
            assert_eq!(outside(scene), [""; 0], "{paper:?} {k}");
            assert_eq!(overlaps(scene), [""; 0], "{paper:?} {k}");
        }
    }
}

/// The class of something that each number on a page touches, if there is any.
fn touched(scene: &Scene) -> Vec<Option<&'static str>> {
    let numbers: Vec<Rect> = texts(scene)
        .into_iter()
        .filter(|(class, _)| *class == "number")
        .map(|(_, text)| Rect::from_text(text, [0.73, 0.0]))
        .collect();
    let drawn = ["linkage", "underlay", "grid", "straight"]
        .into_iter()
        .flat_map(|class| paths(scene, &[class]).into_iter().map(move |path| (class, path)));
    let drawn = drawn.flat_map(|(class, path)| {
        let half = path.stroke.map_or(0.0, |stroke| stroke.width / 2.0);
        path.polylines.iter().map(move |line| (class, line.points.clone(), half))
    });
    let curves = curves(scene).into_iter().flatten().flat_map(|curve| {
        let half = curve.stroke.width / 2.0;
        curve.splines.iter().map(move |spline| ("curve", spline.flatten(1e-3), half))
    });
    let lines: Vec<(&'static str, Vec<Point>, f64)> = curves.chain(drawn).collect();
    let points = circles(scene, &["coupler-point", "linkage"]);
    let touch = |(k, number): (usize, &Rect)| {
        if numbers.iter().enumerate().any(|(other, rect)| other != k && rect.meets(number)) {
            return Some("number");
        }
        let is_on = |circle: &&Circle| {
            number.distance(circle.centre) < circle.radius + circle.stroke.map_or(0.0, |stroke| stroke.width / 2.0)
        };
        if points.iter().any(is_on) {
            return Some("point");
        }
        // Most segments are on one side of the number, which takes little to tell.
        let is_apart = |a: Point, b: Point, half: f64| {
            let Rect { low, high } = number;
            (a.x.max(b.x) < low.x - half || a.x.min(b.x) > high.x + half)
                || (a.y.max(b.y) < low.y - half || a.y.min(b.y) > high.y + half)
        };
        let is_crossed = |line: &[Point], half: f64| {
            let mut segments = line.windows(2).filter(|p| !is_apart(p[0], p[1], half));
            segments.any(|p| number.distance_to_segment(p[0], p[1]) < half)
        };
        lines.iter().find(|(_, line, half)| is_crossed(line, *half)).map(|(class, ..)| *class)
    };
    numbers.iter().enumerate().map(touch).collect()
}

#[test]
#[ignore = "thorough"]
fn numbers_touch_nothing_that_is_drawn() {
    let plan = example();
    for paper in [PAPERS[0], PAPERS[2]] {
        let scenes = all_pages(&plan, 1, &options(paper));
        assert_eq!(scenes.len(), 780);
        let all: Vec<Option<&str>> = scenes.iter().flat_map(touched).collect();
        // Where curves are close, there is no space for a second number that is clearly next to its curve.
        assert!((15_200..=15_600).contains(&all.len()), "{paper:?}: {}", all.len());
        // Where lines are close there may be no free position; of 7,800 numbers this concerns one on A4.
        let touching = all.iter().filter(|touched| touched.is_some()).count();
        assert!(touching <= 12, "{paper:?}: {touching}");
    }
}

/// Panics if a page of some papers has type that is too small to read.
fn assert_readable(papers: &[(&str, Paper)]) {
    let plan = example();
    for &(name, paper) in papers {
        let scenes = all_pages(&plan, 40, &Options::for_paper(paper));
        let sizes = scenes.iter().flat_map(texts).map(|(_, text)| text.size * 72.0 / 25.4);
        let least = sizes.fold(f64::INFINITY, f64::min);
        // In points, up to rounding.
        assert!(least > 6.0 - 1e-9, "{name}: {least}");
    }
}

#[test]
fn no_type_is_too_small_to_read() {
    assert_readable(&Paper::NAMED[..1]);
}

#[test]
#[ignore = "thorough"]
fn no_type_on_other_papers_is_too_small_to_read() {
    assert_readable(&Paper::NAMED[1..]);
}

/// The pages of the first cell of a manifest, on A4.
fn first(text: &str) -> (SolvedCell, Vec<(Scene, Vec<usize>)>) {
    let plan = plan(text);
    let planned = &plan.families[0];
    let solved = Solver::new(&planned.family).solve(0).unwrap();
    let pages = pages(&planned.family, &planned.source, &solved, &options(PAPERS[0]));
    for (scene, _) in &pages {
        assert_eq!(outside(scene), [""; 0]);
        assert_eq!(overlaps(scene), [""; 0]);
    }
    (solved, pages)
}

#[test]
fn each_point_is_drawn_once_and_each_curve_under_its_own_name() {
    let (solved, pages) = first(GOOD);
    let sizes: Vec<usize> = pages.iter().map(|(_, shown)| shown.len()).collect();
    assert_eq!((solved.curves.len(), sizes), (12, vec![10, 2]));
    for (scene, shown) in &pages {
        let ids: Vec<&str> = groups(scene, "curve").iter().map(|group| group.id.as_str()).collect();
        let expected: Vec<String> = shown.iter().map(|k| format!("grid-1-{}-1", k + 1)).collect();
        assert_eq!(ids, expected);
        let numbers: Vec<String> =
            texts(scene).iter().filter(|(class, _)| *class == "number").map(|(_, text)| content(text)).collect();
        // Each number is at its point, and again at the far end of its curve.
        let expected: Vec<String> = shown.iter().chain(shown).map(|k| (k + 1).to_string()).collect();
        assert_eq!(numbers, expected);
        assert_eq!(circles(scene, &["coupler-point"]).len(), shown.len());
    }
}

#[test]
fn curves_of_one_ink_differ_in_every_theme() {
    for named in Theme::NAMED {
        let mut plan = plan(GOOD);
        plan.page.theme = (named.theme)();
        let scene = all_pages(&plan, 1, &plan.page).remove(0);
        let theme = &plan.page.theme;
        let inks: Vec<Color> = curves(&scene).iter().map(|[_, dashes]| dashes.stroke.color).collect();
        assert_eq!(inks, [theme.curve_inks.clone(), theme.curve_inks.clone()].concat(), "{}", named.name);
        // The table shows each curve in its strokes.
        let swatches: Vec<Stroke> = paths(&scene, &["swatch"]).iter().map(|path| path.stroke.unwrap()).collect();
        let strokes: Vec<Stroke> = curves(&scene).into_iter().flatten().map(|curve| curve.stroke).collect();
        assert_eq!(swatches, strokes, "{}", named.name);
        // Each has a thin continuous line under its dashes; that of the second five is in full ink, and their points
        // are filled.
        for (k, [whole, dashes]) in curves(&scene).into_iter().enumerate() {
            assert_eq!((whole.splines.len(), dashes.splines.len()), (1, 72));
            assert!(whole.stroke.width < 0.6 * dashes.stroke.width, "{}", named.name);
            assert_eq!(whole.stroke.color == dashes.stroke.color, k >= 5, "{}", named.name);
        }
        let fills: Vec<Color> = circles(&scene, &["coupler-point"]).iter().map(|circle| circle.fill.unwrap()).collect();
        assert_eq!(fills, [vec![theme.paper; 5], theme.curve_inks.clone()].concat(), "{}", named.name);
    }
}

#[test]
fn a_dash_begins_at_each_fifth_degree() {
    let (solved, pages) = first(GOOD);
    let pose = page::clearest_pose(&solved).unwrap();
    let (scene, shown) = &pages[0];
    // The map from the plane to the page, from two of the coupler points.
    let at: Vec<Point> = circles(scene, &["coupler-point"]).iter().map(|circle| circle.centre).collect();
    let place = |k: usize| pose[solved.curves[shown[k]].joint];
    let scale = (at[9] - at[0]).norm() / (place(9) - place(0)).norm();
    let on_page = |p: Point| {
        let off = (p - place(0)) * scale;
        at[0] + Vector::new(off.x, -off.y)
    };
    for ([_, dashes], &k) in curves(scene).iter().zip(shown) {
        assert_eq!(dashes.splines.len(), 72);
        let pass = &solved.circuit(&solved.curves[k]).passes[0];
        for (dash, spline) in dashes.splines.iter().enumerate() {
            let point = |input: f64| on_page(motion::pose(&solved.linkage, pass, input)[solved.curves[k].joint]);
            let begins = 5.0 * dash as f64;
            let ends = [(begins, spline.start), (begins + 3.0, spline.end())];
            for (input, end) in ends {
                // In millimetres: rounding, also of the positions of the circles on the page.
                assert!((end - point(input)).norm() < 1e-6, "curve {k}, {input} degrees");
            }
        }
    }
}

#[test]
fn a_page_has_ten_of_the_points_that_are_kept() {
    let fifty = GOOD.replace(
        "count = 3 }, across = { from = -1, to = 1, count = 4 }",
        "count = 5 }, across = { from = -1, to = 1, count = 10 }",
    );
    let (solved, pages) = first(&format!("{fifty}where = \"length > 5.5\"\n"));
    let kept = solved.curves.len();
    assert!(kept > 10 && kept < 50 && solved.left_out_count == 50 - kept, "{kept}");
    let sizes: Vec<usize> = pages.iter().map(|(_, shown)| shown.len()).collect();
    assert_eq!(sizes.iter().sum::<usize>(), kept);
    assert!(sizes.len() == kept.div_ceil(10) && sizes[..sizes.len() - 1].iter().all(|&size| size == 10), "{sizes:?}");
    let all: Vec<usize> = pages.into_iter().flat_map(|(_, shown)| shown).collect();
    assert_eq!(all, (0..kept).collect::<Vec<_>>());
}

#[test]
fn both_circuits_of_a_point_are_on_its_page() {
    let (solved, pages) = first(&GOOD.replace("continuation", "circuits = \"all\"\ncontinuation"));
    assert_eq!((solved.motion.circuits.len(), solved.curves.len(), pages.len()), (2, 24, 2));
    let (scene, shown) = &pages[0];
    assert_eq!((shown.len(), circles(scene, &["coupler-point"]).len()), (20, 10));
    // Curves of the same point have the same ink.
    let inks: Vec<Color> = curves(scene).iter().map(|[_, dashes]| dashes.stroke.color).collect();
    assert!(inks.chunks(2).all(|pair| pair[0] == pair[1]) && inks[0] != inks[2]);
    let all: Vec<String> = texts(scene).iter().map(|(_, text)| content(text)).collect();
    assert!(["1/1", "1/2", "10/2"].iter().all(|row| all.iter().any(|text| text == row)), "{all:?}");
}

#[test]
fn long_captions_and_single_points_fit() {
    let long = "a caption that goes on and on, g = {g:.5}, which is the frame, and then on again to no end";
    let (_, pages) = first(&GOOD.replace("g = {g:.1}", long));
    assert_eq!(pages.len(), 2);
    let grid = "along = { from = 0.5, to = 1.5, count = 3 }, across = { from = -1, to = 1, count = 4 }";
    let (_, pages) = first(&GOOD.replace(grid, "along = 0.5, across = 0.25"));
    assert_eq!((pages.len(), pages[0].1.len()), (1, 1));
}

#[test]
fn a_page_keeps_its_number_however_long_its_titles_are() {
    let long = "goes on and on and then on again, ".repeat(60);
    let text = format!("{GOOD}title = \"A family with a title that {long}\"\n")
        .replace("\"T\"", "\"An atlas of no few words, with a title as long as that\"");
    for (k, (scene, _)) in first(&text).1.iter().enumerate() {
        let number = format!("… · page {} of 2", k + 1);
        assert!(texts(scene).iter().any(|(_, text)| content(text).ends_with(&number)), "{number}");
    }
}

#[test]
fn hairlines_connect_the_link_with_all_points() {
    let plan = example();
    for solved in solve_cells(&plan, 40) {
        for (scene, _) in pages(&plan.families[0].family, "", &solved, &options(PAPERS[2])) {
            let lines =
                |class| paths(&scene, &[class]).into_iter().flat_map(|path| &path.polylines).collect::<Vec<_>>();
            let hairs: Vec<[Point; 2]> = lines("grid").iter().map(|line| [line.points[0], line.points[1]]).collect();
            assert!(!hairs.is_empty() && hairs.iter().all(|[a, b]| (b - a).norm() > 0.1), "{hairs:?}");
            let links: Vec<[Point; 2]> =
                lines("linkage").iter().flat_map(|line| line.points.windows(2)).map(|p| [p[0], p[1]]).collect();
            // Segments meet if an end of one is on the other, or if each has its ends on both sides of the other.
            let meets = |[a, b]: [Point; 2], [c, d]: [Point; 2]| {
                let side = |o: Point, u: Point, v: Point| (u - o).perp(&(v - o));
                let crosses = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
                // To the rounding of coordinates on the page.
                let touches = |p: Point, q: Point, r: Point| distance_to_segment(p, q, r) < 1e-6;
                crosses || touches(a, c, d) || touches(b, c, d) || touches(c, a, b) || touches(d, a, b)
            };
            assert!(hairs.iter().any(|hair| links.iter().any(|link| meets(*hair, *link))), "{hairs:?}");
            // The hairlines meet one another too.
            assert!(hairs.iter().all(|hair| hairs.len() == 1 || hairs.iter().any(|o| o != hair && meets(*hair, *o))));
        }
    }
}

#[test]
fn positions_have_enough_digits_and_joints_have_none() {
    let near = "along = { from = 0.9995, to = 1.0005, count = 3 }, across = { from = -0.001, to = 0.001, count = 2 }";
    let grid = "along = { from = 0.5, to = 1.5, count = 3 }, across = { from = -1, to = 1, count = 4 }";
    let texts_of = |text: &str| -> Vec<String> {
        first(text).1.iter().flat_map(|(scene, _)| texts(scene)).map(|(_, text)| content(text)).collect()
    };
    let lines = texts_of(&GOOD.replace(grid, near));
    assert!(
        ["0.9995", "1.0000", "1.0005", "0.001", "−0.001"].iter().all(|place| lines.contains(&(*place).to_owned())),
        "{lines:?}"
    );
    let lines = texts_of(GOOD);
    assert!(["0.50", "1.50", "0.33", "−1.00"].iter().all(|place| lines.contains(&(*place).to_owned())), "{lines:?}");
    let point = format!("M = {{ point = [\"A\", \"B\"], {grid} }}\n");
    let lines = texts_of(&GOOD.replace("[\"M\"]", "[\"B\"]").replace(&point, ""));
    assert!(lines.contains(&"point".to_owned()) && !lines.contains(&"along".to_owned()), "{lines:?}");
}

/// Proportions for the parameters of the catalogue that have no default.
const GIVEN: [(&str, &[(&str, f64)]); 5] = [
    ("four-bar", &[("frame", 4.0), ("crank", 1.0), ("coupler", 3.0), ("rocker", 3.5)]),
    ("evans", &[("p", 2.0), ("a", 2.59)]),
    ("chebyshev", &[("p", 2.0), ("r", 2.5)]),
    ("roberts", &[("p", 2.0), ("r", 1.2), ("a", 1.0), ("b", 1.2)]),
    ("watt", &[("p", 4.0), ("r", 2.2), ("a", 1.0)]),
];

#[test]
fn every_linkage_of_the_catalogue_has_a_page() {
    let mut slides = 0;
    for template in catalogue::all() {
        slides += usize::from(template.is_driven_by_length());
        let given = GIVEN.iter().find(|(id, _)| *id == template.id).map_or(&[][..], |(_, given)| given);
        let given: Vec<(String, f64)> = given.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        let family = Family::single_cell(template.clone(), &given, Sampling::Samples(72));
        let family = family.unwrap_or_else(|errors| panic!("{}: {errors:?}", template.id));
        let solved = Solver::new(&family).solve(0).unwrap();
        for paper in [PAPERS[0], PAPERS[2], PAPERS[4], PAPERS[5]] {
            for (scene, shown) in pages(&family, template.source.as_str(), &solved, &options(paper)) {
                let id = &template.id;
                assert!(!shown.is_empty(), "{id}");
                assert_eq!(groups(&scene, "curve").len(), shown.len(), "{id}");
                // Hairlines lead to the points of grids, and not to joints of links.
                let is_grid = id == "hrones-nelson";
                assert_eq!(!paths(&scene, &["grid"]).is_empty(), is_grid, "{id}");
                assert_eq!(outside(&scene), [""; 0], "{id} {paper:?}");
                assert_eq!(overlaps(&scene), [""; 0], "{id} {paper:?}");
            }
        }
    }
    assert!(slides > 0);
}

#[test]
fn a_coupler_grid_has_no_panels() {
    let text = format!("{GOOD}panels = [2, 2]\n");
    let printed = problems(&text);
    assert!(printed.contains("a page of a coupler grid has one cell and no panels"), "{printed}");
}

/// The pages of a manifest as the program writes them, in order.
fn rendered(text: &str) -> Vec<String> {
    let atlas = Atlas::rendered(text, &[]);
    let page = |k: usize| fs::read_to_string(atlas.out().join(format!("grid/grid-{k:03}.svg"))).ok();
    (1..).map_while(page).collect()
}

#[test]
fn pages_are_numbered_throughout_the_family() {
    let pages = rendered(GOOD);
    assert_eq!(pages.len(), 5);
    for (k, page) in pages.iter().enumerate() {
        assert!(page.contains(&format!("page {} of 5<", k + 1)), "{k}");
        assert_eq!(page.matches("class=\"curve\"").count(), [10, 2, 10, 2, 0][k], "{k}");
    }
    // A cell that cannot be assembled has one page, with the reason.
    assert!(pages[4].contains("not assembled") && pages[4].contains("</tspan> = 9.0<"), "{}", pages[4]);
    assert!(!pages[..4].iter().any(|page| page.contains("not assembled")));
    for symbol in ["crank's pivot", "fixed pivot", "dash and gap: 5° of input", "every 30° of input"] {
        let symbol = symbol.replace('\'', "’");
        assert!(pages[3].contains(&symbol) && !pages[4].contains(&symbol), "{symbol}");
    }
    let kept = rendered(&format!("{GOOD}where = \"is_crank_rocker or is_change_point\"\n"));
    assert_eq!(kept.len(), 4);
    assert!(kept[3].contains("page 4 of 4<") && kept[3].contains("change-point"));
}

/// The lines of text outside of groups, as one text: the heads, rows and notes.
fn running_text(scene: &Scene) -> String {
    let lines = texts(scene).into_iter().filter(|(class, _)| class.is_empty()).map(|(_, text)| content(text));
    lines.collect::<Vec<_>>().join(" ")
}

#[test]
fn a_page_has_every_length_in_full_and_the_names_of_the_joints() {
    for (g, length) in [("2", "2"), ("2.123456789012", "2.123456789012"), ("sqrt(6)", "2.449489742783178")] {
        let case = format!("cases = [{{ g = \"{g}\" }}]");
        let (_, pages) = first(&GOOD.replace("grid = { g = [2, 3, 9] }", &case));
        for (scene, _) in &pages {
            let text = running_text(scene);
            for line in [&format!("frame OC: g = {length}"), "crank OA: 1", "coupler AB: 2", "rocker CB: 2, the output"]
            {
                assert!(text.contains(line), "{line}: {text}");
            }
            let names: Vec<String> =
                texts(scene).iter().filter(|(class, _)| *class == "key").map(|(_, text)| content(text)).collect();
            assert!(["O", "A", "B", "C", "0°"].iter().all(|name| names.contains(&(*name).to_owned())), "{names:?}");
        }
    }
}

#[test]
fn a_change_point_says_what_it_is_and_where() {
    let (solved, pages) = first(&GOOD.replace("[2, 3, 9]", "[3]"));
    assert_eq!(solved.first_curve_values()[0], coupler_curves::measure::Value::Word("change-point"));
    let text = running_text(&pages[0].0);
    assert!(text.contains("all links on one line at 180°: there the motion is not determined"), "{text}");
    let (_, pages) = first(GOOD);
    assert!(!running_text(&pages[0].0).contains("not determined"));
}

#[test]
fn the_transmission_angle_has_the_extremes_that_are_measured() {
    let plan = example();
    for solved in solve_cells(&plan, 35) {
        let [least, greatest] = [Measure::MU_MIN, Measure::MU_MAX].map(|key| solved.curves[0].measure(key).unwrap());
        let (scene, _) = &pages(&plan.families[0].family, "", &solved, &options(PAPERS[2]))[0];
        let text = running_text(scene);
        // A crank is on the frame line where the angle is extreme.
        let note = format!("least {least:.1}° at 0° of input, greatest {greatest:.1}° at 180°");
        assert!(text.contains(&note), "{note}: {text}");
    }
}

#[test]
fn graphs_are_the_speeds_of_their_points_on_one_scale() {
    let (solved, pages) = first(GOOD);
    let (scene, shown) = &pages[0];
    let top: f64 = texts(scene).iter().find_map(|(_, text)| content(text).strip_prefix("0 to ")?.parse().ok()).unwrap();
    let pass = &solved.circuit(&solved.curves[0]).passes[0];
    let graphs = groups(scene, "speed");
    assert_eq!(graphs.len(), shown.len());
    // The height on paper of a unit of speed, and the greatest speed.
    let (mut unit, mut greatest) = (None, 0.0_f64);
    for (graph, &k) in graphs.iter().zip(shown) {
        let [Item::Path(axis), Item::Path(speed)] = &graph.items[..] else { panic!("{graph:?}") };
        let [from, to] = [axis.polylines[0].points[0], axis.polylines[0].points[1]];
        for p in &speed.polylines[0].points {
            let input = 360.0 * (p.x - from.x) / (to.x - from.x);
            // The difference quotient over a degree, per radian; the crank is 1 long.
            let place = |input: f64| motion::pose(&solved.linkage, pass, input)[solved.curves[k].joint];
            let expected = (place(input + 0.5) - place(input - 0.5)).norm() / 1_f64.to_radians();
            let height = from.y - p.y;
            let unit = *unit.get_or_insert(height / expected);
            assert!((height / unit - expected).abs() < 2e-3, "{k} at {input}: {} {expected}", height / unit);
            greatest = greatest.max(expected);
        }
    }
    assert!(greatest <= top + 1e-3 && greatest > 0.7 * top, "{greatest} {top}");
}

#[test]
fn change_points_are_a_chapter_after_the_others_in_a_book() {
    let text = GOOD.replace("\"svg\"", "\"pdf\"").replace("[2, 3, 9]", "[3, 2, 2.5]");
    let text = text.replace("id = \"grid\"", "id = \"grid\"\ntitle = \"grid\"");
    let atlas = Atlas::rendered(&text, &[]);
    let pdf = crate::book::reader::Pdf::read(&fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let outline = pdf.outline();
    let page_of = |title: &str| outline.iter().find(|entry| entry.0 == 0 && entry.1 == title).unwrap().2;
    let front = page_of("grid");
    assert_eq!((page_of("Contents"), page_of("grid: change points")), (3, front + 4));
    let cells: Vec<(&str, usize)> = outline
        .iter()
        .filter(|(depth, title, _)| *depth == 1 && title.starts_with("g ="))
        .map(|(_, title, page)| (title.as_str(), *page))
        .collect();
    assert_eq!(cells, [("g = 2.0", front), ("g = 2.5", front + 2), ("g = 3.0", front + 4)]);
    // Each page has one number, that of the book, outside its border.
    for k in 0..6 {
        let texts = pdf.contents(front + k).texts;
        let folios = texts.iter().filter(|(text, at, _)| *text == (k + 1).to_string() && at[1] > 272.0).count();
        assert!(folios == 1 && !texts.iter().any(|(text, ..)| text.contains(" of 6")), "{k}: {texts:?}");
    }
    let contents = pdf.contents(3).texts;
    assert!(contents.iter().any(|(text, ..)| text == "grid: change points"), "{contents:?}");
}

/// The texts of a page of a manifest that is rendered as SVG, in its order.
fn page_texts(manifest: &str, page: &str) -> Vec<String> {
    svg_texts(&Atlas::rendered(manifest, &["-q", "--format", "svg", "-o", "out"]).read(page))
}

#[test]
fn long_titles_and_captions_are_printed_in_full() {
    let [atlas, title] =
        ["an atlas", "a family"].map(|of| format!("A long title of {of} that is printed in full on each of its pages"));
    let caption = "the ratios A = {A:.2}, B = {B:.2} and C = {C:.2} of a linkage with a caption that goes on and on";
    let text = format!(
        "[atlas]\ntitle = \"{atlas}\"\n[page]\npaper = {{ width = \"210 mm\", height = \"148 mm\" }}\n[[family]]\nid = \"f\"\n\
         title = \"{title}\"\nlinkage = \"hrones-nelson\"\nlayout = \"coupler-grid\"\ncaption = \"{caption}\"\n\
         cases = [{{ A = 2.5, B = 3, C = 2 }}, {{ A = 2.5, B = 3.5, C = 2 }}]\n"
    );
    let all = page_texts(&text, "f/f-001.svg").join(" ");
    let caption = "the ratios A = 2.50, B = 3.00 and C = 2.00 of a linkage with a caption that goes on and on";
    for whole in [caption, &format!("{atlas} · {title}"), "page 1 of 2"] {
        assert!(all.contains(whole), "{whole}: {all}");
    }
}

#[test]
fn a_page_on_which_nothing_varies_has_the_title_of_its_family() {
    let text = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"f\"\ntitle = \"A family of one\"\nlinkage = \"one\"\n\
        layout = \"coupler-grid\"\ncases = [{}]\n[[linkage]]\nid = \"one\"\ntrace = [\"M\"]\n[linkage.joints]\n\
        O = { fixed = [0, 0] }\nC = { fixed = [3, 0] }\nA = { crank = \"O\", length = 1 }\n\
        B = { dyad = [\"A\", \"C\"], lengths = [2.5, 2.5], side = \"left\" }\n\
        M = { point = [\"A\", \"B\"], along = { from = 0, to = 2, count = 4 }, across = 0.5 }\n";
    let texts = page_texts(text, "f/f-001.svg");
    assert!(texts.contains(&"A family of one".to_owned()) && texts.contains(&"T".to_owned()), "{texts:?}");
    // Two thirds and four thirds are in full as fractions.
    assert!(texts.join(" ").contains("in full: 2 / 3, 4 / 3"), "{texts:?}");
}

#[test]
fn the_key_names_both_coordinates_of_a_point_on_small_paper() {
    for paper in ["\"tabloid\"", "\"a5\"", "\"a6\"", "\"a6\"\norientation = \"portrait\""] {
        let text = format!(
            "[atlas]\ntitle = \"T\"\n[page]\npaper = {paper}\n[[family]]\nid = \"f\"\nlinkage = \"hrones-nelson\"\n\
             layout = \"coupler-grid\"\ncases = [{{ A = 2.5, B = 3, C = 2 }}]\n"
        );
        let texts = page_texts(&text, "f/f-001.svg");
        // In the key and at the head of a column.
        let count = |name: &str| texts.iter().filter(|text| *text == name).count();
        assert_eq!(["along", "across"].map(count), [2, 2], "{paper}: {texts:?}");
        assert!(!texts.iter().any(|text| text.ends_with(" more")), "{paper}: {texts:?}");
    }
}

#[test]
fn the_pages_of_a_linkage_have_the_same_columns() {
    // Only points near the first page have cusps.
    let (_, pages) = first(&GOOD.replace("from = -1, to = 1, count = 4", "from = 0, to = 3, count = 4"));
    let heads = |scene: &Scene| -> Vec<(String, u64)> {
        let all = texts(scene).into_iter().map(|(_, text)| (content(text), text.position.x.to_bits()));
        all.filter(|(text, _)| {
            ["along", "across", "length", "from", "over", "radius", "cusps"].contains(&text.as_str())
        })
        .collect()
    };
    let in_table = |scene: &Scene| heads(scene).split_off(2);
    assert_eq!(in_table(&pages[0].0), in_table(&pages[1].0));
}

#[test]
fn names_in_the_key_touch_no_line_on_small_paper() {
    let plan = example();
    for scene in all_pages(&plan, 40, &options((105.0, 148.0))) {
        let names = texts(&scene).into_iter().filter(|(_, text)| ["along", "0°"].contains(&content(text).as_str()));
        for (_, name) in names.take(2) {
            let rect = Rect::from_text(name, [0.7, 0.0]);
            let lines = paths(&scene, &["key"]).into_iter().flat_map(|path| &path.polylines);
            let touches = |p: &[Point]| rect.distance_to_segment(p[0], p[1]) < 1e-3;
            assert!(lines.into_iter().all(|line| !line.points.windows(2).any(touches)), "{}", content(name));
        }
    }
}

/// A four-bar with long names and an expression for a length, on paper.
fn long_names(paper: &str) -> String {
    format!(
        "[atlas]\ntitle = \"T\"\n[page]\npaper = {paper}\n[[linkage]]\nid = \"l\"\ntrace = [\"M\"]\n\
         parameters = {{ A = {{ min = 0 }}, coupler_length = {{ min = 0 }} }}\ncaption = \"A = {{A}}\"\n[linkage.joints]\n\
         O = {{ fixed = [0, 0] }}\nC = {{ fixed = [\"A\", \"A / 2\"] }}\nCrankpin = {{ crank = \"O\", length = 1 }}\n\
         Knuckle = {{ dyad = [\"Crankpin\", \"C\"], lengths = [\"coupler_length\", \"A / 1.1\"], side = \"left\" }}\n\
         M = {{ point = [\"Crankpin\", \"Knuckle\"], along = {{ from = 0, to = \"A\", count = 5 }}, across = {{ from = -1, to = 1, count = 2 }} }}\n\
         [[family]]\nid = \"f\"\nlinkage = \"l\"\nlayout = \"coupler-grid\"\ncases = [{{ A = \"10 / 3\", coupler_length = 3 }}]\n"
    )
}

#[test]
fn all_lengths_are_stated_however_long_the_names_and_small_the_paper() {
    let smallest = "{ width = \"100 mm\", height = \"100 mm\" }";
    for paper in ["\"a4\"", "\"a5\"", "\"a6\"", "\"a6\"\norientation = \"portrait\"", smallest] {
        let texts = page_texts(&long_names(paper), "f/f-001.svg");
        let all = texts.join(" ");
        for whole in [
            "crank O–Crankpin: 1",
            "coupler length = 3",
            "rocker C–Knuckle: 100 / 33 ≈ 3.0303",
            "from (0, 0) to (10 / 3 ≈ 3.33333, 5 / 3 ≈ 1.66667)",
        ] {
            assert!(all.contains(whole), "{paper}: {whole}: {all}");
        }
        // A coordinate of ten thirds is rounded in the table, and says so.
        assert!(texts.contains(&"≈ along".to_owned()) && !texts.contains(&"≈ across".to_owned()), "{paper}: {all}");
        let rows = (1..=10).filter(|k| texts.contains(&k.to_string())).count();
        assert!(rows == 10 && !all.contains(" more"), "{paper}: {all}");
    }
}
