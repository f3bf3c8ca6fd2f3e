//! Measured properties that are marked on curves and written under them: straight portions and axes of symmetry.

use super::layout::Layout;
use super::plot::{MAX_CURVE_ERROR, Plot};
use super::theme::Theme;
use super::typography::{format_fixed, superscript};
use crate::scene::{Color, Item, Path, Polyline};

use coupler_curves::family::{Family, StraightCriterion};
use coupler_curves::geometry::{Bounds, Point, distance_to_segment, simplify_polyline};
use coupler_curves::linkage::{Input, JointId, Linkage};
use coupler_curves::measure::{Measure, MeasureSet, StraightPortion, Symmetry, SymmetryAxis};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_curves::text::{format_as_written, format_exactly, round_to_six_digits};

/// The measures that pages of every layout and the index of a book use, in addition to those in captions.
pub(super) const PAGE_MEASURES: MeasureSet = MeasureSet::EMPTY
    .with(Measure::CLASS)
    .with(Measure::MU_MIN)
    .with(Measure::MU_MAX)
    .with(Measure::MU_WORST)
    .with(Measure::LENGTH)
    .with(Measure::STRAIGHT_LENGTH)
    .with(Measure::STRAIGHT_TWIN)
    .with(Measure::SYMMETRY)
    .with(Measure::TOLERANCE_WORST);

/// The facts of a cell of a family: first its class, the range of its transmission angle and that of its actuator, second
/// its longest straight portion. Either may be empty.
pub fn cell_facts(family: &Family, solved: &SolvedCell) -> [String; 2] {
    let Some(first) = solved.curves.first() else { return Default::default() };
    let mut parts = Vec::new();
    if let Some(class) = first.measure(Measure::CLASS) {
        parts.push(class.to_owned());
    }
    if let (Some(least), Some(most)) = (first.measure(Measure::MU_MIN), first.measure(Measure::MU_MAX)) {
        parts.push(transmission_text(least, most));
    } else {
        parts.extend(least_transmission_text(solved, first));
    }
    parts.extend(input_range(solved, first));
    parts.extend(tolerance_fact(solved));
    // The path of a slider on its guide is straight by construction.
    let is_of_slider = |curve: &&MeasuredCurve| solved.linkage.slider_line(curve.joint).is_some();
    let portions = solved.curves.iter().filter(|curve| !is_of_slider(curve));
    let portions = portions.filter_map(|curve| Some((curve, curve.straight.as_ref()?)));
    let longest = portions.max_by(|(_, a), (_, b)| a.length.total_cmp(&b.length));
    let straight = longest.map_or(String::new(), |(curve, portion)| {
        let unit = solved.linkage.input().unit_sign();
        // The input may pass the mirror image in another range.
        let image = mirrored_portion(solved, curve, portion);
        let image = match image {
            None => "",
            Some(_) if has_equal_twin(solved, curve, portion) => ", twice",
            Some(_) => ", also mirrored",
        };
        let length = format_with_digits(portion.length, 4);
        let [exactly, deviation] = deviation_texts(family.straight, portion);
        let path = path_name(solved, curve).map(|name| name.join(" "));
        // The linkage is drawn on the first circuit.
        let circuit = (curve.circuit > 1).then(|| format!("circuit {}", curve.circuit));
        let which: Vec<String> = path.into_iter().chain(circuit).collect();
        let which = if which.is_empty() { String::new() } else { format!(" ({})", which.join(", ")) };
        let span = match solved.linkage.input() {
            Input::Length => format_with_digits(portion.input_span, 4),
            Input::Angle { .. } => format!("{:.1}{unit}", portion.input_span),
        };
        format!("{exactly}straight {length}{deviation} over {span}{image}{which}")
    });
    [parts.join(" · "), straight]
}

/// The greatest move of a curve that is shown: as large as the curve itself, as next to a limit that an error of a length moves, the first order
/// says nothing.
pub(super) fn greatest_shown_move(solved: &SolvedCell, curve: &MeasuredCurve) -> f64 {
    Bounds::from_points(solved.circuit(curve).points(curve.joint)).size().norm()
}

