//! The linkages whose output is exact at precision points, all of them.
//!
//! Freudenstein's equation of a four-bar with the frame 1, K1 cos ψ - K2 cos θ + K3 = cos(θ - ψ), with K1 = 1 / crank, K2 = 1 / rocker
//! and K3 = (1 + crank² + rocker² - coupler²) / (2 crank rocker), is linear in P = K1 exp(i ψ0), Q = K2 exp(i θ0), K3 and
//! E = exp(i (θ0 - ψ0)), of which P, Q and E must agree: Im(Q P* E*) = 0. Five points leave two dimensions of these seven numbers, in
//! which the agreement is a cubic form: there are at most three linkages, and all are found. Four points, with one start given, leave a
//! quadratic form and two linkages at most, and three, with both, one linkage.
//!
//! Of a slider-crank with the way s = s0 + σ, s² - 2 s crank cos θ - 2 offset crank sin θ + crank² + offset² - coupler² = 0 is linear in
//! P = 2 crank exp(i θ0), R = (s0 - i offset) P, K = coupler² - crank² - offset² - s0² and s0, which must agree: Re(R P*) = s0 |P|².
//! There are as many.
//!
//! # Source
//! F. Freudenstein, Approximate synthesis of four-bar linkages, *Transactions of the ASME* 77 (1955), for the equation and three to five
//! points; the elimination is our own.

mod four_bar;
mod slider_crank;
mod solution;

pub(super) use solution::{Exact, GivenStarts};

use super::generator::{Generator, GeneratorKind};
use nalgebra::{Matrix3, Vector3};

/// All linkages with their output exact at some points, each the travels of input and output from the start: five points, or four with one
/// of the starts given, or three with both. The side is that at the first point.
pub(super) fn exact(kind: GeneratorKind, points: &[[f64; 2]], starts: GivenStarts) -> Exact {
    let mut found = match kind {
        GeneratorKind::FourBar => four_bar::four_bars(points, starts),
        GeneratorKind::SliderCrank => slider_crank::slider_cranks(points, starts),
    };
    if let Some([x, y]) = points.first() {
        for linkage in &mut found.linkages {
            linkage.side = Generator::side_of(kind, linkage.lengths, [linkage.starts[0] + x, linkage.starts[1] + y]);
        }
    }
    found
}

/// The linkage with given starts that is nearest to many points, by the squares of what their equations lack, which is not the error of the
/// output but leads near; on any side. `None` if it is not real.
pub(super) fn nearest(kind: GeneratorKind, points: &[[f64; 2]], starts: [f64; 2]) -> Option<Generator> {
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for point in points {
        let row = match kind {
            GeneratorKind::FourBar => four_bar::row(*point, starts.map(Some)),
            GeneratorKind::SliderCrank => slider_crank::row(*point, starts.map(Some)),
        };
        let unknowns = Vector3::new(row[0], row[1], row[2]);
        normal += unknowns * unknowns.transpose();
        right -= unknowns * row[3];
    }
    let solution = normal.cholesky()?.solve(&right);
    let numbers = [solution.x, solution.y, solution.z, 1.0];
    let found = match kind {
        GeneratorKind::FourBar => four_bar::of_numbers(&numbers, starts),
        GeneratorKind::SliderCrank => slider_crank::of_numbers(&numbers, starts),
    };
    found.ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatter::Scatter;
    use coupler_curves::geometry::trig;

    /// Random linkages through all of some points on one branch: their points, and the linkage.
    fn random(scatter: &mut Scatter, kind: GeneratorKind, count: usize) -> (Generator, Vec<[f64; 2]>) {
        loop {
            let mut length = || trig::exp(scatter.normal(0.5));
            let lengths = [length(), length(), length()];
            let side = if scatter.normal(1.0) > 0.0 { 1.0 } else { -1.0 };
            let start = scatter.normal(2.0);
            let mut travel = 0.0;
            let mut steps = vec![0.0];
            for _ in 1..count {
                travel += 0.15 + scatter.normal(0.1).abs();
                steps.push(travel);
            }
            let generator = Generator { kind, lengths, starts: [start, 0.0], side };
            if generator.worst_transmission(start, start + travel) < 0.2 {
                continue;
            }
            let outputs: Option<Vec<f64>> = steps.iter().map(|x| generator.output(start + x)).collect();
            let Some(outputs) = outputs else { continue };
            let points = steps.iter().zip(&outputs).map(|(x, y)| [*x, y - outputs[0]]).collect();
            return (Generator { starts: [start, outputs[0]], ..generator }, points);
        }
    }

    /// Whether a linkage is at all points, on any branch.
    fn is_exact(linkage: &Generator, points: &[[f64; 2]]) -> bool {
        let [a, b, third] = linkage.lengths;
        let unclosed = |[x, y]: &[f64; 2]| {
            let (input, output) = (linkage.starts[0] + x, linkage.starts[1] + y);
            let end = match linkage.kind {
                GeneratorKind::FourBar => [1.0 + third * trig::cos(output), third * trig::sin(output)],
                GeneratorKind::SliderCrank => [output, third],
            };
            trig::hypot(end[0] - a * trig::cos(input), end[1] - a * trig::sin(input)) - b
        };
        let size = 1.0 + a + b + third.abs();
        points.iter().all(|point| unclosed(point).abs() < 1e-6 * size)
    }

    fn is_same(a: &Generator, b: &Generator) -> bool {
        let turn = |k: usize| {
            let difference = a.starts[k] - b.starts[k];
            if k == 1 && a.kind == GeneratorKind::SliderCrank { difference } else { trig::sin(0.5 * difference) }
        };
        (0..3).all(|k| (a.lengths[k] - b.lengths[k]).abs() < 1e-4 * (1.0 + b.lengths[k].abs()))
            && (0..2).all(|k| turn(k).abs() < 1e-4)
            && a.side == b.side
    }

    #[test]
    fn the_linkage_that_made_the_points_is_among_all_that_pass_them() {
        for kind in [GeneratorKind::FourBar, GeneratorKind::SliderCrank] {
            let mut scatter = Scatter::new(3);
            let mut most = [0; 4];
            for (case, [with_input, with_output]) in
                [[false, false], [true, false], [false, true], [true, true]].into_iter().enumerate()
            {
                let count = 5 - usize::from(with_input) - usize::from(with_output);
                for _ in 0..300 {
                    let (generator, points) = random(&mut scatter, kind, count);
                    let starts = [with_input, with_output];
                    let starts = [0, 1].map(|k| starts[k].then_some(generator.starts[k]));
                    let found = exact(kind, &points, starts);
                    assert!(!found.is_degenerate, "{generator:?}");
                    assert!(
                        found.linkages.iter().any(|linkage| is_same(linkage, &generator)),
                        "{case}: {generator:?} {points:?}: {found:?}"
                    );
                    assert!(found.linkages.iter().all(|linkage| is_exact(linkage, &points)), "{generator:?} {found:?}");
                    most[case] = most[case].max(found.linkages.len() + found.imaginary + found.infinite);
                }
            }
            assert_eq!(most, [3, 2, 2, 1], "{kind:?}");
        }
    }
}
