//! The curves of an atlas that are nearest to a path, where they are placed on it.

use crate::threads::Interrupted;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use coupler_curves::expression::{CompiledExpression, Kind};
use coupler_curves::family::Family;
use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::measure::{self, MeasureSet};
use coupler_curves::solve::{MeasuredCurve, SolvedCell, Solver};
use coupler_find::{
    Constraint, CurveFitOptions, CurveFitter, CurveIndex, CurveLookup, CurveShape, PlacedCurve, Target, is_scalable,
};

use super::super::Error;
use super::answer::{AtlasAnswer, AtlasQuery};
use crate::manifest::Plan;
use crate::sweep::{self, CellGroups, CellIndices};

/// What the curves of an atlas are compared by, and what they must satisfy.
pub(super) struct AtlasOptions<'a> {
    is_fixed: bool,
    full_turn: bool,
    max_link: f64,
    pivots: Option<Bounds>,
    condition: Option<&'a str>,
    /// The number of curves that are compared exactly.
    candidates: usize,
}

impl<'a> AtlasOptions<'a> {
    pub(super) fn new(AtlasQuery { options, condition, is_fixed }: &AtlasQuery<'a>) -> AtlasOptions<'a> {
        /// The least number of curves that are compared exactly, and that for each answer.
        const CANDIDATES: [usize; 2] = [300, 20];
        AtlasOptions {
            is_fixed: *is_fixed,
            full_turn: options.full_turn,
            max_link: options.max_link,
            pivots: options.pivots,
            condition: *condition,
            candidates: CANDIDATES[0].max(CANDIDATES[1] * options.most),
        }
    }

    /// The same without constraints.
    pub(super) fn relaxed(&self) -> AtlasOptions<'a> {
        let (candidates, is_fixed) = (self.candidates, self.is_fixed);
        AtlasOptions { is_fixed, full_turn: false, max_link: f64::INFINITY, pivots: None, condition: None, candidates }
    }
}

/// A curve: its cell by index, its trace and its circuit.
type Curve = [u32; 3];

/// A family by its index in the plan, and the condition in its names.
type ConditionedFamily<'p> = (usize, &'p Family, Option<CompiledExpression>);

/// The curves of an atlas that are nearest to a target, the nearest first, and how many curves meet what can be asked of them in their own
/// place. Cells are solved on all threads, in bounded memory: of each curve 72 bytes are kept.
///
/// # Errors
/// The condition is none in any of the families, or `interrupt` is true.
pub(super) fn search_atlas(
    plan: &Plan,
    target: &Target,
    options: &AtlasOptions,
    interrupt: &AtomicBool,
) -> Result<(Vec<AtlasAnswer>, usize), Error> {
    let families = compile(plan, options.condition)?;
    let mut index = CurveIndex::new();
    let mut curves: Vec<Curve> = Vec::new();
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for (_, family, condition) in &families {
        let start = curves.len();
        let shapes = |solved: SolvedCell| -> Vec<(Curve, CurveShape)> {
            let kept = solved.curves.iter().filter(|curve| is_kept(condition.as_ref(), options, &solved, curve));
            let shape = |curve: &MeasuredCurve| {
                let circuit = solved.circuit(curve);
                let points: Vec<Point> = circuit.points(curve.joint).collect();
                let place = [solved.cell.number - 1, curve.trace, curve.circuit].map(|number| number as u32);
                (place, CurveShape::new(&points, circuit.is_closed))
            };
            kept.map(shape).collect()
        };
        let cells = CellIndices::Range(0..family.cell_count());
        solve_cells(family, condition.as_ref(), &cells, shapes, interrupt, |found| {
            for (curve, shape) in found {
                curves.push(curve);
                index.push_shape(shape);
            }
        })?;
        ranges.push(start..curves.len());
    }
    let fit_options = CurveFitOptions { is_fixed: options.is_fixed, ..CurveFitOptions::default() };
    // What is in its place need not be like the target.
    let wanted = if options.is_fixed || curves.len() <= options.candidates {
        (0..curves.len()).collect()
    } else {
        let mut lookup = CurveLookup::new(target, fit_options, options.candidates);
        lookup.compare(&index, 0..index.len());
        let mut found: Vec<usize> = lookup.found().map(|(_, number)| number).collect();
        if found.len() > options.candidates {
            let mut closely: Vec<(f64, usize)> = Vec::new();
            let likeness = |solved: &SolvedCell, curve: &MeasuredCurve, number| {
                let circuit = solved.circuit(curve);
                let points: Vec<Point> = circuit.points(curve.joint).collect();
                Some((lookup.likeness(&points, circuit.is_closed)?, number))
            };
            for (family, range) in families.iter().zip(&ranges) {
                let curves = (&curves[..], range);
                solve_curves(family, curves, &found, likeness, interrupt, |likenesses| closely.extend(likenesses))?;
            }
            closely.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            closely.truncate(options.candidates);
            found = closely.into_iter().map(|(_, number)| number).collect();
        }
        found
    };
    drop(index);
    let fitter = CurveFitter::new(target, fit_options);
    let mut answers: Vec<AtlasAnswer> = Vec::new();
    for (family, range) in families.iter().zip(&ranges) {
        let (place, of_family, _) = family;
        let fit = |solved: &SolvedCell, curve: &MeasuredCurve, _| answer(*place, of_family, solved, curve, &fitter);
        solve_curves(family, (&curves, range), &wanted, fit, interrupt, |found| {
            answers.extend(found.into_iter().filter(|answer| is_placed_well(answer, target, options)));
            answers.sort_by(|a, b| a.curve.fit.deviation.rms.total_cmp(&b.curve.fit.deviation.rms));
            answers.truncate(options.candidates);
        })?;
    }
    for answer in &mut answers {
        let family = &plan.families[answer.place[0]].family;
        answer.curve.is_scalable = options.is_fixed || is_scalable(&family.template, &answer.curve.values);
    }
    Ok((answers, curves.len()))
}

