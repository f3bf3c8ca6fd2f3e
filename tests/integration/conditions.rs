//! Where `where` keeps nothing, every command that filters says which of its conditions fails how often, and what values there are.

use std::fs;

use crate::support::command::{folder_with, run};

/// Of a crank-rocker of these lengths the transmission angle is least at the input 0: cos mu = (9 + 9 - (4 - crank)^2) / 18.
const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg"]
[[family]]
id = "f"
linkage = "four-bar"
sampling = { samples = 12 }
measures = ["mu_min_deg"]
grid = { crank = [1, 1.5] }
let = { frame = 4, coupler = 3, rocker = 3, along = 1, across = 1 }
where = "mu_min_deg > 89 and crank * 2 > 2.5 and length / mu_max_deg > 1"
"#;

/// What is said of the whole family: the greatest angle is that of the crank 1, whose cosine is 1/2.
const WHOLE: [&str; 7] = [
    "`where` keeps none of the 2 cells\n",
    "in 2 cells `crank` is 1 to 1.5, `crank · 2` is 2 to 3; on the 4 curves `mu_min_deg` is 49.2486 to 60, `mu_max_deg` is ",
    "`length` is ",
    "`length / mu_max_deg` is 0.",
    "; `mu_min_deg > 89` fails for 4 of 4 curves; ",
    "`crank · 2 > 2.5` fails for 1 of 2 cells; ",
    "`length / mu_max_deg > 1` fails for 4 of 4 curves\n",
];

#[test]
fn which_condition_fails_is_said_by_every_command_that_filters() {
    let folder = folder_with(MANIFEST);
    fs::write(folder.path().join("path.csv"), "x,y\n0,0\n2,1\n4,0\n3,-2\n1,-2\n").unwrap();
    for arguments in [
        &["validate"][..],
        &["render"],
        // Nothing has changed, and it is so all the same.
        &["render", "--quiet"],
        &["sweep", "-o", "swept"],
        &["sweep", "-o", "best", "--top", "3", "--by", "length"],
        &["find", "path.csv", "--atlas", "atlas.toml"],
    ] {
        let (code, _, err) = run(folder.path(), arguments);
        assert_eq!(code, 0, "{arguments:?}: {err}");
        WHOLE.iter().for_each(|part| assert!(err.contains(part), "{arguments:?}: {part}: {err}"));
    }
    // In a part of the cells nothing is missing that another may have.
    let (code, _, err) = run(folder.path(), &["sweep", "--shard", "0/2", "-o", "shards"]);
    assert_eq!((code, err.as_str()), (0, ""));
    // Of a single curve it is said what is wrong with it.
    for (curve, cells, conditions) in
        [("f:1.1.1", "`crank` is 1, `crank · 2` is 2; ", 3), ("f:2", "`crank` is 1.5, `crank · 2` is 3; ", 2)]
    {
        let (code, _, err) = run(folder.path(), &["export", "atlas.toml", curve, "--format", "csv"]);
        assert!(code == 2 && err.contains(&format!("`where` leaves it out: {cells}on the 2 curves ")), "{err}");
        assert_eq!(err.matches(" fails").count(), conditions, "{err}");
    }
}

/// What is searched for is no list of curves: of the nearest miss it is said which conditions it does not meet.
#[test]
fn which_condition_the_nearest_miss_fails_is_said() {
    let folder = folder_with(MANIFEST);
    fs::write(folder.path().join("path.csv"), "x,y\n0,0\n2,1\n4,0\n3,-2\n1,-2\n").unwrap();
    let search = [
        "find",
        "path.csv",
        "--effort",
        "quick",
        "--no-refine",
        "--top",
        "1",
        "--where",
        "crank > 1e6 and mu_worst_deg < 91",
    ];
    for linkage in [&["--index", "1000"][..], &["--linkage", "slider-crank", "--index", "200"]] {
        let (code, out, err) = run(folder.path(), &[&search[..], linkage].concat());
        assert!(code == 0 && out.contains("the nearest miss "), "{err}{out}");
        assert!(
            out.contains("note: the nearest miss does not meet --where: `crank` is ")
                && out.ends_with("; `crank > 1000000` fails\n"),
            "{out}"
        );
        // In JSON it is on standard error.
        let (code, out, err) = run(folder.path(), &[&search[..], linkage, &["--json"]].concat());
        assert!(code == 0 && !out.contains("note: ") && err.ends_with("; `crank > 1000000` fails\n"), "{err}");
    }
    // In an atlas it is a cell, of which those conditions hold that are not named.
    let kept = MANIFEST.split("where").next().unwrap();
    fs::write(folder.path().join("atlas.toml"), kept).unwrap();
    for (condition, ends) in [
        ("mu_min_deg > 89 and crank < 2", &["; `mu_min_deg > 89` fails for 2 of 2 curves\n"][..]),
        ("mu_min_deg > 40 and crank * 2 > 9", &["; `crank · 2 > 9` fails\n"]),
        // A single condition has its value, as elsewhere.
        ("mu_min_deg > 89", &["`mu_min_deg` is 60\n", "`mu_min_deg` is 49.2486\n"]),
    ] {
        let search = ["find", "path.csv", "--atlas", "atlas.toml", "--no-refine", "--where", condition];
        let (code, out, err) = run(folder.path(), &search);
        assert!(code == 0 && out.contains("the nearest miss is an answer without --where, --open:\n"), "{err}{out}");
        assert!(out.contains("\nnote: the nearest miss does not meet --where: "), "{out}");
        assert!(ends.iter().any(|end| out.ends_with(end)), "{out}");
        let (code, out, err) = run(folder.path(), &[&search[..], &["--json"]].concat());
        assert!(code == 0 && !out.contains("note: ") && ends.iter().any(|end| err.ends_with(end)), "{err}");
    }
    // What the nearest miss meets is not blamed.
    let search = ["find", "path.csv", "--atlas", "atlas.toml", "--no-refine", "--max-link", "1e-3"];
    let (code, out, err) = run(folder.path(), &[&search[..], &["--where", "crank < 2"]].concat());
    assert!(
        code == 0 && out.contains("is an answer without --max-link, --open:\n") && !out.contains("note: "),
        "{err}{out}"
    );
}

/// A single condition needs no count of failures, and one that joins others by `or` is one.
#[test]
fn a_single_condition_has_its_values() {
    for (condition, values) in [
        ("mu_min_deg > 89", "on the 4 curves `mu_min_deg` is 49.2486 to 60\n"),
        (
            "mu_min_deg > 2 * crank + 89",
            "in 2 cells `crank` is 1 to 1.5, `2 · crank + 89` is 91 to 92; on the 4 curves `mu_min_deg` is 49.2486 to 60\n",
        ),
        (
            "crank > 2 or mu_min_deg > 89",
            "in 2 cells `crank` is 1 to 1.5; on the 4 curves `mu_min_deg` is 49.2486 to 60\n",
        ),
    ] {
        let first = MANIFEST.split("where").next().unwrap();
        let folder = folder_with(&format!("{first}where = \"{condition}\"\n"));
        let (code, _, err) = run(folder.path(), &["validate"]);
        assert!(code == 0 && err.contains(values) && !err.contains(" fails"), "{err}");
    }
}
