//! Finding charts: the shapes of the curves of a family over its grid.

use super::super::area::{self, Area};
use super::super::caption_form::CaptionForm;
use super::super::element::Drawing;
use super::super::empty_scene::empty_scene;
use super::super::plot::round_number_below;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::super::{Options, heading};
use super::atlas::{Atlas, FindingCell, FindingChart, FindingCurve, ScaleBar};
use super::reference::{Form, in_form, reference};
use crate::scene::{Anchor, Group, Item, LinkKind, LinkTarget, PageLink, Path, Polyline, Scene, Stroke, Text};
use coupler_curves::geometry::{Point, Vector};

/// The title of a chart, before what is the same on the whole page.
const TITLE: &str = "Finding chart";

/// The least side of a drawing of a curve, in ems of a note.
const LEAST_DRAWING: f64 = 3.1;
/// The least width of a cell with a caption, in ems, and the most lines of one.
const LEAST_CAPTION_WIDTH: f64 = 11.0;
const CAPTION_LINES: usize = 3;
/// The heights of a line of a caption, of the scale bar, of the label of a curve, and of the number of a page, in ems.
const CAPTION_HEIGHT: f64 = 1.2;
const BAR_HEIGHT: f64 = 1.0;
const LABEL_HEIGHT: f64 = 0.8;
const NUMBER_HEIGHT: f64 = 1.5;
/// The distance of a drawing from the edges of its place, and of the contents of a cell from its lines, in ems.
const INSET: f64 = 0.25;

/// The most columns and rows of a chart whose cells have so many pages with so many curves, and captions or not.
pub fn max_chart_grid([pages, curves]: [usize; 2], has_captions: bool, options: &Options) -> [usize; 2] {
    let theme = &options.theme.for_paper(options.paper);
    let whole = frame(heading::margins(theme)[0], options, theme).size;
    let em = theme.note_size;
    let most = |length: f64, least: f64| (length / least).floor().max(1.0) as usize;
    let [caption_width, caption_height] =
        if has_captions { [LEAST_CAPTION_WIDTH, CAPTION_LINES as f64 * CAPTION_HEIGHT] } else { [0.0; 2] };
    // Upright pages of curves, so that those of a cell are side by side.
    let across = (1..=curves).take_while(|across| 2 * across * across <= curves).last().unwrap_or(1);
    let down = curves.max(1).div_ceil(across) as f64;
    let width = (pages.clamp(1, 6) * across) as f64 * LEAST_DRAWING + 2.0 * INSET;
    let height = down * (LEAST_DRAWING + LABEL_HEIGHT) + BAR_HEIGHT + NUMBER_HEIGHT + caption_height + 2.0 * INSET;
    [most(whole.x, width.max(caption_width) * em), most(whole.y, height * em)]
}

