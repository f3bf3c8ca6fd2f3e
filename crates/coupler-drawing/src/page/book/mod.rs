//! Books: title page, how to read, contents and finding charts; after the pages of families, lists of curves and an index;
//! outline, page labels and thumb index.
//!
//! A book is an [`Atlas`] of chapters. If it has more pages than a volume, it is divided into [`Volume`]s: files with front
//! matter of their own; the back matter is in the last. Pages are numbered throughout the atlas, from 1. This module composes all
//! pages but those of the families, and draws what is outside their borders with a
//! [`PageFinisher`].

mod atlas;
#[cfg(feature = "pdf")]
mod code;
mod columns;
mod contents;
mod finding;
mod folio;
mod free_space;
mod how_to_read;
mod index;
mod index_entry;
mod linkage_identity;
mod list;
mod miniature;
mod reference;
mod table;
mod title;

pub use atlas::{
    Atlas, CellEntry, Chapter, CurveList, FindingCell, FindingChart, FindingCurve, HowToRead, ListEntry, ScaleBar,
    Volume,
};
#[cfg(feature = "pdf")]
pub use code::{draw_code, gallery_address};
pub use finding::max_chart_grid;
pub use folio::{Tab, draw_folio};
pub use how_to_read::plate_part;
pub use index::keep_listed;
pub use index_entry::IndexEntry;
pub use linkage_identity::linkage_identity;
pub use miniature::{Emphasis, Miniature};

use super::empty_scene::empty_scene;
use super::{Options, PanelPage};
use crate::scene::{LinkKind, OutlineEntry, PageNumber, Scene};
use atlas::{BackMatter, CHARTS_TITLE, charts_in};
use columns::{ListHeader, Places};

/// The title of the index.
const INDEX_TITLE: &str = "Index of geometries";

impl Atlas<'_> {
    /// The volumes, of at most `max_pages` pages each; all but the last are full. There is at least one.
    pub fn volumes(&self, max_pages: usize, options: &Options) -> Vec<Volume> {
        let back_pages = self.back_matter(options).iter().map(|part| part.page_count).sum();
        let (pages, max_pages) = (self.page_count(), max_pages.max(1));
        let volume_count = pages.div_ceil(max_pages).max(1);
        let volume = |k: usize| Volume {
            number: k + 1,
            volume_count,
            first_page: k * max_pages + 1,
            page_count: max_pages.min(pages - k * max_pages),
            back_page_count: if k + 1 == volume_count { back_pages } else { 0 },
        };
        (0..volume_count).map(volume).collect()
    }

    /// The lists and the index, as far as they have pages.
    fn back_matter(&self, options: &Options) -> Vec<BackMatter> {
        if self.plates_only {
            return Vec::new();
        }
        let theme = options.theme.for_paper(options.paper);
        let pages = |list: &CurveList| {
            let ranges =
                if list.columns.is_empty() { Vec::new() } else { table::page_ranges(list, self, options, &theme) };
            let count = if ranges.is_empty() { list::page_count(list, self, options) } else { ranges.len() };
            (list.title.clone(), false, count, ranges)
        };
        let rows = index::rows(self);
        let header = ListHeader { title: INDEX_TITLE, note: "", heads: &[], atlas: self, volume: &Volume::NONE };
        let index = (INDEX_TITLE.to_owned(), true, columns::page_count(&rows, &header, options, &theme), Vec::new());
        let mut next = self.page_count() + 1;
        let part = |(title, is_index, page_count, ranges): (String, bool, usize, Vec<String>)| {
            let part = BackMatter { title, ranges, is_index, first_page: next, page_count };
            next += page_count;
            part
        };
        let parts = self.lists.iter().map(pages).chain([index]).map(part);
        parts.filter(|part| part.page_count > 0).collect()
    }
}

/// Where the parts of the front matter of a volume are, with so many pages of contents.
fn places(atlas: &Atlas, volume: &Volume, [how_to_read, contents]: [usize; 2]) -> Places {
    let charts = 1 + how_to_read + contents;
    let front = charts + charts_in(atlas, volume).count();
    // Odd numbers are on right-hand pages: a blank page precedes the first plate if needed.
    let front = front + (front + volume.first_page + 1) % 2;
    Places { how_to_read: 1, charts, front }
}

