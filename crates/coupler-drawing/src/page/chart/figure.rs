//! A chart: its axes, its lines and their names.

use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::style::{Color as _, IntoFont, RGBColor, ShapeStyle, TextStyle};

use super::super::ChartSheet;
use super::super::element::{Area, Drawing, Tagged, draw, size};
use super::super::theme::Theme;
use super::keys::{self, Key};
use super::line::{Manner, Trace};
use super::scale::{Ends, Scale, Wish, is_drawn};
use crate::chart::{Over, Quantity, Series};
use crate::scene::{Anchor, Canvas, Color, Group, Item};
use coupler_curves::geometry::{Point, Vector};

/// A chart that is to be drawn.
pub(super) struct Figure<'a> {
    sheet: &'a ChartSheet<'a>,
    /// Which of the quantities it shows.
    place: usize,
    /// The scales of x and y; none where there is nothing to draw.
    scales: Option<[Scale; 2]>,
    /// The room for the numbers on the left, and for the names of the lines on the right, in millimetres.
    left: f64,
    right: f64,
}

impl<'a> Figure<'a> {
    /// The chart of the quantity at a place, to be drawn in an area of that size.
    pub fn of(sheet: &'a ChartSheet<'a>, place: usize, area: Vector, theme: &Theme) -> Figure<'a> {
        let chart = sheet.chart;
        let labels = || sheet.series.iter().map(|series| series.label.as_str());
        let right = keys::room(labels(), sheet.heading.symbols, theme).min(0.3 * area.x);
        let room = |mm: f64, least: f64, most: usize| ((mm / least) as usize).clamp(2, most);
        let wish = |quantity: &Quantity, ends, ticks| Wish {
            is_log: quantity.is_log,
            in_degrees: quantity.unit == "deg",
            range: quantity.range,
            ends,
            ticks,
        };
        // Marks are not to stand on the axis; lines may begin there.
        let ends = Ends::Beyond(if chart.over == Over::Curves { 0.025 } else { 0.0 });
        let wishes = [
            wish(&chart.x, ends, room(area.x - right, 7.0 * theme.note, 12)),
            wish(&chart.y[place], Ends::Round, room(area.y - 7.0 * theme.caption, 4.5 * theme.note, 8)),
        ];
        // What has no place on one axis does not count on the other; to the right, what any chart of the page has.
        let drawn = |place: usize| {
            let is_log = [chart.x.is_log, chart.y[place].is_log];
            let is_drawn = move |&(x, y): &(f64, f64)| is_drawn(x, is_log[0]) && is_drawn(y, is_log[1]);
            sheet.series.iter().flat_map(move |series| points(series, place)).filter(is_drawn)
        };
        let x = Scale::of(sheet.shown.clone().flat_map(drawn).map(|(x, _)| x), &wishes[0]);
        let y = Scale::of(drawn(place).map(|(_, y)| y), &wishes[1]);
        let scales = x.zip(y).map(|(x, y)| [x, y]);
        let labels = scales.iter().flat_map(|[_, y]| y.ticks.iter().map(|tick| y.label(*tick)));
        let left = labels.map(|label| theme.typeface.regular().width(&label, theme.note)).fold(0.0, f64::max);
        let left = left + 2.0 * tick(theme) + 0.2 * theme.note;
        Figure { sheet, place, scales, left, right }
    }

    /// The room its numbers need on the left, in millimetres.
    pub fn margin(&self) -> f64 {
        self.left
    }

    fn quantity(&self) -> &'a Quantity {
        &self.sheet.chart.y[self.place]
    }

    /// Draws it with that much room for the numbers on the left; what is to be known to read its places.
    pub fn draw(&self, area: &Area, left: f64, theme: &Theme) -> Vec<(&'static str, String)> {
        let gap = 1.2 * theme.caption;
        let head = 2.6 * theme.caption;
        let foot = 2.0 * tick(theme) + 1.5 * theme.note + 3.0 * theme.caption;
        self.name(area, theme);
        let Some([x, y]) = &self.scales else {
            self.nothing(area, theme);
            return Vec::new();
        };
        let mut builder = ChartBuilder::on(area);
        builder.margin_top(Canvas::pixels(head)).margin_right(Canvas::pixels(gap + self.right));
        builder.y_label_area_size(Canvas::pixels(left)).x_label_area_size(Canvas::pixels(foot));
        // A canvas cannot fail.
        let mut context = builder.build_cartesian_2d(x.clone(), y.clone()).expect("recording a scene does not fail");
        let style = |color: Color, width: f64| ShapeStyle {
            color: rgb(color).to_rgba(),
            filled: false,
            stroke_width: Canvas::pixels(width) as u32,
        };
        let grey = rgb(theme.grey);
        let label = TextStyle::from(("serif", theme.note * f64::from(Canvas::pixels(1.0))).into_font()).color(&grey);
        let mut mesh = context.configure_mesh();
        mesh.bold_line_style(style(theme.hairline, theme.hair))
            .light_line_style(style(theme.faded(theme.hairline), 0.6 * theme.hair));
        mesh.axis_style(style(theme.grey, 0.7 * theme.fine)).label_style(label);
        mesh.set_all_tick_mark_size(Canvas::pixels(tick(theme))).draw().expect("recording a scene does not fail");
        let frame = context.plotting_area().strip_coord_spec();
        self.words(area, &frame, foot, theme);
        self.lines(&frame, theme);
        facts(&frame, [x, y])
    }

    /// What goes up, over the frame: the quantity, its unit, and, where there is room, what it is.
    fn name(&self, area: &Area, theme: &Theme) {
        let width = size(area).x;
        let y = 1.2 * theme.caption;
        let name = named(self.quantity());
        let words = theme.words(&name, Point::new(0.0, y), Anchor::Start, theme.caption, theme.ink);
        let words = words.italic(self.sheet.heading.symbols).fitted(width);
        let after = words.text.width() + 1.2 * theme.caption;
        draw(area, &words);
        let definition = |text: &str| theme.words(text, Point::new(after, y), Anchor::Start, theme.note, theme.grey);
        let whole = self.quantity().definition;
        // A definition may go on to say how it is found; that is left out first.
        let parts = [": ", ", "].into_iter().filter_map(|end| whole.split_once(end)).map(|(part, _)| part);
        let fitting = std::iter::once(whole).chain(parts).find(|text| definition(text).text.width() <= width - after);
        if let Some(text) = fitting.filter(|text| !text.is_empty()) {
            draw(area, &definition(text));
        }
    }

    /// Under the frame what goes to the right, and what has no place in it.
    fn words(&self, area: &Area, frame: &Area, foot: f64, theme: &Theme) {
        let (all, inner) = (size(area), size(frame));
        let left = f64::from(frame.get_base_pixel().0 - area.get_base_pixel().0) / f64::from(Canvas::pixels(1.0));
        let y = all.y - foot + 2.0 * tick(theme) + 1.5 * theme.note + 1.1 * theme.caption;
        let name = named(&self.sheet.chart.x);
        let words = theme.words(&name, Point::new(left + inner.x / 2.0, y), Anchor::Middle, theme.caption, theme.ink);
        let words = words.italic(self.sheet.heading.symbols).fitted(0.9 * inner.x);
        let beside = (inner.x - words.text.width()) / 2.0 - theme.caption;
        draw(area, &words);
        let below: usize = self.traces(frame).iter().map(|trace| trace.below).sum();
        if below > 0 {
            let note = match below {
                1 => "1 value of 0 or less is left out".to_owned(),
                n => format!("{n} values of 0 or less are left out"),
            };
            let words = theme.words(&note, Point::new(left + inner.x, y), Anchor::End, theme.note, theme.grey);
            draw(area, &words.fitted(beside));
        }
    }

    /// That there is nothing to draw, and why.
    fn nothing(&self, area: &Area, theme: &Theme) {
        let is_log = self.quantity().is_log || self.sheet.chart.x.is_log;
        let text = if is_log { "no value that a logarithmic axis has a place for" } else { "no finite value" };
        let at = Point::from(size(area) / 2.0);
        let words = theme.words(text, at, Anchor::Middle, theme.caption, theme.grey).fitted(size(area).x);
        draw(area, &Drawing { class: "nothing", title: String::new(), items: vec![Item::Text(words.text)] });
    }

    fn traces(&self, frame: &Area) -> Vec<Trace> {
        let Some([x, y]) = &self.scales else { return Vec::new() };
        let size = span(frame);
        self.sheet.series.iter().map(|series| Trace::of(points(series, self.place), (x, y), size)).collect()
    }

    /// The lines, each a group of its own, and their names beside the frame.
    fn lines(&self, frame: &Area, theme: &Theme) {
        let traces = self.traces(frame);
        let span = span(frame);
        // Marks are for points that stand apart, on one chart of a page as on another.
        let most = self.sheet.series.iter().map(|series| series.x.len()).max().unwrap_or(0);
        let with_marks = self.sheet.chart.over == Over::Curves && most as f64 * 4.0 * theme.joint < span.x;
        let mut keys = Vec::new();
        for (k, (trace, series)) in traces.iter().zip(self.sheet.series).enumerate() {
            let manner = Manner::of(k, theme);
            let mut items = manner.line(&trace.runs, theme);
            let marked = if with_marks { &trace.points } else { &trace.alone };
            items.extend(marked.iter().map(|at| manner.mark(*at, theme)));
            draw(frame, &Tagged { group: self.group(k, series, items) });
            if let Some(end) = trace.end().filter(|_| !series.label.is_empty()) {
                keys.push(Key { label: &series.label, manner, height: end.y });
            }
        }
        let items = keys::items(keys, (span.x, span.y, self.right), with_marks, self.sheet.heading.symbols, theme);
        if !items.is_empty() {
            draw(frame, &Drawing { class: "keys", title: String::new(), items });
        }
    }

    fn group(&self, k: usize, series: &Series, items: Vec<Item>) -> Group {
        let (x, y) = (&self.sheet.chart.x.text, &self.quantity().text);
        let of = if series.label.is_empty() { String::new() } else { format!(", {}", series.label) };
        let mut data: Vec<(&'static str, String)> =
            series.cell.map(|cell| ("cell", cell.to_string())).into_iter().collect();
        data.extend([("trace", series.trace.to_string()), ("circuit", series.circuit.to_string())]);
        Group {
            id: format!("{}-chart-{}-{}", self.sheet.heading.family, self.place + 1, k + 1),
            class: "series",
            title: format!("{}: {y} over {x}{of}", self.sheet.heading.title),
            data,
            items,
        }
    }
}

