//! Shards: their union is what `render` writes, however they are divided; complete ones are kept; the best are those of a sorted
//! table.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

use coupler_curves::exchange::append_number;
use parquet::file::reader::FileReader;
use parquet::file::serialized_reader::SerializedFileReader;
use parquet::record::Field;
use tempfile::TempDir;

use crate::command::{folder_with, printed, program, run};

/// Families with unassembled cells, several circuits and traces, missing measures, further columns, an actuator, and `where`.
const MANIFEST: &str = r#"[atlas]
title = "T"
formats = ["svg"]
[[family]]
id = "evans"
linkage = "evans"
sampling = { step = "10 deg" }
columns = ["psi_deg", "mu_deg"]
grid = { p = [2, 3, 4, 5, 6] }
let = { a = "(1 + p)^1.5 / 2" }
[[family]]
id = "far"
linkage = "watt"
sampling = { samples = 20 }
measures = ["straight_length", "class"]
cases = [{ p = 4, r = 2, a = 1 }, { p = 90, r = 2, a = 1 }, { p = 4, r = 2, a = 1.5 }]
[[family]]
id = "bars"
linkage = "mine"
sampling = { samples = 12 }
measures = ["length"]
where = "length > 4 and frame < 6"
sort = "-length"
grid = { frame = [3, 4, 5, 7], coupler = [2, 3] }
let = { half = "frame / 2", rocker = "half + 1" }
[[family]]
id = "actuator"
linkage = "linear-actuator"
sampling = { samples = 10 }
cases = [{ g = 3 }, { g = 1.5 }]
[[linkage]]
id = "mine"
parameters = { frame = { min = 0 }, coupler = { min = 0 }, rocker = { min = 0 } }
trace = ["M", "B"]
circuits = "all"
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["frame", 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = ["coupler", "rocker"], side = "left" }
M = { point = ["A", "B"], along = "coupler / 2", across = 1 }
"#;

const FAMILIES: [&str; 4] = ["evans", "far", "bars", "actuator"];

/// The rows of a CSV file, the header first.
fn csv_rows(path: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path).unwrap();
    reader.records().map(|record| record.unwrap().iter().map(str::to_owned).collect()).collect()
}

/// The rows of a Parquet file as those of the CSV file, the header first.
fn parquet_rows(path: &Path) -> Vec<Vec<String>> {
    let reader = SerializedFileReader::new(fs::File::open(path).unwrap()).unwrap();
    let columns = reader.metadata().file_metadata().schema_descr().columns();
    let mut rows = vec![columns.iter().map(|column| column.name().to_owned()).collect::<Vec<_>>()];
    for row in reader.get_row_iter(None).unwrap() {
        let text = |field: &Field| match field {
            Field::Null => String::new(),
            Field::Int(value) => value.to_string(),
            Field::Long(value) => value.to_string(),
            Field::Str(text) => text.clone(),
            Field::Double(value) => {
                let mut digits = Vec::new();
                append_number(*value, &mut digits);
                String::from_utf8(digits).unwrap()
            }
            field => panic!("{field:?}"),
        };
        rows.push(row.unwrap().get_column_iter().map(|(_, field)| text(field)).collect());
    }
    rows
}

fn table_rows(path: &Path) -> Vec<Vec<String>> {
    if path.extension().unwrap() == "csv" { csv_rows(path) } else { parquet_rows(path) }
}

fn shard(table: &str, index: usize, of: usize, format: &str) -> String {
    format!("{table}-{index:05}-of-{of:05}.{format}")
}

/// Sweeps all shards of a manifest in a folder into another.
fn sweep_all(folder: &Path, output: &str, of: usize, options: &[&str]) {
    for index in 0..of {
        let shard = format!("{index}/{of}");
        printed(folder, &[&["sweep", "-o", output, "--shard", &shard][..], options].concat());
    }
}

/// Every file below a folder by its name there, with its bytes.
fn tree(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                folders.push(entry);
            } else {
                found.push((entry.strip_prefix(folder).unwrap().to_owned(), fs::read(&entry).unwrap()));
            }
        }
    }
    found.sort();
    found
}

