use crate::geometry::{Point, Vector, cross};

/// The golden section.
pub(super) const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The narrowest ring between two circles about one centre that holds a row of points, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Annulus {
    /// The centre of both circles.
    pub centre: Point,
    /// The radius halfway between them.
    pub radius: f64,
    /// How far they are apart.
    pub width: f64,
}

impl Annulus {
    /// The narrowest annulus of a row of at least four points, which lie on an arc of a circle or nearly so.
    ///
    /// Its circles go through four of the points by turns, outer and inner (de la Vallée Poussin): of any four the ring is
    /// no wider than that of all, and four are exchanged for others until it is no narrower. Given up as soon as it must be
    /// wider than `most`, and done as soon as it is known to be no wider. `None` where there is no such circle.
    pub fn of(points: &[Point], most: f64) -> Option<Annulus> {
        const ROUNDS: usize = 12;
        let last = points.len().checked_sub(1)?;
        // Where a polynomial of the third degree has its extremes: the first guess is good. Of a row that goes nearly round
        // the ends are nearly one point, and tell the less.
        let [near, far] = [last, last / 2].map(|k| (points[k] - points[0]).norm_squared());
        let goes_round = near < far / 4.0;
        let mut four =
            if goes_round { [1, 3, 5, 7].map(|k| k * last / 8) } else { [0, last / 4, last - last / 4, last] };
        // A row that goes there and back on one arc has pairs of points in one place.
        if Annulus::through(four.map(|k| points[k])).is_none() {
            four = [1, 6, 11, 17].map(|k| k * last / 20);
        }
        let mut best: Option<Annulus> = None;
        for _ in 0..ROUNDS {
            let ring = Annulus::through(four.map(|k| points[k]))?;
            if ring.width > most {
                return None;
            }
            let [(low, at_low), (high, at_high)] = ring.extremes(points);
            let found = Annulus { radius: ring.radius + (low + high) / 2.0, width: high - low, ..ring };
            if best.is_none_or(|best| found.width < best.width) {
                best = Some(found);
            }
            let is_done = found.width <= ring.width * (1.0 + 1e-9) || (most.is_finite() && found.width <= most);
            let outermost = if -low > high { at_low } else { at_high };
            if is_done || four.contains(&outermost) {
                break;
            }
            four = exchanged(four, outermost, |k| (points[k] - ring.centre).norm() > ring.radius);
        }
        best.filter(|best| best.width <= most)
    }

    /// The narrowest annulus of a row of points whose radius is no more than `largest`; as [`Annulus::of`] otherwise.
    pub fn within(points: &[Point], most: f64, largest: f64) -> Option<Annulus> {
        let free = Annulus::of(points, most)?;
        if free.radius <= largest {
            return Some(free);
        }
        // The row is flatter than the largest circle, which touches it best somewhere between its ends. About a point in
        // the middle the centre is turned to where the ring is narrowest.
        let (middle, chord) = (points[points.len() / 2], points[points.len() - 1] - points[0]);
        let side = if cross(chord, free.centre - middle) < 0.0 { -1.0 } else { 1.0 };
        let arm = Vector::new(-chord.y, chord.x).try_normalize(0.0)? * (side * largest);
        let turned = |slope: f64| {
            let centre = middle + (arm + Vector::new(-arm.y, arm.x) * slope) / (1.0 + slope * slope).sqrt();
            let ring = Annulus { centre, radius: largest, width: 0.0 };
            let [(low, _), (high, _)] = ring.extremes(points);
            Annulus { width: high - low, ..ring }
        };
        let straight = turned(0.0);
        if most.is_finite() && straight.width <= most {
            return Some(straight);
        }
        // The ends go as far with it as it is wide, at most. To half a hundredth of that, by golden sections.
        let reach = 2.0 * straight.width / chord.norm();
        let [mut low, mut high] = [-reach, reach];
        let [mut a, mut b] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let [mut at_a, mut at_b] = [turned(a).width, turned(b).width];
        for _ in 0..12 {
            if at_a < at_b {
                (high, b, at_b) = (b, a, at_a);
                a = high - GOLDEN * (high - low);
                at_a = turned(a).width;
            } else {
                (low, a, at_a) = (a, b, at_b);
                b = low + GOLDEN * (high - low);
                at_b = turned(b).width;
            }
        }
        Some(turned((low + high) / 2.0)).filter(|ring| ring.width <= most)
    }

    /// The circles through the first and third of four points, and through the second and fourth.
    fn through([a, b, c, d]: [Point; 4]) -> Option<Annulus> {
        // The centre is as far from the one as from the other of each pair.
        let [u, v] = [c - a, d - b];
        let by = [(c - a).dot(&(c + a.coords).coords) / 2.0, (d - b).dot(&(d + b.coords).coords) / 2.0];
        let turn = cross(u, v);
        let centre = Point::new((by[0] * v.y - by[1] * u.y) / turn, (u.x * by[1] - v.x * by[0]) / turn);
        let [outer, inner] = [a, b].map(|p| (p - centre).norm());
        let ring = Annulus { centre, radius: (outer + inner) / 2.0, width: (outer - inner).abs() };
        ring.radius.is_finite().then_some(ring)
    }

    /// How far the innermost and the outermost point are from the circle halfway, and which they are.
    fn extremes(&self, points: &[Point]) -> [(f64, usize); 2] {
        let mut found = [(f64::INFINITY, 0), (f64::NEG_INFINITY, 0)];
        for (k, p) in points.iter().enumerate() {
            let by: Vector = p - self.centre;
            let far = by.norm() - self.radius;
            if far < found[0].0 {
                found[0] = (far, k);
            }
            if far > found[1].0 {
                found[1] = (far, k);
            }
        }
        found
    }
}

/// Four points by turns outside and inside with one of them exchanged for another point.
fn exchanged(four: [usize; 4], new: usize, is_outside: impl Fn(usize) -> bool) -> [usize; 4] {
    let [a, b, c, d] = four;
    let is_like = |k: usize| is_outside(four[k]) == is_outside(new);
    match four.iter().filter(|&&k| k < new).count() {
        0 if is_like(0) => [new, b, c, d],
        0 => [new, a, b, c],
        1 if is_like(0) => [new, b, c, d],
        1 => [a, new, c, d],
        2 if is_like(1) => [a, new, c, d],
        2 => [a, b, new, d],
        3 if is_like(2) => [a, b, new, d],
        3 => [a, b, c, new],
        _ if is_like(3) => [a, b, c, new],
        _ => [b, c, d, new],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::trig;

    /// Points at radius 2 + 0.01 cos(3 t) over t from 0 to 3 / pi: the cosine has four extremes there, by turns.
    #[test]
    fn a_wave_of_four_extremes_is_as_wide_as_its_waves() {
        let point = |k: i32| {
            let t = std::f64::consts::PI * f64::from(k) / 300.0;
            let r = 2.0 + 0.01 * trig::cos(3.0 * t);
            Point::new(5.0 + r * trig::cos(t), 1.0 + r * trig::sin(t))
        };
        let points: Vec<Point> = (0..=300).map(point).collect();
        let ring = Annulus::of(&points, f64::INFINITY).expect("a ring");
        assert!((ring.width - 0.02).abs() < 1e-9 && (ring.radius - 2.0).abs() < 1e-9, "{ring:?}");
        assert!((ring.centre - Point::new(5.0, 1.0)).norm() < 1e-9, "{ring:?}");
        assert!(Annulus::of(&points, 0.019).is_none());
        assert!(Annulus::of(&points, 0.021).is_some_and(|ring| ring.width <= 0.021));
    }
}
