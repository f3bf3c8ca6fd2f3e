//! What the program answers is so: a measure that a linkage cannot have is an error, cells that cannot be assembled are
//! not left out by `where`, each problem is reported once and in the first run, angles may state their unit.

use std::fs;
use std::path::Path;

use coupler_atlas::manifest;
use coupler_curves::catalogue;
use coupler_curves::family::Family;
use coupler_curves::measure::{ALL, COLUMNS, Subject};
use coupler_curves::problem::Problem;
use coupler_curves::template::ParameterKind;

use crate::support::command::{folder_with, printed, run};
use crate::support::folder::Atlas;
use crate::support::plan::plan;

/// A manifest with one family of a linkage.
fn family(linkage: &str, lines: &str) -> String {
    format!("[atlas]\ntitle = \"T\"\noutput = \"out\"\n[[family]]\nid = \"f\"\nlinkage = \"{linkage}\"\n{lines}\n")
}

fn errors(text: &str) -> Vec<Problem> {
    manifest::parse(text).problems.into_iter().filter(Problem::is_error).collect()
}

fn messages(text: &str) -> Vec<String> {
    errors(text).into_iter().map(|problem| problem.message).collect()
}

#[test]
fn a_measure_or_column_that_a_linkage_cannot_have_is_an_error() {
    let grid = "grid = { crank = [1, 1.5] }\n";
    for line in [
        "where = \"mu_min_deg > 40\"",
        "where = \"length > 1 and is_crank_rocker\"",
        "sort = \"-output_swing_deg\"",
        "measures = [\"length\", \"class\"]",
        "columns = [\"vx\", \"psi_deg\"]",
        "caption = \"{crank} {mu_max_deg:.1}\"",
        "note = \"{six_bar}\"",
        "layout = \"chart\"\nchart = { x = \"crank\", y = \"mu_min_deg\" }",
        "layout = \"chart\"\nchart = { x = \"input_deg\", y = \"psi_deg\" }",
    ] {
        let found = errors(&family("slider-crank", &format!("{grid}{line}")));
        assert_eq!(found.len(), 1, "{line}: {found:?}");
        assert!(found[0].message.starts_with("`slider-crank` has no `"), "{line}: {found:?}");
        let has = if line.contains("psi_deg") { "vx, vy" } else { "mu_worst_deg" };
        assert!(found[0].help.contains(has), "{line}: {found:?}");
    }
    // A name of the family itself is not the measure.
    let own = "grid = { crank = [1] }\nlet = { across = \"coupler\" }\nwhere = \"across > 1\"";
    assert_eq!(messages(&family("slider-crank", own)), [""; 0]);
}

/// The joints of a linkage are known without its dimensions, and every restriction divides the catalogue.
#[test]
fn whether_a_linkage_has_a_measure_follows_from_its_joints() {
    let structures: Vec<_> = catalogue::all().iter().map(|template| template.structure().unwrap()).collect();
    let subjects = ALL.iter().map(|measure| measure.subject).chain(COLUMNS.iter().map(|column| column.subject));
    for subject in subjects {
        let count = structures.iter().filter(|linkage| subject.includes(linkage)).count();
        let is_general = matches!(subject, Subject::Any | Subject::WithOutput | Subject::WithDyad);
        // Linkages of the catalogue have no loads and no tolerances.
        if matches!(subject, Subject::WithLoad | Subject::WithTolerance) {
            continue;
        }
        assert!(count > 0 && (is_general || count < structures.len()), "{subject:?}: {count}");
    }
}

