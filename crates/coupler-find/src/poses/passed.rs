//! How near a link of any solved linkage comes to the poses of a body that is fixed to it.

use super::answer::PoseDeviation;
use super::body::BodyPose;
use crate::complex::{Complex, dot, length, mean, times_i, unit};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{Input, JointId, Linkage};
use coupler_curves::motion::{Circuit, JointPositions, Pass, poses as positions_at};
use coupler_curves::numerical::maximum_with_ends;
use coupler_curves::solve::SolvedCell;

/// A pose of a body where the linkage is nearest to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PassedPose {
    /// The number of the circuit, from 1.
    pub circuit: usize,
    /// The input, in degrees or as a length.
    pub input: f64,
    /// How far the body is from the pose there.
    pub deviation: PoseDeviation,
    /// The positions of all joints there.
    pub joints: Vec<Point>,
}

/// Where a solved linkage is nearest to poses of a body whose point is its first traced joint, on the circuits of that joint's curves; none if it
/// has no curve.
///
/// The body is fixed to the link of the traced joint, turned so that the sum of the squares of the errors is least, with angles in radians times
/// the root mean square distance of the places from their middle. A pin of two links has no angle: its angles are those of the poses.
pub fn passed_poses(poses: &[BodyPose], solved: &SolvedCell) -> Vec<PassedPose> {
    let Some(guided) = Guided::new(poses, solved) else { return Vec::new() };
    let stations = guided.stations();
    if stations.is_empty() {
        return Vec::new();
    }
    let aims: Vec<Aim> = poses.iter().map(Aim::new).collect();
    let turn = guided.best_turn(&aims, &stations);
    let passed = aims.iter().map(|aim| guided.passed(aim, turn, &guided.nearest(aim, turn, &stations)));
    passed.collect()
}

/// A pose to come near to.
struct Aim {
    point: Complex,
    direction: Complex,
}

impl Aim {
    fn new(pose: &BodyPose) -> Aim {
        let direction = unit(trig::radians(pose.angle_deg.rem_euclid(360.0)));
        Aim { point: Complex::new(pose.point.x, pose.point.y), direction }
    }
}

/// The traced joint at an input, and the direction of its link.
#[derive(Clone, Copy)]
struct State {
    point: Complex,
    direction: Complex,
}

/// A sample of a circuit.
struct Station<'a> {
    number: usize,
    circuit: &'a Circuit,
    sample: usize,
    state: State,
}

/// A place on a circuit.
#[derive(Clone, Copy)]
struct Place<'a> {
    number: usize,
    pass: &'a Pass,
    input: f64,
    square: f64,
}

struct Guided<'a> {
    solved: &'a SolvedCell,
    joint: JointId,
    /// Two joints of its link, if it is on one.
    base: Option<[JointId; 2]>,
    /// What an angle in radians is multiplied by.
    angle_length: f64,
    /// The inputs after which the linkage is as before.
    period: Option<f64>,
}

/// Another joint of the link of a joint, the farthest; `None` if it is on several links or alone.
fn other_joint(linkage: &Linkage, joint: JointId) -> Option<JointId> {
    let mut links = linkage.links.iter().filter_map(|link| Some((link, link.position(joint)?)));
    let (link, own) = links.next()?;
    if links.next().is_some() {
        return None;
    }
    let distances = link.joints.iter().map(|(other, place)| (*other, (place - own).norm_squared()));
    let (other, _) = distances.filter(|(_, distance)| *distance > 0.0).max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(other)
}

