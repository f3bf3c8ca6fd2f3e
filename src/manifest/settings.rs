//! The tables `[atlas]` and `[page]`.

use super::{FORMAT, theme};
use coupler_curves::expression::Dimension;
use coupler_curves::notation::{Fields, Form, Key, Reader, Table, Value, words};
use coupler_curves::problem::Problem;
use coupler_drawing::page::{Options, Paper, Theme};
use coupler_drawing::render::{Format, TextMode};

pub(super) struct Atlas {
    pub title: String,
    pub output: String,
    pub formats: Vec<Format>,
    pub volume_pages: usize,
}

/// The most pages a volume may have: readers and the memory of a run bear no more.
const MAX_VOLUME: usize = 10_000;

pub(super) struct Page {
    pub options: Options,
    pub dpi: f64,
    pub text: TextMode,
}

/// The most pixels an image may have: 1.6 GB while it is drawn.
const MAX_PIXELS: f64 = 4e8;

/// The `[atlas]` table.
pub(super) static ATLAS: Table = Table::new(
    "[atlas]",
    &[
        Key::new("format", Form::Count([FORMAT, FORMAT]), "The version of the language of manifests.").or("1"),
        Key::required("title", Form::Text, "The title of the atlas."),
        Key::new(
            "output",
            Form::Text,
            "The folder results go to, relative to the manifest; / and \\ both part folders, on every system.",
        )
        .or("\"output\""),
        FORMATS.or("[\"svg\", \"png\"]"),
        Key::new("volume_pages", Form::Count([1, MAX_VOLUME]), "The most pages of a volume of the book.").or("1000"),
    ],
);

/// The `formats` of an atlas or a family.
pub(super) const FORMATS: Key = Key::new(
    "formats",
    Form::List(&Form::Word(|| Format::ALL.map(Format::name).to_vec()), [1, usize::MAX]),
    "The formats of pages: svg and png, a file for each page, and pdf, one book of all of them.",
);

/// The `[page]` table.
pub(super) static PAGE: Table = Table::new(
    "[page]",
    &[
        Key::new(
            "paper",
            Form::Either(&[Form::Word(|| words(&Paper::NAMED)), Form::Table(&PAPER)]),
            "The paper, by its name or its sides.",
        )
        .or("\"tabloid\""),
        Key::new("dpi", Form::Within(DPI), "The resolution of PNG images, in pixels to the inch.").or("100"),
        Key::new("dash", Form::Quantity(Dimension::Angle), "How much input a dash and its gap span.").or("\"5 deg\""),
        Key::new("text", Form::Word(|| words(&TEXT)), "How text stands in SVG: as text, or as outlines.")
            .or("\"text\""),
        Key::new(
            "theme",
            Form::Either(&[theme::NAME, Form::Table(&theme::THEME)]),
            "What pages look like: a theme by its name, or one changed.",
        )
        .or("\"paper\""),
    ],
);

static PAPER: Table = Table::new(
    "a paper",
    &[
        Key::required("width", Form::Quantity(Dimension::Paper), "Its width, with a unit: mm, in or pt."),
        Key::required("height", Form::Quantity(Dimension::Paper), "Its height, with a unit: mm, in or pt."),
    ],
);

const DPI: [f64; 2] = [10.0, 2400.0];

/// How text can stand in SVG.
const TEXT: [(&str, TextMode); 2] = [("text", TextMode::Text), ("outlines", TextMode::Outlines)];

pub(super) fn atlas<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Atlas> {
    let fields = Fields::of(value, &ATLAS, reader)?;
    let title = fields.required_text("title", "title = \"Straight-line coupler curves\"", reader);
    let output = match fields.get("output") {
        None => Some("output".to_owned()),
        Some(value) => reader.text(value).and_then(|text| {
            let folder = folder(&text, cfg!(windows));
            folder.map_err(|message| reader.note(Problem::error(value.span(), message).help(FOLDER_HELP))).ok()
        }),
    };
    let formats = match fields.get("formats") {
        None => Some(vec![Format::Svg, Format::Png]),
        Some(value) => formats(value, reader),
    };
    let volume_pages = fields.get("volume_pages").map_or(Some(1000), |value| reader.count(value, 1, MAX_VOLUME));
    Some(Atlas { title: title?, output: output?, formats: formats?, volume_pages: volume_pages? })
}

const FOLDER_HELP: &str = "write a folder relative to the manifest, as in output = \"output\"";

/// The folder a manifest names, as this system writes it. Manifests go from system to system: `/` and `\` both part
/// folders on all of them. What only Windows has, a drive or a share, cannot be had elsewhere.
fn folder(text: &str, is_windows: bool) -> Result<String, &'static str> {
    let has_drive = text.as_bytes().get(1) == Some(&b':') && text.as_bytes()[0].is_ascii_alphabetic();
    if text.is_empty() || text.contains('\0') {
        Err("this names no folder")
    } else if is_windows {
        Ok(text.to_owned())
    } else if has_drive || text.starts_with("\\\\") {
        Err("only Windows has such a folder")
    } else {
        Ok(text.replace('\\', "/"))
    }
}

