//! The equation of the coupler curve.

use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::{
    CircuitSelection, DoublePoint, DoublePointKind, FourBar, Linkage, LinkageBuilder, MotionOptions, Sextic, Side,
};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use proptest::prelude::*;

fn linkage(four_bar: FourBar, point: Vector) -> Linkage {
    let FourBar { frame, crank, coupler, rocker } = four_bar;
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [frame, 0.0].into());
    let a = builder.crank("A", o, crank).unwrap();
    let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).unwrap();
    let m = builder.point("M", [a, b], point.x, point.y).unwrap();
    builder.build(vec![m], None, MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() }).unwrap()
}

/// Every sample of both circuits.
fn curve(four_bar: FourBar, point: Vector, samples: usize) -> Vec<Point> {
    let linkage = linkage(four_bar, point);
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(samples)));
    motion.circuits.iter().flat_map(|circuit| circuit.points(linkage.traced[0]).collect::<Vec<_>>()).collect()
}

fn lengths() -> impl Strategy<Value = FourBar> {
    prop::array::uniform4(0.3f64..3.0).prop_map(|[frame, crank, coupler, rocker]| FourBar {
        frame,
        crank,
        coupler,
        rocker,
    })
}

/// The coefficients of (7.7) by the powers of X and Y, for a symmetrical four-bar of frame p and crank r, with its
/// coupler point at b from both pins and the angle beta, given by sine and cosine, from the coupler to it. The bracket
/// that is missing after `sin^2 beta (1 + sin^2 beta` is added.
fn thesis_centred_equation([p, r, b]: [f64; 3], [sine, cosine]: [f64; 2]) -> Vec<([usize; 2], f64)> {
    let (s, c, q) = (sine * sine, cosine * cosine, b * b - r * r);
    let (s2, c2) = (2.0 * sine * cosine, c - s);
    let (t, b2, p2, p4) = (s2 * s2, b * b, p * p, p * p * p * p);
    vec![
        ([6, 0], t),
        ([4, 0], p2 * s * (1.0 - 3.0 * c) + 2.0 * t * q - 4.0 * b2 * t * s),
        ([4, 1], -2.0 * p * s * s2),
        ([4, 2], 3.0 * t),
        ([2, 0], p4 / 4.0 * s * (1.0 - 3.0 * s) - 2.0 * p2 * q * s + q * q * t + 2.0 * b2 * p2 * s * t),
        ([2, 1], p * s2 * (s * (p2 - 4.0 * b2 + 4.0 * r * r) - 8.0 * b2 * c2 * s)),
        ([2, 2], 2.0 * p2 * s * s - 8.0 * b2 * s * t + 4.0 * q * t),
        ([2, 3], -4.0 * p * s2 * s),
        ([2, 4], 3.0 * t),
        ([0, 6], t),
        ([0, 5], -2.0 * p * s2 * s),
        ([0, 4], 2.0 * t * q + p2 * s * (1.0 + c) - 4.0 * b2 * s * t),
        ([0, 3], p * s2 * s * (-p2 - 4.0 * b2 + 4.0 * r * r) - 8.0 * b2 * p * s2 * s * c2),
        (
            [0, 2],
            p4 / 4.0 * s * (1.0 + s) + q * q * t + 2.0 * p2 * q * s - 4.0 * b2 * p2 * s * (1.0 - 6.0 * c + 6.0 * c * c),
        ),
        ([0, 1], p / 2.0 * s2 * s * (-p4 / 4.0 - 4.0 * q * q - 2.0 * p2 * q) + 2.0 * b2 * p * p2 * s2 * c2 * s),
        ([0, 0], p2 * s * s * (p4 / 16.0 + q * q + p2 / 2.0 * q) - b2 * p4 * t * s / 4.0),
    ]
}

