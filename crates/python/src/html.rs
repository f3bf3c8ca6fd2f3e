//! What notebooks show as HTML.

/// A text as HTML, also in an attribute.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A row of a table, of cells `td` or `th` with these texts.
pub fn row(cell: &str, texts: &[&str]) -> String {
    row_of(cell, texts.iter().map(|text| escaped(text)))
}

/// The same with what is HTML already.
pub fn row_of(cell: &str, contents: impl Iterator<Item = String>) -> String {
    let cells: String = contents.map(|content| format!("<{cell}>{content}</{cell}>")).collect();
    format!("<tr>{cells}</tr>")
}

/// A text as an address that has it in it.
pub fn address(kind: &str, text: &str) -> String {
    text.bytes().fold(format!("data:{kind},"), |mut address, byte| {
        match byte {
            b'%' | b'"' | b'#' | b'&' | b'<' | b'>' | b'\'' | 0..=31 | 127.. => address += &format!("%{byte:02X}"),
            _ => address.push(char::from(byte)),
        }
        address
    })
}

/// A drawing so many pixels wide, apart from all others: ids in SVG hold for a whole notebook.
pub fn picture(svg: &str, title: &str, width: usize) -> String {
    let address = address("image/svg+xml", svg);
    format!("<img src=\"{address}\" width=\"{width}\" alt=\"{0}\" title=\"{0}\">", escaped(title))
}