/// How far the curves of a cell move in the worst case; `None` without a tolerance.
fn tolerance_fact(solved: &SolvedCell) -> Option<String> {
    let moves = solved.curves.iter().map(|curve| curve.measure(Measure::TOLERANCE_WORST));
    let most = moves.collect::<Option<Vec<f64>>>()?.into_iter().fold(0.0, f64::max);
    let curves = if solved.curves.len() == 1 { "the curve" } else { "the curves" };
    let tolerance = format_as_written(solved.linkage.tolerance?);
    let shown = solved.curves.iter().map(|curve| greatest_shown_move(solved, curve)).fold(0.0, f64::max);
    let by = if most > shown {
        format!("more than {}", format_with_digits(shown, 2))
    } else {
        format!("up to {}", format_with_digits(most, 2))
    };
    Some(format!("lengths ± {tolerance} move {curves} by {by}"))
}

/// The part whose length or way is the input.
pub(super) fn driver(linkage: &Linkage) -> &'static str {
    if linkage.is_driven_by_slider() { "slider" } else { "actuator" }
}

/// The range of the input on the circuit of a curve; of one that turns fully, the turns after which its poses repeat if these are several.
fn input_range(solved: &SolvedCell, curve: &MeasuredCurve) -> Option<String> {
    let circuit = solved.circuit(curve);
    let ranges = circuit.passes.iter().map(|pass| pass.input_range());
    let [least, most] = ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    if circuit.is_full_turn() {
        let turns = ((most - least) / 360.0).round();
        return (turns > 1.0).then(|| format!("repeats after {turns} turns"));
    }
    // A dash would look like the sign of a negative number.
    let to = if least < 0.0 { " to " } else { "–" };
    let [least, most] = [(least, 1.0), (most, -1.0)].map(|(end, inward)| format_limit(&solved.linkage, end, inward));
    let what = if solved.linkage.input() == Input::Length { driver(&solved.linkage) } else { "input" };
    Some(format!("{what} {least}{to}{most}"))
}

/// A value of the input with its unit: an angle with up to two decimals.
pub(super) fn format_input(linkage: &Linkage, input: f64) -> String {
    match linkage.input() {
        Input::Length => format_with_digits(input, LENGTH_DIGITS),
        Input::Angle { .. } => format!("{}°", format_exactly((input * 100.0).round() / 100.0)),
    }
}

/// The same of a limit of the input, rounded inward, by the sign of `inward`, so that the linkage reaches what is printed.
fn format_limit(linkage: &Linkage, limit: f64, inward: f64) -> String {
    /// Limits are known to about this part of the last place that is printed, and one that is round is printed as it is.
    const ACCURACY: f64 = 1e-6;
    let decimals = match linkage.input() {
        Input::Length => decimals(exponent(limit), LENGTH_DIGITS),
        Input::Angle { .. } => 2,
    };
    let places = (0..decimals).fold(1.0, |places, _| places * 10.0);
    let printed = (limit * places).round() / places;
    let is_outside = (limit - printed) * inward > ACCURACY / places;
    format_input(linkage, if is_outside { printed + inward / places } else { limit })
}

/// The digits of an input that is a length.
const LENGTH_DIGITS: i32 = 4;

/// What the path of a curve is called, where several joints are traced, on all pages but those of coupler grids.
pub(super) fn path_name(solved: &SolvedCell, curve: &MeasuredCurve) -> Option<[String; 2]> {
    Layout::Panels { columns: 1, rows: 1 }.curve_name(&solved.linkage, curve.trace)
}

