//! Nelder and Mead's simplex: the least value of a function that has no derivative to go by.

/// How far a search goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Options {
    /// How far the first corners are from the start, in each coordinate.
    pub initial_step: f64,
    /// How often the function may be asked.
    pub max_evaluations: usize,
}

/// A place and what the function is there.
type Vertex<T> = (Vec<f64>, f64, T);

/// The least place found from a start, with its value and what came with it.
///
/// The function gives a value and whatever belongs to it; a value that is not a number is taken for infinity. The same
/// start gives the same place on every machine.
///
/// # Source
/// Nelder and Mead, *A simplex method for function minimization*, Computer Journal 7 (1965).
pub(super) fn minimize<T: Clone>(start: &[f64], effort: Options, mut of: impl FnMut(&[f64]) -> (f64, T)) -> Vertex<T> {
    /// A simplex this small beside a step of 1 has arrived.
    const SMALL: f64 = 1e-4;
    let mut ask = |place: Vec<f64>| -> Vertex<T> {
        let (value, with) = of(&place);
        (place, if value.is_nan() { f64::INFINITY } else { value }, with)
    };
    let n = start.len();
    let mut corners = vec![ask(start.to_vec())];
    for axis in 0..n {
        let mut place = start.to_vec();
        place[axis] += effort.initial_step;
        corners.push(ask(place));
    }
    let mut asked = n + 1;
    while asked < effort.max_evaluations && n > 0 {
        // The sort is stable: of equal corners the older stays before.
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let width = (0..n).map(|axis| (corners[n].0[axis] - corners[0].0[axis]).abs()).fold(0.0, f64::max);
        if width < SMALL {
            break;
        }
        let middle: Vec<f64> =
            (0..n).map(|axis| corners[..n].iter().map(|corner| corner.0[axis]).sum::<f64>() / n as f64).collect();
        let beyond = |by: f64| (0..n).map(|k| middle[k] + by * (corners[n].0[k] - middle[k])).collect::<Vec<f64>>();
        let mirrored = ask(beyond(-1.0));
        asked += 1;
        let next = if mirrored.1 < corners[0].1 {
            let further = ask(beyond(-2.0));
            asked += 1;
            Some(if further.1 < mirrored.1 { further } else { mirrored })
        } else if mirrored.1 < corners[n - 1].1 {
            Some(mirrored)
        } else {
            let (inner, worst) = if mirrored.1 < corners[n].1 { (-0.5, mirrored.1) } else { (0.5, corners[n].1) };
            let drawn_in = ask(beyond(inner));
            asked += 1;
            (drawn_in.1 < worst).then_some(drawn_in)
        };
        match next {
            Some(next) => corners[n] = next,
            None => {
                let best = corners[0].0.clone();
                for corner in &mut corners[1..] {
                    let halved = corner.0.iter().zip(&best).map(|(x, b)| (x + b) / 2.0).collect();
                    *corner = ask(halved);
                    asked += 1;
                }
            }
        }
    }
    corners.sort_by(|a, b| a.1.total_cmp(&b.1));
    corners.swap_remove(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_walks_down_rosenbrocks_valley() {
        let valley = |x: &[f64]| {
            let (a, b) = (1.0 - x[0], x[1] - x[0] * x[0]);
            (a * a + 100.0 * b * b, ())
        };
        let (place, value, ()) = minimize(&[-1.2, 1.0], Options { initial_step: 0.5, max_evaluations: 400 }, valley);
        // The valley is flat along its bottom: a place to 1e-2 there is a value to 1e-5.
        assert!(value < 1e-5 && place.iter().all(|x| (x - 1.0).abs() < 1e-2), "{place:?} {value}");
    }

    #[test]
    fn what_is_no_number_is_kept_away_from() {
        let root = |x: &[f64]| (x[0].sqrt(), x[0]);
        let (_, value, with) = minimize(&[1.0], Options { initial_step: 0.3, max_evaluations: 200 }, root);
        // The root of a place known to 1e-4.
        assert!((0.0..2e-2).contains(&value) && with >= 0.0, "{value}");
    }
}
