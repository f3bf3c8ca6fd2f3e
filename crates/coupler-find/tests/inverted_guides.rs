//! Inverted slider-cranks that guide a body, of the poses of random ones.

use coupler_curves::geometry::{Point, trig};
use coupler_find::{
    BodyPose, Effort, Freedom, Guide, OneAtATime, PlacedInvertedSliderCrank, PoseAnswer, PoseCondition, PoseFindings,
    PoseOptions, PoseSet, exact_guides, nearest_guides,
};
use nalgebra::Complex;

/// Numbers from 0 to 1, from a seed.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// An inverted slider-crank, from the intersection of a line through the crank pin with a circle about the block's pivot.
#[derive(Clone, Copy, Debug)]
struct Inverted {
    pivots: [Complex<f64>; 2],
    crank: f64,
    /// How far the block's pivot is to the right of the line.
    offset: f64,
    point: Complex<f64>,
    /// The direction of the body from that of the line, in degrees.
    turn_deg: f64,
    inputs_deg: [f64; 2],
}

impl Inverted {
    /// A random one that moves from the first of its inputs to the second without a limit.
    fn random(seed: u64) -> Inverted {
        let mut numbers = Numbers(seed.wrapping_mul(7919));
        // The first numbers of seeds near each other are alike.
        for _ in 0..10 {
            numbers.next(0.0, 1.0);
        }
        loop {
            let mut place = || Complex::new(numbers.next(-1.0, 1.0), numbers.next(-1.0, 1.0));
            let [o, c, point] = [place(), place(), place()];
            let crank = numbers.next(0.3, 1.5);
            let start = numbers.next(0.0, 360.0);
            let inverted = Inverted {
                pivots: [o, c],
                crank,
                offset: numbers.next(-0.8, 0.8),
                point,
                turn_deg: numbers.next(0.0, 360.0),
                inputs_deg: [start, start + numbers.next(60.0, 240.0)],
            };
            let distances = (0..=200).map(|k| inverted.pins(f64::from(k) / 200.0)).map(|[a, c]| (c - a).norm());
            if distances.fold(f64::INFINITY, f64::min) > 1.02 * inverted.offset.abs() + 0.05 && (c - o).norm() > 0.3 {
                return inverted;
            }
        }
    }

    /// The crank pin and the block's pivot, at a part of the motion.
    fn pins(&self, part: f64) -> [Complex<f64>; 2] {
        let [from, to] = self.inputs_deg;
        let (cos, sin) = trig::cos_sin_deg(from + part * (to - from));
        [self.pivots[0] + Complex::new(cos, sin) * self.crank, self.pivots[1]]
    }

    fn pose(&self, part: f64) -> BodyPose {
        let [a, c] = self.pins(part);
        let slide = ((c - a).norm_sqr() - self.offset * self.offset).sqrt();
        let along = (c - a) / Complex::new(slide, -self.offset);
        let point = a + along * self.point;
        BodyPose {
            point: Point::new(point.re, point.im),
            angle_deg: trig::degrees(trig::atan2(along.im, along.re)) + self.turn_deg,
        }
    }

    fn poses(&self, count: usize) -> Vec<BodyPose> {
        (0..count).map(|k| self.pose(k as f64 / (count - 1) as f64)).collect()
    }

    fn points(&self) -> [Point; 2] {
        self.pivots.map(|z| Point::new(z.re, z.im))
    }

    /// The greatest difference of an answer's dimensions.
    fn difference(&self, answer: &PlacedInvertedSliderCrank) -> f64 {
        let places = answer.pivots.iter().zip(self.points()).map(|(own, other)| (own - other).norm());
        let point = Complex::new(answer.coupler_point.x, answer.coupler_point.y);
        let lengths = [answer.crank - self.crank, answer.offset - self.offset, (point - self.point).norm()];
        places.chain(lengths.map(f64::abs)).fold(0.0, f64::max)
    }
}

fn options() -> PoseOptions {
    PoseOptions { full_turn: false, max_link: f64::INFINITY, effort: Effort::Quick, most: 20, ..PoseOptions::default() }
}

fn found(poses: &[BodyPose], options: &PoseOptions) -> PoseFindings {
    exact_guides(&PoseSet::new(poses).unwrap(), options, &OneAtATime)
}

fn inverted(answers: &[PoseAnswer]) -> impl Iterator<Item = (&PoseAnswer, &PlacedInvertedSliderCrank)> {
    answers.iter().filter_map(|answer| match &answer.guide {
        Guide::InvertedSliderCrank(guide) => Some((answer, guide)),
        Guide::FourBar(_) | Guide::SliderCrank(_) => None,
    })
}

/// Checks that an answer passes the poses, in order on one branch.
fn check_passes(answer: &PoseAnswer, size: f64, seed: u64) {
    let error = answer.greatest_error();
    assert!(error.distance < 1e-9 * size && error.angle_deg < 1e-7, "{seed}: {error:?} of {answer:?}");
    assert!(answer.in_order && answer.on_one_branch, "{seed}: {answer:?}");
}

