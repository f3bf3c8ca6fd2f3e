//! The `coupler-grid` layout: a linkage with a grid of points on its coupler, and the curves of ten of these points.
//!
//! All pages of a cell show the same pose, each at the largest scale at which linkage and curves fit the frame. To the
//! right of the figure is a column with the key, which names the links, and a table of the points.

mod footer;
mod grid;
mod key;
mod labels;
mod table;

use super::area::{self, Area};
use super::arrangement::Rect;
use super::element::{CouplerCurve, Drawing};
use super::figure;
use super::heading;
use super::marks;
use super::mechanism::PosedMechanism;
use super::plot::Plot;
use super::theme::Theme;
use super::{CouplerGridPage, Layout, Options, Panel, PoseChoice, pose};
use crate::mechanism::Mechanism;
use crate::scene::{Anchor, Circle, Color, Item, Scene, Stroke, Text};
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector};
use coupler_curves::linkage::Input;
use coupler_curves::path::{DashPattern, JointPath};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use labels::Obstacles;

/// A curve on the page, which shares its ink with its coupler point and its row in the table.
struct ShownCurve<'a> {
    curve: &'a MeasuredCurve,
    /// The index of its traced point on the page.
    point_index: usize,
}

impl ShownCurve<'_> {
    /// Whether the line under the dashes is in full ink and the point is filled: a page has more points than inks, so
    /// each ink is used a second time.
    fn has_underline(&self, theme: &Theme) -> bool {
        self.point_index / theme.curve_inks.len() % 2 == 1
    }

    fn ink(&self, theme: &Theme) -> Color {
        theme.curve_ink(self.point_index)
    }

    /// The stroke of the line under the dashes.
    fn hairline(&self, theme: &Theme) -> Stroke {
        if self.has_underline(theme) {
            theme.stroke(self.ink(theme), 0.6 * theme.fine_width)
        } else {
            theme.stroke(theme.faded(self.ink(theme)), theme.hair_width)
        }
    }
}

pub(super) fn compose(scene: &mut Scene, page: &CouplerGridPage, options: &Options, theme: &Theme) {
    let size = Vector::new(scene.width, scene.height);
    let theme = &with_legible_notes(theme, size);
    let root = area::whole_page(scene);
    heading::draw_border(&root, theme);
    let foot = footer::draw(&root, page, options, theme);
    let edge = theme.border + theme.margin;
    let column = (0.19 * size.x).max(MIN_COLUMN_WIDTH * theme.note_size);
    let height = size.y - edge - foot;
    let whole = Rect { corner: Point::new(edge, edge), size: Vector::new(size.x - 2.0 * edge, height) };
    let figure = Rect { size: whole.size - Vector::new(column + GUTTER * theme.note_size, 0.0), ..whole };
    let side = Rect { corner: Point::new(size.x - edge - column, edge), size: Vector::new(column, height) };
    let solved = page.panel.solved_cell;
    let shown = shown_curves(solved, &page.curve_indices);
    match posed_mechanism(&page.panel) {
        Some(mechanism) => {
            draw_figure(&root, figure, page, &mechanism, &shown, options, theme);
            let rest = key::draw(&root, side, page, &mechanism, theme);
            table::draw(&root, rest, page, &shown, theme);
        }
        None => {
            super::panels::draw_not_assembled(&root, whole, solved, theme);
        }
    }
    footer::draw_source(&root, side, page, theme);
}

/// The theme with notes large enough for the smallest text, which is set in proportion to them, to be legible, as far
/// as the paper is large enough.
fn with_legible_notes(theme: &Theme, paper: Vector) -> Theme {
    /// The least font size on these pages, in millimetres: 5.5 points.
    const MIN_LETTERING: f64 = 5.5 * 25.4 / 72.0;
    /// The font size at a scale bar, which is the smallest, relative to that of notes.
    const SCALE_BAR_PART: f64 = 0.75;
    let most = (0.3 * paper.x / MIN_COLUMN_WIDTH).min(0.0125 * paper.y);
    let note = theme.note_size.max((MIN_LETTERING / SCALE_BAR_PART).min(most));
    Theme { note_size: note, source_size: theme.source_size.max(note), ..theme.clone() }
}

