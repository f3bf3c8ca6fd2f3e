//! `find --function --linkage`: the dimensions of any linkage whose output is a function of its input.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::atomic::AtomicBool;

use crate::find::description::named_values;
use crate::find::function::{
    draw_linkage_function, find_function_by, linkage_error_in_words, linkage_function_manifest, linkage_motion_in_words,
};
use coupler_find::{
    Condition, FunctionTarget, LinkageFunctionAnswer, LinkageFunctionOptions, LinkageSpace, most_precision_points,
};
use serde::Serialize;

use super::super::super::format::angle;
use super::super::super::jams::jams;
use super::super::super::progress_bar;
use super::super::super::report as reports;
use super::super::arguments::{FitChoice, InputChoice};
use super::super::json::FORMAT;
use super::super::linkage::Named;
use super::super::{Arguments, Failure, Outcome, Shown, show, title_of};

/// A function, and the dimensions of a linkage that have been found for it.
struct LinkageFunctionReport {
    name: String,
    target: FunctionTarget,
    space: LinkageSpace,
    own_linkage: Option<String>,
    answers: Vec<LinkageFunctionAnswer>,
}

/// The starts that the arguments give, in degrees or as a length.
pub(super) type Starts = [Option<f64>; 2];

pub(super) fn run(
    arguments: &Arguments,
    named: Named,
    (name, target): (String, FunctionTarget),
    ([input_start_deg, output_start], max_link): (Starts, Option<f64>),
    is_drawing_printed: bool,
) -> Result<Outcome, Failure> {
    let Named { searched, own_linkage } = named;
    let mut problems = Vec::new();
    if let Some(ratio) = max_link.filter(|ratio| ratio.is_nan() || *ratio < 1.0) {
        problems.push(format!(
            "--max-link {ratio}: give how many times the longest link is as long as the shortest at most, as in 10, or inf"
        ));
    }
    let condition = arguments.condition.as_deref().map(|text| {
        Condition::new(&searched.template, text)
            .map_err(|error| format!("--where: `{text}`: {}", error.message_with_help()))
    });
    let condition = condition.transpose().unwrap_or_else(|problem| {
        problems.push(problem);
        None
    });
    let option = if searched.kept.is_empty() { "--linkage" } else { "--keep" };
    let space = LinkageSpace::new(searched.template.clone(), &searched.kept);
    let space = space.map_err(|errors| problems.extend(errors.iter().map(|error| format!("{option}: {error}")))).ok();
    let open_starts = [input_start_deg, output_start].iter().filter(|start| start.is_none()).count();
    let points = space.as_ref().map_or(Ok(None), |space| {
        precision_points(arguments, &target, most_precision_points(space, &target, open_starts))
    });
    let points = points.unwrap_or_else(|problem| {
        problems.push(problem);
        None
    });
    let Some(space) = space.filter(|_| problems.is_empty()) else { return Err(Failure::inputs(&problems)) };
    let options = LinkageFunctionOptions {
        minimax: arguments.fit == Some(FitChoice::Minimax),
        points,
        max_ratio: max_link.unwrap_or(f64::INFINITY),
        input_start_deg,
        output_start,
        full_turn: arguments.input == Some(InputChoice::FullTurn),
        condition,
        effort: arguments.effort.into(),
        seed: arguments.seed,
        most: arguments.top.into(),
    };
    let bar = progress_bar::of_parts(&space.template().id);
    let report_part = |part: f64| bar.set_position((1000.0 * part) as u64);
    let found = find_function_by(&space, &target, &options, &AtomicBool::new(false), report_part);
    bar.finish_and_clear();
    let found = found.map_err(Failure::input)?;
    let answers = found.map_err(Failure::input)?;
    show(&LinkageFunctionReport { name, target, space, own_linkage, answers }, arguments, is_drawing_printed)
}

/// The most precision points of a formula if their number is not given, as of four-bars.
const MOST_BY_DEFAULT: usize = 5;

