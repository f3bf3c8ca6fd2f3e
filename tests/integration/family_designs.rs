//! Families whose cells are the answers of a search by wishes: the same as the command's, rendered, checked, and what is wrong with wishes.

use std::cell::Cell;
use std::fs;
use std::path::Path;
use std::rc::Rc;

use coupler_atlas::manifest::{self, ParseOutcome, Plan};
use coupler_atlas::manifest_files::{KnownTable, ManifestFiles};
use tempfile::TempDir;

use crate::support::command::{folder_with, printed, run};
use crate::support::folder::times;
use crate::support::plan::{faultless_plan, plan};

/// A family of designs, and another family.
const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg"]
[[family]]
id = "pumps"
linkage = "slider-crank"
sampling = { samples = 24 }
caption = "stroke {output_stroke:.2}"
[family.design]
where = "output_stroke == 80 and time_ratio == 1.2"
best = 3
effort = "quick"
[[family]]
id = "other"
linkage = "hoeken"
sampling = { samples = 24 }
cases = [{}]
"#;

/// A manifest with these keys of a design.
fn with_design(linkage: &str, keys: &str) -> String {
    format!(
        "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"found\"\nlinkage = \"{linkage}\"\nsampling = {{ samples = 24 }}\n[family.design]\n{keys}"
    )
}

fn parse(text: &str, files: ManifestFiles) -> ParseOutcome {
    manifest::parse_with_files(text, Some(&files))
}

/// The parameters of all cells of the first family, in their order.
fn cells(plan: &Plan) -> Vec<Vec<f64>> {
    let family = &plan.families[0].family;
    let parameters = &family.template.parameters;
    let values = |k: usize| parameters.iter().map(|one| family.value(&one.name, &family.cell(k))).collect();
    (0..family.cell_count()).map(values).collect()
}

#[test]
fn the_cells_are_the_answers_of_the_command() {
    let pump = "where = \"output_stroke == 80 and time_ratio == 1.2\"\nrange = [\"crank = 20..60 by 1\", \"coupler = 50..200\"]\n\
                max_link = \"500 / 2\"\nbest = 3\nseed = 3\n";
    let pump_options = [
        "--where",
        "output_stroke == 80 and time_ratio == 1.2",
        "--range",
        "crank = 20..60 by 1",
        "--range",
        "coupler = 50..200",
        "--max-link",
        "250",
        "--best",
        "3",
        "--seed",
        "3",
    ];
    let goals = "where = \"time_ratio > 1\"\nmaximize = [\"mu_worst_deg\"]\nminimize = \"p\"\nrange = \"p = 2..3 by 0.25\"\n\
                 fix = [\"r = 1\", \"a = 2.5\", \"s\", \"k\"]\n";
    let goal_options = [
        "--where",
        "time_ratio > 1",
        "--maximize",
        "mu_worst_deg",
        "--minimize",
        "p",
        "--range",
        "p = 2..3 by 0.25",
        "--fix",
        "r = 1",
        "--fix",
        "a = 2.5",
        "--fix",
        "s",
        "--fix",
        "k",
    ];
    for (linkage, keys, options) in [("slider-crank", pump, &pump_options[..]), ("evans", goals, &goal_options)] {
        let command = [&["design", linkage, "--effort", "quick", "--toml"], options].concat();
        let expected = cells(&faultless_plan(&printed(TempDir::new().unwrap().path(), &command)));
        assert!(!expected.is_empty(), "{linkage}");
        let text = with_design(linkage, &format!("{keys}effort = \"quick\"\n"));
        assert_eq!(cells(&plan(&text)), expected, "{linkage}");
    }
}

