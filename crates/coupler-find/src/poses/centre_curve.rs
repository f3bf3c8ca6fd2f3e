//! The centre-point curve of four poses: the pivots of all their dyads.
//!
//! It is a cubic, on which the determinant of the three forms is zero, and passes the poles of all pairs of poses. Each line through a pole meets it in at most two
//! further points, so that the pencil of these lines passes all of it, both parts of one that has two (Bottema and Roth, Theoretical
//! Kinematics, chapter VIII).

use super::body::{Placed, pole};
use super::dyad::{Dyad, Forms};
use crate::complex::{Complex, unit};
use nalgebra::{Matrix3, Vector3};

/// The centre-point curve.
pub(super) struct CentreCurve {
    forms: Forms,
    pole: Complex,
}

/// The coefficients of a determinant below which it is zero: the forms and the vectors have about the size 1.
const ZERO: f64 = 1e-13;

impl CentreCurve {
    /// The curve of four poses; `None` if every point of the plane, or none, is the pivot of a dyad, as of translations.
    pub fn new(placed: &[Placed]) -> Option<CentreCurve> {
        let forms = Some(Forms::new(placed).independent()).filter(|forms| forms.matrices().len() == 3)?;
        let pairs = (0..placed.len()).flat_map(|k| (0..k).map(move |m| (k, m)));
        let poles = pairs.filter_map(|(k, m)| pole([&placed[k], &placed[m]]));
        let pole = poles.min_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()))?;
        let curve = CentreCurve { forms, pole };
        // Some lines of the pencil: the determinant is not zero on all of them.
        let is_curve = (0..7).any(|k| curve.cubic(unit(f64::from(k))).iter().any(|c| c.abs() > ZERO));
        is_curve.then_some(curve)
    }

    /// The dyads whose pivots are on a line through the pole, at an angle in radians: at most two, always in the same order.
    pub fn dyads(&self, angle: f64) -> [Option<Dyad>; 2] {
        let direction = unit(angle);
        let [c, b, a] = {
            let cubic = self.cubic(direction);
            [cubic[1], cubic[2], cubic[3]]
        };
        let square = b * b - 4.0 * a * c;
        if square < 0.0 || square.is_nan() {
            return [None; 2];
        }
        // Without a difference of nearly equal numbers, which would lose digits.
        let sum = -0.5 * (b + square.sqrt().copysign(b));
        let roots = if b >= 0.0 { [(sum, a), (c, sum)] } else { [(c, sum), (sum, a)] };
        roots.map(|(above, below)| self.dyad(direction, above, below))
    }

    /// The slider of the poses, whose pivot is where the curve is at infinity.
    pub fn slider(&self) -> Option<Dyad> {
        let [pivot, pin] = at_infinity(&self.forms)?;
        Dyad::from_homogeneous(&pivot, &pin)
    }

    /// The slot of the poses, whose line is where the curve of the pins, the circle-point curve, is at infinity.
    pub fn slot(&self) -> Option<Dyad> {
        let [pin, pivot] = at_infinity(&self.forms.exchanged())?;
        Dyad::from_homogeneous(&pivot, &pin)
    }

    /// A dyad at `above` / `below` from the pole.
    fn dyad(&self, direction: Complex, above: f64, below: f64) -> Option<Dyad> {
        let at = self.pole * below + direction * above;
        let pivot = Vector3::new(at.re, at.im, below);
        let norm = pivot.norm();
        let pivot = (norm > f64::MIN_POSITIVE && norm.is_finite()).then(|| pivot / norm)?;
        Dyad::from_homogeneous(&pivot, &self.forms.pin(&pivot)?)
    }

    /// The coefficients of the determinant by the distance from the pole in a direction, from that of power 0, which is zero.
    fn cubic(&self, direction: Complex) -> [f64; 4] {
        let base = self.forms.rows(&Vector3::new(self.pole.re, self.pole.im, 1.0));
        let along = self.forms.rows(&Vector3::new(direction.re, direction.im, 0.0));
        let mut coefficients = [0.0; 4];
        for choice in 0..8_usize {
            let row = |k: usize| if choice >> k & 1 == 1 { along[k] } else { base[k] };
            let determinant = Matrix3::from_columns(&[row(0), row(1), row(2)]).determinant();
            coefficients[choice.count_ones() as usize] += determinant;
        }
        coefficients
    }
}

/// Where the determinant of three forms is zero at infinity, and the pin there.
fn at_infinity(forms: &Forms) -> Option<[Vector3<f64>; 2]> {
    let at = |x: f64, y: f64| determinant(forms, &Vector3::new(x, y, 0.0));
    // At infinity the cubic is (x² + y²)(αx + βy).
    let [alpha, beta] = [at(1.0, 0.0), at(0.0, 1.0)];
    let pivot = Vector3::new(beta, -alpha, 0.0);
    let norm = pivot.norm();
    let pivot = (norm > ZERO).then(|| pivot / norm)?;
    Some([pivot, forms.pin(&pivot)?])
}

fn determinant(forms: &Forms, pivot: &Vector3<f64>) -> f64 {
    Matrix3::from_columns(&forms.rows(pivot)).determinant()
}

#[cfg(test)]
mod tests {
    use super::super::body::random::random_poses;
    use super::*;
    use crate::complex::length;

    #[test]
    fn all_dyads_keep_their_lengths_and_those_of_the_four_bar_are_among_them() {
        for seed in 1..=50 {
            let (set, own) = random_poses(4, seed);
            let placed = set.placed();
            let curve = CentreCurve::new(placed).unwrap();
            for k in 0..90 {
                for dyad in curve.dyads(f64::from(k) * 0.035).into_iter().flatten() {
                    // Far pivots and pins have as many digits less.
                    let extent = 1.0 + dyad.pivot().map_or(0.0, length) + dyad.pin().map_or(0.0, length);
                    assert!(dyad.error(placed) < 1e-9 * extent * extent * extent, "{seed}: {dyad:?}");
                }
            }
            for [pivot, pin] in own {
                let along = pivot - curve.pole;
                let found = curve.dyads(coupler_curves::geometry::trig::atan2(along.im, along.re));
                let is_own = |dyad: &Dyad| match dyad {
                    Dyad::Revolute { pivot: g, pin: w } => length(g - pivot) < 1e-7 && length(w - pin) < 1e-6,
                    Dyad::Slider { .. } | Dyad::Slot { .. } => false,
                };
                assert!(found.iter().flatten().any(is_own), "{seed}: {pivot} {pin} among {found:?}");
            }
            for dyad in [curve.slider().unwrap(), curve.slot().unwrap()] {
                let extent = 1.0 + dyad.pivot().or(dyad.pin()).map_or(0.0, length);
                assert!(dyad.error(placed) < 1e-9 * extent, "{seed}: {dyad:?}");
            }
        }
    }

    #[test]
    fn the_poles_are_on_the_curve() {
        let (set, _) = random_poses(4, 11);
        let placed = set.placed();
        let curve = CentreCurve::new(placed).unwrap();
        for k in 0..4 {
            for m in 0..k {
                let pole = pole([&placed[k], &placed[m]]).unwrap();
                let determinant = determinant(&curve.forms, &Vector3::new(pole.re, pole.im, 1.0).normalize());
                assert!(determinant.abs() < 1e-13, "{k} {m}: {determinant}");
            }
        }
    }
}
