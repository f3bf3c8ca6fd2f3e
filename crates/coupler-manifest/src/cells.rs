//! Checks the cells of a family.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use crate::parameter_sets::TableColumns;
use crate::plan::PlannedFamily;
use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::{Cell, CellError, Family, ParameterSpace};
use coupler_curves::linkage_format::{Fields, TomlParser, TomlValue};
use coupler_curves::motion::MAX_CIRCUIT_BYTES;
use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::Parameter;
use coupler_drawing::page::Layout;
use coupler_drawing::render::Format;

/// The most names of all families of an atlas, which are in memory together: a hundred bytes each.
const MAX_NAMES: usize = 500_000;

/// The most cells of all families of an atlas that is drawn: all of them are checked before any is solved, which takes about
/// a microsecond each, and the order of their pages takes 16 bytes each.
const MAX_DRAWN_CELLS: usize = 10_000_000;

/// What the cells of a manifest are for.
#[derive(Clone, Copy)]
pub enum Purpose<'a> {
    /// All of them are solved, and drawn on pages. Their number is limited, and all of them are checked.
    Pages,
    /// Some are solved, and written into tables: those of which this function returns the range of indices in a family. Only these
    /// are checked, and there may be as many as `limit` allows.
    Tables(&'a dyn Fn(&Family) -> Range<usize>),
}

/// The most values of all cells of an atlas, each computed and checked before any cell is solved, in some ten seconds.
const MAX_CHECKED_VALUES: usize = 1_000_000_000;

/// The most files that the pages of an atlas may have; the record of each takes about two kilobytes during a run.
pub const MAX_PAGE_FILES: usize = 100_000;

/// The most cells of a book, whose captions are in memory for its contents and index.
const MAX_BOOK_CELLS: usize = 1_000_000;

/// How many cells, names, values and files the families of an atlas have so far.
#[derive(Default)]
pub(crate) struct AtlasTotals {
    page_files: usize,
    book_cells: usize,
    cells: usize,
    names: usize,
    values: usize,
}

impl AtlasTotals {
    /// Adds the names of a family, which are at least the parameters of its linkage; reports too many, and is false
    /// then.
    pub fn add_names(&mut self, names: usize, fields: &Fields, parser: &mut TomlParser) -> bool {
        self.names = self.names.saturating_add(names);
        let span = fields.get("linkage").map_or_else(|| fields.span.clone(), TomlValue::span);
        let help = "use linkages with fewer parameters, or divide the atlas";
        is_within(self.names, MAX_NAMES, "names", span, help, parser)
    }

    /// Adds the cells of a family; reports too many, and is false then.
    pub fn add_cells(&mut self, family: &Family, fields: &Fields, parser: &mut TomlParser) -> bool {
        let cells = family.cell_count();
        // A joint takes about as long as a value.
        let values_per_cell = family.names.len() + family.template.joints.len() + family.template.curve_count();
        self.cells = self.cells.saturating_add(cells);
        self.values = self.values.saturating_add(cells.saturating_mul(values_per_cell));
        let help = "use fewer values, divide the atlas, or solve it without pages: `coupler-atlas sweep`";
        is_within(self.cells, MAX_DRAWN_CELLS, "cells", space_span(fields), help, parser)
            && is_within(self.values, MAX_CHECKED_VALUES, "values of cells", space_span(fields), help, parser)
    }

