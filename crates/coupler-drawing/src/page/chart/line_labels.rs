//! The labels of the lines of a chart, to the right of their ends.

use super::super::element::TextLine;
use super::super::theme::Theme;
use super::line::LineStyle;
use crate::scene::{Anchor, Item, MIN_TEXT_SIZE};
use coupler_curves::geometry::Point;

/// A label and the end of its line.
#[derive(Clone, Debug)]
pub(super) struct LineLabel<'a> {
    pub text: &'a str,
    pub style: LineStyle,
    /// The height at which the line ends, in millimetres from the top of the frame.
    pub end_height: f64,
}

/// The distance of the baselines of labels, in ems.
const SPACING: f64 = 1.35;

/// The length of the sample of the line before its label.
fn sample_length(theme: &Theme) -> f64 {
    2.6 * theme.note_size
}

fn label_text(label: &str, at: Point, symbols: &[String], theme: &Theme) -> TextLine {
    theme.text_line(label, at, Anchor::Start, theme.note_size, theme.ink).with_italics(symbols)
}

/// The width of the labels of lines with their samples, in millimetres; 0 if all labels are empty.
pub(super) fn label_width<'a>(labels: impl Iterator<Item = &'a str>, symbols: &[String], theme: &Theme) -> f64 {
    let width = |label: &str| label_text(label, Point::origin(), symbols, theme).text.width();
    let widest = labels.map(width).fold(0.0, f64::max);
    if widest > 0.0 { 0.8 * theme.note_size + sample_length(theme) + 0.5 * theme.note_size + widest } else { 0.0 }
}

/// Labels without the names of their values, which are the same in all, and these names; `None` if they are not.
pub(super) fn without_names(labels: &[Option<String>]) -> Option<(String, Vec<Option<String>>)> {
    let equations = |label: &String| -> Vec<(String, String)> {
        let equation = |part: &str| match [" = ", " ≈ "].iter().find_map(|sign| part.split_once(sign)) {
            Some((name, value)) => (name.to_owned(), value.to_owned()),
            None => (String::new(), part.to_owned()),
        };
        label.split(", ").map(equation).collect()
    };
    let names = |label: &String| equations(label).into_iter().map(|(name, _)| name).collect::<Vec<String>>();
    let mut all = labels.iter().flatten().map(names);
    let first = all.next()?;
    let is_named = first.iter().any(|name| !name.is_empty());
    // Of lines that coincide, labels are joined.
    let is_joined = labels.iter().flatten().any(|label| label.contains([';', '…']));
    if !is_named || is_joined || all.any(|names| names != first) {
        return None;
    }
    let values = |label: &String| {
        equations(label).into_iter().map(|(_, value)| value.replace(" / ", "/")).collect::<Vec<_>>().join(", ")
    };
    let names: Vec<String> = first.into_iter().filter(|name| !name.is_empty()).collect();
    Some((names.join(", "), labels.iter().map(|label| label.as_ref().map(values)).collect()))
}

/// Whether so many labels fit a height at their smallest size, a line each.
pub(super) fn have_room(count: usize, height: f64, theme: &Theme) -> bool {
    count as f64 * SPACING * MIN_TEXT_SIZE.min(theme.note_size) <= height
}

