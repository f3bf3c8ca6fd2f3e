//! Measures a linkage of the catalogue with any parameters.

#![no_main]

#[path = "../../tests/integration/corpus/any_linkage.rs"]
#[expect(dead_code, reason = "the name of a linkage is for the tests")]
mod any_linkage;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    any_linkage::measures(bytes);
});
