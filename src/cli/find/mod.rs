//! `find`: the linkages whose coupler curves are nearest to a path.

mod atlas;
mod json;
mod linkage;
mod not_a_path;
mod notes;
mod shown;
mod text;

use std::path::{Path, PathBuf};

use crate::find::{self, MAX_CURVES, MAX_POINTS, Outline};
use crate::output;
use clap::{Args, ValueEnum, ValueHint};
use coupler_curves::expression::Expression;
use coupler_curves::find::{
    Answer, Constraint, Effort, Index, Options, PathKind, Search, Target, answers_manifest, nearest_miss,
};
use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::template::Template;

use super::export::CurveSamples;
use super::{InputError, InputErrors, Outcome, export, files, source};
use notes::Best;
use shown::{Shown, show};

/// Find the linkages whose coupler curves are nearest to a path, with their cognates.
///
/// The path is a table of points (x, y on each line), JSON or a drawing in SVG, of which the longest outline is read, with y
/// pointing up; - for standard input. Curves are compared by E, the root of the mean square of the distances of its points from the
/// continuous curve, in their order along one circuit, relative to the path's size S, the root of the mean square of their
/// distances from their centroid. docs/find.md describes the search and its limits.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The file of the path.
    #[arg(value_name = "PATH", value_hint = ValueHint::FilePath, required_unless_present = "like")]
    path: Option<PathBuf>,
    /// Take a curve of an atlas as the path, by its name, as in evans:3.1.1 or "evans:3.1.1?p=2.5".
    #[arg(long, value_name = "CURVE", conflicts_with = "path")]
    like: Option<String>,
    #[arg(
        long,
        value_name = "FILE",
        value_hint = ValueHint::FilePath,
        help = format!(
            "The manifest with the curve of --like, or with the linkage of --linkage; - for standard input [default of --like: {}]",
            source::DEFAULT_MANIFEST
        )
    )]
    manifest: Option<PathBuf>,
    /// The path is closed; without these three it is if the gap between its ends is at most 1.5 times the median distance of its points,
    /// and otherwise open.
    #[arg(long, conflicts_with_all = ["open", "part"])]
    closed: bool,
    /// The path is open: the curve passes its points in their order, whatever it does between them and elsewhere.
    #[arg(long, conflicts_with = "part")]
    open: bool,
    /// The path is a part of the curve, and that part is as long as the path.
    #[arg(long)]
    part: bool,
    /// The crank reaches the points at their angles, in degrees from any zero and in either direction: a third column, or one named
    /// `angle`; without angles a closed path has equal steps of a turn.
    #[arg(long)]
    timed: bool,
    /// Whether the crank must turn fully.
    #[arg(long, value_enum, default_value_t = InputChoice::FullTurn)]
    input: InputChoice,
    /// A condition on the linkage, as in `where` of a manifest: "is_crank_rocker and mu_worst_deg >= 30". Its names are frame, crank,
    /// coupler, rocker, along and across, the crank's pivot x and y, turn, the frame's angle, and all measures; with --linkage the
    /// parameters of that linkage and all measures.
    #[arg(long = "where", value_name = "EXPR")]
    condition: Option<String>,
    /// The greatest distance of two joints of a link, in sizes S of the path; inf for any.
    #[arg(long, value_name = "X", default_value = "10", allow_hyphen_values = true)]
    max_link: String,
    /// The box in which both fixed pivots must be, in the unit of the path: XMIN,YMIN,XMAX,YMAX.
    #[arg(long, value_name = "BOX", allow_hyphen_values = true)]
    pivots: Option<String>,
    #[arg(
        long,
        value_name = "N",
        default_value_t = Options::default().most as u16,
        value_parser = clap::value_parser!(u16).range(1..=MAX_TOP),
        help = format!("How many linkages to show at most, 1 to {MAX_TOP}")
    )]
    top: u16,
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u64).range(1..=MAX_CURVES as u64),
        help = format!(
            "How many four-bars to look the path up in, 1 to {MAX_CURVES}; the index of each number is kept in the user's cache folder \
             [default: {}]. With --linkage, the number of its parameter sets, which are not kept",
            Index::DEFAULT_COUNT
        )
    )]
    index: Option<u64>,
    /// Look the path up in the curves of an atlas, of any linkages: its manifest, or the folder of a rendered one with the manifest beside it.
    /// Four-bars are refined, others only placed on the path.
    #[arg(long, value_name = "MANIFEST|DIR", value_hint = ValueHint::AnyPath)]
    atlas: Option<PathBuf>,
    /// Search the dimensions of a linkage, a built-in one (coupler-atlas list linkages) or one of --manifest, in place of a four-bar.
    #[arg(long, value_name = "NAME", conflicts_with = "atlas")]
    linkage: Option<String>,
    /// With --linkage, keep a parameter at its default or at a value, which may use others; may be repeated: --keep s --keep "k=2".
    #[arg(long, value_name = "NAME[=EXPR]", requires = "linkage")]
    keep: Vec<String>,
    /// With --atlas, compare its curves where they are: position, size and rotation count.
    #[arg(long)]
    fixed: bool,
    /// Only place the curves of the index on the path, without moving their linkages towards it.
    #[arg(long)]
    no_refine: bool,
    /// How many linkages are tried.
    #[arg(long, value_enum, default_value_t = EffortChoice::Normal)]
    effort: EffortChoice,
    /// A number that changes which linkages are tried near those that have been found.
    #[arg(long, value_name = "N", default_value_t = Options::default().seed)]
    seed: u64,
    /// The number of threads for the index [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Draw the path and the curves on one page, and write it to this file; - for standard output, in place of the text.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = files::svg_parser())]
    svg: Option<PathBuf>,
    /// Print a manifest that renders the linkages: coupler-atlas find … --toml > found.toml
    #[arg(long, conflicts_with = "json")]
    toml: bool,
    /// Print the linkages as JSON.
    #[arg(long)]
    json: bool,
}

