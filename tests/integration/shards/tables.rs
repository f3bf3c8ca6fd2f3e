//! What is in tables.

use std::fs;
use std::process::Stdio;
use std::time::Duration;

use parquet::file::reader::FileReader;
use parquet::file::serialized_reader::SerializedFileReader;

use super::{FAMILIES, MANIFEST, csv_rows, parquet_rows, shard, sweep_all, table_rows};
use crate::support::command::{folder_with, printed, program, run};
use crate::support::folder::{files, tree};

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
    assert_eq!(one.len(), 8, "no other files are left: {:?}", one.keys());
    // Bytes do not depend on the number of threads.
    for jobs in ["1", "3"] {
        sweep_all(folder.path(), jobs, 1, &["-j", jobs]);
        assert!(tree(&folder.path().join(jobs)) == one, "{jobs} threads");
    }
}

/// The curves of a family with 4,000 cells whose `where` keeps none of the first half.
#[test]
fn shards_have_equal_work() {
    const MANIFEST: &str = r#"[atlas]
title = "T"
[[family]]
id = "bars"
linkage = "four-bar"
sampling = { samples = 12 }
measures = ["length"]
where = "coupler > 3 and is_crank_rocker"
let = { crank = 1, along = 0.5, across = 0.5 }
grid = { coupler = { from = 2, to = 4, count = 40 }, frame = { from = 2, to = 3, count = 10 }, rocker = { from = 2, to = 3, count = 10 } }
"#;
    let folder = folder_with(MANIFEST);
    let all = printed(folder.path(), &["sweep", "-o", "whole", "--no-points"]);
    sweep_all(folder.path(), "out", 3, &["--no-points"]);
    let cells = |output: &str, index, of| {
        table_rows(&folder.path().join(output).join("bars").join(shard("cells", index, of, "parquet")))
    };
    let whole = cells("whole", 0, 1);
    let parts: Vec<Vec<Vec<String>>> = (0..3).map(|index| cells("out", index, 3)).collect();
    let joined: Vec<&Vec<String>> = parts.iter().flat_map(|part| &part[1..]).collect();
    assert!(joined == whole[1..].iter().collect::<Vec<_>>(), "{all}");
    // A cell that is left out is a twentieth of the work of a curve, and there are as many of each.
    let curves = parts.iter().map(|part| part.len() - 1);
    let third = (whole.len() - 1) / 3;
    assert!(curves.clone().all(|count| count.abs_diff(third) < third / 8), "{:?}: {all}", curves.collect::<Vec<_>>());
    // A shard in the middle is missing: it is known which, without its cells.
    fs::remove_file(folder.path().join("out/bars").join(shard("cells", 1, 3, "parquet"))).unwrap();
    let (code, _, errors) = run(folder.path(), &["gather", "out"]);
    assert!(code == 2 && errors.contains("bars: shard 1 of 3 is missing"), "{errors}");
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
    // The input of an actuator is a length, in the unit of the manifest.
    printed(folder.path(), &["sweep", "-o", "out", "--only", "actuator", "--format", "csv"]);
    let record = fs::read(folder.path().join("out/actuator").join(shard("cells", 0, 1, "json"))).unwrap();
    let record: serde_json::Value = serde_json::from_slice(&record).unwrap();
    let columns = record["columns"].as_array().unwrap();
    let units = record["units"].as_object().unwrap();
    assert!(columns.iter().any(|name| name == "input_min_length") && units["mu_min_deg"] == "deg", "{units:?}");
    assert!(units.iter().all(|(name, unit)| unit != "deg" || name.ends_with("_deg")), "{units:?}");
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
    assert!(tree(&output).keys().eq(files.keys()));
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
    let names = files(&family);
    assert!(!names.is_empty() && names.iter().all(|name| name.starts_with('.')), "{names:?}");
    printed(folder.path(), &[&arguments[..], &["--measures", "none", "-o", "out"]].concat());
    assert!(tree(&folder.path().join("out")) == tree(&folder.path().join("undisturbed")));
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
    let folder = folder_with(&text.replace("4000000000", "4000000001"));
    assert_eq!(run(folder.path(), &["sweep", "--cells", "1..1"]).0, 2);
}
