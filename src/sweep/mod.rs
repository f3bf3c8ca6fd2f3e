//! Solves the cells of a family in parallel, delivers the results in order, and uses bounded memory.

mod cell_indices;
mod diagnosis;
mod division;
mod equal_work;

pub use cell_indices::CellIndices;
pub use diagnosis::{Diagnosis, diagnose};
pub use division::{Division, MAX_RANGES, MAX_SHARDS, number_ranges};
pub use equal_work::cells_of_division;

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, TryRecvError};

use coupler_curves::family::Family;
use coupler_curves::measure::MeasureSet;
use coupler_curves::motion;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, Solver};
use rayon::prelude::*;

/// The cells that `where` keeps, by index, see [`CellSelection::kept`].
pub fn kept_cells(family: &Family) -> CellIndices {
    // This flag is never set.
    let found = select_cells(family, false, &AtomicBool::new(false));
    found.map(|found| found.kept).unwrap_or_default()
}

/// Whether any cell of a family has a curve; most often the first has one.
pub fn has_curve(family: &Family) -> bool {
    let solver = Solver::new(family).measuring(MeasureSet::EMPTY);
    let is_assembled = |cell: usize| solver.solve(cell).is_some_and(|solved| solved.motion.is_assembled());
    is_assembled(0) || (1..family.cell_count()).into_par_iter().any(is_assembled)
}

/// The cells of a family that are shown, and their order on pages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellSelection {
    /// The cells that `where` keeps, by index: those with a kept curve, and those that have no curves at all. All cells
    /// if there is no `where`.
    pub kept: CellIndices,
    /// The same cells sorted by the least sort key of their curves, cells without a key last; `None` if they are not
    /// sorted.
    pub sorted: Option<CellIndices>,
    /// The number of cells that `where` does not keep because they cannot be assembled: it uses measures.
    pub unassembled_left_out: usize,
    /// The number of traced points of each cell that have a kept curve on any circuit, in the order of pages; 0 for a
    /// cell without curves. Empty if the counts were not requested.
    pub point_counts: Vec<u32>,
}

impl CellSelection {
    /// The cells in the order of pages.
    pub fn page_order(&self) -> &CellIndices {
        self.sorted.as_ref().unwrap_or(&self.kept)
    }
}

/// The number of cells that are ranked before their ranks are stored, to bound the memory of a selection.
const CELLS_PER_BLOCK: usize = 1 << 14;

/// Whether [`select_cells`] has to solve cells.
pub fn selects_by_solving(family: &Family, counts_points: bool) -> bool {
    family.filter.is_some() || family.sort.is_some() || counts_points
}

/// Selects the cells that are shown; `None` if `stop` becomes true. The cells are solved only if `where`, `sort` or
/// `counts_points` require it.
///
/// The selection takes no memory if no cell is solved, otherwise 4 bytes for each cell that is kept, and 12 more for
/// each that is sorted.
pub fn select_cells(family: &Family, counts_points: bool, stop: &AtomicBool) -> Option<CellSelection> {
    let count = family.cell_count();
    if !selects_by_solving(family, counts_points) {
        return Some(CellSelection { kept: CellIndices::Range(0..count), ..CellSelection::default() });
    }
    struct RankedCell {
        cell: u32,
        rank: u64,
        points: u32,
    }
    let solver = Solver::new(family).measuring(family.selection_measures());
    // A condition on parameters alone leaves out a cell whether it can be assembled or not.
    let needs_curves = family.filter_uses_measures();
    let unassembled = AtomicUsize::new(0);
    let rank_cell = |cell: usize| {
        let solved = if stop.load(Ordering::Relaxed) { None } else { solver.solve(cell) }?;
        if solved.is_left_out() {
            let is_unassembled = needs_curves && !solved.motion.is_assembled();
            unassembled.fetch_add(usize::from(is_unassembled), Ordering::Relaxed);
            return None;
        }
        let key = |curve: &MeasuredCurve| family.sort_key(&solved.cell, &curve.values);
        let rank = rank_bits(solved.curves.iter().map(key).fold(f64::NAN, f64::min));
        let points = u32::try_from(solved.traced_point_count()).unwrap_or(u32::MAX);
        Some(RankedCell { cell: u32::try_from(cell).ok()?, rank, points })
    };
    let (mut kept, mut ranks, mut points) = (Vec::new(), Vec::new(), Vec::new());
    for start in (0..count).step_by(CELLS_PER_BLOCK) {
        let block = start..count.min(start + CELLS_PER_BLOCK);
        let ranked: Vec<RankedCell> = block.into_par_iter().filter_map(rank_cell).collect();
        if stop.load(Ordering::Relaxed) {
            return None;
        }
        for RankedCell { cell, rank, points: point_count } in ranked {
            kept.push(cell);
            ranks.extend(family.sort.is_some().then_some(rank));
            points.extend(counts_points.then_some(point_count));
        }
    }
    let unassembled_left_out = unassembled.into_inner();
    if family.sort.is_none() {
        let kept = CellIndices::Listed(kept);
        return Some(CellSelection { kept, sorted: None, unassembled_left_out, point_counts: points });
    }
    // The indices of kept cells in the order of pages; cells of equal rank remain in their order.
    let mut order: Vec<u32> = (0..).take(kept.len()).collect();
    order.sort_unstable_by_key(|&k| (ranks[k as usize], k));
    let point_counts = if counts_points { order.iter().map(|&k| points[k as usize]).collect() } else { points };
    order.iter_mut().for_each(|k| *k = kept[*k as usize]);
    let sorted = Some(CellIndices::Listed(order));
    Some(CellSelection { kept: CellIndices::Listed(kept), sorted, unassembled_left_out, point_counts })
}

