//! Curves taken away: to a file, to a folder, or to standard output.

mod moved_point;
mod selection;
mod selector;

use std::path::{Path, PathBuf};

use clap::Args;
use coupler_atlas::export::{self, Format, Options};
use coupler_atlas::manifest::Plan;
use coupler_atlas::output;
use coupler_curves::exchange::{ParameterSet, SelectedCurve, manifest_fragment};
use coupler_curves::family::{Family, Sampling};
use coupler_curves::problem::suggestion;
use coupler_drawing::page;
use coupler_drawing::render::TextMode;

use super::{InputError, Outcome, linkage, pluralize, print, print_bytes, print_stderr, source};
use selection::CurveSelection;
use selector::CurveSelector;

/// Take curves away: as drawings, still or moving, for CAD, as tables, as JSON, or as a piece of a manifest.
///
/// A curve is named FAMILY:CELL.TRACE.CIRCUIT, as in evans:12.1.1, by the numbers it has in points.csv; FAMILY:CELL is every
/// curve of a cell, FAMILY every curve of a family, and no name at all every curve of the manifest. Parameters may be
/// changed: "evans:12.1.1?p=2.5&k=2". One result goes to standard output if no file is given, several need a folder.
/// docs/export.md describes the formats.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest, if the first word ends in .toml [default: atlas.toml], and names of curves; with --linkage, parameters
    /// as NAME=VALUE, and curves as TRACE.CIRCUIT, all if there are none.
    #[arg(value_name = "MANIFEST|CURVE")]
    words: Vec<String>,
    /// What to make: svg, moving-svg, png, dxf (AutoCAD R12), csv, json, toml (a [[family]] of all together).
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', default_value = "svg", value_parser = parse_format)]
    format: Vec<Format>,
    /// The file to write, or of several the folder, relative to the current folder.
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Take the curves of this family only; may be given more than once.
    #[arg(long, value_name = "FAMILY", conflicts_with = "linkage")]
    only: Vec<String>,
    /// Take the curves of one linkage: of the catalogue, or of the manifest given.
    #[arg(long, value_name = "LINKAGE")]
    linkage: Option<String>,
    /// A manifest whose own linkages can be named.
    #[arg(long, value_name = "FILE", requires = "linkage")]
    manifest: Option<PathBuf>,
    /// Of a linkage, a sample at every multiple of so much input, in degrees or as a length.
    #[arg(long, value_name = "STEP", requires = "linkage", conflicts_with = "samples", value_parser = parse_step)]
    step: Option<f64>,
    /// Of a linkage, so many samples to a circuit [default: 360].
    #[arg(long, value_name = "N", requires = "linkage", value_parser = clap::value_parser!(u32).range(2..=100_000))]
    samples: Option<u32>,
    /// How far a chord of a DXF polyline may be from the curve, in parts of the curve's extent.
    #[arg(long, value_name = "X", default_value_t = Options::DEFAULT_CHORD_TOLERANCE, value_parser = parse_chord)]
    chord: f64,
    /// Pixels to the inch of PNG images [default: the manifest's, or 150].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(10..=2400))]
    dpi: Option<u32>,
}

fn parse_format(name: &str) -> Result<Format, String> {
    let known = Format::ALL.map(Format::name);
    Format::ALL
        .into_iter()
        .find(|format| format.name() == name)
        .ok_or_else(|| format!("there is no format `{name}`: {}", suggestion(name, &known)))
}

fn parse_chord(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "it is no number; give one like 1e-4".to_owned())?;
    let is_good = (1e-9..=0.1).contains(&value);
    is_good.then_some(value).ok_or_else(|| "give a number from 1e-9 to 0.1, as in --chord 1e-4".to_owned())
}

fn parse_step(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "it is no number; give one like 2".to_owned())?;
    // A shorter one makes more samples of a turn than there may be.
    let is_good = value.is_finite() && value >= 0.0036;
    is_good.then_some(value).ok_or_else(|| "give a number from 0.0036, as in --step 2".to_owned())
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let (choices, plan) = match &arguments.linkage {
        Some(id) => (vec![select_from_linkage(id, arguments)?], None),
        None => {
            let (choices, plan) = select_from_manifest(arguments)?;
            (choices, Some(plan))
        }
    };
    let curves = count_curves(&choices)?;
    let mut formats = arguments.format.clone();
    formats.sort_unstable();
    formats.dedup();
    let files = curves * formats.iter().filter(|format| **format != Format::Toml).count()
        + usize::from(formats.contains(&Format::Toml));
    let options = export_options(arguments, plan.as_ref());
    let mut destination = Destination::from_path(arguments.output.as_deref(), files)?;
    let mut cases = Vec::new();
    for choice in &choices {
        export_selection(choice, (&formats, &options), &mut destination, &mut cases)?;
    }
    if formats.contains(&Format::Toml) {
        destination.write_file("curves.toml", manifest_fragment(&cases).as_bytes())?;
    }
    if let Destination::Folder(folder) = destination {
        print(&format!("{} written to {}\n", pluralize(files, "file"), folder.display()))?;
    }
    Ok(Outcome::Done)
}

