//! Reads arbitrary text as a recorded `points.csv`.

#![no_main]

#[path = "../../tests/integration/corpus/checks.rs"]
#[expect(dead_code, reason = "each target uses one of the checks")]
mod checks;

libfuzzer_sys::fuzz_target!(|text: &str| checks::points(text));
