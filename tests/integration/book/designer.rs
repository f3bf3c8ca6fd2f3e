//! What a designer finds curves by in a book: charts, lists, thumb index, folios and links, compared with the tables.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::sync::LazyLock;

use super::reader::{Contents, Pdf, PolylineMm};
use crate::support::folder::Atlas;
use crate::support::table::{self, Row};

const MANIFEST: &str = r#"
[atlas]
title = "Rockers"
output = "out"
formats = ["pdf"]
[book]
[[book.list]]
title = "Straightest"
where = "mu_worst_deg >= 20"
sort = "-straight_length"
caption = "over {straight_length:.4}"
count = 12
per_geometry = 2
[[book.list]]
title = "Returns"
where = "time_ratio > 1.2"
sort = "-time_ratio"
caption = "ratio {time_ratio:.4}"
[[book.list]]
title = "Table"
where = "mu_worst_deg >= 20"
sort = "-straight_10_length"
columns = ["stroke: {straight_10_length:.3}", "over: {straight_10_input_deg:.1}°"]
count = 200
per_geometry = 15
[[book.list]]
title = "None at all"
where = "mu_worst_deg > 91"
sort = "length"
[[family]]
id = "grid"
linkage = "points"
title = "Points"
layout = "coupler-grid"
sampling = { samples = 36 }
grid = { A = [2, 2.5, 3], B = [2.5, 3, 3.5], C = [2, 2.5, 3] }
where = "is_crank_rocker or is_change_point"
[[linkage]]
id = "points"
parameters = { A = { min = 0 }, B = { min = 0 }, C = { min = 0 } }
caption = "A = {A:.1} B = {B:.1} C = {C:.1}"
trace = ["M"]
continuation = "branch"
[linkage.joints]
O = { fixed = [0, 0] }
Q = { fixed = ["C", 0] }
P = { crank = "O", length = 1 }
R = { dyad = ["P", "Q"], lengths = ["A", "B"], side = "left" }
M = { point = ["P", "R"], along = { from = 0, to = "A", count = 3 }, across = { from = -1, to = 1, count = 5 } }
"#;

/// The texts of a page whose start is in a rectangle of a link, in points.
fn texts_in(pdf: &Pdf, page: usize, [left, bottom, right, top]: [f64; 4]) -> Vec<String> {
    let mm = |points: f64| points * 25.4 / 72.0;
    let inside = |at: &[f64; 2]| {
        at[0] > mm(left) - 1e-3 && at[0] < mm(right) && at[1] > mm(792.0 - top) && at[1] < mm(792.0 - bottom) + 1e-3
    };
    pdf.contents(page).texts.into_iter().filter(|(_, at, _)| inside(at)).map(|(text, ..)| text).collect()
}

/// The book of the manifest, made once for all tests.
struct Book {
    pdf: Pdf,
    /// Its index of parts: titles with the indices of their pages.
    parts: BTreeMap<String, usize>,
    /// The rows of `cells.csv`.
    rows: Vec<Row>,
}

