//! A line of a chart on paper: where it goes, and how it is told from others.

use crate::scene::{Circle, Color, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Point, Vector};

use super::super::theme::Theme;
use super::scale::{Scale, is_drawable};

/// A line on paper, parted at its gaps and cut off at the frame; in millimetres of the frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ClippedLine {
    /// Its unbroken parts.
    pub runs: Vec<Vec<Point>>,
    /// Its points within the frame.
    pub points: Vec<Point>,
    /// Those of them that no other is joined to.
    pub isolated_points: Vec<Point>,
    /// How many of its points have a value that a logarithmic axis has no place for.
    pub nonpositive_count: usize,
}

impl ClippedLine {
    /// The line through points, x and y, in a frame of that size.
    pub fn from_points(
        points: impl Iterator<Item = (f64, f64)>,
        (x, y): (&Scale, &Scale),
        size: Vector,
    ) -> ClippedLine {
        let mut trace = ClippedLine::default();
        let inside = |p: &Point| (-1e-6..=size.x + 1e-6).contains(&p.x) && (-1e-6..=size.y + 1e-6).contains(&p.y);
        let mut last: Option<Point> = None;
        let mut joined = true;
        for (a, b) in points {
            let is_low = (x.is_log && a <= 0.0) || (y.is_log && b <= 0.0);
            trace.nonpositive_count += usize::from(is_low && a.is_finite() && b.is_finite());
            if !is_drawable(a, x.is_log) || !is_drawable(b, y.is_log) {
                trace.isolated_points.extend(last.take().filter(|p| !joined && inside(p)));
                continue;
            }
            let p = Point::new(x.fraction(a) * size.x, (1.0 - y.fraction(b)) * size.y);
            joined = last.is_some();
            if let Some(last) = last {
                trace.push_segment(last, p, size);
            }
            trace.points.extend(Some(p).filter(inside));
            last = Some(p);
        }
        trace.isolated_points.extend(last.filter(|p| !joined && inside(p)));
        trace
    }

    /// Goes on straight, as far as that is in the frame.
    fn push_segment(&mut self, from: Point, to: Point, size: Vector) {
        let Some([a, b]) = clip_segment(from, to, size) else { return };
        match self.runs.last_mut() {
            Some(run) if run.last() == Some(&a) => run.push(b),
            _ => self.runs.push(vec![a, b]),
        }
    }

    /// Where it ends, furthest to the right of its last points.
    pub fn end_point(&self) -> Option<Point> {
        let run = self.runs.last().and_then(|run| run.last()).copied();
        [run, self.isolated_points.last().copied()].into_iter().flatten().max_by(|a, b| a.x.total_cmp(&b.x))
    }
}

/// The part of a segment that is in the frame (Liang and Barsky 1984); none where that is nothing.
fn clip_segment(a: Point, b: Point, size: Vector) -> Option<[Point; 2]> {
    let along = b - a;
    let (mut from, mut to) = (0.0, 1.0);
    for (rate, room) in [(-along.x, a.x), (along.x, size.x - a.x), (-along.y, a.y), (along.y, size.y - a.y)] {
        // A point on the edge is within, whatever its last bit says.
        let room = if room.abs() < 1e-9 { 0.0 } else { room };
        if rate == 0.0 && room < 0.0 {
            return None;
        }
        if rate < 0.0 {
            from = f64::max(from, room / rate);
        } else if rate > 0.0 {
            to = f64::min(to, room / rate);
        }
    }
    let at = |part: f64| match part {
        0.0 => a,
        1.0 => b,
        part => a + along * part,
    };
    (from <= to).then(|| [at(from), at(to)])
}

/// How a line is told from others: by colour, weight, dashes and marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LineStyle {
    pub ink: Color,
    /// Its weight in millimetres.
    width: f64,
    /// Its dashes and gaps in turn, in millimetres; none where it is unbroken.
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

impl LineStyle {
    /// That of the k-th line, from 0: those of one ink, five of them, differ in dashes and in marks.
    pub fn for_index(k: usize, theme: &Theme) -> LineStyle {
        const DASHES: [&[f64]; 5] = [&[], &[3.0, 1.2], &[1.0, 1.0], &[5.0, 1.0, 1.0, 1.0], &[7.0, 1.6]];
        const MARKS: [Mark; 5] = [Mark::Disc, Mark::Ring, Mark::Square, Mark::Diamond, Mark::Triangle];
        let inks = theme.curve_inks.len();
        let (ink, round) = (k % inks, k / inks);
        let weight = 1.2 * theme.curve_stroke(k).width;
        LineStyle {
            ink: theme.curve_ink(k),
            width: weight,
            dashes: DASHES[(ink + round) % 5],
            mark: MARKS[(ink + 2 * round) % 5],
        }
    }

