//! The names of a family, and the values that `grid`, `cases`, `let` and the linkage's defaults give them.

use std::collections::HashMap;

use crate::files::FileReader;
use crate::parameter_sets::{TableColumns, kind_of, read_space};
use crate::unused_names;
use coupler_curves::expression::{Caption, CompiledExpression, Expression, Kind, Scope};
use coupler_curves::family::{Family, ParameterSpace, sort_by_dependency};
use coupler_curves::linkage_format::{self, Fields, TomlParser, TomlValue};
use coupler_curves::measure::{BOOLEANS, parse_condition};
use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::Template;
use coupler_drawing::chart;

/// The names of a family and where their values come from.
pub(crate) struct FamilyNames {
    pub all: Vec<String>,
    pub space: ParameterSpace,
    pub derived: Vec<(usize, CompiledExpression)>,
    pub filter: Option<CompiledExpression>,
    pub sort: Option<CompiledExpression>,
    pub captions: [Option<Caption>; 2],
    /// The place where each name is given a value.
    pub spans: Vec<Option<Span>>,
    /// The parameters of which misspelt names have been reported, and so not that they have no value.
    pub misspelt: Vec<String>,
    /// The names of which a value or an expression could not be read, and so not that they have none.
    pub unread: Vec<String>,
    /// The table that the cases are from, if they are.
    pub table: Option<TableColumns>,
    /// Whether all values and expressions could be read; otherwise there are problems.
    pub is_complete: bool,
}

/// The entries of `let`: names, their places and their values.
type Lets<'v, 't> = Vec<(&'v str, Span, &'v TomlValue<'t>)>;

/// Reads the names of a family, and the expressions over them: `let`, `where`, `sort`, `caption` and `note`. `None` if it is not known
/// which names there are, as without the linkage; the expressions are checked as far as they can be.
pub(crate) fn read_names<'t>(
    template: Option<&Template>,
    fields: &Fields<'_, 't>,
    files: FileReader,
    parser: &mut TomlParser<'t>,
) -> Option<FamilyNames> {
    let lets: Option<Lets> = match fields.get("let") {
        None => Some(Vec::new()).filter(|_| !fields.may_be_misspelt("let")),
        Some(value) => Fields::with_any_keys(value, "`let`", parser).map(|table| table.entries().collect()),
    };
    let named_space = read_space(fields, template, files, parser);
    let (Some(template), Some(lets), Some(named_space)) = (template, &lets, named_space) else {
        parser.with_unknown_names(|parser| check_expressions(template, lets.unwrap_or_default(), fields, parser));
        return None;
    };
    let mut collected = NameTable::default();
    for parameter in &template.parameters {
        collected.add(&parameter.name, None);
    }
    let mut unread = named_space.unread();
    let (space, table) = named_space.into_space(&mut |name, span| collected.add(name, Some(span)));
    let let_slots: Vec<usize> = lets.iter().map(|(name, span, _)| collected.add(name, Some(span))).collect();
    let NameTable { all, spans, .. } = collected;
    for (slot, name) in all.iter().enumerate() {
        if Family::is_column_name(name) {
            let place = table.as_ref().map_or(String::new(), |table| table.place_of(name));
            let problem = Problem::error(
                spans[slot].clone().unwrap_or(fields.span.clone()),
                format!("{place}`{name}` is the name of a column"),
            );
            parser.report(problem.with_help("`coupler-atlas list measures` lists the reserved names: use another one"));
        }
    }
    let scope = Scope::from_numbers(all.iter().map(String::as_str));
    let assignments = space.assignment_counts(all.len());
    let mut sources: Vec<(usize, Expression, Span)> = Vec::new();
    let mut read_all = table.as_ref().is_none_or(|table| table.is_complete) && unread.is_empty();
    for ((name, span, value), &slot) in lets.iter().zip(&let_slots) {
        linkage_format::check_identifier(name, span.clone(), parser);
        if assignments[slot] > 0 {
            let problem = Problem::error(
                span.clone(),
                format!("`{name}` has a value in the grid or a case, and another in `let`"),
            );
            parser.report(problem.with_help("keep one of the two"));
            read_all = false;
        }
        let kind = kind_of(Some(template), name);
        let expression = parser.parameter_expression(value, name, kind).filter(|expression| {
            let compiled = expression.compile(&scope, Kind::Number);
            parser.ok_or_report(value, compiled).is_some()
        });
        if expression.is_none() {
            unread.push((*name).to_owned());
            read_all = false;
        }
        sources.extend(expression.map(|expression| (slot, expression, span.clone())));
    }
    let always_given = |slot: usize| assignments[slot] == space.count();
    let mut is_derived = vec![false; all.len()];
    let_slots.iter().for_each(|&slot| is_derived[slot] = true);
    for (slot, parameter) in template.parameters.iter().enumerate() {
        if let (Some(default), false) = (&parameter.default, always_given(slot) || is_derived[slot]) {
            let span = fields.get("linkage").map_or(fields.span.clone(), TomlValue::span);
            sources.push((slot, default.clone(), span));
        }
    }
    let curve_scope = Family::scope(&all, template.is_driven_by_length());
    let curve_expressions = read_curve_expressions(fields, &curve_scope, parser);
    read_all &= curve_expressions.are_complete;
    let CurveExpressions { filter, sort, captions: [caption, note], .. } = curve_expressions;
    let captions = [caption.or_else(|| template.caption.clone()), note.or_else(|| template.note.clone())];
    let mut misspelt = Vec::new();
    if !parser.has_syntax_error() {
        // If all expressions could be compiled no word is misspelt.
        let known = chart::scope(&all, template.is_driven_by_length());
        let is_known = |word: &str| read_all || known.index_of(word).is_some();
        let names = all.iter().zip(&spans).map(|(name, span)| (name.as_str(), span.clone().unwrap_or_default()));
        misspelt = unused_names::report(template, (names, table.as_ref()), is_known, fields, parser);
    }
    let derived = in_dependency_order(sources, &all, &scope, parser)?;
    let is_complete = read_all;
    Some(FamilyNames { all, space, derived, filter, sort, captions, spans, misspelt, unread, table, is_complete })
}

