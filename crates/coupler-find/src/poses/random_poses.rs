//! Poses of random four-bars, for tests.

use super::body::{BodyPose, PoseSet};
use crate::complex::{Complex, length, unit};
use crate::scatter::Scatter;
use coupler_curves::geometry::{Point, trig};

/// Poses of the coupler of a random four-bar on one branch, at rising angles of its crank; and its two dyads, each the pivot and the pin
/// in the first pose, in sizes of the poses.
pub fn random_poses(count: usize, seed: u64) -> (PoseSet, [[Complex; 2]; 2]) {
    let mut scatter = Scatter::new(seed);
    loop {
        let mut point = || Complex::new(scatter.normal(1.0), scatter.normal(1.0));
        let pivots = [point(), point()];
        let [across, of_body] = [point(), point()];
        let lengths = point();
        let (crank, rocker, coupler) = (0.3 + lengths.re.abs(), 0.5 + lengths.im.abs(), 0.5 + length(across));
        let start = scatter.normal(3.0);
        let step = 0.3 + scatter.normal(0.4).abs();
        let pose = |k: f64| {
            let a = pivots[0] + unit(start + step * k) * crank;
            let base = pivots[1] - a;
            let square = base.norm_sqr();
            let along = (coupler * coupler - rocker * rocker + square) / (2.0 * square);
            let height = coupler * coupler / square - along * along;
            (height > 0.01).then(|| {
                let b = a + base * Complex::new(along, height.sqrt());
                [a, b]
            })
        };
        // Assembled between the poses, too.
        const BETWEEN: usize = 40;
        let all = (0..=BETWEEN * (count - 1)).map(|k| pose(k as f64 / BETWEEN as f64));
        let Some(all) = all.collect::<Option<Vec<_>>>() else { continue };
        if step * count as f64 > 6.0 {
            continue;
        }
        let pins: Vec<[Complex; 2]> = all.into_iter().step_by(BETWEEN).collect();
        let body = |[a, b]: &[Complex; 2]| {
            let along = (b - a) / coupler;
            let p = a + along * of_body;
            BodyPose { point: Point::new(p.re, p.im), angle_deg: trig::degrees(trig::atan2(along.im, along.re)) }
        };
        let poses: Vec<BodyPose> = pins.iter().map(body).collect();
        let set = PoseSet::new(&poses).expect("they differ");
        let relative = |z: Complex| set.relative(Point::new(z.re, z.im));
        let dyads = [0, 1].map(|k| [relative(pivots[k]), relative(pins[0][k])]);
        return (set, dyads);
    }
}
