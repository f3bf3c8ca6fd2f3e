//! A page of the curves that a search has found for a path, with the linkage that traces the best of them.

use super::area::{self, Area};
use super::body::{self, BodyDrawing};
use super::element::Drawing;
use super::heading;
use super::labels::{LabelPlacer, Obstacles};
use super::mechanism::PosedMechanism;
use super::plot::Plot;
use super::rect::Rect;
use super::symbols::{self, Symbol};
use super::theme::Theme;
use super::{AnswersPage, FoundCurve};
use crate::mechanism::Mechanism;
use crate::scene::{Anchor, Curve, Group, Item, Path, Scene};
use coupler_curves::geometry::Similarity;
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
        place = legend(
            vec![Item::Path(Path::stroked(ends, theme.stroke(theme.curve_ink(k), curve_width(k, theme))))],
            &curve.label,
        );
    }
    for Symbol { mark, meaning } in of_body {
        place = legend(mark.items(centre(place), theme), &meaning);
    }
}

/// The best curve is as broad as on other pages, and the others are finer.
fn curve_width(rank: usize, theme: &Theme) -> f64 {
    if rank == 0 { theme.curve_width } else { theme.fine_width }
}

fn draw_figure(area: &impl Area, frame: Rect, page: &AnswersPage, theme: &Theme) {
    /// Of the curves that labels avoid, in millimetres.
    const FLATNESS: f64 = 0.05;
    let samples = page.curves.iter().flat_map(|found| {
        let curve = &found.solved.curves[0];
        found.solved.circuit(curve).points(curve.joint).map(|p| found.placement.apply(p))
    });
    let first = page.curves.first().filter(|found| found.placement == Similarity::IDENTITY);
    let joints = first.iter().flat_map(|curve| curve.pose.iter().copied());
    let plot = Plot::new(frame, theme);
    let plot =
        plot.fitted_to(page.body.bounds(Bounds::from_points(page.target.iter().copied().chain(samples).chain(joints))));
    plot.draw_scale_bar(area, &[], theme);
    // A hundredth of a millimetre, as on other pages.
    let tolerance = 0.01 / plot.page_from_plane.scale();
    let mut body = BodyDrawing::new(&page.body, &plot, theme);
    let mut obstacles = Obstacles::default();
    body.add_to(&mut obstacles);
    body.draw(area);
    // Behind the curves, which its plate would hide.
    if let Some(found) = first {
        let traced = found.solved.curves[0].joint;
        let mechanism = Mechanism::new(&found.solved.linkage, found.solved.circuit(&found.solved.curves[0]));
        let posed = PosedMechanism::new(&found.solved.linkage, mechanism, found.pose.clone());
        let mut items = posed.underlay_items(&plot, theme);
        items.extend(posed.linkage_items(
            &plot,
            theme,
            |joint| if joint == traced { theme.curve_ink(0) } else { theme.ink },
        ));
        obstacles.add(&items, false);
        area.record(Drawing { class: "linkage", title: "the linkage of the first curve".to_owned(), items });
    }
    for (k, found) in page.curves.iter().enumerate().rev() {
        let (solved, curve) = (&found.solved, &found.solved.curves[0]);
        let tolerance = tolerance / found.placement.scale();
        let splines = path::joint_splines(&solved.linkage, solved.circuit(curve), curve.joint, tolerance);
        let on_page = |p: Point| plot.page_from_plane.apply(found.placement.apply(p));
        let splines: Vec<Spline> = splines.iter().map(|spline| spline.map(on_page)).collect();
        splines.iter().for_each(|spline| obstacles.add_points(&spline.flatten(FLATNESS), theme.curve_width, false));
        let stroke = theme.stroke(theme.curve_ink(k), curve_width(k, theme));
        area.record(Drawing {
            class: "found",
            title: found.label.clone(),
            items: vec![Item::Curve(Curve { splines, stroke })],
        });
    }
    let dot = |p: &Point| body::mark_item(plot.page_from_plane.apply(*p), theme.ink, theme);
    let dots: Vec<Item> = page.target.iter().map(dot).collect();
    obstacles.add(&dots, false);
    area.record(Drawing { class: "target", title: page.target_label.clone(), items: dots });
    body.draw_labels(area, &mut LabelPlacer::new(&obstacles, frame, theme), theme);
}
