//! The page of the gallery reads files as `find` does: the same points, and the same words.

use coupler_atlas::find::{ReadOptions, parse_outline};
use coupler_kernel::Kernel;
use serde_json::{Value, json};

/// What the kernel reads of a file, as the page asks for it: the points, whether it is closed and what was taken, or what is wrong.
fn read_on_page(bytes: &[u8], outline: Option<&str>) -> Result<(Vec<[f64; 2]>, bool, String), String> {
    let numbers: Vec<f64> = bytes.iter().map(|byte| f64::from(*byte)).collect();
    let request = json!({ "method": "read_path", "bytes": { "$": [0, numbers.len()] }, "outline": outline });
    let response = Kernel::default().call_with_numbers(&request.to_string(), &numbers);
    let value: Value = serde_json::from_str(&response.json).unwrap();
    if let Some(error) = value["error"].as_str() {
        return Err(error.to_owned());
    }
    let taken = value["taken"].as_str().unwrap().to_owned();
    Ok((response.numbers.as_chunks().0.to_vec(), value["closed"].as_bool().unwrap(), taken))
}

/// The same by `find`, with the page's word for its option.
fn read_by_find(bytes: &[u8], outline: Option<&str>) -> Result<(Vec<[f64; 2]>, bool, String), String> {
    let options = ReadOptions { outline, outline_option: "outline ", ..ReadOptions::default() };
    let mut read = parse_outline(bytes, &options).map_err(|problems| problems.join("\n"))?;
    let is_closed = read.decide_closed();
    Ok((read.points.iter().map(|p| [p.x, p.y]).collect(), is_closed, read.reading.taken))
}

#[test]
fn the_page_reads_files_as_find_does() {
    let two = "<svg><path id='a' d='M0 0H4V3' stroke='red' fill='none'/><circle r='9' cx='40'/></svg>";
    let dxf = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n1.0\n20\n2.0\n40\n3.0\n0\nENDSEC\n0\nEOF\n";
    let samples: [(&[u8], Option<&str>); 17] = [
        (include_bytes!("../../../examples/sketch.svg"), None),
        (include_bytes!("../../../output/evans/evans-001.svg"), None),
        (include_bytes!("../../../output/evans/points.csv"), None),
        (include_bytes!("../../../output/evans/points.csv"), Some("3.1.1")),
        (two.as_bytes(), None),
        (two.as_bytes(), Some("2")),
        (two.as_bytes(), Some("b")),
        (dxf.as_bytes(), None),
        (b"M0 0C10 30 40 30 50 0S80-20 90 10", None),
        (b"<g transform='rotate(90)'><ellipse rx='4' ry='2'/></g>", None),
        (b"x;y\n1,5;2\n3,25;4\n2;6", None),
        (b"angle\xb0;x;y\n0;1;2\n90;3;4\n180;1;6", None),
        (b"{\"points\": [[0, 0], [3, 1], [4, 4]], \"closed\": true}", None),
        (b"hello\nthere", None),
        (b"[[1, 2], [3, null]]", None),
        (b"<svg><path d='M0 0L1 x'/></svg>", None),
        (b"1,2\n3,z\n4", None),
    ];
    let mut read = 0;
    for (bytes, outline) in samples {
        let found = read_by_find(bytes, outline);
        read += usize::from(found.is_ok());
        assert_eq!(read_on_page(bytes, outline), found, "{}", String::from_utf8_lossy(bytes));
    }
    assert_eq!(read, 11, "the others have problems");
}

#[test]
fn pieces_of_drawings_are_drawings() {
    let whole = read_by_find(b"<svg><path d='M1 2H5V4Z' stroke='black'/></svg>", None).unwrap();
    assert_eq!(read_by_find(b" M1 2H5V4Z\n", None).unwrap(), whole);
    assert_eq!(read_by_find(b"<path d='M1 2H5V4Z' stroke='black'/>", None).unwrap(), whole);
    let group =
        read_by_find(b"<!-- a sketch --><g transform='translate(1)'><path d='M0 2H4V4Z' stroke='black'/></g>", None);
    assert_eq!(group.unwrap(), whole);
    assert!(read_by_find(b"M0 0Q", None).unwrap_err().contains("the path `M0 0Q` cannot be read"));
    assert!(read_by_find(b"<p>hello</p>", None).unwrap_err().contains("it has no <svg>"));
}
