//! Graphs over the input: the speed of each point, next to its row, and under them the transmission angle, all on one
//! axis.

use super::super::area::Area;
use super::super::element::{Drawing, TextLine};
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::shown_curve::ShownCurve;
use super::table::AXIS_HEIGHT;
use super::turn::{InputRange, Runs, Sample, Speeds, TransmissionAngles};
use crate::scene::{Anchor, Circle, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::solve::SolvedCell;
use coupler_curves::text::format_in_full;

/// The transmission angle below which, or above its supplement, a linkage transmits motion poorly, in degrees.
pub(super) const POOR_TRANSMISSION: f64 = 40.0;

/// The graphs of a page: one for each row of the table, and the transmission angle.
pub(super) struct Graphs {
    pub range: InputRange,
    pub speeds: Speeds,
    pub transmission: Option<TransmissionAngles>,
}

/// A rectangle with the axis of the input along it and another axis up.
struct Axes<'a> {
    frame: Rect,
    range: &'a InputRange,
    /// The value at the top; that at the bottom is 0.
    top: f64,
}

impl Axes<'_> {
    fn x(&self, input: f64) -> f64 {
        let span = self.range.to - self.range.from;
        let part = if span > 0.0 { (input - self.range.from) / span } else { 0.5 };
        self.frame.corner.x + part * self.frame.size.x
    }

    fn y(&self, value: f64) -> f64 {
        self.frame.corner.y + self.frame.size.y * (1.0 - value / self.top)
    }

    fn point(&self, [input, value]: Sample) -> Point {
        Point::new(self.x(input), self.y(value))
    }

    /// The lines of a quantity, without what is above the top.
    fn lines(&self, runs: &Runs) -> Vec<Polyline> {
        let is_shown = |sample: &Sample| sample[1] <= self.top * (1.0 + 1e-9);
        let shown = runs.iter().flat_map(|run| run.split(|sample| !is_shown(sample))).filter(|run| run.len() > 1);
        shown.map(|run| line(run.iter().map(|&sample| self.point(sample)).collect())).collect()
    }

    fn across(&self, value: f64) -> Polyline {
        line([self.range.from, self.range.to].map(|input| self.point([input, value])).to_vec())
    }
}

fn line(points: Vec<Point>) -> Polyline {
    Polyline { points, is_closed: false }
}

fn stroked(polylines: Vec<Polyline>, stroke: Stroke) -> Item {
    Item::Path(Path { polylines, stroke: Some(stroke), fill: None })
}

impl Graphs {
    /// The graphs of some curves, at least one.
    pub fn new(solved: &SolvedCell, shown: &[ShownCurve]) -> Graphs {
        let range = InputRange::of_curves(solved, shown);
        let speeds = Speeds::of_curves(solved, shown, &range);
        let transmission = TransmissionAngles::of_curves(solved, shown, &range);
        Graphs { range, speeds, transmission }
    }

