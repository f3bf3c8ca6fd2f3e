//! The longest portion near a given one that does not exceed what is permitted.
//!
//! A portion is given by its middle and half its span. Around each middle there is one span at which what is permitted
//! is just used up, found by Newton's method; how its size changes with the middle follows from the rates of both. The
//! middle is then moved to where the size is greatest: where its rate is zero, or, where the points change that bound
//! the portion, where the rate jumps from positive to negative.

use crate::measure::budget::TooManySteps;

/// The excess that is as good as none. What is permitted is less by as much than what is promised.
pub const ACCURACY: f64 = 1e-9;

/// How a portion compares with what is permitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// By what part it exceeds what is permitted; negative if it fits.
    pub excess: Constraint,
    /// What is to be greatest.
    pub size: f64,
    /// The derivatives of the size with respect to the start and the end.
    pub size_rates: [f64; 2],
    /// Which points bound the portion: where these are the same, the rates are continuous.
    pub contacts: Contacts,
    /// What may be the excess nearby, bounded by other points.
    pub others: Constraints,
}

/// The points that bound a portion: the start is the least number, the end the greatest, and of those between the
/// numbers say which.
pub type Contacts = [i64; 4];

/// A few constraints.
pub type Constraints = [Option<Constraint>; 8];

/// A value and its derivatives with respect to the start and the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    pub value: f64,
    pub rates: [f64; 2],
}

/// A portion that just fits around a middle.
#[derive(Clone, Copy, Debug)]
struct Fitting {
    middle: f64,
    half: f64,
    size: f64,
    /// The derivatives of the size and of half the span with respect to the middle.
    slope: f64,
    half_slope: f64,
    /// Whether it fits less if either end moves outwards.
    is_held: bool,
    contacts: Contacts,
}

impl Fitting {
    /// About half the span that just fits around another middle.
    fn half_at(&self, middle: f64) -> f64 {
        let half = self.half + self.half_slope * (middle - self.middle);
        half.clamp(0.5 * self.half, 2.0 * self.half)
    }
}

/// Where portions may be.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The first position.
    pub low: f64,
    /// The last position.
    pub high: f64,
    /// The greatest span.
    pub span: f64,
}

/// How the points are found that bound a portion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touching {
    /// Near those of the portion before, if these still do.
    Next,
    /// In the whole portion.
    Anew,
}

/// What is reached from a portion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reached {
    /// The longest, certainly or not.
    Longest { size: f64, ends: [f64; 2], is_certain: bool },
    /// One that is not the longest; the longest is shorter than what was asked for, and no longer than `bound`.
    Shorter { ends: [f64; 2], bound: f64 },
    /// No portion that fits.
    Nothing,
}

/// The search for the portion of the greatest size near a given one.
pub struct LongestNear<F> {
    /// Where portions may be.
    pub limits: Limits,
    /// Compares the portion between two positions with what is permitted, by points found as [`Touching`] says; fails if that would
    /// be one step too many.
    pub fit: F,
    /// How far the ends need be moved: what is further away is reached from elsewhere.
    pub reach: f64,
}

impl<F: FnMut([f64; 2], Touching) -> Result<Fit, TooManySteps>> LongestNear<F> {
    /// The longest portion that fits and is reached from a given one along ever longer ones; nothing after too many steps.
    pub fn search(&mut self, ends: [f64; 2], least: f64) -> Reached {
        const ROUNDS: usize = 4;
        let (mut ends, mut reached) = (ends, Reached::Nothing);
        for _ in 0..ROUNDS {
            reached = match self.ascend(ends, least) {
                Ok(near) => self.climb(near, least),
                Err(reached) => reached,
            };
            let Reached::Longest { ends: found, is_certain, .. } = reached else { break };
            // Where an end could be moved outwards so that the portion fits better, it is not the longest.
            if is_certain && self.is_confirmed(found) {
                break;
            }
            ends = found;
        }
        reached
    }

    /// Whether the points that bound a portion, found anew, permit as much as those that were followed to it.
    fn is_confirmed(&mut self, ends: [f64; 2]) -> bool {
        /// What it fits too well is nothing to its size.
        const SLACK: f64 = 1e-7;
        (self.fit)(ends, Touching::Anew).is_ok_and(|fit| (-SLACK..=ACCURACY).contains(&fit.excess.value))
    }