impl<'a> Guided<'a> {
    fn new(poses: &[BodyPose], solved: &'a SolvedCell) -> Option<Guided<'a>> {
        let first = solved.curves.first()?;
        let base = other_joint(&solved.linkage, first.joint).map(|other| [other, first.joint]);
        let points: Vec<Complex> = poses.iter().map(|pose| Complex::new(pose.point.x, pose.point.y)).collect();
        let spread = |points: &[Complex]| {
            let middle = mean(points);
            (points.iter().map(|p| (p - middle).norm_sqr()).sum::<f64>() / points.len().max(1) as f64).sqrt()
        };
        // Of a body that stays in its place, the size of the curve.
        let curve = || solved.circuit(first).points(first.joint).map(|p| Complex::new(p.x, p.y)).collect::<Vec<_>>();
        let angle_length = Some(spread(&points)).filter(|size| *size > 0.0).unwrap_or_else(|| spread(&curve()));
        let period = (solved.linkage.input() != Input::Length).then_some(360.0);
        Some(Guided { solved, joint: first.joint, base, angle_length, period })
    }

    fn state(&self, positions: &JointPositions, sample: usize) -> State {
        let at = |joint: JointId| {
            let p = positions.point(joint, sample);
            Complex::new(p.x, p.y)
        };
        let along = self.base.map_or(Complex::new(1.0, 0.0), |[from, to]| at(to) - at(from));
        State { point: at(self.joint), direction: along / length(along) }
    }

    fn state_at(&self, pass: &Pass, input: f64) -> State {
        self.state(&positions_at(&self.solved.linkage, pass, &[input]), 0)
    }

    /// The samples of the circuits on which the joint has a curve.
    fn stations(&self) -> Vec<Station<'a>> {
        let own = self.solved.curves.iter().filter(|curve| curve.joint == self.joint);
        let of_curve = own.flat_map(|curve| {
            let circuit = self.solved.circuit(curve);
            (0..circuit.len()).map(move |sample| (curve.circuit, circuit, sample))
        });
        let station = |(number, circuit, sample): (usize, &'a Circuit, usize)| {
            let state = self.state(&circuit.positions, sample);
            let numbers = [state.point.re, state.point.im, state.direction.re, state.direction.im];
            numbers.iter().all(|x| x.is_finite()).then_some(Station { number, circuit, sample, state })
        };
        of_curve.filter_map(station).collect()
    }

    /// The square of the error, with twice the sine of half the angle in place of it, which has no jump and is nearly the same.
    fn square(&self, state: &State, aim: &Aim, turn: Complex) -> f64 {
        let place = (state.point - aim.point).norm_sqr();
        if self.base.is_none() {
            return place;
        }
        place + self.angle_length * self.angle_length * (state.direction * turn - aim.direction).norm_sqr()
    }

