//! A line of a chart on paper: its points and its style.

use crate::scene::{Circle, Color, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Point, Vector};

use super::super::theme::Theme;
use super::scale::Scale;
use crate::chart::is_drawable;

/// A line on paper, split at its gaps and clipped to the frame; in millimetres of the frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ClippedLine {
    /// The unbroken parts of the line.
    pub runs: Vec<Vec<Point>>,
    /// The points within the frame.
    pub points: Vec<Point>,
    /// The points within the frame that are not joined to another one.
    pub isolated_points: Vec<Point>,
    /// The number of points that a logarithmic axis cannot show because a value is not positive.
    pub nonpositive_count: usize,
}

impl ClippedLine {
    /// The line through points, x and y, in a frame of a size in millimetres.
    pub fn from_points(points: impl IntoIterator<Item = [f64; 2]>, x: &Scale, y: &Scale, size: Vector) -> ClippedLine {
        let mut line = ClippedLine::default();
        let inside = |p: &Point| (-1e-6..=size.x + 1e-6).contains(&p.x) && (-1e-6..=size.y + 1e-6).contains(&p.y);
        let mut last: Option<Point> = None;
        let mut joined = true;
        for [a, b] in points {
            let is_nonpositive = (x.is_log && a <= 0.0) || (y.is_log && b <= 0.0);
            line.nonpositive_count += usize::from(is_nonpositive && a.is_finite() && b.is_finite());
            if !is_drawable(a, x.is_log) || !is_drawable(b, y.is_log) {
                line.isolated_points.extend(last.take().filter(|p| !joined && inside(p)));
                continue;
            }
            let p = Point::new(x.fraction(a) * size.x, (1.0 - y.fraction(b)) * size.y);
            joined = last.is_some();
            if let Some(last) = last {
                line.push_segment(last, p, size);
            }
            line.points.extend(Some(p).filter(inside));
            last = Some(p);
        }
        line.isolated_points.extend(last.filter(|p| !joined && inside(p)));
        line
    }

    /// Adds the part of a segment that is in the frame.
    fn push_segment(&mut self, from: Point, to: Point, size: Vector) {
        let Some([a, b]) = clip_segment(from, to, size) else { return };
        match self.runs.last_mut() {
            Some(run) if run.last() == Some(&a) => run.push(b),
            _ => self.runs.push(vec![a, b]),
        }
    }

    /// The rightmost of the last points, next to which the label of the line is.
    pub fn end_point(&self) -> Option<Point> {
        let run = self.runs.last().and_then(|run| run.last()).copied();
        [run, self.isolated_points.last().copied()].into_iter().flatten().max_by(|a, b| a.x.total_cmp(&b.x))
    }
}

/// The part of a segment that is in the frame (Liang and Barsky 1984); `None` if it is outside.
fn clip_segment(a: Point, b: Point, size: Vector) -> Option<[Point; 2]> {
    let along = b - a;
    let (mut from, mut to) = (0.0, 1.0);
    for (rate, distance) in [(-along.x, a.x), (along.x, size.x - a.x), (-along.y, a.y), (along.y, size.y - a.y)] {
        // A point on the edge is inside in spite of rounding.
        let distance = if distance.abs() < 1e-9 { 0.0 } else { distance };
        if rate == 0.0 && distance < 0.0 {
            return None;
        }
        if rate < 0.0 {
            from = f64::max(from, distance / rate);
        } else if rate > 0.0 {
            to = f64::min(to, distance / rate);
        }
    }
    let at = |part: f64| match part {
        0.0 => a,
        1.0 => b,
        part => a + along * part,
    };
    (from <= to).then(|| [at(from), at(to)])
}

/// The style by which a line differs from others: colour, weight, dashes and marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LineStyle {
    pub ink: Color,
    /// The weight in millimetres.
    width: f64,
    /// The lengths of dashes and gaps alternately, in millimetres; empty for a solid line.
    dashes: &'static [f64],
    mark: Mark,
}

/// The shape of a mark.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mark {
    Disc,
    Ring,
    Square,
    Diamond,
    Triangle,
}

/// The patterns of lines: the lengths of dashes and gaps alternately, in millimetres.
const DASHES: [&[f64]; 5] = [&[], &[3.0, 1.2], &[1.0, 1.0], &[5.0, 1.0, 1.0, 1.0], &[7.0, 1.6]];

