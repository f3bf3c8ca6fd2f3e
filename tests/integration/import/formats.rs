//! Files of Linkage and linkage_sim, components of pylinkage, tables.

use coupler_atlas::import;
use coupler_curves::geometry::trig;
use tempfile::TempDir;

use super::samples::{
    COMPONENTS, COMPONENTS_SLIDER, LINKAGE_SIM, LINKAGE_SIM_SLIDER, LINKAGE2, LINKAGE2_SLIDER, LINKS, TABLE,
};
use super::{check, check_four_bar, manifest, solved};
use crate::support::command::run;

#[test]
fn a_four_bar_is_the_same() {
    let letters = ["A", "B", "C", "D", "M"];
    for text in [LINKAGE2, LINKAGE_SIM, COMPONENTS, TABLE] {
        check_four_bar(&manifest(text, None), letters);
    }
    let text = manifest(LINKAGE2, None);
    assert!(text.contains("Unit of lengths: Millimeters") && text.contains("drawn for show was left out"), "{text}");
    assert!(manifest(LINKAGE_SIM, None).contains("the file has no pose"));
    let document = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/import.md")).unwrap();
    assert!(document.contains(TABLE));
    // Joints without names are those of LINKS.
    let numbers =
        "x,y,bars,fixed,motor,target\n0,0,J1,1,1,\n0.6,0.8,J2 J4,,1,\n3.4,2.6,J3 J4,,,\n4,0,,1,,\n2.5,3.4,,,,1";
    let from_links = manifest(LINKS, None).replace("a file of LINKS or LInK", "a table of joints");
    assert_eq!(manifest(numbers, None), from_links);
}

#[test]
fn sliders_keep_to_their_lines() {
    for text in [LINKAGE2_SLIDER, LINKAGE_SIM_SLIDER, COMPONENTS_SLIDER] {
        let manifest = manifest(text, None);
        let (linkage, motion) = solved(&manifest);
        assert!(motion.is_assembled(), "{manifest}");
        let [pin, slider] = ["B", "C"].map(|name| linkage.find_joint(name).unwrap());
        for circuit in &motion.circuits {
            for (a, b) in circuit.points(pin).zip(circuit.points(slider)) {
                assert!((a.coords.norm() - 1.0).abs() < 1e-9 && (b.y - 0.5).abs() < 1e-9, "{manifest}");
            }
        }
    }
    let drawn = [("A", [0.0, 0.0]), ("B", [0.6, 0.8]), ("C", [3.0, 0.5]), ("M", [1.5, 1.4])];
    check(&manifest(LINKAGE2_SLIDER, None), &drawn, &[&["A", "B"], &["B", "C", "M"]]);
    // The plate is welded to the rod.
    let (linkage, motion) = solved(&manifest(LINKAGE_SIM_SLIDER, None));
    let [b, c, m] = ["B", "C", "M"].map(|name| linkage.find_joint(name).unwrap());
    let angle = trig::atan2(1.0, 1.0) + 0.1;
    for circuit in &motion.circuits {
        let points = circuit.points(b).zip(circuit.points(c)).zip(circuit.points(m));
        for ((b, c), m) in points {
            let (rod, plate) = (c - b, m - b);
            let cosine = rod.dot(&plate) / rod.norm() / plate.norm();
            assert!((plate.norm() - 2.0_f64.sqrt()).abs() < 1e-9 && (cosine - trig::cos(angle)).abs() < 1e-9);
        }
    }
}

/// Where a manifest is expected, a linkage of another program is recognized.
#[test]
fn a_linkage_in_place_of_a_manifest_is_recognized() {
    let folder = TempDir::new().unwrap();
    for (file, text) in
        [("a.linkage2", LINKAGE2), ("a.json", LINKAGE_SIM), ("b.json", COMPONENTS), ("c.json", LINKS), ("a.csv", TABLE)]
    {
        std::fs::write(folder.path().join(file), text).unwrap();
        let (code, _, err) = run(folder.path(), &["validate", file]);
        assert!(code == 2 && err.contains(&format!("`coupler-atlas import {file}` prints a manifest")), "{err}");
    }
}

