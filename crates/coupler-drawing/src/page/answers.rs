//! A page of the curves that a search has found for a path, with the linkage that traces the best of them.

use super::area::{self, Area};
use super::arrangement::{Arrangement, Extents};
use super::body::{self, BodyDrawing};
use super::element::Drawing;
use super::heading;
use super::labels::{LabelPlacer, Obstacles};
use super::marks;
use super::mechanism::{self, PosedMechanism};
use super::plot::Plot;
use super::rect::Rect;
use super::symbols::{self, Symbol};
use super::theme::Theme;
use super::{AnswersPage, FoundCurve};
use crate::mechanism::Mechanism;
use crate::scene::{Anchor, Curve, Group, Item, Path, Scene, Stroke};
use coupler_curves::geometry::{Bounds, Point, Spline, Vector};
use coupler_curves::path;

pub(super) fn compose(scene: &mut Scene, page: &AnswersPage, theme: &Theme) {
    let root = area::whole_page(scene);
    heading::draw_border(&root, theme);
    let mut at = heading::draw_title(&root, page.title, theme);
    let paper = root.size();
    let width = paper.x - 2.0 * at.x;
    for line in &page.details {
        let line = theme.text_line(line, Point::origin(), Anchor::Start, theme.source_size, theme.grey);
        for line in line.wrap(width) {
            root.record(theme.text_line(&line, at, Anchor::Start, theme.source_size, theme.grey));
            at.y += 1.35 * theme.source_size;
        }
    }
    let entries: Vec<&FoundCurve> = page.curves.iter().collect();
    let step = 1.45 * theme.note_size;
    let of_body = symbols::of_body(&page.body, theme);
    let foot = theme.border + theme.margin + step * (entries.len() + of_body.len() + 1) as f64;
    let frame = Rect { corner: at, size: Vector::new(width, (paper.y - foot - at.y).max(0.3 * paper.y)) };
    let shown = [page.target_label.as_str()].into_iter().chain(page.curves.iter().map(|curve| curve.label.as_str()));
    let group = Group::figure("figure", shown.collect::<Vec<_>>().join("; "));
    root.grouped(group, || draw_figure(&root, frame, page, theme));
    // The target, then the curves with their ranks.
    let mut baseline = frame.corner.y + frame.size.y + step;
    let mut legend = |items: Vec<Item>, text: &str| {
        let line = theme.text_line(
            text,
            Point::new(at.x + 4.0 * theme.note_size, baseline),
            Anchor::Start,
            theme.note_size,
            theme.ink,
        );
        root.record(Drawing { class: "legend", title: String::new(), items });
        root.record(line.fit_width(width - 4.0 * theme.note_size));
        baseline += step;
        Point::new(at.x, baseline - 0.35 * theme.note_size)
    };
    let mut place = Point::new(at.x, frame.corner.y + frame.size.y + step - 0.35 * theme.note_size);
    let centre = |place: Point| place + Vector::new(1.5 * theme.note_size, 0.0);
    let dot = |centre: Point| body::mark_item(centre, theme.ink, theme);
    place = legend(vec![dot(centre(place))], &page.target_label);
    for (k, curve) in entries.iter().enumerate() {
        let ends = vec![place, place + Vector::new(3.0 * theme.note_size, 0.0)];
        place = legend(vec![Item::Path(Path::stroked(ends, curve_stroke(k, theme)))], &curve.label);
    }
    for Symbol { mark, meaning } in of_body {
        place = legend(mark.items(centre(place), theme), &meaning);
    }
}

/// The stroke of a curve: that of the best is as on other pages, the others are ghosts.
fn curve_stroke(rank: usize, theme: &Theme) -> Stroke {
    let ink = theme.curve_ink(rank);
    if rank == 0 { theme.stroke(ink, theme.curve_width) } else { theme.stroke(theme.faded(ink), theme.fine_width) }
}

