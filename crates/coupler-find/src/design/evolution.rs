//! An evolution strategy that adapts its matrix (MA-ES; Beyer and Sendhoff, "Simplify your covariance matrix adaptation evolution strategy",
//! IEEE Trans. Evol. Comput. 21, 2017), the covariance matrix adaptation of Hansen and Ostermeier without covariances.

use coupler_curves::geometry::trig;
use nalgebra::{DMatrix, DVector};

use crate::scatter::Scatter;

/// The state of a strategy that makes a function least.
#[derive(Clone, Debug)]
pub(super) struct Evolution {
    mean: DVector<f64>,
    /// The standard deviation of the places, as the matrix scales it.
    step: f64,
    matrix: DMatrix<f64>,
    path: DVector<f64>,
    scatter: Scatter,
    rates: Rates,
}

/// The numbers of a strategy, which depend on the dimension only; the names are those of the paper.
#[derive(Clone, Debug)]
struct Rates {
    population: usize,
    /// The weights of the best, which sum to 1.
    weights: Vec<f64>,
    mu_eff: f64,
    c_s: f64,
    c_1: f64,
    c_w: f64,
    d_s: f64,
    /// The mean length of a vector of normal numbers.
    mean_length: f64,
}

/// The places of a generation, and the normal numbers and directions that they are made of.
pub(super) struct Generation {
    normals: Vec<DVector<f64>>,
    directions: Vec<DVector<f64>>,
    pub places: Vec<Vec<f64>>,
}

impl Rates {
    fn new(dimension: usize) -> Rates {
        let n = dimension as f64;
        let population = 4 + (3.0 * trig::ln(n)).floor() as usize;
        let parents = population / 2;
        let raw: Vec<f64> = (1..=parents).map(|k| trig::ln(parents as f64 + 0.5) - trig::ln(k as f64)).collect();
        let sum: f64 = raw.iter().sum();
        let weights: Vec<f64> = raw.iter().map(|weight| weight / sum).collect();
        let mu_eff = 1.0 / weights.iter().map(|weight| weight * weight).sum::<f64>();
        let c_s = (mu_eff + 2.0) / (mu_eff + n + 5.0);
        let c_1 = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff);
        let c_w = (1.0 - c_1).min(2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / ((n + 2.0) * (n + 2.0) + mu_eff));
        let d_s = 1.0 + c_s + 2.0 * (((mu_eff - 1.0) / (n + 1.0)).max(0.0).sqrt() - 1.0).max(0.0);
        let mean_length = n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
        Rates { population, weights, mu_eff, c_s, c_1, c_w, d_s, mean_length }
    }
}

impl Evolution {
    /// A strategy from a place, with a standard deviation and a seed.
    pub fn new(place: &[f64], step: f64, seed: u64) -> Evolution {
        let dimension = place.len();
        Evolution {
            mean: DVector::from_column_slice(place),
            step,
            matrix: DMatrix::identity(dimension, dimension),
            path: DVector::zeros(dimension),
            scatter: Scatter::new(seed),
            rates: Rates::new(dimension),
        }
    }

    /// The middle of the places to come.
    pub fn mean(&self) -> &[f64] {
        self.mean.as_slice()
    }

    /// About how far the places to come are from the middle.
    pub fn spread(&self) -> f64 {
        self.step * self.matrix.norm() / (self.mean.len() as f64).sqrt()
    }

    /// The places of the next generation.
    pub fn generation(&mut self) -> Generation {
        let dimension = self.mean.len();
        let mut generation = Generation { normals: Vec::new(), directions: Vec::new(), places: Vec::new() };
        for _ in 0..self.rates.population {
            let normal = DVector::from_fn(dimension, |_, _| self.scatter.normal(1.0));
            let direction = &self.matrix * &normal;
            generation.places.push((&self.mean + self.step * &direction).as_slice().to_vec());
            generation.normals.push(normal);
            generation.directions.push(direction);
        }
        generation
    }

    /// Goes on from a generation with the values at its places; one that is not a number is the greatest.
    pub fn advance(&mut self, generation: &Generation, values: &[f64]) {
        /// The greatest change of the step in a generation, as a logarithm.
        const MOST: f64 = 1.0;
        let Rates { weights, mu_eff, c_s, c_1, c_w, d_s, mean_length, .. } = &self.rates;
        let known = |k: usize| if values[k].is_nan() { f64::INFINITY } else { values[k] };
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&a, &b| known(a).total_cmp(&known(b)));
        let best = || order.iter().zip(weights).map(|(&k, &weight)| (k, weight));
        let dimension = self.mean.len();
        let mut normal = DVector::zeros(dimension);
        let mut direction = DVector::zeros(dimension);
        let mut spread = DMatrix::zeros(dimension, dimension);
        for (k, weight) in best() {
            normal += weight * &generation.normals[k];
            direction += weight * &generation.directions[k];
            spread += weight * &generation.directions[k] * generation.normals[k].transpose();
        }
        self.mean += self.step * direction;
        self.path = (1.0 - c_s) * &self.path + (mu_eff * c_s * (2.0 - c_s)).sqrt() * normal;
        let along = &self.matrix * &self.path * self.path.transpose();
        self.matrix = (1.0 - 0.5 * (c_1 + c_w)) * &self.matrix + 0.5 * *c_1 * along + 0.5 * *c_w * spread;
        let change = c_s / d_s * (self.path.norm() / mean_length - 1.0);
        self.step *= trig::exp(change.clamp(-MOST, MOST));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least value that is found of a function from a place, with a number of generations.
    fn least(place: &[f64], generations: usize, f: impl Fn(&[f64]) -> f64) -> f64 {
        let mut evolution = Evolution::new(place, 0.3, 1);
        for _ in 0..generations {
            let generation = evolution.generation();
            let values: Vec<f64> = generation.places.iter().map(|place| f(place)).collect();
            evolution.advance(&generation, &values);
        }
        f(evolution.mean())
    }

    #[test]
    fn smooth_and_sharp_functions_are_made_least() {
        let ellipsoid = |x: &[f64]| (0..).zip(x).map(|(k, x)| trig::pow(100.0, f64::from(k)) * x * x).sum::<f64>();
        assert!(least(&[1.0, -2.0, 0.5, 1.5], 400, ellipsoid) < 1e-12);
        let square = |x: f64| x * x;
        let rosenbrock = |x: &[f64]| 100.0 * square(x[1] - x[0] * x[0]) + square(1.0 - x[0]);
        assert!(least(&[-1.2, 1.0], 500, rosenbrock) < 1e-12);
        // The least of a greatest is at a kink.
        let kink = |x: &[f64]| (x[0] + x[1] - 1.0).abs().max((x[0] - x[1]).abs()).max((0.5 - x[2]).abs());
        assert!(least(&[2.0, 0.0, -1.0], 400, kink) < 1e-8);
    }

    #[test]
    fn what_is_not_a_number_is_avoided() {
        let bounded = |x: &[f64]| if x[0] < 0.0 { f64::NAN } else { x[0] + x[1] * x[1] };
        let found = least(&[1.0, 1.0], 300, bounded);
        assert!(found.is_nan() || found < 1e-6, "{found}");
    }
}