#[test]
fn the_union_of_shards_is_what_render_writes() {
    let folder = folder_with(MANIFEST);
    printed(folder.path(), &["render", "-q", "-o", "whole"]);
    for (of, format) in [(1, "parquet"), (2, "csv"), (3, "parquet"), (7, "parquet"), (7, "csv")] {
        let output = format!("{of}-{format}");
        sweep_all(folder.path(), &output, of, &["--format", format]);
        for (family, table) in FAMILIES.into_iter().flat_map(|family| [(family, "cells"), (family, "points")]) {
            let expected = csv_rows(&folder.path().join(format!("whole/{family}/{table}.csv")));
            let mut rows: Vec<Vec<String>> = Vec::new();
            for index in 0..of {
                let path = folder.path().join(&output).join(family).join(shard(table, index, of, format));
                let mut part = table_rows(&path);
                let header = part.remove(0);
                assert_eq!(header, expected[0], "{family} {table}");
                rows.extend(part);
            }
            assert!(rows == expected[1..], "{family} {table} in {of} shards: {rows:?}\n{:?}", &expected[1..]);
        }
    }
    let one = tree(&folder.path().join("1-parquet"));
    assert_eq!(one.len(), 8, "no other files are left: {:?}", one.iter().map(|(name, _)| name).collect::<Vec<_>>());
    // Bytes do not depend on the number of threads.
    for jobs in ["1", "3"] {
        sweep_all(folder.path(), jobs, 1, &["-j", jobs]);
        assert!(tree(&folder.path().join(jobs)) == one, "{jobs} threads");
    }
}

#[test]
fn columns_have_types_and_files_say_what_they_are() {
    let folder = folder_with(MANIFEST);
    printed(folder.path(), &["sweep", "-o", "out", "--only", "far", "--cells", "2..3"]);
    let path = folder.path().join("out/far/cells-2-3.parquet");
    let reader = SerializedFileReader::new(fs::File::open(&path).unwrap()).unwrap();
    let file = reader.metadata().file_metadata();
    let types = file.schema_descr().columns().iter().map(|column| {
        let is_optional = column.self_type().is_optional();
        format!("{} {}{}", column.name(), column.physical_type(), if is_optional { "?" } else { "" })
    });
    let types: Vec<String> = types.collect();
    for expected in
        ["cell INT64", "trace INT32?", "p DOUBLE", "status BYTE_ARRAY", "class BYTE_ARRAY?", "straight_length DOUBLE?"]
    {
        assert!(types.iter().any(|found| found == expected), "{expected}: {types:?}");
    }
    let metadata = file.key_value_metadata().unwrap();
    let value = |name: &str| {
        let pair = metadata.iter().find(|pair| pair.key == format!("coupler_atlas.{name}"));
        pair.unwrap_or_else(|| panic!("{name}")).value.clone().unwrap()
    };
    assert_eq!(value("family"), "far");
    assert_eq!(value("joints"), "[\"M\"]");
    assert_eq!(value("division"), "{\"cells\":{\"first\":2,\"last\":3}}");
    assert_eq!([value("first_cell"), value("last_cell"), value("cell_count"), value("rows")], ["2", "3", "3", "2"]);
    assert_eq!(value("manifest_sha256").len(), 64);
    assert!(value("units").contains("{}"), "neither lengths nor words have a unit: {}", value("units"));
    let points = SerializedFileReader::new(fs::File::open(path.with_file_name("points-2-3.parquet")).unwrap()).unwrap();
    let metadata = points.metadata().file_metadata().key_value_metadata().unwrap().clone();
    let units = metadata.iter().find(|pair| pair.key == "coupler_atlas.units").unwrap();
    assert_eq!(units.value.as_deref(), Some("{\"input_deg\":\"deg\"}"));
}

