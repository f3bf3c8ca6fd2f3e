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
pub(super) const SPACING: f64 = 1.35;

/// The length of the sample of the line before its label.
pub(super) fn sample_length(theme: &Theme) -> f64 {
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
    /// Between the labels of lines that coincide.
    const SEPARATORS: [&str; 2] = ["; ", " … "];
    let equation = |part: &str| match [" = ", " ≈ "].iter().find_map(|sign| part.split_once(sign)) {
        Some((name, value)) => (name.to_owned(), value.replace(" / ", "/")),
        None => (String::new(), part.to_owned()),
    };
    let mut names: Option<Vec<String>> = None;
    let mut without = |label: &str| -> Option<String> {
        let equations: Vec<(String, String)> = label.split(", ").map(equation).collect();
        let own: Vec<String> = equations.iter().map(|(name, _)| name.clone()).filter(|name| !name.is_empty()).collect();
        let is_same = *names.get_or_insert_with(|| own.clone()) == own && !own.is_empty();
        is_same.then(|| equations.into_iter().map(|(_, value)| value).collect::<Vec<_>>().join(", "))
    };
    let mut of_joined = |label: &String| -> Option<String> {
        let Some(separator) = SEPARATORS.into_iter().find(|separator| label.contains(separator)) else {
            return without(label);
        };
        Some(label.split(separator).map(&mut without).collect::<Option<Vec<_>>>()?.join(separator))
    };
    let values = labels.iter().map(|label| label.as_ref().map(&mut of_joined));
    let values = values.map(|value| value.map_or(Some(None), |value| value.map(Some))).collect::<Option<Vec<_>>>()?;
    Some((names?.join(", "), values))
}

/// Whether so many labels fit a height at their smallest size, a line each.
pub(super) fn have_room(count: usize, height: f64, theme: &Theme) -> bool {
    count as f64 * SPACING * MIN_TEXT_SIZE.min(theme.note_size) <= height
}

/// The space for labels next to a frame: its left edge is the right one of the frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    pub left: f64,
    pub height: f64,
    pub width: f64,
}

/// The theme with texts that are smaller and smaller.
pub(super) fn sizes(theme: &Theme) -> impl Iterator<Item = Theme> {
    const PARTS: [f64; 7] = [1.0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7];
    let least = MIN_TEXT_SIZE.min(theme.note_size);
    PARTS.into_iter().map(move |part| Theme { note_size: (part * theme.note_size).max(least), ..theme.clone() })
}

/// The theme with texts of the least size.
pub(super) fn smallest(theme: &Theme) -> Theme {
    Theme { note_size: MIN_TEXT_SIZE.min(theme.note_size), ..theme.clone() }
}

/// How labels are set in their space.
struct Setting {
    head: Vec<String>,
    theme: Theme,
    /// Each so many-th label is drawn.
    step: usize,
    /// Whether no label is wider than its space.
    are_whole: bool,
}

impl Setting {
    /// If not all fit, they are set smaller; if they do not fit then, every n-th is drawn, and then the number of the others.
    fn new((head, labels): (&str, &[&str]), space: Space, symbols: &[String], theme: &Theme) -> Setting {
        /// The space is that of the longest label, to rounding.
        const ROUNDING: f64 = 1e-6;
        let head = match head {
            "" => Vec::new(),
            head => label_text(head, Point::origin(), symbols, theme).wrap(space.right() - from(space, theme)),
        };
        let height = space.height - head_height(&head, theme);
        let widths = |theme: &Theme| {
            let widths = labels.iter().map(|label| label_text(label, Point::origin(), symbols, theme).text.width());
            widths.fold(0.0, f64::max)
        };
        let are_whole = |theme: &Theme| widths(theme) <= space.right() - text_start(space, theme) + ROUNDING;
        let fits = |theme: &Theme| labels.len() as f64 * SPACING * theme.note_size <= height && are_whole(theme);
        let theme = sizes(theme).find(fits).unwrap_or_else(|| smallest(theme));
        let most = ((height / (SPACING * theme.note_size)).floor() as usize).max(1);
        let step = if labels.len() > most { labels.len().div_ceil(most.saturating_sub(1).max(1)) } else { 1 };
        Setting { head, step, are_whole: are_whole(&theme), theme }
    }
}