/// A list of formats, each once.
pub(super) fn formats<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Vec<Format>> {
    let list = reader.list(value)?;
    if list.is_empty() {
        reader.note(Problem::error(value.span(), "no format is named").help("write formats = [\"svg\", \"png\"]"));
        return None;
    }
    let words = Format::ALL.map(|format| (format.name(), format));
    let mut out = Vec::new();
    let mut all_read = true;
    for item in list {
        match reader.word(item, &words) {
            Some(format) if !out.contains(&format) => out.push(format),
            Some(_) => {}
            None => all_read = false,
        }
    }
    all_read.then_some(out)
}

pub(super) fn page<'t>(value: Option<&Value<'t>>, reader: &mut Reader<'t>) -> Option<Page> {
    let tabloid = Paper::NAMED[1].1;
    let default = Page { options: Options::on(tabloid), dpi: 100.0, text: TextMode::default() };
    let Some(value) = value else { return Some(default) };
    let fields = Fields::of(value, &PAGE, reader)?;
    let paper = match fields.get("paper") {
        None => Some(tabloid),
        Some(value) => paper(value, reader),
    };
    let dpi = match fields.get("dpi") {
        None => Some(default.dpi),
        Some(value) => within(value, reader, |value, reader| reader.constant(value), DPI, "pixels to the inch"),
    };
    if let (Some(paper), Some(dpi), Some(value)) = (paper, dpi, fields.get("dpi")) {
        let pixels = paper.width * paper.height * dpi * dpi / (25.4 * 25.4);
        if pixels > MAX_PIXELS {
            let problem = Problem::error(value.span(), "an image of this paper would have too many pixels");
            reader
                .note(problem.help(format!("{:.0} dpi is the most for it", dpi * (MAX_PIXELS / pixels).sqrt() - 0.5)));
        }
    }
    let dash_deg = match fields.get("dash") {
        None => Some(default.options.dash_deg),
        Some(value) => {
            let read = |value: &Value<'t>, reader: &mut Reader<'t>| reader.measure(value, Dimension::Angle);
            within(value, reader, read, [0.1, 360.0], "degrees of input")
        }
    };
    let text = match fields.get("text") {
        None => Some(TextMode::default()),
        Some(value) => reader.word(value, &TEXT),
    };
    let theme = fields.get("theme").map_or_else(Theme::default, |value| theme::read(value, reader));
    Some(Page { options: Options { paper: paper?, dash_deg: dash_deg?, theme }, dpi: dpi?, text: text? })
}

fn paper<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Paper> {
    if value.get_ref().is_str() {
        return reader.word(value, &Paper::NAMED);
    }
    let fields = Fields::of(value, &PAPER, reader)?;
    let mut side = |key: &str| {
        let value = fields.required(key, &format!("{key} = \"279 mm\""), reader)?;
        let read = |value: &Value<'t>, reader: &mut Reader<'t>| reader.measure(value, Dimension::Paper);
        within(value, reader, read, Paper::SIDES, "mm")
    };
    let (width, height) = (side("width"), side("height"));
    Some(Paper { width: width?, height: height? })
}

/// A value that must lie between two others.
pub(super) fn within<'t>(
    value: &Value<'t>,
    reader: &mut Reader<'t>,
    read: impl Fn(&Value<'t>, &mut Reader<'t>) -> Option<f64>,
    [least, most]: [f64; 2],
    what: &str,
) -> Option<f64> {
    let number = read(value, reader)?;
    if (least..=most).contains(&number) {
        return Some(number);
    }
    let problem = Problem::error(value.span(), format!("{number} {what} is out of range"));
    reader.note(problem.help(format!("give {least} to {most} {what}")));
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_of_windows_are_folders_everywhere() {
        for (text, elsewhere) in [
            ("out", Ok("out")),
            ("..\\out", Ok("../out")),
            ("..\\a/b\\", Ok("../a/b/")),
            ("/srv/out", Ok("/srv/out")),
            ("C:\\out", Err("only Windows has such a folder")),
            ("c:out", Err("only Windows has such a folder")),
            ("\\\\server\\share", Err("only Windows has such a folder")),
            ("", Err("this names no folder")),
            ("a\0b", Err("this names no folder")),
        ] {
            assert_eq!(folder(text, false).as_deref(), elsewhere.as_deref(), "{text}");
            assert_eq!(folder(text, true).is_ok(), elsewhere != Err("this names no folder"), "{text}");
        }
    }
}
