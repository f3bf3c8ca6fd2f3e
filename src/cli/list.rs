use clap::{Args, ValueEnum};
use coupler_curves::template::Template;
use coupler_curves::{catalogue, measure};
use coupler_drawing::page::{Layout, Theme};

use super::{Outcome, print, schema};

/// List the built-in linkages, the measures, the further columns, the layouts and the themes; print the schema.
#[derive(Debug, Args)]
pub struct Arguments {
    /// What to list [default: everything but the schema].
    what: Option<Topic>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Topic {
    /// The catalogue, with parameters and sources.
    Linkages,
    /// The columns of `cells.csv` and names of `where`.
    Measures,
    /// The further columns a family may ask of `points.csv`.
    Columns,
    /// The ways a page can be laid out.
    Layouts,
    /// What pages can look like.
    Themes,
    /// The JSON Schema (2020-12) of a manifest, for editors.
    Schema,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    if arguments.what == Some(Topic::Schema) {
        print(&schema::schema_json())?;
        return Ok(Outcome::Done);
    }
    let wanted = |what| arguments.what.is_none_or(|given| given == what);
    let mut out = String::new();
    let mut section = |what, title: &str, rows: String| {
        if wanted(what) {
            if arguments.what.is_none() {
                out.push_str(&format!("{}{title}\n", if out.is_empty() { "" } else { "\n" }));
            }
            out.push_str(&rows);
        }
    };
    section(Topic::Linkages, "linkages", catalogue::all().iter().map(|template| linkage_rows(template)).collect());
    let measures = measure::ALL.iter().map(|m| {
        let unit = if m.unit.is_empty() { "-" } else { m.unit };
        format!("{:<16} {unit:<4} {}\n", m.name, m.definition)
    });
    let truths = measure::BOOLEANS.iter().map(|(name, word)| format!("{name:<16} -    the class is {word}\n"));
    section(Topic::Measures, "measures", measures.chain(truths).collect());
    let columns = measure::COLUMNS.iter().map(|column| format!("{:<16} {}\n", column.name, column.definition));
    section(Topic::Columns, "columns", columns.collect());
    let layouts = Layout::ALL.iter().map(|(name, shows)| format!("{name:<16} {shows}\n"));
    section(Topic::Layouts, "layouts", layouts.collect());
    let themes = Theme::NAMED.iter().map(|theme| format!("{:<16} {}\n", theme.name, theme.description));
    section(Topic::Themes, "themes", themes.collect());
    print(&out)?;
    Ok(Outcome::Done)
}

fn linkage_rows(template: &Template) -> String {
    let parameters: Vec<&str> = template.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    format!(
        "{:<16} {}\n{:16} {}\n{:16} {}\n",
        template.id,
        parameters.join(", "),
        "",
        template.source,
        "",
        template.legend
    )
}
