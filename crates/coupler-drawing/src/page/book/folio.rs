//! What is outside the border of the pages of a book: the folio, and the thumb index.

use super::super::Options;
use super::super::area::{self, Area};
use super::super::element::Drawing;
use crate::scene::group_class::{FOLIO, TAB};
use crate::scene::{
    Anchor, Group, Item, LinkKind, LinkTarget, MIN_TEXT_SIZE, PageLink, PageNumber, Path, Polyline, Scene,
};
use coupler_curves::geometry::{Point, Vector};

/// A mark of the thumb index: a part of the book.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tab {
    /// The number of the chapter, if the marks are those of chapters.
    pub number: Option<usize>,
    /// What is in the part, in a few words.
    pub label: String,
    /// The number of its first page in the atlas, from 1.
    pub first_page: usize,
}

impl Tab {
    /// What may be written on the mark, the longest first: the number with the whole words that fit, or else the number alone; without a number,
    /// the words that fit, or of a value with its name the value alone.
    pub(super) fn labels(&self) -> Vec<String> {
        /// Words that do not end a label.
        const OPEN: [&str; 13] =
            ["a", "an", "and", "by", "double-", "for", "from", "in", "of", "on", "the", "to", "with"];
        if let (None, Some((_, value))) = (self.number, self.label.split_once(" = ")) {
            return vec![self.label.clone(), value.to_owned()];
        }
        let number = self.number.map(|number| number.to_string()).unwrap_or_default();
        let words: Vec<&str> = self.label.split(' ').collect();
        let is_closed = |count: &usize| words.get(count.wrapping_sub(1)).is_none_or(|word| !OPEN.contains(word));
        let label = |count: usize| {
            let said = words[..count].join(" ");
            format!("{number} {}", said.trim_end_matches([',', ':', ';'])).trim().to_owned()
        };
        (0..=words.len()).rev().filter(is_closed).map(label).filter(|label| !label.is_empty()).collect()
    }
}

/// The least distance of text from the edge of the paper, in millimetres: it is not cut off where a trimmed edge is a little off.
const SAFE: f64 = 2.0;

/// Draws the number of a page below the border, at its outer corner. The first page of a file is a right-hand page.
pub fn draw_folio(scene: &mut Scene, label: PageNumber, page_index: usize, options: &Options) {
    let theme = options.theme.for_paper(options.paper);
    let text = label.to_string();
    let root = area::whole_page(scene);
    let page = root.size();
    let (x, anchor) = match is_right_hand(page_index) {
        true => (page.x - theme.border, Anchor::End),
        false => (theme.border, Anchor::Start),
    };
    let at = Point::new(x, page.y - (0.5 * theme.border - 0.35 * theme.source_size).max(SAFE));
    root.grouped(Group::of_class(FOLIO), || {
        root.record(theme.text_line(&text, at, anchor, theme.source_size, theme.ink));
    });
}

/// The link of the folio to a page with an index, described in words.
pub(super) fn link(scene: &Scene, page_index: usize, (to, title): (usize, String), options: &Options) -> PageLink {
    let theme = options.theme.for_paper(options.paper);
    // Wide enough for the longest number.
    let size = Vector::new(4.0 * theme.source_size, theme.border);
    let left = if is_right_hand(page_index) { scene.width - theme.border - size.x } else { theme.border };
    let corner = Point::new(left, scene.height - size.y);
    PageLink { corner, size, target: LinkTarget::Page(to), title, kind: LinkKind::Mark }
}

fn is_right_hand(page_index: usize) -> bool {
    page_index.is_multiple_of(2)
}

/// Draws the marks of the thumb index at the outer edge of a page: that of the part of the page with a number of the atlas is
/// filled. `link` is the index
/// in the file of a page of the atlas, if it is in the file; the marks are links.
pub(super) fn draw_tabs(
    scene: &mut Scene,
    tabs: &[Tab],
    page: Option<usize>,
    page_index: usize,
    link: impl Fn(usize) -> Option<usize>,
    options: &Options,
) {
    let theme = &options.theme.for_paper(options.paper);
    let current = page.and_then(|page| tabs.iter().rposition(|tab| tab.first_page <= page));
    if tabs.len() < 2 {
        return;
    }
    /// The height of the tallest letters, in ems.
    const ASCENT: f64 = 0.76;
    let root = area::whole_page(scene);
    let paper = root.size();
    let height = (paper.y - 2.0 * theme.border) / tabs.len() as f64;
    // The border needs a line of its own.
    let width = theme.border - 2.0 * theme.fine_width;
    let size = theme.note_size.min(0.62 * width).max(MIN_TEXT_SIZE);
    let is_right = is_right_hand(page_index);
    let left = if is_right { paper.x - width } else { 0.0 };
    let mut links = Vec::new();
    for (k, tab) in tabs.iter().enumerate() {
        let top = theme.border + height * k as f64;
        let is_current = Some(k) == current;
        if is_current {
            let corner = |x: f64, y: f64| Point::new(left + x * width, top + y * height);
            let points = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
            let polylines = vec![Polyline { points, is_closed: true }];
            let tab = Item::Path(Path { polylines, stroke: None, fill: Some(theme.ink) });
            root.record(Drawing { class: TAB, title: String::new(), items: vec![tab] });
        }
        if let Some(page_index) = link(tab.first_page).filter(|_| !is_current) {
            let (corner, size) = (Point::new(left, top), Vector::new(width, height));
            let (title, target) = (tab.label.clone(), LinkTarget::Page(page_index));
            links.push(PageLink { corner, size, target, title, kind: LinkKind::Mark });
        }
        let ink = if is_current { theme.paper } else { theme.grey };
        // The text reads from the outer edge, downwards on a right-hand page and upwards on the other: the tops of its letters are nearest
        // to the edge.
        let (turns, outwards) = if is_right { (1, 1.0) } else { (3, -1.0) };
        let outer = if is_right { paper.x } else { 0.0 };
        let baseline = (0.5 * width + 0.35 * size).max(SAFE + ASCENT * size);
        let at = Point::new(outer - outwards * baseline, top + 0.5 * height);
        let lines = tab.labels().into_iter().map(|label| theme.text_line(&label, at, Anchor::Middle, size, ink));
        // What does not fit is left out: the mark is there without it.
        let Some(mut line) = lines.into_iter().find(|line| line.text.width() <= 0.94 * height) else { continue };
        line.text.quarter_turns = turns;
        root.grouped(Group::of_class(TAB), || root.record(line));
    }
    drop(root);
    scene.links.extend(links);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_have_the_words_that_fit() {
        let labels =
            |number: Option<usize>, label: &str| Tab { number, label: label.to_owned(), first_page: 1 }.labels();
        assert_eq!(labels(Some(2), "good, with a view"), ["2 good, with a view", "2 good", "2"]);
        assert_eq!(labels(None, "good, with a view"), ["good, with a view", "good"]);
        assert_eq!(labels(None, "A = 2.5"), ["A = 2.5", "2.5"]);
    }
}
