//! Paths as splines: within the tolerance of the curve, with dashes where the input says, in as few segments as closed
//! forms need.

use coupler_curves::geometry::{Capsule, CapsuleTree, CubicBezier, Point, Spline, SplineSegment, cross, trig};
use coupler_curves::linkage::{CircuitSelection, JointId, Linkage, LinkageBuilder, MotionOptions, Side};
use coupler_curves::motion::{self, Circuit, Motion, Sampler, Sampling, eased_input};
use coupler_curves::path::{DashPattern, JointPath, joint_path, joint_polyline};
use proptest::prelude::*;

use crate::measures::four_bar;

const DASHES: DashPattern = DashPattern { period: 5.0, dash_span: 3.0 };

fn circuits(linkage: &Linkage) -> Vec<Circuit> {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(90))).circuits
}

fn extent(circuit: &Circuit, joint: JointId) -> f64 {
    coupler_curves::geometry::Bounds::from_points(circuit.points(joint)).size().max()
}

/// A tree of segments, and the bounds of nothing else.
fn tree(lines: impl Iterator<Item = Vec<Point>>) -> CapsuleTree {
    let capsule = |pair: &[Point]| Capsule { ends: [pair[0], pair[1]], radius: 0.0 };
    CapsuleTree::new(lines.flat_map(|line| line.windows(2).map(capsule).collect::<Vec<_>>()).collect())
}

/// The positions of a joint at `count` inputs of each pass, dense at limits.
fn positions(linkage: &Linkage, circuit: &Circuit, joint: JointId, count: usize) -> Vec<Vec<Point>> {
    let on_pass = |pass| {
        let inputs: Vec<f64> = (0..=count).map(|k| eased_input(pass, k as f64 / count as f64)).collect();
        let poses = motion::poses(linkage, pass, &inputs);
        (0..inputs.len()).map(|k| poses.point(joint, k)).collect()
    };
    circuit.passes.iter().map(on_pass).collect()
}

/// How far the curve is from its whole path, and any of its splines from the curve.
fn deviations(linkage: &Linkage, circuit: &Circuit, joint: JointId, path: &JointPath, tolerance: f64) -> [f64; 2] {
    const EXACT: f64 = 2e-3;
    // A search ends where the distance is plainly allowed.
    let enough = 0.9 * tolerance;
    let curve = positions(linkage, circuit, joint, 2_000);
    let drawn = tree(path.whole.iter().map(|spline| spline.flatten(EXACT * tolerance)));
    let missed = curve.iter().flatten().map(|point| drawn.signed_distance(*point, enough)).fold(0.0, f64::max);
    // The chords of this polyline are within a hundredth of the tolerance of the curve.
    let solved = tree([joint_polyline(linkage, circuit, joint, 0.01 * tolerance)].into_iter());
    let splines = path.whole.iter().chain(path.dashes.iter().map(|dash| &dash.spline));
    let points = splines.flat_map(|spline| spline.flatten(0.1 * tolerance));
    let strayed = points.map(|point| solved.signed_distance(point, enough)).fold(0.0, f64::max);
    [missed, strayed]
}

/// Checks a path against positions of the joint; returns its number of segments.
fn check(linkage: &Linkage, circuit: &Circuit, joint: JointId, tolerance: f64) -> usize {
    let path = joint_path(linkage, circuit, joint, DASHES, tolerance);
    let [missed, strayed] = deviations(linkage, circuit, joint, &path, tolerance);
    assert!(missed <= tolerance, "missed by {} of the tolerance", missed / tolerance);
    assert!(strayed <= 1.01 * tolerance, "strayed by {} of the tolerance", strayed / tolerance);
    for pass in circuit.passes.iter().filter(|_| path.dashed_travel.is_none()) {
        let [low, high] = pass.input_range();
        let inner = |input: &f64| low + 1e-9 < *input && *input < high - 1e-9;
        let (first, last) = ((low / 5.0).floor() as i32, (high / 5.0).ceil() as i32);
        for input in (first..=last).flat_map(|k| [5.0 * f64::from(k), 5.0 * f64::from(k) + 3.0]).filter(inner) {
            let end = motion::poses(linkage, pass, &[input]).point(joint, 0);
            let is_end = |p: Point| (p - end).norm() <= 1e-9 * extent(circuit, joint);
            let is_found = path.dashes.iter().any(|dash| is_end(dash.spline.start) || is_end(dash.spline.end()));
            assert!(is_found, "no dash ends at {input}");
        }
    }
    path.whole.iter().map(|spline| spline.segments.len()).sum()
}

