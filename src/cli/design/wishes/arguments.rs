//! The arguments of `design LINKAGE`.

use std::path::PathBuf;

use crate::design::WishRequest;
use clap::{Args, ValueHint};
use coupler_find::DesignOptions;

use super::super::super::effort::EffortChoice;
use super::super::super::files;

/// The greatest `--best`.
const MAX_BEST: i64 = WishRequest::MAX_BEST as i64;

#[derive(Debug, Args)]
pub struct WishArguments {
    /// The linkage, a built-in one (coupler-atlas list linkages) or one of --manifest.
    #[arg(value_name = "LINKAGE", required = true)]
    pub(super) linkage: Option<String>,
    /// Conditions on measures and parameters, joined by `and`: "output_swing_deg == 110 +- 0.5 and mu_worst_deg >= 35". What follows == is
    /// met to a ten-thousandth of it, or to the tolerance after +-.
    #[arg(long = "where", value_name = "EXPR")]
    pub(super) condition: Option<String>,
    /// An expression of measures and parameters that is to be as great as possible; may be repeated.
    #[arg(long, value_name = "EXPR", allow_hyphen_values = true)]
    pub(super) maximize: Vec<String>,
    /// An expression that is to be as small as possible; may be repeated.
    #[arg(long, value_name = "EXPR", allow_hyphen_values = true)]
    pub(super) minimize: Vec<String>,
    /// The range of a parameter, and the step of its values if not any can be made or bought; may be repeated: --range "r = 20..60 by 1".
    /// Others range from a quarter to four times their defaults, shifts by two typical lengths to either side, angles by a turn.
    #[arg(long, value_name = "NAME=FROM..TO")]
    pub(super) range: Vec<String>,
    /// Keep a parameter at its default or at a value, which may use others; may be repeated: --fix s --fix "p = 100".
    #[arg(long, value_name = "NAME[=EXPR]")]
    pub(super) fix: Vec<String>,
    /// The greatest distance of two joints of a link, in the unit of the lengths; inf for any.
    #[arg(long, value_name = "X", default_value = "inf", allow_hyphen_values = true)]
    pub(super) max_link: String,
    /// The manifest with the linkage, if it is none of the catalogue; - for standard input.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) manifest: Option<PathBuf>,
    #[arg(
        long,
        value_name = "N",
        default_value_t = DesignOptions::default().most as u16,
        value_parser = clap::value_parser!(u16).range(1..=MAX_BEST),
        help = format!("How many designs to show at most, 1 to {MAX_BEST}")
    )]
    pub(super) best: u16,
    /// How much is tried.
    #[arg(long, value_enum, default_value_t = EffortChoice::Normal)]
    pub(super) effort: EffortChoice,
    /// A number that changes which linkages are tried.
    #[arg(long, value_name = "N", default_value_t = DesignOptions::default().seed)]
    pub(super) seed: u64,
    /// The number of threads [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) jobs: Option<u16>,
    /// Draw the designs on one plate, and write it to this file; - for standard output, in place of the text.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = files::svg_parser())]
    pub(super) svg: Option<PathBuf>,
    /// Print a manifest that renders the designs: coupler-atlas design … --toml > best.toml
    #[arg(long, conflicts_with = "json")]
    pub(super) toml: bool,
    /// Print the designs as JSON.
    #[arg(long)]
    pub(super) json: bool,
}
