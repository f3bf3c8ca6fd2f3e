//! The style sheets and scripts of the page.

/// A style sheet or script of the page.
#[derive(Clone, Copy, Debug)]
pub struct Asset {
    /// Its path, relative to `src/gallery`.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

include!(concat!(env!("OUT_DIR"), "/gallery_parts.rs"));

/// Joins modules, each after those it imports, into one script.
///
/// Imports are removed, and exports become plain definitions; the modules must therefore not declare the same name
/// twice at the top level.
pub fn join_modules(modules: &[Asset]) -> String {
    let mut script = String::new();
    for Asset { name, text } in modules {
        script.push_str(&format!("// {name}\n"));
        let mut in_import = false;
        for line in text.lines() {
            in_import |= line.starts_with("import ");
            if !in_import {
                script.push_str(line.strip_prefix("export ").unwrap_or(line));
                script.push('\n');
            }
            in_import &= !line.trim_end().ends_with(';');
        }
    }
    script
}