/// Of an actuator inputs are lengths, and their columns are named so.
#[test]
fn inputs_of_an_actuator_are_lengths() {
    let atlas = Atlas::new(&family("linear-actuator", "grid = { g = [2, 3] }\nwhere = \"input_min_length > 0\""));
    let (code, _, err) = atlas.run(&[]);
    assert_eq!(code, 0, "{err}");
    let table = fs::read_to_string(atlas.out().join("f/cells.csv")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    for measure in ALL.iter().filter(|measure| measure.length_name.is_some()) {
        assert!(!header.contains(&measure.name), "{}", measure.name);
        assert!(header.contains(&measure.name_for(true)), "{}", measure.name);
    }
    assert_eq!(header[header.len() - 2..], ["family", "joint"]);
    for row in table.lines().skip(1) {
        assert!(row.ends_with(",f,M"), "{row}");
    }
    for name in ["input_min", "output_dwell", "straight_5_start"] {
        let lines = format!("grid = {{ g = [2, 3] }}\nwhere = \"{name}_deg > 0\"\nmeasures = [\"{name}_deg\"]");
        let found = errors(&family("linear-actuator", &lines));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found.iter().all(|problem| problem.help == format!("did you mean `{name}_length`?")), "{found:?}");
    }
}

/// Where a number is zero but for rounding it is printed as zero.
#[test]
fn rounding_is_not_printed() {
    for linkage in ["slider-crank", "inverted-slider-crank", "peaucellier-lipkin", "linear-actuator"] {
        let atlas = Atlas::new(&family(linkage, "cases = [{}]"));
        assert_eq!(atlas.run(&[]).0, 0);
        let table = fs::read_to_string(atlas.out().join("f/cells.csv")).unwrap();
        for field in table.lines().skip(1).flat_map(|line| line.split(',')) {
            let number: f64 = field.parse().unwrap_or(1.0);
            assert!(number == 0.0 || number.abs() > 1e-12, "{linkage}: {field}");
        }
    }
}

/// Cells that cannot be assembled are counted apart from those that `where` leaves out; for a family without curves
/// the message states how near its cells come.
#[test]
fn cells_that_cannot_be_assembled_are_not_left_out_by_where() {
    let lines = "grid = { p = [2, 20, 13], r = [1], a = [2, 3] }\nlet = { s = \"a\" }\nwhere = \"mu_min_deg > 40\"";
    let atlas = Atlas::new(&family("evans", lines));
    let (_, out, err) = atlas.run(&[]);
    assert!(out.starts_with("f: 6 cells (4 not assembled, 2 left out by `where`), 0 curves, 0 pages\n"), "{out}");
    assert!(err.contains("`where` keeps none of the 6 cells"), "{err}");
    assert!(
        err.contains(
            "4 cells cannot be assembled; the nearest is cell 6 (p = 13, r = 1, a = 3, s = 3, k = 2): B cannot be \
             placed: A and C are 12 or more apart, links of 3 and 3 reach 6"
        ),
        "{err}"
    );
    assert!(err.contains("on the 2 curves `mu_min_deg` is 19.1881 to 28.955"), "{err}");
    // Of several conditions it is said which of them fails how often.
    atlas.edit(&family("evans", &lines.replace("mu_min_deg > 40", "mu_min_deg > 40 and p < 15 and length > 0")));
    let (_, _, err) = atlas.run(&[]);
    assert!(err.contains("`mu_min_deg > 40` fails for 2 of 2 curves; `p < 15` fails for 2 of 6 cells\n"), "{err}");
    // A condition on parameters alone leaves out a cell whether it can be assembled or not.
    atlas.edit(&family("evans", &lines.replace("mu_min_deg > 40", "p < 1")));
    let (_, out, err) = atlas.run(&[]);
    assert!(out.starts_with("f: 6 cells (6 left out by `where`), 0 curves, 0 pages\n"), "{out}");
    assert!(err.contains("= help: relax the condition: in 6 cells `p` is 2 to 20\n"), "{err}");
    let none = lines.replace("[2, 20, 13]", "[20, 13]");
    atlas.edit(&family("evans", &none));
    let (_, out, err) = atlas.run(&[]);
    assert!(out.starts_with("f: 4 cells (4 not assembled), 0 curves, 0 pages\n"), "{out}");
    assert!(err.contains("none of the 4 cells can be assembled"), "{err}");
}

