//! Parses a manifest as a whole.

use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;

use coupler_curves::family::Family;
use coupler_curves::linkage_format::{Fields, TomlParser, canonical_toml};
use coupler_curves::problem::Problem;
use coupler_curves::template::Template;
use coupler_drawing::render::{Format, TextMode};

use crate::cells::{AtlasTotals, Purpose};
use crate::files::FileReader;
use crate::inputs::SharedInputs;
use crate::plan::{Plan, PlannedFamily};
use crate::schema::MANIFEST;
use crate::templates::{Templates, id_and_span};
use crate::tolerance::PartialTolerances;
use crate::undrawable::{names_missing_font, undrawable_texts};
use crate::{family, format_version, settings, tolerance};

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

/// Parses a manifest without the files that it names; formats that this build cannot write are errors.
pub fn parse(text: &str) -> ParseOutcome {
    parse_with_files(text, None)
}

/// Parses a manifest with the files that it names; formats that this build cannot write are errors.
pub fn parse_with_files(text: &str, files: FileReader) -> ParseOutcome {
    let built_in: Vec<Format> = Format::ALL.into_iter().filter(|format| format.is_built_in()).collect();
    parse_for_formats(text, &built_in, files)
}

/// Parses a manifest for a program that writes these formats; others are errors.
pub fn parse_for_formats(text: &str, writable: &[Format], files: FileReader) -> ParseOutcome {
    parse_for(text, writable, Purpose::Pages, files)
}

/// Parses a manifest for tables without pages of some of its cells: those of which `cells` returns the range of indices in a
/// family, whose cells may have errors. Only these are checked. Of the others nothing is computed, so that there may be as many as `limit` allows.
pub fn parse_for_tables(text: &str, files: FileReader, cells: &dyn Fn(&Family) -> Range<usize>) -> ParseOutcome {
    parse_for(text, &Format::ALL, Purpose::Tables(cells), files)
}

fn parse_for(text: &str, writable: &[Format], purpose: Purpose, files: FileReader) -> ParseOutcome {
    if let Some(problem) = length_problem(text) {
        return ParseOutcome { plan: None, problems: vec![problem] };
    }
    let mut parser = TomlParser::new(text).with_root(&MANIFEST);
    let plan = read_plan(text, (writable, purpose), files, &mut parser);
    let problems = parser.into_problems();
    let plan = plan.filter(|_| !problems.iter().any(Problem::is_error));
    ParseOutcome { plan, problems }
}

/// Parses the `[[linkage]]` tables of a manifest, and ignores its other tables.
pub fn parse_linkages(text: &str) -> (Vec<Arc<Template>>, Vec<Problem>) {
    if let Some(problem) = length_problem(text) {
        return (Vec::new(), vec![problem]);
    }
    let mut parser = TomlParser::new(text).with_root(&MANIFEST);
    let document = parser.parse_document();
    let root = Fields::with_any_keys(&document, "a manifest", &mut parser)
        .filter(|_| format_version::is_supported(&document, &mut parser));
    let templates = match root {
        Some(root) => Templates::read(&root, &mut parser).manifest_templates,
        None => Vec::new(),
    };
    (templates, parser.into_problems())
}

/// The `[[linkage]]` of a manifest with an id, as TOML for another manifest; `None` if it has none.
pub fn linkage_text(text: &str, id: &str) -> Option<String> {
    let mut parser = TomlParser::new(text).with_root(&MANIFEST);
    let document = parser.parse_document();
    let root = Fields::with_any_keys(&document, "a manifest", &mut parser)?;
    for table in root.tables("linkage", &mut parser) {
        let Some(linkage) = Fields::with_any_keys(table, "a linkage", &mut parser) else { continue };
        let Some(own) = linkage.get("id") else { continue };
        if parser.text(own).as_deref() != Some(id) {
            continue;
        }
        let entry = |(key, _, value)| format!("{key} = {}\n", canonical_toml(value, &[]));
        return Some(format!("[[linkage]]\n{}", linkage.entries().map(entry).collect::<String>()));
    }
    None
}

