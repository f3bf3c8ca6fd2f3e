//! One cell of a family through linkage, motion and measure.

use crate::family::{Cell, Family};
use crate::linkage::{JointId, Linkage};
use crate::measure::{self, Portion, Subject, Symmetry, Value};
use crate::motion::{Circuit, Motion, Sampler};

/// A solved and measured cell.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The parameter set.
    pub cell: Cell,
    /// Its linkage.
    pub linkage: Linkage,
    /// What the linkage does.
    pub motion: Motion,
    /// The curves that `where` keeps, in order of trace and circuit.
    pub curves: Vec<Curve>,
    /// How many curves `where` left out.
    pub left_out: usize,
}

/// A traced joint on a circuit, and what was measured of it.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The number of the circuit, from 1.
    pub circuit: usize,
    /// The joint.
    pub joint: JointId,
    /// The values of [`measure::ALL`].
    pub measures: Vec<Value>,
    /// Its straight portion.
    pub straight: Option<Portion>,
    /// Its symmetry.
    pub symmetry: Option<Symmetry>,
}

impl Curve {
    /// What was measured of it under a name.
    pub fn measure(&self, name: &str) -> Value {
        let at = measure::ALL.iter().position(|measure| measure.name == name);
        at.and_then(|at| self.measures.get(at)).copied().unwrap_or(Value::Missing)
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

impl Solved {
    /// How far the cell was assembled.
    pub fn status(&self) -> Status {
        match (&self.motion.shortfall, self.motion.is_assembled()) {
            (_, false) => Status::None,
            (Some(_), true) => Status::Partial,
            (None, true) => Status::Ok,
        }
    }

    /// The circuit of a curve.
    pub fn circuit(&self, curve: &Curve) -> &Circuit {
        &self.motion.circuits[curve.circuit - 1]
    }

    /// The curves by traced points, in order, so many points together: what stands on one page after the other.
    pub fn by_points(&self, together: usize) -> Vec<Vec<usize>> {
        let mut traces: Vec<usize> = self.curves.iter().map(|curve| curve.trace).collect();
        traces.dedup();
        let of =
            |traces: &[usize]| (0..self.curves.len()).filter(|&k| traces.contains(&self.curves[k].trace)).collect();
        traces.chunks(together).map(of).collect()
    }

    /// What was measured of the first curve; nothing where there is none.
    pub fn measures(&self) -> &[Value] {
        self.curves.first().map_or(&[], |curve| &curve.measures)
    }

    /// Whether nothing of the cell is kept.
    pub fn is_left_out(&self) -> bool {
        self.curves.is_empty() && self.left_out > 0
    }
}

/// Solves and measures the `k`-th cell of a family.
pub fn solve(family: &Family, sampler: &Sampler, k: usize) -> Option<Solved> {
    solve_measuring(family, sampler, k, &family.measures)
}

/// Solves the `k`-th cell of a family and computes the measures requested, by their indices in [`measure::ALL`]; those that
/// `where` uses must be among them.
pub fn solve_measuring(family: &Family, sampler: &Sampler, k: usize, requested: &[bool]) -> Option<Solved> {
    let cell = family.cell(k);
    // A family is validated cell by cell before it is swept, so every cell makes a linkage.
    let linkage = family.linkage(&cell).ok()?;
    let motion = Motion::of(&linkage, sampler);
    let mut solved = Solved { cell, linkage, motion, curves: Vec::new(), left_out: 0 };
    let mut curves = Vec::new();
    for (trace, &joint) in (1..).zip(&solved.linkage.traced) {
        for (number, circuit) in (1..).zip(&solved.motion.circuits) {
            let subject = Subject::new(&solved.linkage, &solved.motion, circuit, joint).asking(family.straight);
            let measures = measure::take_some(&subject, |measure| requested[measure]);
            if family.keeps(&solved.cell, &measures) {
                let (straight, symmetry) = subject.marks();
                curves.push(Curve { trace, circuit: number, joint, measures, straight, symmetry });
            } else {
                solved.left_out += 1;
            }
        }
    }
    // A cell without any motion is one row, of which only its own values can be asked.
    if !solved.motion.is_assembled() && !family.keeps(&solved.cell, &[]) {
        solved.left_out += 1;
    }
    solved.curves = curves;
    Some(solved)
}
