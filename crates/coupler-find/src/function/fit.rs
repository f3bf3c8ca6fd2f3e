//! Linkages moved until the error of their output is least: its mean square, or its greatest magnitude.

use nalgebra::{DVector, Dyn};

use super::generator::{Generator, UNKNOWNS};
use super::precision::GivenStarts;
use crate::descent::{Candidate, Descent, Equations};
use coupler_curves::geometry::trig;

/// What a fit aims at.
#[derive(Clone, Debug)]
pub(super) struct FitAim<'a> {
    /// The travels of input and output that are wanted.
    pub samples: &'a [[f64; 2]],
    /// Which of the unknowns move: three lengths, and the starts that are not given.
    pub free: Vec<usize>,
    /// What the linkage must satisfy.
    pub limits: Limits,
    /// The power of the errors whose sum is least, at least 2, and the error that counts as 1.
    pub power: f64,
    pub reference: f64,
}

/// What a linkage must satisfy.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// The greatest ratio of the longest link to the shortest; may be infinite.
    pub max_ratio: f64,
    /// Whether the crank must turn fully.
    pub full_turn: bool,
    /// The least transmission angle over the range, in radians; 0 for any.
    pub least_transmission: f64,
}

impl Limits {
    /// By how much a linkage that moves between two inputs is beyond each limit: logarithms, lengths and radians, not negative.
    fn excesses(&self, linkage: &Generator, [from, to]: [f64; 2]) -> [f64; 3] {
        let ratio = if self.max_ratio.is_finite() { trig::ln(linkage.ratio() / self.max_ratio) } else { -1.0 };
        let turn = if self.full_turn { linkage.lack_of_full_turn() } else { -1.0 };
        let transmission = match self.least_transmission {
            0.0 => -1.0,
            least => least - linkage.worst_transmission(from, to),
        };
        [ratio, turn, transmission].map(|excess| (excess + MARGIN).max(0.0))
    }
}

/// The unknowns that move if some starts are given.
pub(super) fn free_unknowns(starts: GivenStarts) -> Vec<usize> {
    (0..UNKNOWNS).filter(|k| *k < 3 || starts[*k - 3].is_none()).collect()
}

/// A linkage on its way.
#[derive(Clone, Debug)]
struct Fitted {
    linkage: Generator,
    /// The outputs at all samples, and the errors.
    outputs: Vec<f64>,
    errors: Vec<f64>,
    excesses: [f64; 3],
    objective: f64,
}

/// The weight of what is beyond a limit, relative to the error that counts as 1 at each sample: it is then beyond by less than the margin.
const WEIGHT: f64 = 1e4;

/// Limits are aimed at with a margin, of a thousandth or some hundredths of a degree, so that they hold in the end.
const MARGIN: f64 = 1e-3;

impl Fitted {
    fn new(linkage: Generator, aim: &FitAim) -> Option<Fitted> {
        let [first, last] = [aim.samples.first()?, aim.samples.last()?];
        let start = linkage.starts[0];
        if !linkage.lengths.iter().all(|length| length.is_finite())
            || !linkage.is_assembled_between(start + first[0], start + last[0])
        {
            return None;
        }
        let turns = linkage.turns_at(*first)?;
        let outputs: Option<Vec<f64>> = aim.samples.iter().map(|[x, _]| linkage.output(start + x)).collect();
        let outputs = outputs?;
        let error = |(output, [_, y]): (&f64, &[f64; 2])| output + turns - linkage.starts[1] - y;
        let errors: Vec<f64> = outputs.iter().zip(aim.samples).map(error).collect();
        let excesses = aim.limits.excesses(&linkage, aim.inputs(&linkage));
        let mut fitted = Fitted { linkage, outputs, errors, excesses, objective: 0.0 };
        let sum: f64 = fitted.errors.iter().map(|error| aim.residual(*error)[0]).map(|r| r * r).sum();
        fitted.objective = sum + aim.weight() * excesses.iter().map(|excess| excess * excess).sum::<f64>();
        fitted.objective.is_finite().then_some(fitted)
    }
}

impl FitAim<'_> {
    /// The residual of an error, whose square is its power, and the derivative.
    fn residual(&self, error: f64) -> [f64; 2] {
        let part = error / self.reference;
        if self.power <= 2.0 {
            return [part, 1.0 / self.reference];
        }
        let half = 0.5 * self.power;
        let slope = trig::pow(part.abs(), half - 1.0);
        [slope * part, half * slope / self.reference]
    }

    /// The inputs of a linkage between which it moves.
    fn inputs(&self, linkage: &Generator) -> [f64; 2] {
        let travel = |sample: Option<&[f64; 2]>| sample.map_or(0.0, |[x, _]| *x);
        [self.samples.first(), self.samples.last()].map(|sample| linkage.starts[0] + travel(sample))
    }

    fn weight(&self) -> f64 {
        WEIGHT * self.samples.len() as f64
    }
}