/// Several problems at once.
fn problems_error(problems: &[String]) -> anyhow::Error {
    InputError(problems.join("\nerror: ")).into()
}

/// The curves of one linkage.
fn select_from_linkage(id: &str, arguments: &Arguments) -> anyhow::Result<CurveSelection> {
    let template = linkage::find_template(id, arguments.manifest.as_deref())?;
    let mut problems = Vec::new();
    let (mut given, mut curves) = (Vec::new(), Vec::new());
    for word in &arguments.words {
        match (CurveSelector::parse_curve_numbers(word), linkage::parse_parameter(word)) {
            (Some(curve), _) => curves.push(curve),
            (None, Ok(parameter)) => given.push(parameter),
            (None, Err(why)) => problems.push(why.to_string()),
        }
    }
    let sampling = match (arguments.step, arguments.samples) {
        (Some(step), _) => Sampling::Step(step),
        (None, samples) => Sampling::Samples(samples.unwrap_or(360) as usize),
    };
    let legend = [&template.source, &template.legend].map(String::as_str);
    let source: Vec<&str> = legend.into_iter().filter(|part| !part.is_empty()).collect();
    let source = source.join(" · ");
    match Family::single_cell(template, &given, sampling) {
        Err(objections) => problems.extend(objections.into_iter().map(|objection| format!("{id}: {objection}"))),
        Ok(family) if problems.is_empty() => {
            let mut choice = CurveSelection::empty(family, source);
            let name = |curve| CurveSelector { family: id.to_owned(), cell: Some(1), curve, overrides: Vec::new() };
            let names: Vec<CurveSelector> = match curves.len() {
                0 => vec![name(None)],
                _ => curves.into_iter().map(|curve| name(Some(curve))).collect(),
            };
            names.iter().try_for_each(|name| choice.add(name)).map_err(InputError)?;
            return Ok(choice);
        }
        Ok(_) => {}
    }
    Err(problems_error(&problems))
}

/// The curves that are named of a manifest, and its plan.
fn select_from_manifest(arguments: &Arguments) -> anyhow::Result<(Vec<CurveSelection>, Plan)> {
    let (path, words) = match arguments.words.split_first() {
        Some((first, rest)) if first.to_lowercase().ends_with(".toml") => (Path::new(first), rest),
        _ => (Path::new("atlas.toml"), &arguments.words[..]),
    };
    let source = source::read(path)?;
    source.require_families(&arguments.only)?;
    let is_asked = |id: &str| arguments.only.is_empty() || arguments.only.iter().any(|only| only == id);
    let planned: Vec<_> = source.plan.families.iter().filter(|planned| is_asked(&planned.family.id)).collect();
    let ids: Vec<&str> = planned.iter().map(|planned| planned.family.id.as_str()).collect();
    let mut problems = Vec::new();
    let mut choices: Vec<CurveSelection> = Vec::new();
    for word in words {
        let name = match CurveSelector::parse(word) {
            Ok(name) => name,
            Err(why) => {
                problems.push(why);
                continue;
            }
        };
        let Some(planned) = planned.iter().find(|planned| planned.family.id == name.family) else {
            let remedy = suggestion(&name.family, &ids);
            problems.push(format!("`{word}`: there is no family `{}`: {remedy}", name.family));
            continue;
        };
        let (family, source) = (&planned.family, &planned.source);
        if name.overrides.is_empty() {
            let is_its = |choice: &CurveSelection| choice.overrides.is_empty() && choice.family.id == family.id;
            let at = choices.iter().position(is_its).unwrap_or_else(|| {
                choices.push(CurveSelection::empty(family.clone(), source.clone()));
                choices.len() - 1
            });
            problems.extend(choices[at].add(&name).err());
        } else {
            match CurveSelection::with_overrides(family, source, &name) {
                Ok(choice) => choices.push(choice),
                Err(objections) => problems.extend(objections),
            }
        }
    }
    if words.is_empty() {
        choices
            .extend(planned.iter().map(|planned| CurveSelection::all(planned.family.clone(), planned.source.clone())));
    }
    if problems.is_empty() { Ok((choices, source.plan)) } else { Err(problems_error(&problems)) }
}