#[test]
fn designs_are_rendered_and_checked() {
    let folder = folder_with(MANIFEST);
    let out = folder.path().join("out");
    printed(folder.path(), &["render", "-j", "1"]);
    let page = fs::read_to_string(out.join("pumps/pumps-001.svg")).unwrap();
    assert!(["stroke 80.00", "data-cell=\"3\""].iter().all(|part| page.contains(part)), "{page}");
    printed(folder.path(), &["check", "--against", "out", "-j", "2"]);
    let before = times(&out);
    fs::write(folder.path().join("atlas.toml"), MANIFEST.replace("== 80", "== 81")).unwrap();
    printed(folder.path(), &["render", "-j", "2"]);
    let changed = times(&out).into_iter().filter(|(name, time)| before.get(name) != Some(time));
    let names: Vec<String> = changed.map(|(name, _)| name.replace('\\', "/")).collect();
    assert!(names.iter().any(|name| name == "pumps/points.csv"), "{names:?}");
    assert!(names.iter().all(|name| !name.starts_with("other/")), "{names:?}");
    fs::write(folder.path().join("atlas.toml"), MANIFEST).unwrap();
    let (code, found, err) = run(folder.path(), &["check", "--against", "out"]);
    assert!(code == 1 && format!("{found}{err}").contains("pumps"), "{found} {err}");
}

#[test]
fn a_family_depends_on_the_answers_and_not_on_how_they_are_wished() {
    let inputs = |text: &str| plan(text).families[0].manifest_inputs.clone();
    assert_eq!(inputs(MANIFEST), inputs(&MANIFEST.replace("time_ratio == 1.2", "time_ratio == 6/5")));
    for other in [("== 80", "== 80.001"), ("best = 3", "best = 2")] {
        assert_ne!(inputs(MANIFEST), inputs(&MANIFEST.replace(other.0, other.1)), "{other:?}");
    }
}

#[test]
fn what_was_found_is_not_searched_again() {
    let first = plan(MANIFEST);
    let known = KnownTable::of_plan(&first);
    let (parts, counted) = (Rc::new(Cell::new(0)), |parts: &Rc<Cell<usize>>| {
        let parts = Rc::clone(parts);
        ManifestFiles::new(Path::new("")).with_progress(move |_, _| parts.set(parts.get() + 1))
    });
    let again = parse(MANIFEST, counted(&parts).with_tables(known)).plan.unwrap();
    assert_eq!((parts.get(), cells(&again)), (0, cells(&first)));
    assert_eq!(again.families[0].manifest_inputs, first.families[0].manifest_inputs);
    // Nor is anything searched for a manifest with an error.
    assert!(parse(&MANIFEST.replace("\"T\"", "3"), counted(&parts)).plan.is_none());
    assert_eq!(parts.get(), 0);
    assert!(parse(MANIFEST, counted(&parts)).plan.is_some() && parts.get() > 2);
}

/// The problems of a manifest, each with the text at its place.
fn problems(text: &str) -> Vec<(String, String, String)> {
    let outcome = parse(text, ManifestFiles::new(Path::new("")));
    assert!(outcome.plan.is_none(), "{text}");
    let part = |problem: &coupler_curves::problem::Problem| text[problem.span.clone()].to_owned();
    outcome.problems.iter().map(|one| (part(one), one.message.clone(), one.help.clone())).collect()
}

#[test]
fn all_that_is_wrong_with_wishes_is_said_with_its_place() {
    let keys = "where = \"output_swing_dg == 60\"\nmaximize = [\"area\", \"output_stroke\"]\nminimize = \"2 +\"\n\
                range = [\"crnk = 1..2\", \"crank = 3..2\", \"coupler\"]\nfix = [\"rocker\", \"frame = -1\"]\n\
                max_link = 20\n";
    let text = with_design("four-bar", keys)
        .replace("[family.design]", "sort = \"-aera\"\nlet = { coupler = 2 }\n[family.design]");
    let found = problems(&text);
    let expected = [
        ("coupler", "`coupler` has a value in the grid or a case, and another in `let`", "keep one of the two"),
        ("aera", "unknown name `aera`", "area"),
        ("\"output_swing_dg == 60\"", "unknown name `output_swing_dg`", "did you mean `output_swing_deg`?"),
        ("\"output_stroke\"", "`four-bar` has no `output_stroke`", "`coupler-atlas list measures` lists all"),
        ("\"2 +\"", "`2 +`: unexpected end of the expression", ""),
        ("\"crnk = 1..2\"", "four-bar has no parameter `crnk`", "did you mean `crank`?"),
        ("\"crank = 3..2\"", "3 is not below 2", "write it like 20..60 or 20..60 by 1"),
        ("\"coupler\"", "`coupler` is no range of a parameter", "write it like"),
        ("\"rocker\"", "`rocker` has no default", "give its value"),
        ("\"frame = -1\"", "`frame` is -1, and must be more than 0", "correct it"),
    ];
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (place, said, remedy) in expected {
        let is_said = |(at, message, help): &(String, String, String)| {
            at == place && message.contains(said) && help.contains(remedy) && !help.is_empty()
        };
        assert!(found.iter().any(is_said), "{place}: {found:#?}");
    }
}

