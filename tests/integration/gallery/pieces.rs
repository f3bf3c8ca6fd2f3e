//! The data of a family in pieces.

use std::fs;

use coupler_atlas::gallery::{
    CellData, DataFile, FamilyScript, MAX_PIECE_BYTES, MAX_SINGLE_FILE_BYTES, OpenPiece, PieceContent, PieceIndex,
    PieceSeries, PieceWriter, is_data_file_name, parse_piece_file_name, piece_file_name,
};

use crate::support::folder::{Atlas, check_record, files, times};
use crate::support::plan::plan;

/// A family whose data are larger than a single file: 2,000 curves of 128 points.
const LARGE: &str = r#"[atlas]
title = "Large"
output = "out"
[[family]]
id = "large"
linkage = "evans"
panels = [36, 9]
sampling = { samples = 128 }
measures = ["class", "length"]
grid = { p = { from = 2, to = 4, count = 50 }, k = { from = 1, to = 2, count = 40 } }
let = { a = "(1 + p)^1.5 / 2" }
"#;

/// Some cells whose statements have these sizes.
fn cells(first: usize, count: usize, [table, curves]: [usize; 2]) -> CellData {
    let value = first as f64 / 2.0;
    let content = PieceContent {
        cells: count,
        curves: 2 * count,
        pages: 0,
        numbers: Some([first, first + count - 1]),
        traces: 2,
        ranges: vec![[value, value + 0.25]],
    };
    CellData { table: "t".repeat(table), curves: "c".repeat(curves), content }
}

/// The files of a run with ten groups of cells, each with a page; after `stop` groups, the writer is replaced by one
/// with what can be stored of its state.
fn written(script: FamilyScript, stop: usize) -> Vec<DataFile> {
    let mut writer = PieceWriter::new(script);
    let mut files = Vec::new();
    for group in 0..10 {
        if group == stop {
            let stored = serde_json::to_string(&writer.finished).unwrap();
            let open = writer.open.clone().map(|OpenPiece { statements, content }| {
                let content: PieceContent = serde_json::from_str(&serde_json::to_string(&content).unwrap()).unwrap();
                OpenPiece { statements, content }
            });
            writer = PieceWriter::new(script);
            writer.finished = serde_json::from_str(&stored).unwrap();
            writer.open = open;
        }
        files.extend(writer.add_cells(&cells(1 + 100 * group, 100, [300_000, 1_500_000])));
        files.extend(writer.add_page("page"));
    }
    files.extend(writer.finish());
    files
}

#[test]
fn names_of_pieces_are_read_as_they_are_written() {
    for series in PieceSeries::ALL {
        for number in [1, 42, 9999, 12345] {
            let name = piece_file_name(series, number);
            assert_eq!(parse_piece_file_name(&name), Some((series, number)));
            assert!(is_data_file_name(&name));
        }
    }
    assert!(is_data_file_name("gallery.js"));
    for other in ["gallery-table-0000.js", "gallery-table-1.js", "gallery-table-00001.js", "gallery-other-0001.js"] {
        assert!(!is_data_file_name(other), "{other}");
    }
    for other in ["gallery-table-0001.js.part", "gallery-0001.js", "gallery-table-+001.js", "../gallery-table-0001.js"]
    {
        assert!(!is_data_file_name(other), "{other}");
    }
}

