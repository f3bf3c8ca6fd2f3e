//! Writes the pages of families as a book, in one or several volumes.
//!
//! The book is written whole if any page of it has changed. First its cells are surveyed, unless they have been while the tables
//! were written: pages in front of the plates say where curves are that are found only then.

mod charts;
mod lists;
mod part;
mod sections;

use std::path::Path;

use super::journal::{Journal, JournalFile};
use super::survey::{CellSurvey, FamilySurvey, Surveyor};
use super::{Error, Event, Options, check_interrupt, files, previous_run};
use crate::PROGRAM;
use crate::manifest::{BookPlan, FindingCharts, Plan, PlannedFamily, PlannedList};
use crate::pipeline::{Composer, FamilyPipeline, Inputs, curves_by_page};
use crate::record::{BookRecord, Digest, FileRecord};
use crate::sweep::{self, CellGroups};
use coupler_curves::exchange::CurveName;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::book::{self, Atlas, HowToRead, PageFinisher, Volume};
use coupler_drawing::page::{self, Layout, PanelPage, PanelScale, Paper};
use coupler_drawing::render::{Format, pdf};
use coupler_drawing::scene::Scene;
use part::{BookFamily, FamilyPart};

/// The families of the book that this run writes, with their places in the plan.
///
/// If the run is restricted to some families, their book is written only if the run also names the formats.
fn selected_families<'a>(plan: &'a Plan, options: &Options) -> Vec<(usize, &'a PlannedFamily)> {
    let is_in_book = |(_, planned): &(usize, &PlannedFamily)| {
        let formats = options.formats.as_ref().unwrap_or(&planned.formats);
        let is_selected = options.only.is_empty() || options.only.contains(&planned.family.id);
        is_selected && formats.contains(&Format::Pdf)
    };
    plan.families.iter().enumerate().filter(is_in_book).collect()
}

/// Whether this run leaves the book as it is.
fn is_left_alone(selected: &[(usize, &PlannedFamily)], options: &Options) -> bool {
    options.formats.is_none() && !options.only.is_empty() || options.formats.is_some() && selected.is_empty()
}

fn inputs_digest(plan: &Plan, selected: &[(usize, &PlannedFamily)]) -> Digest {
    let families: Vec<&PlannedFamily> = selected.iter().map(|(_, planned)| *planned).collect();
    Inputs::of_book(plan, &families)
}

/// Whether a recorded book is up to date.
fn is_unchanged(record: &BookRecord, inputs_sha256: Digest, output: &Path, options: &Options) -> bool {
    let is_intact = |file: &FileRecord| file.inputs_sha256.is_some() && files::is_intact(output, file);
    !options.force && record.inputs_sha256 == Some(inputs_sha256) && record.files.iter().all(is_intact)
}

/// Which families of the plan are surveyed for a book while their tables are written.
pub(super) fn families_to_survey(plan: &Plan, output: &Path, options: &Options, journal: &Journal) -> Vec<bool> {
    let selected = selected_families(plan, options);
    let mut is_surveyed = vec![false; plan.families.len()];
    let is_unchanged = |record: &BookRecord| is_unchanged(record, inputs_digest(plan, &selected), output, options);
    if !is_left_alone(&selected, options) && !journal.book().is_some_and(is_unchanged) {
        selected.iter().for_each(|(k, planned)| is_surveyed[*k] = planned.chart.is_none());
    }
    is_surveyed
}

/// Writes the book of all families with the format `pdf`, unless it is up to date. Of some families there are surveys, by their
/// places in the plan.
pub(super) fn write(
    plan: &Plan,
    output: &Path,
    options: &Options,
    (journal, surveys): (&mut Journal, Vec<Option<FamilySurvey>>),
    report: &mut dyn FnMut(Event),
) -> Result<(), Error> {
    let selected = selected_families(plan, options);
    if is_left_alone(&selected, options) {
        return Ok(());
    }
    let earlier = journal.book().cloned();
    if selected.is_empty() {
        if earlier.is_some() {
            remove_stale_volumes(earlier.as_ref(), &[], &*journal.file()?)?;
        }
        return journal.set_book(None);
    }
    let inputs_sha256 = inputs_digest(plan, &selected);
    if let Some(record) = earlier.as_ref().filter(|record| is_unchanged(record, inputs_sha256, output, options)) {
        report(Event::Book { record, is_drawn: false });
        return Ok(());
    }
    // From here on, the files of an earlier run may be replaced at any time.
    let earlier_files = earlier.iter().flat_map(|earlier| earlier.files.clone()).collect();
    journal.set_book(Some(BookRecord { inputs_sha256: None, pages: 0, files: earlier_files }))?;
    let bound = plan.with_book_pages();
    let plan = &*bound;
    let selected = selected_families(plan, options);
    let families = book_families(plan, &selected, surveys, options)?;
    let files = write_volumes(plan, &families, (output, inputs_sha256, &*journal.file()?), options, report)?;
    let pages = files.iter().map(|(_, pages)| pages).sum();
    let files: Vec<FileRecord> = files.into_iter().map(|(file, _)| file).collect();
    remove_stale_volumes(earlier.as_ref(), &files, &*journal.file()?)?;
    let record = BookRecord { inputs_sha256: Some(inputs_sha256), pages, files };
    report(Event::Book { record: &record, is_drawn: true });
    journal.set_book(Some(record))
}

