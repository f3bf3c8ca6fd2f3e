//! The counts that are recorded.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::callgrind::Counts;

/// The counts of benchmarks.
pub struct Record {
    /// The compiler with which they were counted, and for what.
    pub compiler: String,
    pub benchmarks: BTreeMap<String, Counts>,
}

/// Functions that have one in so many of a benchmark's instructions are recorded.
const RECORDED: u64 = 100;

/// The name that stands for all functions.
const ALL: &str = "all";

/// What comes before the compiler in the first line.
const HEAD: &str = "# counted by .ci/counts --bless, with ";

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("counts.csv")
}

/// The compiler, and the machine that it makes programs for.
pub fn compiler() -> String {
    let version = Command::new("rustc").arg("--version").output().expect("rustc");
    format!("{}, {}", String::from_utf8_lossy(&version.stdout).trim(), std::env::consts::ARCH)
}

impl Record {
    pub fn read() -> Record {
        let text = fs::read_to_string(path()).unwrap_or_default();
        let (head, table) = text.split_once('\n').unwrap_or_default();
        let mut record = Record { compiler: head.trim_start_matches(HEAD).to_owned(), benchmarks: BTreeMap::new() };
        for row in csv::Reader::from_reader(table.as_bytes()).deserialize() {
            let (benchmark, function, count): (String, String, u64) = row.expect("a row of counts.csv");
            let counts = record.benchmarks.entry(benchmark).or_default();
            if function == ALL {
                counts.all = count;
            } else {
                counts.functions.insert(function, count);
            }
        }
        record
    }

    pub fn write(&self) {
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record(["benchmark", "function", "instructions"]).expect("a row");
        for (benchmark, counts) in &self.benchmarks {
            let mut row = |function: &str, count: u64| {
                table.write_record([benchmark, function, &count.to_string()]).expect("a row");
            };
            row(ALL, counts.all);
            let least = least_recorded(counts.all);
            for (function, count) in counts.functions.iter().filter(|(_, count)| **count >= least) {
                row(function, *count);
            }
        }
        let table = String::from_utf8(table.into_inner().expect("a table")).expect("text");
        fs::write(path(), format!("{HEAD}{}\n{table}", self.compiler)).expect("counts.csv");
    }
}

/// The instructions from which on those of a function are recorded.
pub fn least_recorded(all: u64) -> u64 {
    all / RECORDED
}
