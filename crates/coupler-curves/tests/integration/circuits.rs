//! Circuits of four-bars of every class: their number, their input ranges, and that no joint jumps.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{
    CircuitSelection, Continuation, DyadId, FourBar, JointId, Linkage, LinkageBuilder, MotionOptions, Side,
};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use proptest::prelude::*;

fn four_bar(lengths: [f64; 4], options: MotionOptions) -> Linkage {
    let [frame, crank, coupler, rocker] = lengths;
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let c = builder.fixed("C", Point::new(frame, 0.0));
    let a = builder.crank("A", o, crank).unwrap();
    let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).unwrap();
    let m = builder.point("M", [a, b], coupler / 3.0, coupler / 4.0).unwrap();
    builder.build(vec![m], None, options).unwrap()
}

fn all() -> MotionOptions {
    MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() }
}

fn motion(lengths: [f64; 4], options: MotionOptions, sampling: Sampling) -> Motion {
    Motion::solve(&four_bar(lengths, options), &Sampler::new(sampling))
}

/// Input ranges and branches of the passes of each circuit.
fn passes(lengths: [f64; 4], options: MotionOptions) -> Vec<Vec<(i64, i64, i8)>> {
    let milli = |deg: f64| (deg * 1000.0).round() as i64;
    let motion = motion(lengths, options, Sampling::Samples(12));
    let pass = |p: &coupler_curves::motion::Pass| {
        (milli(p.from.input.value), milli(p.to.input.value), p.mode.sign(DyadId::FIRST))
    };
    motion.circuits.iter().map(|c| c.passes.iter().map(pass).collect()).collect()
}

#[test]
fn a_crank_rocker_turns_fully_on_each_branch() {
    assert_eq!(passes([4.0, 1.0, 3.0, 3.5], all()), [vec![(0, 360_000, 1)], vec![(0, 360_000, -1)]]);
    assert_eq!(passes([4.0, 1.0, 3.0, 3.5], MotionOptions::default()), [vec![(0, 360_000, 1)]]);
}

/// The measures `is_full_turn`, with its boolean, and `limit_positions`, for linkages of every kind.
#[test]
fn the_input_turns_fully_or_rocks() {
    use coupler_curves::measure::{ALL, BOOLEANS, TracedCurve, Value, compute_all};
    let chebyshev = coupler_curves::catalogue::find("chebyshev").unwrap();
    let parameters: Vec<&str> = chebyshev.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let value =
        |name: &&str| [("p", 2.0), ("a", 1.0), ("k", 0.5)].iter().find(|(n, _)| n == name).map_or(2.59, |v| v.1);
    let driven_by_coupler = chebyshev.linkage(&parameters.iter().map(value).collect::<Vec<f64>>()).unwrap();
    let change_point = four_bar([3.0, 1.0, 2.0, 2.0], all());
    let mut limited = four_bar([4.0, 1.0, 3.0, 3.5], all());
    limited.motion_options.range = Some([0.0, 90.0]);
    // Its input is from 28.96 to 97.18 degrees.
    let mut jamming = four_bar([4.0, 3.0, 1.0, 3.0], MotionOptions { start: Some(45.0), ..MotionOptions::default() });
    jamming.motion_options.range = Some([0.0, 60.0]);
    let of_catalogue =
        |id: &str, turns: bool, limits: usize| (id.to_owned(), crate::catalogue::default_linkage(id), turns, limits);
    for (name, linkage, turns, limits) in [
        ("driven by its coupler".to_owned(), driven_by_coupler, true, 0),
        ("through a change point".to_owned(), change_point, true, 0),
        ("over a quarter turn".to_owned(), limited, false, 0),
        ("over a range in which it jams".to_owned(), jamming, false, 1),
        ("rocker-crank".to_owned(), four_bar([4.0, 3.5, 3.0, 1.0], all()), false, 2),
        of_catalogue("hoeken", true, 0),
        of_catalogue("klann", true, 0),
        of_catalogue("geared-five-bar", true, 0),
        of_catalogue("scotch-yoke", true, 0),
        of_catalogue("inverted-slider-crank", true, 0),
        of_catalogue("hart-inversor", false, 2),
        of_catalogue("linear-actuator", false, 2),
    ] {
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(12)));
        assert!(!motion.circuits.is_empty(), "{name}");
        for circuit in &motion.circuits {
            let values = compute_all(&TracedCurve::new(&linkage, &motion, circuit, linkage.traced[0]));
            let word = ALL.iter().zip(&values).find(|(measure, _)| measure.name == "is_full_turn").unwrap().1;
            assert_eq!(*word, Value::Word(if turns { "yes" } else { "no" }), "{name}");
            let boolean = BOOLEANS.iter().find(|boolean| boolean.name == "is_full_turn").unwrap();
            assert_eq!(boolean.value(&values), f64::from(u8::from(turns)), "{name}");
            let number = ALL.iter().zip(&values).find(|(measure, _)| measure.name == "limit_positions").unwrap().1;
            assert_eq!(*number, Value::Number(limits as f64), "{name}");
            // Where the samples turn back; those of a closed circuit after the last one, too.
            let after = circuit.inputs.first().filter(|_| circuit.is_closed && !turns);
            let inputs: Vec<f64> = circuit.inputs.iter().chain(after).copied().collect();
            let steps: Vec<f64> = inputs.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step != 0.0).collect();
            let first = steps.first().filter(|_| circuit.is_closed);
            let signs: Vec<f64> = steps.iter().chain(first).map(|step| step.signum()).collect();
            assert_eq!(signs.windows(2).filter(|pair| pair[0] != pair[1]).count(), limits, "{name}");
        }
    }
}

