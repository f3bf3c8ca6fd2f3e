//! The figure of a chart: axes, lines and their labels.

use plotters::chart::ChartBuilder;
use plotters::style::{Color as _, IntoFont, RGBColor, ShapeStyle, TextStyle};

use super::super::ChartPage;
use super::super::area::{Area, PlottersArea};
use super::super::element::Drawing;
use super::super::theme::Theme;
use super::coinciding::shared_labels;
use super::legend::Legend;
use super::line::{ClippedLine, LineStyle};
use super::line_labels::{self, LineLabel, Space};
use super::scale::{RangeEnds, Scale, ScaleOptions};
use crate::chart::{AxisRange, PointSource, Quantity, Series, is_drawable};
use crate::scene::{Anchor, Color, Group, Item, pixel};
use coupler_curves::geometry::{Point, Vector};

/// What the lines of a chart have that is explained on its page.
#[derive(Clone, Copy, Default)]
pub(super) struct LineFeatures {
    /// Whether the linkages of the family are marked on them.
    pub has_marks: bool,
    /// Whether some line has a gap.
    pub has_gaps: bool,
}

impl LineFeatures {
    /// What either has.
    pub fn or(self, other: LineFeatures) -> LineFeatures {
        LineFeatures { has_marks: self.has_marks || other.has_marks, has_gaps: self.has_gaps || other.has_gaps }
    }
}

/// The data attributes of a chart, which relate positions on the page to values.
type ChartData = Vec<(&'static str, String)>;

/// A chart with its scales and margins.
pub(super) struct ChartFigure<'a> {
    page: &'a ChartPage<'a>,
    /// The index of the quantity it shows.
    quantity_index: usize,
    /// The label of each line; `None` for a line that coincides with an earlier one.
    labels: Vec<Option<String>>,
    /// The names of the values in the labels next to the frame, if these are without them, and these labels.
    head: String,
    shown_labels: Vec<Option<String>>,
    /// The scales of x and y; `None` if no value can be drawn.
    scales: Option<[Scale; 2]>,
    /// The widths of the tick labels on the left and of the labels of lines on the right, in millimetres.
    left_margin: f64,
    right_margin: f64,
    /// The legend below the chart, if the labels have no room beside it.
    legend: Option<Legend>,
    /// The number of labels that have no room.
    pub omitted: usize,
}