/// The range of the transmission angle, in degrees. At 0° and at 180° coupler and output link are on one line, and no force
/// is transmitted, which is said in words.
fn transmission_text(least: f64, most: f64) -> String {
    /// What is printed as 0 or 180 with one decimal.
    const ROUNDING: f64 = 0.05;
    match (least < ROUNDING, most > 180.0 - ROUNDING) {
        (false, false) if format_fixed(least, 1) == format_fixed(most, 1) => format!("μ {least:.1}°"),
        (false, false) => format!("μ {least:.1}°–{most:.1}°"),
        (true, false) => format!("μ reaches 0°, up to {most:.1}°"),
        (false, true) => format!("μ from {least:.1}°, reaches 180°"),
        (true, true) => "μ reaches 0° and 180°".to_owned(),
    }
}

/// The least transmission angle of a linkage that is no four-bar, at any of its joints, on the circuit on which it is drawn, and on the others where
/// it is another; `None` where no joint has one that changes.
fn least_transmission_text(solved: &SolvedCell, first: &MeasuredCurve) -> Option<String> {
    /// What is printed as 0 or 90 with one decimal.
    const ROUNDING: f64 = 0.05;
    let own = first.measure(Measure::MU_WORST).filter(|own| *own < 90.0 - ROUNDING)?;
    let others = solved.curves.iter().filter(|curve| curve.circuit != first.circuit);
    let others = others.filter_map(|curve| curve.measure(Measure::MU_WORST)).reduce(f64::min);
    let least = |value: f64| if value < ROUNDING { "0°".to_owned() } else { format!("{value:.1}°") };
    let others = others.filter(|other| (other - own).abs() > ROUNDING);
    let others =
        others.map_or(String::new(), |other| format!(" (circuit {}), elsewhere {}", first.circuit, least(other)));
    Some(format!("least μ {}{others}", least(own)))
}

/// What is said of the deviation of a straight portion before the word and after the length: nothing if the criterion sets
/// it as a part of the length.
fn deviation_texts(criterion: StraightCriterion, portion: &StraightPortion) -> [String; 2] {
    /// A smaller part of the length is rounding.
    const ROUNDING: f64 = 1e-12;
    match criterion {
        _ if portion.deviation <= ROUNDING * portion.length => ["exactly ".to_owned(), String::new()],
        StraightCriterion::Tolerance(_) => Default::default(),
        _ => [String::new(), format!(" ± {}", format_with_digits(portion.deviation, 2))],
    }
}

/// What is said of straight portions in the line of symbols.
pub(super) fn straight_criterion_text(criterion: StraightCriterion, unit: &str) -> String {
    match criterion {
        StraightCriterion::Tolerance(tolerance) => {
            let half = format_exactly(round_to_six_digits(0.5 * tolerance));
            format!("longest straight portion, within ± {half} of its length")
        }
        StraightCriterion::Input(input) => format!("straightest portion over {input}{unit} of input"),
        StraightCriterion::Length(length) => format!("straightest portion of length {length}"),
    }
}

/// The mirror image of a straight portion in the axis of its curve, if the curve is symmetrical and the image is another portion: where
/// both overlap or touch, they are one.
fn mirrored_portion(solved: &SolvedCell, curve: &MeasuredCurve, portion: &StraightPortion) -> Option<Vec<Point>> {
    /// The ends of a portion are known to about this part of its length.
    const END_ACCURACY: f64 = 1e-3;
    /// The sine of the angle up to which two portions are on one line.
    const PARALLEL: f64 = 0.1;
    let axis = curve.symmetry.as_ref().and_then(Symmetry::axis_if_symmetric)?;
    crosses_axis(solved, curve, &axis).then_some(())?;
    let image: Vec<Point> = portion.points.iter().map(|p| axis.mirror(*p)).collect();
    let (first, last) = (*portion.points.first()?, *portion.points.last()?);
    let along = (last - first).try_normalize(0.0)?;
    let [from, to] = [*image.first()?, *image.last()?];
    // Portions that cross or meet at an angle are two.
    let is_parallel = along.perp(&(to - from)).abs() <= PARALLEL * (to - from).norm();
    let near = END_ACCURACY * portion.length + 2.0 * portion.deviation;
    let is_on_portion = |end: Point| distance_to_segment(end, first, last) <= near;
    (!(is_parallel && [from, to].into_iter().any(is_on_portion))).then_some(image)
}

