//! The dimensions of a linkage that a search varies.

use std::sync::Arc;

use super::scaling::is_scalable;
use crate::even_sequence::EvenSequence;
use crate::scatter::Scatter;
use coupler_curves::expression::{self, CompiledExpression, Expression, Kind, Scope, Unit};
use coupler_curves::family::sort_by_dependency;
use coupler_curves::geometry::trig;
use coupler_curves::problem::suggestion;
use coupler_curves::template::{JointKindTemplate, Parameter, ParameterKind, Template};

/// A linkage whose parameters are varied: all but those that are kept, by the search or on request.
///
/// Lengths that must be positive, and other numbers that must, are multiplied; other lengths and numbers are shifted; angles turn. A
/// kept parameter has a value or is computed from the others.
#[derive(Clone, Debug)]
pub struct LinkageSpace {
    pub(super) template: Arc<Template>,
    free: Vec<FreeParameter>,
    /// The numbers by which samples are varied.
    sequence: EvenSequence,
    /// Those that are not varied.
    kept: Vec<usize>,
    /// The values of parameters without an expression.
    base: Vec<f64>,
    /// The expressions of the others in order of computation, with the indices of their parameters.
    expressions: Vec<(usize, CompiledExpression)>,
    /// Whether the linkage is as many times greater if all its free lengths are.
    pub(super) is_scalable: bool,
    /// The length that is the same in all samples, for a linkage of any size.
    held: Option<usize>,
    /// The number of the traced joint, from 0, whose curves alone are compared; `None` for all.
    pub(super) trace: Option<usize>,
}

#[derive(Clone, Copy, Debug)]
struct FreeParameter {
    slot: usize,
    unit: VariationUnit,
}

/// How a parameter is varied.
#[derive(Clone, Copy, Debug)]
pub(crate) enum VariationUnit {
    /// By a factor: the unit is e.
    Factor,
    /// By a shift in units of this many of the parameter's own.
    Shift(f64),
    /// By an angle: the unit is that of a radian.
    Turn(f64),
}

/// Why parameters cannot be kept or varied.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkageSpaceError {
    /// The linkage has no parameter of this name.
    #[error("{linkage} has no parameter `{name}`; {suggestion}")]
    Unknown {
        /// The linkage.
        linkage: String,
        /// The name.
        name: String,
        /// The nearest parameter, or all of them.
        suggestion: String,
    },
    /// A parameter is kept twice.
    #[error("`{name}` is given twice")]
    Repeated {
        /// The name.
        name: String,
    },
    /// A parameter without a default is kept without a value.
    #[error("`{name}` has no default; give its value, as in {name}=2")]
    NoValue {
        /// The name.
        name: String,
    },
    /// The value of a parameter is no expression of the others, or out of bounds.
    #[error("{message}")]
    Value {
        /// The parameter.
        name: String,
        /// What is wrong with it.
        message: String,
    },
    /// Values depend on each other.
    #[error("the values depend on each other, {}; give one of them", cycle.join(" -> "))]
    Cycle {
        /// The names, with the first repeated at the end.
        cycle: Vec<String>,
    },
    /// The linkage traces no joint.
    #[error("{linkage} traces no joint: its `trace` names none, and it has no curve to compare")]
    NoTrace {
        /// The linkage.
        linkage: String,
    },
    /// No parameter is left to vary.
    #[error("{linkage} has no parameter to vary: {why}")]
    NothingFree {
        /// The linkage.
        linkage: String,
        /// Why not.
        why: &'static str,
    },
}

/// The widths of the ranges of the samples, in turn: factors of lengths up to this, shifts and angles up to this part of a typical length and
/// of half a turn.
const WIDTHS: [(f64, f64, f64); 3] = [(1.6, 0.4, 0.35), (2.5, 1.0, 1.0), (4.0, 2.0, 1.0)];

