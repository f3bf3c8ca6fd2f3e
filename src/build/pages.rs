//! The tables and pages of a family, rendered and written: those pages that are not there yet as they would be.

use std::sync::atomic::AtomicBool;

use super::claims::Claims;
use super::inputs::Inputs;
use super::{Error, stop_if};
use crate::gallery::Statements;
use crate::press::{Composer, Hand, Leaf, Matter, page_name};
use crate::record::{Cells, FileRecord};
use coupler_curves::exchange::Points;
use coupler_curves::solve::{Solved, Status};
use coupler_drawing::render::{self, PageFormat};

/// A page in each format.
pub(super) struct Printed {
    /// What is recorded of its files.
    pub files: Vec<FileRecord>,
    /// Whether any of them was drawn.
    pub is_drawn: bool,
    /// What is where on it, for the gallery.
    pub shown: String,
}

/// Rows of the tables, and what is counted of their cells.
pub(super) struct Rows {
    pub points: Vec<u8>,
    pub cells: Vec<u8>,
    /// The same for the gallery.
    pub shown: String,
    pub curves: usize,
    pub left_out: usize,
    pub shortfalls: Vec<(usize, String)>,
}

/// How the tables and pages of a family are made, on any number of threads.
#[derive(Clone, Copy)]
pub(super) struct Printer<'a> {
    pub composer: Composer<'a>,
    pub formats: &'a [PageFormat],
    pub inputs: Inputs<'a>,
    pub tables: (Points<'a>, Cells<'a>),
    pub statements: Statements<'a>,
    /// What is said of the files.
    pub claims: &'a Claims,
    /// Becomes true when no more pages are to be begun.
    pub interrupt: &'a AtomicBool,
}

impl Hand for Printer<'_> {
    type Cells = Rows;
    type Page = Printed;
    type Error = Error;

    fn cells(&self, solved: &[Solved]) -> Result<Rows, Error> {
        let (mut points, mut cells) = (Vec::new(), Vec::new());
        for solved in solved {
            stop_if(self.interrupt)?;
            self.tables.0.rows(solved, &mut points);
            self.tables.1.rows(solved, &mut cells);
        }
        let shortfall =
            |s: &Solved| Some((s.cell.number, s.motion.shortfall.clone()?)).filter(|_| s.status() != Status::Ok);
        Ok(Rows {
            points,
            cells,
            shown: self.statements.cells(solved),
            curves: solved.iter().map(|s| s.curves.len()).sum(),
            left_out: solved.iter().map(|s| s.left_out).sum(),
            shortfalls: solved.iter().filter_map(shortfall).collect(),
        })
    }

    /// A page in each format, drawn where it is not there as it would be.
    fn page(&self, leaf: Leaf) -> Result<Printed, Error> {
        stop_if(self.interrupt)?;
        let Composer { plan, planned, of } = self.composer;
        let inputs = &match leaf.matter {
            Matter::Cells { cells, shown } => self.inputs.of_page((leaf.page, of), cells, shown),
            Matter::Charts => self.inputs.of_charts(leaf.page),
        };
        let named = |&format: &PageFormat| (format, page_name(&planned.family.id, leaf.page, format));
        let names: Vec<(PageFormat, String)> = self.formats.iter().map(named).collect();
        let kept: Vec<Option<FileRecord>> = names.iter().map(|(_, name)| self.claims.kept(name, inputs)).collect();
        if names.is_empty() {
            return Ok(Printed { files: Vec::new(), is_drawn: false, shown: String::new() });
        }
        let page = leaf.page;
        let scene = leaf.compose();
        let shown = self.statements.page(page, &scene);
        if kept.iter().all(Option::is_some) {
            return Ok(Printed { files: kept.into_iter().flatten().collect(), is_drawn: false, shown });
        }
        // An image is recorded by its SVG, too.
        let svg = render::svg(&scene, plan.text);
        let draw = |((format, name), kept): ((PageFormat, String), Option<FileRecord>)| match (kept, format) {
            (Some(kept), _) => Ok(kept),
            (None, PageFormat::Svg) => self.claims.write(FileRecord::of_bytes(name, &svg).made_from(inputs), &svg),
            (None, PageFormat::Png) => {
                let record = FileRecord::of_drawing(&name, &svg, plan.dpi).made_from(inputs);
                let png = render::png(&scene, plan.dpi).map_err(|error| Error::Image { name, error })?;
                self.claims.write(record, &png)
            }
        };
        let files = names.into_iter().zip(kept).map(draw).collect::<Result<_, Error>>()?;
        Ok(Printed { files, is_drawn: true, shown })
    }

    /// The pixels of an image, and what they are encoded to.
    fn bytes(&self) -> usize {
        let plan = self.composer.plan;
        let pixels = plan.page.paper.width * plan.page.paper.height * (plan.dpi / 25.4) * (plan.dpi / 25.4);
        if self.formats.contains(&PageFormat::Png) { 4 * pixels as usize } else { 0 }
    }
}
