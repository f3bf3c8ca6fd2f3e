//! The Roberts-Chebyshev cognates of a linkage, as a panel, as text and as a manifest.

use std::fmt::Write;

use coupler_curves::family::Family;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{
    CircuitSelection, Cognate, CognateError, Cognates, DyadId, FourBar, JointId, Linkage, MotionOptions, PlacedFourBar,
};
use coupler_curves::motion::{Motion, Sampler};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_drawing::page::{self, Panel};

use super::cognate_set::{CognateMember, CognateSet};
use super::format::{describe_circuit, format_point};
use super::inspection::Inspection;
use crate::format::format_significant;
use crate::notation::Notation;

/// Finds the cognates of a solved linkage; its coupler point is the `trace`-th traced joint, counted from 1.
///
/// # Errors
/// There is no such joint, the linkage is not a four-bar with a coupler point there, or a cognate cannot be assembled.
pub(super) fn find_cognates(
    Family { id, sampling, .. }: &Family,
    solved: &SolvedCell,
    (notation, trace): (Notation, usize),
) -> Result<CognateSet, String> {
    let sampler = Sampler::new(*sampling);
    let traced = &solved.linkage.traced;
    let Some(&joint) = trace.checked_sub(1).and_then(|k| traced.get(k)) else {
        let numbers = notation.with_value("trace", format!("1 to {}", traced.len()));
        return Err(format!("{id} traces {} joints: give {numbers}", traced.len()));
    };
    let input_error = |error: CognateError| format!("{id}: {error}; {}", error.help());
    let placed = PlacedFourBar::from_linkage(&solved.linkage, joint).map_err(input_error)?;
    let cognates = Cognates::from_four_bar(placed).map_err(input_error)?;
    let assembled = Cognates::assemble(&solved.linkage, joint).map_err(input_error)?;
    let poses = four_bar_poses(solved);
    let motion_options = &solved.linkage.motion_options;
    let member = |(name, cognate): (&'static str, Cognate)| -> Result<CognateMember, String> {
        let linkage = cognate
            .to_linkage(poses.iter().copied(), motion_options)
            .map_err(|error| format!("{id}, {name}: {error}; {}", error.help()))?;
        let motion = Motion::solve(&linkage, &sampler);
        Ok(CognateMember { name, cognate, class: cognate.four_bar.lengths.class(), linkage, motion })
    };
    let [original, first, second] = cognates.all();
    let linkages = [member(("original", original))?, member(("cognate 1", first))?, member(("cognate 2", second))?];
    Ok(CognateSet { trace, cognates, linkages, assembled: with_motion(solved, assembled, joint, &sampler) })
}

/// The crank pivot, crank pin, rocker pin and rocker pivot at each sample of the first circuit.
fn four_bar_poses(solved: &SolvedCell) -> Vec<[Point; 4]> {
    let (Some(pins), Some(circuit)) = (FourBar::pins(&solved.linkage), solved.motion.circuits.first()) else {
        return Vec::new();
    };
    (0..circuit.len()).map(|sample| pins.map(|pin| circuit.positions.point(pin, sample))).collect()
}

/// Solves the linkage assembled with its cognates; only the curve of `joint` is kept.
fn with_motion(solved: &SolvedCell, assembled: Linkage, joint: JointId, sampler: &Sampler) -> SolvedCell {
    let linkage = Linkage { traced: vec![joint], ..assembled };
    let motion = Motion::solve(&linkage, sampler);
    let curves = solved.curves.iter().filter(|curve| curve.joint == joint).cloned();
    let curves = curves.map(|curve| MeasuredCurve { trace: 1, ..curve }).collect();
    SolvedCell { linkage, motion, curves, ..solved.clone() }
}

/// A panel that shows the three four-bars.
pub(super) fn panel<'a>(inspection: &'a Inspection, cognate_set: &'a CognateSet) -> Panel<'a> {
    let [_, first_cognate, second_cognate] = &cognate_set.linkages;
    let note = [(first_cognate, "green"), (second_cognate, "purple")].map(|(member, ink)| {
        let [frame, crank, coupler, rocker] =
            lengths(member.cognate.four_bar.lengths).map(|length| format_significant(length, 4));
        format!("{ink}, {}: frame {frame}, crank {crank}, coupler {coupler}, rocker {rocker}", member.class.name())
    });
    let [caption, _] =
        inspection.family.format_captions(&inspection.solved.cell, inspection.solved.first_curve_values());
    Panel::new(&cognate_set.assembled)
        .with_caption(caption)
        .with_note(note.join(" · "))
        .with_facts(page::cell_facts(&inspection.family, &inspection.solved))
}

