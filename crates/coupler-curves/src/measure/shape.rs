use super::{Measure, TracedCurve, Value};
use crate::geometry::{cross, trig};
use crate::linkage::{DyadSet, Input};
use crate::motion::{InputPosition, JointDerivatives, PassEnd};

/// How often the path crosses itself.
pub const CRUNODES: Measure = Measure {
    name: "crunodes",
    unit: "",
    is_word: false,
    definition: "points at which the path crosses itself",
    compute: |subject: &TracedCurve| Value::Number(subject.sampled_curve().crunodes().len() as f64),
};

/// How often it bends the other way.
pub const INFLECTIONS: Measure = Measure {
    name: "inflections",
    unit: "",
    is_word: false,
    definition: "points at which the path begins to bend the other way",
    compute: |subject: &TracedCurve| Value::Number(subject.sampled_curve().inflection_count() as f64),
};

/// How often it stops and turns back.
pub const CUSPS: Measure = Measure {
    name: "cusps",
    unit: "",
    is_word: false,
    definition: "points at which the path stands still and turns back: slower than a millionth of its fastest",
    compute: |subject: &TracedCurve| Value::Number(subject.cusp_count() as f64),
};

/// Its sharpest bend.
pub const CURVATURE_MAX: Measure = Measure {
    name: "curvature_max",
    unit: "",
    is_word: false,
    definition: "greatest curvature of the path but for corners at change points, 1 over the manifest's unit; inf at a cusp, and where the path turns back at a limit",
    compute: |subject: &TracedCurve| max_curvature(subject).map_or(Value::Missing, Value::Number),
};

/// Speed and curvature of the path at an input of the pass that a sample is on.
fn speed_and_curvature(subject: &TracedCurve, sample: usize, input: f64) -> [f64; 2] {
    let stop = InputPosition::new(subject.linkage.input(), input);
    let (linkage, joint) = subject.single_point_linkage();
    let jets = JointDerivatives::new(linkage, stop, subject.circuit.mode_at(sample), DyadSet::EMPTY);
    let (v, a) = (jets.velocity(joint), jets.acceleration(joint));
    let speed = v.norm();
    [speed, (cross(v, a) / (speed * speed * speed)).abs()]
}

/// The inputs beside a sample on its own pass.
fn neighbour_inputs(subject: &TracedCurve, sample: usize) -> [f64; 2] {
    let input = |k: usize| subject.circuit.inputs.get(k).copied();
    let here = subject.circuit.inputs[sample];
    let (before, after) = (sample.checked_sub(1).and_then(input), input(sample + 1));
    let step = after.or(before).map_or(0.0, |other| (other - here).abs());
    [here - before.map_or(step, |b| (here - b).abs()), here + after.map_or(step, |a| (a - here).abs())]
}

/// How often a path stands still and turns back.
pub(super) fn count_cusps(subject: &TracedCurve) -> usize {
    let trail = subject.sampled_curve();
    let turns: Vec<usize> = (0..trail.points.len()).filter(|&i| trail.turns_sharply(i)).collect();
    if turns.is_empty() {
        return 0;
    }
    let longest = trail.arc_lengths().into_iter().fold(0.0, f64::max);
    let mut found: Vec<f64> = Vec::new();
    for i in turns {
        let sample = trail.sample_indices[i];
        let [mut a, mut b] = neighbour_inputs(subject, sample);
        let step = (b - a).abs();
        for _ in 0..60 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            let [sc, sd] = [c, d].map(|input| speed_and_curvature(subject, sample, input)[0]);
            if sc < sd { b = d } else { a = c }
        }
        let still = speed_and_curvature(subject, sample, a)[0];
        // The speed of the longest step, to a radian or a unit of length, for comparison.
        let unit = if subject.linkage.input() == Input::Length { 1.0 } else { trig::degrees(1.0) };
        let fastest = longest / (step / 2.0) * unit;
        let is_new = found.iter().all(|other| (other - a).abs() > step / 4.0);
        if still <= 1e-6 * fastest && is_new {
            found.push(a);
        }
    }
    found.len()
}

/// The ends of passes at which a dyad lies flat.
fn limit_ends<'a>(subject: &TracedCurve<'a>) -> impl Iterator<Item = &'a PassEnd> {
    let ends = subject.circuit.passes.iter().flat_map(|pass| [&pass.from, &pass.to]);
    ends.filter(|end| !end.flat_dyads.is_empty())
}

fn max_curvature(subject: &TracedCurve) -> Option<f64> {
    let trail = subject.sampled_curve();
    let sharpest = trail.sharpest_sample()?;
    let is_limit = |i: &usize| limit_ends(subject).any(|end| end.input.value == trail.inputs[*i]);
    if subject.cusp_count() > 0 || (0..trail.points.len()).filter(is_limit).any(|i| trail.doubles_back(i)) {
        return Some(f64::INFINITY);
    }
    let sample = trail.sample_indices[sharpest];
    let [mut a, mut b] = neighbour_inputs(subject, sample);
    let is_end = |input: &f64| limit_ends(subject).any(|end| (end.input.value - input).abs() <= (b - a).abs());
    // At a limit the path bends as it does elsewhere, but its rates do not tell.
    if is_end(&subject.circuit.inputs[sample]) {
        return Some(trail.max_curvature_near(sharpest));
    }
    let at = |input: f64| speed_and_curvature(subject, sample, input)[1];
    // To a thousandth of the way between samples: the greatest bend is as flat as it is smooth.
    for _ in 0..18 {
        let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
        if at(c) > at(d) { b = d } else { a = c }
    }
    Some(at((a + b) / 2.0).max(at(subject.circuit.inputs[sample])))
}
