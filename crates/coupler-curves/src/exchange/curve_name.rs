//! Names of curves: `evans:3.1.1?p=2.5&k=2`.

use std::fmt;

use super::number::format_number;
use crate::family::{ParameterSyntaxError, ParameterText, ParameterUnitError};
use crate::template::Template;

/// The curves that a word names: those of a family, those of a cell, or one curve; with overrides, those that the cell
/// has with other parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveName {
    /// The id of the family.
    pub family: String,
    /// The number of the cell, from 1.
    pub cell: Option<usize>,
    /// The numbers of the trace and the circuit, from 1; `None` if there is no cell.
    pub curve: Option<[usize; 2]>,
    /// Parameters that replace those of the cell, and coordinates such as `M.along`; empty if there is no cell.
    pub overrides: Vec<ParameterText>,
}

/// Why a word is not the name of curves.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveNameError {
    /// It has another form.
    #[error(
        "`{0}`: a curve is named FAMILY:CELL.TRACE.CIRCUIT, as in evans:3.1.1, and several at once FAMILY:CELL or FAMILY"
    )]
    Syntax(String),
    /// It replaces parameters of no particular cell.
    #[error("`{text}`: only the parameters of a single cell can be replaced; name it, as in {example}")]
    NoCell {
        /// The word.
        text: String,
        /// The same with a cell.
        example: String,
    },
    /// An override has another form.
    #[error(transparent)]
    Override(#[from] ParameterSyntaxError),
}

impl CurveName {
    /// Parses `evans`, `evans:3`, `evans:3.1.1` or `evans:3.1.1?p=2.5&k=2`.
    ///
    /// # Errors
    /// The text has another form.
    pub fn parse(text: &str) -> Result<CurveName, CurveNameError> {
        let (name, query) = text.split_once('?').map_or((text, None), |(name, query)| (name, Some(query)));
        let (family, numbers) = name.split_once(':').map_or((name, None), |(id, numbers)| (id, Some(numbers)));
        let error = || CurveNameError::Syntax(text.to_owned());
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
        let overrides: Vec<ParameterText> = pairs.map(ParameterText::parse).collect::<Result<_, _>>()?;
        if !overrides.is_empty() && cell.is_none() {
            let example = format!("{family}:1?{}", query.unwrap_or(""));
            return Err(CurveNameError::NoCell { text: text.to_owned(), example });
        }
        Ok(CurveName { family: family.to_owned(), cell, curve, overrides })
    }

    /// The overrides in the units of a linkage's parameters.
    ///
    /// # Errors
    /// Every value that its parameter cannot have.
    pub fn resolve_overrides(&self, template: &Template) -> Result<Vec<(String, f64)>, Vec<ParameterUnitError>> {
        let (resolved, errors): (Vec<_>, Vec<_>) =
            self.overrides.iter().map(|parameter| parameter.resolve(template)).partition(Result::is_ok);
        let errors: Vec<ParameterUnitError> = errors.into_iter().filter_map(Result::err).collect();
        if errors.is_empty() { Ok(resolved.into_iter().flatten().collect()) } else { Err(errors) }
    }

    /// Parses the trace and circuit of a curve of a single linkage, `1.2`.
    pub fn parse_curve_numbers(text: &str) -> Option<[usize; 2]> {
        let (trace, circuit) = text.split_once('.')?;
        Some([parse_positive(trace)?, parse_positive(circuit)?])
    }
}

impl fmt::Display for CurveName {
    /// The name that [`CurveName::parse`] reads back, with numbers in the fewest digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.family)?;
        if let Some(cell) = self.cell {
            write!(f, ":{cell}")?;
        }
        if let Some([trace, circuit]) = self.curve {
            write!(f, ".{trace}.{circuit}")?;
        }
        for (k, ParameterText { name, number, unit, .. }) in self.overrides.iter().enumerate() {
            let unit = unit.map(|unit| format!(" {}", unit.name())).unwrap_or_default();
            write!(f, "{}{name}={}{unit}", if k == 0 { '?' } else { '&' }, format_number(*number))?;
        }
        Ok(())
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
    fn names_have_family_cell_curve_and_overrides() {
        let name = |cell, curve, overrides: &[(&str, f64)]| CurveName {
            family: "evans".to_owned(),
            cell,
            curve,
            overrides: overrides
                .iter()
                .map(|(name, value)| ParameterText::from_number((*name).to_owned(), *value))
                .collect(),
        };
        assert_eq!(CurveName::parse("evans"), Ok(name(None, None, &[])));
        assert_eq!(CurveName::parse("evans:3"), Ok(name(Some(3), None, &[])));
        assert_eq!(CurveName::parse("evans:3.1.2"), Ok(name(Some(3), Some([1, 2]), &[])));
        assert_eq!(
            CurveName::parse("evans:3.1.2?p=2^2&k=1"),
            Ok(name(Some(3), Some([1, 2]), &[("p", 4.0), ("k", 1.0)]))
        );
        for text in ["evans", "evans:3", "evans:3.1.2", "evans:3.1.2?p=4&M.along=-0.1"] {
            assert_eq!(CurveName::parse(text).unwrap().to_string(), text);
        }
        for invalid in
            ["", ":1", "evans:", "evans:0", "evans:1.2", "evans:1.1.1.1", "evans:+1", "evans:1.1.1?p", "evans?p=1"]
        {
            assert!(CurveName::parse(invalid).is_err(), "{invalid}");
        }
    }
}
