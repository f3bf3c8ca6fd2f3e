//! The pages of a family, held against what is drawn now, and against the recorded points.

use std::collections::HashMap;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use super::curve_samples::CurveSamples;
use super::finding::{Change, Finding, Location};
use super::tables::file_change;
use crate::pipeline::{FamilyPipeline, PageContent, PageJob, page_file_name};
use crate::record::{
    FamilyRecord, FileRecord, TableError, TextDigests, is_intact_png, open_regular_file, read_drawn_curves,
};
use coupler_curves::solve::SolvedCell;
use coupler_drawing::render::{self, PageFormat};

/// The recorded pages of a family.
pub(super) struct RecordedPages<'a> {
    pipeline: &'a FamilyPipeline<'a>,
    folder: PathBuf,
    location: Location,
    files: HashMap<&'a str, &'a FileRecord>,
}

/// What is found of a page.
#[derive(Default)]
pub(super) struct PageFindings {
    /// The cells on it; all that the family has, where none is named.
    cells: Vec<usize>,
    /// Its files that are not what would be drawn now, though they are what was recorded.
    differing_files: Vec<String>,
    findings: Vec<Finding>,
}

/// A curve is drawn where its points are if it is no further from them, in millimetres on paper.
const DRAWING_TOLERANCE_MM: f64 = 0.01;

/// A page of more bytes is none of this program's.
const MAX_BYTES: u64 = 1 << 28;

