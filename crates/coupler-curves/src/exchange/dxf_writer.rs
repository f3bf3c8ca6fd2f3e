//! Writes groups of DXF: a code and a value, each on its own line.

use std::fmt::{Display, Write};

use crate::geometry::Point;

/// A document in DXF.
#[derive(Default)]
pub(super) struct DxfWriter(pub String);

impl DxfWriter {
    pub fn group(&mut self, code: u16, value: impl Display) {
        // Writing to a string cannot fail.
        let _ = write!(self.0, "{code:3}\n{value}\n");
    }

    /// Writes a number in the fewest digits that read back to the same value, with a point or an exponent: some
    /// programs read a number without either as an integer.
    pub fn number(&mut self, code: u16, value: f64) {
        // Adding 0 removes the sign of zero.
        self.group(code, format_args!("{:?}", value + 0.0));
    }

    pub fn section(&mut self, name: &str) {
        self.group(0, "SECTION");
        self.group(2, name);
    }

    pub fn end_marker(&mut self, word: &str) {
        self.group(0, word);
    }

    pub fn coordinates(&mut self, first: u16, p: Point) {
        self.number(first, p.x);
        self.number(first + 10, p.y);
        self.number(first + 20, 0.0);
    }

    /// Writes a point of the header, with its first two or all three coordinates.
    pub fn header_point(&mut self, name: &str, p: Point, dimensions: usize) {
        self.group(9, name);
        for (code, value) in [(10, p.x), (20, p.y), (30, 0.0)].into_iter().take(dimensions) {
            self.number(code, value);
        }
    }
}
