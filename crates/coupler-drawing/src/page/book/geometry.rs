use coupler_curves::measure::{Symmetry, Value};
use coupler_curves::solve::{Curve, Solved};

/// What an index says of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// The place of its family among the chapters, from 0.
    pub(super) chapter: usize,
    pub(super) caption: String,
    /// Its straightest curve by the part of it that is straight.
    pub(super) straight: Option<Found>,
    /// Its least transmission angle in degrees, from 0 to 90.
    pub(super) transmission: Option<Found>,
    /// Its most symmetrical curve by how far its mirror image is from it, by its greatest extent.
    pub(super) symmetry: Option<Found>,
}

/// A value, the curve it is of, and its page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub value: f64,
    /// The number of the traced point, where there are several.
    pub curve: Option<usize>,
    /// The page of the atlas it is on, from 1.
    pub page: usize,
}

impl Geometry {
    /// What an index says of a solved cell of a family, given by its place among the chapters; `page` gives the number of
    /// the page in the atlas, from 1, that the k-th of its curves is on.
    pub fn of(solved: &Solved, chapter: usize, caption: &str, page: impl Fn(usize) -> usize) -> Geometry {
        let has_many = solved.linkage.traced.len() > 1;
        let found = |value: f64, k: usize, curve: &Curve| {
            value.is_finite().then(|| Found { value, curve: has_many.then_some(curve.trace), page: page(k) })
        };
        let best = |value: fn(&Curve) -> Option<f64>, is_better: fn(f64, f64) -> bool| {
            let values = solved.curves.iter().enumerate().filter_map(|(k, curve)| found(value(curve)?, k, curve));
            // The first of those that are equal.
            values.reduce(|best, other| if is_better(other.value, best.value) { other } else { best })
        };
        Geometry {
            chapter,
            caption: caption.to_owned(),
            straight: best(straightness, |a, b| a > b),
            // It is the same for all points of a linkage.
            transmission: best(least_transmission, |a, b| a > b).map(|found| Found { curve: None, ..found }),
            symmetry: best(asymmetry, |a, b| a < b),
        }
    }
}

/// The part of a curve's length that its straight portion is.
fn straightness(curve: &Curve) -> Option<f64> {
    let (length, whole) = (number(curve, "straight_length")?, number(curve, "length")?);
    (length > 0.0 && whole > 0.0).then(|| length / whole)
}

/// The least angle between coupler and output link, whichever side of 90 degrees it is.
fn least_transmission(curve: &Curve) -> Option<f64> {
    Some(number(curve, "mu_min_deg")?.min(180.0 - number(curve, "mu_max_deg")?))
}

/// How far the mirror image of a curve is from it, by its greatest extent, in whole steps of what is called symmetrical: what
/// is nearer than that is alike. Nothing of a circle, which has no axis of its own.
fn asymmetry(curve: &Curve) -> Option<f64> {
    let symmetry = curve.symmetry.as_ref().filter(|symmetry| symmetry.axis.is_some())?;
    Some((symmetry.residual / Symmetry::NEAR).round() * Symmetry::NEAR)
}

fn number(curve: &Curve, name: &str) -> Option<f64> {
    match curve.measure(name) {
        Value::Number(value) => Some(value),
        _ => None,
    }
}
