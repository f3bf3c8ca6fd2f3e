//! Parses a manifest in TOML into a validated [`Plan`], or reports every problem in it.

mod bounded_number;
mod cells;
mod chart;
mod default_value;
mod family;
mod format_version;
mod grid;
mod inputs;
mod names;
mod schema;
mod settings;
mod theme;
mod tolerance;

pub use cells::MAX_PAGE_FILES;
pub use format_version::FORMAT_VERSION;
pub use inputs::ManifestInputs;
pub use schema::MANIFEST;
pub use tolerance::{PartialTolerances, Tolerances};

pub use coupler_curves::linkage_format::{KeySchema, TableSchema, ValueSchema};

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use cells::AtlasTotals;
use coupler_curves::catalogue;
use coupler_curves::family::Family;
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::problem::{Problem, Span, suggestion_among};
use coupler_curves::template::Template;
use coupler_drawing::chart::Chart;
use coupler_drawing::page;
use coupler_drawing::render::{Format, TextMode};
use inputs::SharedInputs;

/// A validated manifest: what to solve, and how to draw it.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The atlas's title.
    pub title: String,
    /// The output folder, as the manifest gives it, if it does.
    pub output: Option<String>,
    /// The most pages of a volume of the book.
    pub volume_pages: usize,
    /// The options that all pages share.
    pub page: page::Options,
    /// The resolution of PNG images, in pixels per inch.
    pub dpi: f64,
    /// How text is written in SVG.
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
    /// What its charts show; `None` unless its layout is charts.
    pub chart: Option<Chart>,
    /// The formats of its pages.
    pub formats: Vec<Format>,
    /// The line under the title of its pages.
    pub source: String,
    /// What the manifest contributes to its files.
    pub manifest_inputs: ManifestInputs,
    /// How much it may differ from a recorded atlas.
    pub tolerances: PartialTolerances,
    /// The place of its table in the manifest.
    pub span: Span,
    /// The place of its `where` in the manifest.
    pub filter_span: Option<Span>,
}

impl PlannedFamily {
    /// The most pages that the family can have, if `where` keeps all its cells.
    pub fn max_pages(&self) -> usize {
        let cells = self.family.cell_count();
        let points = self.family.template.curve_count();
        match (&self.chart, self.layout) {
            (Some(chart), layout) => chart.y.len().div_ceil(layout.cells_per_page()),
            (None, page::Layout::CouplerGrid) => {
                cells.saturating_mul(points.div_ceil(page::Layout::POINTS_PER_PAGE).max(1))
            }
            (None, layout) => cells.div_ceil(layout.cells_per_page()),
        }
    }
}

/// The result of parsing a manifest.
#[derive(Clone, Debug)]
pub struct ParseOutcome {
    /// The plan; `None` if any problem is an error.
    pub plan: Option<Plan>,
    /// The problems found, warnings among them.
    pub problems: Vec<Problem>,
}

/// The most bytes of a manifest.
pub const MAX_MANIFEST_BYTES: usize = 1 << 23;

/// The most values, tables and lists of a manifest, enough for some hundred thousand cases. While it is parsed, each takes
/// up to about 260 bytes.
const MAX_MANIFEST_VALUES: usize = 1_000_000;

/// A problem of a manifest that is too long; `None` for others.
fn length_problem(text: &str) -> Option<Problem> {
    // Each value follows one of these characters; those inside strings and comments are few.
    let values = || text.bytes().filter(|byte| matches!(byte, b'=' | b',' | b'{' | b'[')).count();
    let (count, limit, unit) = if text.len() > MAX_MANIFEST_BYTES {
        (text.len(), MAX_MANIFEST_BYTES, "bytes")
    } else {
        (values(), MAX_MANIFEST_VALUES, "values")
    };
    let message = format!("the manifest has {count} {unit}, more than the limit of {limit}");
    let problem = Problem::error(0..first_line_len(text), message);
    (count > limit).then(|| problem.with_help("divide it, or give ranges in place of lists"))
}

/// Parses a manifest.
pub fn parse(text: &str) -> ParseOutcome {
    if let Some(problem) = length_problem(text) {
        return ParseOutcome { plan: None, problems: vec![problem] };
    }
    let mut parser = TomlParser::new(text);
    let plan = read_plan(text, &mut parser);
    let problems = parser.into_problems();
    let plan = plan.filter(|_| !problems.iter().any(Problem::is_error));
    ParseOutcome { plan, problems }
}

/// Parses the `[[linkage]]` tables of a manifest, and ignores its other tables.
pub fn parse_linkages(text: &str) -> (Vec<Arc<Template>>, Vec<Problem>) {
    if let Some(problem) = length_problem(text) {
        return (Vec::new(), vec![problem]);
    }
    let mut parser = TomlParser::new(text);
    let document = parser.parse_document();
    let root = Fields::with_any_keys(&document, "a manifest", &mut parser)
        .filter(|_| format_version::is_supported(&document, &mut parser));
    let templates = match root {
        Some(root) => Templates::read(&root, &mut parser).manifest_templates,
        None => Vec::new(),
    };
    (templates, parser.into_problems())
}

