//! Compares the curves on a recorded page with their recorded points and with the linkage.

use std::borrow::Cow;
use std::cell::LazyCell;
use std::collections::HashMap;

use super::Error;
use super::curve_samples::{CurveSamples, point_distance};
use super::finding::{Change, Finding, Location};
use crate::record::{DrawnCurve, SolvedCurve, read_drawn_curves};
use coupler_curves::family::Family;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::JointId;
use coupler_curves::measure::MeasureSet;
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{SolvedCell, Solver};

/// The greatest distance of a drawn curve from its recorded points and from the curve, in millimetres on paper.
const DRAWING_TOLERANCE_MM: f64 = 0.01;

/// A cell of a recorded page.
struct PageCell<'a> {
    /// Its number on the page, which is the recorded one.
    number: usize,
    /// Its recorded curves.
    recorded: Vec<CurveSamples>,
    /// The present cell of this number, if there is one.
    solved: Option<Cow<'a, SolvedCell>>,
}

/// Reads the curves of a recorded page, and compares them with the recorded points, which `recorded` returns by the
/// number of a cell, and with the curves of the family as it is now, some cells of which are solved.
///
/// A curve that is drawn in the same way on the current page needs no comparison: it is the present one. If its recorded
/// points are others, that is a finding on the points.
///
/// # Errors
/// The recorded points cannot be read.
pub(super) fn check_drawn_curves(
    page: &Location,
    [bytes, current_page]: [&[u8]; 2],
    (family, cells): (&Family, &[SolvedCell]),
    recorded: impl Fn(usize) -> Result<Option<Vec<CurveSamples>>, Error>,
) -> Result<Vec<Finding>, Error> {
    let curves = match read_drawn_curves(bytes) {
        Ok(curves) => curves,
        Err(error) => return Ok(vec![page.finding(Change::Damaged { message: error.to_string() })]),
    };
    let drawn_now = read_drawn_curves(current_page).unwrap_or_default();
    let drawn_now: HashMap<&str, &DrawnCurve> = drawn_now.iter().map(|curve| (curve.id.as_str(), curve)).collect();
    let mut findings = Vec::new();
    let mut current: Option<PageCell> = None;
    for curve in curves.into_iter().filter(|curve| drawn_now.get(curve.id.as_str()) != Some(&curve)) {
        let now = drawn_now.get(curve.id.as_str()).copied();
        // The curves of a cell are consecutive, so that its rows are read once.
        let cell = match current.take() {
            Some(cell) if cell.number == curve.cell => cell,
            _ => PageCell {
                number: curve.cell,
                recorded: recorded(curve.cell)?.unwrap_or_default(),
                solved: find_or_solve(family, cells, curve.cell),
            },
        };
        if let Some(distance_mm) = cell.drawing_error(&curve, now) {
            let location = page.with_cell(curve.cell).with_curve(curve.trace, curve.circuit);
            findings.push(location.finding(Change::DrawnOff { distance_mm }));
        }
        current = Some(cell);
    }
    Ok(findings)
}

/// A cell by its number: it may be on another page now, if the order of the cells has changed.
fn find_or_solve<'a>(family: &Family, cells: &'a [SolvedCell], number: usize) -> Option<Cow<'a, SolvedCell>> {
    if let Some(solved) = cells.iter().find(|solved| solved.cell.number == number) {
        return Some(Cow::Borrowed(solved));
    }
    let k = number.checked_sub(1).filter(|k| *k < family.cell_count())?;
    Solver::new(family).measuring(MeasureSet::EMPTY).solve(k).map(Cow::Owned)
}

impl PageCell<'_> {
    /// How far a drawn curve is from its recorded samples or from the curve, or the ends of its dashes from where they
    /// are drawn `now`, in millimetres; `None` if that is within the tolerance, or if the curve is not recorded.
    fn drawing_error(&self, drawn: &DrawnCurve, now: Option<&DrawnCurve>) -> Option<f64> {
        let is_same = |samples: &&CurveSamples| (samples.trace, samples.circuit) == (drawn.trace, drawn.circuit);
        let recorded = self.recorded.iter().find(is_same)?;
        let solved = self.solved.as_deref().and_then(|solved| {
            let circuit = solved.motion.circuits.get(drawn.circuit.checked_sub(1)?)?;
            let joint = *solved.linkage.traced.get(drawn.trace.checked_sub(1)?)?;
            Some((&solved.linkage, circuit, joint))
        });
        let closed = solved.is_none_or(|(_, circuit, _)| circuit.is_closed);
        let samples = recorded.inputs.iter().copied().zip(recorded.points.iter().copied());
        let after_last = solved.and_then(|(_, circuit, _)| circuit.input_after_last());
        let sample_distance = drawn.furthest_sample(samples, after_last).map_or(0.0, |(_, distance)| distance);
        let Some((linkage, circuit, joint)) = solved else {
            return (sample_distance > DRAWING_TOLERANCE_MM).then_some(sample_distance);
        };
        let curve = LazyCell::new(|| SolvedCurve::new(linkage, circuit, joint, drawn.page_from_plane));
        let is_off =
            |distance: &f64| *distance > DRAWING_TOLERANCE_MM && *distance > DRAWING_TOLERANCE_MM + curve.rounding_mm();
        // The page shows the recorded curve. If it is another one, the cell has changed, and only its samples are known.
        let moved = greatest_difference(&recorded.points, circuit, joint) * drawn.page_from_plane.scale();
        let stray = drawn
            .max_stray(&recorded.points, closed, |point, enough| curve.distance(point, enough))
            .map(|distance| distance - moved);
        let same_dashes = now.filter(|now| now.dash == drawn.dash);
        let dash_ends = same_dashes.map(|now| drawn.furthest_dash_end(now) - moved);
        [Some(sample_distance), stray, dash_ends].into_iter().flatten().filter(is_off).reduce(f64::max)
    }
}

/// The greatest distance of a recorded sample from the present one; infinite if there are more samples or fewer.
fn greatest_difference(recorded: &[Point], circuit: &Circuit, joint: JointId) -> f64 {
    if recorded.len() != circuit.len() {
        return f64::INFINITY;
    }
    recorded.iter().zip(circuit.points(joint)).map(|(a, b)| point_distance(*a, b)).fold(0.0, f64::max)
}
