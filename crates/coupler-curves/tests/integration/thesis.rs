//! The programs of the thesis's Appendix B, with their slips corrected, against samples at the same input and branch.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{DyadId, JointId, Linkage, LinkageBuilder, MotionOptions, Side};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};

/// `r2` of Natesan (9.1), branch 1, and (9.2), branch -1: from the crank pin to the rocker pin.
fn r2(r: [f64; 4], w: f64, branch: f64) -> [f64; 2] {
    let [r0, r1, r2, r3] = r;
    let rd = (r0 * r0 + r1 * r1 - 2.0 * r0 * r1 * trig::cos(w)).sqrt();
    let (rd1, rd2) = ((r1 * trig::cos(w) - r0) / rd, r1 * trig::sin(w) / rd);
    let a = (r3 * r3 - r2 * r2 + rd * rd) / (2.0 * rd);
    let height = branch * (r3 * r3 - a * a).max(0.0).sqrt();
    [height * rd2 + (a - rd) * rd1, -height * rd1 + (a - rd) * rd2]
}

struct Figure {
    linkage: Linkage,
    /// The program's lengths r0 (frame), r1 (crank), r2, r3.
    lengths: [f64; 4],
    /// The program's coupler point from its input angle and branch.
    program: Box<dyn Fn(f64, f64) -> Point>,
    sampling: Sampling,
}

fn four_bar(
    [p, r, a, s]: [f64; 4],
    point: impl Fn(&mut LinkageBuilder, JointId, JointId) -> JointId,
    inverted: bool,
) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let c = builder.fixed("C", Point::new(p, 0.0));
    let pin = builder.crank("A", o, r).unwrap();
    let b = builder.dyad("B", [pin, c], [a, s], Side::Left).unwrap();
    // Seen from the link C-B, the coupler point sits on the crank O-A.
    let m = if inverted { point(&mut builder, o, pin) } else { point(&mut builder, pin, b) };
    builder.build(vec![m], inverted.then_some([c, b]), MotionOptions::default()).unwrap()
}

fn evans(p: f64, s: f64) -> Figure {
    let lengths = [p, 1.0, s, s];
    Figure {
        linkage: four_bar(lengths, |l, a, b| l.point("M", [a, b], 2.0 * s, 0.0).unwrap(), false),
        lengths,
        program: Box::new(move |w, branch| {
            let [x, y] = r2(lengths, w, branch);
            Point::new(2.0 * x + trig::cos(w), 2.0 * y + trig::sin(w))
        }),
        sampling: Sampling::Step(2.0),
    }
}

fn chebyshev(p: f64, r: f64) -> Figure {
    let lengths = [r, 1.0, r, p];
    Figure {
        linkage: four_bar(lengths, |l, a, b| l.point("M", [a, b], 0.5, 0.0).unwrap(), true),
        lengths,
        program: Box::new(move |w, branch| {
            let [x, y] = r2(lengths, w, branch);
            let (x1, y1) = (x + trig::cos(w), y + trig::sin(w));
            let (mx, my) = (0.5 * trig::cos(w) - r, 0.5 * trig::sin(w));
            // The vector in the frame from O to C, in place of the program's arcsines, which lose the quadrant.
            let (ux, uy) = ((x1 - r) / p, y1 / p);
            Point::new(mx * ux + my * uy, my * ux - mx * uy)
        }),
        sampling: Sampling::Step(2.0),
    }
}

fn watt(p: f64, r: f64, a: f64) -> Figure {
    let lengths = [p, r, a, r];
    Figure {
        linkage: four_bar(lengths, |l, pin, b| l.point("M", [pin, b], a / 2.0, 0.0).unwrap(), false),
        lengths,
        program: Box::new(move |w, branch| {
            let [x, y] = r2(lengths, w, branch);
            Point::new(x / 2.0 + r * trig::cos(w), y / 2.0 + r * trig::sin(w))
        }),
        sampling: Sampling::Samples(180),
    }
}

fn roberts(p: f64, r: f64, a: f64, b: f64) -> Figure {
    let lengths = [p, r, a, r];
    Figure {
        linkage: four_bar(
            lengths,
            |l, pin, q| l.point_at_distances("M", [pin, q], [b, b], Side::Right).unwrap(),
            false,
        ),
        lengths,
        program: Box::new(move |w, branch| {
            let [x, y] = r2(lengths, w, branch);
            let (phi, t) = (trig::atan2(y, x), trig::acos(a / (2.0 * b)));
            Point::new(r * trig::cos(w) + b * trig::cos(phi - t), r * trig::sin(w) + b * trig::sin(phi - t))
        }),
        sampling: Sampling::Samples(180),
    }
}

