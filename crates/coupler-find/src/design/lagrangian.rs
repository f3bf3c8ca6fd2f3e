//! The augmented Lagrangian of constraints (Hestenes, Powell, Rockafellar), as Atamna, Auger and Hansen adapt it to an evolution strategy
//! ("Augmented Lagrangian constraint handling for CMA-ES", PPSN 2016).

use coupler_curves::geometry::trig;

/// A value of a constraint: what is to be 0, or at most 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Constraint {
    pub value: f64,
    pub is_equality: bool,
}

/// The multiplier and the penalty of each constraint.
#[derive(Clone, Debug)]
pub(super) struct Lagrangian {
    multipliers: Vec<f64>,
    penalties: Vec<f64>,
    dimension: f64,
    /// The objective with its penalties and the constraints at the last middle.
    last: Option<(f64, Vec<f64>)>,
}

impl Lagrangian {
    pub fn new(constraints: usize, dimension: usize) -> Lagrangian {
        Lagrangian {
            multipliers: vec![0.0; constraints],
            penalties: vec![1.0; constraints],
            dimension: dimension as f64,
            last: None,
        }
    }

    /// The objective with what the constraints add to it.
    pub fn value(&self, objective: f64, constraints: &[Constraint]) -> f64 {
        let of = |(Constraint { value, is_equality }, (multiplier, penalty)): (&Constraint, (&f64, &f64))| {
            let inactive = -multiplier / penalty;
            let value = if *is_equality { *value } else { value.max(inactive) };
            multiplier * value + 0.5 * penalty * value * value
        };
        let added: f64 = constraints.iter().zip(self.multipliers.iter().zip(&self.penalties)).map(of).sum();
        objective + added
    }

    /// Adapts multipliers and penalties to the objective and the constraints in the middle of a generation.
    pub fn adapt(&mut self, objective: f64, constraints: &[Constraint]) {
        /// The constants of the paper: k1, k2, and the factor of which a root of the dimension is taken.
        const K1: f64 = 3.0;
        const K2: f64 = 5.0;
        const CHI: f64 = 2.0;
        /// A multiplier takes a part of what the penalty holds, so that it does not oscillate.
        const DAMPING: f64 = 5.0;
        const MOST: f64 = 1e12;
        let value = self.value(objective, constraints);
        if !value.is_finite() {
            return;
        }
        if let Some((last, previous)) = &self.last {
            let more = trig::exp(trig::ln(CHI) / (4.0 * self.dimension));
            for (k, constraint) in constraints.iter().enumerate() {
                let is_active =
                    constraint.is_equality || self.multipliers[k] + self.penalties[k] * constraint.value >= 0.0;
                if !is_active {
                    continue;
                }
                let (here, change) = (constraint.value, (constraint.value - previous[k]).abs());
                let is_weak = self.penalties[k] * here * here < K1 * (value - last).abs() / self.dimension
                    || K2 * change < previous[k].abs();
                self.penalties[k] =
                    (self.penalties[k] * if is_weak { more } else { 1.0 / more.sqrt().sqrt() }).min(MOST);
            }
        }
        for (k, constraint) in constraints.iter().enumerate() {
            let multiplier = self.multipliers[k] + self.penalties[k] * constraint.value / DAMPING;
            self.multipliers[k] =
                if constraint.is_equality { multiplier } else { multiplier.max(0.0) }.clamp(-MOST, MOST);
        }
        self.last = Some((self.value(objective, constraints), constraints.iter().map(|c| c.value).collect()));
    }
}

#[cfg(test)]
mod tests {
    use super::super::evolution::Evolution;
    use super::*;

    /// The objective and the constraints at a place.
    type Problem = fn(&[f64]) -> (f64, Vec<Constraint>);

    #[test]
    fn a_strategy_finds_the_least_value_under_constraints() {
        // The point of the line x + y = 1 in the half-plane y >= 0.8 that is nearest to the origin, and the greatest of the smaller of two
        // coordinates on the unit circle.
        let nearest: Problem = |p| {
            let constraints = vec![
                Constraint { value: p[0] + p[1] - 1.0, is_equality: true },
                Constraint { value: 0.8 - p[1], is_equality: false },
            ];
            (p[0] * p[0] + p[1] * p[1], constraints)
        };
        let corner: Problem =
            |p| (-p[0].min(p[1]), vec![Constraint { value: p[0] * p[0] + p[1] * p[1] - 1.0, is_equality: true }]);
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let least = |f: Problem, count: usize| {
            let mut evolution = Evolution::new(&[0.3, 0.1], 0.3, 7);
            let mut lagrangian = Lagrangian::new(count, 2);
            for _ in 0..800 {
                let generation = evolution.generation();
                let value = |place: &Vec<f64>| {
                    let (objective, constraints) = f(place);
                    lagrangian.value(objective, &constraints)
                };
                let values: Vec<f64> = generation.places.iter().map(value).collect();
                evolution.advance(&generation, &values);
                let (objective, constraints) = f(evolution.mean());
                lagrangian.adapt(objective, &constraints);
            }
            evolution.mean().to_vec()
        };
        for (found, expected) in [(least(nearest, 2), [0.2, 0.8]), (least(corner, 1), [half, half])] {
            let off = (found[0] - expected[0]).abs() + (found[1] - expected[1]).abs();
            assert!(off < 1e-4, "{found:?}, expected {expected:?}");
        }
    }
}
