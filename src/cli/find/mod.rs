//! `find`: the linkages whose coupler curves are nearest to a path.

mod arguments;
mod atlas;
mod json;
mod linkage;
mod not_a_path;
mod notes;
mod report;
mod shown;
mod text;

use std::path::Path;

use crate::find::{self, MAX_POINTS, Outline, ReadOptions};
use crate::output;
use coupler_curves::expression::Expression;
use coupler_curves::family::Family;
use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::motion::Sampling;
use coupler_curves::template::Template;
use coupler_find::{
    Constraint, Effort, Index, Mechanism, Options, PathKind, Search, Target, answers_manifest, nearest_miss,
    placed_parameters,
};

use super::export::CurveSamples;
use super::linkage::DEFAULT_SAMPLES;
use super::{InputError, InputErrors, Outcome, export, files, print_stderr, source};
pub use arguments::Arguments;
use arguments::{EffortChoice, InputChoice};
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

    fn json(&self) -> anyhow::Result<String> {
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
        Some(Best { quality: best.quality(), mu_worst_deg: best.mechanism.mu_worst_deg })
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let printed = [("--json", arguments.json), ("--toml", arguments.toml)];
    let is_drawing_printed = files::is_drawing_printed(arguments.svg.as_deref(), &printed)?;
    atlas::check(arguments)?;
    linkage::check(arguments)?;
    let sought = linkage::sought(arguments)?;
    let template = sought.as_ref().map(|sought| &*sought.template);
    let options = parse_options(arguments, template).map_err(|errors| InputErrors::from_messages(&errors))?;
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
    let target = target.map_err(|error| InputError(format!("{name}: {error}")))?;
    if let Some(atlas) = &arguments.atlas {
        return atlas::run((arguments, atlas), &options, (name, reading, target), is_drawing_printed);
    }
    if let Some(sought) = sought {
        return linkage::run(arguments, sought, &options, (name, reading, target), is_drawing_printed);
    }
    let index = find::load_index(arguments.index.map_or(Index::DEFAULT_COUNT, |count| count as usize));
    let answers = Search::new(&target, options.clone()).run(&index);
    let nearest_miss = if answers.is_empty() { nearest_miss(&target, &index, &options) } else { None };
    let report = Report { name, reading, target, answers, nearest_miss };
    show(&report, arguments, is_drawing_printed)
}

/// Reads the options of the search, for a linkage other than the four-bar if there is one.
///
/// # Errors
/// Every error in them, one message each.
fn parse_options(arguments: &Arguments, template: Option<&Template>) -> Result<Options, Vec<String>> {
    let mut errors = Vec::new();
    let mut max_link = Options::default().max_link;
    match parse_max_link(&arguments.max_link) {
        Ok(value) => max_link = value,
        Err(error) => errors.push(format!("--max-link: {error}")),
    }
    let mut pivots = None;
    match arguments.pivots.as_deref().map(parse_box).transpose() {
        Ok(value) => pivots = value,
        Err(error) => errors.push(format!("--pivots: {error}")),
    }
    let mut condition = None;
    // The names of an atlas's linkages are not known yet.
    let own = arguments.condition.as_deref().filter(|_| arguments.atlas.is_none());
    match own.map(|text| linkage::condition(template, text).map_err(|error| (text, error))).transpose() {
        Ok(value) => condition = value,
        Err((text, error)) => {
            let help = if error.help.is_empty() { String::new() } else { format!("; {}", error.help) };
            errors.push(format!("--where: `{text}`: {error}{help}"));
        }
    }
    let effort = match arguments.effort {
        EffortChoice::Quick => Effort::Quick,
        EffortChoice::Normal => Effort::Normal,
        EffortChoice::Thorough => Effort::Thorough,
    };
    let options = Options {
        full_turn: arguments.input == InputChoice::FullTurn,
        max_link,
        pivots,
        condition,
        effort,
        refine: !arguments.no_refine,
        seed: arguments.seed,
        most: arguments.top.into(),
    };
    if errors.is_empty() { Ok(options) } else { Err(errors) }
}

/// Reads a length in sizes of the path, or `inf`.
fn parse_max_link(text: &str) -> Result<f64, String> {
    if text.trim() == "inf" {
        return Ok(f64::INFINITY);
    }
    let value =
        Expression::evaluate_constant(text).map_err(|error| format!("`{text}`: {error}; write it like 10, or inf"))?;
    match value {
        value if value.is_finite() && value > 0.0 => Ok(value),
        value => Err(format!("`{text}` is {value}: give a positive number of sizes of the path, as in 10, or inf")),
    }
}

/// Reads a box: `XMIN,YMIN,XMAX,YMAX`.
fn parse_box(text: &str) -> Result<Bounds, String> {
    const EXAMPLE: &str = "write it like --pivots=-50,-20,50,0";
    let values: Result<Vec<f64>, String> = text
        .split(',')
        .map(|part| match part.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(format!("`{part}` is not a number; {EXAMPLE}")),
        })
        .collect();
    match values?[..] {
        [x_min, y_min, x_max, y_max] if x_min < x_max && y_min < y_max => {
            Ok(Bounds::from_points([Point::new(x_min, y_min), Point::new(x_max, y_max)]))
        }
        [_, _, _, _] => Err(format!("`{text}` is no box: XMIN < XMAX and YMIN < YMAX; {EXAMPLE}")),
        _ => Err(format!("`{text}` does not have four numbers; {EXAMPLE}")),
    }
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
    fn new(name: String, mut outline: Outline, arguments: &Arguments) -> Result<TracedPath, InputError> {
        let kind = match arguments {
            Arguments { closed: true, .. } => PathKind::Closed,
            Arguments { open: true, .. } => PathKind::Open,
            Arguments { part: true, .. } => PathKind::Part,
            _ if outline.decide_closed() => PathKind::Closed,
            _ => PathKind::Open,
        };
        let angles_deg = if arguments.timed { outline.take_timing(kind) } else { None };
        if arguments.timed && angles_deg.is_none() {
            return Err(InputError(format!(
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
fn read_path(arguments: &Arguments) -> anyhow::Result<TracedPath> {
    if let Some(name) = &arguments.like {
        let manifest = arguments.manifest.as_deref().unwrap_or(Path::new(files::DEFAULT_MANIFEST));
        let CurveSamples { points, inputs_deg, is_closed } = export::curve_points(manifest, name)?;
        if points.len() > MAX_POINTS {
            let message = format!("{name} has {} samples, and at most {MAX_POINTS} can be searched for", points.len());
            return Err(InputError(message).into());
        }
        return Ok(TracedPath::new(name.clone(), Outline::new(points, inputs_deg, Some(is_closed)), arguments)?);
    }
    let path = arguments.path.as_deref().unwrap_or(Path::new("-"));
    files::protect(path);
    let name = files::input_name(path);
    let bytes = output::read_bytes(path).map_err(|error| not_a_path::unreadable(path, error))?;
    let options =
        ReadOptions { is_timed: arguments.timed, outline: arguments.outline.as_deref(), ..ReadOptions::default() };
    let outline = find::parse_outline(&bytes, &options).map_err(|problems| {
        if let Some(message) = not_a_path::manifest_message(path, &bytes) {
            return InputErrors::from_messages(&[message]);
        }
        let problems: Vec<String> = problems.iter().map(|problem| format!("{name}: {problem}")).collect();
        InputErrors::from_messages(&problems)
    })?;
    if outline.reading.has_unused_angles {
        print_stderr(&format!(
            "note: the angles in {name} are not used: with --timed each point is reached at its own\n"
        ));
    }
    Ok(TracedPath::new(name, outline, arguments)?)
}