/// The names of a family while they are collected.
#[derive(Default)]
struct NameTable {
    all: Vec<String>,
    /// The place where each name is given a value first.
    spans: Vec<Option<Span>>,
    indices: HashMap<String, usize>,
}

impl NameTable {
    /// The index of a name, which is added if it is new.
    fn add(&mut self, name: &str, span: Option<&Span>) -> usize {
        if let Some(&index) = self.indices.get(name) {
            self.spans[index] = self.spans[index].take().or_else(|| span.cloned());
            return index;
        }
        let index = self.all.len();
        self.indices.insert(name.to_owned(), index);
        self.all.push(name.to_owned());
        self.spans.push(span.cloned());
        index
    }
}

/// Checks the expressions of a family when the names they may use are not known.
fn check_expressions<'t>(
    template: Option<&Template>,
    lets: Lets<'_, 't>,
    fields: &Fields<'_, 't>,
    parser: &mut TomlParser<'t>,
) {
    for (name, span, value) in lets {
        linkage_format::check_identifier(name, span, parser);
        if let Some(expression) = parser.parameter_expression(value, name, kind_of(template, name)) {
            let compiled = expression.compile(&Scope::default(), Kind::Number);
            parser.ok_or_report(value, compiled);
        }
    }
    read_curve_expressions(fields, &Family::scope(&[], false), parser);
}

/// The expressions of a family about its curves.
struct CurveExpressions {
    filter: Option<CompiledExpression>,
    sort: Option<CompiledExpression>,
    /// The caption and the note.
    captions: [Option<Caption>; 2],
    /// Whether all that are given could be read.
    are_complete: bool,
}

/// Reads `where`, `sort`, `caption` and `note`.
fn read_curve_expressions<'t>(fields: &Fields<'_, 't>, scope: &Scope, parser: &mut TomlParser<'t>) -> CurveExpressions {
    let filter = fields.get("where").and_then(|value| read_filter(value, scope, parser));
    let sort = fields.get("sort").filter(|value| !uses_text_measure(value, parser) && !states_direction(value, parser));
    let sort = sort.and_then(|value| parser.numeric_expression(value, scope));
    let words: Vec<&str> = Family::word_measure_names().collect();
    let captions =
        ["caption", "note"].map(|key| fields.get(key).and_then(|value| parser.caption(value, scope, &words)));
    let is_read = [filter.is_some(), sort.is_some(), captions[0].is_some(), captions[1].is_some()];
    let keys = ["where", "sort", "caption", "note"];
    let are_complete = keys.into_iter().zip(is_read).all(|(key, is_read)| is_read == fields.get(key).is_some());
    CurveExpressions { filter, sort, captions, are_complete }
}

