use super::{Place, SmoothCurve};
use crate::geometry::{Chebyshev, Point, TERMS, Vector};
use crate::measure::budget::MAX_PARTS;

/// The length of a curve as a function of the place on it.
#[derive(Clone, Debug)]
pub struct ArcLength {
    spans: Vec<LengthSpan>,
    total: f64,
    /// Whether it would need more spans than it may have.
    is_cut_short: bool,
}

/// A part of a piece on which the speed is a polynomial, to rounding.
#[derive(Clone, Debug)]
struct LengthSpan {
    piece: usize,
    from: f64,
    to: f64,
    /// The length from the beginning of the curve to that of the span.
    before: f64,
    /// The length from the beginning of the span.
    length: Chebyshev,
}

/// What is lacking of the speed on a span, and the length of a span that is not divided further, relative to the
/// length of the pieces.
const ACCURACY: f64 = 1e-13;

impl ArcLength {
    /// Integrates the speed of a curve. Where it is not smooth, near a point at which the curve nearly stops, a piece is
    /// halved until the rest is too short to matter.
    pub fn measure(curve: &SmoothCurve) -> ArcLength {
        let mut out = ArcLength { spans: Vec::with_capacity(curve.arcs.len()), total: 0.0, is_cut_short: false };
        let scale: f64 = curve.arcs.iter().map(|arc| 2.0 * (arc.velocity[0].bound() + arc.velocity[1].bound())).sum();
        for (piece, arc) in curve.arcs.iter().enumerate() {
            out.integrate(&arc.velocity, piece, -1.0, 1.0, ACCURACY * scale);
        }
        out
    }

    fn integrate(&mut self, velocity: &[Chebyshev; 2], piece: usize, from: f64, to: f64, accuracy: f64) {
        let [x, y] = velocity.each_ref().map(Chebyshev::values);
        let speeds = std::array::from_fn(|j| (x[j] * x[j] + y[j] * y[j]).sqrt());
        let half = (to - from) / 2.0;
        let speed = Chebyshev::from_values(&speeds);
        // A point between an end and the node next to it at which the curve stops is seen by no node.
        let missed = [
            (speed.at_start(), velocity.each_ref().map(Chebyshev::at_start)),
            (speed.at_end(), velocity.each_ref().map(Chebyshev::at_end)),
        ]
        .map(|(speed, [x, y])| (speed - (x * x + y * y).sqrt()).abs());
        let beyond_nodes = 1.0 - Chebyshev::nodes()[TERMS - 1];
        let lacking = Chebyshev::tail_of(&speeds).max(beyond_nodes * missed[0].max(missed[1]));
        let is_smooth = lacking * half <= accuracy;
        let is_short = half * (velocity[0].bound() + velocity[1].bound()) <= accuracy;
        let is_cut_short = !is_smooth && !is_short && self.spans.len() >= MAX_PARTS;
        self.is_cut_short |= is_cut_short;
        if is_smooth || is_short || is_cut_short {
            let mut length = speed.integral();
            length.0.iter_mut().for_each(|c| *c *= half);
            self.spans.push(LengthSpan { piece, from, to, before: self.total, length });
            self.total += speed.total() * half;
            return;
        }
        let [[x0, x1], [y0, y1]] = velocity.each_ref().map(Chebyshev::halves);
        let middle = (from + to) / 2.0;
        self.integrate(&[x0, y0], piece, from, middle, accuracy);
        self.integrate(&[x1, y1], piece, middle, to, accuracy);
    }

    /// Whether it is known. A curve that would have to be divided into more than [`MAX_PARTS`] parts has no length, and its
    /// places have lengths that are not exact.
    pub fn is_known(&self) -> bool {
        !self.is_cut_short
    }

    /// The length of the whole curve.
    pub fn total(&self) -> f64 {
        self.total
    }

    /// The mean over the length of a curve, of which this is the length, of a function of its points.
    pub fn mean(&self, curve: &SmoothCurve, function: impl Fn(Point) -> Vector) -> Vector {
        let nodes = Chebyshev::nodes();
        let integral = |span: &LengthSpan| {
            let place = |u: f64| Place { piece: span.piece, u: span.from + (span.to - span.from) * (u + 1.0) / 2.0 };
            let speeds = span.length.derivative().values();
            let values: [Vector; TERMS] = std::array::from_fn(|j| function(curve.point(place(nodes[j]))) * speeds[j]);
            let total = |axis: usize| Chebyshev::from_values(&values.map(|value| value[axis])).total();
            Vector::new(total(0), total(1))
        };
        self.spans.iter().map(integral).sum::<Vector>() / self.total
    }

    /// The length from the beginning to a place.
    pub fn at(&self, place: Place) -> f64 {
        let is_before =
            |span: &LengthSpan| span.piece < place.piece || (span.piece == place.piece && span.to < place.u);
        let k = self.spans.partition_point(is_before).min(self.spans.len() - 1);
        let span = &self.spans[k];
        if place.u <= span.from {
            // Exactly: the length from the beginning to itself is 0.
            return span.before;
        }
        span.before + span.length.at(2.0 * (place.u - span.from) / (span.to - span.from) - 1.0)
    }
}
