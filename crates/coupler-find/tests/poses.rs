//! Linkages that guide a body, of poses that are moved, turned, scaled, mirrored and taken at another point of the body.

use coupler_curves::geometry::{Point, trig};
use coupler_find::{
    BodyPose, Effort, Freedom, Guide, OneAtATime, PoseAnswer, PoseOptions, PoseSet, exact_guides, nearest_guides,
};

/// Poses of the coupler of a crank-rocker: frame 4 from the origin, crank 1.5, coupler 3, rocker 3.5, at angles of its crank in degrees.
fn crank_rocker(inputs_deg: &[f64]) -> Vec<BodyPose> {
    let pose = |input: &f64| {
        let (cos, sin) = trig::cos_sin_deg(*input);
        let [ax, ay] = [1.5 * cos, 1.5 * sin];
        let [dx, dy] = [4.0 - ax, -ay];
        let square = dx * dx + dy * dy;
        let along = (9.0 - 3.5 * 3.5 + square) / (2.0 * square);
        let across = (9.0 / square - along * along).sqrt();
        let [ux, uy] = [(dx * along - dy * across) / 3.0, (dy * along + dx * across) / 3.0];
        let point = Point::new(ax + 2.0 * ux - uy, ay + 2.0 * uy + ux);
        BodyPose { point, angle_deg: trig::degrees(trig::atan2(uy, ux)) + 17.0 }
    };
    inputs_deg.iter().map(pose).collect()
}

const INPUTS: [f64; 5] = [30.0, 60.0, 110.0, 150.0, 200.0];

fn options() -> PoseOptions {
    PoseOptions { full_turn: false, max_link: f64::INFINITY, effort: Effort::Quick, most: 20, ..PoseOptions::default() }
}

fn answers(poses: &[BodyPose]) -> Vec<PoseAnswer> {
    let set = PoseSet::new(poses).unwrap();
    exact_guides(&set, &options(), &OneAtATime).answers
}

/// The lengths of a four-bar: frame, crank, coupler, rocker.
fn lengths(answer: &PoseAnswer) -> [f64; 4] {
    match &answer.guide {
        Guide::FourBar(four_bar) => {
            let lengths = four_bar.lengths;
            [lengths.frame, lengths.crank, lengths.coupler, lengths.rocker]
        }
        Guide::SliderCrank(_) => panic!("it has two pivots"),
        Guide::InvertedSliderCrank(_) => panic!("it is a four-bar"),
    }
}

#[test]
fn the_answers_move_with_the_poses() {
    let poses = crank_rocker(&INPUTS);
    let own = answers(&poses);
    assert!(own.len() >= 2);
    let is_own = |answer: &PoseAnswer| {
        lengths(answer).iter().zip([4.0, 1.5, 3.0, 3.5]).all(|(found, expected)| (found - expected).abs() < 1e-9)
    };
    assert!(own.iter().any(is_own), "{own:?}");
    let (cos, sin) = trig::cos_sin_deg(77.0);
    let moved = |pose: &BodyPose, scale: f64, mirror: f64| {
        let [x, y] = [scale * pose.point.x, mirror * scale * pose.point.y];
        let point = Point::new(100.0 + cos * x - sin * y, -40.0 + sin * x + cos * y);
        BodyPose { point, angle_deg: mirror * pose.angle_deg + 77.0 + 720.0 }
    };
    for (scale, mirror) in [(1.0, 1.0), (1e-3, 1.0), (1e6, -1.0), (1.0, -1.0)] {
        let poses: Vec<BodyPose> = poses.iter().map(|pose| moved(pose, scale, mirror)).collect();
        let found = answers(&poses);
        assert_eq!(found.len(), own.len(), "{scale} {mirror}");
        for (a, b) in found.iter().zip(&own) {
            let differ = lengths(a).iter().zip(lengths(b)).map(|(a, b)| (a / scale - b).abs() / b).fold(0.0, f64::max);
            assert!(differ < 1e-6, "{scale} {mirror}: {a:?}\n{b:?}");
            assert_eq!(a.branch, if mirror > 0.0 { b.branch } else { -b.branch });
        }
    }
    // The same poses backward, and another point of the body.
    let backward: Vec<BodyPose> = poses.iter().rev().copied().collect();
    let elsewhere = |pose: &BodyPose| {
        let (cos, sin) = trig::cos_sin_deg(pose.angle_deg);
        BodyPose { point: Point::new(pose.point.x + 3.0 * cos + sin, pose.point.y + 3.0 * sin - cos), ..*pose }
    };
    let elsewhere: Vec<BodyPose> = poses.iter().map(elsewhere).collect();
    for poses in [backward, elsewhere] {
        let found = answers(&poses);
        assert_eq!(found.len(), own.len());
        assert!(found.iter().any(is_own), "{found:?}");
    }
}

#[test]
fn another_order_is_left_out_unless_it_is_allowed() {
    let mut poses = crank_rocker(&INPUTS);
    poses.swap(1, 2);
    let set = PoseSet::new(&poses).unwrap();
    let found = exact_guides(&set, &options(), &OneAtATime);
    let of_order: Vec<_> = found.pairs_left_out.iter().filter(|pair| !pair.order.is_empty()).collect();
    assert!(of_order.iter().any(|pair| pair.order == [1, 3, 2, 4, 5]), "{:?}", found.pairs_left_out);
    assert!(found.answers.iter().all(|answer| answer.in_order));
    let any = exact_guides(&set, &PoseOptions { any_order: true, ..options() }, &OneAtATime);
    assert!(any.answers.len() > found.answers.len());
    assert!(any.answers.iter().any(|answer| !answer.in_order && answer.on_one_branch));
    let circuits = exact_guides(&set, &PoseOptions { any_order: true, any_circuit: true, ..options() }, &OneAtATime);
    assert_eq!(circuits.answers.len() + circuits.left_out.values().sum::<usize>(), circuits.pairs);
    assert!(circuits.answers.len() > any.answers.len());
    for answer in &circuits.answers {
        assert!(answer.greatest_error().distance < 1e-7 * set.size(), "{answer:?}");
    }
}

#[test]
fn a_turn_of_the_body_that_is_repeated_is_no_obstacle() {
    // Two poses of the same direction have their pole at infinity.
    let mut poses = crank_rocker(&[20.0, 70.0, 120.0]);
    poses.push(BodyPose { point: Point::new(poses[0].point.x + 1.0, poses[0].point.y - 0.5), ..poses[0] });
    let set = PoseSet::new(&poses).unwrap();
    let found = exact_guides(&set, &PoseOptions { any_order: true, any_circuit: true, ..options() }, &OneAtATime);
    assert_eq!(found.freedom, Freedom::Curve);
    assert!(!found.answers.is_empty());
    for answer in &found.answers {
        assert!(answer.greatest_error().distance < 1e-7 * set.size(), "{answer:?}");
    }
}

#[test]
fn more_poses_than_five_are_passed_by_the_four_bar_that_has_them() {
    let inputs: Vec<f64> = (0..12).map(|k| 20.0 + 25.0 * f64::from(k)).collect();
    let set = PoseSet::new(&crank_rocker(&inputs)).unwrap();
    let found = nearest_guides(&set, &PoseOptions { full_turn: true, ..options() }, &OneAtATime);
    let best = &found.answers[0];
    assert!(best.rms(set.size()) < 1e-8 * set.size());
    assert!(best.is_full_turn && best.in_order && best.on_one_branch);
    assert!((lengths(best)[1] - 1.5).abs() < 1e-6, "{best:?}");
}
