//! How far curves move where the lengths of their linkage are off.

use std::rc::Rc;

use super::{MeasuredCurve, SolvedCell};
use crate::family::Family;
use crate::linkage::Linkage;
use crate::measure::{CurveMoves, TracedCurve};
use crate::motion::{Motion, NeighbourLinkages, Sampler, Sampling};

/// How far a curve moves for a unit of error in the lengths of its linkage.
#[derive(Clone, Debug)]
pub struct CurveTolerance {
    /// The number of its traced joint, from 1.
    pub trace: usize,
    /// The number of its circuit, from 1.
    pub circuit: usize,
    /// Its moves, for the lengths in the order of [`crate::template::Template::lengths`].
    pub moves: CurveMoves,
    /// The change of its straight portion's length for a unit of each length: 0 where it is less than the accuracy of the ends tells; none where it has
    /// none.
    pub straight: Vec<Option<f64>>,
}

/// The error with which straight portions are found again, as a part of the greatest length: their ends are known to some millionths of their length.
const STRAIGHT_STEP: f64 = 1e-4;

/// Lengths of straight portions that differ by less than this, relatively, are the same.
const SAME_STRAIGHT: f64 = 1e-5;

/// The tolerances of the curves of a solved cell that have any: of none at a change point. `None` of a grid of points, as
/// [`crate::template::Template::lengths`].
pub fn curve_tolerances(family: &Family, solved: &SolvedCell) -> Option<Vec<CurveTolerance>> {
    let with_step = |step| family.template.neighbours(family.parameter_values(&solved.cell), step);
    let neighbours = Rc::new(with_step(NeighbourLinkages::STEP)?);
    let has_straight = solved.curves.iter().any(|curve| curve.straight.is_some());
    let further_off = with_step(STRAIGHT_STEP).filter(|_| has_straight);
    let off = further_off.as_ref().map(solved_pairs);
    let traced = |linkage: &Linkage, motion: &Motion, curve: &MeasuredCurve| {
        let circuit = motion.circuits.get(curve.circuit - 1)?;
        let traced = TracedCurve::new(linkage, motion, circuit, curve.joint);
        Some(traced.with_straight_criterion(family.straight).straight()?.length)
    };
    let change = |curve: &MeasuredCurve, k: usize| {
        let [low, high] = off.as_ref()?[k].each_ref().map(|(linkage, motion)| traced(linkage, motion, curve));
        let (low, high) = (low?, high?);
        let is_same = (high - low).abs() <= SAME_STRAIGHT * high;
        Some(if is_same { 0.0 } else { (high - low) / (2.0 * further_off.as_ref()?.step) })
    };
    let tolerance = |curve: &MeasuredCurve| {
        let circuit = solved.circuit(curve);
        let traced = TracedCurve::new(&solved.linkage, &solved.motion, circuit, curve.joint);
        let traced = traced.with_neighbours(Some(Rc::clone(&neighbours)));
        Some(CurveTolerance {
            trace: curve.trace,
            circuit: curve.circuit,
            moves: curve.moves.clone().or_else(|| traced.moves().cloned())?,
            straight: (0..neighbours.pairs.len()).map(|k| change(curve, k)).collect(),
        })
    };
    Some(solved.curves.iter().filter_map(tolerance).collect())
}

/// The linkages that are off, with their motion.
fn solved_pairs(neighbours: &NeighbourLinkages) -> Vec<[(&Linkage, Motion); 2]> {
    neighbours.pairs.iter().map(|pair| pair.each_ref().map(|linkage| (linkage, solved_motion(linkage)))).collect()
}

