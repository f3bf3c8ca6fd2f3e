//! Solves one cell of a family: its linkage, motion and measures; changes its parameters before.

mod changed_cell;
mod moved_point;
mod screening;

pub use changed_cell::{ChangeError, ChangedCell, OriginalNumbers};
pub use moved_point::{MovablePoint, MovedPointError, PointCoordinate};
pub use screening::Screening;

use std::panic::{self, AssertUnwindSafe};

use crate::family::{Cell, Family};
use crate::linkage::{JointId, Linkage};
use crate::measure::{self, CircuitResults, StraightPortion, Symmetry, TracedCurve, Value};
use crate::motion::{AssemblyError, Circuit, Motion, Sampler};

/// A solved and measured cell.
#[derive(Clone, Debug)]
pub struct SolvedCell {
    /// Its parameter set.
    pub cell: Cell,
    /// Its linkage.
    pub linkage: Linkage,
    /// The motion of the linkage.
    pub motion: Motion,
    /// The curves that `where` keeps, in order of trace and circuit.
    pub curves: Vec<MeasuredCurve>,
    /// The number of curves that `where` excludes.
    pub left_out_count: usize,
}

/// The curve of a traced joint on a circuit, and its measures.
#[derive(Clone, Debug)]
pub struct MeasuredCurve {
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The number of the circuit, from 1.
    pub circuit: usize,
    /// The joint.
    pub joint: JointId,
    /// The values of [`measure::ALL`].
    pub values: Vec<Value>,
    /// Its straight portion.
    pub straight: Option<StraightPortion>,
    /// Its symmetry.
    pub symmetry: Option<Symmetry>,
}

impl MeasuredCurve {
    /// The value of a measure by its name; missing for an unknown name.
    pub fn value(&self, name: &str) -> Value {
        let index = measure::ALL.iter().position(|measure| measure.name == name);
        index.and_then(|index| self.values.get(index)).copied().unwrap_or(Value::Missing)
    }
}

/// Whether a cell could be assembled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Over the whole requested range.
    Ok,
    /// Over a part of the requested range.
    Partial,
    /// At no input.
    None,
    /// Not known: the program failed where it solved the cell.
    Failed,
}

impl Status {
    /// Its name in `cells.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Status::Ok => "ok",
            Status::Partial => "partial",
            Status::None => "none",
            Status::Failed => "failed",
        }
    }
}

impl SolvedCell {
    /// Whether the cell could be assembled.
    pub fn status(&self) -> Status {
        match (&self.motion.assembly_error, self.motion.is_assembled()) {
            (Some(AssemblyError::Failed { .. }), _) => Status::Failed,
            (_, false) => Status::None,
            (Some(_), true) => Status::Partial,
            (None, true) => Status::Ok,
        }
    }

    /// The same cell with only one of its curves.
    pub fn with_curve(&self, curve: &MeasuredCurve) -> SolvedCell {
        SolvedCell { curves: vec![curve.clone()], ..self.clone() }
    }

    /// The column `reason` of `cells.csv`: the message of the assembly error, empty without one.
    pub fn reason(&self) -> String {
        self.motion.assembly_error.as_ref().map(ToString::to_string).unwrap_or_default()
    }

    /// The circuit of a curve.
    pub fn circuit(&self, curve: &MeasuredCurve) -> &Circuit {
        &self.motion.circuits[curve.circuit - 1]
    }

    /// The number of traced points that have a curve.
    pub fn traced_point_count(&self) -> usize {
        self.curves.chunk_by(|a, b| a.trace == b.trace).count()
    }

    /// The indices of the curves in groups of `trace_count` traced points, in order: one group for each page.
    pub fn curves_by_traces(&self, trace_count: usize) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut first = 0;
        for (k, curves) in self.curves.chunk_by(|a, b| a.trace == b.trace).enumerate() {
            if k % trace_count == 0 {
                groups.push(Vec::new());
            }
            if let Some(group) = groups.last_mut() {
                group.extend(first..first + curves.len());
            }
            first += curves.len();
        }
        groups
    }

    /// The values of the first curve; empty where there is no curve.
    pub fn first_curve_values(&self) -> &[Value] {
        self.curves.first().map_or(&[], |curve| &curve.values)
    }

    /// Whether `where` excludes the whole cell.
    pub fn is_left_out(&self) -> bool {
        self.curves.is_empty() && self.left_out_count > 0
    }
}

/// Solves the `k`-th cell of a family, from 0, and computes the family's measures.
pub fn solve_cell(family: &Family, sampler: &Sampler, k: usize) -> Option<SolvedCell> {
    solve_measuring(family, sampler, k, &family.is_computed)
}

