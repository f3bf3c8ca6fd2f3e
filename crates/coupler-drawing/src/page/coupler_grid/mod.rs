//! The `coupler-grid` layout: a linkage with a grid of points on its coupler, and the curves of ten of these points.
//!
//! All pages of a cell show the same pose, each at the largest scale at which linkage and curves fit the frame. To the
//! right of the figure, or below it on upright paper, is a panel: the key with the lengths of all links, a table of the
//! points with a graph of the speed of each, the transmission angle on the same axis, and notes; and below it, or on
//! small paper below both, the symbols of the figure and the source.

mod columns;
mod description;
mod footer;
mod graphs;
mod grid;
mod key;
mod layout;
mod notes;
mod numbers;
mod panel;
mod shown_curve;
mod table;
mod turn;

use super::area::{self, Area};
use super::element::{CouplerCurve, Drawing};
use super::figure;
use super::heading;
use super::labels::{LabelPlacer, Obstacles, label_line};
use super::marks;
use super::mechanism::PosedMechanism;
use super::motion_marks::{MotionMarks, TickPoses, TickSteps};
use super::plot::{Plot, reduction_remark};
use super::rect::Rect;
use super::symbols::{self, Mark, Symbol};
use super::theme::Theme;
use super::{CouplerGridPage, Layout, Options, Panel, PoseChoice, pose};
use crate::mechanism::Mechanism;
use crate::scene::{Anchor, Circle, Group, Item, MIN_TEXT_SIZE, Path, Scene};
use coupler_curves::expression::MathText;
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector};
use coupler_curves::path::{DashPattern, JointPath};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use layout::PageLayout;
use panel::PanelContents;
use shown_curve::ShownCurve;

pub(super) use columns::MEASURES;

/// Composes a page; the result is the greatest scale at which its linkage fits, in millimetres to a unit.
pub(super) fn compose(scene: &mut Scene, page: &CouplerGridPage, options: &Options, theme: &Theme) -> f64 {
    let size = Vector::new(scene.width, scene.height);
    let theme = &with_legible_notes(theme, MIN_TEXT_SIZE);
    let small = Theme { note_size: PANEL_LETTERING * theme.note_size, ..theme.clone() };
    let panel_theme = &with_legible_notes(&small, MIN_TEXT_SIZE);
    let root = area::whole_page(scene);
    heading::draw_border(&root, theme);
    let foot = footer::draw(&root, page, theme);
    let edge = theme.border + theme.margin;
    let whole = Rect { corner: Point::new(edge, edge), size: Vector::new(size.x - 2.0 * edge, size.y - edge - foot) };
    let solved = page.panel.solved_cell;
    let shown = shown_curves(solved, &page.curve_indices);
    let contents = PanelContents::new(page, PageLayout::panel_width(whole.size, panel_theme), &shown, panel_theme);
    let least_height = contents.least_height(panel_theme);
    let all_symbols = page_symbols(page, &shown, page.scale.fixed(), options, theme);
    let foot_height = |symbols: &[Symbol], width: f64| {
        footer::symbols_height(symbols, width, panel_theme) + footer::source_height(page, width, panel_theme)
    };
    let needed = least_height + foot_height(&all_symbols, contents.width);
    let PageLayout { figure, panel } = PageLayout::new(whole, needed, panel_theme);
    // Where the panel is too short, its foot is below the figure too, in fewer lines; and where this is not enough, with fewer symbols.
    let is_short = contents.width < whole.size.x && needed > panel.size.y;
    let is_too_short = is_short && least_height + foot_height(&all_symbols, whole.size.x) > whole.size.y;
    let symbols = |scale| match page_symbols(page, &shown, scale, options, theme) {
        all if is_too_short => most_needed(all),
        all => all,
    };
    let (figure, panel, foot) = if is_short {
        let foot_height = foot_height(&symbols(page.scale.fixed()), whole.size.x);
        let above = Rect { size: whole.size - Vector::new(0.0, foot_height), ..whole };
        let PageLayout { figure, panel } = PageLayout::new(above, least_height, panel_theme);
        (figure, Some(panel), whole)
    } else {
        (figure, None, panel)
    };
    let foot = footer::draw_source(&root, foot, page, panel_theme);
    match posed_mechanism(&page.panel) {
        Some(mechanism) => {
            let figure_theme = with_legible_notes(theme, MIN_TEXT_SIZE / Theme::SMALL_PART);
            let (plot, fitting) = draw_figure(&root, figure, page, &mechanism, &shown, options, &figure_theme);
            // A scale that is common to all pages is stated as it is on this one.
            let scale = page.scale.fixed().map(|_| plot.page_from_plane.scale());
            let above = footer::draw_symbols(&root, foot, &symbols(scale), panel_theme);
            contents.draw(&root, panel.unwrap_or(above), &mechanism, panel_theme);
            fitting
        }
        None => {
            super::panels::draw_not_assembled(&root, whole, solved, theme);
            f64::INFINITY
        }
    }
}

