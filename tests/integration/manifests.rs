//! Problems of a manifest are reported with their place and a remedy, all of them in one run.

use std::fs;

use coupler_atlas::manifest;
use coupler_curves::measure::Subject;
use coupler_curves::problem::report;

use crate::support::command::{folder_with, printed};
use crate::support::plan::{plan, problems};
use crate::support::table::rows;

/// A valid manifest, which tests modify.
const GOOD: &str = r#"[atlas]
title = "T"
[[family]]
id = "evans"
linkage = "evans"
sampling = { step = "2 deg" }
grid = { p = [2, 3] }
let = { a = "(1 + p)^1.5 / 2" }
"#;

/// Each replacement in the valid manifest is reported with this message at this line and column.
#[test]
fn each_mistake_has_its_message() {
    let cases = [
        ("[atlas]\ntitle = \"T\"\n", "", "the manifest has no [atlas]", "1:1"),
        ("title = \"T\"\n", "", "[atlas] has no `title`", "1:1"),
        ("title = \"T\"", "title = 3", "expected a string, found a number", "2:9"),
        ("title = \"T\"", "title = \"T\"\nformats = [\"swg\"]", "`swg` is not one of the words allowed here", "3:12"),
        ("id = \"evans\"", "id = \"../evans\"", "the id `../evans` is not a slug", "4:6"),
        ("id = \"evans\"", "id = \"Evans\"", "the id `Evans` is not a slug", "4:6"),
        ("linkage = \"evans\"", "linkage = \"evens\"", "there is no linkage `evens`", "5:11"),
        ("linkage = \"evans\"", "linkge = \"evans\"", "a [[family]] has no key `linkge`", "5:1"),
        ("\"2 deg\"", "\"0 deg\"", "`step` must not be 0", "6:21"),
        ("\"2 deg\"", "2", "the unit is missing", "6:21"),
        ("\"2 deg\"", "\"2 mm\"", "`mm` is not a unit here", "6:24"),
        ("{ step = \"2 deg\" }", "{}", "sampling needs a step or a number of samples", "6:12"),
        ("{ step = \"2 deg\" }", "{ samples = 1e9 }", "invalid value `1e9`", "6:24"),
        ("p = [2, 3]", "p = []", "`p` has no values", "7:14"),
        ("p = [2, 3]", "", "the grid is empty", "7:8"),
        ("p = [2, 3]", "p = [2, inf]", "its value is inf", "7:18"),
        ("p = [2, 3]", "p = [2, \"1/0\"]", "its value is inf", "7:18"),
        ("p = [2, 3]", "p = [2, -3]", "in cell 2 (p = -3, r = 1, k = 2), `p` is -3, and must be more than 0", "7:18"),
        ("p = [2, 3]", "p = { from = 1, to = 2, step = 0 }", "`step` must not be 0", "7:41"),
        ("p = [2, 3]", "p = { from = 0, to = 1e9, step = 1e-9 }", "the grid has 1000000000000000000 cells", "7:8"),
        ("p = [2, 3]", "p = [2, 3], q = [1]", "`q` is not a parameter of `evans`, and no expression uses it", "7:22"),
        ("p = [2, 3]", "p = [2, 3], a = [1]", "`a` has a value in the grid or a case, and another in `let`", "8:9"),
        ("sampling", "trace = [\"M\", \"Q\"]\nsampling", "there is no joint `Q`", "6:15"),
        ("sampling", "trace = [\"M\", \"M\"]\nsampling", "the joint `M` is named twice", "6:15"),
        ("sampling", "trace = []\nsampling", "no joint is traced", "6:9"),
        ("(1 + p)", "(1 + q)", "unknown name `q`", "8:19"),
        ("(1 + p)", "(1 + a)", "`a` is derived from itself", "8:9"),
        ("(1 + p)", "sine(p)", "unknown function `sine`", "8:14"),
        ("let = { a = \"(1 + p)^1.5 / 2\" }\n", "", "`a` has no value", "7:8"),
        ("[atlas]", "[pages]\n[atlas]", "a manifest has no key `pages`", "1:2"),
        ("[atlas]", "[page]\npaper = \"a7\"\n[atlas]", "`a7` is not one of the words allowed here", "2:9"),
        ("[atlas]", "[page]\ndpi = 1e6\n[atlas]", "1000000 pixels to the inch is out of range", "2:7"),
        ("let =", "columns = [\"vx\", \"vq\"]\nlet =", "there is no column `vq`", "8:18"),
        ("let =", "measures = [\"class\", \"lenght\"]\nlet =", "there is no measure `lenght`", "8:22"),
        ("let =", "measures = [\"area\", \"area\"]\nlet =", "the measure `area` is named twice", "8:21"),
        ("[atlas]", "[atlas", "invalid TOML: this `[` is not closed", "1:1"),
    ];
    for (from, to, message, place) in cases {
        let text = GOOD.replacen(from, to, 1);
        assert_ne!(text, GOOD, "{from}");
        let report = problems(&text);
        assert!(report.contains(message), "{message}:\n{report}");
        assert!(report.contains(&format!("atlas.toml:{place}\n")), "{message} at {place}:\n{report}");
        assert!(report.contains("help: "), "{report}");
    }
}

