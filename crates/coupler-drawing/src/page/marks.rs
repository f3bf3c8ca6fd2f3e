//! Measured properties that are marked on curves and written under them: straight portions and axes of symmetry.

use super::figure::MAX_CURVE_ERROR;
use super::plot::Plot;
use super::theme::Theme;
use crate::scene::{Color, Item, Path, Polyline};
use coupler_curves::geometry::{Bounds, Point, simplify_polyline};
use coupler_curves::linkage::Input;
use coupler_curves::measure::{StraightPortion, Symmetry, SymmetryAxis, Value};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The measures that pages and the index of a book use, in addition to those in captions.
pub const PAGE_MEASURES: [&str; 7] =
    ["class", "mu_min_deg", "mu_max_deg", "mu_worst_deg", "length", "straight_length", "symmetry"];

/// The facts of a cell: first its class and the range of its transmission angle, second its longest straight portion.
/// Either may be empty.
pub fn cell_facts(solved: &SolvedCell) -> [String; 2] {
    let Some(first) = solved.curves.first() else { return Default::default() };
    let mut parts = Vec::new();
    if let Value::Word(class) = first.value("class") {
        parts.push(class.to_owned());
    }
    if let (Value::Number(least), Value::Number(most)) = (first.value("mu_min_deg"), first.value("mu_max_deg")) {
        parts.push(format!("μ {least:.1}°–{most:.1}°"));
    }
    let portions = solved.curves.iter().filter_map(|curve| Some((curve, curve.straight.as_ref()?)));
    let longest = portions.max_by(|(_, a), (_, b)| a.length.total_cmp(&b.length));
    let straight = longest.map_or(String::new(), |(curve, portion)| {
        let unit = if solved.linkage.input() == Input::Length { "" } else { "°" };
        let (length, deviation) = (format_significant(portion.length, 4), format_significant(portion.deviation, 2));
        let curve_number =
            if solved.linkage.traced.len() > 1 { format!(" (curve {})", curve.trace) } else { String::new() };
        format!("straight {length} ± {deviation} over {:.1}{unit}{curve_number}", portion.input_span)
    });
    [parts.join(" · "), straight]
}

/// The straight portion of a curve, if it is long enough to be seen: at least a fiftieth of the extent of the curve.
fn visible_straight_portion<'a>(solved: &'a SolvedCell, curve: &'a MeasuredCurve) -> Option<&'a StraightPortion> {
    let bounds = Bounds::from_points(solved.circuit(curve).points(curve.joint));
    let extent = bounds.size().x.max(bounds.size().y);
    curve.straight.as_ref().filter(|portion| portion.length >= 0.02 * extent)
}

/// A number with `count` significant digits, in scientific notation if it is very large or small.
pub(super) fn format_significant(value: f64, count: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let exponent = format!("{value:e}").rsplit('e').next().and_then(|e| e.parse::<i32>().ok()).unwrap_or(0);
    if (-5..7).contains(&exponent) {
        let decimals = usize::try_from(count - 1 - exponent).unwrap_or(0);
        return format!("{value:.decimals$}");
    }
    let decimals = usize::try_from(count - 1).unwrap_or(0);
    format!("{value:.decimals$e}")
}

/// The straight portion of a curve as a broad light band under the dashes.
pub(super) fn straight_portion_item(
    solved: &SolvedCell,
    curve: &MeasuredCurve,
    ink: Color,
    plot: &Plot,
    theme: &Theme,
) -> Option<Item> {
    let portion = visible_straight_portion(solved, curve)?;
    let points: Vec<Point> = portion.points.iter().map(|p| plot.page_from_plane.apply(*p)).collect();
    let points = simplify_polyline(&points, MAX_CURVE_ERROR);
    let stroke = Some(theme.stroke(theme.faded(ink), 3.0 * theme.curve_width));
    Some(Item::Path(Path { polylines: vec![Polyline { points, is_closed: false }], stroke, fill: None }))
}

/// The axes of symmetry of the curves as dash-dotted lines, a little longer than the curves.
pub(super) fn symmetry_axis_items(solved: &SolvedCell, plot: &Plot, theme: &Theme) -> Vec<Item> {
    let mut drawn: Vec<SymmetryAxis> = Vec::new();
    for curve in &solved.curves {
        let axis = curve.symmetry.as_ref().and_then(Symmetry::axis_if_symmetric);
        let is_like = |other: &SymmetryAxis, axis: &SymmetryAxis| {
            (other.direction_deg() - axis.direction_deg()).abs() < 1e-6
                && (other.mirror(axis.point) - axis.point).norm() < 1e-6
        };
        // A straight line is symmetrical about itself, but drawing that axis would hide it.
        let new = axis.filter(|axis| drawn.iter().all(|other| !is_like(other, axis)));
        drawn.extend(new.filter(|axis| crosses_axis(solved, curve, axis)));
    }
    drawn.iter().filter_map(|axis| symmetry_axis_item(solved, axis, plot, theme)).collect()
}

/// Whether a curve leaves an axis of symmetry, and does not only run along it.
fn crosses_axis(solved: &SolvedCell, curve: &MeasuredCurve, axis: &SymmetryAxis) -> bool {
    let (mut along, mut off) = (0.0f64, 0.0f64);
    for p in solved.circuit(curve).points(curve.joint) {
        along = along.max((p - axis.point).norm());
        off = off.max((axis.mirror(p) - p).norm());
    }
    off > 1e-3 * along
}

fn symmetry_axis_item(solved: &SolvedCell, axis: &SymmetryAxis, plot: &Plot, theme: &Theme) -> Option<Item> {
    let points = solved.curves.iter().flat_map(|curve| solved.circuit(curve).points(curve.joint));
    let positions = points.map(|p| axis.direction.dot(&(p - axis.point)));
    let [low, high] = positions.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)]);
    let beyond = 1.6 * theme.joint_radius / plot.page_from_plane.scale;
    let end = |s: f64| plot.page_from_plane.apply(axis.point + axis.direction * s);
    let (from, to) = (end(low - beyond), end(high + beyond));
    let whole = (to - from).norm();
    let unit = 4.0 * theme.joint_radius;
    if !whole.is_finite() || whole <= unit {
        return None;
    }
    // A period is a long dash, a gap, a dot and a gap; the line starts and ends with a long dash.
    let periods = (whole / unit - 0.6).ceil().max(1.0);
    let unit = whole / (periods + 0.6);
    let at = |s: f64| from + (to - from) * (s * unit / whole);
    let line = |a: f64, b: f64| Polyline { points: vec![at(a), at(b)], is_closed: false };
    let mut lines: Vec<Polyline> = Vec::new();
    for k in 0..periods as usize {
        let start = k as f64;
        lines.extend([line(start, start + 0.6), line(start + 0.78, start + 0.82)]);
    }
    lines.push(line(periods, periods + 0.6));
    Some(Item::Path(Path { polylines: lines, stroke: Some(theme.stroke(theme.grey, theme.hair_width)), fill: None }))
}
