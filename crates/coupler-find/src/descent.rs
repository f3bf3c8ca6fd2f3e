//! The steps of Levenberg and Marquardt's method, whatever is moved towards a target.

use nalgebra::allocator::Allocator;
use nalgebra::{Cholesky, DefaultAllocator, Dim, OMatrix, OVector};

/// The normal equations of a motion that is to make the sum of the squares of some distances least.
pub(crate) struct Equations<D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// The lower triangle of the matrix; the other one follows it in [`Descent::step`].
    normal: OMatrix<f64, D, D>,
    gradient: OVector<f64, D>,
}

impl<D: Dim> Equations<D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Those of no distances, for a number of unknowns.
    pub fn new(unknowns: D) -> Equations<D> {
        Equations {
            normal: OMatrix::zeros_generic(unknowns, unknowns),
            gradient: OVector::zeros_generic(unknowns, nalgebra::Const::<1>),
        }
    }

    /// Adds a distance, with its derivatives by the unknowns, how many times it counts.
    pub fn add(&mut self, row: &[f64], distance: f64, weight: f64) {
        let count = row.len();
        // By columns, as the matrix is stored.
        for (k, column) in self.normal.as_mut_slice().chunks_exact_mut(count).enumerate() {
            let weighted = weight * row[k];
            self.gradient[k] += weighted * distance;
            column[k..].iter_mut().zip(&row[k..]).for_each(|(sum, entry)| *sum += weighted * entry);
        }
    }
}

/// Something that can be moved towards a target.
pub(crate) trait Candidate: Sized
where
    DefaultAllocator: Allocator<Self::Unknowns> + Allocator<Self::Unknowns, Self::Unknowns>,
{
    /// The number of unknowns.
    type Unknowns: Dim;

    /// The target, and what limits the motion.
    type Aim<'a>;

    /// A gain relative to the objective that is no progress.
    const NO_GAIN: f64;

    /// The sum of squares that is to be least, with what limits add to it.
    fn objective(&self) -> f64;

    /// Whether the objective is rounding.
    fn is_exact(&self, _: &Self::Aim<'_>) -> bool {
        false
    }

    /// The equations of the motion; `None` if they are not defined.
    fn equations(&self, aim: &Self::Aim<'_>) -> Option<Equations<Self::Unknowns>>;

    /// The motion within the limits, from that without them and the factors of the matrix.
    fn limited(
        &self,
        _: &Self::Aim<'_>,
        _: &Cholesky<f64, Self::Unknowns>,
        free: OVector<f64, Self::Unknowns>,
    ) -> OVector<f64, Self::Unknowns> {
        free
    }

    /// The candidate after a motion; `None` if that is not possible.
    fn moved(&self, aim: &Self::Aim<'_>, motion: &OVector<f64, Self::Unknowns>) -> Option<Self>;
}

/// How a candidate goes on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Descent {
    damping: f64,
    /// Whether no step improves the candidate.
    pub is_done: bool,
}

impl Default for Descent {
    fn default() -> Descent {
        Descent { damping: 1e-2, is_done: false }
    }
}

impl Descent {
    /// A descent that begins near its end, with steps that are hardly damped.
    pub fn near_the_end() -> Descent {
        Descent { damping: 1e-9, is_done: false }
    }

    /// Takes one step, with as much damping as it needs to lessen the objective.
    pub fn step<C: Candidate>(&mut self, candidate: &mut C, aim: &C::Aim<'_>)
    where
        DefaultAllocator: Allocator<C::Unknowns> + Allocator<C::Unknowns, C::Unknowns>,
    {
        /// The most trials with more and more damping.
        const TRIALS: usize = 8;
        const MAX_DAMPING: f64 = 1e8;
        if self.is_done {
            return;
        }
        self.is_done = true;
        let Some(Equations { mut normal, gradient }) = candidate.equations(aim) else { return };
        normal.fill_upper_triangle_with_lower_triangle();
        // An unknown that moves no point is held by a small part of what holds the others.
        let floor = 1e-9 * normal.trace().max(f64::MIN_POSITIVE);
        for _ in 0..TRIALS {
            let mut damped = normal.clone();
            for k in 0..gradient.len() {
                damped[(k, k)] += self.damping * normal[(k, k)].max(floor);
            }
            if let Some(matrix) = Cholesky::new(damped) {
                let motion = candidate.limited(aim, &matrix, matrix.solve(&gradient));
                if let Some(next) =
                    candidate.moved(aim, &motion).filter(|next| next.objective() < candidate.objective())
                {
                    let promised = 2.0 * gradient.dot(&motion) - motion.dot(&(&normal * &motion));
                    let gain = candidate.objective() - next.objective();
                    self.is_done = gain <= C::NO_GAIN * candidate.objective() || next.is_exact(aim);
                    match gain / promised.max(f64::MIN_POSITIVE) {
                        kept if kept > 0.75 => self.damping = (0.2 * self.damping).max(1e-12),
                        kept if kept < 0.25 => self.damping *= 3.0,
                        _ => {}
                    }
                    *candidate = next;
                    return;
                }
            }
            self.damping *= 6.0;
            if self.damping > MAX_DAMPING {
                return;
            }
        }
    }
}
