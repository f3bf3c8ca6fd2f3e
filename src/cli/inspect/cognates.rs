//! The two other four-bars that draw a linkage's curve: found, drawn, and written as a manifest.

use std::fmt::Write;

use coupler_curves::geometry::Point;
use coupler_curves::linkage::{
    Circuits, Class, Cognate, Cognates, FourBar, JointId, Linkage, NoCognates, PlacedFourBar, Travel,
};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use coupler_curves::solve::{Curve, Solved};
use coupler_drawing::page::{self, Panel, View};

use super::text::{course, point, short};
use super::{Report, WrongInput};

/// The three four-bars that draw one curve.
pub(super) struct Found {
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The lengths, and the third pivot.
    pub cognates: Cognates,
    /// The original as a plain four-bar and both others, each with what it does.
    pub linkages: [Member; 3],
    /// The original with the others hung on, and the links of each.
    pub hung: (Solved, [Vec<usize>; 2]),
}

/// One of the three.
pub(super) struct Member {
    /// Its place among the three, in words.
    pub name: &'static str,
    pub cognate: Cognate,
    pub class: Class,
    pub linkage: Linkage,
    pub motion: Motion,
}

/// The cognates of a solved linkage with a traced joint for its coupler point, counted from 1.
pub(super) fn find(id: &str, solved: &Solved, trace: usize) -> anyhow::Result<Found> {
    let traced = &solved.linkage.traced;
    let Some(&joint) = trace.checked_sub(1).and_then(|k| traced.get(k)) else {
        return Err(WrongInput(format!("{id} traces {} joints: give --trace 1 to {0}", traced.len())).into());
    };
    let wrong = |why: NoCognates| WrongInput(format!("{id}: {why}; {}", why.help()));
    let placed = PlacedFourBar::of(&solved.linkage, joint).map_err(wrong)?;
    let cognates = Cognates::of(placed).map_err(wrong)?;
    let (hung, links) = Cognates::hung(&solved.linkage, joint).map_err(wrong)?;
    let poses = poses(solved);
    let travel = &solved.linkage.travel;
    let member = |(name, cognate): (&'static str, Cognate)| -> anyhow::Result<Member> {
        let linkage = cognate
            .linkage(poses.iter().copied(), travel)
            .map_err(|why| WrongInput(format!("{id}: of its {name}, {why}; {}", why.help())))?;
        let motion = Motion::of(&linkage, &Sampler::new(Sampling::Samples(360)));
        Ok(Member { name, cognate, class: cognate.four_bar.lengths.class(), linkage, motion })
    };
    let [original, first, second] = cognates.all();
    let linkages = [member(("original", original))?, member(("cognate 1", first))?, member(("cognate 2", second))?];
    Ok(Found { trace, cognates, linkages, hung: (moved(solved, hung, joint), links) })
}

/// Crank pivot, crank pin, rocker pin and rocker pivot at each sample of the first circuit.
fn poses(solved: &Solved) -> Vec<[Point; 4]> {
    let (Some(pins), Some(circuit)) = (FourBar::pins(&solved.linkage), solved.motion.circuits.first()) else {
        return Vec::new();
    };
    (0..circuit.len()).map(|sample| pins.map(|pin| circuit.places.point(pin, sample))).collect()
}

/// The motion of the linkage with its cognates, of which one curve is wanted.
fn moved(solved: &Solved, hung: Linkage, joint: JointId) -> Solved {
    let linkage = Linkage { traced: vec![joint], ..hung };
    let motion = Motion::of(&linkage, &Sampler::new(Sampling::Samples(360)));
    let curves = solved.curves.iter().filter(|curve| curve.joint == joint).cloned();
    let curves = curves.map(|curve| Curve { trace: 1, ..curve }).collect();
    Solved { linkage, motion, curves, ..solved.clone() }
}

/// The panel of the three.
pub(super) fn panel<'a>(report: &'a Report, found: &'a Found) -> Panel<'a> {
    let (hung, links) = &found.hung;
    let ink = |(links, ink): (&Vec<usize>, usize)| links.iter().map(move |&link| (link, ink)).collect::<Vec<_>>();
    let [first, second] = links;
    let [_, one, two] = &found.linkages;
    let note = [(one, "green"), (two, "purple")].map(|(member, ink)| {
        let [frame, crank, coupler, rocker] = lengths(member.cognate.four_bar.lengths).map(|length| short(length, 4));
        format!("{ink}, {}: frame {frame}, crank {crank}, coupler {coupler}, rocker {rocker}", member.class.name())
    });
    Panel {
        caption: report.family.describe(&report.solved.cell, report.solved.measures())[0].clone(),
        facts: page::facts(report.solved),
        note: note.join(" · "),
        solved: hung,
        view: View::Clearest,
        // The first two inks are those of the circuits.
        inks: [ink((first, 2)), ink((second, 3))].concat(),
    }
}

fn lengths(FourBar { frame, crank, coupler, rocker }: FourBar) -> [f64; 4] {
    [frame, crank, coupler, rocker]
}

/// For people.
pub(super) fn text(found: &Found, out: &mut String) {
    let _ = writeln!(out, "\ncognates: third pivot at {}", point(found.cognates.third_pivot));
    for Member { name, cognate, class, linkage, motion } in &found.linkages {
        let PlacedFourBar { pivots: [o, c], lengths: bars, point: m } = cognate.four_bar;
        let [frame, crank, coupler, rocker] = lengths(bars).map(|length| short(length, 10));
        let _ = writeln!(out, "{name}: {}", class.name());
        let _ = writeln!(out, "  frame {frame}, crank {crank}, coupler {coupler}, rocker {rocker}");
        let (along, across) = (short(m.x, 10), short(m.y, 10));
        let _ = writeln!(out, "  pivots {} and {}; coupler point along {along}, across {across}", point(o), point(c));
        if *name != "original" {
            let [crank, coupler, rocker] = cognate.turns_as.map(|bar| bar.name());
            let _ = writeln!(out, "  crank, coupler and rocker turn as the original's {crank}, {coupler} and {rocker}");
        }
        for (number, circuit) in (1..).zip(&motion.circuits) {
            let _ = writeln!(out, "  circuit {number}: {}", course(linkage, circuit));
        }
    }
}

/// A manifest of the three: a linkage and a family for each.
pub(super) fn manifest(report: &Report, found: &Found) -> String {
    let id = &report.family.id;
    let values = report.family.names.iter().zip(&report.solved.cell.values);
    let values: Vec<String> = values.map(|(name, value)| format!("{name} = {value}")).collect();
    let mut out = format!(
        "# {id}, {}, and its cognates: three four-bars that draw one curve.\n\n[atlas]\ntitle = \"The cognates of {id}\"\n",
        values.join(", ")
    );
    for Member { name, cognate, class, linkage, .. } in &found.linkages {
        let stem: String = id.chars().take(50).collect();
        let own = format!("{}-{}", stem.trim_end_matches('-'), name.replace(' ', "-"));
        let class = class.name();
        let _ = write!(out, "\n[[linkage]]\nid = \"{own}\"\ncaption = \"{name}, {class}\"\ntrace = [\"M\"]\n");
        let Travel { circuits, start, .. } = &linkage.travel;
        let _ = match (circuits, start) {
            (Circuits::Start, Some(start)) => writeln!(out, "start = \"{start} deg\""),
            _ => writeln!(out, "circuits = \"all\""),
        };
        let PlacedFourBar { pivots: [o, c], lengths: bars, point: m } = cognate.four_bar;
        let side = if linkage.travel.signs.get(0) > 0 { "left" } else { "right" };
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
