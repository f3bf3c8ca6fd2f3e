//! `list`: the words that a manifest may use, and the families of one.

mod linkage;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum, ValueHint};
use coupler_curves::measure::{self, Subject};
use coupler_drawing::page::{Layout, Theme};

use super::files::DEFAULT_MANIFEST;
use super::linkage::find_template;
use super::source;
use super::{Failure, Outcome, print, print_bytes, schema};

/// List the built-in linkages, measures, further columns, layouts and themes, or the families of a manifest, or print the
/// JSON Schema of manifests.
#[derive(Debug, Args)]
pub struct Arguments {
    /// What to list [default: everything built in].
    #[arg(value_name = "TOPIC")]
    what: Option<Topic>,
    #[arg(
        value_name = "LINKAGE|MANIFEST",
        value_hint = ValueHint::FilePath,
        help = format!(
            "With linkages, the one to describe: its joints, its parameters with their kinds, defaults and ranges, and a \
             family to start from; with families, the manifest, - for standard input [default: {DEFAULT_MANIFEST}]"
        )
    )]
    name: Option<PathBuf>,
    /// A manifest whose linkages LINKAGE can name; - for standard input.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "name")]
    manifest: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Topic {
    /// The linkages of the catalogue, with their parameters and sources.
    Linkages,
    /// The measures: columns of `cells.csv`, and names for `where`, `sort` and charts.
    Measures,
    /// The further columns of `points.csv` that a family may request.
    Columns,
    /// The layouts of a page.
    Layouts,
    /// The themes of a page.
    Themes,
    /// The ids of the families of a manifest, one in a line.
    Families,
    /// The JSON Schema (2020-12) of a manifest, for editors.
    Schema,
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match (arguments.what, &arguments.name) {
        (Some(Topic::Schema), None) => {
            print_bytes(schema::schema_json().as_bytes())?;
            return Ok(Outcome::Done);
        }
        (Some(Topic::Families), manifest) if arguments.manifest.is_none() => {
            let source = source::read(manifest.as_deref().unwrap_or(Path::new(DEFAULT_MANIFEST)))?;
            let ids = source.plan.families.iter().map(|planned| format!("{}\n", planned.family.id));
            print(&ids.collect::<String>())?;
            return Ok(Outcome::Done);
        }
        (Some(Topic::Linkages), Some(name)) => {
            let template = find_template(&name.to_string_lossy(), arguments.manifest.as_deref())?;
            print(&linkage::describe(&template))?;
            return Ok(Outcome::Done);
        }
        (_, Some(name)) => {
            let name = name.display();
            let message = format!(
                "nothing can be named here: write `list linkages {name}` for a linkage, or `list families {name}` for the \
                 families of a manifest"
            );
            return Err(Failure::input(message));
        }
        (_, None) => {}
    }
    let is_listed = |topic| arguments.what.is_none_or(|given| given == topic);
    let mut out = String::new();
    let mut section = |topic, title: &str, rows: String| {
        if is_listed(topic) {
            if arguments.what.is_none() {
                out.push_str(&format!("{}{title}\n", if out.is_empty() { "" } else { "\n" }));
            }
            out.push_str(&rows);
        }
    };
    section(Topic::Linkages, "linkages", linkage::catalogue_rows());
    let width = measure::ALL.iter().map(|m| m.name.len()).max().unwrap_or(0);
    let measures = measure::ALL.iter().map(|m| {
        let unit = if m.unit.is_empty() { "-" } else { m.unit };
        let of_actuators = m.length_name.map(|name| format!("; of an actuator a length, `{name}`")).unwrap_or_default();
        format!("{:<width$} {unit:<4} {}{}{of_actuators}\n", m.name, m.definition, subject(m.subject))
    });
    // A boolean with the name of its measure is in the list already.
    let booleans = measure::BOOLEANS
        .iter()
        .filter(|boolean| boolean.name != boolean.measure)
        .map(|measure::Boolean { name, measure, word }| format!("{name:<width$} -    the {measure} is {word}\n"));
    section(Topic::Measures, "measures", measures.chain(booleans).collect());
    let columns = measure::COLUMNS
        .iter()
        .map(|column| format!("{:<16} {}{}\n", column.name, column.definition, subject(column.subject)));
    section(Topic::Columns, "columns", columns.collect());
    let layouts = Layout::ALL.iter().map(|(name, description)| format!("{name:<16} {description}\n"));
    section(Topic::Layouts, "layouts", layouts.collect());
    let themes = Theme::NAMED.iter().map(|theme| format!("{:<16} {}\n", theme.name, theme.description));
    section(Topic::Themes, "themes", themes.collect());
    print(&out)?;
    Ok(Outcome::Done)
}

/// "; four-bars only", where not every linkage has it.
fn subject(subject: Subject) -> String {
    match subject {
        Subject::Any => String::new(),
        subject => format!("; {} only", subject.description()),
    }
}
