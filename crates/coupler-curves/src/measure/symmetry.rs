//! Whether a curve is symmetrical, and about which line.
//!
//! Two theorems of chapter 7 of Natesan's thesis tell of four-bars whose coupler curves are. *Theorem 1* (Berzak): crank
//! and rocker are equal, and the coupler point is as far from the one pin as from the other; the axis is the perpendicular
//! bisector of the frame. *Theorem 2* (Hartenberg and Denavit): coupler, rocker and the way from the rocker's pin to the
//! coupler point are equal; the axis goes through the rocker's pivot, turned from the frame by half the angle at the
//! rocker's pin (7.8). The same holds with crank and rocker exchanged. Of any other curve the axis is looked for.

use super::strip::{convex_hull, diameter};
use super::symmetry_axis::{SymmetryAxis, axis_by_moments, refine_axis, rough_residual};
use super::{Measure, TracedCurve, Value};
use crate::geometry::{Point, Vector, complex_product, cross};
use crate::linkage::{FourBar, FourBarClass, PlacedFourBar, Sextic};

/// What is said of a curve's symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetry {
    /// The line about which it is symmetrical, or most nearly so; none of a circle, to which all lines are alike.
    pub axis: Option<SymmetryAxis>,
    /// The greatest distance of its mirror image from it, by its greatest extent.
    pub residual: f64,
    /// The theorem that says so.
    pub theorem: Option<&'static str>,
}

impl Symmetry {
    /// A curve whose mirror image is nearer to it than this part of its extent is called symmetrical: much less than is
    /// seen on paper, and more than its samples leave open.
    pub const TOLERANCE: f64 = 1e-4;

    /// The axis of a curve that is symmetrical.
    pub fn axis_if_symmetric(&self) -> Option<SymmetryAxis> {
        self.axis.filter(|_| self.residual <= Symmetry::TOLERANCE)
    }
}

/// By what theorem.
pub const SYMMETRY: Measure = Measure {
    name: "symmetry",
    unit: "",
    is_word: true,
    definition: "theorem 1 (crank = rocker, point on the coupler's bisector) or theorem 2 (coupler = rocker = pin to point, or coupler = crank) of Natesan's chapter 7; other: its mirror image is within 1e-4 of its extent all the same; empty of a curve without symmetry",
    compute: |subject: &TracedCurve| match subject.symmetry() {
        Some(Symmetry { theorem: Some(theorem), .. }) => Value::Word(theorem),
        Some(symmetry) if symmetry.residual <= Symmetry::TOLERANCE => Value::Word("other"),
        _ => Value::Missing,
    },
};

/// Where its axis points.
pub const AXIS: Measure = Measure {
    name: "symmetry_deg",
    unit: "deg",
    is_word: false,
    definition: "direction of the line about which the curve is symmetrical, or most nearly so, from the x-axis: 0 up to 180; empty of a circle",
    compute: |subject: &TracedCurve| {
        subject.symmetry().and_then(|s| s.axis).map_or(Value::Missing, |axis| Value::Number(axis.direction_deg()))
    },
};

/// How nearly.
pub const RESIDUAL: Measure = Measure {
    name: "symmetry_residual",
    unit: "",
    is_word: false,
    definition: "greatest distance of the curve's mirror image about that line from the curve, by its greatest extent",
    compute: |subject: &TracedCurve| subject.symmetry().map_or(Value::Missing, |s| Value::Number(s.residual)),
};

/// Of a curve that is no point.
pub(super) fn find_symmetry(subject: &TracedCurve) -> Option<Symmetry> {
    /// A theorem's curve that is no nearer to its image than this, by its extent, is the image of another circuit's.
    const APART: f64 = 0.1;
    let trail = subject.sampled_curve();
    let extent = diameter(&convex_hull(trail.points.clone()));
    if trail.points.len() < 3 || extent <= 0.0 {
        return None;
    }
    // Of a linkage with two circuits each may be the mirror image of the other: not so where it is roughly its own.
    if let Some((axis, theorem)) = axis_by_theorem(subject)
        && (has_one_circuit(subject) || rough_residual(trail, axis) <= APART * extent)
    {
        let residual = residual_by_sextic(subject, axis).unwrap_or_else(|| refine_axis(trail, axis, true).1) / extent;
        return Some(Symmetry { axis: Some(axis), residual, theorem: Some(theorem) });
    }
    let Some(axis) = axis_by_moments(trail) else { return Some(Symmetry { axis: None, residual: 0.0, theorem: None }) };
    let rough = rough_residual(trail, axis);
    // Nearer than that, the curve between its samples is looked at.
    if rough > 4.0 * trail.max_sagitta() {
        return Some(Symmetry { axis: Some(axis), residual: rough / extent, theorem: None });
    }
    let (axis, most) = refine_axis(trail, axis, false);
    Some(Symmetry { axis: Some(axis), residual: most / extent, theorem: None })
}