#[test]
fn complete_shards_are_kept_and_others_replaced() {
    let folder = folder_with(MANIFEST);
    let manifest = folder.path().join("atlas.toml");
    let arguments = ["sweep", "-o", "out", "--shard", "0/2"];
    let output = folder.path().join("out");
    assert_eq!(printed(folder.path(), &arguments).matches("written to").count(), 4);
    let files = tree(&output);
    let cells = output.join("evans").join(shard("cells", 0, 2, "parquet"));
    // What is not in the tables may change.
    fs::write(&manifest, MANIFEST.replace("title = \"T\"", "title = \"Other\"").replace("sort = \"-length\"\n", ""))
        .unwrap();
    let again = printed(folder.path(), &arguments);
    assert_eq!(again.matches("complete in").count(), 4, "{again}");
    // A file that is not whole is made again, with all that killed runs of this shard have left; another run may be making
    // the other shard.
    let whole = fs::read(&cells).unwrap();
    let [own, other] =
        ["0000", "0001"].map(|k| output.join("evans").join(format!(".coupler-atlas-0{k}-of-00002-abc.shard")));
    for path in [&own, &other] {
        fs::write(path, "unfinished").unwrap();
    }
    for damaged in [&whole[..whole.len() / 2], b"", b"PAR1"] {
        fs::write(&cells, damaged).unwrap();
        let again = printed(folder.path(), &arguments);
        assert_eq!(again.matches("written to").count(), 1, "{again}");
        assert!(!own.exists() && other.exists());
    }
    fs::remove_file(&other).unwrap();
    fs::remove_file(output.join("far").join(shard("points", 0, 2, "parquet"))).unwrap();
    assert_eq!(printed(folder.path(), &arguments).matches("written to").count(), 1);
    fs::write(&manifest, MANIFEST).unwrap();
    assert!(tree(&output).iter().map(|(name, _)| name).eq(files.iter().map(|(name, _)| name)));
    printed(folder.path(), &["sweep", "-o", "out", "--shard", "0/2", "--force"]);
    assert!(tree(&output) == files);
    // Another sweep is not replaced unasked.
    let changed = MANIFEST.replace("p = [2, 3, 4, 5, 6]", "p = [2, 3, 4, 5, 7]");
    for (text, further, reason) in [
        (&changed[..], &[][..], "it is from another manifest"),
        (MANIFEST, &["--measures", "length"], "it has other columns"),
        (MANIFEST, &["--top", "2", "--by", "length"], "it has all curves and not only the best"),
    ] {
        fs::write(&manifest, text).unwrap();
        let (code, _, err) = run(folder.path(), &[&arguments[..], further].concat());
        assert_eq!(code, 2, "{err}");
        assert!(err.contains(&format!("{} is not to be replaced: {reason}", shard("cells", 0, 2, "parquet"))), "{err}");
        assert!(tree(&output) == files);
        printed(folder.path(), &[&arguments[..], further, &["--force"]].concat());
        assert!(tree(&output) != files);
        fs::write(&manifest, MANIFEST).unwrap();
        printed(folder.path(), &[&arguments[..], &["--force"]].concat());
        assert!(tree(&output) == files);
    }
}

#[test]
fn a_killed_run_leaves_no_file_under_its_name() {
    let text = MANIFEST.replace("p = [2, 3, 4, 5, 6]", "p = { from = 2, to = 60, count = 4000 }");
    let folder = folder_with(&text);
    let arguments = ["sweep", "--only", "evans", "--no-points", "-q"];
    printed(folder.path(), &[&arguments[..], &["--measures", "none", "-o", "undisturbed"]].concat());
    let mut child = program(folder.path());
    let mut child = child.args(arguments).args(["-o", "out"]).stdout(Stdio::null()).spawn().unwrap();
    let family = folder.path().join("out/evans");
    // All measures take seconds; the run has begun when its unfinished table is there.
    let is_begun = || fs::read_dir(&family).is_ok_and(|entries| entries.count() >= 2);
    while !is_begun() {
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let names: Vec<String> = tree(&family).iter().map(|(name, _)| name.display().to_string()).collect();
    assert!(!names.is_empty() && names.iter().all(|name| name.starts_with('.')), "{names:?}");
    printed(folder.path(), &[&arguments[..], &["--measures", "none", "-o", "out"]].concat());
    assert!(tree(&folder.path().join("out")) == tree(&folder.path().join("undisturbed")));
}

/// The rows of all cells of a family as render writes them, as values of some columns.
fn values(rows: &[Vec<String>], columns: &[&str]) -> Vec<Vec<f64>> {
    let places: Vec<usize> =
        columns.iter().map(|name| rows[0].iter().position(|column| column == name).unwrap()).collect();
    let number = |row: &Vec<String>, place: usize| row[place].parse().unwrap_or(f64::NAN);
    rows[1..].iter().map(|row| places.iter().map(|place| number(row, *place)).collect()).collect()
}

/// The lines of the table of `gather` as values of some columns.
fn gathered(table: &str, columns: &[&str]) -> Vec<Vec<f64>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table.as_bytes());
    let rows: Vec<Vec<String>> =
        reader.records().map(|record| record.unwrap().iter().map(str::to_owned).collect()).collect();
    values(&rows, columns)
}

