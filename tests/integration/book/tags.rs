//! What those who do not see a book are told of it: its structure, read back.

use super::bound;
use super::reader::{Element, Pdf};
use super::{ITALIC, REGULAR};
use super::{book, scene, text};
use coupler_drawing::scene::{Anchor, Item};

/// The elements of a kind, in reading order.
fn of_kind<'e>(element: &'e Element, kind: &str) -> Vec<&'e Element> {
    let own = (element.kind == kind).then_some(element);
    own.into_iter().chain(element.children.iter().flat_map(|child| of_kind(child, kind))).collect()
}

/// The number of pieces of content of an element and those in it.
fn contents(element: &Element) -> usize {
    element.contents + element.children.iter().map(contents).sum::<usize>()
}

#[test]
fn a_book_is_tagged_titled_and_opens_as_one() {
    let plan = bound::plan();
    let [(volume, [front, _], bytes)] = bound::volumes(&plan, 1000).try_into().unwrap();
    let pdf = Pdf::read(&bytes);
    let catalog = pdf.dictionary(pdf.catalog);
    for entry in
        ["/Lang(en)", "/Marked true", "/DisplayDocTitle true", "/PageLayout/TwoPageRight", "/PageMode/UseOutlines"]
    {
        assert!(catalog.contains(entry), "{entry} in {catalog}");
    }
    assert!(String::from_utf8_lossy(&bytes).contains("<pdfuaid:part>1</pdfuaid:part>"));

    let document = pdf.structure();
    assert_eq!(document.kind, "Document");
    let pages = pdf.pages().len();
    let sections = &document.children;
    assert!(sections.len() == pages && sections.iter().all(|section| section.kind == "Sect"), "{sections:?}");
    for (page, section) in sections.iter().enumerate() {
        assert_eq!(
            pdf.count_parts(page),
            contents(section),
            "all content of page {page} is in the structure or decoration"
        );
        let links: usize = of_kind(section, "Link").iter().map(|link| link.objects).sum();
        assert_eq!(links, pdf.links(page).len());
    }
    let titles = |kind| of_kind(&document, kind).iter().map(|title| title.says.as_str()).collect::<Vec<_>>();
    assert_eq!(titles("H1"), ["Curves"]);
    assert_eq!(
        titles("H2"),
        ["Contents", "Crank-rockers", "Crank-rockers", "Evans’s", "Evans’s", "Index of geometries"]
    );

    // Each plate says its dimensions, its class, its transmission angle and its straight portion.
    let plates = &sections[front..front + volume.page_count];
    let figures: Vec<&Element> = plates.iter().flat_map(|plate| of_kind(plate, "Figure")).collect();
    assert_eq!(figures.len(), 6);
    for figure in &figures {
        assert!(
            ["no. ", " = ", "crank-rocker", "μ "].iter().all(|words| figure.says.contains(words)),
            "{}",
            figure.says
        );
    }
    assert!(figures.iter().any(|figure| figure.says.contains("straight ")));
    assert!(
        figures[0].says.starts_with("Crank-rockers, no. 1: frame = 3, rocker = 3; crank-rocker"),
        "{}",
        figures[0].says
    );

    // Contents and index are tables of contents: each entry is a link with its words.
    let entries: Vec<&Element> = of_kind(&document, "TOC").iter().flat_map(|toc| of_kind(toc, "TOCI")).collect();
    let links: Vec<&Element> = entries.iter().flat_map(|entry| of_kind(entry, "Link")).collect();
    assert!(entries.len() >= 20 && links.len() == entries.len(), "{} {}", entries.len(), links.len());
    assert!(links.iter().all(|link| link.objects == 1 && link.contents > 0));
}

#[test]
fn what_has_no_glyph_is_read_as_what_it_is() {
    let words = "漢 x\u{feff}y";
    let line = Item::Text(text(&[(words, REGULAR), ("z", ITALIC)], Anchor::Start, 0));
    let bytes = book(&[scene(vec![line])], &[]).unwrap();
    let pdf = Pdf::read(&bytes);
    // The text as UTF-16.
    let units: String = format!("{words}z").encode_utf16().map(|unit| format!("{unit:04X}")).collect();
    let stream = String::from_utf8_lossy(pdf.stream(0)).into_owned();
    let hex: String = stream.bytes().filter(|byte| byte.is_ascii_hexdigit()).map(char::from).collect();
    let raw: Vec<u8> = format!("{words}z").encode_utf16().flat_map(u16::to_be_bytes).collect();
    let is_raw = pdf.stream(0).windows(raw.len()).any(|window| window == raw);
    assert!(is_raw || hex.to_uppercase().contains(&units), "{stream}");
    let said: Vec<String> = pdf.contents(0).texts.into_iter().map(|(said, ..)| said).collect();
    assert_eq!(said.concat().trim_start(), "xyz");
    // A box for each character without a glyph.
    assert_eq!(pdf.contents(0).paths.len(), 3, "paper and boxes");
}
