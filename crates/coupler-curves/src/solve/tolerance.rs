//! How far curves move where the lengths of their linkage are off.

use super::{MeasuredCurve, SolvedCell};
use crate::family::Family;
use crate::geometry::{Point, cross};
use crate::linkage::Linkage;
use crate::measure::TracedCurve;
use crate::motion::{self, Motion, Pass, Sampler, Sampling};
use crate::template::LinkLength;

/// How far a curve moves for a unit of error in the lengths of its linkage: across itself, for what moves along it is only at another input.
#[derive(Clone, Debug)]
pub struct CurveTolerance {
    /// The number of its traced joint, from 1.
    pub trace: usize,
    /// The number of its circuit, from 1.
    pub circuit: usize,
    /// The greatest move for a unit of each length, in the order of [`crate::template::Template::lengths`].
    pub moves: Vec<f64>,
    /// The greatest move for a unit of every length, each to its worse side.
    pub worst_case: f64,
    /// The greatest root of the sum of squares over the lengths.
    pub root_sum_square: f64,
    /// The change of its straight portion's length for a unit of each length: 0 where it is less than the accuracy of the ends tells; none where it has
    /// none.
    pub straight: Vec<Option<f64>>,
}

/// The relative step of differences: half the digits of a double to a little more than two thirds, as they are central.
const STEP: f64 = 1e-5;

/// The step for the ends of straight portions, which are known to some millionths of their length.
const STRAIGHT_STEP: f64 = 1e-4;

/// Lengths of straight portions that differ by less than this, relatively, are the same.
const SAME_STRAIGHT: f64 = 1e-5;

/// Moves for a unit of a length that are less than this are rounding, of positions divided by the step.
const ROUNDING: f64 = 1e-9;

/// The tolerances of the curves of a solved cell. Moves are by differences of linkages with an error of either sign in one length, at
/// the same inputs on the same passes. `None` where the lengths cannot be off by themselves, as of [`crate::template::Template::lengths`].
pub fn curve_tolerances(family: &Family, solved: &SolvedCell) -> Option<Vec<CurveTolerance>> {
    let lengths = family.template.lengths()?;
    let values = family.parameter_values(&solved.cell);
    let size = solved.motion.circuits.first().map_or(1.0, |circuit| {
        let points = solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, 0));
        points.map(|p| p.coords.norm()).filter(|norm| norm.is_finite()).fold(0.0, f64::max)
    });
    let neighbours = |length: &LinkLength, step: f64| -> Option<[Linkage; 2]> {
        let with = |error: f64| family.template.linkage_with_errors(values, &[(*length, error)]).ok();
        Some([with(-step)?, with(step)?])
    };
    let pairs: Vec<[Linkage; 2]> =
        lengths.iter().map(|length| neighbours(length, STEP * size)).collect::<Option<_>>()?;
    let solved_neighbours = |length: &LinkLength| {
        let sampler = Sampler::new(Sampling::Samples(120));
        let pair = neighbours(length, STRAIGHT_STEP * size)?;
        Some(pair.map(|linkage| (Motion::solve(&linkage, &sampler), linkage)))
    };
    let solved_pairs: Vec<_> = lengths.iter().map(solved_neighbours).collect();
    let tolerance = |curve: &MeasuredCurve| {
        let moves = moves_across(solved, curve, &pairs, STEP * size);
        let greatest = |of: &dyn Fn(&Vec<f64>) -> f64| moves.iter().map(of).fold(0.0, f64::max);
        let straight_length = |(motion, linkage): &(Motion, Linkage)| {
            let circuit = motion.circuits.get(curve.circuit - 1)?;
            let traced =
                TracedCurve::new(linkage, motion, circuit, curve.joint).with_straight_criterion(family.straight);
            traced.straight().map(|portion| portion.length)
        };
        let straight = solved_pairs.iter().map(|pair| {
            let [low, high] = pair.as_ref()?.each_ref().map(straight_length);
            let (low, high) = (low?, high?);
            let is_same = (high - low).abs() <= SAME_STRAIGHT * high;
            Some(if is_same { 0.0 } else { (high - low) / (2.0 * STRAIGHT_STEP * size) })
        });
        CurveTolerance {
            trace: curve.trace,
            circuit: curve.circuit,
            moves: (0..lengths.len()).map(|k| greatest(&|at| at[k].abs())).map(cleared).collect(),
            worst_case: greatest(&|at| at.iter().map(|own| own.abs()).sum()),
            root_sum_square: greatest(&|at| at.iter().map(|own| own * own).sum::<f64>().sqrt()),
            straight: straight.collect(),
        }
    };
    Some(solved.curves.iter().map(tolerance).collect())
}

/// A move without rounding.
fn cleared(own: f64) -> f64 {
    if own <= ROUNDING { 0.0 } else { own }
}

