//! The table of parts: what each is called, how many there are, its holes and slots, and how far the holes are apart.

use super::super::area::Area;
use super::super::element::Drawing;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::dimension::length_text;
use super::group::Group;
use crate::scene::{Anchor, Color, Item, MIN_TEXT_SIZE, Path};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::parts::{Outline, Part, Parts};

/// The texts of a row.
type Row = [String; 4];

/// Where the columns begin, as parts of the width.
const COLUMNS: [f64; 4] = [0.0, 0.24, 0.32, 0.42];

/// Draws the table, in a size at which it fits, and as many of its lines as fit at the smallest.
pub(super) fn draw(root: &impl Area, rect: Rect, groups: &[Group], parts: &Parts, theme: &Theme) {
    let head = ["part", "n", "holes", "centres apart"].map(str::to_owned);
    let rows: Vec<Row> = std::iter::once(head).chain(groups.iter().map(row)).collect();
    let smallest = MIN_TEXT_SIZE.min(theme.note_size);
    let sizes = [1.0, 0.9, 0.8, 0.0].map(|part| (part * theme.note_size).max(smallest));
    let fits = |size: &f64| {
        lines(&rows, rect.size.x, *size, theme).len() as f64 * LEADING * size <= rect.size.y - 2.0 * LEADING * size
    };
    let size = sizes.into_iter().find(fits).unwrap_or(smallest);
    let text = |text: &str, at: Point, color: Color| theme.text_line(text, at, Anchor::Start, size, color);
    let width = rect.size.x;
    let mut items = Vec::new();
    let mut y = LEADING * size;
    let below = |y: f64| rect.corner + Vector::new(0.0, y);
    for (k, line) in lines(&rows, width, size, theme).into_iter().enumerate() {
        if y + LEADING * size > rect.size.y {
            break;
        }
        let color = if k == 0 { theme.grey } else { theme.ink };
        for (column, words) in line.iter().enumerate() {
            let next = COLUMNS.get(column + 1).map_or(width, |next| next * width - 0.5 * size);
            let line = text(words, below(y) + Vector::new(COLUMNS[column] * width, 0.0), color);
            items.push(Item::Text(line.fit_width(next - COLUMNS[column] * width).text));
        }
        if k == 0 {
            let rule = [below(y + 0.4 * size), below(y + 0.4 * size) + Vector::new(width, 0.0)];
            items.push(Item::Path(Path::stroked(rule.to_vec(), theme.stroke(theme.grey, theme.hair_width))));
            y += 0.3 * size;
        }
        y += LEADING * size;
    }
    let [hole, link] = [parts.sizes.hole, parts.sizes.width].map(length_text);
    let note = format!("holes and slots {hole} wide, links {link}");
    items.push(Item::Text(text(&note, below((y + 0.3 * size).min(rect.size.y)), theme.grey).fit_width(width).text));
    root.record(Drawing { class: "parts", title: String::new(), items });
}

/// The distance from a line to the next, in ems.
const LEADING: f64 = 1.35;

/// The lines of the rows: the distances of a part may take several.
fn lines(rows: &[Row], width: f64, size: f64, theme: &Theme) -> Vec<Row> {
    let last = (1.0 - COLUMNS[3]) * width;
    let wrap =
        |text: &str| theme.text_line(text, Point::origin(), Anchor::Start, size, theme.ink).wrap_at_separators(last);
    let mut out = Vec::new();
    for [name, count, holes, distances] in rows {
        let mut wrapped = wrap(distances).into_iter();
        out.push([name.clone(), count.clone(), holes.clone(), wrapped.next().unwrap_or_default()]);
        out.extend(wrapped.map(|rest| [String::new(), String::new(), String::new(), rest]));
    }
    out
}

fn row(group: &Group) -> Row {
    let Part { holes, slots, outline, .. } = group.part;
    let slot_count = if slots.is_empty() { String::new() } else { format!(" + {}", slots.len()) };
    let named: Vec<_> = holes.iter().filter(|hole| !hole.name.is_empty()).collect();
    // The distances from the first two determine where all others are.
    let pairs = (1..named.len()).flat_map(|k| (0..k.min(2)).map(move |j| (j, k)));
    let distance = |(j, k): (usize, usize)| {
        let (a, b) = (named[j], named[k]);
        format!("{}–{} {}", a.name, b.name, length_text((b.centre - a.centre).norm()))
    };
    let slot = |slot: &coupler_curves::parts::Slot| {
        format!("slot {} {}", slot.name, length_text((slot.ends[1] - slot.ends[0]).norm()))
    };
    let radius = match outline {
        Outline::Circle { radius, .. } if group.part.name.starts_with("gear") => {
            Some(format!("pitch radius {}", length_text(*radius)))
        }
        _ => None,
    };
    let words: Vec<String> = pairs.map(distance).chain(slots.iter().map(slot)).chain(radius).collect();
    [group.names.join(", "), group.names.len().to_string(), format!("{}{slot_count}", holes.len()), words.join(" · ")]
}
