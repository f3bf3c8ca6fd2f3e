//! Bytes as text of ASCII, an eleventh shorter than in base64.

/// The characters of basE91 (Joachim Henke), but for `<`, which could end an element of the page.
const LETTERS: &[u8; 91] =
    b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789!#$%&()*+,./:;-=>?@[]^_`{|}~\"";

/// Bytes in basE91 with `-` in place of `<`: 13 bits in two characters, or 14 where they are few. The page decodes them, see
/// `script/data/packed.js`.
pub fn encode_base91(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() * 5 / 4);
    let mut push = |value: u32| text.extend([value % 91, value / 91].map(|digit| char::from(LETTERS[digit as usize])));
    // The bits that are not written yet, the first ones lowest.
    let (mut bits, mut count) = (0u32, 0);
    for byte in bytes {
        bits |= u32::from(*byte) << count;
        count += 8;
        if count > 13 {
            // The values of 13 bits leave some pairs of characters for values of 14 bits.
            let taken = if bits & 8191 > 88 { 13 } else { 14 };
            push(bits & ((1 << taken) - 1));
            bits >>= taken;
            count -= taken;
        }
    }
    if count > 0 {
        push(bits);
        if count < 8 && bits < 91 {
            text.pop();
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The decoder of the page in Rust.
    fn decode(text: &str) -> Vec<u8> {
        let (mut bytes, mut bits, mut count, mut first) = (Vec::new(), 0u32, 0, None);
        for letter in text.bytes() {
            let digit = LETTERS.iter().position(|known| *known == letter).unwrap() as u32;
            let Some(low) = first.take() else {
                first = Some(digit);
                continue;
            };
            let value = low + 91 * digit;
            bits |= value << count;
            count += if value & 8191 > 88 { 13 } else { 14 };
            while count > 7 {
                bytes.push(bits as u8);
                bits >>= 8;
                count -= 8;
            }
        }
        bytes.extend(first.map(|digit| (bits | digit << count) as u8));
        bytes
    }

    #[test]
    fn texts_are_those_of_base91_and_read_back() {
        for (bytes, text) in [("", ""), ("test", "fPNKd"), ("Hello World!", ">OwJh>Io0Tv!8PE")] {
            assert_eq!(encode_base91(bytes.as_bytes()), text);
        }
        for length in 0..300usize {
            for factor in [0usize, 1, 7, 255, 0x9E37] {
                let bytes: Vec<u8> = (0..length).map(|k| ((k * k * factor) >> 3) as u8).collect();
                let text = encode_base91(&bytes);
                assert_eq!(decode(&text), bytes);
                assert!(!text.contains('<') && text.len() <= bytes.len() * 16 / 13 + 2);
            }
        }
    }
}
