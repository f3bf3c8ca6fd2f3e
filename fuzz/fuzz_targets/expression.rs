//! Parses arbitrary text as an expression, a quantity and a caption.

#![no_main]

#[path = "../../tests/integration/corpus/checks.rs"]
#[expect(dead_code, reason = "each target uses one of the checks")]
mod checks;

libfuzzer_sys::fuzz_target!(|text: &str| checks::expression(text));