fn lengths(FourBar { frame, crank, coupler, rocker }: FourBar) -> [f64; 4] {
    [frame, crank, coupler, rocker]
}

/// Appends the lengths, pivots and circuits of the three four-bars.
pub(super) fn append_text(cognate_set: &CognateSet, out: &mut String) {
    let _ = writeln!(out, "\ncognates: third pivot at {}", format_point(cognate_set.cognates.third_pivot));
    for CognateMember { name, cognate, class, linkage, motion } in &cognate_set.linkages {
        let PlacedFourBar { pivots: [o, c], lengths: four_bar, coupler_point: m } = cognate.four_bar;
        let [frame, crank, coupler, rocker] = lengths(four_bar).map(|length| format_significant(length, 10));
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
            let [crank, coupler, rocker] = cognate.counterparts.map(|link| link.name());
            let _ = writeln!(out, "  crank, coupler and rocker turn as the original's {crank}, {coupler} and {rocker}");
        }
        for (number, circuit) in (1..).zip(&motion.circuits) {
            let _ = writeln!(out, "  circuit {number}: {}", describe_circuit(linkage, circuit));
        }
    }
}

/// A manifest with a linkage and a family for each of the three four-bars.
pub(super) fn manifest(inspection: &Inspection, cognate_set: &CognateSet) -> String {
    let id = &inspection.family.id;
    let values = inspection.family.names.iter().zip(&inspection.solved.cell.values);
    let values: Vec<String> = values.map(|(name, value)| format!("{name} = {value}")).collect();
    let mut out = format!(
        "# {id}, {}, and its cognates: three four-bars that trace the same curve.\n\n\
         [atlas]\ntitle = \"The cognates of {id}\"\n",
        values.join(", ")
    );
    for CognateMember { name, cognate, class, linkage, .. } in &cognate_set.linkages {
        let stem: String = id.chars().take(50).collect();
        let linkage_id = format!("{}-{}", stem.trim_end_matches('-'), name.replace(' ', "-"));
        let class = class.name();
        let _ = write!(out, "\n[[linkage]]\nid = \"{linkage_id}\"\ncaption = \"{name}, {class}\"\ntrace = [\"M\"]\n");
        let MotionOptions { circuits, start, .. } = &linkage.motion_options;
        let _ = match (circuits, start) {
            (CircuitSelection::Start, Some(start)) => writeln!(out, "start = \"{start} deg\""),
            _ => writeln!(out, "circuits = \"all\""),
        };
        let PlacedFourBar { pivots: [o, c], lengths: four_bar, coupler_point: m } = cognate.four_bar;
        let side = if linkage.motion_options.mode.sign(DyadId::FIRST) > 0 { "left" } else { "right" };
        let _ = writeln!(out, "\n[linkage.joints]");
        let _ = writeln!(out, "O = {{ fixed = [{}, {}] }}", o.x, o.y);
        let _ = writeln!(out, "C = {{ fixed = [{}, {}] }}", c.x, c.y);
        let _ = writeln!(out, "A = {{ crank = \"O\", length = {} }}", four_bar.crank);
        let _ = writeln!(
            out,
            "B = {{ dyad = [\"A\", \"C\"], lengths = [{}, {}], side = \"{side}\" }}",
            four_bar.coupler, four_bar.rocker
        );
        let _ = writeln!(out, "M = {{ point = [\"A\", \"B\"], along = {}, across = {} }}", m.x + 0.0, m.y + 0.0);
        let _ =
            writeln!(out, "\n[[family]]\nid = \"{linkage_id}\"\nlinkage = \"{linkage_id}\"\ntitle = \"{id}, {name}\"");
        let _ = writeln!(out, "panels = [1, 1]\nsampling = {{ step = \"2 deg\" }}\ncases = [{{}}]");
    }
    out
}