/// Whether a condition or a sort key uses a measure whose value is a word; reports it.
pub(crate) fn uses_text_measure<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> bool {
    let Some(expression) = value.get_ref().as_str().and_then(|text| Expression::parse(text).ok()) else { return false };
    let is_boolean = |word: &&str| BOOLEANS.iter().any(|boolean| boolean.name == *word);
    let mut words = Family::word_measure_names().filter(|word| !is_boolean(word));
    // A comparison with a word has a remedy of its own.
    let is_compared = value.get_ref().as_str().is_some_and(|text| parse_condition(text).is_err());
    let word = words.find(|word| !is_compared && expression.names().iter().any(|name| name == word));
    if let Some(word) = word {
        let problem = Problem::error(value.span(), format!("`{word}` is a word, not a number"));
        parser.report(problem.with_help(
            "compare classes by `is_crank_rocker` and the like, and others by a number such as `symmetry_residual`",
        ));
    }
    word.is_some()
}

/// Whether a sort key ends with a word for the direction, as in SQL; reports it.
pub(crate) fn states_direction<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> bool {
    let text = value.get_ref().as_str();
    let Some((key, word)) = text.and_then(|text| text.trim().rsplit_once([' ', '\t'])) else {
        return false;
    };
    let Ok(expression) = Expression::parse(key) else { return false };
    let help = match word.to_ascii_lowercase().as_str() {
        "asc" | "ascending" => format!("leave it out: \"{}\"", key.trim()),
        "desc" | "descending" if expression.as_name().is_some() => format!("write \"-{}\"", key.trim()),
        "desc" | "descending" => format!("write \"-({})\"", key.trim()),
        _ => return false,
    };
    let problem = Problem::error(value.span(), format!("a sort key is ascending, and `{word}` is no part of it"));
    parser.report(problem.with_help(help));
    true
}

/// Reads `where`.
pub(crate) fn read_filter<'t>(
    value: &TomlValue<'t>,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<CompiledExpression> {
    if !value.get_ref().is_str() {
        let problem = Problem::error(value.span(), "`where` must be a condition in quotes");
        parser.report(problem.with_help("write where = \"a < 5 and is_crank_rocker\""));
        return None;
    }
    if uses_text_measure(value, parser) {
        return None;
    }
    let parsed = parse_condition(value.get_ref().as_str()?);
    let expression = parser.ok_or_report(value, parsed)?;
    let compiled = expression.compile(scope, Kind::Boolean);
    parser.ok_or_report(value, compiled)
}

/// Sorts expressions so that each comes after those it uses; reports a cycle.
fn in_dependency_order(
    sources: Vec<(usize, Expression, Span)>,
    names: &[String],
    scope: &Scope,
    parser: &mut TomlParser,
) -> Option<Vec<(usize, CompiledExpression)>> {
    // Each was compiled against the same names when it was read.
    let compile = |(slot, expression, _): &(usize, Expression, Span)| {
        Some((*slot, expression.compile(scope, Kind::Number).ok()?))
    };
    let compiled = sources.iter().map(compile).collect::<Option<Vec<_>>>()?;
    match sort_by_dependency(compiled) {
        Ok(derived) => Some(derived),
        Err(cycle) => {
            let words: Vec<String> = cycle.iter().map(|&slot| format!("`{}`", names[slot])).collect();
            let span = sources.iter().find(|(slot, ..)| *slot == cycle[0]).map(|source| source.2.clone());
            let problem = Problem::error(span.unwrap_or_default(), format!("{} is derived from itself", words[0]));
            parser.report(problem.with_help(format!("the cycle is {}: give one of them a value", words.join(" -> "))));
            None
        }
    }
}
