//! Single pages in memory, composed and rendered as the atlas has them.

use std::sync::atomic::AtomicBool;

use super::pages::{composed, draw_png};
use super::{Error, check_interrupt, scale};
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, PageJob, Sink, page_file_name};
use crate::sweep::Division;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::render::{self, Format, PageFormat};
use coupler_drawing::scene::Scene;

/// A page of a family in memory.
#[derive(Clone, Debug)]
pub struct ComposedPage {
    /// Its number, from 1.
    pub number: usize,
    /// The number of pages of the family.
    pub count: usize,
    scene: Scene,
    /// Its file as an image, in the folder of its family.
    image_name: String,
}

impl ComposedPage {
    /// Composes a page of a family by its number, from 1, for which as many cells are solved as [`super::cells_solved_for_page`] says.
    ///
    /// # Errors
    /// There is no such page; its linkages do not fit it at the scale that the manifest gives; `stop` has become true.
    pub fn new(plan: &Plan, planned: &PlannedFamily, number: usize, stop: &AtomicBool) -> Result<ComposedPage, Error> {
        let pipeline = FamilyPipeline::new(plan, planned, stop).ok_or(Error::Interrupted)?;
        let count = pipeline.pagination.page_count;
        let id = &planned.family.id;
        if !(1..=count).contains(&number) {
            return Err(Error::NoSuchPage { family: id.clone(), number, count });
        }
        let mut scene = None;
        let result = pipeline.run_pages(&SceneSink { stop }, number - 1..number, |page| {
            scene = Some(page);
            Ok(())
        });
        if let Err(Error::Misfits(_)) = &result
            && let Some(problem) = scale::scale_problem(plan, planned, (&[Format::Svg], Division::WHOLE), stop)?
        {
            return Err(Error::Misfits(vec![problem]));
        }
        result?;
        // Without an error every page is passed on, unless the run has been interrupted.
        let scene = scene.ok_or(Error::Interrupted)?;
        Ok(ComposedPage { number, count, scene, image_name: page_file_name(id, number, count, PageFormat::Png) })
    }

    /// The bytes of its file in a format; `plan` is that of which it is a page.
    ///
    /// # Errors
    /// It cannot be drawn as an image.
    pub fn render(&self, plan: &Plan, format: PageFormat) -> Result<Vec<u8>, Error> {
        match format {
            PageFormat::Svg => Ok(render::svg(&self.scene, plan.text_mode)),
            PageFormat::Png => draw_png(&self.scene, plan, &self.image_name),
        }
    }
}

/// Passes on composed pages.
struct SceneSink<'s> {
    stop: &'s AtomicBool,
}

impl Sink for SceneSink<'_> {
    type CellsOutput = ();
    type PageOutput = Scene;
    type Error = Error;

    fn receive_cells(&self, _: &[SolvedCell]) -> Result<(), Error> {
        check_interrupt(self.stop)
    }

    fn receive_page(&self, job: PageJob) -> Result<Scene, Error> {
        check_interrupt(self.stop)?;
        composed(job)
    }

    fn bytes_per_page(&self) -> usize {
        scale::BYTES_PER_SCENE
    }
}
