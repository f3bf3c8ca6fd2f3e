//! Every cell of a family through linkage, motion and measure: in parallel, in order, in bounded memory.

use rayon::prelude::*;

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
    solve_for(family, sampler, k, measure::take)
}

/// Solves the `k`-th cell of a family, and takes some measures of it.
fn solve_for(family: &Family, sampler: &Sampler, k: usize, take: impl Fn(&Subject) -> Vec<Value>) -> Option<Solved> {
    let cell = family.cell(k);
    // A family is validated cell by cell before it is swept, so every cell makes a linkage.
    let linkage = family.linkage(&cell).ok()?;
    let motion = Motion::of(&linkage, sampler);
    let mut solved = Solved { cell, linkage, motion, curves: Vec::new(), left_out: 0 };
    let mut curves = Vec::new();
    for (trace, &joint) in (1..).zip(&solved.linkage.traced) {
        for (number, circuit) in (1..).zip(&solved.motion.circuits) {
            let subject = Subject::new(&solved.linkage, &solved.motion, circuit, joint).asking(family.straight);
            let measures = take(&subject);
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

/// The cells of which something is kept, by their places; all of them where nothing is asked.
pub fn select(family: &Family) -> Vec<usize> {
    let all = 0..family.cells();
    if family.filter.is_none() {
        return all.collect();
    }
    let judged = judged(family);
    let is_kept = |&k: &usize| judged(k).is_some_and(|solved| !solved.is_left_out());
    all.into_par_iter().filter(is_kept).collect()
}

/// The places of cells in the order of pages: those of [`select`], sorted by the least rank of a cell's curves, the cells
/// without a rank last.
pub fn order(family: &Family, kept: &[usize]) -> Vec<usize> {
    if family.sort.is_none() {
        return kept.to_vec();
    }
    let judged = judged(family);
    let rank = |&k: &usize| {
        let ranks = |solved: Solved| {
            let of = |curve: &Curve| family.rank(&solved.cell, &curve.measures);
            solved.curves.iter().map(of).fold(f64::NAN, f64::min)
        };
        (judged(k).map_or(f64::NAN, ranks), k)
    };
    let mut ranked: Vec<(f64, usize)> = kept.par_iter().map(rank).collect();
    ranked.sort_by(|a, b| a.0.is_nan().cmp(&b.0.is_nan()).then(a.0.total_cmp(&b.0)).then(a.1.cmp(&b.1)));
    ranked.into_iter().map(|(_, k)| k).collect()
}

/// How many traced points of each of some cells are kept on any circuit; none of a cell that is not assembled.
pub fn points(family: &Family, cells: &[usize]) -> Vec<usize> {
    let judged = judged(family);
    cells.par_iter().map(|&k| judged(k).map_or(0, |solved| solved.by_points(1).len())).collect()
}

/// Solves cells of a family, and takes no more measures of them than `where` and `sort` ask for.
fn judged(family: &Family) -> impl Fn(usize) -> Option<Solved> + Sync + '_ {
    let sampler = Sampler::new(family.sampling);
    let asked: Vec<bool> = (0..measure::ALL.len()).map(|measure| family.asks_for(measure)).collect();
    move |k| solve_for(family, &sampler, k, |subject| measure::take_some(subject, |measure| asked[measure]))
}

/// About how many places of curves are held at once: 2^21 of them, and their rows, are some 200 MB.
const MOST_PLACES: usize = 1 << 21;

/// Takes groups of cells through `work` on all threads and hands the results to `take` in order.
///
/// `work` is given the number of the group, from 0, and its solved cells. No more than a few groups to a thread are
/// held at once. Results and their order do not depend on the number of threads.
///
/// # Errors
/// The first error of `take`, after which nothing more is done.
pub fn run<T: Send, E: Send>(
    family: &Family,
    (cells, group): (&[usize], usize),
    work: impl Fn(usize, Vec<Solved>) -> T + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let sampler = Sampler::new(family.sampling);
    let groups: Vec<&[usize]> = cells.chunks(group.max(1)).collect();
    // No more is held at once than keeps the threads busy, and no more than a few million places of curves.
    let places = sampler.turn().len() * family.template.curves() * group;
    let at_once = (MOST_PLACES / places.max(1)).clamp(1, rayon::current_num_threads() * 4);
    for (batch, groups) in groups.chunks(at_once).enumerate() {
        let solve_group = |(k, cells): (usize, &&[usize])| {
            let solved = cells.iter().filter_map(|&cell| solve(family, &sampler, cell)).collect();
            work(batch * at_once + k, solved)
        };
        let done: Vec<T> = groups.par_iter().enumerate().map(solve_group).collect();
        for result in done {
            take(result)?;
        }
    }
    Ok(())
}
