//! Numbers of an SVG, in as few characters as possible.

/// A length in whole micrometres.
#[inline]
pub(super) fn to_micrometres(mm: f64) -> i64 {
    (mm * 1000.0).round() as i64
}

/// A length in micrometres that is written in millimetres, in as few characters as possible.
#[derive(Clone, Copy)]
pub(super) struct Number(pub i64);

impl Number {
    /// The text of the number, at the end of a buffer. An SVG consists mostly of numbers, and this is faster than
    /// `fmt`.
    #[inline]
    pub fn format_into(self, buffer: &mut [u8; 24]) -> &str {
        let (mut whole, mut part) = (self.0.unsigned_abs() / 1000, self.0.unsigned_abs() % 1000);
        let mut at = buffer.len();
        let mut push = |byte: u8| {
            at -= 1;
            buffer[at] = byte;
        };
        if part > 0 {
            let mut digits = 3;
            while part % 10 == 0 {
                part /= 10;
                digits -= 1;
            }
            for _ in 0..digits {
                push(b'0' + (part % 10) as u8);
                part /= 10;
            }
            push(b'.');
        }
        while whole > 0 {
            push(b'0' + (whole % 10) as u8);
            whole /= 10;
        }
        match self.0.signum() {
            -1 => push(b'-'),
            0 => push(b'0'),
            _ => {}
        }
        std::str::from_utf8(&buffer[at..]).unwrap_or_default()
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.format_into(&mut [0; 24]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
