//! Numbers, counts and characters in texts for people.

mod interned;
mod number;
mod words;

pub use interned::interned;
pub use number::{
    exact_decimals, format_as_written, format_exactly, format_fixed, format_for_building, format_in_full,
    format_in_full_if_short, is_same_number, round_to_six_digits,
};
pub use words::{is_control_or_directional, is_invisible, pluralize};

// For the other crates of the workspace only.
#[doc(hidden)]
pub use {number::round_apart, words::divide_word};