#[test]
fn the_best_are_those_of_a_sorted_table() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    printed(path, &["render", "-q", "-o", "whole"]);
    let place = ["cell", "trace", "circuit"];
    // Both circuits of a cell have curves of equal length, mirrored.
    let mut all =
        values(&csv_rows(&path.join("whole/bars/cells.csv")), &["length", "frame", "cell", "trace", "circuit"]);
    assert!(all.len() > 12);
    for (by, key) in [("length", 0), ("-frame", 1)] {
        let sign = if key == 0 { 1.0 } else { -1.0 };
        all.sort_by(|a, b| {
            (sign * b[key]).total_cmp(&(sign * a[key])).then_with(|| a[2..].partial_cmp(&b[2..]).unwrap())
        });
        for of in [1, 2, 3, 7] {
            for (folder, top) in [("all", None), ("best", Some("5"))] {
                let output = format!("{folder}-{by}-{of}");
                let options: &[&str] = match top {
                    None => &["--only", "bars", "--no-points"],
                    Some(top) => &["--only", "bars", "--top", top, "--by", by],
                };
                sweep_all(path, &output, of, options);
                let table = printed(path, &["gather", &output, "--only", "bars", "--top", "5", "--by", by]);
                let best = gathered(&table, &place);
                assert!(best.iter().zip(&all).all(|(best, row)| best[..] == row[2..]), "{of} {by}: {table}");
                assert_eq!(best.len(), 5);
                let keys = gathered(&table, &["by"]);
                assert!(keys.iter().zip(&all).all(|(by, row)| by[0] == sign * row[key]), "{of} {by}: {table}");
            }
        }
    }
    // The points of the best are those of their curves.
    let points = parquet_rows(&path.join("best-length-1/bars").join(shard("points", 0, 1, "parquet")));
    let whole = csv_rows(&path.join("whole/bars/points.csv"));
    assert_eq!(points.len(), 1 + 5 * 12);
    assert!(points.iter().all(|row| whole.contains(row)));
    // Over families; one that lacks a name of the expression has no best.
    sweep_all(path, "families", 2, &["--no-points"]);
    let table = printed(path, &["gather", "families", "--top", "100", "--by", "a * straight_length"]);
    assert!(table.contains(",evans,M,") && table.contains(",far,M,") && !table.contains(",bars,"), "{table}");
    let keys: Vec<f64> = gathered(&table, &["by"]).iter().map(|row| row[0]).collect();
    assert!(keys.len() == 5 + 2 && keys.is_sorted_by(|a, b| a >= b), "{keys:?}");
}

#[test]
fn the_best_are_a_manifest_that_renders_them() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    sweep_all(path, "out", 3, &["--no-points"]);
    let table =
        printed(path, &["gather", "out", "--top", "9", "--by", "length + 0 * frame", "--toml", "best.toml", "-q"]);
    let best = gathered(&table, &["frame", "coupler", "rocker", "by"]);
    assert_eq!(
        printed(path, &["gather", "out", "--top", "9", "--by", "length + 0 * frame", "--toml", "-", "-q"]),
        fs::read_to_string(path.join("best.toml")).unwrap()
    );
    printed(path, &["render", "best.toml", "-q", "-o", "drawn", "--strict"]);
    let drawn = csv_rows(&path.join("drawn/mine-exported/cells.csv"));
    let drawn = values(&drawn, &["frame", "coupler", "rocker", "length"]);
    for row in best {
        assert!(drawn.contains(&row), "{row:?} is not in {drawn:?}");
    }
}

