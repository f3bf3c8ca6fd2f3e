//! Counts by callgrind.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// Numbers of instructions.
#[derive(Debug, Default)]
pub struct Counts {
    pub all: u64,
    /// Those of each function itself, without those that it calls.
    pub functions: BTreeMap<String, u64>,
}

impl Counts {
    /// The functions that have more than before, those with the most more first. Those of which none are recorded had at most `unrecorded`.
    pub fn rises(&self, before: &Counts, unrecorded: u64) -> Vec<(String, u64)> {
        let rise = |(function, count): (&String, &u64)| {
            let before = before.functions.get(function).copied().unwrap_or(unrecorded);
            Some((function.clone(), count.checked_sub(before).filter(|rise| *rise > 0)?))
        };
        let mut rises: Vec<(String, u64)> = self.functions.iter().filter_map(rise).collect();
        rises.sort_by_key(|(_, rise)| std::cmp::Reverse(*rise));
        rises
    }
}

/// Counts the instructions of a benchmark, in a process of its own.
///
/// # Panics
/// Valgrind is not installed, or the benchmark fails.
pub fn count(name: &str) -> Counts {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("callgrind.out");
    let status = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet", "--toggle-collect=*coupler_counts::counted*"])
        .args(["--compress-strings=no", "--compress-pos=no"])
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(std::env::current_exe().expect("this program"))
        .args(["--run", name])
        .env("RAYON_NUM_THREADS", "1")
        .status();
    let status = status.expect("valgrind is not installed");
    assert!(status.success(), "{name}: {status}");
    let counts = parse(&fs::read_to_string(out).expect("what callgrind has written"));
    assert!(counts.all > 0, "{name}: no instruction is counted; are the names of functions stripped?");
    counts
}

/// Reads what callgrind writes: after the name of a function its own costs, and after each call the costs of what is called.
fn parse(text: &str) -> Counts {
    let mut counts = Counts::default();
    let mut function = String::new();
    let mut is_of_call = false;
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("fn=") {
            function = plain_name(name);
        } else if line.starts_with("calls=") {
            is_of_call = true;
        } else if let Some((_, cost)) = line.split_once(' ').filter(|_| line.starts_with(|c: char| c.is_ascii_digit()))
        {
            let cost: u64 = cost.trim().parse().unwrap_or(0);
            if !std::mem::take(&mut is_of_call) {
                *counts.functions.entry(function.clone()).or_default() += cost;
                counts.all += cost;
            }
        }
    }
    counts
}

/// A name without what differs from build to build, the hash at its end, and without the depth of a recursion.
fn plain_name(name: &str) -> String {
    let name = name.split('\'').next().unwrap_or(name);
    match name.rsplit_once("::h") {
        Some((path, hash)) if hash.len() == 16 && hash.chars().all(|c| c.is_ascii_hexdigit()) => path.to_owned(),
        _ => name.to_owned(),
    }
}
