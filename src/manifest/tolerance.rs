use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::problem::Problem;

/// By how much a recorded value may differ from the one that comes out now.
///
/// The same manifest gives the same bytes on any machine, so that nothing has to be allowed for; what is allowed by
/// default is what rounding may do if the order of operations is changed one day. Positions are within 2e-15 of a curve's
/// size of the true ones, so that a thousandth of the default is more than that; measures are found by iterations that
/// magnify it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// How far a point may move, in the manifest's unit.
    pub atol: f64,
    /// How far a point may move, by the size of its curve: the diagonal of the box round it. The greater of both counts.
    pub rtol: f64,
    /// How much a measure may differ, by its own size; of an angle, also by one degree, and of a place by the curve's size.
    pub measure_rtol: f64,
}

impl Default for Tolerances {
    fn default() -> Tolerances {
        Tolerances { atol: 0.0, rtol: 1e-12, measure_rtol: 1e-9 }
    }
}

/// Tolerances of which some are given, and the others are those of somebody else.
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
    /// These, and for the others some more.
    pub fn or(self, others: PartialTolerances) -> PartialTolerances {
        PartialTolerances {
            atol: self.atol.or(others.atol),
            rtol: self.rtol.or(others.rtol),
            measure_rtol: self.measure_rtol.or(others.measure_rtol),
        }
    }

    /// These, and the defaults.
    pub fn or_defaults(self) -> Tolerances {
        let Tolerances { atol, rtol, measure_rtol } = Tolerances::default();
        Tolerances {
            atol: self.atol.unwrap_or(atol),
            rtol: self.rtol.unwrap_or(rtol),
            measure_rtol: self.measure_rtol.unwrap_or(measure_rtol),
        }
    }
}

/// Tolerances for all families.
pub(super) static CHECK: TableSchema = TableSchema::new("[check]", &KEYS);

/// Tolerances of a family.
pub(super) static FAMILY_CHECK: TableSchema = TableSchema::new("`check`", &KEYS);

static KEYS: [KeySchema; 3] = [
    KeySchema::new("atol", ValueSchema::InRange([0.0, f64::MAX]), "How far a point may move, in units of length.")
        .with_default("0"),
    KeySchema::new(
        "rtol",
        ValueSchema::InRange([0.0, f64::MAX]),
        "How far a point may move, by the size of its curve.",
    )
    .with_default("1e-12"),
    KeySchema::new(
        "measure_rtol",
        ValueSchema::InRange([0.0, f64::MAX]),
        "How much a measure may differ, by its own size.",
    )
    .with_default("1e-9"),
];

/// The tolerances of a table.
pub(super) fn read<'t>(
    value: Option<&TomlValue<'t>>,
    table: &'static TableSchema,
    reader: &mut TomlParser<'t>,
) -> PartialTolerances {
    let fields = value.and_then(|value| Fields::from_value(value, table, reader));
    let Some(fields) = fields else { return PartialTolerances::default() };
    let mut tolerance = |key: &str| {
        let value = fields.get(key)?;
        let number = reader.constant(value)?;
        if (0.0..).contains(&number) {
            return Some(number);
        }
        let problem = Problem::error(value.span(), format!("`{key}` is {number}, and less than nothing"));
        reader.report(problem.with_help("give 0 or more"));
        None
    };
    PartialTolerances { atol: tolerance("atol"), rtol: tolerance("rtol"), measure_rtol: tolerance("measure_rtol") }
}
