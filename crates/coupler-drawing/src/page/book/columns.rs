//! Lists in columns, on as many pages as needed.

use super::super::Options;
use super::super::area::{self, Area};
use super::super::element::{Drawing, TextLine};
use super::super::empty_scene::empty_scene;
use super::super::heading;
use super::super::theme::Theme;
use super::atlas::{Atlas, Volume};
use crate::scene::{Anchor, Item, LinkKind, LinkTarget, PageLink, PageNumber, Path, Polyline, Scene};
use coupler_curves::geometry::{Point, Vector};

/// A page that a list refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// The first page that says how plates are read.
    HowToRead,
    /// A finding chart, counted in the volume, from 0.
    Chart(usize),
    /// A page by its number in the atlas, from 1.
    Page(usize),
}

/// Where the parts of the front matter are in the file of a volume, by the indices of their first pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Places {
    pub how_to_read: usize,
    pub charts: usize,
    /// The number of pages of front matter.
    pub front: usize,
}

impl Target {
    /// A label that is at least as wide as that of the page: that of a page of the front matter is not known yet.
    fn widest_label(self) -> String {
        match self {
            Target::HowToRead | Target::Chart(_) => "xxviii".to_owned(),
            Target::Page(page) => page.to_string(),
        }
    }
}

impl Places {
    /// The index of a page in the file; `None` if it is in another volume.
    fn index(&self, target: Target, volume: &Volume) -> Option<usize> {
        match target {
            Target::HowToRead => Some(self.how_to_read),
            Target::Chart(k) => Some(self.charts + k),
            Target::Page(page) => volume.page_index(page, self.front),
        }
    }

    /// The number of a page.
    pub fn label(&self, target: Target) -> String {
        let roman = |index: usize| PageNumber::Roman(u32::try_from(index + 1).unwrap_or(u32::MAX)).to_string();
        match target {
            Target::HowToRead => roman(self.how_to_read),
            Target::Chart(k) => roman(self.charts + k),
            Target::Page(page) => page.to_string(),
        }
    }
}

/// A row of a list.
pub(super) enum Row<'a> {
    /// A heading of the rows after it.
    Heading { text: String, page: Option<Target> },
    /// A note, wrapped to as many lines as needed.
    Note(String),
    /// An entry with its page.
    Entry(Entry<'a>),
}

/// A geometry with its page.
pub(super) struct Entry<'a> {
    /// The title of its family, if the list has several.
    pub family: Option<&'a str>,
    pub caption: &'a str,
    /// The names of parameters in the caption, set in italics.
    pub symbols: &'a [String],
    /// The values by which it is found, which come first.
    pub values: Vec<String>,
    /// What the measured curve is called, as in "point 12", if the geometry has several; may be empty.
    pub curve: String,
    pub page: Target,
    /// The number of the last page, if it has several.
    pub last_page: Option<usize>,
}

impl Entry<'_> {
    /// The family and the caption in one line.
    fn text_line(&self, theme: &Theme) -> TextLine {
        let separator = if self.caption.is_empty() { "" } else { " · " };
        let family = self.family.map_or(String::new(), |family| format!("{family}{separator}"));
        let mut line = entry_line(&family, theme);
        // Only the caption contains names of parameters.
        line.text.runs.extend(entry_line(self.caption, theme).with_italics(self.symbols).text.runs);
        line.text.runs.retain(|run| !run.text.is_empty());
        line
    }

    /// The family and the caption in a line of the first width, or else in several, the others of the second width: the caption, by which a
    /// linkage is built, is whole. A first line with too little room is empty.
    fn lines(&self, [first, other]: [f64; 2], theme: &Theme) -> Vec<TextLine> {
        let whole = self.text_line(theme);
        let fitted = whole.clone().fit_width(first);
        if fitted.text.runs == whole.text.runs {
            return vec![fitted];
        }
        let is_below = is_below_values(first, theme);
        let beside = if is_below { other } else { first };
        let mut lines: Vec<TextLine> = is_below.then(|| entry_line("", theme)).into_iter().collect();
        lines.extend(self.family.map(|family| entry_line(family, theme).fit_width(beside)));
        let width = if self.family.is_some() { other } else { beside };
        let words = entry_line(self.caption, theme).wrap(width);
        let words = words.iter().filter(|words| !words.is_empty());
        lines.extend(words.map(|words| entry_line(words, theme).with_italics(self.symbols).fit_width(width)));
        lines
    }

    /// The page, or the range of pages, of which the first has a label.
    fn page_label(&self, first: String) -> String {
        self.last_page.map_or(first.clone(), |last| format!("{first}–{last}"))
    }
}