proptest! {
    #![proptest_config(crate::random())]

    /// (7.7): about the middle of the frame a symmetrical four-bar has no odd powers of X, and these coefficients.
    #[test]
    fn the_centred_equation_is_that_of_the_thesis(
        (p, r, coupler) in (0.3f64..3.0, 0.3f64..3.0, 0.3f64..3.0), across in prop_oneof![0.1f64..3.0, -3.0f64..-0.1],
    ) {
        let bar = FourBar { frame: p, crank: r, coupler, rocker: r };
        let centred = Sextic::from_four_bar(bar, Vector::new(coupler / 2.0, across)).unwrap().centred_coefficients();
        let b = (coupler * coupler / 4.0 + across * across).sqrt();
        let expected = thesis_centred_equation([p, r, b], [across / b, coupler / 2.0 / b]);
        let lead = expected[0].1;
        for (i, j) in (0..=6).flat_map(|i| (0..=6 - i).map(move |j| (i, j))) {
            let value = expected.iter().find(|(powers, _)| *powers == [i, j]).map_or(0.0, |(_, value)| value / lead);
            let found = centred[i][j];
            prop_assert!(i % 2 == 0 || found == 0.0, "X^{i} Y^{j}: {found}");
            prop_assert!((found - value).abs() <= 1e-9 * (1.0 + value.abs()), "X^{i} Y^{j}: {found} {value}");
        }
    }

    /// About the middle of the frame the equation of any four-bar has the same points.
    #[test]
    fn the_centred_equation_has_the_same_points(bar in lengths(), (along, across) in (-3.0f64..3.0, -3.0f64..3.0)) {
        let point = Vector::new(along, across);
        let Some(sextic) = Sextic::from_four_bar(bar, point) else { return Ok(()) };
        let centred = sextic.centred_coefficients();
        let power = |x: f64, n: usize| (0..n).fold(1.0, |product, _| product * x);
        for p in [Point::new(0.3, 0.7), Point::new(-1.0, 2.0), Point::new(2.5, -0.4)] {
            let [value, size] = sextic.evaluate(p);
            let all = (0..=6).flat_map(|i| (0..=6 - i).map(move |j| (i, j)));
            let sum: f64 = all.map(|(i, j)| centred[i][j] * power(p.x - bar.frame / 2.0, i) * power(p.y, j)).sum();
            prop_assert!((sum - value).abs() <= 1e-12 * size, "{p}: {sum} {value} of {size}");
        }
    }

    #[test]
    fn every_sample_satisfies_its_equation(bar in lengths(), (along, across) in (-3.0f64..3.0, -3.0f64..3.0), flat: bool) {
        let point = Vector::new(along, if flat { 0.0 } else { across });
        let Some(sextic) = Sextic::from_four_bar(bar, point) else { return Ok(()) };
        prop_assert_eq!(sextic.circularity(), 3);
        for p in curve(bar, point, 40) {
            let [value, terms] = sextic.evaluate(p);
            // Some sixty terms of the sixth degree, with coefficients that have lost a few digits themselves.
            prop_assert!(value.abs() <= 1e-11 * terms, "{} at {}: {} of {}", along, p, value, terms);
        }
    }

    /// A line through a sample meets the curve there, and all its intersections are on the curve.
    #[test]
    fn a_line_meets_the_curve_in_its_points(bar in lengths(), (along, across) in (-3.0f64..3.0, 0.2f64..3.0)) {
        let point = Vector::new(along, across);
        let Some(sextic) = Sextic::from_four_bar(bar, point) else { return Ok(()) };
        let direction = Vector::new(0.8, 0.6);
        for p in curve(bar, point, 7) {
            let found = sextic.line_intersections(p + direction * 0.37, direction);
            prop_assert!(found.len() <= 6);
            let near = found.iter().map(|q| (q - p).norm()).fold(f64::INFINITY, f64::min);
            // Where the line touches the curve the root is double, and known to half its digits.
            let slope = sextic.gradient(p).dot(&direction).abs();
            let scale = sextic.gradient(p).norm();
            if slope > 1e-3 * scale && scale > 1e-3 {
                prop_assert!(near < 1e-6, "{p}: {found:?}");
            }
            for q in found {
                let [value, terms] = sextic.evaluate(q);
                prop_assert!(value.abs() <= 1e-9 * terms);
            }
        }
    }

    /// The curve passes twice through a double point, or the point is isolated.
    #[test]
    fn double_points_are_singular(bar in lengths(), (along, across) in (-3.0f64..3.0, -3.0f64..3.0)) {
        let point = Vector::new(along, across);
        let Some(sextic) = Sextic::from_four_bar(bar, point) else { return Ok(()) };
        let found = sextic.double_points();
        prop_assert!(found.len() <= 3);
        for double in &found {
            let nearby = sextic.gradient(double.point + Vector::new(0.1, 0.1)).norm();
            prop_assert!(sextic.gradient(double.point).norm() <= 1e-6 * nearby.max(1.0), "{:?}", double);
        }
    }
}

/// A term of a polynomial of the thesis: its coefficient, and the powers of a, p, r, x and y.
type Term = [i32; 6];

