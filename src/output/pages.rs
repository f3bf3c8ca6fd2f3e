//! The tables and pages of a family, rendered and written: those pages that are not there yet as they would be.

use std::sync::atomic::AtomicBool;

use super::inputs::Inputs;
use super::registry::FileRegistry;
use super::{Error, check_interrupt};
use crate::gallery::FamilyScript;
use crate::pipeline::{Composer, PageContent, PageJob, Sink, page_file_name};
use crate::record::{CellTable, FileRecord};
use coupler_curves::exchange::PointTable;
use coupler_curves::solve::{SolvedCell, Status};
use coupler_drawing::render::{self, PageFormat};

/// A page in each format.
pub(super) struct PageFiles {
    /// What is recorded of its files.
    pub files: Vec<FileRecord>,
    /// Whether any of them was drawn.
    pub is_drawn: bool,
    /// What is where on it, for the gallery.
    pub gallery_data: String,
}

/// Rows of the tables, and what is counted of their cells.
pub(super) struct TableRows {
    pub points: Vec<u8>,
    pub cells: Vec<u8>,
    /// The same for the gallery.
    pub gallery_data: String,
    pub curve_count: usize,
    pub curves_left_out: usize,
    pub shortfalls: Vec<(usize, String)>,
}

/// How the tables and pages of a family are made, on any number of threads.
#[derive(Clone, Copy)]
pub(super) struct OutputSink<'a> {
    pub composer: Composer<'a>,
    pub formats: &'a [PageFormat],
    pub inputs: Inputs<'a>,
    pub tables: (PointTable<'a>, CellTable<'a>),
    pub script: FamilyScript<'a>,
    /// What is said of the files.
    pub registry: &'a FileRegistry,
    /// Becomes true when no more pages are to be begun.
    pub interrupt: &'a AtomicBool,
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
            Some((s.cell.number, s.motion.incomplete_reason.clone()?)).filter(|_| s.status() != Status::Ok)
        };
        Ok(TableRows {
            points,
            cells,
            gallery_data: self.script.cells(solved),
            curve_count: solved.iter().map(|s| s.curves.len()).sum(),
            curves_left_out: solved.iter().map(|s| s.left_out_count).sum(),
            shortfalls: solved.iter().filter_map(shortfall).collect(),
        })
    }

    /// A page in each format, drawn where it is not there as it would be.
    fn receive_page(&self, leaf: PageJob) -> Result<PageFiles, Error> {
        check_interrupt(self.interrupt)?;
        let Composer { plan, planned, page_count: of } = self.composer;
        let inputs = &match leaf.content {
            PageContent::Cells { cells, curves: shown } => self.inputs.page_digest((leaf.number, of), cells, shown),
            PageContent::Charts => self.inputs.chart_page_digest(leaf.number),
        };
        let named = |&format: &PageFormat| (format, page_file_name(&planned.family.id, leaf.number, format));
        let names: Vec<(PageFormat, String)> = self.formats.iter().map(named).collect();
        let kept: Vec<Option<FileRecord>> =
            names.iter().map(|(_, name)| self.registry.reuse_unchanged(name, inputs)).collect();
        if names.is_empty() {
            return Ok(PageFiles { files: Vec::new(), is_drawn: false, gallery_data: String::new() });
        }
        let page = leaf.number;
        let scene = leaf.compose();
        let shown = self.script.page(page, &scene);
        if kept.iter().all(Option::is_some) {
            return Ok(PageFiles { files: kept.into_iter().flatten().collect(), is_drawn: false, gallery_data: shown });
        }
        // An image is recorded by its SVG, too.
        let svg = render::svg(&scene, plan.text_mode);
        let draw = |((format, name), kept): ((PageFormat, String), Option<FileRecord>)| match (kept, format) {
            (Some(kept), _) => Ok(kept),
            (None, PageFormat::Svg) => {
                self.registry.write_file(FileRecord::from_bytes(name, &svg).with_inputs(inputs), &svg)
            }
            (None, PageFormat::Png) => {
                let record = FileRecord::from_page_svg(&name, &svg, plan.dpi).with_inputs(inputs);
                let png = render::png(&scene, plan.dpi).map_err(|error| Error::Image { name, error })?;
                self.registry.write_file(record, &png)
            }
        };
        let files = names.into_iter().zip(kept).map(draw).collect::<Result<_, Error>>()?;
        Ok(PageFiles { files, is_drawn: true, gallery_data: shown })
    }

    /// The pixels of an image, and what they are encoded to.
    fn bytes_per_page(&self) -> usize {
        let plan = self.composer.plan;
        let pixels = plan.page.paper.width * plan.page.paper.height * (plan.dpi / 25.4) * (plan.dpi / 25.4);
        if self.formats.contains(&PageFormat::Png) { 4 * pixels as usize } else { 0 }
    }
}
