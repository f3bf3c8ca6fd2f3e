//! The best curves of shards.

use std::collections::BTreeSet;
use std::fs;

use super::{MANIFEST, csv_rows, gather_problems, parquet_rows, shard, sweep_all};
use crate::support::command::{folder_with, printed, run};

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
    let all = values(&csv_rows(&path.join("whole/bars/cells.csv")), &["length", "frame", "cell", "trace", "circuit"]);
    assert!(all.len() > 12);
    for (by, key) in [("-length", 0), ("frame", 1)] {
        let sign = if key == 0 { -1.0 } else { 1.0 };
        // All joints that are traced on a circuit have the same frame: the first counts.
        let mut circuits = BTreeSet::new();
        let mut all: Vec<&Vec<f64>> =
            all.iter().filter(|row| key == 0 || circuits.insert([row[2], row[4]].map(f64::to_bits))).collect();
        all.sort_by(|a, b| {
            (sign * a[key]).total_cmp(&(sign * b[key])).then_with(|| a[2..].partial_cmp(&b[2..]).unwrap())
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
    let points = parquet_rows(&path.join("best--length-1/bars").join(shard("points", 0, 1, "parquet")));
    let whole = csv_rows(&path.join("whole/bars/points.csv"));
    assert_eq!(points.len(), 1 + 5 * 12);
    assert!(points.iter().all(|row| whole.contains(row)));
    // Over families; one that lacks a name of the expression has no best.
    sweep_all(path, "families", 2, &["--no-points"]);
    let table = printed(path, &["gather", "families", "--top", "100", "--by", "-a * straight_length"]);
    assert!(table.contains(",evans,M,") && table.contains(",far,M,") && !table.contains(",bars,"), "{table}");
    let keys: Vec<f64> = gathered(&table, &["by"]).iter().map(|row| row[0]).collect();
    assert!(keys.len() == 5 + 2 && keys.is_sorted(), "{keys:?}");
}

#[test]
fn a_family_is_ranked_by_its_sort() {
    let folder =
        folder_with(&MANIFEST.replace("cases = [{ g = 3 }", "sort = \"output_dwell_length\"\ncases = [{ g = 3 }"));
    let path = folder.path();
    let families = ["--only", "bars", "--only", "actuator"];
    let out = printed(path, &[&["sweep", "-o", "own", "--no-points", "--top", "2"], &families[..]].concat());
    // The table of each family is below its line: the names, the least value of its own expression first, the parameters, and the
    // measures of expressions.
    let lines: Vec<Vec<&str>> = out.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(lines.len(), 2 * 4, "{out}");
    assert!(out.contains("the best 2 curves by `-length`, written to "), "{out}");
    assert_eq!(lines[1], ["curve", "by", "frame", "coupler", "rocker", "length"]);
    for (rank, line) in lines[2..4].iter().enumerate() {
        let [length, by] = [line[6], line[2]].map(|text| text.parse::<f64>().unwrap());
        assert!(line[0] == (rank + 1).to_string() && line[1].starts_with("bars:") && length == -by, "{out}");
    }
    let columns: Vec<usize> = out.lines().skip(1).take(3).map(|line| line.chars().count()).collect();
    assert!(columns.iter().all(|width| *width == columns[0]), "{out}");
    assert_eq!(lines[5].last(), Some(&"output_dwell_length"), "{out}");
    // A complete table is shown again, and nothing with --quiet.
    let again = printed(path, &[&["sweep", "-o", "own", "--no-points", "--top", "2"], &families[..]].concat());
    assert_eq!(again.replace("complete in", "written to"), out);
    assert_eq!(
        printed(path, &[&["sweep", "-q", "-o", "own", "--no-points", "--top", "2"], &families[..]].concat()),
        ""
    );
    // Each family by its own: those of the shards, and those of all curves.
    printed(path, &[&["sweep", "-q", "-o", "all", "--no-points"], &families[..]].concat());
    let table = printed(path, &["gather", "own", families[0], families[1], families[2], families[3]]);
    let own = printed(path, &[&["gather", "all", "--top", "2"], &families[..]].concat());
    assert_eq!(table, own);
    let best = gathered(&table, &["by"]);
    assert!(best.len() == 4 && best[..2].is_sorted() && best[2..].is_sorted() && best[0][0] < 0.0, "{table}");
    assert!(table.lines().skip(1).take(2).all(|line| line.contains(",bars,")), "{table}");
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

#[test]
fn an_empty_answer_says_why() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    sweep_all(path, "out", 2, &["--no-points"]);
    sweep_all(path, "best", 2, &["--no-points", "--top", "3", "--by", "length / 0 * 0"]);
    let (code, _, err) =
        run(path, &["sweep", "-q", "-o", "none", "--only", "evans", "--top", "3", "--by", "length / 0 * 0"]);
    assert_eq!((code, err.as_str()), (0, "note: evans: `length / 0 * 0` has no value for any curve\n"));
    for (arguments, expected) in [
        (&["out", "--top", "3", "--by", "0/0"][..], "nothing is the best: `0/0` has no value for any of "),
        (&["best"], "nothing is the best: no shard has a curve for which `length / 0 * 0` has a value"),
    ] {
        let (code, out, err) = run(path, &[&["gather"], arguments, &["--toml", "best.toml"]].concat());
        assert!(code == 0 && out.lines().count() == 1 && err.contains(expected), "{out}{err}");
        assert!(err.contains("best.toml is not written") && !path.join("best.toml").exists(), "{err}");
    }
}

#[test]
fn only_what_gather_wrote_is_replaced() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    sweep_all(path, "out", 1, &["--no-points"]);
    let gather = |toml: &str| run(path, &["gather", "out", "-q", "--top", "2", "--by", "length", "--toml", toml]);
    let (code, out, err) = gather("atlas.toml");
    assert!(
        code == 2 && out.is_empty() && err.contains("atlas.toml exists already, and is not what gather writes"),
        "{err}"
    );
    assert_eq!(fs::read_to_string(path.join("atlas.toml")).unwrap(), MANIFEST);
    for _ in 0..2 {
        assert_eq!(gather("best.toml").0, 0);
    }
}

#[test]
fn families_without_the_measure_have_no_best() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    sweep_all(path, "out", 2, &["--no-points"]);
    // `far` names its measures, and `area` is not among them.
    let (code, out, err) = run(path, &["gather", "out", "--top", "100", "--by", " area  "]);
    assert!(code == 0 && out.contains(",evans,M,") && !out.contains(",far,"), "{out}{err}");
    assert!(err.contains("note: no curve of far has no column `area`: sweep it with that measure"), "{err}");
    let message = gather_problems(path, &["out", "--only", "far", "--top", "1", "--by", "area"]);
    assert!(message.contains("far has no column `area`"), "{message}");
    // The best by a name that one family lacks; that is checked all the same.
    sweep_all(path, "best", 2, &["--no-points", "--top", "2", "--by", " frame"]);
    let (code, out, err) = run(path, &["gather", "best", "--only", "evans"]);
    assert_eq!((code, out.as_str(), err.as_str()), (0, "", "evans: 2 shards, 5 cells, 0 curves\n"));
    // Other options of another family.
    printed(
        path,
        &[
            "sweep",
            "-q",
            "-o",
            "out",
            "--only",
            "far",
            "--shard",
            "0/2",
            "--top",
            "1",
            "--by",
            "p",
            "--no-points",
            "--force",
        ],
    );
    printed(path, &["gather", "out", "--only", "evans"]);
    assert!(gather_problems(path, &["out"]).contains("make them with the same options"));
}
