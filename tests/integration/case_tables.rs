//! Cases in a file: the same atlas as with cases in the manifest, what is wrong in a file, and what is made again when it changes.

use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use coupler_atlas::manifest::{self, ParseOutcome};
use coupler_atlas::manifest_files::ManifestFiles;
use tempfile::TempDir;

use crate::support::command::{folder_with, printed, program, result, run};
use crate::support::folder::{times, tree};

/// A family whose cases come from `cases`, with a helper `q`, and another family.
const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg"]
[[family]]
id = "listed"
linkage = "evans"
sampling = { samples = 24 }
panels = [2, 1]
cases = CASES
let = { a = "(1 + p)^1.5 / q" }
where = "length > 1"
sort = "-length"
[[family]]
id = "other"
linkage = "hoeken"
sampling = { samples = 24 }
cases = [{}]
"#;

const INLINE: &str = "[{ p = 2, q = 2 }, { p = 3, q = 2.1 }, { p = 0.1e2, q = 2 }, { p = 2.5, q = 1.9 }]";

const TABLE: &str = "p,q\n2,2\n3,2.1\n0.1e2,2\n2.5,1.9\n";

/// A manifest whose cases are in `list.csv`.
fn with_table() -> String {
    MANIFEST.replace("CASES", "\"list.csv\"")
}

/// A folder with such a manifest and a table.
fn folder(table: impl AsRef<[u8]>) -> TempDir {
    let folder = folder_with(&with_table());
    fs::write(folder.path().join("list.csv"), table).unwrap();
    folder
}

/// The manifest as it is read in a folder.
fn parse(folder: &Path, text: &str) -> ParseOutcome {
    manifest::parse_with_files(text, Some(&ManifestFiles::new(&folder.join("atlas.toml"))))
}

/// The messages and remedies of what is wrong with a table.
fn problems(table: impl AsRef<[u8]>) -> Vec<(String, String)> {
    let folder = folder(table);
    problems_of(folder.path(), &with_table())
}

fn problems_of(folder: &Path, text: &str) -> Vec<(String, String)> {
    let outcome = parse(folder, text);
    assert!(outcome.plan.is_none());
    let place = text.find("\"list.").map(|start| start..start + text[start..].find('\n').unwrap());
    for problem in outcome.problems.iter().take(500) {
        assert!(!problem.help.is_empty(), "{problem:?}");
        assert_eq!(Some(&problem.span), place.as_ref(), "{problem:?}");
    }
    outcome.problems.into_iter().map(|problem| (problem.message, problem.help)).collect()
}

fn messages(table: impl AsRef<[u8]>) -> Vec<String> {
    problems(table).into_iter().map(|(message, _)| message).collect()
}

#[test]
fn the_same_cases_in_a_table_give_the_same_files() {
    let inline = folder_with(&MANIFEST.replace("CASES", INLINE));
    printed(inline.path(), &["render"]);
    // As a spreadsheet writes it: a byte order mark, the line ends of Windows, quotes, blank lines, and no end of the last line.
    let spreadsheet = "\u{feff}\"p\" , q\r\n2,2\r\n\r\n 3 ,\"2.1\"\r\n10,2\r\n\n2.5,1.9";
    for table in [TABLE, spreadsheet] {
        let tabled = folder(table);
        printed(tabled.path(), &["render"]);
        let [mut expected, mut found] = [&inline, &tabled].map(|folder| tree(&folder.path().join("out")));
        // The record has other inputs.
        for files in [&mut expected, &mut found] {
            files.retain(|name, _| !name.ends_with("run.json"));
        }
        assert_eq!(expected.keys().collect::<Vec<_>>(), found.keys().collect::<Vec<_>>());
        for (name, bytes) in &expected {
            assert!(found[name] == *bytes, "{name}");
        }
        assert!(expected.keys().any(|name| name.ends_with("listed-002.svg")), "{:?}", expected.keys());
        printed(tabled.path(), &["check", "--against", "out"]);
    }
    let names: &[&str] = &["export", "atlas.toml", "listed:3.1.1", "--format", "csv"];
    assert_eq!(printed(inline.path(), names), printed(folder(TABLE).path(), names));
}

