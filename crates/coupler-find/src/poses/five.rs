//! The dyads of five poses: the real roots of Burmester's quartic.
//!
//! The four forms are linear in the pivot and in the pin, both in the projective plane, and have six common zeros: the two pairs of
//! isotropic directions, and the four dyads. Multiplied by the monomials of the pivot of degree 2 they are 24 equations in the 30
//! products of the pin and the monomials of degree 3, whose null space is spanned by the zeros; multiplication with coordinates of the
//! pivot is a matrix of order 6 on it, of which the zeros are the eigenvectors (Cox, Little, O'Shea, Using Algebraic Geometry, §2.4).
//! All zeros are found, at infinity and multiple ones, too.

use super::dyad::{Dyad, Forms};
use nalgebra::{DMatrix, DVector, Matrix6, Schur, Vector3, Vector6};

/// The number of zeros with their multiplicities.
const ZEROS: usize = 6;

/// The products of coordinates of a degree, as exponents.
fn monomials(degree: usize) -> Vec<[usize; 3]> {
    let first = |x: usize| (0..=degree - x).map(move |y| [x, y, degree - x - y]);
    (0..=degree).flat_map(first).collect()
}

/// The place of a monomial among those of its degree.
fn place(monomial: [usize; 3], all: &[[usize; 3]]) -> usize {
    all.iter().position(|other| *other == monomial).unwrap_or(0)
}

fn times(mut monomial: [usize; 3], coordinate: usize) -> [usize; 3] {
    monomial[coordinate] += 1;
    monomial
}

/// The null space of the multiplied forms; `None` if it is greater than that of single zeros: then there are infinitely many dyads, or the
/// equations of two poses are the same.
fn null_space(forms: &Forms) -> Option<DMatrix<f64>> {
    /// Singular values below this part of the greatest are zero: rounding is some 1e-15 of it.
    const ZERO: f64 = 1e-12;
    const ROUNDS: usize = 500;
    let [quadratic, cubic] = [2, 3].map(monomials);
    let count = 3 * cubic.len();
    // With rows of zeros the factors have the whole space.
    let mut equations = DMatrix::zeros(count, count);
    for (k, form) in forms.matrices().iter().enumerate() {
        for (m, monomial) in quadratic.iter().enumerate() {
            for pivot in 0..3 {
                let column = place(times(*monomial, pivot), &cubic);
                for pin in 0..3 {
                    equations[(k * quadratic.len() + m, pin * cubic.len() + column)] += form[(pivot, pin)];
                }
            }
        }
    }
    let factors = equations.try_svd(false, true, f64::EPSILON, ROUNDS)?;
    let rows = factors.v_t?;
    let mut order: Vec<usize> = (0..count).collect();
    let values: Vec<f64> = factors.singular_values.iter().copied().collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]).then(a.cmp(b)));
    let [least, greatest] = [order[ZEROS], order[count - 1]].map(|k| values[k]);
    let columns: Vec<DVector<f64>> = order[..ZEROS].iter().map(|k| rows.row(*k).transpose()).collect();
    (least > ZERO * greatest).then(|| DMatrix::from_columns(&columns))
}

/// The multiplication with each coordinate of the pivot, from the null space to the products of degree 2.
fn shifts(null: &DMatrix<f64>) -> [DMatrix<f64>; 3] {
    let [quadratic, cubic] = [2, 3].map(monomials);
    [0, 1, 2].map(|coordinate| {
        let row = |k: usize| {
            let (pin, monomial) = (k / quadratic.len(), quadratic[k % quadratic.len()]);
            pin * cubic.len() + place(times(monomial, coordinate), &cubic)
        };
        DMatrix::from_fn(3 * quadratic.len(), ZEROS, |k, column| null[(row(k), column)])
    })
}

