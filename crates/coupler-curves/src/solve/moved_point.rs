//! Moves a traced point on its link by the overrides `M.along` and `M.across`.

use crate::expression::{CompiledExpression, Expression, Kind, PostfixToken, Scope};
use crate::template::{Coordinate, JointKindTemplate, JointTemplate, Template};

/// Why the point of a trace cannot be moved.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MovedPointError {
    /// No trace is given.
    #[error("only the point of a single curve can be moved; name it by cell, trace and circuit")]
    NotSingleCurve,
    /// The linkage has no trace with this number.
    #[error("there is no trace {0}")]
    NoSuchTrace(usize),
    /// The joint with this name has no coordinates on a link.
    #[error("`{0}` is not a point with `along` and `across`, and cannot be moved on its link")]
    NoCoordinates(String),
    /// A name is not that of a coordinate of the point.
    #[error("there is no `{name}`: it can be `{point}.along` or `{point}.across`")]
    UnknownCoordinate {
        /// The name.
        name: String,
        /// The point.
        point: String,
    },
    /// The coordinates of the point with this name are not finite.
    #[error("the coordinates of `{0}` are not finite")]
    NotFinite(String),
}

/// A point on a link that can be moved by overrides of its coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct MovablePoint {
    /// The name of the joint.
    pub name: String,
    /// The coordinates along and across its base.
    pub coordinates: [PointCoordinate; 2],
}

/// A coordinate of a point on a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointCoordinate {
    /// Its value.
    pub value: f64,
    /// Whether it is a number in the linkage, and not computed.
    pub is_constant: bool,
    /// Whether it is a parameter of the linkage.
    pub is_parameter: bool,
}

impl MovablePoint {
    /// The point of a trace, counted from 1, of a template with these values of its parameters; `None` if the trace has
    /// no point with coordinates.
    pub fn of_trace(template: &Template, trace: usize, values: &[f64]) -> Option<MovablePoint> {
        let (joint, point) = find_traced_point(template, trace)?;
        let JointTemplate { name, kind: JointKindTemplate::Point { along, across, .. }, .. } = &template.joints[joint]
        else {
            return None;
        };
        let coordinate = |coordinate: &Coordinate, k: usize| {
            let value = coordinate_value(coordinate, k, values);
            match coordinate {
                Coordinate::Single(expression) => {
                    let is_name = matches!(expression.postfix().collect::<Vec<_>>()[..], [PostfixToken::Name(_)]);
                    PointCoordinate { value, is_constant: expression.slots().is_empty(), is_parameter: is_name }
                }
                Coordinate::Range { .. } => PointCoordinate { value, is_constant: false, is_parameter: false },
            }
        };
        let coordinates = [coordinate(along, point / across.count()), coordinate(across, point % across.count())];
        Some(MovablePoint { name: name.clone(), coordinates })
    }
}

/// The `k`-th value of a coordinate.
fn coordinate_value(coordinate: &Coordinate, k: usize, values: &[f64]) -> f64 {
    coordinate.values(|expression| expression.evaluate(|slot| values[slot])).get(k).copied().unwrap_or(f64::NAN)
}

/// Moves the point of a trace, counted from 1, on its link, and returns the new template and the number of its trace.
///
/// `values` are the values of the template's parameters. If the point is one of a grid, the grid is unchanged, and the
/// moved point is added to the template as a joint of its own, which becomes the last trace.
///
/// # Errors
/// No trace is given, the trace does not exist, its point cannot be moved, or an override has an unknown name.
pub(super) fn move_point(
    template: &Template,
    trace: Option<usize>,
    values: &[f64],
    overrides: &[&(String, f64)],
) -> Result<(Template, usize), MovedPointError> {
    let trace = trace.ok_or(MovedPointError::NotSingleCurve)?;
    let (joint, point) = find_traced_point(template, trace).ok_or(MovedPointError::NoSuchTrace(trace))?;
    let JointTemplate { name, kind, .. } = &template.joints[joint];
    let JointKindTemplate::Point { base, along, across } = kind else {
        return Err(MovedPointError::NoCoordinates(name.clone()));
    };
    let is_grid = along.count() * across.count() > 1;
    let mut coordinates = [
        coordinate_value(along, point / across.count(), values),
        coordinate_value(across, point % across.count(), values),
    ];
    for (word, value) in overrides {
        match word.strip_prefix(name.as_str()).and_then(|rest| rest.strip_prefix('.')) {
            Some("along") => coordinates[0] = *value,
            Some("across") => coordinates[1] = *value,
            _ => {
                return Err(MovedPointError::UnknownCoordinate { name: word.clone(), point: name.clone() });
            }
        }
    }
    let [Some(along), Some(across)] = coordinates.map(constant_expression) else {
        return Err(MovedPointError::NotFinite(name.clone()));
    };
    let kind =
        JointKindTemplate::Point { base: *base, along: Coordinate::Single(along), across: Coordinate::Single(across) };
    let mut moved = template.clone();
    if is_grid {
        moved.traced.push(moved.joints.len());
        moved.joints.push(JointTemplate { name: format!("{name}′"), kind, drawn: None });
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
