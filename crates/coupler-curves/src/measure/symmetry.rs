//! Whether a curve is symmetrical, and about which axis.
//!
//! Two theorems of chapter 7 of Natesan's thesis describe four-bars with symmetrical coupler curves. *Theorem 1*
//! (Berzak): crank and rocker are equal, and the coupler point is equally far from both pins; the axis is the
//! perpendicular bisector of the frame. *Theorem 2* (Hartenberg and Denavit): coupler, rocker and the distance from the
//! rocker's pin to the coupler point are equal; the axis passes through the rocker's pivot, rotated from the frame by
//! half the angle at the rocker's pin (7.8). The same is true with crank and rocker exchanged. For any other curve the
//! axis is searched for.

use super::features::{Symmetry, SymmetryAxis};
use super::portion::Row;
use super::symmetry_axis::{AxisCandidates, MirrorImages};
use super::{Measure, TracedCurve, Value, without_rounding};
use crate::geometry::{Point, Vector, complex_product, cross, in_rising_order, trig};
use crate::linkage::{FourBar, FourBarClass, JointId, JointKind, PlacedFourBar, Sextic};

/// The measure `symmetry`.
pub const SYMMETRY: Measure = Measure::word(
    "symmetry",
    "kind of symmetry",
    "theorem 1 (crank = rocker, point on the coupler's bisector) or theorem 2 (coupler = rocker = pin to point, or coupler = crank) of Natesan's chapter 7; other: another curve whose mirror image is within 1e-4 of its extent; empty for a curve without symmetry",
    |curve: &TracedCurve| match curve.symmetry() {
        Some(Symmetry { theorem: Some(theorem), .. }) => Value::Word(theorem),
        Some(symmetry) if symmetry.residual <= Symmetry::TOLERANCE => Value::Word("other"),
        _ => Value::Missing,
    },
);

/// The measure `symmetry_deg`.
pub const AXIS: Measure = Measure::number(
    "symmetry_deg",
    "direction of the axis of symmetry",
    "deg",
    "direction of the line about which the curve is symmetrical, or nearly so, from the x-axis: 0 up to 180; empty for a circle, and where the residual would be more than 0.01",
    |curve: &TracedCurve| {
        curve.symmetry().and_then(|s| s.axis).map_or(Value::Missing, |axis| Value::Number(axis.direction_deg()))
    },
);

/// The measure `symmetry_residual`.
pub const RESIDUAL: Measure = Measure::number(
    "symmetry_residual",
    "deviation from symmetry",
    "",
    "greatest distance of the curve's mirror image about that line from the curve, relative to its greatest extent; empty where that is more than 0.01",
    |curve: &TracedCurve| {
        curve.symmetry().map_or(Value::Missing, |s| Value::Number(without_rounding(s.residual, RESOLVED)))
    },
);

impl TracedCurve<'_> {
    /// The symmetry of the curve; `None` for a point, and where its residual would be more than [`Symmetry::GREATEST`].
    pub fn symmetry(&self) -> Option<&Symmetry> {
        let is_near = |symmetry: &Symmetry| symmetry.residual <= Symmetry::GREATEST;
        self.symmetry.get_or_init(|| find_symmetry(self).filter(is_near)).as_ref()
    }
}

/// The accuracy of the residual of a symmetrical curve.
const RESOLVED: f64 = 1e-9;