/// The messages of a gather that fails.
fn gather_problems(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, err) = run(folder, &[&["gather"], arguments].concat());
    assert!(code == 2 && out.is_empty(), "{arguments:?}: {code} {out} {err}");
    err
}

#[test]
fn what_is_missing_or_mixed_is_named() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    let family = ["--only", "evans", "--no-points", "--measures", "none"];
    sweep_all(path, "out", 5, &family);
    let out = path.join("out/evans");
    assert!(
        gather_problems(path, &["out"])
            .contains("error: far: there are no shards: sweep it, or gather the others with --only")
    );
    let (code, _, err) = run(path, &["gather", "out", "--only", "evans"]);
    assert_eq!((code, err.as_str()), (0, "evans: 5 shards, 5 cells, 5 curves\n"));
    let file = |index| out.join(shard("cells", index, 5, "parquet"));
    for index in [1, 3, 4] {
        fs::rename(file(index), path.join(format!("{index}.parquet"))).unwrap();
    }
    let message = gather_problems(path, &["out", "--only", "evans"]);
    assert!(
        message.contains(
            "evans: shards 1, 3 to 4 of 5 are missing: make them with `coupler-atlas sweep MANIFEST --shard 1/5`"
        ),
        "{message}"
    );
    // In another folder, and one of them in both.
    fs::create_dir_all(path.join("other/evans")).unwrap();
    for index in [1, 3, 4] {
        fs::rename(
            path.join(format!("{index}.parquet")),
            path.join("other/evans").join(shard("cells", index, 5, "parquet")),
        )
        .unwrap();
    }
    fs::copy(file(0), path.join("other/evans").join(shard("cells", 0, 5, "parquet"))).unwrap();
    let (code, _, err) = run(path, &["gather", "out", "other", "--only", "evans"]);
    assert!(code == 0 && err.contains("are the same shard, which counts once") && err.contains("5 shards"), "{err}");
    // Cells that are there twice, and others that are missing.
    for cells in ["1..2", "2..3", "5..5"] {
        printed(path, &[&["sweep", "-o", "ranges", "--cells", cells], &family[..]].concat());
    }
    let message = gather_problems(path, &["ranges", "--only", "evans"]);
    assert!(
        message.contains(
            "evans: the cells 2 to 2 are in ranges/evans/cells-1-2.parquet and in ranges/evans/cells-2-3.parquet"
        ),
        "{message}"
    );
    assert!(
        message.contains(
            "evans: the cells 4 to 4 of 5 are missing: make them with `coupler-atlas sweep MANIFEST --cells 4..4`"
        ),
        "{message}"
    );
    // Other manifests, and files that are not whole: all in one run.
    fs::write(path.join("second.toml"), MANIFEST.replace("p = [2, 3, 4, 5, 6]", "p = [2, 3, 4, 5, 7]")).unwrap();
    printed(path, &[&["sweep", "second.toml", "-o", "out", "--shard", "0/1"], &family[..]].concat());
    let text = fs::read(file(2)).unwrap();
    fs::write(file(2), &text[..100]).unwrap();
    let message = gather_problems(path, &["out", "other", "--only", "evans"]);
    assert!(message.contains("out/evans/cells-00002-of-00005.parquet: it is not a whole Parquet file"), "{message}");
    assert!(message.contains("the shards are of 2 manifests or versions of the program"), "{message}");
    assert!(message.contains("out/evans/cells-00000-of-00001.parquet: manifest "), "{message}");
    fs::write(file(2), "a,b\n").unwrap();
    fs::write(out.join("cells-00003-of-00009.csv"), "cell\n").unwrap();
    let message = gather_problems(path, &["out", "--only", "evans"]);
    assert!(
        message.contains("cells-00003-of-00009.csv: its record") && message.contains("does not exist"),
        "{message}"
    );
    // Without points, with points, and with points of another run.
    sweep_all(path, "points", 2, &["--only", "actuator"]);
    let points = |index| path.join("points/actuator").join(shard("points", index, 2, "parquet"));
    fs::copy(points(0), points(1)).unwrap();
    assert!(gather_problems(path, &["points", "--only", "actuator"]).contains("it does not belong to"));
    fs::remove_file(points(1)).unwrap();
    assert!(
        gather_problems(path, &["points", "--only", "actuator"])
            .contains("points-00001-of-00002.parquet: it does not exist")
    );
    printed(path, &["sweep", "-o", "points", "--only", "actuator", "--shard", "1/2", "--no-points", "--force"]);
    assert!(gather_problems(path, &["points", "--only", "actuator"]).contains("make both with or without --no-points"));
    // A changed CSV file.
    printed(path, &["sweep", "-o", "text", "--only", "actuator", "--format", "csv"]);
    assert_eq!(run(path, &["gather", "text", "--only", "actuator"]).0, 0);
    let cells = path.join("text/actuator").join(shard("cells", 0, 1, "csv"));
    fs::write(&cells, fs::read_to_string(&cells).unwrap().replace("ok", "no")).unwrap();
    assert!(gather_problems(path, &["text", "--only", "actuator"]).contains("it is not the file that was written"));
}

