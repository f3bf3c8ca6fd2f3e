//! The distance of a point of a page from a curve, found by solving the linkage.

use coupler_curves::geometry::{Point, Similarity, distance_to_segment};
use coupler_curves::linkage::{Input, JointId, Linkage};
use coupler_curves::motion::{Circuit, eased_input, poses};

/// The curve of a joint on a circuit, solved wherever its distance from a point is to be known.
#[derive(Debug)]
pub struct SolvedCurve<'a> {
    linkage: &'a Linkage,
    circuit: &'a Circuit,
    joint: JointId,
    page_from_plane: Similarity,
    /// Below this size, in millimetres, arcs are not divided.
    resolution: f64,
    /// The curve in arcs, from its beginning to its end.
    arcs: Vec<Arc>,
}

/// A part of the curve on one pass.
#[derive(Clone, Copy, Debug)]
struct Arc {
    /// The index of the pass.
    pass: usize,
    /// The fractions of the pass at its ends, as those of [`eased_input`].
    fractions: [f64; 2],
    /// Its beginning, its middle and its end, in millimetres of the page.
    points: [Point; 3],
}

impl<'a> SolvedCurve<'a> {
    /// The curve of `joint` on a circuit of a linkage, as drawn with the transform `page_from_plane`.
    pub fn new(
        linkage: &'a Linkage,
        circuit: &'a Circuit,
        joint: JointId,
        page_from_plane: Similarity,
    ) -> SolvedCurve<'a> {
        /// The distance is exact to this, in millimetres, or to the rounding of the positions if that is more.
        const RESOLUTION_MM: f64 = 1e-4;
        let mut curve = SolvedCurve { linkage, circuit, joint, page_from_plane, resolution: 0.0, arcs: Vec::new() };
        curve.resolution = RESOLUTION_MM.max(curve.rounding_mm());
        curve.arcs = (0..circuit.passes.len()).flat_map(|pass| curve.pass_arcs(pass)).collect();
        curve
    }

    /// The rounding of its positions, in millimetres of the page. It is relative to the size of the linkage, and so is
    /// visible on a curve that is far smaller than its linkage and drawn as large as any.
    pub fn rounding_mm(&self) -> f64 {
        /// Relative to the coordinates of the joints: more than the steps from the input to a traced joint make.
        const ROUNDING: f64 = 256.0 * f64::EPSILON;
        let coordinates = self.linkage.joint_ids().flat_map(|joint| {
            let positions = &self.circuit.positions;
            positions.x(joint).iter().chain(positions.y(joint))
        });
        let greatest = coordinates.copied().filter(|x| x.is_finite()).map(f64::abs).fold(0.0, f64::max);
        ROUNDING * greatest * self.page_from_plane.scale()
    }

    /// The arcs in which the search on a pass begins.
    fn pass_arcs(&self, pass: usize) -> Vec<Arc> {
        /// The most input that such an arc spans, in degrees of the fastest crank.
        const MAX_ARC_DEG: f64 = 6.0;
        /// The fewest arcs of a pass, and the most.
        const COUNTS: [f64; 2] = [32.0, 20_000.0];
        let turned = match self.linkage.input() {
            Input::Angle { .. } => self.circuit.passes[pass].input_length() * self.linkage.fastest_crank_ratio(),
            Input::Length => 0.0,
        };
        let count = (turned / MAX_ARC_DEG).ceil().clamp(COUNTS[0], COUNTS[1]) as usize;
        let fractions: Vec<f64> = (0..=2 * count).map(|k| k as f64 / (2 * count) as f64).collect();
        let points = self.points(pass, &fractions);
        let arc = |k: usize| Arc {
            pass,
            fractions: [fractions[2 * k], fractions[2 * k + 2]],
            points: [points[2 * k], points[2 * k + 1], points[2 * k + 2]],
        };
        (0..count).map(arc).collect()
    }

    /// The points of the curve at fractions of a pass, in millimetres of the page.
    fn points(&self, pass: usize, fractions: &[f64]) -> Vec<Point> {
        let pass = &self.circuit.passes[pass];
        let inputs: Vec<f64> = fractions.iter().map(|&fraction| eased_input(pass, fraction)).collect();
        let positions = poses(self.linkage, pass, &inputs);
        (0..inputs.len()).map(|k| self.page_from_plane.apply(positions.point(self.joint, k))).collect()
    }

    /// The distance of a point of the page from the curve, in millimetres; infinite if the curve has no finite point.
    ///
    /// The search ends as soon as the distance is known to be at most `enough`; the result is then at most `enough`,
    /// but need not be the least.
    pub fn distance(&self, point: Point, enough: f64) -> f64 {
        let mut search = Search { curve: self, point, enough, least: f64::INFINITY };
        for on_curve in self.arcs.iter().flat_map(|arc| arc.points) {
            search.include(on_curve);
        }
        let bounded = self.arcs.iter().map(|arc| (arc.least_distance(point), arc));
        let mut nearest: Vec<(f64, &Arc)> = bounded.filter(|(bound, _)| *bound < search.least).collect();
        nearest.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (bound, arc) in nearest {
            if search.ends_at(bound) {
                break;
            }
            search.divide(arc);
        }
        search.least
    }

    /// Both halves of an arc.
    fn halves(&self, arc: &Arc) -> [Arc; 2] {
        let ([from, to], [a, b, c]) = (arc.fractions, arc.points);
        let at = |share: f64| from + (to - from) * share;
        let middles = self.points(arc.pass, &[at(0.25), at(0.75)]);
        [
            Arc { pass: arc.pass, fractions: [from, at(0.5)], points: [a, middles[0], b] },
            Arc { pass: arc.pass, fractions: [at(0.5), to], points: [b, middles[1], c] },
        ]
    }
}

