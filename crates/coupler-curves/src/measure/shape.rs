//! Crunodes, inflections, cusps and the greatest curvature of the path.

use super::{Measure, TracedCurve, Value};
use crate::geometry::{cross, trig};
use crate::linkage::{DyadSet, Input};
use crate::motion::{InputPosition, JointDerivatives, PassEnd};

/// The measure `crunodes`.
pub const CRUNODES: Measure = Measure {
    name: "crunodes",
    unit: "",
    is_word: false,
    definition: "points at which the path crosses itself",
    compute: |curve: &TracedCurve| Value::Number(curve.sampled_curve().crunodes().len() as f64),
};

/// The measure `inflections`.
pub const INFLECTIONS: Measure = Measure {
    name: "inflections",
    unit: "",
    is_word: false,
    definition: "points at which the curvature of the path changes its sign",
    compute: |curve: &TracedCurve| Value::Number(curve.sampled_curve().inflection_count() as f64),
};

/// The measure `cusps`.
pub const CUSPS: Measure = Measure {
    name: "cusps",
    unit: "",
    is_word: false,
    definition: "points at which the path stops and reverses: slower than a millionth of its greatest speed",
    compute: |curve: &TracedCurve| Value::Number(curve.cusp_count() as f64),
};

/// The measure `curvature_max`.
pub const CURVATURE_MAX: Measure = Measure {
    name: "curvature_max",
    unit: "",
    is_word: false,
    definition: "greatest curvature of the path except at corners at change points, in 1 over the manifest's unit; inf if there is a cusp, or if the path reverses at a limit",
    compute: |curve: &TracedCurve| max_curvature(curve).map_or(Value::Missing, Value::Number),
};

/// The speed and the curvature of the path at an input of the pass of a sample.
fn speed_and_curvature(curve: &TracedCurve, sample: usize, input: f64) -> [f64; 2] {
    let input = InputPosition::new(curve.linkage.input(), input);
    let (linkage, joint) = curve.single_point_linkage();
    let derivatives = JointDerivatives::new(linkage, input, curve.circuit.mode_at(sample), DyadSet::EMPTY);
    let (v, a) = (derivatives.velocity(joint), derivatives.acceleration(joint));
    let speed = v.norm();
    [speed, (cross(v, a) / (speed * speed * speed)).abs()]
}

/// The inputs on the pass of a sample that are as far from it as the neighbouring samples.
fn neighbour_inputs(curve: &TracedCurve, sample: usize) -> [f64; 2] {
    let input = |k: usize| curve.circuit.inputs.get(k).copied();
    let here = curve.circuit.inputs[sample];
    let (before, after) = (sample.checked_sub(1).and_then(input), input(sample + 1));
    let step = after.or(before).map_or(0.0, |other| (other - here).abs());
    [here - before.map_or(step, |b| (here - b).abs()), here + after.map_or(step, |a| (a - here).abs())]
}

/// The number of cusps of a path.
pub(super) fn count_cusps(curve: &TracedCurve) -> usize {
    let samples = curve.sampled_curve();
    let sharp_samples: Vec<usize> = (0..samples.points.len()).filter(|&i| samples.turns_sharply(i)).collect();
    if sharp_samples.is_empty() {
        return 0;
    }
    let longest = samples.arc_lengths().into_iter().fold(0.0, f64::max);
    let mut found: Vec<f64> = Vec::new();
    for i in sharp_samples {
        let sample = samples.sample_indices[i];
        let [mut a, mut b] = neighbour_inputs(curve, sample);
        let step = (b - a).abs();
        for _ in 0..60 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            let [sc, sd] = [c, d].map(|input| speed_and_curvature(curve, sample, input)[0]);
            if sc < sd { b = d } else { a = c }
        }
        let least_speed = speed_and_curvature(curve, sample, a)[0];
        // The speed of the longest step per radian or unit of length, for comparison.
        let unit = if curve.linkage.input() == Input::Length { 1.0 } else { trig::degrees(1.0) };
        let fastest = longest / (step / 2.0) * unit;
        let is_new = found.iter().all(|other| (other - a).abs() > step / 4.0);
        if least_speed <= 1e-6 * fastest && is_new {
            found.push(a);
        }
    }
    found.len()
}

/// The ends of passes at which a dyad is flat.
fn limit_ends<'a>(curve: &TracedCurve<'a>) -> impl Iterator<Item = &'a PassEnd> {
    let ends = curve.circuit.passes.iter().flat_map(|pass| [&pass.from, &pass.to]);
    ends.filter(|end| !end.flat_dyads.is_empty())
}

/// The greatest curvature of a path; infinite if it has a cusp or reverses at a limit.
fn max_curvature(curve: &TracedCurve) -> Option<f64> {
    let samples = curve.sampled_curve();
    let sharpest = samples.sharpest_sample()?;
    let is_limit = |i: &usize| limit_ends(curve).any(|end| end.input.value == samples.inputs[*i]);
    if curve.cusp_count() > 0 || (0..samples.points.len()).filter(is_limit).any(|i| samples.doubles_back(i)) {
        return Some(f64::INFINITY);
    }
    let sample = samples.sample_indices[sharpest];
    let [mut a, mut b] = neighbour_inputs(curve, sample);
    let is_end = |input: &f64| limit_ends(curve).any(|end| (end.input.value - input).abs() <= (b - a).abs());
    // At a limit the curvature is finite, but the derivatives with respect to the input are not.
    if is_end(&curve.circuit.inputs[sample]) {
        return Some(samples.max_curvature_near(sharpest));
    }
    let at = |input: f64| speed_and_curvature(curve, sample, input)[1];
    // To a thousandth of the distance between samples: the error of the maximum is of the second order in that.
    for _ in 0..18 {
        let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
        if at(c) > at(d) { b = d } else { a = c }
    }
    Some(at((a + b) / 2.0).max(at(curve.circuit.inputs[sample])))
}
