//! The output of a linkage along a pass of its motion.

use super::super::circuit::Traced;
use super::fitting::LinkageFit;
use super::track::Track;
use coupler_curves::geometry::trig;
use coupler_curves::linkage::{JointId, Linkage};
use coupler_curves::motion::find_circuits;

/// The output of any linkage along a pass of its motion, followed from the start of a function.
#[derive(Clone, Debug)]
pub struct FollowedOutput {
    traced: Traced,
    place: [usize; 2],
    starts: [f64; 2],
    is_length: bool,
}

impl FollowedOutput {
    /// That of a linkage on a pass of a circuit, both by their indices among those that [`find_circuits`] finds, from an input in degrees with
    /// the output that is wanted there, in radians or as a length; `None` if the linkage has no such pass.
    pub fn new(linkage: Linkage, place: [usize; 2], starts: [f64; 2], is_length: bool) -> Option<FollowedOutput> {
        let circuit = find_circuits(&linkage).circuits.into_iter().nth(place[0])?;
        circuit.passes.get(place[1])?;
        let joint: JointId = linkage.traced.first().copied().or_else(|| linkage.joint_ids().next())?;
        Some(FollowedOutput { traced: Traced { linkage, circuit, joint }, place, starts, is_length })
    }

    /// That of a fit with these outputs at travels of the input: on the pass on which they are.
    pub(super) fn of_fit(
        fit: &LinkageFit,
        travels: &[f64],
        outputs: &[f64],
        is_length: bool,
    ) -> Option<FollowedOutput> {
        let track = Track::new(travels);
        let linkage = &fit.traced.linkage;
        let passes = find_circuits(linkage).circuits.into_iter().enumerate().flat_map(|(number, circuit)| {
            let joint = fit.traced.joint;
            (0..circuit.passes.len())
                .map(move |pass| (Traced { linkage: linkage.clone(), circuit: circuit.clone(), joint }, [number, pass]))
        });
        let apart = |(traced, place): (Traced, [usize; 2])| {
            let own = track.outputs(&traced, place[1], fit.starts[0])?;
            let apart = own.iter().zip(outputs).map(|(own, output)| (own - output).abs()).fold(0.0, f64::max);
            Some((apart, traced, place))
        };
        let (_, traced, place) = passes.filter_map(apart).min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(FollowedOutput { traced, place, starts: fit.starts, is_length })
    }

    /// The indices of the circuit and of the pass, and the input and the output at the start: with the linkage, what [`FollowedOutput::new`] takes.
    pub fn place(&self) -> ([usize; 2], [f64; 2]) {
        (self.place, self.starts)
    }

    /// The outputs at travels of the input from the start, in degrees and in their order, less the output that is wanted at the start, in degrees or
    /// as lengths; `None` where the linkage cannot be assembled.
    pub fn at(&self, travels_deg: &[f64]) -> Option<Vec<f64>> {
        let unit = if self.is_length { 1.0 } else { trig::degrees(1.0) };
        let outputs = Track::new(travels_deg).outputs(&self.traced, self.place[1], self.starts[0])?;
        Some(outputs.into_iter().map(|output| unit * (output - self.starts[1])).collect())
    }
}