/// The items of the labels: each as close as possible to the height of the end of its line, without overlaps, under `head`, which may be empty.
///
/// Labels that are too long are broken. If not all fit, they are set smaller; if they do not fit then, every n-th is drawn, and then the number of the
/// others. `left` is the right edge of the frame, `height` the height of the frame, and `width` the space for the labels, all in millimetres.
pub(super) fn label_items(
    (head, labels): (&str, Vec<LineLabel>),
    left: f64,
    height: f64,
    width: f64,
    with_marks: bool,
    symbols: &[String],
    theme: &Theme,
) -> Vec<Item> {
    let from = |theme: &Theme| left + 0.8 * theme.note_size;
    let text_start = |theme: &Theme| from(theme) + sample_length(theme) + 0.5 * theme.note_size;
    // A label that is too long for the space is broken into lines.
    let lines = |label: &LineLabel, theme: &Theme| {
        /// The space is that of the longest label, to rounding.
        const ROUNDING: f64 = 1e-6;
        let (line, space) = (label_text(label.text, Point::origin(), symbols, theme), left + width - text_start(theme));
        if line.text.width() <= space + ROUNDING { vec![label.text.to_owned()] } else { line.wrap(space) }
    };
    // In lines; broken labels are apart from each other.
    let spacing_of = |theme: &Theme| match labels.iter().map(|label| lines(label, theme).len()).max() {
        Some(most @ 2..) => most as f64 + 0.4,
        _ => 1.0,
    };
    let head_lines: Vec<String> = match head {
        "" => Vec::new(),
        head => label_text(head, Point::origin(), symbols, theme).wrap(left + width - from(theme)),
    };
    let top = if head.is_empty() { 0.0 } else { (head_lines.len() as f64 + 0.4) * SPACING * theme.note_size };
    let mut items = Vec::new();
    for (k, line) in head_lines.iter().enumerate() {
        let at = Point::new(from(theme), (0.8 + SPACING * k as f64) * theme.note_size);
        items.push(Item::Text(label_text(line, at, symbols, theme).fit_width(left + width - at.x).text));
    }
    let height = height - top;
    let least = MIN_TEXT_SIZE.min(theme.note_size);
    let with_size = |part: f64| Theme { note_size: (part * theme.note_size).max(least), ..theme.clone() };
    let count = labels.len();
    let needed = |theme: &Theme| count as f64 * spacing_of(theme) * SPACING * theme.note_size;
    let theme = [1.0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7].map(with_size).into_iter().find(|theme| needed(theme) <= height);
    let theme = &theme.unwrap_or_else(|| with_size(0.0));
    let leading = SPACING * theme.note_size;
    let spacing = leading * spacing_of(theme);
    // Above and below the middle of a label are the other lines of the longest one.
    let half = 0.5 * (spacing_of(theme).floor() - 1.0) * leading;
    let most = ((height / spacing).floor() as usize).max(1);
    let mut drawn: Vec<LineLabel> = if count > most {
        labels.into_iter().step_by(count.div_ceil(most.saturating_sub(1).max(1))).collect()
    } else {
        labels
    };
    drawn.sort_by(|a, b| a.end_height.total_cmp(&b.end_height));
    let omitted = count - drawn.len();
    let foot = if omitted > 0 { height - leading } else { height };
    let ends: Vec<f64> = drawn.iter().map(|label| label.end_height - top - half).collect();
    let heights = spread_heights(&ends, spacing, foot - 2.0 * half).into_iter().map(|height| height + half);
    let (from, text) = (from(theme), text_start(theme));
    // From the middle of a letter down to its baseline.
    let drop = 0.35 * theme.note_size;
    for (label, y) in drawn.iter().zip(heights.map(|height| height + top)) {
        items.extend(
            label.style.line_items(&[vec![Point::new(from, y), Point::new(from + sample_length(theme), y)]], theme),
        );
        if with_marks {
            items.push(label.style.mark_item(Point::new(from + sample_length(theme) / 2.0, y), theme));
        }
        let lines = lines(label, theme);
        for (k, line) in lines.iter().enumerate() {
            let below = (k as f64 - 0.5 * (lines.len() - 1) as f64) * leading;
            let line = label_text(line, Point::new(text, y + drop + below), symbols, theme);
            items.push(Item::Text(line.fit_width(left + width - text).text));
        }
    }
    if omitted > 0 {
        let at = Point::new(text, top + height + drop);
        let more = |words: &str| theme.text_line(words, at, Anchor::Start, theme.note_size, theme.grey);
        let whole = more(&format!("and {omitted} more"));
        let space = left + width - text;
        items.push(Item::Text(if whole.text.width() <= space { whole } else { more(&format!("+ {omitted}")) }.text));
    }
    items
}

/// Ascending heights moved as little as possible so that they are at least `spacing` apart and from 0 to `max_height`.
fn spread_heights(preferred: &[f64], spacing: f64, max_height: f64) -> Vec<f64> {
    // Neighbours that would overlap form a block about the mean of their preferred heights (pool adjacent violators).
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for &height in preferred {
        let mut block = (height, 1);
        while let Some(&(middle, count)) = blocks.last() {
            let gap = (block.0 - middle) - spacing * (count + block.1) as f64 / 2.0;
            if gap >= 0.0 {
                break;
            }
            let all = (count + block.1) as f64;
            block = ((middle * count as f64 + block.0 * block.1 as f64) / all, count + block.1);
            blocks.pop();
        }
        blocks.push(block);
    }
    let spread = blocks
        .iter()
        .flat_map(|&(middle, count)| (0..count).map(move |k| middle + spacing * (k as f64 - (count - 1) as f64 / 2.0)));
    let mut heights: Vec<f64> = spread.collect();
    let mut least = 0.0;
    for height in &mut heights {
        *height = f64::max(*height, least);
        least = *height + spacing;
    }
    let mut greatest = max_height;
    for height in heights.iter_mut().rev() {
        *height = f64::min(*height, greatest);
        greatest = *height - spacing;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_all_labels_have_are_said_once() {
        let labels =
            |texts: &[&str]| -> Vec<Option<String>> { texts.iter().map(|text| Some((*text).to_owned())).collect() };
        let (names, values) =
            without_names(&labels(&["p = 2, k = 1 / 3, circuit 1", "p = 3, k ≈ 1.41, circuit 2"])).unwrap();
        assert_eq!((names.as_str(), values), ("p, k", labels(&["2, 1/3, circuit 1", "3, 1.41, circuit 2"])));
        for other in [&["p = 2", "k = 2"][..], &["p = 2; p = 3", "p = 4"], &["circuit 1", "circuit 2"], &[]] {
            assert_eq!(without_names(&labels(other)), None, "{other:?}");
        }
    }

    #[test]
    fn labels_are_close_to_their_lines_and_do_not_overlap() {
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
