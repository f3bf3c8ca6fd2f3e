//! Names of joints that a manifest accepts, each of one joint.

use std::collections::HashSet;

use coupler_curves::text::is_invisible;

/// Names that have been given.
#[derive(Debug, Default)]
pub struct Names(HashSet<String>);

impl Names {
    /// The name of a joint that a file calls `wanted`: without characters that a manifest refuses, and with a number if another joint has it.
    pub fn distinct(&mut self, wanted: &str) -> String {
        let acceptable = acceptable(wanted);
        let numbered = (2..).map(|k| format!("{acceptable}-{k}"));
        let name = [acceptable.clone()].into_iter().chain(numbered).find(|name| !self.0.contains(name));
        let name = name.unwrap_or(acceptable);
        self.0.insert(name.clone());
        name
    }
}

/// A name without blanks, which divide the two joints of a line, and without what does not show or begins a formula.
fn acceptable(wanted: &str) -> String {
    /// The most characters of a name.
    const MAX_LENGTH: usize = 40;
    let shown = wanted.trim().chars().filter(|&c| c.is_whitespace() || !is_invisible(c));
    let name: String = shown.map(|c| if c.is_whitespace() { '_' } else { c }).take(MAX_LENGTH).collect();
    match name.chars().next() {
        None => "J".to_owned(),
        Some(c) if c.is_alphanumeric() || matches!(c, '_' | '\'') => name,
        // It may begin like a formula.
        Some(_) => format!("J{name}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_acceptable_and_distinct() {
        let mut names = Names::default();
        let given =
            [("A", "A"), ("A", "A-2"), (" the pin ", "the_pin"), ("", "J"), ("=1+1", "J=1+1"), ("A\u{202e}", "A-3")];
        for (wanted, name) in given {
            assert_eq!(names.distinct(wanted), name);
        }
    }
}