/// How many curves are wanted; what is not there is said, all of it.
fn count_curves(choices: &[CurveSelection]) -> anyhow::Result<usize> {
    let mut curves = 0;
    let mut problems = Vec::new();
    for choice in choices {
        let look = |solved| {
            let missing = choice.missing_curves(&solved);
            let shortfall = (!solved.motion.is_assembled() && !solved.is_left_out())
                .then(|| format!("{}:{}", choice.family.id, solved.cell.number));
            (missing, choice.retain_selected(solved).curves.len(), shortfall)
        };
        let mut not_assembled = Vec::new();
        choice.solve_cells(false, look, |(missing, found, shortfall)| {
            curves += found;
            if missing.is_empty() {
                not_assembled.extend(shortfall);
            }
            problems.extend(missing);
            Ok::<(), anyhow::Error>(())
        })?;
        if let [first, rest @ ..] = &not_assembled[..] {
            let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
            print_stderr(&format!("warning: {first}{more}: not assembled, and without a curve\n"));
        }
    }
    if problems.is_empty() && curves == 0 {
        problems.push("there is no curve in what is named: look at its cells.csv for the reasons".to_owned());
    }
    if problems.is_empty() { Ok(curves) } else { Err(problems_error(&problems)) }
}

fn export_options(arguments: &Arguments, plan: Option<&Plan>) -> Options {
    let page = match plan {
        Some(plan) => page::Options { paper: Options::PLATE_PAPER, ..plan.page.clone() },
        None => page::Options::for_paper(Options::PLATE_PAPER),
    };
    let dpi = arguments.dpi.map(f64::from).or(plan.map(|plan| plan.dpi)).unwrap_or(150.0);
    Options {
        page,
        text_mode: plan.map_or(TextMode::Text, |plan| plan.text_mode),
        dpi,
        chord_tolerance: arguments.chord,
    }
}

/// Makes the files of a choice, and gathers its cases.
fn export_selection<'a>(
    choice: &'a CurveSelection,
    (formats, options): (&[Format], &Options),
    destination: &mut Destination,
    cases: &mut Vec<ParameterSet<'a>>,
) -> anyhow::Result<()> {
    let of_each = || formats.iter().filter(|format| **format != Format::Toml);
    let make = |solved| {
        let each = SelectedCurve::all_from_cell(
            &choice.family,
            &choice.source,
            &choice.overrides,
            &choice.retain_selected(solved),
        );
        let mut files = Vec::new();
        for chosen in &each {
            for &format in of_each() {
                files.push((export::file_name(chosen, format), export::bytes(chosen, format, options)));
            }
        }
        (files, each.iter().map(ParameterSet::from_curve).collect::<Vec<_>>())
    };
    choice.solve_cells(true, make, |(files, of_cell)| {
        cases.extend(of_cell);
        for (file, bytes) in files {
            let bytes = bytes.map_err(|why| InputError(format!("{file}: {why}; give a smaller --dpi")))?;
            destination.write_file(&file, &bytes)?;
        }
        Ok(())
    })
}

/// Where results go.
enum Destination {
    Stdout,
    File(PathBuf),
    Folder(PathBuf),
}

impl Destination {
    fn from_path(given: Option<&Path>, files: usize) -> anyhow::Result<Destination> {
        let Some(path) = given else {
            let several =
                || InputError(format!("there are {files} files to write: name a folder for them with -o FOLDER"));
            return if files == 1 { Ok(Destination::Stdout) } else { Err(several().into()) };
        };
        // A file is written beside its place and renamed: what is no file, a device or a pipe, would be gone.
        if path.exists() && !path.is_file() && !path.is_dir() {
            let path = path.display();
            return Err(InputError(format!(
                "{path} is neither a file nor a folder: name one with -o, or leave -o out"
            ))
            .into());
        }
        let is_folder = path.is_dir() || path.as_os_str().to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR]);
        if files == 1 && !is_folder {
            return Ok(Destination::File(path.to_owned()));
        }
        if path.is_file() {
            let path = path.display();
            return Err(
                InputError(format!("{path} is a file, and there are {files} to write: name a folder with -o")).into()
            );
        }
        output::create_folder(path)?;
        Ok(Destination::Folder(path.to_owned()))
    }

    fn write_file(&mut self, name: &str, bytes: &[u8]) -> anyhow::Result<()> {
        match self {
            Destination::Stdout => print_bytes(bytes),
            Destination::File(path) => Ok(output::write_file(path, bytes)?),
            Destination::Folder(folder) => Ok(output::write_file(&folder.join(name), bytes)?),
        }
    }
}
