//! Reads typed values from TOML and collects the problems found.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::entries::{entry_around, unclosed_bracket};
use super::schema::{TableSchema, ValueSchema};
use super::syntax_errors::syntax_problem;
use crate::expression::{self, Caption, CompiledExpression, Expression, Kind, Scope};
use crate::measure::Measure;
use crate::problem::{Problem, Span};

/// A TOML value and its span in the text.
pub type TomlValue<'t> = Spanned<DeValue<'t>>;

/// The most problems of a text that are reported; a text with more is not what it was meant to be.
pub const MAX_PROBLEMS: usize = 500;

/// Parses a TOML text and collects its problems, at most [`MAX_PROBLEMS`].
pub struct TomlParser<'t> {
    text: &'t str,
    problems: Vec<Problem>,
    /// The number of problems, including those that are not collected.
    problem_count: usize,
    /// The entries with a syntax error.
    broken_entries: Vec<Span>,
    /// Whether it is not known which names expressions may use.
    ignores_unknown_names: bool,
    /// The tables of the document, among which those are looked for that have a key which is in another.
    root: Option<&'static TableSchema>,
}

impl<'t> TomlParser<'t> {
    /// A parser of a text.
    pub fn new(text: &'t str) -> TomlParser<'t> {
        TomlParser {
            text,
            problems: Vec::new(),
            problem_count: 0,
            broken_entries: Vec::new(),
            ignores_unknown_names: false,
            root: None,
        }
    }

    /// What is read where it is not known which names expressions may use: other errors in them are reported.
    pub fn with_unknown_names<T>(&mut self, read: impl FnOnce(&mut TomlParser<'t>) -> T) -> T {
        let before = std::mem::replace(&mut self.ignores_unknown_names, true);
        let read = read(self);
        self.ignores_unknown_names = before;
        read
    }

    /// The same of a document with these tables.
    pub fn with_root(self, root: &'static TableSchema) -> TomlParser<'t> {
        TomlParser { root: Some(root), ..self }
    }

    /// The table of the document that has a key, by its name in messages.
    pub(super) fn table_of(&self, key: &str) -> Option<&'static str> {
        let tables = self.root?.keys.iter().filter_map(|key| match &key.value {
            ValueSchema::Table(table) | ValueSchema::List(ValueSchema::Table(table), _) => Some(*table),
            _ => None,
        });
        tables.into_iter().find(|table| table.key_names().contains(&key)).map(|table| table.display_name)
    }

    /// The document; after a syntax error, as much of it as can be recovered. Of the syntax errors in one entry, a key
    /// and its value, only the first is reported: others, and what else seems wrong with the entry, follow from it.
    pub fn parse_document(&mut self) -> TomlValue<'t> {
        // A byte order mark is not part of the document, but spans count from it.
        let (table, mut errors) = DeTable::parse_recoverable(self.text);
        errors.sort_by_key(|error| error.span().map_or(0, |span| span.start));
        if let Some(open) = errors.first().and_then(|_| unclosed_bracket(self.text)) {
            let bracket = &self.text[open..open + 1];
            let message = format!("invalid TOML: this `{bracket}` is not closed before the next entry");
            let close = if bracket == "[" { "]" } else { "}" };
            self.report(Problem::error(open..open + 1, message).with_help(format!("add the `{close}`")));
            // Nothing after it can be read, and some of it may have been taken for a part of the table.
            let before = &self.text[..open];
            let table = before.rfind("\n[").map_or(0, |at| at + 1);
            self.broken_entries.push(table..self.text.len() + 1);
            errors.clear();
        }
        for error in errors {
            let span = error.span().unwrap_or(0..0);
            let entry = entry_around(self.text, span.start);
            self.report(syntax_problem(self.text, span, error.message()));
            self.broken_entries.push(entry);
        }
        if self.has_syntax_error() {
            // What seems to be missing in the whole document may be in such an entry.
            self.broken_entries.push(0..1);
        }
        let span = table.span();
        Spanned::new(span, DeValue::Table(table.into_inner()))
    }

    /// Whether the text has a syntax error: what seems to be missing may be in an entry that could not be read.
    pub fn has_syntax_error(&self) -> bool {
        !self.broken_entries.is_empty()
    }

    /// Adds a problem, unless it is in an entry with a syntax error; parsing continues.
    pub fn report(&mut self, problem: Problem) {
        if self.broken_entries.iter().any(|entry| entry.contains(&problem.span.start)) {
            return;
        }
        self.problem_count += 1;
        if self.problems.len() < MAX_PROBLEMS {
            self.problems.push(problem);
        }
    }

    /// The number of problems reported so far.
    pub fn problem_count(&self) -> usize {
        self.problem_count
    }

    /// Whether an error has been reported, and not only warnings.
    pub fn has_error(&self) -> bool {
        self.problem_count > self.problems.len() || self.problems.iter().any(Problem::is_error)
    }

    /// The problems reported; if there are more than [`MAX_PROBLEMS`], the last states how many more.
    pub fn into_problems(self) -> Vec<Problem> {
        let mut problems = self.problems;
        if self.problem_count > problems.len() {
            let message = format!("there are {} more problems", self.problem_count - problems.len());
            let end = self.text.len();
            problems.push(Problem::error(end..end, message).with_help("correct those above first"));
        }
        problems
    }

    /// Reports a value of another type than expected.
    pub(super) fn report_mismatch(&mut self, value: &TomlValue, expected: &str, help: &str) {
        let found = match value.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "a boolean",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.report(Problem::error(value.span(), format!("expected {expected}, found {found}")).with_help(help));
    }

    /// A string on one line: line breaks and tabs become spaces. Other control characters, which cannot be written to
    /// an SVG, are a problem.
    pub fn text(&mut self, value: &TomlValue<'t>) -> Option<String> {
        let DeValue::String(text) = value.get_ref() else {
            self.report_mismatch(value, "a string", "put it in quotes");
            return None;
        };
        let is_forbidden = |&(at, c): &(usize, char)| {
            c.is_control() && !matches!(c, '\t' | '\n') && !text[at..].starts_with("\r\n")
                || matches!(c, '\u{fffe}' | '\u{ffff}')
        };
        if let Some((at, c)) = text.char_indices().find(is_forbidden) {
            let span = self.span_in_string(value, at..at + c.len_utf8());
            let message = format!("a string cannot contain the control character U+{:04X}", c as u32);
            self.report(Problem::error(span, message).with_help("remove it; a line break or a tab counts as a space"));
            return None;
        }
        Some(text.replace("\r\n", " ").replace(['\n', '\t'], " "))
    }

    /// The meaning of one of several words.
    pub fn word<T: Copy>(&mut self, value: &TomlValue<'t>, words: &[(&str, T)]) -> Option<T> {
        let text = self.text(value)?;
        if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == text) {
            return Some(*meaning);
        }
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let help = format!("it can be {}", known.iter().map(|w| format!("\"{w}\"")).collect::<Vec<_>>().join(" or "));
        self.report(
            Problem::error(value.span(), format!("`{text}` is not one of the words allowed here")).with_help(help),
        );
        None
    }

