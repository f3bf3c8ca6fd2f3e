//! `find --poses`: linkages that guide a body through poses.

mod json;
mod report;
mod request;
mod text;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::find::{self, Notation, PoseReading};
use crate::output;
use coupler_curves::family::Family;
use coupler_find::{Quality, poses_manifest};

use super::super::{Failure, Outcome, files, print_stderr};
use super::{Arguments, Best, Shown, not_a_path, show, title_of};
use report::PoseReport;

pub(super) fn run(arguments: &Arguments, is_drawing_printed: bool) -> Result<Outcome, Failure> {
    let options = request::check(arguments)?;
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let path = arguments.path.as_deref().unwrap_or(Path::new("-"));
    files::protect(path, "the poses");
    let name = files::input_name(path);
    let bytes = output::read_bytes(path).map_err(|error| not_a_path::unreadable(path, error))?;
    let read = find::read_poses(&bytes, arguments.outline.as_deref()).map_err(|problems| {
        if let Some(message) = not_a_path::manifest_message(path, &bytes) {
            return Failure::inputs(&[message]);
        }
        let problems: Vec<String> = problems.iter().map(|problem| format!("{name}: {problem}")).collect();
        Failure::inputs(&problems)
    })?;
    let PoseReading { poses, taken } = read;
    if !taken.is_empty() {
        print_stderr(&format!("note: {name}: {taken}\n"));
    }
    let wrong = |message: String| Failure::input(format!("{name}: {message}"));
    find::check_given_pivots(Notation::CommandLine, &poses, &options).map_err(wrong)?;
    let found = find::find_poses(&poses, &options, &AtomicBool::new(false)).map_err(Failure::input)?;
    let report = PoseReport { name, reading: taken, poses, found };
    show(&report, arguments, is_drawing_printed)
}

impl Shown for PoseReport {
    fn drawing(&self) -> Vec<u8> {
        find::draw_poses(&title_of(&self.name), &self.poses, &self.found.findings.answers)
    }

    fn json(&self) -> Result<String, Failure> {
        json::json(self)
    }

    fn manifest(&self) -> String {
        poses_manifest(&title_of(&self.name), &self.poses, &self.found.findings.answers)
    }

    fn text(&self) -> String {
        text::text(self)
    }

    fn best(&self) -> Option<Best> {
        let best = self.found.findings.answers.first()?;
        Some(Best { quality: Quality::Exact, mu_worst_deg: best.mu_worst_deg[0] })
    }

    fn miss(&self) -> Option<(Family, usize)> {
        None
    }
}
