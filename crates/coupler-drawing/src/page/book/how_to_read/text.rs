//! The page that explains the numbers of the plate, how a linkage is built, and how a curve is found.

use super::super::super::area::{self, Area};
use super::super::super::element::TextLine;
use super::super::super::heading;
use super::super::super::theme::Theme;
use super::super::super::{Layout, Options};
use super::super::atlas::{Atlas, HowToRead};
use super::super::empty_scene::empty_scene;
use super::parts::{Part, TITLE};
use crate::scene::{Anchor, Scene};
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
                "Every curve has a name, such as {} on the plate on the left: its family, the number of the linkage in the table \
                 cells.csv next to this book, and its point. With it, the program that made this book writes drawings for CAD, \
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

/// The title of the page.
const CONTINUED: &str = "How to read this book, continued";

/// The page with the explanations, in columns.
pub(super) fn compose(
    how: &HowToRead,
    atlas: &Atlas,
    shown: &[(&Part, Point)],
    find: &[String],
    options: &Options,
    theme: &Theme,
) -> Scene {
    let mut scene = empty_scene(format!("{TITLE}: {}", atlas.title), options, theme);
    let root = area::whole_page(&mut scene);
    heading::draw_border(&root, theme);
    let page = root.size();
    let [_, bottom, _] = heading::margins(theme);
    let left = theme.border + theme.margin;
    heading::draw_title(&root, CONTINUED, theme);
    let [top, ..] = heading::margins(theme);
    let paragraphs = paragraphs(how, shown, find);
    let height = page.y - top - bottom;
    // The largest letters with which everything fits.
    let sizes = (0..12)
        .map(|k| (1.25 * theme.source_size - 0.07 * theme.source_size * f64::from(k)).max(0.5 * theme.note_size));
    let mut laid_out = Vec::new();
    for size in sizes {
        let count = ((page.x - 2.0 * left) / (34.0 * size)).floor().max(1.0);
        let gutter = 2.5 * size;
        let width = (page.x - 2.0 * left + gutter) / count - gutter;
        let frame = (Point::new(left, top), Vector::new(width, height), gutter);
        let (lines, columns) = lay_out(&paragraphs, frame, size, theme);
        laid_out = lines;
        if columns as f64 <= count {
            break;
        }
    }
    for line in laid_out.into_iter().filter(|line| line.text.position.x < page.x - left) {
        root.record(line);
    }
    drop(root);
    scene
}

/// The lines of paragraphs in columns, and the number of columns.
fn lay_out(
    paragraphs: &[Paragraph],
    (corner, size, gutter): (Point, Vector, f64),
    em: f64,
    theme: &Theme,
) -> (Vec<TextLine>, usize) {
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
            let at = corner + Vector::new((size.x + gutter) * f64::from(column) + indent, y);
            lines.push(line(words).fit_width(size.x - indent).moved_to(at));
            if let (0, Some(number)) = (k, paragraph.number) {
                let ink = theme.text_ink(theme.curve_ink(0));
                let at = at - Vector::new(indent, 0.0);
                lines.push(theme.text_line(&number.to_string(), at, Anchor::Start, em, ink));
            }
        }
    }
    let columns = usize::try_from(column).unwrap_or(0) + 1;
    (lines, columns)
}