    /// The longest portion that fits near one that nearly is it.
    fn climb(&mut self, [from, to]: [f64; 2], least: f64) -> Reached {
        /// The first step of the middle, relative to half the span.
        const FIRST_STEP: f64 = 1.0 / 64.0;
        const LONGEST_STEP: f64 = 1.0 / 8.0;
        const ROUNDS: usize = 60;
        /// An excess that is corrected for to the first order.
        const ROUGH: f64 = 1e-6;
        let Some(mut low) = self.fitting((from + to) / 2.0, (to - from) / 2.0, ROUGH) else {
            return Reached::Nothing;
        };
        let mut step = FIRST_STEP * low.half * if low.slope < 0.0 { -1.0 } else { 1.0 };
        // Upwards, until the slope has changed its sign or the size decreases.
        let (mut end, mut high) = loop {
            let bound = low.size + (low.slope * self.reach).abs();
            if bound < least {
                return Reached::Shorter { ends: self.ends(low.middle, low.half), bound };
            }
            let middle = (low.middle + step).clamp(self.limits.low, self.limits.high);
            if low.slope == 0.0 || middle == low.middle {
                return self.exactly(low);
            }
            match self.fitting(middle, low.half_at(middle), ROUGH) {
                Some(next) if next.slope * step > 0.0 && next.size >= low.size => low = next,
                next => break (middle, next),
            }
            step = (2.0 * step).clamp(-LONGEST_STEP * low.half, LONGEST_STEP * low.half);
        };
        let mut best = low;
        // The weights of both slopes: that of an end that stays is halved (the Illinois method).
        let mut weights = [1.0; 2];
        for _ in 0..ROUNDS {
            if let Some(high) = high
                && high.size > best.size
            {
                best = high;
            }
            let distance = end - low.middle;
            if distance.abs() <= 1e-12 * best.half {
                break;
            }
            let mut part = 0.5;
            if let Some(high) = high.filter(|high| high.slope * distance < 0.0) {
                // Where the tangents meet: the size is no greater if it is concave.
                part = (high.size - low.size - high.slope * distance) / ((low.slope - high.slope) * distance);
                let bound = low.size + low.slope * distance * part.clamp(0.0, 1.0);
                if bound < least {
                    return Reached::Shorter { ends: self.ends(best.middle, best.half), bound };
                }
                if bound <= best.size * (1.0 + 1e-12) {
                    break;
                }
                if is_same(high.contacts, low.contacts) {
                    let [s, t] = [weights[0] * low.slope, weights[1] * high.slope];
                    part = s / (s - t);
                }
            }
            let part = if part > 1e-6 && part < 1.0 - 1e-6 { part } else { 0.5 };
            let middle = low.middle + part * distance;
            match self.fitting(middle, low.half_at(middle), ROUGH) {
                Some(next) if next.slope * distance > 0.0 && next.size >= low.size => {
                    low = next;
                    weights = [1.0, weights[1] / 2.0];
                    if next.size > best.size {
                        best = next;
                    }
                }
                next => {
                    (end, high) = (middle, next);
                    weights = [weights[0] / 2.0, 1.0];
                }
            }
        }
        self.exactly(best)
    }

    /// The portion around the middle of another that fits to the accuracy.
    fn exactly(&mut self, Fitting { middle, half, .. }: Fitting) -> Reached {
        match self.fitting(middle, half, ACCURACY) {
            Some(Fitting { half, size, is_held, .. }) => {
                Reached::Longest { size, ends: self.ends(middle, half), is_certain: is_held }
            }
            None => Reached::Nothing,
        }
    }

