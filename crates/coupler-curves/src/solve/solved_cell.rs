//! A cell when it is solved.

use crate::family::Cell;
use crate::linkage::{JointId, Linkage};
use crate::measure::{CurveMoves, MeasureKey, MeasureValue, StraightPortion, Symmetry, Value};
use crate::motion::{AssemblyError, Circuit, Motion};

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
    /// The values of [`measure::ALL`](crate::measure::ALL).
    pub values: Vec<Value>,
    /// Its straight portion.
    pub straight: Option<StraightPortion>,
    /// Its symmetry.
    pub symmetry: Option<Symmetry>,
    /// Its moves for errors of the lengths of its linkage, if this has a tolerance.
    pub moves: Option<CurveMoves>,
}

impl MeasuredCurve {
    /// The value of a measure; `None` where it does not apply, or has not been requested.
    pub fn measure<T: MeasureValue>(&self, key: MeasureKey<T>) -> Option<T> {
        key.value_in(&self.values)
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
