//! Compares recorded rows of `cells.csv` with current ones.

use std::collections::HashMap;

use super::curve::relative_difference;
use super::finding::{Change, Finding, Location};
use super::measures::{self, Values};
use crate::manifest::Tolerances;
use crate::record::{Row, TableError};
use coupler_curves::measure::{self, Measure};

/// The indices of the columns of a recorded and of the current `cells.csv`.
#[derive(Clone, Debug)]
pub(super) struct CellColumns {
    /// The [`KEY_COLUMNS`] of the recorded table.
    recorded: [Option<usize>; 5],
    /// The [`KEY_COLUMNS`] of the current table.
    current: [Option<usize>; 5],
    /// The parameters that both tables have.
    pub parameters: Vec<(String, [usize; 2])>,
    /// The measures that both tables have, with their names there.
    measures: Vec<(&'static Measure, &'static str, [usize; 2])>,
}

const KEY_COLUMNS: [&str; 5] = ["cell", "trace", "circuit", "status", "reason"];

impl CellColumns {
    /// Finds the columns in the recorded and current headers; `parameters` are those of the linkage.
    pub fn from_headers(recorded: &[String], current: &[String], parameters: &[String]) -> CellColumns {
        let index = |header: &[String], name: &str| header.iter().position(|other| other == name);
        let both = |name: &str| Some([index(recorded, name)?, index(current, name)?]);
        let measure = |measure: &'static Measure| measure.names().find_map(|name| Some((measure, name, both(name)?)));
        CellColumns {
            recorded: KEY_COLUMNS.map(|name| index(recorded, name)),
            current: KEY_COLUMNS.map(|name| index(current, name)),
            parameters: parameters.iter().filter_map(|name| Some((name.clone(), both(name)?))).collect(),
            measures: measure::ALL.iter().filter_map(measure).collect(),
        }
    }

    /// The names of recorded columns that the current table does not have, and of current ones that are not recorded.
    pub fn unmatched_names(recorded: &[String], current: &[String]) -> [Vec<String>; 2] {
        let without = |names: &[String], others: &[String]| {
            names.iter().filter(|name| !others.contains(name)).cloned().collect::<Vec<_>>()
        };
        [without(recorded, current), without(current, recorded)]
    }

    /// The values of the common parameters in a recorded row.
    ///
    /// # Errors
    /// A value is not a number.
    pub fn recorded_parameters(&self, row: &Row) -> Result<Vec<f64>, TableError> {
        self.parameters.iter().map(|(name, [recorded, _])| row.number(*recorded, name)).collect()
    }

    /// Compares the recorded and current rows of a cell, and appends the differences; `curves` are the pairs of curves
    /// whose measures are compared.
    ///
    /// # Errors
    /// A recorded value is not a number.
    pub fn compare_rows(
        &self,
        location: &Location,
        [recorded, current]: [&[Row]; 2],
        curves: &[CurvePair],
        tolerances: &Tolerances,
        findings: &mut Vec<Finding>,
    ) -> Result<(), TableError> {
        let [Some(first_recorded), Some(first_current)] = [recorded.first(), current.first()] else { return Ok(()) };
        for (name, [a, b]) in &self.parameters {
            let (recorded, current) = (first_recorded.number(*a, name)?, first_current.number(*b, name)?);
            let is_near = (recorded - current).abs() <= tolerances.atol
                || relative_difference([recorded, current], 1.0) <= tolerances.rtol;
            if !is_near {
                findings.push(location.finding(Change::Parameter { name: name.clone(), recorded, current }));
            }
        }
        let describe_status = |row: &Row, columns: [Option<usize>; 5]| {
            let field = |k: usize| columns[k].map_or("", |column| row.field(column)).to_owned();
            let (status, reason) = (field(3), field(4));
            if reason.is_empty() { status } else { format!("{status} ({reason})") }
        };
        let recorded_status = describe_status(first_recorded, self.recorded);
        let current_status = describe_status(first_current, self.current);
        if recorded_status != current_status && self.recorded[3].is_some() {
            findings.push(location.finding(Change::Status { recorded: recorded_status, current: current_status }));
        }
        let key = |row: &Row, columns: [Option<usize>; 5]| {
            [1, 2].map(|k| columns[k].map_or("", |column| row.field(column)).to_owned())
        };
        let by_key = |rows: &[Row], columns| -> HashMap<[String; 2], usize> {
            rows.iter().enumerate().map(|(k, row)| (key(row, columns), k)).collect()
        };
        let (recorded_rows, current_rows) = (by_key(recorded, self.recorded), by_key(current, self.current));
        let mut is_class_reported = false;
        for pair in curves {
            let keys = [pair.recorded, pair.current].map(|(trace, circuit)| [trace.to_string(), circuit.to_string()]);
            let (Some(&a), Some(&b)) = (recorded_rows.get(&keys[0]), current_rows.get(&keys[1])) else { continue };
            let curve = location.with_curve(pair.current.0, pair.current.1);
            self.compare_measures(
                &curve,
                [&recorded[a], &current[b]],
                pair,
                tolerances,
                &mut is_class_reported,
                findings,
            )?;
        }
        Ok(())
    }

    /// Compares the measures of a curve; a change of the class is reported once for the cell.
    fn compare_measures(
        &self,
        location: &Location,
        [recorded, current]: [&Row; 2],
        pair: &CurvePair,
        tolerances: &Tolerances,
        is_class_reported: &mut bool,
        findings: &mut Vec<Finding>,
    ) -> Result<(), TableError> {
        let values = Rows { columns: self, rows: [recorded, current] };
        for &(Measure { is_word, .. }, name, [a, b]) in &self.measures {
            let [recorded_text, current_text] = [recorded.field(a), current.field(b)].map(str::to_owned);
            if recorded_text == current_text || tolerances.of(name) == f64::INFINITY {
                continue;
            }
            if name == "class" {
                // All curves of a linkage have the same class.
                if !std::mem::replace(is_class_reported, true) {
                    let cell = Location { trace: None, circuit: None, ..location.clone() };
                    findings.push(cell.finding(Change::Class { recorded: recorded_text, current: current_text }));
                }
                continue;
            }
            let in_doubt = measures::is_count_in_doubt(name, &values)
                || !pair.has_moved && measures::is_place_of_equal(name, &values, pair.size, tolerances);
            if in_doubt {
                continue;
            }
            let relative = match is_word {
                true => f64::INFINITY,
                false => measures::change(name, [recorded.number(a, name)?, current.number(b, name)?], pair.size),
            };
            if relative > tolerances.of(name) {
                findings.push(location.finding(Change::Measure {
                    name: (*name).to_owned(),
                    recorded: recorded_text,
                    current: current_text,
                    relative,
                }));
            }
        }
        Ok(())
    }
}

/// A recorded curve and the current curve it is compared with.
pub(super) struct CurvePair {
    /// The trace and circuit of the recorded curve.
    pub recorded: (usize, usize),
    /// The trace and circuit of the current curve.
    pub current: (usize, usize),
    /// The size of the current curve.
    pub size: f64,
    /// Whether its points have changed.
    pub has_moved: bool,
}

/// A recorded and a current row.
struct Rows<'a> {
    columns: &'a CellColumns,
    rows: [&'a Row; 2],
}

impl Values for Rows<'_> {
    fn texts(&self, name: &str) -> Option<[&str; 2]> {
        let (.., [a, b]) = self.columns.measures.iter().find(|(_, own, _)| *own == name)?;
        let [recorded, current] = self.rows;
        Some([recorded.field(*a), current.field(*b)])
    }
}
