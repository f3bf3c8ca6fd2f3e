//! The legend of the lines of a chart, below it, where their labels have no room beside it.

use super::super::element::TextLine;
use super::super::theme::Theme;
use super::line_labels::{self, LineLabel, SPACING};
use crate::scene::{Anchor, Item};
use coupler_curves::geometry::{Point, Vector};

/// The part of the height of a chart that its legend may take.
const MOST: f64 = 0.4;
/// The distance of columns, in ems.
const GAP: f64 = 1.2;

/// The most labels for which all are tried to be shown; no page has room for more.
pub(super) const MOST_LABELS: usize = 500;

/// The places of the labels in a legend.
#[derive(Clone, Debug)]
pub(super) struct Legend {
    /// The names of the values in the labels, if these are without them, in lines.
    head: Vec<String>,
    columns: usize,
    /// The lines of a column.
    rows: usize,
    /// The number of labels that are shown: the first of every so many lines, if not all.
    step: usize,
    pub shown: usize,
    pub height: f64,
    /// The theme of its texts, which are smaller where that makes room for all labels.
    theme: Theme,
}

impl Legend {
    /// The legend of labels below a chart of a size; empty labels have no place.
    pub fn new(texts: (&str, &[Option<String>]), chart: Vector, symbols: &[String], theme: &Theme) -> Legend {
        let sizes = line_labels::sizes(theme).filter(|_| texts.1.len() <= MOST_LABELS);
        { sizes }
            .map(|theme| Legend::of_size(texts, chart, symbols, theme))
            .find(|legend| legend.step == 1)
            .unwrap_or_else(|| Legend::of_size(texts, chart, symbols, line_labels::smallest(theme)))
    }

    /// The same with the texts of a theme.
    fn of_size((head, labels): (&str, &[Option<String>]), chart: Vector, symbols: &[String], theme: Theme) -> Legend {
        let leading = SPACING * theme.note_size;
        let line = |text: &str| text_line(text, symbols, &theme);
        let head = if head.is_empty() { Vec::new() } else { line(head).wrap(chart.x) };
        let labels: Vec<&str> = labels.iter().flatten().map(String::as_str).filter(|text| !text.is_empty()).collect();
        let gap = GAP * theme.note_size;
        let entry = labels.iter().map(|text| line(text).text.width()).fold(0.0, f64::max) + text_start(&theme);
        let columns = ((chart.x / (entry + gap)).floor() as usize).clamp(1, labels.len().max(1));
        let room = columns * ((MOST * chart.y / leading).floor() as usize).saturating_sub(head.len()).max(1);
        let text_width = text_width(chart.x, columns, &theme);
        let lines: Vec<usize> = labels.iter().map(|text| line(text).wrap_unless_it_fits(text_width).len()).collect();
        // Of more labels than have room, the last place has their number.
        let needed = |step: usize| lines.iter().step_by(step).sum::<usize>() + usize::from(step > 1);
        let step = (1..lines.len().max(2)).find(|step| needed(*step) <= room).unwrap_or(lines.len().max(1));
        let (shown, rows) = (labels.len().div_ceil(step), needed(step).div_ceil(columns));
        let height = leading * (head.len() + rows) as f64 + 0.5 * leading;
        Legend { head, columns, rows, step, shown, height, theme }
    }

    /// The items of the labels, from the upper left corner of the legend.
    pub fn items(
        &self,
        labels: &[LineLabel],
        (corner, width): (Point, f64),
        with_marks: bool,
        symbols: &[String],
    ) -> Vec<Item> {
        let theme = &self.theme;
        let leading = SPACING * theme.note_size;
        let mut items = Vec::new();
        let baseline = |row: usize| corner.y + leading * (row as f64 + 1.0);
        for (row, words) in self.head.iter().enumerate() {
            let line = text_line(words, symbols, theme).moved_to(Point::new(corner.x, baseline(row)));
            items.push(Item::Text(line.fit_width(width).text));
        }
        // The columns are read downwards.
        let place = |line: usize| {
            let left = corner.x + width / self.columns as f64 * (line / self.rows) as f64;
            Point::new(left, baseline(self.head.len() + line % self.rows))
        };
        // From a baseline up to the middle of its letters.
        let up = 0.35 * theme.note_size;
        let text_width = text_width(width, self.columns, theme);
        let shown: Vec<&LineLabel> = labels.iter().step_by(self.step).collect();
        let mut next = 0;
        for label in &shown {
            let at = place(next);
            items.extend(label.sample_items(Point::new(at.x, at.y - up), with_marks, theme));
            for words in text_line(label.text, symbols, theme).wrap_unless_it_fits(text_width) {
                let line = text_line(&words, symbols, theme).fit_width(text_width);
                items.push(Item::Text(line.moved_to(place(next) + Vector::new(text_start(theme), 0.0)).text));
                next += 1;
            }
        }
        let omitted = labels.len() - shown.len();
        if omitted > 0 {
            let more = format!("and {omitted} more");
            let more = theme.text_line(&more, place(next), Anchor::Start, theme.note_size, theme.grey);
            items.push(Item::Text(more.fit_width(text_width).text));
        }
        items
    }
}

fn text_line(text: &str, symbols: &[String], theme: &Theme) -> TextLine {
    theme.text_line(text, Point::origin(), Anchor::Start, theme.note_size, theme.ink).with_italics(symbols)
}

/// The distance of a text from the left end of the sample of its line.
fn text_start(theme: &Theme) -> f64 {
    line_labels::sample_length(theme) + 0.5 * theme.note_size
}

/// The width of the text of a label in one of so many columns.
fn text_width(chart: f64, columns: usize, theme: &Theme) -> f64 {
    chart / columns as f64 - GAP * theme.note_size - text_start(theme)
}
