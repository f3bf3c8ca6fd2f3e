//! What is found for wishes.

use coupler_curves::family::{Family, Sampling};
use coupler_curves::measure::{Measure, MeasureSet};
use coupler_curves::solve::{SolvedCell, Solver};

use super::measured::Meter;
use super::wish::Direction;
use crate::linkage::longest_link;

/// A linkage that meets the wishes, or comes nearest to them.
#[derive(Clone, Debug)]
pub struct DesignAnswer {
    /// A family of this linkage only.
    pub family: Family,
    /// It, solved, with one curve: that whose measures are wished for.
    pub solved: SolvedCell,
    /// The values of the linkage's parameters, in their order.
    pub values: Vec<f64>,
    /// How the wishes are met, in their order.
    pub wishes: Vec<WishValue>,
    /// The goals as they are set in messages and their values, in their order.
    pub goals: Vec<(String, f64)>,
    /// The greatest distance of two joints of a link.
    pub longest_link: f64,
}

/// How a wish is met.
#[derive(Clone, Debug, PartialEq)]
pub struct WishValue {
    /// The wish.
    pub text: String,
    /// What it compares, and its value; `None` of a condition that is no comparison.
    pub value: Option<(String, f64)>,
    /// Whether it is met, to its tolerance.
    pub is_met: bool,
}

/// What one wish would have to be while all others are met.
#[derive(Clone, Debug)]
pub struct DesignMiss {
    /// The number of the wish, from 0.
    pub wish: usize,
    /// The linkage that comes nearest to it and meets the others.
    pub nearest: DesignAnswer,
}

/// The samples of a circuit.
const SAMPLES: usize = 360;

impl DesignAnswer {
    /// The linkage with these values of its parameters and the curve with these numbers of its joint and circuit, from 1.
    pub(super) fn new(meter: &Meter, values: Vec<f64>, [trace, circuit]: [usize; 2]) -> Option<DesignAnswer> {
        let template = meter.space.template();
        let named = template.parameters.iter().map(|parameter| parameter.name.clone()).zip(values.iter().copied());
        let given: Vec<(String, f64)> = named.collect();
        let family = Family::single_cell(template.clone(), &given, Sampling::Samples(SAMPLES)).ok()?;
        let shown = MeasureSet::EMPTY.with(Measure::CLASS).with(Measure::MU_WORST);
        let solved = Solver::new(&family).measuring(meter.wishes.measures() | shown).solve(0)?;
        let curve = solved.curves.iter().find(|curve| [curve.trace, curve.circuit] == [trace, circuit])?;
        let load = |slot: usize| Family::scope_value(&solved.cell, &curve.values, slot);
        let wish = |wish: &super::wish::Wish| WishValue {
            text: wish.text(),
            value: wish.subject().map(|subject| (subject.message_text(), subject.evaluate(load))),
            is_met: wish.is_met(load),
        };
        let wishes = meter.wishes.wishes.iter().map(wish).collect();
        let goal = |goal: &super::wish::Goal| (goal.expression.message_text(), goal.expression.evaluate(load));
        let goals = meter.wishes.goals.iter().map(goal).collect();
        let longest_link = longest_link(&solved.linkage);
        let solved = solved.with_curve(curve);
        Some(DesignAnswer { family, solved, values, wishes, goals, longest_link })
    }

    /// Its worst transmission angle in degrees, if it has one.
    pub fn mu_worst_deg(&self) -> Option<f64> {
        self.solved.curves[0].measure(Measure::MU_WORST)
    }

    /// Whether it meets all wishes.
    pub(super) fn is_met(&self, max_link: f64) -> bool {
        self.longest_link <= max_link && self.wishes.iter().all(|wish| wish.is_met)
    }

    /// Whether another one is as good in all goals and better in one.
    pub(super) fn is_exceeded_by(&self, other: &DesignAnswer, directions: &[Direction]) -> bool {
        let better = |k: usize| {
            let gain = other.goals[k].1 - self.goals[k].1;
            if directions[k] == Direction::Greatest { gain } else { -gain }
        };
        let goals = 0..directions.len();
        goals.clone().all(|k| better(k) >= 0.0) && goals.into_iter().any(|k| better(k) > 0.0)
    }
}
