//! Moves a traced point on its link by the overrides `M.along` and `M.across`.

use coupler_curves::expression::{CompiledExpression, Expression, Kind, Scope};
use coupler_curves::template::{Coordinate, JointKindTemplate, JointTemplate, Template};

/// Moves the point of a trace, counted from 1, on its link, and returns the new template and the number of its trace.
///
/// `values` are the values of the template's parameters. If the point is one of a grid, the grid is unchanged, and the
/// moved point is added to the template as a joint of its own, which becomes the last trace.
///
/// # Errors
/// The trace does not exist, its point cannot be moved, or an override has an unknown name.
pub(super) fn move_point(
    template: &Template,
    trace: usize,
    values: &[f64],
    overrides: &[&(String, f64)],
) -> Result<(Template, usize), String> {
    let (joint, point) = find_traced_point(template, trace).ok_or_else(|| format!("there is no trace {trace}"))?;
    let JointTemplate { name, kind } = &template.joints[joint];
    let JointKindTemplate::Point { base, along, across } = kind else {
        return Err(format!("`{name}` is not a point with `along` and `across`, and cannot be moved on its link"));
    };
    let number = |coordinate: &Coordinate, k: usize| {
        coordinate.values(|expression| expression.evaluate(|slot| values[slot])).get(k).copied().unwrap_or(f64::NAN)
    };
    let is_grid = along.count() * across.count() > 1;
    let mut coordinates = [number(along, point / across.count()), number(across, point % across.count())];
    for (word, value) in overrides {
        match word.strip_prefix(name.as_str()).and_then(|rest| rest.strip_prefix('.')) {
            Some("along") => coordinates[0] = *value,
            Some("across") => coordinates[1] = *value,
            _ => return Err(format!("there is no `{word}`: it can be `{name}.along` or `{name}.across`")),
        }
    }
    let [Some(along), Some(across)] = coordinates.map(constant_expression) else {
        return Err(format!("the coordinates of `{name}` are not finite"));
    };
    let kind =
        JointKindTemplate::Point { base: *base, along: Coordinate::Single(along), across: Coordinate::Single(across) };
    let mut moved = template.clone();
    if is_grid {
        moved.traced.push(moved.joints.len());
        moved.joints.push(JointTemplate { name: format!("{name}′"), kind });
        return Ok((moved, template.curve_count() + 1));
    }
    moved.joints[joint].kind = kind;
    Ok((moved, trace))
}

/// The index of the joint of a trace in the template, and the index of the point among those of the joint.
fn find_traced_point(template: &Template, trace: usize) -> Option<(usize, usize)> {
    let mut index = trace.checked_sub(1)?;
    for &joint in &template.traced {
        let points = match &template.joints[joint].kind {
            JointKindTemplate::Point { along, across, .. } => along.count() * across.count(),
            _ => 1,
        };
        if index < points {
            return Some((joint, index));
        }
        index -= points;
    }
    None
}

fn constant_expression(value: f64) -> Option<CompiledExpression> {
    let expression = Expression::parse(&value.to_string()).ok().filter(|_| value.is_finite())?;
    expression.compile(&Scope::default(), Kind::Number).ok()
}
