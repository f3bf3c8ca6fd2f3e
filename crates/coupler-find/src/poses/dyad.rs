//! Dyads that guide a body through poses: a pin of the body at a constant distance from a pivot, or on a straight line, or a line of the body
//! at a constant distance from a pivot.
//!
//! With the pin W in the first pose, in pose k at W_k = a_k W + d_k, and the pivot G, the distances are equal if
//! |d|²/2 + (conj(a) d) · W - G · d - G · ((a - 1) W) = 0 for each further pose (McCarthy and Soh, Geometric Design of Linkages, chapter 5): a form that is
//! linear in G and in W. In homogeneous coordinates a pivot at infinity is the normal of a line on which the pin moves, and a pin at infinity that of
//! a line of the body which slides through a block that turns about the pivot: the same with the body and the frame exchanged.

use super::body::Placed;
use crate::complex::{Complex, length};
use nalgebra::{Matrix3, Vector3};

/// What guides a pin of the body, in sizes of the poses from their middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Dyad {
    /// A link that turns about a pivot.
    Revolute {
        /// The pivot.
        pivot: Complex,
        /// The pin in the first pose.
        pin: Complex,
    },
    /// A slider on a line.
    Slider {
        /// The normal of the line, of length 1.
        normal: Complex,
        /// The pin in the first pose.
        pin: Complex,
    },
    /// A straight slot of the body, or a bar, that slides on a block which turns about a pivot.
    Slot {
        /// The pivot.
        pivot: Complex,
        /// The normal of the slot's line in the first pose, of length 1.
        normal: Complex,
    },
}

/// The equations of the poses after the first one.
#[derive(Clone, Debug)]
pub(crate) struct Forms(Vec<Matrix3<f64>>);

/// A homogeneous coordinate below which a point is at infinity, in units of the others.
const AT_INFINITY: f64 = 1e-8;

impl Forms {
    /// The equations of some poses, each divided by its size.
    pub fn new(placed: &[Placed]) -> Forms {
        let first = &placed[0];
        let form = |pose: &Placed| {
            let a = pose.direction * first.direction.conj();
            // 1 - cos of a small angle, with all digits of its sine.
            let versine = if a.re > 0.0 { a.im * a.im / (1.0 + a.re) } else { 1.0 - a.re };
            let d = pose.point - first.point + first.point * Complex::new(versine, -a.im);
            let l = a.conj() * d;
            let form = Matrix3::new(versine, a.im, -d.re, -a.im, versine, -d.im, l.re, l.im, 0.5 * d.norm_sqr());
            form / form.norm().max(f64::MIN_POSITIVE)
        };
        Forms(placed.iter().skip(1).map(form).collect())
    }

    /// Combinations of the forms that are perpendicular to each other, as many as are independent: those of poses near each other differ little, and
    /// would lose the digits in which they do.
    pub fn independent(&self) -> Forms {
        /// The part of a form that is left by the others, if it is rounding.
        const DEPENDENT: f64 = 3e-13;
        let mut rest = self.0.clone();
        let mut found: Vec<Matrix3<f64>> = Vec::new();
        while let Some(next) = (0..rest.len()).max_by(|a, b| rest[*a].norm().total_cmp(&rest[*b].norm())) {
            let mut form = rest.swap_remove(next);
            // Once more, for what rounding has left.
            for other in &found {
                form -= other * other.dot(&form);
            }
            let norm = form.norm();
            if norm <= DEPENDENT || norm.is_nan() {
                break;
            }
            form /= norm;
            for other in &mut rest {
                *other -= form * form.dot(other);
            }
            found.push(form);
        }
        Forms(found)
    }

    /// The same with the pivot in place of the pin, and the pin in place of the pivot.
    pub fn exchanged(&self) -> Forms {
        Forms(self.0.iter().map(Matrix3::transpose).collect())
    }

    /// The forms as matrices, the pivot on their left.
    pub fn matrices(&self) -> &[Matrix3<f64>] {
        &self.0
    }

    /// The equations of the pin for a pivot.
    pub fn rows(&self, pivot: &Vector3<f64>) -> Vec<Vector3<f64>> {
        self.0.iter().map(|form| form.tr_mul(pivot)).collect()
    }

    /// The greatest of the forms for a pivot and a pin of length 1.
    pub fn residual(&self, pivot: &Vector3<f64>, pin: &Vector3<f64>) -> f64 {
        self.0.iter().map(|form| pivot.dot(&(form * pin)).abs()).fold(0.0, f64::max)
    }