fn remove_stale_volumes(
    earlier: Option<&BookRecord>,
    current: &[FileRecord],
    journal: &JournalFile,
) -> Result<(), Error> {
    let known = earlier.iter().flat_map(|record| &record.files).map(|file| file.name.as_str());
    journal.remove_files("", known.filter(|name| current.iter().all(|file| file.name != **name)))
}

/// The approximate memory of the pages of a volume, which is written when it is complete, in bytes.
const MAX_VOLUME_BYTES: usize = 150_000_000;
/// The memory of a page of a book with its structure, and of each curve on it, in bytes.
const BYTES_PER_BOOK_PAGE: usize = 30_000;
const BYTES_PER_BOOK_CURVE: usize = 6_000;

/// The most pages of a volume for which it fits memory.
fn max_volume_pages(selected: &[&PlannedFamily]) -> usize {
    let bytes = |planned: &&PlannedFamily| {
        let curves = match planned.layout {
            Layout::Panels { .. } | Layout::Poses | Layout::Drawing => {
                planned.layout.cells_per_page() * planned.family.template.curve_count()
            }
            Layout::CouplerGrid => Layout::POINTS_PER_PAGE,
            Layout::Chart { .. } => 0,
        };
        BYTES_PER_BOOK_PAGE + curves * BYTES_PER_BOOK_CURVE
    };
    (MAX_VOLUME_BYTES / selected.iter().map(bytes).max().unwrap_or(BYTES_PER_BOOK_PAGE)).max(1)
}

/// What is known of the families of a book, of which some have been surveyed while their tables were written.
fn book_families<'a>(
    plan: &'a Plan,
    selected: &[(usize, &'a PlannedFamily)],
    mut surveys: Vec<Option<FamilySurvey>>,
    options: &Options,
) -> Result<Vec<BookFamily<'a>>, Error> {
    let family = |&(number, planned): &(usize, &'a PlannedFamily)| {
        let mut pipeline = FamilyPipeline::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
        // Pages have the numbers of the book only.
        pipeline.composer.page_count = 1;
        let survey = match surveys.get_mut(number).and_then(Option::take) {
            Some(survey) => survey,
            None => survey_family(plan, number, &pipeline, options)?,
        };
        Ok(BookFamily { number, pipeline, survey })
    };
    selected.iter().map(family).collect()
}

/// Surveys the cells of a family.
fn survey_family(
    plan: &Plan,
    number: usize,
    pipeline: &FamilyPipeline,
    options: &Options,
) -> Result<FamilySurvey, Error> {
    let planned = pipeline.composer.planned;
    let mut survey = FamilySurvey::default();
    if planned.chart.is_some() {
        return Ok(survey);
    }
    let surveyor = Surveyor::new(planned, &plan.book, number);
    let groups = CellGroups {
        cells: &pipeline.arrangement.kept,
        first_group: 0,
        size: pipeline.pagination.group_size,
        work_bytes: 0,
        requested_measures: None,
        solve_known: None,
    };
    let work = |_, solved: Vec<SolvedCell>| {
        check_interrupt(&options.interrupt)?;
        Ok(surveyor.survey(&solved, &pipeline.composer.captions))
    };
    sweep::process_groups(&planned.family, groups, work, |surveyed: Result<Vec<CellSurvey>, Error>| {
        survey.add(surveyed?, &plan.book);
        Ok(())
    })?;
    Ok(survey)
}

