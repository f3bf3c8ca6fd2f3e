//! `find`: the linkages whose coupler curves are nearest to a path.

mod arguments;
mod atlas;
mod function;
mod json;
mod linkage;
mod not_a_path;
mod notes;
mod poses;
mod report;
mod request;
mod shown;
mod text;

use std::path::Path;

use crate::find::{self, MAX_POINTS, Outline, ReadOptions, Searched};
use crate::output;
use coupler_curves::family::Family;
use coupler_curves::geometry::Point;
use coupler_curves::motion::Sampling;
use coupler_find::{
    Constraint, Index, Mechanism, PathKind, Search, Target, answers_manifest, nearest_miss, placed_parameters,
};

use super::export::CurveSamples;
use super::linkage::DEFAULT_SAMPLES;
use super::{Failure, Outcome, export, files, print_stderr, source};
pub use arguments::Arguments;
use arguments::InputChoice;

use notes::Best;
use report::{Report, title_of};
use shown::{Shown, show};

impl Shown for Report {
    fn drawing(&self) -> Vec<u8> {
        find::draw_four_bars(&self.title(), &self.target, &self.answers)
    }

    fn miss(&self) -> Option<(Family, usize)> {
        let (constraints, answer) = self.nearest_miss.as_ref()?;
        let parameters = placed_parameters(&answer.mechanism.four_bar).map(|(name, value)| (name.to_owned(), value));
        let family =
            Family::single_cell(Mechanism::template(), &parameters, Sampling::Samples(DEFAULT_SAMPLES as usize))
                .ok()?;
        constraints.contains(&Constraint::Condition).then_some((family, 0))
    }

    fn json(&self) -> Result<String, Failure> {
        json::json(self)
    }

    fn manifest(&self) -> String {
        answers_manifest(&self.title(), self.target.size(), &self.answers)
    }

    fn text(&self) -> String {
        text::text(self)
    }

    fn best(&self) -> Option<Best> {
        let best = self.answers.first()?;
        Some(Best { quality: best.deviation.quality(), mu_worst_deg: best.mechanism.mu_worst_deg })
    }
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let printed = [("--json", arguments.json), ("--toml", arguments.toml)];
    let is_drawing_printed = files::is_drawing_printed(arguments.svg.as_deref(), &printed)?;
    if arguments.poses {
        return poses::run(arguments, is_drawing_printed);
    }
    if arguments.function {
        return function::run(arguments, is_drawing_printed);
    }
    let several = linkage::several(arguments);
    if several.is_some() && !arguments.keep.is_empty() {
        return Err(Failure::input(
            "--keep keeps parameters of one linkage, and --linkage names several: leave it out",
        ));
    }
    let linkage = if several.is_none() { linkage::named(arguments)? } else { None };
    let searched = match (&linkage, &arguments.atlas, several) {
        (_, _, Some(several)) => Searched::Several(several),
        (Some(named), ..) => Searched::Linkage(named.searched.clone()),
        (None, Some(_), None) => Searched::Atlas,
        (None, None, None) => Searched::FourBars,
    };
    let (options, space) = request::check(arguments, searched)?;
    // Before a curve of an atlas is solved on these threads.
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let TracedPath { name, points, kind, angles_deg, reading } = read_path(arguments)?;
    if !reading.is_empty() {
        print_stderr(&format!("note: {name}: {reading}\n"));
    }
    let target = match &angles_deg {
        Some(angles_deg) => Target::timed(&points, kind, angles_deg),
        None => Target::new(&points, kind),
    };
    let target = target.map_err(|error| Failure::input(format!("{name}: {error}")))?;
    if let Some(atlas) = &arguments.atlas {
        return atlas::run((arguments, atlas), &options, (name, reading, target), is_drawing_printed);
    }
    if let Some(several) = several {
        return linkage::run_several(arguments, several, &options, (name, reading, target), is_drawing_printed);
    }
    if let Some((space, named)) = space.zip(linkage) {
        return linkage::run(arguments, (space, named), &options, (name, reading, target), is_drawing_printed);
    }
    let index = find::load_index(arguments.index.map_or(Index::DEFAULT_COUNT, |count| count as usize));
    let answers = Search::new(&target, options.clone()).run(&index);
    let nearest_miss = if answers.is_empty() { nearest_miss(&target, &index, &options) } else { None };
    let report = Report { name, reading, target, answers, nearest_miss };
    show(&report, arguments, is_drawing_printed)
}

/// The path to search for.
struct TracedPath {
    name: String,
    points: Vec<Point>,
    kind: PathKind,
    /// The angles of the crank at the points, if it is timed.
    angles_deg: Option<Vec<f64>>,
    /// What of the file was taken, and why it is closed or open.
    reading: String,
}

impl TracedPath {
    /// # Errors
    /// It is timed, open, and has no angles.
    fn new(name: String, mut outline: Outline, arguments: &Arguments) -> Result<TracedPath, Failure> {
        let kind = match arguments {
            Arguments { closed: true, .. } => PathKind::Closed,
            Arguments { open: true, .. } => PathKind::Open,
            Arguments { part: true, .. } => PathKind::Part,
            _ if outline.decide_closed() => PathKind::Closed,
            _ => PathKind::Open,
        };
        let angles_deg = if arguments.timed { outline.take_timing(kind) } else { None };
        if arguments.timed && angles_deg.is_none() {
            return Err(Failure::input(format!(
                "{name}: --timed needs an angle of the crank for each point of an open path: write them as a third column, in degrees"
            )));
        }
        Ok(TracedPath { name, points: outline.points, kind, angles_deg, reading: outline.reading.taken })
    }
}

/// The path that the arguments name.
///
/// # Errors
/// It cannot be read.
fn read_path(arguments: &Arguments) -> Result<TracedPath, Failure> {
    if let Some(name) = &arguments.like {
        let manifest = arguments.manifest.as_deref().unwrap_or(Path::new(files::DEFAULT_MANIFEST));
        let CurveSamples { points, inputs_deg, is_closed } = export::curve_points(manifest, name)?;
        if points.len() > MAX_POINTS {
            let message = format!("{name} has {} samples, and at most {MAX_POINTS} can be searched for", points.len());
            return Err(Failure::input(message));
        }
        return TracedPath::new(name.clone(), Outline::new(points, inputs_deg, Some(is_closed)), arguments);
    }
    let path = arguments.path.as_deref().unwrap_or(Path::new("-"));
    files::protect(path, "the path");
    let name = files::input_name(path);
    let bytes = output::read_bytes(path).map_err(|error| not_a_path::unreadable(path, error))?;
    let options =
        ReadOptions { is_timed: arguments.timed, outline: arguments.outline.as_deref(), ..ReadOptions::default() };
    let outline = find::parse_outline(&bytes, &options).map_err(|problems| {
        if let Some(message) = not_a_path::manifest_message(path, &bytes) {
            return Failure::inputs(&[message]);
        }
        let problems: Vec<String> = problems.iter().map(|problem| format!("{name}: {problem}")).collect();
        Failure::inputs(&problems)
    })?;
    if outline.reading.has_unused_angles {
        print_stderr(&format!(
            "note: the angles in {name} are not used: with --timed each point is reached at its own, and with --poses they are those of a body that a linkage guides\n"
        ));
    }
    TracedPath::new(name, outline, arguments)
}
