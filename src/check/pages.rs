//! Compares the recorded pages of a family with the current ones, and with the recorded points.

use std::collections::HashMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::Error;
use super::curve_samples::CurveSamples;
use super::drawn_curves::check_drawn_curves;
use super::finding::{Change, Finding, Location};
use super::images::image_change;
use super::left_out::LeftOut;
use super::tables::file_change;
use crate::pipeline::{FamilyPipeline, PageContent, PageJob, page_file_name};
use crate::record::{FamilyRecord, FileRecord, TextDigests, read_regular_file};
use coupler_drawing::render::{self, PageFormat};

/// The recorded pages of a family.
pub(super) struct RecordedPages<'a> {
    pipeline: &'a FamilyPipeline<'a>,
    folder: PathBuf,
    location: Location,
    files: HashMap<&'a str, &'a FileRecord>,
    left_out: LeftOut,
}

/// The findings on a page.
#[derive(Default)]
pub(super) struct PageFindings {
    /// The numbers of the cells on the page; empty if every cell of the family may be on it.
    cells: Vec<usize>,
    /// The files that have not been edited, but would be drawn differently now.
    differing_files: Vec<String>,
    /// The files that are recorded as made from something else than now.
    pub other_inputs: Vec<String>,
    findings: Vec<Finding>,
}

/// The largest page that is read, in bytes; this program writes none that large.
const MAX_BYTES: u64 = 1 << 28;

impl<'a> RecordedPages<'a> {
    /// The recorded pages of a pipeline's family in the folder of an atlas, which may leave out images.
    pub fn new(
        pipeline: &'a FamilyPipeline<'a>,
        record: &'a FamilyRecord,
        (output, left_out): (&Path, LeftOut),
    ) -> RecordedPages<'a> {
        let id = &pipeline.composer.planned.family.id;
        let files = record.files.iter().map(|file| (file.name.as_str(), file)).collect();
        RecordedPages { pipeline, folder: output.join(id), location: Location::in_family(id), files, left_out }
    }

    /// Compares the files of a page with the current drawing, and with the recorded curves of its cells, which
    /// `recorded` returns by the number of the cell.
    ///
    /// # Errors
    /// The system fails to read a file.
    pub fn check_page(
        &self,
        job: PageJob,
        recorded: impl Fn(usize) -> Result<Option<Vec<CurveSamples>>, Error>,
    ) -> Result<PageFindings, Error> {
        let cells = match job.content {
            PageContent::Cells { cells, .. } => cells.iter().map(|solved| solved.cell.number).collect(),
            PageContent::Charts => Vec::new(),
        };
        let mut page = PageFindings { cells, ..PageFindings::default() };
        let plan = self.pipeline.composer.plan;
        let page_count = self.pipeline.pagination.page_count;
        let name = |format| page_file_name(&self.location.family, job.number, page_count, format);
        let [svg_name, png_name] = PageFormat::ALL.map(name);
        let (svg_record, png_record) = (self.files.get(svg_name.as_str()), self.files.get(png_name.as_str()));
        if svg_record.is_none() && png_record.is_none() {
            return Ok(page);
        }
        let inputs = Some(job.inputs_digest(&self.pipeline.composer));
        let records = svg_record.into_iter().chain(png_record);
        page.other_inputs
            .extend(records.filter(|record| record.inputs_sha256 != inputs).map(|record| record.name.clone()));
        let content = job.content;
        let scene = job.compose();
        let svg = render::svg(&scene, plan.text_mode);
        if let Some(record) = svg_record {
            let recorded_svg = self.check_svg(record, &svg, &mut page)?;
            let differing_svg = recorded_svg.filter(|bytes| *bytes != svg);
            if let (Some(bytes), PageContent::Cells { cells, .. }) = (differing_svg, content) {
                let family = &self.pipeline.composer.planned.family;
                let location = self.file_location(&record.name);
                page.findings.extend(check_drawn_curves(&location, [&bytes, &svg], (family, cells), recorded)?);
            }
        }
        if let Some(record) = png_record {
            let is_current = record.drawn_from_sha256 == Some(FileRecord::drawing_digest(&svg, plan.dpi));
            if !is_current {
                page.differing_files.push(record.name.clone());
            }
            if !self.left_out.leaves_images() {
                let draw = || if is_current { render::png(&scene, plan.dpi).ok() } else { None };
                let change = image_change(&self.folder, record, draw)?;
                page.findings.extend(change.map(|change| self.file_location(&record.name).finding(change)));
            }
        }
        Ok(page)
    }

    /// Compares the bytes of a recorded page with the current drawing, and returns them; `None` if there is no such file.
    ///
    /// # Errors
    /// The system fails to read it.
    fn check_svg(
        &self,
        record: &FileRecord,
        current: &[u8],
        page: &mut PageFindings,
    ) -> Result<Option<Vec<u8>>, Error> {
        let location = self.file_location(&record.name);
        let bytes = match read_regular_file(&self.folder.join(&record.name), MAX_BYTES) {
            Ok(bytes) => bytes,
            Err(error) => {
                page.findings.push(location.finding(Error::or_damage(error)?));
                return Ok(None);
            }
        };
        let mut digests = TextDigests::default();
        // Writing to a digest cannot fail.
        let _ = digests.write_all(&bytes);
        let change = file_change(Some(record), &digests.finish());
        if change.is_none() && bytes != current {
            page.differing_files.push(record.name.clone());
        }
        page.findings.extend(change.map(|change| location.finding(change)));
        Ok(Some(bytes))
    }

    /// The findings on all pages that are not explained by the cells that have changed.
    pub fn findings(&self, pages: Vec<PageFindings>, changed_cells: &[usize]) -> Vec<Finding> {
        let mut findings = Vec::new();
        for page in pages {
            let has_changed_cell = match page.cells.is_empty() {
                true => !changed_cells.is_empty(),
                false => page.cells.iter().any(|cell| changed_cells.contains(cell)),
            };
            // A changed cell explains why its page does not match the recorded points.
            let is_explained = |finding: &Finding| {
                let is_on_changed_cell = finding.location.cell.is_some_and(|cell| changed_cells.contains(&cell));
                is_on_changed_cell && matches!(finding.change, Change::DrawnOff { .. })
            };
            findings.extend(page.findings.into_iter().filter(|finding| !is_explained(finding)));
            if !has_changed_cell {
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