    /// Adds the files of a family's pages, and reports too many. How many pages a family with `where` has is known only
    /// when its cells are solved, and checked then.
    pub fn add_page_files(&mut self, planned: &PlannedFamily, fields: &Fields, parser: &mut TomlParser) {
        let PlannedFamily { family, layout, chart, formats, .. } = planned;
        let cells = family.cell_count();
        let pages = match (layout, chart) {
            _ if family.filter.is_some() => 0,
            (_, Some(chart)) => chart.y.len().div_ceil(layout.cells_per_page()),
            (Layout::CouplerGrid, _) => {
                cells.saturating_mul(family.template.curve_count().div_ceil(Layout::POINTS_PER_PAGE))
            }
            _ => cells.div_ceil(layout.cells_per_page()),
        };
        if formats.contains(&Format::Pdf) {
            self.book_cells = self.book_cells.saturating_add(cells);
            let help = "leave the format pdf out, or divide the atlas";
            is_within(self.book_cells, MAX_BOOK_CELLS, "cells in the book", space_span(fields), help, parser);
        }
        let page_formats = formats.iter().filter(|format| format.page_format().is_some()).count();
        self.page_files = self.page_files.saturating_add(pages.saturating_mul(page_formats));
        let help = "put more panels on a page, write fewer formats, or divide the atlas";
        is_within(self.page_files, MAX_PAGE_FILES, "files of pages", space_span(fields), help, parser);
    }
}

/// Whether the number of something in the families so far is within its limit; reports it otherwise.
fn is_within(number: usize, limit: usize, what: &str, span: Span, help: &str, parser: &mut TomlParser) -> bool {
    if number > limit {
        let message = format!("the families up to here have {number} {what}, more than the limit of {limit}");
        parser.report(Problem::error(span, message).with_help(help));
    }
    number <= limit
}

/// Checks that the cells of a page, which are in memory together, are not too large; without pages, that a single one is not.
pub(crate) fn check_memory(family: &Family, layout: Option<Layout>, fields: &Fields, parser: &mut TomlParser) {
    let cells = match layout {
        None => 1,
        // Charts are drawn from the measures of all cells, which are solved a few at a time.
        Some(Layout::Chart { .. }) => 1,
        Some(layout) => layout.cells_per_page().min(family.cell_count()),
    };
    let bytes = family.estimate_cell_bytes().saturating_mul(cells);
    if bytes > MAX_CIRCUIT_BYTES {
        let [needed, limit] = [bytes, MAX_CIRCUIT_BYTES].map(|bytes| bytes.div_ceil(1_000_000));
        let of_page = if cells == 1 { "a cell".to_owned() } else { format!("the {cells} cells of a page") };
        let message = format!("{of_page} would take about {needed} MB, more than the limit of {limit} MB");
        let span = fields.get("sampling").map_or_else(|| fields.span.clone(), TomlValue::span);
        let help = "use fewer samples, traced points or panels on a page";
        parser.report(Problem::error(span, message).with_help(help));
    }
}

/// A problem of one or more cells.
struct CellProblem {
    span: Span,
    message: String,
    help: String,
    cell_count: usize,
}

/// The kinds of problems, of each of which only the first is reported.
#[derive(PartialEq, Eq, Hash)]
enum ProblemKind {
    Missing(String),
    Value(usize),
    Linkage,
}

/// What is known of the names of a family.
pub(crate) struct GivenNames<'a> {
    /// The places where they get their values.
    pub spans: &'a [Option<Span>],
    /// The parameters of which misspelt names have been reported.
    pub misspelt: &'a [String],
    /// The names of which a value or an expression could not be read, which has been reported.
    pub unread: &'a [String],
    /// The table that the cases are from, if they are.
    pub table: Option<&'a TableColumns>,
}

