//! The motion over the input: the speed of every point on the page, and the transmission angle.

use super::shown_curve::ShownCurve;
use coupler_curves::linkage::{Input, JointId};
use coupler_curves::measure::transmission_angle;
use coupler_curves::motion::{self, JointDerivatives, Pass};
use coupler_curves::numerical::maximum;
use coupler_curves::solve::SolvedCell;

/// A value of the input and that of a quantity.
pub(super) type Sample = [f64; 2];

/// The samples of a quantity on each pass, in order; between passes it may jump.
pub(super) type Runs = Vec<Vec<Sample>>;

/// The range of the input over some circuits, and its scale.
pub(super) struct InputRange {
    pub from: f64,
    pub to: f64,
    input: Input,
}

impl InputRange {
    /// The range over the circuits of some curves.
    pub fn of_curves(solved: &SolvedCell, shown: &[ShownCurve]) -> InputRange {
        let passes = shown.iter().flat_map(|s| &solved.circuit(s.curve).passes);
        let ends = passes.flat_map(Pass::input_range);
        let [from, to] =
            ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        InputRange { from, to, input: solved.linkage.input() }
    }

    /// Inputs at round steps, for numbers on the axis: at most five.
    pub fn ticks(&self) -> Vec<f64> {
        /// The steps of angles, in degrees: parts of a turn, and for small ranges round numbers.
        const DEGREES: [f64; 10] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0];
        const MOST: f64 = 4.5;
        let span = self.to - self.from;
        let is_angle = self.input != Input::Length;
        let round = || super::super::plot::round_number_below(span / 2.0);
        let step = DEGREES.into_iter().find(|step| is_angle && span <= MOST * step).unwrap_or_else(round);
        let first = (self.from / step - 1e-9).ceil();
        let count = ((self.to / step + 1e-9).floor() - first).clamp(-1.0, MOST) as i32;
        (0..=count).map(|k| (first + f64::from(k)) * step).collect()
    }

    /// The unit, as written after a number.
    pub fn unit(&self) -> &'static str {
        self.input.unit_sign()
    }
}

/// The inputs at which a quantity is sampled on a pass, from its beginning to its end.
fn inputs(pass: &Pass, range: &InputRange) -> impl Iterator<Item = f64> + use<> {
    /// The number of intervals of the whole range: a turn in steps of 3 degrees.
    const INTERVALS: f64 = 120.0;
    let (from, to) = (pass.from.input.value, pass.to.input.value);
    let count = (INTERVALS * pass.input_length() / (range.to - range.from) - 1e-9).ceil().clamp(2.0, INTERVALS) as i32;
    (0..=count).map(move |k| if k == count { to } else { from + (to - from) * f64::from(k) / f64::from(count) })
}

/// The speeds of the points of a page relative to that of the input: of a crank's pin, or along an actuator.
pub(super) struct Speeds {
    /// The speed of each curve on the page; not finite at limits.
    pub curves: Vec<Runs>,
    /// The upper end of the scale that all graphs have, a round number. Near limits speeds are greater.
    pub top: f64,
}

impl Speeds {
    /// The speeds of some curves over the input.
    pub fn of_curves(solved: &SolvedCell, shown: &[ShownCurve], range: &InputRange) -> Speeds {
        // The speed of the crank's pin per radian.
        let unit = solved.linkage.crank_length().unwrap_or(1.0);
        let mut curves: Vec<Runs> = shown.iter().map(|_| Vec::new()).collect();
        for (number, circuit) in (1..).zip(&solved.motion.circuits) {
            let on_circuit: Vec<usize> = (0..shown.len()).filter(|&k| shown[k].curve.circuit == number).collect();
            if on_circuit.is_empty() {
                continue;
            }
            for pass in &circuit.passes {
                on_circuit.iter().for_each(|&k| curves[k].push(Vec::new()));
                for input in inputs(pass, range) {
                    let derivatives = JointDerivatives::on_pass(&solved.linkage, pass, input);
                    for &k in &on_circuit {
                        let speed = derivatives.velocity(shown[k].curve.joint).norm() / unit;
                        curves[k].last_mut().into_iter().for_each(|run| run.push([input, speed]));
                    }
                }
            }
        }
        let has_limits = shown.iter().any(|s| {
            let circuit = solved.circuit(s.curve);
            (0..circuit.passes.len()).any(|pass| circuit.reverses_after(pass))
        });
        Speeds { top: scale_top(&curves, has_limits), curves }
    }
}

