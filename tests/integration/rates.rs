//! Velocities on circuits of several passes.

use coupler_curves::motion::{Motion, Sampler};

/// At every sample of a circuit of several passes, some of which share their assembly modes and ends, the velocity is
/// that of the pass the sample is on, compared with a backward difference of positions along that pass.
#[test]
fn velocities_at_a_sample_are_those_of_its_own_pass() {
    let plan = crate::support::plan::plan(include_str!("../../atlas.toml"));
    let roberts = plan.families.iter().find(|planned| planned.family.id == "roberts").unwrap();
    let family = &roberts.family;
    let (mut checked, mut most_passes) = (0, 0);
    for k in 0..family.cell_count() {
        let linkage = family.linkage(&family.cell(k)).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(family.sampling));
        let joint = linkage.traced[0];
        for circuit in &motion.circuits {
            most_passes = most_passes.max(circuit.passes.len());
            let mut pass = 0;
            for sample in 1..circuit.len() {
                let at = circuit.inputs[sample];
                while circuit.passes[pass].to.input.value != at
                    && (circuit.passes[pass].to.input.value - at) * circuit.passes[pass].input_direction() < 0.0
                {
                    pass += 1;
                }
                let own = &circuit.passes[pass];
                // A backward difference of second order with steps of a thousandth of a degree, along the sample's own
                // pass: its error is 3e-10 of the third derivative, and the height of a dyad that is flat at the end of
                // the pass is accurate to 3e-7 there.
                let step = -1e-3 * own.input_direction();
                let back = |steps: f64| coupler_curves::motion::pose(&linkage, own, at + steps * step)[joint].coords;
                let here = circuit.positions.point(joint, sample).coords;
                let expected = (back(1.0) * 4.0 - back(2.0) - here * 3.0) / (2.0 * step.to_radians());
                let velocity = circuit.derivatives(&linkage, sample).velocity(joint);
                if velocity.norm().is_finite() && velocity.norm() < 50.0 {
                    assert!(
                        (velocity - expected).norm() < 1e-5 * (1.0 + expected.norm()),
                        "cell {}, sample {sample}: {velocity}, not {expected}",
                        k + 1
                    );
                    checked += 1;
                }
                if own.to.input.value == at && pass + 1 < circuit.passes.len() {
                    pass += 1;
                }
            }
        }
    }
    assert!(most_passes >= 4 && checked > 500, "{checked} samples, {most_passes} passes");
}
