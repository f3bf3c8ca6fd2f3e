//! The Roberts-Chebyshev cognates: three four-bars, one curve.

use coupler_curves::catalogue;
use coupler_curves::geometry::{Orientation, Point, Vector, cross, distance_to_segment, trig};
use coupler_curves::linkage::{
    CircuitSelection, CognateError, Cognates, FourBar, FourBarClass, JointId, Linkage, MotionOptions, MovingLink,
    PlacedFourBar, Sextic, Side,
};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};
use proptest::prelude::*;

use crate::linkages::check_motion;

/// The curves of the first traced joint of a linkage, one a circuit, sampled evenly along their lengths.
fn curves(linkage: &Linkage) -> Vec<Vec<Point>> {
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::ArcLength(500)));
    let path = |circuit: &Circuit| {
        let mut path: Vec<Point> = circuit.points(linkage.traced[0]).collect();
        if circuit.is_closed {
            path.extend(path.first().copied());
        }
        path
    };
    motion.circuits.iter().map(path).collect()
}

/// The greatest distance of the points of some curves from others, as a fraction of the longest chord of the others.
fn relative_distance(one: &[Vec<Point>], other: &[Vec<Point>]) -> f64 {
    let chords = || other.iter().flat_map(|path| path.windows(2));
    let longest = chords().map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max);
    let from = |p: &Point| chords().map(|pair| distance_to_segment(*p, pair[0], pair[1])).fold(f64::INFINITY, f64::min);
    one.iter().flatten().map(from).fold(0.0, f64::max) / longest
}

fn is_same_curve(one: &[Vec<Point>], other: &[Vec<Point>]) -> bool {
    // A chord of a smooth curve is off by far less than its length; the margin is for cusps.
    one.is_empty() == other.is_empty()
        && (one.is_empty() || relative_distance(one, other).max(relative_distance(other, one)) < 0.5)
}

/// Crank pivot, crank pin, rocker pin and rocker pivot at each sample of the first circuit.
fn poses(linkage: &Linkage, samples: usize) -> Vec<[Point; 4]> {
    let pins = FourBar::pins(linkage).unwrap();
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::Samples(samples)));
    let Some(circuit) = motion.circuits.first() else { return Vec::new() };
    (0..circuit.len()).map(|i| pins.map(|pin| circuit.positions.point(pin, i))).collect()
}

fn placed_four_bar() -> impl Strategy<Value = PlacedFourBar> {
    let lengths = prop::array::uniform4(0.3f64..3.0);
    let point = (-3.0f64..3.0, prop_oneof![Just(0.0), -3.0f64..3.0]);
    (lengths, point, (-2.0f64..2.0, -2.0f64..2.0, -180.0f64..180.0)).prop_map(
        |([frame, crank, coupler, rocker], (along, across), (x, y, turn))| {
            let (cos, sin) = trig::cos_sin_deg(turn);
            let o = Point::new(x, y);
            PlacedFourBar {
                pivots: [o, o + Vector::new(cos, sin) * frame],
                lengths: FourBar { frame, crank, coupler, rocker },
                coupler_point: Vector::new(along, across),
            }
        },
    )
}

fn all() -> MotionOptions {
    MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() }
}

