//! What moves where lengths of a linkage are off.

use coupler_curves::linkage::JointId;
use coupler_curves::motion::{self, InputPosition, LengthRates, NeighbourLinkages, Pass};
use coupler_curves::solve::{SolvedCell, curve_tolerances};
use coupler_curves::template::Template;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::solution::Solution;
use crate::error::LinkageError;

/// The neighbours of a linkage, for derivatives by its lengths.
///
/// # Errors
/// Its lengths cannot be off by themselves.
pub(super) fn neighbours(solution: &Solution, solved: &SolvedCell) -> PyResult<NeighbourLinkages> {
    let family = &solution.family;
    let found = family.template.neighbours(family.parameter_values(&solved.cell), NeighbourLinkages::STEP);
    found.ok_or_else(|| no_lengths(solution))
}

fn no_lengths(solution: &Solution) -> PyErr {
    LinkageError::new_err(format!("{}: {}", solution.family.id, Template::NO_LENGTHS))
}

/// The derivatives of the position of a joint at an input of a pass, by each length: x and y, NaN at a change point.
pub(super) fn position_rates(
    solved: &SolvedCell,
    neighbours: &NeighbourLinkages,
    joint: JointId,
    (pass, input): (&Pass, f64),
) -> Vec<[f64; 2]> {
    let linkage = &solved.linkage;
    let positions = motion::pose(linkage, pass, input);
    let input = InputPosition::new(linkage.input(), input);
    match LengthRates::new(linkage, neighbours, &positions, input, pass.mode) {
        Some(rates) => rates.at_input(joint).map(|rate| [rate.x, rate.y]).collect(),
        None => vec![[f64::NAN; 2]; neighbours.pairs.len()],
    }
}

/// How far a curve, by its index, moves for an error of the lengths: as a dictionary; None where it stands still, or passes a change point.
///
/// # Errors
/// The lengths cannot be off by themselves.
pub(super) fn tolerance<'py>(
    py: Python<'py>,
    solution: &Solution,
    index: usize,
    error: f64,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let solved = solution.measured(py)?;
    let template = &solution.family.template;
    let found = py.detach(|| template.lengths().zip(curve_tolerances(&solution.family, solved)));
    let (lengths, curves) = found.ok_or_else(|| no_lengths(solution))?;
    let own = &solved.curves[index];
    let found = curves.into_iter().find(|curve| (curve.trace, curve.circuit) == (own.trace, own.circuit));
    let Some(curve) = found else { return Ok(None) };
    let table = PyDict::new(py);
    table.set_item("worst_case", error * curve.moves.worst_case)?;
    table.set_item("root_sum_square", error * curve.moves.root_sum_square)?;
    let (sensitivities, straight) = (PyDict::new(py), PyDict::new(py));
    for (k, length) in lengths.iter().enumerate() {
        let name = template.length_name(length);
        sensitivities.set_item(&name, curve.moves.lengths[k])?;
        straight.set_item(&name, curve.straight[k])?;
    }
    table.set_item("sensitivities", sensitivities)?;
    table.set_item("straight_sensitivities", straight)?;
    Ok(Some(table))
}