    /// The ends of a portion, moved until it fits and is nearly the longest, in steps to where the size is greatest if
    /// all is linear, no longer than this may be relied on.
    ///
    /// # Errors
    /// What is reached, if it is the longest exactly, as where several points bound it, or if it is known to be shorter
    /// than `least`.
    fn ascend(&mut self, mut ends: [f64; 2], least: f64) -> Result<[f64; 2], Reached> {
        const ROUNDS: usize = 40;
        /// The part of the size that is worth as much as that part in excess: more than the size gains by it.
        const PENALTY: f64 = 4.0;
        /// What is linear does not err by more, relative to the size, within the reach.
        const LINEAR: f64 = 0.1;
        let span = ends[1] - ends[0];
        let mut reach = (0.1 * span).min(self.reach);
        let Ok(mut here) = (self.fit)(ends, Touching::Next) else { return Err(Reached::Nothing) };
        let value = |fit: &Fit| fit.size * (1.0 - PENALTY * fit.excess.value.max(0.0));
        // What bounded portions that were tried in vain: more than can be told from one point.
        let mut cuts: Vec<([f64; 2], Constraint)> = Vec::new();
        for round in 0..ROUNDS {
            let cut = |(at, cut): &([f64; 2], Constraint)| Constraint {
                value: cut.value + cut.rates[0] * (ends[0] - at[0]) + cut.rates[1] * (ends[1] - at[1]),
                ..*cut
            };
            let constraints = here.others.iter().flatten().copied().chain([here.excess]).chain(cuts.iter().map(cut));
            let low = [(self.limits.low - ends[0]).max(-reach), -reach];
            let high = [reach, (self.limits.high - ends[1]).min(reach)];
            let step = linear_step(constraints, &here, [low, high]);
            let gain = step[0] * here.size_rates[0] + step[1] * here.size_rates[1];
            let fits = here.excess.value <= ACCURACY;
            if fits && gain <= 1e-12 * here.size && !cuts.is_empty() {
                // What was cut off may have been too much.
                cuts.clear();
                reach = reach.min(0.01 * span);
                continue;
            }
            if fits && gain <= 1e-12 * here.size {
                return Err(Reached::Longest { size: here.size, ends, is_certain: true });
            }
            let bound = (here.size + gain) * (1.0 + LINEAR);
            if round == 0 && bound < least {
                return Err(Reached::Shorter { ends, bound });
            }
            let is_bounded = step.iter().any(|step| step.abs() >= 0.999 * reach);
            if reach < 1e-7 * span || (is_bounded && reach < 0.01 * span && here.excess.value <= 1e-3) {
                break;
            }
            let next_ends = [ends[0] + step[0], ends[1] + step[1]];
            if !(0.0..=self.limits.span).contains(&(next_ends[1] - next_ends[0])) {
                break;
            }
            let Ok(next) = (self.fit)(next_ends, Touching::Next) else { return Err(Reached::Nothing) };
            if value(&next) > value(&here) {
                (ends, here) = (next_ends, next);
                reach = (2.0 * reach).min(0.1 * (ends[1] - ends[0]));
            } else {
                const KEPT: usize = 3;
                if cuts.len() == KEPT {
                    cuts.remove(0);
                }
                cuts.push((next_ends, next.excess));
                reach /= 3.0;
            }
        }
        Ok(ends)
    }

    /// The ends of the portion around a middle; at the limits it is shorter.
    fn ends(&self, middle: f64, half: f64) -> [f64; 2] {
        [(middle - half).max(self.limits.low), (middle + half).min(self.limits.high)]
    }

    /// The portion around a middle that just fits, searched for from a guess of half its span.
    fn fitting(&mut self, middle: f64, guess: f64, accuracy: f64) -> Option<Fitting> {
        const ROUNDS: usize = 60;
        /// A portion this much shorter than the guess is another one.
        const LEAST: f64 = 0.2;
        let Limits { low, high, span } = self.limits;
        // A portion that ends at both limits is as long as there is.
        let most = (span / 2.0).min((middle - low).max(high - middle));
        let mut half = guess.min(most);
        let (mut fits, mut exceeds): (Option<f64>, Option<f64>) = (None, None);
        for _ in 0..ROUNDS {
            let ends = self.ends(middle, half);
            let fit = (self.fit)(ends, Touching::Next).ok()?;
            // An end at a limit does not move.
            let moves = [middle - half > low, middle + half < high].map(|moves| if moves { 1.0 } else { 0.0 });
            let rates = |[start, end]: [f64; 2]| {
                let [start, end] = [start * moves[0], end * moves[1]];
                // With respect to half the span, and to the middle.
                [end - start, end + start]
            };
            let [by_half, by_middle] = rates(fit.excess.rates);
            let is_whole = half >= most && fit.excess.value <= 0.0;
            if is_whole || fit.excess.value.abs() <= accuracy {
                let [size_by_half, size_by_middle] = rates(fit.size_rates);
                // What is left of the excess is taken off; what that neglects is its square.
                let (by_middle, rest) =
                    if is_whole { (0.0, 0.0) } else { (by_middle / by_half, fit.excess.value / by_half) };
                let slope = size_by_middle - if is_whole { 0.0 } else { size_by_half * by_middle };
                if !slope.is_finite() {
                    return None;
                }
                let (half, size) = (half - rest, fit.size - size_by_half * rest);
                let is_held = fit.excess.rates[0] * moves[0] <= 0.0 && fit.excess.rates[1] * moves[1] >= 0.0;
                let half_slope = -by_middle;
                return Some(Fitting { middle, half, size, slope, half_slope, is_held, contacts: fit.contacts });
            }
            if fit.excess.value <= 0.0 {
                fits = Some(half);
            } else {
                exceeds = Some(half);
            }
            let newton = half - fit.excess.value / by_half;
            half = match (fits, exceeds) {
                (Some(a), Some(b)) if newton > a.min(b) && newton < a.max(b) => newton,
                (Some(a), Some(b)) => (a + b) / 2.0,
                (_, None) if newton > half => newton.min(1.25 * half).min(most),
                (_, None) => (1.1 * half).min(most),
                (None, _) if newton < half => newton.max(0.8 * half),
                (None, _) => 0.9 * half,
            };
            if half < LEAST * guess || !half.is_finite() {
                return None;
            }
        }
        None
    }
}

