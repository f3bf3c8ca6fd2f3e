//! A traced point that is moved on its link: `M.along` and `M.across` among changed parameters.

use coupler_curves::expression::{CompiledExpression, Expression, Kind};
use coupler_curves::template::{Coordinate, JointKindTemplate, JointTemplate, Template};

/// A template with the point of a trace, counted from 1, where `changed` has it on its link, and the number of its trace
/// then: a point of a grid comes to stand beside the grid, and is traced last.
///
/// # Errors
/// What is wrong with a name, in a sentence.
pub(super) fn move_point(
    template: &Template,
    trace: usize,
    values: &[f64],
    changed: &[&(String, f64)],
) -> Result<(Template, usize), String> {
    let (joint, place) = find_traced_point(template, trace).ok_or_else(|| format!("there is no trace {trace}"))?;
    let JointTemplate { name, kind: placing } = &template.joints[joint];
    let JointKindTemplate::Point { base, along, across } = placing else {
        return Err(format!("`{name}` is no point along and across its link, and cannot be moved on it"));
    };
    let number = |coordinate: &Coordinate, k: usize| {
        coordinate.values(|bound| bound.evaluate(|slot| values[slot])).get(k).copied().unwrap_or(f64::NAN)
    };
    let is_grid = along.count() * across.count() > 1;
    let mut at = [number(along, place / across.count()), number(across, place % across.count())];
    for (word, value) in changed {
        match word.strip_prefix(name.as_str()).and_then(|rest| rest.strip_prefix('.')) {
            Some("along") => at[0] = *value,
            Some("across") => at[1] = *value,
            _ => return Err(format!("there is no `{word}`: it can be `{name}.along` or `{name}.across`")),
        }
    }
    let [Some(along), Some(across)] = at.map(constant_expression) else {
        return Err(format!("`{name}` has no place on its link"));
    };
    let placing =
        JointKindTemplate::Point { base: *base, along: Coordinate::Single(along), across: Coordinate::Single(across) };
    let mut own = template.clone();
    if is_grid {
        own.traced.push(own.joints.len());
        own.joints.push(JointTemplate { name: format!("{name}′"), kind: placing });
        return Ok((own, template.curve_count() + 1));
    }
    own.joints[joint].kind = placing;
    Ok((own, trace))
}

/// The joint of a trace, by its place in the template, and which of its points it is.
fn find_traced_point(template: &Template, trace: usize) -> Option<(usize, usize)> {
    let mut left = trace.checked_sub(1)?;
    for &joint in &template.traced {
        let points = match &template.joints[joint].kind {
            JointKindTemplate::Point { along, across, .. } => along.count() * across.count(),
            _ => 1,
        };
        if left < points {
            return Some((joint, left));
        }
        left -= points;
    }
    None
}

fn constant_expression(value: f64) -> Option<CompiledExpression> {
    let expression = Expression::parse(&value.to_string()).ok().filter(|_| value.is_finite())?;
    expression.compile(&[], Kind::Number).ok()
}
