//! Every cell of a family through linkage, motion and measure: in parallel, in order, in bounded memory.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, TryRecvError};

use coupler_curves::family::Family;
use coupler_curves::measure;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, solve_measuring};
use rayon::prelude::*;

/// The cells of which something is kept, by their places; all of them where nothing is asked.
pub fn kept_cells(family: &Family) -> Vec<usize> {
    // Nobody stops this.
    let found = select_cells(family, false, &AtomicBool::new(false));
    found.map(|found| found.kept).unwrap_or_default()
}

/// Which cells of a family are shown, and in what order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellSelection {
    /// The cells of which something is kept, by their places; all of them where nothing is asked.
    pub kept: Vec<usize>,
    /// The same in the order of pages: sorted by the least rank of a cell's curves, the cells without a rank last.
    pub page_order: Vec<usize>,
    /// How many traced points of each are kept on any circuit, in the order of pages: none of a cell that is not
    /// assembled. Empty where it was not asked for.
    pub point_counts: Vec<usize>,
}

/// Solves the cells of a family as far as it takes to tell which are shown, where and, if that is asked, with how many
/// points; nothing where `stop` becomes true on the way.
pub fn select_cells(family: &Family, counts_points: bool, stop: &AtomicBool) -> Option<CellSelection> {
    let all = 0..family.cell_count();
    if family.filter.is_none() && family.sort.is_none() && !counts_points {
        let kept: Vec<usize> = all.collect();
        return Some(CellSelection { page_order: kept.clone(), kept, point_counts: Vec::new() });
    }
    struct RankedCell {
        cell: usize,
        rank: f64,
        points: usize,
    }
    let sampler = Sampler::new(family.sampling);
    // No more measures are taken than `where` and `sort` ask for.
    let asked: Vec<bool> = (0..measure::ALL.len()).map(|measure| family.filter_or_sort_uses(measure)).collect();
    let judge = |cell: usize| {
        let solved = if stop.load(Ordering::Relaxed) { None } else { solve_measuring(family, &sampler, cell, &asked) };
        let solved = solved.filter(|solved| !solved.is_left_out())?;
        let rank = |curve: &MeasuredCurve| family.sort_key(&solved.cell, &curve.values);
        let rank = solved.curves.iter().map(rank).fold(f64::NAN, f64::min);
        Some(RankedCell { cell, rank, points: solved.curves_by_traces(1).len() })
    };
    let mut judged: Vec<RankedCell> = all.into_par_iter().filter_map(judge).collect();
    if stop.load(Ordering::Relaxed) {
        return None;
    }
    let kept = judged.iter().map(|judged| judged.cell).collect();
    if family.sort.is_some() {
        judged.sort_by(|a, b| a.rank.is_nan().cmp(&b.rank.is_nan()).then(a.rank.total_cmp(&b.rank)));
    }
    let points = judged.iter().filter(|_| counts_points).map(|judged| judged.points).collect();
    Some(CellSelection { kept, page_order: judged.iter().map(|judged| judged.cell).collect(), point_counts: points })
}

/// Cells that are worked on in groups.
#[derive(Clone, Copy, Debug)]
pub struct CellGroups<'a> {
    /// The cells, by their places.
    pub cells: &'a [usize],
    /// How many of them make a group; the last may have fewer.
    pub size: usize,
    /// How many bytes the work on a group holds at a time, beside the group itself.
    pub work_bytes: usize,
    /// Which measures are taken, by their places in [`measure::ALL`], those that `where` asks for among them; the family's,
    /// where nothing is said.
    pub requested_measures: Option<&'a [bool]>,
}

/// About how many bytes are held at once.
const MAX_BYTES: usize = 240_000_000;

/// About how many bytes a place of a curve takes, with its row.
const BYTES_PER_POINT: usize = 100;

impl CellGroups<'_> {
    /// How many groups are held at once: what keeps the threads busy, and as many as the memory is meant for.
    fn max_in_flight(&self, family: &Family, sampler: &Sampler) -> usize {
        let places = sampler.full_turn().len() * family.template.curve_count() * self.size;
        let bytes = places * BYTES_PER_POINT + self.work_bytes;
        (MAX_BYTES / bytes.max(1)).clamp(1, rayon::current_num_threads() * 4)
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
pub fn process_groups<T: Send, E>(
    family: &Family,
    groups: CellGroups,
    work: impl Fn(usize, Vec<SolvedCell>) -> T + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let sampler = &Sampler::new(family.sampling);
    let at_once = groups.max_in_flight(family, sampler);
    let stopped = &AtomicBool::new(false);
    let work = &work;
    let wanted = groups.requested_measures.unwrap_or(&family.is_computed);
    let solve = move |cell: usize| solve_measuring(family, sampler, cell, wanted);
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
            let Some(result) = wait_for_result(&next) else { return Ok(()) };
            if let Err(error) = take(result) {
                stopped.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
    })
}

/// Waits for a result; a thread of the pool does other work meanwhile, which may be that very result.
fn wait_for_result<T>(result: &Receiver<T>) -> Option<T> {
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
