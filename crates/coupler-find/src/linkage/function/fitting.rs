//! The dimensions of a linkage moved until the error of its output is least.

use nalgebra::{DVector, Dyn};

use super::super::circuit::Traced;
use super::super::space::LinkageSpace;
use super::track::Track;
use crate::descent::{Candidate, Descent, Equations};
use coupler_curves::geometry::trig;

/// What a fit aims at.
pub(super) struct LinkageAim<'a> {
    pub space: &'a LinkageSpace,
    pub track: &'a Track,
    /// The wanted outputs at the travels of the track, from the start.
    pub wanted: &'a [f64],
    /// The starts that are given: the input in degrees, and the output.
    pub given: [Option<f64>; 2],
    /// Whether the input must turn fully.
    pub full_turn: bool,
    /// The power of the errors whose sum is least, at least 2, and the error that counts as 1.
    pub power: f64,
    pub reference: f64,
}

/// A linkage on its way.
#[derive(Clone, Debug)]
pub(super) struct LinkageFit {
    pub values: Vec<f64>,
    pub traced: Traced,
    pub pass: usize,
    /// The input at the start in degrees, and the wanted output there.
    pub starts: [f64; 2],
    pub errors: Vec<f64>,
    objective: f64,
}

/// How near a linkage comes that is as many times as large, if that makes its output as many times as great.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rough {
    pub mean_square: f64,
    pub scale: f64,
}

impl LinkageAim<'_> {
    /// How near a linkage comes on a pass from an input, with the best start of the output and, of a way, the best size of the linkage.
    pub fn rough(&self, traced: &Traced, pass: usize, start_deg: f64) -> Option<Rough> {
        let outputs = self.track.outputs(traced, pass, start_deg)?;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let [middle, wanted] = [mean(&outputs), mean(self.wanted)];
        let both = || outputs.iter().zip(self.wanted).map(|(there, own)| (there - middle, own - wanted));
        let scale = match self.space.is_scalable && !self.is_angle(traced) {
            true => both().map(|(a, b)| a * b).sum::<f64>() / both().map(|(a, _)| a * a).sum::<f64>(),
            false => 1.0,
        };
        let mean_square = both().map(|(a, b)| (scale * a - b) * (scale * a - b)).sum::<f64>() / outputs.len() as f64;
        (scale > 0.0 && scale.is_finite()).then_some(Rough { mean_square, scale })
    }

    /// A linkage on a pass from an input; its wanted output at the start is that of the least mean square, if it is not given.
    pub fn begun(&self, values: Vec<f64>, traced: Traced, pass: usize, start_deg: f64) -> Option<LinkageFit> {
        let outputs = self.track.outputs(&traced, pass, start_deg)?;
        let count = outputs.len() as f64;
        let mean = outputs.iter().zip(self.wanted).map(|(there, wanted)| there - wanted).sum::<f64>() / count;
        let start = match self.given[1] {
            Some(given) if self.is_angle(&traced) => given + whole_turns(mean - given),
            Some(given) => given,
            None => mean,
        };
        self.fit(values, traced, pass, [start_deg, start])
    }

    /// The same linkage with what is aimed at now.
    pub fn again(&self, fit: &LinkageFit) -> Option<LinkageFit> {
        self.fit(fit.values.clone(), fit.traced.clone(), fit.pass, fit.starts)
    }

    fn is_angle(&self, traced: &Traced) -> bool {
        traced.linkage.output().is_some_and(|output| !output.is_slider())
    }

    fn fit(&self, values: Vec<f64>, traced: Traced, pass: usize, starts: [f64; 2]) -> Option<LinkageFit> {
        if self.full_turn && !traced.is_full_turn() {
            return None;
        }
        let outputs = self.track.outputs(&traced, pass, starts[0])?;
        let errors: Vec<f64> =
            outputs.iter().zip(self.wanted).map(|(there, wanted)| there - starts[1] - wanted).collect();
        let objective = errors.iter().map(|error| self.residual(*error)[0]).map(|residual| residual * residual).sum();
        Some(LinkageFit { values, traced, pass, starts, errors, objective })
    }

    /// The residual of an error, whose square is its power, and the derivative.
    fn residual(&self, error: f64) -> [f64; 2] {
        let part = error / self.reference;
        if self.power <= 2.0 {
            return [part, 1.0 / self.reference];
        }
        let slope = trig::pow(part.abs(), 0.5 * self.power - 1.0);
        [slope * part, 0.5 * self.power * slope / self.reference]
    }

    /// The starts that move, by their index.
    fn free_starts(&self) -> Vec<usize> {
        (0..2).filter(|k| self.given[*k].is_none()).collect()
    }

    /// The linkage after a motion of the parameters in their units, of the input in radians and of the output in sizes.
    fn moved(&self, fit: &LinkageFit, motion: &[f64], is_small: bool) -> Option<LinkageFit> {
        let count = self.space.dimension();
        let values = self.space.moved(&fit.values, &motion[..count]);
        if !self.space.are_valid(&values) {
            return None;
        }
        let linkage = self.space.template().linkage(&values).ok()?;
        let traced = if is_small { fit.traced.perturbed(linkage)? } else { fit.traced.followed(linkage)? };
        let mut starts = fit.starts;
        for (k, by) in self.free_starts().into_iter().zip(&motion[count..]) {
            starts[k] += if k == 0 { trig::degrees(*by) } else { self.reference_size() * by };
        }
        self.fit(values, traced, fit.pass, starts)
    }

    /// The size of the output in which its start moves.
    fn reference_size(&self) -> f64 {
        let least = self.wanted.iter().copied().fold(f64::INFINITY, f64::min);
        self.wanted.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
    }
}

