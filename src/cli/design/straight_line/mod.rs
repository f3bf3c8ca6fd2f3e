//! `design straight-line`: finds straight-line linkages for a designer's requirements, or the requirements to relax (Natesan, chapter 10).

mod format;
mod fragment;
mod json;
mod plate;
mod report;
mod text;
mod trade_offs;

use std::path::PathBuf;

use crate::design::{self, Driver, LinkageKind, Requirement, Requirements};
use clap::{Args, ValueEnum, ValueHint};
use coupler_curves::expression::Expression;

use super::super::{Failure, Outcome, choice, files, print, print_bytes};
use report::{Report, option_name};

/// Find straight-line linkages that meet a designer's requirements, ranked, with their trade-offs (Natesan, chapter 10).
///
/// Searches the linkages of Evans, Chebyshev, Watt, Roberts and Hoeken for a straight portion, by a sweep over their proportions that is
/// then refined. Without --length or --size, or with one of them, the best design has the longest straight portion for its size; with both,
/// it is the straightest that has this length within this size. If no linkage meets the requirements, the error lists what each of them
/// would have to be while the others are kept. Numbers may be expressions: "sqrt(2)".
#[derive(Debug, Args)]
pub struct Arguments {
    /// What drives the linkage.
    #[arg(long, value_enum, default_value_t = InputChoice::Any)]
    input: InputChoice,
    /// How fast the linkage returns from the straight stroke.
    #[arg(long = "return", value_name = "RETURN", value_enum, default_value_t = ReturnChoice::Any)]
    back: ReturnChoice,
    /// Whether the curve must cross itself, as that of Watt's linkage does; the thesis would use the crossing for the
    /// return.
    #[arg(long, value_enum, default_value_t = DoublePointChoice::Any)]
    double_point: DoublePointChoice,
    /// The ratio of the frame to the crank (evans, hoeken) or to the coupler (the others); the proportions that (8.10)
    /// and (8.19) give for it are shown as well.
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    p: Option<String>,
    /// The length of the straight portion, projected on its line; sets the unit of all other lengths.
    #[arg(long, value_name = "L", allow_hyphen_values = true)]
    length: Option<String>,
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with = "deviation", help = tolerance_help())]
    tolerance: Option<String>,
    /// The greatest distance of the straight portion from its line, in the unit of --length; replaces --tolerance.
    #[arg(long, value_name = "D", allow_hyphen_values = true, requires = "length")]
    deviation: Option<String>,
    /// The greatest size: the largest distance between any two positions of the joints, pivots and coupler point, over
    /// the whole turn with a motor and over the straight stroke with a rocker.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    size: Option<String>,
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, help = mu_min_help())]
    mu_min: Option<String>,
    #[arg(long, value_name = "TYPES", value_delimiter = ',', help = types_help())]
    types: Option<Vec<String>>,
    #[arg(
        long,
        value_name = "N",
        default_value_t = Requirements::default().max_designs.to_string(),
        help = best_help()
    )]
    best: String,
    /// Draw the designs on one plate, and write it to this file; - for standard output, in place of the text.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = files::svg_parser())]
    svg: Option<PathBuf>,
    /// Print a manifest that renders the designs: coupler-atlas design … --toml > best.toml
    #[arg(long, conflicts_with = "json")]
    toml: bool,
    /// Print the designs as JSON.
    #[arg(long)]
    json: bool,
}

/// The greatest number of designs that `--best` accepts.
const MAX_BEST: usize = 20;

fn tolerance_help() -> String {
    let default = Requirements::default().tolerance;
    format!(
        "The greatest width of the strip around the straight portion (twice the deviation), relative to the length of \
         the portion [default: {default}]"
    )
}

fn mu_min_help() -> String {
    let default = Requirements::default().mu_min;
    format!(
        "The least transmission angle in degrees, over the same motion as --size; an angle over 90 counts as its \
         supplement, and 0 sets no limit [default: {default}]"
    )
}

fn types_help() -> String {
    format!(
        "The linkages to choose from, separated by commas [default: {}]",
        LinkageKind::ALL.map(LinkageKind::id).join(",")
    )
}

