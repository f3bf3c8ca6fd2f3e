//! Certified steps along the curve on which the equations of a group hold.

use nalgebra::{Const, DMatrix, DVector, DVectorViewMut, Dyn, LU, SMatrix, SVectorViewMut};

use super::equations::{Equations, Linearization};
use crate::motion::enclosure::Enclosure;
use crate::motion::series::Series;
use crate::numerical::Bracket;

/// The most corrections of a state. Newton's method doubles the digits with each.
const MAX_CORRECTIONS: usize = 8;

/// Corrections as small as this, relative to the size of the linkage, are rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Corrections next to a limit that are rounding, at the least distance from it at which poses are corrected.
const MAGNIFIED_ROUNDING: f64 = 1e-8;

/// How often a tube is tried with greater radii.
const MAX_INFLATIONS: usize = 4;

/// A tube is wider at most, relative to the size of the linkage.
const FARTHEST_FROM_TANGENT: f64 = 0.5;

/// A state on the curve, and the direction of the curve there, a unit vector.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub state: Vec<f64>,
    pub tangent: Vec<f64>,
    /// Whether two parts of the curve cross there, a change point, so that its derivatives do not determine it.
    pub is_change: bool,
}

impl Node {
    /// How fast the input changes along the curve.
    pub fn input_rate(&self) -> f64 {
        self.tangent[self.tangent.len() - 1]
    }

    /// The node with the direction of another that is next to it, and 1 where that is its own, -1 where it is the other one.
    pub fn directed_as(mut self, other: &Node) -> (Node, f64) {
        let along: f64 = self.tangent.iter().zip(&other.tangent).map(|(a, b)| a * b).sum();
        let sense = if along < 0.0 { -1.0 } else { 1.0 };
        self.tangent.iter_mut().for_each(|rate| *rate *= sense);
        (self, sense)
    }

    /// The distance of two states, in all coordinates.
    pub fn distance(&self, other: &Node) -> f64 {
        let squares = self.state.iter().zip(&other.state).map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>().sqrt()
    }

    /// The state on the tangent, at a distance.
    pub fn ahead(&self, distance: f64) -> Vec<f64> {
        self.state.iter().zip(&self.tangent).map(|(at, rate)| at + rate * distance).collect()
    }

    /// The unknown, or the input, that changes most: with it as the parameter the curve is regular.
    pub fn parameter(&self) -> usize {
        let most = |best: usize, k: usize| if self.tangent[k].abs() > self.tangent[best].abs() { k } else { best };
        (0..self.tangent.len()).fold(0, most)
    }

    /// The state at a share of the way to the next node, by the cubic with the directions of both.
    pub fn towards(&self, next: &Node, share: f64) -> Vec<f64> {
        let cubic = self.cubic(next);
        (0..self.state.len()).map(|k| cubic(k, share)).collect()
    }

    /// The same at an input.
    pub fn at_input(&self, next: &Node, input: f64) -> Vec<f64> {
        let cubic = self.cubic(next);
        let last = self.state.len() - 1;
        // The cubic's input is all but monotonic, as that of the curve is.
        let misses = [self, next].map(|node| node.state[last] - input);
        let share = match Bracket::new([0.0, 1.0], misses) {
            Some(bracket) => bracket.zero(0.0, |share| cubic(last, share) - input),
            // It is at an end.
            None if misses[0].abs() < misses[1].abs() => 0.0,
            None => 1.0,
        };
        (0..=last).map(|k| cubic(k, share)).collect()
    }

    /// The cubic from this node to another: of each coordinate, at a share of the way.
    fn cubic(&self, next: &Node) -> impl Fn(usize, f64) -> f64 {
        let chord = self.distance(next);
        // Nodes are in the order of the curve or against it.
        let ahead: f64 = (0..self.state.len()).map(|k| (next.state[k] - self.state[k]) * self.tangent[k]).sum();
        let chord = if ahead < 0.0 { -chord } else { chord };
        move |k, u| {
            let (a, b) = (self.state[k], next.state[k]);
            let (da, db) = (self.tangent[k] * chord, next.tangent[k] * chord);
            let v = 1.0 - u;
            a * v * v * (1.0 + 2.0 * u) + da * u * v * v + b * u * u * (3.0 - 2.0 * u) - db * u * u * v
        }
    }
}