/// A number whose order is that of sort keys: as [`f64::total_cmp`], and a key that is NaN last.
fn rank_bits(key: f64) -> u64 {
    let bits = key.to_bits();
    match key {
        key if key.is_nan() => u64::MAX,
        key if key.is_sign_negative() => !bits,
        _ => bits | 1 << 63,
    }
}

/// Cells to be processed in groups.
#[derive(Clone, Copy)]
pub struct CellGroups<'a> {
    /// The cells, by index.
    pub cells: &'a CellIndices,
    /// The first group to be processed, from 0; those before it are left out.
    pub first_group: usize,
    /// The number of cells in a group; the last group may have fewer.
    pub size: usize,
    /// The memory that processing a group takes in addition to the group itself, in bytes.
    pub work_bytes: usize,
    /// The measures that are computed, and those that `where` uses; those of the family if `None`.
    pub requested_measures: Option<MeasureSet>,
    /// Solves a cell by its index from what is known of it already; `None` for a cell of which nothing is known.
    pub solve_known: Option<&'a SolveKnown<'a>>,
}

/// Solves a cell of which something is known.
pub type SolveKnown<'a> = dyn Fn(&Solver, usize) -> Option<SolvedCell> + Sync + 'a;

/// The approximate limit of memory for groups in flight, in bytes.
const MAX_BYTES: usize = motion::MAX_CIRCUIT_BYTES;

impl CellGroups<'_> {
    /// The number of groups in flight: enough to keep the threads busy, within the limit of memory.
    fn max_in_flight(&self, family: &Family) -> usize {
        let bytes = family.estimate_cell_bytes().saturating_mul(self.size).saturating_add(self.work_bytes);
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
    let solver = &Solver::new(family).measuring(groups.requested_measures.unwrap_or(family.measures));
    let max_in_flight = groups.max_in_flight(family);
    let stopped = &AtomicBool::new(false);
    let work = &work;
    let known = groups.solve_known;
    let solve = move |cell: usize| {
        let solved = known.and_then(|known| known(solver, cell));
        solved.or_else(|| solver.solve(cell))
    };
    let cells = groups.cells;
    let size = groups.size.max(1);
    let solve_group = move |group: usize| {
        let is_running = |_: &usize| !stopped.load(Ordering::Relaxed);
        let indices = group * size..cells.len().min((group + 1) * size);
        let indices = indices.filter_map(|k| cells.get(k)).take_while(is_running);
        let solved = indices.filter_map(solve).collect();
        (!stopped.load(Ordering::Relaxed)).then(|| work(group, solved))
    };
    let mut remaining = groups.first_group..cells.len().div_ceil(size);
    rayon::in_place_scope_fifo(|scope| {
        let mut in_flight: VecDeque<Receiver<T>> = VecDeque::with_capacity(max_in_flight);
        loop {
            for group in remaining.by_ref().take(max_in_flight - in_flight.len()) {
                let (done, result) = mpsc::sync_channel(1);
                in_flight.push_back(result);
                scope.spawn_fifo(move |_| {
                    // After an error no one receives the result.
                    let _ = solve_group(group).map(|output| done.send(output));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_in_the_order_of_sort_keys() {
        let keys = [f64::NEG_INFINITY, -2.0, -1.0, -0.0, 0.0, f64::MIN_POSITIVE, 1.0, 2.0, f64::INFINITY, f64::NAN];
        assert!(keys.map(rank_bits).is_sorted_by(|a, b| a < b));
        assert_eq!(rank_bits(-f64::NAN), rank_bits(f64::NAN));
    }
}
