//! Two faults in one manifest are told in one run, each as by itself, and nothing that only follows from them.

mod faults;

use coupler_atlas::manifest;
use coupler_atlas::manifest::ParseOutcome;

use crate::support::plan::faultless_plan;
use faults::FAULTS;

/// A manifest with most keys.
const MANIFEST: &str = include_str!("manifest.toml");

/// The messages of the problems of a manifest, in alphabetical order.
fn messages(text: &str) -> Vec<String> {
    let ParseOutcome { plan, problems } = manifest::parse(text);
    assert!(plan.is_none(), "the manifest is accepted:\n{text}");
    let mut messages: Vec<String> = problems.into_iter().map(|problem| problem.message).collect();
    messages.sort();
    messages
}

/// The place of the k-th fault in the manifest.
fn place(k: usize) -> std::ops::Range<usize> {
    let (old, ..) = FAULTS[k];
    let start = MANIFEST.find(old).unwrap_or_else(|| panic!("{old} is not in the manifest"));
    assert_eq!(MANIFEST.rfind(old), Some(start), "{old} is twice in the manifest");
    start..start + old.len()
}

/// Whether a fault is in the joints and parameters of the linkage `own`, without which it is not known what the names of its family are.
fn hides_names(k: usize) -> bool {
    let names = MANIFEST.find("parameters =").unwrap()..MANIFEST.find("\ncaption = \"g =").unwrap();
    let joints = MANIFEST.find("trace = [\"M\"]\ncircuits").unwrap()..MANIFEST.len();
    let settings = MANIFEST.find("circuits = \"start\"\nseen").unwrap();
    let arc = MANIFEST.find("arc =").unwrap()..MANIFEST.find("[linkage.joints]").unwrap();
    let start = place(k).start;
    (names.contains(&start) || joints.contains(&start)) && start != settings && !arc.contains(&start)
}

/// Whether a fault is found by the names and the bounds of the linkage `own` only.
fn needs_names(k: usize) -> bool {
    ["{ r = -1", "x = \"rr", "\"foos\"", "by = [\"gg\"]"].iter().any(|part| FAULTS[k].1.contains(part))
}

#[test]
fn two_faults_are_told_in_one_run() {
    faultless_plan(MANIFEST);
    let with = |faults: &[usize]| {
        faults.iter().fold(MANIFEST.to_owned(), |text, &k| text.replacen(FAULTS[k].0, FAULTS[k].1, 1))
    };
    let single: Vec<Vec<String>> = (0..FAULTS.len()).map(|k| messages(&with(&[k]))).collect();
    for (told, (_, new, parts)) in single.iter().zip(FAULTS) {
        let all_told = parts.iter().all(|part| told.iter().any(|message| message.contains(part)));
        assert!(all_told && told.len() == parts.len(), "{new}: {told:?}");
    }
    // Each with some that are near and some that are far; tens of thousands of pairs would take too long.
    for step in [1, 2, 5, 13, 34, 57] {
        for (k, other) in (0..FAULTS.len()).map(|k| (k, (k + step) % FAULTS.len())) {
            let (a, b) = (place(k), place(other));
            let overlap = a.start < b.end && b.start < a.end;
            if overlap || hides_names(k) && needs_names(other) || hides_names(other) && needs_names(k) {
                continue;
            }
            let mut expected = [&single[k][..], &single[other][..]].concat();
            expected.sort();
            assert_eq!(messages(&with(&[k, other])), expected, "{} and {}", FAULTS[k].1, FAULTS[other].1);
        }
    }
}

/// What is reported where `old` is replaced in the manifest: messages with their remedies.
fn told(old: &str, new: &str) -> Vec<[String; 2]> {
    assert!(MANIFEST.contains(old), "{old}");
    let problems = manifest::parse(&MANIFEST.replacen(old, new, 1)).problems;
    problems.into_iter().map(|problem| [problem.message, problem.help]).collect()
}

