//! Binds the pages of families into a book, or several volumes of one.
//!
//! The cells are solved for it anew: a book is made where any page of it has changed, and then has all of them.

use coupler_curves::solve;
use std::path::Path;

use super::inputs::Inputs;
use super::journal::Journal;
use super::{Error, Event, Options, earlier, files};
use crate::manifest::{Plan, PlannedFamily};
use crate::press::{Composer, Press, Setting, leaves, told_on_pages};
use crate::record::{BookRecord, FileRecord};
use crate::sweep::{self, Arrangement, Groups};
use coupler_curves::solve::Solved;
use coupler_curves::template::Circuits;
use coupler_drawing::chart::Gathering;
use coupler_drawing::page::book::{self, Atlas, Cell, Chapter, Geometry, Volume};
use coupler_drawing::page::{Layout, Sheet};
use coupler_drawing::render::{Format, pdf};
use coupler_drawing::scene::Scene;

/// The program, as a book names it.
const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// Binds the families that are to be in the book, unless it is there as it would be.
///
/// Where only some families are asked for, a book is made of those if it is asked for in so many words, and left alone
/// otherwise.
pub(super) fn build(
    plan: &Plan,
    output: &Path,
    options: &Options,
    journal: &mut Journal,
    tell: &mut dyn FnMut(Event),
) -> Result<(), Error> {
    let is_bound = |planned: &&PlannedFamily| {
        let formats = options.formats.as_ref().unwrap_or(&planned.formats);
        let is_asked = options.only.is_empty() || options.only.contains(&planned.family.id);
        is_asked && formats.contains(&Format::Pdf)
    };
    let bound: Vec<&PlannedFamily> = plan.families.iter().filter(is_bound).collect();
    if options.formats.is_none() && !options.only.is_empty() || options.formats.is_some() && bound.is_empty() {
        return Ok(());
    }
    let earlier = journal.book().cloned();
    if bound.is_empty() {
        remove_others(earlier.as_ref(), &[], output)?;
        return journal.put_book(None);
    }
    let inputs_sha256 = Inputs::of_book(&bound, plan.volume_pages);
    let is_unchanged = |record: &&BookRecord| {
        let is_whole = |file: &FileRecord| file.inputs_sha256.is_some() && files::is_intact(output, file);
        record.inputs_sha256.as_ref() == Some(&inputs_sha256) && record.files.iter().all(is_whole)
    };
    if let Some(record) = earlier.as_ref().filter(|_| !options.force).filter(is_unchanged) {
        tell(Event::Bound { record, is_drawn: false });
        return Ok(());
    }
    if let Some(earlier) = &earlier {
        // From here on, what was there may be replaced at any time.
        let files = earlier.files.iter().map(|file| FileRecord::of_name(&file.name)).collect();
        journal.put_book(Some(BookRecord { inputs_sha256: None, files, ..earlier.clone() }))?;
    }
    let files = bind(plan, &bound, (output, &inputs_sha256), options, tell)?;
    let pages = files.iter().map(|(_, pages)| pages).sum();
    let files: Vec<FileRecord> = files.into_iter().map(|(file, _)| file).collect();
    remove_others(earlier.as_ref(), &files, output)?;
    let record = BookRecord { inputs_sha256: Some(inputs_sha256), pages, files };
    tell(Event::Bound { record: &record, is_drawn: true });
    journal.put_book(Some(record))
}

fn remove_others(earlier: Option<&BookRecord>, stay: &[FileRecord], output: &Path) -> Result<(), Error> {
    let known = earlier.iter().flat_map(|record| &record.files).map(|file| file.name.as_str());
    files::remove(output, known.filter(|name| stay.iter().all(|file| file.name != **name)))
}

/// A family, and where its cells go.
struct Part<'a> {
    press: Press<'a>,
    /// How many pages of the atlas stand before its own.
    before: usize,
}

/// The chapter a family makes.
fn chapter<'a>(planned: &'a PlannedFamily, arrangement: &Arrangement, setting: &Setting) -> Chapter<'a> {
    let family = &planned.family;
    let cell = |(k, &cell): (usize, &usize)| {
        // What is measured is not known yet.
        let [caption, _] = family.describe(&family.cell(cell), &[]);
        Cell { caption, page: setting.page_of(k) }
    };
    let cells = if planned.chart.is_none() { arrangement.order.iter().enumerate().map(cell).collect() } else { vec![] };
    // Points are counted for coupler grids; on the one circuit of the start each draws one curve.
    let is_counted = planned.layout == Layout::CouplerGrid && family.template.circuits == Circuits::Start;
    let curves = is_counted.then(|| arrangement.points.iter().sum());
    Chapter { title: &family.title, symbols: &family.names, curves, pages: setting.pages, cells }
}