#[test]
fn wrong_options_are_explained() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    let message = |arguments: &[&str]| {
        let (code, out, err) = run(path, arguments);
        assert!(code == 2 && out.is_empty(), "{arguments:?}: {code} {out} {err}");
        err
    };
    for (arguments, expected) in [
        (&["--shard", "3/3"][..], "shards are numbered from 0: give 0/3 to 2/3"),
        (&["--shard", "0/0"], "expected a number and the number of shards, as in --shard 3/64"),
        (&["--shard=-1/2"], "expected a number and the number of shards"),
        (&["--shard", "0/2000000"], "at most 1000000 shards are possible"),
        (&["--cells", "0..3"], "cells are numbered from 1"),
        (&["--cells", "3..2"], "the last number is less than the first"),
        (&["--cells", "3"], "expected the numbers of the first and the last cell"),
        (&["--cells", "1..2", "--shard", "0/2"], "cannot be used with"),
        (
            &["--cells", "1..2"],
            "--cells is for a single family: name one with --only, as in --only evans, of evans, far and others",
        ),
        (&["--cells", "4..9", "--only", "evans"], "--cells: `evans` has no cell 9: its cells are numbered from 1 to 5"),
        (&["--top", "3"], "--by"),
        (&["--top", "0", "--by", "length"], "0 is not in 1..=1000000"),
        (&["--top", "3", "--by", "lenght"], "--by: `lenght`: unknown name `lenght`; did you mean `length`?"),
        (&["--top", "3", "--by", "length > 2"], "--by: `length > 2`: expected a number"),
        (
            &["--top", "3", "--by", "half", "--only", "bars"],
            "`half` is neither a parameter of the linkage nor a measure",
        ),
        (&["--measures", "lenght"], "--measures: unknown measure `lenght`: did you mean `length`?"),
        (&["--format", "xls"], "unknown format `xls`"),
        (&["--only", "evnas"], "there is no family `evnas`: did you mean `evans`?"),
    ] {
        let found = message(&[&["sweep", "-o", "out"], arguments].concat());
        assert!(found.contains(expected), "{arguments:?}: {found}");
    }
    assert!(!path.join("out").exists());
    printed(path, &["sweep", "-o", "out", "--no-points", "--top", "2", "--by", "length"]);
    printed(path, &["sweep", "-o", "all", "--no-points"]);
    for (arguments, expected) in [
        (&["nowhere"][..], "cannot read nowhere"),
        (&["."], "there are no tables of shards in .: `coupler-atlas sweep` writes them"),
        (&["out", "--by", "area"], "the shards have only the best by `length`, not by `area`"),
        (&["out", "--top", "3"], "the shards have only the best 2, not 3"),
        (&["all", "--top", "3"], "by what are they the best?"),
        (&["all", "--by", "length"], "how many are the best?"),
        (&["all", "--toml", "best.toml"], "--toml is for the best curves"),
        (&["all", "--top", "1", "--by", "lenght"], "did you mean `length`?"),
        (&["all", "--only", "evnas"], "there is no family `evnas`"),
        (&["all", "out"], "make them with the same options"),
    ] {
        let found = message(&[&["gather"], arguments].concat());
        assert!(found.contains(expected), "{arguments:?}: {found}");
    }
    // The best that the shards kept are found by themselves.
    assert_eq!(printed(path, &["gather", "out"]).lines().count(), 1 + 2);
}

