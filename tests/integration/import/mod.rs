//! Linkages of other programs become manifests with the same joints, links and motion.

mod formats;
mod samples;

use std::io::Write;
use std::process::Stdio;

use tempfile::TempDir;

use coupler_atlas::import::{self, Format};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::Linkage;
use coupler_curves::motion::{self, Motion, Sampler};

use crate::support::command::{folder_with, printed, program, result, run};
use crate::support::curve_rows;
use crate::support::plan::plan;
use samples::{
    ARRAYS, LINKS, PYLINKAGE, PYLINKAGE_SLIDER, PYSLVS, PYSLVS_SLIDER, READABLE, SLIDER, short_address, short_slider,
};

/// The manifest of a text.
#[track_caller]
fn manifest(text: &str, input: Option<&str>) -> String {
    let drawing = import::read(text, None, input).unwrap_or_else(|error| panic!("{error}\n{text}"));
    import::manifest_text(&drawing)
}

/// The linkage of a manifest, and its motion.
fn solved(manifest: &str) -> (Linkage, Motion) {
    let plan = plan(manifest);
    let family = &plan.families[0].family;
    let linkage = family.linkage(&family.cell(0)).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(family.sampling));
    (linkage, motion)
}

/// Checks that the joints are drawn where they are given, that the distances of joints of a link are kept, and that the motion passes the drawing.
#[track_caller]
fn check(manifest: &str, drawn: &[(&str, [f64; 2])], links: &[&[&str]]) {
    let (linkage, motion) = solved(manifest);
    assert!(motion.is_assembled(), "{manifest}");
    let drawn: Vec<_> =
        drawn.iter().map(|&(name, [x, y])| (name, linkage.find_joint(name).unwrap(), Point::new(x, y))).collect();
    let of = |name: &str| drawn.iter().find(|(other, ..)| *other == name).unwrap();
    for circuit in &motion.circuits {
        for sample in 0..circuit.len() {
            let at = |joint| circuit.positions.point(joint, sample);
            for link in links {
                for (&(_, a, p), &(_, b, q)) in link.iter().flat_map(|a| link.iter().map(|b| (of(a), of(b)))) {
                    assert!(((at(a) - at(b)).norm() - (p - q).norm()).abs() < 1e-9, "{link:?}: {manifest}");
                }
            }
        }
    }
    let pose = start_pose(&linkage, &motion).unwrap_or_else(|| panic!("no pass has the drawn pose: {manifest}"));
    for &(name, joint, point) in &drawn {
        let distance = (pose[joint.index()] - point).norm();
        assert!(distance < 1e-9, "{name}: {distance}: {manifest}");
    }
}

/// The positions of the joints at the input of the drawing.
fn start_pose(linkage: &Linkage, motion: &Motion) -> Option<Vec<Point>> {
    let start = linkage.motion_options.start?;
    motion.circuits.iter().flat_map(|circuit| &circuit.passes).find_map(|pass| {
        let (from, to) = (pass.from.input.value, pass.to.input.value);
        let at = start + 360.0 * ((from.min(to) - start) / 360.0).ceil();
        (pass.mode == linkage.motion_options.mode && at <= from.max(to)).then(|| motion::pose(linkage, pass, at))
    })
}

const FOUR_BAR: [[f64; 2]; 5] = [[0.0, 0.0], [0.6, 0.8], [3.4, 2.6], [4.0, 0.0], [2.5, 3.4]];

#[track_caller]
fn check_four_bar(manifest: &str, [a, b, c, d, m]: [&str; 5]) {
    let drawn: Vec<_> = [a, b, c, d, m].into_iter().zip(FOUR_BAR).collect();
    check(manifest, &drawn, &[&[a, b], &[b, c, m], &[c, d], &[a, d]]);
    assert!(manifest.contains(&format!("trace = [\"{m}\"]")), "{manifest}");
    assert!(manifest.contains(&format!("input = \"{a} {b}\"")), "{manifest}");
}

