//! Homogeneous linear equations, and the zeros of forms in two variables: what the equations of precision points are reduced to.

use crate::complex::{Complex, length};
use coupler_curves::numerical::real_roots;

/// What an equation of precision points is linear in: the number of columns is that of the kind of problem.
pub(super) type Row = Vec<f64>;

/// A basis of the solutions of homogeneous linear equations, orthonormal; by elimination with complete pivoting. A pivot less than 1e-11 of
/// the greatest coefficient is rounding: of five points some digits are lost in products.
pub(super) fn null_space(mut rows: Vec<Row>) -> Vec<Row> {
    const ROUNDING: f64 = 1e-11;
    let columns = rows.first().map_or(0, Vec::len);
    let size = rows.iter().flatten().fold(0.0, |most: f64, entry| most.max(entry.abs()));
    let mut pivots: Vec<usize> = Vec::new();
    for step in 0..rows.len() {
        let mut best = (ROUNDING * size, None);
        for (r, row) in rows.iter().enumerate().skip(step) {
            for (c, entry) in row.iter().enumerate() {
                if !pivots.contains(&c) && entry.abs() > best.0 {
                    best = (entry.abs(), Some((r, c)));
                }
            }
        }
        let Some((r, c)) = best.1 else { break };
        rows.swap(step, r);
        let pivot = rows[step].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != step) {
            let factor = row[c] / pivot[c];
            row.iter_mut().zip(&pivot).for_each(|(entry, by)| *entry -= factor * by);
            row[c] = 0.0;
        }
        pivots.push(c);
    }
    let mut basis: Vec<Row> = Vec::new();
    for free in (0..columns).filter(|c| !pivots.contains(c)) {
        let mut vector = vec![0.0; columns];
        vector[free] = 1.0;
        for (row, &c) in rows.iter().zip(&pivots) {
            vector[c] = -row[free] / row[c];
        }
        for other in &basis {
            let part: f64 = vector.iter().zip(other).map(|(a, b)| a * b).sum();
            vector.iter_mut().zip(other).for_each(|(entry, by)| *entry -= part * by);
        }
        let norm = vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        vector.iter_mut().for_each(|entry| *entry /= norm);
        basis.push(vector);
    }
    basis
}

/// A complex number that is linear in two variables.
pub(super) type LinearForm = [Complex; 2];

/// The directions (u, v) in which the real part of a sum of products of linear forms, all of as many, is zero, each once; `None` if it is zero in all,
/// to rounding.
///
/// A form of degree n has at most n, and all are found: the polynomial in a coordinate in which the greatest of some values of the form is at
/// infinity has them as its roots.
pub(super) fn zeros_of_products(products: &[&[LinearForm]]) -> Option<Vec<[f64; 2]>> {
    /// Of a value relative to the sum of its terms' sizes.
    const ROUNDING: f64 = 1e-12;
    let at = |[u, v]: [f64; 2]| {
        products.iter().map(|factors| factors.iter().map(|[a, b]| a * u + b * v).product::<Complex>().re).sum::<f64>()
    };
    let size = |factors: &&[LinearForm]| factors.iter().map(|[a, b]| length(*a) + length(*b)).product::<f64>();
    let size: f64 = products.iter().map(size).sum();
    // More than the degree of any form, so that it is not zero in all of them.
    let directions = [[1.0, 0.0], [0.0, 1.0], [0.8, 0.6], [-0.6, 0.8], [0.96, -0.28], [0.28, 0.96]];
    let most = directions.into_iter().max_by(|a, b| at(*a).abs().total_cmp(&at(*b).abs()))?;
    let greatest = at(most).abs();
    if greatest.is_nan() || greatest <= ROUNDING * size {
        return None;
    }
    // With u, v = t most + across.
    let across = [-most[1], most[0]];
    let mut coefficients = Vec::new();
    for factors in products {
        let mut product = vec![Complex::new(1.0, 0.0)];
        for [a, b] in *factors {
            let [rising, constant] = [most, across].map(|[u, v]| a * u + b * v);
            let mut next = vec![Complex::new(0.0, 0.0); product.len() + 1];
            for (k, coefficient) in product.iter().enumerate() {
                next[k] += coefficient * constant;
                next[k + 1] += coefficient * rising;
            }
            product = next;
        }
        coefficients.resize(product.len(), 0.0);
        coefficients.iter_mut().zip(&product).for_each(|(sum, term)| *sum += term.re);
    }
    let direction = |t: f64| [t * most[0] + across[0], t * most[1] + across[1]];
    Some(real_roots(&coefficients).into_iter().map(direction).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatter::Scatter;

    #[test]
    fn a_null_space_solves_the_equations_and_has_the_dimension_that_is_left() {
        let mut scatter = Scatter::new(1);
        for (equations, unknowns) in [(5, 7), (4, 6), (3, 4), (1, 2)] {
            let mut rows: Vec<Row> =
                (0..equations).map(|_| (0..unknowns).map(|_| scatter.normal(1.0)).collect()).collect();
            let check = |rows: &[Row], dimension: usize| {
                let basis = null_space(rows.to_vec());
                assert_eq!(basis.len(), dimension);
                for vector in &basis {
                    for row in rows {
                        assert!(row.iter().zip(vector).map(|(a, b)| a * b).sum::<f64>().abs() < 1e-12);
                    }
                }
            };
            check(&rows, unknowns - equations);
            // An equation that follows from another.
            rows[0] = rows[equations - 1].iter().map(|entry| 2.0 * entry).collect();
            check(&rows, unknowns - equations + usize::from(equations > 1));
        }
    }

    #[test]
    fn all_directions_in_which_a_product_vanishes_are_found() {
        // Re of real forms: each vanishes in its own direction, also at both ends of the coordinate.
        let real = |a: f64, b: f64| [Complex::new(a, 0.0), Complex::new(b, 0.0)];
        let zeros = zeros_of_products(&[&[real(1.0, 0.0), real(0.0, 2.0), real(3.0, 3.0)]]).unwrap();
        let mut angles: Vec<f64> = zeros.iter().map(|[u, v]| u / (u * u + v * v).sqrt() * v.signum()).collect();
        angles.sort_by(f64::total_cmp);
        let expected = [-0.5f64.sqrt(), 0.0, 1.0];
        assert!(angles.iter().zip(expected).all(|(a, b)| (a.abs() - b.abs()).abs() < 1e-9), "{angles:?}");
        assert_eq!(zeros_of_products(&[&[real(0.0, 0.0)]]), None);
        // u² - v²
        let zeros =
            zeros_of_products(&[&[real(1.0, 0.0), real(1.0, 0.0)], &[real(0.0, 1.0), real(0.0, -1.0)]]).unwrap();
        assert!(zeros.len() == 2 && zeros.iter().all(|[u, v]| (u.abs() - v.abs()).abs() < 1e-12), "{zeros:?}");
        // |z|² has none.
        let z = [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0)];
        let conjugate = z.map(|part: Complex| part.conj());
        assert_eq!(zeros_of_products(&[&[z, conjugate]]), Some(Vec::new()));
    }
}
