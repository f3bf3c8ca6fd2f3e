//! Reads arbitrary bytes as the file of a path.

#![no_main]

#[path = "../../tests/integration/corpus/checks.rs"]
#[expect(dead_code, reason = "each target uses one of the checks")]
mod checks;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| checks::path(bytes));
