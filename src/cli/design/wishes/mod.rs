//! `design LINKAGE`: finds the dimensions of a linkage by wishes on its measures.

mod arguments;
mod json;
mod request;
mod text;

pub use arguments::WishArguments;

use crate::design::{self, Designs};
use coupler_drawing::page::PoseChoice;

use super::super::interrupt::{self, interrupt_flag_within};
use super::super::{Failure, Outcome, files, print, print_bytes, print_stderr, progress_bar};
use super::plate::{ShownDesign, designs_plate};
use request::Request;

pub fn run(arguments: &WishArguments) -> Result<Outcome, Failure> {
    let printed = [("--json", arguments.json), ("--toml", arguments.toml)];
    let is_drawing_printed = files::is_drawing_printed(arguments.svg.as_deref(), &printed)?;
    let Request { space, wishes, options, own_linkage } = request::check(arguments)?;
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let linkage = space.template().id.clone();
    let interrupt = interrupt_flag_within(interrupt::LONG_GRACE_PERIOD, "interrupted before anything was found")?;
    let bar = progress_bar::of_parts(&linkage);
    let designs = design::by_wishes(space, wishes.clone(), options, &interrupt, |part| {
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
        files::write(path, &plate(&linkage, &designs, arguments))?;
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

/// The designs on one page.
fn plate(linkage: &str, designs: &Designs, arguments: &WishArguments) -> Vec<u8> {
    let shown = designs.answers.iter().map(|answer| ShownDesign {
        solved: answer.solved.clone(),
        caption: design::describe(answer),
        note: text::parameters(answer),
        pose: PoseChoice::Clearest,
    });
    let symbols = designs.answers.iter().flat_map(|answer| answer.family.names.clone()).collect();
    designs_plate(&format!("Designs of {linkage}"), text::wished(arguments), symbols, shown.collect())
}
