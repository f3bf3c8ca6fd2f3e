//! `find --linkage six-bar` and `any`: several linkages together.

use std::fs;

use coupler_atlas::find::Several;
use serde_json::Value as Json;
use tempfile::TempDir;

use super::random_curves::{Random, random_curve};
use crate::support::command::{printed, run};
use coupler_curves::catalogue;

/// The path of the curve of a random linkage.
fn path_of(linkage: &str, seed: u64) -> String {
    let (points, _) = random_curve(&catalogue::find(linkage).unwrap(), true, &mut Random(seed), 60);
    let rows = points.iter().map(|p| format!("{},{}\n", p.x, p.y));
    rows.collect()
}

fn folder_with_paths(paths: &[(&str, String)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    paths.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
    folder
}

#[test]
fn names_of_several_linkages_are_no_linkages() {
    for several in Several::ALL {
        assert!(catalogue::find(several.name()).is_none());
        assert_eq!(Several::named(several.name()), Some(several));
    }
    let folder = folder_with_paths(&[("path.csv", path_of("four-bar", 3))]);
    let arguments = ["find", "path.csv", "--linkage", "six-bar", "--keep", "p", "--index", "0"];
    let (code, _, error) = run(folder.path(), &arguments);
    assert!(code == 2 && error.contains("--index"), "{code} {error}");
    let (code, _, error) = run(folder.path(), &arguments[..6]);
    assert!(code == 2 && error.contains("--keep keeps parameters of one linkage"), "{code} {error}");
    let unknown = ["find", "path.csv", "--linkage", "any", "--where", "nonsense > 1"];
    let (code, _, error) = run(folder.path(), &unknown);
    assert!(code == 2 && error.contains("nonsense"), "{code} {error}");
}

#[test]
#[ignore = "thorough"]
fn the_curve_of_a_four_bar_is_that_of_a_four_bar_first_and_that_of_a_six_bar_is_found() {
    let paths = [("four.csv", path_of("four-bar", 3)), ("six.csv", path_of("stephenson-i-six-bar", 7))];
    let folder = folder_with_paths(&paths);
    let found = |path: &str, linkage: &str| -> Json {
        let arguments = ["find", path, "--closed", "--linkage", linkage, "--max-link", "inf", "--json"];
        serde_json::from_str(&printed(folder.path(), &arguments)).unwrap()
    };
    let first = |found: &Json| found["results"][0].clone();
    let deviation = |result: &Json| result["rms_relative"].as_f64().unwrap();
    let four = first(&found("four.csv", "any"));
    assert!(deviation(&four) < 1e-4 && four["linkage"] == "four-bar", "{four}");
    let six = found("six.csv", "six-bar");
    assert!(deviation(&first(&six)) < 0.01, "{}", first(&six));
    // Those that jam come last, and of each kind the nearest first, but for those that are exact.
    let jams: Vec<bool> = six["results"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["mu_worst_deg"].as_f64().is_some_and(|mu| mu < 5.0))
        .collect();
    assert!(jams.is_sorted(), "{jams:?}");
    // The index is read back, and another number of threads changes nothing.
    let arguments = ["find", "six.csv", "--closed", "--linkage", "six-bar", "--max-link", "inf", "--json", "-j", "1"];
    assert_eq!(serde_json::from_str::<Json>(&printed(folder.path(), &arguments)).unwrap(), six);
    // Its manifest renders what was found.
    let manifest = printed(folder.path(), &["find", "four.csv", "--linkage", "any", "--effort", "quick", "--toml"]);
    fs::write(folder.path().join("found.toml"), manifest).unwrap();
    printed(folder.path(), &["validate", "found.toml"]);
}