#[test]
fn a_double_rocker_rocks_above_and_below_its_frame() {
    let [below, above]: [_; 2] = passes([4.0, 3.0, 1.0, 3.0], all()).try_into().unwrap();
    // cos = (16 + 9 - (3 -+ 1)^2) / 24
    let degs = |c: f64| (trig::degrees(trig::acos(c)) * 1000.0).round() as i64;
    let (inner, outer) = (degs(21.0 / 24.0), degs(9.0 / 24.0));
    assert_eq!(above, [(inner, outer, 1), (outer, inner, -1)]);
    assert_eq!(below, [(-outer, -inner, 1), (-inner, -outer, -1)]);
}

#[test]
fn a_triple_rocker_has_one_circuit_about_0_or_about_180() {
    let about_zero = passes([4.0, 2.0, 2.0, 2.0], all());
    assert_eq!(about_zero.len(), 1);
    assert_eq!((about_zero[0][0].0, about_zero[0].len()), (-about_zero[0][0].1, 2));
    let about_180 = passes([2.0, 3.0, 1.0, 4.5], all());
    assert_eq!(about_180.len(), 1);
    let (from, to, branch) = about_180[0][0];
    assert_eq!((from + to, branch), (360_000, 1));
}

#[test]
fn change_points_continue_smoothly_or_on_their_branch() {
    // Roberts, figure 36: folded at input 0.
    let limit = (trig::degrees(trig::acos(1.0 / 3.0)) * 1000.0).round() as i64;
    let smooth = [(-limit, 0, 1), (0, limit, -1), (limit, 0, 1), (0, -limit, -1)];
    assert_eq!(passes([3.0, 2.0, 1.0, 2.0], all()), [smooth.to_vec()]);
    let branch = MotionOptions { continuation: Continuation::Branch, ..all() };
    let kept = [(-limit, 0, 1), (0, limit, 1), (limit, 0, -1), (0, -limit, -1)];
    assert_eq!(passes([3.0, 2.0, 1.0, 2.0], branch.clone()), [kept.to_vec()]);
    // Stretched at 180: two turns if continued smoothly, otherwise one turn on each branch.
    let smooth = [(0, 180_000, 1), (180_000, 540_000, -1), (540_000, 720_000, 1)];
    assert_eq!(passes([3.0, 1.0, 2.0, 2.0], all()), [smooth.to_vec()]);
    assert_eq!(passes([3.0, 1.0, 2.0, 2.0], branch).len(), 2);
    // Four-bars with equal opposite links have two circuits, the parallelogram and the antiparallelogram.
    let parallelogram = passes([3.0, 1.0, 3.0, 1.0], all());
    assert_eq!(
        parallelogram,
        [vec![(0, 180_000, 1), (180_000, 360_000, -1)], vec![(0, 180_000, -1), (180_000, 360_000, 1)]]
    );
}

#[test]
fn a_kite_does_not_jump_where_its_base_vanishes() {
    for continuation in [Continuation::Smooth, Continuation::Branch] {
        let options = MotionOptions { continuation, ..all() };
        let motion = motion([2.0, 2.0, 3.0, 3.0], options, Sampling::Step(1.0));
        assert_eq!(motion.circuits.len(), 1);
        assert_no_jumps(&motion, 3.0, 1.0);
    }
}

#[test]
fn a_circuit_of_two_turns_is_sampled_over_both() {
    let step = motion([3.0, 1.0, 2.0, 2.0], all(), Sampling::Step(50.0));
    // Multiples of 50 and the change points at 180 and 540; 360 is neither.
    let expected = [0, 50, 100, 150, 180, 200, 250, 300, 350, 400, 450, 500, 540, 550, 600, 650, 700].map(f64::from);
    assert_eq!(step.circuits[0].inputs, expected);
    assert_eq!(motion([3.0, 1.0, 2.0, 2.0], all(), Sampling::Samples(8)).circuits[0].len(), 8);
}