/// A hundred thousandth of the extent is about what pages allow: 0.009 mm of an extent of some hundred.
fn page_tolerance(circuit: &Circuit, joint: JointId) -> f64 {
    1e-4 * extent(circuit, joint)
}

#[test]
fn a_circle_takes_few_cubics() {
    let linkage = four_bar([4.0, 1.0, 3.0, 3.0], (1.0, 1.0));
    let circuit = &circuits(&linkage)[0];
    let path = joint_path(&linkage, circuit, linkage.traced[0], DASHES, 1e-4);
    let [spline] = &path.whole[..] else { panic!("one spline") };
    assert!(spline.segments.len() <= 12, "{}", spline.segments.len());
    let on_circle = |p: Point| ((p - Point::origin()).norm() - 1.0).abs();
    assert!(spline.flatten(1e-6).into_iter().map(on_circle).fold(0.0, f64::max) <= 1e-4);
    assert_eq!((path.dashes.len(), path.dashed_travel), (72, None));
    for (k, dash) in path.dashes.iter().enumerate() {
        for (point, deg) in [(dash.spline.start, 5.0 * k as f64), (dash.spline.end(), 5.0 * k as f64 + 3.0)] {
            let (cos, sin) = trig::cos_sin_deg(deg);
            assert!((point - Point::new(cos, sin)).norm() < 1e-14, "{deg}");
        }
    }
}

/// A crank and a coupler of the same length, whose end slides on a line through the pivot: other points of the coupler
/// trace ellipses, through change points at 90 and 270 degrees.
fn trammel(along: f64) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let x = builder.fixed("X", Point::new(1.0, 0.0));
    let a = builder.crank("A", o, 1.0).unwrap();
    let b = builder.slide("B", (a, 1.0), ([o, x], 0.0), Side::Left).unwrap();
    let m = builder.point("M", [a, b], along, 0.0).unwrap();
    builder.build(vec![b, m], None, MotionOptions::default()).unwrap()
}

#[test]
fn an_ellipse_is_one_smooth_spline() {
    for along in [0.5, 2.5, -0.7] {
        let linkage = trammel(along);
        let circuit = &circuits(&linkage)[0];
        let m = linkage.traced[1];
        let path = joint_path(&linkage, circuit, m, DASHES, 1e-4);
        let [spline] = &path.whole[..] else { panic!("one spline") };
        assert!(spline.segments.len() <= 24, "{}", spline.segments.len());
        // M is at ((1 + along) cos, (1 - along) sin).
        for p in spline.flatten(1e-6) {
            let (x, y) = (p.x / (1.0 + along), p.y / (1.0 - along));
            let least = (1.0 + along).abs().min((1.0 - along).abs());
            assert!(((x * x + y * y).sqrt() - 1.0).abs() * least <= 1.01e-4, "{along}");
        }
        check(&linkage, circuit, m, 1e-4);
    }
}

