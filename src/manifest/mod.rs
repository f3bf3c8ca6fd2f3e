//! TOML text -> a validated [`Plan`], or every problem in it.

mod chart;
mod family;
mod format_version;
mod grid;
mod inputs;
mod names;
mod schema;
mod settings;
mod theme;
mod tolerance;

pub use format_version::FORMAT_VERSION;
pub use inputs::ManifestInputs;
pub use schema::MANIFEST;
pub use tolerance::{PartialTolerances, Tolerances};

pub use coupler_curves::linkage_format::{KeySchema, TableSchema, ValueSchema};

use std::sync::Arc;

use coupler_curves::catalogue;
use coupler_curves::family::Family;
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::Template;
use coupler_drawing::chart::Chart;
use coupler_drawing::page;
use coupler_drawing::render::{Format, TextMode};

/// All that is to be done.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The atlas's title.
    pub title: String,
    /// The folder results go to, as the manifest gives it.
    pub output: String,
    /// How many pages go into a volume of the book.
    pub volume_pages: usize,
    /// What all pages have in common.
    pub page: page::Options,
    /// The resolution of PNG images, in pixels to the inch.
    pub dpi: f64,
    /// How text stands in SVG.
    pub text_mode: TextMode,
    /// The families, in order.
    pub families: Vec<PlannedFamily>,
}

/// A family and how it is rendered.
#[derive(Clone, Debug)]
pub struct PlannedFamily {
    /// The family.
    pub family: Family,
    /// How pages are laid out.
    pub layout: page::Layout,
    /// What its charts show, where it is laid out as charts.
    pub chart: Option<Chart>,
    /// The formats of its pages.
    pub formats: Vec<Format>,
    /// What stands under the title of its pages.
    pub source: String,
    /// What its files are made from.
    pub manifest_inputs: ManifestInputs,
    /// By how much it may differ from a recorded atlas.
    pub tolerances: PartialTolerances,
    /// Where its table stands in the manifest.
    pub span: Span,
    /// Where its `where` stands in the manifest.
    pub filter_span: Option<Span>,
}

/// What a manifest comes to.
#[derive(Clone, Debug)]
pub struct ParseOutcome {
    /// The plan, where no problem is an error.
    pub plan: Option<Plan>,
    /// What is wrong with the manifest.
    pub problems: Vec<Problem>,
}

/// Reads a manifest.
pub fn parse(text: &str) -> ParseOutcome {
    let mut reader = TomlParser::new(text);
    let plan = read_plan(text, &mut reader);
    let problems = reader.into_problems();
    let plan = plan.filter(|_| !problems.iter().any(Problem::is_error));
    ParseOutcome { plan, problems }
}

/// The linkages of a manifest's own, whatever else it has.
pub fn parse_linkages(text: &str) -> (Vec<Arc<Template>>, Vec<Problem>) {
    let mut reader = TomlParser::new(text);
    let document = reader.parse_document();
    let root = Fields::with_any_keys(&document, "a manifest", &mut reader)
        .filter(|_| format_version::is_supported(&document, &mut reader));
    let templates = match root {
        Some(root) => Templates::read(&root, &mut reader).manifest_templates,
        None => Vec::new(),
    };
    (templates, reader.into_problems())
}