#[test]
fn a_four_bar_is_the_same_from_every_format() {
    let letters = ["A", "B", "C", "D", "M"];
    check_four_bar(&manifest(READABLE, None), letters);
    check_four_bar(&manifest(PYLINKAGE, None), letters);
    check_four_bar(&manifest(PYSLVS, Some("P0, P1")), ["P0", "P1", "P2", "P3", "P4"]);
    check_four_bar(&manifest(LINKS, None), ["J0", "J1", "J2", "J3", "J4"]);
    assert_eq!(manifest(ARRAYS, None), manifest(LINKS, None));
    let joints: Vec<_> = letters.into_iter().zip(FOUR_BAR).zip("G500G".chars()).collect();
    // The flags: A is ground and input, D is ground, M is shown.
    let flags = ['6', '0', '0', '4', 'G'];
    let joints: Vec<_> =
        joints.iter().zip(flags).map(|(((id, [x, y]), _), flags)| (flags, *id, [*x, *y, 0.0])).collect();
    let address =
        short_address(&joints, &["YR1,AB,1,1,0,0,c,A,B,,", "YR2,BCM,1,1,0,0,c,B,C,M,,", "YR3,CD,1,1,0,0,c,C,D,,"]);
    check_four_bar(&manifest(&address, None), letters);
    let text = manifest(PYLINKAGE, None);
    assert!(text.contains("title = \"A four-bar\"") && text.contains("angular velocity"), "{text}");
    assert!(manifest(READABLE, None).contains("forces were left out"));
}

#[test]
fn sliders_keep_to_their_lines() {
    let drawn = |c: [f64; 2]| [("A", [0.0, 0.0]), ("B", [0.6, 0.8]), ("C", c), ("M", [1.5, 1.4])];
    let links: [&[&str]; 2] = [&["A", "B"], &["B", "C", "M"]];
    for (text, c, angle) in [
        (SLIDER.to_owned(), [3.0, 0.2], 0.5_f64),
        (PYLINKAGE_SLIDER.to_owned(), [3.0, 0.5], 0.0),
        (short_slider(), [3.0, -0.2], std::f64::consts::FRAC_PI_2),
    ] {
        let manifest = manifest(&text, None);
        check(&manifest, &drawn(c), &links);
        let (linkage, motion) = solved(&manifest);
        let slider = linkage.find_joint("C").unwrap();
        for point in motion.circuits.iter().flat_map(|circuit| circuit.points(slider)) {
            let across = (point.y - c[1]) * trig::cos(angle) - (point.x - c[0]) * trig::sin(angle);
            assert!(across.abs() < 1e-9, "{across}: {manifest}");
        }
    }
    assert!(manifest(PYLINKAGE_SLIDER, None).contains("the arc of the driver was left out"));
}

#[test]
fn a_slider_may_be_driven() {
    let text = SLIDER.replace("AB,R,t,0,0.1,t", "AB,R,t,0,0.1,f").replace("P,t,0.5,0.1,f", "P,t,0.5,0.1,t");
    let manifest = manifest(&text, None);
    assert!(manifest.contains("input = { slider = \"C\" }"), "{manifest}");
    let (linkage, motion) = solved(&manifest);
    let slider = linkage.find_joint("C").unwrap();
    let circuit = &motion.circuits[0];
    // The way is measured from the first joint of the line.
    let from = linkage.find_joint("C1").unwrap();
    for sample in 0..circuit.len() {
        let way = (circuit.positions.point(slider, sample) - circuit.positions.point(from, sample)).norm();
        assert!((way - circuit.inputs[sample].abs()).abs() < 1e-9);
    }
}

/// The block of a slider of Pyslvs moves without turning, and with it a point on it.
#[test]
fn a_block_keeps_its_direction() {
    let manifest = manifest(PYSLVS_SLIDER, Some("P0 P1"));
    let drawn = [("P0", [0.0, 0.0]), ("P1", [0.6, 0.8]), ("P2", [3.0, 0.2]), ("P3", [1.5, 1.4]), ("P4", [3.5, 0.9])];
    check(&manifest, &drawn, &[&["P0", "P1"], &["P1", "P2", "P3"], &["P2", "P4"]]);
    let (linkage, motion) = solved(&manifest);
    let [pin, point] = ["P2", "P4"].map(|name| linkage.find_joint(name).unwrap());
    for circuit in &motion.circuits {
        for (a, b) in circuit.points(pin).zip(circuit.points(point)) {
            assert!((b.x - a.x - 0.5).abs() < 1e-9 && (b.y - a.y - 0.7).abs() < 1e-9);
        }
    }
}

#[test]
fn names_are_distinct_and_acceptable() {
    let text = READABLE
        .replace("M,2.5,3.4", "=B,2.5,3.4")
        .replace("C,3.4,2.6", "B,3.4,2.6")
        .replace("B%7CC%7CM", "B")
        .replace("C%7CD,,", "D,,");
    let manifest = manifest(&text, None);
    check_four_bar(&manifest, ["A", "B", "B-2", "D", "J=B"]);
}

