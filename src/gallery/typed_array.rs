//! Columns of numbers in JSON.
//!
//! A column of equal numbers is that number: most columns of a grid are constant over the cells of a page. Any other
//! column is the bytes of a typed array, little-endian, in base64, which a page reads quickly and exactly. Points take half of
//! that as differences.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

fn base64<const N: usize>(bytes: impl Iterator<Item = [u8; N]>) -> Value {
    let bytes: Vec<u8> = bytes.flatten().collect();
    Value::String(BASE64_STANDARD.encode(bytes))
}

/// The number that all of some numbers are equal to.
fn constant<T: Copy + PartialEq>(numbers: &[T]) -> Option<T> {
    numbers.first().copied().filter(|first| numbers.iter().all(|number| number == first))
}

/// A column of double-precision numbers; NaN stands for missing values, and null for a column of them.
pub(super) fn f64s(numbers: impl IntoIterator<Item = f64>) -> Value {
    // NaN has many bit patterns; only one is written, so that equal data have equal bytes.
    let canonical = |number: f64| if number.is_nan() { f64::NAN } else { number };
    let numbers: Vec<f64> = numbers.into_iter().map(canonical).collect();
    // Numbers are compared by their bits, which tell 0 from -0.
    let bits: Vec<u64> = numbers.iter().map(|number| number.to_bits()).collect();
    match constant(&bits).map(f64::from_bits) {
        Some(number) if number.is_nan() => Value::Null,
        Some(number) if number.is_finite() => json!(number),
        _ => base64(numbers.iter().map(|number| number.to_le_bytes())),
    }
}

/// A column of 32-bit integers; larger numbers become the greatest one.
pub(super) fn u32s(numbers: impl IntoIterator<Item = usize>) -> Value {
    let numbers: Vec<u32> = numbers.into_iter().map(|number| u32::try_from(number).unwrap_or(u32::MAX)).collect();
    constant(&numbers).map_or_else(|| base64(numbers.iter().map(|number| number.to_le_bytes())), |number| json!(number))
}

/// A column of 16-bit integers; larger numbers become the greatest one.
pub(super) fn u16s(numbers: impl IntoIterator<Item = usize>) -> Value {
    let numbers: Vec<u16> = numbers.into_iter().map(|number| u16::try_from(number).unwrap_or(u16::MAX)).collect();
    constant(&numbers).map_or_else(|| base64(numbers.iter().map(|number| number.to_le_bytes())), |number| json!(number))
}

/// A column of 8-bit integers.
pub(super) fn u8s(numbers: impl IntoIterator<Item = u8>) -> Value {
    let numbers: Vec<u8> = numbers.into_iter().collect();
    constant(&numbers).map_or_else(|| base64(numbers.iter().map(|number| [*number])), |number| json!(number))
}

/// The points of curves as third differences, which are small where a curve is smooth: of each curve first all x, then all y. Each
/// is the deviation from the parabola through the three numbers before it, of which the first stands for those that there are not:
/// zigzag (0, -1, 1, -2, …), seven bits in a byte from the lowest on, of which all but the last have the bit 128.
pub(super) fn differences(curves: &[Vec<[u16; 2]>]) -> String {
    let mut bytes = Vec::new();
    for (points, axis) in curves.iter().flat_map(|points| [(points, 0), (points, 1)]) {
        let mut before = [0_i32; 3];
        for (k, point) in points.iter().enumerate() {
            let value = i32::from(point[axis]);
            let difference = value - (3 * (before[0] - before[1]) + before[2]);
            let mut rest = (difference << 1) ^ (difference >> 31);
            while rest > 127 {
                bytes.push((rest & 127) as u8 | 128);
                rest >>= 7;
            }
            bytes.push(rest as u8);
            before = if k == 0 { [value; 3] } else { [value, before[0], before[1]] };
        }
    }
    BASE64_STANDARD.encode(bytes)
}