/// The number of pages that say how plates are read.
fn how_to_read_pages(atlas: &Atlas, volume: &Volume, back_matter: &[BackMatter], options: &Options) -> usize {
    let Some(how) = &atlas.how_to_read else { return 0 };
    // The numbers of pages of the front matter are not known yet: these are wide.
    let places = Places { how_to_read: 1, charts: 27, front: 0 };
    how_to_read::page_count(how, &contents::ways_to_find(atlas, volume, back_matter, &places), options)
}

/// Composes the front matter of a volume: the title page, two pages that say how plates are read, the contents and the
/// finding charts. The title page shows the first panel of the frontispiece.
pub fn compose_front_matter(
    atlas: &Atlas,
    volume: &Volume,
    frontispiece: Option<&PanelPage>,
    options: &Options,
) -> Vec<Scene> {
    if atlas.plates_only {
        return Vec::new();
    }
    let theme = options.theme.for_paper(options.paper);
    let mut first = empty_scene(atlas.title.to_owned(), options, &theme);
    title::compose(&mut first, atlas, volume, frontispiece, options, &theme);
    let mut pages = vec![first];
    let back_matter = atlas.back_matter(options);
    let rows = contents::rows(atlas, volume, &back_matter);
    let header = contents::header(atlas, volume);
    let explained = how_to_read_pages(atlas, volume, &back_matter, options);
    let places_with = |contents: usize| places(atlas, volume, [explained, contents]);
    let contents = columns::compose_list(&rows, &header, places_with, options, &theme);
    let places = places_with(contents.len());
    if let Some(how) = &atlas.how_to_read {
        let find = contents::ways_to_find(atlas, volume, &back_matter, &places);
        pages.extend(how_to_read::compose(how, atlas, &find, options));
        // With shorter numbers of pages, the text may need one page less.
        pages.resize_with(1 + explained, || empty_scene(atlas.title.to_owned(), options, &theme));
    }
    pages.extend(contents);
    let link = |page| volume.page_index(page, places.front);
    pages.extend(charts_in(atlas, volume).map(|chart| finding::compose(chart, atlas, link, options)));
    let is_blank = pages.len() < places.front;
    let tabs = atlas.all_tabs(&back_matter);
    for (index, page) in pages.iter_mut().enumerate() {
        draw_folio(page, page_number(volume, places.front, index), index, options);
        if index > 0 {
            folio::draw_tabs(page, &tabs, None, index, link, options);
        }
    }
    pages.extend(is_blank.then(|| empty_scene(atlas.title.to_owned(), options, &theme)));
    pages
}

/// Composes the back matter of a volume, after `front` pages of front matter: in the last volume the lists of curves, and the
/// index of geometries by straightness, by transmission angle and by symmetry.
pub fn compose_back_matter(atlas: &Atlas, volume: &Volume, front: usize, options: &Options) -> Vec<Scene> {
    if volume.number < volume.volume_count || atlas.plates_only {
        return Vec::new();
    }
    let theme = options.theme.for_paper(options.paper);
    let link = |page| volume.page_index(page, front);
    let places = Places { how_to_read: 0, charts: 0, front };
    let compose = |list: &CurveList| match list.columns.is_empty() {
        true => list::compose(list, atlas, link, options),
        false => table::compose(list, (atlas, volume), places, options, &theme),
    };
    let mut pages: Vec<Scene> = atlas.lists.iter().flat_map(compose).collect();
    let header = ListHeader { title: INDEX_TITLE, note: "", heads: &[], atlas, volume };
    pages.extend(columns::compose_list(&index::rows(atlas), &header, |_| places, options, &theme));
    let finisher = PageFinisher::new(atlas, volume, front, options);
    for (page, index) in pages.iter_mut().zip(front + volume.page_count..) {
        finisher.finish(page, index);
    }
    pages
}

/// Draws what is outside the borders of the pages of a volume after its front matter: the folio and the thumb index.
#[derive(Clone, Debug)]
pub struct PageFinisher<'a> {
    volume: &'a Volume,
    tabs: Vec<Tab>,
    /// The number of pages of front matter.
    front: usize,
    /// The pages that the contents list, with the pages of the contents, by their indices.
    entries: Vec<(usize, usize)>,
    options: &'a Options,
}