/// Composes all pages and writes the volumes in order; returns their records and page counts.
fn write_volumes(
    plan: &Plan,
    families: &[BookFamily],
    (output, inputs_sha256, journal): (&Path, Digest, &JournalFile),
    options: &Options,
    report: &mut dyn FnMut(Event),
) -> Result<Vec<(FileRecord, usize)>, Error> {
    let mut parts: Vec<FamilyPart> = Vec::new();
    let mut page_count = 0;
    for family in families {
        let own = part::family_parts(family, &plan.book, page_count);
        page_count += own.iter().map(FamilyPart::page_count).sum::<usize>();
        parts.extend(own);
    }
    report(Event::Begin { family: "book", pages: page_count });
    let selected: Vec<&PlannedFamily> = families.iter().map(|family| family.pipeline.composer.planned).collect();
    // A single plate needs no way to find it.
    let plates_only = plan.book.plates_only.unwrap_or(page_count == 1);
    let atlas = if plates_only {
        let chapters = parts.iter().map(FamilyPart::chapter).collect();
        Atlas { plates_only, names_families: families.len() > 1, ..Atlas::new(&plan.title, PROGRAM, chapters) }
    } else {
        atlas(plan, families, &parts, options)?
    };
    if options.only.is_empty() {
        report_empty_parts(&plan.book, families, &atlas, report);
    }
    let first = families.iter().find(|family| family.pipeline.composer.planned.chart.is_none()).and_then(first_cell);
    let frontispiece = first.as_ref().map(|(composer, solved)| composer.frontispiece(solved));
    let volumes = atlas.volumes(plan.volume_pages.min(max_volume_pages(&selected)), &plan.page);
    let mut writer = BookWriter {
        plan,
        atlas: &atlas,
        frontispiece: frontispiece.as_ref(),
        output,
        inputs_sha256,
        journal,
        remaining_volumes: volumes.iter(),
        open_volume: None,
        files: Vec::new(),
    };
    writer.open_next_volume()?;
    for part in &parts {
        part.compose_pages(options, &mut |scenes: Vec<Scene>| {
            for scene in scenes {
                writer.add_page(scene, &part.family.pipeline.composer.planned.family.id)?;
                report(Event::Page);
            }
            Ok(())
        })?;
    }
    writer.close_volume()?;
    Ok(writer.files)
}

/// The atlas with everything that a curve is found by.
fn atlas<'a>(
    plan: &'a Plan,
    families: &[BookFamily],
    parts: &'a [FamilyPart],
    options: &Options,
) -> Result<Atlas<'a>, Error> {
    let book = &plan.book;
    let mut atlas = Atlas::new(&plan.title, PROGRAM, parts.iter().map(FamilyPart::chapter).collect());
    atlas.names_families = families.len() > 1;
    atlas.lists = lists::curve_lists(plan, families, parts, options)?;
    for family in families.iter().filter(|_| book.finding_charts != FindingCharts::None) {
        let own: Vec<&FamilyPart> = parts.iter().filter(|part| part.family.number == family.number).collect();
        atlas.charts.extend(charts::finding_charts(&own, families.len() > 1, (plan, options))?);
    }
    let entries = |family: &BookFamily| -> Vec<(usize, u32)> {
        family.survey.index.iter().map(|(cell, _)| (family.number, *cell)).collect()
    };
    let places = part::find_cells(parts, &families.iter().flat_map(entries).collect());
    for family in families {
        let placed = family.survey.index.iter().filter_map(|(cell, entry)| {
            let &(chapter, first_page) = places.get(&(family.number, *cell))?;
            Some(entry.clone().placed(chapter, first_page))
        });
        atlas.index.extend(placed);
    }
    if book.thumb_index {
        let is_only_family = families.len() == 1;
        let titles: Vec<&str> = parts.iter().map(|part| part.title.as_str()).collect();
        let tabs = |(k, part): (usize, &FamilyPart)| part.tabs((k + 1, short_title(k, &titles)), is_only_family);
        atlas.tabs = parts.iter().enumerate().flat_map(tabs).collect();
        if atlas.tabs.len() > MAX_TABS {
            atlas.tabs.clear();
        }
    }
    if book.how_to_read {
        atlas.how_to_read = how_to_read(plan, parts);
    }
    Ok(atlas)
}

/// Reports the chapters and lists of the manifest that would be empty.
fn report_empty_parts(book: &BookPlan, families: &[BookFamily], atlas: &Atlas, report: &mut dyn FnMut(Event)) {
    for (k, chapter) in book.chapters.iter().enumerate().filter(|(_, chapter)| chapter.is_given) {
        let has_cells = |family: &BookFamily| family.survey.chapters.values().any(|own| *own == k);
        // That one applies to no family has been reported with the manifest.
        if chapter.conditions.iter().any(Option::is_some) && !families.iter().any(has_cells) {
            report(Event::EmptyBookPart { kind: "chapter", title: &chapter.title });
        }
    }
    // A book of plates only has none.
    let wanted = |list: &&PlannedList| !atlas.plates_only && list.is_given && list.criteria.iter().any(Option::is_some);
    for list in book.lists.iter().filter(wanted) {
        if atlas.lists.iter().all(|found| found.title != list.title) {
            report(Event::EmptyBookPart { kind: "list", title: &list.title });
        }
    }
}