fn figures() -> Vec<(usize, Figure)> {
    let pairs = [(2.0, 2.59), (2.0, 2.5), (3.0, 4.0), (3.0, 4.1), (4.0, 5.59), (4.0, 5.9), (5.0, 7.35), (5.0, 7.95)];
    let pairs: Vec<(f64, f64)> = pairs.into_iter().chain([(6.0, 9.26), (6.0, 10.2)]).collect();
    let watts = [
        [2.0, 1.0, 1.0],
        [4.0, 2.0, 2.0],
        [4.0, 2.0, 1.0],
        [5.0, 2.0, 2.0],
        [5.0, 2.0, 3.0],
        [5.0, 2.0, 4.0],
        [6.0, 1.0, 5.0],
        [6.0, 2.0, 5.0],
        [6.0, 2.0, 3.0],
        [6.0, 3.0, 3.0],
        [6.0, 3.0, 1.0],
        [6.0, 3.0, 2.0],
        [6.0, 3.0, 4.0],
        [6.0, 2.0, 4.0],
    ];
    let all_roberts = [
        [2.0, 2.0, 1.0, 2.0],
        [3.0, 2.0, 1.0, 1.0],
        [3.0, 3.0, 1.0, 1.0],
        [4.0, 3.0, 1.0, 1.0],
        [4.0, 2.0, 2.0, 3.0],
        [4.0, 3.0, 2.0, 3.0],
    ];
    let all = pairs.iter().map(|&(p, s)| evans(p, s));
    let all = all.chain(pairs.iter().map(|&(p, r)| chebyshev(p, r)));
    let all = all.chain(watts.iter().map(|&[p, r, a]| watt(p, r, a)));
    let all = all.chain(all_roberts.iter().map(|&[p, r, a, b]| roberts(p, r, a, b)));
    (1..).zip(all).collect()
}

fn size(circuit: &Circuit, joint: JointId) -> f64 {
    let points = || circuit.points(joint);
    let range = |f: fn(Point) -> f64| {
        points().map(f).fold(f64::NEG_INFINITY, f64::max) - points().map(f).fold(f64::INFINITY, f64::min)
    };
    range(|p| p.x).max(range(|p| p.y))
}

#[test]
fn samples_match_the_programs_of_the_thesis() {
    for (number, figure) in figures() {
        let motion = Motion::solve(&figure.linkage, &Sampler::new(figure.sampling));
        assert_eq!(motion.circuits.len(), 1, "figure {number}");
        let circuit = &motion.circuits[0];
        let joint = figure.linkage.traced[0];
        assert_eq!(circuit.len(), 180, "figure {number}");
        let size = size(circuit, joint);
        let [p, r, a, s] = figure.lengths;
        for sample in 0..circuit.len() {
            let w = trig::radians(circuit.inputs[sample]);
            let rd = (p * p + r * r - 2.0 * p * r * trig::cos(w)).sqrt();
            let foot = (s * s - a * a + rd * rd) / (2.0 * rd);
            let height = (s * s - foot * foot).max(0.0).sqrt();
            // Away from a limit 1e-12 of the curve's size; nearer one the reference loses digits in proportion.
            let tolerance =
                if height > 1e-3 * a.min(s) { 1e-12 * size } else { 1e-15 * size * size / height.max(1e-9) + 1e-7 };
            let branch = f64::from(circuit.mode_at(sample).sign(DyadId::FIRST));
            let expected = (figure.program)(w, branch);
            let found = circuit.positions.point(joint, sample);
            assert!((found - expected).norm() <= tolerance, "figure {number} sample {sample}: {found} {expected}");
        }
    }
}

#[test]
fn watt_and_roberts_reach_their_limits() {
    for (number, figure) in figures().into_iter().filter(|(n, _)| *n > 20) {
        let circuit = &Motion::solve(&figure.linkage, &Sampler::new(figure.sampling)).circuits[0];
        let [p, r, a, s] = figure.lengths;
        // Natesan (4.6), (4.9).
        let limit = trig::degrees(trig::acos((p * p + r * r - (s + a) * (s + a)) / (2.0 * p * r)));
        let upper = circuit.inputs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((upper - limit).abs() < 1e-12 * limit, "figure {number}: {upper} {limit}");
    }
}

#[test]
fn links_keep_their_lengths_at_every_sample() {
    for (number, figure) in figures() {
        let linkage = &figure.linkage;
        for circuit in Motion::solve(linkage, &Sampler::new(figure.sampling)).circuits {
            for link in &linkage.links {
                for pair in link.joints.windows(2) {
                    let length = (pair[0].1 - pair[1].1).norm();
                    for sample in 0..circuit.len() {
                        let found =
                            circuit.positions.point(pair[0].0, sample) - circuit.positions.point(pair[1].0, sample);
                        assert!((found.norm() - length).abs() <= 1e-12 * length, "figure {number} sample {sample}");
                    }
                }
            }
        }
    }
}
