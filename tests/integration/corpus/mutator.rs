//! Random small changes of a text, the same in every run.

/// Makes random changes, from a seed.
pub struct Mutator(u64);

/// The tokens that are inserted into texts: some have a meaning in one of the formats, others are rarely expected.
const TOKENS: [&str; 40] = [
    "0",
    "-1",
    "1e308",
    "1e-308",
    "nan",
    "inf",
    "9223372036854775808",
    "0x7f",
    "1_0",
    "\"",
    "'",
    "\"\"\"",
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    ".",
    "#",
    "\n",
    "\r\n",
    "\\u0000",
    "\\U0010FFFF",
    "é",
    "\u{1f980}",
    "\u{0}",
    "\u{85}",
    "\u{feff}",
    "(",
    ")",
    "^",
    "-",
    " deg",
    "[[family]]\n",
    "[[linkage]]\n",
    "true",
    "[]",
    "{}",
    "not ",
];

impl Mutator {
    pub fn new(seed: u64) -> Mutator {
        Mutator(seed)
    }

    /// A random number below `n` (Knuth's MMIX generator).
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n.max(1)
    }

    /// A random position between two characters.
    fn position(&mut self, text: &str) -> usize {
        let mut at = self.below(text.len() + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }

    /// A random short part of a text.
    fn part(&mut self, text: &str) -> std::ops::Range<usize> {
        let from = self.position(text);
        let length = 1 + self.below(30);
        let to = text[from..].char_indices().nth(length).map_or(text.len(), |(at, _)| from + at);
        from..to
    }

    /// A text with a few changes.
    pub fn change(&mut self, text: &str) -> String {
        let mut out = text.to_owned();
        for _ in 0..1 + self.below(3) {
            let (part, at) = (self.part(&out), self.position(&out));
            let word = out[part.clone()].to_owned();
            match self.below(5) {
                0 => out.replace_range(part, ""),
                1 => out.insert_str(at, &word),
                2 => out.insert_str(at, TOKENS[self.below(TOKENS.len())]),
                3 => out.replace_range(part, TOKENS[self.below(TOKENS.len())]),
                _ => out.truncate(at),
            }
        }
        out
    }

    /// A text in which a few numbers are of any size, from 10^-300 to 10^300 and of either sign, or are those that are special.
    pub fn change_numbers(&mut self, text: &str) -> String {
        let is_part = |c: char| c.is_ascii_digit() || c == '.';
        let mut out = text.to_owned();
        for _ in 0..1 + self.below(3) {
            let at = self.position(&out);
            let Some(from) = out[at..].find(|c: char| c.is_ascii_digit()).map(|digit| at + digit) else { continue };
            let to = out[from..].find(|c| !is_part(c)).map_or(out.len(), |end| from + end);
            let sign = ["", "-"][self.below(2)];
            let number = match self.below(8) {
                0 => "0".to_owned(),
                1 => "1e-320".to_owned(),
                2 => "9007199254740993".to_owned(),
                _ => format!("{sign}{}e{}", 1 + self.below(9), self.below(601) as i32 - 300),
            };
            out.replace_range(from..to, &number);
        }
        out
    }
}
