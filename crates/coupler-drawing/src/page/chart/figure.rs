//! A chart: its axes, its lines and their names.

use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::style::{Color as _, IntoFont, RGBColor, ShapeStyle, TextStyle};

use super::super::ChartPage;
use super::super::element::{Area, Drawing, GroupElement, draw, size};
use super::super::theme::Theme;
use super::line::{ClippedLine, LineStyle};
use super::line_labels::{self, LineLabel};
use super::scale::{RangeEnds, Scale, ScaleOptions, is_drawable};
use crate::chart::{PointSource, Quantity, Series};
use crate::scene::{Anchor, Canvas, Color, Group, Item};
use coupler_curves::geometry::{Point, Vector};

/// A chart that is to be drawn.
pub(super) struct ChartFigure<'a> {
    page: &'a ChartPage<'a>,
    /// Which of the quantities it shows.
    quantity_index: usize,
    /// The scales of x and y; none where there is nothing to draw.
    scales: Option<[Scale; 2]>,
    /// The room for the numbers on the left, and for the names of the lines on the right, in millimetres.
    left_margin: f64,
    right_margin: f64,
}

impl<'a> ChartFigure<'a> {
    /// The chart of the quantity at a place, to be drawn in an area of that size.
    pub fn new(sheet: &'a ChartPage<'a>, place: usize, area: Vector, theme: &Theme) -> ChartFigure<'a> {
        let chart = sheet.chart;
        let labels = || sheet.series.iter().map(|series| series.label.as_str());
        let right = line_labels::label_width(labels(), sheet.heading.symbols, theme).min(0.3 * area.x);
        let room = |mm: f64, least: f64, most: usize| ((mm / least) as usize).clamp(2, most);
        let wish = |quantity: &Quantity, ends, ticks| ScaleOptions {
            is_log: quantity.is_log,
            is_in_degrees: quantity.unit == "deg",
            range: quantity.range,
            ends,
            target_ticks: ticks,
        };
        // Marks are not to stand on the axis; lines may begin there.
        let ends = RangeEnds::Padded(if chart.point_source == PointSource::Curves { 0.025 } else { 0.0 });
        let wishes = [
            wish(&chart.x, ends, room(area.x - right, 7.0 * theme.note_size, 12)),
            wish(&chart.y[place], RangeEnds::Round, room(area.y - 7.0 * theme.caption_size, 4.5 * theme.note_size, 8)),
        ];
        // What has no place on one axis does not count on the other; to the right, what any chart of the page has.
        let drawn = |place: usize| {
            let is_log = [chart.x.is_log, chart.y[place].is_log];
            let is_drawn = move |&(x, y): &(f64, f64)| is_drawable(x, is_log[0]) && is_drawable(y, is_log[1]);
            sheet.series.iter().flat_map(move |series| series_points(series, place)).filter(is_drawn)
        };
        let x = Scale::from_values(sheet.quantity_range.clone().flat_map(drawn).map(|(x, _)| x), &wishes[0]);
        let y = Scale::from_values(drawn(place).map(|(_, y)| y), &wishes[1]);
        let scales = x.zip(y).map(|(x, y)| [x, y]);
        let labels = scales.iter().flat_map(|[_, y]| y.ticks.iter().map(|tick| y.tick_label(*tick)));
        let left = labels.map(|label| theme.typeface.regular().width(&label, theme.note_size)).fold(0.0, f64::max);
        let left = left + 2.0 * tick_length(theme) + 0.2 * theme.note_size;
        ChartFigure { page: sheet, quantity_index: place, scales, left_margin: left, right_margin: right }
    }

    /// The room its numbers need on the left, in millimetres.
    pub fn left_margin(&self) -> f64 {
        self.left_margin
    }

    fn quantity(&self) -> &'a Quantity {
        &self.page.chart.y[self.quantity_index]
    }

    /// Draws it with that much room for the numbers on the left; what is to be known to read its places.
    pub fn draw(&self, area: &Area, left: f64, theme: &Theme) -> Vec<(&'static str, String)> {
        let gap = 1.2 * theme.caption_size;
        let head = 2.6 * theme.caption_size;
        let foot = 2.0 * tick_length(theme) + 1.5 * theme.note_size + 3.0 * theme.caption_size;
        self.draw_title(area, theme);
        let Some([x, y]) = &self.scales else {
            self.draw_empty_message(area, theme);
            return Vec::new();
        };
        let mut builder = ChartBuilder::on(area);
        builder.margin_top(Canvas::to_pixels(head)).margin_right(Canvas::to_pixels(gap + self.right_margin));
        builder.y_label_area_size(Canvas::to_pixels(left)).x_label_area_size(Canvas::to_pixels(foot));
        // A canvas cannot fail.
        let mut context = builder.build_cartesian_2d(x.clone(), y.clone()).expect("recording a scene does not fail");
        let style = |color: Color, width: f64| ShapeStyle {
            color: to_rgb(color).to_rgba(),
            filled: false,
            stroke_width: Canvas::to_pixels(width) as u32,
        };
        let grey = to_rgb(theme.grey);
        let label =
            TextStyle::from(("serif", theme.note_size * f64::from(Canvas::to_pixels(1.0))).into_font()).color(&grey);
        let mut mesh = context.configure_mesh();
        mesh.bold_line_style(style(theme.hairline, theme.hair_width))
            .light_line_style(style(theme.faded(theme.hairline), 0.6 * theme.hair_width));
        mesh.axis_style(style(theme.grey, 0.7 * theme.fine_width)).label_style(label);
        mesh.set_all_tick_mark_size(Canvas::to_pixels(tick_length(theme)))
            .draw()
            .expect("recording a scene does not fail");
        let frame = context.plotting_area().strip_coord_spec();
        self.draw_x_title(area, &frame, foot, theme);
        self.draw_lines(&frame, theme);
        axis_data(&frame, [x, y])
    }

    /// What goes up, over the frame: the quantity, its unit, and, where there is room, what it is.
    fn draw_title(&self, area: &Area, theme: &Theme) {
        let width = size(area).x;
        let y = 1.2 * theme.caption_size;
        let name = quantity_title(self.quantity());
        let words = theme.text_line(&name, Point::new(0.0, y), Anchor::Start, theme.caption_size, theme.ink);
        let words = words.with_italics(self.page.heading.symbols).fit_width(width);
        let after = words.text.width() + 1.2 * theme.caption_size;
        draw(area, &words);
        let definition =
            |text: &str| theme.text_line(text, Point::new(after, y), Anchor::Start, theme.note_size, theme.grey);
        let whole = self.quantity().definition;
        // A definition may go on to say how it is found; that is left out first.
        let parts = [": ", ", "].into_iter().filter_map(|end| whole.split_once(end)).map(|(part, _)| part);
        let fitting = std::iter::once(whole).chain(parts).find(|text| definition(text).text.width() <= width - after);
        if let Some(text) = fitting.filter(|text| !text.is_empty()) {
            draw(area, &definition(text));
        }
    }

    /// Under the frame what goes to the right, and what has no place in it.
    fn draw_x_title(&self, area: &Area, frame: &Area, foot: f64, theme: &Theme) {
        let (all, inner) = (size(area), size(frame));
        let left = f64::from(frame.get_base_pixel().0 - area.get_base_pixel().0) / f64::from(Canvas::to_pixels(1.0));
        let y = all.y - foot + 2.0 * tick_length(theme) + 1.5 * theme.note_size + 1.1 * theme.caption_size;
        let name = quantity_title(&self.page.chart.x);
        let words =
            theme.text_line(&name, Point::new(left + inner.x / 2.0, y), Anchor::Middle, theme.caption_size, theme.ink);
        let words = words.with_italics(self.page.heading.symbols).fit_width(0.9 * inner.x);
        let beside = (inner.x - words.text.width()) / 2.0 - theme.caption_size;
        draw(area, &words);
        let below: usize = self.clipped_lines(frame).iter().map(|trace| trace.nonpositive_count).sum();
        if below > 0 {
            let note = match below {
                1 => "1 value of 0 or less is left out".to_owned(),
                n => format!("{n} values of 0 or less are left out"),
            };
            let words = theme.text_line(&note, Point::new(left + inner.x, y), Anchor::End, theme.note_size, theme.grey);
            draw(area, &words.fit_width(beside));
        }
    }

    /// That there is nothing to draw, and why.
    fn draw_empty_message(&self, area: &Area, theme: &Theme) {
        let is_log = self.quantity().is_log || self.page.chart.x.is_log;
        let text = if is_log { "no value that a logarithmic axis has a place for" } else { "no finite value" };
        let at = Point::from(size(area) / 2.0);
        let words = theme.text_line(text, at, Anchor::Middle, theme.caption_size, theme.grey).fit_width(size(area).x);
        draw(area, &Drawing { class: "nothing", title: String::new(), items: vec![Item::Text(words.text)] });
    }

    fn clipped_lines(&self, frame: &Area) -> Vec<ClippedLine> {
        let Some([x, y]) = &self.scales else { return Vec::new() };
        let size = frame_size(frame);
        self.page
            .series
            .iter()
            .map(|series| ClippedLine::from_points(series_points(series, self.quantity_index), (x, y), size))
            .collect()
    }

    /// The lines, each a group of its own, and their names beside the frame.
    fn draw_lines(&self, frame: &Area, theme: &Theme) {
        let traces = self.clipped_lines(frame);
        let span = frame_size(frame);
        // Marks are for points that stand apart, on one chart of a page as on another.
        let most = self.page.series.iter().map(|series| series.x.len()).max().unwrap_or(0);
        let with_marks =
            self.page.chart.point_source == PointSource::Curves && most as f64 * 4.0 * theme.joint_radius < span.x;
        let mut keys = Vec::new();
        for (k, (trace, series)) in traces.iter().zip(self.page.series).enumerate() {
            let manner = LineStyle::for_index(k, theme);
            let mut items = manner.line_items(&trace.runs, theme);
            let marked = if with_marks { &trace.points } else { &trace.isolated_points };
            items.extend(marked.iter().map(|at| manner.mark_item(*at, theme)));
            draw(frame, &GroupElement { group: self.series_group(k, series, items) });
            if let Some(end) = trace.end_point().filter(|_| !series.label.is_empty()) {
                keys.push(LineLabel { text: &series.label, style: manner, end_height: end.y });
            }
        }
        let items = line_labels::label_items(
            keys,
            (span.x, span.y, self.right_margin),
            with_marks,
            self.page.heading.symbols,
            theme,
        );
        if !items.is_empty() {
            draw(frame, &Drawing { class: "keys", title: String::new(), items });
        }
    }

    fn series_group(&self, k: usize, series: &Series, items: Vec<Item>) -> Group {
        let (x, y) = (&self.page.chart.x.text, &self.quantity().text);
        let of = if series.label.is_empty() { String::new() } else { format!(", {}", series.label) };
        let mut data: Vec<(&'static str, String)> =
            series.cell.map(|cell| ("cell", cell.to_string())).into_iter().collect();
        data.extend([("trace", series.trace.to_string()), ("circuit", series.circuit.to_string())]);
        Group {
            id: format!("{}-chart-{}-{}", self.page.heading.family_id, self.quantity_index + 1, k + 1),
            class: "series",
            title: format!("{}: {y} over {x}{of}", self.page.heading.family_title),
            data,
            items,
        }
    }
}

