//! Chapter 10 of the thesis as a command: what is wished, what is found, and what would have to give.

mod compared;
mod fragment;
mod json;
mod plate;
mod text;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use coupler_atlas::build;
use coupler_atlas::design::{self, Found, Input, Kind, Wish, Wishes};
use coupler_curves::expression::Expression;
use coupler_curves::problem::nearest_or_all;

use super::{Outcome, WrongInput, print};

/// Find the linkages that meet a designer's wishes, ranked, with their trade-offs (Natesan, chapter 10).
///
/// straight-line: Evans's, Chebyshev's, Watt's, Roberts's and Hoeken's linkages with a straight portion, searched by a sweep
/// over their proportions and refined. Given --length or --size, or neither, the best has the longest straight portion for
/// its size; given both, it is the straightest that has this length within this size. Where nothing meets the wishes,
/// it is told what each of them would have to be, the others kept. Numbers may be expressions: "sqrt(2)".
#[derive(Debug, Args)]
pub struct Arguments {
    /// What to design.
    what: What,
    /// What moves it: a motor wants a link that turns fully, a rocker goes there and back over the straight stroke.
    #[arg(long, value_enum, default_value_t = Moved::Any)]
    input: Moved,
    /// The way back: quick takes less of the turn than the straight stroke.
    #[arg(long = "return", value_enum, default_value_t = Return::Any)]
    back: Return,
    /// Whether the curve is to cross itself, as Watt's does, which the thesis would use to return by.
    #[arg(long, value_enum, default_value_t = DoublePoint::Any)]
    double_point: DoublePoint,
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
enum What {
    /// A linkage with a straight line.
    StraightLine,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Moved {
    Motor,
    Rocker,
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Return {
    Quick,
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DoublePoint {
    Yes,
    No,
    Any,
}

/// What was wished, as it was given, and what came of it.
struct Report {
    wishes: Wishes,
    /// Whether a deviation was given in place of a tolerance.
    by_deviation: bool,
    found: Found,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let What::StraightLine = arguments.what;
    let wishes = wishes(arguments).map_err(|wrong| WrongInput(wrong.join("\nerror: ")))?;
    let found = design::straight_line(&wishes);
    let report = Report { wishes, by_deviation: arguments.deviation.is_some(), found };
    if report.found.designs.is_empty() {
        // Programs are told as JSON too, and by the exit code as everyone.
        if arguments.json {
            print(&json::json(&report))?;
        }
        return Err(WrongInput(text::nothing(&report)).into());
    }
    if let Some(path) = &arguments.svg {
        build::write_file(path, &plate::plate(&report))?;
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
fn wishes(arguments: &Arguments) -> Result<Wishes, Vec<String>> {
    let mut wrong = Vec::new();
    let mut read = |text: &Option<String>, name: &str, example: &str| {
        let text = text.as_deref()?;
        number(text, &format!("--{name} {example}")).map_err(|why| wrong.push(format!("--{name}: {why}"))).ok()
    };
    let default = Wishes::default();
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
        Some(names) => kinds(names, &mut wrong),
    };
    let by_deviation = deviation.zip(length).map(|(deviation, length)| 2.0 * deviation / length);
    let wishes = Wishes {
        input: match arguments.input {
            Moved::Motor => Some(Input::Motor),
            Moved::Rocker => Some(Input::Rocker),
            Moved::Any => None,
        },
        double_point: match arguments.double_point {
            DoublePoint::Yes => Some(true),
            DoublePoint::No => Some(false),
            DoublePoint::Any => None,
        },
        quick_return: arguments.back == Return::Quick,
        p,
        length,
        tolerance: by_deviation.or(tolerance).unwrap_or(default.tolerance),
        size,
        mu_min: mu_min.unwrap_or(default.mu_min),
        kinds,
        best: best as usize,
    };
    let named = |(wish, why): (Wish, String)| match wish {
        Wish::Tolerance if deviation.is_some() => format!("--deviation: twice it over the length is {why}"),
        _ => format!("{}: {why}", option(wish)),
    };
    // No linkage is left where the names given are wrong: that has been said.
    let is_new = |(wish, _): &(Wish, String)| *wish != Wish::Kinds || wrong.is_empty();
    let objections: Vec<String> = wishes.objections().into_iter().filter(is_new).map(named).collect();
    wrong.extend(objections);
    if wrong.is_empty() { Ok(wishes) } else { Err(wrong) }
}

fn kinds(names: &[String], wrong: &mut Vec<String>) -> Vec<Kind> {
    let known = Kind::ALL.map(Kind::id);
    let mut kinds = Vec::new();
    for name in names {
        match Kind::ALL.into_iter().find(|kind| kind.id() == name.trim()) {
            Some(kind) => kinds.push(kind),
            None => wrong.push(format!("--types: there is no `{name}` here: {}", nearest_or_all(name, &known))),
        }
    }
    kinds
}

/// A finite number, or an expression without names that is one.
fn number(text: &str, example: &str) -> Result<f64, String> {
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
fn option(wish: Wish) -> &'static str {
    match wish {
        Wish::Input => "--input",
        Wish::DoublePoint => "--double-point",
        Wish::QuickReturn => "--return",
        Wish::P => "--p",
        Wish::Length => "--length",
        Wish::Tolerance => "--tolerance",
        Wish::Size => "--size",
        Wish::MuMin => "--mu-min",
        Wish::Kinds => "--types",
    }
}