/// The nearest multiple of a turn.
fn whole_turns(angle: f64) -> f64 {
    std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

impl LinkageFit {
    /// The mean square of the error.
    pub fn mean_square(&self) -> f64 {
        self.errors.iter().map(|error| error * error).sum::<f64>() / self.errors.len() as f64
    }

    /// The greatest magnitude of the error.
    pub fn greatest(&self) -> f64 {
        self.errors.iter().fold(0.0, |most: f64, error| most.max(error.abs()))
    }

    /// The linkage after some steps at most that lessen what is aimed at.
    pub fn refined(mut self, aim: &LinkageAim, steps: usize) -> LinkageFit {
        let mut descent = Descent::default();
        for _ in 0..steps {
            if descent.is_done {
                break;
            }
            descent.step(&mut self, aim);
        }
        self
    }
}

impl Candidate for LinkageFit {
    type Unknowns = Dyn;
    type Aim<'a> = LinkageAim<'a>;

    const NO_GAIN: f64 = 1e-9;

    fn objective(&self) -> f64 {
        self.objective
    }

    fn is_exact(&self, aim: &LinkageAim) -> bool {
        /// Of the error that counts as 1, squared: rounding of poses.
        const ROUNDING: f64 = 1e-22;
        self.objective <= ROUNDING * aim.wanted.len() as f64
    }

    fn equations(&self, aim: &LinkageAim) -> Option<Equations<Dyn>> {
        /// The step of a difference, in the units of a motion.
        const STEP: f64 = 1e-6;
        let count = aim.space.dimension() + aim.free_starts().len();
        let mut columns = Vec::new();
        for place in 0..count {
            let at = |by: f64| {
                let motion: Vec<f64> = (0..count).map(|k| if k == place { by } else { 0.0 }).collect();
                aim.moved(self, &motion, true)
            };
            // At a border of where it can be assembled the difference is one-sided.
            let errors = |fit: Option<LinkageFit>| fit.map(|fit| fit.errors);
            let (before, after, width) = match (errors(at(-STEP)), errors(at(STEP))) {
                (Some(before), Some(after)) => (before, after, 2.0 * STEP),
                (Some(before), None) => (before, self.errors.clone(), STEP),
                (None, Some(after)) => (self.errors.clone(), after, STEP),
                (None, None) => return None,
            };
            columns
                .push(after.iter().zip(&before).map(|(after, before)| (after - before) / width).collect::<Vec<f64>>());
        }
        let mut equations = Equations::new(Dyn(count));
        for (k, error) in self.errors.iter().enumerate() {
            let [residual, slope] = aim.residual(*error);
            let row: Vec<f64> = columns.iter().map(|column| slope * column[k]).collect();
            equations.add(&row, -residual, 1.0);
        }
        Some(equations)
    }

    fn moved(&self, aim: &LinkageAim, motion: &DVector<f64>) -> Option<LinkageFit> {
        aim.moved(self, motion.as_slice(), false)
    }
}
