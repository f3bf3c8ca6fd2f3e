//! `design LINKAGE`: the dimensions of any linkage by wishes on its measures, as the program prints them. `crates/coupler-find/tests/design.rs`
//! compares what is found with closed forms.

use serde_json::Value as Json;
use tempfile::TempDir;

use crate::support::command::{Ran, folder_with, program, run};
use crate::support::plan::faultless_plan;

const SLIDER_CRANK: [&str; 4] = ["design", "slider-crank", "--where", "output_stroke == 80 and time_ratio == 1.2"];

fn in_new_folder(arguments: &[&str]) -> Ran {
    run(TempDir::new().unwrap().path(), arguments)
}

#[test]
fn designs_are_printed_as_text_json_manifest_and_plate() {
    let folder = TempDir::new().unwrap();
    let with = |more: &[&str]| {
        let (code, out, err) =
            run(folder.path(), &[&SLIDER_CRANK[..], &["--effort", "quick", "--best", "3"], more].concat());
        assert_eq!((code, err.as_str()), (0, ""));
        out
    };
    let text = with(&["--svg", "plate.svg"]);
    assert!(text.starts_with("slider-crank, 3 parameters searched: crank, coupler, offset\n"), "{text}");
    assert_eq!(text.matches("output_stroke 80, time_ratio 1.2\n").count(), 3, "{text}");
    let plate = std::fs::read_to_string(folder.path().join("plate.svg")).unwrap();
    assert_eq!(plate.matches("class=\"curve\"").count(), 3);
    let json: Json = serde_json::from_str(&with(&["--json"])).unwrap();
    let designs = json["designs"].as_array().unwrap();
    assert_eq!(designs.len(), 3);
    let plan = faultless_plan(&with(&["--toml"]));
    for (k, design) in designs.iter().enumerate() {
        assert_eq!(design["rank"], k + 1);
        assert!((design["wishes"][0]["value"].as_f64().unwrap() - 80.0).abs() < 1e-9);
        let family = &plan.families[0].family;
        let cell = family.cell(k);
        for (name, value) in design["parameters"].as_object().unwrap() {
            assert_eq!(Some(family.value(name, &cell)), value.as_f64(), "{name}");
        }
    }
}

#[test]
fn all_that_is_wrong_is_said_in_one_run() {
    let arguments = [
        "design",
        "four-bar",
        "--where",
        "output_swing_dg == 60",
        "--maximize",
        "output_stroke",
        "--minimize",
        "2 +",
        "--range",
        "crnk = 1..2",
        "--range",
        "crank = 3..2",
        "--range",
        "coupler",
        "--fix",
        "rocker",
        "--fix",
        "frame = -1",
        "--max-link",
        "-3",
    ];
    let (code, out, err) = in_new_folder(&arguments);
    assert_eq!((code, out.as_str()), (2, ""));
    for part in [
        "`output_swing_dg == 60`: unknown name `output_swing_dg`; did you mean `output_swing_deg`?",
        "`four-bar` has no `output_stroke`, which is defined for linkages whose output is a slider only",
        "`2 +`: unexpected end of the expression",
        "`crnk = 1..2`: four-bar has no parameter `crnk`; did you mean `crank`?",
        "`crank = 3..2`: 3 is not below 2",
        "`coupler` is no range of a parameter; write it like",
        "`rocker` has no default",
        "`frame` is -1, and must be more than 0",
        "--max-link: -3 is not positive",
    ] {
        assert!(err.contains(part), "{part}: {err}");
    }
    assert_eq!(err.matches("error: ").count(), 9, "{err}");
    let (code, _, err) = in_new_folder(&["design", "watt"]);
    assert!(code == 2 && err.contains("nothing is wished"), "{err}");
    let (code, _, err) = in_new_folder(&["design", "wat", "--maximize", "area"]);
    assert!(code == 2 && err.contains("did you mean `watt`?"), "{err}");
    let excluding = ["design", "watt", "--where", "mu_worst_deg >= 50 and mu_worst_deg <= 40"];
    let (code, _, err) = in_new_folder(&excluding);
    assert!(code == 2 && err.contains("`mu_worst_deg ≥ 50` and `mu_worst_deg ≤ 40` exclude each other"), "{err}");
    let (code, _, err) = in_new_folder(&["design", "straight-line", "--where", "area > 1"]);
    assert!(code == 2 && err.contains("--where"), "{err}");
}

#[test]
#[ignore = "thorough"]
fn what_cannot_be_met_says_what_each_wish_comes_to() {
    let wishes = "output_stroke == 80 and time_ratio == 1.25 and mu_worst_deg >= 60";
    let arguments = ["design", "slider-crank", "--where", wishes, "--effort", "quick"];
    let (code, out, err) = in_new_folder(&arguments);
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(err.contains("no slider-crank was found that meets these wishes"), "{err}");
    assert!(err.contains("hint: `mu_worst_deg ≥ 60`: mu_worst_deg comes to 42.8"), "{err}");
    assert!(err.contains("hint: `time_ratio = 1.25`: time_ratio comes to 1.0"), "{err}");
    let (code, _, err) = in_new_folder(&[
        "design",
        "watt",
        "--maximize",
        "area",
        "--range",
        "p = 90..99",
        "--fix",
        "r = 1",
        "--fix",
        "a = 1",
    ]);
    assert!(code == 2 && err.contains("no linkage within these ranges can be assembled"), "{err}");
}

#[test]
#[ignore = "thorough"]
fn designs_are_the_same_with_any_number_of_threads() {
    let output = |threads: &str| {
        let folder = TempDir::new().unwrap();
        let arguments =
            [&SLIDER_CRANK[..], &["--maximize", "mu_worst_deg", "--effort", "quick", "--json", "-j", threads]].concat();
        program(folder.path()).args(arguments).output().unwrap().stdout
    };
    let one = output("1");
    assert!(!one.is_empty() && one == output("3"));
}

#[test]
fn linkages_of_a_manifest_are_designed_and_written_with_their_text() {
    let manifest = "[atlas]\ntitle = \"T\"\n[[linkage]]\nid = \"lift\"\ntrace = [\"B\"]\n\
        parameters = { rise = { default = 0.2, min = 0, max = 1 } }\n\
        [linkage.drawing]\njoints = { O = [0, 0], C = [4, 0], A = [0.6, 0.8], B = [3.4, \"2.6 + rise\"] }\nframe = [\"O\", \"C\"]\n\
        links = [[\"O\", \"A\"], [\"A\", \"B\"], [\"B\", \"C\"]]\ninput = \"O A\"\n\
        [[family]]\nid = \"lift\"\nlinkage = \"lift\"\ncases = [{}]\n";
    let folder = folder_with(manifest);
    let arguments = [
        "design",
        "lift",
        "--manifest",
        "atlas.toml",
        "--maximize",
        "mu_worst_deg",
        "--effort",
        "quick",
        "--best",
        "1",
    ];
    let (code, out, err) = run(folder.path(), &[&arguments[..], &["--toml"]].concat());
    assert_eq!((code, err.as_str()), (0, ""));
    let plan = faultless_plan(&out);
    let rise = plan.families[0].family.value("rise", &plan.families[0].family.cell(0));
    assert!((0.0..=1.0).contains(&rise), "{rise}");
}
