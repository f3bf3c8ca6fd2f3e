//! Chapter 10 of the thesis as a command: what is wished, what is found, and what would have to give.

mod fragment;
mod json;
mod plate;
mod text;
mod trade_offs;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use coupler_atlas::design::{self, Driver, LinkageKind, Requirement, Requirements, SynthesisResult};
use coupler_atlas::output;
use coupler_curves::expression::Expression;
use coupler_curves::problem::suggestion;

use super::{InputError, Outcome, print};

/// Find the linkages that meet a designer's wishes, ranked, with their trade-offs (Natesan, chapter 10).
///
/// straight-line: Evans's, Chebyshev's, Watt's, Roberts's and Hoeken's linkages with a straight portion, searched by a sweep
/// over their proportions and refined. Given --length or --size, or neither, the best has the longest straight portion for
/// its size; given both, it is the straightest that has this length within this size. Where nothing meets the wishes,
/// it is told what each of them would have to be, the others kept. Numbers may be expressions: "sqrt(2)".
#[derive(Debug, Args)]
pub struct Arguments {
    /// What to design.
    what: Task,
    /// What moves it: a motor wants a link that turns fully, a rocker goes there and back over the straight stroke.
    #[arg(long, value_enum, default_value_t = InputChoice::Any)]
    input: InputChoice,
    /// The way back: quick takes less of the turn than the straight stroke.
    #[arg(long = "return", value_enum, default_value_t = ReturnChoice::Any)]
    back: ReturnChoice,
    /// Whether the curve is to cross itself, as Watt's does, which the thesis would use to return by.
    #[arg(long, value_enum, default_value_t = DoublePointChoice::Any)]
    double_point: DoublePointChoice,
    /// The frame to the crank of Evans's and Hoeken's linkages, to the coupler of the others; what (8.10) and (8.19) give
    /// for it is shown beside what is found.
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    p: Option<String>,
    /// The length of the straight portion, projected on its line; every length is then in its unit.
    #[arg(long, value_name = "L", allow_hyphen_values = true)]
    length: Option<String>,
    /// How straight: the width of the strip it lies in over its length, twice the deviation [default: 0.001].
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with = "deviation")]
    tolerance: Option<String>,
    /// How straight: the greatest distance from its line, in the unit of --length.
    #[arg(long, value_name = "D", allow_hyphen_values = true, requires = "length")]
    deviation: Option<String>,
    /// The largest size: the greatest distance between any two places that its joints, pivots and coupler point come to;
    /// of a motor's linkage over the whole turn, of a rocker's over the straight stroke.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    size: Option<String>,
    /// The smallest transmission angle in degrees, over the same motion; one over 90 counts as its supplement. 0 asks for
    /// nothing [default: 20].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    mu_min: Option<String>,
    /// The linkages to choose from [default: all of evans,hoeken,chebyshev,watt,roberts].
    #[arg(long, value_name = "TYPES", value_delimiter = ',')]
    types: Option<Vec<String>>,
    /// How many to show at most, 1 to 20; of a given p, what (8.10) and (8.19) give is shown beside them.
    #[arg(long, value_name = "N", allow_hyphen_values = true, default_value = "5")]
    best: String,
    /// Draw them on one plate.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Print a manifest that renders them, whole: coupler-atlas design … --toml > best.toml
    #[arg(long, conflicts_with = "json")]
    toml: bool,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Task {
    /// A linkage with a straight line.
    StraightLine,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum InputChoice {
    Motor,
    Rocker,
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ReturnChoice {
    Quick,
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DoublePointChoice {
    Yes,
    No,
    Any,
}

/// What was wished, as it was given, and what came of it.
struct Report {
    requirements: Requirements,
    /// Whether a deviation was given in place of a tolerance.
    is_deviation_given: bool,
    results: SynthesisResult,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let Task::StraightLine = arguments.what;
    let wishes = parse_requirements(arguments).map_err(|wrong| InputError(wrong.join("\nerror: ")))?;
    let found = design::straight_line(&wishes);
    let report = Report { requirements: wishes, is_deviation_given: arguments.deviation.is_some(), results: found };
    if report.results.designs.is_empty() {
        // Programs are told as JSON too, and by the exit code as everyone.
        if arguments.json {
            print(&json::json(&report))?;
        }
        return Err(InputError(text::no_design_message(&report)).into());
    }
    if let Some(path) = &arguments.svg {
        output::write_file(path, &plate::plate(&report))?;
    }
    let out = match (arguments.json, arguments.toml) {
        (true, _) => json::json(&report),
        (_, true) => fragment::manifest(&report),
        _ => text::text(&report),
    };
    print(&out)?;
    Ok(Outcome::Done)
}

/// The wishes, or everything that is wrong with them.
fn parse_requirements(arguments: &Arguments) -> Result<Requirements, Vec<String>> {
    let mut wrong = Vec::new();
    let mut read = |text: &Option<String>, name: &str, example: &str| {
        let text = text.as_deref()?;
        parse_number(text, &format!("--{name} {example}")).map_err(|why| wrong.push(format!("--{name}: {why}"))).ok()
    };
    let default = Requirements::default();
    let (p, length) = (read(&arguments.p, "p", "2"), read(&arguments.length, "length", "100"));
    let deviation = read(&arguments.deviation, "deviation", "0.05");
    let tolerance = read(&arguments.tolerance, "tolerance", "0.001");
    let (size, mu_min) = (read(&arguments.size, "size", "400"), read(&arguments.mu_min, "mu-min", "30"));
    let best = read(&Some(arguments.best.clone()), "best", "5").unwrap_or(1.0);
    if !(1.0..=20.0).contains(&best) || best.fract() != 0.0 {
        wrong.push(format!("--best: {best} is not a whole number from 1 to 20"));
    }
    let kinds = match &arguments.types {
        None => default.kinds,
        Some(names) => parse_kinds(names, &mut wrong),
    };
    let by_deviation = deviation.zip(length).map(|(deviation, length)| 2.0 * deviation / length);
    let wishes = Requirements {
        input: match arguments.input {
            InputChoice::Motor => Some(Driver::Motor),
            InputChoice::Rocker => Some(Driver::Rocker),
            InputChoice::Any => None,
        },
        double_point: match arguments.double_point {
            DoublePointChoice::Yes => Some(true),
            DoublePointChoice::No => Some(false),
            DoublePointChoice::Any => None,
        },
        quick_return: arguments.back == ReturnChoice::Quick,
        p,
        length,
        tolerance: by_deviation.or(tolerance).unwrap_or(default.tolerance),
        size,
        mu_min: mu_min.unwrap_or(default.mu_min),
        kinds,
        max_designs: best as usize,
    };
    let named = |(wish, why): (Requirement, String)| match wish {
        Requirement::Tolerance if deviation.is_some() => format!("--deviation: twice it over the length is {why}"),
        _ => format!("{}: {why}", option_name(wish)),
    };
    // No linkage is left where the names given are wrong: that has been said.
    let is_new = |(wish, _): &(Requirement, String)| *wish != Requirement::Kinds || wrong.is_empty();
    let objections: Vec<String> = wishes.errors().into_iter().filter(is_new).map(named).collect();
    wrong.extend(objections);
    if wrong.is_empty() { Ok(wishes) } else { Err(wrong) }
}

fn parse_kinds(names: &[String], wrong: &mut Vec<String>) -> Vec<LinkageKind> {
    let known = LinkageKind::ALL.map(LinkageKind::id);
    let mut kinds = Vec::new();
    for name in names {
        match LinkageKind::ALL.into_iter().find(|kind| kind.id() == name.trim()) {
            Some(kind) => kinds.push(kind),
            None => wrong.push(format!("--types: there is no `{name}` here: {}", suggestion(name, &known))),
        }
    }
    kinds
}

/// A finite number, or an expression without names that is one.
fn parse_number(text: &str, example: &str) -> Result<f64, String> {
    let expression =
        Expression::parse(text).map_err(|error| format!("`{text}`: {}; write it like {example}", error.message))?;
    if let Some(name) = expression.names().first() {
        return Err(format!("`{text}`: `{name}` has no value here; write it like {example}"));
    }
    match expression.evaluate(|_| f64::NAN) {
        value if value.is_finite() => Ok(value),
        value => Err(format!("`{text}` is {value}: give a finite number, as in {example}")),
    }
}

/// The option a wish is given by.
fn option_name(wish: Requirement) -> &'static str {
    match wish {
        Requirement::Input => "--input",
        Requirement::DoublePoint => "--double-point",
        Requirement::QuickReturn => "--return",
        Requirement::P => "--p",
        Requirement::Length => "--length",
        Requirement::Tolerance => "--tolerance",
        Requirement::Size => "--size",
        Requirement::MuMin => "--mu-min",
        Requirement::Kinds => "--types",
    }
}