/// Composes all pages, adds them to the volumes in order, and writes these: their files, and how many pages they have.
fn bind(
    plan: &Plan,
    bound: &[&PlannedFamily],
    (output, inputs_sha256): (&Path, &str),
    options: &Options,
    tell: &mut dyn FnMut(Event),
) -> Result<Vec<(FileRecord, usize)>, Error> {
    let mut parts: Vec<Part> = Vec::new();
    let mut chapters = Vec::new();
    let mut before = 0;
    for &planned in bound {
        let press = Press::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
        chapters.push(chapter(planned, &press.arrangement, &press.setting));
        let pages = press.setting.pages;
        parts.push(Part { press, before });
        before += pages;
    }
    let atlas = Atlas { title: &plan.title, program: PROGRAM, chapters };
    let first = parts.iter().find(|part| part.press.composer.planned.chart.is_none()).and_then(first_cell);
    let frontispiece = first.as_ref().map(|(composer, solved)| composer.frontispiece(solved));
    let volumes = atlas.volumes(plan.volume_pages);
    tell(Event::Begin { family: "book", pages: before });
    let mut bindery = Bindery {
        plan,
        atlas: &atlas,
        frontispiece: frontispiece.as_ref(),
        output,
        inputs_sha256,
        waiting: volumes.iter(),
        open: None,
        found: Vec::new(),
        files: Vec::new(),
    };
    bindery.turn()?;
    for (number, part) in parts.iter().enumerate() {
        part.pages(number, options, &mut |leaf: Leaf| {
            bindery.found.extend(leaf.found);
            for scene in leaf.scenes {
                bindery.add(scene)?;
                tell(Event::Page);
            }
            Ok(())
        })?;
    }
    bindery.close()?;
    Ok(bindery.files)
}

/// The first cell of a family that has a curve, of a coupler grid with those of the page in the middle.
fn first_cell<'a>(part: &'a Part) -> Option<(&'a Composer<'a>, Solved)> {
    let family = &part.press.composer.planned.family;
    let sampler = coupler_curves::motion::Sampler::new(family.sampling);
    let solved = part.press.arrangement.order.iter().filter_map(|&cell| solve::solve(family, &sampler, cell));
    let mut solved = solved.take(100).find(|solved| !solved.curves.is_empty())?;
    if part.press.composer.planned.layout == Layout::CouplerGrid {
        let leaves = leaves(&solved);
        let shown = &leaves[leaves.len() / 2];
        solved.curves = shown.iter().map(|&k| solved.curves[k].clone()).collect();
    }
    Some((&part.press.composer, solved))
}

/// Pages that follow each other, and what the index will say of their cells.
struct Leaf {
    scenes: Vec<Scene>,
    found: Vec<Geometry>,
}

/// About how many bytes a composed page takes: ten thousand points, and what it takes to find them.
const BYTES_TO_A_PAGE: usize = 1 << 20;