/// The least width of the column, in ems of a note.
const MIN_COLUMN_WIDTH: f64 = 22.0;

/// The gap between figure and column, in ems of a note: it separates the dashes of curves from those in the table.
const GUTTER: f64 = 2.0;

/// The curves of a page by their indices, with the indices of their points.
fn shown_curves<'a>(solved: &'a SolvedCell, curve_indices: &[usize]) -> Vec<ShownCurve<'a>> {
    let mut traces: Vec<usize> = Vec::with_capacity(Layout::POINTS_PER_PAGE);
    let mut shown = Vec::with_capacity(curve_indices.len());
    for curve in curve_indices.iter().filter_map(|&k| solved.curves.get(k)) {
        let point_index = traces.iter().position(|trace| *trace == curve.trace).unwrap_or_else(|| {
            traces.push(curve.trace);
            traces.len() - 1
        });
        shown.push(ShownCurve { curve, point_index });
    }
    shown
}

/// The linkage in its pose; `None` if the cell has no curve.
fn posed_mechanism<'a>(panel: &'a Panel) -> Option<PosedMechanism<'a>> {
    let solved = panel.solved_cell;
    let circuit = solved.circuit(solved.curves.first()?);
    let pose = match &panel.pose {
        PoseChoice::Fixed(pose) => pose.clone(),
        PoseChoice::Clearest | PoseChoice::Animated { .. } => pose::clearest_pose(&solved.linkage, circuit),
    };
    let mechanism = Mechanism::new(&solved.linkage, circuit);
    Some(PosedMechanism::new(&solved.linkage, mechanism, pose, &panel.link_inks))
}

/// The accuracy, in millimetres, of the lines that labels avoid.
const FLATNESS: f64 = 0.05;

fn draw_figure(
    area: &impl Area,
    frame: Rect,
    page: &CouplerGridPage,
    mechanism: &PosedMechanism,
    shown: &[ShownCurve],
    options: &Options,
    theme: &Theme,
) {
    let solved = page.panel.solved_cell;
    let grid = grid::PointGrids::from_joints(&solved.linkage, shown.iter().map(|s| s.curve.joint));
    let curves = shown.iter().flat_map(|s| solved.circuit(s.curve).points(s.curve.joint));
    let extents = Bounds::from_points(curves.chain(grid.line_ends(&mechanism.pose))).union(mechanism.bounds());
    let plot = Plot::new(frame, theme).fitted_to(extents);
    plot.draw_scale_bar(area, theme);
    let period = figure::dash_period(&solved.linkage, &solved.motion.circuits, options);
    let dashes = |k: usize| DashPattern { period, dash_span: theme.curve_dash_fraction(shown[k].point_index) * period };
    let path = |(k, s): (usize, &ShownCurve)| figure::curve_path(solved, s.curve, plot.page_from_plane, dashes(k));
    let paths: Vec<JointPath> = shown.iter().enumerate().map(path).collect();
    let underlay = mechanism.underlay_items(&plot, theme);
    let grid = grid.items(&mechanism.pose, &plot, theme);
    let portion = |s: &ShownCurve| marks::straight_portion_item(solved, s.curve, s.ink(theme), &plot, theme);
    let straight: Vec<Item> = shown.iter().filter_map(portion).collect();
    let linkage = mechanism.linkage_items(&plot, theme, |_| theme.ink);
    let points = point_circles(mechanism, shown, &plot, theme);

    let mut obstacles = Obstacles::default();
    [&underlay, &grid, &straight].into_iter().for_each(|items| obstacles.add(items, true));
    [&linkage, &points].into_iter().for_each(|items| obstacles.add(items, false));
    for (shown, path) in shown.iter().zip(&paths) {
        let weight = theme.curve_stroke(shown.point_index).width;
        path.whole.iter().for_each(|spline| obstacles.add_points(&spline.flatten(FLATNESS), weight, false));
    }
    let numbers = labels::place_labels(
        point_numbers(mechanism, shown, &plot, theme),
        &obstacles,
        plot.rect_above_scale_bar(theme),
        theme,
    );

    let group = |class, items| area.record(&Drawing { class, title: String::new(), items });
    group("underlay", underlay);
    group("grid", grid);
    group("straight", straight);
    for (k, (shown, path)) in shown.iter().zip(paths).enumerate() {
        area.record(&coupler_curve(page, shown, path, (plot.page_from_plane, dashes(k)), theme));
    }
    group("linkage", linkage);
    group("coupler-point", points);
    group("number", numbers);
}