impl<'a> RecordedPages<'a> {
    pub fn new(press: &'a FamilyPipeline<'a>, record: &'a FamilyRecord, output: &Path) -> RecordedPages<'a> {
        let id = &press.composer.planned.family.id;
        let files = record.files.iter().map(|file| (file.name.as_str(), file)).collect();
        RecordedPages { pipeline: press, folder: output.join(id), location: Location::in_family(id), files }
    }

    /// Holds the files of a page against what is drawn now, and against the recorded curves of its cells.
    pub fn check_page(&self, leaf: PageJob, recorded: impl Fn(usize) -> Option<Vec<CurveSamples>>) -> PageFindings {
        let cells = match leaf.content {
            PageContent::Cells { cells, .. } => cells.iter().map(|solved| solved.cell.number).collect(),
            PageContent::Charts => Vec::new(),
        };
        let mut page = PageFindings { cells, ..PageFindings::default() };
        let plan = self.pipeline.composer.plan;
        let name = |format| page_file_name(&self.location.family, leaf.number, format);
        let [svg_name, png_name] = PageFormat::ALL.map(name);
        let (svg_record, png_record) = (self.files.get(svg_name.as_str()), self.files.get(png_name.as_str()));
        if svg_record.is_none() && png_record.is_none() {
            return page;
        }
        let matter = leaf.content;
        let svg = render::svg(&leaf.compose(), plan.text_mode);
        if let Some(record) = svg_record {
            let found = self.check_svg(record, &svg, &mut page);
            if let (Some(bytes), PageContent::Cells { cells, .. }) = (found, matter) {
                page.findings.extend(self.check_drawn_curves(record, &bytes, cells, recorded));
            }
        }
        if let Some(record) = png_record {
            let drawn = FileRecord::from_page_svg(&record.name, &svg, plan.dpi);
            if record.drawn_from_sha256 != drawn.drawn_from_sha256 {
                page.differing_files.push(record.name.clone());
            }
            let wrong = match read_file(&self.folder.join(&record.name)) {
                Ok(bytes) if is_intact_png(&bytes) => None,
                Ok(_) => Some("is no whole image".to_owned()),
                Err(flaw) => Some(flaw.to_string()),
            };
            page.findings.extend(
                wrong.map(|wrong| self.file_location(&record.name).finding(Change::Damaged { message: wrong })),
            );
        }
        page
    }

    /// Holds the bytes of a page against what is drawn now, and gives them.
    fn check_svg(&self, record: &FileRecord, fresh: &[u8], page: &mut PageFindings) -> Option<Vec<u8>> {
        let place = self.file_location(&record.name);
        let bytes = match read_file(&self.folder.join(&record.name)) {
            Ok(bytes) => bytes,
            Err(flaw) => {
                page.findings.push(place.finding(Change::Damaged { message: flaw.to_string() }));
                return None;
            }
        };
        let mut digests = TextDigests::default();
        // A digest takes whatever it is given.
        let _ = digests.write_all(&bytes);
        let change = file_change(Some(record), &digests.finish());
        if change.is_none() && bytes != fresh {
            page.differing_files.push(record.name.clone());
        }
        page.findings.extend(change.map(|change| place.finding(change)));
        Some(bytes)
    }

    /// Reads the curves of a page back, and holds them against the recorded points.
    fn check_drawn_curves(
        &self,
        record: &FileRecord,
        bytes: &[u8],
        cells: &[SolvedCell],
        recorded: impl Fn(usize) -> Option<Vec<CurveSamples>>,
    ) -> Vec<Finding> {
        let place = self.file_location(&record.name);
        let curves = match read_drawn_curves(bytes) {
            Ok(curves) => curves,
            Err(error) => return vec![place.finding(Change::Damaged { message: error.to_string() })],
        };
        let mut findings = Vec::new();
        let mut of_cell: Option<(usize, Vec<CurveSamples>)> = None;
        for curve in curves {
            // The curves of a cell stand together.
            if of_cell.as_ref().is_none_or(|(cell, _)| *cell != curve.cell) {
                of_cell = Some((curve.cell, recorded(curve.cell).unwrap_or_default()));
            }
            let mut tracks = of_cell.iter().flat_map(|(_, tracks)| tracks);
            let ours = |track: &&CurveSamples| (track.trace, track.circuit) == (curve.trace, curve.circuit);
            let Some(track) = tracks.find(ours) else { continue };
            let of = cells.iter().find(|solved| solved.cell.number == curve.cell).or(cells.first());
            let circuit = of.and_then(|solved| solved.motion.circuits.get(curve.circuit.checked_sub(1)?));
            let closed = circuit.is_none_or(|circuit| circuit.is_closed);
            let samples = track.inputs.iter().copied().zip(track.points.iter().copied());
            let off = curve.furthest_sample(samples, closed).map_or(0.0, |(_, distance)| distance);
            let off =
                off.max(curve.max_stray(&track.points, closed).map_or(0.0, |strays| strays + DRAWING_TOLERANCE_MM));
            if off > DRAWING_TOLERANCE_MM {
                let place = place.with_cell(curve.cell).with_curve(curve.trace, curve.circuit);
                findings.push(place.finding(Change::DrawnOff { distance_mm: off }));
            }
        }
        findings
    }

    /// What is found on pages: of those that differ, which do so though their cells have not changed.
    pub fn findings(&self, pages: Vec<PageFindings>, changed: &[usize]) -> Vec<Finding> {
        let mut findings = Vec::new();
        for page in pages {
            let is_due = match page.cells.is_empty() {
                true => !changed.is_empty(),
                false => page.cells.iter().any(|cell| changed.contains(cell)),
            };
            // Of a cell whose points have changed the page cannot be right.
            let is_due_to_points = |finding: &Finding| {
                let of_changed = finding.location.cell.is_some_and(|cell| changed.contains(&cell));
                of_changed && matches!(finding.change, Change::DrawnOff { .. })
            };
            findings.extend(page.findings.into_iter().filter(|finding| !is_due_to_points(finding)));
            if !is_due {
                findings
                    .extend(page.differing_files.iter().map(|name| self.file_location(name).finding(Change::Drawing)));
            }
        }
        findings
    }

    fn file_location(&self, name: &str) -> Location {
        self.location.with_file(&format!("{}/{name}", self.location.family))
    }
}

/// What is wrong with a volume of the book: its bytes may differ from machine to machine, but it is a file.
pub(super) fn check_volume(output: &Path, name: &str) -> Option<Finding> {
    // A record may name anything; a volume is in the atlas's folder.
    let is_plain = Path::new(name).components().count() == 1;
    let found =
        if is_plain { open_regular_file(&output.join(name), u64::MAX).map(drop) } else { Err(TableError::NotFound) };
    found.err().map(|flaw| Location::default().with_file(name).finding(Change::Damaged { message: flaw.to_string() }))
}

/// The bytes of a file, or what is wrong with it.
fn read_file(path: &Path) -> Result<Vec<u8>, TableError> {
    let mut bytes = Vec::new();
    match open_regular_file(path, MAX_BYTES)?.take(MAX_BYTES).read_to_end(&mut bytes) {
        Ok(_) => Ok(bytes),
        Err(error) => Err(TableError::Unreadable(error.to_string())),
    }
}