    /// A list.
    pub fn list<'v>(&mut self, value: &'v TomlValue<'t>) -> Option<&'v [TomlValue<'t>]> {
        match value.get_ref() {
            DeValue::Array(list) => Some(list),
            _ => {
                /// The most characters of a value that is repeated.
                const MAX_REPEATED: usize = 60;
                let written = self.source_text(value);
                let is_short = written.len() <= MAX_REPEATED && !written.contains(['\n', '\r']);
                let help = format!("put it in brackets: [{}]", if is_short { written } else { "…" });
                self.report_mismatch(value, "a list", &help);
                None
            }
        }
    }

    /// A list of two values, of which the help for other lists has an example.
    pub fn pair<'v>(&mut self, value: &'v TomlValue<'t>, example: &str) -> Option<[&'v TomlValue<'t>; 2]> {
        let help = format!("write them like {example}");
        match value.get_ref().as_array().map(|list| &list[..]) {
            Some([a, b]) => return Some([a, b]),
            Some(list) => {
                let problem = Problem::error(value.span(), format!("expected two values, found {}", list.len()));
                self.report(problem.with_help(help));
            }
            None => self.report_mismatch(value, "a list of two values", &help),
        }
        None
    }

    /// A whole number from `least` to `most`.
    pub fn integer(&mut self, value: &TomlValue<'t>, least: usize, most: usize) -> Option<usize> {
        let help = format!("give a whole number from {least} to {most}");
        let number = match value.get_ref() {
            DeValue::Integer(n) => i128::from_str_radix(n.as_str(), n.radix()).ok(),
            // Integers and floats are alike: 5.0 is 5.
            DeValue::Float(x) => x.as_str().parse().ok().filter(|x: &f64| x.fract() == 0.0).map(|x| x as i128),
            _ => {
                self.report_mismatch(value, "a whole number", &help);
                return None;
            }
        };
        let count = number.and_then(|n| usize::try_from(n).ok()).filter(|n| (least..=most).contains(n));
        if count.is_none() {
            let problem = Problem::error(value.span(), format!("invalid value `{}`", self.source_text(value)));
            self.report(problem.with_help(help));
        }
        count
    }

    /// A number, or an expression in quotes.
    pub fn expression(&mut self, value: &TomlValue<'t>) -> Option<Expression> {
        match value.get_ref() {
            DeValue::Integer(_) | DeValue::Float(_) => self.literal(value).map(Expression::constant),
            DeValue::String(text) => {
                let parsed = Expression::parse(text);
                self.ok_or_report(value, parsed)
            }
            _ => {
                self.report_mismatch(
                    value,
                    "a number or an expression",
                    "write a number, or an expression in quotes: \"2 * a\"",
                );
                None
            }
        }
    }

    /// A number, or a numeric expression over the names of `scope`.
    pub fn numeric_expression(&mut self, value: &TomlValue<'t>, scope: &Scope) -> Option<CompiledExpression> {
        let expression = self.expression(value)?;
        let compiled = expression.compile(scope, Kind::Number);
        self.ok_or_report(value, compiled)
    }

    /// A number, or an expression without names.
    pub fn constant(&mut self, value: &TomlValue<'t>) -> Option<f64> {
        let compiled = self.numeric_expression(value, &Scope::default())?;
        self.require_finite(value, compiled.evaluate(|_| f64::NAN))
    }

    /// A boolean.
    pub fn boolean(&mut self, value: &TomlValue<'t>) -> Option<bool> {
        let boolean = value.get_ref().as_bool();
        if boolean.is_none() {
            self.report_mismatch(value, "a boolean", "write `true` or `false` without quotes");
        }
        boolean
    }

    /// A caption with expressions over `scope`; each of `words` may be used as an expression by itself.
    pub fn caption(&mut self, value: &TomlValue<'t>, scope: &Scope, words: &[&str]) -> Option<Caption> {
        let text = self.text(value)?;
        let (caption, mut errors) = Caption::parse_partly(&text);
        for (expression, start) in caption.expressions() {
            let is_word = expression.as_name().is_some_and(|name| words.contains(&name));
            if self.problem_count + errors.len() >= MAX_PROBLEMS {
                break;
            }
            if let (Err(error), false) = (expression.compile(scope, Kind::Number), is_word) {
                errors.extend(error.moved_by(start).into_each());
            }
        }
        errors.sort_by_key(|error| error.span.start);
        for mut error in errors.iter().cloned() {
            let name = &text[error.span.clone()];
            if error.is_unknown_name && Measure::find(name).is_some() {
                error.help = format!("`{name}` is a measure: write it in the caption of a [[family]]");
            }
            error.span = unfold_span(value, error.span);
            self.ok_or_report::<()>(value, Err(error));
        }
        errors.is_empty().then_some(caption)
    }

    /// The value of a TOML number.
    fn literal(&mut self, value: &TomlValue<'t>) -> Option<f64> {
        let number = match value.get_ref() {
            DeValue::Integer(n) if n.radix() == 10 => n.as_str().parse().ok(),
            DeValue::Integer(n) => i128::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
            DeValue::Float(x) => x.as_str().parse().ok(),
            _ => None,
        };
        self.require_finite(value, number.unwrap_or(f64::NAN))
    }

    /// The number if it is finite, or else a problem at `value`.
    pub fn require_finite(&mut self, value: &TomlValue<'t>, number: f64) -> Option<f64> {
        if number.is_finite() {
            return Some(number);
        }
        let problem = Problem::error(value.span(), format!("its value is {number}, which is not a finite number"));
        self.report(problem.with_help("every value must be finite"));
        None
    }

    /// The decimal digits of a number as written; `None` for an expression.
    pub fn decimal_digits(&self, value: &TomlValue<'t>) -> Option<&str> {
        match value.get_ref() {
            DeValue::Integer(_) | DeValue::Float(_) => Some(self.source_text(value)),
            DeValue::String(text) if text.parse::<f64>().is_ok() => {
                Some(self.source_text(value).trim_matches(['"', '\'']))
            }
            _ => None,
        }
    }

    /// A string, or a number as it is written.
    pub fn value_text(&self, value: &TomlValue<'t>) -> String {
        value.get_ref().as_str().unwrap_or_else(|| self.source_text(value)).to_owned()
    }

    /// The source text of a value.
    pub(super) fn source_text(&self, value: &TomlValue<'t>) -> &'t str {
        self.text.get(value.span()).unwrap_or_default()
    }

    /// The result; errors are reported at their places inside the string `value`.
    pub fn ok_or_report<T>(&mut self, value: &TomlValue<'t>, result: Result<T, expression::Error>) -> Option<T> {
        match result {
            Ok(result) => Some(result),
            Err(error) => {
                for error in error.into_each() {
                    // The name may be given its value in an entry that could not be read.
                    if !(error.is_unknown_name && (self.has_syntax_error() || self.ignores_unknown_names)) {
                        let problem = error.into_problem(|inner| self.span_in_string(value, inner));
                        self.report(problem);
                    }
                }
                None
            }
        }
    }

    /// The span in the text of a part of an expression in a string.
    pub fn expression_span(&self, value: &TomlValue<'t>, inner: Option<Span>) -> Span {
        inner.map_or_else(|| value.span(), |inner| self.span_in_string(value, inner))
    }

    /// The span in the text of a part of a string; that of the whole string if it is written with escapes.
    fn span_in_string(&self, value: &TomlValue<'t>, inner: Span) -> Span {
        let whole = value.span();
        let DeValue::String(content) = value.get_ref() else { return whole };
        let source = self.source_text(value);
        let quotes = source.len().saturating_sub(content.len()) / 2;
        let is_quoted = matches!(quotes, 1 | 3) && source.get(quotes..source.len() - quotes) == Some(content.as_ref());
        if is_quoted {
            let start = whole.start + quotes;
            start + inner.start..start + inner.end.max(inner.start)
        } else {
            whole
        }
    }
}

/// Maps a span in the result of [`TomlParser::text`], where a line break of two characters is one, to a span in the
/// string.
fn unfold_span(value: &TomlValue, span: Span) -> Span {
    let DeValue::String(content) = value.get_ref() else { return span };
    let unfold = |at: usize| {
        let ends = content.match_indices("\r\n").zip(0..).take_while(|((end, _), before)| end - before < at);
        at + ends.count()
    };
    unfold(span.start)..unfold(span.end)
}