/// Cells that are assembled over a part of the range have curves, and are counted by themselves; `validate` warns of a
/// family without curves as `render` does.
#[test]
fn cells_assembled_in_part_and_not_at_all_are_told_apart() {
    let own = "[[linkage]]\nid = \"own\"\nparameters = { g = {} }\ntrace = [\"B\"]\n\
               input = { from = \"0 deg\", to = \"180 deg\" }\n[linkage.joints]\nO = { fixed = [0, 0] }\n\
               C = { fixed = [\"g\", 0] }\nA = { crank = \"O\", length = 2 }\n\
               B = { dyad = [\"A\", \"C\"], lengths = [3, 2], side = \"left\" }\n";
    let with = |grid: &str| format!("{}{own}", family("own", grid));
    let atlas = Atlas::new(&with("grid = { g = [3.5, 4, 40] }"));
    let (_, out, _) = atlas.run(&[]);
    assert!(
        out.starts_with("f: 3 cells (1 not assembled, 2 assembled over a part of the range), 2 curves, 1 page\n"),
        "{out}"
    );
    atlas.edit(&with("grid = { g = [30, 40] }"));
    let (code, _, err) = run(atlas.0.path(), &["validate", "atlas.toml"]);
    assert!(code == 0 && err.contains("none of the 2 cells can be assembled"), "{err}");
    // A linkage may have no family to start from that can be assembled without a change.
    atlas.edit(&with("grid = { g = [28] }").replace("lengths = [3, 2]", "lengths = [30, 2]"));
    let out = printed(atlas.0.path(), &["list", "linkages", "own", "--manifest", "atlas.toml"]);
    assert!(out.contains("# Change the numbers, with which it cannot be assembled: "), "{out}");
}

#[test]
fn a_linkage_without_an_equation_has_no_sextic() {
    let (code, _, err) = run(Path::new("."), &["inspect", "slider-crank", "--sextic"]);
    assert_eq!(code, 2);
    assert!(err.contains("slider-crank has no coupler curve of a four-bar"), "{err}");
}

#[test]
fn every_problem_is_reported_in_the_first_run() {
    let text = family(
        "evans",
        "grid = { p = [2, 3], q = [1] }\nlet = { a = \"(1 + p)^1.5 / 2\", h = 3 }\nwhere = \"mu_min > 3\"\n\
         sort = \"lenth\"\ncolumns = [\"vxx\"]\ncaption = \"{pp}\"\nfoo = 3",
    );
    let found = messages(&text);
    for message in [
        "`q` is not a parameter of `evans`, and no expression uses it",
        "`h` is not a parameter of `evans`, and no expression uses it",
        "unknown name `mu_min`",
        "unknown name `lenth`",
        "there is no column `vxx`",
        "unknown name `pp`",
        "a [[family]] has no key `foo`",
    ] {
        assert!(found.iter().any(|found| found == message), "{message}: {found:?}");
    }
    assert_eq!(found.len(), 7, "{found:?}");
    let help = |message: &str| errors(&text).into_iter().find(|problem| problem.message == message).unwrap().help;
    assert_eq!(help("unknown name `mu_min`"), "did you mean `mu_min_deg`?");
    // A name that may be meant by a misspelt one is not reported as unused.
    let misspelt = "grid = { p = [2], height = [1] }\nlet = { a = \"3 + heigth\" }";
    assert_eq!(messages(&family("evans", misspelt)), ["unknown name `heigth`"]);
}

/// What follows from a syntax error is not reported, but other problems are.
#[test]
fn a_missing_comma_is_one_problem() {
    let good = "[atlas]\ntitle = \"T\"\nformats = [\"svg\", \"png\"]\n[[family]]\nid = \"f\"\nlinkage = \"own\"\n\
                grid = { p = [2, 3], k = [1, 2] }\nlet = { a = \"2 * p\", h = 1 }\nwhere = \"h > 0\"\n\
                [[linkage]]\nid = \"own\"\nparameters = { p = {}, a = {}, k = { default = 1, min = 0 } }\ntrace = [\"A\"]\n\
                [linkage.joints]\nO = { fixed = [0, 0] }\nA = { crank = \"O\", length = \"p + a + k\" }\n";
    assert_eq!(messages(good), [""; 0]);
    let commas: Vec<usize> = good.match_indices(',').map(|(at, _)| at).collect();
    for at in commas {
        let mut text = good.to_owned();
        text.replace_range(at..=at, " ");
        let found = errors(&text);
        assert_eq!(found.len(), 1, "{}: {found:?}", &text[at.saturating_sub(9)..at + 9]);
        assert!(found[0].message.starts_with("invalid TOML: "), "{found:?}");
        let both = text.replace("title = \"T\"", "title = 3");
        assert_eq!(errors(&both).len(), 2, "{both}");
    }
}