#[test]
fn samples_can_be_dense_at_limits_or_even_along_the_path() {
    // A triple-rocker turns back at both limits.
    let lengths = [4.0, 2.0, 2.0, 2.0];
    let steps = |sampling| -> Vec<f64> {
        let circuit = motion(lengths, all(), sampling).circuits.remove(0);
        let n = circuit.len();
        (0..n)
            .map(|i| {
                (circuit.positions.point(JointId::new(4), (i + 1) % n) - circuit.positions.point(JointId::new(4), i))
                    .norm()
            })
            .collect()
    };
    let ratio = |steps: Vec<f64>| {
        steps.iter().copied().fold(0.0, f64::max) / steps.iter().copied().fold(f64::INFINITY, f64::min)
    };
    // Near a limit the path length grows as the root of the input: of two equal input steps the first is
    // 1 / (sqrt 2 - 1) = 2.41 times as long. The mean over both branches cancels the linear term, which has opposite
    // signs on them.
    let first_step_ratio = |steps: Vec<f64>| (steps[0] / steps[1] * steps[119] / steps[118]).sqrt();
    let (even, smooth) =
        (first_step_ratio(steps(Sampling::Samples(120))), first_step_ratio(steps(Sampling::DenseAtLimits(120))));
    assert!(even > 2.0 && (smooth - 1.0).abs() < 0.05, "{even} {smooth}");
    // With this many samples a chord is as long as its arc. Each pass has a whole number of them, about a thousand, so
    // the steps of different passes may differ by one part in a thousand.
    let arc = ratio(steps(Sampling::ArcLength(2000)));
    assert!(arc < 1.003, "{arc}");
    let whole = motion([4.0, 1.0, 3.0, 3.5], MotionOptions::default(), Sampling::ArcLength(90));
    assert_eq!((whole.circuits[0].len(), whole.circuits[0].inputs[0]), (90, 0.0));
}

#[test]
fn bases_that_vanish_up_to_rounding_are_kites() {
    let decimals: [f64; 4] = [0.3, 0.1 + 0.2, 0.5, 0.5];
    for lengths in [decimals, [2.0, 2.0 + 4.0 * f64::EPSILON, 2.0, 2.0], [3.0, 3.000_000_000_000_000_4, 2.0, 2.0]] {
        let motion = motion(lengths, all(), Sampling::Step(1.0));
        for circuit in &motion.circuits {
            for i in 0..circuit.len() {
                let length =
                    (circuit.positions.point(JointId::new(3), i) - circuit.positions.point(JointId::new(2), i)).norm();
                assert!((length - lengths[2]).abs() < 1e-12, "{lengths:?} at {}: {length}", circuit.inputs[i]);
            }
        }
        assert_no_jumps(&motion, lengths.iter().sum(), 1.0);
    }
}

#[test]
fn short_links_keep_their_lengths_next_to_long_ones() {
    for scale in [1e3, 1e6] {
        let motion = motion([scale, scale, 1.0, 1.5], all(), Sampling::Samples(40));
        for circuit in &motion.circuits {
            for i in 0..circuit.len() {
                let coupler =
                    (circuit.positions.point(JointId::new(3), i) - circuit.positions.point(JointId::new(2), i)).norm();
                let rocker =
                    (circuit.positions.point(JointId::new(3), i) - circuit.positions.point(JointId::new(1), i)).norm();
                // Coordinates of the size of the scale are rounded to this.
                let rounding = 4.0 * f64::EPSILON * scale;
                assert!((coupler - 1.0).abs() <= rounding && (rocker - 1.5).abs() <= rounding, "{coupler} {rocker}");
            }
        }
    }
}

#[test]
fn positions_beyond_double_precision_are_reported() {
    for scale in [1e160, 1e-170] {
        let motion = motion([4.0, 1.0, 3.0, 3.5].map(|l| l * scale), all(), Sampling::Step(10.0));
        let message = motion.assembly_error.map(|error| error.to_string()).unwrap_or_default();
        assert!(message.contains("double precision"), "{scale}: {message}");
        assert!(motion.circuits.is_empty());
    }
}

#[test]
fn a_linkage_that_cannot_be_assembled_has_a_reason() {
    let far = motion([9.0, 1.0, 2.0, 3.0], all(), Sampling::Step(2.0));
    assert!(!far.is_assembled());
    assert_eq!(
        far.assembly_error.unwrap().to_string(),
        "B cannot be placed: A and C are 8 or more apart, links of 2 and 3 reach 5"
    );
    let near = motion([1.0, 1.0, 9.0, 3.0], all(), Sampling::Step(2.0));
    assert_eq!(
        near.assembly_error.unwrap().to_string(),
        "B cannot be placed: A and C are 2 or less apart, links of 9 and 3 need 6"
    );
}

