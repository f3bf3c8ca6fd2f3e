//! The files the page is joined from.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use coupler_atlas::gallery::{Asset, join_modules, scripts, styles};

/// The names that a module imports, with the file each comes from.
fn imports(part: &Asset) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for statement in part.text.split("import ").skip(1) {
        let Some((names, rest)) = statement.strip_prefix('{').and_then(|rest| rest.split_once("} from \"")) else {
            continue;
        };
        let from = rest.split('"').next().unwrap();
        let folder = Path::new(part.name).parent().unwrap();
        let mut path: Vec<&str> = folder.iter().map(|part| part.to_str().unwrap()).collect();
        for step in from.split('/') {
            match step {
                "." => {}
                ".." => drop(path.pop()),
                name => path.push(name),
            }
        }
        let path = path.join("/");
        found.extend(
            names.split(',').map(str::trim).filter(|name| !name.is_empty()).map(|name| (name.to_owned(), path.clone())),
        );
    }
    found
}

/// The names that a module defines at its top level, and whether it exports them.
fn definitions(part: &Asset) -> Vec<(String, bool)> {
    let definition = |line: &str| {
        let (line, is_exported) = line.strip_prefix("export ").map_or((line, false), |line| (line, true));
        let kinds = ["async function* ", "async function ", "function* ", "function ", "class ", "const ", "let "];
        let rest = kinds.iter().find_map(|kind| line.strip_prefix(kind))?;
        let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || "_$".contains(*c)).collect();
        Some((name, is_exported))
    };
    part.text.lines().filter_map(definition).collect()
}

#[test]
fn every_file_of_the_page_is_in_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/gallery");
    let mut open = vec![root.join("script"), root.join("style")];
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|kind| kind == "js" || kind == "css") {
                let name = path.strip_prefix(&root).unwrap();
                found.push(name.iter().map(|part| part.to_str().unwrap()).collect::<Vec<_>>().join("/"));
            }
        }
    }
    found.sort();
    let mut named: Vec<&str> = scripts().iter().chain(styles()).map(|part| part.name).collect();
    named.sort_unstable();
    assert_eq!(named, found);
}

#[test]
fn a_module_comes_after_its_imports_and_they_export_the_names_it_uses() {
    let mut exports: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for part in scripts() {
        for (name, from) in imports(part) {
            let exported =
                exports.get(from.as_str()).unwrap_or_else(|| panic!("{}: {from} does not come before it", part.name));
            assert!(exported.contains(&name), "{}: {from} does not export {name}", part.name);
        }
        let exported = definitions(part).into_iter().filter(|(_, is_exported)| *is_exported).map(|(name, _)| name);
        exports.insert(part.name, exported.collect());
    }
}

#[test]
fn no_name_is_defined_twice() {
    let mut files: BTreeMap<String, &str> = BTreeMap::new();
    for part in scripts() {
        for (name, _) in definitions(part) {
            assert!(!name.is_empty(), "{}: a definition without a single name", part.name);
            if let Some(other) = files.insert(name.clone(), part.name) {
                panic!("{name} is defined in {other} and in {}", part.name);
            }
        }
    }
}

#[test]
fn joined_modules_import_and_export_nothing() {
    let parts = [
        Asset { name: "a.js", text: "export const A = 1;\n" },
        Asset { name: "b.js", text: "import {\n  A,\n} from \"./a.js\";\n\nexport function b() {\n  return A;\n}\n" },
    ];
    assert_eq!(join_modules(&parts), "const A = 1;\nfunction b() {\nreturn A;\n}\n");
    let all = join_modules(scripts());
    assert!(all.lines().all(|line| !line.starts_with("import ") && !line.starts_with("export ")));
}

#[test]
fn joined_modules_have_no_lines_of_comments_and_no_indentation() {
    let text = "// a\n/**\n * b\n */\nfunction f() {\n  /** c */\n\n  /** @type {d} */ return 1; // e\n}\n";
    let part = Asset { name: "a.js", text };
    assert_eq!(join_modules(&[part]), "function f() {\n/** @type {d} */ return 1; // e\n}\n");
}

/// Such a literal would lose its indentation when modules are joined.
#[test]
fn no_literal_spans_lines() {
    for part in scripts() {
        let is_comment = |line: &str| ["*", "//", "/*"].iter().any(|start| line.trim_start().starts_with(start));
        for line in part.text.lines().filter(|line| !is_comment(line)) {
            assert!(line.matches('`').count() % 2 == 0 && !line.ends_with('\\'), "{}: {line}", part.name);
        }
    }
}

#[test]
fn text_never_becomes_markup_or_code() {
    let banned = [
        "innerHTML",
        // Read, it is text: that of the file of a plate.
        "outerHTML =",
        "insertAdjacentHTML",
        "document.write",
        "eval(",
        "new Function",
        " fetch(",
        "XMLHttpRequest",
        "WebSocket",
        "</script",
        "import(",
        "style: `",
        "setAttribute(\"style\"",
    ];
    for part in scripts() {
        for word in banned {
            assert!(!part.text.contains(word), "{} has {word}", part.name);
        }
    }
}

/// Each file is short enough to be read as a whole.
#[test]
fn files_are_small() {
    for (parts, most) in [(scripts(), 249), (styles(), 400)] {
        for part in parts {
            let lines = part.text.lines().count();
            assert!(lines <= most, "{} has {lines} lines", part.name);
        }
    }
}

/// All JavaScript together is short enough to be known.
#[test]
fn the_scripts_are_small_together() {
    let loader = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/gallery/loader.js")).unwrap();
    let texts = scripts().iter().map(|part| part.text).chain([loader.as_str()]);
    let lines: usize = texts.map(|text| text.lines().count()).sum();
    assert!(lines <= 12_000, "they have {lines} lines");
}
