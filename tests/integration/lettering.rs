//! Titles, captions, notes and legends are written as plain text in well-formed files; characters that cannot be
//! written are rejected.

use std::fs;

use coupler_atlas::manifest;
use coupler_curves::problem::report;
use coupler_drawing::render::{self, TextMode};
use coupler_drawing::scene::{FontFamily, Group, Item, Scene, Typeface};
use roxmltree::{Document, Node};

use crate::book::reader::Pdf;
use crate::support::folder::{Atlas, tree};

/// Texts that are easily written wrongly: markup, quotes and escapes; right-to-left text and direction overrides; long
/// words; characters without a glyph in the typefaces; combining characters.
const STRANGE: [&str; 10] = [
    "<script>alert(1)</script> & \"two\" 'one' ]]> <!-- &amp; &#0; <![CDATA[ -- ?> %s {0} \\ $HOME",
    "onload=\"alert(1)\" x='</text><svg onload=alert(1)>'",
    "שלום עולם, מכונות; مرحبا بالعالم 123",
    "a \u{202e}turned round\u{202c} b \u{2067}kept apart\u{2069} \u{200f}",
    "Straßenbahnschienenritzenreinigungsgerät-und-dreihundert-Buchstaben-ohne-ein-einziges-Leerzeichen-das-eine-Trennung-\
     erlauben-würde-auf-einer-Seite-von-hundertfünfzig-Millimetern-Breite-und-noch-immer-ist-kein-Ende-dieses-Wortes-zu-sehen",
    "🦀 👩‍👩‍👧 漢字 ﷽ 𝔘𝔫𝔦 \u{10ffff}",
    "e\u{301}\u{327}\u{30a} a\u{ad}b c\u{a0}d \u{200b}\u{2028}\u{2029}\u{feff}",
    "\u{2400} \u{fffd} ￼",
    "_^$#~%\\input{x}(\\)",
    " ",
];

/// A TOML string with every character escaped.
fn toml(text: &str) -> String {
    let escape = |c: char| format!("\\U{:08X}", u32::from(c));
    format!("\"{}\"", text.chars().map(escape).collect::<String>())
}

/// A manifest with this text in all titles, sources, legends, captions and notes.
fn manifest_with(text: &str, mode: &str) -> String {
    manifest_in_formats(text, mode, r#"["svg", "png", "pdf"]"#)
}

/// The same in some formats.
fn manifest_in_formats(text: &str, mode: &str, formats: &str) -> String {
    let words = toml(text);
    let caption = toml(&text.replace('{', "{{").replace('}', "}}"));
    format!(
        r#"[atlas]
title = {words}
output = "out"
formats = {formats}
[page]
paper = {{ width = "150 mm", height = "110 mm" }}
dpi = 30
text = "{mode}"
[[family]]
id = "cells"
linkage = "mine"
title = {words}
panels = [1, 1]
sampling = {{ samples = 20 }}
cases = [{{}}]
[[family]]
id = "source"
linkage = "mine"
title = {words}
source = {words}
caption = {caption}
note = {caption}
panels = [1, 1]
sampling = {{ samples = 20 }}
cases = [{{}}]
[[linkage]]
id = "mine"
source = {words}
legend = {words}
caption = {caption}
note = {caption}
trace = ["M"]
[linkage.joints]
O = {{ fixed = [0, 0] }}
C = {{ fixed = [4, 0] }}
A = {{ crank = "O", length = 1 }}
B = {{ dyad = ["A", "C"], lengths = [4, 3], side = "left" }}
M = {{ point = ["A", "B"], along = 2, across = 1 }}
"#
    )
}

/// Parses a page and asserts that it has only elements of drawings and no event handlers.
fn check_svg(bytes: &[u8]) -> Document<'_> {
    let document = Document::parse(std::str::from_utf8(bytes).unwrap()).unwrap();
    let known = ["svg", "title", "desc", "rect", "g", "path", "circle", "text", "tspan"];
    for node in document.descendants().filter(Node::is_element) {
        assert!(known.contains(&node.tag_name().name()), "unexpected element {:?}", node.tag_name());
        assert!(node.attributes().all(|attribute| !attribute.name().starts_with("on")), "{node:?}");
    }
    assert!(document.descendants().all(|node| !node.is_comment() && !node.is_pi()));
    document
}

/// The text with single spaces between words, and the characters of a typewriter in place of those of typesetting.
fn plain(text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let quotes = text.replace(['‘', '’'], "'").replace(['“', '”'], "\"");
    quotes.replace("--", "-").replace(['–', '−'], "-").replace('…', "...")
}

