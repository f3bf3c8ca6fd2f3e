//! Sheets with a gutter and bleed.

use coupler_drawing::page::Layout;
use coupler_drawing::render::pdf::{Book, Sheet};
use coupler_drawing::scene::{Color, Group, Item, PageNumber, Path, Scene, group_class};

use super::reader::{Contents, Pdf};
use super::{line, path, scene};

use crate::support::folder::Atlas;
use crate::support::plan::{plan, problems};

/// A page with a line, and a mark of the thumb index at one of its edges.
fn page(mark_left: bool) -> Scene {
    let [left, right] = if mark_left { [0.0, 7.0] } else { [424.8, 431.8] };
    let mut mark = line(&[(left, 20.0), (right, 20.0), (right, 40.0), (left, 40.0)]);
    mark.is_closed = true;
    let mark = Item::Path(Path { polylines: vec![mark], stroke: None, fill: Some(Color(0, 0, 0)) });
    let tab = Item::Group(Group { class: group_class::TAB, items: vec![mark], ..Group::default() });
    scene(vec![path(vec![line(&[(100.0, 50.0), (120.0, 50.0)])]), tab])
}

/// The pages of a book on some sheets: the boxes in points, and what is drawn.
fn pages(sheet: Sheet) -> Vec<(String, Contents)> {
    let mut book = Book::new("A book", "a program").with_sheet(sheet);
    for (is_left, number) in [(false, 1), (true, 2)] {
        book.add_page(&page(is_left), PageNumber::Arabic(number)).unwrap();
    }
    let pdf = Pdf::read(&book.finish(&[]).unwrap());
    let dictionary = |page: usize| pdf.dictionary(pdf.pages()[page]).to_owned();
    (0..2).map(|page| (dictionary(page), pdf.contents(page))).collect()
}

/// A box of a page, in millimetres.
fn page_box(dictionary: &str, name: &str) -> Option<Vec<f64>> {
    let (_, rest) = dictionary.split_once(&format!("/{name}["))?;
    let numbers = rest.split(']').next()?.split(' ').map(|number| number.parse::<f64>().unwrap() * 25.4 / 72.0);
    Some(numbers.map(|mm| (1e3 * mm).round() / 1e3).collect())
}

/// The least and greatest x of a path of a page, by its place among the paths.
fn range(contents: &Contents, path: usize) -> [f64; 2] {
    let xs = contents.paths[path].0.iter().flatten().map(|point| point[0]);
    [xs.clone().fold(f64::INFINITY, f64::min), xs.fold(f64::NEG_INFINITY, f64::max)].map(|x| (1e2 * x).round() / 1e2)
}

#[test]
fn a_gutter_is_at_the_inner_edge_and_bleed_beyond_the_outer_ones() {
    let plain = pages(Sheet::default());
    let (dictionary, _) = &plain[0];
    assert_eq!(page_box(dictionary, "MediaBox"), Some(vec![0.0, 0.0, 431.8, 279.4]));
    assert!(!dictionary.contains("TrimBox") && !dictionary.contains("BleedBox"));

    let bound = pages(Sheet { binding: 12.0, bleed: 0.0 });
    for (k, (dictionary, contents)) in bound.iter().enumerate() {
        assert_eq!(page_box(dictionary, "MediaBox"), Some(vec![0.0, 0.0, 443.8, 279.4]));
        let shift = if k == 0 { 12.0 } else { 0.0 };
        assert_eq!(range(contents, 0), [0.0, 443.8], "the paper has the gutter's colour");
        assert_eq!(range(contents, 1), [100.0 + shift, 120.0 + shift]);
        // The mark is at the outer edge.
        assert_eq!(range(contents, 2), if k == 0 { [436.8, 443.8] } else { [0.0, 7.0] });
    }

    let bled = pages(Sheet { binding: 12.0, bleed: 3.0 });
    for (k, (dictionary, contents)) in bled.iter().enumerate() {
        assert_eq!(page_box(dictionary, "MediaBox"), Some(vec![0.0, 0.0, 449.8, 285.4]));
        assert_eq!(page_box(dictionary, "BleedBox"), Some(vec![0.0, 0.0, 449.8, 285.4]));
        assert_eq!(page_box(dictionary, "TrimBox"), Some(vec![3.0, 3.0, 446.8, 282.4]));
        let shift = if k == 0 { 15.0 } else { 3.0 };
        assert_eq!(range(contents, 0), [0.0, 449.8]);
        assert_eq!(range(contents, 1), [100.0 + shift, 120.0 + shift]);
        assert_eq!(range(contents, 2), if k == 0 { [439.8, 449.8] } else { [0.0, 10.0] });
    }
}

