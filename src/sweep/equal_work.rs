//! Parts of a family's cells that take about equally long.

use std::convert::Infallible;
use std::ops::Range;

use coupler_curves::family::Family;
use coupler_curves::measure::MeasureSet;
use coupler_curves::motion::MAX_CIRCUIT_BYTES;
use coupler_curves::solve::SolvedCell;

use super::{CellGroups, CellIndices, Division, process_groups};

/// The work of a cell of which no curve is kept, some 5 microseconds, is 1; that of each curve that `where` keeps is added, some 100
/// microseconds with the measures of a few straight portions. With dearer measures parts are still equally large in curves.
const CURVE_WORK: u64 = 20;

/// The most cells that are solved to estimate where the work is. By so many parts of a million cells are equal within some percent.
const MAX_SAMPLES: usize = 4096;

/// One of so many cells of a part, at most, is solved to estimate where the work is, so that estimates cost little beside the work.
const CELLS_PER_SAMPLE: usize = 16;

/// The fewest samples that say more than that cells are alike.
const MIN_SAMPLES: usize = 16;

/// The indices of the cells of a part of a family. The parts of which a division has several are consecutive, and have about equally much work:
/// `where` may leave out whole stretches of cells, which are found by cells at equal distances. The result depends on the family alone, and not on
/// the measures of its tables.
pub fn cells_of_division(family: &Family, division: Division) -> Range<usize> {
    let count = family.cell_count();
    let Division::Shard { index, of } = division else { return division.range(count) };
    let samples = (count / of.max(1) / CELLS_PER_SAMPLE).min(MAX_SAMPLES);
    if of <= 1 || samples < MIN_SAMPLES || family.estimate_cell_bytes() > MAX_CIRCUIT_BYTES {
        return division.range(count);
    }
    let strata: Vec<Range<usize>> =
        (0..samples).map(|index| Division::Shard { index, of: samples }.range(count)).collect();
    let middle = |stratum: &Range<usize>| u32::try_from(stratum.start + stratum.len() / 2).unwrap_or(u32::MAX);
    let works = works(family, CellIndices::Listed(strata.iter().map(middle).collect()));
    let start = |index: usize| start_of_part((index, of), &strata, &works);
    start(index)..start(index + 1)
}

/// The work of cells.
fn works(family: &Family, cells: CellIndices) -> Vec<u64> {
    let requested_measures = Some(MeasureSet::EMPTY);
    let groups =
        CellGroups { cells: &cells, first_group: 0, size: 1, work_bytes: 0, requested_measures, solve_known: None };
    // A cell with errors, which are reported with those of its part, has no curves.
    let work = |_, solved: Vec<SolvedCell>| {
        1 + CURVE_WORK * solved.iter().map(|solved| solved.curves.len() as u64).sum::<u64>()
    };
    let mut works = Vec::with_capacity(cells.len());
    let Ok(()) = process_groups(family, groups, work, |work| -> Result<(), Infallible> {
        works.push(work);
        Ok(())
    });
    works
}

/// The index of the first cell of a part of several, where the cells of each stratum have the same work.
fn start_of_part((index, of): (usize, usize), strata: &[Range<usize>], works: &[u64]) -> usize {
    // Work times the number of parts, which has no fractions and more than 64 bits.
    let work_of = |(stratum, work): (&Range<usize>, &u64)| stratum.len() as u128 * u128::from(*work);
    let total: u128 = strata.iter().zip(works).map(work_of).sum();
    let mut rest = total * index as u128;
    for (stratum, work) in strata.iter().zip(works) {
        let cell_work = u128::from(*work) * of as u128;
        let cells = rest / cell_work;
        if cells < stratum.len() as u128 {
            return stratum.start + cells as usize;
        }
        rest -= cell_work * stratum.len() as u128;
    }
    strata.last().map_or(0, |stratum| stratum.end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_consecutive_and_of_equal_work() {
        let strata = [0..10, 10..30, 30..40];
        let works = [1, 20, 2];
        let starts: Vec<usize> = (0..=5).map(|index| start_of_part((index, 5), &strata, &works)).collect();
        // The work is 10 + 400 + 20, a part 86.
        assert_eq!(starts, [0, 13, 18, 22, 26, 40]);
        // As many parts as cells and more.
        let starts: Vec<usize> = (0..=1000).map(|index| start_of_part((index, 1000), &strata, &works)).collect();
        assert!(starts.is_sorted());
        assert_eq!([starts[0], starts[1000]], [0, 40]);
    }
}