/// What is known of the curve between a node and a parameter ahead of it.
#[derive(Clone, Debug)]
pub(super) struct Tube {
    /// The unknown, or the input, that is the parameter.
    pub parameter: usize,
    /// The length of the tangent that it is around.
    pub length: f64,
    /// How far the curve is from the tangent at most, in each coordinate.
    pub radii: Vec<f64>,
    /// How much Krawczyk's operator shrinks the tube: less than 1.
    pub contraction: f64,
    /// Bounds of the rate of the input, and of that rate's rate, along the tangent.
    pub input_rates: [Enclosure; 2],
}

/// A square matrix in factors.
#[expect(clippy::large_enum_variant, reason = "millions are made, each for a few solutions, and none is kept")]
pub(super) enum Factors {
    Four(LU<f64, Const<4>, Const<4>>),
    Six(LU<f64, Const<6>, Const<6>>),
    Eight(LU<f64, Const<8>, Const<8>>),
    Any(LU<f64, Dyn, Dyn>),
}

impl Factors {
    /// Solves linear equations in place; `None` if the matrix is singular.
    pub fn solve(&self, values: &mut [f64]) -> Option<()> {
        let is_regular = match self {
            Factors::Four(lu) => lu.solve_mut(&mut SVectorViewMut::<f64, 4>::from_slice(values)),
            Factors::Six(lu) => lu.solve_mut(&mut SVectorViewMut::<f64, 6>::from_slice(values)),
            Factors::Eight(lu) => lu.solve_mut(&mut SVectorViewMut::<f64, 8>::from_slice(values)),
            Factors::Any(lu) => lu.solve_mut(&mut DVectorViewMut::from_slice(values, values.len())),
        };
        is_regular.then_some(())
    }
}

/// The derivatives without the column of one unknown, or of the input.
fn square<const N: usize>(at: &Linearization, held: usize) -> SMatrix<f64, N, N> {
    SMatrix::from_fn(|row, k| at.jacobian[row * (N + 1) + k + usize::from(k >= held)])
}

impl Equations {
    /// The state on the curve next to another, with one unknown, or the input, as it is there; `None` if Newton's
    /// method finds none.
    pub fn corrected(&self, mut state: Vec<f64>, held: usize) -> Option<Vec<f64>> {
        let mut last = f64::INFINITY;
        let mut at = Linearization::default();
        let mut correction = Vec::with_capacity(state.len());
        for _ in 0..MAX_CORRECTIONS {
            self.linearized(&state, &mut at);
            correction.clone_from(&at.residuals);
            self.factors(&at, held).solve(&mut correction)?;
            if correction.iter().any(|change| !change.is_finite()) {
                return None;
            }
            let change = correction.iter().fold(0.0, |most: f64, change| most.max(change.abs()));
            // Next to a limit rounding is magnified: corrections that were small and grow are that.
            if change >= last && last < MAGNIFIED_ROUNDING {
                return Some(state);
            }
            let others = (0..state.len()).filter(|k| *k != held);
            others.zip(correction.iter()).for_each(|(k, change)| state[k] -= change);
            if change <= ROUNDING * (1.0 + state.iter().fold(0.0, |most: f64, x| most.max(x.abs()))) {
                return Some(state);
            }
            last = change;
        }
        (last < MAGNIFIED_ROUNDING).then_some(state)
    }

    /// The factors of the derivatives without the column of one unknown, or of the input: without allocations for the usual numbers of unknowns.
    pub fn factors(&self, at: &Linearization, held: usize) -> Factors {
        match self.unknown_count() {
            4 => Factors::Four(square::<4>(at, held).lu()),
            6 => Factors::Six(square::<6>(at, held).lu()),
            8 => Factors::Eight(square::<8>(at, held).lu()),
            _ => Factors::Any(self.matrix_without(&at.jacobian, held).lu()),
        }
    }