/// (8.1), for a = b = s and the coupler point at 2a, corrected: `- 2 p r^4 x` for `- 2 p^4 x`.
const EVANS: [Term; 42] = [
    [16, 4, 2, 0, 0, 0],
    [-8, 2, 2, 2, 0, 0],
    [1, 0, 2, 4, 0, 0],
    [-32, 4, 1, 0, 1, 0],
    [16, 2, 3, 0, 1, 0],
    [16, 2, 1, 2, 1, 0],
    [-4, 0, 3, 2, 1, 0],
    [-2, 0, 1, 4, 1, 0],
    [16, 4, 0, 0, 2, 0],
    [-40, 2, 2, 0, 2, 0],
    [4, 0, 4, 0, 2, 0],
    [-8, 2, 0, 2, 2, 0],
    [10, 0, 2, 2, 2, 0],
    [1, 0, 0, 4, 2, 0],
    [32, 2, 1, 0, 3, 0],
    [-12, 0, 3, 0, 3, 0],
    [-8, 0, 1, 2, 3, 0],
    [-8, 2, 0, 0, 4, 0],
    [13, 0, 2, 0, 4, 0],
    [2, 0, 0, 2, 4, 0],
    [-6, 0, 1, 0, 5, 0],
    [1, 0, 0, 0, 6, 0],
    [16, 4, 0, 0, 0, 2],
    [-24, 2, 2, 0, 0, 2],
    [4, 0, 4, 0, 0, 2],
    [-8, 2, 0, 2, 0, 2],
    [2, 0, 2, 2, 0, 2],
    [1, 0, 0, 4, 0, 2],
    [32, 2, 1, 0, 1, 2],
    [-12, 0, 3, 0, 1, 2],
    [-8, 0, 1, 2, 1, 2],
    [-16, 2, 0, 0, 2, 2],
    [18, 0, 2, 0, 2, 2],
    [4, 0, 0, 2, 2, 2],
    [-12, 0, 1, 0, 3, 2],
    [3, 0, 0, 0, 4, 2],
    [-8, 2, 0, 0, 0, 4],
    [5, 0, 2, 0, 0, 4],
    [2, 0, 0, 2, 0, 4],
    [-6, 0, 1, 0, 1, 4],
    [3, 0, 0, 0, 2, 4],
    [1, 0, 0, 0, 0, 6],
];

/// (8.11), for r = s and the coupler point in the middle of the coupler of length 2a.
const CHEBYSHEV: [Term; 42] = [
    [1, 4, 2, 0, 0, 0],
    [-2, 2, 2, 2, 0, 0],
    [1, 0, 2, 4, 0, 0],
    [-4, 4, 1, 0, 1, 0],
    [-2, 2, 3, 0, 1, 0],
    [8, 2, 1, 2, 1, 0],
    [2, 0, 3, 2, 1, 0],
    [-4, 0, 1, 4, 1, 0],
    [4, 4, 0, 0, 2, 0],
    [10, 2, 2, 0, 2, 0],
    [1, 0, 4, 0, 2, 0],
    [-8, 2, 0, 2, 2, 0],
    [-10, 0, 2, 2, 2, 0],
    [4, 0, 0, 4, 2, 0],
    [-16, 2, 1, 0, 3, 0],
    [-6, 0, 3, 0, 3, 0],
    [16, 0, 1, 2, 3, 0],
    [8, 2, 0, 0, 4, 0],
    [13, 0, 2, 0, 4, 0],
    [-8, 0, 0, 2, 4, 0],
    [-12, 0, 1, 0, 5, 0],
    [4, 0, 0, 0, 6, 0],
    [4, 4, 0, 0, 0, 2],
    [2, 2, 2, 0, 0, 2],
    [1, 0, 4, 0, 0, 2],
    [-8, 2, 0, 2, 0, 2],
    [-6, 0, 2, 2, 0, 2],
    [4, 0, 0, 4, 0, 2],
    [-16, 2, 1, 0, 1, 2],
    [-6, 0, 3, 0, 1, 2],
    [16, 0, 1, 2, 1, 2],
    [16, 2, 0, 0, 2, 2],
    [18, 0, 2, 0, 2, 2],
    [-16, 0, 0, 2, 2, 2],
    [-24, 0, 1, 0, 3, 2],
    [12, 0, 0, 0, 4, 2],
    [8, 2, 0, 0, 0, 4],
    [5, 0, 2, 0, 0, 4],
    [-8, 0, 0, 2, 0, 4],
    [-12, 0, 1, 0, 1, 4],
    [12, 0, 0, 0, 2, 4],
    [4, 0, 0, 0, 0, 6],
];