/// A piston of Linkage slides by two joints, and its rod is on a third.
#[test]
fn a_piston_moves_without_turning() {
    let piston = LINKAGE2_SLIDER
        .replace(r#"name="C" x="3" y="0.5" slider="true""#, r#"name="P" x="3.5" y="0.5" slider="true""#)
        .replace("</linkage2>", r#"<connector id="6" name="Q" x="4" y="0.5" slider="true"><slidelimit id="3"/><slidelimit id="4"/></connector>
            <connector id="7" name="C" x="3" y="0.5"/><Link id="2"><connector id="2"/><connector id="6"/><connector id="7"/></Link></linkage2>"#)
        .replace(r#"<connector id="2"/><connector id="5"/>"#, r#"<connector id="7"/><connector id="5"/>"#);
    let manifest = manifest(&piston, None);
    let (linkage, motion) = solved(&manifest);
    assert!(motion.is_assembled(), "{manifest}");
    let [pin, end] = ["C", "P"].map(|name| linkage.find_joint(name).unwrap());
    for circuit in &motion.circuits {
        for (a, b) in circuit.points(pin).zip(circuit.points(end)) {
            assert!((b.x - a.x - 0.5).abs() < 1e-9 && (a.y - 0.5).abs() < 1e-9 && (b.y - 0.5).abs() < 1e-9);
        }
    }
}

/// An actuator of Linkage is the input, and a driver between two moving bodies of linkage_sim is the angle between them.
#[test]
fn other_inputs_are_read() {
    let lift = r#"<linkage2><connector id="0" anchor="true" x="0" y="0"/><connector id="1" x="1" y="2"/>
        <connector id="2" anchor="true" x="3" y="0"/><connector id="3" draw="true" x="0.5" y="3"/>
        <Link id="0" actuator="true" throw="1" cpm="15"><connector id="1"/><connector id="2"/></Link>
        <Link id="1"><connector id="0"/><connector id="1"/><connector id="3"/></Link></linkage2>"#;
    let text = manifest(lift, None);
    assert!(text.contains("input = { distance = [\"J1\", \"J2\"] }"), "{text}");
    assert!(solved(&text).1.is_assembled());
    let between = LINKAGE_SIM.replace(
        r#""body_i": "ground", "body_j": "crank", "omega""#,
        r#""body_i": "crank", "body_j": "coupler", "omega""#,
    );
    let between = between.replace("\"theta_0\": 0", "\"theta_0\": 1.6");
    let text = manifest(&between, None);
    assert!(text.contains("input = { between = [\"A B\", \"B C\"] }"), "{text}");
    assert!(solved(&text).1.is_assembled());
}

#[test]
fn wrong_files_are_errors_with_remedies() {
    let gears = LINKAGE2.replace("</linkage2>", "<ratios><ratio type=\"gears\"/></ratios></linkage2>");
    let second = COMPONENTS.replace("\"type\": \"Revolute\"", "\"type\": \"Crank\"");
    for (text, words) in [
        ("<linkage2/>", "the input is not known"),
        ("<svg/>", "line 1, `svg`: the XML is not that of Linkage"),
        ("<linkage2>", "it ends within an element"),
        ("<linkage2>\n<connector/></linkage2>", "line 2, `connector`: it has no `id`"),
        ("<linkage2>\n<a></b>", "line 2: it is not well-formed XML"),
        (&gears, "gears and chains, which a drawing cannot express"),
        (
            &LINKAGE2.replace("x=\"2.5\"", "x=\"1e999\""),
            "line 7, `connector` `7`: expected a number for x, found `1e999`",
        ),
        (&LINKAGE2.replace("<connector id=\"5\"/>", "<connector id=\"6\"/>"), "there is no connector `6`"),
        (&LINKAGE2_SLIDER.replace("<slidelimit id=\"4\"/>", ""), "it slides, and has 1 limits, not 2"),
        (&LINKAGE2_SLIDER.replace("slider=", "slideradius=\"2\" slider="), "it slides on an arc"),
        ("{\"bodies\": []}", "there is no table `bodies`"),
        ("{\"bodies\": {}}", "there is no body `ground`"),
        (
            &LINKAGE_SIM.replace("\"point_j\": \"D\"", "\"point_j\": \"E\""),
            "the joint `D`: the body `rocker` has no point `E`",
        ),
        (&LINKAGE_SIM.replace("\"type\": \"revolute\"", "\"type\": \"cam\""), "a joint of the type `cam`"),
        (
            &LINKAGE_SIM.replace("\"O4\": [4, 0]", "\"O4\": [40, 0]"),
            "no pose was found in which its bodies fit together",
        ),
        (&LINKAGE_SIM_SLIDER.replace("[2, 0]", "[0, 0]"), "its axis has no direction"),
        (
            &COMPONENTS.replace("\"ref\": \"C\"", "\"ref\": \"M\""),
            "`M` is placed from a joint that is not there, or from itself",
        ),
        (&COMPONENTS.replace("3.32", "9.32"), "do not meet"),
        (&COMPONENTS.replace("PointTracker", "PPDyad"), "a component of the type `PPDyad`"),
        (&COMPONENTS_SLIDER.replace("2.41", "0.01"), "does not reach its line"),
        (&second, "a second crank is driven"),
        (&TABLE.replace("motor,", "motors,"), "line 1: there is a column `motors`; the columns are `x`, `y`, `bars`"),
        (&TABLE.replace("2.6", "x"), "line 4: expected a number for `y`, found `x`"),
        (&TABLE.replace("B D", "B E"), "line 4: `bars` names `E`, which is no joint"),
        (&TABLE.replace("B D", "C D"), "line 4: the bar is from joint 2 to itself"),
        (&TABLE.replace("D,4,0,1", "D,4,0,yes"), "line 5: `fixed` is `yes`"),
        (&TABLE.replace("D,4,0,1,,,", "D,4,0,1"), "line 5: it has 4 values, and the first line 7"),
        (&TABLE.replace("D,4", "A,4"), "line 5: another joint is called `A`"),
        (&TABLE.replace("B,0.6,0.8,,1", "B,0.6,0.8,,0"), "the column `motor`: it does not name two joints"),
    ] {
        let found = import::read(text, None, None).unwrap_err().to_string();
        assert!(found.contains(words), "{words}: {found}");
    }
}
