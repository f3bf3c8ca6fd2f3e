//! The choice of the pose a linkage is drawn in.

use super::mechanism::sliding_line;
use coupler_curves::geometry::{Point, cross, distance_to_segment};
use coupler_curves::linkage::{BranchArc, DyadId, JointId, JointKind, Linkage};
use coupler_curves::measure::{self, TracedCurve};
use coupler_curves::motion::{self, Circuit};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The positions of all joints in the clearest pose of a circuit.
///
/// A pose is clear if no two joints, and no joint and link, are close to each other, and if no two links that meet are
/// nearly collinear: its clarity is the least of those distances times the least sine of the angles between links that
/// meet. Poses within one percent of the greatest clarity count as equal; the result is the first of them. If the source
/// of the linkage shows an arc, the pose is on it; otherwise its joints are on the sides that the key states, where a circuit has such poses.
pub(super) fn clearest_pose(linkage: &Linkage, circuit: &Circuit) -> Vec<Point> {
    /// More candidates than this make no visible difference.
    const CANDIDATES: usize = 360;
    // The frame counts as a link: a crank that lies on it cannot be seen.
    let mut links: Vec<_> = circuit.link_outlines(linkage).into_iter().map(|outline| outline.joints).collect();
    links.push(linkage.pivots());
    for joint in linkage.joint_ids() {
        let Some([foot, through]) = sliding_line(linkage, joint) else { continue };
        // The link with a slot extends to the joint that slides in it; the line of an actuator is a separate link.
        let is_slot = matches!(linkage.joints[joint].kind, JointKind::Slot { .. } | JointKind::Yoke { .. });
        let carrier = links.iter_mut().filter(|_| is_slot);
        match carrier.into_iter().find_map(|link| Some((link.iter().position(|joint| *joint == foot)?, link))) {
            Some((at, carrier)) if !carrier.contains(&through) => carrier.insert(at + 1, through),
            Some(_) => {}
            None => links.push(vec![foot, through]),
        }
    }
    merge_coincident_joints(&mut links, circuit);
    let pose = |sample: usize| -> Vec<Point> {
        linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect()
    };
    let clarity = |at: &[Point]| {
        let clearance = clearance(&links, at);
        // Sliders alone are never near another joint: those poses are clear in which links are not across their lines.
        if !clearance.is_finite() {
            return min_slider_cosine(linkage, &links, at);
        }
        clearance * min_link_angle_sine(&links, at)
    };
    let arc_samples = samples_on_arc(linkage, circuit);
    let samples = if arc_samples.is_empty() { samples_on_stated_sides(linkage, circuit) } else { arc_samples };
    let stride = samples.len().div_ceil(CANDIDATES).max(1);
    let all: Vec<(usize, f64)> =
        samples.into_iter().step_by(stride).map(|sample| (sample, clarity(&pose(sample)))).collect();
    let best = all.iter().map(|(_, clarity)| *clarity).fold(0.0, f64::max);
    pose(all.iter().find(|(_, clarity)| *clarity >= 0.99 * best).map_or(0, |(sample, _)| *sample))
}

/// The samples on the arc that the source of the linkage shows.
fn samples_on_arc(linkage: &Linkage, circuit: &Circuit) -> Vec<usize> {
    let Some(BranchArc { input_deg: [from, to], branch }) = linkage.motion_options.figure_arc else {
        return Vec::new();
    };
    let is_on_arc = |sample: &usize| {
        // The arc is given within one turn; the circuit may take several.
        let past = (circuit.inputs[*sample] - from).rem_euclid(360.0);
        past <= to - from && circuit.mode_at(*sample).sign(DyadId::FIRST) == branch
    };
    (0..circuit.len()).filter(is_on_arc).collect()
}

/// The samples with the sides of the linkage's definition; all if there are none, and of a group, in which no sides are stated.
fn samples_on_stated_sides(linkage: &Linkage, circuit: &Circuit) -> Vec<usize> {
    let stated = linkage.motion_options.mode;
    let is_stated = |sample: &usize| linkage.group.is_none() && circuit.mode_at(*sample) == stated;
    let samples: Vec<usize> = (0..circuit.len()).filter(is_stated).collect();
    if samples.is_empty() { (0..circuit.len()).collect() } else { samples }
}

/// Replaces joints that coincide over the whole circuit by the first of them: their distance is zero in every pose.
fn merge_coincident_joints(links: &mut [Vec<JointId>], circuit: &Circuit) {
    for joint in links.iter_mut().flatten() {
        *joint =
            (0..joint.index()).map(JointId::new).find(|&earlier| circuit.coincide(earlier, *joint)).unwrap_or(*joint);
    }
    for link in links {
        link.dedup();
    }
}

