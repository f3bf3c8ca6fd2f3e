//! Samples of the lines of a chart between the cells of a family.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::adaptive::{AdaptiveInterval, ChartPoint, Sample};
use super::axis::AxisRange;
use super::path::settled_range;
use super::{Chart, ChartSample};
use coupler_curves::family::{Case, Family, ParameterSpace, Sampling};
use coupler_curves::measure::MeasureSet;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::Solver;

/// The most curves that are solved for a chart in addition to those of its cells: some seconds of work at most. A
/// chart with many cells gets fewer between two of them, and needs fewer.
const MAX_ADDITIONAL_CURVES: usize = 1 << 13;

/// The most additional samples between two cells: enough for some jumps, each of which takes about forty.
const MAX_SAMPLES: usize = 256;

/// The additional samples between any two cells, before those where a line is not straight get further ones.
const FIRST_SAMPLES: usize = 3;

/// The number of a traced joint and of a circuit, both from 1.
pub(super) type CurveKey = (usize, usize);

/// What is needed to solve a chart between its cells.
#[derive(Debug)]
pub(super) struct Refinement<'a> {
    line_solver: LineSolver<'a>,
    /// The intervals of all groups of cells.
    intervals: Vec<Interval>,
    /// The indices in `intervals` of those of each group.
    groups: Vec<Range<usize>>,
}

/// Solves cells between those of a family.
#[derive(Debug)]
struct LineSolver<'a> {
    chart: &'a Chart,
    family: &'a Family,
    sampler: Sampler,
    requested_measures: MeasureSet,
    /// The name that changes along a line, by its index.
    slot: usize,
    /// The axes of x and of each y.
    axes: Vec<AxisRange>,
}

/// The interval between two neighbouring cells on the lines of a group.
#[derive(Debug)]
pub struct Interval {
    /// The values of the first of the two cells.
    case: Case,
    /// The lines of the group.
    lines: Vec<CurveKey>,
    adaptive: AdaptiveInterval,
}

/// A path between two cells, and the least and the greatest y on it that are not on the side of a pole.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Path {
    pub points: Vec<[f64; 2]>,
    pub range: Option<[f64; 2]>,
}

/// Runs a function on every interval, on any thread and in any order.
pub type ForEachInterval<'f> = &'f dyn Fn(&mut [Interval], &(dyn Fn(&mut Interval) + Sync));

impl<'a> Refinement<'a> {
    /// The intervals of a chart; `None` if its lines do not follow one parameter, or have too many cells.
    ///
    /// `cells` are the numbers of the cells of each group in the order of its lines, and `samples` what was computed of
    /// each cell.
    pub fn new(
        chart: &'a Chart,
        family: &'a Family,
        cells: &[Vec<usize>],
        samples: &BTreeMap<usize, Vec<&ChartSample>>,
    ) -> Option<Refinement<'a>> {
        let interval_count: usize = cells.iter().map(|cells| cells.len().saturating_sub(1)).sum();
        let curves_per_cell = samples.values().map(Vec::len).max().unwrap_or(0);
        if FIRST_SAMPLES * interval_count * curves_per_cell > MAX_ADDITIONAL_CURVES {
            return None;
        }
        let slot = common_slot(family, cells).filter(|_| chart.is_ordered_by_x)?;
        let line_solver = LineSolver {
            chart,
            family,
            sampler: Sampler::new(Sampling::Samples(2)),
            requested_measures: used_measures(chart, family),
            slot,
            axes: axes(chart, samples.values().flatten().map(|sample| &sample.numbers[..])),
        };
        let (mut intervals, mut groups) = (Vec::new(), Vec::new());
        for cells in cells {
            let first = intervals.len();
            let of_cell = |cell: &usize| samples.get(cell).into_iter().flatten().copied();
            let lines: BTreeSet<CurveKey> =
                cells.iter().flat_map(of_cell).map(|sample| (sample.trace, sample.circuit)).collect();
            let lines: Vec<CurveKey> = lines.into_iter().collect();
            let sample = |cell: usize| line_solver.sample_of_cell(cell, &lines, of_cell(&cell));
            for pair in cells.windows(2) {
                intervals.push(Interval {
                    case: family.case(pair[0] - 1),
                    lines: lines.clone(),
                    adaptive: AdaptiveInterval::new(sample(pair[0]), sample(pair[1])),
                });
            }
            groups.push(first..intervals.len());
        }
        Some(Refinement { line_solver, intervals, groups })
    }

    /// Adds samples to all intervals, in rounds: in each, those that need further ones share what is left.
    pub fn refine(&mut self, for_each: ForEachInterval) {
        let curves_per_sample = self.intervals.iter().map(|interval| interval.lines.len()).max().unwrap_or(0).max(1);
        let all = MAX_ADDITIONAL_CURVES / curves_per_sample;
        let mut limit = FIRST_SAMPLES;
        while limit > 1 {
            let solver = &self.line_solver;
            for_each(&mut self.intervals, &|interval| interval.refine(limit, solver));
            let used: usize = self.intervals.iter().map(|interval| interval.adaptive.additional_count()).sum();
            let unfinished = self.intervals.iter().filter(|interval| interval.needs_samples()).count();
            limit = all.saturating_sub(used).checked_div(unfinished).unwrap_or(0);
        }
    }

    /// The paths of a line of a group for the quantity `chart.y` at an index, one between every two cells of the group.
    pub fn paths(&self, group: usize, line: CurveKey, quantity: usize) -> impl Iterator<Item = Path> {
        self.intervals[self.groups[group].clone()]
            .iter()
            .map(move |interval| interval.path(line, quantity, self.line_solver.chart.y.len()))
    }
}

