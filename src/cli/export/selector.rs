//! Names of curves on the command line.

use super::super::linkage;

/// The curves that a word names: those of a family, those of a cell, or one curve; with overrides, those that the cell
/// has with other parameters.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurveSelector {
    pub family: String,
    /// The number of the cell, from 1.
    pub cell: Option<usize>,
    /// The numbers of the trace and the circuit, from 1.
    pub curve: Option<[usize; 2]>,
    /// Parameters that replace those of the cell.
    pub overrides: Vec<(String, f64)>,
}

const SYNTAX_HELP: &str =
    "a curve is named FAMILY:CELL.TRACE.CIRCUIT, as in evans:3.1.1, and several at once FAMILY:CELL or FAMILY";

impl CurveSelector {
    /// Parses `evans`, `evans:3`, `evans:3.1.1` or `evans:3.1.1?p=2.5&k=2`.
    ///
    /// # Errors
    /// A message, if the text has another form.
    pub fn parse(text: &str) -> Result<CurveSelector, String> {
        let (name, query) = text.split_once('?').map_or((text, None), |(name, query)| (name, Some(query)));
        let (family, numbers) = name.split_once(':').map_or((name, None), |(id, numbers)| (id, Some(numbers)));
        let error = || format!("`{text}`: {SYNTAX_HELP}");
        let numbers: Vec<usize> = match numbers {
            None => Vec::new(),
            Some(numbers) => numbers.split('.').map(parse_positive).collect::<Option<_>>().ok_or_else(error)?,
        };
        let (cell, curve) = match numbers[..] {
            [] => (None, None),
            [cell] => (Some(cell), None),
            [cell, trace, circuit] => (Some(cell), Some([trace, circuit])),
            _ => return Err(error()),
        };
        if family.is_empty() {
            return Err(error());
        }
        let pairs = query.into_iter().flat_map(|query| query.split('&')).filter(|pair| !pair.is_empty());
        let overrides: Vec<(String, f64)> =
            pairs.map(linkage::parse_parameter).collect::<Result<_, _>>().map_err(|error| error.to_string())?;
        if !overrides.is_empty() && cell.is_none() {
            return Err(format!(
                "`{text}`: only the parameters of a single cell can be replaced; name it, as in {family}:1?{}",
                query.unwrap_or("")
            ));
        }
        Ok(CurveSelector { family: family.to_owned(), cell, curve, overrides })
    }

    /// Parses the trace and circuit of a curve of a single linkage, `1.2`.
    pub fn parse_curve_numbers(text: &str) -> Option<[usize; 2]> {
        let (trace, circuit) = text.split_once('.')?;
        Some([parse_positive(trace)?, parse_positive(circuit)?])
    }
}

/// Parses a whole number from 1 on, in digits only.
fn parse_positive(text: &str) -> Option<usize> {
    text.parse().ok().filter(|number| *number > 0 && text.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_selector_names_family_cell_curve_and_overrides() {
        let selector = |cell, curve, overrides: &[(&str, f64)]| CurveSelector {
            family: "evans".to_owned(),
            cell,
            curve,
            overrides: overrides.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
        };
        assert_eq!(CurveSelector::parse("evans"), Ok(selector(None, None, &[])));
        assert_eq!(CurveSelector::parse("evans:3"), Ok(selector(Some(3), None, &[])));
        assert_eq!(CurveSelector::parse("evans:3.1.2"), Ok(selector(Some(3), Some([1, 2]), &[])));
        assert_eq!(
            CurveSelector::parse("evans:3.1.2?p=2^2&k=1"),
            Ok(selector(Some(3), Some([1, 2]), &[("p", 4.0), ("k", 1.0)]))
        );
        for invalid in
            ["", ":1", "evans:", "evans:0", "evans:1.2", "evans:1.1.1.1", "evans:+1", "evans:1.1.1?p", "evans?p=1"]
        {
            assert!(CurveSelector::parse(invalid).is_err(), "{invalid}");
        }
    }
}