    /// The direction of the body from that of the link for which the sum of the squares is least: of one in each degree the best, from which
    /// Gauss and Newton's method goes on while it betters it.
    fn best_turn(&self, aims: &[Aim], stations: &[Station<'a>]) -> Complex {
        /// The most that are compared: the method goes on with all.
        const MOST_AIMS: usize = 24;
        const MOST_STATIONS: usize = 720;
        const STEPS: usize = 30;
        const CONVERGED: f64 = 1e-13;
        if self.base.is_none() {
            return Complex::new(1.0, 0.0);
        }
        let some_aims: Vec<&Aim> = aims.iter().step_by(aims.len().div_ceil(MOST_AIMS)).collect();
        let some: Vec<&Station> = stations.iter().step_by(stations.len().div_ceil(MOST_STATIONS)).collect();
        let sum = |turn: Complex| {
            let least = |aim: &&Aim| {
                some.iter().map(|station| self.square(&station.state, aim, turn)).fold(f64::INFINITY, f64::min)
            };
            some_aims.iter().map(least).sum::<f64>()
        };
        let turns = (0..360).map(|k| unit(trig::radians(f64::from(k))));
        let mut best = turns
            .map(|turn| (sum(turn), turn))
            .fold((f64::INFINITY, Complex::new(1.0, 0.0)), |a, b| if b.0 < a.0 { b } else { a });
        best.0 = f64::INFINITY;
        let mut turn = best.1;
        for _ in 0..STEPS {
            let (square, step) = self.turning(aims, turn, stations);
            if square >= best.0 {
                break;
            }
            best = (square, turn);
            turn *= unit(step);
            if step.abs() <= CONVERGED {
                break;
            }
        }
        best.1
    }

    /// The sum of the squares for a direction of the body, and the angle in radians by which to turn it: the mean of its errors, in which a pose
    /// counts as much as the place of the nearest point holds it while the body turns.
    fn turning(&self, aims: &[Aim], turn: Complex, stations: &[Station<'a>]) -> (f64, f64) {
        let (mut square, mut error, mut weight) = (0.0, 0.0, 0.0);
        for aim in aims {
            let place = self.nearest(aim, turn, stations);
            let state = self.state_at(place.pass, place.input);
            square += place.square;
            let away = state.direction * turn * aim.direction.conj();
            error -= trig::atan2(away.im, away.re);
            let [by_place, by_angle] = self.speeds(&place);
            let by_angle = self.angle_length * by_angle;
            let all = by_place * by_place + by_angle * by_angle;
            weight += if all > 0.0 { by_place * by_place / all } else { 1.0 };
        }
        (square, if weight > 0.0 { error / weight } else { 0.0 })
    }

    /// The speed of the joint over the input, and that of its link in radians.
    fn speeds(&self, place: &Place) -> [f64; 2] {
        /// Of the range of the pass: weights need some digits only.
        const PART: f64 = 1e-5;
        let [low, high] = place.pass.input_range();
        let step = PART * (high - low);
        let [from, to] = [(place.input - step).max(low), (place.input + step).min(high)];
        let [a, b] = [from, to].map(|input| self.state_at(place.pass, input));
        let turned = dot(b.direction, times_i(a.direction));
        [length(b.point - a.point) / (to - from), turned.abs() / (to - from)]
    }

    /// Where the linkage is nearest to a pose: at the nearest sample, or between it and its neighbours.
    fn nearest(&self, aim: &Aim, turn: Complex, stations: &[Station<'a>]) -> Place<'a> {
        /// Of the input: the square of an error that is not zero has half as many digits.
        const ACCURACY: f64 = 1e-10;
        let squares = stations.iter().map(|station| self.square(&station.state, aim, turn));
        let (k, _) =
            squares.enumerate().fold((0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best });
        let Station { number, circuit, sample, .. } = stations[k];
        let inputs = &circuit.inputs;
        let neighbours = [sample.saturating_sub(1), (sample + 1).min(circuit.len() - 1)];
        let reach = neighbours.iter().map(|other| (inputs[*other] - inputs[sample]).abs()).fold(0.0, f64::max);
        let mut passes = [neighbours[0], sample, neighbours[1]].map(|other| circuit.pass_at(other)).to_vec();
        // A closed circuit goes on at its other end.
        if circuit.is_closed && (sample == 0 || sample + 1 == circuit.len()) {
            passes.extend([0, circuit.passes.len() - 1]);
        }
        passes.sort_unstable();
        passes.dedup();
        let mut best: Option<Place> = None;
        for pass in passes.into_iter().map(|pass| &circuit.passes[pass]) {
            let [low, high] = pass.input_range();
            for shift in self.period.map_or(vec![0.0], |period| vec![0.0, -period, period]) {
                let input = inputs[sample] + shift;
                let [from, to] = [(input - reach).max(low), (input + reach).min(high)];
                if from > to {
                    continue;
                }
                let found = maximum_with_ends([from, to], ACCURACY, |input| {
                    -self.square(&self.state_at(pass, input), aim, turn)
                });
                if best.as_ref().is_none_or(|best| -found.value < best.square) {
                    best = Some(Place { number, pass, input: found.place, square: -found.value });
                }
            }
        }
        let at_sample = || Place {
            number,
            pass: &circuit.passes[circuit.pass_at(sample)],
            input: inputs[sample],
            square: self.square(&stations[k].state, aim, turn),
        };
        best.unwrap_or_else(at_sample)
    }

    fn passed(&self, aim: &Aim, turn: Complex, place: &Place) -> PassedPose {
        let linkage = &self.solved.linkage;
        let positions = positions_at(linkage, place.pass, &[place.input]);
        let state = self.state(&positions, 0);
        let away = state.direction * turn * aim.direction.conj();
        let angle_deg = if self.base.is_some() { trig::degrees(trig::atan2(away.im, away.re)) } else { 0.0 };
        PassedPose {
            circuit: place.number,
            input: place.input,
            deviation: PoseDeviation { distance: length(state.point - aim.point), angle_deg },
            joints: linkage.joint_ids().map(|joint| positions.point(joint, 0)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::body::random::random_poses;
    use super::super::findings::PoseOptions;
    use super::super::search::exact_guides;
    use super::*;
    use crate::scatter::Scatter;
    use crate::workers::OneAtATime;
    use coupler_curves::family::{Family, Sampling};
    use coupler_curves::measure::MeasureSet;
    use coupler_curves::solve::Solver;

    fn guides(seed: u64, count: usize) -> (Vec<BodyPose>, Vec<SolvedCell>) {
        let (set, _) = random_poses(count, seed);
        let options = PoseOptions { full_turn: false, max_link: f64::INFINITY, ..PoseOptions::default() };
        let found = exact_guides(&set, &options, &OneAtATime);
        (set.poses().to_vec(), found.answers.iter().filter_map(|answer| answer.solved()).collect())
    }

    #[test]
    fn linkages_that_guide_a_body_pass_its_poses() {
        let mut count = 0;
        for seed in 1..=12 {
            let (poses, solved) = guides(seed, 5);
            for solved in solved {
                let passed = passed_poses(&poses, &solved);
                assert_eq!(passed.len(), 5);
                for (pose, passed) in poses.iter().zip(passed) {
                    let PoseDeviation { distance, angle_deg } = passed.deviation;
                    assert!(distance < 1e-6 && angle_deg.abs() < 1e-4, "{seed}: {distance} {angle_deg}");
                    let point = solved.linkage.find_joint("M").unwrap();
                    assert!((passed.joints[point] - pose.point).norm() < 1e-6, "{seed}");
                }
                count += 1;
            }
        }
        assert!(count >= 12, "{count}");
    }

    #[test]
    fn a_link_that_slides_through_a_pin_passes_its_poses() {
        // The line through the crank pin and the pivot at (2, 0): its direction is that of the pin from the pivot.
        let template = coupler_curves::catalogue::find("inverted-slider-crank").unwrap();
        let values = [("g", 2.0), ("r", 1.0), ("e", 0.0), ("along", 1.5), ("across", 0.5)];
        let values = values.map(|(name, value)| (name.to_owned(), value));
        let family = Family::single_cell(template, &values, Sampling::Samples(90)).unwrap();
        let solved = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0).unwrap();
        let pose = |input: f64| {
            let (cos, sin) = trig::cos_sin_deg(input);
            let along = Complex::new(cos - 2.0, sin);
            let unit = along / length(along);
            let at = Complex::new(2.0, 0.0) + unit * Complex::new(1.5, 0.5);
            BodyPose { point: Point::new(at.re, at.im), angle_deg: 30.0 + trig::degrees(trig::atan2(unit.im, unit.re)) }
        };
        let poses = [10.3, 77.7, 130.1, 255.5, 359.2].map(pose);
        for (pose, passed) in poses.iter().zip(passed_poses(&poses, &solved)) {
            let PoseDeviation { distance, angle_deg } = passed.deviation;
            assert!(distance < 1e-7 && angle_deg.abs() < 1e-5, "{pose:?}: {passed:?}");
        }
        // A pin of two links has places only.
        let four_bar = coupler_curves::catalogue::find("four-bar").unwrap();
        let linkage = four_bar.linkage(&[4.0, 1.5, 3.0, 3.5, 1.0, 1.0]).unwrap();
        let joint = |name: &str| linkage.find_joint(name).unwrap();
        assert_eq!(other_joint(&linkage, joint("B")), None);
        assert!(other_joint(&linkage, joint("M")).is_some());
    }

    #[test]
    fn no_other_turn_and_no_other_inputs_are_nearer() {
        let mut scatter = Scatter::new(3);
        for seed in 1..=4 {
            let (mut poses, solved) = guides(seed, 5);
            let solved = &solved[0];
            for pose in &mut poses {
                pose.point += coupler_curves::geometry::Vector::new(scatter.normal(0.05), scatter.normal(0.05));
                pose.angle_deg += scatter.normal(3.0);
            }
            let guided = Guided::new(&poses, solved).unwrap();
            let sum_of = |passed: &[PassedPose]| {
                let square = |one: &PassedPose| {
                    let sine = 2.0 * trig::sin(trig::radians(one.deviation.angle_deg) / 2.0) * guided.angle_length;
                    one.deviation.distance * one.deviation.distance + sine * sine
                };
                passed.iter().map(square).sum::<f64>()
            };
            let found = sum_of(&passed_poses(&poses, solved));
            // All inputs in steps of 0.1 degrees, for all turns in steps of half a degree.
            let circuit = solved.circuit(&solved.curves[0]);
            let mut states = Vec::new();
            for pass in &circuit.passes {
                let [low, high] = pass.input_range();
                let steps = ((high - low) / 0.1) as usize;
                states.extend((0..=steps).map(|k| guided.state_at(pass, low + (high - low) * k as f64 / steps as f64)));
            }
            let aims: Vec<Aim> = poses.iter().map(Aim::new).collect();
            let of_turn = |k: u32| {
                let turn = unit(trig::radians(0.5 * f64::from(k)));
                let least = |aim: &Aim| {
                    states.iter().map(|state| guided.square(state, aim, turn)).fold(f64::INFINITY, f64::min)
                };
                aims.iter().map(least).sum::<f64>()
            };
            let least = (0..720).map(of_turn).fold(f64::INFINITY, f64::min);
            assert!(found <= least * (1.0 + 1e-9) && found > 1e-6, "{seed}: {found} and {least}");
            assert!(least <= 1.05 * found + 1e-3, "{seed}: {found} and {least}");
        }
    }
}