/// The families in which a condition has a meaning, with it.
fn compile<'p>(plan: &'p Plan, condition: Option<&str>) -> Result<Vec<ConditionedFamily<'p>>, Error> {
    let mut error = None;
    let mut families = Vec::new();
    for (place, planned) in plan.families.iter().enumerate() {
        let family = &planned.family;
        let scope = Family::scope(&family.names, family.template.is_driven_by_length());
        let compiled = condition.map(|text| measure::parse_condition(text)?.compile(&scope, Kind::Boolean)).transpose();
        match compiled {
            Ok(condition) => families.push((place, family, condition)),
            Err(other) => drop(error.get_or_insert(other)),
        }
    }
    match error.filter(|_| families.is_empty()) {
        Some(error) => {
            let condition = condition.unwrap_or_default().to_owned();
            Err(Error::Condition { condition, error: error.message_with_help() })
        }
        None => Ok(families),
    }
}

/// Whether a curve satisfies what does not depend on its place.
fn is_kept(
    condition: Option<&CompiledExpression>,
    options: &AtlasOptions,
    solved: &SolvedCell,
    curve: &MeasuredCurve,
) -> bool {
    let value = |slot| Family::scope_value(&solved.cell, &curve.values, slot);
    (!options.full_turn || solved.circuit(curve).is_full_turn())
        && condition.is_none_or(|condition| condition.evaluate(value) == 1.0)
}

/// The measures that are needed of the curves of a family.
fn requested_measures(family: &Family, condition: Option<&CompiledExpression>) -> MeasureSet {
    let used = condition.map_or(MeasureSet::EMPTY, |condition| family.measures_in(condition));
    PlacedCurve::MEASURES | family.selection_measures() | used
}

/// Solves cells on all threads, and receives the results in order.
///
/// # Errors
/// `interrupt` is true.
fn solve_cells<T: Send>(
    family: &Family,
    condition: Option<&CompiledExpression>,
    cells: &CellIndices,
    work: impl Fn(SolvedCell) -> Vec<T> + Sync,
    interrupt: &AtomicBool,
    mut receive: impl FnMut(Vec<T>),
) -> Result<(), Error> {
    let groups = CellGroups {
        cells,
        first_group: 0,
        size: 8,
        work_bytes: 0,
        requested_measures: Some(requested_measures(family, condition)),
        solve_known: None,
    };
    let works = |_, solved: Vec<SolvedCell>| solved.into_iter().flat_map(&work).collect::<Vec<T>>();
    sweep::process_groups(family, groups, works, |found| {
        receive(found);
        if interrupt.load(Ordering::Relaxed) { Err(Interrupted.into()) } else { Ok(()) }
    })
}

