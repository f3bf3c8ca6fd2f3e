//! The parameter sets of a family: its `grid`, its `cases`, which may be in a file, or what its `design` finds.

use std::sync::Arc;

use crate::design;
use crate::files::{CaseTable, FileReader, RowPlaces};
use crate::grid::{self, GridValues};
use coupler_curves::family::{Axis, AxisValues, Case, MAX_CELLS, ParameterSpace};
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::{ParameterKind, Template};

/// The most cells that `limit` may allow; their numbers have 32 bits.
pub(crate) const MAX_LIMIT: usize = 4_000_000_000;

/// The values of `grid`, `cases` or `design`, by name; `None` for those that could not be read, which is a problem already, so that what else is
/// wrong is found in the same run.
pub(crate) enum NamedSpace {
    Grid(Vec<(String, Span, Option<AxisValues>)>),
    Cases(Vec<Vec<(String, Span, Option<f64>)>>),
    /// Those of a file or of a search, with the place of its name; NaN for those that could not be read.
    Table(TableColumns, Vec<f64>, Span),
}

impl NamedSpace {
    /// The names of which some value could not be read.
    pub fn unread(&self) -> Vec<String> {
        let names: Vec<&String> = match self {
            NamedSpace::Grid(axes) => {
                axes.iter().filter(|(.., values)| values.is_none()).map(|(name, ..)| name).collect()
            }
            NamedSpace::Cases(cases) => {
                cases.iter().flatten().filter(|(.., value)| value.is_none()).map(|(name, ..)| name).collect()
            }
            NamedSpace::Table(columns, ..) if columns.is_complete => Vec::new(),
            NamedSpace::Table(columns, values, _) => {
                let column = |k: usize| values.iter().skip(k).step_by(columns.names.len());
                let names = columns.names.iter().enumerate();
                names.filter(|(k, _)| column(*k).any(|value| value.is_nan())).map(|(_, name)| name).collect()
            }
        };
        names.into_iter().cloned().collect()
    }

    /// The parameter sets, with the indices of their names, and the table that they are from. What could not be read is not a number there.
    pub fn into_space(self, slot_of: &mut impl FnMut(&str, &Span) -> usize) -> (ParameterSpace, Option<TableColumns>) {
        let space = match self {
            NamedSpace::Grid(axes) => {
                let axis = |(name, span, values): (String, Span, Option<AxisValues>)| Axis {
                    slot: slot_of(&name, &span),
                    values: values.unwrap_or_else(|| vec![f64::NAN].into()),
                };
                ParameterSpace::Grid(axes.into_iter().map(axis).collect())
            }
            NamedSpace::Cases(cases) => {
                let mut case = |case: Vec<(String, Span, Option<f64>)>| -> Case {
                    let value = |(name, span, value): (String, Span, Option<f64>)| {
                        (slot_of(&name, &span), value.unwrap_or(f64::NAN))
                    };
                    case.into_iter().map(value).collect()
                };
                ParameterSpace::Cases(cases.into_iter().map(&mut case).collect())
            }
            NamedSpace::Table(columns, values, span) => {
                let slots = columns.names.iter().map(|name| slot_of(name, &span)).collect();
                return (ParameterSpace::Table { slots, values: Arc::new(values) }, Some(columns));
            }
        };
        (space, None)
    }
}

/// What a name is a number of: a parameter of the linkage, or another name; `None` if the linkage is not known.
pub(crate) fn kind_of(template: Option<&Template>, name: &str) -> Option<ParameterKind> {
    let parameter = template?.parameters.iter().find(|parameter| parameter.name == name);
    Some(parameter.map(|parameter| parameter.kind).unwrap_or_default())
}

