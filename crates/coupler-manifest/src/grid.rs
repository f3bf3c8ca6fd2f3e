//! The values of a grid: lists, ranges by step and ranges by count.

use coupler_curves::family::AxisValues;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::problem::Problem;

/// What a grid may give for a name.
pub(crate) const VALUES_FORM: ValueSchema = ValueSchema::AnyOf(&[
    ValueSchema::List(&ValueSchema::Number, [1, usize::MAX]),
    ValueSchema::Table(&RANGE),
    ValueSchema::Number,
]);

static RANGE: TableSchema = TableSchema::new(
    "a range",
    &[
        KeySchema::required("from", ValueSchema::Number, "The first value."),
        KeySchema::required("to", ValueSchema::Number, "The last value; with `step`, only if a step reaches it."),
        KeySchema::new("step", ValueSchema::Number, "The difference of consecutive values."),
        KeySchema::new("count", ValueSchema::Integer([1, MAX_COUNT]), "The number of values."),
    ],
)
.with_one_of(&["step", "count"]);

/// The most values of one range.
const MAX_COUNT: usize = usize::MAX >> 12;

/// The values of one name, and their number.
pub(crate) struct GridValues {
    pub values: AxisValues,
    /// The number of values; a float, since it may exceed any integer.
    pub count: f64,
}

impl From<Vec<f64>> for GridValues {
    fn from(list: Vec<f64>) -> GridValues {
        GridValues { count: list.len() as f64, values: list.into() }
    }
}

/// `from` and `step` as whole multiples of `1 / scale`.
struct DecimalRange {
    from: f64,
    step: f64,
    scale: f64,
}

/// Reads the values that a grid gives for a name.
pub(crate) fn read_values<'t>(name: &str, value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<GridValues> {
    if let Some(list) = value.get_ref().as_array() {
        if list.is_empty() {
            let problem = Problem::error(value.span(), format!("`{name}` has no values"));
            parser.report(problem.with_help("give at least one value, as in [2, 3, 4]"));
            return None;
        }
        let read: Vec<Option<f64>> = list.iter().map(|item| parser.constant(item)).collect();
        return read.into_iter().collect::<Option<Vec<f64>>>().map(GridValues::from);
    }
    if value.get_ref().is_table() {
        return read_range(value, parser);
    }
    parser.constant(value).map(|value| GridValues::from(vec![value]))
}

/// Reads a range by step or by count.
fn read_range<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<GridValues> {
    let fields = Fields::from_value(value, &RANGE, parser)?;
    let mut end = |key: &str| {
        let value = fields.required(key, &format!("{key} = 2"), parser)?;
        Some((parser.constant(value)?, value))
    };
    let (from, to) = (end("from"), end("to"));
    match (fields.get("step"), fields.get("count")) {
        (Some(step_value), None) => {
            let step = parser.constant(step_value)?;
            let ((from, from_value), (to, _)) = (from?, to?);
            if step == 0.0 {
                parser.report(
                    Problem::error(step_value.span(), "`step` must not be 0").with_help("give a step other than 0"),
                );
                return None;
            }
            let steps = (to - from) / step;
            if steps < 0.0 {
                let problem = Problem::error(value.span(), format!("steps of {step} from {from} do not reach {to}"));
                parser.report(problem.with_help("change the sign of the step, or swap `from` and `to`"));
                return None;
            }
            let decimals = decimal_range(parser.decimal_digits(from_value), parser.decimal_digits(step_value));
            let number = (steps + 1e-9).floor() + 1.0;
            // The conversion saturates; so many values are a problem in any case.
            let count = number as usize;
            let values = match decimals {
                Some(DecimalRange { from, step, scale }) => AxisValues::DecimalSteps { from, step, scale, count },
                None => AxisValues::Steps { from, step, count },
            };
            Some(GridValues { values, count: number })
        }
        (None, Some(count)) => {
            let count = parser.integer(count, 1, MAX_COUNT)?;
            let ((from, _), (to, _)) = (from?, to?);
            Some(GridValues { values: AxisValues::Even { from, to, count }, count: count as f64 })
        }
        (step, _) => {
            let message = if step.is_some() {
                "a range has a step or a count, not both"
            } else {
                "a range needs a step or a count"
            };
            parser.report(
                Problem::error(value.span(), message)
                    .with_help("write { from = 2, to = 6, step = 0.5 } or { from = 2, to = 6, count = 9 }"),
            );
            None
        }
    }
}

/// The exact decimals of a range; `None` unless `from` and `step` are plain decimals of few enough digits.
fn decimal_range(from: Option<&str>, step: Option<&str>) -> Option<DecimalRange> {
    let (from, step) = (parse_decimal(from?)?, parse_decimal(step?)?);
    let places = from.1.max(step.1);
    // Powers of ten up to 10^15, and whole numbers below 2^53, are exact.
    let scale = |places: u32| 10u64.checked_pow(places).filter(|_| places <= 15).map(|n| n as f64);
    let units = |(digits, decimals): (f64, u32)| Some(digits * scale(places - decimals)?).filter(|n| n.abs() < 9e15);
    Some(DecimalRange { from: units(from)?, step: units(step)?, scale: scale(places)? })
}

/// Parses a plain decimal into its digits as a whole number, and the number of its decimal places.
fn parse_decimal(text: &str) -> Option<(f64, u32)> {
    let text = text.replace('_', "");
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let digits: f64 = format!("{whole}{fraction}").parse::<i64>().ok()? as f64;
    Some((digits, u32::try_from(fraction.len()).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Result<Vec<f64>, String> {
        let text = format!("p = {text}");
        let mut parser = TomlParser::new(&text);
        let document = parser.parse_document();
        let root = Fields::with_any_keys(&document, "the file", &mut parser).unwrap();
        match root.get("p").and_then(|value| read_values("p", value, &mut parser)) {
            Some(read) => Ok(read.values.iter().collect()),
            None => Err(parser.into_problems().remove(0).message),
        }
    }

    #[test]
    fn values_are_exact_decimals() {
        assert_eq!(values("{ from = 0.1, to = 0.7, step = 0.1 }").unwrap(), [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
        assert_eq!(values("{ from = 1, to = -1, step = -0.5 }").unwrap(), [1.0, 0.5, 0.0, -0.5, -1.0]);
        assert_eq!(values("{ from = 0, to = 1, step = 0.3 }").unwrap(), [0.0, 0.3, 0.6, 0.9]);
        assert_eq!(values("{ from = 0, to = 1, step = \"1/3\" }").unwrap().len(), 4);
        assert_eq!(values("{ from = 1.5, to = 4.0, step = 0.5 }").unwrap(), [1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
        assert_eq!(values("{ from = 2, to = 3, count = 3 }").unwrap(), [2.0, 2.5, 3.0]);
        assert_eq!(values("{ from = 2, to = 3, count = 1 }").unwrap(), [3.0]);
        assert_eq!(values("[\"sqrt(4)\", 3]").unwrap(), [2.0, 3.0]);
        assert_eq!(values("1_000").unwrap(), [1000.0]);
    }

    #[test]
    fn endless_and_empty_ranges_are_errors() {
        assert_eq!(values("{ from = 0, to = 1, step = 0 }").unwrap_err(), "`step` must not be 0");
        assert_eq!(values("{ from = 0, to = 1, step = -1 }").unwrap_err(), "steps of -1 from 0 do not reach 1");
        assert_eq!(values("{ from = 0, to = 1 }").unwrap_err(), "a range needs a step or a count");
        assert_eq!(values("[]").unwrap_err(), "`p` has no values");
    }
}