const MARKS: [Mark; 5] = [Mark::Disc, Mark::Ring, Mark::Square, Mark::Diamond, Mark::Triangle];

/// The weight of lines of charts, as a multiple of that of curves.
const WEIGHT: f64 = 1.2;

impl LineStyle {
    /// The style of the k-th line, from 0: five lines in the same ink differ in dashes and in marks.
    pub fn for_index(k: usize, theme: &Theme) -> LineStyle {
        let inks = theme.curve_inks.len();
        let (ink, round) = (k % inks, k / inks);
        LineStyle {
            ink: theme.curve_ink(k),
            width: WEIGHT * theme.curve_stroke(k).width,
            dashes: DASHES[(ink + round) % DASHES.len()],
            mark: MARKS[(ink + 2 * round) % MARKS.len()],
        }
    }

    /// The style of the k-th line, from 0, of `count` lines in an order: its ink is at its place in the order, and lines
    /// in similar inks, or in greys, differ in dashes.
    pub fn for_place(k: usize, count: usize, theme: &Theme) -> LineStyle {
        /// More inks than these are too similar to be distinguished without dashes.
        const MAX_INKS: usize = 7;
        let ink = theme.ordered_ink(k as f64 / count.saturating_sub(1).max(1) as f64);
        let needs_dashes = count > MAX_INKS || theme.curve_styles.len() > 1;
        LineStyle {
            ink,
            width: WEIGHT * theme.curve_width,
            dashes: if needs_dashes { DASHES[k % DASHES.len()] } else { DASHES[0] },
            mark: MARKS[k % MARKS.len()],
        }
    }

    /// The items of a line through some runs; a dashed line has a light solid one under it that bridges the gaps.
    pub fn line_items(&self, runs: &[Vec<Point>], theme: &Theme) -> Vec<Item> {
        let line = |points: &Vec<Point>| Polyline { points: points.clone(), is_closed: false };
        let whole = |stroke: Stroke| {
            Item::Path(Path { polylines: runs.iter().map(line).collect(), stroke: Some(stroke), fill: None })
        };
        let stroke = theme.stroke(self.ink, self.width);
        if runs.is_empty() {
            return Vec::new();
        }
        if self.dashes.is_empty() {
            return vec![whole(stroke)];
        }
        let scale = theme.curve_width / 0.4;
        let lines = runs.iter().flat_map(|run| split_into_dashes(run, self.dashes, scale)).collect();
        let dashes = Item::Path(Path { polylines: lines, stroke: Some(stroke), fill: None });
        vec![whole(theme.stroke(theme.faded(self.ink), theme.hair_width)), dashes]
    }

    /// A mark at a point.
    pub fn mark_item(&self, at: Point, theme: &Theme) -> Item {
        let r = 0.8 * theme.joint_radius;
        let stroke = Some(theme.stroke(self.ink, theme.fine_width));
        let circle = |fill| Item::Circle(Circle { centre: at, radius: r, stroke, fill: Some(fill) });
        let shape = |corners: &[(f64, f64)], fill| {
            let points = corners.iter().map(|(x, y)| at + Vector::new(*x, *y) * r).collect();
            Item::Path(Path { polylines: vec![Polyline { points, is_closed: true }], stroke, fill: Some(fill) })
        };
        match self.mark {
            Mark::Disc => circle(self.ink),
            Mark::Ring => circle(theme.paper),
            Mark::Square => shape(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)], self.ink),
            Mark::Diamond => shape(&[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)], theme.paper),
            Mark::Triangle => shape(&[(0.0, -1.15), (1.1, 0.8), (-1.1, 0.8)], self.ink),
        }
    }
}