    /// A line through some runs: where it is dashed, with a light one under it that leads over the gaps.
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

/// A polyline cut to dashes; it begins with one.
fn split_into_dashes(run: &[Point], pattern: &[f64], scale: f64) -> Vec<Polyline> {
    let mut out: Vec<Polyline> = Vec::new();
    let (mut k, mut left) = (0, pattern[0] * scale);
    let mut dash: Vec<Point> = run.first().copied().into_iter().collect();
    for pair in run.windows(2) {
        let mut at = pair[0];
        loop {
            let rest = pair[1] - at;
            let length = rest.norm();
            if length < left {
                left -= length;
                break;
            }
            at += rest * (left / length);
            if k % 2 == 0 {
                dash.push(at);
                out.push(Polyline { points: std::mem::take(&mut dash), is_closed: false });
            } else {
                dash.push(at);
            }
            k = (k + 1) % pattern.len();
            left = pattern[k] * scale;
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
        let wish = ScaleOptions {
            is_log,
            is_in_degrees: false,
            range: Some([low, high]),
            ends: RangeEnds::Round,
            target_ticks: 5,
        };
        Scale::from_values([low].into_iter(), &wish).unwrap()
    }

    #[test]
    fn a_line_has_gaps_and_stays_in_its_frame() {
        let (x, y) = (scale(0.0, 10.0, false), scale(0.0, 1.0, false));
        let size = Vector::new(100.0, 50.0);
        let points =
            [(0.0, 0.0), (2.0, 1.0), (3.0, f64::NAN), (4.0, 0.5), (5.0, f64::INFINITY), (6.0, 0.5), (7.0, 2.0)];
        let trace = ClippedLine::from_points(points.into_iter(), (&x, &y), size);
        assert_eq!(trace.runs.len(), 2);
        assert_eq!(trace.runs[0], [Point::new(0.0, 50.0), Point::new(20.0, 0.0)]);
        // It leaves the frame a third of the way up from 0.5 to 2.
        assert!((trace.runs[1][1] - Point::new(60.0 + 10.0 / 3.0, 0.0)).norm() < 1e-12);
        assert_eq!(trace.isolated_points, [Point::new(40.0, 25.0)]);
        assert_eq!(trace.points.len(), 4);
    }

    #[test]
    fn a_logarithmic_axis_has_no_place_for_zero() {
        let (x, y) = (scale(0.0, 2.0, false), scale(0.01, 1.0, true));
        let size = Vector::new(20.0, 20.0);
        let trace = ClippedLine::from_points(
            [(0.0, 0.1), (1.0, 0.0), (2.0, -1.0), (2.0, f64::NAN)].into_iter(),
            (&x, &y),
            size,
        );
        assert_eq!((trace.nonpositive_count, trace.isolated_points.len(), trace.runs.len()), (2, 1, 0));
        assert!((trace.isolated_points[0].y - 10.0).abs() < 1e-9);
    }

    #[test]
    fn dashes_lie_on_the_line_and_fill_their_part_of_it() {
        let run: Vec<Point> = (0..=40).map(|k| Point::new(f64::from(k), f64::from(k % 2) * 0.5)).collect();
        let length: f64 = run.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let dashes = split_into_dashes(&run, &[3.0, 1.0], 1.0);
        let drawn: f64 =
            dashes.iter().flat_map(|dash| dash.points.windows(2)).map(|pair| (pair[1] - pair[0]).norm()).sum();
        // All but a part of one period is whole periods.
        assert!((drawn - 0.75 * length).abs() < 1.0, "{drawn} of {length}");
        assert_eq!(dashes.len(), (length / 4.0).ceil() as usize);
    }

    #[test]
    fn twenty_five_lines_differ() {
        let theme = Theme::default().for_paper(super::super::super::Paper::NAMED[1].1);
        let manners: Vec<LineStyle> = (0..25).map(|k| LineStyle::for_index(k, &theme)).collect();
        for (k, a) in manners.iter().enumerate() {
            for b in &manners[..k] {
                assert!(a != b && (a.ink != b.ink || (a.dashes != b.dashes && a.mark != b.mark)), "{a:?} {b:?}");
            }
        }
    }
}
