use crate::measure::{Symmetry, Value};
use crate::sweep::{Curve, Solved};

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
    /// Its symmetrical curves, by the direction of their axes in degrees.
    pub(super) symmetrical: Vec<Found>,
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
        let best = |value: fn(&Curve) -> Option<f64>| {
            let values = solved.curves.iter().enumerate().filter_map(|(k, curve)| found(value(curve)?, k, curve));
            // The first of those that are equal.
            values.reduce(|best, other| if other.value > best.value { other } else { best })
        };
        let symmetrical = solved.curves.iter().enumerate().filter_map(|(k, curve)| {
            let axis = curve.symmetry.as_ref().and_then(Symmetry::of_symmetrical)?;
            found(axis.deg(), k, curve)
        });
        Geometry {
            chapter,
            caption: caption.to_owned(),
            straight: best(straightness),
            // It is the same for all points of a linkage.
            transmission: best(least_transmission).map(|found| Found { curve: None, ..found }),
            symmetrical: symmetrical.collect(),
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

fn number(curve: &Curve, name: &str) -> Option<f64> {
    match curve.measure(name) {
        Value::Number(value) => Some(value),
        _ => None,
    }
}
