//! The two other four-bars that draw a linkage's curve: found, drawn, and written as a manifest.

use std::fmt::Write;

use coupler_curves::geometry::Point;
use coupler_curves::linkage::{
    CircuitSelection, Cognate, CognateError, Cognates, FourBar, FourBarClass, JointId, Linkage, MotionOptions,
    PlacedFourBar,
};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_drawing::page::{self, Panel, PoseChoice};

use super::text::{describe_circuit, format_point, format_significant};
use super::{InputError, Report};

/// The three four-bars that draw one curve.
pub(super) struct CognateSet {
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The lengths, and the third pivot.
    pub cognates: Cognates,
    /// The original as a plain four-bar and both others, each with what it does.
    pub linkages: [CognateMember; 3],
    /// The original with the others hung on, and the links of each.
    pub assembled: (SolvedCell, [Vec<usize>; 2]),
}

/// One of the three.
pub(super) struct CognateMember {
    /// Its place among the three, in words.
    pub name: &'static str,
    pub cognate: Cognate,
    pub class: FourBarClass,
    pub linkage: Linkage,
    pub motion: Motion,
}

/// The cognates of a solved linkage with a traced joint for its coupler point, counted from 1.
pub(super) fn find_cognates(id: &str, solved: &SolvedCell, trace: usize) -> anyhow::Result<CognateSet> {
    let traced = &solved.linkage.traced;
    let Some(&joint) = trace.checked_sub(1).and_then(|k| traced.get(k)) else {
        return Err(InputError(format!("{id} traces {} joints: give --trace 1 to {0}", traced.len())).into());
    };
    let wrong = |why: CognateError| InputError(format!("{id}: {why}; {}", why.help()));
    let placed = PlacedFourBar::from_linkage(&solved.linkage, joint).map_err(wrong)?;
    let cognates = Cognates::from_four_bar(placed).map_err(wrong)?;
    let (hung, links) = Cognates::assemble(&solved.linkage, joint).map_err(wrong)?;
    let poses = four_bar_poses(solved);
    let travel = &solved.linkage.motion_options;
    let member = |(name, cognate): (&'static str, Cognate)| -> anyhow::Result<CognateMember> {
        let linkage = cognate
            .to_linkage(poses.iter().copied(), travel)
            .map_err(|why| InputError(format!("{id}: of its {name}, {why}; {}", why.help())))?;
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(360)));
        Ok(CognateMember { name, cognate, class: cognate.four_bar.lengths.class(), linkage, motion })
    };
    let [original, first, second] = cognates.all();
    let linkages = [member(("original", original))?, member(("cognate 1", first))?, member(("cognate 2", second))?];
    Ok(CognateSet { trace, cognates, linkages, assembled: (with_motion(solved, hung, joint), links) })
}

/// Crank pivot, crank pin, rocker pin and rocker pivot at each sample of the first circuit.
fn four_bar_poses(solved: &SolvedCell) -> Vec<[Point; 4]> {
    let (Some(pins), Some(circuit)) = (FourBar::pins(&solved.linkage), solved.motion.circuits.first()) else {
        return Vec::new();
    };
    (0..circuit.len()).map(|sample| pins.map(|pin| circuit.positions.point(pin, sample))).collect()
}

/// The motion of the linkage with its cognates, of which one curve is wanted.
fn with_motion(solved: &SolvedCell, hung: Linkage, joint: JointId) -> SolvedCell {
    let linkage = Linkage { traced: vec![joint], ..hung };
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(360)));
    let curves = solved.curves.iter().filter(|curve| curve.joint == joint).cloned();
    let curves = curves.map(|curve| MeasuredCurve { trace: 1, ..curve }).collect();
    SolvedCell { linkage, motion, curves, ..solved.clone() }
}

/// The panel of the three.
pub(super) fn panel<'a>(report: &'a Report, found: &'a CognateSet) -> Panel<'a> {
    let (hung, links) = &found.assembled;
    let ink = |(links, ink): (&Vec<usize>, usize)| links.iter().map(move |&link| (link, ink)).collect::<Vec<_>>();
    let [first, second] = links;
    let [_, one, two] = &found.linkages;
    let note = [(one, "green"), (two, "purple")].map(|(member, ink)| {
        let [frame, crank, coupler, rocker] =
            lengths(member.cognate.four_bar.lengths).map(|length| format_significant(length, 4));
        format!("{ink}, {}: frame {frame}, crank {crank}, coupler {coupler}, rocker {rocker}", member.class.name())
    });
    Panel {
        caption: report.family.format_captions(&report.solved.cell, report.solved.first_curve_values())[0].clone(),
        facts: page::cell_facts(report.solved),
        note: note.join(" · "),
        solved_cell: hung,
        pose: PoseChoice::Clearest,
        // The first two inks are those of the circuits.
        link_inks: [ink((first, 2)), ink((second, 3))].concat(),
    }
}