/// Each replacement in the valid manifest has this remedy, and no other problem follows from it.
#[test]
fn each_mistake_of_a_beginner_has_its_remedy() {
    let cases = [
        ("title = \"T\"", "title = \"T\"\nformats = \"pdf\"", "put it in brackets: [\"pdf\"]"),
        ("let =", "panels = 3\nlet =", "write them like [1, 2]"),
        ("let =", "sort = \"straight_length desc\"\nlet =", "write \"-straight_length\""),
        ("let =", "sort = \"area + length DESC\"\nlet =", "write \"-(area + length)\""),
        ("let =", "sort = \"area asc\"\nlet =", "leave it out: \"area\""),
        ("let =", "where = \"area => 2\"\nlet =", "write `>=`"),
        ("let =", "where = \"p > 1 AND area > 2\"\nlet =", "write `and`"),
        ("[[family]]", "[[families]]", "did you mean `family`?"),
        ("[atlas]\ntitle", "title", "did you mean `atlas.title`?"),
        ("title = \"T\"", "title = T", "write \"T\""),
        ("title = \"T\"", "title = My curves", "write \"My curves\""),
        ("grid = { p = [2, 3] }", "cases = \"list.csv\"", "write them in the manifest: cases = [{ p = 2 }, { p = 3 }]"),
        ("(1 + p)", "cos(deg(p))", "`deg` turns radians into degrees: write `cos(rad(p))`"),
        ("let =", "where = \"mu_min_deg > acos(0.5)\"\nlet =", "write `deg(acos(0.5))` for `acos(0.5)`"),
        ("p = [2, 3]", "p = 4,5", "write a decimal point, 4.5, or a list of values, [4, 5]"),
    ];
    for (from, to, remedy) in cases {
        let text = GOOD.replacen(from, to, 1);
        assert_ne!(text, GOOD, "{from}");
        let report = problems(&text);
        assert!(report.contains(&format!("help: {remedy}")), "{remedy}:\n{report}");
        assert_eq!(report.matches("error: ").count(), 1, "{report}");
    }
}

#[test]
fn a_value_out_of_its_bounds_is_named_where_it_is_given() {
    for (space, place) in [("grid = { p = [2, -3] }", "7:18"), ("cases = [{ p = 2 }, { p = -3 }]", "7:27")] {
        let report = problems(&GOOD.replace("grid = { p = [2, 3] }", space));
        assert!(report.contains(&format!("atlas.toml:{place}\n")), "{report}");
        assert!(report.contains("help: give `p` a value of more than 0 here"), "{report}");
    }
}

#[test]
fn a_misspelt_parameter_is_not_missing_as_well() {
    let text = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"f\"\nlinkage = \"four-bar\"\n\
                grid = { frame = 4, crank = 1, coupler = 3, roker = 3, along = 1, across = 1 }\n";
    let report = problems(text);
    assert!(report.contains("did you mean `rocker`?") && !report.contains("has no value"), "{report}");
    assert_eq!(report.matches("error: ").count(), 1, "{report}");
    // Others are.
    assert!(problems(&text.replace("crank = 1, ", "")).contains("`crank` has no value"));
}

#[test]
fn all_problems_are_reported_in_one_run() {
    let text = GOOD.replace("title", "titel").replace("\"2 deg\"", "\"0 deg\"").replace("(1 + p)", "(1 + q");
    let report = problems(&text);
    for message in ["[atlas] has no key `titel`", "`step` must not be 0", "never closed"] {
        assert!(report.contains(message), "{message}:\n{report}");
    }
    // A misspelt key is not missing as well.
    assert!(!report.contains("has no `title`"), "{report}");
    let two = format!("{GOOD}{}", GOOD.split_once("[[family]]").unwrap().1.replacen("", "[[family]]", 1));
    assert!(problems(&two).contains("there are two families `evans`"));
}

#[test]
fn one_mistake_does_not_hide_another() {
    // An unknown linkage, and errors in the grid, in `let` and in `where`.
    let text = GOOD.replace("linkage = \"evans\"", "linkage = \"evanz\"").replace("[2, 3]", "[\"1/0\"]");
    let report = problems(&(text.replace("(1 + p)", "sine(p)") + "where = \"p >\"\n"));
    for message in [
        "there is no linkage `evanz`",
        "its value is inf",
        "unknown function `sine`",
        "unexpected end of the expression",
    ] {
        assert!(report.contains(message), "{message}:\n{report}");
    }
    let cases = GOOD.replace("grid = { p = [2, 3] }", "cases = [1, 2, { p = \"x\" }]").replace("(1 + p)", "(1 +");
    assert_eq!(problems(&cases).matches("error: ").count(), 4);
    // The values of all parameters are checked, also next to an unknown key.
    let values = GOOD.replace("p = [2, 3]", "p = -1, r = -2").replacen("id =", "foo = 1\nid =", 1);
    let report = problems(&values);
    for message in ["no key `foo`", "`p` is -1", "`r` is -2"] {
        assert!(report.contains(message), "{message}:\n{report}");
    }
    // Nor does a value that cannot be read hide what is wrong with the others, with names and with expressions; and what follows from
    // it is no problem of its own.
    let unread =
        GOOD.replace("p = [2, 3]", "p = [\"2 mm\"], r = -2, foo = 3") + "where = \"mu_worst > 40\"\nsort = \"nix\"\n";
    let report = problems(&unread);
    for message in ["`mm` is not a unit here", "`r` is -2", "`foo` is not a parameter", "name `mu_worst`", "name `nix`"]
    {
        assert!(report.contains(message), "{message}:\n{report}");
    }
    assert_eq!(report.matches("error: ").count(), 5, "{report}");
    let unread = GOOD.replace("grid = { p = [2, 3] }", "cases = [{ p = \"x\", k = -1 }]");
    assert!(problems(&unread).contains("unknown name `x`"));
    let missing = problems(&GOOD.replace("p = [2, 3]", "r = -2"));
    assert!(missing.contains("`p` has no value") && missing.contains("`r` is -2"), "{missing}");
    let list = "[book]\n[[book.list]]\ntitle = \"L\"\nsort = \"nonsense\"\ncaption = \"{foo}\"\ncolumns = [\"x\", \"y\"]\n[[family]]";
    let report = problems(&GOOD.replacen("[[family]]", list, 1));
    for message in ["name `nonsense`", "name `foo`", "which has no captions"] {
        assert!(report.contains(message), "{message}:\n{report}");
    }
    assert_eq!(report.matches("this column has no head").count(), 2, "{report}");
    let helper = GOOD.replace("grid = { p = [2, 3] }", "cases = [{ p = 2, t = 2 }, { p = 3 }]").replace("(1 + p)", "t");
    assert!(problems(&helper).contains("in cell 2 (p = 3, r = 1, k = 2), `t` has no value"));
}

