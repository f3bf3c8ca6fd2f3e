use std::borrow::Cow;

use super::remez::exchange_point;
use super::strip::min_max;
use crate::geometry::{Point, cross, left_normal};

/// The golden section.
pub(super) const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;

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

/// The points that the circles of an annulus go through by turns: for another row much like the last they are a good
/// guess.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AlternatingPoints {
    free: Option<[usize; 4]>,
    bounded: Option<[usize; 3]>,
}

impl AlternatingPoints {
    /// The narrowest annulus of a row of at least four points, which lie on an arc of a circle or nearly so.
    ///
    /// Its circles go through four of the points by turns, outer and inner (de la Vallée Poussin): of any four the ring is
    /// no wider than that of all, and four are exchanged for others until it is no narrower. Given up as soon as it must be
    /// wider than `most`, and done as soon as it is known to be no wider. `None` where there is no such circle.
    fn narrowest_annulus(&mut self, points: &[Point], most: f64) -> Option<Annulus> {
        if let Some(four) = &mut self.free
            && let Some(ring) = narrowest_by_exchange(points, four, most, Annulus::through_alternating)
        {
            return Some(ring);
        }
        let (four, ring) = initial_points(points)?;
        let four = self.free.insert(four);
        if ring.width > most {
            return None;
        }
        if most.is_finite() {
            improve_by_subset(points, four, most);
        }
        narrowest_by_exchange(points, four, most, Annulus::through_alternating)
    }

    /// The narrowest annulus of a row of points whose radius is no more than `largest`; as [`AlternatingPoints::narrowest_annulus`] otherwise.
    pub fn narrowest_annulus_within(&mut self, points: &[Point], most: f64, largest: f64) -> Option<Annulus> {
        let free = self.narrowest_annulus(points, most)?;
        if free.radius <= largest {
            return Some(free);
        }
        // The row is flatter than the largest circle, which touches it best somewhere between its ends. About a point in
        // the middle the centre is turned to where the ring is narrowest: three points tell.
        let middle = points[points.len() / 2];
        let points = &*sorted_along(points);
        let last = points.len() - 1;
        let is_left = cross(points[last] - points[0], free.centre - middle) >= 0.0;
        let through = |[a, b, c]: [Point; 3]| {
            // As far from the middle as it may be, and as far from the first as from the third.
            let along = (c - a).try_normalize(0.0)?;
            let normal = if is_left { left_normal(along) } else { -left_normal(along) };
            let rest = along.dot(&(nalgebra::center(&a, &c) - middle));
            let centre = middle + along * rest + normal * (largest * largest - rest * rest).max(0.0).sqrt();
            Some(Annulus::with_centre(centre, [a, b]))
        };
        narrowest_by_exchange(points, self.bounded.get_or_insert([0, last / 2, last]), most, through)
    }
}

/// The points of a nearly straight row in the order in which they lie along it, should it go there and back.
fn sorted_along(points: &[Point]) -> Cow<'_, [Point]> {
    let along = points[points.len() - 1] - points[0];
    let reach = along.norm_squared();
    let [low, high] = min_max(points, |p| along.dot(&(p - points[0])));
    if low >= -1e-3 * reach && high <= 1.001 * reach {
        return points.into();
    }
    let square = |p: &Point| (p - points[0]).norm_squared();
    let furthest = points.iter().copied().reduce(|far, p| if square(&p) > square(&far) { p } else { far });
    let along = furthest.unwrap_or(points[0]) - points[0];
    let mut row = points.to_vec();
    row.sort_by(|a, b| along.dot(&a.coords).total_cmp(&along.dot(&b.coords)));
    row.into()
}

/// Four points of a row where those of a narrow annulus may be, and the one through them.
fn initial_points(points: &[Point]) -> Option<([usize; 4], Annulus)> {
    let last = points.len().checked_sub(1)?;
    // Where a polynomial of the third degree has its extremes: the first guess is good. Of a row that goes nearly round
    // the ends are nearly one point, and tell the less.
    let [near, far] = [last, last / 2].map(|k| (points[k] - points[0]).norm_squared());
    let four = if near < far / 4.0 { [1, 3, 5, 7].map(|k| k * last / 8) } else { [0, last / 4, last - last / 4, last] };
    let through = |four: [usize; 4]| Some((four, Annulus::through_alternating(four.map(|k| points[k]))?));
    // A row that goes there and back on one arc has pairs of points in one place.
    through(four).or_else(|| through([1, 6, 11, 17].map(|k| k * last / 20)))
}

/// Exchanges four points of a long row for better ones, of a few of its points only.
fn improve_by_subset(points: &[Point], four: &mut [usize; 4], most: f64) {
    const FEW: usize = 16;
    let last = points.len() - 1;
    if last < 2 * FEW {
        return;
    }
    let few: [Point; FEW + 1] = std::array::from_fn(|k| points[k * last / FEW]);
    let mut among = four.map(|k| k * FEW / last);
    narrowest_by_exchange(&few, &mut among, most, Annulus::through_alternating);
    if Annulus::through_alternating(among.map(|k| few[k])).is_some() {
        *four = among.map(|k| k * last / FEW);
    }
}

