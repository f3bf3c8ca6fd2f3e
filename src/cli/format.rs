//! Numbers and counts, as text.

pub(super) use coupler_curves::exchange::format_significant;

/// "1 page", "2 pages".
pub(super) fn pluralize(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}