/// Compares the general equation's coefficients with a polynomial of the thesis.
fn compare(sextic: &Sextic, terms: &[Term], [a, p, r]: [f64; 3]) {
    let power = |x: f64, n: i32| (0..n).fold(1.0, |product, _| product * x);
    for i in 0..=6 {
        for j in 0..=6 - i {
            let has_powers = |term: &&Term| (term[4], term[5]) == (i as i32, j as i32);
            let value = |t: &Term| f64::from(t[0]) * power(a, t[1]) * power(p, t[2]) * power(r, t[3]);
            let expected: f64 = terms.iter().filter(has_powers).map(value).sum();
            let size: f64 = terms.iter().filter(has_powers).map(|t| value(t).abs()).sum();
            let lead: f64 = terms.iter().filter(|t| (t[4], t[5]) == (6, 0)).map(value).sum();
            let found = sextic.coefficient(i, j) * lead;
            assert!((found - expected).abs() <= 1e-12 * (size + 1.0), "x^{i} y^{j}: {found} {expected}");
        }
    }
}

#[test]
fn the_equations_of_evans_and_chebyshev_are_special_cases() {
    for (a, p, r) in [(2.6, 2.0, 1.0), (4.0, 3.0, 1.2), (1.7, 0.8, 0.9)] {
        let evans = FourBar { frame: p, crank: r, coupler: a, rocker: a };
        compare(&Sextic::from_four_bar(evans, Vector::new(2.0 * a, 0.0)).unwrap(), &EVANS, [a, p, r]);
        let chebyshev = FourBar { frame: p, crank: r, coupler: 2.0 * a, rocker: r };
        compare(&Sextic::from_four_bar(chebyshev, Vector::new(a, 0.0)).unwrap(), &CHEBYSHEV, [a, p, r]);
    }
}

#[test]
fn a_lemniscate_crosses_itself_at_its_centre() {
    // Watt's curve with frame 2c, cranks c sqrt 2 and coupler 2c is Bernoulli's lemniscate.
    let c = 1.3;
    let bar = FourBar { frame: 2.0 * c, crank: c * 2f64.sqrt(), coupler: 2.0 * c, rocker: c * 2f64.sqrt() };
    let sextic = Sextic::from_four_bar(bar, Vector::new(c, 0.0)).unwrap();
    let middle = Point::new(c, 0.0);
    let doubles = sextic.double_points();
    assert!(
        doubles.iter().any(|d| (d.point - middle).norm() < 1e-9 && d.kind == DoublePointKind::Crunode),
        "{doubles:?}"
    );
    // (x^2 + y^2)^2 = 2 c^2 (x^2 - y^2) about the middle, with its tangents there at 45 degrees, and a circle about it.
    for p in curve(bar, Vector::new(c, 0.0), 40) {
        let q = p - middle;
        let on_lemniscate = q.norm_squared() * q.norm_squared() - 2.0 * c * c * (q.x * q.x - q.y * q.y);
        let on_circle = q.norm_squared() - 2.0 * c * c;
        assert!((on_lemniscate * on_circle).abs() < 1e-9, "{p}");
    }
}

/// A point on the coupler's line moves across it in both ways in which a linkage goes on from a change point: its branches touch.
#[test]
fn a_point_on_the_line_of_a_change_point_linkage_has_a_tacnode_at_any_scale() {
    for scale in [1.0, 0.1, 1e3, 1.0 / 3.0] {
        for (bar, along) in [([4.0, 2.0, 3.0, 5.0], 1.5), ([4.0, 1.5, 2.5, 3.0], -1.0), ([3.0, 2.0, 3.0, 2.0], 1.1)] {
            let [frame, crank, coupler, rocker] = bar.map(|length| scale * length);
            let bar = FourBar { frame, crank, coupler, rocker };
            let signs = (0..8).map(|k| [1, 2, 4].map(|bit| if k & bit == 0 { 1.0 } else { -1.0 }));
            let flat = signs.filter(|[a, b, c]| (a * crank + b * coupler - c * rocker - frame).abs() < 1e-9 * frame);
            let flat: Vec<[f64; 3]> = flat.collect();
            assert!(!flat.is_empty());
            let kinds = |across: f64| -> Vec<DoublePointKind> {
                let doubles =
                    Sextic::from_four_bar(bar, Vector::new(scale * along, scale * across)).unwrap().double_points();
                let kind = |[a, b, _]: &[f64; 3]| {
                    let at = Point::new(a * crank + b * scale * along, b * scale * across);
                    doubles
                        .iter()
                        .find(|double| (double.point - at).norm() < 1e-9 * frame)
                        .expect("a double point")
                        .kind
                };
                flat.iter().map(kind).collect()
            };
            assert!(kinds(0.0).iter().all(|kind| *kind == DoublePointKind::Tacnode), "{bar:?}: {:?}", kinds(0.0));
            assert!(kinds(0.3).iter().all(|kind| *kind == DoublePointKind::Crunode), "{bar:?}: {:?}", kinds(0.3));
        }
    }
}