#[test]
fn an_input_range_that_is_not_reached_is_reported() {
    let options = |range| MotionOptions { range: Some(range), ..MotionOptions::default() };
    let whole = motion([4.0, 1.0, 3.0, 3.5], options([30.0, 120.0]), Sampling::Step(10.0));
    assert_eq!(whole.assembly_error, None);
    assert_eq!(whole.circuits[0].inputs, [30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0]);
    assert!(!whole.circuits[0].is_closed);
    let part = motion([4.0, 2.0, 2.0, 2.0], options([0.0, 120.0]), Sampling::Step(10.0));
    assert!(part.assembly_error.unwrap().to_string().starts_with("the input goes from 0 to 75.5225 deg only"));
    assert_eq!(part.circuits[0].passes.len(), 2, "out on one branch and back on the other");
    let none = motion([4.0, 2.0, 2.0, 2.0], options([100.0, 120.0]), Sampling::Step(10.0));
    assert!(!none.is_assembled() && none.assembly_error.is_some());
    // From the upper end down to a limit and back.
    let down = motion([2.0, 3.0, 1.0, 4.5], options([0.0, 180.0]), Sampling::Step(10.0));
    assert_eq!((down.circuits[0].inputs[0], down.circuits[0].passes.len()), (180.0, 2));
}

/// Asserts that neighbouring samples are no further apart than the fastest joint can move: as the root of the step, at
/// a limit.
fn assert_no_jumps(motion: &Motion, size: f64, step_deg: f64) {
    for circuit in &motion.circuits {
        let n = circuit.len();
        let allowed = 12.0 * size * trig::radians(step_deg).sqrt();
        for i in 0..(if circuit.is_closed { n } else { n - 1 }) {
            for joint in (0..5).map(JointId::new) {
                let moved = circuit.positions.point(joint, (i + 1) % n) - circuit.positions.point(joint, i);
                assert!(moved.norm() <= allowed, "{} to {}: {moved}", circuit.inputs[i], circuit.inputs[(i + 1) % n]);
            }
        }
    }
}

/// Link lengths, many of them with change points exactly or nearly.
fn lengths() -> impl Strategy<Value = [f64; 4]> {
    let plain = prop::array::uniform4(0.1f64..4.0);
    let tenths = prop::array::uniform4((1..30u32).prop_map(|n| f64::from(n) / 10.0));
    let near = (prop::array::uniform3(0.5f64..3.0), prop::sample::select(vec![0.0, 1e-15, 1e-12, -1e-12, 1e-9, -1e-9]))
        .prop_map(|([a, b, c], off)| [a + b + c * 0.5, a, b, c * 0.5 + off + b + a - b - a + b]);
    let folded = (prop::array::uniform3(0.5f64..3.0), prop::sample::select(vec![0.0, 1e-12, -1e-12]))
        .prop_map(|([a, b, c], off)| [a, b, c, (a + c - b).abs().max(0.1) + off]);
    prop_oneof![plain, tenths, near, folded]
}

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn every_circuit_keeps_lengths_and_never_jumps(lengths in lengths(), branch: bool) {
        let continuation = if branch { Continuation::Branch } else { Continuation::Smooth };
        let motion = motion(lengths, MotionOptions { continuation, ..all() }, Sampling::Step(0.5));
        let [frame, crank, coupler, rocker] = lengths;
        for circuit in &motion.circuits {
            for i in 0..circuit.len() {
                let p = |j| circuit.positions.point(JointId::new(j), i);
                // A link that is shorter than its base loses digits in proportion.
                let scale = frame + crank;
                prop_assert!(((p(3) - p(2)).norm() - coupler).abs() <= 1e-12 * coupler.max(1e-2 * scale));
                prop_assert!(((p(3) - p(1)).norm() - rocker).abs() <= 1e-12 * rocker.max(1e-2 * scale));
            }
        }
        // If the branch is kept, the path has a corner at a change point, but no jump.
        assert_no_jumps(&motion, lengths.iter().sum(), 0.5);
    }

    #[test]
    fn cranks_turn_fully_in_drag_links_and_crank_rockers(lengths in prop::array::uniform4(0.1f64..4.0)) {
        use coupler_curves::linkage::FourBarClass;
        let [frame, crank, coupler, rocker] = lengths;
        let class = FourBar { frame, crank, coupler, rocker }.class();
        let motion = motion(lengths, all(), Sampling::Step(5.0));
        let turns = motion.circuits.first().is_some_and(|c| c.passes[0].from.flat_dyads.is_empty());
        let expected = matches!(class, FourBarClass::DragLink | FourBarClass::CrankRocker);
        prop_assert_eq!(turns, expected);
        prop_assert!(motion.circuits.iter().all(|circuit| circuit.is_full_turn() == expected), "{}", class);
    }
}
