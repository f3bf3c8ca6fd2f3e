//! A message about the input proposes the unit that the input has: degrees for a crank, none for an actuator, and neither where there is no input.

use coupler_atlas::manifest;
use coupler_curves::problem::Problem;

fn errors(text: &str) -> Vec<Problem> {
    manifest::parse(text).problems.into_iter().filter(Problem::is_error).collect()
}

/// A linkage with these joints besides the pivot O, with these keys, and a family of it with these lines.
fn with(joints: &str, keys: &str, family: &str) -> String {
    format!(
        "[atlas]\ntitle = \"T\"\n[[linkage]]\nid = \"own\"\ntrace = [\"A\"]\n{keys}\n[linkage.joints]\nO = {{ fixed = [0, 0] }}\n\
         {joints}\n[[family]]\nid = \"f\"\nlinkage = \"own\"\ncases = [{{}}]\n{family}\n"
    )
}

const CRANK: &str = "A = { crank = \"O\", length = 1 }";
const SLIDER_CRANK: &str = "C = { fixed = [2, 0] }\nA = { crank = \"O\", length = 1 }\nB = { slide = \"A\", length = 3, line = [\"O\", \"C\"], side = \"ahead\" }";
const ACTUATOR: &str = "C = { fixed = [2, 0] }\nA = { piston = [\"C\", \"O\"], length = 1, side = \"left\" }";

/// Every key that takes a value of the input, without one or with one that is wrong for both kinds: of the linkage, then of the family.
const KEYS: [(&str, &str); 7] = [
    ("input = { from = [1] }", ""),
    ("input = { to = true }", ""),
    ("arc = { branch = 1 }", ""),
    ("", "sampling = {}"),
    ("", "sampling = { step = -1, samples = 9 }"),
    ("", "straight = {}"),
    ("", "straight = { input = true }"),
];

/// The keys that take a number that is a length of an actuator, and an angle of a crank.
const NUMBERS: [(&str, &str); 5] = [
    ("start = 2.5", ""),
    ("input = { from = 2.5, to = 2.75 }", ""),
    ("arc = { from = 2.5, to = 2.75 }", ""),
    ("", "sampling = { step = 2.5 }"),
    ("", "straight = { input = 2.5 }"),
];

#[test]
fn a_length_is_not_asked_for_in_degrees_nor_an_angle_without_a_unit() {
    for (key, family) in KEYS {
        let help = |joints| -> String {
            let found = errors(&with(joints, key, family));
            assert!(!found.is_empty(), "{key}{family}");
            found.into_iter().map(|problem| problem.help).collect()
        };
        assert!(!help(ACTUATOR).contains("deg"), "{key}{family}: {}", help(ACTUATOR));
        let angle = help(CRANK);
        assert!(angle.contains("deg") || family.contains("[1]"), "{key}{family}: {angle}");
    }
    for (key, family) in NUMBERS {
        let found = errors(&with(ACTUATOR, key, family));
        assert!(found.is_empty(), "{key}{family}: {found:?}");
        let found = errors(&with(CRANK, key, family));
        let all_have_help =
            found.iter().all(|problem| problem.help.starts_with("write \"2.") && problem.help.contains(" deg\""));
        assert!(!found.is_empty() && all_have_help, "{key}{family}: {found:?}");
        // An angle has no place where a length is meant.
        let [key, family] = [key, family].map(|text| text.replace("2.5", "\"2.5 deg\""));
        let found = errors(&with(ACTUATOR, &key, &family));
        assert!(
            found.len() == 1 && found[0].help.ends_with("give a number without a unit"),
            "{key}{family}: {found:?}"
        );
    }
}

/// The displacement of a slider on a link is no input: where one might be meant this is said, and no degrees are proposed where there is no crank.
#[test]
fn a_slider_is_not_taken_for_the_input() {
    let found = errors(&with(SLIDER_CRANK, "output_link = \"B\"\nstart = 2.5", ""));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].message.ends_with("the input is the angle of the crank"), "{found:?}");
    assert!(
        found[0].help.contains("\"2.5 deg\"")
            && found[0].help.contains("a slider or an actuator that is the input is a joint with `slider` or `piston`"),
        "{found:?}"
    );
    let driven_by_slider = "C = { fixed = [2, 0] }\nB = { slide = \"C\", length = 3, line = [\"O\", \"C\"], side = \"ahead\" }\n\
                            A = { dyad = [\"O\", \"B\"], lengths = [1, 3], side = \"left\" }";
    for (key, family) in NUMBERS.into_iter().chain(KEYS) {
        let found = errors(&with(driven_by_slider, key, family));
        assert_eq!(found[0].message, "the linkage has no input");
        assert!(
            found[0].help.starts_with("add a crank, ") && found[0].help.contains("slider that is driven"),
            "{found:?}"
        );
        assert!(found.iter().all(|problem| !problem.help.contains("2.5 deg")), "{key}{family}: {found:?}");
    }
}

/// A list of other than two joints names no link; only a slider is proposed without brackets.
#[test]
fn an_output_link_in_brackets_is_answered_by_its_joints() {
    for (value, help) in [
        ("[\"B\"]", "write output_link = \"B\" for the slider"),
        ("[\"O\", \"A\", \"B\"]", "write output_link = \"B\" for the slider"),
        ("[\"C\"]", "name two joints of a link, as in output_link = [\"C\", \"B\"]"),
        ("[]", "name two joints of a link, as in output_link = [\"C\", \"B\"]"),
        ("[[\"O\", \"A\"]]", "name two joints of a link, as in output_link = [\"C\", \"B\"]"),
    ] {
        let found = errors(&with(SLIDER_CRANK, &format!("output_link = {value}"), ""));
        assert!(found.iter().any(|problem| problem.help == help), "{value}: {found:?}");
    }
}

#[test]
fn a_file_is_not_one_of_the_cases() {
    for value in ["[\"list.csv\"]", "[{}, \"list.csv\"]"] {
        let found = errors(&with(CRANK, "", "").replace("cases = [{}]", &format!("cases = {value}")));
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].help.ends_with("name one file with all of them: cases = \"list.csv\""), "{found:?}");
    }
}
