//! Real roots of polynomials.

use super::Bracket;

/// The real roots of a polynomial, given by ascending powers, in ascending order. There is at most one between two
/// roots of the derivative; a root of even order is a root of both. None of a constant; a leading coefficient that is less than 1e-14 of
/// the greatest is rounding, and counts as 0.
pub fn real_roots(coefficients: &[f64]) -> Vec<f64> {
    let size = coefficients.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
    let degree = coefficients.iter().rposition(|c| c.abs() > 1e-14 * size).unwrap_or(0);
    if degree == 0 {
        return Vec::new();
    }
    let coefficients = &coefficients[..=degree];
    let value = |t: f64| coefficients.iter().rev().fold([0.0; 2], |[v, s], c| [v * t + c, s * t.abs() + c.abs()]);
    let lead = coefficients[degree];
    // Cauchy's bound on the roots.
    let bound = 1.0 + coefficients[..degree].iter().fold(0.0, |a: f64, c| a.max((c / lead).abs()));
    let derivative: Vec<f64> = (1..=degree).map(|n| n as f64 * coefficients[n]).collect();
    let extrema = real_roots(&derivative);
    let mut breaks = vec![-bound];
    breaks.extend(extrema.iter().copied().filter(|t| t.abs() < bound));
    breaks.push(bound);
    let mut roots: Vec<f64> = Vec::new();
    for pair in breaks.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let ([fa, sa], [fb, _]) = (value(a), value(b));
        // At an extremum a value within its rounding error is a root of even order.
        if extrema.contains(&a) && fa.abs() <= 1e-13 * sa {
            roots.push(a);
        } else if let Some(bracket) = Bracket::new([a, b], [fa, fb]) {
            roots.push(bracket.zero(0.0, |t| value(t)[0]));
        }
    }
    roots.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * bound);
    roots
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The coefficients of a product of linear factors.
    fn product(roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![1.0], |factors, root| {
            let at = |k: usize| factors.get(k).copied().unwrap_or(0.0);
            (0..=factors.len()).map(|k| if k == 0 { -root * at(0) } else { at(k - 1) - root * at(k) }).collect()
        })
    }

    #[test]
    fn roots_of_even_order_are_found_and_a_constant_has_none() {
        assert_eq!(real_roots(&[]), [0.0; 0]);
        assert_eq!(real_roots(&[3.0]), [0.0; 0]);
        assert_eq!(real_roots(&[1.0, 0.0, 1.0]), [0.0; 0]);
        assert_eq!(real_roots(&[4.0, -4.0, 1.0]), [2.0]);
        assert_eq!(real_roots(&[-1.0, 2.0, 0.0]), [0.5]);
    }

    proptest! {
        #[test]
        fn the_roots_of_a_product_are_those_of_its_factors(
            mut roots in prop::collection::vec(-4.0..4.0f64, 1..4), size in 1e-3..1e3f64,
        ) {
            roots.sort_by(f64::total_cmp);
            prop_assume!(roots.windows(2).all(|pair| pair[1] - pair[0] > 1e-3));
            let coefficients: Vec<f64> = product(&roots).iter().map(|c| size * c).collect();
            let found = real_roots(&coefficients);
            prop_assert_eq!(found.len(), roots.len());
            prop_assert!(found.iter().zip(&roots).all(|(a, b)| (a - b).abs() < 1e-8), "{:?} {:?}", found, roots);
        }
    }
}