/// A bracket that is not closed makes nothing of what follows it wrong.
#[test]
fn an_open_bracket_is_one_problem() {
    let good = include_str!("../../atlas.toml");
    for (open, close) in
        [("formats = [\"svg\"", "]"), ("p = 2.00, r = 2.59, s = 2.59, a = 1.00 ", "}"), ("[[family]", "]")]
    {
        let at = good.find(open).unwrap() + open.len();
        let at = at + good[at..].find(close).unwrap();
        let text = format!("{}{}", &good[..at], &good[at + 1..]);
        let found = errors(&text);
        assert_eq!(found.len(), 1, "{open}: {found:?}");
        assert!(found[0].message.ends_with("is not closed before the next entry"), "{found:?}");
        let line = |at: usize| text[..at].lines().count();
        assert!(line(at) - line(found[0].span.start) <= 1, "{open}: {found:?}");
    }
}

/// What a command writes never takes the place of the manifest it reads, nor of an atlas or a page of someone else's.
#[test]
fn reports_and_drawings_do_not_replace_what_is_there() {
    let text = family("hoeken", "cases = [{}]\n");
    let atlas = Atlas::new(&text);
    assert_eq!(atlas.run(&[]).0, 0);
    let page = fs::read(atlas.out().join("index.html")).unwrap();
    let own = atlas.0.path().join("own");
    fs::create_dir(&own).unwrap();
    fs::write(own.join("index.html"), "precious").unwrap();
    for (arguments, message) in [
        (&["validate", "atlas.toml", "--report", "json=atlas.toml"][..], "is the manifest"),
        (&["export", "atlas.toml", "f:1.1.1", "-o", "./atlas.toml"], "is the manifest"),
        (&["check", "atlas.toml", "--against", "out", "--report", "json=atlas.toml"], "is the manifest"),
        (&["inspect", "hoeken", "--manifest", "atlas.toml", "--svg", "atlas.toml"], "is the manifest"),
        (&["inspect", "hoeken", "--svg", "out"], "is a folder"),
        (&["check", "atlas.toml", "--against", "out", "--diff", "out"], "out has an atlas"),
        (&["check", "atlas.toml", "--against", "out", "--diff", "own"], "that no check wrote"),
    ] {
        let (code, _, err) = run(atlas.0.path(), arguments);
        assert_eq!(code, 2, "{arguments:?}: {err}");
        assert!(err.contains(message), "{arguments:?}: {err}");
        assert_eq!(fs::read_to_string(atlas.0.path().join("atlas.toml")).unwrap(), text, "{arguments:?}");
    }
    assert_eq!(fs::read(atlas.out().join("index.html")).unwrap(), page);
    assert_eq!(fs::read_to_string(own.join("index.html")).unwrap(), "precious");
    // Drawings of an earlier check are replaced.
    for _ in 0..2 {
        printed(atlas.0.path(), &["check", "atlas.toml", "--against", "out", "--diff", "moved"]);
    }
}

