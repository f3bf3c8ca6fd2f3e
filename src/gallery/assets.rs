//! The page's own files, and how they become one.

/// A file of the page: its name below `src/gallery`, and its text.
#[derive(Clone, Copy, Debug)]
pub struct Asset {
    /// Its name.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

include!(concat!(env!("OUT_DIR"), "/gallery_parts.rs"));

/// Modules as one script: what they import from one another is there already, so that imports go and exports are plain
/// definitions. No two of them may use one name for two things at their top level.
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
