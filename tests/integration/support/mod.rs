//! What tests of several topics share: the program, folders and atlases, manifests, tables, and the texts of pages.

pub mod command;
pub mod curve_rows;
pub mod folder;
pub mod plan;
pub mod table;
pub mod texts;

/// Every other file runs the program by [`command::program`], in the same environment.
#[test]
fn no_other_file_names_the_program() {
    let tests = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/integration");
    let mut others = folder::tree(&tests);
    others.retain(|name, _| name.ends_with(".rs") && !name.starts_with("support/"));
    assert!(others.len() > 50);
    for (name, text) in others {
        assert!(!String::from_utf8(text).unwrap().contains("CARGO_BIN_EXE"), "{name}");
    }
}