fn best_help() -> String {
    format!(
        "How many designs to show at most, 1 to {MAX_BEST}; with --p, the proportions that (8.10) and (8.19) give are \
         shown in addition"
    )
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum InputChoice {
    /// A motor on a link that turns fully.
    Motor,
    /// A link that rocks over the straight stroke and back.
    Rocker,
    /// Either.
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ReturnChoice {
    /// The return takes less of the turn than the straight stroke.
    Quick,
    /// No requirement.
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DoublePointChoice {
    /// The curve crosses itself.
    Yes,
    /// The curve does not cross itself.
    No,
    /// No requirement.
    Any,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let printed = [("--json", arguments.json), ("--toml", arguments.toml)];
    let is_drawing_printed = files::is_drawing_printed(arguments.svg.as_deref(), &printed)?;
    let requirements = parse_requirements(arguments).map_err(|errors| Failure::inputs(&errors))?;
    let results = design::straight_line(&requirements);
    let report = Report { requirements, is_deviation_given: arguments.deviation.is_some(), results };
    if report.results.designs.is_empty() {
        // The JSON lists the relaxations; the exit code is that of an error all the same.
        if arguments.json {
            print_bytes(json::json(&report).as_bytes())?;
        }
        return Err(Failure::inputs(&[text::no_design_message(&report)]));
    }
    if let Some(path) = &arguments.svg {
        files::write(path, &plate::plate(&report))?;
        if is_drawing_printed {
            return Ok(Outcome::Done);
        }
    }
    match (arguments.json, arguments.toml) {
        (true, _) => print_bytes(json::json(&report).as_bytes())?,
        (_, true) => print_bytes(fragment::manifest(&report).as_bytes())?,
        _ => print(&text::text(&report))?,
    }
    Ok(Outcome::Done)
}

/// Reads the requirements.
///
/// # Errors
/// Every error in the options, one message each.
fn parse_requirements(arguments: &Arguments) -> Result<Requirements, Vec<String>> {
    let mut errors = Vec::new();
    let mut read = |text: &Option<String>, name: &str, example: &str| {
        let text = text.as_deref()?;
        let number = match name {
            "mu-min" => parse_angle(text, &format!("--{name} {example}")),
            _ => parse_number(text, &format!("--{name} {example}")),
        };
        number.map_err(|error| errors.push(format!("--{name}: {error}"))).ok()
    };
    let default = Requirements::default();
    let (p, length) = (read(&arguments.p, "p", "2"), read(&arguments.length, "length", "100"));
    let deviation = read(&arguments.deviation, "deviation", "0.05");
    let tolerance = read(&arguments.tolerance, "tolerance", "0.001");
    let (size, mu_min) = (read(&arguments.size, "size", "400"), read(&arguments.mu_min, "mu-min", "30"));
    let best = read(&Some(arguments.best.clone()), "best", "5").unwrap_or(1.0);
    if !(1.0..=MAX_BEST as f64).contains(&best) || best.fract() != 0.0 {
        errors.push(format!("--best: {best} is not a whole number from 1 to {MAX_BEST}"));
    }
    let kinds = match &arguments.types {
        None => default.kinds,
        Some(names) => parse_kinds(names, &mut errors),
    };
    let deviation_tolerance = deviation.zip(length).map(|(deviation, length)| 2.0 * deviation / length);
    let requirements = Requirements {
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
        tolerance: deviation_tolerance.or(tolerance).unwrap_or(default.tolerance),
        size,
        mu_min: mu_min.unwrap_or(default.mu_min),
        kinds,
        max_designs: best as usize,
    };
    let with_option = |(requirement, error): (Requirement, String)| match requirement {
        Requirement::Tolerance if deviation.is_some() => {
            format!("--deviation: twice its ratio to the length is {error}")
        }
        _ => format!("{}: {error}", option_name(requirement)),
    };
    // With a wrong name in `--types` there may be no linkage to choose from, and the name has been reported.
    let is_new = |(requirement, _): &(Requirement, String)| *requirement != Requirement::Kinds || errors.is_empty();
    let further: Vec<String> = requirements.errors().into_iter().filter(is_new).map(with_option).collect();
    errors.extend(further);
    if errors.is_empty() { Ok(requirements) } else { Err(errors) }
}

fn parse_kinds(names: &[String], errors: &mut Vec<String>) -> Vec<LinkageKind> {
    let known = LinkageKind::ALL.map(LinkageKind::id);
    let mut kinds = Vec::new();
    for name in names {
        match LinkageKind::ALL.into_iter().find(|kind| kind.id() == name.trim()) {
            Some(kind) => kinds.push(kind),
            None => errors.push(format!("--types: {}", choice::unknown("linkage", name, &known))),
        }
    }
    kinds
}

/// Reads a finite number or an expression without names; `example` is shown in the error.
fn parse_number(text: &str, example: &str) -> Result<f64, String> {
    let value =
        Expression::evaluate_constant(text).map_err(|error| format!("`{text}`: {error}; write it like {example}"))?;
    match value {
        value if value.is_finite() => Ok(value),
        value => Err(format!("`{text}` is {value}: give a finite number, as in {example}")),
    }
}

/// Reads an angle in degrees, or in the unit that it states.
fn parse_angle(text: &str, example: &str) -> Result<f64, String> {
    let value = crate::inspect::parse_input(text, false, example)?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(format!("`{text}` is {value}: give a finite number, as in {example}"))
    }
}