/// Whether the mirror image of a portion takes as much input as the portion, from where its twin begins: the samples in that range are those on the image.
fn has_equal_twin(solved: &SolvedCell, curve: &MeasuredCurve, portion: &StraightPortion) -> bool {
    /// The samples at the ends that rounding may leave out.
    const ENDS: usize = 2;
    let is_known = || {
        let axis = curve.symmetry.as_ref().and_then(Symmetry::axis_if_symmetric)?;
        let start = curve.measure(Measure::STRAIGHT_TWIN)?;
        let (first, last) = (*portion.points.first()?, *portion.points.last()?);
        let along = (last - first).try_normalize(0.0)?;
        let circuit = solved.circuit(curve);
        let is_on_image = |p: Point| {
            let off = axis.mirror(p) - first;
            let (along, across) = (along.dot(&off), (off - along * along.dot(&off)).norm());
            (0.0..=(last - first).norm()).contains(&along) && across <= 2.0 * portion.deviation + 1e-9 * portion.length
        };
        let is_in_range = |input: f64| {
            let from_start = if circuit.is_full_turn() { (input - start).rem_euclid(360.0) } else { input - start };
            (0.0..=portion.input_span).contains(&from_start)
        };
        let samples = circuit.inputs.iter().zip(circuit.points(curve.joint));
        Some(samples.filter(|(input, p)| is_in_range(**input) != is_on_image(*p)).count() <= ENDS)
    };
    is_known().unwrap_or(false)
}

/// The straight portion of a curve, if it is long enough to be seen, at least a fiftieth of the extent of the curve, and is
/// not the whole curve.
pub(super) fn visible_straight_portion<'a>(
    solved: &'a SolvedCell,
    curve: &'a MeasuredCurve,
) -> Option<&'a StraightPortion> {
    let bounds = Bounds::from_points(solved.circuit(curve).points(curve.joint));
    let extent = bounds.size().x.max(bounds.size().y);
    let diagonal = bounds.size().norm();
    curve.straight.as_ref().filter(|portion| portion.length >= 0.02 * extent && portion.length < 0.999 * diagonal)
}

/// A number with `count` significant digits; times a power of ten if it is very large or small.
pub(super) fn format_with_digits(value: f64, count: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let exponent = exponent(value);
    if (-5..7).contains(&exponent) {
        return format!("{value:.0$}", decimals(exponent, count));
    }
    let scientific = format!("{value:.0$e}", decimals(0, count));
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    format!("{digits} × 10{}", superscript(exponent))
}

/// The power of ten of the first digit of a number.
fn exponent(value: f64) -> i32 {
    format!("{value:e}").rsplit('e').next().and_then(|exponent| exponent.parse().ok()).unwrap_or(0)
}

/// The decimals of a number with `count` significant digits.
fn decimals(exponent: i32, count: i32) -> usize {
    usize::try_from(count - 1 - exponent).unwrap_or(0)
}

/// The straight portion of a curve as a broad light band under the dashes, and its mirror image on a symmetrical curve.
pub(super) fn straight_portion_item(
    solved: &SolvedCell,
    curve: &MeasuredCurve,
    ink: Color,
    plot: &Plot,
    theme: &Theme,
) -> Option<Item> {
    let portion = visible_straight_portion(solved, curve)?;
    let line = |points: &[Point]| {
        let points: Vec<Point> = points.iter().map(|p| plot.page_from_plane.apply(*p)).collect();
        Polyline { points: simplify_polyline(&points, MAX_CURVE_ERROR), is_closed: false }
    };
    let image = mirrored_portion(solved, curve, portion);
    let polylines = std::iter::once(line(&portion.points)).chain(image.iter().map(|image| line(image))).collect();
    let stroke = Some(theme.stroke(theme.faded(ink), 3.0 * theme.curve_width));
    Some(Item::Path(Path { polylines, stroke, fill: None }))
}