/// Whether two portions are bounded by the same points; those between the ends move a little with the ends.
fn is_same(a: Contacts, b: Contacts) -> bool {
    const CLOSE: u64 = 2;
    a.iter().zip(&b).all(|(a, b)| a.abs_diff(*b) <= CLOSE)
}

/// The change of both ends between two bounds with the greatest gain in size if all is linear, or if what is permitted
/// is exceeded anyway, with the least excess.
fn linear_step(constraints: impl Iterator<Item = Constraint>, fit: &Fit, [low, high]: [[f64; 2]; 2]) -> [f64; 2] {
    // What cannot be reached between the bounds does not count.
    let most = |c: &Constraint| (0..2).map(|k| (c.rates[k] * low[k]).max(c.rates[k] * high[k])).sum::<f64>() + c.value;
    let constraints: Vec<Constraint> = constraints.filter(|c| most(c) > 0.0).collect();
    // The greatest is at a corner: where two of the lines that bound the changes cross.
    let mut lines: Vec<([f64; 2], f64)> = Vec::with_capacity(constraints.len() + 4);
    lines.extend(constraints.iter().map(|c| (c.rates, -c.value)));
    for k in 0..2 {
        let mut axis = [0.0; 2];
        axis[k] = 1.0;
        lines.extend([(axis, low[k]), (axis, high[k])]);
    }
    let mut best: Option<((f64, f64), [f64; 2])> = None;
    for (i, &([a, b], c)) in lines.iter().enumerate() {
        for &([d, e], f) in &lines[i + 1..] {
            let determinant = a * e - b * d;
            let x = [(c * e - b * f) / determinant, (a * f - c * d) / determinant];
            let slack = 1e-9 * (high[0] - low[0]);
            if !(0..2).all(|k| x[k] >= low[k] - slack && x[k] <= high[k] + slack) {
                continue;
            }
            let gain = fit.size_rates[0] * x[0] + fit.size_rates[1] * x[1];
            if best.is_some_and(|((excess, loss), _)| excess == 0.0 && -gain >= loss) {
                continue;
            }
            let excess = constraints.iter().map(|c| c.value + c.rates[0] * x[0] + c.rates[1] * x[1]);
            let excess = excess.fold(0.0, f64::max);
            let rank = (if excess <= ACCURACY / 16.0 { 0.0 } else { excess }, -gain);
            if best.is_none_or(|(least, _)| rank < least) {
                best = Some((rank, x));
            }
        }
    }
    best.map_or([0.0; 2], |(_, step)| step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::budget::Steps;

    /// A portion of a span of 2 that is the larger the further on it begins, without an end.
    #[test]
    fn a_search_without_an_end_takes_no_more_steps_than_it_may() {
        for most in [0, 10, 1000] {
            let (steps, mut count) = (Steps::new(most), 0);
            let fit = |ends: [f64; 2], _: Touching| {
                steps.take(1)?;
                count += 1;
                let excess = Constraint { value: ends[1] - ends[0] - 2.0, rates: [-1.0, 1.0] };
                let (contacts, others) = (Contacts::default(), Constraints::default());
                Ok(Fit { excess, size: ends[0] + ends[1], size_rates: [1.0, 1.0], contacts, others })
            };
            let limits = Limits { low: f64::NEG_INFINITY, high: f64::INFINITY, span: 100.0 };
            let reached = LongestNear { limits, fit, reach: 1.0 }.search([0.0, 2.0], 0.0);
            assert_eq!((reached, count), (Reached::Nothing, most));
            assert_eq!(steps.check(), Err(TooManySteps));
        }
    }
}