impl<'a> ChartFigure<'a> {
    /// The chart of the quantity at an index, for an area of a size in millimetres.
    pub fn new(page: &'a ChartPage<'a>, quantity_index: usize, area: Vector, theme: &Theme) -> ChartFigure<'a> {
        let chart = page.chart;
        let quantities = [&chart.x, &chart.y[quantity_index]];
        let values =
            |k: usize| page.series.iter().flat_map(move |line| line.points(quantity_index).map(move |at| at[k]));
        let axes = [0, 1].map(|k| AxisRange::new(quantities[k], values(k)));
        let labels = shared_labels(page.series, quantity_index, chart.point_source, axes);
        let label_width = |labels: &[Option<String>]| {
            line_labels::label_width(labels.iter().flatten().map(String::as_str), page.heading.symbols, theme)
        };
        // Where the labels have no room, the names in them are said once.
        let (whole, most) = (label_width(&labels), 0.3 * area.x);
        let count = labels.iter().flatten().count();
        let have_room = whole <= most && line_labels::have_room(count, frame_height(area, theme), theme);
        let without_names = if have_room { None } else { line_labels::without_names(&labels) };
        let right = whole.min(most);
        let right = without_names.as_ref().map_or(right, |(_, values)| label_width(values).clamp(right, 0.45 * area.x));
        let (head, shown_labels) = without_names.unwrap_or_else(|| (String::new(), labels.clone()));
        let texts: Vec<&str> =
            shown_labels.iter().flatten().map(String::as_str).filter(|text| !text.is_empty()).collect();
        let symbols = page.heading.symbols;
        let beside = Space { left: 0.0, height: frame_height(area, theme), width: right };
        let legible = line_labels::legible_count((&head, &texts), beside, symbols, theme);
        let legend = (legible < texts.len()).then(|| Legend::new((&head, &shown_labels), area, symbols, theme));
        let legend = legend.filter(|legend| legend.shown >= legible);
        let omitted = texts.len() - legend.as_ref().map_or(legible, |legend| legend.shown);
        let right = if legend.is_some() { 0.0 } else { right };
        let legend_height = legend.as_ref().map_or(0.0, |legend| legend.height);
        let tick_count = |length: f64, spacing: f64, most: usize| ((length / spacing) as usize).clamp(2, most);
        let scale_options = |quantity: &Quantity, ends, ticks| ScaleOptions {
            is_log: quantity.is_log,
            is_in_degrees: quantity.unit == "deg",
            range: quantity.range,
            ends,
            target_ticks: ticks,
        };
        // Marks must not overlap the axis; lines may start on it.
        let ends = RangeEnds::Padded(if chart.point_source == PointSource::Curves { 0.025 } else { 0.0 });
        let options = [
            scale_options(&chart.x, ends, tick_count(area.x - right, 7.0 * theme.note_size, 12)),
            scale_options(
                &chart.y[quantity_index],
                RangeEnds::Round,
                tick_count(area.y - legend_height - 7.0 * theme.caption_size, 4.5 * theme.note_size, 8),
            ),
        ];
        // A point that cannot be drawn on one axis does not extend the other. The x axis is that of all charts of the
        // page.
        let drawn = |index: usize| {
            let is_log = [chart.x.is_log, chart.y[index].is_log];
            let is_drawn = move |&[x, y]: &[f64; 2]| is_drawable(x, is_log[0]) && is_drawable(y, is_log[1]);
            page.series.iter().flat_map(move |series| series.points(index)).filter(is_drawn)
        };
        let between_cells = |series: &Series| series.paths.get(quantity_index)?.range;
        let heights = drawn(quantity_index).map(|[_, y]| y);
        let heights = heights.chain(page.series.iter().filter_map(between_cells).flatten());
        // A line may begin and end between cells, where it has values but they have none.
        let beyond_cells = |index: usize| {
            let is_log = chart.y[index].is_log;
            let points =
                page.series.iter().filter_map(move |series| series.paths.get(index)).flat_map(|path| &path.points);
            points.copied().filter(move |[_, y]| is_drawable(*y, is_log))
        };
        let on_lines = page.quantity_range.clone().flat_map(|index| drawn(index).chain(beyond_cells(index)));
        let x = Scale::from_values(on_lines.map(|[x, _]| x), &options[0]);
        let y = Scale::from_values(heights, &options[1]);
        let scales = x.zip(y).map(|(x, y)| [x, y]);
        let ticks = scales.iter().flat_map(|[_, y]| y.ticks.iter().map(|tick| y.tick_label(*tick)));
        let left = ticks.map(|label| theme.typeface.regular().width(&label, theme.note_size)).fold(0.0, f64::max);
        let left = left + 2.0 * tick_length(theme) + 0.2 * theme.note_size;
        ChartFigure {
            page,
            quantity_index,
            labels,
            head,
            shown_labels,
            scales,
            left_margin: left,
            right_margin: right,
            legend,
            omitted,
        }
    }

    /// The width of the tick labels on the left, in millimetres.
    pub fn left_margin(&self) -> f64 {
        self.left_margin
    }

    /// The height of the legend, in millimetres; 0 if there is none.
    pub fn legend_height(&self) -> f64 {
        self.legend.as_ref().map_or(0.0, |legend| legend.height)
    }

    fn quantity(&self) -> &'a Quantity {
        &self.page.chart.y[self.quantity_index]
    }

    /// Draws the chart with a width for the tick labels on the left and a height for the legend, in millimetres; the result is its data
    /// and what is explained on its page.
    pub fn draw(
        &self,
        area: &PlottersArea,
        [left, legend_height]: [f64; 2],
        theme: &Theme,
    ) -> (ChartData, LineFeatures) {
        let gap = 1.2 * theme.caption_size;
        let head = 2.6 * theme.caption_size;
        let foot = 2.0 * tick_length(theme) + 1.5 * theme.note_size + 3.0 * theme.caption_size;
        self.draw_title(area, theme);
        let Some([x, y]) = &self.scales else {
            self.draw_empty_message(area, theme);
            return Default::default();
        };
        let mut builder = ChartBuilder::on(area);
        builder
            .margin_top(pixel::from_millimetres(head))
            .margin_right(pixel::from_millimetres(gap + self.right_margin))
            .margin_bottom(pixel::from_millimetres(legend_height));
        builder.y_label_area_size(pixel::from_millimetres(left)).x_label_area_size(pixel::from_millimetres(foot));
        // A canvas cannot fail.
        let mut context = builder.build_cartesian_2d(x.clone(), y.clone()).expect("recording a scene does not fail");
        let style = |color: Color, width: f64| ShapeStyle {
            color: to_rgb(color).to_rgba(),
            filled: false,
            stroke_width: pixel::from_millimetres(width) as u32,
        };
        let grey = to_rgb(theme.grey);
        let label = TextStyle::from(("serif", theme.note_size * pixel::PER_MM).into_font()).color(&grey);
        let mut mesh = context.configure_mesh();
        mesh.bold_line_style(style(theme.hairline, theme.hair_width))
            .light_line_style(style(theme.faded(theme.hairline), 0.6 * theme.hair_width));
        mesh.axis_style(style(theme.grey, 0.7 * theme.fine_width)).label_style(label);
        mesh.set_all_tick_mark_size(pixel::from_millimetres(tick_length(theme)))
            .draw()
            .expect("recording a scene does not fail");
        let frame = context.plotting_area().strip_coord_spec();
        self.draw_x_title(area, &frame, foot + legend_height, theme);
        let features = self.draw_lines(area, &frame, legend_height, theme);
        (axis_data(&frame, [x, y]), features)
    }

    /// Draws the quantity of the y axis above the frame, with its unit.
    fn draw_title(&self, area: &PlottersArea, theme: &Theme) {
        let at = Point::new(0.0, 1.2 * theme.caption_size);
        let title = theme.text_line(&self.quantity().label(), at, Anchor::Start, theme.caption_size, theme.ink);
        area.record(title.with_italics(self.page.heading.symbols).fit_width(area.size().x));
    }

    /// Draws the quantity of the x axis under the frame, and the number of values that a logarithmic axis leaves out.
    fn draw_x_title(&self, area: &PlottersArea, frame: &PlottersArea, foot: f64, theme: &Theme) {
        let (all, inner) = (area.size(), frame.size());
        let left = f64::from(frame.get_base_pixel().0 - area.get_base_pixel().0) / pixel::PER_MM;
        let y = all.y - foot + 2.0 * tick_length(theme) + 1.5 * theme.note_size + 1.1 * theme.caption_size;
        let name = self.page.chart.x.label();
        let title =
            theme.text_line(&name, Point::new(left + inner.x / 2.0, y), Anchor::Middle, theme.caption_size, theme.ink);
        // A title may be wider than the frame, as far as the chart is.
        let middle = left + inner.x / 2.0;
        let lines = title.fit_or_wrap((2.0 * middle.min(all.x - middle)).max(0.9 * inner.x));
        let note_width = (inner.x - lines.first().map_or(0.0, |line| line.text.width())) / 2.0 - theme.caption_size;
        for (k, line) in lines.into_iter().enumerate() {
            let below = Vector::new(0.0, 1.3 * theme.caption_size * k as f64);
            let at = line.text.position + below;
            area.record(line.with_italics(self.page.heading.symbols).moved_to(at));
        }
        let lines = self.clipped_lines(frame);
        let drawn = lines.iter().zip(&self.labels).filter(|(_, label)| label.is_some());
        let left_out: usize = drawn.map(|([_, points], _)| points.nonpositive_count).sum();
        if left_out > 0 {
            let note = match left_out {
                1 => "1 value of 0 or less is left out".to_owned(),
                n => format!("{n} values of 0 or less are left out"),
            };
            let corner = Point::new(left + inner.x, y);
            let note = theme.text_line(&note, corner, Anchor::End, theme.note_size, theme.grey);
            // Beside the title, or under it where it is longer than what that leaves.
            let is_beside = note.text.width() <= note_width;
            let under = corner + Vector::new(0.0, 1.4 * theme.note_size);
            area.record(if is_beside { note } else { note.moved_to(under).fit_width(left + inner.x) });
        }
    }

    /// Draws the reason why there is nothing to draw.
    fn draw_empty_message(&self, area: &PlottersArea, theme: &Theme) {
        let is_log = self.quantity().is_log || self.page.chart.x.is_log;
        draw_message(area, if is_log { "no positive value for a logarithmic axis" } else { "no finite value" }, theme);
    }

    /// The lines of the chart, and their points, which may be fewer than those of the lines.
    fn clipped_lines(&self, frame: &PlottersArea) -> Vec<[ClippedLine; 2]> {
        let Some([x, y]) = &self.scales else { return Vec::new() };
        let (size, index) = (frame_size(frame), self.quantity_index);
        let clipped = |series: &Series| {
            let points = ClippedLine::from_points(series.points(index), x, y, size);
            [ClippedLine::from_points(series.path(index), x, y, size), points]
        };
        self.page.series.iter().map(clipped).collect()
    }

    /// Draws the lines, each as a group, and their labels next to the frame or in a legend at the foot of the area.
    fn draw_lines(&self, area: &PlottersArea, frame: &PlottersArea, legend_height: f64, theme: &Theme) -> LineFeatures {
        let lines = self.clipped_lines(frame);
        let span = frame_size(frame);
        let is_empty =
            |line: &ClippedLine| line.runs.is_empty() && line.points.is_empty() && line.isolated_points.is_empty();
        if lines.iter().flatten().all(is_empty) {
            draw_message(frame, "no value is in the range of the axes", theme);
        }
        // Points are marked if they are far enough apart on all charts of the page.
        let most = self.page.series.iter().map(|series| series.x.len()).max().unwrap_or(0);
        let with_marks =
            self.page.chart.point_source == PointSource::Curves && most as f64 * 4.0 * theme.joint_radius < span.x;
        let mut labels = Vec::new();
        for (k, ([line, points], series)) in lines.iter().zip(self.page.series).enumerate() {
            let Some(label) = &self.labels[k] else { continue };
            let style = self.line_style(series, k, theme);
            let mut items = style.line_items(&line.runs, theme);
            let marked = if with_marks { &points.points } else { &line.isolated_points };
            items.extend(marked.iter().map(|at| style.mark_item(*at, theme)));
            frame.record(Item::Group(self.series_group(k, label, items)));
            if let (Some(end), Some(text)) = (line.end_point(), &self.shown_labels[k])
                && !text.is_empty()
            {
                labels.push(LineLabel { text: text.as_str(), style, end_height: end.y });
            }
        }
        let symbols = self.page.heading.symbols;
        let keys = |items: Vec<Item>| Drawing { class: "keys", title: String::new(), items };
        if let Some(legend) = &self.legend {
            let size = area.size();
            let corner = Point::new(0.0, size.y - legend_height);
            area.record(keys(legend.items(&labels, (corner, size.x), with_marks, symbols)));
        } else if !labels.is_empty() {
            let space = Space { left: span.x, height: span.y, width: self.right_margin };
            let items = line_labels::label_items((&self.head, labels), space, with_marks, symbols, theme);
            frame.record(keys(items));
        }
        LineFeatures { has_marks: with_marks, has_gaps: lines.iter().any(|[line, _]| line.runs.len() > 1) }
    }

    /// The style of the k-th line: by its place, if the lines are in an order.
    fn line_style(&self, series: &Series, k: usize, theme: &Theme) -> LineStyle {
        let count = self.page.series.len();
        match series.place {
            Some(place) => LineStyle::for_place((place * (count - 1) as f64).round() as usize, count, theme),
            None => LineStyle::for_index(k, theme),
        }
    }

    fn series_group(&self, k: usize, label: &str, items: Vec<Item>) -> Group {
        let series = &self.page.series[k];
        let (x, y) = (&self.page.chart.x.title, &self.quantity().title);
        let suffix = if label.is_empty() { String::new() } else { format!(", {label}") };
        let mut data: Vec<(&'static str, String)> =
            series.cell.map(|cell| ("cell", cell.to_string())).into_iter().collect();
        data.extend([("trace", series.trace.to_string()), ("circuit", series.circuit.to_string())]);
        Group {
            id: format!("{}-chart-{}-{}", self.page.heading.family_id, self.quantity_index + 1, k + 1),
            class: "series",
            title: format!("{}: {y} over {x}{suffix}", self.page.heading.family_title),
            data,
            items,
            ..Group::default()
        }
    }
}

