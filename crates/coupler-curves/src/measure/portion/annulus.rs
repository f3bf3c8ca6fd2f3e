//! The narrowest annulus of a row of points, by the exchange of points.

use std::borrow::Cow;

use super::remez::exchange_point;
use super::strip::min_max;
use crate::geometry::{Point, Vector, cross, in_rising_order, left_normal};

/// The ring between two concentric circles.
#[derive(Clone, Copy, Debug)]
pub struct Annulus {
    /// The centre of both circles.
    pub centre: Point,
    /// The radius halfway between them.
    pub radius: f64,
    /// The difference of the radii.
    pub width: f64,
}

/// The indices of the points through which the circles of an annulus pass, alternating between outer and inner circle.
/// They are a good initial guess for a similar row of points.
#[derive(Clone, Copy, Debug, Default)]
pub struct AlternatingPoints {
    /// Whether rows may go back along themselves, so that their order is not that around the centre.
    is_folded: bool,
    free: Option<[usize; 4]>,
    bounded: Option<[usize; 3]>,
}

impl AlternatingPoints {
    /// For rows of points that may go back along themselves.
    pub fn folded(is_folded: bool) -> AlternatingPoints {
        AlternatingPoints { is_folded, ..AlternatingPoints::default() }
    }

    /// The narrowest annulus that contains a row of at least four points near an arc of a circle.
    ///
    /// Its circles pass through four of the points, alternating between outer and inner circle (de la Vallée Poussin).
    /// The annulus of any four points is no wider than that of all; points are exchanged until it is as wide. The
    /// search fails as soon as the annulus is certain to be wider than `max_width`, and ends as soon as it is known to be no
    /// wider. `None` also if there is no such circle.
    fn narrowest_annulus(&mut self, points: &[Point], max_width: f64) -> Option<Annulus> {
        if let Some(four) = &mut self.free
            && four[3] < points.len()
            && let Some(ring) = narrowest_by_exchange(points, four, max_width, Annulus::through_alternating)
        {
            return Some(ring);
        }
        let (four, ring) = initial_points(points)?;
        let four = self.free.insert(four);
        if ring.width > max_width {
            return None;
        }
        if max_width.is_finite() {
            improve_by_subset(points, four, max_width);
        }
        narrowest_by_exchange(points, four, max_width, Annulus::through_alternating)
    }

    /// Turns to a row of another number of points, whose points in the same places are likely to alternate. Whether four of
    /// them are in no annulus of a width: then the row is not.
    pub fn are_apart(&mut self, points: &[Point], before: usize, max_width: f64) -> bool {
        let (last, last_before) = (points.len() - 1, before.max(2) - 1);
        let Some(four) = &mut self.free else { return false };
        if last != last_before {
            *four = four.map(|k| (k * last + last_before / 2) / last_before);
        }
        let [a, b, c, d] = *four;
        if !(a < b && b < c && c < d && d <= last) {
            self.free = None;
            return false;
        }
        let alternating = four.map(|k| points[k]);
        Annulus::through_alternating(alternating).is_some_and(|ring| {
            ring.width > max_width && goes_one_way(&alternating, |from, to| cross(from - ring.centre, to - ring.centre))
        })
    }

    /// The narrowest annulus with a radius of at most `largest` that contains a row of points; otherwise like
    /// [`AlternatingPoints::narrowest_annulus`].
    pub fn narrowest_annulus_within(&mut self, points: &[Point], max_width: f64, largest: f64) -> Option<Annulus> {
        let around = if self.is_folded { sorted_around(points) } else { Some(points.into()) };
        let free = around.as_deref().and_then(|points| self.narrowest_annulus(points, max_width));
        if let Some(free) = free.filter(|free| free.radius <= largest) {
            return Some(free);
        }
        let is_too_wide = |points| free.is_none() && max_width.is_finite() && initial_points(points).is_some();
        if around.as_deref().is_some_and(is_too_wide) {
            return None;
        }
        // The row is flatter than the largest circle. With the radius fixed, the centre is rotated about a point in the
        // middle of the row to where the ring is narrowest: three points determine it.
        let middle = points[points.len() / 2];
        let points = &*sorted_along(points);
        let last = points.len() - 1;
        let is_left = free.is_none_or(|free| cross(points[last] - points[0], free.centre - middle) >= 0.0);
        let through = |[a, b, c]: [Point; 3]| {
            // The centre is at the largest radius from the middle, and equally far from the first and the third point.
            let along = (c - a).try_normalize(0.0)?;
            let normal = if is_left { left_normal(along) } else { -left_normal(along) };
            let offset = along.dot(&(nalgebra::center(&a, &c) - middle));
            let centre = middle + along * offset + normal * (largest * largest - offset * offset).max(0.0).sqrt();
            Some(Annulus::with_centre(centre, [a, b]))
        };
        let guess = self.bounded.filter(|three| three[2] <= last).unwrap_or([0, last / 2, last]);
        narrowest_by_exchange(points, self.bounded.insert(guess), max_width, through)
    }
}

