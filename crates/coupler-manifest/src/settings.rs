//! Reads the tables `[atlas]` and `[page]`.

use crate::bounded_number::read_within;
use crate::default_value;
use crate::files::FileReader;
use crate::format_version::FORMAT_VERSION;
use crate::theme;
use coupler_curves::expression::Dimension;
use coupler_curves::family::LengthUnit;
use coupler_curves::linkage_format::{Fields, KeySchema, TableSchema, TomlParser, TomlValue, ValueSchema, words};
use coupler_curves::problem::Problem;
use coupler_drawing::page::{Options, Paper};
use coupler_drawing::render::{Format, TextMode};

/// The settings of `[atlas]`.
pub(crate) struct AtlasSettings {
    pub title: String,
    pub output: Option<String>,
    /// The unit of lengths of families that have none of their own.
    pub unit: Option<LengthUnit>,
    pub formats: Vec<Format>,
    pub volume_pages: usize,
}

/// The default formats of pages.
const DEFAULT_FORMATS: [Format; 2] = [Format::Svg, Format::Png];

/// The default of `volume_pages`.
const DEFAULT_VOLUME_PAGES: usize = 1000;

/// The most pages a volume may have: PDF readers, and the memory of a run, cannot cope with more.
const MAX_VOLUME_PAGES: usize = 10_000;

/// The default paper, with its name.
const DEFAULT_PAPER: (&str, Paper) = Paper::NAMED[1];

/// The settings of `[page]`.
pub(crate) struct PageSettings {
    pub options: Options,
    pub dpi: f64,
    pub text_mode: TextMode,
}

impl Default for PageSettings {
    fn default() -> PageSettings {
        PageSettings { options: Options::for_paper(DEFAULT_PAPER.1), dpi: 100.0, text_mode: TextMode::default() }
    }
}

/// The most pixels of an image; it takes 1.6 GB while it is drawn.
const MAX_PIXELS: f64 = 4e8;

/// The `[atlas]` table.
pub(crate) static ATLAS: TableSchema = TableSchema::new(
    "[atlas]",
    &[
        KeySchema::new(
            "format",
            ValueSchema::Integer([FORMAT_VERSION, FORMAT_VERSION]),
            "The version of the manifest format.",
        )
        .with_default(|| FORMAT_VERSION.to_string()),
        KeySchema::required("title", ValueSchema::Text, "The title of the atlas."),
        KeySchema::new(
            "output",
            ValueSchema::Text,
            "The output folder, relative to the manifest; by default the manifest's file name without its extension. / and \\ \
             both separate folders, on every system.",
        ),
        FORMATS.with_default(|| default_value::strings(DEFAULT_FORMATS.map(Format::name))),
        UNIT,
        KeySchema::new(
            "volume_pages",
            ValueSchema::Integer([1, MAX_VOLUME_PAGES]),
            "The most pages of a volume of the book.",
        )
        .with_default(|| DEFAULT_VOLUME_PAGES.to_string()),
    ],
);

/// The `formats` of an atlas or a family.
pub(crate) const FORMATS: KeySchema = KeySchema::new(
    "formats",
    ValueSchema::List(&ValueSchema::Word(|| Format::ALL.map(Format::name).to_vec()), [1, usize::MAX]),
    "The formats of pages: svg and png, a file for each page, and pdf, one book of all of them.",
);

/// The `unit` of an atlas or a family.
pub(crate) const UNIT: KeySchema = KeySchema::new(
    "unit",
    ValueSchema::Word(|| words(&LengthUnit::ALL)),
    "The unit of all lengths, which pages and drawings state; by default they are in a unit of their own.",
);

