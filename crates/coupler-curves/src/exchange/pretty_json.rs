//! JSON that people can read: objects a line for each member, lists of plain values on one line.

use super::format_number;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Json {
    Null,
    Bool(bool),
    /// Written in the fewest digits that read back to it; `null` where it is not finite.
    Number(f64),
    Text(String),
    List(Vec<Json>),
    /// Members in this order.
    Object(Vec<(String, Json)>),
}

impl Json {
    pub fn text(text: impl Into<String>) -> Json {
        Json::Text(text.into())
    }

    pub fn integer(number: usize) -> Json {
        Json::Number(number as f64)
    }

    pub fn object<const N: usize>(members: [(&str, Json); N]) -> Json {
        Json::Object(members.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }

    fn is_scalar(&self) -> bool {
        !matches!(self, Json::List(_) | Json::Object(_))
    }

    /// As text, and the end of a line.
    pub fn to_pretty_string(&self) -> String {
        let mut out = String::new();
        self.write(0, &mut out);
        out.push('\n');
        out
    }

    fn write(&self, depth: usize, out: &mut String) {
        match self {
            Json::Null => out.push_str("null"),
            Json::Bool(truth) => out.push_str(if *truth { "true" } else { "false" }),
            Json::Number(value) if value.is_finite() => out.push_str(&format_number(*value)),
            Json::Number(_) => out.push_str("null"),
            Json::Text(text) => out.push_str(&quoted(text)),
            Json::List(items) => {
                let lines = items.iter().any(|item| !item.is_scalar());
                write_members(['[', ']'], lines, items.iter().map(|item| (None, item)), depth, out);
            }
            Json::Object(items) => {
                write_members(
                    ['{', '}'],
                    true,
                    items.iter().map(|(name, item)| (Some(name.as_str()), item)),
                    depth,
                    out,
                );
            }
        }
    }
}

/// Members between brackets, each on a line of its own or all on one.
fn write_members<'j>(
    [open, close]: [char; 2],
    lines: bool,
    items: impl Iterator<Item = (Option<&'j str>, &'j Json)>,
    depth: usize,
    out: &mut String,
) {
    let mut is_empty = true;
    out.push(open);
    for (name, item) in items {
        match (is_empty, lines) {
            (true, true) => write_line_break(depth + 1, out),
            (true, false) => {}
            (false, true) => {
                out.push(',');
                write_line_break(depth + 1, out);
            }
            (false, false) => out.push_str(", "),
        }
        is_empty = false;
        if let Some(name) = name {
            out.push_str(&quoted(name));
            out.push_str(": ");
        }
        item.write(depth + 1, out);
    }
    if lines && !is_empty {
        write_line_break(depth, out);
    }
    out.push(close);
}

fn write_line_break(depth: usize, out: &mut String) {
    out.push('\n');
    out.extend(std::iter::repeat_n("  ", depth));
}

fn quoted(text: &str) -> String {
    // A text is always JSON.
    serde_json::to_string(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_laid_out_by_lines_and_reads_back() {
        let value = Json::object([
            ("n", Json::Number(0.1)),
            ("none", Json::Number(f64::INFINITY)),
            ("\"q\"", Json::text("a\nb")),
            ("empty", Json::List(Vec::new())),
            ("rows", Json::List(vec![Json::List(vec![Json::Number(1.0), Json::Number(-0.0), Json::Bool(true)])])),
        ]);
        let text = value.to_pretty_string();
        assert_eq!(
            text,
            "{\n  \"n\": 0.1,\n  \"none\": null,\n  \"\\\"q\\\"\": \"a\\nb\",\n  \"empty\": [],\n  \"rows\": [\n    \
             [1, 0, true]\n  ]\n}\n"
        );
        let read: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(read["rows"][0][0], 1);
    }
}
