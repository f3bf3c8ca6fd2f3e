//! The pages that explain the numbers of the plate, how a linkage is built, and how a curve is found.

use super::super::super::area::{self, Area};
use super::super::super::element::TextLine;
use super::super::super::empty_scene::empty_scene;
use super::super::super::heading;
use super::super::super::theme::Theme;
use super::super::super::{Layout, Options};
use super::super::atlas::{Atlas, HowToRead};
use super::parts::{Part, TITLE};
use crate::scene::{Anchor, MIN_TEXT_SIZE, Scene};
use coupler_curves::geometry::{Point, Vector};

/// A paragraph: a number, if it has one, a title, and its text.
struct Paragraph {
    number: Option<usize>,
    title: String,
    text: String,
    is_heading: bool,
}

impl Paragraph {
    fn heading(title: &str) -> Paragraph {
        Paragraph { number: None, title: title.to_owned(), text: String::new(), is_heading: true }
    }

    fn plain(text: impl Into<String>) -> Paragraph {
        Paragraph { number: None, title: String::new(), text: text.into(), is_heading: false }
    }
}

/// What is said of the plate, of building a linkage, and of finding a curve.
fn paragraphs(how: &HowToRead, shown: &[(&Part, Point)], find: &[String]) -> Vec<Paragraph> {
    let mut said = vec![Paragraph::heading("What a plate shows")];
    said.extend(shown.iter().zip(1..).map(|((part, _), number)| Paragraph {
        number: Some(number),
        title: part.title.to_owned(),
        text: part.text.replace("{dash}", &how.dash),
        is_heading: false,
    }));
    if !matches!(how.layout, Layout::Chart { .. }) {
        said.push(Paragraph::heading("From a plate to a linkage"));
        let (from, point) = match how.layout {
            Layout::CouplerGrid => (
                "Choose a curve, and read the dimensions at the foot of its page and the coordinates of its point in the table.",
                "Lay off the coordinates as the key shows: along from the joint where the arrow begins, and across from there.",
            ),
            _ => (
                "Choose a curve, and read the dimensions in the caption of its figure.",
                "What is the same for all figures of a page is stated under its title; the drawing shows what the letters mean.",
            ),
        };
        said.push(Paragraph::plain(from));
        said.push(Paragraph::plain(point));
        said.push(Paragraph::plain(
            "All lengths of the linkage, those of straight portions and the radii of arcs are in one unit. Multiply all of them by \
             the same number for the size that is needed; angles, inputs, ratios of times and the shape do not change.",
        ));
        said.push(Paragraph::plain(
            "A dwell: a further link as long as the radius, pivoted on the traced point, stands nearly still with its other end at \
             the centre of the arc while the point is on it.",
        ));
        said.push(Paragraph::plain(
            "μ is the transmission angle. Below about 30° a linkage needs large forces or jams.",
        ));
        if !how.curve_name.is_empty() {
            said.push(Paragraph::plain(format!(
                "Every curve has a name, such as {} on the plate that is explained here: its family, the number of the linkage in the table \
                 cells.csv next to this book, its point and its circuit. With it, the program that made this book writes drawings for CAD, \
                 tables and the linkage itself: coupler-atlas export.",
                how.curve_name
            )));
        }
    }
    if !find.is_empty() {
        said.push(Paragraph::heading("To find a curve"));
        said.extend(find.iter().map(Paragraph::plain));
    }
    said
}

/// The title of the pages.
const CONTINUED: &str = "How to read this book, continued";

/// The explanations in columns: so many on a page, at this distance.
struct Columns {
    /// Each line with its column, at its place on the first page.
    lines: Vec<(usize, TextLine)>,
    per_page: usize,
    step: f64,
}

