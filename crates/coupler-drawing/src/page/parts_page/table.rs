//! The table of parts: what each is called, how many there are, its holes and slots, and how far the holes are apart.

use super::super::area::Area;
use super::super::element::Drawing;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::dimension::length_text;
use super::group::Group;
use crate::scene::{Anchor, Color, Item, MIN_TEXT_SIZE, Path};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::parts::{Actuator, Hole, Outline, Part, Parts, Slot};
use coupler_curves::text::pluralize;

/// The number of columns.
const COLUMNS: usize = 4;

/// The table.
pub(super) struct Table<'t> {
    head: [String; COLUMNS],
    /// The texts of each row, and how many parts it is of.
    rows: Vec<([String; COLUMNS], usize)>,
    /// What is said under the rows.
    notes: Vec<String>,
    theme: &'t Theme,
}

/// Some rows of the table in a size of text: their columns begin at these places, and each has its texts in lines.
struct SetRows {
    size: f64,
    columns: [f64; COLUMNS],
    rows: Vec<[Vec<String>; COLUMNS]>,
    notes: Vec<String>,
}

/// The distance from a line to the next, in ems.
const LEADING: f64 = 1.35;

/// What the rule under the head and the notes are further down, in ems.
const GAP: f64 = 0.3;

impl<'t> Table<'t> {
    /// The table of some parts, those of one shape in a row.
    pub fn new(groups: &[Group], parts: &Parts, theme: &'t Theme) -> Table<'t> {
        let actuator = parts.actuator.iter().map(|actuator| (actuator_row(actuator), 1));
        let [hole, link] = [parts.sizes.hole, parts.sizes.width].map(length_text);
        Table {
            head: ["part", "n", "holes", "centres apart"].map(str::to_owned),
            rows: groups.iter().map(|group| (row(group), group.names.len())).chain(actuator).collect(),
            notes: vec![format!("holes and slots {hole} wide, links {link}")],
            theme,
        }
    }

    /// The table with a further note.
    pub fn with_note(mut self, note: Option<String>) -> Table<'t> {
        self.notes.extend(note);
        self
    }

    /// The number of its rows.
    pub fn row_count(groups: &[Group], parts: &Parts) -> usize {
        groups.len() + usize::from(parts.actuator.is_some())
    }

    /// How many rows fit a rectangle of a size; `None` if not even how many parts are left out.
    pub fn rows_in(&self, size: Vector) -> Option<usize> {
        if self.fitting(size).is_some() {
            return Some(self.rows.len());
        }
        (0..self.rows.len()).rev().find(|count| self.set(*count, size.x, self.smallest()).height() <= size.y)
    }

    /// Draws the table in the greatest size of text in which it fits; where none does, as many rows as fit, and how many parts are left out.
    pub fn draw(&self, root: &impl Area, rect: Rect) {
        let cut = || self.set(self.rows_in(rect.size).unwrap_or_default(), rect.size.x, self.smallest());
        let set = self.fitting(rect.size).unwrap_or_else(cut);
        root.record(Drawing { class: "parts", title: String::new(), items: set.items(rect, self.theme) });
    }

    fn smallest(&self) -> f64 {
        MIN_TEXT_SIZE.min(self.theme.note_size)
    }

    fn fitting(&self, size: Vector) -> Option<SetRows> {
        let sizes = [1.0, 0.9, 0.8, 0.0].map(|part| (part * self.theme.note_size).max(self.smallest()));
        let set = |em: f64| self.set(self.rows.len(), size.x, em);
        sizes.into_iter().map(set).find(|set| set.height() <= size.y)
    }

    /// The first rows in a width.
    fn set(&self, count: usize, width: f64, size: f64) -> SetRows {
        /// The most that the names take, as a part of the width.
        const MAX_NAMES: f64 = 0.34;
        let line = |text: &str| self.theme.text_line(text, Point::origin(), Anchor::Start, size, self.theme.ink);
        let texts = || std::iter::once(&self.head).chain(self.rows[..count].iter().map(|(texts, _)| texts));
        let gap = 0.8 * size;
        let natural = |k: usize| texts().map(|row| line(&row[k]).text.width()).fold(0.0, f64::max) + gap;
        let [names, counts, holes] = [natural(0).min(MAX_NAMES * width), natural(1), natural(2)];
        let columns = [0.0, names, names + counts, names + counts + holes];
        let widths = [names - 0.5 * gap, counts, holes, width - columns[3]];
        let set = |row: &[String; COLUMNS]| std::array::from_fn(|k| line(&row[k]).wrap_at_separators(widths[k]));
        let left_out: usize = self.rows[count..].iter().map(|(_, parts)| parts).sum();
        let left_out = (left_out > 0)
            .then(|| format!("… and {}, for which this page is too small", pluralize(left_out, "more part")));
        let notes = left_out.iter().chain(&self.notes).flat_map(|note| line(note).wrap_at_separators(width)).collect();
        SetRows { size, columns, rows: texts().map(set).collect(), notes }
    }
}

