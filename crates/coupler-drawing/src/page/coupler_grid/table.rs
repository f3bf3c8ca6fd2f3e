//! The table of the points of a page: coordinates on the link, and the straight portion of the curve.

use super::super::CouplerGridPage;
use super::super::area::Area;
use super::super::arrangement::Rect;
use super::super::element::Drawing;
use super::super::marks::format_significant;
use super::super::theme::Theme;
use super::{ShownCurve, input_unit};
use crate::scene::{Anchor, Circle, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::{JointKind, Linkage};
use coupler_curves::measure::Value;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The heads of the columns, and the right edge of each as a fraction of the table's width.
const COLUMNS: [(&str, f64); 5] =
    [("point", 0.2), ("along", 0.38), ("across", 0.58), ("straight", 0.82), ("over", 1.0)];

/// The number of columns without those of the straight portion.
const POINT_COLUMNS: usize = 3;

/// Draws the table at the head of a frame.
pub(super) fn draw(area: &impl Area, frame: Rect, page: &CouplerGridPage, shown: &[ShownCurve], theme: &Theme) {
    let solved = page.panel.solved_cell;
    let has_circuits = solved.motion.circuits.len() > 1;
    let row = 1.5 * theme.note_size;
    let at = |column: usize, y: f64| Point::new(frame.corner.x + COLUMNS[column].1 * frame.size.x, y);
    let mut y = frame.corner.y + 1.5 * row;
    let has_straightness = shown.iter().any(|s| s.curve.value("straight_length") != Value::Missing);
    let columns = if has_straightness { COLUMNS.len() } else { POINT_COLUMNS };
    let coordinates: Vec<Option<[f64; 2]>> = shown.iter().map(|s| link_coordinates(&solved.linkage, s.curve)).collect();
    let decimals = [0, 1].map(|k| decimals_needed(coordinates.iter().flatten().map(|pair| pair[k])));
    // A traced joint of a link has no coordinates.
    let is_blank = |column: usize| (1..POINT_COLUMNS).contains(&column) && coordinates.iter().all(Option::is_none);
    for (column, (head, _)) in COLUMNS.iter().enumerate().take(columns).filter(|(column, _)| !is_blank(*column)) {
        area.record(&theme.text_line(head, at(column, y), Anchor::End, 0.9 * theme.note_size, theme.grey));
    }
    let rule =
        vec![Point::new(frame.corner.x, y + 0.4 * row), Point::new(frame.corner.x + frame.size.x, y + 0.4 * row)];
    let rule = Item::Path(Path::stroked(rule, theme.stroke(theme.hairline, theme.hair_width)));
    area.record(&Drawing { class: "rule", title: String::new(), items: vec![rule] });
    y += 0.25 * row;
    let last = frame.corner.y + frame.size.y - 3.0 * row;
    for (k, (s, coordinates)) in shown.iter().zip(&coordinates).enumerate() {
        y += row;
        if y > last && k + 1 < shown.len() {
            let rest = format!("and {} more", shown.len() - k);
            area.record(&theme.text_line(&rest, at(4, y), Anchor::End, theme.note_size, theme.grey));
            break;
        }
        area.record(&swatch(Point::new(frame.corner.x, y - 0.35 * theme.note_size), s, theme));
        let number =
            if has_circuits { format!("{}/{}", s.curve.trace, s.curve.circuit) } else { s.curve.trace.to_string() };
        let [along, across] =
            [0, 1].map(|k| coordinates.map_or(String::new(), |pair| format_fixed(pair[k], decimals[k])));
        let [straight, over] = format_straight_portion(solved, s.curve);
        for (column, text) in [number, along, across, straight, over].iter().enumerate().take(columns) {
            let color = if column == 0 { s.ink(theme) } else { theme.grey };
            area.record(&theme.text_line(text, at(column, y), Anchor::End, theme.note_size, color));
        }
    }
}

/// Two dashes of the curve, and its point.
fn swatch(at: Point, shown: &ShownCurve, theme: &Theme) -> Drawing {
    let ink = shown.ink(theme);
    let length = 2.4 * theme.note_size;
    let line = |from: f64, to: f64| Polyline {
        points: vec![at + Vector::new(from * length, 0.0), at + Vector::new(to * length, 0.0)],
        is_closed: false,
    };
    let drawn = 0.5 * theme.curve_dash_fraction(shown.point_index);
    let lines = vec![line(0.0, drawn), line(0.5, 0.5 + drawn)];
    let path =
        |polylines: Vec<Polyline>, stroke: Stroke| Item::Path(Path { polylines, stroke: Some(stroke), fill: None });
    let mut items =
        vec![path(vec![line(0.0, 1.0)], shown.hairline(theme)), path(lines, theme.curve_stroke(shown.point_index))];
    let fill = Some(if shown.has_underline(theme) { ink } else { theme.paper });
    let centre = at + Vector::new(length, 0.0);
    let stroke = Some(theme.stroke(ink, theme.fine_width));
    items.push(Item::Circle(Circle { centre, radius: 0.8 * theme.joint_radius, stroke, fill }));
    Drawing { class: "swatch", title: String::new(), items }
}

/// The coordinates of a point on its link: along the base from its first joint, and to the left of it. `None` if the
/// joint is not a point of a rigid link.
fn link_coordinates(linkage: &Linkage, curve: &MeasuredCurve) -> Option<[f64; 2]> {
    let JointKind::Rigid { base: [from, to], along, across } = linkage.joints[curve.joint].kind else { return None };
    let link = linkage.links.iter().find(|link| link.position(from).is_some() && link.position(to).is_some())?;
    let base = (link.position(to)? - link.position(from)?).norm();
    Some([along * base, across * base])
}

/// The number of decimals that distinguishes values from each other and from zero: at least two, and no more than fit
/// the column.
fn decimals_needed(values: impl Iterator<Item = f64>) -> usize {
    /// Values with a smaller relative difference are equal up to rounding.
    const ROUNDING: f64 = 1e-9;
    /// The number of characters that fit the column.
    const MAX_CHARACTERS: usize = 7;
    let mut values: Vec<f64> = values.chain([0.0]).collect();
    values.sort_by(f64::total_cmp);
    let is_distinct = |pair: &[f64], decimals: usize| {
        let is_equal = pair[1] - pair[0] <= ROUNDING * pair[0].abs().max(pair[1].abs());
        is_equal || format_fixed(pair[0], decimals) != format_fixed(pair[1], decimals)
    };
    let fits =
        |decimals: usize| values.iter().all(|value| format_fixed(*value, decimals).chars().count() <= MAX_CHARACTERS);
    let all_distinct = |decimals: usize| values.windows(2).all(|pair| is_distinct(pair, decimals));
    let mut decimals = 2;
    while !all_distinct(decimals) && fits(decimals + 1) {
        decimals += 1;
    }
    decimals
}

/// A number with a fixed number of decimals and a true minus sign, which zero does not have.
fn format_fixed(value: f64, decimals: usize) -> String {
    let number = format!("{value:.decimals$}");
    if number.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        return number.trim_start_matches('-').to_owned();
    }
    number.replace('-', "−")
}

/// The length of the straight portion of a curve, and the range of the input it spans.
fn format_straight_portion(solved: &SolvedCell, curve: &MeasuredCurve) -> [String; 2] {
    match &curve.straight {
        Some(portion) => {
            [format_significant(portion.length, 3), format!("{:.1}{}", portion.input_span, input_unit(solved))]
        }
        None => ["–", "–"].map(str::to_owned),
    }
}
