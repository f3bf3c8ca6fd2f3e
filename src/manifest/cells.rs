//! Checks the cells of a family.

use std::collections::HashMap;

use super::names::MAX_LIMIT;
use coupler_curves::family::{Cell, CellError, Family};
use coupler_curves::linkage_format::{Fields, TomlParser, TomlValue};
use coupler_curves::problem::{Problem, Span};

/// The number of cells that the families of an atlas may still have.
pub(super) struct RemainingCells(usize);

impl Default for RemainingCells {
    fn default() -> RemainingCells {
        RemainingCells(MAX_LIMIT)
    }
}

impl RemainingCells {
    /// Subtracts the cells of a family; reports a family with too many, and then is false.
    pub fn subtract(&mut self, cells: usize, fields: &Fields, parser: &mut TomlParser) -> bool {
        match self.0.checked_sub(cells) {
            Some(rest) => {
                self.0 = rest;
                true
            }
            None => {
                let total = cells.saturating_add(MAX_LIMIT - self.0);
                let message = format!("the families up to here have {total} cells, more than the limit of {MAX_LIMIT}");
                let span = space_span(fields);
                parser.report(Problem::error(span, message).with_help("use fewer values, or divide the atlas"));
                false
            }
        }
    }
}

/// A problem of one or more cells.
struct CellProblem {
    span: Span,
    message: String,
    help: &'static str,
    cell_count: usize,
}

/// The kinds of problems, of each of which only the first is reported.
#[derive(PartialEq, Eq, Hash)]
enum ProblemKind {
    Missing(String),
    Value(usize),
    Linkage,
}

/// Checks every cell's values and linkage; of each kind of problem the first cell is reported, and the others are
/// counted. `spans` are the places where the names get their values.
pub(super) fn check(family: &Family, fields: &Fields, spans: &[Option<Span>], parser: &mut TomlParser) {
    let mut problems: Vec<CellProblem> = Vec::new();
    let mut problem_indices: HashMap<ProblemKind, usize> = HashMap::new();
    for k in 0..family.cell_count() {
        let cell = family.cell(k);
        for error in family.cell_errors(&cell) {
            let (kind, slot, help) = match &error {
                CellError::Missing(name) => {
                    (ProblemKind::Missing(name.clone()), None, "give it in the grid, the cases or `let`")
                }
                CellError::Value { slot, .. } => {
                    (ProblemKind::Value(*slot), Some(*slot), "change the values it comes from")
                }
                CellError::Template(_) => {
                    (ProblemKind::Linkage, None, "change the values it comes from, or leave the cell out")
                }
            };
            if let Some(&found) = problem_indices.get(&kind) {
                problems[found].cell_count += 1;
                continue;
            }
            problem_indices.insert(kind, problems.len());
            let span = case_span(fields, k).or_else(|| spans.get(slot?).cloned().flatten());
            let message = format!("in cell {} ({}), {error}", cell.number, given_values(family, &cell));
            let span = span.unwrap_or_else(|| space_span(fields));
            problems.push(CellProblem { span, message, help, cell_count: 1 });
        }
    }
    for problem in problems {
        let help = match problem.cell_count {
            1 => problem.help.to_owned(),
            n => format!("{}; {} more cells have the same error", problem.help, n - 1),
        };
        parser.report(Problem::error(problem.span, problem.message).with_help(help));
    }
}

/// The most values of a cell that a message names.
const MAX_VALUES: usize = 20;

/// The values of a cell as a message names them.
fn given_values(family: &Family, cell: &Cell) -> String {
    let given = || family.names.iter().zip(&cell.values).filter(|(_, value)| value.is_finite());
    let mut named: Vec<String> = given().take(MAX_VALUES).map(|(name, value)| format!("{name} = {value}")).collect();
    let more = given().count() - named.len();
    if more > 0 {
        named.push(format!("and {more} more"));
    }
    named.join(", ")
}

/// The place of the grid or the cases; that of the family if it has neither.
fn space_span(fields: &Fields) -> Span {
    let space = ["grid", "cases"].into_iter().find_map(|key| fields.get(key));
    space.map_or_else(|| fields.span.clone(), TomlValue::span)
}

/// The place of the k-th case, if the family has cases.
fn case_span(fields: &Fields, k: usize) -> Option<Span> {
    Some(fields.get("cases")?.get_ref().as_array()?.get(k)?.span())
}