impl Arc {
    /// How far the arc may be from the two chords through its points.
    ///
    /// An estimate, far more than the deviation of a smooth arc, and enough for one that turns back between two of
    /// them: then its middle is not on the line of its ends, or not half-way. Infinite next to an undefined position.
    fn deviation(&self) -> f64 {
        let [a, b, c] = self.points;
        let (before, after) = ((b - a).norm(), (c - b).norm());
        let deviation = 0.1 * (before + after) + 4.0 * distance_to_segment(b, a, c) + (before - after).abs();
        if deviation.is_finite() { deviation } else { f64::INFINITY }
    }

    /// The distance of a point from the two chords; infinite if no chord is defined.
    fn distance_from_chords(&self, point: Point) -> f64 {
        let [a, b, c] = self.points;
        distance_to_segment(point, a, b).min(distance_to_segment(point, b, c))
    }

    /// A lower bound of the distance of a point from the arc; infinite for an arc without any defined position.
    fn least_distance(&self, point: Point) -> f64 {
        let is_undefined = |p: &Point| !p.x.is_finite() || !p.y.is_finite();
        if self.points.iter().all(is_undefined) {
            return f64::INFINITY;
        }
        // A distance that is NaN counts as 0.
        (self.distance_from_chords(point) - self.deviation()).max(0.0)
    }
}

/// A search for the least distance of a point from a curve.
struct Search<'a> {
    curve: &'a SolvedCurve<'a>,
    point: Point,
    enough: f64,
    /// The least distance found.
    least: f64,
}

impl Search<'_> {
    /// Whether no arc with this lower bound of its distance has to be searched.
    fn ends_at(&self, bound: f64) -> bool {
        self.least <= self.enough || bound >= self.least
    }

    fn include(&mut self, on_curve: Point) {
        // The distance of an undefined position is NaN, and ignored.
        self.least = self.least.min((on_curve - self.point).norm());
    }

    /// Searches an arc, the nearer half first.
    fn divide(&mut self, arc: &Arc) {
        self.include(arc.points[1]);
        let [from, to] = arc.fractions;
        if arc.deviation() <= self.curve.resolution {
            self.least = self.least.min(arc.distance_from_chords(self.point));
            return;
        }
        let middle = from + (to - from) * 0.5;
        if middle <= from || middle >= to {
            return;
        }
        let mut halves = self.curve.halves(arc).map(|half| (half.least_distance(self.point), half));
        if halves[1].0 < halves[0].0 {
            halves.swap(0, 1);
        }
        for (bound, half) in &halves {
            if !self.ends_at(*bound) {
                self.divide(half);
            }
        }
    }
}