#[test]
fn a_table_is_relative_to_the_manifest_or_to_the_current_folder() {
    let outer = TempDir::new().unwrap();
    let inner = outer.path().join("inner");
    fs::create_dir_all(inner.join("tables")).unwrap();
    let text = with_table().replace("list.csv", "tables/list.csv");
    fs::write(inner.join("atlas.toml"), &text).unwrap();
    fs::write(inner.join("tables/list.csv"), TABLE).unwrap();
    printed(outer.path(), &["validate", "inner/atlas.toml"]);
    let input = |folder: &Path| {
        let file = File::open(inner.join("atlas.toml")).unwrap();
        result(program(folder).args(["validate", "-"]).stdin(file).output().unwrap())
    };
    assert_eq!(input(&inner).0, 0);
    let (code, _, err) = input(outer.path());
    assert!(code == 2 && err.contains("cannot read `tables/list.csv`: No such file"), "{err}");
}

#[test]
fn each_mistake_in_a_table_is_named_with_its_place() {
    for (table, expected) in [
        ("", "`list.csv`: it is empty"),
        ("\n\n", "`list.csv`: it is empty"),
        ("p,q\n", "there are no cases"),
        ("p;k\n2;2\n", "`list.csv`, line 1: its columns are not separated by commas"),
        ("p,q,p\n2,2,3\n", "in `list.csv`, there are two columns `p`"),
        ("p,q,\n2,2,3\n", "in `list.csv`, column 3: the name `` cannot be used in an expression"),
        ("p,q,a b\n2,2,3\n", "in `list.csv`, column 3: the name `a b` cannot be used in an expression"),
        ("p,q,u\n2,2,3\n", "in `list.csv`, `u` is not a parameter of `evans`, and no expression uses it"),
        ("p,q,length\n2,2,3\n", "in `list.csv`, `length` is the name of a column"),
        ("p,q\n\n2,2\n3,x\n", "`list.csv`, line 4, column `q`: expected a finite number, found `x`"),
        ("p,q\r\n\r\n2,2\r\n3,1 + 1\r\n", "`list.csv`, line 4, column `q`: expected a finite number, found `1 + 1`"),
        ("p,q\n2,\n", "`list.csv`, line 2, column `q`: expected a finite number, found nothing"),
        ("p,q\n2,NaN\n", "`list.csv`, line 2, column `q`: expected a finite number, found `NaN`"),
        ("p,q\n2,1e999", "`list.csv`, line 2, column `q`: expected a finite number, found `1e999`"),
        ("p,q\n2,2\n3,2,5\n", "`list.csv`, line 3: expected 2 values, one for each column, found 3"),
    ] {
        assert_eq!(messages(table), [expected], "{table:?}");
    }
    assert_eq!(messages(b"p,q\n2,2\n2,\xff\n"), ["`list.csv`, line 3: it is not UTF-8"]);
    assert_eq!(messages(b"\xff\xfep\0\n\0"), ["`list.csv`, line 1: it is not UTF-8"]);
    let help = |table: &str| problems(table)[0].1.clone();
    assert!(help("p,q,r_\n2,2,3\n").starts_with("did you mean `r`?"), "{}", help("p,q,r_\n2,2,3\n"));
}

#[test]
fn a_value_that_no_cell_can_have_is_named_with_its_line() {
    let found = problems("p,q\n2,2\n\n-0.5,2\n-0.25,2\n");
    let [(message, help)] = &found[..] else { panic!("{found:?}") };
    assert!(message.starts_with("in cell 2 (`list.csv`, line 4: p = -0.5, "), "{message}");
    assert!(help.starts_with("give `p` a value of more than 0 there; one more cell"), "{help}");
    let text = with_table().replace("let = { a = \"(1 + p)^1.5 / q\" }\n", "").replace("length > 1", "q > 1");
    let folder = folder(TABLE);
    let found = problems_of(folder.path(), &text);
    let [(message, help)] = &found[..] else { panic!("{found:?}") };
    assert!(
        message.ends_with("`a` has no value") && help.starts_with("give it in a column of `list.csv`"),
        "{found:?}"
    );
}

