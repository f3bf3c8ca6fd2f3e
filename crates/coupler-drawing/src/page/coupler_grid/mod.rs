//! The `coupler-grid` layout: a linkage with a grid of points on its coupler, and the curves of ten of them.
//!
//! All pages of a cell have one pose, and each the largest scale at which linkage and curves fit its frame. To the right
//! of the figure stands a column: the key, which says what the letters are, and a table of the points.

mod foot;
mod grid;
mod key;
mod labels;
mod table;

use plotters::drawing::IntoDrawingArea;

use super::arrangement::Frame;
use super::element::{Area, CouplerCurve, Drawing, draw};
use super::figure;
use super::heading;
use super::marks;
use super::mechanism::Mechanism;
use super::plot::Plot;
use super::theme::Theme;
use super::{GridSheet, Layout, Options, Panel, View, pose};
use crate::scene::{Anchor, Canvas, Circle, Color, Item, Path, Scene, Text};
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector};
use coupler_curves::linkage::Input;
use coupler_curves::motion::{self, Dashes};
use coupler_curves::solve::{Curve, Solved};
use labels::Obstacles;

/// What is read of a page, and in which ink: a curve, its coupler point and its row in the table.
struct Shown<'a> {
    curve: &'a Curve,
    /// Its traced point's place on the page, from 0.
    place: usize,
}

impl Shown<'_> {
    /// There are more points on a page than inks: the same ink is used again with a thin line under the dashes.
    fn is_lined(&self, theme: &Theme) -> bool {
        self.place / theme.curves.len() % 2 == 1
    }

    fn ink(&self, theme: &Theme) -> Color {
        theme.curve_ink(self.place)
    }
}

pub(super) fn compose(scene: &mut Scene, sheet: &GridSheet, options: &Options, theme: &Theme) {
    let size = Vector::new(scene.width, scene.height);
    let theme = &legible(theme, size);
    let root = Canvas::new(scene).into_drawing_area();
    heading::border(&root, theme);
    let foot = foot::draw(&root, sheet, options, theme);
    let edge = theme.border + theme.margin;
    let column = (0.19 * size.x).max(COLUMN * theme.note);
    let height = size.y - edge - foot;
    let whole = Frame { corner: Point::new(edge, edge), size: Vector::new(size.x - 2.0 * edge, height) };
    let figure = Frame { size: whole.size - Vector::new(column + GUTTER * theme.note, 0.0), ..whole };
    let side = Frame { corner: Point::new(size.x - edge - column, edge), size: Vector::new(column, height) };
    let solved = sheet.panel.solved;
    let shown = shown(solved, &sheet.shown);
    match figure_of(&sheet.panel) {
        Some(mechanism) => {
            draw_figure(&root, figure, sheet, &mechanism, &shown, options, theme);
            let below = key::draw(&root, side, sheet, &mechanism, theme);
            table::draw(&root, below, sheet, &shown, theme);
        }
        None => {
            let reason = solved.motion.shortfall.as_deref().unwrap_or("no curve is kept");
            super::panels::draw_reason(&root, whole, reason, theme);
        }
    }
    foot::source(&root, side, sheet, theme);
}

/// The theme with notes so large that all that is smaller by them can be read, as far as the paper has room for that.
fn legible(theme: &Theme, paper: Vector) -> Theme {
    /// The em of the least lettering of these pages, in millimetres: 5.5 points.
    const LEAST: f64 = 5.5 * 25.4 / 72.0;
    /// The em of the number at a scale bar, the least there is, in that of a note.
    const OF_NOTE: f64 = 0.75;
    let room = (0.3 * paper.x / COLUMN).min(0.0125 * paper.y);
    let note = theme.note.max((LEAST / OF_NOTE).min(room));
    Theme { note, source: theme.source.max(note), ..theme.clone() }
}

/// The least width of the column, in ems of a note.
const COLUMN: f64 = 22.0;

/// What is free between figure and column, likewise: the dashes of curves are not to run into those of the table.
const GUTTER: f64 = 2.0;

/// The curves of a page, numbered by their points.
fn shown<'a>(solved: &'a Solved, places: &[usize]) -> Vec<Shown<'a>> {
    let mut traces: Vec<usize> = Vec::with_capacity(Layout::POINTS);
    let mut shown = Vec::with_capacity(places.len());
    for curve in places.iter().filter_map(|&k| solved.curves.get(k)) {
        let place = traces.iter().position(|trace| *trace == curve.trace).unwrap_or_else(|| {
            traces.push(curve.trace);
            traces.len() - 1
        });
        shown.push(Shown { curve, place });
    }
    shown
}

/// The linkage in its pose, where it can be assembled.
fn figure_of<'a>(panel: &'a Panel) -> Option<Mechanism<'a>> {
    let solved = panel.solved;
    let circuit = solved.circuit(solved.curves.first()?);
    let pose = match &panel.view {
        View::At(pose) => pose.clone(),
        View::Clearest | View::Moving { .. } => pose::clearest(&solved.linkage, circuit),
    };
    Some(Mechanism::new(&solved.linkage, circuit, pose, &panel.inks))
}

