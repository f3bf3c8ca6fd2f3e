use super::super::linkage;

/// What a word on the command line names: the curves of a family, of one of its cells, or one curve; with other parameters
/// than the cell's own, if it says so.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurveSelector {
    pub family: String,
    /// The number of the cell, from 1.
    pub cell: Option<usize>,
    /// The numbers of the trace and the circuit, from 1.
    pub curve: Option<[usize; 2]>,
    /// Parameters in place of the cell's.
    pub overrides: Vec<(String, f64)>,
}

const SYNTAX_HELP: &str =
    "a curve is named FAMILY:CELL.TRACE.CIRCUIT, as in evans:12.1.1, and several at once FAMILY:CELL or FAMILY";

impl CurveSelector {
    /// Reads `evans`, `evans:12`, `evans:12.1.1` or `evans:12.1.1?p=2.5&k=2`.
    ///
    /// # Errors
    /// What is wrong with it, in a sentence.
    pub fn parse(text: &str) -> Result<CurveSelector, String> {
        let (place, query) = text.split_once('?').map_or((text, None), |(place, query)| (place, Some(query)));
        let (family, numbers) = place.split_once(':').map_or((place, None), |(id, numbers)| (id, Some(numbers)));
        let wrong = || format!("`{text}`: {SYNTAX_HELP}");
        let numbers: Vec<usize> = match numbers {
            None => Vec::new(),
            Some(numbers) => numbers.split('.').map(parse_positive).collect::<Option<_>>().ok_or_else(wrong)?,
        };
        let (cell, curve) = match numbers[..] {
            [] => (None, None),
            [cell] => (Some(cell), None),
            [cell, trace, circuit] => (Some(cell), Some([trace, circuit])),
            _ => return Err(wrong()),
        };
        if family.is_empty() {
            return Err(wrong());
        }
        let pairs = query.into_iter().flat_map(|query| query.split('&')).filter(|pair| !pair.is_empty());
        let changed: Vec<(String, f64)> =
            pairs.map(linkage::parse_parameter).collect::<Result<_, _>>().map_err(|why| why.to_string())?;
        if !changed.is_empty() && cell.is_none() {
            return Err(format!(
                "`{text}`: parameters are changed of one cell; name it, as in {family}:1?{}",
                query.unwrap_or("")
            ));
        }
        Ok(CurveSelector { family: family.to_owned(), cell, curve, overrides: changed })
    }

    /// The numbers of a curve of a single linkage, `1.2`; none where a text is something else.
    pub fn parse_curve_numbers(text: &str) -> Option<[usize; 2]> {
        let (trace, circuit) = text.split_once('.')?;
        Some([parse_positive(trace)?, parse_positive(circuit)?])
    }
}

/// A number from 1.
fn parse_positive(text: &str) -> Option<usize> {
    text.parse().ok().filter(|number| *number > 0 && text.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_family_cell_curve_and_changes() {
        let name = |cell, curve, changed: &[(&str, f64)]| CurveSelector {
            family: "evans".to_owned(),
            cell,
            curve,
            overrides: changed.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
        };
        assert_eq!(CurveSelector::parse("evans"), Ok(name(None, None, &[])));
        assert_eq!(CurveSelector::parse("evans:3"), Ok(name(Some(3), None, &[])));
        assert_eq!(CurveSelector::parse("evans:3.1.2"), Ok(name(Some(3), Some([1, 2]), &[])));
        assert_eq!(
            CurveSelector::parse("evans:3.1.2?p=2^2&k=1"),
            Ok(name(Some(3), Some([1, 2]), &[("p", 4.0), ("k", 1.0)]))
        );
        for wrong in
            ["", ":1", "evans:", "evans:0", "evans:1.2", "evans:1.1.1.1", "evans:+1", "evans:1.1.1?p", "evans?p=1"]
        {
            assert!(CurveSelector::parse(wrong).is_err(), "{wrong}");
        }
    }
}
