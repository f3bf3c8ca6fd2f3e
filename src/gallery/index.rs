use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::parts::{SCRIPTS, STYLES, joined};
use crate::record::{FamilyRecord, Run};
use coupler_curves::measure;

/// A family as the gallery shows it.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// What was written of it.
    pub record: &'a FamilyRecord,
    /// How many bytes its script has.
    pub bytes: u64,
}

/// The name of the page, in the atlas's folder.
pub const PAGE: &str = "index.html";

/// The page, with `{{…}}` for what is put in.
const TEXT: &str = include_str!("index.html");

/// `index.html`: the gallery of what a run has written.
pub fn index(run: &Run, families: &[Shown]) -> String {
    let style: String = STYLES.iter().map(|part| part.text).collect();
    let script = joined(SCRIPTS);
    // Text between tags: a tag of the page's own must not end in it.
    let data = atlas(run, families).to_string().replace('<', "\\u003c");
    let parts = [
        ("title", escaped(&run.title)),
        ("policy", policy(&style, &script)),
        ("style", style),
        ("atlas", data),
        ("script", script),
    ];
    let mut page = String::new();
    let mut rest = TEXT;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        page.push_str(parts.iter().find(|(known, _)| *known == name).map_or("", |(_, text)| text));
        rest = after;
    }
    page.push_str(rest);
    page
}

/// What the page may do: run its own script and the scripts of data beside it, and show the pages; nothing else.
fn policy(style: &str, script: &str) -> String {
    let digest = |text: &str| BASE64_STANDARD.encode(Sha256::digest(text.as_bytes()));
    format!(
        "default-src 'none'; script-src 'self' 'sha256-{}'; style-src 'sha256-{}'; img-src 'self' data: blob:; \
         base-uri 'none'; form-action 'none'",
        digest(script),
        digest(style)
    )
}

fn atlas(run: &Run, families: &[Shown]) -> Value {
    let measure =
        |m: &measure::Measure| json!({ "name": m.name, "unit": m.unit, "definition": m.definition, "word": m.is_word });
    json!({
        "format": 1,
        "title": run.title,
        "program": format!("{} {}", run.program, run.version),
        "measures": measure::ALL.iter().map(measure).collect::<Vec<_>>(),
        "families": families.iter().map(family).collect::<Vec<_>>(),
        "book": run.book.iter().flat_map(|book| &book.files).map(|file| file.name.as_str()).collect::<Vec<_>>(),
    })
}

fn family(shown: &Shown) -> Value {
    let record = shown.record;
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
        "script": has(super::SCRIPT).then(|| format!("{}/{}", record.id, super::SCRIPT)),
        "bytes": shown.bytes,
    })
}

/// Text between tags and in attributes.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
