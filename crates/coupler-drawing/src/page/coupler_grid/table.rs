//! The table of a page's points: where each is on its link, and how straight its curve is.

use super::super::GridSheet;
use super::super::arrangement::Frame;
use super::super::element::{Area, Drawing, draw as put};
use super::super::marks::digits;
use super::super::theme::Theme;
use super::{Shown, input_unit};
use crate::scene::{Anchor, Circle, Item, Line, Path};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::{Linkage, Step};
use coupler_curves::measure::Value;
use coupler_curves::solve::{Curve, Solved};

/// The heads of the columns, and where each ends, in parts of the table's width.
const COLUMNS: [(&str, f64); 5] =
    [("point", 0.2), ("along", 0.38), ("across", 0.58), ("straight", 0.82), ("over", 1.0)];

/// The first columns, which are there where no straight portion was sought too.
const OF_POINTS: usize = 3;

/// Draws it at the head of a frame.
pub(super) fn draw(area: &Area, frame: Frame, sheet: &GridSheet, shown: &[Shown], theme: &Theme) {
    let solved = sheet.panel.solved;
    let has_circuits = solved.motion.circuits.len() > 1;
    let row = 1.5 * theme.note;
    let at = |column: usize, y: f64| Point::new(frame.corner.x + COLUMNS[column].1 * frame.size.x, y);
    let mut y = frame.corner.y + 1.5 * row;
    let is_straight = shown.iter().any(|s| s.curve.measure("straight_length") != Value::Missing);
    let columns = if is_straight { COLUMNS.len() } else { OF_POINTS };
    let places: Vec<Option<[f64; 2]>> = shown.iter().map(|s| place(&solved.linkage, s.curve)).collect();
    let decimals = [0, 1].map(|k| decimals(places.iter().flatten().map(|place| place[k])));
    // Joints of links have no places to tell of.
    let is_blank = |column: usize| (1..OF_POINTS).contains(&column) && places.iter().all(Option::is_none);
    for (column, (head, _)) in COLUMNS.iter().enumerate().take(columns).filter(|(column, _)| !is_blank(*column)) {
        put(area, &theme.words(head, at(column, y), Anchor::End, 0.9 * theme.note, theme.grey));
    }
    let rule =
        vec![Point::new(frame.corner.x, y + 0.4 * row), Point::new(frame.corner.x + frame.size.x, y + 0.4 * row)];
    let rule = Item::Path(Path::stroked(rule, theme.stroke(theme.hairline, theme.hair)));
    put(area, &Drawing { class: "rule", title: String::new(), items: vec![rule] });
    y += 0.25 * row;
    let last = frame.corner.y + frame.size.y - 3.0 * row;
    for (k, (s, place)) in shown.iter().zip(&places).enumerate() {
        y += row;
        if y > last && k + 1 < shown.len() {
            let rest = format!("and {} more", shown.len() - k);
            put(area, &theme.words(&rest, at(4, y), Anchor::End, theme.note, theme.grey));
            break;
        }
        put(area, &swatch(Point::new(frame.corner.x, y - 0.35 * theme.note), s, theme));
        let number =
            if has_circuits { format!("{}/{}", s.curve.trace, s.curve.circuit) } else { s.curve.trace.to_string() };
        let [along, across] = [0, 1].map(|k| place.map_or(String::new(), |place| fixed(place[k], decimals[k])));
        let [straight, over] = straight(solved, s.curve);
        for (column, text) in [number, along, across, straight, over].iter().enumerate().take(columns) {
            let color = if column == 0 { s.ink(theme) } else { theme.grey };
            put(area, &theme.words(text, at(column, y), Anchor::End, theme.note, color));
        }
    }
}

/// Two dashes of the curve in its manner, with its point.
fn swatch(at: Point, shown: &Shown, theme: &Theme) -> Drawing {
    let ink = shown.ink(theme);
    let length = 2.4 * theme.note;
    let line = |from: f64, to: f64| Line {
        points: vec![at + Vector::new(from * length, 0.0), at + Vector::new(to * length, 0.0)],
        closed: false,
    };
    let drawn = 0.5 * theme.curve_drawn(shown.place);
    let lines = vec![line(0.0, drawn), line(0.5, 0.5 + drawn)];
    let mut items = vec![Item::Path(Path { lines, stroke: Some(theme.curve_stroke(shown.place)), fill: None })];
    if shown.is_lined(theme) {
        let stroke = Some(theme.stroke(ink, 0.6 * theme.fine));
        items.insert(0, Item::Path(Path { lines: vec![line(0.0, 1.0)], stroke, fill: None }));
    }
    let fill = Some(if shown.is_lined(theme) { ink } else { theme.paper });
    let centre = at + Vector::new(length, 0.0);
    let stroke = Some(theme.stroke(ink, theme.fine));
    items.push(Item::Circle(Circle { centre, radius: 0.8 * theme.joint, stroke, fill }));
    Drawing { class: "swatch", title: String::new(), items }
}

/// Where a point is on its link, along its base from the first joint and to the left of it; nothing where it is not
/// placed that way.
fn place(linkage: &Linkage, curve: &Curve) -> Option<[f64; 2]> {
    let Step::Rigid { base: [from, to], along, across } = linkage.joints[curve.joint].step else { return None };
    let link = linkage.links.iter().find(|link| link.place(from).is_some() && link.place(to).is_some())?;
    let base = (link.place(to)? - link.place(from)?).norm();
    Some([along * base, across * base])
}

/// The decimals it takes to tell some values from each other and from zero: two, or more while the column has room.
fn decimals(values: impl Iterator<Item = f64>) -> usize {
    /// What differs by this part is the same but for rounding.
    const ALIKE: f64 = 1e-9;
    /// As many figures and signs as the column has room for.
    const ROOM: usize = 7;
    let mut values: Vec<f64> = values.chain([0.0]).collect();
    values.sort_by(f64::total_cmp);
    let is_told = |pair: &[f64], decimals: usize| {
        let alike = pair[1] - pair[0] <= ALIKE * pair[0].abs().max(pair[1].abs());
        alike || fixed(pair[0], decimals) != fixed(pair[1], decimals)
    };
    let has_room = |decimals: usize| values.iter().all(|value| fixed(*value, decimals).chars().count() <= ROOM);
    let all_told = |decimals: usize| values.windows(2).all(|pair| is_told(pair, decimals));
    let mut decimals = 2;
    while !all_told(decimals) && has_room(decimals + 1) {
        decimals += 1;
    }
    decimals
}

/// A number with so many decimals and a true minus sign; zero has none.
fn fixed(value: f64, decimals: usize) -> String {
    let number = format!("{value:.decimals$}");
    if number.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        return number.trim_start_matches('-').to_owned();
    }
    number.replace('-', "−")
}

/// The length of a curve's straight portion and the input it spans.
fn straight(solved: &Solved, curve: &Curve) -> [String; 2] {
    match &curve.straight {
        Some(portion) => [digits(portion.length, 3), format!("{:.1}{}", portion.input, input_unit(solved))],
        None => ["–", "–"].map(str::to_owned),
    }
}
