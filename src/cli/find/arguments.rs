//! The arguments of `find`.

use std::path::PathBuf;

use crate::find::function::FunctionFit;
use crate::find::{MAX_CURVES, Request};
use clap::{Args, ValueEnum, ValueHint};
use coupler_find::{Index, Options};

use super::super::effort::EffortChoice;
use super::super::files;

/// Find the linkages whose coupler curves are nearest to a path, with their cognates.
///
/// With --function, find the linkages that generate a function instead.
///
/// The path is a table of points (x, y on each line), JSON or a drawing in SVG or DXF, of which the longest line is read, with y
/// pointing up; - for standard input. What was read is said on standard error. Curves are compared by E, the root of the mean square of the distances of its points from the
/// continuous curve, in their order along one circuit, relative to the path's size S, the root of the mean square of their
/// distances from their centroid. docs/find.md describes the search and its limits.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The file of the path; with --function, that of the function, or the function itself.
    #[arg(value_name = "PATH", value_hint = ValueHint::FilePath, required_unless_present = "like")]
    pub(super) path: Option<PathBuf>,
    /// Take a curve of an atlas as the path, by its name, as in evans:3.1.1 or "evans:3.1.1?p=2.5".
    #[arg(long, value_name = "CURVE", conflicts_with = "path")]
    pub(super) like: Option<String>,
    /// The outline of a drawing to take, or the path of a table with several: its id, layer or name, or its number from 1.
    #[arg(long, value_name = "ID|N", conflicts_with = "like")]
    pub(super) outline: Option<String>,
    #[arg(
        long,
        value_name = "FILE",
        value_hint = ValueHint::FilePath,
        help = format!(
            "The manifest with the curve of --like, or with the linkage of --linkage; - for standard input [default of --like: {}]",
            files::DEFAULT_MANIFEST
        )
    )]
    pub(super) manifest: Option<PathBuf>,
    /// The path is closed; without these three it is if the gap between its ends is like the steps beside it, and otherwise open.
    #[arg(long, conflicts_with_all = ["open", "part"])]
    pub(super) closed: bool,
    /// The path is open: the curve passes its points in their order, whatever it does between them and elsewhere.
    #[arg(long, conflicts_with = "part")]
    pub(super) open: bool,
    /// The path is a part of the curve, and that part is as long as the path.
    #[arg(long)]
    pub(super) part: bool,
    /// The crank reaches the points at their angles, in degrees from any zero and in either direction: a third column, or one named
    /// `angle`; without angles a closed path has equal steps of a turn.
    #[arg(long)]
    pub(super) timed: bool,
    /// The file has poses of a body, x, y and its angle (angle_deg or angle_rad): find four-bars, slider-cranks and inverted ones whose coupler passes 2 to 5 of
    /// them exactly, and more as near as can be.
    #[arg(long)]
    pub(super) poses: bool,
    /// With --poses, also linkages that pass the poses in another order.
    #[arg(long, requires = "poses")]
    pub(super) any_order: bool,
    /// With --poses, also linkages that must be taken apart, or pass a limit of the crank, between poses.
    #[arg(long, requires = "poses")]
    pub(super) any_circuit: bool,
    /// Find four-bars or slider-cranks whose output is a function of their input: a table with the columns input,output in degrees, or
    /// "y = log10(x) for x = 1..10 over 60 deg of input and 90 deg of output"; of a slider-crank the output is a length.
    #[arg(
        long,
        requires = "path",
        conflicts_with_all = [
            "like", "outline", "closed", "open", "part", "timed", "pivots", "index", "atlas", "fixed", "no_refine",
        ]
    )]
    pub(super) function: bool,
    /// With --function, how: exact at precision points, or with the least error everywhere, in the mean square or the greatest [default: points
    /// for a formula and tables of few rows, and otherwise least-squares].
    #[arg(long, value_enum, requires = "function")]
    pub(super) fit: Option<FitChoice>,
    /// With --function, the number of precision points of a formula, 3 to 5, in Chebyshev's spacing [default: the most that have an answer].
    #[arg(long, value_name = "N", requires = "function")]
    pub(super) points: Option<usize>,
    /// With --function, the input at the start, in degrees from the frame, or from the slider's line.
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, requires = "function")]
    pub(super) input_start: Option<String>,
    /// With --function, the output at the start: in degrees from the frame, or the slider's distance from the foot of the crank's pivot.
    #[arg(long, value_name = "DEG|X", allow_hyphen_values = true, requires = "function")]
    pub(super) output_start: Option<String>,
    /// Whether the crank must turn fully [default: full-turn, and with --function any].
    #[arg(long, value_enum, hide_default_value = true)]
    pub(super) input: Option<InputChoice>,
    /// A condition on the linkage, as in `where` of a manifest: "is_crank_rocker and mu_worst_deg >= 30". Its names are frame, crank,
    /// coupler, rocker, along and across, the crank's pivot x and y, turn, the frame's angle, and all measures; with --linkage the
    /// parameters of that linkage and all measures.
    #[arg(long = "where", value_name = "EXPR")]
    pub(super) condition: Option<String>,
    /// The greatest distance of two joints of a link, in sizes S of the path; with --function, how many times the longest link is as long as the
    /// shortest; inf for any [default: 10, and with --function 20].
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    pub(super) max_link: Option<String>,
    /// The box in which both fixed pivots must be, in the unit of the path: XMIN,YMIN,XMAX,YMAX.
    #[arg(long, value_name = "BOX", allow_hyphen_values = true)]
    pub(super) pivots: Option<String>,
    /// With --poses of 2 or 3 poses, a fixed pivot that every linkage has: X,Y; may be given twice, for both.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, requires = "poses")]
    pub(super) pivot: Vec<String>,
    #[arg(
        long,
        value_name = "N",
        default_value_t = Options::default().most as u16,
        value_parser = clap::value_parser!(u16).range(1..=MAX_TOP),
        help = format!("How many linkages to show at most, 1 to {MAX_TOP}")
    )]
    pub(super) top: u16,
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u64).range(1..=MAX_CURVES as u64),
        help = format!(
            "How many four-bars to look the path up in, 1 to {MAX_CURVES}; the index of each number is kept in the user's cache folder \
             [default: {}]. With --linkage, the number of its parameter sets, which are not kept; of six-bar and any that of curves of six-bars, which are",
            Index::DEFAULT_COUNT
        )
    )]
    pub(super) index: Option<u64>,
    /// Look the path up in the curves of an atlas, of any linkages: its manifest, or the folder of a rendered one with the manifest beside it.
    /// Four-bars are refined, others only placed on the path.
    #[arg(long, value_name = "MANIFEST|DIR", value_hint = ValueHint::AnyPath)]
    pub(super) atlas: Option<PathBuf>,
    /// Search the dimensions of a linkage, a built-in one (coupler-atlas list linkages) or one of --manifest, in place of a four-bar; six-bar for all six-bars, any for
    /// these and simpler linkages.
    #[arg(long, value_name = "NAME", conflicts_with = "atlas")]
    pub(super) linkage: Option<String>,
    /// With --linkage, keep a parameter at its default or at a value, which may use others; may be repeated: --keep s --keep "k=2".
    #[arg(long, value_name = "NAME[=EXPR]", requires = "linkage")]
    pub(super) keep: Vec<String>,
    /// With --atlas, compare its curves where they are: position, size and rotation count.
    #[arg(long)]
    pub(super) fixed: bool,
    /// Only place the curves of the index on the path, without moving their linkages towards it.
    #[arg(long)]
    pub(super) no_refine: bool,
    /// How many linkages are tried.
    #[arg(long, value_enum, default_value_t = EffortChoice::Normal)]
    pub(super) effort: EffortChoice,
    /// A number that changes which linkages are tried near those that have been found.
    #[arg(long, value_name = "N", default_value_t = Options::default().seed)]
    pub(super) seed: u64,
    /// The number of threads for the index [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) jobs: Option<u16>,
    /// Draw the path and the curves on one page, and write it to this file; - for standard output, in place of the text.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = files::svg_parser())]
    pub(super) svg: Option<PathBuf>,
    /// Print a manifest that renders the linkages: coupler-atlas find … --toml > found.toml
    #[arg(long, conflicts_with = "json")]
    pub(super) toml: bool,
    /// Print the linkages as JSON.
    #[arg(long)]
    pub(super) json: bool,
}

/// The greatest `--top`.
const MAX_TOP: i64 = Request::MAX_TOP as i64;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum InputChoice {
    /// The crank turns fully.
    FullTurn,
    /// Any linkage.
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FitChoice {
    /// Exact at three to five precision points.
    Points,
    /// The least mean square of the error.
    LeastSquares,
    /// The least greatest error.
    Minimax,
}

impl From<FitChoice> for FunctionFit {
    fn from(choice: FitChoice) -> FunctionFit {
        match choice {
            FitChoice::Points => FunctionFit::Points,
            FitChoice::LeastSquares => FunctionFit::LeastSquares,
            FitChoice::Minimax => FunctionFit::Minimax,
        }
    }
}

impl Arguments {
    /// Whether the crank of a linkage for a path must turn fully.
    pub(super) fn input_or_default(&self) -> InputChoice {
        self.input.unwrap_or(InputChoice::FullTurn)
    }

    /// The longest link for a path.
    pub(super) fn max_link_or_default(&self) -> &str {
        self.max_link.as_deref().unwrap_or("10")
    }
}
