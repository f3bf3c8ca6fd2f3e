//! The pages of a family, held against what is drawn now, and against the recorded points.

use std::collections::HashMap;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use super::finding::{Change, Finding, Place};
use super::tables::altered;
use super::track::Track;
use crate::press::{Leaf, Matter, Press, page_name};
use crate::record::{FamilyRecord, FileRecord, Flaw, LineDigests, drawn_curves, is_whole_png, open_plain};
use coupler_curves::solve::Solved;
use coupler_drawing::render::{self, PageFormat};

/// The recorded pages of a family.
pub(super) struct Pages<'a> {
    press: &'a Press<'a>,
    folder: PathBuf,
    place: Place,
    files: HashMap<&'a str, &'a FileRecord>,
}

/// What is found of a page.
#[derive(Default)]
pub(super) struct Page {
    /// The cells on it; all that the family has, where none is named.
    cells: Vec<usize>,
    /// Its files that are not what would be drawn now, though they are what was recorded.
    differing: Vec<String>,
    findings: Vec<Finding>,
}

/// A curve is drawn where its points are if it is no further from them, in millimetres on paper.
const DRAWN_OFF: f64 = 0.01;

/// A page of more bytes is none of this program's.
const MOST_BYTES: u64 = 1 << 28;

impl<'a> Pages<'a> {
    pub fn new(press: &'a Press<'a>, record: &'a FamilyRecord, output: &Path) -> Pages<'a> {
        let id = &press.composer.planned.family.id;
        let files = record.files.iter().map(|file| (file.name.as_str(), file)).collect();
        Pages { press, folder: output.join(id), place: Place::family(id), files }
    }

    /// Holds the files of a page against what is drawn now, and against the recorded curves of its cells.
    pub fn check(&self, leaf: Leaf, recorded: impl Fn(usize) -> Option<Vec<Track>>) -> Page {
        let cells = match leaf.matter {
            Matter::Cells { cells, .. } => cells.iter().map(|solved| solved.cell.number).collect(),
            Matter::Charts => Vec::new(),
        };
        let mut page = Page { cells, ..Page::default() };
        let plan = self.press.composer.plan;
        let name = |format| page_name(&self.place.family, leaf.page, format);
        let [svg_name, png_name] = PageFormat::ALL.map(name);
        let (svg_record, png_record) = (self.files.get(svg_name.as_str()), self.files.get(png_name.as_str()));
        if svg_record.is_none() && png_record.is_none() {
            return page;
        }
        let matter = leaf.matter;
        let svg = render::svg(&leaf.compose(), plan.text);
        if let Some(record) = svg_record {
            let found = self.svg(record, &svg, &mut page);
            if let (Some(bytes), Matter::Cells { cells, .. }) = (found, matter) {
                page.findings.extend(self.drawn(record, &bytes, cells, recorded));
            }
        }
        if let Some(record) = png_record {
            let drawn = FileRecord::of_drawing(&record.name, &svg, plan.dpi);
            if record.drawn_from_sha256 != drawn.drawn_from_sha256 {
                page.differing.push(record.name.clone());
            }
            let wrong = match read(&self.folder.join(&record.name)) {
                Ok(bytes) if is_whole_png(&bytes) => None,
                Ok(_) => Some("is no whole image".to_owned()),
                Err(flaw) => Some(flaw.to_string()),
            };
            page.findings.extend(wrong.map(|wrong| self.file(&record.name).has(Change::Damaged { wrong })));
        }
        page
    }

    /// Holds the bytes of a page against what is drawn now, and gives them.
    fn svg(&self, record: &FileRecord, fresh: &[u8], page: &mut Page) -> Option<Vec<u8>> {
        let place = self.file(&record.name);
        let bytes = match read(&self.folder.join(&record.name)) {
            Ok(bytes) => bytes,
            Err(flaw) => {
                page.findings.push(place.has(Change::Damaged { wrong: flaw.to_string() }));
                return None;
            }
        };
        let mut digests = LineDigests::default();
        // A digest takes whatever it is given.
        let _ = digests.write_all(&bytes);
        let change = altered(Some(record), &digests.finish());
        if change.is_none() && bytes != fresh {
            page.differing.push(record.name.clone());
        }
        page.findings.extend(change.map(|change| place.has(change)));
        Some(bytes)
    }

    /// Reads the curves of a page back, and holds them against the recorded points.
    fn drawn(
        &self,
        record: &FileRecord,
        bytes: &[u8],
        cells: &[Solved],
        recorded: impl Fn(usize) -> Option<Vec<Track>>,
    ) -> Vec<Finding> {
        let place = self.file(&record.name);
        let curves = match drawn_curves(bytes) {
            Ok(curves) => curves,
            Err(error) => return vec![place.has(Change::Damaged { wrong: error.to_string() })],
        };
        let mut findings = Vec::new();
        let mut of_cell: Option<(usize, Vec<Track>)> = None;
        for curve in curves {
            // The curves of a cell stand together.
            if of_cell.as_ref().is_none_or(|(cell, _)| *cell != curve.cell) {
                of_cell = Some((curve.cell, recorded(curve.cell).unwrap_or_default()));
            }
            let mut tracks = of_cell.iter().flat_map(|(_, tracks)| tracks);
            let ours = |track: &&Track| (track.trace, track.circuit) == (curve.trace, curve.circuit);
            let Some(track) = tracks.find(ours) else { continue };
            let of = cells.iter().find(|solved| solved.cell.number == curve.cell).or(cells.first());
            let circuit = of.and_then(|solved| solved.motion.circuits.get(curve.circuit.checked_sub(1)?));
            let closed = circuit.is_none_or(|circuit| circuit.closed);
            let samples = track.input.iter().copied().zip(track.points.iter().copied());
            let off = curve.furthest(samples, closed).map_or(0.0, |(_, distance)| distance);
            let off = off.max(curve.strays(&track.points, closed).map_or(0.0, |strays| strays + DRAWN_OFF));
            if off > DRAWN_OFF {
                let place = place.cell(curve.cell).curve(curve.trace, curve.circuit);
                findings.push(place.has(Change::DrawnOff { distance_mm: off }));
            }
        }
        findings
    }

    /// What is found on pages: of those that differ, which do so though their cells have not changed.
    pub fn findings(&self, pages: Vec<Page>, changed: &[usize]) -> Vec<Finding> {
        let mut findings = Vec::new();
        for page in pages {
            let is_due = match page.cells.is_empty() {
                true => !changed.is_empty(),
                false => page.cells.iter().any(|cell| changed.contains(cell)),
            };
            // Of a cell whose points have changed the page cannot be right.
            let is_due_to_points = |finding: &Finding| {
                let of_changed = finding.place.cell.is_some_and(|cell| changed.contains(&cell));
                of_changed && matches!(finding.change, Change::DrawnOff { .. })
            };
            findings.extend(page.findings.into_iter().filter(|finding| !is_due_to_points(finding)));
            if !is_due {
                findings.extend(page.differing.iter().map(|name| self.file(name).has(Change::Drawing)));
            }
        }
        findings
    }

    fn file(&self, name: &str) -> Place {
        self.place.file(&format!("{}/{name}", self.place.family))
    }
}

/// What is wrong with a volume of the book: its bytes may differ from machine to machine, but it is a file.
pub(super) fn missing(output: &Path, name: &str) -> Option<Finding> {
    // A record may name anything; a volume is in the atlas's folder.
    let is_plain = Path::new(name).components().count() == 1;
    let found = if is_plain { open_plain(&output.join(name), u64::MAX).map(drop) } else { Err(Flaw::Missing) };
    found.err().map(|flaw| Place::default().file(name).has(Change::Damaged { wrong: flaw.to_string() }))
}

/// The bytes of a file, or what is wrong with it.
fn read(path: &Path) -> Result<Vec<u8>, Flaw> {
    let mut bytes = Vec::new();
    match open_plain(path, MOST_BYTES)?.take(MOST_BYTES).read_to_end(&mut bytes) {
        Ok(_) => Ok(bytes),
        Err(error) => Err(Flaw::Unreadable(error.to_string())),
    }
}
