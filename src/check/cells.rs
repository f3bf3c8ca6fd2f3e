//! Rows of `cells.csv` held against those that come out now.

use std::collections::HashMap;

use super::curve::difference;
use super::finding::{Change, Finding, Place};
use crate::manifest::Tolerances;
use crate::record::{Flaw, Row};
use coupler_curves::measure::{self, Measure};

/// Where the columns of a `cells.csv` are, in a recorded one and in the present one.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    /// The keys of a row, status and reason.
    was: [Option<usize>; 5],
    is: [Option<usize>; 5],
    /// Parameters that both have.
    pub parameters: Vec<(String, [usize; 2])>,
    /// Measures that both have.
    measures: Vec<(&'static Measure, [usize; 2])>,
}

const KEYS: [&str; 5] = ["cell", "trace", "circuit", "status", "reason"];

impl Columns {
    /// Of a recorded header, the present one, and the parameters of the linkage.
    pub fn of(was: &[String], is: &[String], parameters: &[String]) -> Columns {
        let place = |header: &[String], name: &str| header.iter().position(|other| other == name);
        let both = |name: &str| Some([place(was, name)?, place(is, name)?]);
        let measure = |measure: &'static Measure| Some((measure, both(measure.name)?));
        Columns {
            was: KEYS.map(|name| place(was, name)),
            is: KEYS.map(|name| place(is, name)),
            parameters: parameters.iter().filter_map(|name| Some((name.clone(), both(name)?))).collect(),
            measures: measure::ALL.iter().filter_map(measure).collect(),
        }
    }

    /// The names of recorded columns that the present table does not have, and of present ones that are not recorded.
    pub fn differing(was: &[String], is: &[String]) -> [Vec<String>; 2] {
        let without = |these: &[String], those: &[String]| {
            these.iter().filter(|name| !those.contains(name)).cloned().collect::<Vec<_>>()
        };
        [without(was, is), without(is, was)]
    }

    /// The recorded values of the common parameters.
    pub fn recorded(&self, row: &Row) -> Result<Vec<f64>, Flaw> {
        self.parameters.iter().map(|(name, [was, _])| row.number(*was, name)).collect()
    }

    /// In what the rows of a cell differ. `curves` are the pairs of curves that are held against each other: trace and
    /// circuit, as recorded and as they are; `sizes` those of the present ones.
    pub fn compare(
        &self,
        place: &Place,
        [was, is]: [&[Row]; 2],
        curves: &[Pair],
        tolerances: &Tolerances,
        findings: &mut Vec<Finding>,
    ) -> Result<(), Flaw> {
        let [Some(first), Some(now)] = [was.first(), is.first()] else { return Ok(()) };
        for (name, [a, b]) in &self.parameters {
            let (was, is) = (first.number(*a, name)?, now.number(*b, name)?);
            if difference([was, is], 1.0) > tolerances.rtol.min(1e-9) {
                findings.push(place.has(Change::Parameter { name: name.clone(), was, is }));
            }
        }
        let told = |row: &Row, at: [Option<usize>; 5]| {
            let field = |k: usize| at[k].map_or("", |at| row.field(at)).to_owned();
            let (status, reason) = (field(3), field(4));
            if reason.is_empty() { status } else { format!("{status} ({reason})") }
        };
        let (was_status, is_status) = (told(first, self.was), told(now, self.is));
        if was_status != is_status && self.was[3].is_some() {
            findings.push(place.has(Change::Status { was: was_status, is: is_status }));
        }
        let key = |row: &Row, at: [Option<usize>; 5]| [1, 2].map(|k| at[k].map_or("", |at| row.field(at)).to_owned());
        let by_key = |rows: &[Row], at| -> HashMap<[String; 2], usize> {
            rows.iter().enumerate().map(|(k, row)| (key(row, at), k)).collect()
        };
        let (recorded, present) = (by_key(was, self.was), by_key(is, self.is));
        let mut class_told = false;
        for pair in curves {
            let keys = [pair.was, pair.is].map(|(trace, circuit)| [trace.to_string(), circuit.to_string()]);
            let (Some(&a), Some(&b)) = (recorded.get(&keys[0]), present.get(&keys[1])) else { continue };
            let place = place.curve(pair.is.0, pair.is.1);
            self.measures(&place, [&was[a], &is[b]], pair.size, tolerances, &mut class_told, findings)?;
        }
        Ok(())
    }

    fn measures(
        &self,
        place: &Place,
        [was, is]: [&Row; 2],
        size: f64,
        tolerances: &Tolerances,
        class_told: &mut bool,
        findings: &mut Vec<Finding>,
    ) -> Result<(), Flaw> {
        for &(Measure { name, unit, is_word, .. }, [a, b]) in &self.measures {
            let (old, new) = (was.field(a), is.field(b));
            if old == new {
                continue;
            }
            let (was_text, is_text) = (old.to_owned(), new.to_owned());
            if *name == "class" {
                // All curves of a linkage have its class.
                if !std::mem::replace(class_told, true) {
                    let place = Place { trace: None, circuit: None, ..place.clone() };
                    findings.push(place.has(Change::Class { was: was_text, is: is_text }));
                }
                continue;
            }
            let relative = match is_word {
                true => f64::INFINITY,
                false => relative([was.number(a, name)?, is.number(b, name)?], (name, unit), size),
            };
            if relative > tolerances.measure_rtol {
                findings.push(place.has(Change::Measure {
                    name: (*name).to_owned(),
                    was: was_text,
                    is: is_text,
                    relative,
                }));
            }
        }
        Ok(())
    }
}

/// Curves that are held against each other: trace and circuit, as recorded and as they are.
pub(super) struct Pair {
    pub was: (usize, usize),
    pub is: (usize, usize),
    /// The size of the present one.
    pub size: f64,
}

/// By how much a measure differs: in parts of itself, of an angle also of one degree, of a place also of the curve's size.
fn relative(values: [f64; 2], (name, unit): (&str, &str), size: f64) -> f64 {
    let is_place = ["_x", "_y", "_x_min", "_x_max", "_y_min", "_y_max"].iter().any(|end| name.ends_with(end));
    let least = match unit {
        "deg" => 1.0,
        _ if is_place => size,
        _ => 0.0,
    };
    difference(values, least)
}
