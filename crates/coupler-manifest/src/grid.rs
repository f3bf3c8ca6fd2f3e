//! The values of a grid: lists, ranges by step and ranges by count.

use coupler_curves::family::AxisValues;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema};
use coupler_curves::problem::Problem;
use coupler_curves::template::ParameterKind;

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

/// A decimal number as it is written: `digits * 10^exponent`, with a last digit other than 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Decimal {
    digits: i128,
    exponent: i32,
}

/// Reads the values that a grid gives for a name of a kind, if that is known.
pub(crate) fn read_values<'t>(
    name: &str,
    kind: Option<ParameterKind>,
    value: &TomlValue<'t>,
    parser: &mut TomlParser<'t>,
) -> Option<GridValues> {
    if let Some(list) = value.get_ref().as_array() {
        if list.is_empty() {
            let problem = Problem::error(value.span(), format!("`{name}` has no values"));
            parser.report(problem.with_help("give at least one value, as in [2, 3, 4]"));
            return None;
        }
        let read: Vec<Option<f64>> = list.iter().map(|item| parser.parameter_value(item, name, kind)).collect();
        return read.into_iter().collect::<Option<Vec<f64>>>().map(GridValues::from);
    }
    if value.get_ref().is_table() {
        return read_range(name, kind, value, parser);
    }
    parser.parameter_value(value, name, kind).map(|value| GridValues::from(vec![value]))
}

