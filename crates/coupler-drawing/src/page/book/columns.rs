//! Lists in columns, on as many pages as it takes.

use plotters::drawing::IntoDrawingArea;

use super::super::Options;
use super::super::element::{Area, Drawing, Words, draw, size};
use super::super::heading;
use super::super::theme::Theme;
use super::{Atlas, Volume, blank, number};
use crate::scene::{Anchor, Canvas, Item, Label, Line, Link, Path, Scene, Text};
use coupler_curves::geometry::{Point, Vector};

/// A line of a list. Pages are those of the atlas, from 1.
pub(super) enum Row<'a> {
    /// What follows it is about this.
    Heading { text: String, page: Option<usize> },
    /// A remark, of one line or more.
    Note(String),
    /// Something with its page.
    Entry(Entry<'a>),
}

/// A geometry, or what else has a page.
pub(super) struct Entry<'a> {
    /// The name of its family, where it needs one.
    pub family: Option<&'a str>,
    pub caption: &'a str,
    /// Words of the caption that stand for values.
    pub symbols: &'a [String],
    /// What was measured of it; may be empty.
    pub value: String,
    /// The number of the curve it was measured of.
    pub curve: Option<usize>,
    pub page: usize,
}

impl Entry<'_> {
    /// What it says at a place, in one line.
    fn words(&self, at: Point, theme: &Theme) -> Words {
        let family = self.family.map_or(String::new(), |family| format!("{family} · "));
        let mut says = words(&family, at, Anchor::Start, theme.note, theme);
        // Only in the caption are there words that stand for values.
        says.text.runs.extend(words(self.caption, at, Anchor::Start, theme.note, theme).italic(self.symbols).text.runs);
        says.text.runs.retain(|run| !run.text.is_empty());
        says
    }

    fn curve(&self) -> String {
        self.curve.map_or(String::new(), |curve| format!("curve {curve}"))
    }
}

/// What the pages of a list have in common.
pub(super) struct Leaf<'a> {
    pub title: &'static str,
    pub atlas: &'a Atlas<'a>,
    pub volume: &'a Volume,
    /// The Roman numeral of the first.
    pub first: usize,
}

/// The measures of a column, in millimetres.
struct Columns {
    corner: Point,
    /// Of one column.
    size: Vector,
    gutter: f64,
    count: usize,
    /// From one line to the next.
    line: f64,
    /// The widths that pages, values and curves' numbers take.
    page: f64,
    value: f64,
    curve: f64,
}

/// A line with its place: from the top of a column, on the baseline.
struct Placed<'r> {
    row: &'r Row<'r>,
    /// Of a heading or a note the line it is, of others nothing.
    text: Option<String>,
    /// Whether it is the first of its row.
    is_first: bool,
    column: usize,
    y: f64,
}

/// Sets rows on pages. `front` gives, of the number of pages set, how much front matter there is in all.
pub(super) fn set(
    rows: &[Row],
    leaf: &Leaf,
    front: impl Fn(usize) -> usize,
    (options, theme): (&Options, &Theme),
) -> Vec<Scene> {
    let columns = Columns::fit(rows, options, theme);
    let placed = columns.place(rows, theme);
    let pages: Vec<&[Placed]> = placed.chunk_by(|a, b| a.column / columns.count == b.column / columns.count).collect();
    let front = front(pages.len());
    let page = |(k, placed): (usize, &&[Placed])| {
        let mut scene = blank(format!("{}: {}", leaf.title, leaf.atlas.title), options, theme);
        let root = Canvas::new(&mut scene).into_drawing_area();
        heading::border(&root, theme);
        let at = heading::title(&root, leaf.title, theme);
        let says =
            leaf.volume.name().map_or(leaf.atlas.title.to_owned(), |name| format!("{} · {name}", leaf.atlas.title));
        let words = theme.words(&says, at, Anchor::Start, theme.source, theme.grey);
        draw(&root, &words.fitted(size(&root).x - 2.0 * at.x));
        let leaders = columns.draw(&root, placed, theme);
        draw(&root, &Drawing { class: "leaders", title: String::new(), items: leaders });
        drop(root);
        scene.links = placed.iter().filter_map(|placed| columns.link(placed, leaf.volume, front)).collect();
        number(&mut scene, Label::Roman(u32::try_from(leaf.first + k).unwrap_or(u32::MAX)), options);
        scene
    };
    pages.iter().enumerate().map(page).collect()
}

fn words(text: &str, at: Point, anchor: Anchor, size: f64, theme: &Theme) -> Words {
    theme.words(text, at, anchor, size, theme.ink)
}

fn heading(text: &str, theme: &Theme) -> Words {
    words(text, Point::origin(), Anchor::Start, theme.caption, theme)
}

fn note(text: &str, theme: &Theme) -> Words {
    theme.words(text, Point::origin(), Anchor::Start, theme.note, theme.grey)
}

fn width(text: &str, theme: &Theme) -> f64 {
    words(text, Point::origin(), Anchor::Start, theme.note, theme).text.width()
}