/// Each replacement has a problem with these parts of its message and of its remedy.
#[test]
fn each_value_has_a_remedy_of_its_kind() {
    for (old, new, message, help) in [
        ("\"20 deg\" }]", "\"200 mm\" }]", "`mm` is not a unit here", "write an angle like \"2 deg\""),
        ("{ r = 1, g", "{ r = \"1 mm\", g", "`mm` is not a unit here", "lengths are numbers in the unit of the atlas"),
        ("{ r = 1, g", "{ r = \"1 qq\", g", "`qq` is not a unit here", "give a length as a number without a unit"),
        ("\"20 deg\" }]", "\"2 deg + 3 rad\" }]", "unexpected `+` after the unit `deg`", "as in \"(2 + 3) deg\""),
        ("\"20 deg\" }]", "\"2 a + 3\" }]", "unexpected `a`", "there must be an operator"),
        ("r = { default = 1", "r = { default = \"30 deg\"", "unexpected `deg`", "`rad(30)` is 30 degrees in radians"),
        ("across = 1 }\nlet", "and = 1 }\nlet", "the name `and` is reserved", "use another name"),
        ("across = 1 }\nlet", "\"ä\" = 1 }\nlet", "the name `ä` cannot be used", "a letter from a to z"),
        ("across = 1 }\nlet", "across = 1, across = 2 }\nlet", "duplicate key", "leave one of the two out"),
        (
            "along = { from = 0, to = 1, count = 2 }",
            "along = { from = 1, to = 1e300, step = 1e-300 }",
            "10^18",
            "fewer",
        ),
    ] {
        let told = told(old, new);
        let has = |problem: &[String; 2]| problem[0].contains(message) && problem[1].contains(help);
        assert!(told.iter().any(has), "{new}: {told:?}");
    }
}

/// Each replacement has as many problems as it has faults: what only follows from one is none.
#[test]
fn what_follows_from_a_fault_is_not_told() {
    let drawing = "[linkage.drawing]\njoints = { P = [0, 0], Q = [1] }\nframe = [\"P\"]\nlinks = [[\"P\", \"Q\"]]\ninput = \"P Q\"\n[linkage.joints]\n";
    for (old, new, count) in [
        ("let = {", "lett = {", 1),
        ("grid = {", "gird = {", 1),
        ("let = { rocker = \"2 + crank\" }", "let = [2]", 1),
        ("parameters = {", "paramters = {", 1),
        ("r = { default = 1, min = 0 }", "r = 1", 1),
        // A rocker that is negative because the crank is.
        ("crank = [1, 1.5]", "crank = [-3, 1.5]", 1),
        // A parameter of an unknown linkage may be an angle.
        ("linkage = \"own\"", "linkage = \"owm\"", 1),
        ("load = { joint = \"B\", force = 2 }", "load = { joint = \"BX\", force = 0 }", 2),
        // A table in place of a list of one is read all the same.
        ("[[book.chapter]]\ntitle = \"Change points\"", "[book.chapter]\ntitle = \" \"", 2),
        // The joints of a drawing with a fault have their names; the drawing is the start.
        ("[linkage.joints]\n", drawing, 2),
        ("trace = [\"M\"]\ncircuits = \"start\"\nseen", "circuits = \"start\"\nseen", 1),
        ("unit = \"mm\"", "unit = \"ell\"", 1),
    ] {
        let told = told(old, new);
        assert_eq!(told.len(), count, "{new}: {told:?}");
    }
    let without_joints = MANIFEST.split_once("[linkage.joints]").unwrap().0.replace("trace = [\"M\"]\ncirc", "circ");
    let told: Vec<String> = manifest::parse(&without_joints).problems.into_iter().map(|p| p.message).collect();
    for message in ["a [[linkage]] has no `joints`", "a [[linkage]] has no `trace`"] {
        assert!(told.iter().any(|other| other == message), "{told:?}");
    }
}

#[test]
fn the_book_is_read_beside_a_family_that_cannot_be() {
    let text = MANIFEST
        .replace("four-bar", "four-baz")
        .replace("linkage = \"own\"", "linkage = \"owm\"")
        .replace("sort = \"length\"\n", "sort = \"length +\"\n")
        .replace("where = \"is_change_point\"", "where = \"area\"")
        .replace("{length:.2} of {crank}", "{length:9z} of {crank}")
        .replace("binding = \"10 mm\"", "binding = \"70 mm\"");
    assert_eq!(messages(&text).len(), 6, "{:?}", messages(&text));
}
