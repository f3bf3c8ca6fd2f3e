//! One cell of a family through linkage, motion and measure.

use crate::family::{Cell, Family};
use crate::linkage::{JointId, Linkage};
use crate::measure::{self, StraightPortion, Symmetry, TracedCurve, Value};
use crate::motion::{Circuit, Motion, Sampler};

/// A solved and measured cell.
#[derive(Clone, Debug)]
pub struct SolvedCell {
    /// The parameter set.
    pub cell: Cell,
    /// Its linkage.
    pub linkage: Linkage,
    /// What the linkage does.
    pub motion: Motion,
    /// The curves that `where` keeps, in order of trace and circuit.
    pub curves: Vec<MeasuredCurve>,
    /// How many curves `where` left out.
    pub left_out_count: usize,
}

/// A traced joint on a circuit, and what was measured of it.
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
    /// What was measured of it under a name.
    pub fn value(&self, name: &str) -> Value {
        let at = measure::ALL.iter().position(|measure| measure.name == name);
        at.and_then(|at| self.values.get(at)).copied().unwrap_or(Value::Missing)
    }
}

/// How far a cell was assembled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Over all that was asked for.
    Ok,
    /// Over a part of the range asked for.
    Partial,
    /// Nowhere.
    None,
}

impl Status {
    /// Its name in `cells.csv`.
    pub fn name(self) -> &'static str {
        match self {
            Status::Ok => "ok",
            Status::Partial => "partial",
            Status::None => "none",
        }
    }
}

impl SolvedCell {
    /// How far the cell was assembled.
    pub fn status(&self) -> Status {
        match (&self.motion.incomplete_reason, self.motion.is_assembled()) {
            (_, false) => Status::None,
            (Some(_), true) => Status::Partial,
            (None, true) => Status::Ok,
        }
    }

    /// The circuit of a curve.
    pub fn circuit(&self, curve: &MeasuredCurve) -> &Circuit {
        &self.motion.circuits[curve.circuit - 1]
    }

    /// The curves by traced points, in order, so many points together: what stands on one page after the other.
    pub fn curves_by_traces(&self, together: usize) -> Vec<Vec<usize>> {
        let mut traces: Vec<usize> = self.curves.iter().map(|curve| curve.trace).collect();
        traces.dedup();
        let of =
            |traces: &[usize]| (0..self.curves.len()).filter(|&k| traces.contains(&self.curves[k].trace)).collect();
        traces.chunks(together).map(of).collect()
    }

    /// What was measured of the first curve; nothing where there is none.
    pub fn first_curve_values(&self) -> &[Value] {
        self.curves.first().map_or(&[], |curve| &curve.values)
    }

    /// Whether nothing of the cell is kept.
    pub fn is_left_out(&self) -> bool {
        self.curves.is_empty() && self.left_out_count > 0
    }
}

/// Solves and measures the `k`-th cell of a family.
pub fn solve_cell(family: &Family, sampler: &Sampler, k: usize) -> Option<SolvedCell> {
    solve_measuring(family, sampler, k, &family.is_computed)
}

/// Solves the `k`-th cell of a family and computes the measures requested, by their indices in [`measure::ALL`]; those that
/// `where` uses must be among them.
pub fn solve_measuring(family: &Family, sampler: &Sampler, k: usize, requested: &[bool]) -> Option<SolvedCell> {
    let cell = family.cell(k);
    // A family is validated cell by cell before it is swept, so every cell makes a linkage.
    let linkage = family.linkage(&cell).ok()?;
    let motion = Motion::solve(&linkage, sampler);
    let mut solved = SolvedCell { cell, linkage, motion, curves: Vec::new(), left_out_count: 0 };
    let mut curves = Vec::new();
    for (trace, &joint) in (1..).zip(&solved.linkage.traced) {
        for (number, circuit) in (1..).zip(&solved.motion.circuits) {
            let subject = TracedCurve::new(&solved.linkage, &solved.motion, circuit, joint)
                .with_straight_criterion(family.straight);
            let measures = measure::compute_selected(&subject, |measure| requested[measure]);
            if family.keeps(&solved.cell, &measures) {
                let (straight, symmetry) = subject.computed_marks();
                curves.push(MeasuredCurve { trace, circuit: number, joint, values: measures, straight, symmetry });
            } else {
                solved.left_out_count += 1;
            }
        }
    }
    // A cell without any motion is one row, of which only its own values can be asked.
    if !solved.motion.is_assembled() && !family.keeps(&solved.cell, &[]) {
        solved.left_out_count += 1;
    }
    solved.curves = curves;
    Some(solved)
}