/// Whether an axis of symmetry is marked.
pub(super) fn has_symmetry_axis(solved: &SolvedCell) -> bool {
    !marked_axes(solved, &solved.curves.iter().collect::<Vec<_>>()).is_empty()
}

/// The axes of symmetry of the curves as dash-dotted lines, a little longer than the curves that have them.
pub(super) fn symmetry_axis_items(
    solved: &SolvedCell,
    curves: &[&MeasuredCurve],
    plot: &Plot,
    theme: &Theme,
) -> Vec<Item> {
    let item = |axis| symmetry_axis_item(solved, curves, axis, plot, theme);
    marked_axes(solved, curves).iter().filter_map(item).collect()
}

/// The axes of symmetry that inform: not of straight lines and of arcs about a fixed pivot.
fn marked_axes(solved: &SolvedCell, curves: &[&MeasuredCurve]) -> Vec<SymmetryAxis> {
    let mut drawn: Vec<SymmetryAxis> = Vec::new();
    for curve in curves {
        let axis = curve.symmetry.as_ref().and_then(Symmetry::axis_if_symmetric);
        // A straight line is symmetrical about itself, but drawing that axis would hide it.
        let new = axis.filter(|axis| drawn.iter().all(|other| !is_same_axis(other, axis)));
        drawn.extend(new.filter(|axis| crosses_axis(solved, curve, axis) && !is_arc(solved, curve)));
    }
    drawn
}

fn is_same_axis(one: &SymmetryAxis, other: &SymmetryAxis) -> bool {
    (one.direction_deg() - other.direction_deg()).abs() < 1e-6 && (one.mirror(other.point) - other.point).norm() < 1e-6
}

/// Whether a curve is on a circle about a fixed pivot.
fn is_arc(solved: &SolvedCell, curve: &MeasuredCurve) -> bool {
    /// The positions of joints are known to less than this part of the radius.
    const ROUNDING: f64 = 1e-9;
    let circuit = solved.circuit(curve);
    let is_at_constant_distance = |pivot: JointId| {
        let centre = circuit.positions.point(pivot, 0);
        let distances = circuit.points(curve.joint).map(|p| (p - centre).norm());
        let [least, most] = distances.fold([f64::INFINITY, 0.0], |[low, high], d| [low.min(d), high.max(d)]);
        most - least <= ROUNDING * most
    };
    solved.linkage.pivots().into_iter().any(is_at_constant_distance)
}

/// Whether a curve leaves an axis of symmetry, and does not only run along it or straight across it.
fn crosses_axis(solved: &SolvedCell, curve: &MeasuredCurve, axis: &SymmetryAxis) -> bool {
    /// Symmetry is known to 1e-4 of the extent of a curve.
    const VISIBLE: f64 = 1e-3;
    let (mut along, mut off) = ([f64::INFINITY, f64::NEG_INFINITY], 0.0f64);
    for p in solved.circuit(curve).points(curve.joint) {
        let position = axis.direction.dot(&(p - axis.point));
        along = [along[0].min(position), along[1].max(position)];
        off = off.max((axis.mirror(p) - p).norm());
    }
    let length = along[1] - along[0];
    off > VISIBLE * length && length > VISIBLE * off
}

fn symmetry_axis_item(
    solved: &SolvedCell,
    curves: &[&MeasuredCurve],
    axis: &SymmetryAxis,
    plot: &Plot,
    theme: &Theme,
) -> Option<Item> {
    let has_axis = |curve: &&&MeasuredCurve| {
        let own = curve.symmetry.as_ref().and_then(Symmetry::axis_if_symmetric);
        own.is_some_and(|own| is_same_axis(&own, axis))
    };
    let points = curves.iter().filter(has_axis).flat_map(|curve| solved.circuit(curve).points(curve.joint));
    let positions = points.map(|p| axis.direction.dot(&(p - axis.point)));
    let [low, high] = positions.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)]);
    let beyond = 1.6 * theme.joint_radius / plot.page_from_plane.scale();
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
