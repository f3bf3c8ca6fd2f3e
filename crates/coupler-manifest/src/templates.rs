//! The linkages of a manifest and of the catalogue, by their ids.

use std::collections::HashMap;
use std::sync::Arc;

use coupler_curves::catalogue;
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::problem::{Problem, Span, suggestion_among};
use coupler_curves::template::Template;

/// The id of a table and its place; `None` if it has none.
pub(crate) fn id_and_span(value: &TomlValue) -> Option<(String, Span)> {
    let id = value.get_ref().as_table()?.get("id")?;
    Some((id.get_ref().as_str()?.to_owned(), id.span()))
}

/// The linkages a family may name: those of the manifest and those of the catalogue.
pub(crate) struct Templates {
    /// The linkages of the manifest that could be parsed, in order.
    pub manifest_templates: Vec<Arc<Template>>,
    /// The ids of the manifest's linkages in order, including those that could not be parsed.
    ids: Vec<String>,
    /// The linkages of the manifest by their ids, also those with problems with which families can be checked; `None` for others that could
    /// not be parsed.
    by_id: HashMap<String, Option<Arc<Template>>>,
}

impl Templates {
    /// Reads the linkages of a manifest.
    pub fn read<'t>(root: &Fields<'_, 't>, parser: &mut TomlParser<'t>) -> Templates {
        let mut templates = Templates { manifest_templates: Vec::new(), ids: Vec::new(), by_id: HashMap::new() };
        for value in root.tables("linkage", parser) {
            let before = parser.problem_count();
            let read = linkage_format::parse_template(value, parser).map(Arc::new);
            let has_problems = parser.problem_count() > before;
            if let Some((id, span)) = id_and_span(value) {
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
            templates.manifest_templates.extend(read.filter(|_| !has_problems));
        }
        templates
    }

    /// The linkage that a value names. One that could not be parsed has been reported already.
    pub fn find<'t>(&self, value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Arc<Template>> {
        let id = parser.text(value)?;
        // A linkage of the manifest that could not be parsed is not replaced by the catalogue's of the same name.
        if let Some(found) = self.by_id.get(&id) {
            return found.clone();
        }
        let found = catalogue::find(&id);
        // A linkage may be in an entry that could not be read.
        if found.is_none() && !parser.has_syntax_error() {
            let built_in = catalogue::all().iter().map(|template| template.id.as_str());
            let known = self.ids.iter().map(String::as_str).chain(built_in);
            let count = self.ids.len() + catalogue::all().len();
            let problem = Problem::error(value.span(), format!("there is no linkage `{}`", id.escape_debug()));
            parser.report(problem.with_help(suggestion_among(&id, known, count)));
        }
        found
    }
}