impl Columns {
    /// With the largest letters with which everything fits a page, or with the smallest that can be read.
    fn new(paragraphs: &[Paragraph], options: &Options, theme: &Theme) -> Columns {
        let [top, bottom, _] = heading::margins(theme);
        let left = theme.border + theme.margin;
        let (page_width, height) = (options.paper.width - 2.0 * left, options.paper.height - top - bottom);
        let least = MIN_TEXT_SIZE.min(theme.note_size);
        let size = |k: u32| ((1.25 - 0.07 * f64::from(k)) * theme.source_size).max(least);
        let with_size = |size: f64| {
            let count = (page_width / (34.0 * size)).floor().max(1.0);
            let gutter = 2.5 * size;
            let step = (page_width + gutter) / count;
            let frame = (Point::new(left, top), Vector::new(step - gutter, height), gutter);
            Columns { lines: lay_out(paragraphs, frame, size, theme), per_page: count as usize, step }
        };
        (0..11).map(|k| with_size(size(k))).find(|columns| columns.page_count() < 2).unwrap_or_else(|| with_size(least))
    }

    fn page_count(&self) -> usize {
        self.lines.last().map_or(0, |(column, _)| column / self.per_page) + 1
    }
}

/// The number of pages with the explanations.
pub(super) fn page_count(
    how: &HowToRead,
    shown: &[(&Part, Point)],
    find: &[String],
    options: &Options,
    theme: &Theme,
) -> usize {
    Columns::new(&paragraphs(how, shown, find), options, theme).page_count()
}

/// The pages with the explanations.
pub(super) fn compose(
    how: &HowToRead,
    atlas: &Atlas,
    shown: &[(&Part, Point)],
    find: &[String],
    options: &Options,
    theme: &Theme,
) -> Vec<Scene> {
    let columns = Columns::new(&paragraphs(how, shown, find), options, theme);
    let page = |page: usize| {
        let mut scene = empty_scene(format!("{TITLE}: {}", atlas.title), options, theme);
        let root = area::whole_page(&mut scene);
        heading::draw_border(&root, theme);
        heading::draw_title(&root, CONTINUED, theme);
        let before = Vector::new(columns.step * (page * columns.per_page) as f64, 0.0);
        for (_, line) in columns.lines.iter().filter(|(column, _)| column / columns.per_page == page) {
            root.record(line.clone().moved_to(line.text.position - before));
        }
        drop(root);
        scene
    };
    (0..columns.page_count()).map(page).collect()
}

/// The lines of paragraphs, each with its column, from 0.
fn lay_out(
    paragraphs: &[Paragraph],
    (corner, size, gutter): (Point, Vector, f64),
    em: f64,
    theme: &Theme,
) -> Vec<(usize, TextLine)> {
    let leading = 1.42 * em;
    let mut lines = Vec::new();
    let (mut column, mut y) = (0, 0.0);
    for paragraph in paragraphs {
        let (text_size, ink) = if paragraph.is_heading { (1.3 * em, theme.ink) } else { (em, theme.ink) };
        let indent = if paragraph.number.is_some() { 2.2 * em } else { 0.0 };
        let line = |text: &str| theme.text_line(text, Point::origin(), Anchor::Start, text_size, ink);
        let text = [paragraph.title.as_str(), &paragraph.text].join(" ");
        let wrapped = line(text.trim()).wrap(size.x - indent);
        let space = if paragraph.is_heading { 1.1 * leading } else { 0.45 * leading };
        // A heading stays with what follows, and paragraphs are not broken.
        let needed = wrapped.len() as f64 * leading + if paragraph.is_heading { 5.0 * leading } else { 0.0 };
        if y > 0.0 && y + space + needed > size.y {
            (column, y) = (column + 1, 0.0);
        }
        y += if y > 0.0 { space } else { 0.0 };
        for (k, words) in wrapped.iter().enumerate() {
            y += leading * text_size / em;
            let at = corner + Vector::new((size.x + gutter) * column as f64 + indent, y);
            lines.push((column, line(words).fit_width(size.x - indent).moved_to(at)));
            if let (0, Some(number)) = (k, paragraph.number) {
                let ink = theme.text_ink(theme.curve_ink(0));
                let at = at - Vector::new(indent, 0.0);
                lines.push((column, theme.text_line(&number.to_string(), at, Anchor::Start, em, ink)));
            }
        }
    }
    lines
}
