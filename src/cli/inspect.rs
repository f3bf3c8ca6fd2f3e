//! `inspect`: describes one linkage, as text, as JSON or as a drawing.

use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueHint};
use coupler_curves::family::{Family, ParameterText, Sampling};

use super::linkage::{self, DEFAULT_SAMPLES};
use super::{Failure, Outcome, files, print, print_bytes};
use crate::inspect::{Inspection, Options, parse_input};
use crate::notation::Notation;

/// Describe one linkage: its class, limits, transmission angle and straight portion; then its circuits, and the
/// positions and velocities of its joints.
///
/// Rates are per radian of input, or per unit of length of an actuator. docs/inspect.md describes the output of --json.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The linkage: one of the catalogue, or of the manifest given with --manifest.
    linkage: String,
    /// The parameters of the linkage, as numbers or expressions: p=2 "a=(1+2)^1.5/2".
    #[arg(value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    /// A manifest whose linkages can be named; - for standard input.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    manifest: Option<PathBuf>,
    /// Print the positions and derivatives of the joints at this input, in degrees unless a unit is stated, as in
    /// "0.5 rad", or as a length; a number or an expression.
    #[arg(long, value_name = "INPUT", allow_hyphen_values = true)]
    at: Option<String>,
    /// With --at, only the poses with the first two-valued joint on this side: 1 left, -1 right; those of all circuits,
    /// not only of the one through the start pose.
    #[arg(long, value_name = "N", value_parser = ["1", "-1"], requires = "at")]
    branch: Option<String>,
    /// A force on a joint, for the torque with which the input moves it: "100 on C at -90 deg", from the x-axis, or "100 on C" against the
    /// motion of C.
    #[arg(long, value_name = "LOAD", allow_hyphen_values = true)]
    load: Option<String>,
    /// Print how far the curves move where each length of the linkage is off by this much, and how far each may be off until the length of the
    /// straight portion changes in its last printed digit.
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// Print the coefficients of the equations of the coupler curves, with the crank pivot at the origin and the x axis
    /// towards the rocker pivot, and again with the origin in the middle of the two.
    #[arg(long, conflicts_with = "toml")]
    sextic: bool,
    /// Print the Roberts-Chebyshev cognates, the two other four-bars that trace the same curve; with --svg, draw them
    /// too.
    #[arg(long)]
    cognates: bool,
    /// With --cognates, the number of the traced joint that is the coupler point, from 1.
    #[arg(long, value_name = "N", default_value_t = 1, requires = "cognates")]
    trace: usize,
    /// With --cognates, print a manifest of all three linkages instead.
    #[arg(long, requires = "cognates", conflicts_with = "json")]
    toml: bool,
    /// Print the description as JSON.
    #[arg(long)]
    json: bool,
    /// Draw the linkage on one plate, at the input of --at or in its clearest pose, and write it to this file; - for
    /// standard output, in place of the text.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = files::svg_parser())]
    svg: Option<PathBuf>,
    /// With --svg, animate the linkage through its first circuit.
    #[arg(long, requires = "svg", conflicts_with = "at")]
    animate: bool,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let printed = [("--json", arguments.json), ("--toml", arguments.toml), ("--sextic", arguments.sextic)];
    let is_drawing_printed = files::is_drawing_printed(arguments.svg.as_deref(), &printed)?;
    let mut template = linkage::find_template(&arguments.linkage, arguments.manifest.as_deref())?;
    let mut options = Options {
        branch: arguments.branch.as_ref().map(|text| if text == "1" { 1 } else { -1 }),
        load: arguments.load.clone(),
        tolerance: arguments.tolerance,
        sextic: arguments.sextic,
        cognates: arguments.cognates.then_some(arguments.trace),
        ..Options::new(Notation::CommandLine)
    };
    options.apply(&mut template).map_err(Failure::input)?;
    let given = |text: &String| {
        let parameter = ParameterText::parse(text).map_err(Failure::input)?;
        parameter.resolve(&template).map_err(|error| Failure::input(format!("{}: {error}", arguments.linkage)))
    };
    let given = arguments.parameters.iter().map(given).collect::<Result<Vec<_>, _>>()?;
    let is_length = template.is_driven_by_length();
    let at = arguments.at.as_deref().map(|text| parse_input(text, is_length, "--at 30"));
    options.at = at.transpose().map_err(Failure::input)?;
    if let (Some(at), Some(text)) = (options.at.filter(|at| !at.is_finite()), &arguments.at) {
        return Err(Failure::input(format!("`{text}` is {at}: give a finite number, as in --at 30")));
    }
    let family = Family::single_cell(Arc::clone(&template), &given, Sampling::Samples(DEFAULT_SAMPLES as usize))
        .map_err(|errors| Failure::inputs(&linkage::parameter_errors(&template, &errors)))?;
    let inspection = Inspection::new(family, &options).map_err(Failure::input)?;
    if let Some(path) = &arguments.svg {
        files::write(path, &inspection.svg(arguments.animate))?;
        if is_drawing_printed {
            return Ok(Outcome::Done);
        }
    }
    match inspection.cognates_manifest() {
        Some(manifest) if arguments.toml => print_bytes(manifest.as_bytes())?,
        _ if arguments.json => print_bytes(inspection.json()?.as_bytes())?,
        _ => print(&inspection.text())?,
    }
    Ok(Outcome::Done)
}
