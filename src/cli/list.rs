//! `list`: the words that a manifest may use.

use clap::{Args, ValueEnum};
use coupler_curves::template::{OutputLinkTemplate, Template};
use coupler_curves::{catalogue, measure};
use coupler_drawing::page::{Layout, Theme};

use super::{Outcome, print, print_bytes, schema};

/// List the built-in linkages, measures, further columns, layouts and themes, or print the JSON Schema of a manifest.
#[derive(Debug, Args)]
pub struct Arguments {
    /// What to list [default: everything but the schema].
    #[arg(value_name = "TOPIC")]
    what: Option<Topic>,
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
    section(Topic::Linkages, "linkages", catalogue::all().iter().map(|template| linkage_rows(template)).collect());
    let width = measure::ALL.iter().map(|m| m.name.len()).max().unwrap_or(0);
    let measures = measure::ALL.iter().map(|m| {
        let unit = if m.unit.is_empty() { "-" } else { m.unit };
        format!("{:<width$} {unit:<4} {}\n", m.name, m.definition)
    });
    // A boolean with the name of its measure is in the list already.
    let booleans = measure::BOOLEANS
        .iter()
        .filter(|boolean| boolean.name != boolean.measure)
        .map(|measure::Boolean { name, measure, word }| format!("{name:<width$} -    the {measure} is {word}\n"));
    section(Topic::Measures, "measures", measures.chain(booleans).collect());
    let columns = measure::COLUMNS.iter().map(|column| format!("{:<16} {}\n", column.name, column.definition));
    section(Topic::Columns, "columns", columns.collect());
    let layouts = Layout::ALL.iter().map(|(name, description)| format!("{name:<16} {description}\n"));
    section(Topic::Layouts, "layouts", layouts.collect());
    let themes = Theme::NAMED.iter().map(|theme| format!("{:<16} {}\n", theme.name, theme.description));
    section(Topic::Themes, "themes", themes.collect());
    print(&out)?;
    Ok(Outcome::Done)
}

fn linkage_rows(template: &Template) -> String {
    let name = |joint: usize| template.joints[joint].name.as_str();
    let output = match template.output_link {
        None => String::new(),
        Some(OutputLinkTemplate::Link([from, to])) => format!("{:16} output: link {}-{}\n", "", name(from), name(to)),
        Some(OutputLinkTemplate::Slider(joint)) => format!("{:16} output: slider {}\n", "", name(joint)),
    };
    let parameters: Vec<&str> = template.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    format!(
        "{:<16} {}\n{:16} {}\n{:16} {}\n{output}",
        template.id,
        parameters.join(", "),
        "",
        template.source,
        "",
        template.legend
    )
}
