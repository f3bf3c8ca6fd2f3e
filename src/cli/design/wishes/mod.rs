//! `design LINKAGE`: finds the dimensions of a linkage by wishes on its measures.

mod arguments;
mod json;
mod request;
mod text;

pub use arguments::WishArguments;

use crate::design;

use super::super::interrupt::{self, interrupt_flag_within};
use super::super::{Failure, Outcome, files, print, print_bytes, print_stderr, progress_bar};

pub fn run(arguments: &WishArguments) -> Result<Outcome, Failure> {
    let printed = [("--json", arguments.json), ("--toml", arguments.toml)];
    let is_drawing_printed = files::is_drawing_printed(arguments.svg.as_deref(), &printed)?;
    let (request, own_linkage) = request::read(arguments)?;
    let (space, wishes) = request.check().map_err(|problems| Failure::inputs(&problems))?;
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let linkage = space.template().id.clone();
    let interrupt = interrupt_flag_within(interrupt::LONG_GRACE_PERIOD, "interrupted before anything was found")?;
    let bar = progress_bar::of_parts(&linkage);
    let designs = design::by_wishes(space, wishes.clone(), request.options.clone(), &interrupt, |part| {
        bar.set_position((1000.0 * part) as u64);
    });
    bar.finish_and_clear();
    print_stderr(&text::notes(arguments, &designs));
    if designs.answers.is_empty() {
        if arguments.json {
            print_bytes(json::json(&linkage, &wishes, &designs)?.as_bytes())?;
        }
        return Err(Failure::inputs(&[text::no_design_message(&linkage, &wishes, &designs)]));
    }
    if let Some(path) = &arguments.svg {
        files::write(path, &design::draw_designs(&linkage, request.in_words(), &designs))?;
        if is_drawing_printed {
            return Ok(Outcome::Done);
        }
    }
    match (arguments.json, arguments.toml) {
        (true, _) => print_bytes(json::json(&linkage, &wishes, &designs)?.as_bytes())?,
        (_, true) => print_bytes(designs.manifest(&linkage, own_linkage.as_deref()).as_bytes())?,
        _ => print(&text::text(&linkage, &designs))?,
    }
    Ok(Outcome::Done)
}