/// The symmetry of a curve; `None` for a point, and for a curve that is far from any.
fn find_symmetry(curve: &TracedCurve) -> Option<Symmetry> {
    /// If the residual for a theorem's axis is greater than this, the mirror image is the curve of another circuit.
    const MAX_ROUGH_RESIDUAL: f64 = 0.1;
    /// Refining rarely improves an axis by more than a third: none with more than this is expected to come to what is reported.
    const GREATEST_ROUGH: f64 = 4.0 * Symmetry::GREATEST;
    /// As many points show whether an axis is worth refining.
    const FEW_POINTS: usize = 32;
    /// The residual below which a curve may be symmetrical about an axis that is not yet exact.
    const NEARLY: f64 = 1e-3;
    /// The residual of a few points about an axis of symmetry, relative to the extent.
    const EXACT: f64 = 1e-8;
    let extent = curve.extent();
    let row = curve.row().ok()??;
    let images = MirrorImages::new(row);
    // If a linkage has two circuits, their curves may be mirror images of each other, and not of themselves. A part of a
    // curve does not have the axis of the whole.
    if row.is_closed
        && let Some((axis, theorem)) = axis_by_theorem(curve)
        && (has_one_circuit(curve) || images.residual(axis, FEW_POINTS, MAX_ROUGH_RESIDUAL * extent).is_some())
    {
        let residual = residual_by_sextic(curve, row, axis).unwrap_or_else(|| images.exact_residual(axis)) / extent;
        return Some(Symmetry { axis: Some(axis), residual, theorem: Some(theorem) });
    }
    if images.are_far(extent, Symmetry::GREATEST * extent) {
        return None;
    }
    let candidates = match images.candidates() {
        AxisCandidates::AnyDiameter => return Some(Symmetry { axis: None, residual: 0.0, theorem: None }),
        AxisCandidates::Lines(lines) => lines,
    };
    // If the moving joints are in line too, the mirror image of a pose is a pose of the other branch.
    if let Some(axis) = line_of_pivots(curve)
        && images.residual(axis, FEW_POINTS, EXACT * extent).is_some()
    {
        return Some(Symmetry { axis: Some(axis), residual: images.exact_residual(axis) / extent, theorem: None });
    }
    let few = |axis| Some((images.residual(axis, FEW_POINTS, GREATEST_ROUGH * extent)?, axis));
    let rough = in_rising_order(candidates.into_iter().filter_map(few).collect(), |candidate| candidate.0);
    let least = rough.first()?.0;
    // Refining an axis rarely improves it by more than a third.
    let refined =
        rough.into_iter().filter(|(rough, _)| *rough <= 1.5 * least).map(|(rough, axis)| images.refine(axis, rough));
    let refined = refined.min_by(|a, b| a.1.total_cmp(&b.1))?;
    // Where a curve bends sharply the mirror image of points next to the bend has no nearest point that moves with the axis.
    let (axis, most) = Some(refined)
        .filter(|(_, most)| *most <= NEARLY * extent)
        .and_then(|(axis, _)| axis_by_moments(curve, axis))
        .map(|axis| (axis, images.exact_residual(axis)))
        .filter(|(_, most)| *most < refined.1)
        .unwrap_or(refined);
    Some(Symmetry { axis: Some(axis), residual: most / extent, theorem: None })
}

/// The axis near another that a curve has, if it is symmetrical: through its centroid, in the direction of the moment of the least order
/// that is not small.
///
/// With z from the centroid to a point of the curve, as a complex number, the mean m of z^n over the length is that of the mirror
/// image: for an axis at the angle a, `m = e^(2ina) conj m`, so that n a is the angle of m, or differs from it by a multiple of pi.
fn axis_by_moments(curve: &TracedCurve, near: SymmetryAxis) -> Option<SymmetryAxis> {
    /// What a moment must be, relative to that of a circle of the curve's extent.
    const SMALL: f64 = 1e-5;
    /// A curve that is turned into itself by a part of a turn has no moments of lower orders than the number of these parts.
    const HIGHEST: u32 = 12;
    let (smooth, length) = (curve.smooth(), curve.arc_length());
    let centre = Point::from(length.mean(smooth, |p| p.coords));
    let scale = curve.extent() / 2.0;
    let moment = |order: u32| {
        let power = |z: Vector| (1..order).fold(z, |power, _| complex_product(power, z));
        (order, length.mean(smooth, |p| power((p - centre) / scale)))
    };
    let (order, moment) = (2..=HIGHEST).map(moment).find(|(_, moment)| moment.norm() > SMALL)?;
    let part = 180.0 / f64::from(order);
    let first = trig::degrees(trig::atan2(moment.y, moment.x)) / f64::from(order);
    let nearest = first + ((near.direction_deg() - first) / part).round() * part;
    let (cos, sin) = trig::cos_sin_deg(nearest);
    SymmetryAxis::new(centre, Vector::new(cos, sin))
}

/// The line through the first two fixed joints apart.
fn line_of_pivots(curve: &TracedCurve) -> Option<SymmetryAxis> {
    let linkage = curve.linkage;
    let position = |joint| curve.circuit.positions.point(joint, 0);
    let is_fixed = |joint: &JointId| matches!(linkage.joints[*joint].kind, JointKind::Fixed(_));
    let mut pivots = linkage.joint_ids().filter(is_fixed).map(position);
    let first = pivots.next()?;
    pivots.find_map(|other| SymmetryAxis::new(first, other - first))
}