fn lengths(FourBar { frame, crank, coupler, rocker }: FourBar) -> [f64; 4] {
    [frame, crank, coupler, rocker]
}

/// For people.
pub(super) fn text(found: &CognateSet, out: &mut String) {
    let _ = writeln!(out, "\ncognates: third pivot at {}", format_point(found.cognates.third_pivot));
    for CognateMember { name, cognate, class, linkage, motion } in &found.linkages {
        let PlacedFourBar { pivots: [o, c], lengths: bars, coupler_point: m } = cognate.four_bar;
        let [frame, crank, coupler, rocker] = lengths(bars).map(|length| format_significant(length, 10));
        let _ = writeln!(out, "{name}: {}", class.name());
        let _ = writeln!(out, "  frame {frame}, crank {crank}, coupler {coupler}, rocker {rocker}");
        let (along, across) = (format_significant(m.x, 10), format_significant(m.y, 10));
        let _ = writeln!(
            out,
            "  pivots {} and {}; coupler point along {along}, across {across}",
            format_point(o),
            format_point(c)
        );
        if *name != "original" {
            let [crank, coupler, rocker] = cognate.counterparts.map(|bar| bar.name());
            let _ = writeln!(out, "  crank, coupler and rocker turn as the original's {crank}, {coupler} and {rocker}");
        }
        for (number, circuit) in (1..).zip(&motion.circuits) {
            let _ = writeln!(out, "  circuit {number}: {}", describe_circuit(linkage, circuit));
        }
    }
}

/// A manifest of the three: a linkage and a family for each.
pub(super) fn manifest(report: &Report, found: &CognateSet) -> String {
    let id = &report.family.id;
    let values = report.family.names.iter().zip(&report.solved.cell.values);
    let values: Vec<String> = values.map(|(name, value)| format!("{name} = {value}")).collect();
    let mut out = format!(
        "# {id}, {}, and its cognates: three four-bars that draw one curve.\n\n[atlas]\ntitle = \"The cognates of {id}\"\n",
        values.join(", ")
    );
    for CognateMember { name, cognate, class, linkage, .. } in &found.linkages {
        let stem: String = id.chars().take(50).collect();
        let own = format!("{}-{}", stem.trim_end_matches('-'), name.replace(' ', "-"));
        let class = class.name();
        let _ = write!(out, "\n[[linkage]]\nid = \"{own}\"\ncaption = \"{name}, {class}\"\ntrace = [\"M\"]\n");
        let MotionOptions { circuits, start, .. } = &linkage.motion_options;
        let _ = match (circuits, start) {
            (CircuitSelection::Start, Some(start)) => writeln!(out, "start = \"{start} deg\""),
            _ => writeln!(out, "circuits = \"all\""),
        };
        let PlacedFourBar { pivots: [o, c], lengths: bars, coupler_point: m } = cognate.four_bar;
        let side = if linkage.motion_options.mode.sign(0) > 0 { "left" } else { "right" };
        let _ = writeln!(out, "\n[linkage.joints]");
        let _ = writeln!(out, "O = {{ fixed = [{}, {}] }}", o.x, o.y);
        let _ = writeln!(out, "C = {{ fixed = [{}, {}] }}", c.x, c.y);
        let _ = writeln!(out, "A = {{ crank = \"O\", length = {} }}", bars.crank);
        let _ = writeln!(
            out,
            "B = {{ dyad = [\"A\", \"C\"], lengths = [{}, {}], side = \"{side}\" }}",
            bars.coupler, bars.rocker
        );
        let _ = writeln!(out, "M = {{ point = [\"A\", \"B\"], along = {}, across = {} }}", m.x + 0.0, m.y + 0.0);
        let _ = writeln!(out, "\n[[family]]\nid = \"{own}\"\nlinkage = \"{own}\"\ntitle = \"{id}, {name}\"");
        let _ = writeln!(out, "panels = [1, 1]\nsampling = {{ step = \"2 deg\" }}\ncases = [{{}}]");
    }
    out
}
