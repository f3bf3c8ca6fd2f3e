//! Rows of `cells.csv` held against those that come out now.

use std::collections::HashMap;

use super::curve::relative_difference;
use super::finding::{Change, Finding, Location};
use crate::manifest::Tolerances;
use crate::record::{Row, TableError};
use coupler_curves::measure::{self, Measure};

/// Where the columns of a `cells.csv` are, in a recorded one and in the present one.
#[derive(Clone, Debug)]
pub(super) struct CellColumns {
    /// The keys of a row, status and reason.
    recorded: [Option<usize>; 5],
    current: [Option<usize>; 5],
    /// Parameters that both have.
    pub parameters: Vec<(String, [usize; 2])>,
    /// Measures that both have.
    measures: Vec<(&'static Measure, [usize; 2])>,
}

const KEY_COLUMNS: [&str; 5] = ["cell", "trace", "circuit", "status", "reason"];

impl CellColumns {
    /// Of a recorded header, the present one, and the parameters of the linkage.
    pub fn from_headers(was: &[String], is: &[String], parameters: &[String]) -> CellColumns {
        let place = |header: &[String], name: &str| header.iter().position(|other| other == name);
        let both = |name: &str| Some([place(was, name)?, place(is, name)?]);
        let measure = |measure: &'static Measure| Some((measure, both(measure.name)?));
        CellColumns {
            recorded: KEY_COLUMNS.map(|name| place(was, name)),
            current: KEY_COLUMNS.map(|name| place(is, name)),
            parameters: parameters.iter().filter_map(|name| Some((name.clone(), both(name)?))).collect(),
            measures: measure::ALL.iter().filter_map(measure).collect(),
        }
    }

    /// The names of recorded columns that the present table does not have, and of present ones that are not recorded.
    pub fn unmatched_names(was: &[String], is: &[String]) -> [Vec<String>; 2] {
        let without = |these: &[String], those: &[String]| {
            these.iter().filter(|name| !those.contains(name)).cloned().collect::<Vec<_>>()
        };
        [without(was, is), without(is, was)]
    }

    /// The recorded values of the common parameters.
    pub fn recorded_parameters(&self, row: &Row) -> Result<Vec<f64>, TableError> {
        self.parameters.iter().map(|(name, [was, _])| row.number(*was, name)).collect()
    }

    /// In what the rows of a cell differ. `curves` are the pairs of curves that are held against each other: trace and
    /// circuit, as recorded and as they are; `sizes` those of the present ones.
    pub fn compare_rows(
        &self,
        place: &Location,
        [was, is]: [&[Row]; 2],
        curves: &[CurvePair],
        tolerances: &Tolerances,
        findings: &mut Vec<Finding>,
    ) -> Result<(), TableError> {
        let [Some(first), Some(now)] = [was.first(), is.first()] else { return Ok(()) };
        for (name, [a, b]) in &self.parameters {
            let (was, is) = (first.number(*a, name)?, now.number(*b, name)?);
            if relative_difference([was, is], 1.0) > tolerances.rtol.min(1e-9) {
                findings.push(place.finding(Change::Parameter { name: name.clone(), recorded: was, current: is }));
            }
        }
        let told = |row: &Row, at: [Option<usize>; 5]| {
            let field = |k: usize| at[k].map_or("", |at| row.field(at)).to_owned();
            let (status, reason) = (field(3), field(4));
            if reason.is_empty() { status } else { format!("{status} ({reason})") }
        };
        let (was_status, is_status) = (told(first, self.recorded), told(now, self.current));
        if was_status != is_status && self.recorded[3].is_some() {
            findings.push(place.finding(Change::Status { recorded: was_status, current: is_status }));
        }
        let key = |row: &Row, at: [Option<usize>; 5]| [1, 2].map(|k| at[k].map_or("", |at| row.field(at)).to_owned());
        let by_key = |rows: &[Row], at| -> HashMap<[String; 2], usize> {
            rows.iter().enumerate().map(|(k, row)| (key(row, at), k)).collect()
        };
        let (recorded, present) = (by_key(was, self.recorded), by_key(is, self.current));
        let mut class_told = false;
        for pair in curves {
            let keys = [pair.recorded, pair.current].map(|(trace, circuit)| [trace.to_string(), circuit.to_string()]);
            let (Some(&a), Some(&b)) = (recorded.get(&keys[0]), present.get(&keys[1])) else { continue };
            let place = place.with_curve(pair.current.0, pair.current.1);
            self.compare_measures(&place, [&was[a], &is[b]], pair.size, tolerances, &mut class_told, findings)?;
        }
        Ok(())
    }

    fn compare_measures(
        &self,
        place: &Location,
        [was, is]: [&Row; 2],
        size: f64,
        tolerances: &Tolerances,
        class_told: &mut bool,
        findings: &mut Vec<Finding>,
    ) -> Result<(), TableError> {
        for &(Measure { name, unit, is_word, .. }, [a, b]) in &self.measures {
            let (old, new) = (was.field(a), is.field(b));
            if old == new {
                continue;
            }
            let (was_text, is_text) = (old.to_owned(), new.to_owned());
            if *name == "class" {
                // All curves of a linkage have its class.
                if !std::mem::replace(class_told, true) {
                    let place = Location { trace: None, circuit: None, ..place.clone() };
                    findings.push(place.finding(Change::Class { recorded: was_text, current: is_text }));
                }
                continue;
            }
            let relative = match is_word {
                true => f64::INFINITY,
                false => measure_difference([was.number(a, name)?, is.number(b, name)?], (name, unit), size),
            };
            if relative > tolerances.measure_rtol {
                findings.push(place.finding(Change::Measure {
                    name: (*name).to_owned(),
                    recorded: was_text,
                    current: is_text,
                    relative,
                }));
            }
        }
        Ok(())
    }
}

/// Curves that are held against each other: trace and circuit, as recorded and as they are.
pub(super) struct CurvePair {
    pub recorded: (usize, usize),
    pub current: (usize, usize),
    /// The size of the present one.
    pub size: f64,
}

/// By how much a measure differs: in parts of itself, of an angle also of one degree, of a place also of the curve's size.
fn measure_difference(values: [f64; 2], (name, unit): (&str, &str), size: f64) -> f64 {
    let is_place = ["_x", "_y", "_x_min", "_x_max", "_y_min", "_y_max"].iter().any(|end| name.ends_with(end));
    let least = match unit {
        "deg" => 1.0,
        _ if is_place => size,
        _ => 0.0,
    };
    relative_difference(values, least)
}