    /// The node at a state on the curve; `None` where the curve is not regular. Its direction is the one from which the
    /// determinant of the derivatives and the direction is positive.
    pub fn node(&self, state: Vec<f64>) -> Option<Node> {
        let n = self.unknown_count();
        let jacobian = self.jacobian(&state);
        let held = self.least_dependent_column(&jacobian)?;
        let whole = self.matrix_without(&jacobian, held).lu();
        let column = DVector::from_iterator(n, (0..n).map(|row| -jacobian[row * (n + 1) + held]));
        let rates = whole.solve(&column)?;
        let mut tangent: Vec<f64> = rates.iter().copied().collect();
        tangent.insert(held, 1.0);
        // The determinant of the derivatives with this direction as the last row, developed by it.
        let sign = if (n - held).is_multiple_of(2) { 1.0 } else { -1.0 } * whole.determinant().signum();
        let norm = tangent.iter().map(|rate| rate * rate).sum::<f64>().sqrt() * sign;
        if !norm.is_finite() {
            return None;
        }
        tangent.iter_mut().for_each(|rate| *rate /= norm);
        Some(Node { state, tangent, is_change: false })
    }

    /// The sign of the determinant of the derivatives and a direction, which changes where two parts of the curve cross.
    pub fn orientation(&self, state: &[f64], tangent: &[f64]) -> f64 {
        let n = self.unknown_count();
        let jacobian = self.jacobian(state);
        let entry = |row: usize, k: usize| if row < n { jacobian[row * (n + 1) + k] } else { tangent[k] };
        DMatrix::from_fn(n + 1, n + 1, entry).lu().determinant().signum()
    }

    /// The column without which the derivatives are the best conditioned: the last that elimination with complete
    /// pivoting leaves.
    fn least_dependent_column(&self, jacobian: &[f64]) -> Option<usize> {
        let n = self.unknown_count();
        let matrix = DMatrix::from_row_slice(n, n + 1, jacobian);
        let lu = matrix.full_piv_lu();
        let u = lu.u();
        let is_regular = (0..n).all(|k| u[(k, k)].abs() > f64::EPSILON * u[(0, 0)].abs());
        let mut columns = DMatrix::from_fn(1, n + 1, |_, column| column as f64);
        // The columns of the matrix in the order of the pivots.
        lu.q().permute_columns(&mut columns);
        is_regular.then(|| columns[(0, n)] as usize)
    }