impl Space {
    fn right(self) -> f64 {
        self.left + self.width
    }
}

/// The x at which the samples of lines begin, and their labels.
fn from(space: Space, theme: &Theme) -> f64 {
    space.left + 0.8 * theme.note_size
}

fn text_start(space: Space, theme: &Theme) -> f64 {
    from(space, theme) + sample_length(theme) + 0.5 * theme.note_size
}

/// The height of the names of values above the labels.
fn head_height(head: &[String], theme: &Theme) -> f64 {
    if head.is_empty() { 0.0 } else { (head.len() as f64 + 0.4) * SPACING * theme.note_size }
}

/// The number of labels that are whole next to a frame; none if not all that are drawn are, or a word of the names above them is divided.
pub(super) fn legible_count(texts: (&str, &[&str]), space: Space, symbols: &[String], theme: &Theme) -> usize {
    let setting = Setting::new(texts, space, symbols, theme);
    let (head, labels) = texts;
    if setting.are_whole && setting.head.join(" ") == head { labels.len().div_ceil(setting.step) } else { 0 }
}

impl LineLabel<'_> {
    /// The sample of its line from a point to the right.
    pub fn sample_items(&self, at: Point, with_marks: bool, theme: &Theme) -> Vec<Item> {
        let length = sample_length(theme);
        let mut items = self.style.line_items(&[vec![at, Point::new(at.x + length, at.y)]], theme);
        items.extend(with_marks.then(|| self.style.mark_item(Point::new(at.x + 0.5 * length, at.y), theme)));
        items
    }
}

/// The items of the labels: each as close as possible to the height of the end of its line, without overlaps, under `head`, which may be empty.
pub(super) fn label_items(
    (head, labels): (&str, Vec<LineLabel>),
    space: Space,
    with_marks: bool,
    symbols: &[String],
    theme: &Theme,
) -> Vec<Item> {
    let texts: Vec<&str> = labels.iter().map(|label| label.text).collect();
    let setting = Setting::new((head, &texts), space, symbols, theme);
    let right = space.right();
    let mut items = Vec::new();
    for (k, line) in setting.head.iter().enumerate() {
        let at = Point::new(from(space, theme), (0.8 + SPACING * k as f64) * theme.note_size);
        items.push(Item::Text(label_text(line, at, symbols, theme).fit_width(right - at.x).text));
    }
    let top = head_height(&setting.head, theme);
    let height = space.height - top;
    let theme = &setting.theme;
    let leading = SPACING * theme.note_size;
    let count = labels.len();
    let mut drawn: Vec<LineLabel> = labels.into_iter().step_by(setting.step).collect();
    drawn.sort_by(|a, b| a.end_height.total_cmp(&b.end_height));
    let omitted = count - drawn.len();
    let foot = if omitted > 0 { height - leading } else { height };
    let ends: Vec<f64> = drawn.iter().map(|label| label.end_height - top).collect();
    let heights = spread_heights(&ends, leading, foot);
    let text = text_start(space, theme);
    // From the middle of a letter down to its baseline.
    let drop = 0.35 * theme.note_size;
    for (label, y) in drawn.iter().zip(heights.into_iter().map(|height| height + top)) {
        items.extend(label.sample_items(Point::new(from(space, theme), y), with_marks, theme));
        let line = label_text(label.text, Point::new(text, y + drop), symbols, theme);
        items.push(Item::Text(line.fit_width(right - text).text));
    }
    if omitted > 0 {
        let at = Point::new(text, top + height + drop);
        let more = |words: &str| theme.text_line(words, at, Anchor::Start, theme.note_size, theme.grey);
        let whole = more(&format!("and {omitted} more"));
        let is_short = whole.text.width() > right - text;
        items.push(Item::Text(if is_short { more(&format!("+ {omitted}")) } else { whole }.text));
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
        let joined = labels(&["p = 2, circuit 1 … p = 3, circuit 2 (4 lines)", "p = 4; p = 5", "p = 6"]);
        let values = labels(&["2, circuit 1 … 3, circuit 2 (4 lines)", "4; 5", "6"]);
        assert_eq!(without_names(&joined), Some(("p".to_owned(), values)));
        for other in [&["p = 2", "k = 2"][..], &["p = 2; k = 3", "p = 4"], &["circuit 1", "circuit 2"], &[]] {
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