/// All real dyads of five poses, sliders and slots among them, from their independent forms; `None` if there are infinitely many, as of translations.
pub(super) fn dyads(forms: &Forms) -> Option<Vec<Dyad>> {
    if forms.matrices().len() != 4 {
        return None;
    }
    Some(zeros(forms)?.iter().filter_map(|[pivot, pin]| Dyad::from_homogeneous(pivot, pin)).collect())
}

/// The real zeros, pivot and pin of length 1.
fn zeros(forms: &Forms) -> Option<Vec<[Vector3<f64>; 2]>> {
    /// Two numbers of no meaning, with which no zero is at infinity and different zeros have different values.
    const FORMS: [[f64; 3]; 2] = [[0.2718, 0.5772, 0.7701], [0.8346, -0.4669, 0.2915]];
    /// Zeros nearer to each other are one: a double zero has half of the digits.
    const SAME: f64 = 1e-6;
    /// A double zero is divided by rounding into two, of which the imaginary parts are the root of it; what is no zero is not kept.
    const IMAGINARY: f64 = 1e-3;
    const ROUNDS: usize = 500;
    let null = null_space(forms)?;
    let shifts = shifts(&null);
    let [lower, upper] = FORMS.map(|form| &shifts[0] * form[0] + &shifts[1] * form[1] + &shifts[2] * form[2]);
    let matrix = lower.clone().try_svd(true, true, f64::EPSILON, ROUNDS)?.solve(&upper, f64::EPSILON).ok()?;
    let matrix = Matrix6::from_iterator(matrix.iter().copied());
    let values = Schur::try_new(matrix, f64::EPSILON, ROUNDS)?.complex_eigenvalues();
    let mut found: Vec<[Vector3<f64>; 2]> = Vec::new();
    let mut real: Vec<f64> =
        values.iter().filter(|z| z.im.abs() <= IMAGINARY * (1.0 + z.re.abs())).map(|z| z.re).collect();
    real.sort_by(f64::total_cmp);
    for value in real {
        let Some(zero) = zero_of(&matrix, value, &null, &shifts, &lower).and_then(|zero| refined(forms, zero)) else {
            continue;
        };
        let is_same = |other: &[Vector3<f64>; 2]| {
            (0..2).all(|k| (zero[k] - other[k]).norm().min((zero[k] + other[k]).norm()) <= SAME)
        };
        if !found.iter().any(is_same) {
            found.push(zero);
        }
    }
    Some(found)
}

/// The pivot and the pin of an eigenvalue.
fn zero_of(
    matrix: &Matrix6<f64>,
    value: f64,
    null: &DMatrix<f64>,
    shifts: &[DMatrix<f64>; 3],
    lower: &DMatrix<f64>,
) -> Option<[Vector3<f64>; 2]> {
    const ROUNDS: usize = 500;
    let factors = (matrix - Matrix6::identity() * value).try_svd(false, true, f64::EPSILON, ROUNDS)?;
    let vector: Vector6<f64> = factors.v_t?.row(factors.singular_values.imin()).transpose();
    let vector = DVector::from_column_slice(vector.as_slice());
    let base = lower * &vector;
    let pivot = Vector3::from_fn(|k, _| base.dot(&(&shifts[k] * &vector)));
    let norm = pivot.norm();
    if norm <= f64::MIN_POSITIVE || !norm.is_finite() {
        return None;
    }
    let pivot = pivot / norm;
    let products = null * &vector;
    let cubic = monomials(3);
    let of_pivot = |[x, y, z]: [usize; 3]| {
        let power = |value: f64, times: usize| std::iter::repeat_n(value, times).product::<f64>();
        power(pivot.x, x) * power(pivot.y, y) * power(pivot.z, z)
    };
    let pin = Vector3::from_fn(|k, _| {
        cubic.iter().enumerate().map(|(m, monomial)| products[k * cubic.len() + m] * of_pivot(*monomial)).sum::<f64>()
    });
    let norm = pin.norm();
    (norm > f64::MIN_POSITIVE && norm.is_finite()).then(|| [pivot, pin / norm])
}

