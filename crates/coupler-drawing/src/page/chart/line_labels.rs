//! The names of a chart's lines, to the right of their ends.

use super::super::element::TextLine;
use super::super::theme::Theme;
use super::line::LineStyle;
use crate::scene::{Anchor, Item};
use coupler_curves::geometry::Point;

/// A name, and where its line ends.
#[derive(Clone, Debug)]
pub(super) struct LineLabel<'a> {
    pub text: &'a str,
    pub style: LineStyle,
    /// The height at which the line ends, in millimetres from the top of the frame.
    pub end_height: f64,
}

/// The length of the piece of line before a name.
fn sample_length(theme: &Theme) -> f64 {
    2.6 * theme.note_size
}

fn label_text(label: &str, at: Point, symbols: &[String], theme: &Theme) -> TextLine {
    theme.text_line(label, at, Anchor::Start, theme.note_size, theme.ink).with_italics(symbols)
}

/// How much room the names of lines take, in millimetres; none where there is nothing to tell apart.
pub(super) fn label_width<'a>(labels: impl Iterator<Item = &'a str>, symbols: &[String], theme: &Theme) -> f64 {
    let width = |label: &str| label_text(label, Point::origin(), symbols, theme).text.width();
    let widest = labels.map(width).fold(0.0, f64::max);
    if widest > 0.0 { 0.8 * theme.note_size + sample_length(theme) + 0.5 * theme.note_size + widest } else { 0.0 }
}

/// The names, each as near as may be to the height of its line's end, and none on another; where there is not room for
/// all of them, every so many, and how many lines go without. `height` is that of the frame, and `left` its right edge.
pub(super) fn label_items(
    keys: Vec<LineLabel>,
    (left, height, room): (f64, f64, f64),
    with_marks: bool,
    symbols: &[String],
    theme: &Theme,
) -> Vec<Item> {
    let apart = 1.35 * theme.note_size;
    let most = ((height / apart).floor() as usize).max(1);
    let count = keys.len();
    let mut kept: Vec<LineLabel> = if count > most {
        keys.into_iter().step_by(count.div_ceil(most.saturating_sub(1).max(1))).collect()
    } else {
        keys
    };
    kept.sort_by(|a, b| a.end_height.total_cmp(&b.end_height));
    let mut items = Vec::new();
    let unnamed = count - kept.len();
    let foot = if unnamed > 0 { height - apart } else { height };
    let heights = spread_heights(&kept.iter().map(|key| key.end_height).collect::<Vec<_>>(), apart, foot);
    let from = left + 0.8 * theme.note_size;
    let text = from + sample_length(theme) + 0.5 * theme.note_size;
    // Half the height of a letter below the middle.
    let drop = 0.35 * theme.note_size;
    for (key, y) in kept.iter().zip(heights) {
        items.extend(
            key.style.line_items(&[vec![Point::new(from, y), Point::new(from + sample_length(theme), y)]], theme),
        );
        if with_marks {
            items.push(key.style.mark_item(Point::new(from + sample_length(theme) / 2.0, y), theme));
        }
        let words = label_text(key.text, Point::new(text, y + drop), symbols, theme);
        items.push(Item::Text(words.fit_width(left + room - text).text));
    }
    if unnamed > 0 {
        let more = format!("and {unnamed} more");
        let words = theme.text_line(&more, Point::new(text, height + drop), Anchor::Start, theme.note_size, theme.grey);
        items.push(Item::Text(words.fit_width(left + room - text).text));
    }
    items
}

/// Ascending heights moved apart, as little as may be, within 0 and `most`.
fn spread_heights(wanted: &[f64], apart: f64, most: f64) -> Vec<f64> {
    // Neighbours that would touch stand together about the middle of what they want (pool adjacent violators).
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for &height in wanted {
        let mut block = (height, 1);
        while let Some(&(middle, count)) = blocks.last() {
            let gap = (block.0 - middle) - apart * (count + block.1) as f64 / 2.0;
            if gap >= 0.0 {
                break;
            }
            let all = (count + block.1) as f64;
            block = ((middle * count as f64 + block.0 * block.1 as f64) / all, count + block.1);
            blocks.pop();
        }
        blocks.push(block);
    }
    let places = blocks
        .iter()
        .flat_map(|&(middle, count)| (0..count).map(move |k| middle + apart * (k as f64 - (count - 1) as f64 / 2.0)));
    let mut heights: Vec<f64> = places.collect();
    let mut least = 0.0;
    for height in &mut heights {
        *height = f64::max(*height, least);
        least = *height + apart;
    }
    let mut greatest = most;
    for height in heights.iter_mut().rev() {
        *height = f64::min(*height, greatest);
        greatest = *height - apart;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_by_their_lines_and_never_on_each_other() {
        assert_eq!(spread_heights(&[5.0, 20.0], 4.0, 50.0), [5.0, 20.0]);
        assert_eq!(spread_heights(&[10.0, 10.0], 4.0, 50.0), [8.0, 12.0]);
        assert_eq!(spread_heights(&[0.0, 0.0, 50.0, 50.0], 4.0, 50.0), [0.0, 4.0, 46.0, 50.0]);
        let crowded = spread_heights(&[25.0; 13], 4.0, 50.0);
        assert!(crowded.windows(2).all(|pair| pair[1] - pair[0] > 4.0 - 1e-9));
        assert!(crowded[0] >= 0.0 && crowded[12] <= 50.0);
        let chained = spread_heights(&[10.0, 13.0, 15.0, 30.0], 4.0, 50.0);
        assert!(chained.windows(2).all(|pair| pair[1] - pair[0] > 4.0 - 1e-9));
        assert_eq!(chained[3], 30.0);
    }
}
