//! A page on which a curve is overlaid on its recorded form, with the differences magnified.

use super::OverlayPage;
use super::area::{self, Area};
use super::element::Drawing;
use super::heading;
use super::plot::{Plot, round_number_below};
use super::rect::Rect;
use super::theme::Theme;
use crate::scene::{Anchor, Circle, Color, Item, Path, Polyline, Scene};
use coupler_curves::geometry::{Bounds, Point, Vector};

pub(super) fn compose(scene: &mut Scene, page: &OverlayPage, theme: &Theme) {
    let root = area::whole_page(scene);
    heading::draw_border(&root, theme);
    let mut at = heading::draw_title(&root, page.title, theme);
    let paper = root.size();
    let width = paper.x - 2.0 * at.x;
    for line in &page.details {
        root.record(theme.text_line(line, at, Anchor::Start, theme.source_size, theme.grey).fit_width(width));
        at.y += 1.35 * theme.source_size;
    }
    let foot = theme.border + theme.margin + 2.0 * theme.source_size;
    let frame = Rect { corner: Point::new(at.x, at.y), size: Vector::new(width, paper.y - foot - at.y) };
    draw_figure(&root, frame, page, theme);
    let at = Point::new(paper.x - at.x, paper.y - theme.border - 0.6 * theme.margin);
    root.record(theme.text_line(page.footer, at, Anchor::End, theme.source_size, theme.grey).fit_width(width));
}

/// The length at which the greatest difference is drawn, as a fraction of the height of the figure.
const MAX_DIFFERENCE_PART: f64 = 0.08;

fn draw_figure(area: &impl Area, frame: Rect, page: &OverlayPage, theme: &Theme) {
    let is_defined = |p: &&Point| p.x.is_finite() && p.y.is_finite();
    let all = page.recorded.iter().chain(&page.current).chain(&page.current_path).filter(is_defined).copied();
    let bounds = Bounds::from_points(all);
    if bounds.is_empty() {
        return;
    }
    // Magnified differences extend beyond the curve.
    let margin = Vector::repeat(MAX_DIFFERENCE_PART * frame.size.y);
    let inner = Rect { corner: frame.corner + margin, size: frame.size - margin * 2.0 };
    let plot = Plot::new(inner, theme).fitted_to(bounds);
    plot.draw_scale_bar(area, None, &[], theme);
    let on_page = |p: Point| plot.page_from_plane.apply(p);
    let (old, new) = (theme.curve_ink(0), theme.ink);
    let path = |points: &[Point], color: Color, width: f64| {
        let runs = points.split(|p| !is_defined(&p)).filter(|run| run.len() > 1);
        let line = |run: &[Point]| Polyline { points: run.iter().copied().map(on_page).collect(), is_closed: false };
        Item::Path(Path { polylines: runs.map(line).collect(), stroke: Some(theme.stroke(color, width)), fill: None })
    };
    let mut recorded = page.recorded.clone();
    if page.is_closed {
        recorded.extend(page.recorded.first().copied());
    }
    let faded = theme.faded(old);
    let recorded = vec![path(&recorded, faded, 2.0 * theme.curve_width)];
    area.record(Drawing { class: "recorded", title: "recorded".to_owned(), items: recorded });
    let current = vec![path(&page.current_path, new, theme.hair_width)];
    area.record(Drawing { class: "now", title: "current".to_owned(), items: current });
    let pairs: Vec<(Point, Vector)> = match page.recorded.len() == page.current.len() {
        true => page.current.iter().zip(&page.recorded).map(|(new, old)| (*new, old - new)).collect(),
        false => Vec::new(),
    };
    let scale = plot.page_from_plane.scale();
    let longest = pairs
        .iter()
        .map(|(_, difference)| difference.norm() * scale)
        .filter(|length| length.is_finite())
        .fold(0.0, f64::max);
    if longest > 0.0 {
        let magnification = round_number_below(MAX_DIFFERENCE_PART * frame.size.y / longest);
        draw_differences(area, frame, &pairs, magnification, &on_page, theme);
    }
    let mark = |p: &Point, color| {
        let stroke = Some(theme.stroke(color, theme.fine_width));
        Item::Circle(Circle { centre: on_page(*p), radius: 1.6 * theme.joint_radius, stroke, fill: None })
    };
    let worst = page.worst_points.iter().filter(is_defined);
    area.record(Drawing {
        class: "worst",
        title: "the greatest differences".to_owned(),
        items: worst.map(|p| mark(p, old)).collect(),
    });
}

/// Draws a line from each sample towards its recorded position, `magnification` times as long as the difference, and
/// the legend.
fn draw_differences(
    area: &impl Area,
    frame: Rect,
    pairs: &[(Point, Vector)],
    magnification: f64,
    on_page: &impl Fn(Point) -> Point,
    theme: &Theme,
) {
    let is_drawn = |(p, difference): &&(Point, Vector)| p.x.is_finite() && p.y.is_finite() && difference.norm() > 0.0;
    let line = |(p, difference): &(Point, Vector)| Polyline {
        points: vec![on_page(*p), on_page(p + difference * magnification)],
        is_closed: false,
    };
    let lines: Vec<Polyline> = pairs.iter().filter(is_drawn).map(line).collect();
    let stroke = Some(theme.stroke(theme.curve_ink(0), theme.hair_width));
    let hairlines = Item::Path(Path { polylines: lines, stroke, fill: None });
    let magnified = match magnification {
        1.0 => "the difference".to_owned(),
        times if times < 1.0 => format!("the difference, magnified {times} times"),
        times => format!("the difference, magnified {times:.0} times"),
    };
    area.record(Drawing { class: "difference", title: magnified.clone(), items: vec![hairlines] });
    let legend = format!("thin line: current; broad pale line: recorded; hairlines: {magnified}");
    let at = Point::new(frame.corner.x, frame.corner.y + frame.size.y + theme.source_size);
    area.record(theme.text_line(&legend, at, Anchor::Start, theme.note_size, theme.grey).fit_width(frame.size.x));
}
