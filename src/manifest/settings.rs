//! The tables `[atlas]` and `[page]`.

use super::{FORMAT_VERSION, theme};
use coupler_curves::expression::Dimension;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema, words};
use coupler_curves::problem::Problem;
use coupler_drawing::page::{Options, Paper, Theme};
use coupler_drawing::render::{Format, TextMode};

pub(super) struct AtlasSettings {
    pub title: String,
    pub output: String,
    pub formats: Vec<Format>,
    pub volume_pages: usize,
}

/// The most pages a volume may have: readers and the memory of a run bear no more.
const MAX_VOLUME_PAGES: usize = 10_000;

pub(super) struct PageSettings {
    pub options: Options,
    pub dpi: f64,
    pub text_mode: TextMode,
}

/// The most pixels an image may have: 1.6 GB while it is drawn.
const MAX_PIXELS: f64 = 4e8;

/// The `[atlas]` table.
pub(super) static ATLAS: TableSchema = TableSchema::new(
    "[atlas]",
    &[
        KeySchema::new(
            "format",
            ValueSchema::Integer([FORMAT_VERSION, FORMAT_VERSION]),
            "The version of the language of manifests.",
        )
        .with_default("1"),
        KeySchema::required("title", ValueSchema::Text, "The title of the atlas."),
        KeySchema::new(
            "output",
            ValueSchema::Text,
            "The folder results go to, relative to the manifest; / and \\ both part folders, on every system.",
        )
        .with_default("\"output\""),
        FORMATS.with_default("[\"svg\", \"png\"]"),
        KeySchema::new(
            "volume_pages",
            ValueSchema::Integer([1, MAX_VOLUME_PAGES]),
            "The most pages of a volume of the book.",
        )
        .with_default("1000"),
    ],
);

/// The `formats` of an atlas or a family.
pub(super) const FORMATS: KeySchema = KeySchema::new(
    "formats",
    ValueSchema::List(&ValueSchema::Word(|| Format::ALL.map(Format::name).to_vec()), [1, usize::MAX]),
    "The formats of pages: svg and png, a file for each page, and pdf, one book of all of them.",
);

/// The `[page]` table.
pub(super) static PAGE: TableSchema = TableSchema::new(
    "[page]",
    &[
        KeySchema::new(
            "paper",
            ValueSchema::AnyOf(&[ValueSchema::Word(|| words(&Paper::NAMED)), ValueSchema::Table(&PAPER)]),
            "The paper, by its name or its sides.",
        )
        .with_default("\"tabloid\""),
        KeySchema::new("dpi", ValueSchema::InRange(DPI_RANGE), "The resolution of PNG images, in pixels to the inch.")
            .with_default("100"),
        KeySchema::new("dash", ValueSchema::Quantity(Dimension::Angle), "How much input a dash and its gap span.")
            .with_default("\"5 deg\""),
        KeySchema::new(
            "text",
            ValueSchema::Word(|| words(&TEXT_MODES)),
            "How text stands in SVG: as text, or as outlines.",
        )
        .with_default("\"text\""),
        KeySchema::new(
            "theme",
            ValueSchema::AnyOf(&[theme::NAME_FORM, ValueSchema::Table(&theme::THEME)]),
            "What pages look like: a theme by its name, or one changed.",
        )
        .with_default("\"paper\""),
    ],
);

static PAPER: TableSchema = TableSchema::new(
    "a paper",
    &[
        KeySchema::required(
            "width",
            ValueSchema::Quantity(Dimension::PaperLength),
            "Its width, with a unit: mm, in or pt.",
        ),
        KeySchema::required(
            "height",
            ValueSchema::Quantity(Dimension::PaperLength),
            "Its height, with a unit: mm, in or pt.",
        ),
    ],
);

const DPI_RANGE: [f64; 2] = [10.0, 2400.0];

/// How text can stand in SVG.
const TEXT_MODES: [(&str, TextMode); 2] = [("text", TextMode::Text), ("outlines", TextMode::Outlines)];

pub(super) fn atlas<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<AtlasSettings> {
    let fields = Fields::from_value(value, &ATLAS, reader)?;
    let title = fields.required_text("title", "title = \"Straight-line coupler curves\"", reader);
    let output = match fields.get("output") {
        None => Some("output".to_owned()),
        Some(value) => reader.text(value).and_then(|text| {
            let folder = normalize_folder(&text, cfg!(windows));
            folder.map_err(|message| reader.report(Problem::error(value.span(), message).with_help(FOLDER_HELP))).ok()
        }),
    };
    let formats = match fields.get("formats") {
        None => Some(vec![Format::Svg, Format::Png]),
        Some(value) => formats(value, reader),
    };
    let volume_pages =
        fields.get("volume_pages").map_or(Some(1000), |value| reader.integer(value, 1, MAX_VOLUME_PAGES));
    Some(AtlasSettings { title: title?, output: output?, formats: formats?, volume_pages: volume_pages? })
}