impl LinkageSpace {
    /// The space of a linkage of which some parameters are kept: at an expression of the others, or at their defaults.
    ///
    /// Numbers that must be whole, the ratios of gears, are always kept.
    ///
    /// # Errors
    /// Every name that cannot be kept; or that nothing is left to vary.
    pub fn new(
        template: Arc<Template>,
        kept: &[(String, Option<String>)],
    ) -> Result<LinkageSpace, Vec<LinkageSpaceError>> {
        let linkage = || template.id.clone();
        if template.traced.is_empty() {
            return Err(vec![LinkageSpaceError::NoTrace { linkage: linkage() }]);
        }
        let parameters = &template.parameters;
        let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        let scope = Scope::from_numbers(names.iter().copied());
        let mut errors = Vec::new();
        let mut is_kept = whole_numbers(&template);
        let mut given: Vec<Option<Expression>> = vec![None; names.len()];
        let mut seen = vec![false; names.len()];
        for (name, text) in kept {
            let Some(slot) = scope.index_of(name) else {
                let suggestion = suggestion(name, &names);
                errors.push(LinkageSpaceError::Unknown { linkage: linkage(), name: name.clone(), suggestion });
                continue;
            };
            if std::mem::replace(&mut seen[slot], true) {
                errors.push(LinkageSpaceError::Repeated { name: name.clone() });
            }
            is_kept[slot] = true;
            match text.as_deref().map(|text| parsed(&parameters[slot], text, &scope)) {
                Some(Ok(expression)) => given[slot] = Some(expression),
                Some(Err(error)) => errors.push(error),
                None if parameters[slot].default.is_none() => {
                    errors.push(LinkageSpaceError::NoValue { name: name.clone() });
                }
                None => {}
            }
        }
        let expression = |slot: usize| {
            let own = given[slot].as_ref().or(parameters[slot].default.as_ref())?;
            Some((slot, own.compile(&scope, Kind::Number).ok()?))
        };
        let expressions = sort_by_dependency((0..names.len()).filter_map(expression).collect()).map_err(|cycle| {
            let cycle = cycle.iter().map(|slot| names[*slot].to_owned()).collect();
            vec![LinkageSpaceError::Cycle { cycle }]
        })?;
        let mut base: Vec<f64> = parameters.iter().map(example).collect();
        for (slot, expression) in &expressions {
            base[*slot] = expression.evaluate(|slot| base[slot]);
        }
        let out_of_bounds = (0..names.len()).filter(|slot| is_kept[*slot]);
        errors.extend(
            out_of_bounds
                .filter_map(|slot| Some((names[slot].to_owned(), parameters[slot].value_error(base[slot])?)))
                .map(|(name, message)| LinkageSpaceError::Value { name, message }),
        );
        if !errors.is_empty() {
            return Err(errors);
        }
        let length = typical_length(parameters, &base);
        let free: Vec<FreeParameter> = (0..names.len())
            .filter(|slot| !is_kept[*slot])
            .map(|slot| FreeParameter { slot, unit: unit_of(&parameters[slot], base[slot], length) })
            .collect();
        if free.is_empty() {
            let why = if kept.is_empty() { "it has none but whole numbers" } else { "all are kept" };
            return Err(vec![LinkageSpaceError::NothingFree { linkage: linkage(), why }]);
        }
        let kept = (0..names.len()).filter(|slot| is_kept[*slot]).collect();
        let mut space = LinkageSpace {
            sequence: EvenSequence::new(free.len()),
            free,
            kept,
            base,
            expressions,
            is_scalable: false,
            held: None,
            trace: None,
            template: template.clone(),
        };
        space.is_scalable = is_scalable(&template, &space.base) && space.keeps_scale();
        let is_held = |free: &&FreeParameter| {
            parameters[free.slot].kind == ParameterKind::Length && matches!(free.unit, VariationUnit::Factor)
        };
        space.held = space.free.iter().find(is_held).map(|free| free.slot).filter(|_| space.is_scalable);
        Ok(space)
    }

    /// The same space with the curves of one of its traced joints only; `None` if it is none of them.
    pub fn tracing(mut self, joint: &str) -> Option<LinkageSpace> {
        let is_named = |traced: &usize| self.template.joints[*traced].name == joint;
        self.trace = Some(self.template.traced.iter().position(is_named)?);
        Some(self)
    }

    /// The linkage.
    pub fn template(&self) -> &Arc<Template> {
        &self.template
    }

    /// Whether joints are placed together, by Newton's method. Such a linkage has no transmission angle.
    pub(super) fn is_group(&self) -> bool {
        self.template.structure().is_ok_and(|linkage| linkage.group.is_some())
    }

    /// Whether the linkage is as many times greater if all its free lengths are: its dimensions are then found in the unit of the target.
    pub fn is_scalable(&self) -> bool {
        self.is_scalable
    }