/// A coupler point that passes a pivot of the frame, and a curve with a cusp.
#[test]
fn double_points_on_pivots_and_cusps_have_their_kinds() {
    let bar = FourBar { frame: 4.0, crank: 1.5, coupler: 3.0, rocker: 3.5 };
    // The coupler point is on the circle of the instant centre: a cusp where it is at it.
    let cusp = Sextic::from_four_bar(bar, Vector::new(0.5, -2.5 * 0.96f64.sqrt())).unwrap().double_points();
    assert!(cusp.iter().any(|double| double.kind == DoublePointKind::Cusp), "{cusp:?}");
    for (from, point) in [(0.0, Vector::new(0.9, 1.2)), (4.0, Vector::new(3.0 - 2.1, 2.8))] {
        let sextic = Sextic::from_four_bar(bar, point).unwrap();
        let pivot = sextic.double_points().into_iter().find(|double| (double.point.x - from).abs() < 1e-9);
        assert_eq!(pivot.map(|double| double.kind), Some(DoublePointKind::Crunode), "{from}");
    }
}

proptest! {
    #![proptest_config(crate::random())]

    /// A double point is isolated if no circuit comes near it, and of the same kind on mirrored and scaled copies.
    #[test]
    fn only_points_that_no_circuit_passes_are_isolated(bar in lengths(), along in -2.0f64..3.0, across in 0.1f64..3.0) {
        let doubles = |scale: f64, mirror: f64| {
            let FourBar { frame, crank, coupler, rocker } = bar;
            let [frame, crank, coupler, rocker] = [frame, crank, coupler, rocker].map(|length| scale * length);
            let bar = FourBar { frame, crank, coupler, rocker };
            let point = Vector::new(along, mirror * across) * scale;
            let mut doubles = Sextic::from_four_bar(bar, point).unwrap().double_points();
            doubles.sort_by(|a, b| a.point.x.total_cmp(&b.point.x));
            doubles
        };
        let points = curve(bar, Vector::new(along, across), 4000);
        let given = doubles(1.0, 1.0);
        for double in &given {
            let nearest = points.iter().map(|p| (p - double.point).norm()).fold(f64::INFINITY, f64::min);
            // Half of a step of the crank moves the point by less than this, but near the limits of a rocking input.
            let is_passed = nearest < 0.01;
            prop_assert!(double.kind != DoublePointKind::Acnode || nearest > 1e-5, "{double:?}, {nearest}");
            prop_assert!(double.kind == DoublePointKind::Acnode || is_passed, "{double:?}, {nearest}");
        }
        for (scale, mirror) in [(0.1, 1.0), (1e3, -1.0), (1.0, -1.0)] {
            let copy = doubles(scale, mirror);
            let kinds = |doubles: &[DoublePoint]| doubles.iter().map(|double| double.kind).collect::<Vec<_>>();
            prop_assert_eq!(kinds(&copy), kinds(&given), "scale {}, mirror {}", scale, mirror);
        }
    }
}

/// Where all links lie on one line the linkage can continue in two ways, and the curve crosses itself.
#[test]
fn a_change_point_is_a_double_point() {
    let bar = FourBar { frame: 4.0, crank: 1.5, coupler: 2.5, rocker: 3.0 };
    let sextic = Sextic::from_four_bar(bar, Vector::new(-1.0, 1.0)).unwrap();
    let node = Point::new(-2.5, 1.0);
    let doubles = sextic.double_points();
    assert_eq!(doubles.len(), 4);
    assert!(
        doubles.iter().any(|double| double.point == node && double.kind == DoublePointKind::Crunode),
        "{doubles:?}"
    );
    // The terms of the gradient are of the size of 1e4 there.
    assert!(sextic.gradient(node).norm() < 1e-9, "{}", sextic.gradient(node));
}

#[test]
fn coupler_points_on_pins_have_no_sextic() {
    let bar = FourBar { frame: 4.0, crank: 1.0, coupler: 3.0, rocker: 3.5 };
    assert!(
        Sextic::from_four_bar(bar, Vector::zeros()).is_none()
            && Sextic::from_four_bar(bar, Vector::new(3.0, 0.0)).is_none()
    );
}