/// Draws path and curves, and the linkage of the first of them with the pivots of all: on one figure, or the curves apart if the linkage is much
/// larger.
fn draw_figure(area: &impl Area, frame: Rect, page: &AnswersPage, theme: &Theme) {
    let samples = page.curves.iter().flat_map(|found| {
        let curve = &found.solved.curves[0];
        found.solved.circuit(curve).points(curve.joint).map(|p| found.placement.apply(p))
    });
    let curves = Bounds::from_points(page.target.iter().copied().chain(samples));
    let first = page.curves.first().filter(|found| found.is_in_place());
    let joints = first.iter().flat_map(|found| found.pose.iter().copied());
    let pivots = pivots(page);
    let joints = Bounds::from_points(joints.chain(pivots.iter().map(|(_, at, _)| *at)));
    let linkage = page.body.bounds(if joints.is_empty() { curves } else { curves.union(joints) });
    let arrangement = match page.body.poses.is_empty() {
        true => Arrangement::best(frame, None, theme, &[Extents { curves: vec![curves], linkage }]),
        false => Arrangement::Combined,
    };
    let [curve_frame, frame] = arrangement.rects(frame);
    let plot = Plot::new(frame, theme).fitted_to(linkage);
    plot.draw_scale_bar(area, None, &[], theme);
    let mut body = BodyDrawing::new(&page.body, &plot, theme);
    let mut obstacles = Obstacles::default();
    body.add_to(&mut obstacles);
    body.draw(area);
    // Behind the curves, which its plate would hide.
    if let Some(found) = first {
        let items = linkage_items(found, &plot, theme);
        obstacles.add(&items, false);
        area.record(Drawing { class: "linkage", title: "the linkage of the first curve".to_owned(), items });
    }
    if arrangement == Arrangement::Combined {
        draw_curves(area, page, &plot, &mut obstacles, theme);
    } else {
        let alone = AnswersPage { curves: page.curves.iter().take(1).cloned().collect(), ..page.clone() };
        draw_curves(area, &alone, &plot, &mut obstacles, theme);
        let plot_of_curves = Plot::new(curve_frame, theme).fitted_to(curves);
        let enlargement = plot_of_curves.page_from_plane.scale() / plot.page_from_plane.scale();
        let remark = format!(", enlarged × {}", marks::format_with_digits(enlargement, 2));
        plot_of_curves.draw_scale_bar(area, None, &[remark], theme);
        draw_curves(area, page, &plot_of_curves, &mut Obstacles::default(), theme);
    }
    let mut placer = LabelPlacer::new(&obstacles, frame, theme);
    draw_pivots(area, &pivots, &plot, &mut placer, theme);
    body.draw_labels(area, &mut placer, theme);
}

/// The fixed pivots of the linkages after the first that are in their own places: the rank of the curve, the place, and whether it is the crank's.
fn pivots(page: &AnswersPage) -> Vec<(usize, Point, bool)> {
    let in_place = page.curves.iter().enumerate().skip(1).filter(|(_, found)| found.is_in_place());
    let of_found = in_place.flat_map(|(rank, found)| {
        let linkage = &found.solved.linkage;
        let crank = linkage.crank().map(|[pivot, _]| pivot);
        linkage.pivots().into_iter().map(move |pivot| (rank, found.pose[pivot], Some(pivot) == crank))
    });
    of_found.collect()
}

/// Draws pivots in the inks of their curves, with the numbers of these.
fn draw_pivots(
    area: &impl Area,
    pivots: &[(usize, Point, bool)],
    plot: &Plot,
    placer: &mut LabelPlacer,
    theme: &Theme,
) {
    let small = Theme { joint_radius: 0.75 * theme.joint_radius, ..theme.clone() };
    for (rank, at, is_crank) in pivots {
        let ink = theme.faded(theme.curve_ink(*rank));
        let at = plot.page_from_plane.apply(*at);
        let number = (rank + 1).to_string();
        let number = theme.text_line(&number, Point::origin(), Anchor::Middle, theme.small_size(), theme.grey).text;
        let mut items = mechanism::pivot_items(at, *is_crank, ink, &small);
        items.extend(placer.place_if_clear(at, number));
        area.record(Drawing { class: "pivot", title: format!("a fixed pivot of curve {}", rank + 1), items });
    }
}

/// The linkage of a curve in its pose.
fn linkage_items(found: &FoundCurve, plot: &Plot, theme: &Theme) -> Vec<Item> {
    let traced = found.solved.curves[0].joint;
    let mechanism = Mechanism::new(&found.solved.linkage, found.solved.circuit(&found.solved.curves[0]));
    let posed = PosedMechanism::new(&found.solved.linkage, mechanism, found.pose.clone());
    let ink = |joint| if joint == traced { theme.curve_ink(0) } else { theme.ink };
    let mut items = posed.underlay_items(plot, theme);
    items.extend(posed.linkage_items(plot, theme, ink));
    items
}

/// Draws the curves, the best above the others, and the points of the path.
fn draw_curves(area: &impl Area, page: &AnswersPage, plot: &Plot, obstacles: &mut Obstacles, theme: &Theme) {
    /// Of the curves that labels avoid, in millimetres.
    const FLATNESS: f64 = 0.05;
    // A hundredth of a millimetre, as on other pages.
    let tolerance = 0.01 / plot.page_from_plane.scale();
    for (k, found) in page.curves.iter().enumerate().rev() {
        let (solved, curve) = (&found.solved, &found.solved.curves[0]);
        let tolerance = tolerance / found.placement.scale();
        let splines = path::joint_splines(&solved.linkage, solved.circuit(curve), curve.joint, tolerance);
        let on_page = |p: Point| plot.page_from_plane.apply(found.placement.apply(p));
        let splines: Vec<Spline> = splines.iter().map(|spline| spline.map(on_page)).collect();
        splines.iter().for_each(|spline| obstacles.add_points(&spline.flatten(FLATNESS), theme.curve_width, false));
        let items = vec![Item::Curve(Curve { splines, stroke: curve_stroke(k, theme) })];
        area.record(Drawing { class: "found", title: found.label.clone(), items });
    }
    let dot = |p: &Point| body::mark_item(plot.page_from_plane.apply(*p), theme.ink, theme);
    let dots: Vec<Item> = page.target.iter().map(dot).collect();
    obstacles.add(&dots, false);
    area.record(Drawing { class: "target", title: page.target_label.clone(), items: dots });
}
