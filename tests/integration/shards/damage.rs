//! Files that are not what was written: damaged ones are made again, those of others are refused.

use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

use coupler_atlas::record::Digest;
use parquet::basic::Compression;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::FileReader;
use parquet::file::serialized_reader::SerializedFileReader;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::{MANIFEST, gather_problems, shard, sweep_all};
use crate::support::command::{folder_with, printed, run};
use crate::support::folder::tree;

/// A family of two cells.
const FAMILY: [&str; 2] = ["--only", "actuator"];

/// Panics unless damage of a shard's file, in its last byte and in so many parts of it, is noticed, and the shard made again.
fn assert_noticed(parts: usize) {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    for (format, tables) in [("parquet", ["cells", "points"]), ("csv", ["cells", "points"])] {
        sweep_all(path, format, 2, &[&FAMILY[..], &["--format", format]].concat());
        let whole = tree(&path.join(format));
        for table in tables {
            let file = path.join(format).join("actuator").join(shard(table, 0, 2, format));
            let bytes = fs::read(&file).unwrap();
            // The last bytes are the length of the metadata, and the mark of the format.
            for place in (4..bytes.len()).step_by(bytes.len() / parts).chain([bytes.len() - 1]) {
                let mut damaged = bytes.clone();
                damaged[place] ^= 0xff;
                fs::write(&file, &damaged).unwrap();
                let message = gather_problems(path, &[format, "--only", "actuator"]);
                assert!(message.contains("make the shard again"), "{table} at {place}: {message}");
                let again = [&["sweep", "-o", format, "--shard", "0/2", "--format", format], &FAMILY[..]].concat();
                let out = printed(path, &again);
                assert!(out.contains("written to"), "{out}");
                assert!(tree(&path.join(format)) == whole, "{table} at {place}");
            }
        }
    }
}

#[test]
fn damage_is_noticed_and_made_again() {
    assert_noticed(4);
}

#[test]
#[ignore = "thorough"]
fn damage_anywhere_is_noticed_and_made_again() {
    assert_noticed(9);
}

/// A change of columns, and what it is noticed by.
type Change<'a> = (&'a str, &'a dyn Fn(&mut Vec<Arc<Type>>));

/// Writes a file with the metadata of a table without rows, and other columns.
fn write_with_columns(path: &Path, original: &Path, change: impl Fn(&mut Vec<Arc<Type>>)) {
    let reader = SerializedFileReader::new(File::open(original).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata();
    assert_eq!(metadata.num_rows(), 0);
    let mut fields = metadata.schema_descr().root_schema().get_fields().to_vec();
    change(&mut fields);
    let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build().unwrap());
    let pairs: Vec<KeyValue> = metadata.key_value_metadata().unwrap().clone();
    let properties =
        WriterProperties::builder().set_compression(Compression::SNAPPY).set_key_value_metadata(Some(pairs));
    let writer = SerializedFileWriter::new(File::create(path).unwrap(), schema, Arc::new(properties.build())).unwrap();
    writer.close().unwrap();
}

#[test]
fn other_columns_than_a_file_states_are_refused() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    // Most shards of two cells are empty.
    sweep_all(path, "out", 3, &[&FAMILY[..], &["--no-points"]].concat());
    let file = path.join("out/actuator").join(shard("cells", 0, 3, "parquet"));
    let original = path.join("original.parquet");
    fs::copy(&file, &original).unwrap();
    let changes: [Change; 3] = [
        ("it has other columns than it states: not `joint`", &|fields| drop(fields.pop())),
        ("it has other columns than it states; make", &|fields| fields.swap(3, 4)),
        ("it is not the file that was written", &|_| {}),
    ];
    for (expected, change) in changes {
        write_with_columns(&file, &original, change);
        let message = gather_problems(path, &["out", "--only", "actuator"]);
        assert!(message.contains(expected), "{message}");
    }
}

/// What is kept in memory of the best is no more than a sweep writes of them, also of a whole file.
#[test]
fn rows_with_more_text_than_a_sweep_writes_are_refused() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    printed(path, &["sweep", "-o", "out", "--no-points", "--only", "evans", "--format", "csv"]);
    let table = path.join("out/evans").join(shard("cells", 0, 1, "csv"));
    let (text, record) = (fs::read_to_string(&table).unwrap(), table.with_extension("json"));
    let stated = fs::read_to_string(&record).unwrap();
    let best =
        |top: usize| run(path, &["gather", "out", "--only", "evans", "--top", &top.to_string(), "--by", "length"]);
    let (code, whole, _) = best(5);
    assert!(code == 0 && whole.lines().count() == 6);
    // In the first format the best were the greatest: it is read where all curves are there.
    let first_format = stated.replace("\"format\": 2", "\"format\": 1");
    assert_ne!(first_format, stated);
    fs::write(&record, &first_format).unwrap();
    assert_eq!(best(5).1, whole);
    let only_best = first_format.replace("\"top\": null", "\"top\": {\"count\": 5, \"by\": \"length\"}");
    assert_ne!(only_best, first_format);
    fs::write(&record, only_best).unwrap();
    let (code, out, err) = best(5);
    assert!(
        code == 2 && out.is_empty() && err.contains("it has the curves for which its expression is greatest"),
        "{err}"
    );
    // The last field of each row is the name of the joint.
    for (length, is_refused) in [(100_000, false), (300_000, true)] {
        let long = text.lines().enumerate().map(|(k, line)| match k {
            0 => format!("{line}\n"),
            _ => format!("{line}{}\n", "x".repeat(length)),
        });
        let long: String = long.collect();
        let [before, after] = [&text, &long].map(|text| Digest::of(text.as_bytes()).to_string());
        fs::write(&table, &long).unwrap();
        fs::write(&record, stated.replace(&before, &after)).unwrap();
        let (code, out, err) = best(5);
        assert_eq!((code == 2, out.is_empty()), (is_refused, is_refused), "{err}");
        assert_eq!(err.contains("5 of its rows have more text than the limit of 10"), is_refused, "{err}");
        assert_eq!(best(3).0, 0);
    }
}

