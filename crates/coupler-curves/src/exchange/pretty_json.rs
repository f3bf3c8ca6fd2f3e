//! Human-readable JSON: a line for each member of an object, and lists of scalars on one line.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::Formatter;

use super::append_number;

/// A value as JSON text that ends with a line break. Numbers have the fewest digits that read back to the same value;
/// NaN and infinities are `null`.
pub(super) fn to_pretty_string(value: &impl Serialize) -> serde_json::Result<String> {
    let mut out = Vec::new();
    value.serialize(&mut serde_json::Serializer::with_formatter(&mut out, Layout::default()))?;
    out.push(b'\n');
    String::from_utf8(out).map_err(serde::ser::Error::custom)
}

/// Whether an item is the first of its list.
type IsFirst = bool;

/// The layout, indented by two spaces. Whether a list takes one line depends on its items: a list or an object is put
/// on its own line. So the separator before an item is written when the item begins.
#[derive(Default)]
struct Layout {
    /// For each open list or object, whether its items are on separate lines.
    has_lines: Vec<bool>,
    /// The list item whose separator is not yet written.
    pending: Option<IsFirst>,
}

impl Layout {
    fn break_line<W: ?Sized + Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.has_lines.len()).try_for_each(|_| writer.write_all(b"  "))
    }

    /// Writes the separator before a scalar item.
    fn plain<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        match self.pending.take() {
            Some(false) => writer.write_all(b", "),
            _ => Ok(()),
        }
    }

    /// Writes the separator before an item that is a list or an object, and its opening bracket.
    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if let Some(is_first) = self.pending.take() {
            if !is_first {
                writer.write_all(b",")?;
            }
            if let Some(has_lines) = self.has_lines.last_mut() {
                *has_lines = true;
            }
            self.break_line(writer)?;
        }
        self.has_lines.push(false);
        writer.write_all(bracket)
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if self.has_lines.pop() == Some(true) {
            self.break_line(writer)?;
        }
        writer.write_all(bracket)
    }
}

macro_rules! integers {
    ($($method:ident: $integer:ty,)*) => {
        $(fn $method<W: ?Sized + Write>(&mut self, writer: &mut W, value: $integer) -> io::Result<()> {
            self.plain(writer)?;
            write!(writer, "{value}")
        })*
    };
}

impl Formatter for Layout {
    fn write_null<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.plain(writer)?;
        writer.write_all(b"null")
    }

    fn write_bool<W: ?Sized + Write>(&mut self, writer: &mut W, value: bool) -> io::Result<()> {
        self.plain(writer)?;
        writer.write_all(if value { b"true" } else { b"false" })
    }

    // Each type of integers has a method of its own, and the default of each writes no separator.
    integers! {
        write_i8: i8, write_i16: i16, write_i32: i32, write_i64: i64, write_i128: i128,
        write_u8: u8, write_u16: u16, write_u32: u32, write_u64: u64, write_u128: u128,
    }

    fn write_f32<W: ?Sized + Write>(&mut self, writer: &mut W, value: f32) -> io::Result<()> {
        self.write_f64(writer, value.into())
    }

    fn write_f64<W: ?Sized + Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        self.plain(writer)?;
        let mut digits = Vec::new();
        append_number(value, &mut digits);
        writer.write_all(&digits)
    }

    fn begin_string<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.plain(writer)?;
        writer.write_all(b"\"")
    }

    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"[")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, _: &mut W, is_first: bool) -> io::Result<()> {
        self.pending = Some(is_first);
        Ok(())
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"{")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, is_first: bool) -> io::Result<()> {
        if !is_first {
            writer.write_all(b",")?;
        }
        if let Some(has_lines) = self.has_lines.last_mut() {
            *has_lines = true;
        }
        self.break_line(writer)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize)]
    struct Example {
        n: f64,
        none: f64,
        #[serde(rename = "\"q\"")]
        quoted: &'static str,
        empty: [f64; 0],
        rows: Vec<(f64, f64, bool, Option<u64>)>,
        integers: (i8, i32, u8, i64, f32),
        objects: [Member; 2],
    }

    #[derive(Serialize)]
    struct Member {
        words: [&'static str; 2],
    }

    #[test]
    fn lists_of_scalars_take_one_line_and_the_text_reads_back() {
        let value = Example {
            n: 0.1,
            none: f64::INFINITY,
            quoted: "a\nb",
            empty: [],
            rows: vec![(1.0, -0.0, true, None), (1e300, 2.5, false, Some(7))],
            integers: (-1, 2, 3, -4, 0.5),
            objects: [Member { words: ["a", "b"] }, Member { words: ["c", "d"] }],
        };
        let text = to_pretty_string(&value).unwrap();
        let expected = r#"{
  "n": 0.1,
  "none": null,
  "\"q\"": "a\nb",
  "empty": [],
  "rows": [
    [1, 0, true, null],
    [1e300, 2.5, false, 7]
  ],
  "integers": [-1, 2, 3, -4, 0.5],
  "objects": [
    {
      "words": ["a", "b"]
    },
    {
      "words": ["c", "d"]
    }
  ]
}
"#;
        assert_eq!(text, expected);
        let read: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(read["rows"][1][2], false);
    }
}