/// The title of a list, and what is under it.
pub(super) struct ListHeader<'a> {
    pub title: &'a str,
    /// What is listed; that of the atlas and the volume if it is empty.
    pub note: &'a str,
    /// The heads of the values of entries; may be none.
    pub heads: &'a [String],
    pub atlas: &'a Atlas<'a>,
    pub volume: &'a Volume,
}

/// The dimensions of the columns, in millimetres.
struct ColumnLayout {
    corner: Point,
    /// The size of one column.
    column_size: Vector,
    gutter: f64,
    count: usize,
    /// The distance of baselines.
    line_height: f64,
    /// The widths of page numbers and labels of curves, with the gap before them, and of each value, with the gap after it.
    page_width: f64,
    curve_width: f64,
    value_widths: Vec<f64>,
}

/// A line with its position: `y` is the distance of the baseline from the top of the column.
struct PlacedLine<'r> {
    row: &'r Row<'r>,
    /// Its text, and how far that is from the left edge of the column.
    text: TextLine,
    indent: f64,
    /// Whether it is the first line of its row.
    is_first: bool,
    column: usize,
    y: f64,
}

/// The number of pages of rows.
pub(super) fn page_count(rows: &[Row], header: &ListHeader, options: &Options, theme: &Theme) -> usize {
    let columns = ColumnLayout::fit(rows, header, options, theme);
    columns.place_rows(rows, theme).last().map_or(0, |last| last.column / columns.count + 1)
}

/// The first and the last row of each page.
pub(super) fn page_ends<'r>(
    rows: &'r [Row<'r>],
    header: &ListHeader,
    options: &Options,
    theme: &Theme,
) -> Vec<[&'r Row<'r>; 2]> {
    let columns = ColumnLayout::fit(rows, header, options, theme);
    let placed = columns.place_rows(rows, theme);
    let pages = placed.chunk_by(|a, b| a.column / columns.count == b.column / columns.count);
    pages.filter_map(|page| Some([page.first()?.row, page.last()?.row])).collect()
}

/// Composes rows to pages. `places` maps the number of these pages to the places of the front matter.
pub(super) fn compose_list(
    rows: &[Row],
    header: &ListHeader,
    places: impl Fn(usize) -> Places,
    options: &Options,
    theme: &Theme,
) -> Vec<Scene> {
    let columns = ColumnLayout::fit(rows, header, options, theme);
    let placed = columns.place_rows(rows, theme);
    let pages: Vec<&[PlacedLine]> =
        placed.chunk_by(|a, b| a.column / columns.count == b.column / columns.count).collect();
    let places = places(pages.len());
    let page = |placed: &&[PlacedLine]| {
        let mut scene = empty_scene(format!("{}: {}", header.title, header.atlas.title), options, theme);
        let root = area::whole_page(&mut scene);
        heading::draw_border(&root, theme);
        let at = heading::draw_title(&root, header.title, theme);
        let continued = placed.first().and_then(|first| continued_heading(rows, first.row));
        let lines = header.lines(continued, root.size().x - 2.0 * at.x, theme);
        for (k, line) in lines.into_iter().enumerate() {
            root.record(line.moved_to(at + Vector::new(0.0, heading::SOURCE_LEADING * theme.source_size * k as f64)));
        }
        columns.draw_heads(&root, header, theme);
        let leaders = columns.draw_lines(&root, placed, &places, theme);
        root.record(Drawing { class: "leaders", title: String::new(), items: leaders });
        drop(root);
        scene.links = placed.iter().filter_map(|placed| columns.line_link(placed, header.volume, &places)).collect();
        scene
    };
    pages.iter().map(page).collect()
}