/// Reads `grid`, `cases` or `design` of a family of a linkage; `None` if it is not known which.
pub(crate) fn read_space<'t>(
    fields: &Fields<'_, 't>,
    template: Option<&Template>,
    files: FileReader,
    parser: &mut TomlParser<'t>,
) -> Option<NamedSpace> {
    let limit = match fields.get("limit") {
        None => MAX_CELLS,
        // With a limit that cannot be read there may be as many as with any.
        Some(value) => parser.integer(value, 1, MAX_LIMIT).unwrap_or(MAX_LIMIT),
    };
    match (fields.get("grid"), fields.get("cases"), fields.get("design")) {
        (Some(value), None, None) => read_grid(value, limit, template, parser),
        (None, Some(value), None) if value.get_ref().is_str() => read_table(value, limit, files, parser),
        (None, Some(value), None) => read_cases(value, limit, template, parser),
        (None, None, Some(value)) => {
            let id = fields.get("id").and_then(|id| id.get_ref().as_str()).unwrap_or_default();
            let name = format!("the designs of {id}");
            let (table, is_complete) = design::read(value, &name, template, files, parser)?;
            into_space(name, table, is_complete, (value, limit), parser)
        }
        // One may be in an entry that could not be read.
        (None, None, None) if parser.has_syntax_error() => None,
        (None, None, None) if ["grid", "cases", "design"].iter().any(|key| fields.may_be_misspelt(key)) => None,
        (grid, cases, design) => {
            let message = match (grid, cases, design) {
                (None, None, None) => "a [[family]] has no `grid`, no `cases` and no `design`",
                (Some(_), Some(_), None) => "a family has a grid or cases, not both",
                _ => "a family has a `design` or parameter sets of its own, not both",
            };
            let problem = Problem::error(fields.span.clone(), message);
            let help = match template.map(|template| (&template.id, &template.parameters[..])) {
                Some((id, [])) => format!("write cases = [{{}}]: `{id}` has no parameters, and one cell"),
                Some((_, [first, ..])) => {
                    format!("write grid = {{ {0} = [2, 3] }} or cases = [{{ {0} = 2 }}]", first.name)
                }
                None => "write grid = { p = [2, 3, 4] } or cases = [{ p = 2 }, { p = 3 }]".to_owned(),
            };
            parser.report(problem.with_help(help));
            None
        }
    }
}

/// Reads `grid`, with at most `limit` cells.
fn read_grid<'t>(
    value: &TomlValue<'t>,
    limit: usize,
    template: Option<&Template>,
    parser: &mut TomlParser<'t>,
) -> Option<NamedSpace> {
    let table = Fields::with_any_keys(value, "`grid`", parser)?;
    if table.keys().is_empty() {
        if parser.has_syntax_error() {
            return None;
        }
        let help = match template {
            Some(template) if template.parameters.is_empty() => "write cases = [{}] for its one cell",
            _ => "name a parameter, as in { p = [2, 3, 4] }",
        };
        parser.report(Problem::error(value.span(), "the grid is empty").with_help(help));
        return None;
    }
    let mut axes = Vec::new();
    for (name, span, value) in table.entries() {
        linkage_format::check_identifier(name, span.clone(), parser);
        let values = grid::read_values(name, kind_of(template, name), value, parser);
        axes.push((name.to_owned(), span, values));
    }
    let count = |(.., read): &(_, _, Option<GridValues>)| read.as_ref().map_or(1.0, |read| read.count);
    let cells: f64 = axes.iter().map(count).product();
    if cells > limit as f64 {
        const MAX_WRITTEN: f64 = 1e18;
        let count = if cells <= MAX_WRITTEN { format!("{cells:.0}") } else { "more than 10^18".to_owned() };
        let problem =
            Problem::error(value.span(), format!("the grid has {count} cells, more than the limit of {limit}"));
        parser.report(problem.with_help("use fewer values, or allow more with `limit = N` in the family"));
        return None;
    }
    Some(NamedSpace::Grid(
        axes.into_iter().map(|(name, span, read)| (name, span, read.map(|read| read.values))).collect(),
    ))
}

