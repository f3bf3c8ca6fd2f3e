//! Solves cells of a family.

use std::panic::{self, AssertUnwindSafe};
use std::rc::Rc;

use super::screening::Screening;
use super::solved_cell::{MeasuredCurve, SolvedCell};
use crate::family::{Cell, Family};
use crate::linkage::Linkage;
use crate::measure::{MeasureSet, TracedCurve};
use crate::motion::{AssemblyError, Motion, NeighbourLinkages, Sampler};

/// Solves cells of a family, in any order and on any threads: their linkages, their motion, and the measures of their curves.
///
/// ```
/// use coupler_curves::catalogue;
/// use coupler_curves::family::{Family, Sampling};
/// use coupler_curves::measure::Measure;
/// use coupler_curves::solve::Solver;
///
/// let evans = [("p", 2.0), ("r", 2.0), ("a", 1.0)].map(|(name, value)| (name.to_owned(), value));
/// let family = Family::single_cell(catalogue::find("evans").unwrap(), &evans, Sampling::Samples(360))?;
/// let solved = Solver::new(&family).solve(0).unwrap();
/// println!("{} curves, the first {:?} long", solved.curves.len(), solved.curves[0].measure(Measure::LENGTH));
/// # assert!(solved.motion.is_assembled());
/// # Ok::<(), coupler_curves::family::ParameterErrors>(())
/// ```
#[derive(Clone, Debug)]
pub struct Solver<'f> {
    family: &'f Family,
    sampler: Sampler,
    screening: Screening,
}

impl<'f> Solver<'f> {
    /// A solver that samples circuits and computes measures as the family asks for.
    pub fn new(family: &'f Family) -> Solver<'f> {
        Solver::with_sampler(family, Sampler::new(family.sampling))
    }

    /// The same with a sampler, which may be one that other solvers share.
    pub fn with_sampler(family: &'f Family, sampler: Sampler) -> Solver<'f> {
        Solver { family, sampler, screening: Screening::new(family) }
    }

    /// The same solver that computes these measures of the curves that `where` keeps, and the measures that it uses.
    pub fn measuring(mut self, requested: MeasureSet) -> Solver<'f> {
        self.screening.requested = requested;
        self
    }

    /// Solves the `k`-th cell, from 0. `None` if it has no linkage, which is so in no family whose cells have no
    /// [`Family::cell_errors`].
    ///
    /// A panic in it is an error of the program, but it ends neither the program nor the solving of other cells: it is the reason
    /// of a cell with the status [`Status::Failed`](super::Status::Failed).
    pub fn solve(&self, k: usize) -> Option<SolvedCell> {
        let cell = self.family.cell(k);
        let linkage = self.family.linkage(&cell).ok()?;
        let solved = catch_panic(|| self.solve_linkage(&cell, &linkage));
        let (motion, curves, left_out_count) = solved.unwrap_or_else(|message| {
            let motion = Motion { circuits: Vec::new(), assembly_error: Some(AssemblyError::Failed { message }) };
            (motion, Vec::new(), usize::from(!self.family.keeps(&cell, &[])))
        });
        Some(SolvedCell { cell, linkage, motion, curves, left_out_count })
    }

    /// Solves the `k`-th cell, from 0, whose curves have been measured before: `measured` is the curves and the number of those that
    /// `where` excludes, as of [`Solver::solve`]. `None` if there are neither: why there are none is not known from it.
    pub fn solve_measured(&self, k: usize, measured: (Vec<MeasuredCurve>, usize)) -> Option<SolvedCell> {
        let (curves, left_out_count) = measured;
        if curves.is_empty() && left_out_count == 0 {
            return None;
        }
        let cell = self.family.cell(k);
        let linkage = self.family.linkage(&cell).ok()?;
        let motion = Motion::solve(&linkage, &self.sampler);
        Some(SolvedCell { cell, linkage, motion, curves, left_out_count })
    }

    /// The motion of a cell's linkage, the curves that `where` keeps, and the number of those that it excludes.
    fn solve_linkage(&self, cell: &Cell, linkage: &Linkage) -> (Motion, Vec<MeasuredCurve>, usize) {
        let motion = Motion::solve(linkage, &self.sampler);
        let (mut curves, mut left_out_count) = (Vec::new(), 0);
        let circuit_count = motion.circuits.len();
        let numbers =
            (1..=linkage.traced.len()).flat_map(|trace| (1..=circuit_count).map(move |circuit| (trace, circuit)));
        let values = linkage.tolerance.map(|_| self.family.parameter_values(cell));
        let neighbours =
            values.and_then(|values| self.family.template.neighbours(values, NeighbourLinkages::STEP)).map(Rc::new);
        for ((trace, circuit), curve) in numbers.zip(TracedCurve::all(linkage, &motion)) {
            let curve = curve.with_straight_criterion(self.family.straight).with_neighbours(neighbours.clone());
            if let Some(values) = self.screening.measure(cell, &curve) {
                let (straight, symmetry, moves) = curve.computed_marks();
                curves.push(MeasuredCurve { trace, circuit, joint: curve.joint, values, straight, symmetry, moves });
            } else {
                left_out_count += 1;
            }
        }
        // A cell without motion is one row, and `where` sees only its parameter values.
        if !motion.is_assembled() && !self.family.keeps(cell, &[]) {
            left_out_count += 1;
        }
        (motion, curves, left_out_count)
    }
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
