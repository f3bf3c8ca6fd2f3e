//! `export`: writes curves to a file, to a folder, or to standard output.

mod destination;
mod parts;
mod selection;

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::export::{self, CompleteFamily, DEFAULT_DPI, Format, ManifestForm, Options};
use crate::manifest::Plan;
use clap::{Args, ValueHint};
use coupler_curves::exchange::{CurveName, ParameterSet, SelectedCurve, manifest_fragment};
use coupler_curves::family::{Family, MAX_SAMPLES, ParameterText, Sampling};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::Input;
use coupler_curves::problem::suggestion;
use coupler_curves::template::Template;
use coupler_drawing::curve_file::FileOptions;
use coupler_drawing::page;
use coupler_drawing::plate::PAPER;
use coupler_drawing::render::TextMode;

use super::files::DEFAULT_MANIFEST;
use super::linkage::{self, DEFAULT_SAMPLES};
use super::source;
use super::{Failure, Outcome, choice, files, print, print_stderr, printable};
use coupler_curves::parts::GivenSizes;
use coupler_curves::text::pluralize;
use destination::Destination;
use parts::PartArguments;
use selection::CurveSelection;

/// Export curves as drawings, still or moving, CAD drawings, tables, JSON, or a fragment of a manifest.
///
/// A curve is named FAMILY:CELL.TRACE.CIRCUIT, as in evans:3.1.1, by its numbers in points.csv; FAMILY:CELL names
/// every curve of a cell, and FAMILY every curve of a family. Without a name, every curve of the manifest is exported.
/// Parameters can be replaced: "evans:3.1.1?p=2.5&k=2". A single file is written to standard output unless --output is
/// given; several need a folder. docs/export.md describes the formats.
#[derive(Debug, Args)]
pub struct Arguments {
    #[arg(value_name = "MANIFEST|CURVE", help = words_help())]
    words: Vec<String>,
    /// The formats to export: svg, moving-svg, png, pdf (a page), dxf (AutoCAD R12), csv, json, toml (one fragment of a manifest for
    /// all curves), pmks (the address by which PMKS+ opens the linkage).
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', default_value = "svg", value_parser = parse_format)]
    format: Vec<Format>,
    /// What the manifest of toml says of linkages: families names them and has the values of their parameters, for a manifest
    /// that has them; joints and drawing make a manifest by itself, with the linkages in numbers, joint by joint or by
    /// their drawing.
    #[arg(long, value_name = "FORM", default_value = "families", value_parser = parse_form)]
    form: ManifestForm,
    /// The file to write, or the folder if there are several files; - for standard output.
    #[arg(short, long, value_name = "PATH", value_hint = ValueHint::AnyPath)]
    output: Option<PathBuf>,
    /// Export only curves of this family; may be given more than once.
    #[arg(long, value_name = "FAMILY", conflicts_with = "linkage")]
    only: Vec<String>,
    /// Export the curves of a single linkage from the catalogue, or from the manifest given with --manifest.
    #[arg(long, value_name = "LINKAGE")]
    linkage: Option<String>,
    /// A manifest whose linkages --linkage can name; - for standard input.
    #[arg(long, value_name = "FILE", requires = "linkage", value_hint = ValueHint::FilePath)]
    manifest: Option<PathBuf>,
    /// With --linkage, the input between samples, in degrees unless a unit is stated, or as a length.
    #[arg(long, value_name = "STEP", requires = "linkage", conflicts_with = "samples")]
    step: Option<String>,
    #[arg(
        long,
        value_name = "N",
        requires = "linkage",
        value_parser = clap::value_parser!(u32).range(2..=MAX_SAMPLES as i64),
        help = format!("With --linkage, the number of samples of a circuit [default: {DEFAULT_SAMPLES}]")
    )]
    samples: Option<u32>,
    /// The greatest distance of a chord of a DXF polyline from the curve, relative to the curve's extent.
    #[arg(long, value_name = "X", default_value_t = FileOptions::DEFAULT_CHORD_TOLERANCE, value_parser = parse_chord)]
    chord: f64,
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(10..=2400),
        help = format!("The resolution of PNG images, in pixels per inch [default: the manifest's, or {DEFAULT_DPI}]")
    )]
    dpi: Option<u32>,
    #[command(flatten)]
    parts: PartArguments,
}

/// The chord tolerances that `--chord` accepts.
const CHORD_RANGE: RangeInclusive<f64> = 1e-9..=0.1;

/// The least input between samples: with a smaller one, a full turn has too many samples.
const MIN_STEP: f64 = 360.0 / MAX_SAMPLES as f64;