#[test]
fn pieces_are_bounded_and_the_head_has_their_index() {
    let plan = plan(LARGE);
    let script = FamilyScript::new(&plan, &plan.families[0]);
    let files = written(script, usize::MAX);
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let curves = |number| piece_file_name(PieceSeries::Curves, number);
    // Two groups of 1.5 MB are in a piece of points, and all groups of 0.3 MB in one of the table.
    let mut expected: Vec<String> = (1..=4).map(curves).collect();
    expected.extend([piece_file_name(PieceSeries::Table, 1), curves(5), "gallery.js".to_owned()]);
    assert_eq!(names, expected);
    assert!(files.iter().all(|file| file.text.len() < MAX_PIECE_BYTES + 200));
    let head = &files.last().unwrap().text;
    let begin = head.lines().next().unwrap().strip_prefix("couplerAtlas.begin(").unwrap().strip_suffix(");").unwrap();
    let pieces = &serde_json::from_str::<serde_json::Value>(begin).unwrap()["pieces"];
    let sizes: Vec<u64> = files[..4].iter().map(|file| file.text.len() as u64).collect();
    for (k, piece) in pieces["curves"].as_array().unwrap()[..4].iter().enumerate() {
        assert_eq!(piece["bytes"], sizes[k]);
        assert_eq!([&piece["cells"], &piece["curves"], &piece["pages"]], [200, 400, 2]);
        assert_eq!(piece["numbers"], serde_json::json!([200 * k + 1, 200 * k + 200]));
    }
    let table = &pieces["table"][0];
    assert_eq!([&table["cells"], &table["curves"], &table["traces"]], [1000, 2000, 2]);
    assert_eq!(table["ranges"], serde_json::json!([[0.5, 450.75]]));
}

#[test]
fn a_writer_that_is_resumed_writes_the_same_files() {
    let plan = plan(LARGE);
    let script = FamilyScript::new(&plan, &plan.families[0]);
    let whole = written(script, usize::MAX);
    for stop in 0..10 {
        assert_eq!(written(script, stop), whole, "stopped before group {stop}");
    }
}

#[test]
fn an_index_is_stored_to_the_last_bit() {
    for value in [0.1 + 0.2, 1.0 / 3.0, -0.0, f64::MIN_POSITIVE, 1e300, 5e-324] {
        let content = PieceContent { ranges: vec![[value, value]], ..PieceContent::default() };
        let index = PieceIndex { series: PieceSeries::Table, bytes: 1, content };
        let text = serde_json::to_string(&index).unwrap();
        let read: PieceIndex = serde_json::from_str(&text).unwrap();
        assert_eq!(read.content.ranges[0].map(f64::to_bits), [value.to_bits(); 2], "{text}");
        assert_eq!(read, index);
    }
}

#[test]
#[ignore = "thorough"]
fn a_large_family_is_written_checked_and_cleaned_up_in_pieces() {
    let atlas = Atlas::new(LARGE);
    let run = |arguments: &[&str]| {
        let (code, _, err) = atlas.run(arguments);
        assert_eq!(code, 0, "{err}");
    };
    let data_files = || -> Vec<String> {
        files(&atlas.out().join("large")).into_iter().filter(|name| is_data_file_name(name)).collect()
    };
    run(&[]);
    check_record(&atlas.out());
    assert_eq!(data_files(), ["gallery-curves-0001.js", "gallery-table-0001.js", "gallery.js"]);
    let size = |name: &str| fs::metadata(atlas.out().join("large").join(name)).unwrap().len() as usize;
    assert!(size("gallery-curves-0001.js") > MAX_SINGLE_FILE_BYTES && size("gallery.js") < 10_000);
    let before = times(&atlas.out());
    run(&[]);
    assert_eq!(times(&atlas.out()), before);

    // A piece that was edited is found by `check`, and written again by the next run.
    let piece = atlas.out().join("large/gallery-table-0001.js");
    let text = fs::read(&piece).unwrap();
    fs::write(&piece, "edited").unwrap();
    let (code, found, err) = atlas.check(&[]);
    assert!(code == 1 && found.contains("gallery-table-0001.js"), "{found}{err}");
    run(&[]);
    assert_eq!(fs::read(&piece).unwrap(), text);
    assert_eq!(atlas.check(&[]).0, 0);

    // A family that has become small has a single file.
    atlas.edit(&LARGE.replace("count = 50", "count = 5"));
    run(&[]);
    assert_eq!(data_files(), ["gallery.js"]);
    check_record(&atlas.out());
}
