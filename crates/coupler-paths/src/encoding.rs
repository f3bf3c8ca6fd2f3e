//! The characters of a file.

/// The text in some bytes: UTF-8, UTF-16 with a byte order mark or without, or else Windows' western code page, in which
/// spreadsheets write a degree sign.
///
/// # Errors
/// They are no text.
pub(crate) fn decode(bytes: &[u8]) -> Result<String, String> {
    const NO_TEXT: &str = "it is no table of points, JSON, SVG or DXF";
    let (is_little_endian, units) = match bytes {
        [0xff, 0xfe, rest @ ..] => (true, rest),
        [0xfe, 0xff, rest @ ..] => (false, rest),
        // Western text has a zero for every other byte.
        [0, 1..=255, ..] => (false, bytes),
        [1..=255, 0, ..] => (true, bytes),
        _ => {
            let text = match std::str::from_utf8(bytes) {
                Ok(text) => text.trim_start_matches('\u{feff}').to_owned(),
                Err(_) => bytes.iter().copied().map(western).collect(),
            };
            // Old systems end files with a control character.
            let is_text = text.trim_end_matches('\u{1a}').chars().all(|c| !c.is_control() || c.is_whitespace());
            return if is_text { Ok(text) } else { Err(NO_TEXT.to_owned()) };
        }
    };
    let unit = |pair: &[u8]| match is_little_endian {
        true => u16::from_le_bytes([pair[0], pair[1]]),
        false => u16::from_be_bytes([pair[0], pair[1]]),
    };
    let units: Vec<u16> = units.chunks_exact(2).map(unit).collect();
    let text = String::from_utf16(&units).map_err(|_| NO_TEXT.to_owned())?;
    let is_text = text.chars().all(|c| !c.is_control() || c.is_whitespace());
    if is_text { Ok(text) } else { Err(NO_TEXT.to_owned()) }
}

/// A character of Windows' western code page: of ISO 8859-1, a dash, or another that no number has.
fn western(byte: u8) -> char {
    match byte {
        0x96 => '\u{2013}',
        0x80..=0x9f => char::REPLACEMENT_CHARACTER,
        byte => char::from(byte),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_read_in_the_encodings_of_spreadsheets() {
        let text = "x;y\n1,5;2 °\n";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let western: Vec<u8> = text.chars().map(|c| c as u8).collect();
        for bytes in [
            text.as_bytes(),
            &[b"\xef\xbb\xbf", text.as_bytes()].concat(),
            &[b"\xff\xfe", &little[..]].concat(),
            &[b"\xfe\xff", &big[..]].concat(),
            &little,
            &big,
            &western,
        ] {
            assert_eq!(decode(bytes).as_deref(), Ok(text), "{bytes:?}");
        }
        assert_eq!(decode(b"\x931\x94;\x962").as_deref(), Ok("\u{fffd}1\u{fffd};\u{2013}2"));
        for bytes in [
            &b"\x89PNG\r\n\x1a\n\0\0\0"[..],
            b"\x89PNG\r\n\x1a\n",
            b"%PDF-1.7\n\xb5\x01",
            b"\xff\xfe\x00\xd8",
            b"1,2\n\0\0",
        ] {
            assert!(decode(bytes).is_err(), "{bytes:?}");
        }
        assert_eq!(decode(b"").as_deref(), Ok(""));
    }
}