#[test]
fn parameters_cannot_have_the_names_of_columns() {
    for name in ["cell", "status", "class", "input_min_deg", "is_crank_rocker"] {
        let own = OWN.replace("p = { min = 0 }", &format!("p = {{ min = 0 }}, {name} = {{ default = 1 }}"));
        assert!(problems(&own).contains(&format!("`{name}` is the name of a column")), "{name}");
    }
}

#[test]
fn panels_must_fit_the_paper() {
    let with = |panels: &str| GOOD.replace("sampling", &format!("panels = {panels}\nsampling"));
    plan(&with("[10, 4]"));
    let report = problems(&with("[5, 40]"));
    assert!(report.contains("invalid value `40`") && report.contains("give a whole number from 1 to"), "{report}");
}

#[test]
fn an_empty_manifest_and_one_without_families_are_reported_with_a_remedy() {
    assert!(problems("").contains("the manifest is empty"));
    assert!(problems("  \n\n").contains("coupler-atlas init"));
    assert!(problems("[atlas]\ntitle = \"T\"\n").contains("the manifest has no family"));
}

#[test]
fn cycles_are_spelled_out() {
    let text = GOOD.replace("a = \"(1 + p)^1.5 / 2\"", "a = \"u + 1\", u = \"v\", v = \"a\"");
    let report = problems(&text);
    assert!(report.contains("the cycle is `a` -> `u` -> `v` -> `a`"), "{report}");
}

#[test]
fn a_wrong_value_is_reported_once_and_counted() {
    let text = GOOD.replace("p = [2, 3]", "p = { from = -2, to = 2, step = 1 }");
    let report = problems(&text);
    assert_eq!(report.matches("must be more than 0").count(), 1, "{report}");
    assert!(report.contains("2 more cells have the same error"), "{report}");
}

#[test]
fn grids_keep_the_written_order_and_vary_the_last_parameter_fastest() {
    let text = GOOD.replace("p = [2, 3]", "r = [1, 0.5], p = [3, 2]");
    let family = &plan(&text).families[0].family;
    let cells: Vec<(f64, f64)> =
        (0..4).map(|k| family.cell(k)).map(|cell| (family.value("r", &cell), family.value("p", &cell))).collect();
    assert_eq!(cells, [(1.0, 3.0), (1.0, 2.0), (0.5, 3.0), (0.5, 2.0)]);
    // s follows a, which `let` derives.
    let cell = family.cell(0);
    assert_eq!((family.value("s", &cell), family.value("a", &cell)), (4.0, 4.0));
}

#[test]
fn let_and_where_may_use_names_that_are_not_parameters() {
    let text = GOOD.replace("p = [2, 3]", "q = [1, 2]").replace("a = \"(1 + p)^1.5 / 2\"", "p = \"q + 1\", a = 3");
    assert_eq!(plan(&text).families[0].family.cell_count(), 2);
    let in_where = GOOD.replace("p = [2, 3]", "p = [2, 3], q = [1, 2]") + "where = \"q > 1\"\n";
    assert_eq!(plan(&in_where).families[0].family.cell_count(), 4);
}

#[test]
fn where_is_a_condition_over_names_and_measures() {
    for good in ["p > 2 and is_crank_rocker", "input_min_deg < 3 or not is_change_point"] {
        plan(&format!("{GOOD}where = \"{good}\"\n"));
    }
    for (bad, message) in [
        ("p", "expected a condition, found a numeric expression"),
        ("is_crankrocker", "unknown name `is_crankrocker`"),
        ("1 < p < 3", "expected a number, found a condition"),
    ] {
        assert!(problems(&format!("{GOOD}where = \"{bad}\"\n")).contains(message), "{bad}");
    }
}