proptest! {
    #![proptest_config(crate::random())]

    /// Every sample of each cognate satisfies the equation of every other, and all or none of them are Grashof.
    #[test]
    fn cognates_have_one_equation(four_bar in placed_four_bar()) {
        let Ok(cognates) = Cognates::from_four_bar(four_bar) else { return Ok(()) };
        let three = cognates.all();
        let is_grashof = |c: FourBarClass| c != FourBarClass::TripleRocker;
        for member in &three {
            let linkage = member.to_linkage([], &all()).unwrap();
            prop_assert_eq!(is_grashof(member.four_bar.lengths.class()), is_grashof(four_bar.lengths.class()));
            let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(60)));
            for other in &three {
                let sextic = Sextic::from_four_bar(other.four_bar.lengths, other.four_bar.coupler_point).unwrap();
                let [o, c] = other.four_bar.pivots;
                let axis = (c - o).normalize();
                for p in motion.circuits.iter().flat_map(|circuit| circuit.points(linkage.traced[0])) {
                    let own = Point::new(axis.dot(&(p - o)), cross(axis, p - o));
                    let [value, terms] = sextic.evaluate(own);
                    // Some sixty terms of the sixth degree; the lengths and positions of the cognates are rounded too.
                    prop_assert!(value.abs() <= 1e-10 * terms, "{value} of {terms}");
                }
            }
        }
    }

    /// The circuits of each cognate together are the same set of points.
    #[test]
    #[ignore = "thorough"]
    fn cognates_trace_one_curve(four_bar in placed_four_bar()) {
        let Ok(cognates) = Cognates::from_four_bar(four_bar) else { return Ok(()) };
        let [original, first, second] = cognates.all().map(|c| curves(&c.to_linkage([], &all()).unwrap()));
        prop_assert!(is_same_curve(&original, &first) && is_same_curve(&original, &second));
    }

    /// A circuit of the original is traced by one circuit of each cognate: the one through the given poses.
    #[test]
    #[ignore = "thorough"]
    fn cognates_trace_the_selected_circuit(four_bar in placed_four_bar(), left: bool) {
        let Ok(cognates) = Cognates::from_four_bar(four_bar) else { return Ok(()) };
        let side = if left { Side::Left } else { Side::Right };
        let original = four_bar.to_linkage(side, MotionOptions::default()).unwrap();
        let curve = curves(&original);
        prop_assume!(!curve.is_empty());
        for cognate in cognates.others {
            let linkage = cognate.to_linkage(poses(&original, 90), &original.motion_options).unwrap();
            prop_assert!(is_same_curve(&curve, &curves(&linkage)), "{cognate:?}");
        }
    }

    /// Assembled on the original, the cognates keep all their lengths while it moves, and each link turns as its
    /// counterpart.
    #[test]
    fn assembled_cognates_move_together(four_bar in placed_four_bar(), mirror: bool, turn in -180.0f64..180.0) {
        let plain = four_bar.to_linkage(Side::Left, all()).unwrap();
        let linkage = Linkage { placement: Orientation::new(mirror, turn), ..plain };
        let m = linkage.traced[0];
        let Ok(assembled) = Cognates::assemble(&linkage, m) else { return Ok(()) };
        let cognates = Cognates::from_four_bar(PlacedFourBar::from_linkage(&linkage, m).unwrap()).unwrap();
        let motion = Motion::solve(&assembled, &Sampler::new(Sampling::Samples(24)));
        check_motion(&assembled, &motion)?;
        prop_assert_eq!((assembled.links.len() - linkage.links.len(), assembled.chains.len()), (6, 2));
        let joint = |name: &str| assembled.find_joint(name).unwrap();
        let [o, c, q] = ["O", "C", "Q"].map(joint);
        let pins = FourBar::pins(&linkage).unwrap();
        for circuit in &motion.circuits {
            for i in 0..circuit.len() {
                let at = |joint| circuit.positions.point(joint, i);
                // Rounding of positions and of their sums, with lengths up to some hundred.
                let close = |a: Point, b: Point| (a - b).norm() <= 1e-12 * (1.0 + a.coords.norm() + b.coords.norm());
                prop_assert!(close(at(q), cognates.third_pivot));
                for (cognate, [own, shared]) in cognates.others.iter().zip([["D", "E"], ["F", "G"]]) {
                    let ends = cognate.pins(pins.map(at));
                    let (own, shared) = (at(joint(own)), at(joint(shared)));
                    let first = cognate.four_bar.pivots[0];
                    let is_own = close(first, at(o)) || close(first, at(c));
                    let expected = if is_own && !close(first, at(q)) { [own, shared] } else { [shared, own] };
                    prop_assert!(close(ends[0], expected[0]) && close(ends[1], expected[1]));
                    let FourBar { coupler, .. } = cognate.four_bar.lengths;
                    let along = (ends[1] - ends[0]) / coupler;
                    let point = cognate.four_bar.coupler_point;
                    let left = Vector::new(-along.y, along.x);
                    prop_assert!(close(ends[0] + along * point.x + left * point.y, at(m)));
                }
            }
        }
    }
}

/// A cognate is driven by its shortest link if that is on a pivot; and counterparts turn alike.
#[test]
fn cognates_are_driven_by_links_that_turn_fully() {
    let bar = |frame, crank, coupler, rocker| PlacedFourBar {
        pivots: [Point::origin(), Point::new(frame, 0.0)],
        lengths: FourBar { frame, crank, coupler, rocker },
        coupler_point: Vector::new(1.1, 0.7),
    };
    use MovingLink::{Coupler, Crank, Rocker};
    for (bars, classes, turns) in [
        // The crank turns fully, and so does that of the cognate on the rocker's pivot, about the third pivot.
        (bar(4.0, 1.0, 3.0, 3.5), [FourBarClass::DoubleRocker, FourBarClass::CrankRocker], [Coupler, Crank]),
        (bar(4.0, 3.5, 3.0, 1.0), [FourBarClass::CrankRocker, FourBarClass::DoubleRocker], [Rocker, Crank]),
        (bar(4.0, 3.5, 1.0, 3.0), [FourBarClass::CrankRocker, FourBarClass::CrankRocker], [Coupler, Coupler]),
        (bar(1.0, 3.5, 4.0, 3.0), [FourBarClass::DragLink, FourBarClass::DragLink], [Coupler, Crank]),
        (bar(4.0, 2.0, 2.5, 2.0), [FourBarClass::TripleRocker, FourBarClass::TripleRocker], [Rocker, Crank]),
    ] {
        let cognates = Cognates::from_four_bar(bars).unwrap();
        assert_eq!(cognates.others.map(|c| c.four_bar.lengths.class()), classes, "{bars:?}");
        assert_eq!(cognates.others.map(|c| c.counterparts[0]), turns, "{bars:?}");
        for (cognate, class) in cognates.others.iter().zip(classes) {
            let motion = Motion::solve(&cognate.to_linkage([], &all()).unwrap(), &Sampler::new(Sampling::Samples(8)));
            let turns_fully = motion.circuits.iter().all(|circuit| circuit.is_full_turn());
            assert_eq!(turns_fully, matches!(class, FourBarClass::CrankRocker | FourBarClass::DragLink), "{bars:?}");
        }
    }
}

