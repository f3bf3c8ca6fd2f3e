//! Values of JSON files: positions, indices, units.

use serde_json::{Map, Value};

use super::error::{Error, quote};

/// Two finite numbers.
pub fn position(value: &Value, place: &str) -> Result<[f64; 2], Error> {
    let pair = match value.as_array().map(Vec::as_slice) {
        Some([x, y]) => x.as_f64().zip(y.as_f64()),
        _ => None,
    };
    pair.map(<[f64; 2]>::from).ok_or_else(|| {
        let message = format!("expected two numbers, found {}", quote(&value.to_string()));
        Error::new(place, message, "write the x and y of the joint, as in [0.6, 0.8]")
    })
}

/// The index of one of `count` joints, from 0; whole numbers may be written as floats.
pub fn index(value: &Value, place: &str, count: usize) -> Result<usize, Error> {
    let number = value.as_f64().filter(|number| number.fract() == 0.0 && (0.0..count as f64).contains(number));
    number.map(|number| number as usize).ok_or_else(|| {
        let message = format!("expected a joint, found {}", quote(&value.to_string()));
        let remedy = match count {
            0 => "add the positions of the joints".to_owned(),
            _ => format!("joints have the numbers 0 to {}", count - 1),
        };
        Error::new(place, message, remedy)
    })
}

/// The indices in a list.
pub fn indices(list: &[Value], key: &str, count: usize) -> Result<Vec<usize>, Error> {
    list.iter().enumerate().map(|(k, value)| index(value, &format!("`{key}`, entry {k}"), count)).collect()
}

/// The unit that a file states.
pub fn unit(object: &Map<String, Value>) -> Option<String> {
    ["units", "unit"].iter().find_map(|key| object.get(*key)?.as_str()).map(str::to_owned)
}