fn read_plan(
    text: &str,
    (writable, purpose): (&[Format], Purpose),
    files: FileReader,
    parser: &mut TomlParser,
) -> Option<Plan> {
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
        Some(value) => settings::atlas(value, writable, parser),
        None if root.may_be_misspelt("atlas") => None,
        None => {
            let problem = Problem::error(0..first_line_len(text), "the manifest has no [atlas]");
            parser.report(problem.with_help("add a table [atlas] with title = \"…\""));
            None
        }
    };
    let page = settings::page(root.get("page"), files, parser);
    let tolerances = tolerance::read(root.get("check"), &tolerance::CHECK, parser);
    let templates = Templates::read(&root, parser);
    let formats = atlas.as_ref().map_or_else(|| vec![Format::Svg], |atlas| atlas.formats.clone());
    let unit = atlas.as_ref().and_then(|atlas| atlas.unit);
    let tables = root.tables("family", parser);
    let has_none = tables.is_empty() && root.get("family").is_none_or(|value| value.get_ref().is_array());
    if has_none && !root.may_be_misspelt("family") {
        let problem = Problem::error(0..first_line_len(text), "the manifest has no family");
        parser.report(problem.with_help("add a table [[family]] with id, linkage, and grid or cases"));
    }
    let mut families: Vec<PlannedFamily> = Vec::new();
    let mut ids: HashSet<String> = HashSet::new();
    let mut totals = AtlasTotals::default();
    let typeface = page.as_ref().map(|page| page.options.theme.typeface);
    let shared_inputs = SharedInputs::from_manifest(&root, typeface.and_then(|typeface| typeface.fallback));
    // The pages of an atlas of one family are those of the atlas.
    let default_title = atlas.as_ref().map(|atlas| atlas.title.clone()).filter(|_| tables.len() == 1);
    for value in tables {
        let default_title = default_title.as_deref();
        let page = page.as_ref().map(|page| &page.options);
        let (templates, formats) = (&templates, &formats);
        let context = family::Context { templates, formats, writable, default_title, unit, page, purpose, files };
        let read = family::read(value, context, &mut totals, parser);
        if let Some((id, span)) = id_and_span(value) {
            let message = format!("there are two families `{id}`");
            if !ids.insert(id) {
                let problem = Problem::error(span, message);
                parser.report(problem.with_help("an id names the family's folder: give each family its own"));
            }
        }
        let tolerances = |family: PartialTolerances| family.or(tolerances.clone());
        families.extend(read.map(|read| PlannedFamily {
            manifest_inputs: shared_inputs.of_family(
                value,
                (read.layout, &read.family.title),
                read.case_file.as_ref().map(|file| file.digest.as_str()),
            ),
            tolerances: tolerances(read.tolerances),
            ..read
        }));
    }
    let options = page.as_ref().map(|page| &page.options);
    let book = crate::book::read(root.get("book"), (&families, families.len() == tables.len()), options, parser);
    let undrawable = typeface.map(|typeface| undrawable_texts(&document, typeface)).unwrap_or_default();
    let needs_fonts = page.as_ref().is_some_and(|page| page.text_mode == TextMode::Outlines)
        || families.iter().flat_map(|family| &family.formats).any(|format| *format != Format::Svg);
    // What is wrong with the font file has been reported.
    if needs_fonts && !names_missing_font(&root, typeface) {
        undrawable.iter().for_each(|problem| parser.report(problem.clone()));
    }
    let (atlas, page, book) = (atlas?, page?, book?);
    Some(Plan {
        title: atlas.title,
        output: atlas.output,
        volume_pages: atlas.volume_pages,
        book,
        page: page.options,
        dpi: page.dpi,
        text_mode: page.text_mode,
        families,
        undrawable,
    })
}

fn first_line_len(text: &str) -> usize {
    text.find('\n').unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_that_cannot_be_written_are_errors() {
        let text = "[atlas]\ntitle = \"T\"\nformats = [\"pdf\"]\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
                    formats = [\"png\"]\nsampling = { samples = 9 }\ngrid = { p = [2], a = [2] }";
        assert!(parse_for_formats(text, &Format::ALL, None).plan.is_some());
        let messages: Vec<String> =
            parse_for_formats(text, &[Format::Svg], None).problems.into_iter().map(|problem| problem.message).collect();
        assert_eq!(messages, ["this build cannot write `pdf`", "this build cannot write `png`"]);
    }
}
