//! Rates on circuits of several passes.

use coupler_curves::motion::{Motion, Sampler};

/// At every sample of a circuit of several passes, some of which have their sides and their ends in common, the rates are
/// those of the pass it is on: the change of places along that pass, taken forward where it begins and back where it ends.
#[test]
fn rates_at_a_sample_are_those_of_its_own_pass() {
    let plan = coupler_atlas::manifest::parse(include_str!("../../atlas.toml")).plan.unwrap();
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
                // A difference of the second order over a thousandth of a degree, back on its own pass: what it leaves out is
                // 3e-10 of the third rate, and the height of a dyad that is flat at its end is good to 3e-7 there.
                let step = -1e-3 * own.input_direction();
                let back = |steps: f64| coupler_curves::motion::pose(&linkage, own, at + steps * step)[joint].coords;
                let here = circuit.positions.point(joint, sample).coords;
                let rate = (back(1.0) * 4.0 - back(2.0) - here * 3.0) / (2.0 * step.to_radians());
                let found = circuit.derivatives(&linkage, sample).velocity(joint);
                if found.norm().is_finite() && found.norm() < 50.0 {
                    assert!(
                        (found - rate).norm() < 1e-5 * (1.0 + rate.norm()),
                        "cell {}, sample {sample}: {found} {rate}",
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