    /// The number of parameters that are varied.
    pub fn dimension(&self) -> usize {
        self.free.len()
    }

    /// The names of the parameters that are varied.
    pub fn free_names(&self) -> impl Iterator<Item = &str> {
        self.free.iter().map(|free| self.template.parameters[free.slot].name.as_str())
    }

    /// Whether kept lengths follow the free ones when these grow.
    fn keeps_scale(&self) -> bool {
        const FACTOR: f64 = 1.7;
        let is_length = |slot: usize| self.template.parameters[slot].kind == ParameterKind::Length;
        let mut scaled = self.base.clone();
        self.free.iter().filter(|free| is_length(free.slot)).for_each(|free| scaled[free.slot] *= FACTOR);
        self.complete(&mut scaled);
        let follows = |slot: &usize| (scaled[*slot] - FACTOR * self.base[*slot]).abs() <= 1e-9 * self.base[*slot].abs();
        self.kept.iter().filter(|slot| is_length(**slot)).all(follows)
    }

    /// The parameters that vary, and how.
    pub(crate) fn free(&self) -> impl Iterator<Item = (usize, VariationUnit)> {
        self.free.iter().map(|free| (free.slot, free.unit))
    }

    /// The length that is the same in all samples, for a linkage of any size.
    pub(crate) fn held(&self) -> Option<usize> {
        self.held
    }

    /// The values that samples vary.
    pub(crate) fn base(&self) -> &[f64] {
        &self.base
    }

    /// Computes the kept parameters from the others.
    fn complete(&self, values: &mut [f64]) {
        self.complete_with(&[], values);
    }

    /// Computes the kept parameters from the others, and further ones that have a default.
    pub(crate) fn complete_with(&self, further: &[usize], values: &mut [f64]) {
        let is_computed = |slot: &usize| self.kept.contains(slot) || further.contains(slot);
        for (slot, expression) in self.expressions.iter().filter(|(slot, _)| is_computed(slot)) {
            values[*slot] = expression.evaluate(|slot| values[slot]);
        }
    }

    /// A parameter set of the sequence, the ranges of which are around the defaults: those that are computed from others around what
    /// follows from these. `None` if one is out of its bounds.
    ///
    /// The numbers are those of an [`EvenSequence`].
    pub(super) fn sample(&self, number: usize) -> Option<Vec<f64>> {
        let (factor, shift, turn) = WIDTHS[number % WIDTHS.len()];
        let part = self.sequence.parts(number / WIDTHS.len());
        let mut values = self.base.clone();
        let vary = |values: &mut [f64], slot: usize| {
            let Some(place) = self.free.iter().position(|free| free.slot == slot && self.held != Some(slot)) else {
                return;
            };
            let part = part(place);
            let centred = 2.0 * part - 1.0;
            let parameter = &self.template.parameters[slot];
            let (value, by) = (values[slot], &mut values[slot]);
            *by = match (self.free[place].unit, parameter.min, parameter.max) {
                (VariationUnit::Factor | VariationUnit::Shift(_), Some(min), Some(max)) => min + (max - min) * part,
                (VariationUnit::Factor, ..) => value * trig::exp(trig::ln(factor) * centred),
                (VariationUnit::Shift(unit), ..) => value + shift * unit * centred,
                (VariationUnit::Turn(unit), ..) => value + turn * std::f64::consts::PI * unit * centred,
            };
            *by = reflected(*by, parameter);
        };
        for slot in (0..values.len()).filter(|slot| self.expressions.iter().all(|(other, _)| other != slot)) {
            vary(&mut values, slot);
        }
        for (slot, expression) in &self.expressions {
            values[*slot] = expression.evaluate(|slot| values[slot]);
            vary(&mut values, *slot);
        }
        self.are_valid(&values).then_some(values)
    }

    /// The values after a motion of the free parameters in their units, within their bounds.
    pub(super) fn moved(&self, values: &[f64], by: &[f64]) -> Vec<f64> {
        /// The greatest step of a logarithm.
        const MOST: f64 = 1.0;
        let mut values = values.to_vec();
        for (FreeParameter { slot, unit }, by) in self.free.iter().zip(by) {
            let parameter = &self.template.parameters[*slot];
            let moved = match unit {
                VariationUnit::Factor => values[*slot] * trig::exp(by.clamp(-MOST, MOST)),
                VariationUnit::Shift(unit) | VariationUnit::Turn(unit) => values[*slot] + unit * by,
            };
            values[*slot] = moved.clamp(
                parameter.min.filter(|min| *min != 0.0).unwrap_or(f64::NEG_INFINITY),
                parameter.max.filter(|max| *max != 0.0).unwrap_or(f64::INFINITY),
            );
        }
        self.complete(&mut values);
        values
    }

