//! The output of a linkage at inputs of a pass, followed along the motion.

use std::f64::consts::TAU;

use super::super::circuit::Traced;
use coupler_curves::geometry::{Vector, trig};
use coupler_curves::linkage::{JointId, OutputLink};
use coupler_curves::motion::JointPositions;

/// Travels of the input, in degrees, with others between them, so close that an angle between neighbours is less than half a turn.
#[derive(Clone, Debug)]
pub(super) struct Track {
    travels: Vec<f64>,
    /// The places of those that are asked for.
    asked: Vec<usize>,
}

impl Track {
    /// Travels in their order, in either direction.
    pub fn new(asked_deg: &[f64]) -> Track {
        /// Degrees: links of ordinary proportions turn by far less than half a turn meanwhile.
        const STEP: f64 = 6.0;
        let mut track = Track { travels: Vec::new(), asked: Vec::new() };
        for travel in asked_deg {
            if let Some(last) = track.travels.last().copied() {
                let steps = ((travel - last).abs() / STEP).ceil().clamp(1.0, 100.0) as usize;
                track.travels.extend((1..steps).map(|k| last + (travel - last) * k as f64 / steps as f64));
            }
            track.asked.push(track.travels.len());
            track.travels.push(*travel);
        }
        track
    }

    /// The outputs at the travels that are asked for, from an input in degrees: an angle in radians without jumps, or a way. `None` if the linkage cannot
    /// be assembled at one of them, or has no output.
    pub fn outputs(&self, traced: &Traced, pass: usize, start_deg: f64) -> Option<Vec<f64>> {
        let output = traced.linkage.output()?;
        let inputs: Vec<f64> = self.travels.iter().map(|travel| start_deg + travel).collect();
        let places = traced.places_at_inputs(pass, &inputs)?;
        let poses = traced.poses(&places);
        if !poses.are_closed(&traced.linkage) {
            return None;
        }
        let positions = poses.of_passes.first()?;
        let mut all: Vec<f64> = Vec::with_capacity(inputs.len());
        for k in 0..inputs.len() {
            let here = value(output, positions, k);
            let turns = match all.last() {
                Some(last) if !output.is_slider() => TAU * ((last - here) / TAU).round(),
                _ => 0.0,
            };
            if !here.is_finite() {
                return None;
            }
            all.push(here + turns);
        }
        Some(self.asked.iter().map(|place| all[*place]).collect())
    }
}

/// The output in a pose: the angle of a link, or the way of a slider along its line. The angle of a slot may differ by half a turn, the same in all poses of
/// a pass.
fn value(output: OutputLink, positions: &JointPositions, pose: usize) -> f64 {
    let arm = |from: JointId, to: JointId| -> Vector { positions.point(to, pose) - positions.point(from, pose) };
    match output {
        OutputLink::Link([from, to]) | OutputLink::Slot { base: [from, to], .. } => {
            let arm = arm(from, to);
            trig::atan2(arm.y, arm.x)
        }
        OutputLink::Slider { joint, line: [from, to] } => {
            let line = arm(from, to);
            line.dot(&arm(from, joint)) / line.dot(&line).sqrt()
        }
    }
}
