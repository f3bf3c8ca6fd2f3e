//! The dimensions of a linkage that a design varies, and their ranges.

use std::sync::Arc;

use coupler_curves::expression::{Kind, Scope};
use coupler_curves::geometry::trig;
use coupler_curves::problem::suggestion;
use coupler_curves::template::{Parameter, ParameterKind, Template};

use super::axes::{Axis, Range};
use crate::even_sequence::EvenSequence;
use crate::linkage::{LinkageSpace, LinkageSpaceError, VariationUnit, scaled_values};

/// The parameters of a linkage that vary, each within a range.
///
/// A linkage whose dimensions all scale, and none of whose lengths has a range or a value, is searched in any size.
#[derive(Clone, Debug)]
pub struct DesignSpace {
    pub(super) space: LinkageSpace,
    pub(super) axes: Vec<Axis>,
    sequence: EvenSequence,
    /// Whether the size of the linkage is one of the unknowns.
    pub(super) is_scaled: bool,
    /// Parameters that could vary and keep their default, as they change nothing that is wished for.
    idle: Vec<usize>,
}

/// A range that is asked for, as in `r = 20..60 by 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeRequest {
    /// The parameter.
    pub name: String,
    /// Its least and greatest value and their step, as in `20..60 by 1`.
    pub text: String,
}

/// Why the dimensions of a linkage cannot be searched.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DesignSpaceError {
    /// A parameter cannot be kept or varied.
    #[error(transparent)]
    Parameter(#[from] LinkageSpaceError),
    /// A range is none of a parameter that varies.
    #[error("`{name} = {text}`: {message}")]
    Range {
        /// The parameter.
        name: String,
        /// The range.
        text: String,
        /// What is wrong with it.
        message: String,
    },
    /// A parameter has neither a default nor bounds, from which its range could follow.
    #[error(
        "`{name}` has no default and no bounds, from which a range would follow; give a range, as in {name} = 1..5, or a value"
    )]
    NoRange {
        /// The parameter.
        name: String,
    },
}

/// The factors of the default value between which a positive parameter varies by default, and the typical lengths by which others do.
const FACTOR: f64 = 4.0;
const SHIFT: f64 = 2.0;

/// The unit of the logarithm of the size, so that it varies about as fast as other unknowns do.
const SCALE_UNIT: f64 = 256.0;