impl Annulus {
    /// The circles through the first and third of four points, and through the second and fourth.
    fn through_alternating([a, b, c, d]: [Point; 4]) -> Option<Annulus> {
        // The centre is as far from the one as from the other of each pair.
        let [u, v] = [c - a, d - b];
        let by = [(c - a).dot(&(c + a.coords).coords) / 2.0, (d - b).dot(&(d + b.coords).coords) / 2.0];
        let turn = cross(u, v);
        let centre = Point::new((by[0] * v.y - by[1] * u.y) / turn, (u.x * by[1] - v.x * by[0]) / turn);
        let ring = Annulus::with_centre(centre, [a, b]);
        ring.radius.is_finite().then_some(ring)
    }

    /// The circles about a centre that hold some points between them.
    pub fn enclosing(centre: Point, points: &[Point]) -> Annulus {
        let [low, high] = min_max(points, |p| (p - centre).norm_squared()).map(f64::sqrt);
        Annulus { centre, radius: (low + high) / 2.0, width: high - low }
    }

    /// The circles about a centre through two points.
    fn with_centre(centre: Point, through: [Point; 2]) -> Annulus {
        let [a, b] = through.map(|p| (p - centre).norm());
        Annulus { centre, radius: (a + b) / 2.0, width: (a - b).abs() }
    }
}

/// The narrowest annulus of a row of points, by some of them that are by turns on its two circles, which go `through`
/// those; given up and done with as [`AlternatingPoints::narrowest_annulus`] says. The points are those of the narrowest afterwards.
fn narrowest_by_exchange<const N: usize>(
    points: &[Point],
    turns: &mut [usize; N],
    most: f64,
    through: impl Fn([Point; N]) -> Option<Annulus>,
) -> Option<Annulus> {
    const ROUNDS: usize = 24;
    let of = |turns: [usize; N]| through(turns.map(|k| points[k]));
    let mut best: Option<Annulus> = None;
    let mut ring = of(*turns)?;
    for _ in 0..ROUNDS {
        if ring.width > most {
            return None;
        }
        let square = |p: &Point| (p - ring.centre).norm_squared();
        let squares = min_max(points, square);
        let [low, high] = squares.map(f64::sqrt);
        let found = Annulus { radius: (low + high) / 2.0, width: high - low, ..ring };
        if best.is_none_or(|best| found.width < best.width) {
            best = Some(found);
        }
        if found.width <= ring.width * (1.0 + 1e-9) || (most.is_finite() && found.width <= most) {
            break;
        }
        let is_inside = ring.radius - low > high - ring.radius;
        let outermost = squares[usize::from(!is_inside)];
        let Some(new) = points.iter().position(|p| square(p) == outermost) else { break };
        if turns.contains(&new) {
            break;
        }
        let own = turns.map(|k| (points[k] - ring.centre).norm() < ring.radius);
        let next = exchange_point(*turns, new, |k| own[k] == is_inside);
        let wider = of(next).filter(|next| next.width > ring.width).map(|ring| (ring, next));
        // On a long arc it may be another that goes: one that lies within the ring of the rest.
        let other = || {
            let each = (0..N).filter_map(|gone| Some((of(with_replaced(*turns, gone, new))?, gone)));
            let fits =
                |ring: &Annulus, p: Point| ((p - ring.centre).norm() - ring.radius).abs() <= ring.width * (0.5 + 1e-9);
            let fitting = each.filter(|(ring, gone)| fits(ring, points[turns[*gone]]));
            let (ring, gone) = fitting.min_by(|a, b| a.0.width.total_cmp(&b.0.width))?;
            Some((ring, with_replaced(*turns, gone, new)))
        };
        let Some(next) = wider.or_else(other) else { break };
        (ring, *turns) = next;
    }
    best.filter(|best| best.width <= most)
}

/// Places in order, with another for one of them.
fn with_replaced<const N: usize>(mut turns: [usize; N], gone: usize, new: usize) -> [usize; N] {
    turns[gone] = new;
    turns.sort_unstable();
    turns
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
        let ring = AlternatingPoints::default().narrowest_annulus(&points, f64::INFINITY).expect("a ring");
        assert!((ring.width - 0.02).abs() < 1e-9 && (ring.radius - 2.0).abs() < 1e-9, "{ring:?}");
        assert!((ring.centre - Point::new(5.0, 1.0)).norm() < 1e-9, "{ring:?}");
        assert!(AlternatingPoints::default().narrowest_annulus(&points, 0.019).is_none());
        assert!(AlternatingPoints::default().narrowest_annulus(&points, 0.021).is_some_and(|ring| ring.width <= 0.021));
    }
}