#[test]
fn a_slider_s_path_is_a_line_there_and_back_with_dashes_on_the_way_there() {
    let linkage = trammel(0.5);
    let circuit = &circuits(&linkage)[0];
    // B is at 2 cos.
    let path = joint_path(&linkage, circuit, linkage.traced[0], DASHES, 1e-4);
    let [Spline { start, segments }] = &path.whole[..] else { panic!("one spline") };
    let ends: Vec<f64> = [*start].into_iter().chain(segments.iter().map(SplineSegment::end)).map(|p| p.x).collect();
    assert!(segments.iter().all(|segment| matches!(segment, SplineSegment::Line(_))));
    assert!(
        ends.len() <= 8 && (ends[0] - 2.0).abs() < 1e-14 && ends.iter().any(|x| (x + 2.0).abs() < 1e-9),
        "{ends:?}"
    );
    let [[from, to]] = path.dashed_travel.as_deref().unwrap() else { panic!("one stretch") };
    assert!(*from == 0.0 && (to - 180.0).abs() < 1e-6, "{from} {to}");
    assert_eq!(path.dashes.len(), 36);
}

/// The lengths of the gaps between dashes on a curve that is drawn once, and to and fro.
#[test]
fn the_dashes_of_a_return_do_not_fill_the_gaps() {
    // B oscillates on a circle about C at (3, 0), from its outer dead centre to its inner one and back.
    let linkage = four_bar([3.0, 1.0, 2.5, 2.0], (0.3, 0.0));
    let circuit = &circuits(&linkage)[0];
    let path = joint_path(&linkage, circuit, linkage.traced[1], DASHES, 1e-4);
    let angle = |p: Point| trig::atan2(p.y, p.x - 3.0);
    let mut dashes: Vec<[f64; 2]> = path
        .dashes
        .iter()
        .map(|dash| [angle(dash.spline.start), angle(dash.spline.end())])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    dashes.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for pair in dashes.windows(2) {
        assert!(pair[0][1] <= pair[1][0] + 1e-9, "{pair:?}");
    }
    // Every place of the arc has been traced for the first time once: dashes are three fifths of the input there.
    let stretches = path.dashed_travel.unwrap();
    let half_strokes: f64 = stretches.iter().map(|[from, to]| to - from).sum();
    assert!((150.0..210.0).contains(&half_strokes), "{stretches:?}");
    let range = |dashes: &[[f64; 2]]| dashes[dashes.len() - 1][1] - dashes[0][0];
    let all = positions(&linkage, circuit, linkage.traced[1], 4_000).concat();
    let [low, high] = all.iter().map(|p| angle(*p)).fold([9.0f64, -9.0f64], |[l, h], a| [l.min(a), h.max(a)]);
    assert!(range(&dashes) > 0.97 * (high - low));
}

/// A curve that crosses itself, or touches itself, is not traced twice.
#[test]
fn crossing_curves_keep_their_dashes() {
    // A figure of eight, and the curve of a parallelogram's coupler point through its change points.
    for lengths in [[2.0, 2.5, 1.0, 2.5], [4.0, 3.0, 2.0, 3.4], [2.0, 1.0, 2.5, 2.5]] {
        for (along, across) in [(0.5, 0.0), (1.0, 0.7), (5.0, 0.0)] {
            let linkage = four_bar(lengths, (along, across));
            for circuit in &circuits(&linkage) {
                let path = joint_path(&linkage, circuit, linkage.traced[2], DASHES, 1e-4);
                assert_eq!(path.dashed_travel, None, "{lengths:?} {along} {across}");
            }
        }
    }
}

#[test]
fn neighbouring_segments_have_a_common_tangent() {
    let linkage = four_bar([2.0, 1.0, 2.5, 2.5], (3.0, 1.5));
    let circuit = &circuits(&linkage)[0];
    let path = joint_path(&linkage, circuit, linkage.traced[2], DASHES, 1e-4);
    let [spline] = &path.whole[..] else { panic!("one spline") };
    let cubics: Vec<CubicBezier> = spline
        .segments_with_starts()
        .map(|(start, segment)| match *segment {
            SplineSegment::Cubic([b, c, d]) => CubicBezier([start, b, c, d]),
            SplineSegment::Line(_) => panic!("nothing of it is straight"),
        })
        .collect();
    for (before, after) in cubics.iter().zip(cubics.iter().cycle().skip(1)) {
        let [a, b] = [before.derivatives(1.0)[0].normalize(), after.derivatives(0.0)[0].normalize()];
        assert!(cross(a, b).abs() < 1e-9 && a.dot(&b) > 0.0, "{a} {b}");
    }
}