/// Draws a reason why there is nothing to see in the middle of an area.
fn draw_message(area: &PlottersArea, text: &str, theme: &Theme) {
    let at = Point::from(area.size() / 2.0);
    let line = theme.text_line(text, at, Anchor::Middle, theme.caption_size, theme.grey).fit_width(area.size().x);
    area.record(Drawing { class: "nothing", title: String::new(), items: vec![Item::Text(line.text)] });
}

/// The length of a tick, in millimetres.
fn tick_length(theme: &Theme) -> f64 {
    0.4 * theme.note_size
}

fn to_rgb(Color(r, g, b): Color) -> RGBColor {
    RGBColor(r, g, b)
}

/// The height of the frame of a chart in an area of a size.
fn frame_height(area: Vector, theme: &Theme) -> f64 {
    area.y - 5.6 * theme.caption_size - 2.0 * tick_length(theme) - 1.5 * theme.note_size
}

/// The width and height of the frame between its first and its last pixel, both of which plotters counts as inside.
fn frame_size(frame: &PlottersArea) -> Vector {
    frame.size() - Vector::repeat(1.0 / pixel::PER_MM)
}

/// The data attributes that relate positions on the page to values: the frame of the chart and the ranges of its axes.
fn axis_data(frame: &PlottersArea, [x, y]: [&Scale; 2]) -> Vec<(&'static str, String)> {
    let corner = pixel::to_millimetres(frame.get_base_pixel());
    let opposite = corner + frame_size(frame);
    let kind = |scale: &Scale| if scale.is_log { "log" } else { "linear" }.to_owned();
    vec![
        ("frame", format!("{} {} {} {}", corner.x, corner.y, opposite.x, opposite.y)),
        ("x-range", format!("{} {}", x.low, x.high)),
        ("y-range", format!("{} {}", y.low, y.high)),
        ("x-scale", kind(x)),
        ("y-scale", kind(y)),
    ]
}