/// The points of a page without repetition, with their positions on it.
fn distinct_points<'a>(
    mechanism: &PosedMechanism,
    shown: &'a [ShownCurve],
    plot: &Plot,
) -> impl Iterator<Item = (Point, &'a ShownCurve<'a>)> {
    let is_first = |k: usize| shown[..k].iter().all(|other| other.point_index != shown[k].point_index);
    let first = (0..shown.len()).filter(move |&k| is_first(k)).map(|k| &shown[k]);
    first.map(|s| (plot.page_from_plane.apply(mechanism.pose[s.curve.joint]), s))
}

/// The numbers of the points of a page, with the positions of the points.
fn point_numbers(mechanism: &PosedMechanism, shown: &[ShownCurve], plot: &Plot, theme: &Theme) -> Vec<(Point, Text)> {
    let number = |s: &ShownCurve| {
        let number = s.curve.trace.to_string();
        theme.text_line(&number, Point::origin(), Anchor::Middle, 0.85 * theme.note_size, s.ink(theme)).text
    };
    distinct_points(mechanism, shown, plot).map(|(centre, s)| (centre, number(s))).collect()
}

fn coupler_curve(
    page: &CouplerGridPage,
    shown: &ShownCurve,
    path: JointPath,
    (page_from_plane, dashes): (Similarity, DashPattern),
    theme: &Theme,
) -> CouplerCurve {
    let MeasuredCurve { trace, circuit, .. } = shown.curve;
    let cell = page.panel.solved_cell.cell.number;
    let stroke = theme.curve_stroke(shown.point_index);
    CouplerCurve {
        id: format!("{}-{cell}-{trace}-{circuit}", page.heading.family_id),
        class: "curve",
        title: format!("{}, no. {cell}: {}, point {trace}", page.heading.family_title, page.panel.caption),
        data: vec![("cell", cell.to_string()), ("trace", trace.to_string()), ("circuit", circuit.to_string())],
        page_from_plane,
        dashes,
        path,
        hairline: shown.hairline(theme),
        stroke_styles: [stroke, theme.stroke(theme.faded(stroke.color), theme.fine_width)],
        marks: Vec::new(),
    }
}

/// A small circle at the position of each point of the page in the pose.
fn point_circles(mechanism: &PosedMechanism, shown: &[ShownCurve], plot: &Plot, theme: &Theme) -> Vec<Item> {
    let circle = |(centre, s): (Point, &ShownCurve)| {
        let stroke = Some(theme.stroke(s.ink(theme), theme.fine_width));
        let fill = Some(if s.has_underline(theme) { s.ink(theme) } else { theme.paper });
        Item::Circle(Circle { centre, radius: 0.8 * theme.joint_radius, stroke, fill })
    };
    distinct_points(mechanism, shown, plot).map(circle).collect()
}

/// The unit of the input, as written after a number; empty for a length.
fn input_unit(solved: &SolvedCell) -> &'static str {
    if solved.linkage.input() == Input::Length { "" } else { "°" }
}