/// Reads a range by step or by count.
fn read_range<'t>(
    name: &str,
    kind: Option<ParameterKind>,
    value: &TomlValue<'t>,
    parser: &mut TomlParser<'t>,
) -> Option<GridValues> {
    let fields = Fields::from_value(value, &RANGE, parser)?;
    let mut end = |key: &str| {
        let value = fields.required(key, &format!("{key} = 2"), parser)?;
        Some((parser.parameter_value(value, name, kind)?, value))
    };
    let (from, to) = (end("from"), end("to"));
    match (fields.get("step"), fields.get("count")) {
        (Some(step_value), None) => {
            let step = parser.parameter_value(step_value, name, kind)?;
            let ((from, from_value), (to, to_value)) = (from?, to?);
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
            let decimals = [from_value, to_value, step_value].map(|value| parser.decimal_digits(value));
            if let Some(exact) = decimal_steps(decimals) {
                return Some(exact);
            }
            let number = (steps + 1e-9).floor() + 1.0;
            // The conversion saturates; so many values are a problem in any case.
            Some(GridValues { values: AxisValues::Steps { from, step, count: number as usize }, count: number })
        }
        (None, Some(count)) => {
            let count = parser.integer(count, 1, MAX_COUNT)?;
            let ((from, from_value), (to, to_value)) = (from?, to?);
            let exact = decimal_division([from_value, to_value].map(|value| parser.decimal_digits(value)), count);
            let values = exact.unwrap_or(AxisValues::Even { from, to, count });
            Some(GridValues { values, count: count as f64 })
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

/// The values of a range by step, from, to and step as decimals; `None` for other expressions, and for decimals that
/// together span more than some 28 digits.
fn decimal_steps(texts: [Option<&str>; 3]) -> Option<GridValues> {
    let ([from, to, step], exponent) = align_decimals(parse_decimals(texts)?)?;
    // `to` is included if a step comes within 1e-9 of a step to it.
    const PARTS: i128 = 1_000_000_000;
    let parts = (to - from).checked_mul(PARTS)?.checked_add(step)?;
    let last = parts.checked_div(step.checked_mul(PARTS)?)?;
    let count = usize::try_from(last).ok()?.checked_add(1)?;
    let values = AxisValues::DecimalSteps { from, step, divisor: 1, exponent, count };
    Some(GridValues { values, count: count as f64 })
}

/// The values of a range by count, from and to as decimals; `None` as for [`decimal_steps`].
fn decimal_division(texts: [Option<&str>; 2], count: usize) -> Option<AxisValues> {
    let ([from, to], exponent) = align_decimals(parse_decimals(texts)?)?;
    Some(match u64::try_from(count - 1).ok()? {
        0 => AxisValues::DecimalSteps { from: to, step: 0, divisor: 1, exponent, count },
        divisor => {
            let intervals = i128::from(divisor);
            // With these all numerators are within range.
            to.checked_mul(intervals)?;
            AxisValues::DecimalSteps { from: from.checked_mul(intervals)?, step: to - from, divisor, exponent, count }
        }
    })
}

fn parse_decimals<const N: usize>(texts: [Option<&str>; N]) -> Option<[Decimal; N]> {
    let mut parsed = [Decimal { digits: 0, exponent: 0 }; N];
    for (decimal, text) in parsed.iter_mut().zip(texts) {
        *decimal = parse_decimal(text?)?;
    }
    Some(parsed)
}

/// Decimals as whole multiples of one power of ten; `None` if a multiple exceeds 2^126, so that sums and differences of
/// two do not overflow.
fn align_decimals<const N: usize>(decimals: [Decimal; N]) -> Option<([i128; N], i32)> {
    let is_nonzero = |decimal: &&Decimal| decimal.digits != 0;
    let exponent = decimals.iter().filter(is_nonzero).map(|decimal| decimal.exponent).min().unwrap_or(0);
    let mut multiples = [0; N];
    for (multiple, decimal) in multiples.iter_mut().zip(decimals).filter(|(_, decimal)| decimal.digits != 0) {
        let power = 10i128.checked_pow(u32::try_from(decimal.exponent.checked_sub(exponent)?).ok()?)?;
        *multiple = decimal.digits.checked_mul(power).filter(|multiple| multiple.unsigned_abs() <= 1 << 126)?;
    }
    Some((multiples, exponent))
}

/// Parses a number in one of the forms of TOML: `1_000`, `-0.25`, `2e-3`, `0x10`; `None` for more digits than fit.
fn parse_decimal(text: &str) -> Option<Decimal> {
    let text = text.replace('_', "");
    let radix = [("0x", 16), ("0o", 8), ("0b", 2)].into_iter().find(|(prefix, _)| text.starts_with(prefix));
    let (mut digits, mut exponent) = match radix {
        Some((_, radix)) => (i128::from_str_radix(&text[2..], radix).ok()?, 0),
        None => {
            let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((&text, "0"));
            let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
            let places = i32::try_from(fraction.len()).ok()?;
            (format!("{whole}{fraction}").parse().ok()?, exponent.parse::<i32>().ok()?.checked_sub(places)?)
        }
    };
    while digits != 0 && digits % 10 == 0 {
        (digits, exponent) = (digits / 10, exponent.checked_add(1)?);
    }
    Some(Decimal { digits, exponent })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Result<Vec<f64>, String> {
        let text = format!("p = {text}");
        let mut parser = TomlParser::new(&text);
        let document = parser.parse_document();
        let root = Fields::with_any_keys(&document, "the file", &mut parser).unwrap();
        match root.get("p").and_then(|value| read_values("p", Some(ParameterKind::Length), value, &mut parser)) {
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
    fn decimals_may_have_exponents_and_other_forms() {
        let tenths = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];
        assert_eq!(values("{ from = 1e-1, to = 1, step = 1e-1 }").unwrap(), tenths);
        assert_eq!(values("{ from = 1.0E-1, to = 1e+0, step = 10e-2 }").unwrap(), tenths);
        assert_eq!(values("{ from = \"1e-1\", to = \".1e1\", step = \"0.1\" }").unwrap(), tenths);
        assert_eq!(values("{ from = 1e-1, to = 1, count = 10 }").unwrap(), tenths);
        assert_eq!(values("{ from = 0x1, to = 0b10, step = 0.1 }").unwrap()[7], 1.7);
        assert_eq!(values("{ from = 1e22, to = 3e22, step = 1e22 }").unwrap(), [1e22, 2e22, 3e22]);
        assert_eq!(values("{ from = 1e-300, to = 3e-300, step = 1e-300 }").unwrap(), [1e-300, 2e-300, 3e-300]);
        assert_eq!(values("{ from = -3e300, to = 0e9, step = 1.5e300 }").unwrap(), [-3e300, -1.5e300, 0.0]);
        assert_eq!(values("{ from = 0, to = 0.99999999995, step = 0.1 }").unwrap().len(), 11, "within 1e-9 of a step");
        assert_eq!(values("{ from = 0, to = 0.9999999998, step = 0.1 }").unwrap().len(), 10);
        // So many digits are added as numbers.
        assert_eq!(values("{ from = 1e-60, to = 2, step = 1 }").unwrap(), [1e-60, 1.0, 2.0]);
    }

    /// The written decimals, added exactly and parsed, against the values of a grid.
    #[test]
    fn random_ranges_are_the_nearest_numbers_to_their_decimals() {
        let mut state = 7u64;
        let mut random = |bound: i64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % bound
        };
        for _ in 0..2000 {
            let (exponent, count) = (random(40) as i32 - 30, 1 + random(30));
            let (from, step) = (random(2_000_000_000) - 1_000_000_000, random(1_000_000) - 500_000);
            let step = if step == 0 { 1 } else { step };
            let to = from + step * (count - 1);
            // The same number, with one to three decimal places.
            let write = |digits: i64, places: usize| {
                let text = format!("{:0>1$}", digits.abs(), places + 1);
                let (whole, fraction) = text.split_at(text.len() - places);
                format!("{}{whole}.{fraction}e{}", if digits < 0 { "-" } else { "" }, exponent + places as i32)
            };
            let exact: Vec<f64> =
                (0..count).map(|k| format!("{}e{exponent}", from + step * k).parse().unwrap()).collect();
            let [from, to, step] = [(from, 1), (to, 2), (step, 3)].map(|(digits, places)| write(digits, places));
            let by_step = format!("{{ from = {from}, to = {to}, step = {step} }}");
            assert_eq!(values(&by_step).unwrap(), exact, "{by_step}");
            if count > 1 {
                let by_count = format!("{{ from = {from}, to = {to}, count = {count} }}");
                assert_eq!(values(&by_count).unwrap(), exact, "{by_count}");
            }
        }
    }

    #[test]
    fn endless_and_empty_ranges_are_errors() {
        assert_eq!(values("{ from = 0, to = 1, step = 0 }").unwrap_err(), "`step` must not be 0");
        assert_eq!(values("{ from = 0, to = 1, step = -1 }").unwrap_err(), "steps of -1 from 0 do not reach 1");
        assert_eq!(values("{ from = 0, to = 1 }").unwrap_err(), "a range needs a step or a count");
        assert_eq!(values("[]").unwrap_err(), "`p` has no values");
    }
}
