//! `index.html`, the page of the gallery.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::assets::{SCRIPTS, STYLES, join_modules};
use super::pieces::{PieceSeries, is_data_file_name, parse_piece_file_name};
use crate::record::{FamilyRecord, RunRecord};
use coupler_curves::measure;

/// A family in the gallery.
#[derive(Clone, Copy, Debug)]
pub struct GalleryFamily<'a> {
    /// The record of the family.
    pub record: &'a FamilyRecord,
    /// The sizes of its data.
    pub bytes: DataBytes,
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
    pub fn new(record: &FamilyRecord, size_of: impl Fn(&str) -> u64) -> DataBytes {
        let mut bytes = DataBytes::default();
        for file in record.files.iter().filter(|file| is_data_file_name(&file.name)) {
            let size = size_of(&file.name);
            bytes.all += size;
            let has_points = parse_piece_file_name(&file.name).is_some_and(|(series, _)| series == PieceSeries::Curves);
            bytes.table += if has_points { 0 } else { size };
        }
        bytes
    }
}

/// The name of the page in the folder of the atlas.
pub const PAGE_FILE: &str = "index.html";

/// The page, with placeholders like `{{title}}`.
const PAGE_TEMPLATE: &str = include_str!("index.html");

/// The text of `index.html`, for the families of a run.
pub fn index_html(run: &RunRecord, families: &[GalleryFamily]) -> String {
    let style: String = STYLES.iter().map(|part| part.text).collect();
    let script = join_modules(SCRIPTS);
    // Escaped, so that the data cannot end its script element.
    let data = atlas_json(run, families).to_string().replace('<', "\\u003c");
    let parts = [
        ("title", escape_html(&run.title)),
        ("policy", content_security_policy(&style, &script)),
        ("style", style),
        ("atlas", data),
        ("script", script),
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

/// The policy by which the page may only run its own script and the scripts in its folder, and show images.
fn content_security_policy(style: &str, script: &str) -> String {
    let digest = |text: &str| BASE64_STANDARD.encode(Sha256::digest(text.as_bytes()));
    format!(
        "default-src 'none'; script-src 'self' 'sha256-{}'; style-src 'sha256-{}'; img-src 'self' data: blob:; \
         base-uri 'none'; form-action 'none'",
        digest(script),
        digest(style)
    )
}

fn atlas_json(run: &RunRecord, families: &[GalleryFamily]) -> Value {
    let measure =
        |m: &measure::Measure| json!({ "name": m.name, "unit": m.unit, "definition": m.definition, "word": m.is_word });
    json!({
        "format": 2,
        "title": run.title,
        "program": format!("{} {}", run.program, run.version),
        "measures": measure::ALL.iter().map(measure).collect::<Vec<_>>(),
        "families": families.iter().map(family_json).collect::<Vec<_>>(),
        "book": run.book.iter().flat_map(|book| &book.files).map(|file| file.name.as_str()).collect::<Vec<_>>(),
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