impl Columns {
    /// As many columns as the widest entry allows, eight at most and two where one is very wide.
    fn fit(rows: &[Row], options: &Options, theme: &Theme) -> Columns {
        let [top, bottom, _] = heading::margins(theme);
        let left = theme.border + theme.margin;
        let whole = Vector::new(options.paper.width - 2.0 * left, options.paper.height - top - bottom);
        let [mut text, mut value, mut curve, mut page] = [0.0f64; 4];
        for row in rows {
            if let Row::Entry(entry) = row {
                text = text.max(entry.words(Point::origin(), theme).text.width());
                value = value.max(width(&entry.value, theme));
                curve = curve.max(width(&entry.curve(), theme));
                page = page.max(width(&entry.page.to_string(), theme));
            }
        }
        let gap = 1.2 * theme.note;
        let with_gap = |width: f64| if width > 0.0 { width + gap } else { 0.0 };
        let (page, value, curve) = (with_gap(page) + gap, with_gap(value), with_gap(curve));
        let gutter = 5.0 * theme.note;
        let natural = (text + curve + value + page).max(20.0 * theme.note);
        let count = (((whole.x + gutter) / (natural + gutter)).floor() as usize).clamp(2, 8);
        let size = Vector::new((whole.x + gutter) / count as f64 - gutter, whole.y.max(8.0 * theme.note));
        Columns { corner: Point::new(left, top), size, gutter, count, line: 1.5 * theme.note, page, value, curve }
    }

    /// The rows from column to column; a heading stays with what follows it.
    fn place<'r>(&self, rows: &'r [Row<'r>], theme: &Theme) -> Vec<Placed<'r>> {
        let mut placed: Vec<Placed> = Vec::new();
        let (mut column, mut y) = (0, 0.0);
        for row in rows {
            let before = if matches!(row, Row::Heading { .. }) && y > 0.0 { self.line } else { 0.0 };
            // A heading with its note and an entry takes some five lines.
            let room = if matches!(row, Row::Heading { .. }) { 6.0 } else { 1.0 };
            if y > 0.0 && y + before + room * self.line > self.size.y {
                (column, y) = (column + 1, 0.0);
            } else {
                y += before;
            }
            let texts = match row {
                Row::Heading { text, page } => {
                    heading(text, theme).wrapped(self.beside(*page)).into_iter().map(Some).collect()
                }
                Row::Note(text) => note(text, theme).wrapped(self.size.x).into_iter().map(Some).collect(),
                Row::Entry(_) => vec![None],
            };
            for (k, text) in texts.into_iter().enumerate() {
                if y > 0.0 && y + self.line > self.size.y {
                    (column, y) = (column + 1, 0.0);
                }
                y += self.line;
                placed.push(Placed { row, text, is_first: k == 0, column, y });
            }
        }
        placed
    }

    /// The width that is left beside a heading's page.
    fn beside(&self, page: Option<usize>) -> f64 {
        self.size.x - page.map_or(0.0, |_| self.page)
    }

    /// Where a line begins on its page.
    fn start(&self, placed: &Placed) -> Point {
        let column = (placed.column % self.count) as f64;
        self.corner + Vector::new(column * (self.size.x + self.gutter), placed.y)
    }

    /// Draws lines, and gives the dots that lead from what they say to their numbers.
    fn draw(&self, root: &Area, placed: &[Placed], theme: &Theme) -> Vec<Item> {
        let mut leaders = Vec::new();
        for line in placed {
            let at = self.start(line);
            let end = at + Vector::new(self.size.x, 0.0);
            let says = line.text.as_deref().unwrap_or_default();
            let at_place = |words: Words| Words { text: Text { at, ..words.text } };
            match line.row {
                Row::Heading { page, .. } => {
                    draw(root, &at_place(heading(says, theme)).fitted(self.beside(*page)));
                    if let Some(page) = page.filter(|_| line.is_first) {
                        draw(root, &words(&page.to_string(), end, Anchor::End, theme.note, theme));
                    }
                }
                Row::Note(_) => draw(root, &at_place(note(says, theme)).fitted(self.size.x)),
                Row::Entry(entry) => leaders.extend(self.entry(root, entry, at, theme)),
            }
        }
        let stroke = Some(theme.stroke(theme.hairline, theme.fine));
        vec![Item::Path(Path { lines: leaders, stroke, fill: None })]
    }

    /// Draws an entry, and gives its dots.
    fn entry(&self, root: &Area, entry: &Entry, at: Point, theme: &Theme) -> Vec<Line> {
        let right = at.x + self.size.x;
        let says = entry.words(at, theme).fitted(self.size.x - self.page - self.value - self.curve);
        let from = at.x + says.text.width();
        draw(root, &says);
        let numbers = [
            (entry.page.to_string(), right, theme.ink),
            (entry.value.clone(), right - self.page, theme.ink),
            (entry.curve(), right - self.page - self.value, theme.grey),
        ];
        let mut to = right;
        for (says, x, ink) in numbers.into_iter().filter(|(says, ..)| !says.is_empty()) {
            let says = theme.words(&says, Point::new(x, at.y), Anchor::End, theme.note, ink);
            to = says.text.start().x;
            draw(root, &says);
        }
        dots(from, to, at.y, theme)
    }

    /// The box of a line that leads to a page of its volume.
    fn link(&self, placed: &Placed, volume: &Volume, front: usize) -> Option<Link> {
        let page = match placed.row {
            Row::Heading { page, .. } => (*page)?,
            Row::Entry(entry) => entry.page,
            Row::Note(_) => return None,
        };
        let corner = self.start(placed) - Vector::new(0.0, 0.75 * self.line);
        Some(Link { corner, size: Vector::new(self.size.x, self.line), page: volume.place(page, front)? })
    }
}

/// Dots on a baseline between two words, which stand under one another from line to line.
fn dots(from: f64, to: f64, y: f64, theme: &Theme) -> Vec<Line> {
    let step = 0.9 * theme.note;
    let (first, last) = ((from / step + 0.7).ceil() as i64, (to / step - 0.9).floor() as i64);
    let dot = |k: i64| {
        let x = k as f64 * step;
        Line { points: vec![Point::new(x, y), Point::new(x + theme.fine, y)], closed: false }
    };
    (first..=last).map(dot).collect()
}