fn words_help() -> String {
    format!(
        "The manifest, if the first word ends in .toml, or is - for standard input [default: {DEFAULT_MANIFEST}], followed \
         by the names of curves; \
         with --linkage, parameters as NAME=VALUE and curves as TRACE.CIRCUIT [default: all curves]"
    )
}

fn parse_format(name: &str) -> Result<Format, String> {
    let format = choice::parse("format", name, &Format::ALL.map(|format| (format.name(), format)))?;
    let refused = || "this build cannot write PDF: build the program with the feature `pdf`".to_owned();
    if format.is_built_in() { Ok(format) } else { Err(refused()) }
}

fn parse_form(name: &str) -> Result<ManifestForm, String> {
    choice::parse("form", name, &ManifestForm::ALL.map(|form| (form.name(), form)))
}

fn parse_chord(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number, as in --chord 1e-4".to_owned())?;
    let error = || {
        let (least, greatest) = (CHORD_RANGE.start(), CHORD_RANGE.end());
        format!("expected a number from {least:e} to {greatest}, as in --chord 1e-4")
    };
    CHORD_RANGE.contains(&value).then_some(value).ok_or_else(error)
}

fn parse_step(text: &str, template: &Template) -> Result<f64, String> {
    let step = crate::inspect::parse_input(text, template.is_driven_by_length(), "--step 2")?;
    let is_valid = step.is_finite() && step >= MIN_STEP;
    is_valid.then_some(step).ok_or_else(|| format!("`{text}`: give a number of at least {MIN_STEP}, as in --step 2"))
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments.form != ManifestForm::Families && !arguments.format.contains(&Format::TOML) {
        let message = format!("--form {} is for manifests: add --format toml", arguments.form.name());
        return Err(Failure::input(message));
    }
    let (selections, plan) = match &arguments.linkage {
        Some(id) => (vec![select_from_linkage(id, arguments)?], None),
        None => {
            let (selections, plan) = select_from_manifest(arguments)?;
            (selections, Some(plan))
        }
    };
    let curves = count_curves(&selections)?;
    let sizes = arguments.parts.sizes(&arguments.format)?;
    let documents = sizes.map_or(Ok(curves), |sizes| parts::count_files(&selections, sizes))?;
    let mut formats = arguments.format.clone();
    formats.sort_unstable();
    formats.dedup();
    let files = documents * formats.iter().filter(|format| **format != Format::TOML).count()
        + usize::from(formats.contains(&Format::TOML));
    let options = export_options(arguments, plan.as_ref());
    let mut destination = Destination::from_path(arguments.output.as_deref(), files)?;
    let form = formats.contains(&Format::TOML).then_some(arguments.form);
    let (mut cases, mut families) = (Vec::new(), Vec::new());
    for selection in &selections {
        let manifest = (&mut cases, &mut families);
        export_selection(selection, (&formats, form, sizes, &options), &mut destination, manifest)?;
    }
    if let Some(form) = form {
        let text = match form {
            ManifestForm::Families => manifest_fragment(&cases),
            ManifestForm::Joints | ManifestForm::Drawing => export::complete_manifest(&families),
        };
        destination.write_file("curves.toml", text.as_bytes())?;
    }
    if let Destination::Folder(folder) = destination {
        print(&format!("{} written to {}\n", pluralize(files, "file"), printable(folder.display())))?;
    }
    Ok(Outcome::Done)
}

/// Selects the curves of a single linkage.
///
/// # Errors
/// Every error in the parameters and curves on the command line.
fn select_from_linkage(id: &str, arguments: &Arguments) -> Result<CurveSelection, Failure> {
    let template = linkage::find_template(id, arguments.manifest.as_deref())?;
    let mut problems = Vec::new();
    let (mut given, mut curves) = (Vec::new(), Vec::new());
    for word in &arguments.words {
        match (CurveName::parse_curve_numbers(word), ParameterText::parse(word)) {
            (Some(curve), _) => curves.push(curve),
            (None, Ok(parameter)) => match parameter.resolve(&template) {
                Ok(parameter) => given.push(parameter),
                Err(error) => problems.push(format!("{id}: {error}")),
            },
            (None, Err(error)) => problems.push(error.to_string()),
        }
    }
    let step = arguments.step.as_deref().map(|text| parse_step(text, &template));
    let sampling = match step.transpose() {
        Ok(Some(step)) => Sampling::Step(step),
        Ok(None) => Sampling::Samples(arguments.samples.unwrap_or(DEFAULT_SAMPLES) as usize),
        Err(error) => {
            problems.push(error);
            Sampling::Samples(DEFAULT_SAMPLES as usize)
        }
    };
    let source = template.source_line();
    match Family::single_cell(Arc::clone(&template), &given, sampling) {
        Err(errors) => problems.extend(linkage::parameter_errors(&template, &errors)),
        Ok(family) if problems.is_empty() => {
            let mut selection = CurveSelection::empty(family, source);
            let name = |curve| CurveName { family: id.to_owned(), cell: Some(1), curve, overrides: Vec::new() };
            let names: Vec<CurveName> = match curves.len() {
                0 => vec![name(None)],
                _ => curves.into_iter().map(|curve| name(Some(curve))).collect(),
            };
            names.iter().try_for_each(|name| selection.add(name)).map_err(Failure::input)?;
            return Ok(selection);
        }
        Ok(_) => {}
    }
    Err(Failure::inputs(&problems))
}

