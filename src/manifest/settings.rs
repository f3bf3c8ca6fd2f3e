//! The tables `[atlas]` and `[page]`.

use super::theme;
use crate::expression::Dimension;
use crate::notation::{Fields, Reader, Value};
use crate::page::{Options, Paper, Theme};
use crate::problem::Problem;
use crate::render::{Format, TextMode};

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

pub(super) fn atlas<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Atlas> {
    let fields = Fields::of(value, "[atlas]", &["title", "output", "formats", "volume_pages"], reader)?;
    let title = fields.required_text("title", "title = \"Straight-line coupler curves\"", reader);
    let output = match fields.get("output") {
        None => Some("output".to_owned()),
        Some(value) => reader.text(value).filter(|text| {
            if text.is_empty() {
                reader.note(Problem::error(value.span(), "this names no folder").help("write output = \"output\""));
            }
            !text.is_empty()
        }),
    };
    let formats = match fields.get("formats") {
        None => Some(vec![Format::Svg, Format::Png]),
        Some(value) => formats(value, reader),
    };
    let volume_pages = fields.get("volume_pages").map_or(Some(1000), |value| reader.count(value, 1, MAX_VOLUME));
    Some(Atlas { title: title?, output: output?, formats: formats?, volume_pages: volume_pages? })
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
    let fields = Fields::of(value, "[page]", &["paper", "dpi", "dash", "text", "theme"], reader)?;
    let paper = match fields.get("paper") {
        None => Some(tabloid),
        Some(value) => paper(value, reader),
    };
    let dpi = match fields.get("dpi") {
        None => Some(default.dpi),
        Some(value) => {
            within(value, reader, |value, reader| reader.constant(value), [10.0, 2400.0], "pixels to the inch")
        }
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
        Some(value) => reader.word(value, &[("text", TextMode::Text), ("outlines", TextMode::Outlines)]),
    };
    let theme = fields.get("theme").map_or_else(Theme::default, |value| theme::read(value, reader));
    Some(Page { options: Options { paper: paper?, dash_deg: dash_deg?, theme }, dpi: dpi?, text: text? })
}

fn paper<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Paper> {
    if value.get_ref().is_str() {
        return reader.word(value, &Paper::NAMED);
    }
    let fields = Fields::of(value, "a paper", &["width", "height"], reader)?;
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