    /// Values near others, at random: the spread is that of logarithms and of shifts in their units.
    pub(super) fn near(&self, values: &[f64], scatter: &mut Scatter, spread: f64) -> Vec<f64> {
        let by: Vec<f64> = self.free.iter().map(|_| scatter.normal(spread)).collect();
        self.moved(values, &by)
    }

    /// The values with the free lengths multiplied, if the linkage is as many times greater then.
    pub(super) fn scaled(&self, values: &[f64], factor: f64) -> Vec<f64> {
        super::scaling::scaled_values(&self.template, values, factor)
    }

    /// Whether all values are within their bounds.
    pub(crate) fn are_valid(&self, values: &[f64]) -> bool {
        self.template.parameters.iter().zip(values).all(|(parameter, value)| parameter.value_error(*value).is_none())
    }
}

/// Reads the value of a parameter.
fn parsed(parameter: &Parameter, text: &str, scope: &Scope) -> Result<Expression, LinkageSpaceError> {
    let name = &parameter.name;
    let described = |error: expression::Error| LinkageSpaceError::Value {
        name: name.clone(),
        message: format!("`{name}` = `{text}`: {}", error.message_with_help()),
    };
    let expression = parameter.kind.parse_value(name, text).map_err(described)?;
    expression.compile(scope, Kind::Number).map_err(described)?;
    Ok(expression)
}

/// The parameters of the ratios of gears, which must be whole numbers.
fn whole_numbers(template: &Template) -> Vec<bool> {
    let mut are_whole = vec![false; template.parameters.len()];
    for joint in &template.joints {
        if let JointKindTemplate::Gear { ratio, .. } = &joint.kind {
            ratio.iter().flat_map(CompiledExpression::slots).for_each(|slot| are_whole[*slot] = true);
        }
    }
    are_whole
}

/// A value of a parameter without a default.
fn example(parameter: &Parameter) -> f64 {
    let own = if matches!(parameter.kind, ParameterKind::Angle(_)) { 0.0 } else { 1.0 };
    let value = parameter.example.unwrap_or(own);
    match (parameter.min, parameter.max) {
        _ if parameter.value_error(value).is_none() => value,
        (Some(min), Some(max)) => 0.5 * (min + max),
        (Some(min), None) => min + 1.0,
        (_, Some(max)) => max - 1.0,
        _ => value,
    }
}

/// The geometric mean of the lengths that are positive.
fn typical_length(parameters: &[Parameter], base: &[f64]) -> f64 {
    let lengths = parameters.iter().zip(base).filter(|(parameter, _)| parameter.kind == ParameterKind::Length);
    let logarithms: Vec<f64> =
        lengths.map(|(_, value)| value.abs()).filter(|value| value.is_normal()).map(trig::ln).collect();
    if logarithms.is_empty() { 1.0 } else { trig::exp(logarithms.iter().sum::<f64>() / logarithms.len() as f64) }
}

fn unit_of(parameter: &Parameter, value: f64, length: f64) -> VariationUnit {
    let is_positive = parameter.min.is_some_and(|min| min >= 0.0) && value > 0.0;
    match parameter.kind {
        ParameterKind::Angle(Unit::Rad) => VariationUnit::Turn(1.0),
        ParameterKind::Angle(_) => VariationUnit::Turn(trig::degrees(1.0)),
        _ if is_positive => VariationUnit::Factor,
        ParameterKind::Length => VariationUnit::Shift(length),
        _ => VariationUnit::Shift(value.abs().max(1.0)),
    }
}

/// A value beyond a bound, as far on its other side, where that is within the other bound.
fn reflected(value: f64, parameter: &Parameter) -> f64 {
    match (parameter.min, parameter.max) {
        (Some(min), _) if value < min => 2.0 * min - value,
        (_, Some(max)) if value > max => 2.0 * max - value,
        _ => value,
    }
}