#[test]
fn files_of_others_are_refused() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    let arguments = [&["sweep", "-o", "out", "--no-points"], &FAMILY[..]].concat();
    printed(path, &arguments);
    let file = path.join("out/actuator").join(shard("cells", 0, 1, "parquet"));
    let whole = fs::read(&file).unwrap();
    // A newer format: the digits have the same length.
    let newer = replace_bytes(&whole, b"coupler_atlas.format\x18\x012", b"coupler_atlas.format\x18\x013");
    let foreign = replace_bytes(&whole, b"coupler_atlas.", b"another_thing.");
    for (bytes, reason) in [
        (&newer[..], "it has the format 3, and this version reads 2"),
        (&foreign[..], "no sweep wrote it"),
        (b"a,b\n", "it is not a Parquet file"),
    ] {
        fs::write(&file, bytes).unwrap();
        let (code, _, err) = run(path, &arguments);
        assert!(code == 2 && err.contains(&format!("is not to be replaced: {reason}")), "{err}");
        assert_eq!(fs::read(&file).unwrap(), bytes);
        let message = gather_problems(path, &["out", "--only", "actuator"]);
        assert!(message.contains(&format!("{reason}; move it away")), "{message}");
        printed(path, &[&arguments[..], &["--force"]].concat());
        assert_eq!(fs::read(&file).unwrap(), whole);
    }
    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    let (code, _, err) = run(path, &arguments);
    assert!(code == 2 && err.contains("it is a folder, not a file"), "{err}");
    // Text without a record.
    let text = file.with_extension("csv");
    fs::write(&text, "mine\n").unwrap();
    let (code, _, err) = run(path, &[&arguments[..], &["--format", "csv"]].concat());
    assert!(code == 2 && err.contains("its record") && err.contains("does not exist"), "{err}");
    // What is no folder.
    fs::write(path.join("file"), "mine").unwrap();
    for output in ["file", "file/deeper"] {
        let (code, _, err) = run(path, &["sweep", "-o", output]);
        assert!(code == 2 && err.contains("file is not a folder: name another with -o"), "{err}");
    }
}

/// Some bytes with all occurrences of a part replaced by others.
fn replace_bytes(bytes: &[u8], part: &[u8], by: &[u8]) -> Vec<u8> {
    assert_eq!(part.len(), by.len());
    let mut replaced = bytes.to_vec();
    let places: Vec<usize> = (0..=bytes.len() - part.len()).filter(|&k| bytes[k..].starts_with(part)).collect();
    assert!(!places.is_empty());
    for place in places {
        replaced[place..place + by.len()].copy_from_slice(by);
    }
    replaced
}

#[test]
fn points_belong_to_their_cells() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    let sweep = |further: &[&str]| printed(path, &[&["sweep", "-q", "-o", "out"], &FAMILY[..], further].concat());
    sweep(&[]);
    let points = path.join("out/actuator").join(shard("points", 0, 1, "parquet"));
    // Of the best, and of another family.
    printed(path, &[&["sweep", "-q", "-o", "best", "--top", "1", "--by", "length"], &FAMILY[..]].concat());
    printed(path, &["sweep", "-q", "-o", "best", "--only", "evans"]);
    for (other, why) in [("actuator", "it has only the best 1 by `length`"), ("evans", "it has other columns")] {
        fs::copy(path.join("best").join(other).join(shard("points", 0, 1, "parquet")), &points).unwrap();
        let message = gather_problems(path, &["out", "--only", "actuator"]);
        assert!(message.contains("it does not belong to") && message.contains(why), "{message}");
        let (code, _, err) = run(path, &[&["sweep", "-o", "out"], &FAMILY[..]].concat());
        assert!(code == 2 && err.contains(why), "{err}");
        sweep(&["--force"]);
        printed(path, &["gather", "out", "--only", "actuator"]);
    }
    // Without points, none of an earlier sweep are left.
    sweep(&["--force", "--no-points"]);
    assert!(!points.exists());
    printed(path, &["gather", "out", "--only", "actuator"]);
}
