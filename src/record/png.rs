//! Checks the integrity of PNG images.

/// Whether every chunk of a PNG is present and has its correct checksum.
pub fn is_intact_png(bytes: &[u8]) -> bool {
    let chunks = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n");
    let mut rest = chunks.unwrap_or_default();
    while let Some((body, after)) = read_chunk(rest) {
        if body == b"IEND" {
            return after.is_empty();
        }
        rest = after;
    }
    false
}

/// Splits off the type and data of the first chunk; `None` if the chunk is incomplete or its checksum is wrong.
fn read_chunk(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk()?;
    let (body, rest) = rest.split_at_checked((u32::from_be_bytes(*length) as usize).checked_add(4)?)?;
    let (checksum, rest) = rest.split_first_chunk()?;
    (crc32fast::hash(body) == u32::from_be_bytes(*checksum)).then_some((body, rest))
}
