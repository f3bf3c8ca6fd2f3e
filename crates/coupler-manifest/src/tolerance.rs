//! The tolerances of `check`.

use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::problem::Problem;

/// How much a recorded value may differ from the value computed now.
///
/// The same manifest gives the same bytes on any machine, so no difference is expected. The defaults allow for the
/// rounding of a future version that changes the order of operations. Positions are accurate to 2e-15 of a curve's
/// size, less than a thousandth of the default; measures are found by iterations that magnify rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// How far a point may move, in the manifest's unit of length.
    pub atol: f64,
    /// How far a point may move, relative to the size of its curve: the diagonal of its bounding box. The greater of
    /// this and [`atol`](Tolerances::atol) applies.
    pub rtol: f64,
    /// How much a measure may differ, relative to its value; an angle also relative to one degree, and a coordinate
    /// relative to the curve's size.
    pub measure_rtol: f64,
}

impl Default for Tolerances {
    fn default() -> Tolerances {
        Tolerances { atol: 0.0, rtol: 1e-12, measure_rtol: 1e-9 }
    }
}

/// Tolerances of which only some are given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartialTolerances {
    /// [`Tolerances::atol`].
    pub atol: Option<f64>,
    /// [`Tolerances::rtol`].
    pub rtol: Option<f64>,
    /// [`Tolerances::measure_rtol`].
    pub measure_rtol: Option<f64>,
}

impl PartialTolerances {
    /// Fills in the missing tolerances from others.
    pub fn or(self, other: PartialTolerances) -> PartialTolerances {
        PartialTolerances {
            atol: self.atol.or(other.atol),
            rtol: self.rtol.or(other.rtol),
            measure_rtol: self.measure_rtol.or(other.measure_rtol),
        }
    }

    /// Fills in the missing tolerances with the defaults.
    pub fn or_defaults(self) -> Tolerances {
        let Tolerances { atol, rtol, measure_rtol } = Tolerances::default();
        Tolerances {
            atol: self.atol.unwrap_or(atol),
            rtol: self.rtol.unwrap_or(rtol),
            measure_rtol: self.measure_rtol.unwrap_or(measure_rtol),
        }
    }
}

/// The `[check]` table, for all families.
pub(crate) static CHECK: TableSchema = TableSchema::new("[check]", &KEYS);

/// The `check` table of a family.
pub(crate) static FAMILY_CHECK: TableSchema = TableSchema::new("`check`", &KEYS);

static KEYS: [KeySchema; 3] = [
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
];

/// Reads the tolerances of a table.
pub(crate) fn read<'t>(
    value: Option<&TomlValue<'t>>,
    table: &'static TableSchema,
    parser: &mut TomlParser<'t>,
) -> PartialTolerances {
    let fields = value.and_then(|value| Fields::from_value(value, table, parser));
    let Some(fields) = fields else { return PartialTolerances::default() };
    let mut tolerance = |key: &str| {
        let value = fields.get(key)?;
        let number = parser.constant(value)?;
        if (0.0..).contains(&number) {
            return Some(number);
        }
        let problem = Problem::error(value.span(), format!("`{key}` must not be negative, found {number}"));
        parser.report(problem.with_help("give 0 or more"));
        None
    };
    PartialTolerances { atol: tolerance("atol"), rtol: tolerance("rtol"), measure_rtol: tolerance("measure_rtol") }
}
