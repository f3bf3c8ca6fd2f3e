//! The tables and pages of a family as they come off the press, in order: [`crate::build`] writes them, and
//! [`crate::check`] holds them against those that were written.

mod composer;
mod setting;

pub use composer::{Composer, leaves};
pub use setting::{Setting, told_on_pages};

use std::sync::atomic::AtomicBool;

use crate::manifest::{Plan, PlannedFamily};
use crate::sweep::{self, Arrangement, Groups};
use coupler_curves::solve::Solved;
use coupler_drawing::chart::{Chart, Gathering, Taken};
use coupler_drawing::page::Layout;
use coupler_drawing::render::PageFormat;
use coupler_drawing::scene::Scene;

/// The name of the file of a page.
pub fn page_name(family: &str, page: usize, format: PageFormat) -> String {
    format!("{family}-{page:03}.{}", format.name())
}

/// A family that is to be printed.
#[derive(Debug)]
pub struct Press<'a> {
    /// What its pages show.
    pub composer: Composer<'a>,
    /// Which cells are shown, and in what order.
    pub arrangement: Arrangement,
    /// How they are put on pages.
    pub setting: Setting,
}

/// A page that is to be composed.
pub struct Leaf<'a> {
    /// Its number, from 1.
    pub page: usize,
    /// What is on it.
    pub matter: Matter<'a>,
    compose: Box<dyn FnOnce() -> Scene + 'a>,
}

/// What is on a page.
#[derive(Clone, Copy, Debug)]
pub enum Matter<'a> {
    /// Curves of some cells.
    Cells {
        /// The cells.
        cells: &'a [Solved],
        /// Of a coupler grid the places of the curves; otherwise all curves are shown, and nothing is here.
        shown: &'a [usize],
    },
    /// Charts, on which every cell of the family may count.
    Charts,
}

impl Leaf<'_> {
    /// Composes the page.
    pub fn compose(self) -> Scene {
        (self.compose)()
    }
}

/// What is done with what comes off the press, on all threads.
pub trait Hand: Sync {
    /// What comes of a group of cells.
    type Cells: Send;
    /// What comes of a page.
    type Page: Send;
    /// Why it stops.
    type Error: Send;

    /// Takes the next cells, in the order of their numbers.
    ///
    /// # Errors
    /// Whatever ends the run.
    fn cells(&self, solved: &[Solved]) -> Result<Self::Cells, Self::Error>;

    /// Takes a page.
    ///
    /// # Errors
    /// Whatever ends the run.
    fn page(&self, leaf: Leaf) -> Result<Self::Page, Self::Error>;

    /// About how many bytes it takes to work on a page.
    fn bytes(&self) -> usize;
}

/// What has come off the press.
#[derive(Debug)]
pub enum Off<C, P> {
    /// Cells, in the order of their numbers.
    Cells(C),
    /// A page, in the order of pages.
    Page(P),
}

/// What comes of a group of cells, and what charts take of them.
type Made<H> = (Option<<H as Hand>::Cells>, Vec<<H as Hand>::Page>, Vec<Taken>);

impl<'a> Press<'a> {
    /// The press for a family; nothing where `stop` becomes true while its cells are arranged.
    pub fn new(plan: &'a Plan, planned: &'a PlannedFamily, stop: &AtomicBool) -> Option<Press<'a>> {
        let counts_points = planned.layout == Layout::CouplerGrid;
        let arrangement = sweep::arrange(&planned.family, counts_points, stop)?;
        let setting = Setting::new(planned, &arrangement);
        let composer = Composer { plan, planned, of: setting.pages };
        Some(Press { composer, arrangement, setting })
    }

    /// Solves and measures all cells and hands them and their pages to `hand` on all threads, and what comes of them, in
    /// order, to `take` on the thread that calls.
    ///
    /// # Errors
    /// The first error of either.
    pub fn run<H: Hand>(
        &self,
        hand: &H,
        mut take: impl FnMut(Off<H::Cells, H::Page>) -> Result<(), H::Error>,
    ) -> Result<(), H::Error> {
        let planned = self.composer.planned;
        let chart = planned.chart.as_ref();
        let is_sorted = planned.family.sort.is_some();
        let mut gathering = chart.map(|chart| Gathering::new(chart, &planned.family));
        let make = |group: usize, solved: Vec<Solved>| -> Result<Made<H>, H::Error> {
            let cells = hand.cells(&solved)?;
            let pages = if chart.is_none() && !is_sorted { self.pages(group, &solved, hand)? } else { Vec::new() };
            let taken = chart.iter().flat_map(|chart| solved.iter().flat_map(|solved| chart.take(solved)));
            Ok((Some(cells), pages, taken.collect()))
        };
        let mut off = |made: Result<Made<H>, H::Error>| {
            let (cells, pages, taken) = made?;
            if let Some(gathering) = &mut gathering {
                taken.into_iter().for_each(|taken| gathering.add(taken));
            }
            cells.into_iter().try_for_each(|cells| take(Off::Cells(cells)))?;
            pages.into_iter().try_for_each(|page| take(Off::Page(page)))
        };
        sweep::run(&planned.family, self.groups(&self.arrangement.kept, hand, None), make, &mut off)?;
        if chart.is_none() && is_sorted {
            // The order of the tables is that of the cells, the order of pages their own.
            let wanted = told_on_pages(&planned.family);
            let groups = self.groups(&self.arrangement.order, hand, Some(&wanted));
            let make = |group: usize, solved: Vec<Solved>| Ok((None, self.pages(group, &solved, hand)?, Vec::new()));
            sweep::run(&planned.family, groups, make, &mut off)?;
        }
        match (chart, gathering) {
            (Some(chart), Some(gathering)) => self.charts(chart, gathering, hand, &mut take),
            _ => Ok(()),
        }
    }

    fn groups<'c>(&self, cells: &'c [usize], hand: &impl Hand, wanted: Option<&'c [bool]>) -> Groups<'c> {
        Groups { cells, size: self.setting.size, bytes: hand.bytes(), wanted }
    }

    /// The pages of a group of cells.
    fn pages<H: Hand>(&self, group: usize, cells: &[Solved], hand: &H) -> Result<Vec<H::Page>, H::Error> {
        let page = self.setting.page_of(group * self.setting.size);
        match (self.composer.planned.layout, cells) {
            (Layout::CouplerGrid, [solved]) => {
                let print = |(page, shown, compose): (usize, Vec<usize>, _)| {
                    hand.page(Leaf { page, matter: Matter::Cells { cells, shown: &shown }, compose: Box::new(compose) })
                };
                self.composer.grids(page, solved).map(print).collect()
            }
            _ => {
                let compose = Box::new(move || self.composer.panels(page, cells));
                Ok(vec![hand.page(Leaf { page, matter: Matter::Cells { cells, shown: &[] }, compose })?])
            }
        }
    }

    fn charts<H: Hand>(
        &self,
        chart: &Chart,
        gathering: Gathering,
        hand: &H,
        take: &mut impl FnMut(Off<H::Cells, H::Page>) -> Result<(), H::Error>,
    ) -> Result<(), H::Error> {
        let gathered = gathering.finish();
        for page in 1..=self.setting.pages {
            let compose = Box::new(|| self.composer.charts(page, chart, &gathered));
            take(Off::Page(hand.page(Leaf { page, matter: Matter::Charts, compose })?))?;
        }
        Ok(())
    }
}
