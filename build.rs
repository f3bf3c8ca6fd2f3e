//! Compresses the gallery's style sheets and scripts, with their names; each script comes after those it imports.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::ZlibEncoder;

const GALLERY: &str = "src/gallery";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-changed={GALLERY}");
    let root = Path::new(&std::env::var("CARGO_MANIFEST_DIR")?).join(GALLERY);
    let mut scripts = Vec::new();
    visit(&root.join("script/main.js"), &mut Vec::new(), &mut scripts)?;
    let mut styles: Vec<PathBuf> =
        fs::read_dir(root.join("style"))?.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?;
    // The base styles come first; the print styles come last, since they override the others.
    let has_name = |path: &Path, name: &str| path.file_name().is_some_and(|file| file == name);
    styles.sort_by_key(|path| (!has_name(path, "base.css"), has_name(path, "print.css"), path.clone()));
    let out = PathBuf::from(std::env::var("OUT_DIR")?);
    for (name, files) in [("styles", &styles), ("scripts", &scripts)] {
        let mut text = String::new();
        for file in files {
            let parts: Vec<_> = file.strip_prefix(&root)?.iter().map(|part| part.to_string_lossy()).collect();
            // Neither names nor texts have the character that ends them.
            text += &format!("{}\0{}\0", parts.join("/"), fs::read_to_string(file)?);
        }
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(text.as_bytes())?;
        fs::write(out.join(name).with_extension("zlib"), encoder.finish()?)?;
    }
    Ok(())
}

/// Adds a module to `found` after those it imports; `open` are the modules being visited, to detect cycles.
fn visit(module: &Path, open: &mut Vec<PathBuf>, found: &mut Vec<PathBuf>) -> Result<(), Box<dyn std::error::Error>> {
    if found.iter().any(|known| known == module) {
        return Ok(());
    }
    if open.iter().any(|known| known == module) {
        return Err(format!("{} imports itself through other modules", module.display()).into());
    }
    open.push(module.to_owned());
    let text = fs::read_to_string(module).map_err(|error| format!("{}: {error}", module.display()))?;
    for import in text.lines().filter_map(source) {
        let mut path = module.parent().unwrap_or(Path::new("")).to_owned();
        for step in import.split('/') {
            match step {
                "." => {}
                ".." => drop(path.pop()),
                name => path.push(name),
            }
        }
        visit(&path, open, found)?;
    }
    open.pop();
    found.push(module.to_owned());
    Ok(())
}

/// The path in an import statement that ends on this line.
fn source(line: &str) -> Option<&str> {
    let is_end = line.starts_with("import {") || line.starts_with("} from ");
    let (_, rest) = line.split_once(" from \"").filter(|_| is_end)?;
    rest.strip_suffix("\";")
}
