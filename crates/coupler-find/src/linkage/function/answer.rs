//! A linkage with an output link that generates a function.

use std::sync::Arc;

use super::fitting::LinkageFit;
use super::followed::FollowedOutput;
use super::track::Track;
use crate::condition::Condition;
use crate::function::{FunctionTarget, StructuralError};
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::trig;
use coupler_curves::measure::{Measure, MeasureSet};
use coupler_curves::solve::{MeasuredCurve, Solver};
use coupler_curves::template::Template;

/// Dimensions of a linkage whose output is near a wanted function of its input.
#[derive(Clone, Debug)]
pub struct LinkageFunctionAnswer {
    /// The values of its parameters.
    pub values: Vec<f64>,
    /// The input at the start and the end of the function, in degrees.
    pub input_deg: [f64; 2],
    /// The output that is wanted there, in degrees or as a length.
    pub output: [f64; 2],
    /// The output less the wanted one, in degrees or as a length; its places are inputs of the linkage, in degrees. Zeros are not searched for.
    pub error: StructuralError,
    /// The worst transmission angle over the range of the input, in degrees; not a number if it has none.
    pub mu_worst_deg: f64,
    /// A family of this linkage over the range of its input.
    pub family: Family,
    /// What it generates.
    pub output_function: FollowedOutput,
    pub(super) fit: LinkageFit,
}

/// The steps over the range at which the error of a law is measured.
const PARTS: usize = 720;

impl LinkageFunctionAnswer {
    /// The answer of a fit, if it meets a condition over the range of its input.
    pub(super) fn new(
        fit: LinkageFit,
        template: &Arc<Template>,
        target: &FunctionTarget,
        condition: Option<&Condition>,
    ) -> Option<LinkageFunctionAnswer> {
        let unit = if target.is_length() { 1.0 } else { trig::degrees(1.0) };
        let samples: Vec<[f64; 2]> = match target.as_law() {
            Some(law) => {
                let travel = |k: usize| law.travel() * k as f64 / PARTS as f64;
                (0..=PARTS).map(|k| [travel(k), law.wanted(travel(k))]).collect()
            }
            None => target.samples(),
        };
        let travels: Vec<f64> = samples.iter().map(|[x, _]| trig::degrees(*x)).collect();
        let outputs = Track::new(&travels).outputs(&fit.traced, fit.pass, fit.starts[0])?;
        let errors: Vec<f64> = outputs.iter().zip(&samples).map(|(there, [_, y])| there - fit.starts[1] - y).collect();
        let worst = (0..errors.len()).max_by(|a, b| errors[*a].abs().total_cmp(&errors[*b].abs()))?;
        let mean = errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64;
        let error = StructuralError {
            greatest: unit * errors[worst],
            at: fit.starts[0] + travels[worst],
            rms: unit * mean.sqrt(),
            zeros: Vec::new(),
        };
        let input_deg = [fit.starts[0], fit.starts[0] + trig::degrees(target.travel())];
        let mut family = ranged_family(&fit.values, template, input_deg)?;
        let used = condition.map_or(MeasureSet::EMPTY, |condition| family.measures_in(condition.compiled()));
        let solved = Solver::new(&family).measuring(used | MeasureSet::EMPTY.with(Measure::MU_WORST)).solve(0)?;
        family.filter = condition.map(|condition| condition.compiled().clone());
        let mode = fit.traced.circuit.passes.get(fit.pass)?.mode;
        let is_own = |curve: &&MeasuredCurve| {
            solved.circuit(curve).passes.iter().any(|pass| pass.mode == mode)
                && family.keeps(&solved.cell, &curve.values)
        };
        let curve = solved.curves.iter().find(is_own)?;
        let mu_worst_deg = curve.measure(Measure::MU_WORST).unwrap_or(f64::NAN);
        family.filter = None;
        let last = samples.last().map_or(0.0, |[_, y]| *y);
        Some(LinkageFunctionAnswer {
            values: fit.values.clone(),
            input_deg,
            output: [unit * fit.starts[1], unit * (fit.starts[1] + last)],
            error,
            mu_worst_deg,
            family,
            output_function: FollowedOutput::of_fit(&fit, &travels, &outputs, target.is_length())?,
            fit,
        })
    }

    /// The outputs at travels of the input from the start, see [`FollowedOutput::at`].
    pub fn generated(&self, travels_deg: &[f64]) -> Option<Vec<f64>> {
        self.output_function.at(travels_deg)
    }
}

/// The family of a linkage over a range of its input only.
fn ranged_family(values: &[f64], template: &Arc<Template>, range_deg: [f64; 2]) -> Option<Family> {
    let names = template.parameters.iter().map(|parameter| parameter.name.clone());
    let given: Vec<(String, f64)> = names.zip(values.iter().copied()).collect();
    Family::single_cell(Arc::new(template.over(range_deg)), &given, Sampling::Samples(180)).ok()
}