/// Whether a four-bar has only one circuit, as a triple-rocker has.
fn has_one_circuit(curve: &TracedCurve) -> bool {
    FourBar::from_linkage(curve.linkage).is_some_and(|bar| bar.class() == FourBarClass::TripleRocker)
}

/// The greatest distance of the mirrored samples from the curve of a coupler point, from its sextic.
fn residual_by_sextic(curve: &TracedCurve, row: &Row, axis: SymmetryAxis) -> Option<f64> {
    let PlacedFourBar { pivots: [origin, end], lengths, coupler_point: point } =
        PlacedFourBar::from_linkage(curve.linkage, curve.joint).ok()?;
    let sextic = Sextic::from_four_bar(lengths, point)?;
    let frame = (end - origin).try_normalize(0.0)?;
    let distance = |point: &Point| {
        let offset = axis.mirror(*point) - origin;
        let in_frame = Point::new(frame.dot(&offset), cross(frame, offset));
        // The distance to the first order. At a double point value and gradient vanish, and the value is only rounding.
        let [value, terms] = sextic.evaluate(in_frame);
        let distance = value.abs() / sextic.gradient(in_frame).norm();
        if value.abs() > 1e-13 * terms && distance.is_finite() { distance } else { 0.0 }
    };
    Some(row.points[..row.start_count].iter().map(distance).fold(0.0, f64::max))
}

/// The axis of the curves of a coupler point by a theorem, and the name of the theorem.
fn axis_by_theorem(curve: &TracedCurve) -> Option<(SymmetryAxis, &'static str)> {
    /// The relative tolerance for equal lengths: the rounding of the expressions they come from.
    const EQUAL: f64 = 1e-12;
    let linkage = curve.linkage;
    let [o, a, b, c] = FourBar::coupler_pins(linkage, curve.joint)?;
    let FourBar { frame, crank, coupler, rocker } = FourBar::from_linkage(linkage)?;
    let link = linkage.links.iter().find(|link| [a, b, curve.joint].iter().all(|&j| link.position(j).is_some()))?;
    let to_point = |pin| Some((link.position(curve.joint)? - link.position(pin)?).norm());
    let (from_crank, from_rocker) = (to_point(a)?, to_point(b)?);
    let is_equal = |x: f64, y: f64| (x - y).abs() <= EQUAL * (frame + crank + coupler + rocker);
    let positions = curve.circuit.pieces(linkage).positions();
    let position = |joint, k| positions.point(joint, k);
    // The pivots are at rest.
    let [origin, end] = [o, c].map(|pivot| curve.circuit.positions.point(pivot, 0));
    let first = is_equal(crank, rocker) && is_equal(from_crank, from_rocker);
    // The pivots and the pins, first those of the arm that the axis belongs to; the length of the arm and the distance
    // of its pin from the point.
    let second = [([end, origin], [b, a], rocker, from_rocker), ([origin, end], [a, b], crank, from_crank)]
        .into_iter()
        .find(|(_, _, arm, to_point)| is_equal(coupler, *arm) && is_equal(coupler, *to_point));
    if first {
        let along = end - origin;
        let axis = SymmetryAxis::new(origin + along / 2.0, Vector::new(-along.y, along.x))?;
        return Some((axis, if second.is_some() { "theorems 1 and 2" } else { "theorem 1" }));
    }
    let ([pivot, other], [_, pin], ..) = second?;
    // The angle at the pivot from the pin to the point is the same in every pose; it is computed where both are far
    // from it.
    let arms = |k: usize| [position(pin, k) - pivot, position(curve.joint, k) - pivot];
    let reach = |k: usize| arms(k).map(|by| by.norm()).into_iter().fold(f64::INFINITY, f64::min);
    let best = (0..positions.len()).max_by(|&j, &k| reach(j).total_cmp(&reach(k)))?;
    let [from, to] = arms(best);
    let (cos, sin) = (from.dot(&to), cross(from, to));
    let frame = other - pivot;
    let direction = complex_product(Vector::new(cos, sin), frame);
    Some((SymmetryAxis::new(Point::from(pivot.coords), direction)?, "theorem 2"))
}