/// The point of the coupler at the instant centre: its curve has a cusp there.
fn cusped([frame, crank, coupler, rocker]: [f64; 4], deg: f64, off: f64) -> Linkage {
    let plain = four_bar([frame, crank, coupler, rocker], (0.0, 0.0));
    let circuit = &circuits(&plain)[0];
    let pose = motion::pose(&plain, &circuit.passes[0], deg);
    let [a, b] = [pose[plain.traced[0].index()], pose[plain.traced[1].index()]];
    let (from, to) = (a.coords, b - Point::new(frame, 0.0));
    // O + s (A - O) = C + t (B - C).
    let s = cross(Point::new(frame, 0.0).coords, to) / cross(from, to);
    let centre = Point::from(from * s);
    let unit = (b - a).normalize();
    four_bar([frame, crank, coupler, rocker], (unit.dot(&(centre - a)) + off, cross(unit, centre - a)))
}

#[test]
fn cusps_and_what_is_nearly_a_cusp_are_drawn() {
    for deg in [40.0, 100.0, 251.3] {
        for off in [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, -1e-3, 1e-2] {
            let linkage = cusped([4.0, 1.0, 3.0, 2.5], deg, off);
            let circuit = &circuits(&linkage)[0];
            let m = linkage.traced[2];
            let count = check(&linkage, circuit, m, page_tolerance(circuit, m));
            assert!(count < 60, "{deg} {off}: {count} segments");
        }
    }
}

#[test]
fn curves_of_any_size_have_the_same_segments() {
    let count = |size: f64| {
        let linkage = four_bar([2.0, 1.0, 2.5, 2.5].map(|length| length * size), (3.0 * size, 1.5 * size));
        let circuit = &circuits(&linkage)[0];
        check(&linkage, circuit, linkage.traced[2], page_tolerance(circuit, linkage.traced[2]))
    };
    // Powers of two change no digit.
    assert_eq!([(1u64 << 30) as f64, 1.0 / (1u64 << 30) as f64].map(count), [count(1.0); 2]);
    assert!([1e-9, 1e9].map(count).iter().all(|other| other.abs_diff(count(1.0)) <= 2));
}

/// Near the crank pin of a large linkage, curves are small compared with its coordinates.
#[test]
fn small_curves_of_large_linkages_are_drawn() {
    for size in [1e-3, 1e-6, 1e-8] {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let c = builder.fixed("C", Point::new(1.0, 0.0));
        let a = builder.crank("A", o, size).unwrap();
        let b = builder.dyad("B", [a, c], [0.7, 0.6], Side::Left).unwrap();
        let m = builder.point("M", [a, b], size, 0.3 * size).unwrap();
        let options = MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() };
        let linkage = builder.build(vec![m], None, options).unwrap();
        let circuit = &circuits(&linkage)[0];
        check(&linkage, circuit, m, page_tolerance(circuit, m));
    }
}

proptest! {
    #![proptest_config(crate::random())]

    /// Between limits, through change points, and round and round.
    #[test]
    fn four_bars_are_drawn_within_the_tolerance(
        lengths in [0.5f64..5.0, 0.5f64..5.0, 0.5f64..5.0, 0.5f64..5.0],
        along in -3.0f64..6.0,
        across in -4.0f64..4.0,
        is_round in proptest::bool::ANY,
        fineness in 1.0f64..5.0,
    ) {
        // Whole numbers have change points.
        let lengths = if is_round { lengths.map(f64::round) } else { lengths };
        let linkage = four_bar(lengths.map(|length| length.max(0.5)), (along, across));
        for circuit in &circuits(&linkage) {
            // B may be at rest on its pivot.
            for &joint in linkage.traced[1..].iter().filter(|&&joint| extent(circuit, joint) > 1e-6) {
                let tolerance = trig::pow(10.0, -fineness) * extent(circuit, joint);
                check(&linkage, circuit, joint, tolerance);
            }
        }
    }
}