    /// Draws the speeds in the frames of their rows, and the axis; `foot` is the frame of the transmission angle, if it
    /// is drawn, below the axis of the speeds.
    pub fn draw(&self, area: &impl Area, rows: &[Rect], foot: Option<Rect>, shown: &[ShownCurve], theme: &Theme) {
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return };
        self.draw_head(area, *first, theme);
        let bottom = last.corner.y + last.size.y;
        let strip = foot.filter(|_| self.transmission.is_some());
        self.draw_ticks(area, [first.corner.y, bottom], *first, strip, theme);
        for ((row, runs), shown) in rows.iter().zip(&self.speeds.curves).zip(shown) {
            // A little less high than the row, so that graphs do not touch.
            let frame = Rect {
                corner: row.corner + Vector::new(0.0, 0.1 * row.size.y),
                size: Vector::new(row.size.x, 0.82 * row.size.y),
            };
            let axes = Axes { frame, range: &self.range, top: self.speeds.top };
            let base = stroked(vec![axes.across(0.0)], theme.stroke(theme.hairline, theme.hair_width));
            let speed = stroked(axes.lines(runs), theme.stroke(shown.ink(theme), theme.fine_width));
            let title = format!("speed of point {}", shown.curve.trace);
            area.record(Drawing { class: "speed", title, items: vec![base, speed] });
        }
        if let (Some(strip), Some(transmission)) = (strip, &self.transmission) {
            draw_transmission(area, strip, &self.range, transmission, theme);
        }
    }

    fn draw_head(&self, area: &impl Area, first: Rect, theme: &Theme) {
        let em = theme.note_size;
        let lines = ["speed".to_owned(), format!("0 to {}", format_in_full(self.speeds.top))];
        for (text, k) in lines.iter().zip([1.0, 0.0]) {
            let at = Point::new(first.corner.x, first.corner.y - (0.55 + 1.35 * k) * em);
            area.record(theme.text_line(text, at, Anchor::Start, em, theme.grey).fit_width(first.size.x));
        }
    }

    /// Draws hairlines through all graphs at round inputs, and the inputs below the speeds.
    fn draw_ticks(&self, area: &impl Area, [top, bottom]: [f64; 2], row: Rect, strip: Option<Rect>, theme: &Theme) {
        let em = theme.note_size;
        let axes = Axes { frame: row, range: &self.range, top: 1.0 };
        let ticks = self.range.ticks();
        let mut lines: Vec<Polyline> = Vec::new();
        let spans = [Some([top, bottom]), strip.map(|strip| [strip.corner.y, strip.corner.y + strip.size.y])];
        for [from, to] in spans.into_iter().flatten() {
            lines.extend(ticks.iter().map(|&tick| line([from, to].map(|y| Point::new(axes.x(tick), y)).to_vec())));
        }
        let stroke = theme.stroke(theme.faded(theme.hairline), theme.hair_width);
        area.record(Drawing { class: "axis", title: String::new(), items: vec![stroked(lines, stroke)] });
        let y = bottom + (AXIS_HEIGHT - 0.65) * em;
        let number = |k: usize, tick: f64| {
            let unit = if k + 1 == ticks.len() { self.range.unit() } else { "" };
            let mut text = theme.text_line(
                &format!("{}{unit}", format_in_full(tick)),
                Point::new(0.0, y),
                Anchor::Middle,
                em,
                theme.grey,
            );
            // The last number stays within the graph, which ends at the margin.
            let most = row.corner.x + row.size.x - text.text.width() / 2.0;
            text.text.position.x = axes.x(tick).min(most);
            text
        };
        let numbers: Vec<TextLine> = ticks.iter().enumerate().map(|(k, &tick)| number(k, tick)).collect();
        let gap = |pair: &[TextLine]| {
            let [a, b] = [&pair[0].text, &pair[1].text];
            b.start().x - a.start().x - a.width()
        };
        // Where they would be close together, some are left out, at equal steps from the first to the last.
        let last = numbers.len().saturating_sub(1);
        let are_apart = |step: &usize| {
            let kept: Vec<TextLine> = numbers.iter().step_by(*step).cloned().collect();
            last.is_multiple_of(*step) && kept.windows(2).all(|pair| gap(pair) > 0.6 * em)
        };
        let step = (1..=last).find(are_apart).unwrap_or(last.max(1));
        numbers.into_iter().step_by(step).for_each(|text| area.record(text));
    }
}

/// Draws the transmission angle from 0 to 180 degrees, with bands where it is poor and dots at its extremes.
fn draw_transmission(area: &impl Area, frame: Rect, range: &InputRange, angles: &TransmissionAngles, theme: &Theme) {
    const STRAIGHT: f64 = 180.0;
    let axes = Axes { frame, range, top: STRAIGHT };
    let band = |[from, to]: [f64; 2]| {
        let [a, b] = [[range.from, from], [range.to, to]].map(|sample| axes.point(sample));
        Polyline { points: vec![a, Point::new(b.x, a.y), b, Point::new(a.x, b.y)], is_closed: true }
    };
    let bands = [[0.0, POOR_TRANSMISSION], [STRAIGHT - POOR_TRANSMISSION, STRAIGHT]].map(band).to_vec();
    let fill = Some(theme.faded(theme.faded(theme.hairline)));
    let dot = |&extreme: &Sample| {
        let radius = 0.6 * theme.joint_radius;
        Item::Circle(Circle { centre: axes.point(extreme), radius, stroke: None, fill: Some(theme.ink) })
    };
    let mut items = vec![
        Item::Path(Path { polylines: bands, stroke: None, fill }),
        stroked(
            [0.0, STRAIGHT].map(|value| axes.across(value)).to_vec(),
            theme.stroke(theme.hairline, theme.hair_width),
        ),
        stroked(axes.lines(&angles.runs), theme.stroke(theme.ink, theme.fine_width)),
    ];
    items.extend(angles.extremes.iter().map(dot));
    area.record(Drawing { class: "transmission", title: "transmission angle".to_owned(), items });
    let em = theme.note_size;
    for value in [0.0, POOR_TRANSMISSION, STRAIGHT - POOR_TRANSMISSION, STRAIGHT] {
        let at = Point::new(frame.corner.x - 0.6 * em, axes.y(value) + 0.36 * em);
        area.record(theme.text_line(&format!("{value}°"), at, Anchor::End, em, theme.grey));
    }
}

/// The space to the left of the transmission angle for the numbers of its axis, in ems.
pub(super) const NUMBERS_WIDTH: f64 = 3.2;
