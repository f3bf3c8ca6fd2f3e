//! Numbers of an SVG, in as few characters as possible.

use std::fmt::{self, Write};

/// A length in whole micrometres, the nearest; of two the one further from zero.
#[inline]
pub(super) fn to_micrometres(mm: f64) -> i64 {
    /// The number before a half: rounding of the sum makes a half of it, but only where that is needed.
    const HALF: f64 = 0.5 - f64::EPSILON / 4.0;
    let micrometres = mm * 1000.0;
    // As `f64::round`, which is a call where the processor may be an old one.
    (micrometres + HALF.copysign(micrometres)) as i64
}

/// A length in micrometres that is written in millimetres, in as few characters as possible.
#[derive(Clone, Copy)]
pub(super) struct Number(pub i64);

impl Number {
    /// Writes the number. An SVG consists mostly of numbers, and for a `String` this is faster than `Display`.
    #[inline]
    pub fn write_to(self, out: &mut impl Write) -> fmt::Result {
        let (whole, part) = (self.0.unsigned_abs() / 1000, (self.0.unsigned_abs() % 1000) as u32);
        if self.0 < 0 {
            out.write_char('-')?;
        }
        if whole > 0 || part == 0 {
            write_whole(whole, out)?;
        }
        if part > 0 {
            out.write_char('.')?;
            out.write_char(digit(part / 100))?;
            if part % 100 > 0 {
                out.write_char(digit(part / 10 % 10))?;
                if part % 10 > 0 {
                    out.write_char(digit(part % 10))?;
                }
            }
        }
        Ok(())
    }
}

fn write_whole(whole: u64, out: &mut impl Write) -> fmt::Result {
    if whole >= 10 {
        write_whole(whole / 10, out)?;
    }
    out.write_char(digit((whole % 10) as u32))
}

#[inline]
fn digit(value: u32) -> char {
    char::from(b'0' + value as u8)
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_to(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn micrometres_are_rounded() {
        let halves = (-2000..2000).map(|k| f64::from(k) / 2.0).chain([0.1, 4e15, 9e15 + 1.0, 1e300, f64::NAN]);
        for micrometres in halves.flat_map(|value| [value.next_down(), value, value.next_up()]) {
            let mm = micrometres / 1000.0;
            assert_eq!(to_micrometres(mm), (mm * 1000.0).round() as i64, "{micrometres}");
        }
    }

    #[test]
    fn numbers_are_short() {
        for (micrometres, written) in [
            (0, "0"),
            (500, ".5"),
            (-10, "-.01"),
            (1234, "1.234"),
            (-2000, "-2"),
            (1050, "1.05"),
            (40_100, "40.1"),
            (i64::MIN, "-9223372036854775.808"),
        ] {
            assert_eq!(Number(micrometres).to_string(), written);
        }
    }
}