#[test]
fn strange_texts_are_written_unchanged() {
    for (k, text) in STRANGE.into_iter().enumerate() {
        let mode = if k % 3 == 2 { "outlines" } else { "text" };
        let manifest = manifest_with(text, mode);
        // Only SVG shows characters that the typeface does not have.
        let is_drawable = manifest::parse(&manifest).plan.is_some();
        assert_eq!(is_drawable, !['ש', '漢', '\u{2400}'].iter().any(|c| text.contains(*c)), "{text}");
        let manifest = if is_drawable { manifest } else { manifest_in_formats(text, "text", r#"["svg"]"#) };
        let atlas = Atlas::new(&manifest);
        let (code, _, err) = atlas.run(&[]);
        assert_eq!(code, 0, "{text}: {err}");
        let files = tree(&atlas.out());
        let pages: Vec<Document> =
            files.iter().filter(|(name, _)| name.ends_with(".svg")).map(|(_, bytes)| check_svg(bytes)).collect();
        assert_eq!(pages.len(), 2);
        for page in &pages {
            let text_of = |node: Node| node.descendants().filter_map(|n| n.text()).collect::<String>();
            let lines: Vec<String> = page
                .descendants()
                .filter(|node| node.has_tag_name("text"))
                .map(text_of)
                .chain(page.descendants().filter_map(|node| node.attribute("aria-label").map(str::to_owned)))
                .collect();
            let title = page.root_element().children().find(|node| node.has_tag_name("title")).unwrap();
            assert!(plain(&text_of(title)).contains(&plain(text)), "{text}: {title:?}");
            // The heading has the title, or as much of it as fits.
            let begin: String = plain(text).chars().take(12).collect();
            assert!(lines.iter().any(|line| plain(line).contains(&begin)), "{text}: {lines:?}");
        }
        let record: serde_json::Value = serde_json::from_slice(&files["run.json"]).unwrap();
        assert_eq!(record["title"], text);
        assert_eq!(record["families"][0]["title"], text);
        if !is_drawable {
            continue;
        }
        let book = Pdf::read(&files["atlas.pdf"]);
        for page in 0..book.pages().len() {
            book.contents(page);
        }
        assert!(book.outline().iter().any(|(_, title, _)| title.contains(text)), "{text}: {:?}", book.outline());
    }
}

/// Text that the typeface does not have needs a font file in all formats but SVG, and is drawn with it.
#[test]
fn a_font_file_draws_what_the_typeface_does_not_have() {
    let text = STRANGE[2];
    let manifest = manifest_with(text, "outlines");
    let with_file =
        |name: &str| manifest.replace("dpi = 30", &format!("dpi = 30\ntheme = {{ fallback_face = \"{name}\" }}"));
    let refused = |manifest: &str, arguments: &[&str], message: &str| {
        let (code, _, err) = Atlas::new(manifest).run(arguments);
        assert!(code == 2 && err.contains(message), "{err}");
    };
    let missing = "the typeface `serif-condensed` has no `ש` (U+05E9)";
    refused(&manifest, &[], missing);
    refused(&manifest_in_formats(text, "outlines", r#"["svg"]"#), &[], missing);
    refused(&manifest_in_formats(text, "text", r#"["svg"]"#), &["--format", "png"], missing);
    refused(&with_file("none.ttf"), &[], "cannot use `none.ttf`: ");
    refused(&with_file("atlas.toml"), &[], "cannot use `atlas.toml`: it is not a font");
    let mixed = with_file("font.ttf").replace(&toml(text), &toml("שלום 漢"));
    let atlas = Atlas::new(&mixed);
    let font = atlas.0.path().join("font.ttf");
    let face = |family: FontFamily| Typeface::from(family).regular().bytes();
    fs::write(&font, face(FontFamily::Sans)).unwrap();
    let (code, _, err) = atlas.run(&[]);
    assert!(code == 2 && err.contains("and its fallback face have no `漢`"), "{err}");

    let atlas = Atlas::new(&with_file("font.ttf"));
    let font = atlas.0.path().join("font.ttf");
    fs::write(&font, face(FontFamily::Sans)).unwrap();
    let (code, _, err) = atlas.run(&[]);
    assert_eq!(code, 0, "{err}");
    let first = tree(&atlas.out());
    let book = Pdf::read(&first["atlas.pdf"]);
    assert!(book.outline().iter().any(|(_, title, _)| title.contains(text)));
    let (_, out, _) = atlas.run(&[]);
    assert!(out.contains("nothing has changed"), "{out}");
    // Another font is another page.
    fs::write(&font, face(FontFamily::SansCondensed)).unwrap();
    atlas.run(&[]);
    let second = tree(&atlas.out());
    let page = "cells/cells-001.svg";
    assert_ne!(first[page], second[page]);
}

#[test]
fn markup_is_text_in_the_book_too() {
    let atlas = Atlas::new(&manifest_with(STRANGE[0], "text"));
    atlas.run(&["--format", "pdf"]);
    let book = Pdf::read(&fs::read(atlas.out().join("atlas.pdf")).unwrap());
    let texts: Vec<String> =
        (0..book.pages().len()).flat_map(|page| book.contents(page).texts).map(|(text, ..)| text).collect();
    let begin = "<script>alert(1)</script> & \"two\"";
    assert!(texts.iter().filter(|text| plain(text).contains(begin)).count() >= 3, "{texts:?}");
}

/// A scene made without a manifest gives a well-formed page too: U+FFFD replaces characters that XML does not allow.
#[test]
fn every_character_can_be_on_a_page() {
    let all: String =
        (0..0x1_1000).filter_map(char::from_u32).chain(['\u{1f980}', '\u{10fffe}', '\u{10ffff}']).collect();
    let group = Group { id: all.clone(), title: all.clone(), data: vec![("cell", all.clone())], ..Group::default() };
    let scene = Scene {
        width: 100.0,
        height: 100.0,
        paper: coupler_drawing::scene::Color(255, 255, 255),
        title: all.clone(),
        items: vec![Item::Group(group)],
        links: Vec::new(),
        reduced_scale: None,
        typeface: FontFamily::Serif.into(),
    };
    let svg = render::svg(&scene, TextMode::Text);
    let document = check_svg(&svg);
    let title = document.descendants().find(|node| node.has_tag_name("title")).unwrap().text().unwrap();
    assert_eq!(title.chars().count(), all.chars().count());
    for (written, original) in title.chars().zip(all.chars()) {
        let is_space = matches!(original, '\t' | '\n') && written == ' ';
        let is_control = original < ' ' || matches!(original, '\u{7f}' | '\u{fffe}' | '\u{ffff}');
        assert!(
            written == original || is_space || is_control && written == '\u{fffd}',
            "{original:?} became {written:?}"
        );
    }
}

#[test]
fn control_characters_are_rejected_with_their_place() {
    let good = manifest_with("T", "text");
    assert!(manifest::parse(&good).plan.is_some());
    let word = toml("T");
    let places: Vec<usize> = good.match_indices(&word).map(|(at, _)| at).collect();
    assert!(places.len() >= 10);
    for c in ['\0', '\u{1b}', '\u{7}', '\r', '\u{7f}', '\u{85}', '\u{9b}', '\u{fffe}', '\u{ffff}'] {
        for &at in &places {
            let invalid = toml(&format!("a{c}b"));
            let text = format!("{}{invalid}{}", &good[..at], &good[at + word.len()..]);
            let loaded = manifest::parse(&text);
            assert!(loaded.plan.is_none(), "{c:?} in {}", &text[at - 10..]);
            let [problem] = &loaded.problems[..] else { panic!("{:?}", loaded.problems) };
            let message = format!("a string cannot contain the control character U+{:04X}", u32::from(c));
            assert_eq!((problem.message.as_str(), problem.span.clone()), (message.as_str(), at..at + invalid.len()));
        }
    }
    // A control character that is not escaped is reported by itself.
    let text = good.replacen(&word, "\"a\u{85}b\"", 1);
    let span = manifest::parse(&text).problems[0].span.clone();
    assert_eq!(&text[span], "\u{85}");
    // Line breaks and tabs become spaces, with any line ends.
    for breaks in ["\"\"\"\none\n\ttwo\"\"\"", "\"\"\"\r\none\r\n\ttwo\"\"\"", "\"one\\n\\ttwo\"", "'one \ttwo'"] {
        let loaded = manifest::parse(&good.replacen(&word, breaks, 1));
        let plan = loaded.plan.unwrap_or_else(|| panic!("{breaks:?}: {:?}", loaded.problems));
        assert_eq!(plan.title.replace("   ", "  "), "one  two", "{breaks:?}");
    }
}

/// A manifest cannot control the terminal through its problems.
#[test]
fn no_report_has_a_control_character() {
    let good = manifest_with("T", "text");
    let escape = "\\u001B[2J\\u0007\\u009B";
    for text in [
        format!("\"{escape}\" = 1\n{good}"),
        good.replace("[atlas]", &format!("[atlas]\n\"{escape}\" = 1")),
        good.replace("\"outlines\"", "").replace("text = \"text\"", &format!("text = \"{escape}\"")),
        good.replace("cases = [{}]", &format!("cases = [{{ \"{escape}\" = 1 }}]")),
        good.replace("cases = [{}]", &format!("cases = [{{ p = \"1 + {escape}\" }}]")),
        good.replace("samples = 20", &format!("step = \"5 {escape}\"")),
        good.replace("O = {", &format!("\"{escape}\" = {{")),
        good.replace("trace = [\"M\"]", &format!("trace = [\"{escape}\"]")),
        // The help for the unknown linkage may name those that exist.
        good.replace("id = \"mine\"", &format!("id = \"min{escape}\"")),
        good.replace("linkage = \"mine\"", &format!("linkage = \"{escape}\"")),
        format!("# \u{1b}[2J\n{good}"),
        format!("{good}\u{9b}2J"),
        good.replace("side = \"left\"", "side = \"\u{9b}2J\""),
    ] {
        assert_ne!(text, good);
        let loaded = manifest::parse(&text);
        assert!(loaded.plan.is_none(), "{text}");
        let report = report(&loaded.problems, "atlas.toml", &text, false);
        assert!(report.chars().all(|c| c == '\n' || !c.is_control()), "{report:?}");
    }
}
