//! A page on which a curve lies over one that was recorded, with the difference magnified.

use plotters::drawing::IntoDrawingArea;

use super::OverlayPage;
use super::arrangement::Rect;
use super::element::{Area, Drawing, draw, size};
use super::heading;
use super::plot::{Plot, round_number_below};
use super::theme::Theme;
use crate::scene::{Anchor, Canvas, Circle, Color, Item, Path, Polyline, Scene};
use coupler_curves::geometry::{Bounds, Point, Vector};

pub(super) fn compose(scene: &mut Scene, sheet: &OverlayPage, theme: &Theme) {
    let root = Canvas::new(scene).into_drawing_area();
    heading::draw_border(&root, theme);
    let mut at = heading::draw_title(&root, sheet.title, theme);
    let page = size(&root);
    let width = page.x - 2.0 * at.x;
    for line in &sheet.details {
        draw(&root, &theme.text_line(line, at, Anchor::Start, theme.source_size, theme.grey).fit_width(width));
        at.y += 1.35 * theme.source_size;
    }
    let foot = theme.border + theme.margin + 2.0 * theme.source_size;
    let frame = Rect { corner: Point::new(at.x, at.y), size: Vector::new(width, page.y - foot - at.y) };
    draw_figure(&root, frame, sheet, theme);
    let at = Point::new(page.x - at.x, page.y - theme.border - 0.6 * theme.margin);
    draw(&root, &theme.text_line(sheet.footer, at, Anchor::End, theme.source_size, theme.grey).fit_width(width));
}

/// The greatest difference is drawn this long, by the height of the figure.
const MAX_DIFFERENCE_PART: f64 = 0.08;

fn draw_figure(area: &Area, frame: Rect, sheet: &OverlayPage, theme: &Theme) {
    let is_placed = |p: &&Point| p.x.is_finite() && p.y.is_finite();
    let all = sheet.recorded.iter().chain(&sheet.current).chain(&sheet.current_path).filter(is_placed).copied();
    let bounds = Bounds::from_points(all);
    if bounds.is_empty() {
        return;
    }
    // What is magnified goes over the curve's edge.
    let free = Vector::repeat(MAX_DIFFERENCE_PART * frame.size.y);
    let inner = Rect { corner: frame.corner + free, size: frame.size - free * 2.0 };
    let plot = Plot::new(inner, theme).fitted_to(bounds);
    plot.draw_scale_bar(area, theme);
    let on_page = |p: Point| plot.page_from_plane.apply(p);
    let (old, new) = (theme.curve_ink(0), theme.ink);
    let path = |points: &[Point], color: Color, width: f64| {
        let placed = points.split(|p| !is_placed(&p)).filter(|run| run.len() > 1);
        let line = |run: &[Point]| Polyline { points: run.iter().copied().map(on_page).collect(), is_closed: false };
        Item::Path(Path { polylines: placed.map(line).collect(), stroke: Some(theme.stroke(color, width)), fill: None })
    };
    let mut was = sheet.recorded.clone();
    if sheet.is_closed {
        was.extend(sheet.recorded.first().copied());
    }
    let faded = theme.faded(old);
    let recorded = vec![path(&was, faded, 2.0 * theme.curve_width)];
    draw(area, &Drawing { class: "recorded", title: "as it was".to_owned(), items: recorded });
    let now = vec![path(&sheet.current_path, new, theme.hair_width)];
    draw(area, &Drawing { class: "now", title: "as it is".to_owned(), items: now });
    let pairs: Vec<(Point, Vector)> = match sheet.recorded.len() == sheet.current.len() {
        true => sheet.current.iter().zip(&sheet.recorded).map(|(is, was)| (*is, was - is)).collect(),
        false => Vec::new(),
    };
    let scale = plot.page_from_plane.scale;
    let longest = pairs.iter().map(|(_, by)| by.norm() * scale).filter(|by| by.is_finite()).fold(0.0, f64::max);
    if longest > 0.0 {
        let times = round_number_below(MAX_DIFFERENCE_PART * frame.size.y / longest);
        draw_differences(area, frame, &pairs, times, &on_page, theme);
    }
    let mark = |p: &Point, color| {
        let stroke = Some(theme.stroke(color, theme.fine_width));
        Item::Circle(Circle { centre: on_page(*p), radius: 1.6 * theme.joint_radius, stroke, fill: None })
    };
    let worst = sheet.worst_points.iter().filter(is_placed);
    draw(
        area,
        &Drawing { class: "worst", title: "the furthest".to_owned(), items: worst.map(|p| mark(p, old)).collect() },
    );
}

/// From each sample the way to where it was, so many times as long.
fn draw_differences(
    area: &Area,
    frame: Rect,
    pairs: &[(Point, Vector)],
    times: f64,
    on_page: &impl Fn(Point) -> Point,
    theme: &Theme,
) {
    let is_drawn = |(p, by): &&(Point, Vector)| p.x.is_finite() && p.y.is_finite() && by.norm() > 0.0;
    let line =
        |(p, by): &(Point, Vector)| Polyline { points: vec![on_page(*p), on_page(p + by * times)], is_closed: false };
    let lines: Vec<Polyline> = pairs.iter().filter(is_drawn).map(line).collect();
    let stroke = Some(theme.stroke(theme.curve_ink(0), theme.hair_width));
    let ways = Item::Path(Path { polylines: lines, stroke, fill: None });
    let magnified = match times {
        1.0 => "the difference".to_owned(),
        times if times < 1.0 => format!("the difference, {times} times as long"),
        times => format!("the difference, {times:.0} times as long"),
    };
    draw(area, &Drawing { class: "difference", title: magnified.clone(), items: vec![ways] });
    let words = format!("thin and black as it is, broad and pale as it was recorded; hairlines: {magnified}");
    let at = Point::new(frame.corner.x, frame.corner.y + frame.size.y + theme.source_size);
    draw(area, &theme.text_line(&words, at, Anchor::Start, theme.note_size, theme.grey).fit_width(frame.size.x));
}