#[test]
fn all_problems_are_found_in_one_run_up_to_a_limit() {
    assert_eq!(messages("p,q,u\n2,x,1\n3,2\n3,inf,2\n").len(), 4);
    let rows = "2,x\n".repeat(2_000);
    let found = messages(format!("p,q\n{rows}"));
    assert_eq!(found.len(), 500 + 1);
    assert_eq!(found[499], "`list.csv`, line 501, column `q`: expected a finite number, found `x`");
    assert!(found[500].contains("1500 more problems"), "{}", found[500]);
}

#[test]
fn the_limits_are_those_of_cases_in_the_manifest() {
    let both = [("list", with_table()), ("inline", MANIFEST.replace("CASES", INLINE))];
    let folder = folder(TABLE);
    let found = both.map(|(_, text)| {
        let outcome = parse(
            folder.path(),
            &text.replace("[[family]]\nid = \"listed\"", "[[family]]\nlimit = 3\nid = \"listed\""),
        );
        outcome.problems.into_iter().map(|problem| (problem.message, problem.help)).collect::<Vec<_>>()
    });
    assert_eq!(found[0], found[1]);
    assert_eq!(found[0][0].0, "there are 4 cases, more than the limit of 3");
    // Nothing of it is read.
    File::create(folder.path().join("list.csv")).unwrap().set_len(512_000_001).unwrap();
    let found = problems_of(folder.path(), &with_table());
    assert_eq!(found[0].0, "cannot read `list.csv`: it has more than 512000000 bytes");
    fs::remove_file(folder.path().join("list.csv")).unwrap();
    fs::create_dir(folder.path().join("list.csv")).unwrap();
    assert!(problems_of(folder.path(), &with_table())[0].0.starts_with("cannot read `list.csv`: "));
}

#[test]
fn a_table_is_not_overwritten() {
    let folder = folder(TABLE);
    let (code, _, err) = run(folder.path(), &["export", "atlas.toml", "listed:1.1.1", "-o", "list.csv"]);
    assert!(code == 2 && err.contains("list.csv is a file of the manifest, which would be lost"), "{err}");
    assert_eq!(fs::read_to_string(folder.path().join("list.csv")).unwrap(), TABLE);
}

#[test]
fn only_the_family_of_a_changed_table_is_made_again() {
    let folder = folder(TABLE);
    let out = folder.path().join("out");
    printed(folder.path(), &["render"]);
    let touched = |table: &str| {
        let before = times(&out);
        fs::write(folder.path().join("list.csv"), table).unwrap();
        printed(folder.path(), &["render"]);
        let after = times(&out);
        let changed = after.iter().filter(|(name, time)| before.get(*name) != Some(time));
        changed.map(|(name, _)| name.replace('\\', "/")).collect::<Vec<_>>()
    };
    // The same numbers, written otherwise.
    assert_eq!(touched("p,q\n2.0,2\n3,2.1\n10,2\n25e-1,1.9\n"), Vec::<String>::new());
    let names = touched(&TABLE.replace("2.1", "2.2"));
    assert!(names.iter().any(|name| name.starts_with("listed/listed-00")), "{names:?}");
    assert!(names.iter().any(|name| name == "listed/points.csv"), "{names:?}");
    assert!(names.iter().all(|name| !name.starts_with("other/")), "{names:?}");
    let (code, ..) = run(folder.path(), &["check", "--against", "out"]);
    assert_eq!(code, 0);
    fs::write(folder.path().join("list.csv"), TABLE).unwrap();
    let (code, out, err) = run(folder.path(), &["check", "--against", "out"]);
    assert!(code == 1 && format!("{out}{err}").contains("listed"), "{out} {err}");
}