/// Checks the values and the linkages of a range of cells; of each kind of problem the first cell is reported, and the others are
/// counted. If the family `has_problems` already, a name without a value that is not a parameter, or that is one misspelt, is one
/// of them.
pub(crate) fn check(
    family: &Family,
    cells: Range<usize>,
    fields: &Fields,
    GivenNames { spans, misspelt, unread, table }: GivenNames,
    has_problems: bool,
    parser: &mut TomlParser,
) {
    let is_parameter = |name: &String| family.template.parameters.iter().any(|parameter| parameter.name == *name);
    let is_unread = |name: &String| unread.contains(name);
    let is_missing_reported =
        |name: &String| has_problems && (!is_parameter(name) || misspelt.contains(name) || is_unread(name));
    let mut problems: Vec<CellProblem> = Vec::new();
    let mut problem_indices: HashMap<ProblemKind, usize> = HashMap::new();
    let derived: HashMap<usize, &CompiledExpression> =
        family.derived.iter().map(|(slot, value)| (*slot, value)).collect();
    for k in cells {
        let cell = family.cell(k);
        let errors = family.cell_errors(&cell);
        let slot = |error: &CellError| match error {
            CellError::Value { slot, .. } => Some(*slot),
            CellError::Missing(_) | CellError::Template(_) => None,
        };
        let wrong: HashSet<usize> = errors.iter().filter_map(slot).collect();
        // A value that is derived from a wrong one may be right with another.
        let follows =
            |slot: &usize| derived.get(slot).is_some_and(|value| value.slots().iter().any(|slot| wrong.contains(slot)));
        for error in &errors {
            let is_reported = match error {
                CellError::Missing(name) => is_missing_reported(name),
                // What could not be read, or is derived from it, is not a number.
                CellError::Value { slot, .. } => follows(slot) || !unread.is_empty() && !cell.values[*slot].is_finite(),
                CellError::Template(_) => false,
            };
            if is_reported {
                continue;
            }
            let (kind, slot, help) = match error {
                CellError::Missing(name) => {
                    let help = match table {
                        Some(table) => format!("give it in a column of `{}`, or in `let`", table.shown_path()),
                        None => "give it in the grid, the cases or `let`".to_owned(),
                    };
                    (ProblemKind::Missing(name.clone()), None, help)
                }
                CellError::Value { slot, .. } => (ProblemKind::Value(*slot), Some(*slot), value_help(family, k, *slot)),
                CellError::Template(_) => {
                    (ProblemKind::Linkage, None, "change the values it comes from, or leave the cell out".to_owned())
                }
            };
            if let Some(&found) = problem_indices.get(&kind) {
                problems[found].cell_count += 1;
                continue;
            }
            problem_indices.insert(kind, problems.len());
            let value_span = slot.and_then(|slot| value_span(family, fields, k, slot));
            let span = value_span.or_else(|| case_span(fields, k)).or_else(|| spans.get(slot?).cloned().flatten());
            let row = table.map_or(String::new(), |table| format!("{}: ", table.row(k)));
            let message = format!("in cell {} ({row}{}), {error}", cell.number, given_values(family, &cell));
            let span = span.unwrap_or_else(|| space_span(fields));
            problems.push(CellProblem { span, message, help, cell_count: 1 });
        }
    }
    for problem in problems {
        let help = match problem.cell_count {
            1 => problem.help,
            2 => format!("{}; one more cell has the same error", problem.help),
            n => format!("{}; {} more cells have the same error", problem.help, n - 1),
        };
        parser.report(Problem::error(problem.span, problem.message).with_help(help));
    }
}

/// The most values of a cell that a message names.
const MAX_VALUES: usize = 20;

/// The values of a cell as a message names them.
fn given_values(family: &Family, cell: &Cell) -> String {
    let given = || family.names.iter().zip(&cell.values).filter(|(_, value)| value.is_finite());
    let mut named: Vec<String> = given().take(MAX_VALUES).map(|(name, value)| format!("{name} = {value}")).collect();
    let more = given().count() - named.len();
    if more > 0 {
        named.push(format!("and {more} more"));
    }
    named.join(", ")
}

/// The place of the grid, the cases or the wishes; that of the family if it has none.
fn space_span(fields: &Fields) -> Span {
    let space = ["grid", "cases", "design"].into_iter().find_map(|key| fields.get(key));
    space.map_or_else(|| fields.span.clone(), TomlValue::span)
}

