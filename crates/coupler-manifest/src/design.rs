//! Reads the `design` of a family: wishes, and as cells the linkages that meet them.

use crate::files::{CaseTable, FileProblem, FileReader, RowPlaces};
use crate::wishes::{DesignRequest, EFFORTS, MAX_DESIGNS, WishPlace, WishTexts};
use coupler_curves::linkage_format::{
    Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema, one_or_more, words,
};
use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::Template;

const TEXTS: ValueSchema = ValueSchema::OneOrMore(&ValueSchema::Text, 0);

/// The `design` table of a family.
pub(crate) static DESIGN: TableSchema = TableSchema::new(
    "`design`",
    &[
        KeySchema::new(
            "where",
            ValueSchema::Text,
            "Conditions on measures and parameters that the linkages meet, as in \"output_swing_deg == 60\".",
        ),
        KeySchema::new("maximize", TEXTS, "Expressions that are to be as great as possible."),
        KeySchema::new("minimize", TEXTS, "Expressions that are to be as small as possible."),
        KeySchema::new("range", TEXTS, "Ranges of parameters, and steps of their values, as in \"r = 20..60 by 1\"."),
        KeySchema::new("fix", TEXTS, "Parameters that keep their default, as in \"s\", or a value, as in \"p = 100\"."),
        KeySchema::new("max_link", ValueSchema::Positive, "The greatest distance of two joints of a link."),
        KeySchema::new("best", ValueSchema::Integer([1, MAX_DESIGNS]), "The most linkages, the best first."),
        KeySchema::new("effort", ValueSchema::Word(|| words(&EFFORTS)), "How much is tried."),
        KeySchema::new("seed", ValueSchema::Integer([0, MAX_SEED]), "A number that changes which linkages are tried."),
    ],
);

/// The greatest whole number of TOML.
const MAX_SEED: usize = i64::MAX as usize;

/// Reads wishes for a linkage, and what meets them: the cases, and whether nothing was wrong. In place of cases that are not known there is
/// one without values, so that names and expressions of the family can be checked. `name` is what they are called.
pub(crate) fn read<'t>(
    value: &TomlValue<'t>,
    name: &str,
    template: Option<&Template>,
    files: FileReader,
    parser: &mut TomlParser<'t>,
) -> Option<(CaseTable, bool)> {
    let request = read_request(value, name, parser);
    let template = template?;
    let unknown = || CaseTable {
        names: template.parameters.iter().map(|parameter| parameter.name.clone()).collect(),
        values: vec![f64::NAN; template.parameters.len()],
        count: 1,
        digest: String::new(),
        rows: RowPlaces::Numbered,
    };
    let (Some((request, places)), Some(files)) = (request, files) else {
        if files.is_none() {
            let problem =
                Problem::error(value.span(), "the cases are those that a search finds, and none is made here");
            let help = "write them in the manifest: `coupler-atlas design` with --toml prints them";
            parser.report(problem.with_help(help));
        }
        return Some((unknown(), false));
    };
    let mut report = |place, problem: FileProblem| parser.report(problem.at(places.span(place)));
    let found = files.designs(template, &request, &mut report);
    Some(found.map_or_else(|| (unknown(), false), |table| (table, true)))
}

/// The places of wishes in a manifest.
struct Places {
    table: Span,
    condition: Option<Span>,
    /// Those of `maximize`, `minimize`, `range` and `fix`.
    lists: [Vec<Span>; 4],
}

impl Places {
    fn span(&self, place: WishPlace) -> Span {
        let [maximize, minimize, range, fix] = &self.lists;
        let span = match place {
            WishPlace::All => None,
            WishPlace::Condition => self.condition.as_ref(),
            WishPlace::Maximize(k) => maximize.get(k),
            WishPlace::Minimize(k) => minimize.get(k),
            WishPlace::Range(k) => range.get(k),
            WishPlace::Fix(k) => fix.get(k),
        };
        span.unwrap_or(&self.table).clone()
    }
}

/// Reads the keys of the table; `None` if one cannot be read.
fn read_request<'t>(value: &TomlValue<'t>, name: &str, parser: &mut TomlParser<'t>) -> Option<(DesignRequest, Places)> {
    let fields = Fields::from_value(value, &DESIGN, parser)?;
    let mut all_read = true;
    let condition = optional(fields.get("where"), |value| Some((parser.text(value)?, value.span())));
    let mut texts = |key: &str, parser: &mut TomlParser<'t>| -> (Vec<String>, Vec<Span>) {
        let items = fields.get(key).map(one_or_more).unwrap_or_default();
        let read: Vec<_> = items.iter().filter_map(|item| Some((parser.text(item)?, item.span()))).collect();
        all_read &= read.len() == items.len();
        read.into_iter().unzip()
    };
    let (maximize, maximize_places) = texts("maximize", parser);
    let (minimize, minimize_places) = texts("minimize", parser);
    let (range, range_places) = texts("range", parser);
    let (fix, fix_places) = texts("fix", parser);
    let max_link = fields.get("max_link").map_or(Some(f64::INFINITY), |value| positive(value, parser));
    let best = optional(fields.get("best"), |value| parser.integer(value, 1, MAX_DESIGNS));
    let effort = optional(fields.get("effort"), |value| parser.word(value, &EFFORTS));
    let seed = optional(fields.get("seed"), |value| parser.integer(value, 0, MAX_SEED));
    let (condition, max_link, best, effort, seed) = (condition?, max_link?, best?, effort?, seed?);
    let (condition, condition_place) = condition.unzip();
    let request = DesignRequest {
        name: name.to_owned(),
        wishes: WishTexts { condition, maximize, minimize, range, fix },
        max_link,
        best,
        effort,
        seed: seed.map(|seed| seed as u64),
        is_searched: !parser.has_error(),
    };
    let lists = [maximize_places, minimize_places, range_places, fix_places];
    let places = Places { table: value.span(), condition: condition_place, lists };
    all_read.then_some((request, places))
}

/// What is read from a value, if there is one; `None` if it cannot be read.
fn optional<V, T>(value: Option<V>, read: impl FnOnce(V) -> Option<T>) -> Option<Option<T>> {
    match value {
        None => Some(None),
        Some(value) => read(value).map(Some),
    }
}

/// Reads a number that is greater than 0.
fn positive<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<f64> {
    let number = parser.constant(value)?;
    if number > 0.0 {
        return Some(number);
    }
    let problem = Problem::error(value.span(), format!("`max_link` is {number}, and must be more than 0"));
    parser.report(problem.with_help("give a length, as in max_link = 250"));
    None
}