/// Reads `cases`, at most `limit` of them.
fn read_cases<'t>(
    value: &TomlValue<'t>,
    limit: usize,
    template: Option<&Template>,
    parser: &mut TomlParser<'t>,
) -> Option<NamedSpace> {
    let mut items = value.get_ref().as_array().into_iter().flatten();
    if let Some(text) = items.find(|value| value.get_ref().is_str()) {
        let help = "write { p = 2 }, or name one file with all of them: cases = \"list.csv\"";
        parser.report(Problem::error(text.span(), "expected a case, found a string").with_help(help));
        return None;
    }
    let list = parser.list(value)?;
    if list.is_empty() {
        parser.report(
            Problem::error(value.span(), "there are no cases").with_help("give at least one, as in [{ p = 2 }]"),
        );
        return None;
    }
    if !is_within_limit(list.len(), limit, value, parser) {
        return None;
    }
    let mut cases = Vec::new();
    let mut all_read = true;
    for item in list {
        let Some(table) = Fields::with_any_keys(item, "a case", parser) else {
            all_read = false;
            continue;
        };
        let mut case = Vec::new();
        for (name, span, value) in table.entries() {
            linkage_format::check_identifier(name, span.clone(), parser);
            let value = parser.parameter_value(value, name, kind_of(template, name));
            case.push((name.to_owned(), span, value));
        }
        cases.push(case);
    }
    all_read.then_some(NamedSpace::Cases(cases))
}

/// Whether there are at most `limit` cases; reports more.
fn is_within_limit(count: usize, limit: usize, value: &TomlValue, parser: &mut TomlParser) -> bool {
    if count > limit {
        let problem = Problem::error(value.span(), format!("there are {count} cases, more than the limit of {limit}"));
        parser.report(problem.with_help("use fewer, or allow more with `limit = N` in the family"));
    }
    count <= limit
}

/// What is known of the table that the cases of a family are from, besides their values.
pub(crate) struct TableColumns {
    /// The path, as the manifest has it, or what the answers of a search are called.
    pub path: String,
    /// The names of the columns.
    pub names: Vec<String>,
    /// Whether all of it could be read.
    pub is_complete: bool,
    /// The digest of its names and values.
    pub digest: String,
    rows: RowPlaces,
}

impl TableColumns {
    /// The beginning of a message about a name; empty if it is none of a column.
    pub fn place_of(&self, name: &str) -> String {
        match self.names.iter().any(|own| own == name) {
            true => format!("in `{}`, ", self.shown_path()),
            false => String::new(),
        }
    }

    /// Where the `k`-th row is, from 0: "`list.csv`, line 7".
    pub fn row(&self, k: usize) -> String {
        format!("`{}`, {}", self.shown_path(), self.rows.place(k))
    }

    /// The path for messages.
    pub fn shown_path(&self) -> String {
        self.path.escape_debug().to_string()
    }
}

/// Reads the cases in a file, at most `limit` of them.
fn read_table<'t>(
    value: &TomlValue<'t>,
    limit: usize,
    files: FileReader,
    parser: &mut TomlParser<'t>,
) -> Option<NamedSpace> {
    let path = parser.text(value)?;
    let Some(files) = files else {
        let problem = Problem::error(value.span(), "the cases are in a file, and files are not read here");
        parser.report(problem.with_help("write them in the manifest: cases = [{ p = 2 }, { p = 3 }]"));
        return None;
    };
    let before = parser.problem_count();
    let table = files.cases(&path, limit, &mut |problem| parser.report(problem.at(value.span())));
    let table = table?;
    let shown = path.escape_debug();
    for (k, name) in table.names.iter().enumerate() {
        if let Some([message, help]) = linkage_format::identifier_error(name) {
            let problem = Problem::error(value.span(), format!("in `{shown}`, column {}: {message}", k + 1));
            parser.report(problem.with_help(help));
        } else if table.names[..k].contains(name) {
            let problem = Problem::error(value.span(), format!("in `{shown}`, there are two columns `{name}`"));
            parser.report(problem.with_help("remove one of them, or name it otherwise"));
        }
    }
    if table.count == 0 {
        let problem = Problem::error(value.span(), "there are no cases");
        parser.report(problem.with_help(format!("give at least one, in a row below the names in `{shown}`")));
        return None;
    }
    let is_complete = parser.problem_count() == before;
    into_space(path, table, is_complete, (value, limit), parser)
}

/// The cases of a table at a place in the manifest, if they are not more than the limit.
fn into_space(
    path: String,
    CaseTable { names, values, count, digest, rows }: CaseTable,
    is_complete: bool,
    (value, limit): (&TomlValue, usize),
    parser: &mut TomlParser,
) -> Option<NamedSpace> {
    let columns = TableColumns { path, names, is_complete, digest, rows };
    is_within_limit(count, limit, value, parser).then(|| NamedSpace::Table(columns, values, value.span()))
}