/// What to do about a value of the k-th cell that is out of its bounds.
fn value_help(family: &Family, k: usize, slot: usize) -> String {
    let allowed = family.template.parameters.get(slot).and_then(Parameter::allowed);
    match allowed.filter(|_| family.space.assigns(k, slot)) {
        Some(allowed) => {
            let place = if matches!(family.space, ParameterSpace::Table { .. }) { "there" } else { "here" };
            format!("give `{}` a value {allowed} {place}", family.names[slot])
        }
        None => "change the values it comes from".to_owned(),
    }
}

/// The place of the value that the grid or the k-th case gives a name, if it does.
fn value_span(family: &Family, fields: &Fields, k: usize, slot: usize) -> Option<Span> {
    let name = &family.names[slot];
    let value = match &family.space {
        ParameterSpace::Cases(_) => {
            fields.get("cases")?.get_ref().as_array()?.get(k)?.get_ref().as_table()?.get(name.as_str())?
        }
        ParameterSpace::Table { .. } => return None,
        ParameterSpace::Grid(axes) => {
            let value = fields.get("grid")?.get_ref().as_table()?.get(name.as_str())?;
            let axis = axes.iter().find(|axis| axis.slot == slot)?;
            let list = value.get_ref().as_array();
            let of_cell = family.cell(k).values[slot];
            list.and_then(|list| list.get(axis.values.iter().position(|value| value == of_cell)?)).unwrap_or(value)
        }
    };
    Some(value.span())
}

/// The place of the k-th case, if the family has cases; of one in a file, that of the file's name, and of an answer that of the wishes.
fn case_span(fields: &Fields, k: usize) -> Option<Span> {
    let cases = fields.get("cases").or_else(|| fields.get("design"))?;
    match cases.get_ref().as_array() {
        Some(list) => Some(list.get(k)?.span()),
        None => Some(cases.span()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\nsampling = { samples = 9 }\n\
                        panels = [1, 1]\ngrid = { p = [2, 3], a = [2] }";

    /// The messages of the problems that a family adds to totals.
    fn problems(mut totals: AtlasTotals) -> Vec<String> {
        let planned = &crate::parse(TEXT).plan.unwrap().families[0];
        let mut parser = TomlParser::new(TEXT);
        let document = parser.parse_document();
        let root = Fields::with_any_keys(&document, "a manifest", &mut parser).unwrap();
        let fields = Fields::with_any_keys(&root.tables("family", &mut parser)[0], "a family", &mut parser).unwrap();
        totals.add_names(planned.family.names.len(), &fields, &mut parser);
        totals.add_cells(&planned.family, &fields, &mut parser);
        totals.add_page_files(planned, &fields, &mut parser);
        let problems = parser.into_problems();
        assert!(problems.iter().all(|problem| problem.span.start > TEXT.find("[[family]]").unwrap()));
        problems.into_iter().map(|problem| problem.message).collect()
    }

    #[test]
    fn what_exceeds_a_limit_of_the_atlas_is_refused() {
        let none = AtlasTotals::default;
        let message = |number: usize, what: &str, limit: usize| {
            vec![format!("the families up to here have {number} {what}, more than the limit of {limit}")]
        };
        assert!(problems(none()).is_empty());
        // The family has two cells on two pages in two formats.
        assert!(
            problems(AtlasTotals { cells: MAX_DRAWN_CELLS - 2, page_files: MAX_PAGE_FILES - 4, ..none() }).is_empty()
        );
        let cells = AtlasTotals { cells: MAX_DRAWN_CELLS - 1, ..none() };
        assert_eq!(problems(cells), message(MAX_DRAWN_CELLS + 1, "cells", MAX_DRAWN_CELLS));
        let files = AtlasTotals { page_files: MAX_PAGE_FILES - 3, ..none() };
        assert_eq!(problems(files), message(MAX_PAGE_FILES + 1, "files of pages", MAX_PAGE_FILES));
        let names = AtlasTotals { names: MAX_NAMES, ..none() };
        assert_eq!(problems(names).len(), 1);
        let values = AtlasTotals { values: MAX_CHECKED_VALUES, ..none() };
        assert_eq!(problems(values).len(), 1);
    }
}