/// The points of a row near an arc, sorted around it in case it goes back along itself; `None` if it is on a line.
fn sorted_around(points: &[Point]) -> Option<Cow<'_, [Point]>> {
    /// What is no further from a line, relative to its length, is on it but for rounding.
    const LINE: f64 = 1e-12;
    let a = points[0];
    let b = furthest(points, |p| (p - a).norm_squared());
    let c = furthest(points, |p| cross(b - a, p - a).abs());
    let (u, v) = (b - a, c - a);
    let twice_area = 2.0 * cross(u, v);
    if twice_area.abs() <= LINE * u.norm_squared() {
        return None;
    }
    let centre = a + (left_normal(v) * -u.norm_squared() + left_normal(u) * v.norm_squared()) / twice_area;
    if goes_one_way(points, |from, to| cross(from - centre, to - centre)) {
        return Some(points.into());
    }
    // From opposite the middle of the row, so that the gap of an arc is not within it.
    let middle = points.iter().map(|p| (p - centre).normalize()).sum::<Vector>();
    let around = |p: &Point| {
        let offset = p - centre;
        let cosine = middle.dot(&offset) / (middle.norm() * offset.norm());
        if cross(middle, offset) < 0.0 { cosine - 1.0 } else { 1.0 - cosine }
    };
    Some(in_rising_order(points.to_vec(), around).into())
}

/// The points of a nearly straight row, sorted along it in case it reverses.
fn sorted_along(points: &[Point]) -> Cow<'_, [Point]> {
    // The ends of the row need not be those of the line: they are one point if it goes to and fro.
    let end = furthest(points, |p| (p - points[0]).norm_squared());
    let along = furthest(points, |p| (p - end).norm_squared()) - end;
    if goes_one_way(points, |from, to| along.dot(&(to - from))) {
        return points.into();
    }
    in_rising_order(points.to_vec(), |p| along.dot(&p.coords)).into()
}

/// The first of the points with the greatest distance.
fn furthest(points: &[Point], distance: impl Fn(&Point) -> f64) -> Point {
    points.iter().copied().reduce(|far, p| if distance(&p) > distance(&far) { p } else { far }).unwrap_or_default()
}

/// Whether no two steps from point to point have advances of different signs.
fn goes_one_way(points: &[Point], advance: impl Fn(Point, Point) -> f64) -> bool {
    let advances = points.windows(2).map(|pair| advance(pair[0], pair[1]));
    let [least, most] = advances.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], step| [l.min(step), h.max(step)]);
    least >= 0.0 || most <= 0.0
}

/// An initial guess of the four alternating points of a row, and the annulus through them.
fn initial_points(points: &[Point]) -> Option<([usize; 4], Annulus)> {
    let last = points.len().checked_sub(1)?;
    // The extremes of a polynomial of the third degree are a good first guess. If the row is nearly a full circle, its
    // ends are nearly one point, and inner points are better.
    let [near, far] = [last, last / 2].map(|k| (points[k] - points[0]).norm_squared());
    let four = if near < far / 4.0 { [1, 3, 5, 7].map(|k| k * last / 8) } else { [0, last / 4, last - last / 4, last] };
    let through = |four: [usize; 4]| Some((four, Annulus::through_alternating(four.map(|k| points[k]))?));
    // If the row reverses on one arc, these may be pairs of coincident points; others are not.
    through(four).or_else(|| through([1, 6, 11, 17].map(|k| k * last / 20)))
}

/// Improves the guess of the four points of a long row by the exchange on a subset of it.
fn improve_by_subset(points: &[Point], four: &mut [usize; 4], max_width: f64) {
    const FEW: usize = 16;
    let last = points.len() - 1;
    if last < 2 * FEW {
        return;
    }
    let few: [Point; FEW + 1] = std::array::from_fn(|k| points[k * last / FEW]);
    let mut four_of_few = four.map(|k| k * FEW / last);
    narrowest_by_exchange(&few, &mut four_of_few, max_width, Annulus::through_alternating);
    if Annulus::through_alternating(four_of_few.map(|k| few[k])).is_some() {
        *four = four_of_few.map(|k| k * last / FEW);
    }
}

impl Annulus {
    /// The circles through the first and third of four points, and through the second and fourth.
    fn through_alternating([a, b, c, d]: [Point; 4]) -> Option<Annulus> {
        // The centre is equally far from both points of each pair.
        let [u, v] = [c - a, d - b];
        let constants = [(c - a).dot(&(c + a.coords).coords) / 2.0, (d - b).dot(&(d + b.coords).coords) / 2.0];
        let determinant = cross(u, v);
        let centre = Point::new(
            (constants[0] * v.y - constants[1] * u.y) / determinant,
            (u.x * constants[1] - v.x * constants[0]) / determinant,
        );
        let ring = Annulus::with_centre(centre, [a, b]);
        ring.radius.is_finite().then_some(ring)
    }

