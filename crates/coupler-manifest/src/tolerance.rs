//! The tolerances of `check`.

use std::collections::BTreeMap;

use crate::name_list::name_indices;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::measure::{self, Measure};
use coupler_curves::problem::{Problem, suggestion};

/// How much a recorded value may differ from the value computed now.
///
/// The same manifest gives the same bytes on any machine, so no difference is expected. The defaults allow for the
/// rounding of a future version that changes the order of operations. Positions are accurate to 2e-15 of a curve's
/// size, less than a thousandth of the default; measures are found by iterations that magnify rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerances {
    /// How far a point may move, in the manifest's unit of length.
    pub atol: f64,
    /// How far a point may move, relative to the size of its curve: the diagonal of its bounding box. The greater of
    /// this and [`atol`](Tolerances::atol) applies.
    pub rtol: f64,
    /// How much a measure may differ, relative to its value, or to what it is a part of: a length to the curve's size, an angle to one degree.
    pub measure_rtol: f64,
    /// The same of single measures, and columns of `points.csv`, by their names; infinite for those that are not compared.
    pub by_name: BTreeMap<String, f64>,
}

impl Tolerances {
    /// How much a measure or a column may differ.
    pub fn of(&self, name: &str) -> f64 {
        self.by_name.get(name).copied().unwrap_or(self.measure_rtol)
    }
}

impl Default for Tolerances {
    fn default() -> Tolerances {
        Tolerances { atol: 0.0, rtol: 1e-12, measure_rtol: 1e-9, by_name: BTreeMap::new() }
    }
}

/// Tolerances of which only some are given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartialTolerances {
    /// [`Tolerances::atol`].
    pub atol: Option<f64>,
    /// [`Tolerances::rtol`].
    pub rtol: Option<f64>,
    /// [`Tolerances::measure_rtol`].
    pub measure_rtol: Option<f64>,
    /// [`Tolerances::by_name`].
    pub by_name: BTreeMap<String, f64>,
}

/// The names of the measures and the columns that can have a tolerance of their own.
pub fn tolerated_names() -> Vec<&'static str> {
    let measures = measure::ALL.iter().flat_map(Measure::names);
    measures.chain(measure::COLUMNS.iter().map(|column| column.name)).collect()
}

impl PartialTolerances {
    /// Fills in the missing tolerances from others.
    pub fn or(self, other: PartialTolerances) -> PartialTolerances {
        PartialTolerances {
            atol: self.atol.or(other.atol),
            rtol: self.rtol.or(other.rtol),
            measure_rtol: self.measure_rtol.or(other.measure_rtol),
            by_name: other.by_name.into_iter().chain(self.by_name).collect(),
        }
    }

    /// Fills in the missing tolerances with the defaults.
    pub fn or_defaults(self) -> Tolerances {
        let Tolerances { atol, rtol, measure_rtol, .. } = Tolerances::default();
        Tolerances {
            atol: self.atol.unwrap_or(atol),
            rtol: self.rtol.unwrap_or(rtol),
            measure_rtol: self.measure_rtol.unwrap_or(measure_rtol),
            by_name: self.by_name,
        }
    }
}

/// The `[check]` table, for all families.
pub(crate) static CHECK: TableSchema = TableSchema::new("[check]", &KEYS);

/// The `check` table of a family.
pub(crate) static FAMILY_CHECK: TableSchema = TableSchema::new("`check`", &KEYS);

static KEYS: [KeySchema; 5] = [
    KeySchema::new("atol", ValueSchema::InRange([0.0, f64::MAX]), "How far a point may move, in units of length.")
        .with_default(|| Tolerances::default().atol.to_string()),
    KeySchema::new(
        "rtol",
        ValueSchema::InRange([0.0, f64::MAX]),
        "How far a point may move, relative to the size of its curve.",
    )
    .with_default(|| Tolerances::default().rtol.to_string()),
    KeySchema::new(
        "measure_rtol",
        ValueSchema::InRange([0.0, f64::MAX]),
        "How much a measure may differ, relative to its value.",
    )
    .with_default(|| Tolerances::default().measure_rtol.to_string()),
    KeySchema::new(
        "measures",
        ValueSchema::Map(&ValueSchema::InRange([0.0, f64::MAX])),
        "How much single measures or columns may differ, by their names, in place of `measure_rtol`.",
    ),
    KeySchema::new(
        "ignore",
        ValueSchema::Set(&ValueSchema::Text, [0, usize::MAX]),
        "Measures and columns that are not compared.",
    ),
];

/// Reads the tolerances of a table.
pub(crate) fn read<'t>(
    value: Option<&TomlValue<'t>>,
    table: &'static TableSchema,
    parser: &mut TomlParser<'t>,
) -> PartialTolerances {
    let fields = value.and_then(|value| Fields::from_value(value, table, parser));
    let Some(fields) = fields else { return PartialTolerances::default() };
    let mut tolerance = |key: &str| not_negative(fields.get(key)?, key, parser);
    let [atol, rtol, measure_rtol] = ["atol", "rtol", "measure_rtol"].map(&mut tolerance);
    let known = tolerated_names();
    let mut by_name = BTreeMap::new();
    let table = fields.get("measures").and_then(|value| Fields::with_any_keys(value, "`measures`", parser));
    for (name, span, value) in table.iter().flat_map(Fields::entries) {
        if !known.contains(&name) {
            let problem = Problem::error(span, format!("there is no measure or column `{}`", name.escape_debug()));
            parser.report(problem.with_help(suggestion(name, &known)));
        } else if let Some(tolerance) = not_negative(value, name, parser) {
            by_name.insert(name.to_owned(), tolerance);
        }
    }
    if let Some(value) = fields.get("ignore") {
        let ignored = name_indices(value, "measure or column", Some(&known), parser).unwrap_or_default();
        by_name.extend(ignored.into_iter().map(|index| (known[index].to_owned(), f64::INFINITY)));
    }
    PartialTolerances { atol, rtol, measure_rtol, by_name }
}

/// Reads a number that is not negative.
fn not_negative<'t>(value: &TomlValue<'t>, name: &str, parser: &mut TomlParser<'t>) -> Option<f64> {
    let number = parser.constant(value)?;
    if number >= 0.0 {
        return Some(number);
    }
    let problem = Problem::error(value.span(), format!("`{name}` must not be negative, found {number}"));
    parser.report(problem.with_help("give 0 or more"));
    None
}