impl DesignSpace {
    /// The space of a linkage of which some parameters are fixed, at a value or at their default, and others have a range.
    ///
    /// Other parameters vary from a quarter to four times their default if they must be positive, other lengths by two typical lengths to
    /// either side, angles by a whole turn; within the bounds of the parameter. Where ranges or values of lengths are given, the default
    /// lengths are as many times greater as these are than their defaults.
    ///
    /// # Errors
    /// Every name and every range that cannot be used.
    pub fn new(
        template: Arc<Template>,
        fixed: &[(String, Option<String>)],
        ranges: &[RangeRequest],
    ) -> Result<DesignSpace, Vec<DesignSpaceError>> {
        let mut errors: Vec<DesignSpaceError> = Vec::new();
        let parameters = template.parameters.clone();
        let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        let mut given: Vec<Option<(Range, Option<f64>)>> = vec![None; names.len()];
        for request in ranges {
            let wrong = |message: String| DesignSpaceError::Range {
                name: request.name.clone(),
                text: request.text.clone(),
                message,
            };
            let Some(slot) = names.iter().position(|name| *name == request.name) else {
                let suggestion = suggestion(&request.name, &names);
                errors.push(wrong(format!("{} has no parameter `{}`; {suggestion}", template.id, request.name)));
                continue;
            };
            if given[slot].is_some() {
                errors.push(wrong("the parameter has two ranges; leave one out".to_owned()));
            } else if fixed.iter().any(|(name, _)| *name == request.name) {
                errors.push(wrong("the parameter is fixed; leave the range or the value out".to_owned()));
            }
            match parse_range(&parameters[slot], &request.text) {
                Ok(range) => given[slot] = Some(range),
                Err(message) => errors.push(wrong(message)),
            }
        }
        let space = match LinkageSpace::new(template.clone(), fixed) {
            Ok(space) => space,
            Err(wrong) => {
                errors.extend(wrong.into_iter().map(DesignSpaceError::Parameter));
                return Err(errors);
            }
        };
        let is_free = |slot: usize| space.free().any(|(free, _)| free == slot);
        for request in ranges {
            let slot = names.iter().position(|name| *name == request.name);
            if slot.is_some_and(|slot| !is_free(slot)) && fixed.iter().all(|(name, _)| *name != request.name) {
                errors.push(DesignSpaceError::Range {
                    name: request.name.clone(),
                    text: request.text.clone(),
                    message: "the parameter must be a whole number and is not varied; give it a value".to_owned(),
                });
            }
        }
        let is_length = |slot: usize| parameters[slot].kind == ParameterKind::Length;
        let is_unfixed = |slot: &usize| fixed.iter().all(|(name, _)| *name != names[*slot]);
        // A fixed expression of others that scales does not give a size.
        let is_scaled = space.is_scalable() && (0..names.len()).all(|slot| given[slot].is_none() || !is_length(slot));
        let size = size_factor(&space, &given, |slot| is_length(slot) && !is_unfixed(&slot));
        let mut axes = Vec::new();
        for (slot, unit) in space.free() {
            let parameter = &parameters[slot];
            if is_scaled && space.held() == Some(slot) {
                continue;
            }
            if let Some((range, step)) = given[slot] {
                axes.push(Axis { slot, range, step });
                continue;
            }
            let has_bounds = parameter.min.is_some() && parameter.max.is_some();
            if parameter.default.is_none() && parameter.example.is_none() && !has_bounds && !is_length(slot) {
                errors.push(DesignSpaceError::NoRange { name: parameter.name.clone() });
                continue;
            }
            let size = if is_length(slot) { size } else { 1.0 };
            axes.push(Axis { slot, range: default_range(parameter, unit, space.base()[slot], size), step: None });
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        Ok(DesignSpace { sequence: EvenSequence::new(axes.len().max(1)), space, axes, is_scaled, idle: Vec::new() })
    }

    /// The linkage.
    pub fn template(&self) -> &Arc<Template> {
        self.space.template()
    }

    /// The names of the parameters that vary.
    pub fn free_names(&self) -> impl Iterator<Item = &str> {
        let is_varied = |slot: &usize| !self.idle.contains(slot);
        self.space
            .free()
            .map(|(slot, _)| slot)
            .filter(is_varied)
            .map(|slot| self.template().parameters[slot].name.as_str())
    }

    /// The same space where the parameters of some axes keep their defaults.
    pub(super) fn without(&self, idle_axes: &[usize]) -> DesignSpace {
        let mut reduced = self.clone();
        reduced.idle.extend(idle_axes.iter().map(|&axis| self.axes[axis].slot));
        reduced.axes.retain(|axis| !reduced.idle.contains(&axis.slot));
        reduced.sequence = EvenSequence::new(reduced.axes.len().max(1));
        reduced
    }

    /// Whether the size of a place is at the end of what is searched.
    pub(super) fn is_size_at_its_end(&self, place: &[f64]) -> bool {
        const NEAR: f64 = 0.9;
        self.is_scaled && place.last().is_some_and(|size| size.abs() > NEAR * MAX_SIZE)
    }

    /// Whether some parameters vary in steps.
    pub(super) fn has_steps(&self) -> bool {
        self.axes.iter().any(|axis| axis.step.is_some())
    }

    /// The same space, in the size of the default of a length.
    pub(super) fn of_default_size(&self) -> DesignSpace {
        DesignSpace { is_scaled: false, ..self.clone() }
    }

    /// The number of unknowns: the parts of the ranges and, if it is one, the logarithm of the size.
    pub(super) fn dimension(&self) -> usize {
        self.axes.len() + usize::from(self.is_scaled)
    }

    /// A place of the sequence that fills the ranges evenly, in the size of the defaults.
    pub(super) fn sample(&self, number: usize) -> Vec<f64> {
        let part = self.sequence.parts(number);
        let mut place: Vec<f64> = (0..self.axes.len()).map(part).collect();
        if self.is_scaled {
            place.push(0.0);
        }
        place
    }

    /// The values of all parameters at a place; `None` if one of them is out of its bounds.
    pub(super) fn values(&self, place: &[f64]) -> Option<Vec<f64>> {
        let mut values = self.space.base().to_vec();
        for (axis, part) in self.axes.iter().zip(place) {
            values[axis.slot] = axis.value(*part);
        }
        self.space.complete_with(&self.idle, &mut values);
        if let (true, Some(size)) = (self.is_scaled, place.last()) {
            values = scaled_values(self.template(), &values, size_of(*size));
        }
        self.space.are_valid(&values).then_some(values)
    }

    /// The same place within the ranges, at steps where there are some.
    pub(super) fn folded(&self, place: &[f64]) -> Vec<f64> {
        let mut folded = place.to_vec();
        for (axis, part) in self.axes.iter().zip(&mut folded) {
            *part = axis.part(axis.value(*part)).unwrap_or(*part);
        }
        folded
    }

    /// The same place in another size, as many times greater.
    pub(super) fn resized(&self, place: &[f64], factor: f64) -> Vec<f64> {
        let mut place = place.to_vec();
        if let (true, Some(size)) = (self.is_scaled, place.last_mut()) {
            *size += trig::ln(factor) / trig::ln(SCALE_UNIT);
        }
        place
    }
}

/// Beyond this size, in logarithms of [`SCALE_UNIT`], there is nothing to be found.
const MAX_SIZE: f64 = 4.0;

fn size_of(part: f64) -> f64 {
    trig::exp(part.clamp(-MAX_SIZE, MAX_SIZE) * trig::ln(SCALE_UNIT))
}

/// How many times greater than their defaults the lengths with a range or a value are: the geometric mean.
fn size_factor(
    space: &LinkageSpace,
    given: &[Option<(Range, Option<f64>)>],
    is_fixed_length: impl Fn(usize) -> bool,
) -> f64 {
    let parameters_of = space.template();
    let parameters = &parameters_of.parameters;
    let own = LinkageSpace::new(parameters_of.clone(), &[]);
    let default = own.as_ref().map_or(space.base(), LinkageSpace::base);
    let factor = |slot: usize| {
        let own = match given[slot] {
            Some((Range::Factors([low, high]), _)) if parameters[slot].kind == ParameterKind::Length => {
                (low * high).sqrt()
            }
            None if is_fixed_length(slot) => space.base()[slot],
            _ => return None,
        };
        let factor = own / default[slot];
        (factor.is_normal() && factor > 0.0).then(|| trig::ln(factor))
    };
    let factors: Vec<f64> = (0..parameters.len()).filter_map(factor).collect();
    if factors.is_empty() { 1.0 } else { trig::exp(factors.iter().sum::<f64>() / factors.len() as f64) }
}

/// The range of a parameter that none is given for.
fn default_range(parameter: &Parameter, unit: VariationUnit, value: f64, size: f64) -> Range {
    let within = |[low, high]: [f64; 2]| {
        let ends = [
            parameter.min.filter(|min| *min != 0.0 || low < 0.0).map_or(low, |min| low.max(min)),
            parameter.max.filter(|max| *max != 0.0 || high > 0.0).map_or(high, |max| high.min(max)),
        ];
        if ends[0] < ends[1] { ends } else { [low, high] }
    };
    match (unit, parameter.min, parameter.max) {
        (VariationUnit::Turn(unit), None, None) => {
            let length = std::f64::consts::TAU * unit;
            Range::Turn { from: value - 0.5 * length, length }
        }
        (VariationUnit::Turn(_) | VariationUnit::Shift(_), Some(min), Some(max)) => Range::Differences([min, max]),
        (VariationUnit::Turn(unit), ..) => {
            let half = std::f64::consts::PI * unit;
            Range::Differences(within([value - half, value + half]))
        }
        (VariationUnit::Factor, ..) => Range::Factors(within([size * value / FACTOR, size * value * FACTOR])),
        (VariationUnit::Shift(unit), ..) => {
            Range::Differences(within([size * (value - SHIFT * unit), size * (value + SHIFT * unit)]))
        }
    }
}

/// Reads a range as in `20..60 by 1`.
fn parse_range(parameter: &Parameter, text: &str) -> Result<(Range, Option<f64>), String> {
    const EXAMPLE: &str = "write it like 20..60 or 20..60 by 1";
    let (ends, step) = match text.split_once(" by ") {
        Some((ends, step)) => (ends, Some(step)),
        None => (text, None),
    };
    let (low, high) = ends.split_once("..").ok_or(EXAMPLE)?;
    let number = |text: &str| -> Result<f64, String> {
        let parsed = parameter.kind.parse_value(&parameter.name, text.trim());
        let compiled = parsed.and_then(|expression| expression.compile(&Scope::default(), Kind::Number));
        let value = compiled.map_err(|error| format!("`{}`: {}", text.trim(), error.message_with_help()))?;
        Ok(value.evaluate(|_| f64::NAN))
    };
    let [low, high] = [number(low)?, number(high)?];
    if low.is_nan() || high.is_nan() || low >= high || !low.is_finite() || !high.is_finite() {
        return Err(format!("{low} is not below {high}; {EXAMPLE}"));
    }
    if let Some(error) = [low, high].into_iter().find_map(|end| parameter.value_error(end)) {
        return Err(error);
    }
    let step = step.map(number).transpose()?;
    if let Some(step) = step.filter(|step| step.is_nan() || *step <= 0.0 || *step > high - low) {
        return Err(format!("the step {step} is not from 0 to {}; {EXAMPLE}", high - low));
    }
    Ok((Range::new([low, high]), step))
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::catalogue;

    fn space(linkage: &str, fixed: &[(&str, &str)], ranges: &[(&str, &str)]) -> Result<DesignSpace, Vec<String>> {
        let fixed: Vec<_> = fixed.iter().map(|(name, value)| ((*name).to_owned(), Some((*value).to_owned()))).collect();
        let ranges: Vec<_> = ranges
            .iter()
            .map(|(name, text)| RangeRequest { name: (*name).to_owned(), text: (*text).to_owned() })
            .collect();
        DesignSpace::new(catalogue::find(linkage).unwrap(), &fixed, &ranges)
            .map_err(|errors| errors.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn samples_are_in_their_ranges() {
        let space =
            space("four-bar", &[("frame", "100")], &[("crank", "20..60 by 1"), ("coupler", "50 .. 2 * 60")]).unwrap();
        assert!(!space.is_scaled);
        let slot = |name: &str| space.template().parameters.iter().position(|p| p.name == name).unwrap();
        for number in 0..200 {
            let values = space.values(&space.sample(number)).unwrap();
            assert_eq!(values[slot("frame")], 100.0);
            let [crank, coupler] = ["crank", "coupler"].map(|name| values[slot(name)]);
            assert!((20.0..=60.0).contains(&crank) && crank.fract() == 0.0, "{crank}");
            assert!((50.0..=120.0).contains(&coupler), "{coupler}");
        }
    }

    #[test]
    fn every_range_that_cannot_be_used_is_named() {
        let ranges = [
            ("krank", "1..2"),
            ("crank", "60..20"),
            ("coupler", "20"),
            ("rocker", "20..30 by 40"),
            ("frame", "1..2"),
            ("frame", "-1..2"),
        ];
        let errors = space("four-bar", &[("frame", "100")], &ranges).unwrap_err();
        assert_eq!(errors.len(), 7, "{errors:#?}");
    }
}