/// Whether a four-bar has one circuit only, as those without a link that turns fully have.
fn has_one_circuit(subject: &TracedCurve) -> bool {
    FourBar::from_linkage(subject.linkage).is_some_and(|bar| bar.class() == FourBarClass::TripleRocker)
}

/// The greatest distance of the mirrored samples from the curve of a coupler point, by its own equation.
fn residual_by_sextic(subject: &TracedCurve, axis: SymmetryAxis) -> Option<f64> {
    let PlacedFourBar { pivots: [origin, end], lengths, coupler_point: point } =
        PlacedFourBar::from_linkage(subject.linkage, subject.joint).ok()?;
    let sextic = Sextic::from_four_bar(lengths, point)?;
    let frame = (end - origin).try_normalize(0.0)?;
    let distance = |point: &Point| {
        let by = axis.mirror(*point) - origin;
        let own = Point::new(frame.dot(&by), cross(frame, by));
        // To the first order. At a double point both vanish, and what is left of the one is rounding.
        let [value, terms] = sextic.evaluate(own);
        let off = value.abs() / sextic.gradient(own).norm();
        if value.abs() > 1e-13 * terms && off.is_finite() { off } else { 0.0 }
    };
    Some(subject.sampled_curve().points.iter().map(distance).fold(0.0, f64::max))
}

/// The axis that a theorem gives the curves of a coupler point, and which theorem it is.
fn axis_by_theorem(subject: &TracedCurve) -> Option<(SymmetryAxis, &'static str)> {
    /// Lengths that agree to within the rounding of the expressions they come from are meant to be equal.
    const EQUAL: f64 = 1e-12;
    let linkage = subject.linkage;
    let [o, a, b, c] = FourBar::coupler_pins(linkage, subject.joint)?;
    let FourBar { frame, crank, coupler, rocker } = FourBar::from_linkage(linkage)?;
    let link = linkage.links.iter().find(|link| [a, b, subject.joint].iter().all(|&j| link.position(j).is_some()))?;
    let to_point = |pin| Some((link.position(subject.joint)? - link.position(pin)?).norm());
    let (from_crank, from_rocker) = (to_point(a)?, to_point(b)?);
    let is_equal = |x: f64, y: f64| (x - y).abs() <= EQUAL * (frame + crank + coupler + rocker);
    let circuit = subject.circuit;
    let place = |joint, k| circuit.positions.point(joint, k);
    let [origin, end] = [place(o, 0), place(c, 0)];
    let first = is_equal(crank, rocker) && is_equal(from_crank, from_rocker);
    // The pivot the axis goes through, the other one, and the pin on the link of the other.
    let second = [([end, origin], [b, a], rocker, from_rocker), ([origin, end], [a, b], crank, from_crank)]
        .into_iter()
        .find(|(_, _, arm, to_point)| is_equal(coupler, *arm) && is_equal(coupler, *to_point));
    if first {
        let along = end - origin;
        let axis = SymmetryAxis::new(origin + along / 2.0, Vector::new(-along.y, along.x))?;
        return Some((axis, if second.is_some() { "theorems 1 and 2" } else { "theorem 1" }));
    }
    let ([pivot, other], [_, pin], ..) = second?;
    // The angle from the pin to the point about the pivot is the same in every pose: taken where both are far from it.
    let seen = |k: usize| [place(pin, k) - pivot, place(subject.joint, k) - pivot];
    let reach = |k: usize| seen(k).map(|by| by.norm()).into_iter().fold(f64::INFINITY, f64::min);
    let best = (0..circuit.len()).max_by(|&j, &k| reach(j).total_cmp(&reach(k)))?;
    let [from, to] = seen(best);
    let (cos, sin) = (from.dot(&to), cross(from, to));
    let frame = other - pivot;
    let direction = complex_product(Vector::new(cos, sin), frame);
    Some((SymmetryAxis::new(Point::from(pivot.coords), direction)?, "theorem 2"))
}