/// The most marks of a thumb index, without lists and index: more are too small to be found.
const MAX_TABS: usize = 40;

/// A title without an article at its beginning, and the words after that with which another title begins, too.
fn short_title<'t>(k: usize, titles: &[&'t str]) -> &'t str {
    const ARTICLES: [&str; 3] = ["a", "an", "the"];
    let title = titles[k];
    let is_article = |word: &str| ARTICLES.contains(&word.to_lowercase().as_str());
    let begins_with_article = title.split(' ').next().is_some_and(is_article);
    let common = |other: &&str| title.split(' ').zip(other.split(' ')).take_while(|(a, b)| a == b).count();
    let others = titles.iter().enumerate().filter(|(other, _)| *other != k && begins_with_article);
    let common = others.map(|(_, other)| common(other)).max().unwrap_or(0);
    let words = title.splitn(common.max(usize::from(begins_with_article)) + 1, ' ');
    words.last().filter(|rest| !rest.is_empty()).unwrap_or(title)
}

/// The shorter side of the plate that is explained from which it has two panels, in millimetres.
const LEAST_FOR_TWO_PANELS: f64 = 100.0;

/// The plate that two pages of the book explain: that of the middle cell of the first chapter with curves, or one of two panels. A drawing of parts is
/// read as any other of a workshop, and states a paper and a scale that the plate has not.
fn how_to_read(plan: &Plan, parts: &[FamilyPart]) -> Option<HowToRead> {
    let chapter = parts.iter().find(|part| {
        let planned = part.family.pipeline.composer.planned;
        planned.chart.is_none() && planned.layout != Layout::Drawing
    })?;
    let planned = chapter.family.pipeline.composer.planned;
    let family = &planned.family;
    // As a plate of smaller paper, on which letters are as small as they may be.
    let part = book::plate_part(&plan.page);
    // In many panels nothing has space for a number, and on small paper in two.
    let is_small = part * plan.page.paper.width.min(plan.page.paper.height) < LEAST_FOR_TWO_PANELS;
    let layout = match planned.layout {
        Layout::Panels { columns, .. } => {
            Layout::Panels { columns: columns.min(if is_small { 1 } else { 2 }), rows: 1 }
        }
        layout => layout,
    };
    let scale = match planned.scale {
        PanelScale::Fixed(scale) => PanelScale::Fixed(part * scale),
        scale => scale,
    };
    let mut small = plan.clone();
    let Paper { width, height } = plan.page.paper;
    small.page = small.page.with_paper(Paper { width: part * width, height: part * height }).for_specimen();
    let shown = PlannedFamily { layout, scale, ..planned.clone() };
    let composer = Composer::new(&small, &shown, 1);
    let solver = chapter.family.page_solver();
    let size = layout.cells_per_page();
    let first = chapter.cells.len() / 2 / size * size;
    let cells = (first..first + size).filter_map(|k| chapter.cells.get(k));
    let mut solved: Vec<SolvedCell> = cells.filter_map(|cell| chapter.family.solve(&solver, cell)).collect();
    if let (Layout::CouplerGrid, [solved]) = (layout, &mut solved[..]) {
        keep_middle_page(solved);
    }
    let curve_name = solved.iter().find_map(|solved| {
        let curve = solved.curves.get(solved.curves.len() / 2)?;
        let name = CurveName {
            family: family.id.clone(),
            cell: Some(solved.cell.number),
            curve: Some([curve.trace, curve.circuit]),
            overrides: Vec::new(),
        };
        Some(name.to_string())
    });
    let first = solved.first()?;
    let period = page::dash_period(&first.linkage, &first.motion.circuits, &plan.page);
    let unit = first.linkage.input().unit_sign();
    Some(HowToRead {
        plate: part::compose_group(&composer, &solved).into_iter().next()?,
        layout,
        dash: format!("{period}{unit} of input"),
        curve_name: curve_name.unwrap_or_default(),
    })
}