#[test]
fn every_measure_can_be_used_in_where_sort_and_texts() {
    for measure in coupler_curves::measure::ALL {
        let name = measure.name;
        if ["six_bar", "output_stroke"].contains(&name) {
            // The linkage has none.
            let report = problems(&format!("{GOOD}where = \"{name} > 0\"\n"));
            assert!(report.contains(&format!("`evans` has no `{name}`")), "{report}");
            continue;
        }
        let needed = match measure.subject {
            Subject::WithLoad => "load = { joint = \"M\", force = 1 }\n",
            Subject::WithTolerance => "tolerance = 0.1\n",
            _ => "",
        };
        let uses = format!("{needed}where = \"{name} > 0\"\nsort = \"-{name}\"\nnote = \"{{{name}:.3}}\"\n");
        if coupler_curves::measure::BOOLEANS.iter().any(|boolean| boolean.name == name) {
            plan(&format!("{GOOD}where = \"{name} or not {name}\"\ncaption = \"{{{name}}}\"\n"));
            let report = problems(&format!("{GOOD}where = \"{name} > 0\"\nsort = \"{name}\"\n"));
            assert_eq!(report.matches("expected a number, found a condition").count(), 2, "{report}");
        } else if measure.is_word {
            let report = problems(&format!("{GOOD}where = \"{name} > 0\"\nsort = \"{name}\"\n"));
            assert_eq!(report.matches(&format!("`{name}` is a word")).count(), 2, "{report}");
            plan(&format!("{GOOD}{needed}caption = \"{{{name}}}\"\n"));
        } else {
            plan(&format!("{GOOD}{uses}"));
        }
    }
    for good in ["{ tolerance = 0.01 }", "{ input = \"2 * 60 deg\" }", "{ length = \"1 + 1\" }"] {
        plan(&format!("{GOOD}straight = {good}\n"));
    }
    for good in ["{ share = 0.02 }", "{ angle = \"1 / 2 deg\" }"] {
        plan(&format!("{GOOD}dwell = {good}\n"));
    }
    for (bad, message) in [
        ("straight = 0.01", "expected a table, found a number"),
        ("straight = {}", "`straight` takes exactly one of `tolerance`, `input` and `length`"),
        (
            "straight = { tolerance = 0.1, length = 2 }",
            "`straight` takes exactly one of `tolerance`, `input` and `length`",
        ),
        ("straight = { tolerance = 0 }", "`tolerance` is 0, which is out of range"),
        ("straight = { tolerance = 2 }", "`tolerance` is 2, which is out of range"),
        ("straight = { length = -1 }", "`length` is -1, which is out of range"),
        ("straight = { input = 120 }", "the unit is missing"),
        ("straight = { input = \"-5 deg\" }", "`input` is -5, which is out of range"),
        ("straight = { width = 1 }", "`straight` has no key `width`"),
        ("dwell = {}", "`dwell` takes exactly one of `share`, `angle` and `length`"),
        ("dwell = { share = 2 }", "`share` is 2, which is out of range"),
        ("dwell = { angle = \"0 deg\" }", "`angle` is 0, which is out of range"),
        ("dwell = { length = 0.2 }", "the output of `evans` is a link that turns, and has no length"),
        ("paper = \"a4\"", "`paper` is a key of [page]"),
        ("crank = 2", "a parameter of the linkage is given in `grid`, `cases` or `let`"),
        ("where = \"length > 20 mm\"", "leave it out here, and write unit = \"mm\" in [atlas]"),
        ("place = { rotate = 20 mm }", "leave it out here, and write unit = \"mm\" in [atlas]"),
        ("where = \"stride > 2\"", "did you mean `straight_length`?"),
        ("sort = \"p > 2\"", "expected a number, found a condition"),
        ("sort = \"class\"", "`class` is a word"),
        ("note = \"{class + 1}\"", "unknown name `class`"),
        ("sort = 3", ""),
        ("caption = \"{q}\"", "unknown name `q`"),
        ("note = \"{mu_min_deg:.1\"", "this brace is never closed"),
    ] {
        let text = format!("{GOOD}{bad}\n");
        if message.is_empty() {
            plan(&text);
        } else {
            let report = problems(&text);
            assert!(report.contains(message), "{bad}: {report}");
        }
    }
}

/// A valid manifest that defines a linkage, which tests modify.
const OWN: &str = r#"[atlas]
title = "T"
[[linkage]]
id = "mine"
parameters = { p = { min = 0 } }
trace = ["M"]
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["p", 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = [3, 3.5], side = "left" }
M = { point = ["A", "B"], along = 1, across = 2 }
[[family]]
id = "mine"
linkage = "mine"
sampling = { samples = 60 }
grid = { p = [4] }
"#;