/// A polyline split into dashes; it starts with a dash.
fn split_into_dashes(run: &[Point], pattern: &[f64], scale: f64) -> Vec<Polyline> {
    let mut out: Vec<Polyline> = Vec::new();
    let (mut k, mut remaining) = (0, pattern[0] * scale);
    let mut dash: Vec<Point> = run.first().copied().into_iter().collect();
    for pair in run.windows(2) {
        let mut at = pair[0];
        loop {
            let rest = pair[1] - at;
            let length = rest.norm();
            if length < remaining {
                remaining -= length;
                break;
            }
            at += rest * (remaining / length);
            if k % 2 == 0 {
                dash.push(at);
                out.push(Polyline { points: std::mem::take(&mut dash), is_closed: false });
            } else {
                dash.push(at);
            }
            k = (k + 1) % pattern.len();
            remaining = pattern[k] * scale;
        }
        if k % 2 == 0 {
            dash.push(pair[1]);
        }
    }
    if dash.len() > 1 {
        out.push(Polyline { points: dash, is_closed: false });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::scale::{RangeEnds, ScaleOptions};
    use super::*;

    fn scale(low: f64, high: f64, is_log: bool) -> Scale {
        let options = ScaleOptions {
            is_log,
            is_in_degrees: false,
            range: Some([low, high]),
            ends: RangeEnds::Round,
            target_ticks: 5,
        };
        Scale::from_values([low].into_iter(), &options).unwrap()
    }

    #[test]
    fn a_line_has_gaps_and_is_clipped_to_its_frame() {
        let (x, y) = (scale(0.0, 10.0, false), scale(0.0, 1.0, false));
        let size = Vector::new(100.0, 50.0);
        let points =
            [[0.0, 0.0], [2.0, 1.0], [3.0, f64::NAN], [4.0, 0.5], [5.0, f64::INFINITY], [6.0, 0.5], [7.0, 2.0]];
        let line = ClippedLine::from_points(points, &x, &y, size);
        assert_eq!(line.runs.len(), 2);
        assert_eq!(line.runs[0], [Point::new(0.0, 50.0), Point::new(20.0, 0.0)]);
        // The line from 0.5 to 2 leaves the frame after a third of its length.
        assert!((line.runs[1][1] - Point::new(60.0 + 10.0 / 3.0, 0.0)).norm() < 1e-12);
        assert_eq!(line.isolated_points, [Point::new(40.0, 25.0)]);
        assert_eq!(line.points.len(), 4);
    }

    #[test]
    fn values_that_are_not_positive_are_left_out_on_a_logarithmic_axis() {
        let (x, y) = (scale(0.0, 2.0, false), scale(0.01, 1.0, true));
        let size = Vector::new(20.0, 20.0);
        let line = ClippedLine::from_points([[0.0, 0.1], [1.0, 0.0], [2.0, -1.0], [2.0, f64::NAN]], &x, &y, size);
        assert_eq!((line.nonpositive_count, line.isolated_points.len(), line.runs.len()), (2, 1, 0));
        assert!((line.isolated_points[0].y - 10.0).abs() < 1e-9);
    }

    #[test]
    fn dashes_cover_their_fraction_of_the_line() {
        let run: Vec<Point> = (0..=40).map(|k| Point::new(f64::from(k), f64::from(k % 2) * 0.5)).collect();
        let length: f64 = run.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let dashes = split_into_dashes(&run, &[3.0, 1.0], 1.0);
        let drawn: f64 =
            dashes.iter().flat_map(|dash| dash.points.windows(2)).map(|pair| (pair[1] - pair[0]).norm()).sum();
        // The line is whole periods and a part of one.
        assert!((drawn - 0.75 * length).abs() < 1.0, "{drawn} of {length}");
        assert_eq!(dashes.len(), (length / 4.0).ceil() as usize);
    }

    #[test]
    fn twenty_five_lines_have_different_styles() {
        let theme = Theme::default().for_paper(super::super::super::Paper::NAMED[1].1);
        let styles: Vec<LineStyle> = (0..25).map(|k| LineStyle::for_index(k, &theme)).collect();
        for (k, a) in styles.iter().enumerate() {
            for b in &styles[..k] {
                assert!(a != b && (a.ink != b.ink || (a.dashes != b.dashes && a.mark != b.mark)), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn twenty_lines_in_an_order_have_different_styles() {
        for named in Theme::NAMED {
            let theme = (named.theme)();
            let styles: Vec<LineStyle> = (0..20).map(|k| LineStyle::for_place(k, 20, &theme)).collect();
            for (k, a) in styles.iter().enumerate() {
                // Lines in the same dashes are five places apart.
                let is_distinguishable = |b: &LineStyle| a.dashes != b.dashes || a.ink.difference(b.ink) > 7.0;
                assert!(styles[..k].iter().all(is_distinguishable), "{}: {k}", named.name);
            }
        }
        let theme = Theme::default();
        assert!((0..6).all(|k| LineStyle::for_place(k, 6, &theme).dashes.is_empty()));
        assert_eq!(LineStyle::for_place(0, 1, &theme).ink, theme.ordered_ink(0.0));
    }
}
