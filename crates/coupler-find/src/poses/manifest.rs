//! A manifest that renders the linkages that guide a body.

use std::fmt::Write;

use super::answer::PoseAnswer;
use super::body::{BodyPose, PoseSet};
use super::guide::Guide;
use crate::report::manifest::rounded;
use crate::report::{format_length, manifest_head, title_for};
use coupler_curves::linkage_format::{quoted, toml_number};

/// A complete manifest that renders linkages where they are with the poses, each on a page; of none, one that says so.
pub fn poses_manifest(name: &str, set: &PoseSet, answers: &[PoseAnswer]) -> String {
    let mut out = manifest_head("find", &title_for(name));
    if answers.is_empty() {
        return out + "\n# No linkage passes the poses as asked for.\n";
    }
    out.push_str(
        "\n# Each linkage has a page with the poses of the body, which is fixed to the link of the traced point; layout = \"panels\" puts several on one.\n",
    );
    let mut forms: Vec<(String, Vec<(usize, &PoseAnswer)>)> = Vec::new();
    for (rank, answer) in (1..).zip(answers) {
        let form = form_of(answer);
        match forms.iter_mut().find(|(known, _)| *known == form) {
            Some((_, ranked)) => ranked.push((rank, answer)),
            None => forms.push((form, vec![(rank, answer)])),
        }
    }
    for (form, ranked) in &forms {
        append_family(form, name, set, ranked, &mut out);
    }
    out
}

/// The linkage of a family: a crank that turns fully has a circuit for each branch, and of others all circuits are drawn.
fn form_of(answer: &PoseAnswer) -> String {
    let branch = match (&answer.guide, answer.branch > 0) {
        _ if !answer.is_full_turn => "rocking",
        (Guide::FourBar(_) | Guide::InvertedSliderCrank(_), true) => "left",
        (Guide::FourBar(_) | Guide::InvertedSliderCrank(_), false) => "right",
        (Guide::SliderCrank(_), true) => "ahead",
        (Guide::SliderCrank(_), false) => "behind",
    };
    format!("{}-{branch}", answer.guide.name())
}

fn append_family(form: &str, name: &str, set: &PoseSet, ranked: &[(usize, &PoseAnswer)], out: &mut String) {
    let guide = &ranked[0].1.guide;
    let id = &guide.template().id;
    let mut linkage = guide.template_toml().replace(&format!("id = \"{id}\""), &format!("id = \"guide-{form}\""));
    if ranked[0].1.is_full_turn {
        linkage = linkage.replace("circuits = \"all\"", "circuits = \"start\"");
        linkage = linkage
            .replace("side = \"left\"", &format!("side = \"{}\"", &form[form.rfind('-').map_or(0, |at| at + 1)..]));
        linkage = linkage
            .replace("side = \"ahead\"", &format!("side = \"{}\"", &form[form.rfind('-').map_or(0, |at| at + 1)..]));
    }
    let words = form.replace(guide.name(), &format!("{}s,", guide.name())).replace(",-", ", ");
    let title = quoted(&format!("Linkages that guide a body: {name}, {words}"));
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "\n{linkage}\n[[family]]\nid = \"found-{form}\"\nlinkage = \"guide-{form}\"\ntitle = {title}\nlayout = \"poses\"\nposes = [\n{}]\n\
         caption = \"{{rank:.0}}: μ ≥ {{mu_poses:.1}}° at the poses\"\ncases = [\n",
        pose_lines(set)
    );
    for (rank, answer) in ranked {
        let error = answer.greatest_error();
        let inputs: Vec<String> = answer.inputs_deg.iter().map(|input| format!("{input:.3}°")).collect();
        let values = answer
            .guide
            .parameters()
            .into_iter()
            .map(|(name, value)| format!("{name} = {}", rounded(value, set.size())));
        let values: Vec<String> = values.collect();
        let _ = writeln!(
            out,
            "    # {rank}: crank at {}; greatest error {} and {}°\n    {{ rank = {rank}, mu_poses = {:.3}, {} }},",
            inputs.join(", "),
            format_length(error.distance, set.size()),
            format_length(error.angle_deg, 1.0),
            answer.mu_worst_deg[0],
            values.join(", ")
        );
    }
    out.push_str("]\n");
}

/// The poses as items of a list: x, y and the angle in degrees, with all digits.
fn pose_lines(set: &PoseSet) -> String {
    let line = |pose: &BodyPose| {
        let [x, y, angle_deg] = [pose.point.x, pose.point.y, pose.angle_deg].map(toml_number);
        format!("    [{x}, {y}, {angle_deg}],\n")
    };
    set.poses().iter().map(line).collect()
}