#[test]
fn each_mistake_in_a_linkage_has_its_message() {
    plan(OWN);
    let cases = [
        ("id = \"mine\"\nparam", "id = \"evans\"\nparam", "the catalogue has a linkage `evans` already"),
        ("A = { crank = \"O\", length = 1 }", "A = { fixed = [1, 1] }", "the linkage has no input"),
        ("M = {", "A2 = { crank = \"C\", length = 1 }\nM = {", "`A2` is a second input in addition to `A`"),
        ("trace = [\"M\"]", "trace = [\"N\"]", "unknown joint `N`"),
        ("trace = [\"M\"]", "trace = []", "no joint is traced"),
        ("trace = [\"M\"]", "", "a [[linkage]] has no `trace`"),
        ("trace = [\"M\"]", "trace = [\"B\"]", "the joint `M` is not used"),
        ("dyad = [\"A\", \"C\"]", "dyad = [\"A\", \"A\"]", "`A` is named twice"),
        ("dyad = [\"A\", \"C\"]", "dyad = [\"A\", \"M\"]", "the joint `B` is placed from itself"),
        ("dyad = [\"A\", \"C\"]", "dyad = [\"A\"]", "expected two values, found 1"),
        ("side = \"left\"", "side = \"up\"", "`up` is not one of the words allowed here"),
        (
            "point = [\"A\", \"B\"]",
            "point = [\"A\", \"C\"]",
            "`M` needs a link with both `A` and `C`, but no link has both",
        ),
        ("length = 1", "length = -1", "a length must be positive, found -1"),
        ("lengths = [3, 3.5]", "lengths = [3, 0]", "a length must be positive, found 0"),
        ("trace = [\"M\"]", "trace = [\"M\", \"C\"]", "the traced joint `C` does not move"),
        (
            "dyad = [\"A\", \"C\"]",
            "dyad = [\"A\", \"M\"]",
            "no chain of dyads solves this linkage, and `B`, `M` remain unsolved",
        ),
        ("dyad = [\"A\", \"C\"]", "dyad = [\"A\", \"B\"]", "`B` needs its own position"),
        (
            "M = {",
            "Y = { yoke = \"A\", line = [\"O\", \"C\"], angle = \"180 deg\" }\nM = {",
            "the slot of `Y` is parallel to its guide",
        ),
        (
            "C = {",
            "C = { gear = \"A\", about = \"G\", length = 1, ratio = [\"p / 3\", 1] }\nG = {",
            "`C` has the gear ratio 1.3333333333333333 to 1, but both must be whole numbers",
        ),
        (
            "M = {",
            "G = { gear = \"A\", about = \"C\", length = 1, ratio = [1, 0.5] }\nM = {",
            "a gear ratio cannot contain 0.5",
        ),
        ("M = {", "D = { parallelogram = [\"O\", \"A\"] }\nM = {", "a parallelogram is placed from 3 joints, not 2"),
        ("M = {", "D = { parallelogram = [\"O\", \"A\", \"O\"] }\nM = {", "`O` is named twice"),
        (
            "M = {",
            "D = { parallelogram = [\"A\", \"O\", \"B\"] }\nM = {",
            "`D` needs a link with both `O` and `B`, but no link has both",
        ),
        ("trace =", "coincident = \"last one\"\ntrace =", "`last one` is not one of the words allowed here"),
        ("length = 1", "length = \"p - 4\"", "the length of `A` must be positive, found 0"),
        ("length = 1", "length = \"q\"", "unknown name `q`"),
        ("length = 1", "lenght = 1", "a joint with `crank` has no key `lenght`"),
        ("{ fixed = [0, 0] }", "{ at = [0, 0] }", "the joint `O` does not say how it is placed"),
        ("along = 1", "along = \"1 / (p - 4)\"", "`along` of `M` is inf"),
        ("trace =", "caption = \"p = {p:.2\"\ntrace =", "this brace is never closed"),
        ("trace =", "input = { from = \"10 deg\", to = \"5 deg\" }\ntrace =", "and must be more than `from`"),
        ("{ min = 0 }", "{ default = \"p + 1\" }", "is derived from itself"),
        ("min = 0", "mni = 0", "a parameter has no key `mni`"),
        ("min = 0", "min = 2, max = 1", "the least value 2 is above the greatest 1"),
        ("trace =", "seen_from = [\"A\", \"C\"]\ntrace =", "`seen_from` needs a link with both `A` and `C`"),
        ("trace =", "output_link = [\"C\", \"E\"]\ntrace =", "unknown joint `E`"),
        ("trace =", "output_link = [\"A\", \"C\"]\ntrace =", "`output_link` needs a link with both `A` and `C`"),
        ("trace =", "output_link = [\"O\", \"C\"]\ntrace =", "`output_link` names `O` and `C`, which are at rest"),
        ("trace =", "output_link = \"B\"\ntrace =", "`output_link` names `B`, which is not a slider"),
        ("trace =", "output_link = 3\ntrace =", "expected a list"),
        ("trace =", "chains = [[\"A\", \"E\"]]\ntrace =", "unknown joint `E`"),
        ("trace =", "chains = [\"A\"]\ntrace =", "expected a list"),
        ("trace =", "chains = [[\"A\"]]\ntrace =", "a chain has two or more joints, each once"),
        ("trace =", "chains = [[\"A\", \"A\"]]\ntrace =", "a chain has two or more joints, each once"),
        ("[[family]]", "[[family]]\nghosts = 1", "expected a boolean"),
        (
            "[[family]]",
            "[[family]]\nghosts = true\nlayout = \"coupler-grid\"",
            "a page of a coupler grid has no `ghosts`",
        ),
        ("[[family]]", "[[family]]\nlayout = \"poses\"", "the layout is `poses`, but there are no `poses`"),
        ("[[family]]", "[[family]]\npanels = [1, 1]\nlayout = \"poses\"", "a page of poses has one cell and no panels"),
        ("[[family]]", "[[family]]\nposes = []", "`poses` has 0 poses: give 1 to 1000"),
        ("[[family]]", "[[family]]\nposes = [[1, 2]]", "expected x, y and an angle, found 2 values"),
        ("[[family]]", "[[family]]\nposes = [[1, 2, \"1 / 0\"]]", "its value is inf, which is not a finite number"),
        ("[[family]]", "[[family]]\nposes = [[1, 2, 1e7]]", "10000000 deg is out of range"),
        ("[[family]]", "[[family]]\nposes = [[-1e61, 2, 3]]", "units of length is out of range"),
        ("[[family]]", "[[family]]\nposes = [1, 2, 3]", "expected a list, found a number"),
        ("[[family]]", "[[family]]\nposes = \"poses.csv\"", "expected a list, found a string"),
        (
            "[[family]]",
            "[[family]]\nposes = [[1, 2, 3]]\nlayout = \"coupler-grid\"",
            "a page of a coupler grid has no `poses`",
        ),
    ];
    for (from, to, message) in cases {
        let mut text = OWN.replacen(from, to, 1);
        if message.contains("derived from itself") {
            text = text.replace("grid = { p = [4] }", "grid = { q = [4] }\nwhere = \"q > 0\"");
        }
        assert_ne!(text, OWN, "{from}");
        let report = problems(&text);
        assert!(report.contains(message), "{message}:\n{report}");
    }
}

