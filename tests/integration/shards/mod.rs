//! Shards: their union is what `render` writes, however they are divided; complete ones are kept; the best are those of a sorted
//! table; and what is wrong with them is found.

mod best;
mod damage;
mod pages;
mod problems;
mod tables;

use std::fs;
use std::path::Path;

use coupler_curves::exchange::append_number;
use parquet::file::reader::FileReader;
use parquet::file::serialized_reader::SerializedFileReader;
use parquet::record::Field;

use crate::support::command::{printed, run};

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

/// The messages of a gather that fails.
fn gather_problems(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, err) = run(folder, &[&["gather"], arguments].concat());
    assert!(code == 2 && out.is_empty(), "{arguments:?}: {code} {out} {err}");
    err
}
