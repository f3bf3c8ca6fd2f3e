//! Pages of lists of curves: each entry with a small drawing, its dimensions and figures.

use super::super::area::{self, Area};
use super::super::element::{Drawing, TextLine};
use super::super::empty_scene::empty_scene;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{Options, heading};
use super::atlas::{Atlas, CurveList, ListEntry};
use super::reference::reference;
use crate::scene::{Anchor, Group, Item, LinkKind, LinkTarget, PageLink, Path, Scene};
use coupler_curves::geometry::{Point, Vector};

/// The least size of an entry, in ems of its text.
const LEAST: [f64; 2] = [23.5, 11.5];
/// The most columns and rows.
const MOST_ROWS_COLUMNS: usize = 8;

/// The part of the width of an entry that its drawing takes.
const DRAWING_PART: f64 = 0.4;

/// The grid of the entries of a page.
struct Grid {
    /// The height of the heading.
    top: f64,
    corner: Point,
    /// The distance of entries.
    step: Vector,
    columns: usize,
    rows: usize,
}

/// The lines of the note of a list.
fn note_lines(list: &CurveList, width: f64, theme: &Theme) -> Vec<TextLine> {
    let line = |text: &str| theme.text_line(text, Point::origin(), Anchor::Start, theme.source_size, theme.grey);
    let words = line(&list.note).wrap(width);
    words.iter().filter(|text| !text.is_empty()).map(|text| line(text).fit_width(width)).collect()
}

impl Grid {
    fn new(list: &CurveList, atlas: &Atlas, options: &Options, theme: &Theme) -> Grid {
        let left = theme.border + theme.margin;
        let width = options.paper.width - 2.0 * left;
        let [_, bottom, _] = heading::margins(theme);
        let lines = note_lines(list, width, theme).len();
        let top = heading::contents_top(&list.title, lines, options.paper, theme) + 0.5 * theme.source_size;
        let whole = Vector::new(width, options.paper.height - top - bottom);
        let count = |length: f64, least: f64| ((length / least).floor().max(1.0) as usize).min(MOST_ROWS_COLUMNS);
        let em = theme.note_size;
        let columns = count(whole.x, LEAST[0] * em);
        // The texts of all entries have space.
        let width = text_width(whole.x / columns as f64, em);
        let lines = list.entries.iter().map(|entry| entry_lines(entry, atlas, width, theme).len()).max().unwrap_or(0);
        let rows = count(whole.y, LEAST[1].max(1.3 * lines as f64 + 1.1) * em);
        // The entries are distributed evenly over the pages.
        let pages = list.entries.len().div_ceil(columns * rows).max(1);
        let rows = list.entries.len().div_ceil(pages * columns).clamp(1, rows);
        let step = Vector::new(whole.x / columns as f64, (whole.y / rows as f64).min(2.2 * LEAST[1] * em));
        Grid { top, corner: Point::new(left, top), step, columns, rows }
    }

    fn per_page(&self) -> usize {
        self.columns * self.rows
    }
}

/// The number of pages of a list; none without entries.
pub(super) fn page_count(list: &CurveList, atlas: &Atlas, options: &Options) -> usize {
    let theme = options.theme.for_paper(options.paper);
    list.entries.len().div_ceil(Grid::new(list, atlas, options, &theme).per_page())
}

/// Composes the pages of a list. `link` is the index in the file of a page of the atlas, if it is in the file.
pub(super) fn compose(
    list: &CurveList,
    atlas: &Atlas,
    link: impl Fn(usize) -> Option<usize>,
    options: &Options,
) -> Vec<Scene> {
    let theme = &options.theme.for_paper(options.paper);
    let grid = Grid::new(list, atlas, options, theme);
    let page = |(k, entries): (usize, &[ListEntry])| {
        let mut scene = empty_scene(format!("{}: {}", list.title, atlas.title), options, theme);
        let root = area::whole_page(&mut scene);
        heading::draw_border(&root, theme);
        let mut at = heading::draw_title(&root, &list.title, theme);
        for line in note_lines(list, root.size().x - 2.0 * at.x, theme) {
            root.record(line.moved_to(at));
            at.y += heading::SOURCE_LEADING * theme.source_size;
        }
        let mut links = Vec::new();
        for (place, entry) in entries.iter().enumerate() {
            let (column, row) = (place % grid.columns, place / grid.columns);
            let shift = Vector::new(grid.step.x * column as f64, grid.step.y * row as f64);
            let frame = Rect { corner: grid.corner + shift, size: grid.step };
            draw_entry(&root, frame, k * grid.per_page() + place + 1, entry, atlas, theme);
            if let Some(page_index) = link(entry.page) {
                let title = format!("{}: {}", reference(entry.page, entry.figure), entry.caption);
                let (corner, size, kind) = (frame.corner, frame.size, LinkKind::Entry);
                links.push(PageLink { corner, size, target: LinkTarget::Page(page_index), title, kind });
            }
        }
        draw_rules(&root, &grid, entries.len(), theme);
        drop(root);
        scene.links = links;
        scene
    };
    list.entries.chunks(grid.per_page()).enumerate().map(page).collect()
}

