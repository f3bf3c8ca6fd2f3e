use std::fmt::Write;

use toml::de::DeValue;

use super::TomlValue;

/// A value as TOML in one line that is independent of how it was written: of comments, spaces, and the notation of
/// strings and numbers. The order of keys is kept, for in some tables it matters. The keys in `leaving_out` are left out
/// of a table.
pub fn canonical_toml(value: &TomlValue, leaving_out: &[&str]) -> String {
    let mut out = String::new();
    append_value(value, leaving_out, &mut out);
    out
}

/// A text as a quoted TOML string.
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                // Writing to a string cannot fail.
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A name as a key of TOML: bare, or quoted where it has to be.
pub fn toml_key(name: &str) -> String {
    let is_bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-'));
    if is_bare { name.to_owned() } else { quoted(name) }
}

/// A number as TOML in the fewest digits that read back to the same value, whole numbers up to 2^53 as integers.
pub fn toml_number(value: f64) -> String {
    const MAX_WHOLE: f64 = 9_007_199_254_740_992.0;
    let is_integer = value.fract() == 0.0 && value.abs() <= MAX_WHOLE && !(value == 0.0 && value.is_sign_negative());
    match value {
        value if is_integer => format!("{value}"),
        value if value.is_nan() => "nan".to_owned(),
        value => format!("{value:?}"),
    }
}

fn append_value(value: &TomlValue, leaving_out: &[&str], out: &mut String) {
    match value.get_ref() {
        DeValue::String(text) => out.push_str(&quoted(text)),
        // Integers and floats are alike.
        DeValue::Integer(n) => match i128::from_str_radix(n.as_str(), n.radix()) {
            Ok(number) => out.push_str(&toml_number(number as f64)),
            Err(_) => out.push_str(n.as_str()),
        },
        DeValue::Float(x) => match x.as_str().parse::<f64>() {
            Ok(number) => out.push_str(&toml_number(number)),
            Err(_) => out.push_str(x.as_str()),
        },
        DeValue::Boolean(boolean) => out.push_str(if *boolean { "true" } else { "false" }),
        // Writing to a string cannot fail.
        DeValue::Datetime(date) => drop(write!(out, "{date}")),
        DeValue::Array(items) => {
            out.push('[');
            for (k, item) in items.iter().enumerate() {
                out.push_str(if k > 0 { "," } else { "" });
                append_value(item, &[], out);
            }
            out.push(']');
        }
        DeValue::Table(table) => {
            out.push('{');
            let entries = table.iter().filter(|(key, _)| !leaving_out.contains(&key.get_ref().as_ref()));
            for (k, (key, value)) in entries.enumerate() {
                out.push_str(if k > 0 { "," } else { "" });
                out.push_str(&quoted(key.get_ref()));
                out.push('=');
                append_value(value, &[], out);
            }
            out.push('}');
        }
    }
}
