use super::{Point, Vector};

/// A cubic Bézier curve: its start, its two control points and its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubicBezier(pub [Point; 4]);

impl CubicBezier {
    /// The point at a parameter from 0 to 1.
    pub fn point(&self, t: f64) -> Point {
        let CubicBezier([a, b, c, d]) = self;
        let s = 1.0 - t;
        let [wa, wb, wc, wd] = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        Point::from(a.coords * wa + b.coords * wb + c.coords * wc + d.coords * wd)
    }

    /// Its coefficients as a polynomial in the parameter, the constant first.
    pub fn coefficients(&self) -> [Vector; 4] {
        let [a, b, c, d] = self.0.map(|point| point.coords);
        [a, (b - a) * 3.0, (a - b * 2.0 + c) * 3.0, d - a + (b - c) * 3.0]
    }

    /// The first and the second derivative at a parameter.
    pub fn derivatives(&self, t: f64) -> [Vector; 2] {
        let CubicBezier([a, b, c, d]) = self;
        let s = 1.0 - t;
        let [ab, bc, cd] = [b - a, c - b, d - c];
        [(ab * (s * s) + bc * (2.0 * s * t) + cd * (t * t)) * 3.0, ((bc - ab) * s + (cd - bc) * t) * 6.0]
    }

    /// The number of chords, at equal steps of the parameter, that are nowhere further than `tolerance` from the curve,
    /// at most `MAX_CHORDS`; 1 if it is not finite.
    ///
    /// Between two parameters a step apart a curve is no further from its chord than an eighth of the square of the step
    /// times its greatest second derivative, which is at one of the ends.
    pub fn chord_count(&self, tolerance: f64) -> usize {
        let [[_, start], [_, end]] = [0.0, 1.0].map(|t| self.derivatives(t));
        let count = (start.norm().max(end.norm()) / (8.0 * tolerance)).sqrt().ceil();
        if count >= 1.0 { count.min(Self::MAX_CHORDS as f64) as usize } else { 1 }
    }

    /// The most chords of [`CubicBezier::chord_count`], of which no curve that fits paper needs as many.
    pub const MAX_CHORDS: usize = 1 << 20;
}

/// A segment of a [`Spline`], which begins where the one before it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplineSegment {
    /// A line to a point.
    Line(Point),
    /// A cubic Bézier curve: its two control points and its end.
    Cubic([Point; 3]),
}

impl SplineSegment {
    /// The end.
    pub fn end(&self) -> Point {
        let (SplineSegment::Line(end) | SplineSegment::Cubic([_, _, end])) = self;
        *end
    }

    /// The control points, if there are any, and the end.
    pub fn points(&self) -> &[Point] {
        match self {
            SplineSegment::Line(end) => std::slice::from_ref(end),
            SplineSegment::Cubic(points) => points,
        }
    }

    fn transform(&mut self, f: impl Fn(Point) -> Point) {
        match self {
            SplineSegment::Line(end) => *end = f(*end),
            SplineSegment::Cubic(points) => *points = points.map(f),
        }
    }
}

/// A path of lines and cubic Bézier curves, one after another.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Where it begins.
    pub start: Point,
    /// Its segments.
    pub segments: Vec<SplineSegment>,
}

impl Spline {
    /// Where it ends.
    pub fn end(&self) -> Point {
        self.segments.last().map_or(self.start, SplineSegment::end)
    }

    /// All points that define it: it lies within their convex hull.
    pub fn points(&self) -> impl Iterator<Item = Point> {
        std::iter::once(self.start).chain(self.segments.iter().flat_map(|segment| segment.points().iter().copied()))
    }

    /// Each segment, with the point at which it begins.
    pub fn segments_with_starts(&self) -> impl Iterator<Item = (Point, &SplineSegment)> {
        let starts = std::iter::once(self.start).chain(self.segments.iter().map(SplineSegment::end));
        starts.zip(&self.segments)
    }

    /// Makes the spline its image under an affine map.
    pub fn transform(&mut self, f: impl Fn(Point) -> Point) {
        self.start = f(self.start);
        self.segments.iter_mut().for_each(|segment| segment.transform(&f));
    }

    /// The image of the spline under an affine map.
    pub fn map(&self, f: impl Fn(Point) -> Point) -> Spline {
        let mut image = self.clone();
        image.transform(f);
        image
    }

    /// Points on the spline, the ends of all segments among them, whose polyline is nowhere further than `tolerance` from
    /// it.
    pub fn flatten(&self, tolerance: f64) -> Vec<Point> {
        let mut out = vec![self.start];
        for (start, segment) in self.segments_with_starts() {
            if let SplineSegment::Cubic([b, c, d]) = *segment {
                let cubic = CubicBezier([start, b, c, d]);
                let count = cubic.chord_count(tolerance);
                out.extend((1..count).map(|k| cubic.point(k as f64 / count as f64)));
            }
            out.push(segment.end());
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::distance_to_segment;

    fn point(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn a_flattened_spline_is_within_the_tolerance() {
        let cubics = [
            [point(0.0, 0.0), point(40.0, 70.0), point(-30.0, 50.0), point(10.0, -5.0)],
            [point(0.0, 0.0), point(0.0, 0.0), point(1.0, 0.0), point(3.0, 1.0)],
            [point(1.0, 1.0), point(2.0, 2.0), point(3.0, 3.0), point(4.0, 4.0)],
        ];
        for [a, b, c, d] in cubics {
            let spline = Spline { start: a, segments: vec![SplineSegment::Cubic([b, c, d])] };
            for tolerance in [1.0, 1e-2, 1e-4] {
                let line = spline.flatten(tolerance);
                assert_eq!((line[0], line[line.len() - 1]), (a, d));
                for k in 0..=1000 {
                    let on_curve = CubicBezier([a, b, c, d]).point(f64::from(k) / 1000.0);
                    let nearest = line.windows(2).map(|pair| distance_to_segment(on_curve, pair[0], pair[1]));
                    assert!(nearest.fold(f64::INFINITY, f64::min) <= tolerance, "{tolerance}");
                }
            }
        }
        // The third is straight.
        let [a, b, c, d] = cubics[2];
        assert_eq!(CubicBezier([a, b, c, d]).chord_count(1e-9), 1);
    }

    #[test]
    fn a_spline_that_is_not_finite_has_few_chords() {
        for x in [f64::NAN, f64::INFINITY, 1e300] {
            let cubic = CubicBezier([point(0.0, 0.0), point(x, 1.0), point(2.0, -x), point(3.0, 0.0)]);
            assert!(cubic.chord_count(1e-9) <= CubicBezier::MAX_CHORDS);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_points() {
        let cubic = CubicBezier([point(0.0, 0.0), point(4.0, 7.0), point(-3.0, 5.0), point(1.0, -5.0)]);
        for k in 1..10 {
            let (t, h) = (f64::from(k) / 10.0, 1e-4);
            let [before, at, after] = [t - h, t, t + h].map(|t| cubic.point(t));
            let [first, second] = cubic.derivatives(t);
            assert!((first - (after - before) / (2.0 * h)).norm() < 1e-5);
            assert!((second - ((after - at) - (at - before)) / (h * h)).norm() < 1e-4);
        }
    }
}
