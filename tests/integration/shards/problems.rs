//! What is missing, mixed or wrong is named.

use std::fs;

use super::{MANIFEST, gather_problems, shard, sweep_all};
use crate::support::command::{folder_with, printed, run};

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
        (&["--top", "3"], "`evans`: it has no `sort`: say with --by what is least for the best curves"),
        (
            &["--top", "3", "--by", "straight_length"],
            "--by: `straight_length`: it runs as `sort` now, the least value first: write `--by -straight_length` for the greatest, or `--by \
             +straight_length` for the least",
        ),
        (
            &["--top", "3", "--by", " straight_length / 2 + mu_min_deg"],
            "write `--by \"-(straight_length / 2 + mu_min_deg)\"` for the greatest, or `--by \"+(straight_length / 2 + mu_min_deg)\"` for the least",
        ),
        (&["--top", "0", "--by", "length"], "0 is not in 1..=1000000"),
        (&["--top", "3", "--by", "lenght"], "--by: `lenght`: unknown name `lenght`; did you mean `length`?"),
        (&["--top", "3", "--by", "class"], "`class` is a word, and what is least must be a number"),
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
        (&["all", "--top", "3"], "`evans`: it has no `sort`: say with --by"),
        (&["all", "--top", "3", "--by", "mu_min_deg"], "write `--by -mu_min_deg` for the greatest"),
        (&["all", "--top", "3", "--by", "mu_min_deg * 2"], "write `--by \"-(mu_min_deg * 2)\"` for the greatest"),
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

#[test]
fn what_does_not_change_rows_may_differ() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    // Of three cells in seven shards, four are empty.
    let family = ["--only", "far", "--no-points"];
    sweep_all(path, "out", 7, &family);
    fs::write(path.join("atlas.toml"), MANIFEST.replace("\"T\"", "\"Another title\"")).unwrap();
    sweep_all(path, "other", 7, &family);
    let file = |folder: &str| fs::read(path.join(folder).join("far").join(shard("cells", 2, 7, "parquet"))).unwrap();
    assert_ne!(file("out"), file("other"), "the manifest of the family has the title");
    let (code, _, err) = run(path, &["gather", "out", "other", "--only", "far"]);
    assert!(code == 0 && err.contains("far: 7 shards, 3 cells"), "{err}");
    assert_eq!(err.matches("are the same shard, which counts once").count(), 7, "{err}");
    // A measure that `sort` uses is a column.
    fs::write(
        path.join("atlas.toml"),
        MANIFEST.replace("[\"straight_length\", \"class\"]", "[\"straight_length\", \"class\"]\nsort = \"area\""),
    )
    .unwrap();
    let (code, _, err) = run(path, &[&["sweep", "-o", "out", "--shard", "2/7"], &family[..]].concat());
    assert!(code == 2 && err.contains("it has other columns: not `area`"), "{err}");
    printed(path, &[&["sweep", "-o", "out", "--shard", "2/7", "--force"], &family[..]].concat());
    let message = gather_problems(path, &["out", "--only", "far"]);
    assert!(
        message.contains("have different columns: not `area`: make them with the same --measures, and with the same"),
        "{message}"
    );
}

#[cfg(unix)]
#[test]
fn a_folder_of_a_family_that_cannot_be_read_is_named() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    sweep_all(path, "out", 1, &["--no-points", "--measures", "none"]);
    fs::create_dir(path.join("out/lost+found")).unwrap();
    let allow = |name: &str, mode| fs::set_permissions(path.join(name), fs::Permissions::from_mode(mode)).unwrap();
    allow("out/lost+found", 0);
    let is_allowed = fs::read_dir(path.join("out/lost+found")).is_ok();
    printed(path, &["gather", "out"]);
    allow("out/far", 0);
    // Some users may read everything.
    if !is_allowed {
        let message = gather_problems(path, &["out"]);
        assert!(message.contains("out/far: Permission denied"), "{message}");
        printed(path, &["gather", "out", "--only", "evans"]);
    }
    allow("out/far", 0o755);
}