/// Linkages with change points, whose circuits cross.
#[test]
fn cognates_trace_one_curve_through_change_points() {
    for [frame, crank, coupler, rocker] in [[3.0, 2.0, 1.0, 2.0], [2.0, 1.0, 2.0, 1.0], [1.5, 2.0, 1.5, 2.0]] {
        let four_bar = PlacedFourBar {
            pivots: [Point::origin(), Point::new(frame, 0.0)],
            lengths: FourBar { frame, crank, coupler, rocker },
            coupler_point: Vector::new(0.7, 0.6),
        };
        let [original, first, second] =
            Cognates::from_four_bar(four_bar).unwrap().all().map(|c| curves(&c.to_linkage([], &all()).unwrap()));
        assert!(is_same_curve(&original, &first) && is_same_curve(&original, &second), "{four_bar:?}");
    }
}

/// In Cayley's diagram the links on the third pivot, each parallel to a link of the others, end at the corners of the
/// others' triangles, for any four-bar and on every circuit.
#[test]
fn cayleys_diagram_closes() {
    let template = catalogue::find("cognates").unwrap();
    for values in [
        [4.0, 1.5, 3.0, 3.5, 1.8, 1.3],
        [4.0, 3.0, 1.5, 3.5, 0.6, 1.2],
        [1.5, 3.0, 3.5, 4.0, 2.0, -1.5],
        [4.0, 2.5, 2.0, 2.5, 1.0, -1.7],
        [2.0, 1.0, 2.6, 2.6, 5.2, 0.0],
        [3.0, 2.0, 1.0, 2.0, -0.4, 0.3],
    ] {
        let linkage = template.linkage(&values).unwrap();
        let linkage = Linkage {
            motion_options: MotionOptions { circuits: CircuitSelection::All, ..linkage.motion_options.clone() },
            ..linkage
        };
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(90)));
        let joint = |name: &str| linkage.find_joint(name).unwrap();
        let pairs = [["H", "E"], ["I", "G"]].map(|pair| pair.map(joint));
        assert!(motion.is_assembled());
        for circuit in &motion.circuits {
            for (i, [one, other]) in (0..circuit.len()).flat_map(|i| pairs.map(|pair| (i, pair))) {
                let [one, other] = [one, other].map(|joint| circuit.positions.point(joint, i));
                // Rounding of six sums of coordinates of the order of ten.
                assert!((one - other).norm() < 5e-14, "{values:?} at {}: {one} {other}", circuit.inputs[i]);
            }
        }
        // The cognates of the diagram are those computed from the first four-bar.
        let cognates =
            Cognates::from_four_bar(PlacedFourBar::from_linkage(&linkage, linkage.traced[0]).unwrap()).unwrap();
        let length = |name: &str, other: &str| {
            let [from, to] = [name, other].map(joint);
            let places = linkage.links.iter().find_map(|link| Some((link.position(from)?, link.position(to)?)));
            places.map(|(from, to)| (to - from).norm()).unwrap()
        };
        for (cognate, [pivot, own, shared, end]) in
            cognates.others.iter().zip([["O", "D", "E", "H"], ["C", "F", "G", "I"]])
        {
            let FourBar { frame, crank, coupler, rocker } = cognate.four_bar.lengths;
            let own = [length(pivot, "Q"), length(pivot, own), length(own, shared), length("Q", end)];
            let computed = if cognate.counterparts[0] == MovingLink::Coupler {
                [frame, crank, coupler, rocker]
            } else {
                [frame, rocker, coupler, crank]
            };
            assert!(own.iter().zip(computed).all(|(a, b)| (a - b).abs() < 1e-14 * (a + b)), "{own:?} {computed:?}");
        }
    }
}