/// A round number no less than the greatest speed; where speeds grow beyond all bounds, near a limit, no less than
/// three times the mean.
fn scale_top(curves: &[Runs], has_limits: bool) -> f64 {
    let speeds = curves.iter().flatten().flatten().map(|[_, speed]| *speed).filter(|speed| speed.is_finite());
    let (mut greatest, mut sum, mut count) = (0.0f64, 0.0, 0.0);
    for speed in speeds {
        (greatest, sum, count) = (greatest.max(speed), sum + speed, count + 1.0);
    }
    let shown = if has_limits && count > 0.0 { greatest.min(3.0 * sum / count) } else { greatest };
    let step = super::super::plot::round_number_below(shown / 4.0);
    step * (shown / step - 1e-9).ceil().max(1.0)
}

/// The transmission angle of a four-bar over the input.
pub(super) struct TransmissionAngles {
    /// The angle in degrees on each pass.
    pub runs: Runs,
    /// The least and the greatest angle, each after its input.
    pub extremes: [Sample; 2],
}

impl TransmissionAngles {
    /// The transmission angles on the circuits of some curves; `None` if the linkage is not a four-bar.
    pub fn of_curves(solved: &SolvedCell, shown: &[ShownCurve], range: &InputRange) -> Option<TransmissionAngles> {
        let first: JointId = shown.first()?.curve.joint;
        // Poses without the other points of the grid are faster to compute.
        let (linkage, _) = solved.linkage.with_one_point(first);
        let mut numbers: Vec<usize> = shown.iter().map(|s| s.curve.circuit).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let passes: Vec<&Pass> = numbers.iter().flat_map(|&k| &solved.motion.circuits[k - 1].passes).collect();
        let angle = |pass: &Pass, input: f64| transmission_angle(&linkage, &motion::pose(&linkage, pass, input));
        let mut runs = Runs::new();
        for pass in &passes {
            let sample = |input: f64| Some([input, angle(pass, input)?]);
            runs.push(inputs(pass, range).map(sample).collect::<Option<Vec<Sample>>>()?);
        }
        let extreme = |sign: f64| {
            let best = passes
                .iter()
                .zip(&runs)
                .filter_map(|(pass, run)| extreme_sample(run, sign, |input| angle(pass, input).unwrap_or(f64::NAN)));
            best.reduce(|best, other| if sign * (other[1] - best[1]) > 1e-9 { other } else { best })
        };
        Some(TransmissionAngles { extremes: [extreme(-1.0)?, extreme(1.0)?], runs })
    }
}

/// The greatest of `sign` times a function that is sampled: the best sample, or a better value between its neighbours.
fn extreme_sample(run: &[Sample], sign: f64, value: impl Fn(f64) -> f64) -> Option<Sample> {
    /// How accurately the input is found, in degrees or units of length: the value is as accurate as its rounding then.
    const ACCURACY: f64 = 1e-9;
    let is_better = |a: f64, b: f64| sign * (a - b) > 0.0;
    let best = (0..run.len()).reduce(|best, k| if is_better(run[k][1], run[best][1]) { k } else { best })?;
    let ends = [best.saturating_sub(1), (best + 1).min(run.len() - 1)].map(|k| run[k][0]);
    let refined = maximum(ends, ACCURACY, |input| sign * value(input));
    // A sample at a limit, or where the crank is on the frame, is exact.
    let is_better = refined.value - sign * run[best][1] > 1e-9;
    Some(if is_better { [refined.place, sign * refined.value] } else { run[best] })
}

/// The inputs at which a linkage goes on through a change point, from 0 up to a period, in rising order.
pub(super) fn change_point_inputs(solved: &SolvedCell) -> Vec<f64> {
    let period = solved.linkage.input().period();
    let mut inputs: Vec<f64> = Vec::new();
    for circuit in &solved.motion.circuits {
        for (k, pass) in circuit.passes.iter().enumerate() {
            let input = pass.to.input.value.rem_euclid(period);
            let is_new = inputs.iter().all(|other| (other - input).abs() > 1e-6);
            if !pass.to.flat_dyads.is_empty() && !circuit.reverses_after(k) && is_new {
                inputs.push(input);
            }
        }
    }
    inputs.sort_by(f64::total_cmp);
    inputs
}