#[test]
fn the_pivots_of_three_poses_give_the_linkage() {
    for seed in 1..=60 {
        let own = Inverted::random(seed);
        let poses = own.poses(3);
        let all = found(&poses, &PoseOptions { given_pivots: own.points().to_vec(), ..options() });
        let (answer, guide) = inverted(&all.answers).next().unwrap_or_else(|| panic!("{seed}: {:?}", all.left_out));
        assert!(own.difference(guide) < 1e-8, "{seed}: {guide:?} of {own:?}");
        check_passes(answer, PoseSet::new(&poses).unwrap().size(), seed);
    }
}

#[test]
fn five_poses_give_the_linkage() {
    for seed in 1..=60 {
        let own = Inverted::random(seed);
        let poses = own.poses(5);
        let all = found(&poses, &options());
        assert_eq!(all.freedom, Freedom::Points);
        let is_own = |guide: &PlacedInvertedSliderCrank| own.difference(guide) < 1e-7;
        let answer = inverted(&all.answers).find(|(_, guide)| is_own(guide));
        let (answer, _) = answer.unwrap_or_else(|| panic!("{seed}: {:?} {:?} of {own:?}", all.left_out, all.dyads));
        check_passes(answer, PoseSet::new(&poses).unwrap().size(), seed);
    }
}

#[test]
fn the_block_of_four_poses_is_that_of_the_linkage() {
    let condition = Some(PoseCondition::new("frame > offset and crank > 0").unwrap());
    let mut count = 0;
    for seed in 1..=6 {
        let own = Inverted::random(seed);
        let poses = own.poses(4);
        let all = found(&poses, &PoseOptions { condition: condition.clone(), max_link: 10.0, ..options() });
        let size = PoseSet::new(&poses).unwrap().size();
        for (answer, guide) in inverted(&all.answers) {
            assert!((guide.pivots[1] - own.points()[1]).norm() < 1e-9 * size, "{seed}: {guide:?} of {own:?}");
            check_passes(answer, size, seed);
            assert!(answer.longest_link <= 10.0 * size);
            count += 1;
        }
        assert!(inverted(&all.answers).next().is_some(), "{seed}: {:?}", all.left_out);
    }
    assert!(count > 20, "{count}");
}

#[test]
fn two_poses_have_slots_of_given_pivots() {
    let condition = Some(PoseCondition::new("frame > offset and crank > 0").unwrap());
    for seed in 1..=3 {
        let own = Inverted::random(seed);
        let poses = own.poses(2);
        let given_pivots = own.points().to_vec();
        let all = found(&poses, &PoseOptions { condition: condition.clone(), given_pivots, ..options() });
        let (answer, _) = inverted(&all.answers).next().unwrap_or_else(|| panic!("{seed}: {:?}", all.left_out));
        check_passes(answer, PoseSet::new(&poses).unwrap().size(), seed);
    }
}

#[test]
fn mirrored_moved_and_scaled_poses_have_the_same_linkage() {
    let (cos, sin) = trig::cos_sin_deg(77.0);
    for seed in 1..=4 {
        let poses = Inverted::random(seed).poses(5);
        let own = found(&poses, &options()).answers;
        for (scale, mirror) in [(1e-3, 1.0), (1e6, -1.0), (1.0, -1.0)] {
            let moved = |pose: &BodyPose| {
                let [x, y] = [scale * pose.point.x, mirror * scale * pose.point.y];
                let point = Point::new(scale * 3.0 + cos * x - sin * y, -scale + sin * x + cos * y);
                BodyPose { point, angle_deg: mirror * pose.angle_deg + 77.0 }
            };
            let other = found(&poses.iter().map(moved).collect::<Vec<_>>(), &options()).answers;
            assert_eq!(inverted(&other).count(), inverted(&own).count());
            for ((a, guide), (b, first)) in inverted(&other).zip(inverted(&own)) {
                let pairs = [
                    (guide.crank, first.crank),
                    (guide.offset, mirror * first.offset),
                    (guide.coupler_point.x, first.coupler_point.x),
                    (guide.coupler_point.y, mirror * first.coupler_point.y),
                    (a.longest_link, b.longest_link),
                ];
                for (value, expected) in pairs {
                    assert!((value / scale - expected).abs() < 1e-7, "{seed} {scale} {mirror}: {guide:?} {first:?}");
                }
                assert!((a.mu_worst_deg[1] - b.mu_worst_deg[1]).abs() < 1e-5);
            }
        }
    }
}

#[test]
fn many_poses_give_the_linkage() {
    for seed in 1..=3 {
        let own = Inverted::random(seed);
        let set = PoseSet::new(&own.poses(9)).unwrap();
        let all = nearest_guides(&set, &PoseOptions { most: 3, ..options() }, &OneAtATime);
        let near = |answer: &&PoseAnswer| answer.rms(set.size()) < 1e-8 * set.size();
        assert!(all.answers.iter().any(|answer| near(&answer)), "{seed}: {:?}", all.left_out);
        assert!(inverted(&all.answers).any(|(answer, guide)| near(&answer) && own.difference(guide) < 1e-5), "{seed}");
    }
}