fn solved_motion(linkage: &Linkage) -> Motion {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(120)))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::catalogue;
    use crate::geometry::{Orientation, Point, cross};
    use crate::linkage_format::parse_templates;
    use crate::motion::{self, InputPosition, LengthRates, Pass};
    use crate::solve::Solver;
    use crate::template::{LinkLength, Template};

    /// The family of one linkage of the catalogue, and the linkage solved.
    fn solved_linkage(id: &str, given: &[(&str, f64)]) -> (Family, SolvedCell) {
        solved_template(catalogue::find(id).unwrap(), given)
    }

    fn solved_template(template: Arc<Template>, given: &[(&str, f64)]) -> (Family, SolvedCell) {
        let given: Vec<(String, f64)> = given.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        let family = Family::single_cell(template, &given, Sampling::Samples(90)).unwrap();
        let solved = Solver::new(&family).solve(0).unwrap();
        (family, solved)
    }

    /// Along a curve, how far that of a linkage that is off is from it at the same input, to its left.
    fn distances_across(solved: &SolvedCell, curve: &MeasuredCurve, off: &Linkage) -> Vec<f64> {
        let mut distances = Vec::new();
        for pass in &solved.circuit(curve).passes {
            let length = pass.to.input.value - pass.from.input.value;
            let points = |linkage: &Linkage, pass: &Pass, shift: f64| -> Vec<Point> {
                let input = |k: u32| motion::eased_input(pass, (f64::from(k) + 0.5) / 720.0) + shift * length;
                let positions = motion::poses(linkage, pass, &(0..720).map(input).collect::<Vec<f64>>());
                (0..720).map(|k| positions.point(curve.joint, k)).collect()
            };
            let [before, after] = [-1e-7, 1e-7].map(|shift| points(&solved.linkage, pass, shift));
            let (own, moved) = (points(&solved.linkage, pass, 0.0), points(off, &pass.of_neighbour(off).unwrap(), 0.0));
            let across = |k: usize| cross((after[k] - before[k]).normalize(), moved[k] - own[k]);
            distances.extend((0..720).map(across));
        }
        distances.retain(|own| own.is_finite());
        distances
    }

    /// Every corner of the tolerances: no curve is further off than the worst case, and one is as far.
    #[test]
    fn no_corner_of_the_tolerances_is_beyond_the_worst_case() {
        const ERROR: f64 = 1e-5;
        for (id, given) in [("evans", [("p", 2.5), ("a", 2.6)]), ("slider-crank", [("offset", 0.25), ("crank", 1.0)])] {
            let (family, solved) = solved_linkage(id, &given);
            let moves = &curve_tolerances(&family, &solved).unwrap()[0].moves;
            let lengths = family.template.lengths().unwrap();
            let mut furthest: f64 = 0.0;
            for corner in 0..1_u32 << lengths.len() {
                let sides = (0..lengths.len()).map(|k| if corner >> k & 1 == 1 { ERROR } else { -ERROR });
                let errors: Vec<_> = lengths.iter().copied().zip(sides).collect();
                let values = family.parameter_values(&solved.cell);
                let off = family.template.linkage_with_errors(values, &errors).unwrap();
                let distances = distances_across(&solved, &solved.curves[0], &off);
                furthest = distances.iter().fold(furthest, |most, own| most.max(own.abs()));
            }
            let bound = moves.worst_case * ERROR;
            assert!((furthest / bound - 1.0).abs() < 1e-3, "{id}: {furthest} of {bound}");
            assert!(moves.root_sum_square < moves.worst_case);
            assert!(moves.lengths.iter().all(|own| *own <= moves.root_sum_square * (1.0 + 1e-9)));
        }
    }

    /// A group has too many lengths for all corners: the worst is that to which each length moves the curve to the same side, where they move it by most.
    #[test]
    #[ignore = "thorough"]
    fn the_worst_corner_of_a_group_is_as_far_as_the_worst_case() {
        const ERROR: f64 = 1e-6;
        let mut checked = 0;
        let catalogued = ["stephenson-ii-six-bar", "eight-bar-class-iii"].map(|id| catalogue::find(id).unwrap());
        for template in catalogued.into_iter().chain(drawn_groups()) {
            let (family, solved) = solved_template(template, &[]);
            let (curve, own) = (&solved.curves[0], &curve_tolerances(&family, &solved).unwrap()[0]);
            if !solved.circuit(curve).is_full_turn() {
                continue;
            }
            checked += 1;
            let distances = |errors: &[(LinkLength, f64)]| {
                let values = family.parameter_values(&solved.cell);
                distances_across(&solved, curve, &family.template.linkage_with_errors(values, errors).unwrap())
            };
            let lengths = family.template.lengths().unwrap();
            let single: Vec<Vec<f64>> = lengths.iter().map(|length| distances(&[(*length, ERROR)])).collect();
            let moved = |k: usize| single.iter().map(|own| own[k].abs()).sum::<f64>();
            let worst = (0..single[0].len()).max_by(|a, b| moved(*a).total_cmp(&moved(*b))).unwrap();
            let corner = lengths.iter().zip(&single).map(|(length, own)| (*length, ERROR.copysign(own[worst])));
            let corner = distances(&corner.collect::<Vec<_>>());
            let furthest = corner.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            let bound = own.moves.worst_case * ERROR;
            assert!((furthest / bound - 1.0).abs() < 1e-3, "{}: {furthest} of {bound}", family.id);
            for (own, single) in own.moves.lengths.iter().zip(&single) {
                let furthest = single.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
                assert!((furthest - own * ERROR).abs() < 1e-3 * bound, "{}: {furthest} of {own}", family.id);
            }
        }
        assert!(checked >= 2, "{checked}");
    }

    /// The moves for a unit of length are those of the linkage in another size, mirrored, and through limits of the input from another start.
    #[test]
    fn moves_do_not_depend_on_size_and_orientation() {
        let moves = |size: f64, orientation: Orientation| {
            let mut template = (*catalogue::find("four-bar").unwrap()).clone();
            template.orientation = orientation;
            let given =
                [("frame", 4.0), ("crank", 3.0), ("coupler", 3.5), ("rocker", 3.2), ("along", 2.0), ("across", 1.0)];
            let given = given.map(|(name, value)| (name.to_owned(), size * value));
            let family = Family::single_cell(template.into(), &given, Sampling::Samples(90)).unwrap();
            let solved = Solver::new(&family).solve(0).unwrap();
            assert!(!solved.circuit(&solved.curves[0]).is_full_turn());
            curve_tolerances(&family, &solved).unwrap()[0].moves.clone()
        };
        let own = moves(1.0, Orientation::default());
        for (size, orientation) in [(1000.0, Orientation::default()), (1.0, Orientation::new(true, 30.0))] {
            let other = moves(size, orientation);
            let values = |moves: &CurveMoves| [&moves.lengths[..], &[moves.worst_case, moves.root_sum_square]].concat();
            for (own, other) in values(&own).into_iter().zip(values(&other)) {
                assert!((own - other).abs() < 1e-6 * own, "{size}: {own}, {other}");
            }
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
        let moves = &curve_tolerances(&family, &solved).unwrap()[0].moves;
        for (length, own) in family.template.lengths().unwrap().iter().zip(&moves.lengths) {
            let expected = if family.template.length_name(length) == "OA" { 1.0 } else { 0.0 };
            assert!((own - expected).abs() < 1e-9, "{}: {own}", family.template.length_name(length));
        }
        let [worst, square] = [moves.worst_case, moves.root_sum_square];
        assert!((worst - 1.0).abs() < 1e-9 && (square - 1.0).abs() < 1e-9, "{worst} {square}");
    }

    /// Links that no dyads place, driven at the coupler, by actuators between links and with a joint that slides: with all that closes loops of a group.
    fn drawn_groups() -> Vec<Arc<Template>> {
        let six_bar = "joints = { O = [0, 0], C = [4, 0], Q = [7, 1], A = [0.6, 0.8], B = [3.4, 2.6], D = [2.5, 3.4], E = [5, 4], M = [1.2, -0.3], N = [4, 5] }
            frame = ['O', 'C', 'Q']
            links = [['O', 'A', 'M'], ['A', 'B', 'D'], ['B', 'C'], ['D', 'E', 'N'], ['E', 'Q']]";
        let slide = "joints = { O = [0, 0], P = [3, -1], Q = [5, 0], R = [6, 1], A = [0.3, 0.4], D = [1.6, 1.8], E = [2.7, 1.1], F = [3.8, 1.5] }
            frame = ['O', 'P', 'Q', 'R']
            links = [['O', 'A'], ['A', 'D'], ['P', 'E'], ['D', 'E', 'F']]
            slides = { F = ['Q', 'R'] }";
        let drawings = [
            (six_bar, "{ between = ['A B', 'Q E'] }"),
            (six_bar, "{ distance = ['O', 'D'] }"),
            (six_bar, "{ distance = ['N', 'M'] }"),
            (slide, "'O A'"),
        ];
        let template = |(k, (drawing, input)): (usize, &(&str, &str))| {
            let text = format!(
                "[[linkage]]\nid = 'group-{k}'\ntrace = ['D']\n[linkage.drawing]\n{drawing}\ninput = {input}\n"
            );
            Arc::new(parse_templates(&text).unwrap().remove(0))
        };
        drawings.iter().enumerate().map(template).collect()
    }

    /// Checks that the derivatives of all positions at the same input are those that differences of linkages show; how many there are.
    fn check_derivatives(template: &Arc<Template>) -> usize {
        let Some(lengths) = template.lengths() else { return 0 };
        let mut checked = 0;
        // Of a line without offset, points are placed from a foot as near its pivot as the step.
        let step = if template.closures.is_empty() { 1e-4 } else { 1e-5 };
        let missing = template.parameters.iter().filter(|parameter| parameter.default_text.is_empty());
        let given: Vec<(&str, f64)> = missing.map(|own| (own.name.as_str(), own.starting_value())).collect();
        let (family, solved) = solved_template(Arc::clone(template), &given);
        let values = family.parameter_values(&solved.cell);
        let neighbours = template.neighbours(values, NeighbourLinkages::STEP).unwrap();
        let passes = |motion: &Motion| -> Vec<Pass> {
            motion.circuits.iter().flat_map(|circuit| circuit.passes.clone()).collect()
        };
        for (number, pass) in passes(&solved.motion).iter().enumerate() {
            let input = pass.from.input.value + 0.37 * (pass.to.input.value - pass.from.input.value);
            let positions = motion::pose(&solved.linkage, pass, input);
            let position = InputPosition::new(solved.linkage.input(), input);
            let rates = LengthRates::new(&solved.linkage, &neighbours, &positions, position, pass.mode).unwrap();
            for (k, length) in lengths.iter().enumerate() {
                let at = |error: f64| {
                    let off = template.linkage_with_errors(values, &[(*length, error)]).unwrap();
                    let own =
                        pass.of_neighbour(&off).unwrap_or_else(|| passes(&solved_motion(&off)).swap_remove(number));
                    motion::pose(&off, &own, input)
                };
                let [low, high] = [at(-step), at(step)];
                for joint in solved.linkage.joint_ids() {
                    let expected = (high[joint.index()] - low[joint.index()]) / (2.0 * step);
                    let found = rates.at_input(joint).nth(k).unwrap();
                    let difference = (found - expected).norm() / (1.0 + expected.norm());
                    let name = (&template.id, &solved.linkage.joints[joint].name, template.length_name(length));
                    assert!(difference < 1e-6, "{name:?}: {found:?}, {expected:?}");
                    checked += 1;
                }
            }
        }
        checked
    }

    #[test]
    fn derivatives_by_lengths_are_those_of_differences() {
        let checked: usize = catalogue::all().iter().map(check_derivatives).sum();
        assert!(checked > 1000, "{checked}");
    }

    #[test]
    #[ignore = "thorough"]
    fn derivatives_by_lengths_of_groups_are_those_of_differences() {
        let checked: usize = drawn_groups().iter().map(check_derivatives).sum();
        assert!(checked > 1000, "{checked}");
    }
}