impl<'a> PageFinisher<'a> {
    /// What is drawn on the pages of a volume, after `front` pages of front matter.
    pub fn new(atlas: &Atlas, volume: &'a Volume, front: usize, options: &'a Options) -> PageFinisher<'a> {
        let tabs = atlas.all_tabs(&atlas.back_matter(options));
        PageFinisher { volume, tabs, front, entries: Vec::new(), options }
    }

    /// The same with links from the pages to their entries in the contents, which are among the pages of the front matter.
    pub fn with_entries(self, front: &[Scene]) -> PageFinisher<'a> {
        let listed = |(k, page): (usize, &Scene)| -> Vec<(usize, usize)> {
            let entries = page.links.iter().filter(|link| link.kind == LinkKind::Contents);
            entries.filter_map(|link| Some((link.page_index()?, k))).collect()
        };
        let mut entries: Vec<(usize, usize)> = front.iter().enumerate().flat_map(listed).collect();
        entries.sort_unstable();
        PageFinisher { entries, ..self }
    }

    /// Draws it on the page at an index of the file, from 0; the result is the label of the page.
    pub fn finish(&self, scene: &mut Scene, page_index: usize) -> PageNumber {
        let label = page_number(self.volume, self.front, page_index);
        draw_folio(scene, label, page_index, self.options);
        let before = self.entries.partition_point(|(listed, _)| *listed <= page_index);
        if let Some((_, contents)) = before.checked_sub(1).and_then(|k| self.entries.get(k)) {
            let title = format!("page {}: the entry of this page", page_number(self.volume, self.front, *contents));
            scene.links.push(folio::link(scene, page_index, (*contents, title), self.options));
        }
        if let PageNumber::Arabic(page) = label {
            let link = |page| self.volume.page_index(page, self.front);
            folio::draw_tabs(scene, &self.tabs, Some(page as usize), page_index, link, self.options);
        }
        label
    }
}

/// The outline of a volume, with `front` pages of front matter: its parts, each family with its cells.
pub fn outline(atlas: &Atlas, volume: &Volume, front: usize, options: &Options) -> Vec<OutlineEntry> {
    let entry = |title: &str, page| OutlineEntry { title: title.to_owned(), page_index: page, children: Vec::new() };
    let mut entries: Vec<OutlineEntry> = (!atlas.plates_only).then(|| entry(atlas.title, 0)).into_iter().collect();
    let back_matter = atlas.back_matter(options);
    let how_to_read = how_to_read_pages(atlas, volume, &back_matter, options);
    if how_to_read > 0 {
        entries.push(entry(how_to_read::TITLE, 1));
    }
    let theme = options.theme.for_paper(options.paper);
    let contents = contents::page_count(atlas, volume, &back_matter, options, &theme);
    if contents > 0 && !atlas.plates_only {
        entries.push(entry("Contents", 1 + how_to_read));
    }
    let first_chart = places(atlas, volume, [how_to_read, contents]).charts;
    let charts: Vec<&FindingChart> = charts_in(atlas, volume).collect();
    if !charts.is_empty() {
        let titled = charts.iter().zip(first_chart..).filter(|(chart, _)| !chart.title.is_empty());
        let children = titled.map(|(chart, index)| entry(&chart.title, index)).collect();
        entries.push(OutlineEntry { children, ..entry(CHARTS_TITLE, first_chart) });
    }
    for (before, chapter) in atlas.chapters_with_offset() {
        let first = (before + 1).max(volume.first_page);
        let is_in_chapter = first <= before + chapter.page_count && volume.page_range().contains(&first);
        let Some(page) = volume.page_index(first, front).filter(|_| is_in_chapter) else { continue };
        let cells = contents::listed_cells(before, chapter, volume);
        let child = |cell: &&CellEntry| Some(entry(&cell.caption, volume.page_index(before + cell.page, front)?));
        let named = cells.iter().filter(|cell| !cell.caption.is_empty()).copied();
        entries.push(OutlineEntry {
            title: chapter.title.to_owned(),
            page_index: page,
            children: named.filter_map(|cell| child(&cell)).collect(),
        });
    }
    entries.extend(
        back_matter.iter().filter_map(|part| Some(entry(&part.title, volume.page_index(part.first_page, front)?))),
    );
    entries
}

/// The label of the page at an index of a volume's file, after `front` pages of front matter, which have Roman numerals; the
/// others have their numbers in the atlas.
pub fn page_number(volume: &Volume, front: usize, page_index: usize) -> PageNumber {
    let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    match page_index.checked_sub(front) {
        None => PageNumber::Roman(number(page_index + 1)),
        Some(page) => PageNumber::Arabic(number(volume.first_page + page)),
    }
}
