//! Bars between points as a table: a row for each joint, with its coordinates and the joints that bars join it to.

use std::collections::{BTreeSet, HashMap};

use csv::{ReaderBuilder, StringRecord, Trim};

use super::error::{Error, quote};
use super::links::{add_bars, add_edge, joint_name, motor_input};
use super::sketch::{Sketch, parse_number};

const ORIGIN: &str = "a table of joints";

/// The columns, of which the first are needed.
const COLUMNS: [&str; 7] = ["x", "y", "bars", "joint", "fixed", "motor", "target"];
const NEEDED: usize = 3;

/// Whether a text begins with the names of the columns that a table needs.
pub fn is_table(text: &str) -> bool {
    let header: Vec<String> = text.lines().next().unwrap_or_default().split(',').map(column_name).collect();
    COLUMNS[..NEEDED].iter().all(|column| header.iter().any(|name| name == column))
}

fn column_name(text: &str) -> String {
    text.trim().trim_matches('"').to_ascii_lowercase()
}

/// Reads a linkage.
///
/// # Errors
/// A column is missing or unknown, or a row is wrong.
pub fn parse(text: &str) -> Result<Sketch, Error> {
    let mut table = ReaderBuilder::new().trim(Trim::All).from_reader(text.as_bytes());
    let header = table.headers().map_err(|error| unreadable(&error))?.clone();
    let columns = columns(&header)?;
    let mut sketch = Sketch::new(ORIGIN);
    let mut joints = HashMap::new();
    // The line and the neighbours of each joint.
    let mut rows: Vec<(String, String)> = Vec::new();
    let mut motor = Vec::new();
    for (k, record) in table.records().enumerate() {
        let record = record.map_err(|error| unreadable(&error))?;
        let place = record.position().map_or(format!("row {}", k + 1), |position| format!("line {}", position.line()));
        let cell = |name: &str| columns.get(name).and_then(|&column| record.get(column)).unwrap_or_default();
        let own = cell("joint");
        let name = if own.is_empty() { joint_name(k) } else { own.to_owned() };
        let position = [parse_number(cell("x"), &place, "`x`")?, parse_number(cell("y"), &place, "`y`")?];
        let joint = sketch.add_joint(name.as_str(), position)?;
        sketch.joints[joint].is_fixed = is_set(cell("fixed"), "fixed", &place)?;
        sketch.joints[joint].is_traced = is_set(cell("target"), "target", &place)?;
        if is_set(cell("motor"), "motor", &place)? {
            motor.push(joint);
        }
        if joints.insert(name.clone(), joint).is_some() {
            let message = format!("another joint is called {}", quote(&name));
            return Err(Error::new(place, message, "give each a name of its own"));
        }
        rows.push((place, cell("bars").to_owned()));
    }
    let mut edges = BTreeSet::new();
    for (joint, (place, bars)) in rows.iter().enumerate() {
        for name in bars.split_whitespace() {
            let other = joints.get(name).copied().ok_or_else(|| {
                let message = format!("`bars` names {}, which is no joint", quote(name));
                Error::new(place, message, "name the joints at the other ends of its bars, with blanks between them")
            })?;
            add_edge([joint, other], place, &mut edges)?;
        }
    }
    add_bars(&edges, &mut sketch)?;
    if !motor.is_empty() {
        // The crank turns about the end that is fixed.
        motor.sort_by_key(|&joint| !sketch.joints[joint].is_fixed);
        sketch.input = Some(motor_input(&motor, "the column `motor`")?);
    }
    Ok(sketch)
}

/// The index of each column by its name.
fn columns(header: &StringRecord) -> Result<HashMap<String, usize>, Error> {
    let names: Vec<String> = header.iter().map(column_name).collect();
    let remedy = format!("the columns are {}", COLUMNS.map(|name| format!("`{name}`")).join(", "));
    let unknown = names.iter().find(|name| !COLUMNS.contains(&name.as_str()));
    let missing = COLUMNS[..NEEDED].iter().find(|column| names.iter().all(|name| name != *column));
    let message = match (unknown, missing) {
        (_, Some(missing)) => format!("there is no column `{missing}`"),
        (Some(unknown), None) => format!("there is a column {}", quote(unknown)),
        (None, None) => return Ok(names.into_iter().zip(0..).collect()),
    };
    Err(Error::new("line 1", message, remedy))
}

/// Whether a cell says yes.
fn is_set(cell: &str, column: &str, place: &str) -> Result<bool, Error> {
    match cell {
        "" | "0" => Ok(false),
        "1" => Ok(true),
        _ => {
            let message = format!("`{column}` is {}", quote(cell));
            Err(Error::new(place, message, "write 1 for yes, and 0 or nothing for no"))
        }
    }
}

fn unreadable(error: &csv::Error) -> Error {
    let place = error.position().map_or("the table".to_owned(), |position| format!("line {}", position.line()));
    let message = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("it has {len} values, and the first line {expected_len}")
        }
        _ => "it cannot be read".to_owned(),
    };
    Error::new(place, message, "give each line a value, or nothing, for each column")
}