/// A grid of four thousand million cells: only those of a shard are computed and checked.
#[test]
fn a_huge_grid_takes_no_memory() {
    let text = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"f\"\nlinkage = \"four-bar\"\nsampling = { samples = 9 }\nmeasures = []\n\
                limit = 4000000000\ngrid = { frame = { from = 0, to = 4, count = 40000 }, coupler = { from = 3, to = 4, count = 1000 }, \
                rocker = { from = 3, to = 5, count = 100 }, crank = [1] }\n";
    let folder = folder_with(text);
    let path = folder.path();
    let out = printed(path, &["sweep", "--cells", "3999999990..4000000000", "--no-points"]);
    assert!(out.contains("f: cells 3999999990 to 4000000000 of 4000000000, "), "{out}");
    let rows = parquet_rows(&path.join("atlas/f/cells-3999999990-4000000000.parquet"));
    assert_eq!(rows.last().unwrap()[..7].join(","), "4000000000,1,2,4,1,4,5");
    printed(path, &["sweep", "--shard", "999999/1000000", "--no-points"]);
    let shard = parquet_rows(&path.join("atlas/f/cells-999999-of-1000000.parquet"));
    assert_eq!(shard.last(), rows.last());
    // The frame of the first cells has no length.
    let (code, _, err) = run(path, &["sweep", "--cells", "99999..100000"]);
    assert!(
        code == 2 && err.contains("in cell 99999 (frame = 0, ") && err.contains("one more cell has the same error"),
        "{err}"
    );
    let (code, _, err) = run(path, &["render"]);
    assert!(code == 2 && err.contains("4000000000 cells, more than the limit of 10000000"), "{err}");
    assert!(err.contains("solve it without pages: `coupler-atlas sweep`"), "{err}");
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("atlas.toml"), text.replace("4000000000", "4000000001")).unwrap();
    assert_eq!(run(folder.path(), &["sweep", "--cells", "1..1"]).0, 2);
}

/// Pages of panels, sorted and filtered, of a coupler grid, with charts, and of many cells without curves.
const PAGES: &str = r#"[atlas]
title = "T"
formats = ["svg", "png"]
[page]
dpi = 40
[[family]]
id = "panels"
linkage = "evans"
panels = [2, 1]
sampling = { step = "10 deg" }
grid = { p = [2, 3, 4, 5, 6], a = [3, 4] }
[[family]]
id = "sorted"
linkage = "evans"
panels = [1, 1]
sampling = { step = "10 deg" }
where = "length > 3"
sort = "-straight_length"
grid = { p = [2, 3, 4], a = [3, 4] }
[[family]]
id = "far"
linkage = "watt"
panels = [1, 1]
sampling = { samples = 20 }
cases = [{ p = 4, r = 2, a = 1 }, { p = 90, r = 2, a = 1 }, { p = 4, r = 2, a = 1.5 }]
[[family]]
id = "grid"
linkage = "hrones-nelson"
layout = "coupler-grid"
sampling = { step = "20 deg" }
cases = [{ A = 2, B = 2.5, C = 3 }, { A = 3, B = 2, C = 3 }]
[[family]]
id = "chart"
linkage = "evans"
layout = "chart"
panels = [1, 1]
chart = { x = "p", y = ["straight_length", "mu_min_deg"] }
sampling = { step = "20 deg" }
grid = { p = [2, 3, 4], a = [3, 4] }
"#;