/// The greatest `--top`.
const MAX_TOP: i64 = 100;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum InputChoice {
    /// The crank turns fully.
    FullTurn,
    /// Any linkage.
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum EffortChoice {
    /// A third of the normal effort.
    Quick,
    /// About half a second for a hundred points.
    Normal,
    /// Four times the normal effort.
    Thorough,
}

/// A path, and what has been found for it.
struct Report {
    /// The name of the path, for titles.
    name: String,
    target: Target,
    answers: Vec<Answer>,
    /// If there is no answer, the constraints to relax, and the answer without them.
    nearest_miss: Option<(Vec<Constraint>, Answer)>,
}

impl Report {
    /// The name of the path without its folder.
    fn title(&self) -> String {
        title_of(&self.name)
    }
}

impl Shown for Report {
    fn drawing(&self) -> Vec<u8> {
        find::draw_four_bars(&self.title(), &self.target, &self.answers)
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

/// The name of a path without its folder.
fn title_of(name: &str) -> String {
    Path::new(name).file_name().map_or(name.to_owned(), |name| name.to_string_lossy().into_owned())
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
    let TracedPath { name, points, kind, angles_deg } = read_path(arguments)?;
    let target = match &angles_deg {
        Some(angles_deg) => Target::timed(&points, kind, angles_deg),
        None => Target::new(&points, kind),
    };
    let target = target.map_err(|error| InputError(format!("{name}: {error}")))?;
    if let Some(atlas) = &arguments.atlas {
        return atlas::run((arguments, atlas), &options, (name, target), is_drawing_printed);
    }
    if let Some(sought) = sought {
        return linkage::run(arguments, sought, &options, (name, target), is_drawing_printed);
    }
    let index = find::load_index(arguments.index.map_or(Index::DEFAULT_COUNT, |count| count as usize));
    let answers = Search::new(&target, options.clone()).run(&index);
    let nearest_miss = if answers.is_empty() { nearest_miss(&target, &index, &options) } else { None };
    let report = Report { name, target, answers, nearest_miss };
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
}

impl TracedPath {
    /// # Errors
    /// It is timed, open, and has no angles.
    fn new(name: String, mut outline: Outline, kind: PathKind, is_timed: bool) -> Result<TracedPath, InputError> {
        let angles_deg = if is_timed { outline.take_timing(kind) } else { None };
        if is_timed && angles_deg.is_none() {
            return Err(InputError(format!(
                "{name}: --timed needs an angle of the crank for each point of an open path: write them as a third column, in degrees"
            )));
        }
        Ok(TracedPath { name, points: outline.points, kind, angles_deg })
    }
}

/// The path that the arguments name.
///
/// # Errors
/// It cannot be read.
fn read_path(arguments: &Arguments) -> anyhow::Result<TracedPath> {
    let kind = |is_closed: bool| match arguments {
        Arguments { closed: true, .. } => PathKind::Closed,
        Arguments { open: true, .. } => PathKind::Open,
        Arguments { part: true, .. } => PathKind::Part,
        _ if is_closed => PathKind::Closed,
        _ => PathKind::Open,
    };
    if let Some(name) = &arguments.like {
        let manifest = arguments.manifest.as_deref().unwrap_or(Path::new(source::DEFAULT_MANIFEST));
        let CurveSamples { points, inputs_deg, is_closed } = export::curve_points(manifest, name)?;
        if points.len() > MAX_POINTS {
            let message = format!("{name} has {} samples, and at most {MAX_POINTS} can be searched for", points.len());
            return Err(InputError(message).into());
        }
        let outline = Outline { points, angles_deg: inputs_deg, is_closed: Some(is_closed) };
        return Ok(TracedPath::new(name.clone(), outline, kind(is_closed), arguments.timed)?);
    }
    let path = arguments.path.as_deref().unwrap_or(Path::new("-"));
    files::protect(path);
    let name = files::input_name(path);
    let text = output::read_text(path).map_err(|error| not_a_path::unreadable(path, &error))?;
    let outline = find::parse_outline(&text, arguments.timed).map_err(|problems| {
        if let Some(message) = not_a_path::manifest_message(path, &text) {
            return InputErrors::from_messages(&[message]);
        }
        let problems: Vec<String> = problems.iter().map(|problem| format!("{name}: {problem}")).collect();
        InputErrors::from_messages(&problems)
    })?;
    let is_closed = outline.is_closed.unwrap_or_else(|| outline.looks_closed());
    Ok(TracedPath::new(name, outline, kind(is_closed), arguments.timed)?)
}
