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
    let mut reaches_end = false;
    for (k, pass) in trajectory.circuit.passes.iter().enumerate() {
        let may_continue = std::mem::take(&mut reaches_end);
        for DashPart { ends, is_in_figure } in dash_parts(pass, pattern, arc) {
            let range = ends.map(|input| trajectory.parameter(k, input));
            let continues = may_continue && ends[0] == pass.from.input.value;
            match out.last_mut().filter(|last| continues && last.is_in_figure == is_in_figure) {
                Some(last) => last.range[1] = range[1],
                None => out.push(DashRange { range, is_in_figure }),
            }
            reaches_end = ends[1] == pass.to.input.value;
        }
    }
    out
}

/// A dash on a pass, or a part of it that is whole or not at all on the arc of the figure.
struct DashPart {
    /// The inputs of its ends, in the direction of the pass.
    ends: [f64; 2],
    is_in_figure: bool,
}

/// The dashes of a pass, in its order.
fn dash_parts(pass: &Pass, pattern: DashPattern, arc: Option<BranchArc>) -> Vec<DashPart> {
    let [low, high] = pass.input_range();
    // The arc is given within one turn; the pass may lie in another.
    let arc_of_branch = arc.filter(|arc| arc.branch == pass.mode.sign(DyadId::FIRST));
    let turn = ((low + high) / 720.0).floor() * 360.0;
    let arcs: Vec<[f64; 2]> = arc_of_branch
        .iter()
        .flat_map(|arc| [turn - 360.0, turn, turn + 360.0].map(|t| arc.input_deg.map(|deg| deg + t)))
        .collect();
    let mut arc_ends = arcs.concat();
    arc_ends.sort_by(f64::total_cmp);
    let is_in_figure = |[from, to]: [f64; 2]| {
        let middle = (from + to) / 2.0;
        arc.is_none() || arcs.iter().any(|[a, b]| (*a..=*b).contains(&middle))
    };
    let mut parts = Vec::new();
    let mut k = (low / pattern.period).floor();
    while k * pattern.period < high {
        let start = k * pattern.period;
        let [mut from, end] = [start.max(low), (start + pattern.dash_span).min(high)];
        let cuts = arc_ends.iter().copied().filter(|cut| start < *cut && *cut < end);
        for to in cuts.chain([end]) {
            if from < to {
                parts.push(DashPart { ends: [from, to], is_in_figure: is_in_figure([from, to]) });
                from = to;
            }
        }
        k += 1.0;
    }
    if pass.input_direction() < 0.0 {
        parts.reverse();
        parts.iter_mut().for_each(|part| part.ends.reverse());
    }
    parts
}
