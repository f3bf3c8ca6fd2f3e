use std::fmt::Write;

use toml::de::DeValue;

use super::TomlValue;

/// A text of a value that is independent of how it was written: of comments, spaces, and the notation of strings and
/// numbers. The order of keys is kept, for in some tables it matters. The keys in `leaving_out` are left out of a
/// table.
pub fn canonical_text(value: &TomlValue, leaving_out: &[&str]) -> String {
    let mut out = String::new();
    append_value(value, leaving_out, &mut out);
    out
}

fn append_value(value: &TomlValue, leaving_out: &[&str], out: &mut String) {
    // Writing to a string cannot fail.
    let _ = match value.get_ref() {
        DeValue::String(text) => write!(out, "{text:?}"),
        // Integers and floats are alike.
        DeValue::Integer(n) => match i128::from_str_radix(n.as_str(), n.radix()) {
            Ok(number) => write!(out, "{}", number as f64),
            Err(_) => write!(out, "{n}"),
        },
        DeValue::Float(x) => match x.as_str().parse::<f64>() {
            Ok(number) => write!(out, "{number}"),
            Err(_) => write!(out, "{x}"),
        },
        DeValue::Boolean(boolean) => write!(out, "{boolean}"),
        DeValue::Datetime(date) => write!(out, "{date}"),
        DeValue::Array(items) => {
            out.push('[');
            for item in items.iter() {
                append_value(item, &[], out);
                out.push(',');
            }
            out.push(']');
            Ok(())
        }
        DeValue::Table(table) => {
            out.push('{');
            for (key, value) in table.iter().filter(|(key, _)| !leaving_out.contains(&key.get_ref().as_ref())) {
                let _ = write!(out, "{:?}=", key.get_ref());
                append_value(value, &[], out);
                out.push(',');
            }
            out.push('}');
            Ok(())
        }
    };
}