/// Every cut of every sample is a valid manifest or an error with a place and a remedy.
#[test]
fn cut_texts_never_panic() {
    for text in samples::all() {
        let text = text.as_str();
        for end in 0..text.len() {
            for input in [None, Some("P0, P1")] {
                for text in [&text[..end], &text[end..]] {
                    match import::read(text, None, input) {
                        // Whether it can be drawn is known to the parser of manifests, which must not panic.
                        Ok(drawing) => drop(coupler_atlas::manifest::parse(&import::manifest_text(&drawing))),
                        Err(error) => {
                            assert!(!error.place.is_empty() && !error.message.is_empty() && !error.remedy.is_empty())
                        }
                    }
                }
            }
        }
        for format in Format::ALL {
            let _ = import::read(text, Some(format), None);
        }
    }
}

/// Bytes of the samples that are replaced by others never make a panic.
#[test]
fn damaged_texts_never_panic() {
    damage(11);
}

#[test]
#[ignore = "thorough"]
fn no_damaged_text_panics() {
    damage(1);
}

/// Replaces one in so many bytes of each sample by others, one at a time.
fn damage(step: usize) {
    for (k, text) in samples::all().iter().enumerate() {
        for at in (k % step..text.len()).step_by(step) {
            for byte in [b'0', b'9', b'-', b',', b'"', b'%', b'.', b'e', b'[', b']', b' ', b't', b'P', b'<', b'/'] {
                let mut bytes = text.as_bytes().to_vec();
                bytes[at] = byte;
                let text = String::from_utf8(bytes).unwrap();
                if let Ok(drawing) = import::read(&text, None, Some("P0, P1")).or(import::read(&text, None, None)) {
                    let text = import::manifest_text(&drawing);
                    drop(coupler_atlas::manifest::parse(&text));
                }
            }
        }
    }
}

#[test]
fn wrong_texts_are_errors_with_remedies() {
    let error = |text: &str| import::read(text, None, None).unwrap_err().to_string();
    for (text, words) in [
        ("", "it is empty"),
        ("{\"edges\": [", "line 1, column 11: it is not JSON"),
        ("hello", "its format is not known"),
        ("[[linkage]]", "its format is not known"),
        (
            PYSLVS,
            "the input is not known; name two joints of the driven link: --input \"P0, P1\" or --input \"P3, P2\"",
        ),
        ("M[J[R, P[0, x], L[ground]]]", "joint 0: expected a number for y, found `x`"),
        ("M[J[R, P[0, 0], L[ground]", "line 1, column 26: expected `,` or `]`, found the end"),
        ("M[[[[[[[[", "nested too deeply"),
        ("?j=A,0,0,AB,R,t", "`j`, joint 1: it has 6 of 9 fields"),
        ("?j=A,0,1e999,AB,R,t,0,0,f,", "expected a number for y, found `1e999`"),
        ("?j=A%G", "% without two hexadecimal digits"),
        ("?7.A.B.C.6A,A,0,0,0.x", "its last character is not that of its length"),
        (&PYLINKAGE.replace("revolute", "cam"), "a joint of the type `cam`"),
        (&LINKS.replace("[0, 1], [1, 2]", "[0, 9], [1, 2]"), "joints have the numbers 0 to 4"),
        (&LINKS.replace("\"motor\": [0, 1]", "\"motor\": [0]"), "`motor`: it does not name two joints"),
        (&format!("?j={}", (0..200).map(|k| format!("J{k},0,0,L,R,f,0,0,f,%0A")).collect::<String>()), "more than 100"),
        (&" ".repeat(import::MAX_BYTES + 1), "more than 8388608 bytes"),
    ] {
        let found = error(text);
        assert!(found.contains(words), "{words}: {found}");
    }
}

