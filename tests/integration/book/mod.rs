//! Books in PDF, read back.

mod bound;
mod codes;
mod designer;
pub mod reader;
mod references;
mod sheets;
mod tags;

use coupler_curves::geometry::{Point, Vector};
use coupler_drawing::render::pdf::{Book, Error};
use coupler_drawing::scene::{
    Anchor, Animation, Circle, Color, Face, FontFamily, Group, Item, LinkKind, LinkTarget, OutlineEntry, PageLink,
    PageNumber, Path, Polyline, Scene, Stroke, Text, TextRun, Typeface,
};
use reader::Pdf;

const INK: Color = Color(0x11, 0x22, 0x33);

const REGULAR: Face =
    Face { typeface: Typeface { family: FontFamily::SerifCondensed, fallback: None }, is_italic: false };
const ITALIC: Face =
    Face { typeface: Typeface { family: FontFamily::SerifCondensed, fallback: None }, is_italic: true };

fn scene(items: Vec<Item>) -> Scene {
    let paper = Color(0xff, 0xfd, 0xf8);
    Scene {
        width: 431.8,
        height: 279.4,
        paper,
        title: "A page".into(),
        items,
        links: Vec::new(),
        reduced_scale: None,
        typeface: FontFamily::SerifCondensed.into(),
    }
}

fn link(corner: Point, size: Vector, page_index: usize) -> PageLink {
    PageLink { corner, size, target: LinkTarget::Page(page_index), title: "there".into(), kind: LinkKind::Entry }
}

fn line(points: &[(f64, f64)]) -> Polyline {
    Polyline { points: points.iter().map(|&(x, y)| Point::new(x, y)).collect(), is_closed: false }
}

fn path(lines: Vec<Polyline>) -> Item {
    let stroke = Some(Stroke { color: INK, width: 0.35, has_round_ends: false });
    Item::Path(Path { polylines: lines, stroke, fill: None })
}

fn text(words: &[(&str, Face)], anchor: Anchor, quarter_turns: u8) -> Text {
    let runs = words.iter().map(|&(text, face)| TextRun::new(text, face)).collect();
    Text { position: Point::new(123.456, 78.9), anchor, size: 3.7, color: INK, runs, quarter_turns }
}

/// A book of these pages, numbered from 1.
fn book(scenes: &[Scene], outline: &[OutlineEntry]) -> Result<Vec<u8>, Error> {
    let mut book = Book::new("An <atlas> & \"more\"", "coupler-atlas 1.0");
    for (scene, number) in scenes.iter().zip(1..) {
        book.add_page(scene, PageNumber::Arabic(number))?;
    }
    book.finish(outline)
}

/// The book of some pages, read back.
fn read_back(scenes: &[Scene]) -> Pdf {
    Pdf::read(&book(scenes, &[]).unwrap())
}

#[test]
fn positions_in_the_book_are_those_of_the_scene() {
    let lines = vec![
        line(&[(20.1234, 30.5678), (20.5, 31.25), (22.0, 30.0)]),
        line(&[(400.000_4, 250.999_6), (-3.5, 12.0)]),
        line(&[(7.0, 7.0), (7.000_1, 7.0), (8.0, 7.0)]),
    ];
    let contents = read_back(&[scene(vec![path(lines.clone())])]).contents(0);
    let (paper, operator, _) = &contents.paths[0];
    assert_eq!((paper.len(), operator.as_str()), (1, "f"));
    assert!((paper[0][2][0] - 431.8).abs() < 1e-3 && (paper[0][2][1] - 279.4).abs() < 1e-3, "{paper:?}");
    let (drawn, operator, width) = &contents.paths[1];
    assert_eq!(operator, "S");
    assert!((width - 0.35).abs() < 1e-6, "{width}");
    // A point that is written like the one before it is left out.
    assert_eq!(drawn.iter().map(Vec::len).collect::<Vec<_>>(), [3, 2, 2]);
    for (line, drawn) in lines.iter().zip(drawn).take(2) {
        for (point, drawn) in line.points.iter().zip(drawn) {
            // Half a unit of 1/1000 mm, and as much again for single precision in points.
            assert!((point.x - drawn[0]).abs() < 1e-3 && (point.y - drawn[1]).abs() < 1e-3, "{point} {drawn:?}");
        }
    }
}

#[test]
fn circles_are_round() {
    let circle = Circle { centre: Point::new(100.0, 50.0), radius: 20.0, stroke: None, fill: Some(INK) };
    let contents = read_back(&[scene(vec![Item::Circle(circle)])]).contents(0);
    let curve = &contents.paths[1].0[0];
    assert_eq!(curve.len(), 13);
    for cubic in 0..4 {
        let p = &curve[3 * cubic..3 * cubic + 4];
        for t in (0..=20).map(|k| f64::from(k) / 20.0) {
            let s = 1.0 - t;
            let weights = [s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t];
            let at = |k: usize| p.iter().zip(weights).map(|(p, w)| p[k] * w).sum::<f64>();
            let off = Vector::new(at(0) - 100.0, at(1) - 50.0).norm() - 20.0;
            // A quarter circle as a cubic is off by at most 2.7e-4 of the radius.
            assert!(off.abs() < 20.0 * 2.8e-4 + 1e-3, "{off}");
        }
    }
}