/// An angle may be given with its unit wherever a parameter gets a value; a number without one is in the parameter's.
#[test]
fn angles_may_state_their_unit() {
    let own = "[[linkage]]\nid = \"own\"\nparameters = { phi = { kind = \"angle\" }, l = {}, e = { kind = \"ratio\" } }\n\
               trace = [\"M\"]\n[linkage.joints]\nO = { fixed = [0, 0] }\nA = { crank = \"O\", length = \"l\" }\n\
               M = { point = [\"O\", \"A\"], along = \"e * cos(phi)\", across = \"sin(phi)\" }\n";
    let with = |linkage: &str, lines: &str| format!("{}{own}", family(linkage, lines));
    let values = |linkage: &str, lines: &str, name: &str| -> Vec<f64> {
        let text = with(linkage, lines);
        let plan = plan(&text);
        let family: &Family = &plan.families[0].family;
        (0..family.cell_count()).map(|k| family.value(name, &family.cell(k))).collect()
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let given = [
        ("scotch-yoke", "grid = { angle = [90, \"90 deg\", \"pi / 2 rad\", \"deg(pi / 2)\", \"acos(0) rad\"] }", 90.0),
        ("scotch-yoke", "cases = [{ angle = \"90 deg\" }, { angle = \"pi/2 rad\" }]", 90.0),
        ("scotch-yoke", "grid = { r = [1, 2] }\nlet = { angle = \"pi / (r / r * 2) rad\" }", 90.0),
        ("scotch-yoke", "grid = { angle = { from = \"90 deg\", to = \"90.5 deg\", step = \"1 deg\" } }", 90.0),
        ("own", "grid = { phi = [\"pi / 2\", \"90 deg\", \"rad(90)\", \"acos(0)\"], l = 1, e = 1 }", quarter),
    ];
    for (linkage, lines, expected) in given {
        let name = if linkage == "own" { "phi" } else { "angle" };
        for value in values(linkage, lines, name) {
            assert!((value - expected).abs() < 1e-12, "{lines}: {value}");
        }
    }
    for (linkage, lines, message) in [
        (
            "scotch-yoke",
            "grid = { angle = [\"acos(0)\"] }",
            "`acos` returns radians, and `angle` is an angle in degrees",
        ),
        (
            "scotch-yoke",
            "grid = { angle = [\"rad(90)\"] }",
            "`rad` returns radians, and `angle` is an angle in degrees",
        ),
        (
            "own",
            "grid = { phi = [\"deg(1)\"], l = 1, e = 1 }",
            "`deg` returns degrees, and `phi` is an angle in radians",
        ),
        ("own", "grid = { phi = 1, l = [\"2 deg\"], e = 1 }", "`l` is a length, and takes no degrees"),
        ("own", "grid = { phi = 1, l = 1 }\nlet = { e = \"l rad\" }", "`e` is a ratio, and takes no radians"),
        ("own", "grid = { phi = 1, l = [\"2 mm\"], e = 1 }", "`mm` is not a unit here"),
    ] {
        assert_eq!(messages(&with(linkage, lines)), [message], "{lines}");
    }
}

#[test]
fn the_command_line_takes_angles_with_units() {
    let run = |arguments: &[&str]| run(Path::new("."), arguments);
    let inspect = |parameter: &str| run(&["inspect", "scotch-yoke", parameter]);
    assert_eq!(inspect("angle=60"), inspect("angle=60 deg"));
    assert_eq!(inspect("angle=90"), inspect("angle=pi/2 rad"));
    let at = |linkage: &str, at: &str| run(&["inspect", linkage, "--at", at]);
    assert_eq!(at("hoeken", "45"), at("hoeken", "45 deg"));
    assert_eq!(at("hoeken", "180"), at("hoeken", "pi rad"));
    assert!(at("linear-actuator", "2 deg").2.contains("`2 deg` is an angle, and the input is a length"));
    let step = |step: &str| run(&["export", "--linkage", "hoeken", "--format", "csv", "--step", step]);
    assert_eq!(step("90"), step("pi / 2 rad"));
    assert!(step("90").1.lines().count() == 5 && step("0").2.contains("give a number of at least"));
    let (code, _, err) = inspect("r=60 deg");
    assert_eq!(code, 2);
    assert!(err.contains("`r` is a length, and takes no degrees: give a number without a unit"), "{err}");
}

/// The family that `list linkages NAME` prints can be pasted into a manifest, and its linkage can be assembled.
#[test]
fn the_family_to_start_from_can_be_rendered() {
    let mut text = "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"svg\"]\n".to_owned();
    for template in catalogue::all() {
        let page = printed(Path::new("."), &["list", "linkages", &template.id]);
        let (_, pasted) = page.split_once("a family to start from\n").unwrap();
        text.push_str(pasted);
        for joint in &template.joints {
            assert!(page.contains(&format!("\n  {} ", joint.name)), "{page}");
        }
        for parameter in &template.parameters {
            assert_ne!(parameter.kind, ParameterKind::Number, "{} of {}", parameter.name, template.id);
            assert!(page.contains(&format!("\n  {} ", parameter.name)), "{page}");
        }
    }
    let atlas = Atlas::new(&text);
    let (code, out, err) = atlas.run(&["--strict"]);
    assert_eq!(code, 0, "{out}{err}");
    assert_eq!(err, "");
}

#[test]
fn a_family_needs_neither_sampling_nor_parameters() {
    let own = "[[linkage]]\nid = \"own\"\ntrace = [\"A\"]\n[linkage.joints]\nO = { fixed = [0, 0] }\n\
               A = { crank = \"O\", length = 2 }\n";
    let with = |lines: &str| format!("{}{own}", family("own", lines));
    assert_eq!(messages(&with("cases = [{}]")), [""; 0]);
    for lines in ["", "grid = {}"] {
        let found = errors(&with(lines));
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].help.starts_with("write cases = [{}]"), "{found:?}");
    }
}