/// The text of the heading that a row is under, if another row is between them.
fn continued_heading<'r>(rows: &'r [Row], row: &Row) -> Option<&'r str> {
    let at = rows.iter().position(|other| std::ptr::eq(other, row))?;
    let heading = |row: &'r Row| if let Row::Heading { text, .. } = row { Some(text.as_str()) } else { None };
    if heading(&rows[at]).is_some() { None } else { rows[..at].iter().rev().find_map(heading) }
}

/// The distance of the values of an entry, in ems.
const GAP: f64 = 1.0;

impl ListHeader<'_> {
    /// The lines under the title, of a page whose rows are under a heading of an earlier one with its text: in place of the title of the
    /// atlas, so that they are as many on all pages.
    fn lines(&self, continued: Option<&str>, width: f64, theme: &Theme) -> Vec<TextLine> {
        let title = self.atlas.title;
        let said = match (self.note, self.volume.name(), continued) {
            ("", _, Some(heading)) => format!("{heading}, continued"),
            ("", Some(name), None) => format!("{title} · {name}"),
            ("", None, None) => title.to_owned(),
            (note, ..) => note.to_owned(),
        };
        let line = |text: &str| theme.text_line(text, Point::origin(), Anchor::Start, theme.source_size, theme.grey);
        line(&said).wrap(width).iter().map(|words| line(words).fit_width(width)).collect()
    }
}

/// Whether the text of entries is below their values, which leave it this width.
fn is_below_values(width: f64, theme: &Theme) -> bool {
    /// The least width of the text beside them, in ems.
    const LEAST: f64 = 12.0;
    width < LEAST * theme.note_size
}

fn entry_line(text: &str, theme: &Theme) -> TextLine {
    theme.text_line(text, Point::origin(), Anchor::Start, theme.note_size, theme.ink)
}

fn heading_line(text: &str, theme: &Theme) -> TextLine {
    theme.text_line(text, Point::origin(), Anchor::Start, theme.caption_size, theme.ink)
}

fn note_line(text: &str, theme: &Theme) -> TextLine {
    theme.text_line(text, Point::origin(), Anchor::Start, theme.note_size, theme.grey)
}

fn text_width(text: &str, theme: &Theme) -> f64 {
    entry_line(text, theme).text.width()
}

impl ColumnLayout {
    /// As many columns as the widest entry allows, up to eight.
    fn fit(rows: &[Row], header: &ListHeader, options: &Options, theme: &Theme) -> ColumnLayout {
        let [_, bottom, left] = heading::margins(theme);
        let lines = header.lines(None, options.paper.width - 2.0 * left, theme).len();
        let heads = if header.heads.is_empty() { 0.0 } else { 1.5 * theme.note_size };
        let top = heading::contents_top(header.title, lines, options.paper, theme) + heads;
        let whole = Vector::new(options.paper.width - 2.0 * left, options.paper.height - top - bottom);
        let [mut text, mut curve, mut page] = [0.0f64; 3];
        let mut values: Vec<f64> = header.heads.iter().map(|head| text_width(head, theme)).collect();
        for row in rows {
            if let Row::Entry(entry) = row {
                text = text.max(entry.text_line(theme).text.width());
                values.resize(values.len().max(entry.values.len()), 0.0);
                for (width, value) in values.iter_mut().zip(&entry.values) {
                    *width = width.max(text_width(value, theme));
                }
                curve = curve.max(text_width(&entry.curve, theme));
                page = page.max(text_width(&entry.page_label(entry.page.widest_label()), theme));
            }
        }
        let gap = GAP * theme.note_size;
        let with_gap = |width: f64| if width > 0.0 { width + gap } else { 0.0 };
        let (page, curve) = (with_gap(page) + gap, with_gap(curve));
        let values: Vec<f64> = values.into_iter().map(with_gap).collect();
        let gutter = 4.0 * theme.note_size;
        let natural = (text + curve + values.iter().sum::<f64>() + page).max(20.0 * theme.note_size);
        let count = (((whole.x + gutter) / (natural + gutter)).floor() as usize).clamp(1, 8);
        let size = Vector::new((whole.x + gutter) / count as f64 - gutter, whole.y.max(8.0 * theme.note_size));
        ColumnLayout {
            corner: Point::new(left, top),
            column_size: size,
            gutter,
            count,
            line_height: 1.5 * theme.note_size,
            page_width: page,
            curve_width: curve,
            value_widths: values,
        }
    }