#[test]
fn groups_are_flattened_and_animations_show_their_first_frame() {
    let frame = |x: f64| vec![path(vec![line(&[(x, 1.0), (x + 5.0, 1.0)])])];
    let moving = Item::Animation(Animation { frames: vec![frame(10.0), frame(90.0)], seconds: 4.0 });
    let group =
        Item::Group(Group { items: vec![moving, path(vec![line(&[(3.0, 3.0), (4.0, 4.0)])])], ..Group::default() });
    let contents = read_back(&[scene(vec![group])]).contents(0);
    assert_eq!(contents.paths.len(), 3);
    assert!((contents.paths[1].0[0][0][0] - 10.0).abs() < 1e-3);
}

#[test]
fn text_can_be_read_and_is_where_the_other_formats_have_it() {
    let words = [("p", ITALIC), (" = 2.00, “Watt” (µ ≥ 5°) – ", REGULAR), ("a", ITALIC)];
    for (anchor, turns) in
        [(Anchor::Start, 0), (Anchor::Middle, 0), (Anchor::End, 1), (Anchor::Start, 2), (Anchor::End, 3)]
    {
        let text = text(&words, anchor, turns);
        let contents = read_back(&[scene(vec![Item::Text(text.clone())])]).contents(0);
        assert_eq!(
            contents.texts.iter().map(|(text, ..)| text.as_str()).collect::<Vec<_>>(),
            words.map(|(text, _)| text)
        );
        let (_, start, along) = &contents.texts[0];
        let shift = text.position.x - text.start().x;
        let (cos, sin) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][usize::from(turns)];
        let expected = [text.position.x - shift * cos, text.position.y - shift * sin];
        assert!(
            (start[0] - expected[0]).abs() < 2e-3 && (start[1] - expected[1]).abs() < 2e-3,
            "{start:?} {expected:?}"
        );
        assert!((along[0] - 3.7 * cos).abs() < 1e-3 && (along[1] - 3.7 * sin).abs() < 1e-3, "{along:?}");
        let (_, next, _) = &contents.texts[1];
        let advance = Vector::new(next[0] - start[0], next[1] - start[1]).norm();
        assert!((advance - ITALIC.width("p", 3.7)).abs() < 2e-3, "{advance}");
    }
}

#[test]
fn only_the_used_glyphs_of_a_face_are_embedded() {
    let words = text(&[("p", ITALIC), (" = 2", REGULAR)], Anchor::Start, 0);
    let bytes = book(&[scene(vec![Item::Text(words)])], &[]).unwrap();
    let pdf = Pdf::read(&bytes);
    assert_eq!(pdf.fonts().len(), 2);
    for font in pdf.fonts() {
        let name = font.split("/FontName/").nth(1).unwrap().split('/').next().unwrap();
        let (tag, face) = name.split_once('+').unwrap();
        assert!(tag.len() == 6 && face.starts_with("DejaVuSerifCondensed"), "{name}");
        assert!(font.contains("/FontFile2 "), "{font}");
    }
    // A whole face has some 300 kB.
    assert!(bytes.len() < 20_000, "{}", bytes.len());
}

#[test]
fn labels_links_and_the_outline_refer_to_their_pages() {
    let mut first = scene(Vec::new());
    first.links.push(link(Point::new(25.4, 50.8), Vector::new(12.7, 5.08), 2));
    first.links.push(link(Point::new(f64::NAN, 1.0), Vector::new(1.0, 1.0), 1));
    let mut book = Book::new("A book", "a program");
    let pages = [
        (first, PageNumber::Roman(1)),
        (scene(Vec::new()), PageNumber::Arabic(7)),
        (scene(Vec::new()), PageNumber::Arabic(8)),
    ];
    for (scene, label) in &pages {
        book.add_page(scene, *label).unwrap();
    }
    let entry_without_children =
        |title: &str, page| OutlineEntry { title: title.into(), page_index: page, children: Vec::new() };
    let children = vec![entry_without_children("p = 2 (5°)", 1), entry_without_children("p) = \\3", 2)];
    let outline = [
        entry_without_children("Contents", 0),
        OutlineEntry { title: "Evans’s".into(), page_index: 1, children },
        entry_without_children("Index", 2),
    ];
    let bytes = book.finish(&outline).unwrap();
    let pdf = Pdf::read(&bytes);
    let label = |style: &str| format!("<</Type/PageLabel/S/{style}>>");
    assert_eq!(pdf.labels(), ["r/St1", "D/St7", "D/St8"].map(label));
    let links = pdf.links(0);
    assert_eq!(links.len(), 1, "a box without a position is no link");
    let (corners, page) = links[0];
    // 279.4 mm are 792 points; the box is at 1 inch by 2, and half an inch by a fifth.
    let expected = [72.0, 792.0 - 144.0 - 14.4, 108.0, 792.0 - 144.0];
    assert!(corners.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3) && page == 2, "{corners:?} {page}");
    let entry = |depth, title: &str, page| (depth, title.to_owned(), page);
    let entries = [
        entry(0, "Contents", 0),
        entry(0, "Evans’s", 1),
        entry(1, "p = 2 (5°)", 1),
        entry(1, "p) = \\3", 2),
        entry(0, "Index", 2),
    ];
    assert_eq!(pdf.outline(), entries);
    let all = String::from_utf8_lossy(&bytes);
    assert!(
        all.contains("/Title(A book)") && !all.contains("CreationDate") && !all.contains("ModDate"),
        "a title and no dates"
    );
}