/// The font size in the panel relative to that of notes: the table is wide.
const PANEL_LETTERING: f64 = 0.84;

/// The theme with notes of at least a size.
fn with_legible_notes(theme: &Theme, least: f64) -> Theme {
    let note = theme.note_size.max(least);
    Theme { note_size: note, source_size: theme.source_size.max(note), ..theme.clone() }
}

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
    Some(PosedMechanism::new(&solved.linkage, mechanism, pose))
}

/// The symbols of the figure, with its scale in millimetres to a unit if it is to be stated.
fn page_symbols(
    page: &CouplerGridPage,
    shown: &[ShownCurve],
    scale: Option<f64>,
    options: &Options,
    theme: &Theme,
) -> Vec<Symbol> {
    let Some(first) = shown.first() else { return Vec::new() };
    let solved = page.panel.solved_cell;
    let period = figure::dash_period(&solved.linkage, &solved.motion.circuits, options);
    let mut symbols = symbols::of_cell(solved, first.ink(theme), period);
    if let Some(banded) = shown.iter().find(|s| marks::visible_straight_portion(solved, s.curve).is_some()) {
        let meaning = "longest straight portion".to_owned();
        symbols.push(Symbol { mark: Mark::Band(banded.ink(theme)), meaning });
    }
    symbols.push(symbols::scale_bar(scale, solved.linkage.crank_length(), page.heading.unit));
    symbols
}

/// The symbols without which no measure can be taken from a page, and that there are others.
fn most_needed(symbols: Vec<Symbol>) -> Vec<Symbol> {
    let is_needed = |symbol: &Symbol| matches!(symbol.mark, Mark::Dashes(_) | Mark::ScaleBar);
    let others = Symbol { mark: Mark::Letter("…"), meaning: "others: on larger paper".to_owned() };
    symbols.into_iter().filter(is_needed).chain([others]).collect()
}

