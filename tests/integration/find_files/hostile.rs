//! Files that are to exhaust memory or time.

use std::fs;

use tempfile::TempDir;

use super::read;

fn svg(content: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\">{content}</svg>")
}

/// Drawings with numbers of any size, and those that grow when they are read.
fn drawings() -> Vec<(&'static str, String)> {
    let links: String =
        (1..12).map(|k| format!("<g id='a{k}'>{}</g>", format!("<use href='#a{}'/>", k - 1).repeat(10))).collect();
    let rules: String = (0..2000).map(|k| format!("g g .c{k} path {{ fill: red }} ")).collect();
    vec![
        ("an arc", svg("<path d='M0 0A1e48 1e48 0 0 1 1 1'/>")),
        ("a larger arc", svg("<path d='M0 0A1e300 1e-300 0 0 1 1 1'/>")),
        ("a small circle", svg("<circle r='1e-320'/>")),
        ("a large circle", svg("<circle r='1e300'/>")),
        ("an ellipse", svg("<ellipse rx='1e300' ry='1e-300'/>")),
        ("a rectangle", svg("<rect width='-5' height='5' rx='2'/>")),
        ("a rounded rectangle", svg("<rect width='1e300' height='1e-300' rx='1e300' ry='1'/>")),
        ("a scale", svg("<g transform='scale(1e-160)'><circle r='5'/></g>")),
        ("scales", svg(&format!("{}<circle r='5'/>{}", "<g transform='scale(1e30)'>".repeat(20), "</g>".repeat(20)))),
        ("a curve", svg("<path d='M0 0C1e-160 0 1e-160 1e-160 0 1e-160'/>")),
        ("a curve between large and small", svg("<path d='M1e200 1e-200C1e-160 0 1e160 1e-160 0 -1e200z'/>")),
        ("links", svg(&format!("<defs><circle id='a0' r='1'/>{links}</defs><use href='#a11'/>"))),
        ("a style sheet", svg(&format!("<style>{rules}</style>{}", "<path d='M0 0L1 1'/>".repeat(100_000)))),
        ("groups", "<g>".repeat(100_000)),
        ("circles", svg(&"<circle r=\"1\"/>".repeat(8 * 1024 * 1024 / 15 - 10))),
        ("a path of many arcs", svg(&format!("<path d='M0 0{}'/>", "A5 9 3 0 1 1 2A5 9 3 0 1 2 1".repeat(200_000)))),
        ("a path of many curves", svg(&format!("<path d='M0 0{}'/>", "C5 9 3 -80 1 90".repeat(500_000)))),
        ("a star", svg(&format!("<path stroke='#000' d='{}'/>", "M5 5L9 9M5.0000001 5L1 9".repeat(100_000)))),
        ("ends that crowd", svg(&format!("<g stroke='#000'><path d='{}'/></g>", (0..60_000).map(|k| format!("M1e9 {k}e-9L1000000001 {k}")).collect::<String>()))),
        ("entities", "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'><!ENTITY c '&b;&b;&b;&b;&b;&b;&b;'>]><svg><path d='&c;'/></svg>".to_owned()),
    ]
}

/// Tables and drawings of other kinds.
fn others() -> Vec<(&'static str, String)> {
    let entities = |content: &str| format!("0\nSECTION\n2\nENTITIES\n{content}0\nENDSEC\n0\nEOF\n");
    let spline = format!("0\nSPLINE\n71\n25\n{}{}", "40\n0\n40\n1\n".repeat(100_000), "10\n0\n20\n1\n".repeat(100_000));
    vec![
        ("a long table", "1,2\n".repeat(2 * 1024 * 1024)),
        ("a long line", "1,".repeat(4 * 1024 * 1024)),
        ("a long line of blanks", "1 ".repeat(4 * 1024 * 1024)),
        ("many columns", format!("{}\n", "1,".repeat(40)).repeat(99_000)),
        ("quotes", "\"".repeat(8 * 1024 * 1024)),
        ("blank lines", "\n".repeat(8 * 1024 * 1024)),
        ("names", format!("{}\n1,2\n", "x,y,".repeat(100_000))),
        ("names again and again", "x,y\n1,2\n".repeat(50_000)),
        ("numbers", "1e300,1e-300\n-1e300,1e300\n0,5\n1,2\n3,4\n5,6\n".to_owned()),
        ("nested JSON", "[".repeat(1_000_000)),
        ("JSON", format!("[{}[1,2]]", "[1,2],".repeat(1_000_000))),
        ("lines of DXF", entities(&"0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n".repeat(200_000))),
        ("circles of DXF", entities(&"0\nCIRCLE\n10\n0\n20\n0\n40\n1\n".repeat(200_000))),
        ("a spline", entities(&spline)),
        (
            "extreme DXF",
            entities("0\nELLIPSE\n10\n1e300\n20\n0\n11\n1e-300\n21\n1e300\n40\n1e-300\n41\n-1e300\n42\n1e300\n"),
        ),
        (
            "a bulge",
            entities("0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n42\n1e300\n10\n1\n20\n0\n42\n1e-300\n10\n5\n20\n5\n"),
        ),
    ]
}

#[test]
fn small_files_end_with_a_path_or_a_problem() {
    for (name, text) in drawings().into_iter().chain(others()).filter(|(_, text)| text.len() < 10_000) {
        match read(&text) {
            Ok(outline) => assert!(outline.points.iter().all(|p| p.x.is_finite() && p.y.is_finite()), "{name}"),
            Err(problem) => assert!(!problem.is_empty(), "{name}"),
        }
    }
}

/// Under a limit of 400 MB of memory, and of ten seconds.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "thorough"]
fn no_file_takes_all_memory_or_all_time() {
    use crate::support::command::{result, shell};
    let folder = TempDir::new().unwrap();
    for (name, text) in drawings().into_iter().chain(others()) {
        fs::write(folder.path().join("path"), &text).unwrap();
        let script = "ulimit -v 400000; ulimit -t 10; exec \"$0\" find path --index 100 --no-refine --jobs 1 --json";
        let (code, _, error) = result(shell(folder.path(), script).output().unwrap());
        assert!(code == 0 || code == 2 && error.contains("error: path: "), "{name}: {code}: {error}");
    }
}
