//! Where dashes begin and end.

use super::trajectory::Trajectory;
use crate::linkage::{BranchArc, DyadId};
use crate::motion::Pass;

/// How a curve is cut into dashes: dash k starts at input `k * period` and spans `dash_span`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashPattern {
    /// The input from the start of a dash to that of the next, in degrees or lengths.
    pub period: f64,
    /// The input that a dash spans, in degrees or lengths.
    pub dash_span: f64,
}

/// A dash on a trajectory.
pub(super) struct DashRange {
    /// The parameters of its ends.
    pub range: [f64; 2],
    pub is_in_figure: bool,
}

/// The dashes of a circuit, in the order of the motion. A dash that contains a limit continues on the next pass.
pub(super) fn dash_ranges(trajectory: &Trajectory, pattern: DashPattern) -> Vec<DashRange> {
    let arc = trajectory.linkage.motion_options.figure_arc;
    let mut out: Vec<DashRange> = Vec::new();
    let mut continues = false;
    for (k, pass) in trajectory.circuit.passes.iter().enumerate() {
        let parts = cut_pass(pass, pattern, arc);
        for PassPart { ends, is_drawn, is_in_figure } in &parts {
            let range = ends.map(|input| trajectory.parameter(k, input));
            let last = out.last_mut().filter(|last| continues && last.is_in_figure == *is_in_figure);
            match last.filter(|_| *is_drawn && ends[0] == pass.from.input.value) {
                Some(last) => last.range[1] = range[1],
                None if *is_drawn => out.push(DashRange { range, is_in_figure: *is_in_figure }),
                None => {}
            }
        }
        continues = parts.last().is_some_and(|part| part.is_drawn);
    }
    out
}

/// A part of a pass: a dash or a gap, in the direction of the pass.
struct PassPart {
    /// The inputs of its ends.
    ends: [f64; 2],
    is_drawn: bool,
    is_in_figure: bool,
}

/// Cuts a pass into dashes and gaps, in the order of the pass.
fn cut_pass(pass: &Pass, pattern: DashPattern, arc: Option<BranchArc>) -> Vec<PassPart> {
    let [low, high] = pass.input_range();
    let mut cuts = vec![low, high];
    let mut k = (low / pattern.period).floor();
    while k * pattern.period < high {
        cuts.extend([k * pattern.period, k * pattern.period + pattern.dash_span]);
        k += 1.0;
    }
    // The arc is given within one turn; the pass may lie in another.
    let arc_of_branch = arc.filter(|arc| arc.branch == pass.mode.sign(DyadId::FIRST));
    let turn = ((low + high) / 720.0).floor() * 360.0;
    let arcs: Vec<[f64; 2]> = arc_of_branch
        .iter()
        .flat_map(|arc| [turn - 360.0, turn, turn + 360.0].map(|t| arc.input_deg.map(|deg| deg + t)))
        .collect();
    cuts.extend(arcs.iter().flatten());
    cuts.retain(|deg| (low..=high).contains(deg));
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    if pass.input_direction() < 0.0 {
        cuts.reverse();
    }
    let part = |ends: &[f64]| {
        let middle = (ends[0] + ends[1]) / 2.0;
        let is_drawn = middle.rem_euclid(pattern.period) < pattern.dash_span;
        let is_in_figure = arc.is_none() || arcs.iter().any(|[a, b]| (*a..=*b).contains(&middle));
        PassPart { ends: [ends[0], ends[1]], is_drawn, is_in_figure }
    };
    cuts.windows(2).map(part).collect()
}