/// Solves the `k`-th cell of a family, from 0, whose curves have been measured before: `measured` is the curves and the number of
/// those that `where` excludes, as of [`solve_measuring`] for the same cell. `None` if there are neither: why there are none is not
/// known from it.
pub fn solve_measured(
    family: &Family,
    sampler: &Sampler,
    k: usize,
    (curves, left_out_count): (Vec<MeasuredCurve>, usize),
) -> Option<SolvedCell> {
    if curves.is_empty() && left_out_count == 0 {
        return None;
    }
    let cell = family.cell(k);
    let linkage = family.linkage(&cell).ok()?;
    let motion = Motion::solve(&linkage, sampler);
    Some(SolvedCell { cell, linkage, motion, curves, left_out_count })
}

/// Solves the `k`-th cell of a family, from 0, and computes the requested measures, by their indices in
/// [`measure::ALL`]; those that `where` uses are among them.
pub fn solve_measuring(family: &Family, sampler: &Sampler, k: usize, requested: &[bool]) -> Option<SolvedCell> {
    solve_screened(family, sampler, k, &Screening::new(family, requested))
}

/// Solves the `k`-th cell of a family, from 0, and computes the measures of a screening of this family.
///
/// A panic in it is an error of the program, but it ends neither the program nor the solving of other cells: it is the reason of a
/// cell with the status [`Status::Failed`].
pub fn solve_screened(family: &Family, sampler: &Sampler, k: usize, screening: &Screening) -> Option<SolvedCell> {
    let cell = family.cell(k);
    // A family is validated cell by cell before it is swept, so every cell has a linkage.
    let linkage = family.linkage(&cell).ok()?;
    let solved = catch_panic(|| solve_linkage(family, sampler, (&cell, &linkage), screening));
    let (motion, curves, left_out_count) = solved.unwrap_or_else(|message| {
        let motion = Motion { circuits: Vec::new(), assembly_error: Some(AssemblyError::Failed { message }) };
        (motion, Vec::new(), usize::from(!family.keeps(&cell, &[])))
    });
    Some(SolvedCell { cell, linkage, motion, curves, left_out_count })
}

/// The result of a function, or the message of a panic in it, in one line that is not too long for a table.
fn catch_panic<T>(function: impl FnOnce() -> T) -> Result<T, String> {
    const MAX_CHARS: usize = 1000;
    // What it has changed is dropped with it.
    panic::catch_unwind(AssertUnwindSafe(function)).map_err(|payload| {
        let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
        let words = text.as_deref().unwrap_or("without a message").split_whitespace().collect::<Vec<_>>().join(" ");
        words.chars().take(MAX_CHARS).collect()
    })
}

/// The motion of a cell's linkage, the curves that `where` keeps, and the number of those that it excludes.
fn solve_linkage(
    family: &Family,
    sampler: &Sampler,
    (cell, linkage): (&Cell, &Linkage),
    screening: &Screening,
) -> (Motion, Vec<MeasuredCurve>, usize) {
    let motion = Motion::solve(linkage, sampler);
    let (mut curves, mut left_out_count) = (Vec::new(), 0);
    let circuits: Vec<CircuitResults> = motion.circuits.iter().map(|_| CircuitResults::default()).collect();
    for (trace, &joint) in (1..).zip(&linkage.traced) {
        for ((number, circuit), results) in (1..).zip(&motion.circuits).zip(&circuits) {
            let curve = TracedCurve::new(linkage, &motion, circuit, joint)
                .with_straight_criterion(family.straight)
                .with_circuit_results(results.clone());
            if let Some(measures) = screening.measure(cell, &curve) {
                let (straight, symmetry) = curve.computed_marks();
                curves.push(MeasuredCurve { trace, circuit: number, joint, values: measures, straight, symmetry });
            } else {
                left_out_count += 1;
            }
        }
    }
    // A cell without motion is one row, and `where` sees only its parameter values.
    if !motion.is_assembled() && !family.keeps(cell, &[]) {
        left_out_count += 1;
    }
    (motion, curves, left_out_count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_its_message() {
        assert_eq!(catch_panic(|| 3), Ok(3));
        let numbers: Vec<i32> = Vec::new();
        let index = numbers.len() + 2;
        let message = catch_panic(|| numbers[index]).unwrap_err();
        assert_eq!(message, "index out of bounds: the len is 0 but the index is 2");
        assert_eq!(catch_panic(|| panic!("no pieces\n  left: {}", 1)).unwrap_err(), "no pieces left: 1");
        assert_eq!(catch_panic(|| std::panic::panic_any(3)).unwrap_err(), "without a message");
    }
}
