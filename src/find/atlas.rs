//! The curves of an atlas that are nearest to a path.

use std::convert::Infallible;
use std::ops::Range;

use coupler_curves::expression::{CompiledExpression, Expression, Kind};
use coupler_curves::family::{Family, Sampling};
use coupler_curves::find::{
    CurveFit, CurveFitOptions, CurveFitter, CurveIndex, CurveLookup, CurveShape, Options, Placement, Target,
};
use coupler_curves::geometry::{Bounds, Point, Vector, distance_to_segment};
use coupler_curves::linkage::{FourBar, JointId, Linkage, PlacedFourBar};
use coupler_curves::measure::{self, Value};
use coupler_curves::motion::Sampler;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, solve_measuring};
use coupler_curves::template::{ParameterKind, Template};

use crate::manifest::Plan;
use crate::sweep::{self, CellGroups, CellIndices};

/// What the curves of an atlas are compared by, and what they must satisfy.
pub struct AtlasOptions {
    /// Whether position, size and rotation count.
    pub is_fixed: bool,
    /// Whether the input must turn fully.
    pub full_turn: bool,
    /// The greatest distance of two joints of a link, in sizes of the target; may be infinite.
    pub max_link: f64,
    /// The box of the fixed pivots, in the unit of the target.
    pub pivots: Option<Bounds>,
    /// The condition, as in `where` of a manifest.
    pub condition: Option<String>,
    /// The number of curves that are compared exactly.
    pub candidates: usize,
}

impl AtlasOptions {
    /// Those that agree with a search for four-bars.
    pub fn new(options: &Options, condition: Option<String>, is_fixed: bool) -> AtlasOptions {
        /// The least number of curves that are compared exactly, and that for each answer.
        const CANDIDATES: [usize; 2] = [300, 20];
        AtlasOptions {
            is_fixed,
            full_turn: options.full_turn,
            max_link: options.max_link,
            pivots: options.pivots,
            condition,
            candidates: CANDIDATES[0].max(CANDIDATES[1] * options.most),
        }
    }

    /// The same without constraints.
    pub fn relaxed(&self) -> AtlasOptions {
        let (candidates, is_fixed) = (self.candidates, self.is_fixed);
        AtlasOptions { is_fixed, full_turn: false, max_link: f64::INFINITY, pivots: None, condition: None, candidates }
    }
}

/// A curve of an atlas near a target.
#[derive(Clone, Debug)]
pub struct AtlasAnswer {
    /// The index of its family in the plan, and that of its cell in the family.
    pub place: [usize; 2],
    /// Its name, as `export` takes it: `evans:3.1.1`.
    pub name: String,
    /// The numbers of its cell, trace and circuit, from 1.
    pub numbers: [usize; 3],
    /// Where it is on the target, and how near.
    pub fit: CurveFit,
    /// The values of the template's parameters, in the unit of the atlas.
    pub values: Vec<f64>,
    /// Whether the linkage is as many times greater if all its lengths are.
    pub is_scalable: bool,
    /// The joints of the frame on which links turn, where they are on the target.
    pub pivots: Vec<(String, Point)>,
    /// The greatest distance of two joints of a link, in the unit of the target.
    pub longest_link: f64,
    /// The class; empty if it is no four-bar.
    pub class: &'static str,
    /// The worst transmission angle in degrees, NaN if there is none.
    pub mu_worst_deg: f64,
    /// Whether the input turns fully.
    pub is_full_turn: bool,
    /// The four-bar on the target, if it is one.
    pub four_bar: Option<PlacedFourBar>,
    /// Some points of the curve on the target, in their order.
    pub outline: Vec<Point>,
}

/// The measures of an answer.
const REPORTED: [&str; 2] = ["class", "mu_worst_deg"];

/// A curve: its cell by index, its trace and its circuit.
type Curve = [u32; 3];

/// A family by its index in the plan, and the condition in its names.
type ConditionedFamily<'p> = (usize, &'p Family, Option<CompiledExpression>);

/// Why an atlas cannot be searched.
#[derive(Debug, thiserror::Error)]
#[error("--where: `{condition}`: {error}")]
pub struct ConditionError {
    condition: String,
    error: String,
}

/// The curves of an atlas that are nearest to a target, the nearest first, and how many curves meet what can be asked of them in their own
/// place. Cells are solved on all threads, in bounded memory: of each curve 72 bytes are kept.
///
/// # Errors
/// The condition is none in any of the families.
pub fn search_atlas(
    plan: &Plan,
    target: &Target,
    options: &AtlasOptions,
) -> Result<(Vec<AtlasAnswer>, usize), ConditionError> {
    let families = compile(plan, options.condition.as_deref())?;
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
        let cells = CellIndices::First(family.cell_count());
        solve_cells(family, condition.as_ref(), &cells, shapes, |found| {
            for (curve, shape) in found {
                curves.push(curve);
                index.push_shape(shape);
            }
        });
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
                solve_curves(family, curves, &found, likeness, |likenesses| closely.extend(likenesses));
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
        solve_curves(family, (&curves, range), &wanted, fit, |found| {
            answers.extend(found.into_iter().filter(|answer| is_placed_well(answer, target, options)));
            answers.sort_by(|a, b| a.fit.rms.total_cmp(&b.fit.rms));
            answers.truncate(options.candidates);
        });
    }
    for answer in &mut answers {
        let family = &plan.families[answer.place[0]].family;
        answer.is_scalable = options.is_fixed || is_scalable(&family.template, &answer.values);
    }
    Ok((answers, curves.len()))
}

