//! `list`: the words that a manifest may use.

mod linkage;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use coupler_curves::measure::{self, Subject};
use coupler_drawing::page::{Layout, Theme};

use super::linkage::find_template;
use super::{InputError, Outcome, print, print_bytes, schema};

/// List the built-in linkages, measures, further columns, layouts and themes, or print the JSON Schema of a manifest.
#[derive(Debug, Args)]
pub struct Arguments {
    /// What to list [default: everything but the schema].
    #[arg(value_name = "TOPIC")]
    what: Option<Topic>,
    /// With `linkages`, describe this linkage: its joints, its parameters with their kinds, defaults and ranges, and a
    /// family to start from.
    #[arg(value_name = "LINKAGE")]
    linkage: Option<String>,
    /// A manifest whose linkages LINKAGE can name; - for standard input.
    #[arg(long, value_name = "FILE", requires = "linkage")]
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
    /// The JSON Schema (2020-12) of a manifest, for editors.
    Schema,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    if arguments.what == Some(Topic::Schema) {
        print_bytes(schema::schema_json().as_bytes())?;
        return Ok(Outcome::Done);
    }
    if let Some(name) = &arguments.linkage {
        if arguments.what != Some(Topic::Linkages) {
            let error = format!("only a linkage can be named: `coupler-atlas list linkages {name}`");
            return Err(InputError(error).into());
        }
        let template = find_template(name, arguments.manifest.as_deref())?;
        print(&linkage::describe(&template))?;
        return Ok(Outcome::Done);
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