#[test]
fn a_grid_of_points_traces_each_and_varies_across_fastest() {
    let text = OWN.replace(
        "along = 1, across = 2",
        "along = { from = 0, to = 2, count = 3 }, across = { from = 0, to = 1, count = 2 }",
    );
    let family = &plan(&text).families[0].family;
    let linkage = family.linkage(&family.cell(0)).unwrap();
    let places: Vec<(f64, f64)> = linkage
        .traced
        .iter()
        .map(|&joint| linkage.links.iter().find_map(|link| link.position(joint)).unwrap())
        .map(|place| (place.x, place.y))
        .collect();
    assert_eq!(places, [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0), (2.0, 0.0), (2.0, 1.0)]);
}

/// Two points on the same joints are distinct if their coordinates are, and other points may be placed from them.
#[test]
fn points_may_be_placed_from_points_of_the_same_link() {
    for third in [
        "point = [\"M\", \"N\"], along = 1, across = 1",
        "point = [\"M\", \"N\"], distances = [1, \"p\"], side = \"left\"",
    ] {
        let more = format!("N = {{ point = [\"A\", \"B\"], along = \"p\" }}\nX = {{ {third} }}\n[[family]]");
        let text = OWN.replace("[[family]]", &more).replace("trace = [\"M\"]", "trace = [\"X\"]");
        let family = &plan(&text).families[0].family;
        assert_eq!(family.linkage(&family.cell(0)).unwrap().dyad_count(), 1);
    }
    let same = OWN.replace(
        "[[family]]",
        "N = { point = [\"A\", \"B\"], along = 1, across = 2 }\nX = { point = [\"M\", \"N\"], along = 1 }\n[[family]]",
    );
    assert!(
        problems(&same.replace("trace = [\"M\"]", "trace = [\"X\"]")).contains("from `M` to `N`, but these coincide")
    );
}

#[test]
fn an_actuators_input_is_a_length() {
    let text = OWN
        .replace("A = { crank = \"O\", length = 1 }", "A = { piston = [\"C\", \"O\"], length = 1, side = \"left\" }")
        .replace("B = { dyad = [\"A\", \"C\"], lengths = [3, 3.5], side = \"left\" }\n", "")
        .replace("point = [\"A\", \"B\"]", "point = [\"O\", \"A\"]");
    plan(&text.replace("{ samples = 60 }", "{ step = 0.1 }"));
    let report = problems(&text.replace("{ samples = 60 }", "{ step = \"10 deg\" }"));
    assert!(report.contains("expected a length, found an angle"), "{report}");
    let report = problems(&text.replace("trace =", "input = { from = \"2 deg\", to = 4 }\ntrace ="));
    assert!(report.contains("expected a length, found an angle"), "{report}");
}

#[test]
fn a_family_may_be_mirrored_and_rotated() {
    use coupler_curves::geometry::{Orientation, Point};
    let orientation = |place: &str| {
        let text = OWN.replacen("sampling =", &format!("place = {place}\nsampling ="), 1);
        plan(&text).families[0].family.template.orientation
    };
    let p = Point::new(2.0, 1.0);
    assert_eq!(orientation("{ mirror = true, rotate = \"90 deg\" }").transform_point(p), Point::new(1.0, 2.0));
    assert_eq!(orientation("{ rotate = \"-0.5 * 180 deg\" }").transform_point(p), Point::new(1.0, -2.0));
    assert_eq!(orientation("{}"), Orientation::default());
    for (place, message) in [
        ("{ mirror = 1 }", "expected a boolean, found a number"),
        ("{ rotate = 90 }", "the unit is missing"),
        ("{ turn = \"90 deg\" }", "`place` has no key `turn`"),
    ] {
        let report = problems(&OWN.replacen("sampling =", &format!("place = {place}\nsampling ="), 1));
        assert!(report.contains(message), "{report}");
    }
}