fn draw_figure(
    area: &Area,
    frame: Frame,
    sheet: &GridSheet,
    mechanism: &Mechanism,
    shown: &[Shown],
    options: &Options,
    theme: &Theme,
) {
    let solved = sheet.panel.solved;
    let grid = grid::Grid::of(&solved.linkage, shown.iter().map(|s| s.curve.joint));
    let curves = shown.iter().flat_map(|s| solved.circuit(s.curve).points(s.curve.joint));
    let extents = Bounds::of(curves.chain(grid.points(&mechanism.pose))).union(mechanism.bounds());
    let plot = Plot::new(frame, theme).of(extents);
    plot.bar(area, theme);
    let period = figure::dash(solved, options);
    let dashes = |k: usize| Dashes { period, drawn: theme.curve_drawn(shown[k].place) * period };
    let paths = figure::paths(solved, &sheet.shown, plot.page_from_plane, dashes);
    let underlay = mechanism.underlay(&plot, theme);
    let grid = grid.items(&mechanism.pose, &plot, theme);
    let portion = |s: &Shown| marks::portion(solved, s.curve, s.ink(theme), &plot, theme);
    let straight: Vec<Item> = shown.iter().filter_map(portion).collect();
    let linkage = mechanism.items(&plot, theme, |_| theme.ink);
    let points = points(mechanism, shown, &plot, theme);

    let mut obstacles = Obstacles::default();
    [&underlay, &grid, &straight].into_iter().for_each(|items| obstacles.add(items, true));
    [&linkage, &points].into_iter().for_each(|items| obstacles.add(items, false));
    for (shown, path) in shown.iter().zip(&paths) {
        obstacles.add_points(&path.whole, theme.curve_stroke(shown.place).width, false);
    }
    let numbers = labels::place(numbers(mechanism, shown, &plot, theme), &obstacles, plot.above_bar(theme), theme);

    let group = |class, items| draw(area, &Drawing { class, title: String::new(), items });
    group("underlay", underlay);
    group("grid", grid);
    group("straight", straight);
    let lined = |(shown, path): (&Shown, &motion::Path)| {
        let line = || Path::stroked(path.whole.clone(), theme.stroke(shown.ink(theme), 0.6 * theme.fine));
        shown.is_lined(theme).then(|| Item::Path(line()))
    };
    group("trail", shown.iter().zip(&paths).filter_map(lined).collect());
    for (k, (shown, path)) in shown.iter().zip(paths).enumerate() {
        draw(area, &coupler_curve(sheet, shown, path, (plot.page_from_plane, dashes(k)), theme));
    }
    group("linkage", linkage);
    group("coupler-point", points);
    group("number", numbers);
}

/// The points of a page, each once, with their places on it.
fn distinct<'a>(
    mechanism: &Mechanism,
    shown: &'a [Shown],
    plot: &Plot,
) -> impl Iterator<Item = (Point, &'a Shown<'a>)> {
    let is_first = |k: usize| shown[..k].iter().all(|other| other.place != shown[k].place);
    let first = (0..shown.len()).filter(move |&k| is_first(k)).map(|k| &shown[k]);
    first.map(|s| (plot.page_from_plane.apply(mechanism.pose[s.curve.joint]), s))
}

/// The numbers of the points of a page, with the places of these.
fn numbers(mechanism: &Mechanism, shown: &[Shown], plot: &Plot, theme: &Theme) -> Vec<(Point, Text)> {
    let number = |s: &Shown| {
        let words = s.curve.trace.to_string();
        theme.words(&words, Point::origin(), Anchor::Middle, 0.85 * theme.note, s.ink(theme)).text
    };
    distinct(mechanism, shown, plot).map(|(centre, s)| (centre, number(s))).collect()
}

fn coupler_curve(
    sheet: &GridSheet,
    shown: &Shown,
    path: motion::Path,
    (page_from_plane, dashes): (Similarity, Dashes),
    theme: &Theme,
) -> CouplerCurve {
    let Curve { trace, circuit, .. } = shown.curve;
    let cell = sheet.panel.solved.cell.number;
    let stroke = theme.curve_stroke(shown.place);
    CouplerCurve {
        id: format!("{}-{cell}-{trace}-{circuit}", sheet.heading.family),
        class: "curve",
        title: format!("{}, no. {cell}: {}, point {trace}", sheet.heading.title, sheet.panel.caption),
        data: vec![("cell", cell.to_string()), ("trace", trace.to_string()), ("circuit", circuit.to_string())],
        page_from_plane,
        dashes,
        strokes: path.dashes,
        weights: [stroke, theme.stroke(theme.faded(stroke.color), theme.fine)],
        marks: Vec::new(),
    }
}

/// A small circle for each point of the page, once, where it is in the pose.
fn points(mechanism: &Mechanism, shown: &[Shown], plot: &Plot, theme: &Theme) -> Vec<Item> {
    let circle = |(centre, s): (Point, &Shown)| {
        let stroke = Some(theme.stroke(s.ink(theme), theme.fine));
        let fill = Some(if s.is_lined(theme) { s.ink(theme) } else { theme.paper });
        Item::Circle(Circle { centre, radius: 0.8 * theme.joint, stroke, fill })
    };
    distinct(mechanism, shown, plot).map(circle).collect()
}

/// The unit of the input, as it is written after a number.
fn input_unit(solved: &Solved) -> &'static str {
    if solved.linkage.input() == Input::Length { "" } else { "°" }
}
