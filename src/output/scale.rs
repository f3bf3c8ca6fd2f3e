//! Whether linkages fit their pages at the scale that a manifest gives: what does not is an error, never reduced.

use std::borrow::Cow;
use std::sync::atomic::AtomicBool;

use super::options::check_interrupt;
use super::{Error, Options as RunOptions};
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, PageJob, Sink};
use crate::sweep::Division;
use coupler_curves::problem::Problem;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{Layout, PanelScale, Paper, format_scale, usual_scale_below};
use coupler_drawing::render::Format;

/// What is wrong with the scales of families of which a page was reduced, so that everything is said in one run.
///
/// # Errors
/// The problems; the run is interrupted.
pub(super) fn explain<'p>(
    plan: &Plan,
    families: impl Iterator<Item = (&'p PlannedFamily, Division)>,
    options: &RunOptions,
) -> Result<(), Error> {
    let problem = |(planned, part): (&PlannedFamily, Division)| {
        let formats = options.formats.as_deref().unwrap_or(&planned.formats);
        scale_problem(plan, planned, (formats, part), &options.interrupt)
    };
    let misfits: Vec<Problem> =
        families.map(problem).collect::<Result<Vec<_>, Error>>()?.into_iter().flatten().collect();
    if !misfits.is_empty() {
        return Err(Error::Misfits(misfits));
    }
    let given = plan.families.iter().find(|planned| planned.scale.fixed().is_some());
    let span = given.and_then(|planned| planned.scale_span.clone()).unwrap_or_default();
    let problem = Problem::error(span, "linkages do not fit the pages of the book at this scale");
    Err(Error::Misfits(vec![problem.with_help("give a smaller scale, a larger paper, or a narrower binding")]))
}

/// The problem of a family with a given scale at which linkages on some of its pages, or of those of the book, do not fit, in the formats that it has.
///
/// # Errors
/// The run is interrupted.
pub(super) fn scale_problem(
    plan: &Plan,
    planned: &PlannedFamily,
    (formats, part): (&[Format], Division),
    stop: &AtomicBool,
) -> Result<Option<Problem>, Error> {
    let has_pages = formats.iter().any(|format| format.page_format().is_some());
    let has_book = cfg!(feature = "pdf") && formats.contains(&Format::Pdf);
    // The pages of a book may be narrower than those of the atlas.
    let is_narrower = plan.book.binding > 0.0;
    let of_pages = |is_book: bool| problem_of_pages(plan, planned, (is_book, part), stop);
    let own = if has_pages || has_book && !is_narrower { of_pages(false)? } else { None };
    if own.is_none() && has_book && is_narrower { of_pages(true) } else { Ok(own) }
}

/// The plan of the pages of the atlas, or of those of its book.
fn with_pages(plan: &Plan, is_book: bool) -> Cow<'_, Plan> {
    if is_book { plan.with_book_pages() } else { Cow::Borrowed(plan) }
}

/// The problem of the pages of a family, or of those in the book, with what to do about it. The pages are composed to find out, since a figure has
/// what the texts around it leave.
fn problem_of_pages(
    plan: &Plan,
    planned: &PlannedFamily,
    (is_book, part): (bool, Division),
    stop: &AtomicBool,
) -> Result<Option<Problem>, Error> {
    let Some(scale) = planned.scale.fixed() else { return Ok(None) };
    let unit = planned.family.unit;
    // That nothing is wrong is found out at the price of composing the pages only.
    let mut fitting = fitting_scales(&with_pages(plan, is_book), planned, part, false, stop)?;
    let page_count = fitting.len();
    fitting.retain(|fitting| fitting.is_finite());
    if fitting.is_empty() {
        return Ok(None);
    }
    let fits = |plan: &Plan, planned: &PlannedFamily| match fitting_scales(
        &with_pages(plan, is_book),
        planned,
        Division::WHOLE,
        true,
        stop,
    ) {
        Ok(_) => Ok(true),
        Err(Error::Misfits(_)) => Ok(false),
        Err(error) => Err(error),
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
    let is_usual = planned.layout == planned.usual_layout(&plan.page);
    for (keys, paper) in larger_papers(plan.page.paper) {
        let plan = Plan { page: plan.page.clone().with_paper(paper), ..plan.clone() };
        // Where the manifest leaves `panels` to the paper, another paper has others.
        let usual = is_usual.then(|| PlannedFamily { layout: planned.usual_layout(&plan.page), ..planned.clone() });
        if fits(&plan, planned)? && usual.map_or(Ok(true), |planned| fits(&plan, &planned))? {
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
    let which = if is_book { format!("{which} of the book") } else { which };
    let message = format!("the linkages of `{}` do not fit {which} at {at}", planned.family.id);
    let help = match remedies.split_last() {
        None => "write a smaller scale, or a larger paper in [page]".to_owned(),
        Some((last, [])) => format!("write {last}"),
        Some((last, others)) => format!("write {}, or {last}", others.join(", ")),
    };
    let span = planned.scale_span.clone().unwrap_or_else(|| planned.span.clone());
    Ok(Some(Problem::error(span, message).with_help(help)))
}

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
            // What is portrait now says so, and the other has to be said in its place.
            let is_said = is_portrait || paper.height > paper.width;
            let orientation = if is_said { format!(", {}", key(is_portrait)) } else { String::new() };
            (format!("paper = \"{name}\"{orientation}"), named.turned(is_portrait))
        }));
    }
    papers
}

/// The greatest scale at which the linkages of each page fit, in millimetres to a unit, if they are reduced to it, and otherwise infinity.
///
/// # Errors
/// A page is reduced, if it is to stop there; the run is interrupted.
fn fitting_scales(
    plan: &Plan,
    planned: &PlannedFamily,
    part: Division,
    stops_at_first: bool,
    stop: &AtomicBool,
) -> Result<Vec<f64>, Error> {
    let pipeline = FamilyPipeline::new(plan, planned, stop).ok_or(Error::Interrupted)?;
    let mut scales = Vec::new();
    pipeline.run_pages(
        &FittingScale { stops_at_first, stop },
        part.range(pipeline.pagination.page_count),
        |scale| {
            scales.push(scale);
            Ok(())
        },
    )?;
    Ok(scales)
}

/// Composes pages, and passes on the greatest scale at which their linkages fit.
struct FittingScale<'s> {
    /// Whether a page that is reduced is an error.
    stops_at_first: bool,
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
        match job.compose().reduced_scale {
            Some(_) if self.stops_at_first => Err(Error::Misfits(Vec::new())),
            reduced => Ok(reduced.unwrap_or(f64::INFINITY)),
        }
    }

    fn bytes_per_page(&self) -> usize {
        BYTES_PER_SCENE
    }
}

/// A page before it is rendered, with its paths.
pub(super) const BYTES_PER_SCENE: usize = 4_000_000;
