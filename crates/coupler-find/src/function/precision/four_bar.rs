//! Four-bars with precision points.

use super::solution::{Exact, GivenStarts, NOTHING, NoLinkage, conjugate, forms, number, times, value};
use crate::complex::{Complex, length, unit};
use crate::function::elimination::{Row, null_space, zeros_of_products};
use crate::function::generator::{Generator, GeneratorKind};
use coupler_curves::geometry::trig;

const ONE: Complex = Complex::new(1.0, 0.0);

/// All four-bars of five points, of four with one start, or of three with both.
pub(super) fn four_bars(points: &[[f64; 2]], starts: GivenStarts) -> Exact {
    let basis = null_space(points.iter().map(|point| row(*point, starts)).collect());
    let [input, output] = starts.map(|start| start.map(unit));
    if let [Some(input), Some(output)] = starts {
        let [solution] = &basis[..] else { return Exact::degenerate() };
        return Exact::collect([of_numbers(solution, [input, output])]);
    }
    let Ok(basis) = <[Row; 2]>::try_from(basis) else { return Exact::degenerate() };
    // Where P, Q, K3 and E are in a row.
    let (parts, k3): ([&[usize]; 3], usize) = match (input, output) {
        (Some(_), _) => ([&[0, 1], &[2], &[4, 5]], 3),
        (_, Some(_)) => ([&[0], &[1, 2], &[4, 5]], 3),
        _ => ([&[0, 1], &[2, 3], &[5, 6]], 4),
    };
    let [p, q, e] = forms(&basis, parts);
    // A part with a given direction is real until it is turned there. It agrees wherever it is not zero, so that the direction alone counts.
    let [p, q] = [(p, output), (q, input)].map(|(form, given)| times(form, given.unwrap_or(ONE)));
    let minus_i = Complex::new(0.0, -1.0);
    let directions = match (input, output) {
        (Some(given), _) => zeros_of_products(&[&[times(conjugate(p), given * minus_i), conjugate(e)]]),
        (_, Some(given)) => zeros_of_products(&[&[times(q, given.conj() * minus_i), conjugate(e)]]),
        _ => zeros_of_products(&[&[times(q, minus_i), conjugate(p), conjugate(e)]]),
    };
    let Some(directions) = directions else { return Exact::degenerate() };
    let linkage = |at: [f64; 2]| four_bar(value(&p, at), value(&q, at), value(&e, at), number(&basis, k3, at));
    Exact::collect(directions.into_iter().map(linkage))
}

/// The four-bar of both starts and of the lengths of P and Q, K3 and the length of E, each as many times greater.
pub(super) fn of_numbers(numbers: &[f64], starts: [f64; 2]) -> Result<Generator, NoLinkage> {
    let [input, output] = starts.map(unit);
    four_bar(output * numbers[0], input * numbers[1], input * output.conj() * numbers[3], numbers[2])
}

/// The equation of a point: the coefficients of P, Q, K3 and E; of P and Q with a given start that of their lengths, and with both given that
/// of the length of E.
pub(super) fn row([x, y]: [f64; 2], [input, output]: GivenStarts) -> Row {
    let of_direction = |angle: f64, sign: f64| [sign * trig::cos(angle), -sign * trig::sin(angle)];
    let mut row = Row::new();
    let mut push = |angle: f64, given: Option<f64>, sign: f64| match given {
        Some(start) => row.push(sign * trig::cos(start + angle)),
        None => row.extend(of_direction(angle, sign)),
    };
    push(y, output, 1.0);
    push(x, input, -1.0);
    row.push(1.0);
    match input.zip(output) {
        Some((input, output)) => row.push(-trig::cos(input + x - output - y)),
        None => row.extend(of_direction(x - y, -1.0)),
    }
    row
}

/// The four-bar of P, Q, E and K3, each as many times greater, on any side.
fn four_bar(p: Complex, q: Complex, e: Complex, k3: f64) -> Result<Generator, NoLinkage> {
    let norm = length(e);
    let size = (p.norm_sqr() + q.norm_sqr() + e.norm_sqr() + k3 * k3).sqrt();
    if [norm, length(p), length(q)].iter().any(|part| part.is_nan() || *part <= NOTHING * size) {
        return Err(NoLinkage::Infinite);
    }
    // With the other sign those parts agree that are opposite with this one.
    let factor = if (q * p.conj() * e.conj()).re < 0.0 { -1.0 / norm } else { 1.0 / norm };
    let (p, q, k3) = (p * factor, q * factor, k3 * factor);
    let (crank, rocker) = (1.0 / length(p), 1.0 / length(q));
    let squared = 1.0 + crank * crank + rocker * rocker - 2.0 * crank * rocker * k3;
    if squared.is_nan() || squared <= 0.0 {
        return Err(NoLinkage::Imaginary);
    }
    let starts = [q, p].map(|part| trig::atan2(part.im, part.re));
    let lengths = [crank, squared.sqrt(), rocker];
    Ok(Generator { kind: GeneratorKind::FourBar, lengths, starts, side: 1.0 })
}
