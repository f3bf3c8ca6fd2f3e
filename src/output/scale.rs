//! Whether linkages fit their pages at the scale that a manifest gives: what does not is an error, never reduced.

use std::sync::atomic::AtomicBool;

use super::{Error, check_interrupt};
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, PageJob, Sink};
use crate::sweep::Division;
use coupler_curves::problem::Problem;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{Layout, PanelScale, Paper, format_scale, usual_scale_below};

/// Checks that the linkages on some of the pages of families fit at the scales that are given.
///
/// # Errors
/// They do not; the run is interrupted.
pub(super) fn check<'p>(
    plan: &Plan,
    families: impl Iterator<Item = (&'p PlannedFamily, Division)>,
    stop: &AtomicBool,
) -> Result<(), Error> {
    let problems = families.map(|(planned, part)| scale_problem(plan, planned, part, stop));
    let misfits: Vec<Problem> = problems.collect::<Result<Vec<_>, Error>>()?.into_iter().flatten().collect();
    if misfits.is_empty() { Ok(()) } else { Err(Error::Misfits(misfits)) }
}

/// The linkages of a plan that do not fit their pages at the scales that are given, by family.
pub fn scale_problems(plan: &Plan) -> Vec<Problem> {
    let families = plan.families.iter().map(|planned| (planned, Division::WHOLE));
    match check(plan, families, &AtomicBool::new(false)) {
        Err(Error::Misfits(problems)) => problems,
        _ => Vec::new(),
    }
}

/// The problem of a family with a given scale at which linkages on some of the pages do not fit, with what to do about it. The pages are composed to
/// find out, since a figure has what the texts around it leave.
///
/// # Errors
/// The run is interrupted.
fn scale_problem(
    plan: &Plan,
    planned: &PlannedFamily,
    part: Division,
    stop: &AtomicBool,
) -> Result<Option<Problem>, Error> {
    let Some(scale) = planned.scale.fixed() else { return Ok(None) };
    let unit = planned.family.unit;
    let is_reduced = |fitting: &f64| scale > fitting * (1.0 + ROUNDING);
    let mut fitting = fitting_scales(plan, planned, part, stop)?;
    let page_count = fitting.len();
    fitting.retain(is_reduced);
    if fitting.is_empty() {
        return Ok(None);
    }
    let fits = |plan: &Plan, planned: &PlannedFamily| -> Result<bool, Error> {
        let Some(scale) = planned.scale.fixed() else { return Ok(true) };
        let all = fitting_scales(plan, planned, Division::WHOLE, stop)?;
        Ok(all.iter().all(|fitting| scale <= fitting * (1.0 + ROUNDING)))
    };
    let mut remedies = Vec::new();
    // Figures are arranged anew at another scale, so that what fits is found by trying.
    let mut smaller = usual_scale_below(fitting.iter().copied().fold(f64::INFINITY, f64::min), unit);
    for _ in 0..MOST_SCALES {
        if fits(plan, &PlannedFamily { scale: PanelScale::Fixed(smaller), ..planned.clone() })? {
            remedies.push(format!("scale = \"{}\"", format_scale(smaller, unit)));
            break;
        }
        smaller = usual_scale_below(0.99 * smaller, unit);
    }
    for (keys, paper) in larger_papers(plan.page.paper) {
        let plan = Plan { page: plan.page.clone().with_paper(paper), ..plan.clone() };
        if fits(&plan, planned)? {
            remedies.push(format!("{keys} in [page]"));
            break;
        }
    }
    let alone = Layout::Panels { columns: 1, rows: 1 };
    if matches!(planned.layout, Layout::Panels { .. }) && planned.layout != alone {
        let planned = PlannedFamily { layout: alone, ..planned.clone() };
        if fits(plan, &planned)? {
            remedies.push("panels = [1, 1]".to_owned());
        }
    }
    let at = match unit {
        Some(_) => format_scale(scale, unit),
        None => format!("{} to a unit", format_scale(scale, unit)),
    };
    let which = match (page_count, fitting.len()) {
        (1, _) => "the page".to_owned(),
        (all, some) if all == some => format!("any of the {all} pages"),
        (all, some) => format!("{some} of {all} pages"),
    };
    let message = format!("the linkages of `{}` do not fit {which} at {at}", planned.family.id);
    let help = match remedies.split_last() {
        None => "write a smaller scale, or a larger paper in [page]".to_owned(),
        Some((last, [])) => format!("write {last}"),
        Some((last, others)) => format!("write {}, or {last}", others.join(", ")),
    };
    let span = planned.scale_span.clone().unwrap_or_else(|| planned.span.clone());
    Ok(Some(Problem::error(span, message).with_help(help)))
}

/// Panels of a page differ in size by a hundredth of a millimetre.
const ROUNDING: f64 = 1e-3;

/// The most scales that are tried.
const MOST_SCALES: usize = 4;

/// The named papers with more room than one, the smallest first, each with its keys; and this one in the other orientation.
fn larger_papers(paper: Paper) -> Vec<(String, Paper)> {
    let key = |is_portrait| if is_portrait { "orientation = \"portrait\"" } else { "orientation = \"landscape\"" };
    let turned = paper.turned(paper.height < paper.width);
    let mut papers = vec![(key(turned.height > turned.width).to_owned(), turned)];
    let mut named: Vec<(&str, Paper)> =
        Paper::NAMED.into_iter().filter(|(_, named)| named.width * named.height > paper.width * paper.height).collect();
    named.sort_by(|(_, a), (_, b)| (a.width * a.height).total_cmp(&(b.width * b.height)));
    for (name, named) in named {
        papers.extend([false, true].map(|is_portrait| {
            let orientation = if is_portrait { format!(", {}", key(true)) } else { String::new() };
            (format!("paper = \"{name}\"{orientation}"), named.turned(is_portrait))
        }));
    }
    papers
}

/// The greatest scale at which the linkages of each page fit, in millimetres to a unit; infinite without a linkage.
fn fitting_scales(plan: &Plan, planned: &PlannedFamily, part: Division, stop: &AtomicBool) -> Result<Vec<f64>, Error> {
    let pipeline = FamilyPipeline::new(plan, planned, stop).ok_or(Error::Interrupted)?;
    let mut scales = Vec::new();
    pipeline.run_pages(&FittingScale { stop }, part.range(pipeline.pagination.page_count), |scale| {
        scales.push(scale);
        Ok(())
    })?;
    Ok(scales)
}

/// Composes pages, and passes on the greatest scale at which their linkages fit.
struct FittingScale<'s> {
    stop: &'s AtomicBool,
}

impl Sink for FittingScale<'_> {
    type CellsOutput = ();
    type PageOutput = f64;
    type Error = Error;

    fn receive_cells(&self, _: &[SolvedCell]) -> Result<(), Error> {
        Ok(())
    }

    fn receive_page(&self, job: PageJob) -> Result<f64, Error> {
        check_interrupt(self.stop)?;
        Ok(job.compose().fitting_scale.unwrap_or(f64::INFINITY))
    }

    fn bytes_per_page(&self) -> usize {
        BYTES_PER_SCENE
    }
}

/// A page before it is rendered, with its paths.
const BYTES_PER_SCENE: usize = 4_000_000;