/// Draws the curves and the linkage; returns where they are, and the greatest scale at which they fit.
fn draw_figure(
    area: &impl Area,
    frame: Rect,
    page: &CouplerGridPage,
    mechanism: &PosedMechanism,
    shown: &[ShownCurve],
    options: &Options,
    theme: &Theme,
) -> (Plot, f64) {
    let solved = page.panel.solved_cell;
    let grid = grid::PointGrids::from_joints(&solved.linkage, shown.iter().map(|s| s.curve.joint));
    let curves = shown.iter().flat_map(|s| solved.circuit(s.curve).points(s.curve.joint));
    let extents = Bounds::from_points(curves.chain(grid.line_ends(&mechanism.pose))).union(mechanism.bounds());
    let scale = page.scale.fixed();
    let (plot, fitting) = Plot::new(frame, theme).at_scale(extents, scale);
    plot.draw_scale_bar(area, page.heading.unit, &[reduction_remark(scale, fitting)], theme);
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

    let steps = TickSteps::new(&solved.linkage, period);
    let poses: Vec<TickPoses> =
        solved.motion.circuits.iter().map(|circuit| TickPoses::new(&solved.linkage, circuit, steps)).collect();
    let motion =
        |s: &ShownCurve| MotionMarks::new(&poses[s.curve.circuit - 1], s.curve.joint, &plot, s.ink(theme), theme).items;
    let motion: Vec<Item> = shown.iter().flat_map(motion).collect();

    let mut obstacles = Obstacles::default();
    [&underlay, &grid, &straight].into_iter().for_each(|items| obstacles.add(items, true));
    [&linkage, &points, &motion].into_iter().for_each(|items| obstacles.add(items, false));
    let lines: Vec<Vec<Point>> = paths.iter().map(label_line).collect();
    for (k, (shown, points)) in shown.iter().zip(&lines).enumerate() {
        obstacles.add_curve(k, points, theme.curve_stroke(shown.point_index).width);
    }
    let mut placer = LabelPlacer::new(&obstacles, plot.rect_above_scale_bar(theme), theme);
    let number = |s: &ShownCurve| {
        let number = s.curve.trace.to_string();
        let size = (0.8 * theme.note_size).max(MIN_TEXT_SIZE.min(theme.note_size));
        theme.text_line(&number, Point::origin(), Anchor::Middle, size, s.text_ink(theme)).text
    };
    let at_points: Vec<(Point, &ShownCurve)> = distinct_points(mechanism, shown, &plot).collect();
    let mut numbers: Vec<Item> =
        at_points.into_iter().filter_map(|(at, s)| placer.place_at_point(at, number(s))).collect();
    // Curves that are nearly equal at their points differ at their far ends, where they have their numbers again.
    let far_from = |s: &ShownCurve| plot.page_from_plane.apply(mechanism.pose[s.curve.joint]);
    let mut in_bundles = Vec::new();
    for (k, (s, points)) in shown.iter().zip(&lines).enumerate() {
        match placer.place_far_from(far_from(s), k, points, number(s)) {
            Some(placed) => numbers.push(placed),
            None => in_bundles.push((s, points)),
        }
    }
    // In a bundle no number is next to its curve only: a line leads from it to the number.
    for (s, points) in in_bundles {
        if let Some((placed, ends)) = placer.place_with_leader(far_from(s), points, number(s)) {
            let stroke = theme.stroke(s.ink(theme), theme.hair_width);
            numbers.extend([Item::Path(Path::stroked(ends.to_vec(), stroke)), placed]);
        }
    }

    let group = |class, items| area.record(Drawing { class, title: String::new(), items });
    area.grouped(Group::figure("figure", description(page, shown)), || {
        group("underlay", underlay);
        group("grid", grid);
        group("straight", straight);
        for (k, (shown, path)) in shown.iter().zip(paths).enumerate() {
            area.record(coupler_curve(page, shown, path, plot.page_from_plane, dashes(k), theme));
        }
        group("motion", motion);
        group("linkage", linkage);
        group("coupler-point", points);
        group("number", numbers);
    });
    (plot, fitting)
}

/// What the figure shows, in words.
fn description(page: &CouplerGridPage, shown: &[ShownCurve]) -> String {
    let mut traces: Vec<usize> = shown.iter().map(|s| s.curve.trace).collect();
    traces.dedup();
    let curves = match traces[..] {
        [] => String::new(),
        [only] => format!("; curve of point {only}"),
        [first, .., last] => format!("; curves of {} points, from {first} to {last}", traces.len()),
    };
    let lengths = description::dimensions(&page.panel.solved_cell.linkage, page.labels);
    let dimensions = match page.key {
        Some(key) => key.dimensions.clone(),
        None => lengths.into_iter().map(MathText::from_words).collect(),
    };
    page.panel.description(page.heading.family_title, &dimensions) + &curves
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

fn coupler_curve(
    page: &CouplerGridPage,
    shown: &ShownCurve,
    path: JointPath,
    page_from_plane: Similarity,
    dashes: DashPattern,
    theme: &Theme,
) -> CouplerCurve {
    let MeasuredCurve { trace, circuit, .. } = shown.curve;
    let cell = page.panel.solved_cell.cell.number;
    let stroke = theme.curve_stroke(shown.point_index);
    CouplerCurve {
        id: format!("{}-{cell}-{trace}-{circuit}", page.heading.family_id),
        class: "curve",
        title: format!("{}, no. {cell}: {}, point {trace}", page.heading.family_title, page.panel.caption),
        data: [("cell", &cell), ("trace", trace), ("circuit", circuit)]
            .map(|(name, number)| (name, number.to_string()))
            .into_iter()
            .chain(page.heading.unit_data())
            .collect(),
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
