//! By how much the output of a linkage differs from the wanted one: where most, on average, and where not at all.

use super::generator::Generator;
use super::target::FunctionTarget;
use coupler_curves::numerical::{Bracket, maximum};

/// The structural error: the output less the wanted one, in radians or as a length.
#[derive(Clone, Debug, PartialEq)]
pub struct StructuralError {
    /// The error of the greatest magnitude, with its sign.
    pub greatest: f64,
    /// The travel of the input there, in radians.
    pub at: f64,
    /// The root of the mean of its square over the range of the input, or over the rows.
    pub rms: f64,
    /// The travels of the input at which it is zero within the range, where it is known over a range.
    pub zeros: Vec<f64>,
}

/// In how many equal parts of the input extremes and zeros are looked for, at least as many as a law is read at.
const PARTS: usize = 720;

/// A local extreme of the error, or its value at an end: the travel, and the error.
pub(super) type Extreme = [f64; 2];

/// The error of a linkage along the whole function.
pub(super) struct ErrorCurve<'a> {
    linkage: &'a Generator,
    target: &'a FunctionTarget,
    turns: f64,
}

impl<'a> ErrorCurve<'a> {
    /// That of a linkage whose output is to be nearest to the wanted one, of whole turns, at a point. `None` where it cannot be assembled.
    pub fn new(linkage: &'a Generator, target: &'a FunctionTarget, point: [f64; 2]) -> Option<ErrorCurve<'a>> {
        Some(ErrorCurve { linkage, target, turns: linkage.turns_at(point)? })
    }

    /// The error at a travel of the input with a wanted output; not a number where the linkage cannot be assembled.
    fn against(&self, travel: f64, wanted: f64) -> f64 {
        let [input, output] = self.linkage.starts;
        self.linkage.output(input + travel).map_or(f64::NAN, |there| there + self.turns - output - wanted)
    }

    /// The errors at all rows, or the local extremes of the error over the range with its values at the ends.
    pub fn extremes(&self) -> Vec<Extreme> {
        let Some(law) = self.target.as_law() else {
            return self.target.samples().into_iter().map(|[x, y]| [x, self.against(x, y)]).collect();
        };
        let error = |travel: f64| self.against(travel, law.wanted(travel));
        let at = |k: usize| law.travel() * k as f64 / PARTS as f64;
        let values: Vec<f64> = (0..=PARTS).map(|k| error(at(k))).collect();
        let mut found = vec![[0.0, values[0]]];
        for k in 1..PARTS {
            for sign in [1.0, -1.0] {
                let [before, here, after] = [k - 1, k, k + 1].map(|k| sign * values[k]);
                if here > before && here >= after {
                    let accuracy = 1e-9 * law.travel().abs();
                    let best = maximum([at(k - 1), at(k + 1)], accuracy, |travel| sign * error(travel));
                    let inner = if best.value > here { [best.place, sign * best.value] } else { [at(k), values[k]] };
                    found.push(inner);
                }
            }
        }
        found.push([law.travel(), values[PARTS]]);
        found
    }

    /// Its measure; not finite where the linkage cannot be assembled somewhere.
    pub fn measure(&self) -> StructuralError {
        let greater = |a: Extreme, b: Extreme| if b[1].abs() > a[1].abs() || b[1].is_nan() { b } else { a };
        let [at, greatest] = self.extremes().into_iter().reduce(greater).unwrap_or([0.0, f64::NAN]);
        let Some(law) = self.target.as_law() else {
            let errors: Vec<f64> = self.target.samples().iter().map(|[x, y]| self.against(*x, *y)).collect();
            let mean = errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64;
            return StructuralError { greatest, at, rms: mean.sqrt(), zeros: Vec::new() };
        };
        let error = |travel: f64| self.against(travel, law.wanted(travel));
        let travel = |k: usize| law.travel() * k as f64 / PARTS as f64;
        let values: Vec<f64> = (0..=PARTS).map(|k| error(travel(k))).collect();
        // Simpson's rule: the number of parts is even.
        let weight = |k: usize| match k {
            0 | PARTS => 1.0,
            _ if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let sum: f64 = values.iter().enumerate().map(|(k, value)| weight(k) * value * value).sum();
        let zero = |k: usize| {
            let bracket = Bracket::new([travel(k), travel(k + 1)], [values[k], values[k + 1]])?;
            Some(bracket.zero(1e-12 * law.travel().abs(), error))
        };
        /// In sizes of the output: errors that are rounding change their signs anywhere.
        const ROUNDING: f64 = 1e-12;
        let is_rounding = greatest.abs() <= ROUNDING * self.target.size();
        let zeros = if is_rounding { Vec::new() } else { (0..PARTS).filter_map(zero).collect() };
        StructuralError { greatest, at, rms: (sum / (3.0 * PARTS as f64)).sqrt(), zeros }
    }
}