fn read_plan(text: &str, reader: &mut TomlParser) -> Option<Plan> {
    let document = reader.parse_document();
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        let help = "`coupler-atlas init` writes one to start from";
        reader.report(Problem::error(0..0, "the manifest is empty").with_help(help));
        return None;
    }
    if !format_version::is_supported(&document, reader) {
        return None;
    }
    let root = Fields::from_value(&document, &MANIFEST, reader)?;
    let atlas = match root.get("atlas") {
        Some(value) => settings::atlas(value, reader),
        None => {
            let problem = Problem::error(0..first_line_len(text), "the manifest has no [atlas]");
            reader.report(problem.with_help("add a table [atlas] with title = \"…\""));
            None
        }
    };
    let page = settings::page(root.get("page"), reader);
    let tolerances = tolerance::read(root.get("check"), &tolerance::CHECK, reader);
    let templates = Templates::read(&root, reader);
    let formats = atlas.as_ref().map_or_else(|| vec![Format::Svg], |atlas| atlas.formats.clone());
    let tables = root.tables("family", reader);
    if tables.is_empty() && root.get("family").is_none_or(|value| value.get_ref().is_array()) {
        let problem = Problem::error(0..first_line_len(text), "the manifest has no family");
        reader.report(problem.with_help("add a table [[family]] with id, linkage, sampling, and grid or cases"));
    }
    let mut families: Vec<PlannedFamily> = Vec::new();
    let mut ids: Vec<String> = Vec::new();
    for value in tables {
        let options = page.as_ref().map(|page| &page.options);
        let read = family::read(value, &templates, (&formats, options), reader);
        if let Some((id, span)) = family::id_and_span(value) {
            if ids.contains(&id) {
                let problem = Problem::error(span, format!("there are two families `{id}`"));
                reader.report(problem.with_help("an id names the family's folder: give each family its own"));
            }
            ids.push(id);
        }
        let tolerances = |own: PartialTolerances| own.or(tolerances);
        families.extend(read.map(|read| PlannedFamily {
            manifest_inputs: ManifestInputs::from_manifest(&root, value),
            tolerances: tolerances(read.tolerances),
            ..read
        }));
    }
    let (atlas, page) = (atlas?, page?);
    Some(Plan {
        title: atlas.title,
        output: atlas.output,
        volume_pages: atlas.volume_pages,
        page: page.options,
        dpi: page.dpi,
        text_mode: page.text_mode,
        families,
    })
}

fn first_line_len(text: &str) -> usize {
    text.find('\n').unwrap_or(text.len())
}

/// The linkages a family may name: those of the catalogue and those of the manifest.
struct Templates {
    manifest_templates: Vec<Arc<Template>>,
    /// The ids of the manifest's linkages, also of those that could not be read.
    ids: Vec<String>,
}

impl Templates {
    fn read<'t>(root: &Fields<'_, 't>, reader: &mut TomlParser<'t>) -> Templates {
        let mut templates = Templates { manifest_templates: Vec::new(), ids: Vec::new() };
        for value in root.tables("linkage", reader) {
            let read = linkage_format::parse_template(value, reader);
            if let Some((id, span)) = family::id_and_span(value) {
                let taken = if catalogue::find(&id).is_some() {
                    Some(format!("the catalogue has a linkage `{id}` already"))
                } else if templates.ids.contains(&id) {
                    Some(format!("there are two linkages `{id}`"))
                } else {
                    None
                };
                templates.ids.push(id);
                if let Some(message) = taken {
                    reader.report(Problem::error(span, message).with_help("give it an id of its own"));
                    continue;
                }
            }
            templates.manifest_templates.extend(read.map(Arc::new));
        }
        templates
    }

    /// The linkage a value names. A linkage that could not be read has been complained of already.
    fn find<'t>(&self, value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Arc<Template>> {
        let id = reader.text(value)?;
        let own = self.manifest_templates.iter().find(|template| template.id == id).cloned();
        // A linkage of the manifest's that could not be read is not replaced by one of the catalogue of its name.
        let found = own.or_else(|| catalogue::find(&id).filter(|_| !self.ids.contains(&id)));
        if found.is_none() && !self.ids.contains(&id) {
            let built_in = catalogue::all().iter().map(|template| template.id.as_str());
            let known: Vec<&str> = self.ids.iter().map(String::as_str).chain(built_in).collect();
            let problem = Problem::error(value.span(), format!("there is no linkage `{}`", id.escape_debug()));
            reader.report(problem.with_help(coupler_curves::problem::suggestion(&id, &known)));
        }
        found
    }
}
