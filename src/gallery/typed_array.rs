//! Typed arrays in JSON.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

/// The bytes of a typed array, little-endian, in base64: a page reads them quickly and exactly.
fn typed_array<const N: usize>(kind: &str, bytes: impl Iterator<Item = [u8; N]>) -> Value {
    let bytes: Vec<u8> = bytes.flatten().collect();
    json!({ "type": kind, "data": BASE64_STANDARD.encode(bytes) })
}

/// An array of double-precision numbers; NaN stands for missing values.
pub(super) fn f64s(numbers: impl IntoIterator<Item = f64>) -> Value {
    // NaN has many bit patterns; only one is written, so that equal data have equal bytes.
    let canonical = |number: f64| if number.is_nan() { f64::NAN } else { number };
    typed_array("f64", numbers.into_iter().map(|number| canonical(number).to_le_bytes()))
}

/// An array of 32-bit integers; larger numbers become the greatest one.
pub(super) fn u32s(numbers: impl IntoIterator<Item = usize>) -> Value {
    typed_array("u32", numbers.into_iter().map(|number| u32::try_from(number).unwrap_or(u32::MAX).to_le_bytes()))
}

/// An array of 16-bit integers.
pub(super) fn u16s(numbers: impl IntoIterator<Item = u16>) -> Value {
    typed_array("u16", numbers.into_iter().map(u16::to_le_bytes))
}

/// An array of 8-bit integers.
pub(super) fn u8s(numbers: impl IntoIterator<Item = u8>) -> Value {
    typed_array("u8", numbers.into_iter().map(|number| [number]))
}
