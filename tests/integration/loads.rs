//! A load in a manifest and on the command line: measures and columns of the input torque, and what is said where it is missing or wrong.

use std::fs;

use coupler_atlas::manifest;
use coupler_curves::problem::Problem;
use serde_json::Value;
use tempfile::TempDir;

use crate::support::command::run;
use crate::support::folder::Atlas;

/// A manifest with one family of slider-cranks of two couplers.
fn family(lines: &str) -> String {
    format!(
        "[atlas]\ntitle = \"T\"\noutput = \"out\"\n[[family]]\nid = \"f\"\nlinkage = \"slider-crank\"\nsampling = {{ samples = 36 }}\n\
         trace = [\"B\"]\ngrid = {{ coupler = [2, 4] }}\n{lines}\n"
    )
}

fn errors(text: &str) -> Vec<Problem> {
    manifest::parse(text).problems.into_iter().filter(Problem::is_error).collect()
}

/// The value of a column in each row of a table.
fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let k = lines.next().unwrap().iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name}"));
    lines.map(|line| line[k].parse().unwrap_or(f64::NAN)).collect()
}

#[test]
fn a_family_with_a_load_has_torques() {
    let load = "load = { joint = \"B\", force = 10, direction = \"0 deg\" }";
    let atlas = Atlas::new(&family(&format!(
        "{load}\ncolumns = [\"vx\", \"torque\"]\nsort = \"torque_peak\"\nwhere = \"torque_max < 11\""
    )));
    let (code, _, err) = atlas.run(&[]);
    assert_eq!(code, 0, "{err}");
    let read = |name: &str| fs::read_to_string(atlas.out().join("f").join(name)).unwrap();
    let (points, cells) = (read("points.csv"), read("cells.csv"));
    let (velocities, torques) = (column(&points, "vx"), column(&points, "torque"));
    assert!(torques.iter().zip(&velocities).all(|(torque, v)| (torque + 10.0 * v).abs() < 1e-12));
    // With the shorter coupler the greatest torque is more.
    let peaks = column(&cells, "torque_peak");
    assert_eq!((peaks.len(), column(&cells, "coupler")), (1, vec![4.0]));
    let sampled = torques.iter().fold(0.0f64, |most, torque| most.max(torque.abs()));
    assert!(peaks[0] >= sampled && peaks[0] < 1.02 * sampled, "{peaks:?} {sampled}");
    assert_eq!(column(&cells, "torque_min"), [-peaks[0]]);
}

#[test]
fn a_load_of_a_linkage_is_that_of_its_families_but_for_their_own() {
    let linkage = "[[linkage]]\nid = \"press\"\ntrace = [\"B\"]\nload = { joint = \"B\", force = 3 }\n[linkage.joints]\nO = { fixed = [0, 0] }\n\
                   X = { fixed = [1, 0] }\nA = { crank = \"O\", length = 1 }\nB = { slide = \"A\", length = 3, line = [\"O\", \"X\"], offset = 0, side = \"ahead\" }\n";
    let of = |own: &str| {
        let text = format!(
            "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"f\"\nlinkage = \"press\"\nsampling = {{ samples = 9 }}\ncases = [{{}}]\n{own}\n{linkage}"
        );
        let plan = manifest::parse(&text).plan.unwrap_or_else(|| panic!("{own}"));
        plan.families[0].family.template.load.unwrap()
    };
    assert_eq!((of("").force, of("").direction_deg), (3.0, None));
    let own = of("load = { joint = \"A\", force = \"2 * 3\", direction = \"pi/2 rad\" }");
    assert_eq!((own.force, own.direction_deg), (6.0, Some(90.0)));
}

#[test]
fn what_is_wrong_with_a_load_is_said() {
    for (lines, message, help) in [
        (
            "where = \"torque_peak < 5\"",
            "`slider-crank` has no `torque_peak`",
            "give the family a load, as in load = { ",
        ),
        ("columns = [\"torque\"]", "`slider-crank` has no `torque`", "give the family a load, as in load = { "),
        ("load = { joint = \"Z\", force = 1 }", "unknown joint `Z`", ""),
        ("load = { force = 1 }", "`load` has no `joint`", "add joint = \"C\""),
        ("load = { joint = \"B\", force = -1 }", "`force` must be greater than 0, found -1", "another `direction`"),
        ("load = { joint = \"B\", force = 1, direction = 90 }", "", "deg"),
    ] {
        let found = errors(&family(lines));
        assert_eq!(found.len(), 1, "{lines}: {found:?}");
        assert!(found[0].message.contains(message) && found[0].help.contains(help), "{lines}: {found:?}");
    }
}

#[test]
fn inspect_has_the_torque_against_a_load() {
    let folder = TempDir::new().unwrap();
    let inspect =
        |load: &str| run(folder.path(), &["inspect", "scotch-yoke", "r=2", "--load", load, "--at", "90", "--json"]);
    let (code, out, err) = inspect("100 on Y at 0 deg");
    assert_eq!(code, 0, "{err}");
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(found["load"], serde_json::json!({ "joint": "Y", "force": 100.0, "direction": 0.0 }));
    let near = |value: &Value, expected: f64| assert!((value.as_f64().unwrap() - expected).abs() < 1e-5, "{value}");
    near(&found["curves"][0]["measures"]["torque_peak"], 200.0);
    near(&found["curves"][0]["measures"]["torque_peak_deg"], 90.0);
    near(&found["poses"][0]["torque"], 200.0);
    let (code, out, _) = run(folder.path(), &["inspect", "scotch-yoke", "r=2", "--load", "100 on Y", "--at", "270"]);
    assert!(code == 0 && out.contains("input torque: at most 200, at 90°; from "), "{out}");
    assert!(out.contains("load: 100 on Y against its motion") && out.contains("\ninput torque: 200"), "{out}");
    for (load, message) in [("100", "is no load; write \"100 on C at -90 deg\""), ("100 on Q", "no single joint `Q`")] {
        let (code, _, err) = inspect(load);
        assert!(code == 2 && err.contains(message), "{err}");
    }
}
