use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

/// Numbers as the bytes of a typed array, least first, in base64: a page reads them in no time, to the last bit.
fn typed_array<const N: usize>(kind: &str, bytes: impl Iterator<Item = [u8; N]>) -> Value {
    let bytes: Vec<u8> = bytes.flatten().collect();
    json!({ "type": kind, "data": BASE64_STANDARD.encode(bytes) })
}

/// Numbers; not a number where one does not apply.
pub(super) fn f64s(numbers: impl IntoIterator<Item = f64>) -> Value {
    // There are many that are not numbers; they are written as one.
    let canonical = |number: f64| if number.is_nan() { f64::NAN } else { number };
    typed_array("f64", numbers.into_iter().map(|number| canonical(number).to_le_bytes()))
}

/// Whole numbers; the greatest there is in place of one beyond.
pub(super) fn u32s(numbers: impl IntoIterator<Item = usize>) -> Value {
    typed_array("u32", numbers.into_iter().map(|number| u32::try_from(number).unwrap_or(u32::MAX).to_le_bytes()))
}

/// Small whole numbers.
pub(super) fn u16s(numbers: impl IntoIterator<Item = u16>) -> Value {
    typed_array("u16", numbers.into_iter().map(u16::to_le_bytes))
}

/// Numbers up to 255.
pub(super) fn u8s(numbers: impl IntoIterator<Item = u8>) -> Value {
    typed_array("u8", numbers.into_iter().map(|number| [number]))
}