/// A zero after Newton's method; `None` if it is none.
fn refined(forms: &Forms, [mut pivot, mut pin]: [Vector3<f64>; 2]) -> Option<[Vector3<f64>; 2]> {
    /// A double zero gains a binary digit a round.
    const ROUNDS: usize = 60;
    /// The forms and the vectors have the size 1: this is rounding.
    const IS_ZERO: f64 = 1e-13;
    /// What is left at a double zero, which rounding may have made complex.
    const MOST: f64 = 1e-11;
    for _ in 0..ROUNDS {
        if forms.residual(&pivot, &pin) <= IS_ZERO * 1e-2 {
            break;
        }
        let mut equations = Matrix6::zeros();
        let mut values = Vector6::zeros();
        for (k, form) in forms.matrices().iter().enumerate() {
            equations.fixed_view_mut::<1, 3>(k, 0).copy_from(&(form * pin).transpose());
            equations.fixed_view_mut::<1, 3>(k, 3).copy_from(&form.tr_mul(&pivot).transpose());
            values[k] = -pivot.dot(&(form * pin));
        }
        equations.fixed_view_mut::<1, 3>(4, 0).copy_from(&pivot.transpose());
        equations.fixed_view_mut::<1, 3>(5, 3).copy_from(&pin.transpose());
        let Some(step) = equations.lu().solve(&values).filter(|step| step.iter().all(|x| x.is_finite())) else { break };
        let next = [pivot + step.fixed_rows::<3>(0), pin + step.fixed_rows::<3>(3)].map(|v| v.normalize());
        if forms.residual(&next[0], &next[1]) >= forms.residual(&pivot, &pin) {
            break;
        }
        [pivot, pin] = next;
    }
    (forms.residual(&pivot, &pin) <= MOST).then_some([pivot, pin])
}

#[cfg(test)]
mod tests {
    use super::super::body::random::random_poses;
    use super::super::body::{BodyPose, PoseSet};
    use super::*;
    use crate::complex::{Complex, length};
    use coupler_curves::geometry::{Point, trig};

    fn dyads_of(set: &PoseSet) -> Vec<Dyad> {
        dyads(&Forms::new(set.placed()).independent()).expect("there are finitely many")
    }

    fn has(found: &[Dyad], [pivot, pin]: [Complex; 2], accuracy: f64) -> bool {
        found.iter().any(|dyad| match dyad {
            Dyad::Revolute { pivot: g, pin: w } => {
                length(g - pivot) <= accuracy * (1.0 + length(pivot))
                    && length(w - pin) <= accuracy * (1.0 + length(pin))
            }
            Dyad::Slider { .. } | Dyad::Slot { .. } => false,
        })
    }

    #[test]
    fn the_dyads_of_a_four_bar_are_among_those_of_five_of_its_poses() {
        let mut counts = [0; 5];
        for seed in 1..=500 {
            let (set, own) = random_poses(5, seed);
            let found = dyads_of(&set);
            assert!(own.iter().all(|dyad| has(&found, *dyad, 1e-9)), "{seed}: {own:?} among {found:?}");
            assert!(found.iter().all(|dyad| dyad.error(set.placed()) < 1e-10), "{seed}: {found:?}");
            counts[found.len()] += 1;
        }
        // A quartic with two real roots has two or four.
        assert_eq!([counts[0], counts[1], counts[3]], [0; 3], "{counts:?}");
        assert!(counts[2].min(counts[4]) > 50, "{counts:?}");
    }