impl SetRows {
    fn height(&self) -> f64 {
        let lines: usize = self.rows.iter().map(line_count).sum::<usize>() + self.notes.len();
        self.size * (LEADING * lines as f64 + 3.0 * GAP)
    }

    fn items(&self, rect: Rect, theme: &Theme) -> Vec<Item> {
        let (size, step) = (self.size, LEADING * self.size);
        let mut items = Vec::new();
        let mut y = step;
        let below = |y: f64| rect.corner + Vector::new(0.0, y);
        let mut write = |words: &str, at: Point, color: Color| {
            items.push(Item::Text(theme.text_line(words, at, Anchor::Start, size, color).text));
        };
        let mut rule = y;
        for (k, row) in self.rows.iter().enumerate() {
            let color = if k == 0 { theme.grey } else { theme.ink };
            for (words, x) in row.iter().zip(self.columns) {
                for (place, words) in words.iter().enumerate() {
                    write(words, below(y + step * place as f64) + Vector::new(x, 0.0), color);
                }
            }
            y += step * line_count(row) as f64;
            if k == 0 {
                rule = y - step + 0.4 * size;
                y += GAP * size;
            }
        }
        y += GAP * size;
        for note in &self.notes {
            write(note, below(y), theme.grey);
            y += step;
        }
        let rule = [below(rule), below(rule) + Vector::new(rect.size.x, 0.0)];
        items.push(Item::Path(Path::stroked(rule.to_vec(), theme.stroke(theme.grey, theme.hair_width))));
        items
    }
}

/// The number of lines of a row.
fn line_count(row: &[Vec<String>; COLUMNS]) -> usize {
    row.iter().map(Vec::len).max().unwrap_or_default()
}

/// The most holes of a part whose distances are in the table.
const MOST_HOLES: usize = 6;

fn row(group: &Group) -> [String; COLUMNS] {
    let Part { holes, slots, outline, pitch_line, notes, .. } = group.part;
    let slot_count = if slots.is_empty() { String::new() } else { format!(" + {}", slots.len()) };
    let is_named = |k: usize| !holes[k].name.is_empty();
    // The distances from the first two determine where all others are; pins that only guide or hold are on a line of the view.
    let pairs = (1..holes.len()).flat_map(|k| (0..if is_named(k) { k.min(2) } else { 1 }).map(move |j| (j, k)));
    let name = |hole: &Hole| if hole.name.is_empty() { "pin".to_owned() } else { hole.name.clone() };
    let pairs = pairs.filter(|(_, k)| *k < MOST_HOLES);
    let others = (holes.len() > MOST_HOLES).then(|| "others as dimensioned".to_owned());
    let distance = |(j, k): (usize, usize)| {
        let (a, b) = (&holes[j], &holes[k]);
        format!("{}–{} {}", name(a), name(b), length_text((b.centre - a.centre).norm()))
    };
    let slot = |slot: &Slot| format!("slot {} {}", slot.name, length_text((slot.ends[1] - slot.ends[0]).norm()));
    let radius = match outline {
        Outline::Circle { radius, .. } if group.part.name.starts_with("gear") => {
            Some(format!("pitch radius {}", length_text(*radius)))
        }
        _ => None,
    };
    let pitch_line = pitch_line.map(|line| {
        let [length, radius] = [(line.ends[1] - line.ends[0]).norm(), line.radius].map(length_text);
        format!("pitch line {length}, pitch radius of its pinion {radius}")
    });
    let slots = slots.iter().map(slot);
    let mut words: Vec<String> =
        pairs.map(distance).chain(others).chain(slots).chain(radius).chain(pitch_line).collect();
    words.extend(notes.iter().cloned());
    // Both guide pins of a block are as far from its joint.
    words.dedup();
    [group.names.join(", "), group.names.len().to_string(), format!("{}{slot_count}", holes.len()), words.join(" · ")]
}

/// The row of an actuator, which has the least and the greatest distance of its pins.
fn actuator_row(actuator: &Actuator) -> [String; COLUMNS] {
    let [a, b] = &actuator.joints;
    let [least, greatest] = actuator.lengths.map(length_text);
    ["actuator".to_owned(), "1".to_owned(), "2".to_owned(), format!("{a}–{b} {least} to {greatest}")]
}