#[test]
fn wishes_that_cannot_be_searched_for_are_refused() {
    let table = |keys: &str| with_design("slider-crank", keys);
    for (text, place, message) in [
        (table("best = 2\n"), "", "nothing is wished"),
        (
            table("where = \"mu_worst_deg >= 50 and mu_worst_deg <= 40\"\n"),
            "\"mu_worst_deg >= 50 and mu_worst_deg <= 40\"",
            "exclude each other",
        ),
        (table("where = [\"area > 1\"]\n"), "[\"area > 1\"]", "expected a string, found a list"),
        (table("maximize = 3\n"), "3", "expected a string, found a number"),
        (table("maximize = \"area\"\nmax_link = -3\n"), "-3", "`max_link` is -3, and must be more than 0"),
        (table("maximize = \"area\"\nbest = 51\n"), "51", "invalid value `51`"),
        (table("maximize = \"area\"\neffort = \"most\"\n"), "\"most\"", "`most` is not one of the words allowed here"),
        (table("maximize = \"area\"\nspeed = 3\n"), "speed", "`design` has no key `speed`"),
        (
            table("maximize = \"area\"\nrange = [\"crank = 2..3\", \"crank = 3..4\"]\n"),
            "\"crank = 3..4\"",
            "the parameter has two ranges",
        ),
        (
            with_design("peaucellier-lipkin-none", "maximize = \"area\"\n"),
            "\"peaucellier-lipkin-none\"",
            "there is no linkage",
        ),
        (MANIFEST.replace("caption =", "limit = 2\ncaption ="), "", "there are 3 cases, more than the limit of 2"),
    ] {
        let found = problems(&text);
        assert!(found.len() == 1 && found[0].1.contains(message) && !found[0].2.is_empty(), "{text}: {found:?}");
        assert!(place.is_empty() || found[0].0 == place, "{place}: {found:?}");
    }
    let both = MANIFEST.replace("caption =", "grid = { crank = 2 }\ncaption =");
    assert!(problems(&both)[0].1.contains("a family has a `design` or parameter sets of its own, not both"));
    // Where nothing is searched, as in the gallery's page.
    let unsearched = manifest::parse(MANIFEST);
    assert!(unsearched.plan.is_none() && unsearched.problems.len() == 1, "{:?}", unsearched.problems);
    assert!(unsearched.problems[0].help.contains("--toml"), "{:?}", unsearched.problems);
}

#[test]
fn wishes_that_nothing_meets_say_what_comes_nearest() {
    let keys = "where = \"output_stroke == 80 and mu_worst_deg >= 89\"\nrange = [\"crank = 40..50\", \"coupler = 60..80\"]\n\
                fix = \"offset\"\neffort = \"quick\"\n";
    let (code, out, err) = run(folder_with(&with_design("slider-crank", keys)).path(), &["validate"]);
    assert_eq!((code, out.as_str()), (2, ""), "{err}");
    assert!(err.contains("no slider-crank was found that meets these wishes"), "{err}");
    assert!(err.contains("`mu_worst_deg ≥ 89`: mu_worst_deg comes to ") && err.contains("atlas.toml:7:"), "{err}");
}

#[test]
fn a_size_that_nothing_holds_is_a_warning() {
    let keys = "where = \"time_ratio == 1.2\"\nminimize = \"crank\"\nfix = \"offset = 0.5 * crank\"\nbest = 1\neffort = \"quick\"\n";
    let outcome = parse(&with_design("slider-crank", keys), ManifestFiles::new(Path::new("")));
    assert!(outcome.plan.is_some());
    let [warning] = &outcome.problems[..] else { panic!("{:?}", outcome.problems) };
    assert!(!warning.is_error() && warning.message.starts_with("nothing holds the size"), "{warning:?}");
    assert!(warning.help.contains("`max_link`"), "{warning:?}");
}
