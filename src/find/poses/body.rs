//! A body with its poses as pages show it, and how near a linkage comes to them.

use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::linkage::Input;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{BodyFrame, BodyPlaces, GuidedBody};
use coupler_find::{
    BodyPose, PassedPose, PoseSet, burmester_curves, burmester_dyads, format_length as number, passed_poses, poles,
};

/// Poses for a page; with the places that poses in general have: the poles of 2 and 3, the curves of the pivots and pins of 4, the dyads of 5.
pub fn guided_body(poses: &[BodyPose], has_places: bool) -> GuidedBody {
    let frame = |pose: &BodyPose| BodyFrame { origin: pose.point, angle_deg: pose.angle_deg };
    // Poses that no coupler passes, as those of a crank, have no such places.
    let set = PoseSet::new(poses).ok().filter(|_| has_places);
    GuidedBody { poses: poses.iter().map(frame).collect(), places: set.as_ref().map_or(Vec::new(), places) }
}

fn places(set: &PoseSet) -> Vec<BodyPlaces> {
    let mut all = Vec::new();
    if let Some([pivots, pins]) = burmester_curves(set) {
        let label = "the pivots of all dyads, the centre-point curve".to_owned();
        all.push(BodyPlaces { lines: pivots, label, ..BodyPlaces::default() });
        let label = "their pins at pose 1, the circle-point curve".to_owned();
        all.push(BodyPlaces { lines: pins, label, is_light: true, ..BodyPlaces::default() });
    }
    let dyads = burmester_dyads(set);
    let links = dyads.iter().filter_map(|dyad| Some(link(dyad.pin?, dyad.pivot?))).collect::<Vec<_>>();
    if !links.is_empty() {
        let marks = dyads.iter().flat_map(|dyad| dyad.pivot.into_iter().chain(dyad.pin));
        let marks = marks.map(|place| (place, String::new())).collect();
        let label = "all dyads of the poses, from the pivot to the pin at pose 1".to_owned();
        all.push(BodyPlaces { lines: links, marks, label, ..BodyPlaces::default() });
    }
    let poles = poles(set);
    if !poles.is_empty() {
        let marks = poles.into_iter().map(|([k, m], place)| (place, format!("P{k}{m}"))).collect();
        let label = "pole, about which the body turns from one pose to another".to_owned();
        all.push(BodyPlaces { marks, label, ..BodyPlaces::default() });
    }
    all
}

/// The link of a dyad, in short parts.
fn link(pin: Point, pivot: Point) -> Vec<Point> {
    const PARTS: usize = 100;
    (0..=PARTS).map(|k| pivot + (pin - pivot) * (k as f64 / PARTS as f64)).collect()
}

/// How a linkage passes poses, in words, and the positions of its joints at the first; `None` if it has no curve. With `has_inputs` the inputs at
/// the poses are said, if they are few.
pub fn passing(poses: &[BodyPose], solved: &SolvedCell, has_inputs: bool) -> Option<(String, Vec<Point>)> {
    /// The most poses whose inputs are said.
    const MOST: usize = 12;
    let passed = passed_poses(poses, solved);
    let first = passed.first()?;
    let mut text = nearness(poses, &passed);
    if passed.iter().any(|one| one.circuit != first.circuit) {
        text += ", on several circuits";
    }
    if has_inputs && passed.len() <= MOST {
        let is_length = solved.linkage.input() == Input::Length;
        let input = |one: &PassedPose| {
            if is_length { number(one.input, extent(poses)) } else { format!("{:.2}°", one.input.rem_euclid(360.0)) }
        };
        text += &format!("; input {}", passed.iter().map(input).collect::<Vec<_>>().join(", "));
    }
    Some((text, first.joints.clone()))
}

/// By how much the poses are missed.
fn nearness(poses: &[BodyPose], passed: &[PassedPose]) -> String {
    /// What is as good as exact, of the extent of the poses and in degrees: dimensions in a manifest have ten digits, and a limit of the input half
    /// of them.
    const EXACT: f64 = 1e-6;
    const EXACT_DEG: f64 = 1e-4;
    let greatest = |value: fn(&PassedPose) -> f64| {
        let numbered = (1..).zip(passed).map(|(number, one)| (number, value(one)));
        numbered.fold((1, 0.0), |worst: (usize, f64), next| if next.1 > worst.1 { next } else { worst })
    };
    let (far, distance) = greatest(|one| one.deviation.distance);
    let (turned, angle_deg) = greatest(|one| one.deviation.angle_deg.abs());
    let size = extent(poses);
    if distance <= EXACT * size && angle_deg <= EXACT_DEG {
        return match passed.len() {
            1 => "passes the pose".to_owned(),
            count => format!("passes the {count} poses"),
        };
    }
    let [distance, angle] = [number(distance, size), number(angle_deg, 1.0)];
    if passed.len() == 1 {
        return format!("misses the pose by {distance} and {angle}°");
    }
    format!("misses the poses by up to {distance}, at pose {far}, and {angle}°, at pose {turned}")
}

/// A length by which others are small or not.
fn extent(poses: &[BodyPose]) -> f64 {
    let size = Bounds::from_points(poses.iter().map(|pose| pose.point)).size().max();
    if size > 0.0 { size } else { 1.0 }
}