/// The `[page]` table.
pub(crate) static PAGE: TableSchema = TableSchema::new(
    "[page]",
    &[
        KeySchema::new(
            "paper",
            ValueSchema::AnyOf(&[ValueSchema::Word(|| words(&Paper::NAMED)), ValueSchema::Table(&PAPER)]),
            "The paper: its name, or a table of its sides.",
        )
        .with_default(|| default_value::string(DEFAULT_PAPER.0)),
        KeySchema::new(
            "orientation",
            ValueSchema::Word(|| words(&ORIENTATIONS)),
            "Whether the longer side of the paper is its width or its height; by default that of a named paper is its width.",
        ),
        KeySchema::new("dpi", ValueSchema::InRange(DPI_RANGE), "The resolution of PNG images, in pixels per inch.")
            .with_default(|| PageSettings::default().dpi.to_string()),
        KeySchema::new(
            "dash",
            ValueSchema::Quantity(Dimension::Angle),
            "The range of the input that a dash and its gap span.",
        )
        .with_default(|| default_value::degrees(PageSettings::default().options.dash_deg)),
        KeySchema::new(
            "text",
            ValueSchema::Word(|| words(&TEXT_MODES)),
            "How text is written in SVG: as text, or as outlines.",
        )
        .with_default(|| default_value::word(&TEXT_MODES, &PageSettings::default().text_mode)),
        KeySchema::new(
            "theme",
            ValueSchema::AnyOf(&[theme::NAME_FORM, ValueSchema::Table(&theme::THEME)]),
            "The appearance of pages: the name of a theme, or a table that modifies one.",
        )
        .with_default(theme::default_name),
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

/// The words for orientations: whether the longer side is the height.
const ORIENTATIONS: [(&str, bool); 2] = [("landscape", false), ("portrait", true)];

/// The words for text modes.
const TEXT_MODES: [(&str, TextMode); 2] = [("text", TextMode::Text), ("outlines", TextMode::Outlines)];

/// Reads `[atlas]`; formats that are not `writable` are errors.
pub(crate) fn atlas<'t>(
    value: &TomlValue<'t>,
    writable: &[Format],
    parser: &mut TomlParser<'t>,
) -> Option<AtlasSettings> {
    let fields = Fields::from_value(value, &ATLAS, parser)?;
    let title = fields.required_text("title", "title = \"Straight-line coupler curves\"", parser);
    let output = match fields.get("output") {
        None => Some(None),
        Some(value) => parser.text(value).and_then(|text| {
            let folder = normalize_folder(&text, cfg!(windows));
            let folder = folder.map_err(|message| Problem::error(value.span(), message).with_help(FOLDER_HELP));
            folder.map(Some).map_err(|problem| parser.report(problem)).ok()
        }),
    };
    let formats = match fields.get("formats") {
        None => Some(DEFAULT_FORMATS.to_vec()),
        Some(value) => formats(value, writable, parser),
    };
    let volume_pages = match fields.get("volume_pages") {
        None => Some(DEFAULT_VOLUME_PAGES),
        Some(value) => parser.integer(value, 1, MAX_VOLUME_PAGES),
    };
    let unit = match fields.get("unit") {
        None => Some(None),
        Some(value) => parser.word(value, &LengthUnit::ALL).map(Some),
    };
    let (title, output, unit) = (title?, output?, unit?);
    Some(AtlasSettings { title, output, unit, formats: formats?, volume_pages: volume_pages? })
}

const FOLDER_HELP: &str = "write a folder relative to the manifest, as in output = \"output\"";

/// The path of a folder on this system. Manifests are shared between systems, so `/` and `\` both separate folders
/// everywhere. Drives and network shares are errors on other systems than Windows.
fn normalize_folder(text: &str, is_windows: bool) -> Result<String, &'static str> {
    let has_drive = text.as_bytes().get(1) == Some(&b':') && text.as_bytes()[0].is_ascii_alphabetic();
    if text.is_empty() || text.contains('\0') {
        Err("this is not the name of a folder")
    } else if is_windows {
        Ok(text.to_owned())
    } else if has_drive || text.starts_with("\\\\") {
        Err("drives and network shares exist only on Windows")
    } else {
        Ok(text.replace('\\', "/"))
    }
}

/// Reads a list of formats; repeated formats are dropped, and those that are not `writable` are errors.
pub(crate) fn formats<'t>(
    value: &TomlValue<'t>,
    writable: &[Format],
    parser: &mut TomlParser<'t>,
) -> Option<Vec<Format>> {
    let list = parser.list(value)?;
    if list.is_empty() {
        parser
            .report(Problem::error(value.span(), "`formats` is empty").with_help("write formats = [\"svg\", \"png\"]"));
        return None;
    }
    let words = Format::ALL.map(|format| (format.name(), format));
    let mut formats = Vec::new();
    let mut all_read = true;
    for item in list {
        match parser.word(item, &words) {
            Some(format) if !writable.contains(&format) => {
                let problem = Problem::error(item.span(), format!("this build cannot write `{}`", format.name()));
                parser.report(problem.with_help("leave the format out, or build the program with the feature `pdf`"));
                all_read = false;
            }
            Some(format) if !formats.contains(&format) => formats.push(format),
            Some(_) => {}
            None => all_read = false,
        }
    }
    all_read.then_some(formats)
}

