//! Every cell of a family through linkage, motion and measure: in parallel, in order, in bounded memory.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, TryRecvError};

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
    solve_for(family, sampler, k, |subject| measure::take_some(subject, |measure| family.measures[measure]))
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
    // Nobody stops this.
    let found = arrange(family, false, &AtomicBool::new(false));
    found.map(|found| found.kept).unwrap_or_default()
}

/// Which cells of a family are shown, and in what order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrangement {
    /// The cells of which something is kept, by their places; all of them where nothing is asked.
    pub kept: Vec<usize>,
    /// The same in the order of pages: sorted by the least rank of a cell's curves, the cells without a rank last.
    pub order: Vec<usize>,
    /// How many traced points of each are kept on any circuit, in the order of pages: none of a cell that is not
    /// assembled. Empty where it was not asked for.
    pub points: Vec<usize>,
}

/// Solves the cells of a family as far as it takes to tell which are shown, where and, if that is asked, with how many
/// points; nothing where `stop` becomes true on the way.
pub fn arrange(family: &Family, counts_points: bool, stop: &AtomicBool) -> Option<Arrangement> {
    let all = 0..family.cells();
    if family.filter.is_none() && family.sort.is_none() && !counts_points {
        let kept: Vec<usize> = all.collect();
        return Some(Arrangement { order: kept.clone(), kept, points: Vec::new() });
    }
    struct Judged {
        cell: usize,
        rank: f64,
        points: usize,
    }
    let sampler = Sampler::new(family.sampling);
    // No more measures are taken than `where` and `sort` ask for.
    let asked: Vec<bool> = (0..measure::ALL.len()).map(|measure| family.asks_for(measure)).collect();
    let take = |subject: &Subject| measure::take_some(subject, |measure| asked[measure]);
    let judge = |cell: usize| {
        let solved = if stop.load(Ordering::Relaxed) { None } else { solve_for(family, &sampler, cell, take) };
        let solved = solved.filter(|solved| !solved.is_left_out())?;
        let rank = |curve: &Curve| family.rank(&solved.cell, &curve.measures);
        let rank = solved.curves.iter().map(rank).fold(f64::NAN, f64::min);
        Some(Judged { cell, rank, points: solved.by_points(1).len() })
    };
    let mut judged: Vec<Judged> = all.into_par_iter().filter_map(judge).collect();
    if stop.load(Ordering::Relaxed) {
        return None;
    }
    let kept = judged.iter().map(|judged| judged.cell).collect();
    if family.sort.is_some() {
        judged.sort_by(|a, b| a.rank.is_nan().cmp(&b.rank.is_nan()).then(a.rank.total_cmp(&b.rank)));
    }
    let points = judged.iter().filter(|_| counts_points).map(|judged| judged.points).collect();
    Some(Arrangement { kept, order: judged.iter().map(|judged| judged.cell).collect(), points })
}

/// Cells that are worked on in groups.
#[derive(Clone, Copy, Debug)]
pub struct Groups<'a> {
    /// The cells, by their places.
    pub cells: &'a [usize],
    /// How many of them make a group; the last may have fewer.
    pub size: usize,
    /// How many bytes the work on a group holds at a time, beside the group itself.
    pub bytes: usize,
    /// Which measures are taken, by their places in [`measure::ALL`], those that `where` asks for among them; the family's,
    /// where nothing is said.
    pub wanted: Option<&'a [bool]>,
}

/// About how many bytes are held at once.
const MOST_BYTES: usize = 240_000_000;

/// About how many bytes a place of a curve takes, with its row.
const BYTES_OF_A_PLACE: usize = 100;

impl Groups<'_> {
    /// How many groups are held at once: what keeps the threads busy, and as many as the memory is meant for.
    fn at_once(&self, family: &Family, sampler: &Sampler) -> usize {
        let places = sampler.turn().len() * family.template.curves() * self.size;
        let bytes = places * BYTES_OF_A_PLACE + self.bytes;
        (MOST_BYTES / bytes.max(1)).clamp(1, rayon::current_num_threads() * 4)
    }
}

/// Takes groups of cells through `work` on all threads and hands the results to `take` in order, on the thread that
/// calls: while it takes, the others go on, but no further than a few groups to a thread.
///
/// `work` is given the number of the group, from 0, and its solved cells. Results and their order do not depend on the
/// number of threads.
///
/// # Errors
/// The first error of `take`, after which nothing more is begun.
pub fn run<T: Send, E>(
    family: &Family,
    groups: Groups,
    work: impl Fn(usize, Vec<Solved>) -> T + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let sampler = &Sampler::new(family.sampling);
    let at_once = groups.at_once(family, sampler);
    let stopped = &AtomicBool::new(false);
    let work = &work;
    let wanted = groups.wanted.unwrap_or(&family.measures);
    let is_wanted = move |measure: usize| wanted[measure];
    let solve = move |cell: usize| solve_for(family, sampler, cell, |subject| measure::take_some(subject, is_wanted));
    let solve_group = move |group: usize, cells: &[usize]| {
        let goes_on = |_: &&usize| !stopped.load(Ordering::Relaxed);
        let solved = cells.iter().take_while(goes_on).filter_map(|&cell| solve(cell)).collect();
        (!stopped.load(Ordering::Relaxed)).then(|| work(group, solved))
    };
    let mut coming = groups.cells.chunks(groups.size.max(1)).enumerate();
    rayon::in_place_scope_fifo(|scope| {
        let mut ahead: VecDeque<Receiver<T>> = VecDeque::with_capacity(at_once);
        loop {
            for (group, cells) in coming.by_ref().take(at_once - ahead.len()) {
                let (done, result) = mpsc::sync_channel(1);
                ahead.push_back(result);
                scope.spawn_fifo(move |_| {
                    // Where nothing is taken any more, nobody waits for it.
                    let _ = solve_group(group, cells).map(|made| done.send(made));
                });
            }
            let Some(next) = ahead.pop_front() else { return Ok(()) };
            // Of a group whose work panicked there is nothing; the scope panics in its turn.
            let Some(result) = wait(&next) else { return Ok(()) };
            if let Err(error) = take(result) {
                stopped.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
    })
}

/// Waits for a result; a thread of the pool does other work meanwhile, which may be that very result.
fn wait<T>(result: &Receiver<T>) -> Option<T> {
    loop {
        match result.try_recv() {
            Ok(result) => return Some(result),
            Err(TryRecvError::Disconnected) => return None,
            Err(TryRecvError::Empty) => match rayon::yield_now() {
                None => return result.recv().ok(),
                Some(rayon::Yield::Executed) => {}
                Some(rayon::Yield::Idle) => std::thread::yield_now(),
            },
        }
    }
}