pub(super) const MANIFEST: &str = r#"
[atlas]
title = "Bound"
output = "out"
formats = ["pdf"]
[page]
paper = "a4"
[book]
how_to_read = false
index = false
list = []
binding = "12 mm"
bleed = "3 mm"
[[family]]
id = "evans"
linkage = "evans"
title = "Evans linkage"
scale = "4 mm"
panels = [2, 1]
sampling = { samples = 40 }
grid = { p = [2, 3, 4] }
let = { a = "(1 + p)^1.5 / 2" }
[[family]]
id = "hoeken"
linkage = "hoeken"
title = "Hoeken linkage"
panels = [1, 1]
sampling = { samples = 40 }
grid = { p = [2, 3] }
"#;

#[test]
fn a_bound_book_keeps_everything_out_of_its_gutter_and_its_scale() {
    let atlas = Atlas::rendered(MANIFEST, &[]);
    let pdf = Pdf::read(&std::fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let count = pdf.pages().len();
    assert!(count >= 6, "{count}");
    for page in 0..count {
        let dictionary = pdf.dictionary(pdf.pages()[page]);
        assert_eq!(page_box(dictionary, "TrimBox"), Some(vec![3.0, 3.0, 300.0, 213.0]));
        let contents = pdf.contents(page);
        let is_right_hand = page % 2 == 0;
        let [least, most] = if is_right_hand { [15.0, 303.0] } else { [0.0, 288.0] };
        // All but the paper.
        for path in 1..contents.paths.len() {
            let [left, right] = range(&contents, path);
            assert!(left >= least && right <= most, "page {page}: {left} to {right}");
        }
        assert!(contents.texts.iter().all(|(_, at, _)| (least..most).contains(&at[0])), "page {page}");
        // The folio is at the outer corner, the last text before the marks of the thumb index.
        if let Some((_, at, _)) = contents.texts.iter().find(|(text, at, _)| at[1] > 207.0 && !text.is_empty()) {
            assert_eq!(at[0] > 150.0, is_right_hand, "page {page}: {at:?}");
        }
    }
    let plan = plan(MANIFEST);
    assert_eq!(plan.with_book_pages().page.paper.width, 285.0);
    assert_eq!(plan.page.paper.width, 297.0);
}

#[test]
fn gutters_and_addresses_that_cannot_be_are_errors() {
    for (key, message) in [
        ("binding = \"51 mm\"", "51 mm is out of range"),
        ("binding = \"-1 mm\"", "-1 mm is out of range"),
        ("binding = 12", "the unit is missing"),
        ("bleed = \"11 mm\"", "11 mm is out of range"),
        ("gallery = \"example.org\"", "this is not the address of a gallery"),
        ("gallery = \"https://example.org/a b\"", "this is not the address of a gallery"),
        ("gallery = \"https://example.org/#/evans\"", "this is not the address of a gallery"),
    ] {
        let manifest = MANIFEST.replace("binding = \"12 mm\"\nbleed = \"3 mm\"", key);
        let report = problems(&manifest);
        assert!(report.contains(message), "{report}");
    }
    let narrow = |paper: &str| MANIFEST.replace("paper = \"a4\"", paper).replace("12 mm", "40 mm");
    let report = problems(&narrow("paper = { width = \"120 mm\", height = \"200 mm\" }"));
    assert!(report.contains("the gutter leaves 80 mm of the width of a page: the least is 100 mm"), "{report}");
    assert!(!report.contains("columns"), "{report}");
    let [most, _] = Layout::max_panels(&plan(MANIFEST).page);
    let report = problems(&narrow("paper = \"a4\"").replace("panels = [2, 1]", &format!("panels = [{most}, 1]")));
    assert!(
        report.contains(&format!("the gutter leaves no space for the {most} columns of family `evans`")),
        "{report}"
    );
}

/// The number of pages of the PDF of a manifest.
fn page_count(text: &str) -> usize {
    let atlas = Atlas::rendered(text, &[]);
    Pdf::read(&std::fs::read(atlas.out().join("atlas.pdf")).unwrap()).pages().len()
}

#[test]
fn a_single_plate_is_a_single_page_and_a_book_may_have_its_plates_only() {
    let manifest = |book: &str, cells: &str| {
        format!(
            "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"pdf\"]\n{book}\n[[family]]\nid = \"f\"\nlinkage = \"evans\"\npanels = [1, 1]\n\
             sampling = {{ samples = 24 }}\ngrid = {{ p = {cells} }}\nlet = {{ a = \"(1 + p)^1.5 / 2\" }}\n"
        )
    };
    assert_eq!(page_count(&manifest("", "[2]")), 1);
    assert_eq!(page_count(&manifest("[book]\nplates_only = true", "[2, 3, 4]")), 3);
    assert!(page_count(&manifest("", "[2, 3]")) > 4);
    assert!(page_count(&manifest("[book]", "[2]")) > 3);
}

#[test]
fn pages_of_an_index_say_what_they_continue() {
    let atlas = Atlas::rendered(
        "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"pdf\"]\n[page]\npaper = \"a6\"\n[book]\n[[family]]\nid = \"f\"\n\
         linkage = \"evans\"\nsampling = { samples = 24 }\ngrid = { p = { from = 2, to = 6, count = 60 } }\nlet = { a = \"(1 + p)^1.5 / 2\" }\n",
        &[],
    );
    let pdf = Pdf::read(&std::fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let pages = (0..pdf.pages().len())
        .map(|page| -> Vec<String> { pdf.contents(page).texts.into_iter().map(|(words, ..)| words).collect() });
    let of_index: Vec<Vec<String>> = pages.filter(|words| words.contains(&"Index of geometries".to_owned())).collect();
    assert!(of_index.len() > 3, "{}", of_index.len());
    let begins =
        |words: &Vec<String>| words.iter().any(|text| text.starts_with("By ") && text.ends_with(", continued"));
    let continued = of_index.iter().filter(|words| begins(words)).count();
    // The first page has the heading itself.
    assert!(!begins(&of_index[0]) && continued >= of_index.len() - 3, "{continued} of {}", of_index.len());
}

#[test]
fn drawings_state_the_whole_paper_and_are_no_plates_that_are_explained() {
    let manifest = |others: &str| {
        format!(
            "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"pdf\"]\n[page]\npaper = {{ width = \"150 mm\", height = \"105 mm\" }}\n\
             [book]\nbinding = \"12 mm\"\n[[family]]\nid = \"d\"\nlinkage = \"slider-crank\"\nlayout = \"drawing\"\n\
             sampling = {{ samples = 24 }}\ncases = [{{}}]\n{others}"
        )
    };
    let panels =
        "[[family]]\nid = \"p\"\nlinkage = \"jansen\"\npanels = [1, 1]\nsampling = { samples = 24 }\ncases = [{}]\n";
    for (others, is_explained) in [("", false), (panels, true)] {
        let atlas = Atlas::rendered(&manifest(others), &[]);
        let pdf = Pdf::read(&std::fs::read(atlas.out().join("atlas.pdf")).unwrap());
        let has_title = |(_, title, _): &(usize, String, usize)| title == "How to read this book";
        assert_eq!(pdf.outline().iter().any(has_title), is_explained);
        let words: Vec<String> =
            (0..pdf.pages().len()).flat_map(|page| pdf.contents(page).texts).map(|(words, ..)| words).collect();
        let papers: Vec<&String> = words
            .iter()
            .filter(|word| word.contains(" mm") && word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('×'))
            .collect();
        assert_eq!(papers, ["150 × 105 mm"]);
    }
}
