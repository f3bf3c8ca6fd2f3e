//! How good a linkage is: by how much it violates the wishes, and its goals, in units in which they are of one size.

use super::assessment::Assessment;
use super::lagrangian::Constraint;
use super::wish::{Wish, Wishes};

/// What a missing value counts as, in units of its wish or goal.
const MISSING: f64 = 10.0;

/// Bounds are aimed at with this margin, in units of their wish, so that they hold in the end.
const MARGIN: f64 = 1e-9;

/// The sizes of differences, by which wishes and goals are compared.
#[derive(Clone, Debug)]
pub(super) struct Units {
    wishes: Vec<f64>,
    goals: Vec<f64>,
    max_link: f64,
    are_equal: Vec<bool>,
}

/// What is to be least of the goals.
#[derive(Clone, Debug)]
pub(super) enum Objective {
    /// None of them.
    Nothing,
    /// A goal.
    Goal(usize),
    /// By how much a wish is not met, which is no constraint then.
    Wish(usize),
    /// The greatest of the goals above their least values, by weight (the achievement function of Wierzbicki).
    Weighted { weights: Vec<f64>, least: Vec<f64> },
}

impl Units {
    /// Those before anything is measured: the size of the number that is wished.
    pub fn plain(wishes: &Wishes) -> Units {
        let of_wish = |wish: &Wish| wish.bound().map_or(1.0, f64::abs);
        let usable = |unit: f64| if unit.is_normal() { unit } else { 1.0 };
        Units {
            wishes: wishes.wishes.iter().map(of_wish).map(usable).collect(),
            goals: vec![1.0; wishes.goals.len()],
            max_link: if wishes.max_link.is_finite() { wishes.max_link } else { 1.0 },
            are_equal: wishes.wishes.iter().map(|wish| wish.is_equality()).collect(),
        }
    }

    /// Those of samples: the median of the differences of each wish, and the middle half of the values of a goal.
    ///
    /// Where the size of the linkage is chosen for each sample, differences of lengths are small, and much smaller units would hold the
    /// linkage to those wishes so closely that it could hardly move: they are a part of the number that is wished at least.
    pub fn of_samples(wishes: &Wishes, samples: &[Assessment]) -> Units {
        const PART_OF_BOUND: f64 = 0.1;
        let sorted = |values: &dyn Fn(&Assessment) -> f64| {
            let mut values: Vec<f64> = samples.iter().map(values).filter(|value| value.is_finite()).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let usable = |unit: f64| if unit.is_normal() { unit } else { 1.0 };
        let median = |k: usize| {
            let sizes = sorted(&|sample| sample.excesses[k].abs());
            let least = PART_OF_BOUND * wishes.wishes[k].bound().map_or(0.0, f64::abs);
            usable(sizes.get(sizes.len() / 2).copied().unwrap_or(1.0).max(least))
        };
        let spread = |k: usize| {
            let values = sorted(&|sample| sample.goals[k]);
            let at = |part: usize| values.get(part * values.len() / 4).copied().unwrap_or(0.0);
            usable(at(3) - at(1))
        };
        Units {
            wishes: (0..wishes.wishes.len()).map(median).collect(),
            goals: (0..wishes.goals.len()).map(spread).collect(),
            ..Units::plain(wishes)
        }
    }

    /// The square of the violation of a wish.
    pub fn violation_of(&self, wish: usize, excess: f64, is_equality: bool) -> f64 {
        let value = self.scaled(wish, excess);
        let violation = if is_equality { value.abs() } else { value.max(0.0) };
        violation * violation
    }

    fn scaled(&self, wish: usize, excess: f64) -> f64 {
        let value = excess / self.wishes[wish];
        if value.is_nan() { MISSING } else { value }
    }

    /// What is to be 0, or at most 0: each wish and the length of links.
    pub fn constraints(&self, assessment: &Assessment, objective: &Objective) -> Vec<Constraint> {
        let of_wish = |k: usize| {
            let value = self.scaled(k, assessment.excesses[k]);
            let is_equality = self.are_equal[k];
            Constraint { value: if is_equality { value } else { value + MARGIN }, is_equality }
        };
        let is_constraint = |k: &usize| !matches!(objective, Objective::Wish(dropped) if dropped == k);
        let wishes = (0..assessment.excesses.len()).filter(is_constraint).map(of_wish);
        let link = assessment.link_excess / self.max_link;
        let link = link.is_finite().then_some(Constraint { value: link + MARGIN, is_equality: false });
        wishes.chain(link).collect()
    }

    /// By how much constraints are violated: the root of the sum of the squares.
    pub fn violation(&self, assessment: &Assessment, objective: &Objective) -> f64 {
        let of = |Constraint { value, is_equality }: &Constraint| {
            if *is_equality { value.abs() } else { (value - MARGIN).max(0.0) }
        };
        let constraints = self.constraints(assessment, objective);
        constraints.iter().map(of).map(|violation| violation * violation).sum::<f64>().sqrt()
    }

    /// The objective of a linkage.
    pub fn objective(&self, assessment: &Assessment, objective: &Objective) -> f64 {
        /// The part of the sum of goals, so that none is given away.
        const PART_OF_SUM: f64 = 0.01;
        let known = |value: f64| if value.is_nan() { MISSING } else { value };
        match objective {
            Objective::Nothing => 0.0,
            Objective::Goal(k) => known(assessment.goals[*k] / self.goals[*k]),
            Objective::Wish(k) => {
                let value = self.scaled(*k, assessment.excesses[*k]);
                // What meets the wish is as good as can be.
                if self.are_equal[*k] { value.abs() } else { value.max(0.0) }
            }
            Objective::Weighted { weights, least } => {
                let above = assessment.goals.iter().zip(least).zip(&self.goals).zip(weights);
                let above: Vec<f64> =
                    above.map(|(((goal, least), unit), weight)| weight * known((goal - least) / unit)).collect();
                above.iter().copied().fold(f64::NEG_INFINITY, f64::max) + PART_OF_SUM * above.iter().sum::<f64>()
            }
        }
    }
}
