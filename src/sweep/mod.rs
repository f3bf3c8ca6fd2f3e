//! Solves the cells of a family in parallel, delivers the results in order, and uses bounded memory.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, TryRecvError};

use coupler_curves::family::Family;
use coupler_curves::measure;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, solve_measuring};
use rayon::prelude::*;

/// The cells that `where` keeps, by index, see [`CellSelection::kept`].
pub fn kept_cells(family: &Family) -> Vec<usize> {
    // This flag is never set.
    let found = select_cells(family, false, &AtomicBool::new(false));
    found.map(|found| found.kept).unwrap_or_default()
}

/// The cells of a family that are shown, and their order on pages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellSelection {
    /// The cells that `where` keeps, by index: those with a kept curve, and those that have no curves at all. All cells
    /// if there is no `where`.
    pub kept: Vec<usize>,
    /// The same cells in the order of pages: sorted by the least sort key of their curves, cells without a key last.
    pub page_order: Vec<usize>,
    /// The number of traced points of each cell that have a kept curve on any circuit, in the order of pages; 0 for a
    /// cell without curves. Empty if the counts were not requested.
    pub point_counts: Vec<usize>,
}

/// Selects the cells that are shown; `None` if `stop` becomes true. The cells are solved only if `where`, `sort` or
/// `counts_points` require it.
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
    // Only the measures that `where` and `sort` use are computed.
    let measures: Vec<bool> = (0..measure::ALL.len()).map(|measure| family.filter_or_sort_uses(measure)).collect();
    let rank_cell = |cell: usize| {
        let solved =
            if stop.load(Ordering::Relaxed) { None } else { solve_measuring(family, &sampler, cell, &measures) };
        let solved = solved.filter(|solved| !solved.is_left_out())?;
        let rank = |curve: &MeasuredCurve| family.sort_key(&solved.cell, &curve.values);
        let rank = solved.curves.iter().map(rank).fold(f64::NAN, f64::min);
        Some(RankedCell { cell, rank, points: solved.curves_by_traces(1).len() })
    };
    let mut ranked: Vec<RankedCell> = all.into_par_iter().filter_map(rank_cell).collect();
    if stop.load(Ordering::Relaxed) {
        return None;
    }
    let kept = ranked.iter().map(|ranked| ranked.cell).collect();
    if family.sort.is_some() {
        ranked.sort_by(|a, b| a.rank.is_nan().cmp(&b.rank.is_nan()).then(a.rank.total_cmp(&b.rank)));
    }
    let points = ranked.iter().filter(|_| counts_points).map(|ranked| ranked.points).collect();
    Some(CellSelection { kept, page_order: ranked.iter().map(|ranked| ranked.cell).collect(), point_counts: points })
}

/// Cells to be processed in groups.
#[derive(Clone, Copy, Debug)]
pub struct CellGroups<'a> {
    /// The cells, by index.
    pub cells: &'a [usize],
    /// The number of cells in a group; the last group may have fewer.
    pub size: usize,
    /// The memory that processing a group takes in addition to the group itself, in bytes.
    pub work_bytes: usize,
    /// Which measures are computed, by their indices in [`measure::ALL`]; must include those that `where` uses. Those
    /// of the family if `None`.
    pub requested_measures: Option<&'a [bool]>,
}

/// The approximate limit of memory for groups in flight, in bytes.
const MAX_BYTES: usize = 240_000_000;

/// The approximate memory of a point of a curve and its row, in bytes.
const BYTES_PER_POINT: usize = 100;

impl CellGroups<'_> {
    /// The number of groups in flight: enough to keep the threads busy, within the limit of memory.
    fn max_in_flight(&self, family: &Family, sampler: &Sampler) -> usize {
        let points = sampler.full_turn().len() * family.template.curve_count() * self.size;
        let bytes = points * BYTES_PER_POINT + self.work_bytes;
        (MAX_BYTES / bytes.max(1)).clamp(1, rayon::current_num_threads() * 4)
    }
}

/// Solves groups of cells and passes them to `work` on all threads, and passes the results in order to `receive` on the
/// calling thread. Meanwhile the other threads continue, but at most a few groups per thread ahead.
///
/// `work` gets the index of the group, from 0, and its solved cells. Results and their order do not depend on the
/// number of threads.
///
/// # Errors
/// The first error of `receive`; no further group is then begun.
pub fn process_groups<T: Send, E>(
    family: &Family,
    groups: CellGroups,
    work: impl Fn(usize, Vec<SolvedCell>) -> T + Sync,
    mut receive: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let sampler = &Sampler::new(family.sampling);
    let max_in_flight = groups.max_in_flight(family, sampler);
    let stopped = &AtomicBool::new(false);
    let work = &work;
    let measures = groups.requested_measures.unwrap_or(&family.is_computed);
    let solve = move |cell: usize| solve_measuring(family, sampler, cell, measures);
    let solve_group = move |group: usize, cells: &[usize]| {
        let is_running = |_: &&usize| !stopped.load(Ordering::Relaxed);
        let solved = cells.iter().take_while(is_running).filter_map(|&cell| solve(cell)).collect();
        (!stopped.load(Ordering::Relaxed)).then(|| work(group, solved))
    };
    let mut remaining = groups.cells.chunks(groups.size.max(1)).enumerate();
    rayon::in_place_scope_fifo(|scope| {
        let mut in_flight: VecDeque<Receiver<T>> = VecDeque::with_capacity(max_in_flight);
        loop {
            for (group, cells) in remaining.by_ref().take(max_in_flight - in_flight.len()) {
                let (done, result) = mpsc::sync_channel(1);
                in_flight.push_back(result);
                scope.spawn_fifo(move |_| {
                    // After an error no one receives the result.
                    let _ = solve_group(group, cells).map(|output| done.send(output));
                });
            }
            let Some(next) = in_flight.pop_front() else { return Ok(()) };
            // A group whose work panicked has no result; the scope then panics, too.
            let Some(result) = wait_for_result(&next) else { return Ok(()) };
            if let Err(error) = receive(result) {
                stopped.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
    })
}

/// Waits for a result. A thread of the pool meanwhile does other work, possibly that of this very result.
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