/// Reads `[page]`; the defaults if there is none.
pub(crate) fn page<'t>(
    value: Option<&TomlValue<'t>>,
    files: FileReader,
    parser: &mut TomlParser<'t>,
) -> Option<PageSettings> {
    let default = PageSettings::default();
    let Some(value) = value else { return Some(default) };
    let fields = Fields::from_value(value, &PAGE, parser)?;
    let paper = match fields.get("paper") {
        None => Some(default.options.paper),
        Some(value) => paper(value, parser),
    };
    let is_portrait = match fields.get("orientation") {
        None => Some(None),
        Some(value) => parser.word(value, &ORIENTATIONS).map(Some),
    };
    let paper = paper.map(|paper| match is_portrait.flatten() {
        Some(is_portrait) => paper.turned(is_portrait),
        None => paper,
    });
    let dpi = match fields.get("dpi") {
        None => Some(default.dpi),
        Some(value) => {
            read_within(value, parser, |value, parser| parser.constant(value), DPI_RANGE, "pixels to the inch")
        }
    };
    if let (Some(paper), Some(dpi), Some(value)) = (paper, dpi, fields.get("dpi")) {
        let pixels = paper.width * paper.height * dpi * dpi / (25.4 * 25.4);
        if pixels > MAX_PIXELS {
            let problem = Problem::error(value.span(), "an image of this paper would have too many pixels");
            parser.report(
                problem
                    .with_help(format!("give at most {:.0} for this paper", dpi * (MAX_PIXELS / pixels).sqrt() - 0.5)),
            );
        }
    }
    let dash_deg = match fields.get("dash") {
        None => Some(default.options.dash_deg),
        Some(value) => {
            let read =
                |value: &TomlValue<'t>, parser: &mut TomlParser<'t>| parser.constant_quantity(value, Dimension::Angle);
            read_within(value, parser, read, [0.1, 360.0], "degrees of input")
        }
    };
    let text = match fields.get("text") {
        None => Some(default.text_mode),
        Some(value) => parser.word(value, &TEXT_MODES),
    };
    let theme = fields.get("theme").map_or(default.options.theme, |value| theme::read(value, files, parser));
    let options = Options::for_paper(paper?).with_dash_deg(dash_deg?).with_theme(theme);
    is_portrait?;
    Some(PageSettings { options, dpi: dpi?, text_mode: text? })
}

/// Reads a paper, by its name or its sides.
fn paper<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Paper> {
    if let Some(text) = value.get_ref().as_str() {
        let named = Paper::NAMED.into_iter().find(|(name, _)| name.eq_ignore_ascii_case(text));
        return named.map(|(_, paper)| paper).or_else(|| parser.word(value, &Paper::NAMED));
    }
    let fields = Fields::from_value(value, &PAPER, parser)?;
    let mut side = |key: &str| {
        let value = fields.required(key, &format!("{key} = \"279 mm\""), parser)?;
        let read = |value: &TomlValue<'t>, parser: &mut TomlParser<'t>| {
            parser.constant_quantity(value, Dimension::PaperLength)
        };
        read_within(value, parser, read, Paper::SIDE_RANGE, "mm")
    };
    let (width, height) = (side("width"), side("height"));
    Some(Paper { width: width?, height: height? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backslashes_separate_folders_everywhere() {
        for (text, elsewhere) in [
            ("out", Ok("out")),
            ("..\\out", Ok("../out")),
            ("..\\a/b\\", Ok("../a/b/")),
            ("/srv/out", Ok("/srv/out")),
            ("C:\\out", Err("drives and network shares exist only on Windows")),
            ("c:out", Err("drives and network shares exist only on Windows")),
            ("\\\\server\\share", Err("drives and network shares exist only on Windows")),
            ("", Err("this is not the name of a folder")),
            ("a\0b", Err("this is not the name of a folder")),
        ] {
            assert_eq!(normalize_folder(text, false).as_deref(), elsewhere.as_deref(), "{text}");
            assert_eq!(
                normalize_folder(text, true).is_ok(),
                elsewhere != Err("this is not the name of a folder"),
                "{text}"
            );
        }
    }
}
