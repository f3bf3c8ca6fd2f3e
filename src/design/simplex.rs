//! Minimizes functions without derivatives, by the simplex method of Nelder and Mead.

/// The extent of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Options {
    /// The distance of the initial vertices from the start, along each coordinate.
    pub initial_step: f64,
    /// After this many evaluations no iteration is begun.
    pub max_evaluations: usize,
}

/// A point, the value of the function there, and what the function returned with it.
type Vertex<T> = (Vec<f64>, f64, T);

/// Minimizes a function from a starting point, and returns the best vertex found.
///
/// The function returns its value and any data that belongs to it; NaN counts as infinity. The same start gives the
/// same result on every machine.
///
/// # Source
/// Nelder and Mead, *A simplex method for function minimization*, Computer Journal 7 (1965).
pub(super) fn minimize<T: Clone>(
    start: &[f64],
    options: Options,
    mut function: impl FnMut(&[f64]) -> (f64, T),
) -> Vertex<T> {
    /// The search ends when the simplex is this small in every coordinate.
    const SMALL: f64 = 1e-4;
    let mut evaluate = |point: Vec<f64>| -> Vertex<T> {
        let (value, data) = function(&point);
        (point, if value.is_nan() { f64::INFINITY } else { value }, data)
    };
    let n = start.len();
    let mut vertices = vec![evaluate(start.to_vec())];
    for axis in 0..n {
        let mut point = start.to_vec();
        point[axis] += options.initial_step;
        vertices.push(evaluate(point));
    }
    let mut evaluations = n + 1;
    while evaluations < options.max_evaluations && n > 0 {
        // The sort is stable: among equal vertices the older stays first.
        vertices.sort_by(|a, b| a.1.total_cmp(&b.1));
        let width = (0..n).map(|axis| (vertices[n].0[axis] - vertices[0].0[axis]).abs()).fold(0.0, f64::max);
        if width < SMALL {
            break;
        }
        let centroid: Vec<f64> =
            (0..n).map(|axis| vertices[..n].iter().map(|vertex| vertex.0[axis]).sum::<f64>() / n as f64).collect();
        let along =
            |factor: f64| (0..n).map(|k| centroid[k] + factor * (vertices[n].0[k] - centroid[k])).collect::<Vec<f64>>();
        let reflected = evaluate(along(-1.0));
        evaluations += 1;
        let next = if reflected.1 < vertices[0].1 {
            let expanded = evaluate(along(-2.0));
            evaluations += 1;
            Some(if expanded.1 < reflected.1 { expanded } else { reflected })
        } else if reflected.1 < vertices[n - 1].1 {
            Some(reflected)
        } else {
            let (inner, worst) = if reflected.1 < vertices[n].1 { (-0.5, reflected.1) } else { (0.5, vertices[n].1) };
            let contracted = evaluate(along(inner));
            evaluations += 1;
            (contracted.1 < worst).then_some(contracted)
        };
        match next {
            Some(next) => vertices[n] = next,
            None => {
                let best = vertices[0].0.clone();
                for vertex in &mut vertices[1..] {
                    let halved = vertex.0.iter().zip(&best).map(|(x, b)| (x + b) / 2.0).collect();
                    *vertex = evaluate(halved);
                    evaluations += 1;
                }
            }
        }
    }
    vertices.sort_by(|a, b| a.1.total_cmp(&b.1));
    vertices.swap_remove(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_minimum_of_rosenbrocks_function_is_found() {
        let valley = |x: &[f64]| {
            let (a, b) = (1.0 - x[0], x[1] - x[0] * x[0]);
            (a * a + 100.0 * b * b, ())
        };
        let (point, value, ()) = minimize(&[-1.2, 1.0], Options { initial_step: 0.5, max_evaluations: 400 }, valley);
        // The valley is flat along its floor: a point within 1e-2 there has a value within 1e-5.
        assert!(value < 1e-5 && point.iter().all(|x| (x - 1.0).abs() < 1e-2), "{point:?} {value}");
    }

    #[test]
    fn points_without_a_value_are_avoided() {
        let root = |x: &[f64]| (x[0].sqrt(), x[0]);
        let (_, value, data) = minimize(&[1.0], Options { initial_step: 0.3, max_evaluations: 200 }, root);
        // The square root of a point known to 1e-4.
        assert!((0.0..2e-2).contains(&value) && data >= 0.0, "{value}");
    }
}