impl Part<'_> {
    /// Composes the pages of a family on all threads, and gives them to `take` in order.
    fn pages(
        &self,
        number: usize,
        options: &Options,
        take: &mut dyn FnMut(Leaf) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let Press { composer, arrangement, setting } = &self.press;
        let family = &composer.planned.family;
        let (interrupt, chart) = (&*options.interrupt, &composer.planned.chart);
        let wanted = told_on_pages(family);
        let wanted = Some(wanted.as_slice());
        let groups = Groups { cells: &arrangement.order, size: setting.size, bytes: BYTES_TO_A_PAGE, wanted };
        if let Some(chart) = chart {
            let mut gathering = Gathering::new(chart, family);
            let groups = Groups { cells: &arrangement.kept, wanted: None, ..groups };
            let gather = |_, solved: Vec<Solved>| solved.iter().flat_map(|s| chart.take(s)).collect::<Vec<_>>();
            sweep::run(family, groups, gather, |taken| {
                super::stop_if(interrupt)?;
                taken.into_iter().for_each(|taken| gathering.add(taken));
                Ok(())
            })?;
            let gathered = gathering.finish();
            return (1..=setting.pages).try_for_each(|page| {
                take(Leaf { scenes: vec![composer.charts(page, chart, &gathered)], found: Vec::new() })
            });
        }
        let compose = |group: usize, solved: Vec<Solved>| -> Result<Leaf, Error> {
            super::stop_if(interrupt)?;
            Ok(self.leaf(number, group, &solved))
        };
        sweep::run(family, groups, compose, |leaf| take(leaf?))
    }

    /// The pages of a group of cells.
    fn leaf(&self, number: usize, group: usize, solved: &[Solved]) -> Leaf {
        let Part { press: Press { composer, setting, .. }, before } = self;
        let family = &composer.planned.family;
        let geometry = |solved: &Solved, page: &dyn Fn(usize) -> usize| {
            let [caption, _] = family.describe(&solved.cell, solved.measures());
            Geometry::of(solved, number, &caption, page)
        };
        let page = setting.page_of(group * setting.size);
        match (composer.planned.layout, solved) {
            (Layout::CouplerGrid, [solved]) => {
                let leaves = leaves(solved);
                let on = |k: usize| leaves.iter().position(|shown| shown.contains(&k)).unwrap_or(0);
                let found = vec![geometry(solved, &|k| before + page + on(k))];
                Leaf { scenes: composer.grids(page, solved).map(|(_, _, compose)| compose()).collect(), found }
            }
            _ => {
                let found = solved.iter().map(|solved| geometry(solved, &|_| before + page)).collect();
                Leaf { scenes: vec![composer.panels(page, solved)], found }
            }
        }
    }
}

/// Where volumes are made, one after the other.
struct Bindery<'a> {
    plan: &'a Plan,
    atlas: &'a Atlas<'a>,
    frontispiece: Option<&'a Sheet<'a>>,
    output: &'a Path,
    inputs_sha256: &'a str,
    /// The volumes that are not begun.
    waiting: std::slice::Iter<'a, Volume>,
    open: Option<Open<'a>>,
    /// What the index of the open volume will have, and perhaps a little of the next.
    found: Vec<Geometry>,
    /// The finished volumes, each with how many pages it has.
    files: Vec<(FileRecord, usize)>,
}

/// A volume that is being made.
struct Open<'a> {
    volume: &'a Volume,
    book: pdf::Book,
    /// How many pages stand before those of the families.
    front: usize,
}

impl<'a> Bindery<'a> {
    /// Adds a page of a family.
    fn add(&mut self, mut scene: Scene) -> Result<(), Error> {
        if self.open.as_ref().is_some_and(|open| open.book.pages() == open.front + open.volume.pages) {
            self.close()?;
            self.turn()?;
        }
        let Some(open) = &mut self.open else { return Ok(()) };
        let label = book::label(open.volume, open.front, open.book.pages());
        book::number(&mut scene, label, &self.plan.page);
        open.book.add(&scene, label).map_err(Error::Book)
    }

    /// Opens the next volume.
    fn turn(&mut self) -> Result<(), Error> {
        let Some(volume) = self.waiting.next() else { return Ok(()) };
        let mut book = pdf::Book::new(self.atlas.title, PROGRAM);
        let front = book::front(self.atlas, volume, self.frontispiece, &self.plan.page);
        for (place, scene) in front.iter().enumerate() {
            book.add(scene, book::label(volume, front.len(), place)).map_err(Error::Book)?;
        }
        self.open = Some(Open { volume, book, front: front.len() });
        Ok(())
    }

    /// Finishes the open volume, and writes it.
    fn close(&mut self) -> Result<(), Error> {
        let Some(Open { volume, mut book, front }) = self.open.take() else { return Ok(()) };
        let index = book::index(self.atlas, volume, front, &self.found, &self.plan.page);
        for scene in &index {
            let label = book::label(volume, front, book.pages());
            book.add(scene, label).map_err(Error::Book)?;
        }
        // The cell at the seam may be in both volumes.
        self.found = self.found.pop().into_iter().collect();
        let pages = book.pages();
        let bytes = book.finish(&book::outline(self.atlas, volume, [front, index.len()])).map_err(Error::Book)?;
        let record = FileRecord::of_name(earlier::volume_name(volume)).made_from(self.inputs_sha256);
        files::write(&self.output.join(&record.name), &bytes)?;
        self.files.push((record, pages));
        Ok(())
    }
}