const FOLDER_HELP: &str = "write a folder relative to the manifest, as in output = \"output\"";

/// The folder a manifest names, as this system writes it. Manifests go from system to system: `/` and `\` both part
/// folders on all of them. What only Windows has, a drive or a share, cannot be had elsewhere.
fn normalize_folder(text: &str, is_windows: bool) -> Result<String, &'static str> {
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
pub(super) fn formats<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Vec<Format>> {
    let list = reader.list(value)?;
    if list.is_empty() {
        reader
            .report(Problem::error(value.span(), "no format is named").with_help("write formats = [\"svg\", \"png\"]"));
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

pub(super) fn page<'t>(value: Option<&TomlValue<'t>>, reader: &mut TomlParser<'t>) -> Option<PageSettings> {
    let tabloid = Paper::NAMED[1].1;
    let default = PageSettings { options: Options::for_paper(tabloid), dpi: 100.0, text_mode: TextMode::default() };
    let Some(value) = value else { return Some(default) };
    let fields = Fields::from_value(value, &PAGE, reader)?;
    let paper = match fields.get("paper") {
        None => Some(tabloid),
        Some(value) => paper(value, reader),
    };
    let dpi = match fields.get("dpi") {
        None => Some(default.dpi),
        Some(value) => {
            read_within(value, reader, |value, reader| reader.constant(value), DPI_RANGE, "pixels to the inch")
        }
    };
    if let (Some(paper), Some(dpi), Some(value)) = (paper, dpi, fields.get("dpi")) {
        let pixels = paper.width * paper.height * dpi * dpi / (25.4 * 25.4);
        if pixels > MAX_PIXELS {
            let problem = Problem::error(value.span(), "an image of this paper would have too many pixels");
            reader.report(
                problem.with_help(format!("{:.0} dpi is the most for it", dpi * (MAX_PIXELS / pixels).sqrt() - 0.5)),
            );
        }
    }
    let dash_deg = match fields.get("dash") {
        None => Some(default.options.dash_deg),
        Some(value) => {
            let read =
                |value: &TomlValue<'t>, reader: &mut TomlParser<'t>| reader.constant_quantity(value, Dimension::Angle);
            read_within(value, reader, read, [0.1, 360.0], "degrees of input")
        }
    };
    let text = match fields.get("text") {
        None => Some(TextMode::default()),
        Some(value) => reader.word(value, &TEXT_MODES),
    };
    let theme = fields.get("theme").map_or_else(Theme::default, |value| theme::read(value, reader));
    Some(PageSettings { options: Options { paper: paper?, dash_deg: dash_deg?, theme }, dpi: dpi?, text_mode: text? })
}

fn paper<'t>(value: &TomlValue<'t>, reader: &mut TomlParser<'t>) -> Option<Paper> {
    if value.get_ref().is_str() {
        return reader.word(value, &Paper::NAMED);
    }
    let fields = Fields::from_value(value, &PAPER, reader)?;
    let mut side = |key: &str| {
        let value = fields.required(key, &format!("{key} = \"279 mm\""), reader)?;
        let read = |value: &TomlValue<'t>, reader: &mut TomlParser<'t>| {
            reader.constant_quantity(value, Dimension::PaperLength)
        };
        read_within(value, reader, read, Paper::SIDE_RANGE, "mm")
    };
    let (width, height) = (side("width"), side("height"));
    Some(Paper { width: width?, height: height? })
}

/// A value that must lie between two others.
pub(super) fn read_within<'t>(
    value: &TomlValue<'t>,
    reader: &mut TomlParser<'t>,
    read: impl Fn(&TomlValue<'t>, &mut TomlParser<'t>) -> Option<f64>,
    [least, most]: [f64; 2],
    what: &str,
) -> Option<f64> {
    let number = read(value, reader)?;
    if (least..=most).contains(&number) {
        return Some(number);
    }
    let problem = Problem::error(value.span(), format!("{number} {what} is out of range"));
    reader.report(problem.with_help(format!("give {least} to {most} {what}")));
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
            assert_eq!(normalize_folder(text, false).as_deref(), elsewhere.as_deref(), "{text}");
            assert_eq!(normalize_folder(text, true).is_ok(), elsewhere != Err("this names no folder"), "{text}");
        }
    }
}