/// The frame of the cells, and of the words at its edges, from a y.
fn frame(top: f64, options: &Options, theme: &Theme) -> Rect {
    let [_, bottom, left] = heading::margins(theme);
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
    let width = root.size().x - 2.0 * at.x;
    let em = theme.note_size;
    let column_count = chart.cells.iter().map(|cell| cell.place[1] + 1).max().unwrap_or(1).max(chart.columns.len());
    let column = frame(0.0, options, theme).size.x / column_count as f64;
    let lines_in = |form: CaptionForm, cell: &FindingCell| -> Vec<String> {
        let label = form.text(&cell.label, &cell.varying);
        let line = theme.text_line(&label, Point::origin(), Anchor::Middle, em, theme.ink);
        let width = column - 0.6 * em;
        line.wrap_unless_it_fits(width)
    };
    let fits = |form: &CaptionForm| chart.cells.iter().all(|cell| lines_in(*form, cell).len() <= CAPTION_LINES);
    let form = CaptionForm::ALL.into_iter().find(fits).unwrap_or(CaptionForm::Values);
    let varying = chart.cells.first().map_or(&[][..], |cell| &cell.varying);
    let note: Vec<String> = [chart.note.clone()].into_iter().chain(form.meaning(varying)).collect();
    let note = note.join(" · ");
    let note_line = |text: &str| theme.text_line(text, at, Anchor::Start, theme.source_size, theme.grey);
    let lines = note_line(&note).wrap_at_separators(width);
    for (k, line) in lines.iter().enumerate() {
        let below = Vector::new(0.0, heading::SOURCE_LEADING * theme.source_size * k as f64);
        root.record(note_line(line).with_italics(&chart.symbols).fit_width(width).moved_to(at + below));
    }
    let whole = frame(heading::contents_top(&title, lines.len(), options.paper, theme), options, theme);
    let row_count = chart.cells.iter().map(|cell| cell.place[0] + 1).max().unwrap_or(1).max(chart.rows.len());
    let step = Vector::new(column, whole.size.y / row_count as f64);
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
    let caption_lines = |cell: &FindingCell| -> Vec<String> {
        let mut lines = lines_in(form, cell);
        if lines.len() > CAPTION_LINES {
            lines.truncate(CAPTION_LINES);
            lines.iter_mut().skip(CAPTION_LINES - 1).for_each(|last| last.push_str(" …"));
        }
        lines
    };
    // So that drawings are in rows, captions have the same height.
    let caption_height =
        CAPTION_HEIGHT * em * chart.cells.iter().map(|cell| caption_lines(cell).len()).max().unwrap_or(0) as f64;
    // All in one form, that of the longest.
    let fits = |form: &Form| {
        let pages = chart.cells.iter().flat_map(|cell| cell.pages.iter().map(move |(_, page)| (cell, *page)));
        { pages }.all(|(cell, page)| {
            let line =
                theme.text_line(&in_form(*form, page, cell.figure), Point::origin(), Anchor::Middle, em, theme.ink);
            line.text.width() <= (step.x - 2.0 * INSET * em) / cell.pages.len() as f64
        })
    };
    let form = Form::ALL.into_iter().find(fits).unwrap_or(Form::Numbers);
    for cell in &chart.cells {
        let [row, column] = cell.place;
        let corner = whole.corner + Vector::new(step.x * column as f64, step.y * row as f64);
        let frame = Rect { corner, size: step }.inset(INSET * em);
        for (k, line) in caption_lines(cell).iter().enumerate() {
            let down = (1.0 + CAPTION_HEIGHT * k as f64) * em;
            label(line, frame.corner + Vector::new(0.5 * frame.size.x, down), frame.size.x, 0);
        }
        let below = Vector::new(0.0, caption_height);
        let frame = Rect { corner: frame.corner + below, size: frame.size - below };
        for (part, page) in draw_cell(&root, cell, frame, form, theme) {
            if let Some(page_index) = link(page) {
                let (corner, size, kind) = (part.corner, part.size, LinkKind::Entry);
                let (target, title) = (LinkTarget::Page(page_index), reference(page, cell.figure));
                links.push(PageLink { corner, size, target, title, kind });
            }
        }
    }
    drop(root);
    scene.links = links;
    scene
}

/// Draws the curves of a cell, all at one scale, with its bar; the result is the places of its pages, with their numbers.
fn draw_cell(root: &impl Area, cell: &FindingCell, frame: Rect, form: Form, theme: &Theme) -> Vec<(Rect, usize)> {
    let em = theme.note_size;
    let bar_height = if cell.pages.is_empty() { 0.0 } else { BAR_HEIGHT * em };
    let width = frame.size.x / cell.pages.len().max(1) as f64;
    let size = Vector::new(width, frame.size.y - bar_height);
    let part = |k: usize| Rect { corner: frame.corner + Vector::new(width * k as f64, bar_height), size };
    let above_number = Vector::new(size.x, size.y - NUMBER_HEIGHT * em);
    let has_labels = cell.pages.iter().flat_map(|(curves, _)| curves).any(|curve| !curve.label.is_empty());
    let label_height = if has_labels { LABEL_HEIGHT * em } else { 0.0 };
    let count = cell.pages.iter().map(|(curves, _)| curves.len()).max().unwrap_or(1);
    let places = CurvePlaces::new(count, above_number, label_height);
    let inset = 0.5 * INSET * em;
    let drawing = Rect { corner: Point::origin(), size: places.step - Vector::new(0.0, label_height) }.inset(inset);
    let fitting = |curve: &FindingCurve| curve.drawing.fit_scale(drawing);
    let scale = cell.pages.iter().flat_map(|(curves, _)| curves).map(fitting).fold(f64::INFINITY, f64::min);
    if scale.is_finite() {
        draw_bar(root, cell.bar, scale, (frame.corner, frame.size.x), theme);
    }
    draw_dividers(root, (1..cell.pages.len()).map(part), theme);
    let small = &Theme { fine_width: 0.8 * theme.fine_width, ..theme.clone() };
    for (k, (curves, page)) in cell.pages.iter().enumerate() {
        let part = part(k);
        root.grouped(Group::figure("entry", format!("Curves of {}", reference(*page, cell.figure))), || {
            for (k, curve) in curves.iter().enumerate() {
                let corner = places.corner(part.corner, k);
                let at = corner + Vector::new(0.5 * places.step.x, places.step.y - 0.1 * em);
                curve.drawing.draw(
                    root,
                    Rect { corner: corner + Vector::repeat(inset), ..drawing },
                    Some(scale),
                    small,
                );
                let line = theme.text_line(&curve.label, at, Anchor::Middle, theme.small_size(), theme.grey);
                if !curve.label.is_empty() {
                    root.record(line.fit_width(places.step.x));
                }
            }
        });
        let at = part.corner + Vector::new(0.5 * width, size.y - 0.25 * em);
        root.record(
            theme.text_line(&in_form(form, *page, cell.figure), at, Anchor::Middle, em, theme.ink).fit_width(width),
        );
    }
    cell.pages.iter().enumerate().map(|(k, (_, page))| (part(k), *page)).collect()
}