static BOOK: LazyLock<Book> = LazyLock::new(|| {
    let atlas = Atlas::rendered(MANIFEST, &[]);
    let pdf = Pdf::read(&fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let parts = pdf.outline().into_iter().filter(|entry| entry.0 == 0).map(|(_, title, page)| (title, page)).collect();
    Book { pdf, parts, rows: table::rows(&atlas.read("grid/cells.csv")) }
});

fn number(row: &Row, name: &str) -> f64 {
    row[name].parse().unwrap_or(f64::NAN)
}

#[test]
#[ignore = "thorough"]
fn lists_have_the_best_curves_of_the_tables() {
    let Book { pdf, parts, rows } = &*BOOK;
    assert!(!parts.contains_key("None at all"), "a list without entries has no pages");
    let mut rows = rows.clone();
    rows.retain(|row| number(row, "mu_worst_deg") >= 20.0 && number(row, "straight_length") > 0.0);
    rows.sort_by(|a, b| number(b, "straight_length").total_cmp(&number(a, "straight_length")));
    let mut taken: BTreeMap<String, usize> = BTreeMap::new();
    rows.retain(|row| {
        let count = taken.entry(row["cell"].clone()).or_default();
        *count += 1;
        *count <= 2
    });
    let expected: Vec<String> =
        rows.iter().take(12).map(|row| format!("over {:.4}", number(row, "straight_length"))).collect();
    let first = parts["Straightest"];
    let pages = first..parts["Returns"];
    let mut found = Vec::new();
    for page in pages {
        // Links of the thumb index lead out of the page, too; those of entries are in order.
        for (corners, to) in pdf.links(page) {
            let texts = texts_in(pdf, page, corners);
            let Some(said) = texts.iter().find(|text| text.starts_with("over ")) else { continue };
            let row = &rows[found.len()];
            let number = texts.iter().find_map(|text| text.strip_prefix("page ")).unwrap();
            assert_eq!(pdf.labels()[to], format!("<</Type/PageLabel/S/D/St{number}>>"));
            // The plate shows the linkage and the point.
            let plate: String = pdf.contents(to).texts.into_iter().map(|(text, ..)| text + " ").collect();
            let point = format!("point {}", row["trace"]);
            assert!(texts.contains(&point), "{texts:?} {point}");
            for name in ["A", "B", "C"] {
                let value = format!(" = {:.1}", number_of(row, name));
                assert!(plate.contains(&value), "{plate} {value}");
            }
            assert!(plate.split(' ').any(|word| word == row["trace"]), "{plate}");
            found.push(said.clone());
        }
    }
    assert_eq!(found, expected);
}

/// A table has a line for each curve, its values first, and the contents have the range of each of its pages.
#[test]
#[ignore = "thorough"]
fn tables_have_their_values_in_order_and_the_contents_their_ranges() {
    let Book { pdf, parts, rows } = &*BOOK;
    let mut rows = rows.clone();
    let length = |row: &Row| number(row, "straight_10_length");
    rows.retain(|row| number(row, "mu_worst_deg") >= 20.0 && length(row) > 0.0);
    rows.sort_by(|a, b| length(b).total_cmp(&length(a)));
    let expected: Vec<String> = rows.iter().take(200).map(|row| format!("{:.3}", length(row))).collect();
    assert_eq!(expected.len(), 200);
    let pages: Vec<Contents> = (parts["Table"]..parts["Index of geometries"]).map(|page| pdf.contents(page)).collect();
    let is_stroke =
        |text: &&str| text.split_once('.').is_some_and(|(_, decimals)| decimals.len() == 3 && !decimals.contains('°'));
    let strokes =
        |page: &Contents| -> Vec<String> { words(page).into_iter().filter(is_stroke).map(str::to_owned).collect() };
    assert_eq!(pages.iter().flat_map(strokes).collect::<Vec<_>>(), expected);
    assert!(pages.iter().all(|page| words(page).contains(&"stroke") && words(page).contains(&"over")));
    let contents = pdf.contents(parts["Contents"]);
    for page in pages.iter().map(strokes) {
        let range = format!("stroke {} to {}", page[0], page.last().unwrap());
        assert!(pages.len() == 1 || words(&contents).contains(&range.as_str()), "{range} {:?}", words(&contents));
    }
}

fn number_of(row: &BTreeMap<String, String>, name: &str) -> f64 {
    number(row, name)
}

#[test]
#[ignore = "thorough"]
fn every_geometry_is_on_a_finding_chart_with_its_pages() {
    let Book { pdf, parts, rows } = &*BOOK;
    let charts: Vec<(String, usize)> = pdf
        .outline()
        .into_iter()
        .filter(|entry| entry.0 == 1 && entry.1.starts_with("C = "))
        .map(|(_, title, page)| (title, page))
        .collect();
    assert_eq!(charts.iter().map(|(title, _)| title.as_str()).collect::<Vec<_>>(), ["C = 2", "C = 2.5", "C = 3"]);
    assert_eq!(parts["Finding charts"], charts[0].1);
    let cells: BTreeSet<String> = rows.iter().map(|row| row["cell"].clone()).collect();
    let mut linked = BTreeSet::new();
    for (title, page) in &charts {
        for (corners, to) in pdf.links(*page) {
            let texts = texts_in(pdf, *page, corners);
            // The marks of the thumb index have no page.
            let page_of = |text: &String| text.strip_prefix("page ")?.parse::<usize>().ok();
            let Some(number) = texts.iter().find_map(page_of) else { continue };
            assert_eq!(pdf.labels()[to], format!("<</Type/PageLabel/S/D/St{number}>>"));
            let plate: String = pdf.contents(to).texts.into_iter().map(|(text, ..)| text).collect();
            let value: f64 = title.strip_prefix("C = ").unwrap().parse().unwrap();
            assert!(plate.contains(&format!("= {value:.1}")), "{title}: {number} {texts:?} {corners:?} {to} {plate}");
            assert!(linked.insert(number), "{number} is there twice");
        }
    }
    // Fifteen points are on two pages.
    assert_eq!(linked, (1..=2 * cells.len()).collect());
}

fn words(contents: &Contents) -> Vec<&str> {
    contents.texts.iter().map(|(text, ..)| text.as_str()).collect()
}

/// Charts have every curve of the book, with its point, at the scale of the bar of its linkage, which is its crank.
#[test]
#[ignore = "thorough"]
fn charts_have_all_curves_with_their_points_and_scales_and_captions_of_cases() {
    let Book { pdf, parts, rows } = &*BOOK;
    let charts: Vec<usize> =
        pdf.outline().into_iter().filter(|entry| entry.0 == 1 && entry.1.starts_with("C = ")).map(|e| e.2).collect();
    assert_eq!(parts["Finding charts"], charts[0]);
    let extent = |lines: &[PolylineMm]| {
        let across = |k: usize| {
            let at = || lines.iter().flatten().map(|point| point[k]);
            at().fold(f64::NEG_INFINITY, f64::max) - at().fold(f64::INFINITY, f64::min)
        };
        across(0).max(across(1))
    };
    let (mut drawn, mut cranks) = (Vec::new(), 0);
    for &page in &charts {
        let contents = pdf.contents(page);
        cranks += words(&contents).iter().filter(|text| **text == "crank").count();
        let mut crank = f64::NAN;
        for (lines, ..) in &contents.paths {
            // A bar is a line with its ends; curves have many points, lines between cells and the border few.
            let is_bar = lines.len() == 3 && lines.iter().all(|line| line.len() == 2);
            crank = if is_bar { extent(lines) } else { crank };
            drawn.extend(lines.iter().any(|line| line.len() > 8).then(|| extent(lines) / crank));
        }
    }
    let cells: BTreeSet<&String> = rows.iter().map(|row| &row["cell"]).collect();
    assert_eq!(cranks, cells.len());
    let side =
        |row: &Row, axis: &str| number(row, &format!("bbox_{axis}_max")) - number(row, &format!("bbox_{axis}_min"));
    let mut expected: Vec<f64> = rows.iter().map(|row| side(row, "x").max(side(row, "y"))).collect();
    drawn.sort_by(f64::total_cmp);
    expected.sort_by(f64::total_cmp);
    assert_eq!(drawn.len(), expected.len());
    // The control points of the splines are a little outside.
    assert!(drawn.iter().zip(&expected).all(|(a, b)| (a / b - 1.0).abs() < 0.1), "{drawn:?} {expected:?}");
    let points: BTreeSet<&str> = ["1", "7", "15"].into();
    let contents = pdf.contents(charts[0]);
    assert!(points.iter().all(|point| words(&contents).contains(point)), "{:?}", words(&contents));
    let cases = Atlas::new(
        "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"pdf\"]\n[book]\nfinding_charts = true\n[[book.list]]\ntitle = \"Long\"\n\
         sort = \"-length\"\n[[family]]\nid = \"evans\"\nlinkage = \"evans\"\nsampling = { samples = 24 }\npanels = [2, 1]\n\
         cases = [{ p = 2, a = 2.6 }, { p = 3, a = 4 }, { p = 4, a = 5.6 }]\ncaption = \"p = {p}, a = {a}\"",
    );
    let (code, _, err) = cases.run(&[]);
    assert_eq!((code, err.contains("warning")), (0, false), "{err}");
    let pdf = Pdf::read(&fs::read(cases.out().join("atlas.pdf")).unwrap());
    let find = |title: &str| pdf.outline().into_iter().find(|(_, name, _)| name == title).unwrap().2;
    let chart: Vec<String> = pdf.contents(find("Finding charts")).texts.into_iter().map(|(text, ..)| text).collect();
    let chart = chart.join(" ").replace("  ", " ");
    for caption in ["p = 2, a = 2.6", "p = 3, a = 4", "p = 4, a = 5.6"] {
        let squeezed = |text: &str| text.replace(' ', "");
        assert!(squeezed(&chart).contains(&squeezed(caption)), "{chart}");
    }
    let list: Vec<String> = pdf.contents(find("Long")).texts.into_iter().map(|(text, ..)| text).collect();
    let figures: Vec<&String> = list.iter().filter(|text| text.starts_with("page ")).collect();
    assert_eq!(figures.len(), 3, "{list:?}");
    assert!(figures.iter().any(|text| *text == "page 2, figure 3"), "{figures:?}");
}

#[test]
fn finding_charts_and_contents_have_names_as_printed_units_and_what_varies() {
    let book = Atlas::new(
        "[atlas]\ntitle = \"T^2\"\noutput = \"out\"\nformats = [\"pdf\"]\n[page]\npaper = { width = \"105 mm\", height = \"148 mm\" }\n\
         [book]\nfinding_charts = true\nlist = []\nindex = false\n\
         [[family]]\nid = \"turned\"\nlinkage = \"turned\"\nsampling = { samples = 24 }\npanels = [1, 1]\n\
         grid = { foot_along = [3, 3.5], phi = [10, \"0.5 rad\"] }\n\
         [[family]]\nid = \"evans\"\nlinkage = \"evans\"\nsampling = { samples = 24 }\npanels = [1, 1]\n\
         cases = [{ p = 2, k = 1.5 }, { p = 3, k = 2 }, { p = 4, k = 2 }]\nlet = { a = \"(1 + p)^1.5 / 2\" }\n\
         caption = \"frame p = {p}, coupler and rocker of this linkage a = {a:.4}, the coupler point is at k = {k} times a, from there\"\n\
         [[family]]\nid = \"alone\"\nlinkage = \"klann\"\nsampling = { samples = 24 }\ncases = [{}]\n\
         [[linkage]]\nid = \"turned\"\nparameters = { foot_along = { default = 3 }, phi = { default = 0, kind = \"angle\", unit = \"deg\" } }\n\
         trace = [\"M\"]\n[linkage.joints]\nO = { fixed = [0, 0] }\nC = { fixed = [\"foot_along\", 0] }\n\
         A = { crank = \"O\", length = 1 }\nB = { dyad = [\"A\", \"C\"], lengths = [3, 3], side = \"left\" }\n\
         M = { point = [\"A\", \"B\"], along = \"cos(rad(phi))\", across = 1 }\n",
    );
    let (code, _, err) = book.run(&[]);
    assert_eq!(code, 0, "{err}");
    let pdf = Pdf::read(&fs::read(book.out().join("atlas.pdf")).unwrap());
    let find = |title: &str| pdf.outline().into_iter().find(|(_, name, _)| name == title).unwrap().2;
    let said = |page: usize| -> String {
        let texts: Vec<String> = pdf.contents(page).texts.into_iter().map(|(text, ..)| text).collect();
        texts.concat().replace(' ', "")
    };
    // The sample of a plate is smaller than the paper, and says nothing of what its own paper would need to be.
    assert!(!said(find("How to read this book")).contains("thekeyisleftout"));
    let chart = find("Finding charts");
    for label in ["footalong=3.5", "phi=10°", "phi≈28.6479°"] {
        assert!([find("Contents"), chart].iter().all(|page| said(*page).contains(label)), "{label}: {}", said(chart));
    }
    // A family of a single cell has no dimensions that it is told by, and no entry of its own.
    assert!(pdf.outline().iter().all(|(_, title, _)| !title.is_empty()), "{:?}", pdf.outline());
    let cases = said(chart + 1);
    assert!(cases.contains("p=2,k=1.5") && cases.contains("p=4,k=2") && !cases.contains("coupler"), "{cases}");
}

#[test]
#[ignore = "thorough"]
fn every_page_has_one_number_at_its_outer_corner_and_marks_of_the_thumb_index() {
    let Book { pdf, parts, .. } = &*BOOK;
    let labels = pdf.labels();
    let front = labels.iter().position(|label| label.contains("/S/D")).unwrap();
    assert!(front % 2 == 0, "the first plate is a right-hand page");
    let tabs = ["A = 2", "A = 2.5", "A = 3", "change points", "lists", "index"];
    for page in front..labels.len() {
        let contents = pdf.contents(page);
        let folio = (page - front + 1).to_string();
        let below: Vec<_> = contents.texts.iter().filter(|(_, at, _)| at[1] > 273.0).collect();
        assert_eq!(below.iter().map(|(text, ..)| text.as_str()).collect::<Vec<_>>(), [&folio], "page {page}");
        assert_eq!(below[0].1[0] > 215.9, page % 2 == 0, "outer corner of page {page}");
        let outside = |at: &[f64; 2]| if page % 2 == 0 { at[0] > 424.0 } else { at[0] < 7.8 };
        let marks = contents.texts.iter().filter(|(_, at, _)| outside(at) && at[1] < 273.0);
        assert_eq!(marks.map(|(text, ..)| text.as_str()).collect::<Vec<_>>(), tabs, "page {page}");
    }
    // Marks are links to the first page of each part.
    let first_links: BTreeSet<usize> = pdf.links(front).into_iter().map(|(_, to)| to).collect();
    assert!(first_links.contains(&parts["Points: change points"]), "{first_links:?} {parts:?}");
    assert!(first_links.contains(&parts["Straightest"]) && first_links.contains(&parts["Index of geometries"]));
}

#[test]
#[ignore = "thorough"]
fn what_is_said_of_plates_is_right_for_the_atlas() {
    let Book { pdf, parts, .. } = &*BOOK;
    let said = |pdf: &Pdf, page: usize| -> String {
        pdf.contents(page).texts.into_iter().map(|(text, ..)| text + " ").collect()
    };
    let first = parts["How to read this book"];
    assert_eq!(first % 2, 1, "the two pages face each other");
    let text = said(pdf, first + 1);
    assert!(text.contains("The table") && text.contains("5° of input") && text.contains("grid:"), "{text}");
    assert!(text.contains("Straightest, page"), "{text}");
    // The name of the curve is one that can be exported.
    let name = text.split_once("such as ").unwrap().1.split(' ').next().unwrap();
    let name = coupler_curves::exchange::CurveName::parse(name).unwrap();
    assert!(name.family == "grid" && name.curve.is_some(), "{name}");
    let panels = Atlas::new(
        "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"pdf\"]\n[page]\ndash = \"10 deg\"\n[[family]]\nid = \"evans\"\n\
         linkage = \"evans\"\nsampling = { samples = 24 }\npanels = [2, 1]\ngrid = { p = [2, 3, 4] }\nlet = { a = \"(1 + p)^1.5 / 2\" }",
    );
    assert_eq!(panels.run(&[]).0, 0);
    let pdf = Pdf::read(&fs::read(panels.out().join("atlas.pdf")).unwrap());
    let text = said(&pdf, 2);
    assert!(text.contains("10° of input") && text.contains("in the caption of its figure"), "{text}");
    assert!(!text.contains("The table") && !text.contains("The grid") && !text.contains("speed"), "{text}");
}

#[test]
#[ignore = "thorough"]
fn a_book_is_the_same_whether_its_cells_are_measured_with_the_tables_or_for_it() {
    let atlas = Atlas::rendered(MANIFEST, &["--jobs", "1"]);
    let whole = fs::read(atlas.out().join("atlas.pdf")).unwrap();
    // The tables are up to date, so that only the book is made.
    fs::remove_file(atlas.out().join("atlas.pdf")).unwrap();
    let (code, out, err) = atlas.run(&["--jobs", "3"]);
    assert!(code == 0 && out.contains("(unchanged)"), "{out}{err}");
    assert!(fs::read(atlas.out().join("atlas.pdf")).unwrap() == whole);
}

#[test]
#[ignore = "thorough"]
fn what_the_manifest_leaves_out_is_not_in_the_book() {
    let keys = "[book]\nhow_to_read = false\nfinding_charts = false\nthumb_index = false\nindex = false\nlist = []\nchapter = []\n";
    let (begin, rest) = MANIFEST.split_once("[book]").unwrap();
    let families = &rest[rest.find("[[family]]").unwrap()..];
    let atlas = Atlas::new(&[begin, keys, families].concat());
    assert_eq!(atlas.run(&[]).0, 0);
    let pdf = Pdf::read(&fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let parts: Vec<String> =
        pdf.outline().into_iter().filter(|entry| entry.0 == 0).map(|(_, title, _)| title).collect();
    assert_eq!(parts, ["Rockers", "Contents", "Points"]);
}

#[test]
fn mistakes_in_the_table_are_reported_at_their_places() {
    let problems = |book: &str| -> Vec<(String, String)> {
        let text = MANIFEST.replacen("[book]", book, 1);
        let loaded = coupler_atlas::manifest::parse(&text);
        let place = |problem: &coupler_curves::problem::Problem| text[problem.span.clone()].to_owned();
        loaded.problems.iter().map(|problem| (problem.message.clone(), place(problem))).collect()
    };
    let problem = |message: &str, place: &str| (message.to_owned(), place.to_owned());
    assert_eq!(problems("[book]"), []);
    let quoted = "[book]\nfinding_charts = \"yes\"";
    assert!(problems(quoted)[0].0.contains("boolean"), "{:?}", problems(quoted));
    let unknown = "[book]\n[[book.list]]\ntitle = \"T\"\nsort = \"-strait_length\"";
    assert_eq!(problems(unknown), [problem("unknown name `strait_length`", "strait_length")]);
    assert_eq!(
        problems("[book]\nfinding_chart = true"),
        [problem("[book] has no key `finding_chart`", "finding_chart")]
    );
    let chapter = "[book]\n[[book.chapter]]\ntitle = \"T\"\nwhere = \"A + 1\"";
    assert_eq!(problems(chapter), [problem("expected a condition, found a numeric expression", "A +")]);
    let caption = "[book]\n[[book.list]]\ntitle = \"T\"\nsort = \"A\"\ncaption = \"{aera:.2}\"\ncount = 0";
    assert_eq!(problems(caption).len(), 2, "{:?}", problems(caption));
    assert!(problems("[book]\n[[book.list]]\nsort = \"A\"")[0].0.contains("has no `title`"));
    let blank = "[book]\n[[book.list]]\ntitle = \" \"\nsort = \"A\"\n[[book.chapter]]\ntitle = \"\"\nwhere = \"A > 2\"";
    let reported: Vec<String> = problems(blank).into_iter().map(|(message, _)| message).collect();
    assert_eq!(reported, ["the title is blank"; 2]);
    let repeated = "[book]\n[[book.list]]\ntitle = \"Returns\"\nsort = \"A\"";
    assert_eq!(problems(repeated), [problem("another list has the title `Returns`", "\"Returns\"")]);
    let long = format!("[book]\n[[book.list]]\ntitle = \"T\"\nsort = \"A\"\nnote = \"{}\"", "word ".repeat(130));
    assert_eq!(problems(&long)[0].0, "the text has 650 characters, more than the limit of 600");
}

#[test]
fn remedies_name_the_table() {
    let remedy = |book: &str| -> String {
        let (begin, rest) = MANIFEST.split_once("[book]").unwrap();
        let text = [begin, book, &rest[rest.find("[[family]]").unwrap()..]].concat();
        let loaded = coupler_atlas::manifest::parse(&text);
        loaded.problems.first().map_or(String::new(), |problem| problem.help.clone())
    };
    assert_eq!(remedy("[book]\nlist = 3\n"), "write it as [[book.list]]");
    assert_eq!(remedy("[book.chapter]\ntitle = \"T\"\n"), "write it as [[book.chapter]]");
    assert_eq!(remedy("[[book]]\nindex = true\n"), "write it under [book], once");
}

/// A book in whose chapters are all cells, or none.
#[test]
#[ignore = "thorough"]
fn what_would_be_empty_is_left_out_with_a_warning() {
    let chapters = r#"[book]
[[book.chapter]]
title = "every one"
where = "A > 0"
[[book.chapter]]
title = "the rest"
where = "B > 0"
[[book.chapter]]
title = "very long ones"
where = "A > 100""#;
    let atlas = Atlas::new(&MANIFEST.replacen("[book]", chapters, 1));
    let (code, _, err) = atlas.run(&[]);
    assert_eq!(code, 0, "{err}");
    let warnings: Vec<&str> = err.lines().filter_map(|line| line.strip_prefix("warning: the ")).collect();
    let of_chapter = "of the book is left out: no cell meets its condition that is not in a chapter before it";
    assert_eq!(
        warnings,
        [
            format!("chapter `the rest` {of_chapter}"),
            format!("chapter `very long ones` {of_chapter}"),
            "list `None at all` of the book is left out: no curve meets its condition and has a value of its sort key"
                .to_owned(),
        ]
    );
    let pdf = Pdf::read(&fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let (_, _, first) =
        pdf.outline().into_iter().find(|(level, title, _)| *level == 0 && title == "Points: every one").unwrap();
    // The pages of a chapter have its title.
    let plate: String = pdf.contents(first).texts.into_iter().map(|(text, ..)| text + " ").collect();
    assert!(plate.contains("Points: every one"), "{plate}");
}

/// Lists and contents state what tells linkages apart, also where the caption of the linkage does not.
#[test]
fn captions_are_as_complete_as_on_the_plates() {
    let manifest = r#"
[atlas]
title = "Evans"
output = "out"
formats = ["pdf"]
[[family]]
id = "evans"
linkage = "evans"
grid = { p = [3, 4], k = [1.5, 2] }
let = { a = "(1 + p)^1.5 / 2" }
"#;
    let atlas = Atlas::new(manifest);
    let (code, _, err) = atlas.run(&[]);
    assert_eq!(code, 0, "{err}");
    let pdf = Pdf::read(&fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let outline = pdf.outline();
    let linkages: BTreeSet<&String> =
        outline.iter().filter(|(level, ..)| *level == 1).map(|(_, title, _)| title).collect();
    assert!(
        linkages.len() >= 4 && linkages.iter().filter(|title| title.contains("k = 1.5")).count() >= 2,
        "{linkages:?}"
    );
}
