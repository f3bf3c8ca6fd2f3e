//! `index.html`, the page of the gallery.

use std::io::{self, Write};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::assets::{compact, join_modules, scripts, styles};
use super::kernel_script::{KERNEL_FILE, kernel_digest, kernel_file};
use super::piece::PieceSeries;
use super::pieces::{is_data_file_name, parse_piece_file_name};
use crate::manifest::PlannedFamily;
use crate::record::{FamilyRecord, RunRecord};
use coupler_curves::measure;
use coupler_drawing::page::Paper;

/// A family in the gallery.
#[derive(Clone, Copy, Debug)]
pub struct GalleryFamily<'a> {
    /// The record of the family.
    pub record: &'a FamilyRecord,
    /// The sizes of its data.
    pub bytes: DataBytes,
    /// What it is in the plan of the run; `None` if it is not in it.
    pub planned: Option<&'a PlannedFamily>,
}

/// The sizes of a family's data, in bytes.
#[derive(Clone, Copy, Debug, Default)]
pub struct DataBytes {
    /// Of all its data.
    pub all: u64,
    /// Of what is read to find its curves by their measures.
    pub table: u64,
}

impl DataBytes {
    /// The sizes of the data among the files of a family, given the size of a file by its name.
    pub fn new<E>(record: &FamilyRecord, size_of: impl Fn(&str) -> Result<u64, E>) -> Result<DataBytes, E> {
        let mut bytes = DataBytes::default();
        for file in record.files.iter().filter(|file| is_data_file_name(&file.name)) {
            let size = size_of(&file.name)?;
            bytes.all += size;
            let has_points = parse_piece_file_name(&file.name).is_some_and(|(series, _)| series == PieceSeries::Curves);
            bytes.table += if has_points { 0 } else { size };
        }
        Ok(bytes)
    }
}

/// The name of the page in the folder of the atlas.
pub const PAGE_FILE: &str = "index.html";

/// The page, with placeholders like `{{title}}`.
const PAGE_TEMPLATE: &str = include_str!("index.html");

/// The script that unpacks the page's style sheet, and unpacks and runs its script.
const LOADER: &str = include_str!("loader.js");

/// The text of `index.html`, for the families of a run with pages on a paper.
pub fn index_html(run: &RunRecord, paper: Paper, families: &[GalleryFamily]) -> String {
    page_html(&run.title, &atlas_json(run, paper, families), "'self' ")
}

/// The text of a page with one plate, that of a curve by the number of its cell in a family, its trace and its circuit, all from 1, and with all that
/// it needs in it: it opens anywhere. The page itself saves the same of a plate.
///
/// The cell must be one of the family, and have this curve.
pub fn plate_html(planned: &PlannedFamily, cell: usize, [trace, circuit]: [usize; 2]) -> String {
    let family = &planned.family;
    let values = family.cell(cell - 1).values;
    let assigned = family.space.slots_of(cell - 1).map(|slot| (&family.names[slot], values[slot]));
    let key = format!("{cell}.{trace}.{circuit}");
    let plate = json!({
        "address": format!("#/{}/curve/{key}", family.id),
        "key": key,
        "id": family.id,
        "title": family.title,
        "manifest": planned.excerpt(),
        "ranges": values.iter().map(|value| [value, value]).collect::<Vec<_>>(),
        "free": family.space.assigned_slots(),
        "request": {
            "cell": cell,
            "curve": [trace, circuit],
            "values": assigned.collect::<Vec<_>>(),
            "changes": Vec::<(String, f64)>::new(),
        },
    });
    let mut summary = summary(&family.title, crate::PROGRAM, kernel_file());
    summary["plate"] = plate;
    page_html(&format!("{}, {key}", family.title), &summary, "")
}