/// At places along a curve, its move to the left for a unit of each length.
fn moves_across(solved: &SolvedCell, curve: &MeasuredCurve, pairs: &[[Linkage; 2]], step: f64) -> Vec<Vec<f64>> {
    /// On each pass; they are denser at its ends, where a joint at a dead point is fast.
    const PLACES: usize = 180;
    let points = |linkage: &Linkage, pass: &Pass, inputs: &[f64]| -> Vec<Point> {
        let positions = motion::poses(linkage, pass, inputs);
        (0..inputs.len()).map(|k| positions.point(curve.joint, k)).collect()
    };
    let mut moves = Vec::new();
    for pass in &solved.circuit(curve).passes {
        let (from, to) = (pass.from.input.value, pass.to.input.value);
        let eased = |k: usize| {
            let part = (k as f64 + 0.5) / PLACES as f64;
            from + (to - from) * part * part * (3.0 - 2.0 * part)
        };
        let inputs: Vec<f64> = (0..PLACES).map(eased).collect();
        let shifted = |by: f64| inputs.iter().map(|input| input + by * (to - from)).collect::<Vec<f64>>();
        let [before, after] = [-STEP, STEP].map(|by| points(&solved.linkage, pass, &shifted(by)));
        let of_neighbour = |linkage: &Linkage| Some(points(linkage, &pass.of_neighbour(linkage)?, &inputs));
        let moved: Option<Vec<[Vec<Point>; 2]>> =
            pairs.iter().map(|[low, high]| Some([of_neighbour(low)?, of_neighbour(high)?])).collect();
        let Some(moved) = moved else { continue };
        for k in 0..PLACES {
            let Some(along) = (after[k] - before[k]).try_normalize(0.0) else { continue };
            let at: Vec<f64> = moved.iter().map(|[low, high]| cross(along, high[k] - low[k]) / (2.0 * step)).collect();
            if at.iter().all(|own| own.is_finite()) {
                moves.push(at);
            }
        }
    }
    moves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::solve::Solver;

    /// Every corner of the tolerances of an Evans linkage: no curve is further off than the worst case, and one is as far.
    #[test]
    fn no_corner_of_the_tolerances_is_beyond_the_worst_case() {
        const ERROR: f64 = 1e-4;
        for (id, given) in [("evans", [("p", 2.5), ("a", 2.6)]), ("slider-crank", [("offset", 0.25), ("crank", 1.0)])] {
            let given = given.map(|(name, value)| (name.to_owned(), value));
            let family = Family::single_cell(catalogue::find(id).unwrap(), &given, Sampling::Samples(90)).unwrap();
            let solved = Solver::new(&family).solve(0).unwrap();
            let tolerance = &curve_tolerances(&family, &solved).unwrap()[0];
            let lengths = family.template.lengths().unwrap();
            let mut furthest: f64 = 0.0;
            for corner in 0..1_u32 << lengths.len() {
                let sides = (0..lengths.len()).map(|k| if corner >> k & 1 == 1 { ERROR } else { -ERROR });
                let errors: Vec<_> = lengths.iter().copied().zip(sides).collect();
                let values = family.parameter_values(&solved.cell);
                let off = family.template.linkage_with_errors(values, &errors).unwrap();
                // The move of the linkage itself, and not half of that between two.
                let pair = [solved.linkage.clone(), off];
                let moves = moves_across(&solved, &solved.curves[0], &[pair], 0.5);
                furthest = moves.iter().flatten().fold(furthest, |most, own| most.max(own.abs()));
            }
            let bound = tolerance.worst_case * ERROR;
            assert!((furthest / bound - 1.0).abs() < 2e-3, "{id}: {furthest} of {bound}");
            assert!(tolerance.root_sum_square < tolerance.worst_case);
            assert!(tolerance.moves.iter().all(|own| *own <= tolerance.root_sum_square));
        }
    }

    /// A crank pin is on a circle about its pivot, whose radius alone moves it across.
    #[test]
    fn a_circle_moves_with_its_radius() {
        let mut template = (*catalogue::find("evans").unwrap()).clone();
        template.traced = vec![template.joints.iter().position(|joint| joint.name == "A").unwrap()];
        let given = [("p", 2.5), ("a", 2.6)].map(|(name, value)| (name.to_owned(), value));
        let family = Family::single_cell(template.into(), &given, Sampling::Samples(90)).unwrap();
        let solved = Solver::new(&family).solve(0).unwrap();
        let tolerance = &curve_tolerances(&family, &solved).unwrap()[0];
        for (length, own) in family.template.lengths().unwrap().iter().zip(&tolerance.moves) {
            let expected = if family.template.length_name(length) == "OA" { 1.0 } else { 0.0 };
            assert!((own - expected).abs() < 1e-8, "{}: {own}", family.template.length_name(length));
        }
    }
}