impl Interval {
    /// Whether it may have further samples, at least two at a time.
    fn needs_samples(&self) -> bool {
        !self.adaptive.is_finished() && self.adaptive.additional_count() + 2 <= MAX_SAMPLES
    }

    fn refine(&mut self, limit: usize, solver: &LineSolver) {
        let Interval { case, lines, adaptive } = self;
        let limit = limit.min(MAX_SAMPLES - adaptive.additional_count().min(MAX_SAMPLES));
        adaptive.refine(limit, |parameter| solver.sample_between(case, lines, parameter));
    }

    fn path(&self, line: CurveKey, quantity: usize, quantities: usize) -> Path {
        let Some(index) = self.lines.iter().position(|known| *known == line) else { return Path::default() };
        let points = self.adaptive.path(index * quantities + quantity);
        Path { range: settled_range(&points), points: points.iter().map(|point| point.value).collect() }
    }
}

impl LineSolver<'_> {
    /// The sample at a cell of the family.
    fn sample_of_cell<'s>(
        &self,
        number: usize,
        lines: &[CurveKey],
        samples: impl Iterator<Item = &'s ChartSample>,
    ) -> Sample {
        let cell = self.family.cell(number - 1);
        let samples: Vec<&ChartSample> = samples.collect();
        self.sample(cell.values[self.slot], self.chart.cell_x(&cell), lines, &samples)
    }

    /// The sample at another value of the parameter.
    fn sample_between(&self, case: &Case, lines: &[CurveKey], parameter: f64) -> Sample {
        let changed = |&(slot, value): &(usize, f64)| (slot, if slot == self.slot { parameter } else { value });
        let case = case.iter().map(changed).collect();
        let family = Family { space: ParameterSpace::Cases(vec![case]), sort: None, ..self.family.clone() };
        let cell = family.cell(0);
        let x = self.chart.cell_x(&cell);
        // Between valid cells there may be some without a linkage.
        let solved = if family.cell_errors(&cell).is_empty() {
            Solver::with_sampler(&family, self.sampler.clone()).measuring(self.requested_measures).solve(0)
        } else {
            None
        };
        let samples = solved.map(|solved| self.chart.sample_cell(&family, &solved)).unwrap_or_default();
        self.sample(parameter, x, lines, &samples.iter().collect::<Vec<_>>())
    }

    fn sample(&self, parameter: f64, x: f64, lines: &[CurveKey], samples: &[&ChartSample]) -> Sample {
        let place = |axis: usize, value: f64| self.axes[axis].fraction(value).unwrap_or(f64::NAN);
        let mut points = Vec::with_capacity(lines.len() * self.chart.y.len());
        for line in lines {
            let sample = samples.iter().find(|sample| (sample.trace, sample.circuit) == *line);
            points.extend((1..=self.chart.y.len()).map(|k| {
                let y = sample.map_or(f64::NAN, |sample| sample.numbers[k]);
                ChartPoint { value: [x, y], place: [place(0, x), place(k, y)] }
            }));
        }
        Sample { parameter, points }
    }
}

/// The only assigned name whose values differ within groups of cells, given by the numbers of their cells.
fn common_slot(family: &Family, cells: &[Vec<usize>]) -> Option<usize> {
    if family.space.distinct_names().len() != 1 {
        return None;
    }
    let assigned = family.space.assigned_slots();
    let mut varying: BTreeSet<usize> = BTreeSet::new();
    for cells in cells {
        let values: Vec<Vec<f64>> = cells.iter().map(|cell| family.cell(cell - 1).values).collect();
        varying.extend(assigned.iter().filter(|&&slot| values.iter().any(|cell| cell[slot] != values[0][slot])));
        let [slot] = varying.iter().copied().collect::<Vec<_>>()[..] else { continue };
        let is_monotonic =
            values.is_sorted_by(|a, b| a[slot] < b[slot]) || values.is_sorted_by(|a, b| a[slot] > b[slot]);
        if !is_monotonic {
            return None;
        }
    }
    varying.first().copied().filter(|_| varying.len() == 1)
}

/// The measures that a chart and `where` need.
fn used_measures(chart: &Chart, family: &Family) -> MeasureSet {
    let quantities = std::iter::once(&chart.x).chain(&chart.y).map(|quantity| &quantity.expression);
    let expressions = quantities.chain(&family.filter);
    expressions.fold(MeasureSet::EMPTY, |set, expression| set | family.measures_in(expression))
}

/// The axes of x and of each y for the points of all curves.
fn axes<'s>(chart: &Chart, points: impl Iterator<Item = &'s [f64]> + Clone) -> Vec<AxisRange> {
    let quantities = std::iter::once(&chart.x).chain(&chart.y).enumerate();
    quantities.map(|(k, quantity)| AxisRange::new(quantity, points.clone().map(|numbers| numbers[k]))).collect()
}