#[test]
fn links_to_missing_pages_and_pages_without_area_are_errors() {
    let mut linking = scene(Vec::new());
    linking.links.push(link(Point::new(1.0, 1.0), Vector::new(1.0, 1.0), 1));
    assert_eq!(book(&[linking], &[]), Err(Error::MissingPage { page: 2, page_count: 1 }));
    let child = OutlineEntry { title: "there".into(), page_index: 5, children: Vec::new() };
    let entry = OutlineEntry { title: "here".into(), page_index: 0, children: vec![child] };
    assert_eq!(book(&[scene(Vec::new())], &[entry]), Err(Error::MissingPage { page: 6, page_count: 1 }));
    for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = book(&[Scene { width, ..scene(Vec::new()) }], &[]).unwrap_err();
        assert!(matches!(error, Error::InvalidSize { .. }), "{error}");
    }
}

#[test]
fn no_text_and_no_geometry_makes_a_book_fail() {
    let unusual_texts = [
        "",
        " ",
        "<a href=\"x\">&amp;",
        "שלום עולם",
        "مرحبا",
        "漢字",
        "a\u{0}b\n\t\u{7}",
        "\u{e000}\u{fffe}\u{feff}",
        "👩‍👩‍👧",
        "e\u{301}ﬁ",
    ];
    let mut items: Vec<Item> = Vec::new();
    for (words, turns) in unusual_texts.iter().zip(0u8..) {
        items.push(Item::Text(text(&[(words, REGULAR), (words, ITALIC)], Anchor::Middle, turns)));
    }
    items.push(Item::Text(Text { runs: Vec::new(), ..text(&[], Anchor::End, 0) }));
    items.push(Item::Text(Text { size: f64::NAN, ..text(&[("x", REGULAR)], Anchor::End, 0) }));
    for odd in [f64::NAN, f64::INFINITY, 1e300, -1e30, 1e-300] {
        items.push(path(vec![line(&[(odd, 1.0), (2.0, odd), (3.0, 4.0)]), line(&[(odd, odd)]), line(&[])]));
        let circle = Circle { centre: Point::new(odd, 3.0), radius: odd, stroke: None, fill: Some(INK) };
        items.push(Item::Circle(circle));
        items.push(Item::Text(Text { position: Point::new(odd, odd), ..text(&[("x", REGULAR)], Anchor::End, 1) }));
    }
    let scene = scene(items);
    for words in unusual_texts {
        let mut book = Book::new(words, words);
        book.add_page(&scene, PageNumber::Arabic(0)).unwrap();
        let outline = [OutlineEntry { title: words.to_owned(), page_index: 0, children: Vec::new() }];
        let bytes = book.finish(&outline).unwrap();
        let pdf = Pdf::read(&bytes);
        assert_eq!(pdf.outline().len(), 1);
        let xml = String::from_utf8_lossy(&bytes);
        let xml = xml.split("<?xpacket begin").nth(1).unwrap().split("<?xpacket end").next().unwrap();
        assert!(!xml.contains(['\0', '\u{7}', '\u{fffe}']), "no characters that are not allowed in XML");
    }
}

#[test]
fn a_book_has_the_same_bytes_in_every_run_and_on_any_number_of_threads() {
    let page = |k: usize| {
        let curve =
            (0..400).map(|i| (20.0 + (i * k % 97) as f64, 30.0 + (i * i % 101) as f64 / 3.0)).collect::<Vec<_>>();
        let words = format!("page {k} of the curves {}", char::from(b'A' + k as u8));
        scene(vec![path(vec![line(&curve)]), Item::Text(text(&[(&words, REGULAR)], Anchor::Start, 0))])
    };
    let pages: Vec<Scene> = (1..12).map(page).collect();
    let first = book(&pages, &[]).unwrap();
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| book(&pages, &[]).unwrap()) == first, "{threads} threads");
    }
}