impl Candidate for Fitted {
    type Unknowns = Dyn;
    type Aim<'a> = FitAim<'a>;

    const NO_GAIN: f64 = 1e-12;

    fn objective(&self) -> f64 {
        self.objective
    }

    fn is_exact(&self, aim: &FitAim) -> bool {
        /// Of the error that counts as 1, squared: rounding.
        const ROUNDING: f64 = 1e-26;
        self.objective <= ROUNDING * aim.samples.len() as f64
    }

    fn equations(&self, aim: &FitAim) -> Option<Equations<Dyn>> {
        let mut equations = Equations::new(Dyn(aim.free.len()));
        for (([x, _], output), error) in aim.samples.iter().zip(&self.outputs).zip(&self.errors) {
            let slopes = self.linkage.slopes(*x, *output);
            let [residual, slope] = aim.residual(*error);
            let row: Vec<f64> = aim.free.iter().map(|k| slope * slopes[*k]).collect();
            // A sample at a limit has no derivatives.
            if row.iter().all(|entry| entry.is_finite()) {
                equations.add(&row, -residual, 1.0);
            }
        }
        let beyond = (0..self.excesses.len()).filter(|limit| self.excesses[*limit] > 0.0);
        for limit in beyond {
            /// A hundred thousandth of the margin and less.
            const STEP: f64 = 1e-8;
            let slope = |place: usize| {
                let by = (0..aim.free.len()).map(|k| if k == place { STEP } else { 0.0 });
                let near = self.linkage.moved(&aim.free, by);
                (aim.limits.excesses(&near, aim.inputs(&near))[limit] - self.excesses[limit]) / STEP
            };
            let row: Vec<f64> = (0..aim.free.len()).map(slope).collect();
            equations.add(&row, -self.excesses[limit], aim.weight());
        }
        Some(equations)
    }

    fn moved(&self, aim: &FitAim, motion: &DVector<f64>) -> Option<Fitted> {
        Fitted::new(self.linkage.moved(&aim.free, motion.iter().copied()), aim)
    }
}

/// The linkage near another one for which the sum of powers of the errors is least, after a number of steps at most; `None` if it cannot
/// be assembled at all samples.
pub(super) fn fitted(linkage: Generator, aim: &FitAim, steps: usize) -> Option<Generator> {
    let mut candidate = Fitted::new(linkage, aim)?;
    let mut descent = Descent::default();
    for _ in 0..steps {
        if descent.is_done {
            break;
        }
        descent.step(&mut candidate, aim);
    }
    Some(candidate.linkage)
}

/// The mean of the square of the error at the samples, with what the links are beyond their limit; `None` if the linkage cannot be assembled at
/// all of them.
pub(super) fn mean_square(linkage: Generator, aim: &FitAim) -> Option<f64> {
    Some(Fitted::new(linkage, aim)?.objective / aim.samples.len() as f64)
}

/// The greatest magnitude of the error at the samples; `None` if the linkage cannot be assembled at all of them.
pub(super) fn greatest_error(linkage: Generator, aim: &FitAim) -> Option<f64> {
    let fitted = Fitted::new(linkage, aim)?;
    Some(fitted.errors.iter().fold(0.0, |most: f64, error| most.max(error.abs())))
}

/// The linkage near another one for which the greatest error is nearly least: sums of higher and higher powers are made least in turn.
/// That of the power p is beyond the least greatest error by no more than the p-th root of the number of samples.
pub(super) fn least_greatest(linkage: Generator, aim: &FitAim) -> Option<Generator> {
    const STEPS: usize = 40;
    const MAX_POWER: f64 = 1024.0;
    let mut best = (greatest_error(linkage, aim)?, linkage);
    let mut last = linkage;
    let mut power = 4.0;
    while power <= MAX_POWER && best.0 > 0.0 {
        let reference = greatest_error(last, aim)?;
        last = fitted(last, &FitAim { power, reference, ..aim.clone() }, STEPS)?;
        let greatest = greatest_error(last, aim)?;
        if greatest < best.0 {
            best = (greatest, last);
        }
        power *= 2.0;
    }
    Some(best.1)
}
