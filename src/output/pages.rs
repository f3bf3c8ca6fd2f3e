//! Renders the tables and pages of a family, and writes the pages that are not up to date.

use std::sync::atomic::AtomicBool;

use super::registry::FileRegistry;
use super::survey::{CellSurvey, Surveyor};
use super::{Error, check_interrupt};
use crate::gallery::{CellData, FamilyScript};
use crate::manifest::Plan;
use crate::pipeline::{Composer, PageJob, Sink, page_file_name};
use crate::record::{CellTable, FileRecord};
use coupler_curves::exchange::PointTable;
use coupler_curves::solve::{SolvedCell, Status};
use coupler_drawing::render::{self, PageFormat};
use coupler_drawing::scene::Scene;

/// The files of a page, one for each format.
pub(super) struct PageFiles {
    /// The records of its files.
    pub files: Vec<FileRecord>,
    /// Whether any of them was drawn.
    pub is_drawn: bool,
    /// The places of its cells, for the gallery.
    pub gallery_data: String,
}

/// The rows of some cells in the tables, and their counts.
pub(super) struct TableRows {
    pub points: Vec<u8>,
    pub cells: Vec<u8>,
    /// The data for the gallery.
    pub gallery_data: CellData,
    pub curve_count: usize,
    pub curves_left_out: usize,
    pub shortfalls: Vec<(usize, String)>,
    /// The number of those that are assembled over a part of the range.
    pub partly_assembled: usize,
    /// What the book needs to know of the cells; empty if it does not.
    pub surveyed: Vec<CellSurvey>,
}

/// Renders and writes the output of a family; used by all worker threads.
#[derive(Clone, Copy)]
pub(super) struct OutputSink<'a> {
    pub composer: &'a Composer<'a>,
    pub formats: &'a [PageFormat],
    pub tables: (PointTable<'a>, CellTable<'a>),
    pub script: FamilyScript<'a>,
    /// The records of the files.
    pub registry: &'a FileRegistry<'a>,
    /// Set to true when no more pages are to be begun.
    pub interrupt: &'a AtomicBool,
    /// Surveys the cells for the book, if that is written.
    pub surveyor: Option<Surveyor<'a>>,
}

impl Sink for OutputSink<'_> {
    type CellsOutput = TableRows;
    type PageOutput = PageFiles;
    type Error = Error;

    fn receive_cells(&self, solved: &[SolvedCell]) -> Result<TableRows, Error> {
        let (mut points, mut cells) = (Vec::new(), Vec::new());
        for solved in solved {
            check_interrupt(self.interrupt)?;
            self.tables.0.append_rows(solved, &mut points);
            self.tables.1.append_rows(solved, &mut cells);
        }
        let shortfall = |s: &SolvedCell| {
            Some((s.cell.number, s.motion.assembly_error.as_ref()?.to_string())).filter(|_| s.status() != Status::Ok)
        };
        Ok(TableRows {
            points,
            cells,
            gallery_data: self.script.cells(solved),
            curve_count: solved.iter().map(|s| s.curves.len()).sum(),
            curves_left_out: solved.iter().map(|s| s.left_out_count).sum(),
            surveyed: self
                .surveyor
                .map(|surveyor| surveyor.survey(solved, &self.composer.captions))
                .unwrap_or_default(),
            shortfalls: solved.iter().filter_map(shortfall).collect(),
            partly_assembled: solved.iter().filter(|s| s.status() == Status::Partial).count(),
        })
    }

    /// Draws a page in each format, except those that are up to date.
    fn receive_page(&self, job: PageJob) -> Result<PageFiles, Error> {
        check_interrupt(self.interrupt)?;
        let &Composer { plan, planned, page_count, .. } = self.composer;
        let inputs = job.inputs_digest(self.composer);
        let with_name =
            |&format: &PageFormat| (format, page_file_name(&planned.family.id, job.number, page_count, format));
        let names: Vec<(PageFormat, String)> = self.formats.iter().map(with_name).collect();
        let unchanged: Vec<Option<FileRecord>> =
            names.iter().map(|(_, name)| self.registry.reuse_unchanged(name, inputs)).collect();
        if names.is_empty() {
            return Ok(PageFiles { files: Vec::new(), is_drawn: false, gallery_data: String::new() });
        }
        let page = job.number;
        let scene = composed(job)?;
        let gallery_data = self.script.page(page, &scene);
        if unchanged.iter().all(Option::is_some) {
            return Ok(PageFiles { files: unchanged.into_iter().flatten().collect(), is_drawn: false, gallery_data });
        }
        // The record of an image has the digest of the SVG, so that is always rendered.
        let svg = render::svg(&scene, plan.text_mode);
        let draw = |((format, name), kept): ((PageFormat, String), Option<FileRecord>)| match (kept, format) {
            (Some(kept), _) => Ok(kept),
            (None, PageFormat::Svg) => {
                self.registry.write_file(FileRecord::from_bytes(name, &svg).with_inputs(inputs), &svg)
            }
            (None, PageFormat::Png) => {
                let drawn_from = FileRecord::drawing_digest(&svg, plan.dpi);
                let png = draw_png(&scene, plan, &name)?;
                self.registry.write_file(FileRecord::from_image(name, drawn_from, &png).with_inputs(inputs), &png)
            }
        };
        let files = names.into_iter().zip(unchanged).map(draw).collect::<Result<_, Error>>()?;
        Ok(PageFiles { files, is_drawn: true, gallery_data })
    }

    /// The bytes of the pixels of an image.
    fn bytes_per_page(&self) -> usize {
        let plan = self.composer.plan;
        let pixels = plan.page.paper.width * plan.page.paper.height * (plan.dpi / 25.4) * (plan.dpi / 25.4);
        if self.formats.contains(&PageFormat::Png) { 4 * pixels as usize } else { 0 }
    }
}

/// Composes a page.
///
/// # Errors
/// Its linkages do not fit it at the scale that the manifest gives; [`super::scale::explain`] says what to do.
pub(super) fn composed(job: PageJob) -> Result<Scene, Error> {
    let scene = job.compose();
    match scene.reduced_scale {
        Some(_) => Err(Error::Misfits(Vec::new())),
        None => Ok(scene),
    }
}

/// A page as an image; `name` is that of its file.
///
/// # Errors
/// It cannot be drawn, as where it has too many pixels.
pub(super) fn draw_png(scene: &Scene, plan: &Plan, name: &str) -> Result<Vec<u8>, Error> {
    render::png(scene, plan.dpi).map_err(|error| Error::Image { name: name.to_owned(), error })
}