    /// The annulus with a given centre whose circles pass through two points.
    fn with_centre(centre: Point, through: [Point; 2]) -> Annulus {
        let [a, b] = through.map(|p| (p - centre).norm());
        Annulus { centre, radius: (a + b) / 2.0, width: (a - b).abs() }
    }
}

/// The narrowest annulus of a row of points, by the exchange of the `alternating` points that its circles pass
/// `through`; it fails and ends as described at [`AlternatingPoints::narrowest_annulus`]. Afterwards `alternating` are
/// the points of the result.
fn narrowest_by_exchange<const N: usize>(
    points: &[Point],
    alternating: &mut [usize; N],
    max_width: f64,
    through: impl Fn([Point; N]) -> Option<Annulus>,
) -> Option<Annulus> {
    const ROUNDS: usize = 24;
    let ring_through = |alternating: [usize; N]| through(alternating.map(|k| points[k]));
    let mut best: Option<Annulus> = None;
    let mut ring = ring_through(*alternating)?;
    for _ in 0..ROUNDS {
        if ring.width > max_width {
            return None;
        }
        let square = |p: &Point| (p - ring.centre).norm_squared();
        let squares = min_max(points, square);
        let [low, high] = squares.map(f64::sqrt);
        let found = Annulus { radius: (low + high) / 2.0, width: high - low, ..ring };
        if best.is_none_or(|best| found.width < best.width) {
            best = Some(found);
        }
        if found.width <= ring.width * (1.0 + 1e-9) || (max_width.is_finite() && found.width <= max_width) {
            break;
        }
        let is_inside = ring.radius - low > high - ring.radius;
        let outermost = squares[usize::from(!is_inside)];
        let Some(new) = points.iter().position(|p| square(p) == outermost) else { break };
        if alternating.contains(&new) {
            break;
        }
        let is_own_inside = alternating.map(|k| (points[k] - ring.centre).norm() < ring.radius);
        let next = exchange_point(*alternating, new, |k| is_own_inside[k] == is_inside);
        let wider = ring_through(next).filter(|next| next.width > ring.width).map(|ring| (ring, next));
        // On a long arc another point may have to be removed: one that lies within the ring of the others.
        let other = || {
            let each =
                (0..N).filter_map(|removed| Some((ring_through(with_replaced(*alternating, removed, new))?, removed)));
            let fits =
                |ring: &Annulus, p: Point| ((p - ring.centre).norm() - ring.radius).abs() <= ring.width * (0.5 + 1e-9);
            let fitting = each.filter(|(ring, removed)| fits(ring, points[alternating[*removed]]));
            let (ring, removed) = fitting.min_by(|a, b| a.0.width.total_cmp(&b.0.width))?;
            Some((ring, with_replaced(*alternating, removed, new)))
        };
        let Some(next) = wider.or_else(other) else { break };
        (ring, *alternating) = next;
    }
    best.filter(|best| best.width <= max_width)
}

/// Sorted indices, with one of them replaced by another.
fn with_replaced<const N: usize>(mut alternating: [usize; N], removed: usize, new: usize) -> [usize; N] {
    alternating[removed] = new;
    alternating.sort_unstable();
    alternating
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::trig;

    /// Points at radius 2 + 0.01 cos(3 t) for t from 0 to pi: the cosine has four alternating extremes there.
    #[test]
    fn the_annulus_of_a_wave_is_as_wide_as_its_amplitudes() {
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

    /// From one end of a chord to the other and back: as narrow as the sagitta, whichever way round and wherever the row starts.
    #[test]
    fn the_annulus_of_a_line_passed_to_and_fro_is_that_of_its_chord() {
        let radius: f64 = 4.0;
        for (direction, noise) in [(Vector::x(), 0.0), (Vector::y(), 0.0), (Vector::new(0.6, -0.8), 4e-16)] {
            let point = |k: i32| {
                let along = trig::cos(std::f64::consts::PI * f64::from(k) / 32.0) / 4.0;
                Point::new(2.75, -1.5) + direction * along + left_normal(direction) * noise * f64::from(k % 3 - 1)
            };
            // That of the circle halfway, which is as large to within the width.
            let sagitta = radius - (radius * radius - 1.0 / 16.0).sqrt();
            for first in [0, 5, 16, 32, 40] {
                let points: Vec<Point> = (first..=first + 64).map(point).collect();
                for max_width in [f64::INFINITY, 1.01 * sagitta] {
                    let ring = AlternatingPoints::folded(true).narrowest_annulus_within(&points, max_width, radius);
                    let ring = ring.unwrap_or_else(|| panic!("no ring of {direction:?} from {first}"));
                    assert!((ring.width / sagitta - 1.0).abs() < sagitta / radius, "{ring:?}");
                }
                let narrower =
                    AlternatingPoints::folded(true).narrowest_annulus_within(&points, 0.99 * sagitta, radius);
                assert!(narrower.is_none(), "{narrower:?}");
            }
        }
    }
}