    /// The widths of the first line of the text of an entry and of those after it, and the distances of both from the left of the column.
    fn entry_lines(&self, theme: &Theme) -> ([f64; 2], [f64; 2]) {
        let values: f64 = self.value_widths.iter().sum();
        let first = self.column_size.x - values - self.curve_width - self.page_width;
        let indent = GAP * theme.note_size + if is_below_values(first, theme) { 0.0 } else { values };
        ([first, self.column_size.x - indent], [values, indent])
    }

    /// Places the rows from column to column; a heading is kept together with the rows after it, and an entry is not divided.
    fn place_rows<'r>(&self, rows: &'r [Row<'r>], theme: &Theme) -> Vec<PlacedLine<'r>> {
        let mut placed: Vec<PlacedLine> = Vec::new();
        let (mut column, mut y) = (0, 0.0);
        let (widths, [first_indent, indent]) = self.entry_lines(theme);
        for row in rows {
            let lines: Vec<TextLine> = match row {
                Row::Heading { text, page } => {
                    let width = self.heading_width(*page);
                    let words = heading_line(text, theme).wrap(width);
                    words.iter().map(|words| heading_line(words, theme).fit_width(width)).collect()
                }
                Row::Note(text) => {
                    let words = note_line(text, theme).wrap(self.column_size.x);
                    words.iter().map(|words| note_line(words, theme).fit_width(self.column_size.x)).collect()
                }
                Row::Entry(entry) => entry.lines(widths, theme),
            };
            let space_before = if matches!(row, Row::Heading { .. }) && y > 0.0 { self.line_height } else { 0.0 };
            let least_lines = match row {
                // A heading with its note and an entry needs about five lines.
                Row::Heading { .. } => 6.0,
                Row::Note(_) => 1.0,
                Row::Entry(_) => lines.len() as f64,
            };
            if y > 0.0 && y + space_before + least_lines * self.line_height > self.column_size.y {
                (column, y) = (column + 1, 0.0);
            } else {
                y += space_before;
            }
            for (k, text) in lines.into_iter().enumerate() {
                if y > 0.0 && y + self.line_height > self.column_size.y {
                    (column, y) = (column + 1, 0.0);
                }
                y += self.line_height;
                let indent = match (row, k) {
                    (Row::Entry(_), 0) => first_indent,
                    (Row::Entry(_), _) => indent,
                    _ => 0.0,
                };
                placed.push(PlacedLine { row, text, indent, is_first: k == 0, column, y });
            }
        }
        placed
    }

    /// The width of the text of a heading, next to its page number.
    fn heading_width(&self, page: Option<Target>) -> f64 {
        self.column_size.x - page.map_or(0.0, |_| self.page_width)
    }

    /// Draws the heads of the values above each column.
    fn draw_heads(&self, root: &impl Area, header: &ListHeader, theme: &Theme) {
        if header.heads.is_empty() {
            return;
        }
        for column in 0..self.count {
            let left = self.corner + Vector::new(column as f64 * (self.column_size.x + self.gutter), 0.0);
            let ends = self.value_ends(left.x, theme);
            let record = |text: &str, x: f64| {
                let at = Point::new(x, left.y);
                root.record(theme.text_line(text, at, Anchor::End, theme.note_size, theme.grey));
            };
            header.heads.iter().zip(ends).for_each(|(head, x)| record(head, x));
            record("page", left.x + self.column_size.x);
        }
    }

    /// The right ends of the values of a column that begins at x.
    fn value_ends(&self, left: f64, theme: &Theme) -> impl Iterator<Item = f64> {
        let gap = GAP * theme.note_size;
        self.value_widths.iter().scan(left, move |end, width| {
            *end += width;
            Some(*end - gap)
        })
    }

    /// The position at which a line starts on its page.
    fn line_start(&self, placed: &PlacedLine) -> Point {
        let column = (placed.column % self.count) as f64;
        self.corner + Vector::new(column * (self.column_size.x + self.gutter), placed.y)
    }

    /// Draws lines; the result is the leaders of their entries.
    fn draw_lines(&self, root: &impl Area, placed: &[PlacedLine], places: &Places, theme: &Theme) -> Vec<Item> {
        let mut leaders = Vec::new();
        for line in placed {
            let at = self.line_start(line);
            let text = line.text.clone().moved_to(at + Vector::new(line.indent, 0.0));
            let text_end = text.text.position.x + text.text.width();
            if let (Row::Entry(entry), true) = (line.row, line.is_first) {
                let page = entry.page_label(places.label(entry.page));
                self.draw_values(root, entry, at, theme);
                root.record(text);
                leaders.extend(self.draw_page(root, entry, &page, (text_end, at), theme));
                continue;
            }
            root.record(text);
            if let (Row::Heading { page: Some(page), .. }, true) = (line.row, line.is_first) {
                let end = at + Vector::new(self.column_size.x, 0.0);
                let label = places.label(*page);
                root.record(theme.text_line(&label, end, Anchor::End, theme.note_size, theme.ink));
            }
        }
        let stroke = Some(theme.stroke(theme.hairline, theme.fine_width));
        vec![Item::Path(Path { polylines: leaders, stroke, fill: None })]
    }

    /// Draws the values of an entry from the start of its line.
    fn draw_values(&self, root: &impl Area, entry: &Entry, at: Point, theme: &Theme) {
        for (value, x) in entry.values.iter().zip(self.value_ends(at.x, theme)) {
            root.record(theme.text_line(value, Point::new(x, at.y), Anchor::End, theme.note_size, theme.ink));
        }
    }

    /// Draws the curve and the page of an entry, whose line starts at a point and has its text up to x; the result is the dots of its leader.
    fn draw_page(
        &self,
        root: &impl Area,
        entry: &Entry,
        page: &str,
        (text_end, at): (f64, Point),
        theme: &Theme,
    ) -> Vec<Polyline> {
        let right = at.x + self.column_size.x;
        let numbers = [(page, right, theme.ink), (entry.curve.as_str(), right - self.page_width, theme.grey)];
        let mut to = right;
        for (text, x, ink) in numbers.into_iter().filter(|(text, ..)| !text.is_empty()) {
            let number = theme.text_line(text, Point::new(x, at.y), Anchor::End, theme.note_size, ink);
            to = number.text.start().x;
            root.record(number);
        }
        leader_dots(text_end, to, at.y, theme)
    }

    /// The link over a line, if it leads to a page of its volume.
    fn line_link(&self, placed: &PlacedLine, volume: &Volume, places: &Places) -> Option<PageLink> {
        let page = match placed.row {
            Row::Heading { page, .. } => (*page)?,
            Row::Entry(entry) => entry.page,
            Row::Note(_) => return None,
        };
        let corner = self.line_start(placed) - Vector::new(0.0, 0.75 * self.line_height);
        let text = match placed.row {
            Row::Entry(entry) => entry.caption.to_owned(),
            _ => placed.text.text.words(),
        };
        Some(PageLink {
            corner,
            size: Vector::new(self.column_size.x, self.line_height),
            target: LinkTarget::Page(places.index(page, volume)?),
            title: format!("page {}: {text}", places.label(page)),
            kind: LinkKind::Contents,
        })
    }
}

/// The dots of a leader from one x to another, aligned vertically across lines.
fn leader_dots(from: f64, to: f64, y: f64, theme: &Theme) -> Vec<Polyline> {
    let step = 0.9 * theme.note_size;
    let (first, last) = ((from / step + 0.7).ceil() as i64, (to / step - 0.9).floor() as i64);
    let dot = |k: i64| {
        let x = k as f64 * step;
        Polyline { points: vec![Point::new(x, y), Point::new(x + theme.fine_width, y)], is_closed: false }
    };
    (first..=last).map(dot).collect()
}
