//! Symmetrical curves: by the theorems of chapter 7, by their shape, and circles.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{Linkage, LinkageBuilder, MotionOptions, Orientation, Side};
use coupler_curves::measure::TracedCurve;
use coupler_curves::motion::{Motion, Sampler, Sampling};

use crate::measures::four_bar;

/// By theorem 1 the axis is the perpendicular bisector of the frame; by theorem 2 it goes through the rocker's pivot,
/// at half the angle at its pin.
#[test]
fn the_theorems_of_chapter_7_are_recognised() {
    let axis = |linkage: &Linkage, circuit: usize| {
        let motion = Motion::solve(linkage, &Sampler::new(Sampling::Samples(180)));
        let curve = TracedCurve::new(linkage, &motion, &motion.circuits[circuit], linkage.traced[2]);
        let symmetry = *curve.symmetry().expect("a curve");
        (symmetry.theorem, symmetry.axis.expect("an axis"), symmetry.residual)
    };
    for height in [0.0, 0.7, -1.3] {
        let (theorem, axis, residual) = axis(&four_bar([2.0, 2.5, 1.0, 2.5], (0.5, height)), 0);
        assert_eq!(theorem, Some("theorem 1"), "{height} {axis:?} {residual}");
        assert!((axis.direction_deg() - 90.0).abs() < 1e-12 && (axis.point.x - 1.0).abs() < 1e-15, "{axis:?}");
        assert!(residual < 1e-6, "{residual}");
    }
    for beta in [40.0, 100.0, 180.0, -75.0] {
        // M at beta from A about B, B at distance 2.5 along the coupler.
        let (cos, sin) = trig::cos_sin_deg(180.0 - beta);
        let (theorem, axis, residual) = axis(&four_bar([2.0, 1.0, 2.5, 2.5], (2.5 + 2.5 * cos, -2.5 * sin)), 0);
        assert_eq!(theorem, Some("theorem 2"), "{beta}");
        assert!((axis.point - Point::new(2.0, 0.0)).norm() < 1e-12);
        // (7.8) and (7.12): the axis is turned from the frame by half of beta.
        let off = [-0.5, 0.5].map(|part| (axis.direction_deg() + part * beta + 1.0).rem_euclid(180.0) - 1.0);
        assert!(off.iter().any(|off| off.abs() < 1e-9), "{beta}: {}", axis.direction_deg());
        assert!(residual < 1e-6, "{beta}: {residual}");
    }
}

/// Where no theorem applies the axis is found by shape: for a point of a slider-crank on the coupler line, and for no
/// other.
#[test]
fn other_symmetrical_curves_are_found_by_their_shape() {
    let symmetry = |across: f64, turn: f64| {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::new(0.0, 0.0));
        let p = builder.fixed("P", Point::new(1.0, 0.0));
        let a = builder.crank("A", o, 1.0).unwrap();
        let b = builder.slide("B", (a, 2.5), ([o, p], 0.0), Side::Left).unwrap();
        let m = builder.point("M", [a, b], 1.0, across).unwrap();
        let linkage = builder.build(vec![m], None, MotionOptions::default()).unwrap();
        let linkage = Linkage { placement: Orientation::new(false, turn), ..linkage };
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(180)));
        *TracedCurve::new(&linkage, &motion, &motion.circuits[0], m).symmetry().expect("a curve")
    };
    for turn in [0.0, 33.0] {
        let found = symmetry(0.0, turn);
        assert!(found.residual < 1e-7 && found.theorem.is_none(), "{found:?}");
        assert!((found.axis.expect("an axis").direction_deg() - turn).abs() < 1e-5, "{found:?}");
        assert!(symmetry(0.5, turn).residual > 0.002);
    }
    // No axis of a circle is distinguished from the others.
    let linkage = four_bar([4.0, 1.25, 3.0, 3.5], (1.0, 1.0));
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(180)));
    let circle =
        *TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]).symmetry().expect("a curve");
    assert_eq!((circle.axis, circle.residual), (None, 0.0));
}

/// The distance of a point from a polyline.
fn distance(point: Point, line: &[Point]) -> f64 {
    let to_segment = |pair: &[Point]| {
        let along = pair[1] - pair[0];
        let part = ((point - pair[0]).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        (point - (pair[0] + along * part)).norm()
    };
    line.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
}

/// Over a part of a turn a curve is open: its ends count, and it does not have the axis of the whole curve.
#[test]
fn the_residual_of_an_open_curve_is_that_of_its_image_including_its_ends() {
    let lengths = [[4.0, 1.0, 3.0, 3.5], [2.0, 1.0, 2.5, 2.5]];
    let mut closest = f64::INFINITY;
    for (k, lengths) in lengths.into_iter().cycle().take(12).enumerate() {
        let linkage = four_bar(lengths, (0.5 + 0.5 * k as f64, 0.25 * k as f64));
        let range = Some([30.0, 60.0 + 20.0 * k as f64]);
        let motion_options = MotionOptions { range, ..linkage.motion_options.clone() };
        let linkage = Linkage { motion_options, ..linkage };
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(2000)));
        let (circuit, joint) = (&motion.circuits[0], linkage.traced[2]);
        let curve = TracedCurve::new(&linkage, &motion, circuit, joint);
        let symmetry = *curve.symmetry().expect("a curve");
        let axis = symmetry.axis.expect("an axis");
        let points: Vec<Point> = circuit.points(joint).collect();
        let far = points.iter().step_by(7).map(|p| distance(axis.mirror(*p), &points)).fold(0.0, f64::max);
        let ends = [points[0], points[points.len() - 1]].map(|p| distance(axis.mirror(p), &points));
        let brute = ends.into_iter().fold(far, f64::max) / curve.extent();
        assert!((symmetry.residual - brute).abs() <= 0.01 * brute + 1e-6, "{k}: {symmetry:?}, not {brute}");
        assert_eq!(symmetry.theorem, None);
        closest = closest.min(symmetry.residual);
    }
    assert!((1e-4..0.1).contains(&closest), "{closest}");
}