    #[test]
    fn the_number_of_real_dyads_is_that_of_a_search_for_them_in_the_plane() {
        // Of any poses, also of none that two dyads pass: 0, 2 or 4. A search on the centre-point curve of the first four poses finds where the
        // fifth changes its sign.
        use super::super::centre_curve::CentreCurve;
        let mut counts = [0; 5];
        for seed in 1..=60 {
            let mut scatter = crate::scatter::Scatter::new(seed);
            let poses: Vec<BodyPose> = (0..5)
                .map(|_| BodyPose {
                    point: Point::new(scatter.normal(1.0), scatter.normal(1.0)),
                    angle_deg: scatter.normal(60.0),
                })
                .collect();
            let set = PoseSet::new(&poses).unwrap();
            let placed = set.placed();
            let curve = CentreCurve::new(&placed[..4]).unwrap();
            const STEPS: usize = 40_000;
            let mut crossings = 0;
            for side in 0..2 {
                let zero_form = |k: usize| {
                    let dyad = curve.dyads(std::f64::consts::PI * k as f64 / STEPS as f64)[side]?;
                    let Dyad::Revolute { pivot, pin } = dyad else { return None };
                    Some([pivot, pin].map(|z| Vector3::new(z.re, z.im, 1.0).normalize()))
                };
                let last = Forms::new(placed).matrices()[3];
                let values: Vec<_> = (0..STEPS).map(zero_form).collect();
                // Neighbours whose vectors are nearly opposite are on the two sides of infinity.
                let changes = values.windows(2).filter(|pair| match pair {
                    [Some([g, w]), Some([next_g, next_w])] => {
                        let [of_pivot, of_pin] = [g.dot(next_g), w.dot(next_w)];
                        let change = g.dot(&(last * w)) * next_g.dot(&(last * next_w)) * of_pivot * of_pin;
                        change < 0.0 && of_pivot.abs().min(of_pin.abs()) > 0.99
                    }
                    _ => false,
                });
                crossings += changes.count();
            }
            let found = dyads_of(&set);
            counts[found.len()] += 1;
            // Where the curve ends at a double root of its line, a crossing may be between two samples of different sides; there are none here.
            assert_eq!(crossings, found.len(), "{seed}: {found:?}");
        }
        assert!(counts[0] + counts[2] + counts[4] == 60 && counts[0] > 5 && counts[2] > 5, "{counts:?}");
    }

    #[test]
    fn poses_near_each_other_have_the_dyads_of_their_four_bar() {
        // Of a crank-rocker, at steps of half a degree of its crank: its pivots at the origin and at (4, 0), in exact closed form.
        let pose = |k: i32| {
            let (cos, sin) = trig::cos_sin_deg(40.0 + 0.5 * f64::from(k));
            let a = Complex::new(1.5 * cos, 1.5 * sin);
            let base = Complex::new(4.0, 0.0) - a;
            let along = (9.0 - 12.25 + base.norm_sqr()) / (2.0 * base.norm_sqr());
            let coupler = base * Complex::new(along, (9.0 / base.norm_sqr() - along * along).sqrt()) / 3.0;
            let point = a + coupler * Complex::new(2.0, 1.0);
            let angle_deg = trig::degrees(trig::atan2(coupler.im, coupler.re));
            BodyPose { point: Point::new(point.re, point.im), angle_deg }
        };
        let set = PoseSet::new(&[0, 1, 2, 3, 4].map(pose)).unwrap();
        let found = dyads_of(&set);
        for pivot in [0.0, 4.0] {
            let expected = set.relative(Point::new(pivot, 0.0));
            let is_near = |dyad: &Dyad| match dyad {
                Dyad::Revolute { pivot, .. } => length(pivot - expected) < 1e-4 * length(expected),
                Dyad::Slider { .. } | Dyad::Slot { .. } => false,
            };
            assert!(found.iter().any(is_near), "{expected}: {found:?}");
        }
    }

    #[test]
    fn translations_have_infinitely_many() {
        let at =
            |k: i32| BodyPose { point: Point::new(trig::cos(f64::from(k)), trig::sin(f64::from(k))), angle_deg: 30.0 };
        let set = PoseSet::new(&[0, 1, 2, 3, 4].map(at)).unwrap();
        assert_eq!(dyads(&Forms::new(set.placed()).independent()), None);
    }
}