    /// The pin that the equations of two or three further poses leave for a pivot; `None` if they leave several.
    pub fn pin(&self, pivot: &Vector3<f64>) -> Option<Vector3<f64>> {
        /// Rows whose product is smaller are parallel, but for rounding.
        const PARALLEL: f64 = 1e-12;
        let rows = self.rows(pivot);
        let pairs = (0..rows.len()).flat_map(|k| (0..k).map(move |m| (k, m)));
        let products = pairs.map(|(k, m)| rows[k].cross(&rows[m]));
        let best = products.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
        let norm = best.norm();
        (norm > PARALLEL * pivot.norm_squared()).then(|| best / norm)
    }
}

impl Dyad {
    /// The dyad of a pivot and a pin in homogeneous coordinates; `None` if both are at infinity, or at one place.
    pub fn from_homogeneous(pivot: &Vector3<f64>, pin: &Vector3<f64>) -> Option<Dyad> {
        /// A link shorter than this, in sizes of the poses, is none: the pole of two poses satisfies the equations of both.
        const SHORTEST: f64 = 1e-6;
        let place = |v: Vector3<f64>| (v.z.abs() > AT_INFINITY).then(|| Complex::new(v.x / v.z, v.y / v.z));
        let direction = |v: Vector3<f64>| {
            let direction = Complex::new(v.x, v.y);
            direction / length(direction)
        };
        let [g, w] = [pivot.normalize(), pin.normalize()];
        match (place(g), place(w)) {
            (Some(pivot), Some(pin)) => (length(pin - pivot) > SHORTEST).then_some(Dyad::Revolute { pivot, pin }),
            (None, Some(pin)) => Some(Dyad::Slider { normal: direction(g), pin }),
            (Some(pivot), None) => Some(Dyad::Slot { pivot, normal: direction(w) }),
            (None, None) => None,
        }
    }

    /// The pivot and the pin in homogeneous coordinates, of length 1.
    pub fn homogeneous(&self) -> [Vector3<f64>; 2] {
        let place = |z: Complex| Vector3::new(z.re, z.im, 1.0).normalize();
        let direction = |z: Complex| Vector3::new(z.re, z.im, 0.0);
        match *self {
            Dyad::Revolute { pivot, pin } => [place(pivot), place(pin)],
            Dyad::Slider { normal, pin } => [direction(normal), place(pin)],
            Dyad::Slot { pivot, normal } => [place(pivot), direction(normal)],
        }
    }

    /// The fixed pivot; `None` of a slider.
    pub fn pivot(&self) -> Option<Complex> {
        match *self {
            Dyad::Revolute { pivot, .. } | Dyad::Slot { pivot, .. } => Some(pivot),
            Dyad::Slider { .. } => None,
        }
    }

    /// The pin in the first pose; `None` of a slot.
    pub fn pin(&self) -> Option<Complex> {
        match *self {
            Dyad::Revolute { pin, .. } | Dyad::Slider { pin, .. } => Some(pin),
            Dyad::Slot { .. } => None,
        }
    }

    /// Where the pin is in some poses; of a slot, the normals of its line.
    pub fn pins(&self, placed: &[Placed]) -> Vec<Complex> {
        let first = &placed[0];
        match *self {
            Dyad::Revolute { pin, .. } | Dyad::Slider { pin, .. } => {
                let of_body = first.of_body(pin);
                placed.iter().map(|pose| pose.apply(of_body)).collect()
            }
            Dyad::Slot { normal, .. } => {
                placed.iter().map(|pose| normal * pose.direction * first.direction.conj()).collect()
            }
        }
    }

    #[cfg(test)]
    /// The greatest difference of the pin's distance from its pivot or line, or of the pivot's from the slot, from that in the first pose.
    pub fn error(&self, placed: &[Placed]) -> f64 {
        let distance = |(pin, pose): (&Complex, &Placed)| match self {
            Dyad::Revolute { pivot, .. } => length(pin - pivot),
            Dyad::Slider { normal, .. } => (pin * normal.conj()).re,
            Dyad::Slot { pivot, .. } => ((pivot - pose.point) * pin.conj()).re,
        };
        let pins = self.pins(placed);
        let distances: Vec<f64> = pins.iter().zip(placed).map(distance).collect();
        distances.iter().map(|other| (other - distances[0]).abs()).fold(0.0, f64::max)
    }
}