#[test]
fn the_command_prints_a_manifest() {
    let folder = TempDir::new().unwrap();
    let path = folder.path();
    let text = printed(path, &["import", READABLE]);
    assert_eq!(text, manifest(READABLE, None));
    std::fs::write(path.join("four-bar.json"), PYLINKAGE).unwrap();
    let text = printed(path, &["import", "four-bar.json"]);
    assert_eq!(text, manifest(PYLINKAGE, None));
    std::fs::write(path.join("imported.toml"), &text).unwrap();
    printed(path, &["render", "imported.toml", "--format", "svg", "-q"]);
    assert!(path.join("imported/imported/imported-001.svg").is_file());
    let with_input = |arguments: &[&str], text: &str| {
        let mut command = program(path);
        command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let _ = child.stdin.take().unwrap().write_all(text.as_bytes());
        result(child.wait_with_output().unwrap())
    };
    let (code, out, err) = with_input(&["import", "-", "--input", "P0, P1"], PYSLVS);
    assert_eq!((code, out.as_str()), (0, manifest(PYSLVS, Some("P0, P1")).as_str()), "{err}");
    // What the parser of manifests says of a linkage that cannot be drawn.
    let open = LINKS.replace("[2, 3], ", "");
    let (code, out, err) = with_input(&["import", "-", "--format", "links"], &open);
    assert!(code == 2 && out.is_empty() && err.contains("degrees of freedom"), "{err}");
    for arguments in [
        &["import", "missing.json"][..],
        &["import", "four-bar.json", "--format", "pmks"],
        &["import", "four-bar.json", "--format", "x"],
    ] {
        let (code, out, err) = run(path, arguments);
        assert!(code == 2 && out.is_empty() && !err.is_empty(), "{arguments:?}: {err}");
    }
    std::fs::write(path.join("binary"), [0xff]).unwrap();
    for (file, words) in
        [("missing.json", "cannot find missing.json"), ("binary", "binary is not a text"), (".", ". is a folder")]
    {
        let (code, _, err) = run(path, &["import", file]);
        assert!(code == 2 && err.contains(words), "{err}");
    }
    let (code, _, err) = run(path, &["import", "four-bar.json", "--input", "A, Q"]);
    assert!(code == 2 && err.contains("has no joint `Q`"), "{err}");
}

/// Links that no dyads place are as good as others.
#[test]
fn a_group_is_imported() {
    let folder = TempDir::new().unwrap();
    let stephenson = r#"{"edges": [[0, 2], [2, 3], [3, 4], [2, 4], [1, 5], [5, 6], [1, 6], [3, 5], [4, 6]],
        "positions": [[0, 0], [4, 0], [0, 1], [1, 3], [2, 1], [3, 3], [4, 2]], "fixed": [0, 1], "motor": [0, 2], "target": 3}"#;
    std::fs::write(folder.path().join("six.json"), stephenson).unwrap();
    for input in [&[][..], &["--input", "J1, J6"]] {
        let manifest = printed(folder.path(), &[&["import", "six.json"], input].concat());
        assert!(solved(&manifest).1.is_assembled(), "{input:?}");
    }
}

/// What is exported for PMKS+ is imported as the same linkage: its curve passes all points of the exported one.
#[test]
fn exported_addresses_are_the_same_linkages() {
    let folder = folder_with(
        r#"[atlas]
title = "T"
[[linkage]]
id = "slider"
trace = ["M"]
[linkage.joints]
O = { fixed = [0, 0] }
P = { fixed = [0, -1] }
Q = { fixed = [3, -0.4] }
A = { crank = "O", length = 1 }
B = { slide = "A", length = 3.3, line = ["P", "Q"], offset = 0.3, side = "ahead" }
M = { point = ["A", "B"], along = 1.5, across = 1 }
[[family]]
id = "slider"
linkage = "slider"
cases = [{}]
place = { mirror = true, rotate = "30 deg" }
[[family]]
id = "bars"
linkage = "hrones-nelson"
cases = [{ A = 3, B = 3.5, C = 3 }]
[[family]]
id = "six"
linkage = "klann"
cases = [{}]
[[family]]
id = "slot"
linkage = "linear-actuator"
cases = [{ g = 2, r = 0.75, e = 0.3 }]
"#,
    );
    let path = folder.path();
    for curve in ["slider:1.1.1", "bars:1.1.1", "bars:1.10.1", "six:1.1.1"] {
        let address = printed(path, &["export", curve, "--format", "pmks"]);
        assert!(address.starts_with("https://") && address.lines().count() == 1, "{address}");
        let manifest = printed(path, &["import", address.trim()]);
        let expected = curve_rows::rows(path, &["export", curve]);
        // The input is measured from the x-axis in both, but a mirrored one turns the other way.
        let is_placed = curve.starts_with("slider");
        let placed = |[input, x, y]: [f64; 3]| [if is_placed { 30.0 - input } else { input }, x, y];
        let rows = expected.into_iter().map(placed);
        let distance = curve_rows::distance_to_curve(&manifest, rows);
        assert!(distance < 1e-9, "{curve}: {distance}\n{manifest}");
    }
    let (code, out, err) = run(path, &["export", "slot:1.1.1", "--format", "pmks"]);
    assert!(code == 2 && out.is_empty() && err.contains("PMKS+ has no actuator between two links"), "{err}");
}