/// Assembling the cognates of a point of a grid removes the other points, so that all three couplers are seen to share
/// it.
#[test]
fn cognates_of_a_grid_point_keep_only_that_point() {
    let linkage = crate::catalogue::default_linkage("hrones-nelson");
    let joint = linkage.traced[2];
    let assembled = Cognates::assemble(&linkage, joint).unwrap();
    let carriers = assembled.links.iter().filter(|link| link.position(joint).is_some()).count();
    assert_eq!((carriers, assembled.links.len() - linkage.links.len()), (3, 6));
    assert!(
        linkage
            .traced
            .iter()
            .all(|&other| assembled.links.iter().all(|link| other == joint || link.position(other).is_none()))
    );
    assert_eq!(assembled.joints[joint].name, "M3");
}

#[test]
fn errors_say_why_there_are_no_cognates() {
    let bars = |along, across| PlacedFourBar {
        pivots: [Point::origin(), Point::new(4.0, 0.0)],
        lengths: FourBar { frame: 4.0, crank: 1.0, coupler: 3.0, rocker: 3.5 },
        coupler_point: Vector::new(along, across),
    };
    assert_eq!(Cognates::from_four_bar(bars(0.0, 0.0)), Err(CognateError::CouplerPointOnPin { pin: "crank" }));
    assert_eq!(Cognates::from_four_bar(bars(3.0, 1e-14)), Err(CognateError::CouplerPointOnPin { pin: "rocker" }));
    let linkage = bars(1.0, 1.0).to_linkage(Side::Left, all()).unwrap();
    let pin = |joint: JointId| PlacedFourBar::from_linkage(&linkage, joint);
    assert_eq!(pin(JointId::new(0)), Err(CognateError::NotOnCoupler { joint: "O".to_owned() }));
    assert_eq!(
        Cognates::assemble(&linkage, JointId::new(2)).unwrap_err(),
        CognateError::CouplerPointOnPin { pin: "crank" }
    );
    let klann = crate::catalogue::default_linkage("klann");
    assert_eq!(PlacedFourBar::from_linkage(&klann, klann.traced[0]), Err(CognateError::NotFourBar));
}

/// Both cognates of Chebyshev's linkage are Evans's at half size, whose cranks turn as its coupler: crank 1/2, frame
/// p/2, coupler and rocker r/2, and the coupler point a coupler length beyond the rocker pin. And a cognate of Evans's
/// is Chebyshev's at twice the size.
#[test]
fn chebyshevs_cognate_is_evanss_at_half_size() {
    let [chebyshev, evans] = ["chebyshev", "evans"].map(|id| catalogue::find(id).unwrap());
    for k in 0..=89 {
        let p = 1.1 + 0.1 * f64::from(k);
        let a = trig::pow(1.0 + p, 1.5) / 2.0;
        // p, r, s, a and p, r, a, s, k.
        let chebyshev = chebyshev.linkage(&[p, a, a, 1.0, 0.5]).unwrap();
        let evans = evans.linkage(&[p, 1.0, a, a, 2.0]).unwrap();
        let [placed_chebyshev, placed_evans] =
            [&chebyshev, &evans].map(|linkage| PlacedFourBar::from_linkage(linkage, linkage.traced[0]).unwrap());
        let close = |x: f64, y: f64| (x - y).abs() <= 4.0 * f64::EPSILON * (x.abs() + y.abs());
        let is_scaled = |one: &PlacedFourBar, other: &PlacedFourBar, by: f64| {
            let list = |b: &PlacedFourBar| {
                [
                    b.lengths.frame,
                    b.lengths.crank,
                    b.lengths.coupler,
                    b.lengths.rocker,
                    b.coupler_point.x,
                    b.coupler_point.y,
                ]
            };
            list(one).into_iter().zip(list(other)).all(|(x, y)| close(x, by * y))
        };
        let cognates = Cognates::from_four_bar(placed_chebyshev).unwrap();
        assert!(close(cognates.third_pivot.x, p / 2.0) && cognates.third_pivot.y == 0.0);
        for cognate in cognates.others {
            assert!(is_scaled(&cognate.four_bar, &placed_evans, 0.5), "p = {p}: {cognate:?}");
            assert_eq!(cognate.counterparts[0], MovingLink::Coupler, "crank-driven where Chebyshev's coupler turns");
            assert_eq!(cognate.four_bar.lengths.class(), FourBarClass::CrankRocker);
        }
        let back = Cognates::from_four_bar(placed_evans).unwrap().others[0];
        assert!(is_scaled(&back.four_bar, &placed_chebyshev, 2.0), "p = {p}: {back:?}");
        // The curves they trace agree as well.
        if k % 10 > 0 {
            continue;
        }
        let [one, other] = [
            chebyshev.clone(),
            cognates.others[0].to_linkage(poses(&chebyshev, 90), &chebyshev.motion_options).unwrap(),
        ]
        .map(|linkage| curves(&linkage));
        assert!(is_same_curve(&one, &other), "p = {p}");
    }
}
