//! Chains of many dyads that never become flat: every combination of their sides is an assembly mode, and a circuit of
//! its own.

use coupler_curves::geometry::Point;
use coupler_curves::linkage::{CircuitSelection, DyadId, Linkage, LinkageBuilder, MotionOptions, Side};
use coupler_curves::motion::{AssemblyError, MAX_ASSEMBLY_MODES, Motion, Sampler, Sampling};

/// The length of the links of all dyads: with pivots 4 apart, a base is from 4 to 12 long, and 0 to 16 are spanned.
const LENGTH: f64 = 8.0;

/// A crank and a chain of dyads, each from the joint of the one before to a fixed pivot; they begin on alternate sides.
/// `last_lengths` are those of one more dyad, if there is one.
fn chain(dyads: usize, last_lengths: Option<[f64; 2]>, circuits: CircuitSelection) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let mut pin = builder.crank("A", o, 1.0).unwrap();
    let lengths = std::iter::repeat_n([LENGTH; 2], dyads).chain(last_lengths);
    for (k, lengths) in lengths.enumerate() {
        let (y, side) = if k % 2 == 0 { (-2.0, Side::Left) } else { (2.0, Side::Right) };
        let pivot = builder.fixed(&format!("C{k}"), Point::new(2.0, y));
        pin = builder.dyad(&format!("B{k}"), [pin, pivot], lengths, side).unwrap();
    }
    builder.build(vec![pin], None, MotionOptions { circuits, ..MotionOptions::default() }).unwrap()
}

fn solve(linkage: &Linkage) -> Motion {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(36)))
}

#[test]
fn thirty_dyads_turn_on_the_sides_requested_at_the_start() {
    let linkage = chain(30, None, CircuitSelection::Start);
    let motion = solve(&linkage);
    assert_eq!(motion.assembly_error, None);
    let [circuit] = &motion.circuits[..] else { panic!("{} circuits", motion.circuits.len()) };
    assert_eq!(circuit.passes.len(), 1, "a full turn in one assembly mode");
    for dyad in (0..30).map(DyadId::new) {
        assert_eq!(circuit.passes[0].mode.sign(dyad), if dyad.index() % 2 == 0 { 1 } else { -1 }, "{dyad:?}");
    }
    for k in 0..30 {
        let joint = |name: String| linkage.find_joint(&name).unwrap();
        let (b, c) = (joint(format!("B{k}")), joint(format!("C{k}")));
        let before = if k == 0 { joint("A".to_owned()) } else { joint(format!("B{}", k - 1)) };
        for sample in 0..circuit.len() {
            for end in [before, c] {
                let distance = (circuit.positions.point(b, sample) - circuit.positions.point(end, sample)).norm();
                assert!((distance - LENGTH).abs() < 1e-10, "B{k}, sample {sample}: {distance}");
            }
        }
    }
}

#[test]
fn all_circuits_of_a_few_dyads_are_solved_and_of_many_refused() {
    // The largest number of dyads of which all assembly modes are solved.
    let dyads = MAX_ASSEMBLY_MODES.ilog2() as usize;
    let motion = solve(&chain(dyads, None, CircuitSelection::All));
    assert_eq!((motion.circuits.len(), motion.assembly_error), (1 << dyads, None));
    for more in [dyads + 1, 30] {
        let motion = solve(&chain(more, None, CircuitSelection::All));
        assert!(motion.circuits.is_empty());
        let error = motion.assembly_error.unwrap();
        assert_eq!(error, AssemblyError::TooManyModes { dyads: dyads + 1, modes: 2 << dyads });
        let message = error.to_string();
        for part in [(2 << dyads).to_string(), MAX_ASSEMBLY_MODES.to_string(), "`circuits`".to_owned()] {
            assert!(message.contains(&part), "{message}");
        }
    }
}

#[test]
fn a_dyad_that_never_closes_ends_the_search_for_its_modes() {
    // Its links span 0 to 1 of a base of 4 and more, on all sides of the others.
    for circuits in [CircuitSelection::Start, CircuitSelection::All] {
        let motion = solve(&chain(6, Some([0.5; 2]), circuits));
        assert!(motion.circuits.is_empty());
        assert!(matches!(motion.assembly_error, Some(AssemblyError::BaseTooLong { joint, .. }) if joint == "B6"));
    }
}
