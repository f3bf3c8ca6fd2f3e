//! Finding charts: the shapes of the curves of a family over its grid.

use super::super::area::{self, Area};
use super::super::element::Drawing;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{Options, heading};
use super::atlas::{Atlas, FindingCell, FindingChart};
use super::empty_scene::empty_scene;
use crate::scene::{Anchor, Group, Item, LinkKind, LinkTarget, PageLink, Path, Scene};
use coupler_curves::geometry::{Point, Vector};

/// The title of a chart, before what is the same on the whole page.
const TITLE: &str = "Finding chart";

/// The least size of a cell with one page, in ems of a note.
const LEAST: [f64; 2] = [3.4, 7.0];
/// The least width of a cell with a caption, in ems, and the most lines of one.
const LEAST_CAPTION_WIDTH: f64 = 11.0;
const CAPTION_LINES: usize = 3;
/// The height of a line of a caption, and that of the number of a page, in ems.
const CAPTION_HEIGHT: f64 = 1.2;
const NUMBER_HEIGHT: f64 = 1.5;

/// The most columns and rows of a chart whose cells have so many pages, and captions or not.
pub fn max_chart_grid(pages: usize, has_captions: bool, options: &Options) -> [usize; 2] {
    let theme = &options.theme.for_paper(options.paper);
    let whole = frame(options, theme).size;
    let em = theme.note_size;
    let most = |length: f64, least: f64| (length / least).floor().max(1.0) as usize;
    let [caption_width, caption_height] =
        if has_captions { [LEAST_CAPTION_WIDTH, CAPTION_LINES as f64 * CAPTION_HEIGHT] } else { [0.0; 2] };
    let width = (pages.clamp(1, 6) as f64 * LEAST[0]).max(caption_width);
    [most(whole.x, width * em), most(whole.y, (LEAST[1] + caption_height) * em)]
}

/// The number of curves of each page for which the cells of a chart with so many columns and rows have space: one or three.
pub fn chart_curves_per_page([columns, rows]: [usize; 2], pages: usize, options: &Options) -> usize {
    /// The least height of three drawings, relative to their width.
    const LEAST_HEIGHT: f64 = 1.8;
    let theme = &options.theme.for_paper(options.paper);
    let whole = frame(options, theme).size;
    let width = whole.x / (columns.max(1) * pages.max(1)) as f64;
    let height = whole.y / rows.max(1) as f64 - (NUMBER_HEIGHT + 0.6) * theme.note_size;
    if height >= LEAST_HEIGHT * width { 3 } else { 1 }
}

/// The frame of the cells.
fn frame(options: &Options, theme: &Theme) -> Rect {
    let [top, bottom, _] = heading::margins(theme);
    let left = theme.border + theme.margin;
    let corner = Point::new(left + 2.4 * theme.note_size, top + 2.2 * theme.note_size);
    let end = Point::new(options.paper.width - left, options.paper.height - bottom);
    Rect { corner, size: (end - corner).sup(&Vector::repeat(8.0 * theme.note_size)) }
}