/// Draws a line above each row of entries.
fn draw_rules(root: &impl Area, grid: &Grid, count: usize, theme: &Theme) {
    let stroke = theme.stroke(theme.hairline, theme.hair_width);
    let rule = |row: usize| {
        let y = grid.top + grid.step.y * row as f64;
        let end = grid.corner.x + grid.step.x * grid.columns as f64;
        Item::Path(Path::stroked(vec![Point::new(grid.corner.x, y), Point::new(end, y)], stroke))
    };
    let items = (0..count.div_ceil(grid.columns)).map(rule).collect();
    root.record(Drawing { class: "rule", title: String::new(), items });
}

/// Draws an entry with its rank.
fn draw_entry(root: &impl Area, frame: Rect, rank: usize, entry: &ListEntry, atlas: &Atlas, theme: &Theme) {
    let em = theme.note_size;
    let drawing = Rect {
        corner: frame.corner + Vector::new(0.8 * em, 1.0 * em),
        size: Vector::new(DRAWING_PART * frame.size.x - 1.6 * em, frame.size.y - 2.0 * em),
    };
    let shown = [entry.caption.as_str(), &entry.curve].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>();
    let what = if shown.is_empty() { reference(entry.page, entry.figure) } else { shown.join(", ") };
    root.grouped(Group::figure("entry", format!("Curve of {what}")), || {
        if let Some(miniature) = &entry.drawing {
            miniature.draw(root, drawing, None, theme);
        }
    });
    let left = frame.corner.x + DRAWING_PART * frame.size.x;
    let width = text_width(frame.size.x, em);
    let mut y = frame.corner.y + 0.4 * em;
    let bottom = frame.corner.y + frame.size.y - 0.6 * em;
    let rank_line =
        theme.text_line(&rank.to_string(), frame.corner + Vector::new(0.0, 1.4 * em), Anchor::Start, em, theme.grey);
    root.record(rank_line);
    // On paper that is too small for a single entry, the page is told and other lines as far as there is space.
    for line in entry_lines(entry, atlas, width, theme) {
        y += 1.3 * em;
        if y > bottom {
            return;
        }
        root.record(line.fit_width(width).moved_to(Point::new(left, y)));
    }
}

/// The width of the texts of an entry.
fn text_width(entry_width: f64, em: f64) -> f64 {
    entry_width * (1.0 - DRAWING_PART) - 1.2 * em
}

/// The lines of text of an entry, no wider than `width` or nearly.
fn entry_lines(entry: &ListEntry, atlas: &Atlas, width: f64, theme: &Theme) -> Vec<TextLine> {
    let chapter = atlas.chapters.get(entry.chapter);
    let symbols = chapter.map_or(&[][..], |chapter| chapter.symbols);
    let mut texts = vec![(reference(entry.page, entry.figure), theme.text_ink(theme.curve_ink(0)))];
    let family = chapter.filter(|_| atlas.chapters.len() > 1 && atlas.names_families);
    texts.extend(family.map(|chapter| (chapter.title.to_owned(), theme.grey)));
    texts.push((entry.caption.clone(), theme.ink));
    texts.push((entry.curve.clone(), theme.ink));
    texts.extend(entry.lines.iter().map(|line| (line.clone(), theme.grey)));
    let mut lines = Vec::new();
    for (text, ink) in texts.into_iter().filter(|(text, _)| !text.is_empty()) {
        let line = |text: &str| theme.text_line(text, Point::origin(), Anchor::Start, theme.note_size, ink);
        lines.extend(line(&text).wrap_unless_it_fits(width).iter().map(|words| line(words).with_italics(symbols)));
    }
    lines
}