/// The least distance of two joints that share no link, or of a joint and a link it is not on.
fn clearance(links: &[Vec<JointId>], at: &[Point]) -> f64 {
    let mut joints: Vec<JointId> = links.iter().flatten().copied().collect();
    joints.sort_unstable();
    joints.dedup();
    let mut least = f64::INFINITY;
    for (k, &joint) in joints.iter().enumerate() {
        for &other in &joints[..k] {
            // Joints of one link have a fixed distance, which says nothing about the pose.
            if !links.iter().any(|link| link.contains(&joint) && link.contains(&other)) {
                least = least.min((at[joint] - at[other]).norm());
            }
        }
        // The foot of a slot without offset is its pivot, and so it lies on the frame.
        let is_on = |link: &&Vec<JointId>| link.iter().any(|&other| at[other] == at[joint]);
        for link in links.iter().filter(|link| !is_on(link)) {
            for pair in link.windows(2) {
                least = least.min(distance_to_segment(at[joint], at[pair[0]], at[pair[1]]));
            }
        }
    }
    least
}

/// The least sine of the angles at which links meet.
fn min_link_angle_sine(links: &[Vec<JointId>], at: &[Point]) -> f64 {
    let mut least: f64 = 1.0;
    for (k, link) in links.iter().enumerate() {
        for other in &links[..k] {
            for pin in link.iter().filter(|joint| other.contains(joint)) {
                let arms =
                    |link: &[JointId]| link.iter().filter(|j| *j != pin).map(|&j| at[j] - at[*pin]).collect::<Vec<_>>();
                for a in arms(link) {
                    for b in arms(other) {
                        let lengths = a.norm() * b.norm();
                        if lengths > 0.0 {
                            least = least.min(cross(a, b).abs() / lengths);
                        }
                    }
                }
            }
        }
    }
    least
}

/// The least cosine of the angles between links and the lines on which their joints slide, 0 at a dead point.
fn min_slider_cosine(linkage: &Linkage, links: &[Vec<JointId>], at: &[Point]) -> f64 {
    let mut least: f64 = 1.0;
    for (slider, [from, to]) in linkage.joint_ids().filter_map(|joint| Some((joint, linkage.slider_line(joint)?))) {
        let line = at[to] - at[from];
        for other in links.iter().filter(|link| link.contains(&slider)).flatten().filter(|other| **other != slider) {
            let arm = at[*other] - at[slider];
            let lengths = arm.norm() * line.norm();
            if lengths > 0.0 {
                least = least.min(arm.dot(&line).abs() / lengths);
            }
        }
    }
    least
}

/// The poses of a linkage at the limits of its input on the circuit of a curve, or at those of its output if the input
/// turns fully.
pub(super) fn limits(solved: &SolvedCell, curve: &MeasuredCurve) -> Vec<Vec<Point>> {
    let circuit = solved.circuit(curve);
    if !circuit.is_full_turn() {
        return limit_poses(&solved.linkage, circuit);
    }
    let traced = TracedCurve::new(&solved.linkage, &solved.motion, circuit, curve.joint);
    measure::output_limit_poses(&traced).map(Vec::from).unwrap_or_default()
}

/// The poses of a circuit at which the input reverses.
pub(super) fn limit_poses(linkage: &Linkage, circuit: &Circuit) -> Vec<Vec<Point>> {
    let passes = &circuit.passes;
    let pose = |k: usize| motion::pose(linkage, &passes[k], passes[k].to.input.value);
    (0..passes.len()).filter(|&k| circuit.reverses_after(k)).map(pose).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::catalogue;
    use coupler_curves::family::{Family, Sampling};
    use coupler_curves::solve::Solver;

    /// Linkages whose joints change their sides are shown on those that their keys state.
    #[test]
    fn joints_are_on_the_sides_that_are_stated() {
        for (id, [from, to, joint], is_left) in [
            ("linear-actuator", ["C", "O", "A"], false),
            ("watt", ["A", "C", "B"], true),
            ("evans", ["A", "C", "B"], true),
            ("rack-steering", ["N", "K", "B"], true),
            ("rack-steering", ["P", "L", "D"], false),
        ] {
            let template = catalogue::find(id).unwrap();
            let missing = template.parameters.iter().filter(|parameter| parameter.default_text.is_empty());
            let given: Vec<(String, f64)> = missing.map(|own| (own.name.clone(), own.starting_value())).collect();
            let family = Family::single_cell(template, &given, Sampling::Samples(180)).unwrap();
            let solved = Solver::new(&family).solve(0).unwrap();
            let pose = clearest_pose(&solved.linkage, &solved.motion.circuits[0]);
            let [from, to, joint] =
                [from, to, joint].map(|name| pose[solved.linkage.find_joint(name).unwrap().index()]);
            assert_eq!(cross(to - from, joint - from) > 0.0, is_left, "{id}");
        }
    }
}