/// After an error in a file it is not said of a linkage that it does not exist, which may be in what could not be read.
#[test]
fn a_linkage_in_a_damaged_file_is_not_called_unknown() {
    let folder = folder_with("");
    let damaged = "[[linkage]]\nid = \"mine\"\ntrace = [\"M\"]\noutput_link = [\"R\"]\n";
    fs::write(folder.path().join("mine.toml"), damaged).unwrap();
    for arguments in [&["inspect", "mine"][..], &["export", "--linkage", "mine", "--format", "csv"]] {
        let (code, _, error) = run(folder.path(), &[arguments, &["--manifest", "mine.toml"]].concat());
        assert!(code == 2 && error.contains("error: mine.toml: ") && !error.contains("there is no linkage"), "{error}");
    }
    let slider = "[[linkage]]\nid = \"mine\"\ntrace = [\"R\"]\noutput_link = [\"R\"]\n[linkage.joints]\n\
        O = { fixed = [0, 0] }\nX = { fixed = [1, 0] }\nA = { crank = \"O\", length = 1 }\n\
        R = { slide = \"A\", length = 3, line = [\"O\", \"X\"], side = \"ahead\" }\n";
    fs::write(folder.path().join("mine.toml"), slider).unwrap();
    let (code, _, error) = run(folder.path(), &["inspect", "mine", "--manifest", "mine.toml"]);
    assert!(code == 2 && error.contains("write output_link = \"R\" for the slider"), "{error}");
}

/// At a change point, where all joints are on one line, the coupler turns or does not, and only one of the two is printed; angles at which
/// joints are on one line are exact though the lengths are not.
#[test]
fn what_is_on_one_line_is_said_as_it_is() {
    let folder = folder_with("");
    let change_point = ["inspect", "four-bar", "frame=4", "crank=2", "coupler=3", "rocker=5", "along=1.5", "--at", "0"];
    let out = printed(folder.path(), &change_point);
    assert!(out.contains("M: instant centre") && !out.contains("does not rotate"), "{out}");
    // The coupler of a parallelogram translates, and on the other branch it turns.
    let parallelogram = |branch| {
        let lengths = ["frame=4", "crank=2", "coupler=4", "rocker=2", "--at", "50", "--branch", branch];
        printed(folder.path(), &[&["inspect", "four-bar"][..], &lengths].concat())
    };
    let [translating, turning]: [Vec<String>; 2] = {
        let (still, moving) =
            ["1", "-1"].map(parallelogram).into_iter().partition(|out| out.contains("does not rotate"));
        [still, moving]
    };
    assert!(translating.len() == 1 && translating[0].contains("angular velocity 0,"), "{translating:?}");
    assert!(turning[0].contains("M: instant centre") && !turning[0].contains("angular velocity 0,"), "{turning:?}");
    let lemniscate = ["inspect", "four-bar", "frame=sqrt(2)", "crank=1", "coupler=sqrt(2)", "rocker=1", "--json"];
    assert!(printed(folder.path(), &lemniscate).contains("\"folded\": 180.0"));
}