fn read_plan(text: &str, parser: &mut TomlParser) -> Option<Plan> {
    let document = parser.parse_document();
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        let help = "`coupler-atlas init` writes one to start from";
        parser.report(Problem::error(0..0, "the manifest is empty").with_help(help));
        return None;
    }
    if !format_version::is_supported(&document, parser) {
        return None;
    }
    let root = Fields::from_value(&document, &MANIFEST, parser)?;
    let atlas = match root.get("atlas") {
        Some(value) => settings::atlas(value, parser),
        None => {
            let problem = Problem::error(0..first_line_len(text), "the manifest has no [atlas]");
            parser.report(problem.with_help("add a table [atlas] with title = \"…\""));
            None
        }
    };
    let page = settings::page(root.get("page"), parser);
    let tolerances = tolerance::read(root.get("check"), &tolerance::CHECK, parser);
    let templates = Templates::read(&root, parser);
    let formats = atlas.as_ref().map_or_else(|| vec![Format::Svg], |atlas| atlas.formats.clone());
    let tables = root.tables("family", parser);
    if tables.is_empty() && root.get("family").is_none_or(|value| value.get_ref().is_array()) {
        let problem = Problem::error(0..first_line_len(text), "the manifest has no family");
        parser.report(problem.with_help("add a table [[family]] with id, linkage, sampling, and grid or cases"));
    }
    let mut families: Vec<PlannedFamily> = Vec::new();
    let mut ids: HashSet<String> = HashSet::new();
    let mut totals = AtlasTotals::default();
    let shared_inputs = SharedInputs::from_manifest(&root);
    for value in tables {
        let page = page.as_ref().map(|page| &page.options);
        let context = family::Context { templates: &templates, formats: &formats, page };
        let read = family::read(value, context, &mut totals, parser);
        if let Some((id, span)) = family::id_and_span(value) {
            let message = format!("there are two families `{id}`");
            if !ids.insert(id) {
                let problem = Problem::error(span, message);
                parser.report(problem.with_help("an id names the family's folder: give each family its own"));
            }
        }
        let tolerances = |family: PartialTolerances| family.or(tolerances);
        families.extend(read.map(|read| PlannedFamily {
            manifest_inputs: shared_inputs.of_family(value),
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

/// The linkages a family may name: those of the manifest and those of the catalogue.
struct Templates {
    manifest_templates: Vec<Arc<Template>>,
    /// The ids of the manifest's linkages in order, including those that could not be parsed.
    ids: Vec<String>,
    /// The linkages of the manifest by their ids; `None` for those that could not be parsed.
    by_id: HashMap<String, Option<Arc<Template>>>,
}

impl Templates {
    fn read<'t>(root: &Fields<'_, 't>, parser: &mut TomlParser<'t>) -> Templates {
        let mut templates = Templates { manifest_templates: Vec::new(), ids: Vec::new(), by_id: HashMap::new() };
        for value in root.tables("linkage", parser) {
            let read = linkage_format::parse_template(value, parser).map(Arc::new);
            if let Some((id, span)) = family::id_and_span(value) {
                let conflict = if catalogue::find(&id).is_some() {
                    Some(format!("the catalogue has a linkage `{id}` already"))
                } else if templates.by_id.contains_key(&id) {
                    Some(format!("there are two linkages `{id}`"))
                } else {
                    None
                };
                templates.ids.push(id.clone());
                if let Some(message) = conflict {
                    templates.by_id.entry(id).or_insert(None);
                    parser.report(Problem::error(span, message).with_help("choose another id"));
                    continue;
                }
                templates.by_id.insert(id, read.clone());
            }
            templates.manifest_templates.extend(read);
        }
        templates
    }

    /// The linkage that a value names. One that could not be parsed has been reported already.
    fn find<'t>(&self, value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Arc<Template>> {
        let id = parser.text(value)?;
        // A linkage of the manifest that could not be parsed is not replaced by the catalogue's of the same name.
        if let Some(found) = self.by_id.get(&id) {
            return found.clone();
        }
        let found = catalogue::find(&id);
        if found.is_none() {
            let built_in = catalogue::all().iter().map(|template| template.id.as_str());
            let known = self.ids.iter().map(String::as_str).chain(built_in);
            let count = self.ids.len() + catalogue::all().len();
            let problem = Problem::error(value.span(), format!("there is no linkage `{}`", id.escape_debug()));
            parser.report(problem.with_help(suggestion_among(&id, known, count)));
        }
        found
    }
}