fn series_points(series: &Series, place: usize) -> impl Iterator<Item = (f64, f64)> {
    series.x.iter().copied().zip(series.y[place].iter().copied())
}

/// A quantity and its unit.
fn quantity_title(quantity: &Quantity) -> String {
    if quantity.unit == "deg" { format!("{}, °", quantity.text) } else { quantity.text.clone() }
}

/// The length of a tick.
fn tick_length(theme: &Theme) -> f64 {
    0.4 * theme.note_size
}

fn to_rgb(Color(r, g, b): Color) -> RGBColor {
    RGBColor(r, g, b)
}

/// Width and height of the frame from its first place to its last, which plotters has within it.
fn frame_size(frame: &DrawingArea<Canvas, Shift>) -> Vector {
    let pixel = 1.0 / f64::from(Canvas::to_pixels(1.0));
    size(frame) - Vector::new(pixel, pixel)
}

/// What is needed to read a chart's places: where its frame is on the page, and what its edges stand for.
fn axis_data(frame: &Area, [x, y]: [&Scale; 2]) -> Vec<(&'static str, String)> {
    let corner = Canvas::to_millimetres(frame.get_base_pixel());
    let far = corner + frame_size(frame);
    let kind = |scale: &Scale| if scale.is_log { "log" } else { "linear" }.to_owned();
    vec![
        ("frame", format!("{} {} {} {}", corner.x, corner.y, far.x, far.y)),
        ("x-range", format!("{} {}", x.low, x.high)),
        ("y-range", format!("{} {}", y.low, y.high)),
        ("x-scale", kind(x)),
        ("y-scale", kind(y)),
    ]
}