/// Selects the named curves of a manifest, and returns its plan.
///
/// # Errors
/// The manifest cannot be read, or every error in the names.
fn select_from_manifest(arguments: &Arguments) -> Result<(Vec<CurveSelection>, Plan), Failure> {
    let is_manifest = |word: &str| files::is_standard(Path::new(word)) || word.to_lowercase().ends_with(".toml");
    let (path, words) = match arguments.words.split_first() {
        Some((first, rest)) if is_manifest(first) => (Path::new(first), rest),
        _ => (Path::new(DEFAULT_MANIFEST), &arguments.words[..]),
    };
    let source = source::read(path)?;
    source.require_families(&arguments.only)?;
    if arguments.format.iter().any(|format| [Format::Png, Format::Pdf].contains(format)) {
        source.require_drawable()?;
    }
    Ok((select_curves(&source.plan, &arguments.only, words)?, source.plan))
}

/// The samples of a curve.
pub(super) struct CurveSamples {
    pub points: Vec<Point>,
    /// The input of each in degrees; `None` if an actuator drives the linkage.
    pub inputs_deg: Option<Vec<f64>>,
    pub is_closed: bool,
}

/// The samples of a named curve of a manifest.
///
/// # Errors
/// The manifest cannot be read, there is no such curve, or the name is that of several.
pub(super) fn curve_points(manifest: &Path, name: &str) -> Result<CurveSamples, Failure> {
    let source = source::read(manifest)?;
    let selections = select_curves(&source.plan, &[], &[name.to_owned()])?;
    let count = count_curves(&selections)?;
    let [selection] = &selections[..] else { return Err(Failure::input(format!("there is no curve {name}"))) };
    if count > 1 {
        let message = format!("{name} has {count} curves: name one, as FAMILY:CELL.TRACE.CIRCUIT");
        return Err(Failure::input(message));
    }
    let points = |solved| {
        let solved = selection.retain_selected(solved);
        let curve = solved.curves.first()?;
        let circuit = solved.circuit(curve);
        let inputs_deg = (solved.linkage.input() != Input::Length).then(|| circuit.inputs.clone());
        Some(CurveSamples { points: circuit.points(curve.joint).collect(), inputs_deg, is_closed: circuit.is_closed })
    };
    let mut found = None;
    selection.solve_cells(false, points, |curve| {
        found = found.take().or(curve);
        Ok::<(), Failure>(())
    })?;
    found.ok_or_else(|| Failure::input(format!("there is no curve {name}")))
}

/// Selects the named curves of a plan, of some of its families or of all; without names, all of their curves.
///
/// # Errors
/// Every error in the names.
fn select_curves(plan: &Plan, only: &[String], words: &[String]) -> Result<Vec<CurveSelection>, Failure> {
    let is_requested = |id: &str| only.is_empty() || only.iter().any(|only| only == id);
    let planned: Vec<_> = plan.families.iter().filter(|planned| is_requested(&planned.family.id)).collect();
    let ids: Vec<&str> = planned.iter().map(|planned| planned.family.id.as_str()).collect();
    let mut problems = Vec::new();
    let mut selections: Vec<CurveSelection> = Vec::new();
    for word in words {
        let name = match CurveName::parse(word) {
            Ok(name) => name,
            Err(error) => {
                problems.push(error.to_string());
                continue;
            }
        };
        let Some(planned) = planned.iter().find(|planned| planned.family.id == name.family) else {
            let help = suggestion(&name.family, &ids);
            problems.push(format!("`{word}`: there is no family `{}`: {help}", name.family));
            continue;
        };
        let (family, source) = (&planned.family, &planned.source);
        if name.overrides.is_empty() {
            let is_same_family =
                |selection: &CurveSelection| selection.overrides.is_empty() && selection.family.id == family.id;
            let index = selections.iter().position(is_same_family).unwrap_or_else(|| {
                selections.push(CurveSelection::empty(family.clone(), source.clone()));
                selections.len() - 1
            });
            problems.extend(selections[index].add(&name).err().map(|error| error.to_string()));
        } else {
            match CurveSelection::with_overrides(family, source, &name) {
                Ok(selection) => selections.push(selection),
                Err(errors) => problems.extend(errors),
            }
        }
    }
    if words.is_empty() {
        selections
            .extend(planned.iter().map(|planned| CurveSelection::all(planned.family.clone(), planned.source.clone())));
    }
    if problems.is_empty() { Ok(selections) } else { Err(Failure::inputs(&problems)) }
}