/// Draws lines between the pages of a cell, at the left edges of their places.
fn draw_dividers(root: &impl Area, places: impl Iterator<Item = Rect>, theme: &Theme) {
    let stroke = theme.stroke(theme.hairline, theme.hair_width);
    let line = |place: Rect| {
        Item::Path(Path::stroked(vec![place.corner, place.corner + Vector::new(0.0, place.size.y)], stroke))
    };
    let items: Vec<Item> = places.map(line).collect();
    if !items.is_empty() {
        root.record(Drawing { class: "rule", title: String::new(), items });
    }
}

/// The places of the curves of a page: as many side by side as let their drawings be largest.
struct CurvePlaces {
    across: usize,
    step: Vector,
}

impl CurvePlaces {
    fn new(count: usize, size: Vector, label_height: f64) -> CurvePlaces {
        let places = |across: usize| {
            let step = Vector::new(size.x / across as f64, size.y / count.div_ceil(across) as f64);
            CurvePlaces { across, step }
        };
        let side = |places: &CurvePlaces| places.step.x.min(places.step.y - label_height);
        let all = (1..=count.max(1)).map(places);
        all.reduce(|best, other| if side(&other) > side(&best) { other } else { best }).unwrap_or_else(|| places(1))
    }

    fn corner(&self, of_page: Point, k: usize) -> Point {
        of_page + Vector::new(self.step.x * (k % self.across) as f64, self.step.y * (k / self.across) as f64)
    }
}

/// Draws the scale bar of a cell at the left of its upper edge, with the length that it has.
fn draw_bar(root: &impl Area, bar: ScaleBar, scale: f64, (corner, width): (Point, f64), theme: &Theme) {
    /// Of the width of a cell, the most that a bar of a round length takes.
    const MOST: f64 = 0.3;
    let (length, said) = match bar {
        ScaleBar::Crank(length) => (length, "crank".to_owned()),
        ScaleBar::Round(unit) => {
            let length = round_number_below(MOST * width / scale);
            (length, unit.map_or(length.to_string(), |unit| format!("{length} {}", unit.symbol())))
        }
    };
    let length = length * scale;
    let size = theme.small_size();
    let text = theme.text_line(&said, Point::origin(), Anchor::Start, size, theme.grey);
    // Of a curve that is much smaller than its crank, there is no space for the bar.
    if length + 0.4 * size + text.text.width() > width {
        return;
    }
    let start = corner + Vector::new(0.0, 0.5 * size);
    let [end, tick] = [Vector::new(length, 0.0), Vector::new(0.0, 0.3 * size)];
    let line = |from: Point, to: Point| Polyline { points: vec![from, to], is_closed: false };
    let polylines = [(Vector::zeros(), end), (-tick, tick), (end - tick, end + tick)];
    let polylines = polylines.into_iter().map(|(from, to)| line(start + from, start + to)).collect();
    let stroke = Some(Stroke { color: theme.grey, width: theme.fine_width, has_round_ends: false });
    let position = start + end + Vector::new(0.4 * size, 0.35 * size);
    let items = vec![Item::Path(Path { polylines, stroke, fill: None }), Item::Text(Text { position, ..text.text })];
    root.record(Drawing { class: "scale", title: format!("scale bar: {said}"), items });
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
