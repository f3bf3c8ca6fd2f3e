//! A page on which a curve lies over one that was recorded, with the difference magnified.

use plotters::drawing::IntoDrawingArea;

use super::OverlaySheet;
use super::arrangement::Frame;
use super::element::{Area, Drawing, draw, size};
use super::heading;
use super::plot::{Plot, round_number};
use super::theme::Theme;
use crate::scene::{Anchor, Canvas, Circle, Color, Item, Line, Path, Scene};
use coupler_curves::geometry::{Bounds, Point, Vector};

pub(super) fn compose(scene: &mut Scene, sheet: &OverlaySheet, theme: &Theme) {
    let root = Canvas::new(scene).into_drawing_area();
    heading::border(&root, theme);
    let mut at = heading::title(&root, sheet.title, theme);
    let page = size(&root);
    let width = page.x - 2.0 * at.x;
    for line in &sheet.lines {
        draw(&root, &theme.words(line, at, Anchor::Start, theme.source, theme.grey).fitted(width));
        at.y += 1.35 * theme.source;
    }
    let foot = theme.border + theme.margin + 2.0 * theme.source;
    let frame = Frame { corner: Point::new(at.x, at.y), size: Vector::new(width, page.y - foot - at.y) };
    figure(&root, frame, sheet, theme);
    let at = Point::new(page.x - at.x, page.y - theme.border - 0.6 * theme.margin);
    draw(&root, &theme.words(sheet.foot, at, Anchor::End, theme.source, theme.grey).fitted(width));
}

/// The greatest difference is drawn this long, by the height of the figure.
const LONGEST: f64 = 0.08;

fn figure(area: &Area, frame: Frame, sheet: &OverlaySheet, theme: &Theme) {
    let is_placed = |p: &&Point| p.x.is_finite() && p.y.is_finite();
    let all = sheet.was.iter().chain(&sheet.is).chain(&sheet.path).filter(is_placed).copied();
    let bounds = Bounds::of(all);
    if bounds.is_empty() {
        return;
    }
    // What is magnified goes over the curve's edge.
    let free = Vector::repeat(LONGEST * frame.size.y);
    let inner = Frame { corner: frame.corner + free, size: frame.size - free * 2.0 };
    let plot = Plot::new(inner, theme).of(bounds);
    plot.bar(area, theme);
    let on_page = |p: Point| plot.page_from_plane.apply(p);
    let (old, new) = (theme.curve_ink(0), theme.ink);
    let path = |points: &[Point], color: Color, width: f64| {
        let placed = points.split(|p| !is_placed(&p)).filter(|run| run.len() > 1);
        let line = |run: &[Point]| Line { points: run.iter().copied().map(on_page).collect(), closed: false };
        Item::Path(Path { lines: placed.map(line).collect(), stroke: Some(theme.stroke(color, width)), fill: None })
    };
    let mut was = sheet.was.clone();
    if sheet.closed {
        was.extend(sheet.was.first().copied());
    }
    let faded = theme.faded(old);
    let recorded = vec![path(&was, faded, 2.0 * theme.curve)];
    draw(area, &Drawing { class: "recorded", title: "as it was".to_owned(), items: recorded });
    let now = vec![path(&sheet.path, new, theme.hair)];
    draw(area, &Drawing { class: "now", title: "as it is".to_owned(), items: now });
    let pairs: Vec<(Point, Vector)> = match sheet.was.len() == sheet.is.len() {
        true => sheet.is.iter().zip(&sheet.was).map(|(is, was)| (*is, was - is)).collect(),
        false => Vec::new(),
    };
    let scale = plot.page_from_plane.scale;
    let longest = pairs.iter().map(|(_, by)| by.norm() * scale).filter(|by| by.is_finite()).fold(0.0, f64::max);
    if longest > 0.0 {
        let times = round_number(LONGEST * frame.size.y / longest);
        differences(area, frame, &pairs, times, &on_page, theme);
    }
    let mark = |p: &Point, color| {
        let stroke = Some(theme.stroke(color, theme.fine));
        Item::Circle(Circle { centre: on_page(*p), radius: 1.6 * theme.joint, stroke, fill: None })
    };
    let worst = sheet.worst.iter().filter(is_placed);
    draw(
        area,
        &Drawing { class: "worst", title: "the furthest".to_owned(), items: worst.map(|p| mark(p, old)).collect() },
    );
}

/// From each sample the way to where it was, so many times as long.
fn differences(
    area: &Area,
    frame: Frame,
    pairs: &[(Point, Vector)],
    times: f64,
    on_page: &impl Fn(Point) -> Point,
    theme: &Theme,
) {
    let is_drawn = |(p, by): &&(Point, Vector)| p.x.is_finite() && p.y.is_finite() && by.norm() > 0.0;
    let line = |(p, by): &(Point, Vector)| Line { points: vec![on_page(*p), on_page(p + by * times)], closed: false };
    let lines: Vec<Line> = pairs.iter().filter(is_drawn).map(line).collect();
    let stroke = Some(theme.stroke(theme.curve_ink(0), theme.hair));
    let ways = Item::Path(Path { lines, stroke, fill: None });
    let magnified = match times {
        1.0 => "the difference".to_owned(),
        times if times < 1.0 => format!("the difference, {times} times as long"),
        times => format!("the difference, {times:.0} times as long"),
    };
    draw(area, &Drawing { class: "difference", title: magnified.clone(), items: vec![ways] });
    let words = format!("thin and black as it is, broad and pale as it was recorded; hairlines: {magnified}");
    let at = Point::new(frame.corner.x, frame.corner.y + frame.size.y + theme.source);
    draw(area, &theme.words(&words, at, Anchor::Start, theme.note, theme.grey).fitted(frame.size.x));
}