/// The number of selected curves.
///
/// # Errors
/// Every named curve that does not exist; no curve at all.
fn count_curves(selections: &[CurveSelection]) -> Result<usize, Failure> {
    let mut curves = 0;
    let mut problems = Vec::new();
    for selection in selections {
        let inspect = |solved| {
            let missing = selection.missing_curves(&solved);
            let unassembled = (!solved.motion.is_assembled() && !solved.is_left_out())
                .then(|| format!("{}:{}", selection.family.id, solved.cell.number));
            (missing, selection.retain_selected(solved).curves.len(), unassembled)
        };
        let mut not_assembled = Vec::new();
        selection.solve_cells(false, inspect, |(missing, curve_count, unassembled)| {
            curves += curve_count;
            if missing.is_empty() {
                not_assembled.extend(unassembled);
            }
            problems.extend(missing);
            Ok::<(), Failure>(())
        })?;
        if let [first, rest @ ..] = &not_assembled[..] {
            let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
            print_stderr(&format!("warning: {first}{more}: not assembled, and has no curve\n"));
        }
    }
    if problems.is_empty() && curves == 0 {
        problems.push("there is no curve to export: see cells.csv for the reasons".to_owned());
    }
    if problems.is_empty() { Ok(curves) } else { Err(Failure::inputs(&problems)) }
}

fn export_options(arguments: &Arguments, plan: Option<&Plan>) -> Options {
    let page = match plan {
        Some(plan) => plan.page.clone().with_paper(PAPER),
        None => page::Options::for_paper(PAPER),
    };
    let dpi = arguments.dpi.map(f64::from).or(plan.map(|plan| plan.dpi)).unwrap_or(f64::from(DEFAULT_DPI));
    let text_mode = plan.map_or(TextMode::Text, |plan| plan.text_mode);
    Options { file: FileOptions { page, text_mode, chord_tolerance: arguments.chord }, dpi }
}

/// Writes the files of a selection, and appends its cells to what the manifest has of them.
fn export_selection<'a>(
    selection: &'a CurveSelection,
    (formats, form, sizes, options): (&[Format], Option<ManifestForm>, Option<GivenSizes>, &Options),
    destination: &mut Destination,
    (cases, families): (&mut Vec<ParameterSet<'a>>, &mut Vec<CompleteFamily>),
) -> Result<(), Failure> {
    let curve_formats = || formats.iter().filter(|format| **format != Format::TOML);
    let export_cell = |solved| {
        let curves = selection.selected_curves(solved);
        let pairs = curves.iter().flat_map(|curve| curve_formats().map(move |&format| (curve, format)));
        let of_curve = |(curve, format): (&SelectedCurve, Format)| match sizes {
            Some(sizes) => parts::files(curve, format, (sizes, options.file.chord_tolerance)),
            None => {
                let file = format.file_name(curve);
                let bytes = export::bytes(curve, format, options).map_err(|error| export_error(&file, &error))?;
                Ok(vec![(file, bytes)])
            }
        };
        let files: Vec<Result<Vec<_>, Failure>> = pairs.map(of_curve).collect();
        let complete = form.map_or(Ok(Vec::new()), |form| {
            let name = curves.first().map(SelectedCurve::name).unwrap_or_default();
            export::complete_families(&curves, form).map_err(|error| format!("{name}: {error}"))
        });
        (files, complete, curves.iter().map(ParameterSet::from_curve).collect::<Vec<_>>())
    };
    selection.solve_cells(true, export_cell, |(files, complete, cell_cases)| {
        cases.extend(cell_cases);
        families.extend(complete.map_err(Failure::input)?);
        for files in files {
            files?.iter().try_for_each(|(file, bytes)| destination.write_file(file, bytes))?;
        }
        Ok(())
    })
}

/// Why a file cannot be exported, with the remedy.
fn export_error(file: &str, error: &export::Error) -> Failure {
    let remedy = match error {
        export::Error::Png(_) => "; give a smaller --dpi",
        export::Error::Pdf(_) | export::Error::Pmks(_) => "",
    };
    Failure::input(format!("{file}: {error}{remedy}"))
}
