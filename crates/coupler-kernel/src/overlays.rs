//! What is drawn over a linkage on demand: its cognates, and the centrodes of the link that traces the curve.

use serde_json::{Value, json};

use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Cognates, FourBar, JointId, Link, PlacedFourBar};

use crate::response::Numbers;
use crate::study::Study;

/// The cognates of a study's linkage; `None` if it is not a four-bar that traces a point of its coupler.
pub(crate) fn cognates(study: &Study) -> Option<Cognates> {
    let placed = PlacedFourBar::from_linkage(&study.linkage, study.joint).ok()?;
    Cognates::from_four_bar(placed).ok()
}

/// The crank pins and the rocker pins of both cognates in a pose.
pub(crate) fn cognate_pins(study: &Study, cognates: &Cognates, pose: &[Point]) -> Option<[Point; 4]> {
    let pins = FourBar::pins(&study.linkage)?.map(|pin| pose[pin]);
    let [[a, b], [c, d]] = cognates.others.map(|cognate| cognate.pins(pins));
    Some([a, b, c, d])
}

/// The lengths of the linkage and of both cognates, with the coordinates of their coupler points; the pivots of both
/// cognates; and what their pins reach over the circuit.
pub(crate) fn cognates_json(study: &Study, numbers: &mut Numbers) -> Option<Value> {
    let cognates = cognates(study)?;
    let pivots = cognates.others.map(|cognate| numbers.points(cognate.four_bar.pivots));
    let pins =
        (0..study.circuit.len()).filter_map(|sample| cognate_pins(study, &cognates, &study.sampled_pose(sample)));
    let pins: Vec<Point> = pins.flatten().chain([cognates.third_pivot]).collect();
    let [first, second] = cognates.others.map(|cognate| cognate.four_bar);
    let lengths = [cognates.original, first, second].map(|PlacedFourBar { lengths, coupler_point, .. }| {
        json!({
            "frame": lengths.frame,
            "crank": lengths.crank,
            "coupler": lengths.coupler,
            "rocker": lengths.rocker,
            "along": coupler_point.x,
            "across": coupler_point.y,
        })
    });
    Some(json!({ "lengths": lengths, "pivots": pivots, "reached": numbers.points(pins) }))
}

/// The fixed centrode in the plane, and the moving one in the frame of the link, which has its origin at the first joint
/// of `frame` and its x-axis towards the second; `None` if the link only translates.
pub(crate) fn centrodes_json(study: &Study, samples: usize, numbers: &mut Numbers) -> Option<Value> {
    let frame = FourBar::coupler_pins(&study.linkage, study.joint).map(|[_, a, b, _]| [a, b]);
    let frame = frame.or_else(|| first_joints_of_link(study))?;
    let (mut fixed, mut moving) = (Vec::new(), Vec::new());
    for place in study.places(samples) {
        let instant = study.instant(&study.passes()[place.pass], place.input);
        let undefined = Point::new(f64::NAN, f64::NAN);
        fixed.push(instant.map_or(undefined, |instant| instant.pole));
        moving.push(instant.map_or(undefined, |instant| Point::from(instant.moving_pole)));
    }
    if fixed.iter().all(|p| p.x.is_nan()) {
        return None;
    }
    let frame = frame.map(|joint| joint.index());
    Some(json!({ "fixed": numbers.points(fixed), "moving": numbers.points(moving), "frame": frame }))
}

/// The joints that give the frame of the moving link with the traced point, as
/// [`coupler_curves::motion::InstantaneousMotion::from_joint`] chooses them.
fn first_joints_of_link(study: &Study) -> Option<[JointId; 2]> {
    let ground = study.linkage.ground();
    let is_own = |link: &&Link| !std::ptr::eq(*link, ground) && link.position(study.joint).is_some();
    let link = study.linkage.links.iter().find(is_own)?;
    let (first, from) = *link.joints.first()?;
    let (second, _) = link.joints.iter().find(|(_, place)| *place != from)?;
    Some([first, *second])
}
