//! The style sheets and scripts of the page.

use std::io::Read;
use std::sync::LazyLock;

use flate2::read::ZlibDecoder;

/// A style sheet or script of the page.
#[derive(Clone, Copy, Debug)]
pub struct Asset {
    /// Its path, relative to `src/gallery`.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

/// The page's style sheets, in order.
pub fn styles() -> &'static [Asset] {
    static STYLES: LazyLock<Vec<Asset>> =
        LazyLock::new(|| unpack(include_bytes!(concat!(env!("OUT_DIR"), "/styles.zlib"))));
    &STYLES
}

/// The page's scripts, each after those it imports.
pub fn scripts() -> &'static [Asset] {
    static SCRIPTS: LazyLock<Vec<Asset>> =
        LazyLock::new(|| unpack(include_bytes!(concat!(env!("OUT_DIR"), "/scripts.zlib"))));
    &SCRIPTS
}

/// Names and texts, each ended by a zero, as the build script compresses them. They stay in memory until the program ends.
fn unpack(compressed: &[u8]) -> Vec<Asset> {
    let mut text = String::new();
    ZlibDecoder::new(compressed).read_to_string(&mut text).expect("the build script has compressed them");
    let parts: Vec<&'static str> = text.leak().split_terminator('\0').collect();
    let (pairs, _) = parts.as_chunks();
    pairs.iter().map(|[name, text]| Asset { name, text }).collect()
}

/// Joins modules, each after those it imports, into one script without comments and indentation.
///
/// Imports are removed, and exports become plain definitions; the modules must therefore not declare the same name
/// twice at the top level.
pub fn join_modules(modules: &[Asset]) -> String {
    let statements = modules.iter().flat_map(|Asset { text, .. }| {
        let mut in_import = false;
        text.lines().filter_map(move |line| {
            let is_import = in_import || line.starts_with("import ");
            in_import = is_import && !line.ends_with(';');
            (!is_import).then(|| line.strip_prefix("export ").unwrap_or(line))
        })
    });
    compact(statements)
}

/// Lines of a script without indentation, without empty lines, and without the lines that are comments.
///
/// A literal over several lines would lose its indentation: the scripts have none.
pub fn compact<'l>(lines: impl Iterator<Item = &'l str>) -> String {
    let mut in_comment = false;
    let code = lines.map(str::trim).filter(|line| {
        let is_comment =
            in_comment || line.starts_with("//") || line.starts_with("/*") && !has_code_after_comment(line);
        in_comment = (in_comment || line.starts_with("/*")) && !line.contains("*/");
        !is_comment && !line.is_empty()
    });
    code.flat_map(|line| [line, "\n"]).collect()
}

/// Whether a line, which begins with a comment, has code after it.
fn has_code_after_comment(line: &str) -> bool {
    line.split_once("*/").is_some_and(|(_, code)| !code.is_empty())
}