fn points(series: &Series, place: usize) -> impl Iterator<Item = (f64, f64)> {
    series.x.iter().copied().zip(series.y[place].iter().copied())
}

/// A quantity and its unit.
fn named(quantity: &Quantity) -> String {
    if quantity.unit == "deg" { format!("{}, °", quantity.text) } else { quantity.text.clone() }
}

/// The length of a tick.
fn tick(theme: &Theme) -> f64 {
    0.4 * theme.note
}

fn rgb(Color(r, g, b): Color) -> RGBColor {
    RGBColor(r, g, b)
}

/// Width and height of the frame from its first place to its last, which plotters has within it.
fn span(frame: &DrawingArea<Canvas, Shift>) -> Vector {
    let pixel = 1.0 / f64::from(Canvas::pixels(1.0));
    size(frame) - Vector::new(pixel, pixel)
}

/// What is needed to read a chart's places: where its frame is on the page, and what its edges stand for.
fn facts(frame: &Area, [x, y]: [&Scale; 2]) -> Vec<(&'static str, String)> {
    let corner = Canvas::millimetres(frame.get_base_pixel());
    let far = corner + span(frame);
    let kind = |scale: &Scale| if scale.is_log { "log" } else { "linear" }.to_owned();
    vec![
        ("frame", format!("{} {} {} {}", corner.x, corner.y, far.x, far.y)),
        ("x-range", format!("{} {}", x.low, x.high)),
        ("y-range", format!("{} {}", y.low, y.high)),
        ("x-scale", kind(x)),
        ("y-scale", kind(y)),
    ]
}
