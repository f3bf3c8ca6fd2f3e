//! Slider-cranks with precision points.

use super::solution::{Exact, GivenStarts, NOTHING, NoLinkage, conjugate, forms, number, times, value};
use crate::complex::{Complex, length, unit};
use crate::function::elimination::{Row, null_space, zeros_of_products};
use crate::function::generator::{Generator, GeneratorKind};
use coupler_curves::geometry::trig;

/// All slider-cranks of five points, of four with one start, or of three with both.
pub(super) fn slider_cranks(points: &[[f64; 2]], starts: GivenStarts) -> Exact {
    let basis = null_space(points.iter().map(|point| row(*point, starts)).collect());
    match starts {
        [Some(input), Some(output)] => {
            let [solution] = &basis[..] else { return Exact::degenerate() };
            Exact::collect([of_numbers(solution, [input, output])])
        }
        [input, output] => {
            let Ok(basis) = <[Row; 2]>::try_from(basis) else { return Exact::degenerate() };
            match output {
                Some(output) => of_output(&basis, output),
                None => of_input(&basis, input.map(unit)),
            }
        }
    }
}

/// The slider-crank of both starts and of the lengths of P and W, K and 1, each as many times greater.
pub(super) fn of_numbers(numbers: &[f64], [input, output]: [f64; 2]) -> Result<Generator, NoLinkage> {
    let direction = unit(input);
    let lean = Complex::new(direction.im, -direction.re);
    slider_crank(direction * numbers[0], lean * numbers[1], output, [numbers[2], numbers[3]])
}

/// Those with a given start of the output: with W = -i offset P for R, Re(W P*) = 0.
fn of_output(basis: &[Row; 2], output: f64) -> Exact {
    const K_AND_ONE: [usize; 2] = [4, 5];
    let [p, w] = forms(basis, [&[0, 1], &[2, 3]]);
    let Some(directions) = zeros_of_products(&[&[w, conjugate(p)]]) else { return Exact::degenerate() };
    Exact::collect(
        directions.into_iter().map(|at| {
            slider_crank(value(&p, at), value(&w, at), output, K_AND_ONE.map(|index| number(basis, index, at)))
        }),
    )
}

/// Those with or without a given direction of the crank, and any start of the output.
fn of_input(basis: &[Row; 2], given: Option<Complex>) -> Exact {
    // Where P, R, K, the start of the output and 1 are in a row.
    let ([p_part, r_part], [k, start, one]): ([&[usize]; 2], [usize; 3]) = match given {
        Some(_) => ([&[0], &[1, 2]], [3, 4, 5]),
        None => ([&[0, 1], &[2, 3]], [4, 5, 6]),
    };
    let [p, r, s, h] = forms(basis, [p_part, r_part, &[start], &[one]]);
    let minus_s = times(s, Complex::new(-1.0, 0.0));
    // Re(R P*) = s0 |P|², or with the direction d of P, Re(R d*) = s0 Re(P d*).
    let directions = match given {
        Some(given) => zeros_of_products(&[&[h, times(r, given.conj())], &[minus_s, p]]),
        None => zeros_of_products(&[&[h, r, conjugate(p)], &[minus_s, p, conjugate(p)]]),
    };
    let Some(directions) = directions else { return Exact::degenerate() };
    let p = times(p, given.unwrap_or(Complex::new(1.0, 0.0)));
    Exact::collect(directions.into_iter().map(|at| {
        let one = number(basis, one, at);
        let output = number(basis, start, at) / one;
        let p = value(&p, at);
        // K lacks the square of the start, and R has it along P.
        let k = number(basis, k, at) + output * output * one;
        slider_crank(p, value(&r, at) - p * output, output, [k, one])
    }))
}

/// The equation of a point: the coefficients of P, R, K, the start of the output and 1; with a given start of the output, of P, W, K and 1, and
/// with a given input of the lengths of P and W.
pub(super) fn row([x, y]: [f64; 2], [input, output]: GivenStarts) -> Row {
    let way = output.unwrap_or(0.0) + y;
    let (cos, sin) = (trig::cos(x), trig::sin(x));
    let mut row = match input {
        Some(start) => vec![way * trig::cos(start + x)],
        None => vec![way * cos, -way * sin],
    };
    match input.zip(output) {
        Some((start, _)) => row.push(trig::sin(start + x)),
        None => row.extend([cos, -sin]),
    }
    row.push(1.0);
    if output.is_none() {
        row.push(-2.0 * y);
    }
    row.push(-way * way);
    row
}

/// The slider-crank of P, W, K and 1, each as many times greater, on any side.
fn slider_crank(p: Complex, w: Complex, output: f64, [k, one]: [f64; 2]) -> Result<Generator, NoLinkage> {
    let size = (p.norm_sqr() + w.norm_sqr() + k * k + one * one).sqrt();
    if [one.abs(), length(p)].iter().any(|part| part.is_nan() || *part <= NOTHING * size) {
        return Err(NoLinkage::Infinite);
    }
    let crank = 0.5 * length(p) / one.abs();
    let offset = -(w * p.conj()).im / p.norm_sqr();
    let squared = k / one + crank * crank + offset * offset;
    if squared.is_nan() || squared <= 0.0 {
        return Err(NoLinkage::Imaginary);
    }
    let p = p * one.signum();
    let starts = [trig::atan2(p.im, p.re), output];
    let lengths = [crank, squared.sqrt(), offset];
    Ok(Generator { kind: GeneratorKind::SliderCrank, lengths, starts, side: 1.0 })
}