#[test]
fn the_pages_of_shards_are_those_of_one_run() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    for format in ["svg,png", "svg,pdf"] {
        let whole = format!("whole-{format}");
        printed(path, &["render", "-q", "-o", &whole, "--format", format]);
        let whole = tree(&path.join(&whole));
        for of in [1, 2, 3, 40] {
            let output = format!("{format}-{of}");
            let draw = |index: usize| {
                let shard = format!("{index}/{of}");
                let mut command = program(path);
                command.args(["render", "--shard", &shard, "-o", &output, "--format", format, "-j", "1"]);
                command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
            };
            // All at once, in no order, but for one.
            let running: Vec<_> = (1..of).rev().map(draw).collect();
            let mut drawn = 0;
            let mut finish = |child: std::process::Child| {
                let (code, out, err) = crate::command::result(child.wait_with_output().unwrap());
                assert_eq!(code, 0, "{err}");
                drawn += out.split(", ").nth(1).unwrap().split(' ').next().unwrap().parse::<usize>().unwrap();
            };
            running.into_iter().for_each(&mut finish);
            if of > 1 {
                let message = gather_problems(path, &[&output]);
                let expected = format!("{output}: of {of} shards of pages these are not complete: 0; draw them with");
                assert!(message.contains(&expected), "{message}");
            }
            finish(draw(0));
            // Drawn again, nothing is.
            let before = drawn;
            let mut again = 0;
            let (code, out, err) = crate::command::result(draw(0).wait_with_output().unwrap());
            again += out.split(", ").nth(1).unwrap().split(' ').next().unwrap().parse::<usize>().unwrap();
            assert_eq!(
                (code, again, before),
                (0, 0, whole.iter().filter(|(name, _)| name.extension().is_some_and(|e| e == "svg")).count()),
                "{err}"
            );
            let (code, out, err) = run(path, &["gather", &output]);
            assert!(code == 0 && out.is_empty() && err.contains(&format!("written to {output}; open ")), "{err}");
            let found = tree(&path.join(&output));
            let names = |files: &[(PathBuf, Vec<u8>)]| files.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
            assert_eq!(names(&found), names(&whole), "{format} in {of}");
            for ((name, bytes), (_, expected)) in found.iter().zip(&whole) {
                assert!(bytes == expected, "{format} in {of} shards: {} differs", name.display());
            }
            assert!(printed(path, &["render", "-o", &output, "--format", format]).contains("nothing has changed"));
        }
    }
}

#[test]
fn shards_of_pages_of_different_manifests_are_not_completed() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    printed(path, &["render", "-q", "--shard", "0/2", "-o", "out"]);
    fs::write(path.join("atlas.toml"), PAGES.replace("dpi = 40", "dpi = 50")).unwrap();
    printed(path, &["render", "-q", "--shard", "1/2", "-o", "out"]);
    assert!(gather_problems(path, &["out"]).contains("--shard 0/2 and --shard 1/2 are of different manifests"));
    printed(path, &["render", "-q", "--shard", "2/3", "-o", "out"]);
    assert!(gather_problems(path, &["out"]).contains("pages are drawn in 2 and in 3 shards: use one number"));
    // A run of all draws what is missing.
    printed(path, &["render", "-q", "-o", "out"]);
    printed(path, &["render", "-q", "-o", "whole"]);
    assert!(tree(&path.join("out")) == tree(&path.join("whole")));
    // Files of others are not replaced, and the folder of another manifest is not used.
    fs::create_dir_all(path.join("mine/far")).unwrap();
    fs::write(path.join("mine/far/far-001.svg"), "mine").unwrap();
    let (code, _, err) = run(path, &["render", "--shard", "1/3", "-o", "mine"]);
    assert!(code == 2 && err.contains("no earlier run wrote mine/far/far-001.svg"), "{err}");
    fs::copy(path.join("atlas.toml"), path.join("other.toml")).unwrap();
    let (code, _, err) = run(path, &["render", "other.toml", "--shard", "1/3", "-o", "whole"]);
    assert!(code == 2 && err.contains("has the atlas of another manifest"), "{err}");
}