/// Composes a chart. `link` is the index in the file of a page of the atlas, if it is in the file.
pub(super) fn compose(
    chart: &FindingChart,
    atlas: &Atlas,
    link: impl Fn(usize) -> Option<usize>,
    options: &Options,
) -> Scene {
    let theme = &options.theme.for_paper(options.paper);
    let mut scene = empty_scene(format!("{}: {}", chart.title, atlas.title), options, theme);
    let root = area::whole_page(&mut scene);
    heading::draw_border(&root, theme);
    let title = if chart.title.is_empty() { TITLE.to_owned() } else { format!("{TITLE}: {}", chart.title) };
    let at = heading::draw_title(&root, &title, theme);
    let note = theme.text_line(&chart.note, at, Anchor::Start, theme.source_size, theme.grey);
    root.record(note.with_italics(&chart.symbols).fit_width(root.size().x - 2.0 * at.x));
    let whole = frame(options, theme);
    let column_count = chart.cells.iter().map(|cell| cell.place[1] + 1).max().unwrap_or(1).max(chart.columns.len());
    let row_count = chart.cells.iter().map(|cell| cell.place[0] + 1).max().unwrap_or(1).max(chart.rows.len());
    let step = Vector::new(whole.size.x / column_count as f64, whole.size.y / row_count as f64);
    let em = theme.note_size;
    let label = |text: &str, at: Point, width: f64, turns: u8| {
        let line = theme.text_line(text, at, Anchor::Middle, em, theme.ink).with_italics(&chart.symbols);
        let mut line = line.fit_width(width);
        line.text.quarter_turns = turns;
        root.record(line);
    };
    for (k, text) in chart.columns.iter().enumerate() {
        label(text, whole.corner + Vector::new((k as f64 + 0.5) * step.x, -0.6 * em), step.x, 0);
    }
    for (k, text) in chart.rows.iter().enumerate() {
        label(text, whole.corner + Vector::new(-0.7 * em, (k as f64 + 0.5) * step.y), step.y, 3);
    }
    draw_lines(&root, whole, [column_count, row_count], theme);
    let mut links = Vec::new();
    let small = &Theme { fine_width: 0.8 * theme.fine_width, ..theme.clone() };
    let caption_lines = |cell: &FindingCell| -> Vec<String> {
        let line = theme.text_line(&cell.label, Point::origin(), Anchor::Middle, em, theme.ink);
        let width = step.x - 0.6 * em;
        let lines = if line.text.width() <= 1.1 * width { vec![cell.label.clone()] } else { line.wrap(width) };
        lines.into_iter().filter(|line| !line.is_empty()).take(CAPTION_LINES).collect()
    };
    // So that drawings are in rows, captions have the same height.
    let caption_height =
        CAPTION_HEIGHT * em * chart.cells.iter().map(|cell| caption_lines(cell).len()).max().unwrap_or(0) as f64;
    for cell in &chart.cells {
        let [row, column] = cell.place;
        let corner = whole.corner + Vector::new(step.x * column as f64, step.y * row as f64);
        let frame = Rect { corner, size: step }.inset(0.3 * em);
        for (k, line) in caption_lines(cell).iter().enumerate() {
            let down = (1.0 + CAPTION_HEIGHT * k as f64) * em;
            label(line, frame.corner + Vector::new(0.5 * frame.size.x, down), frame.size.x, 0);
        }
        let below = Vector::new(0.0, caption_height);
        let frame = Rect { corner: frame.corner + below, size: frame.size - below };
        let width = frame.size.x / cell.pages.len().max(1) as f64;
        for (k, (drawings, page)) in cell.pages.iter().enumerate() {
            let part = Rect {
                corner: frame.corner + Vector::new(width * k as f64, 0.0),
                size: Vector::new(width, frame.size.y),
            };
            let height = (part.size.y - NUMBER_HEIGHT * em) / drawings.len().max(1) as f64;
            root.grouped(Group::figure("entry", format!("Curves of page {page}")), || {
                for (k, drawing) in drawings.iter().enumerate() {
                    let corner = part.corner + Vector::new(0.0, height * k as f64);
                    drawing.draw(&root, Rect { corner, size: Vector::new(width, height) }.inset(0.25 * em), small);
                }
            });
            let at = part.corner + Vector::new(0.5 * width, part.size.y - 0.25 * em);
            let size = (0.9 * em).max(crate::scene::MIN_TEXT_SIZE.min(em));
            let number = theme.text_line(&page.to_string(), at, Anchor::Middle, size, theme.grey);
            root.record(number.fit_width(width));
            if let Some(page_index) = link(*page) {
                let (corner, size, kind) = (part.corner, part.size, LinkKind::Entry);
                links.push(PageLink {
                    corner,
                    size,
                    target: LinkTarget::Page(page_index),
                    title: format!("page {page}"),
                    kind,
                });
            }
        }
    }
    drop(root);
    scene.links = links;
    scene
}

/// Draws the lines between the cells.
fn draw_lines(root: &impl Area, whole: Rect, [columns, rows]: [usize; 2], theme: &Theme) {
    let stroke = theme.stroke(theme.hairline, theme.hair_width);
    let at = |x: f64, y: f64| whole.corner + Vector::new(x * whole.size.x, y * whole.size.y);
    let line = |ends: [Point; 2]| Item::Path(Path::stroked(ends.to_vec(), stroke));
    let down = (0..=columns).map(|k| k as f64 / columns as f64).map(|x| line([at(x, 0.0), at(x, 1.0)]));
    let across = (0..=rows).map(|k| k as f64 / rows as f64).map(|y| line([at(0.0, y), at(1.0, y)]));
    let items = down.chain(across).collect();
    root.record(Drawing { class: "rule", title: String::new(), items });
}