#[test]
fn shards_are_of_one_table() {
    let folder = folder(TABLE);
    let sweep = |shard: &str| printed(folder.path(), &["sweep", "-o", "shards", "--shard", shard]);
    sweep("0/2");
    fs::write(folder.path().join("list.csv"), TABLE.replace("2.1", "2.2")).unwrap();
    sweep("1/2");
    let gather: &[&str] = &["gather", "shards", "--by", "-length", "--top", "2", "--toml", "best.toml"];
    let (code, _, err) = run(folder.path(), gather);
    assert!(code == 2 && err.contains("the shards are of 2 manifests"), "{err}");
    let (code, _, err) = run(folder.path(), &["sweep", "-o", "shards", "--shard", "0/2"]);
    assert!(code == 2 && err.contains("it is from another manifest"), "{err}");
    printed(folder.path(), &["sweep", "-o", "shards", "--shard", "0/2", "--force"]);
    printed(folder.path(), gather);
    let best = fs::read_to_string(folder.path().join("best.toml")).unwrap();
    assert!(best.contains("title = \"listed\"") && best.contains("p = 10"), "{best}");
    printed(folder.path(), &["validate", "best.toml"]);
}

/// The table as Parquet with the types of numbers of other programs.
fn parquet(path: &Path) {
    use parquet::data_type::{DoubleType, Int32Type};
    let schema = "message m { required int32 p; optional double q; }";
    let schema = parquet::schema::parser::parse_message_type(schema).unwrap();
    let mut writer = parquet::file::writer::SerializedFileWriter::new(
        File::create(path).unwrap(),
        schema.into(),
        Default::default(),
    )
    .unwrap();
    for (p, k) in [([2, 3], [2.0, 2.1]), ([10, 4], [2.0, 1.9])] {
        let mut group = writer.next_row_group().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int32Type>().write_batch(&p, None, None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<DoubleType>().write_batch(&k, Some(&[1, 1]), None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
    }
    writer.close().unwrap();
}

#[test]
fn a_table_may_be_parquet() {
    let folder = folder("p,q\n2,2\n3,2.1\n10,2\n4,1.9\n");
    parquet(&folder.path().join("list.parquet"));
    let text = with_table().replace("list.csv", "list.parquet");
    let [csv, parquet] = [with_table(), text.clone()].map(|text| parse(folder.path(), &text).plan.unwrap());
    assert_eq!(csv.families[0].family.space, parquet.families[0].family.space);
    assert_eq!(csv.families[0].manifest_inputs, parquet.families[0].manifest_inputs);
    let found = problems_of(folder.path(), &text.replace("/ q", "/ 2"));
    assert_eq!(found[0].0, "in `list.parquet`, `q` is not a parameter of `evans`, and no expression uses it");
    fs::write(folder.path().join("list.parquet"), TABLE).unwrap();
    assert!(problems_of(folder.path(), &text)[0].0.starts_with("cannot read `list.parquet`: "));
}

#[test]
#[ignore = "thorough"]
fn a_table_of_a_hundred_thousand_cases_is_swept() {
    let folder =
        folder_with(&with_table().replace("where = \"length > 1\"\nsort = \"-length\"", "measures = [\"length\"]"));
    let mut table = std::io::BufWriter::new(File::create(folder.path().join("list.csv")).unwrap());
    writeln!(table, "p,q").unwrap();
    for row in 0..100_000 {
        writeln!(table, "{},{}", 2.0 + f64::from(row) * 1e-5, 2.0).unwrap();
    }
    table.into_inner().unwrap();
    let start = std::time::Instant::now();
    printed(folder.path(), &["sweep", "-o", "shards", "--shard", "3/100"]);
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
    let gathered = manifest::parse_for_tables(
        &fs::read_to_string(folder.path().join("atlas.toml")).unwrap(),
        Some(&ManifestFiles::new(&folder.path().join("atlas.toml"))),
        &|family| 0..family.cell_count(),
    );
    assert_eq!(gathered.plan.unwrap().families[0].family.cell_count(), 100_000);
}
