use super::{Place, SmoothCurve};
use crate::geometry::{Point, in_rising_order};
use crate::measure::portion::convex_hull;

impl SmoothCurve {
    /// The greatest distance of two points of the curve; 0 for a curve without pieces.
    ///
    /// A polygon through a few points of each piece shows which pairs may be furthest; from each such pair one point
    /// after the other is moved to where it is furthest from the other.
    pub fn extent(&self) -> f64 {
        const PARTS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];
        /// Of nearly a circle all pairs may be furthest; any few are, to a small part of the slack.
        const MAX_PAIRS: usize = 16;
        let places = (0..self.arcs.len()).flat_map(|piece| PARTS.map(|u| Place { piece, u }));
        let places: Vec<Place> = places.collect();
        let points = self.points(&places);
        let hull: Vec<(Point, Place)> = convex_hull(&points).into_iter().map(|k| (points[k], places[k])).collect();
        // No point of the curve is further outside the polygon than a piece bends between its points.
        let bend = |k: usize| {
            let [x, y] = self.arcs[k].position.each_ref().map(|series| series.derivative().derivative().bound());
            (x * x + y * y).sqrt() / 32.0
        };
        let slack = 2.0 * (0..self.arcs.len()).map(bend).fold(0.0, f64::max);
        let count = hull.len();
        let square = |i: usize, j: usize| (hull[i % count].0 - hull[j % count].0).norm_squared();
        let from =
            |i: usize| hull[i + 1..].iter().map(|(other, _)| (other - hull[i].0).norm_squared()).fold(0.0, f64::max);
        let mut best = (0..count).map(from).fold(0.0, f64::max).sqrt();
        let least = (best - slack).max(0.0);
        let least = least * least;
        // Pairs that are further apart than those of their neighbours.
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for i in 0..count {
            for j in i + 1..count {
                let own = (hull[i].0 - hull[j].0).norm_squared();
                let neighbours = [(i + 1, j), (i + count - 1, j), (i, j + 1), (i, j + count - 1)];
                if own >= least && neighbours.iter().all(|&(i, j)| square(i, j) <= own) {
                    pairs.push((own, i, j));
                }
            }
        }
        let mut furthest: Option<[Place; 2]> = None;
        for (_, i, j) in in_rising_order(pairs, |pair| -pair.0).into_iter().take(MAX_PAIRS) {
            let (places, distance) = self.furthest_pair_near([hull[i].1, hull[j].1]);
            if furthest.is_none() || distance > best {
                (furthest, best) = (Some(places), best.max(distance));
            }
        }
        // A tip between two of the few points, or from where Newton's method leads elsewhere: the points that are furthest along the
        // line of both are no closer.
        for _ in 0..MAX_PAIRS {
            let Some(direction) = furthest.and_then(|places| {
                let [p, q] = places.map(|place| self.point(place));
                (p - q).try_normalize(0.0)
            }) else {
                break;
            };
            let (Some((_, p)), Some((_, q))) = (self.furthest(direction), self.furthest(-direction)) else { break };
            let (places, distance) = self.furthest_pair_near([p, q]);
            if distance <= best * (1.0 + 1e-15) {
                break;
            }
            (furthest, best) = (Some(places), distance);
        }
        best
    }

    /// The furthest pair of points near one, and their distance, by Newton's method for both.
    fn furthest_pair_near(&self, mut places: [Place; 2]) -> ([Place; 2], f64) {
        const ROUNDS: usize = 12;
        let distance = |places: [Place; 2]| (self.point(places[0]) - self.point(places[1])).norm();
        let mut most = distance(places);
        for _ in 0..ROUNDS {
            let [(p, [v, a]), (q, [w, b])] = places.map(|place| self.arcs[place.piece].point_and_rates(place.u));
            let gap = p - q;
            // The gradient of half the squared distance and its second derivatives.
            let (f, g) = (gap.dot(&v), -gap.dot(&w));
            let (fu, fw, gw) = (v.norm_squared() + gap.dot(&a), -v.dot(&w), w.norm_squared() - gap.dot(&b));
            let det = fu * gw - fw * fw;
            let steps = [(fw * g - gw * f) / det, (fw * f - fu * g) / det];
            if !(det > 0.0 && fu < 0.0) || steps.iter().any(|step| !step.is_finite()) {
                break;
            }
            let next = [0, 1].map(|k| self.moved(places[k], steps[k]));
            let further = distance(next);
            if further <= most * (1.0 + 1e-15) {
                return if further > most { (next, further) } else { (places, most) };
            }
            (places, most) = (next, further);
        }
        (places, most)
    }

    /// The place at a parameter further along, on a neighbouring piece if it is beyond the end.
    fn moved(&self, place: Place, by: f64) -> Place {
        let count = self.arcs.len();
        let u = place.u + by;
        let neighbour = |piece: usize, beyond: f64, end: f64| {
            let speed = |piece: usize, u: f64| self.arcs[piece].velocity(u).norm();
            let scale = speed(place.piece, end) / speed(piece, -end);
            let u = -end + if scale.is_finite() { (beyond * scale).clamp(-1.0, 1.0) } else { 0.0 };
            Place { piece, u: u.clamp(-1.0, 1.0) }
        };
        match () {
            () if u > 1.0 && (self.is_closed || place.piece + 1 < count) => {
                neighbour((place.piece + 1) % count, u - 1.0, 1.0)
            }
            () if u < -1.0 && (self.is_closed || place.piece > 0) => {
                neighbour((place.piece + count - 1) % count, u + 1.0, -1.0)
            }
            () => Place { u: u.clamp(-1.0, 1.0), ..place },
        }
    }
}