/// Leaves only the curves of the middle page of a cell of a coupler grid.
fn keep_middle_page(solved: &mut SolvedCell) {
    let pages = curves_by_page(solved);
    let shown = &pages[pages.len() / 2];
    solved.curves = shown.iter().map(|&k| solved.curves[k].clone()).collect();
}

/// The first cell of a family that has a curve, among its first hundred; of a coupler grid, with the curves of the
/// middle page only.
fn first_cell<'a>(family: &'a BookFamily) -> Option<(&'a Composer<'a>, SolvedCell)> {
    let FamilyPipeline { composer, arrangement, .. } = &family.pipeline;
    let solver = family.page_solver();
    let order = arrangement.page_order();
    let solved = order.iter().filter_map(|cell| family.solve(&solver, cell));
    let mut solved = solved.take(100).find(|solved| !solved.curves.is_empty())?;
    if composer.planned.layout == Layout::CouplerGrid {
        keep_middle_page(&mut solved);
    }
    Some((composer, solved))
}

/// Writes the volumes of a book, one after another.
struct BookWriter<'a> {
    plan: &'a Plan,
    atlas: &'a Atlas<'a>,
    frontispiece: Option<&'a PanelPage<'a>>,
    output: &'a Path,
    inputs_sha256: Digest,
    journal: &'a JournalFile,
    /// The volumes not begun yet.
    remaining_volumes: std::slice::Iter<'a, Volume>,
    open_volume: Option<OpenVolume<'a>>,
    /// The finished volumes, each with its page count.
    files: Vec<(FileRecord, usize)>,
}

/// A volume that is being written.
struct OpenVolume<'a> {
    volume: &'a Volume,
    book: pdf::Book,
    /// The number of pages of front matter.
    front_pages: usize,
    finisher: PageFinisher<'a>,
}

impl<'a> BookWriter<'a> {
    /// Adds a page of a family; opens the next volume if this one is full.
    fn add_page(&mut self, mut scene: Scene, family: &str) -> Result<(), Error> {
        if scene.reduced_scale.is_some() {
            return Err(Error::Misfits(Vec::new()));
        }
        let is_full = |open: &OpenVolume| open.book.page_count() == open.front_pages + open.volume.page_count;
        if self.open_volume.as_ref().is_some_and(is_full) {
            self.close_volume()?;
            self.open_next_volume()?;
        }
        let Some(open) = &mut self.open_volume else { return Ok(()) };
        if let Some(gallery) = &self.plan.book.gallery {
            let address = book::gallery_address(&scene, gallery, family);
            book::draw_code(&mut scene, &address, &self.plan.page);
        }
        let label = open.finisher.finish(&mut scene, open.book.page_count());
        open.book.add_page(&scene, label).map_err(Error::Book)
    }

    /// Opens the next volume.
    fn open_next_volume(&mut self) -> Result<(), Error> {
        let Some(volume) = self.remaining_volumes.next() else { return Ok(()) };
        let sheet = pdf::Sheet { binding: self.plan.book.binding, bleed: self.plan.book.bleed };
        let mut book = pdf::Book::new(self.atlas.title, PROGRAM).with_sheet(sheet);
        let front = book::compose_front_matter(self.atlas, volume, self.frontispiece, &self.plan.page);
        for (place, scene) in front.iter().enumerate() {
            book.add_page(scene, book::page_number(volume, front.len(), place)).map_err(Error::Book)?;
        }
        let finisher = PageFinisher::new(self.atlas, volume, front.len(), &self.plan.page).with_entries(&front);
        self.open_volume = Some(OpenVolume { volume, book, front_pages: front.len(), finisher });
        Ok(())
    }

    /// Adds the back matter to the open volume, and writes it.
    fn close_volume(&mut self) -> Result<(), Error> {
        let Some(OpenVolume { volume, mut book, front_pages: front, .. }) = self.open_volume.take() else {
            return Ok(());
        };
        for scene in &book::compose_back_matter(self.atlas, volume, front, &self.plan.page) {
            let label = book::page_number(volume, front, book.page_count());
            book.add_page(scene, label).map_err(Error::Book)?;
        }
        let pages = book.page_count();
        let outline = book::outline(self.atlas, volume, front, &self.plan.page);
        let bytes = book.finish(&outline).map_err(Error::Book)?;
        let name = previous_run::volume_name(volume);
        let record = self.journal.replace_file("", &name, || {
            files::write(&self.output.join(&name), &bytes)?;
            Ok(FileRecord::from_book(name.clone(), &bytes).with_inputs(self.inputs_sha256))
        })?;
        self.files.push((record, pages));
        Ok(())
    }
}