/// The families in which a condition has a meaning, with it.
fn compile<'p>(plan: &'p Plan, condition: Option<&str>) -> Result<Vec<ConditionedFamily<'p>>, ConditionError> {
    let mut error = None;
    let mut families = Vec::new();
    for (place, planned) in plan.families.iter().enumerate() {
        let family = &planned.family;
        let scope = Family::scope(&family.names, family.template.is_driven_by_length());
        let compiled = condition.map(|text| Expression::parse(text)?.compile(&scope, Kind::Boolean)).transpose();
        match compiled {
            Ok(condition) => families.push((place, family, condition)),
            Err(other) => drop(error.get_or_insert(other)),
        }
    }
    match error.filter(|_| families.is_empty()) {
        Some(error) => {
            let help = if error.help.is_empty() { String::new() } else { format!("; {}", error.help) };
            let condition = condition.unwrap_or_default().to_owned();
            Err(ConditionError { condition, error: format!("{error}{help}") })
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

/// Solves cells on all threads, and receives the results in order.
fn solve_cells<T: Send>(
    family: &Family,
    condition: Option<&CompiledExpression>,
    cells: &CellIndices,
    work: impl Fn(SolvedCell) -> Vec<T> + Sync,
    mut receive: impl FnMut(Vec<T>),
) {
    let is_needed = |k: usize| {
        REPORTED.contains(&measure::ALL[k].name)
            || family.filter_or_sort_uses(k)
            || condition.is_some_and(|condition| family.expression_uses(condition, k))
    };
    let requested: Vec<bool> = (0..measure::ALL.len()).map(is_needed).collect();
    let groups = CellGroups { cells, first_group: 0, size: 8, work_bytes: 0, requested_measures: Some(&requested) };
    let works = |_, solved: Vec<SolvedCell>| solved.into_iter().flat_map(&work).collect::<Vec<T>>();
    let Ok(()) = sweep::process_groups(family, groups, works, |found| {
        receive(found);
        Ok::<(), Infallible>(())
    });
}

/// Solves those curves of a family again that are among some of all curves by number, and receives what is made of them in order. The curves
/// of the family are those of a range of all.
fn solve_curves<T: Send>(
    (_, family, condition): &ConditionedFamily,
    (curves, range): (&[Curve], &Range<usize>),
    numbers: &[usize],
    work: impl Fn(&SolvedCell, &MeasuredCurve, usize) -> Option<T> + Sync,
    receive: impl FnMut(Vec<T>),
) {
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
    solve_cells(family, condition.as_ref(), &CellIndices::Listed(cells), works, receive);
}

fn answer(
    place: usize,
    family: &Family,
    solved: &SolvedCell,
    curve: &MeasuredCurve,
    fitter: &CurveFitter,
) -> Option<AtlasAnswer> {
    /// Of the points that are kept to tell curves from each other.
    const OUTLINE: usize = 720;
    let circuit = solved.circuit(curve);
    let points: Vec<Point> = circuit.points(curve.joint).collect();
    let fit = fitter.fit(&points, circuit.is_closed)?;
    let numbers = [solved.cell.number, curve.trace, curve.circuit];
    let pivots = pivots_of(&solved.linkage).map(|joint| {
        (solved.linkage.joints[joint.index()].name.clone(), fit.placement.apply(circuit.positions.point(joint, 0)))
    });
    let [cell, trace, number] = numbers;
    Some(AtlasAnswer {
        place: [place, cell - 1],
        name: format!("{}:{cell}.{trace}.{number}", family.id),
        numbers,
        values: family.parameter_values(&solved.cell).to_vec(),
        is_scalable: false,
        pivots: pivots.collect(),
        longest_link: fit.placement.scale() * longest_link(&solved.linkage),
        class: if let Value::Word(class) = curve.value("class") { class } else { "" },
        mu_worst_deg: if let Value::Number(angle) = curve.value("mu_worst_deg") { angle } else { f64::NAN },
        is_full_turn: circuit.is_full_turn(),
        four_bar: placed_four_bar(&solved.linkage, curve.joint, &fit.placement),
        outline: points.iter().step_by(points.len().div_ceil(OUTLINE)).map(|p| fit.placement.apply(*p)).collect(),
        fit,
    })
}

/// Whether an answer satisfies the constraints on its place.
fn is_placed_well(answer: &AtlasAnswer, target: &Target, options: &AtlasOptions) -> bool {
    let is_inside = |b: &Bounds, p: &Point| b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y && p.y <= b.max.y;
    let are_inside = |b: &Bounds| answer.pivots.iter().all(|(_, pivot)| is_inside(b, pivot));
    answer.longest_link <= options.max_link * target.size() && options.pivots.as_ref().is_none_or(are_inside)
}

/// The joints of the link at rest that are on another one.
fn pivots_of(linkage: &Linkage) -> impl Iterator<Item = JointId> {
    let ground = linkage.ground();
    let is_pivot = |joint: &JointId| {
        linkage.links.iter().any(|link| !std::ptr::eq(link, ground) && link.position(*joint).is_some())
    };
    ground.joints.iter().map(|(joint, _)| *joint).filter(is_pivot)
}

fn longest_link(linkage: &Linkage) -> f64 {
    let of_link = |joints: &[(JointId, Vector)]| {
        let pairs = joints.iter().enumerate().flat_map(|(k, (_, a))| joints[k + 1..].iter().map(move |(_, b)| (a, b)));
        pairs.map(|(a, b)| (b - a).norm_squared()).fold(0.0, f64::max)
    };
    linkage.links.iter().map(|link| of_link(&link.joints)).fold(0.0, f64::max).sqrt()
}

/// The four-bar in a linkage on the target; none if it is seen from a moving link.
fn placed_four_bar(linkage: &Linkage, joint: JointId, placement: &Placement) -> Option<PlacedFourBar> {
    let PlacedFourBar { pivots, lengths: FourBar { frame, crank, coupler, rocker }, coupler_point } =
        PlacedFourBar::from_linkage(linkage, joint).ok().filter(|_| linkage.seen_from.is_none())?;
    let scale = placement.scale();
    let across = if placement.is_mirrored { -coupler_point.y } else { coupler_point.y };
    Some(PlacedFourBar {
        pivots: pivots.map(|pivot| placement.apply(pivot)),
        lengths: FourBar {
            frame: scale * frame,
            crank: scale * crank,
            coupler: scale * coupler,
            rocker: scale * rocker,
        },
        coupler_point: Vector::new(scale * coupler_point.x, scale * across),
    })
}

/// Whether all positions are as many times greater if all parameters that are lengths are: no length is written as a number.
fn is_scalable(template: &std::sync::Arc<Template>, values: &[f64]) -> bool {
    /// Not a power of 2, which would be exact.
    const FACTOR: f64 = 1.7;
    const ROUNDING: f64 = 1e-9;
    let solved = |factor: f64| {
        let scaled = template.parameters.iter().zip(scaled_values(template, values, factor));
        let given: Vec<(String, f64)> = scaled.map(|(parameter, value)| (parameter.name.clone(), value)).collect();
        let family = Family::single_cell(template.clone(), &given, Sampling::Samples(24)).ok()?;
        solve_measuring(&family, &Sampler::new(family.sampling), 0, &vec![false; measure::ALL.len()])
    };
    let (Some(one), Some(other)) = (solved(1.0), solved(FACTOR)) else { return false };
    let positions = |solved: &SolvedCell| -> Vec<Point> {
        let circuits = solved.motion.circuits.iter();
        // A joint of the frame alone only gives a direction, or it gives a line that another one is on.
        let is_linked = |joint: &JointId| solved.linkage.links[1..].iter().any(|link| link.position(*joint).is_some());
        let joints = |circuit| solved.linkage.joint_ids().filter(is_linked).map(move |joint| (circuit, joint));
        let all = circuits
            .flat_map(joints)
            .flat_map(|(circuit, joint): (&coupler_curves::motion::Circuit, _)| circuit.points(joint));
        all.collect()
    };
    let (one, other) = (positions(&one), positions(&other));
    let size = one.iter().map(|p| p.coords.norm()).filter(|norm| norm.is_finite()).fold(0.0, f64::max);
    one.len() == other.len()
        && one.iter().zip(&other).all(|(a, b)| {
            let off = (a.coords * FACTOR - b.coords).norm();
            off.is_nan() || off <= ROUNDING * size
        })
}

/// The values of parameters with the lengths among them multiplied.
pub fn scaled_values(template: &Template, values: &[f64], factor: f64) -> Vec<f64> {
    let scaled = template.parameters.iter().zip(values);
    scaled
        .map(|(parameter, value)| if parameter.kind == ParameterKind::Length { factor * value } else { *value })
        .collect()
}

/// Whether two curves, each given by some of its points, are the same to a distance.
pub fn are_same(a: &[Point], b: &[Point], distance: f64) -> bool {
    let is_near = |p: &Point, curve: &[Point]| {
        let chords = (0..curve.len()).map(|k| [curve[k], curve[(k + 1) % curve.len()]]);
        chords.into_iter().any(|[from, to]| distance_to_segment(*p, from, to) <= distance)
    };
    a.iter().all(|p| is_near(p, b)) && b.iter().all(|p| is_near(p, a))
}