    /// Proves that the curve goes on from a node along its tangent for a length, within a tube in which there is no
    /// other part of a curve; `None` if it is too long for that.
    ///
    /// # Source
    /// Krawczyk's operator, with one coordinate as the parameter: for each value of it the operator maps the others'
    /// box into its interior, so that there is one solution in the box.
    pub fn tube(&self, node: &Node, length: f64) -> Option<Tube> {
        let n = self.unknown_count();
        let parameter = node.parameter();
        let point: Vec<Enclosure> = node.state.iter().map(|x| Enclosure::from(*x)).collect();
        let direction: Vec<Enclosure> = node.tangent.iter().map(|x| Enclosure::from(*x)).collect();
        let along = Enclosure { low: 0.0, high: length };
        let line: Vec<Enclosure> = point.iter().zip(&direction).map(|(at, rate)| *at + *rate * along).collect();
        let middle = self.jacobian(&node.ahead(length / 2.0));
        let inverse = self.matrix_without(&middle, parameter).try_inverse()?;
        let preconditioned = |values: &dyn Fn(usize) -> Enclosure| -> Vec<Enclosure> {
            let row = |j: usize| {
                (0..n).fold(Enclosure::from(0.0), |sum, i| sum + Enclosure::from(inverse[(j, i)]) * values(i))
            };
            (0..n).map(row).collect()
        };
        // How far the tangent misses the curve: by Taylor's theorem, the remainder over all of it.
        let start: Vec<Series<Enclosure, 3>> = self.along_line(&point, &direction);
        let rest: Vec<Series<Enclosure, 3>> = self.along_line(&line, &direction);
        let miss = preconditioned(&|i| start[i].0[0] + along * (start[i].0[1] + along * rest[i].0[2]));
        let miss: Vec<f64> = miss.into_iter().map(Enclosure::magnitude).collect();
        let column = |k: usize| k + usize::from(k >= parameter);
        let mut radii = widened(&miss, 2.0);
        for _ in 0..MAX_INFLATIONS {
            let mut tube = line.clone();
            (0..n).for_each(|k| tube[column(k)] = tube[column(k)] + Enclosure { low: -radii[k], high: radii[k] });
            let jacobian = self.jacobian(&tube);
            // The difference of the identity and the preconditioned derivatives, in magnitude.
            let mut difference = DMatrix::zeros(n, n);
            for j in 0..n {
                for k in 0..n {
                    let product = (0..n).fold(Enclosure::from(0.0), |sum, i| {
                        sum + Enclosure::from(inverse[(j, i)]) * jacobian[i * (n + 1) + column(k)]
                    });
                    difference[(j, k)] = (Enclosure::from(if j == k { 1.0 } else { 0.0 }) - product).magnitude();
                }
            }
            // Sums of magnitudes are rounded: an ulp for each term.
            let rounded = |sum: f64| sum * (1.0 + n as f64 * f64::EPSILON);
            let spread = |of: &[f64], j: usize| rounded((0..n).map(|k| difference[(j, k)] * of[k]).sum());
            let contraction = (0..n).map(|j| spread(&radii, j) / radii[j]).fold(0.0, f64::max);
            let image: Vec<f64> = (0..n).map(|j| (miss[j] + spread(&radii, j)).next_up()).collect();
            if !image.iter().all(|own| *own <= FARTHEST_FROM_TANGENT) {
                return None;
            }
            if contraction >= 1.0 || image.iter().zip(&radii).any(|(image, radius)| image >= radius) {
                radii = widened(&image, 1.5);
                continue;
            }
            // The solution of linear equations whose matrix is the derivatives in the tube.
            let solved = |values: Vec<Enclosure>| -> Vec<Enclosure> {
                let known: Vec<f64> = values.iter().map(|value| value.magnitude()).collect();
                let most = known.iter().zip(&radii).map(|(value, radius)| value / radius).fold(0.0, f64::max);
                let mut bounds: Vec<f64> =
                    radii.iter().map(|radius| (most * radius / (1.0 - contraction)).next_up()).collect();
                for _ in 0..2 {
                    bounds = (0..n).map(|j| (known[j] + spread(&bounds, j)).next_up().min(bounds[j])).collect();
                }
                let around = |j: usize| Enclosure { low: -spread(&bounds, j), high: spread(&bounds, j) };
                values.into_iter().enumerate().map(|(j, value)| -value + around(j)).collect()
            };
            let with_parameter = |mut others: Vec<Enclosure>| {
                others.insert(parameter, Enclosure::from(0.0));
                others
            };
            let drift =
                |i: usize| (0..=n).fold(Enclosure::from(0.0), |sum, k| sum + jacobian[i * (n + 1) + k] * direction[k]);
            let first = with_parameter(solved(preconditioned(&drift)));
            let mut rates: Vec<Enclosure> = first.iter().zip(&direction).map(|(own, rate)| *own + *rate).collect();
            let mut second = Vec::new();
            for _ in 0..2 {
                let curved: Vec<Series<Enclosure, 3>> = self.along_line(&tube, &rates);
                second = with_parameter(solved(preconditioned(&|i| curved[i].0[2] + curved[i].0[2])));
                // The rates change from those of the tangent by their own rates.
                let changed = |k: usize| rates[k].intersection(direction[k] + along * second[k]);
                rates = (0..=n).map(changed).collect();
            }
            radii.insert(parameter, 0.0);
            return Some(Tube { parameter, length, radii, contraction, input_rates: [rates[n], second[n]] });
        }
        None
    }
}

/// The radii of a tube for how far its axis misses the curve, so many times greater. None is much smaller than the others: bounds are
/// relative to them.
fn widened(miss: &[f64], factor: f64) -> Vec<f64> {
    /// Rounding of states, so that a node next to the tube's axis is in it.
    const LEAST_RADIUS: f64 = 1e-13;
    let greatest = miss.iter().fold(0.0, |most: f64, own| most.max(*own));
    miss.iter().map(|own| factor * own.max(greatest / 100.0) + LEAST_RADIUS).collect()
}

impl Tube {
    /// Where a state is along the tube of a node; `None` if it is not in it.
    pub fn position_of(&self, node: &Node, state: &[f64]) -> Option<f64> {
        let along = (state[self.parameter] - node.state[self.parameter]) / node.tangent[self.parameter];
        let axis = node.ahead(along);
        let is_inside = axis
            .iter()
            .zip(state)
            .zip(&self.radii)
            .enumerate()
            .all(|(k, ((axis, at), radius))| k == self.parameter || (axis - at).abs() <= *radius);
        let rounding = ROUNDING * (1.0 + state[self.parameter].abs()) / node.tangent[self.parameter].abs();
        (is_inside && (-rounding..=self.length + rounding).contains(&along)).then_some(along)
    }
}