/// The page with a summary of an atlas. Its policy allows scripts and pictures from `sources` in addition to those in the page.
///
/// # Panics
///
/// Never: its style sheet and its script are compressed in memory.
fn page_html(title: &str, summary: &Value, sources: &str) -> String {
    // Without indentation and empty lines.
    let lines = styles().iter().flat_map(|part| part.text.lines()).map(str::trim_start).filter(|line| !line.is_empty());
    let style: String = lines.flat_map(|line| [line, "\n"]).collect();
    let script = join_modules(scripts());
    let loader = compact(LOADER.lines());
    // Escaped, so that the data cannot end its script element.
    let data = summary.to_string().replace('<', "\\u003c");
    let packed = |text: &str| BASE64_STANDARD.encode(gzip(text.as_bytes()).expect("memory takes all bytes"));
    let parts = [
        ("title", escape_html(title)),
        ("policy", content_security_policy(&style, [&loader, &script], sources)),
        ("atlas", data),
        ("packed_style", packed(&style)),
        ("packed_script", packed(&script)),
        ("loader", loader),
    ];
    let mut page = String::new();
    let mut rest = PAGE_TEMPLATE;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        page.push_str(parts.iter().find(|(known, _)| *known == name).map_or("", |(_, text)| text));
        rest = after;
    }
    page.push_str(rest);
    page
}

/// The policy by which the page may only run its own script, the scripts in its folder and modules for WebAssembly, make
/// workers of its own, and show images.
fn content_security_policy(style: &str, scripts: [&str; 2], sources: &str) -> String {
    let digest = |text: &str| format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(text.as_bytes())));
    format!(
        "default-src 'none'; script-src {sources}'wasm-unsafe-eval' {}; style-src {}; img-src {sources}data: blob:; \
         worker-src blob:; base-uri 'none'; form-action 'none'",
        scripts.map(digest).join(" "),
        digest(style)
    )
}

/// Bytes compressed with gzip, the same on every machine.
fn gzip(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

fn atlas_json(run: &RunRecord, paper: Paper, families: &[GalleryFamily]) -> Value {
    let kernel = json!({ "script": KERNEL_FILE, "sha256": kernel_digest().to_string() });
    let mut summary = summary(&run.title, &format!("{} {}", run.program, run.version), kernel);
    summary["paper"] = json!({ "width": paper.width, "height": paper.height });
    summary["families"] = families.iter().map(family_json).collect();
    summary["book"] = run.book.iter().flat_map(|book| &book.files).map(|file| file.name.as_str()).collect();
    summary
}

/// The summary of an atlas without families and books.
fn summary(title: &str, program: &str, kernel: Value) -> Value {
    let measure = |m: &measure::Measure| {
        let is_input = m.length_name.is_some();
        json!({
            "name": m.name, "title": m.title, "unit": m.unit, "definition": m.definition, "word": m.is_word, "is_input": is_input,
            "is_more_better": m.is_more_better
        })
    };
    json!({
        "format": 3,
        "title": title,
        "program": program,
        "measures": measure::ALL.iter().map(measure).collect::<Vec<_>>(),
        "kernel": kernel,
        "families": [],
        "book": [],
    })
}

fn family_json(family: &GalleryFamily) -> Value {
    let record = family.record;
    let has = |ending: &str| record.files.iter().any(|file| file.name.ends_with(ending));
    let format = [".svg", ".png"].into_iter().find(|ending| has(ending)).map(|ending| &ending[1..]);
    json!({
        "id": record.id,
        "title": record.title,
        "linkage": record.linkage,
        "source": family.planned.map(|planned| planned.family.source_without_legend(&planned.source)),
        "cells": record.cells,
        "kept": record.kept,
        "curves": record.curves,
        "not_assembled": record.not_assembled,
        "pages": record.pages,
        "page_format": format,
        "script": has(super::SCRIPT_FILE).then(|| format!("{}/{}", record.id, super::SCRIPT_FILE)),
        "bytes": family.bytes.all,
        "table_bytes": family.bytes.table,
    })
}

/// Escapes text for elements and attributes.
fn escape_html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