/// The number of precision points that the arguments ask for, if they do: of a table its rows.
///
/// # Errors
/// There are too few or too many, or another fit is asked for, too.
fn precision_points(arguments: &Arguments, target: &FunctionTarget, most: usize) -> Result<Option<usize>, String> {
    const LEAST: usize = 3;
    let most = most.max(LEAST);
    let rows = target.row_count();
    let count = match (arguments.points, rows) {
        (Some(_), _) if arguments.fit.is_some_and(|fit| fit != FitChoice::Points) => {
            let why = "is the number of points at which the error is 0, and --fit makes it least everywhere";
            return Err(format!("--points {why}: leave one out"));
        }
        (Some(count), Some(rows)) if count != rows => {
            let why = "is of a formula; of a table each row is a precision point, and it has";
            return Err(format!("--points {why} {rows} rows: leave it out"));
        }
        (Some(count), _) => count,
        (None, _) if arguments.fit == Some(FitChoice::Points) => rows.unwrap_or(most.min(MOST_BY_DEFAULT)),
        (None, _) => return Ok(None),
    };
    if (LEAST..=most).contains(&count) {
        return Ok(Some(count));
    }
    let range = if most == LEAST { LEAST.to_string() } else { format!("from {LEAST} to {most}") };
    Err(format!(
        "{count} precision points: at most {most} can be exact with so many free parameters and starts: give {range}, or --fit least-squares"
    ))
}

#[derive(Serialize)]
struct Document {
    function: String,
    linkage: String,
    searched: Vec<String>,
    results: Vec<Record>,
}

#[derive(Serialize)]
struct Record {
    rank: usize,
    parameters: BTreeMap<String, f64>,
    input_deg: [f64; 2],
    output: [f64; 2],
    error_greatest: f64,
    error_greatest_input_deg: f64,
    error_rms: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    mu_worst_deg: Option<f64>,
}

impl LinkageFunctionReport {
    fn title(&self) -> String {
        if self.target.as_law().is_some() { self.name.clone() } else { title_of(&self.name) }
    }

    fn details(&self) -> String {
        let free: Vec<&str> = self.space.free_names().collect();
        format!("{}, parameters searched: {}", self.space.template().id, free.join(", "))
    }
}

impl Shown for LinkageFunctionReport {
    fn drawing(&self) -> Vec<u8> {
        draw_linkage_function(&self.title(), &self.details(), &self.target, &self.answers)
    }

    fn json(&self) -> Result<String, Failure> {
        let names = || self.space.template().parameters.iter().map(|parameter| parameter.name.clone());
        let record = |(rank, answer): (usize, &LinkageFunctionAnswer)| Record {
            rank,
            parameters: names().zip(answer.values.iter().copied()).collect(),
            input_deg: answer.input_deg,
            output: answer.output,
            error_greatest: answer.error.greatest,
            error_greatest_input_deg: answer.error.at,
            error_rms: answer.error.rms,
            mu_worst_deg: answer.mu_worst_deg.is_finite().then_some(answer.mu_worst_deg),
        };
        let document = Document {
            function: self.name.clone(),
            linkage: self.space.template().id.clone(),
            searched: self.space.free_names().map(str::to_owned).collect(),
            results: (1..).zip(&self.answers).map(record).collect(),
        };
        reports::json(FORMAT, &document)
    }

    fn manifest(&self) -> String {
        let id = &self.space.template().id;
        let own = self.own_linkage.as_deref();
        linkage_function_manifest(&self.title(), self.target.is_length(), id, &self.answers, own)
    }

    fn text(&self) -> String {
        let mut out = format!("{}: {}\n", self.name, self.details());
        if self.answers.is_empty() {
            return out
                + "no linkage was found; what may help: a weaker --where, a greater --max-link, fewer --points, other starts or none, --effort thorough\n";
        }
        let is_length = self.target.is_length();
        for (rank, answer) in (1..).zip(&self.answers) {
            let mu = match answer.mu_worst_deg {
                mu if mu.is_finite() => format!(", mu worst {}", angle(mu)),
                _ => String::new(),
            };
            let _ = writeln!(out, "{rank:>3}  {}{mu}", linkage_error_in_words(answer, is_length));
            let _ = writeln!(out, "     {}", named_values(self.space.template(), &answer.values));
            let _ = writeln!(out, "     {}", linkage_motion_in_words(answer, is_length));
        }
        out
    }

    fn notes(&self, arguments: &Arguments) -> String {
        self.answers.first().map_or(String::new(), |best| jams(best.mu_worst_deg, arguments.condition.as_deref()))
    }
}