#[test]
fn joints_may_be_written_in_any_order() {
    let lines: Vec<&str> = OWN.lines().collect();
    let joint = |name: &str| lines.iter().position(|line| line.starts_with(name)).unwrap();
    let mut shuffled = lines.clone();
    shuffled.swap(joint("O ="), joint("M ="));
    shuffled.swap(joint("A ="), joint("B ="));
    let names =
        |text: &str| plan(text).families[0].family.template.joints.iter().map(|j| j.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(OWN), ["O", "C", "A", "B", "M"]);
    assert_eq!(names(&shuffled.join("\n")), ["C", "O", "A", "B", "M"]);
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_are_accepted() {
    plan(&GOOD.replace('\n', "\r\n"));
    plan(&format!("\u{feff}{GOOD}"));
}

/// Names of functions and units are allowed as well.
#[test]
fn renaming_a_parameter_keeps_the_linkages() {
    let linkages = |text: &str| {
        let family = plan(text).families.remove(0).family;
        (0..family.cell_count()).map(|k| format!("{:?}", family.linkage(&family.cell(k)))).collect::<Vec<_>>()
    };
    let text = OWN.replace("along = 1", "along = \"p / 2\"").replace("p = [4]", "p = [3, 4, 5]");
    for name in ["q", "_", "the_frame", "P2", "sqrt", "deg"] {
        let renamed = text
            .replace("{ p = { min", &format!("{{ {name} = {{ min"))
            .replace("\"p\"", &format!("\"{name}\""))
            .replace("\"p / 2\"", &format!("\"{name} / 2\""))
            .replace("{ p = [", &format!("{{ {name} = ["));
        assert_eq!(linkages(&renamed), linkages(&text), "{name}");
    }
}

mod properties {
    use super::*;
    use proptest::prelude::*;

    /// The keys of a family, one per line.
    const KEYS: [&str; 10] = [
        "id = \"mine\"",
        "linkage = \"mine\"",
        "title = \"Mine\"",
        "layout = \"panels\"",
        "panels = [2, 2]",
        "sampling = { samples = 12 }",
        "grid = { p = [3, 4], h = [1, 2] }",
        "let = { g = \"p + h\" }",
        "where = \"g > 0\"",
        "columns = [\"vx\"]",
    ];

    /// The joints of a linkage, one per line.
    const JOINTS: [&str; 5] = [
        "O = { fixed = [0, 0] }",
        "C = { fixed = [\"p\", 0] }",
        "A = { crank = \"O\", length = 1 }",
        "B = { dyad = [\"A\", \"C\"], lengths = [3, 3.5], side = \"left\" }",
        "M = { point = [\"A\", \"B\"], along = 1, across = 2 }",
    ];

    proptest! {
        #![proptest_config(crate::proptest_config())]

        /// No text makes the parser panic, and its problems can be printed.
        #[test]
        fn no_text_panics(text in "\\PC{0,200}") {
            let loaded = manifest::parse(&text);
            report(&loaded.problems, "m", &text, true);
        }

        /// A valid manifest with a part removed or duplicated.
        #[test]
        fn no_damaged_manifest_panics(a in 0..OWN.len(), b in 0..OWN.len(), is_duplicated: bool) {
            let (a, b) = (a.min(b), a.max(b));
            let (before, after) = if is_duplicated { (&OWN[..b], &OWN[a..]) } else { (&OWN[..a], &OWN[b..]) };
            let text = format!("{before}{after}");
            let loaded = manifest::parse(&text);
            report(&loaded.problems, "m", &text, false);
        }

        /// The order of keys matters only in a grid.
        #[test]
        #[ignore = "thorough"]
        fn the_order_of_keys_changes_no_plan(
            keys in Just(KEYS.to_vec()).prop_shuffle(),
            joints in Just(JOINTS.to_vec()).prop_shuffle(),
            tables in Just(vec![0, 1, 2, 3]).prop_shuffle(),
        ) {
            let text = |keys: &[&str], joints: &[&str], tables: &[usize]| {
                let parts = [
                    "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]".to_owned(),
                    "[page]\ndpi = 50\npaper = \"a4\"".to_owned(),
                    format!("[[family]]\n{}", keys.join("\n")),
                    format!(
                        "[[linkage]]\nid = \"mine\"\nparameters = {{ p = {{}} }}\ntrace = [\"M\"]\n[linkage.joints]\n{}",
                        joints.join("\n")
                    ),
                ];
                tables.iter().map(|&k| format!("{}\n", parts[k])).collect::<String>()
            };
            let contents = |text: &str| {
                let plan = plan(text);
                let planned = &plan.families[0];
                let family = &planned.family;
                let cells: Vec<_> = (0..family.cell_count()).map(|k| family.cell(k)).collect();
                let values = |cell| ["p", "h", "g"].map(|name| family.value(name, cell).to_bits());
                // Joints are numbered in the order they are written in, so the curves of the traced one are compared.
                let solver = coupler_curves::solve::Solver::new(family);
                let curves = |k| {
                    let solved = solver.solve(k).unwrap();
                    let joint = solved.linkage.traced[0];
                    let curve = |circuit: &coupler_curves::motion::Circuit| {
                        circuit.points(joint).map(|p| [p.x.to_bits(), p.y.to_bits()]).collect()
                    };
                    solved.motion.circuits.iter().map(curve).collect::<Vec<Vec<_>>>()
                };
                let atlas = format!(
                    "{} {:?} {} {:?} {:?} {:?}",
                    plan.title, plan.output, plan.dpi, plan.page, planned.layout, planned.formats
                );
                let settings = format!("{} {} {:?} {:?}", family.id, family.title, family.sampling, family.columns);
                let cells: Vec<_> = cells.iter().map(values).collect();
                (atlas, settings, cells.clone(), (0..cells.len()).map(curves).collect::<Vec<_>>())
            };
            prop_assert_eq!(contents(&text(&keys, &joints, &tables)), contents(&text(&KEYS, &JOINTS, &[0, 1, 2, 3])));
        }

        /// The span of every problem is in the text of the manifest, and every problem has a help text.
        #[test]
        fn every_problem_is_in_the_text(
            at in 0..OWN.len(),
            to in 0..OWN.len(),
            any: String,
            special in "[é\u{0}\u{1b}\u{85}🦀\"'\\\\\r\n={}\\[\\]#]{0,6}",
        ) {
            let (at, to) = (at.min(to), at.max(to).min(at.min(to) + 20));
            let (before, after) = (&OWN[..at], &OWN[to..]);
            for text in [any.clone(), format!("{before}{any}{after}"), format!("{before}{special}{after}")] {
                for problem in manifest::parse(&text).problems {
                    prop_assert!(text.get(problem.span.clone()).is_some(), "{problem:?} in {text:?}");
                    prop_assert!(!problem.help.is_empty(), "{problem:?}");
                }
            }
        }

        #[test]
        fn no_expression_panics(inner in "[-+*/^()a-z0-9., <>=!]{0,40}") {
            let text = GOOD.replace("(1 + p)^1.5 / 2", &inner);
            let loaded = manifest::parse(&text);
            report(&loaded.problems, "m", &text, false);
        }
    }
}

/// A family may trace other joints than its linkage, and an exported curve is traced again by what it is exported as.
#[test]
fn a_family_chooses_the_joints_that_are_traced() {
    let manifest = "atlas.title = \"T\"\n[[family]]\nid = \"sliders\"\nlinkage = \"slider-crank\"\ntrace = [\"M\"]\n\
                    sampling = { samples = 36 }\ngrid = { coupler = [2, 3], across = 1 }\n";
    let folder = folder_with(manifest);
    printed(folder.path(), &["render", "-o", "out", "--format", "svg", "--quiet"]);
    let cells = fs::read_to_string(folder.path().join("out/sliders/cells.csv")).unwrap();
    let rows = rows(&cells);
    assert!(rows.len() >= 2 && rows.iter().all(|row| row["trace"] == "1"), "{cells}");
    let exported = printed(folder.path(), &["export", "sliders:2.1.1", "--format", "toml"]);
    assert!(exported.contains("trace = [\"M\"]"), "{exported}");
    fs::write(folder.path().join("again.toml"), format!("atlas.title = \"T\"\n{exported}")).unwrap();
    printed(folder.path(), &["validate", "again.toml"]);
    // The linkage's own traced joints are not written.
    fs::write(folder.path().join("atlas.toml"), manifest.replace("trace = [\"M\"]\n", "")).unwrap();
    let own = printed(folder.path(), &["export", "sliders:2.1.1", "--format", "toml"]);
    assert!(!own.contains("trace"), "{own}");
}

/// Without `panels`, the cells are as large as the page allows, and some fifteen at most are on one.
#[test]
fn the_grid_of_a_page_follows_the_number_of_cells() {
    let grid = |count: usize, page: &str| {
        let text = format!(
            "[atlas]\ntitle = \"T\"\n{page}[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
             grid = {{ a = {{ from = 2, to = 3, count = {count} }}, p = 2 }}\n"
        );
        plan(&text).families[0].layout.grid()
    };
    let tabloid = [1, 2, 3, 4, 6, 8, 9, 15, 16, 400].map(|count| grid(count.max(2), ""));
    assert_eq!(tabloid, [[2, 1], [2, 1], [2, 2], [2, 2], [3, 2], [4, 2], [3, 3], [5, 3], [5, 3], [5, 3]]);
    let [columns, rows] = grid(6, "[page]\npaper = { width = \"210 mm\", height = \"297 mm\" }\n");
    assert!(rows >= columns && columns * rows >= 6, "{columns} x {rows}");
}

/// The pages of an atlas of one family have its title, if the family has none of its own.
#[test]
fn the_only_family_has_the_title_of_the_atlas() {
    let titles =
        |text: &str| plan(text).families.iter().map(|planned| planned.family.title.clone()).collect::<Vec<_>>();
    assert_eq!(titles(GOOD), ["T"]);
    let own = GOOD.replace("id = \"evans\"", "id = \"evans\"\ntitle = \"Own\"");
    assert_eq!(titles(&own), ["Own"]);
    let second = GOOD[GOOD.find("[[family]]").unwrap()..].replace("id = \"evans\"", "id = \"other\"");
    assert_eq!(titles(&format!("{GOOD}{second}")), ["evans", "other"]);
    // What the program writes of the family alone, for the gallery and for tables, has the title, too.
    assert_eq!(titles(&plan(GOOD).families[0].excerpt()), ["T"]);
    let [first, other] = &plan(&format!("{GOOD}{second}")).families[..] else { panic!("two families") };
    for planned in [first, other] {
        assert_eq!(titles(&planned.excerpt())[0], planned.family.id);
    }
    // A second family changes the pages of the first.
    let page_text = |text: &str| plan(text).families[0].manifest_inputs.page_text();
    assert_ne!(page_text(GOOD), page_text(&format!("{GOOD}{second}")));
}