/// Solves those curves of a family again that are among some of all curves by number, and receives what is made of them in order. The curves
/// of the family are those of a range of all.
///
/// # Errors
/// `interrupt` is true.
fn solve_curves<T: Send>(
    (_, family, condition): &ConditionedFamily,
    (curves, range): (&[Curve], &Range<usize>),
    numbers: &[usize],
    work: impl Fn(&SolvedCell, &MeasuredCurve, usize) -> Option<T> + Sync,
    interrupt: &AtomicBool,
    receive: impl FnMut(Vec<T>),
) -> Result<(), Error> {
    let mut chosen: Vec<usize> = numbers.iter().filter(|number| range.contains(number)).copied().collect();
    chosen.sort_unstable();
    let mut cells: Vec<u32> = chosen.iter().map(|number| curves[*number][0]).collect();
    cells.dedup();
    let works = |solved: SolvedCell| -> Vec<T> {
        let number = |curve: &MeasuredCurve| {
            let place = [solved.cell.number - 1, curve.trace, curve.circuit].map(|number| number as u32);
            chosen.binary_search_by(|number| curves[*number].cmp(&place)).ok().map(|k| chosen[k])
        };
        solved.curves.iter().filter_map(|curve| work(&solved, curve, number(curve)?)).collect()
    };
    solve_cells(family, condition.as_ref(), &CellIndices::Listed(cells), works, interrupt, receive)
}

fn answer(
    place: usize,
    family: &Family,
    solved: &SolvedCell,
    curve: &MeasuredCurve,
    fitter: &CurveFitter,
) -> Option<AtlasAnswer> {
    let circuit = solved.circuit(curve);
    let points: Vec<Point> = circuit.points(curve.joint).collect();
    let fit = fitter.fit(&points, circuit.is_closed)?;
    let [cell, trace, number] = [solved.cell.number, curve.trace, curve.circuit];
    Some(AtlasAnswer {
        place: [place, cell - 1],
        name: format!("{}:{cell}.{trace}.{number}", family.id),
        curve: PlacedCurve::new(family, solved, curve, fit),
        refined: None,
    })
}

/// Whether an answer satisfies the constraints on its place.
fn is_placed_well(answer: &AtlasAnswer, target: &Target, options: &AtlasOptions) -> bool {
    is_short_enough(answer, target, options) && is_inside(answer, options)
}

fn is_short_enough(answer: &AtlasAnswer, target: &Target, options: &AtlasOptions) -> bool {
    answer.curve.longest_link <= options.max_link * target.size()
}

fn is_inside(answer: &AtlasAnswer, options: &AtlasOptions) -> bool {
    let is_inside = |b: &Bounds, p: &Point| b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y && p.y <= b.max.y;
    let are_inside = |b: &Bounds| answer.curve.pivots.iter().all(|(_, pivot)| is_inside(b, pivot));
    options.pivots.as_ref().is_none_or(are_inside)
}

/// The constraints that a curve of the atlas does not meet where it is placed on the target.
///
/// # Errors
/// The condition is none in any of the families.
pub(super) fn unmet_constraints(
    plan: &Plan,
    target: &Target,
    options: &AtlasOptions,
    answer: &AtlasAnswer,
) -> Result<Vec<Constraint>, Error> {
    let met = [
        (Constraint::Condition, meets_condition(plan, options.condition, answer)?),
        (Constraint::Pivots, is_inside(answer, options)),
        (Constraint::MaxLink, is_short_enough(answer, target, options)),
        (Constraint::FullTurn, !options.full_turn || answer.curve.is_full_turn),
    ];
    Ok(met.into_iter().filter(|(_, is_met)| !is_met).map(|(constraint, _)| constraint).collect())
}

/// Whether a curve of the atlas satisfies a condition; not if that has no meaning in its family.
fn meets_condition(plan: &Plan, condition: Option<&str>, answer: &AtlasAnswer) -> Result<bool, Error> {
    let ([place, cell], [trace, circuit]) = (answer.place, answer.curve.numbers);
    let families = compile(plan, condition)?;
    let Some((_, family, condition)) = families.iter().find(|(other, ..)| *other == place) else { return Ok(false) };
    let Some(condition) = condition else { return Ok(true) };
    let requested = requested_measures(family, Some(condition));
    let solved = Solver::new(family).measuring(requested).solve(cell);
    Ok(solved.is_some_and(|solved| {
        let mut curves = solved.curves.iter().filter(|curve| (curve.trace, curve.circuit) == (trace, circuit));
        let value = |curve: &MeasuredCurve, slot| Family::scope_value(&solved.cell, &curve.values, slot);
        curves.any(|curve| condition.evaluate(|slot| value(curve, slot)) == 1.0)
    }))
}
