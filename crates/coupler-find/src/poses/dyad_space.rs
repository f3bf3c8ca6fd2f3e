//! The dyads of some poses: a few, those of a curve of pivots, or those of any pivot.

use super::body::{Placed, PoseSet};
use super::centre_curve::CentreCurve;
use super::dyad::{Dyad, Forms};
use super::five;
use crate::complex::{Complex, times_i, unit};
use crate::even_sequence::EvenSequence;
use coupler_curves::geometry::{Bounds, Point};
use nalgebra::Vector3;

/// How many dyads poses have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Finitely many: those of five poses.
    Points,
    /// Those of the pivots on a curve: of four poses, and of five that are special.
    Curve,
    /// One for each pivot: of three poses, and of translations along a circle.
    Plane,
    /// A line of pins for each pivot: of two poses.
    Space,
    /// None that passes the poses exactly, in general: of more than five poses.
    None,
}

impl Freedom {
    /// In a few words: `infinitely many dyads, one for each pivot`.
    pub fn description(self) -> &'static str {
        match self {
            Freedom::Points => "finitely many dyads",
            Freedom::Curve => "infinitely many dyads, with their pivots on a curve",
            Freedom::Plane => "infinitely many dyads, one for each pivot",
            Freedom::Space => "infinitely many dyads, a line of pins for each pivot",
            Freedom::None => "no dyads that pass them exactly, in general",
        }
    }

    /// Its name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Freedom::Points => "points",
            Freedom::Curve => "curve",
            Freedom::Plane => "plane",
            Freedom::Space => "space",
            Freedom::None => "none",
        }
    }
}

/// The dyads of two to five poses.
pub(super) struct DyadSpace {
    forms: Forms,
    kind: Kind,
    /// The box of pivots that is asked for, in sizes of the poses from their middle: least and greatest corner.
    pivots: Option<[Complex; 2]>,
    /// The pivots that linkages are to have, in the same units.
    given: Vec<Complex>,
}

enum Kind {
    Points(Vec<Dyad>),
    Curve(CentreCurve),
    Plane,
    Space,
}

/// Which dyad of a space: coordinates from 0 to 1, of which as many count as it has dimensions, and one of several at them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DyadPlace {
    pub coordinates: [f64; 3],
    /// The number of a dyad of finitely many, or one of the two on a line, [`SLIDER`], [`SLOT`], or from [`FIRST_GIVEN`] on those of given pivots.
    pub number: usize,
}

/// The number of sliders.
const SLIDER: usize = 2;

/// The number of slots.
const SLOT: usize = 3;

/// The number of the dyads of the first given pivot, among those of any pivot.
const FIRST_GIVEN: usize = 4;

/// How far from the middle of the poses pivots and pins are without a box, in sizes of the poses: half of them in the inner sixth, for those that are near
/// make smaller linkages.
fn reach(part: f64) -> f64 {
    const INNER: f64 = 2.5;
    /// The greatest is four times as far as even parts would be.
    const STRETCH: f64 = 0.75;
    let centred = 2.0 * part - 1.0;
    INNER * centred / (1.0 - STRETCH * centred * centred)
}

impl DyadSpace {
    /// The dyads of two to five poses; with the box of the pivots, and those that are given.
    pub fn new(set: &PoseSet, pivots: Option<Bounds>, given: &[Point]) -> DyadSpace {
        let placed = set.placed();
        let forms = Forms::new(placed).independent();
        let curve = |of: &[Placed]| CentreCurve::new(of).map_or(Kind::Plane, Kind::Curve);
        let kind = match placed.len() {
            2 => Kind::Space,
            3 => Kind::Plane,
            4 => curve(placed),
            _ => five::dyads(&forms).map_or_else(|| curve(&placed[..4]), Kind::Points),
        };
        let pivots = pivots.map(|within| [set.relative(within.min), set.relative(within.max)]);
        DyadSpace { forms, kind, pivots, given: given.iter().map(|pivot| set.relative(*pivot)).collect() }
    }

    /// How many dyads there are.
    pub fn freedom(&self) -> Freedom {
        match self.kind {
            Kind::Points(_) => Freedom::Points,
            Kind::Curve(_) => Freedom::Curve,
            Kind::Plane => Freedom::Plane,
            Kind::Space => Freedom::Space,
        }
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.freedom() as usize
    }

    /// Places all over the space: all of finitely many dyads, and of others about as many as asked for.
    pub fn places(&self, count: usize) -> Vec<DyadPlace> {
        /// Of how many samples one is a slider and one a slot, whose lines have one coordinate less.
        const LINES: usize = 8;
        match &self.kind {
            Kind::Points(dyads) => (0..dyads.len()).map(|number| DyadPlace { coordinates: [0.0; 3], number }).collect(),
            Kind::Curve(_) => {
                let on_line = |k: usize| {
                    let angle = (k as f64 + 0.5) / (count / 2).max(1) as f64;
                    [0, 1].map(|number| DyadPlace { coordinates: [angle, 0.0, 0.0], number })
                };
                let at_infinity = [SLIDER, SLOT].map(|number| DyadPlace { coordinates: [0.0; 3], number });
                (0..count / 2).flat_map(on_line).chain(at_infinity).collect()
            }
            Kind::Plane | Kind::Space => {
                let sequence = EvenSequence::new(self.dimension());
                let place = |k: usize| {
                    let part = sequence.parts(k);
                    let coordinates = [0, 1, 2].map(|c| if c < self.dimension() { part(c) } else { 0.0 });
                    let number = match k % LINES {
                        3 => SLOT,
                        7 => SLIDER,
                        _ => 0,
                    };
                    DyadPlace { coordinates, number }
                };
                // Two given pivots leave no other.
                let others = if self.given.len() < 2 { (0..count).map(place).collect() } else { Vec::new() };
                self.given_places(count).into_iter().chain(others).collect()
            }
        }
    }

    /// The places of the dyads of given pivots: of three poses one for each, of two a line of pins, and the slot that is its end.
    fn given_places(&self, count: usize) -> Vec<DyadPlace> {
        /// The most pins of a pivot: every pair of two pivots is tried.
        const MOST: usize = 500;
        let pins = if self.freedom() == Freedom::Space { count.min(MOST) } else { 1 };
        let pin = |number: usize, k: usize| {
            let part = (k as f64 + 0.5) / (pins as f64 - 0.5);
            DyadPlace { coordinates: [part, 0.0, 0.0], number: FIRST_GIVEN + number }
        };
        (0..self.given.len()).flat_map(|number| (0..pins).map(move |k| pin(number, k))).collect()
    }

    /// Whether two dyads have all the given pivots.
    pub fn has_given(&self, places: [&DyadPlace; 2]) -> bool {
        (0..self.given.len()).all(|number| places.iter().any(|place| self.is_given(place, number)))
    }

    fn is_given(&self, place: &DyadPlace, number: usize) -> bool {
        self.is_of_given(place) && place.number == FIRST_GIVEN + number
    }

    /// Whether a dyad has a given pivot.
    pub fn is_of_given(&self, place: &DyadPlace) -> bool {
        matches!(self.kind, Kind::Plane | Kind::Space) && place.number >= FIRST_GIVEN
    }

    /// The dyad of a given pivot, which is exactly there.
    fn at_given(&self, pivot: Complex, part: f64) -> Option<Dyad> {
        let homogeneous = Vector3::new(pivot.re, pivot.im, 1.0).normalize();
        let pin = match self.kind {
            Kind::Space => on_line(&self.forms, &homogeneous, part)?,
            _ => self.forms.pin(&homogeneous)?,
        };
        Some(match Dyad::from_homogeneous(&homogeneous, &pin)? {
            Dyad::Slot { normal, .. } => Dyad::Slot { pivot, normal },
            Dyad::Revolute { pin, .. } | Dyad::Slider { pin, .. } => Dyad::Revolute { pivot, pin },
        })
    }

    /// The slot whose line has a normal at the first pose.
    fn slot(&self, [u, v]: [f64; 2]) -> Option<Dyad> {
        let (forms, normal) = (self.forms.exchanged(), normal(u));
        let pivot = match self.kind {
            Kind::Space => on_line(&forms, &normal, v)?,
            _ => forms.pin(&normal)?,
        };
        Dyad::from_homogeneous(&pivot, &normal)
    }

    /// The dyad at a place; `None` if there is none, or its pivot is beyond the box, where they are not finitely many.
    pub fn dyad(&self, place: &DyadPlace) -> Option<Dyad> {
        let DyadPlace { coordinates: [u, v, w], number } = *place;
        let dyad = match (&self.kind, number) {
            (Kind::Points(dyads), _) => *dyads.get(number)?,
            (Kind::Curve(curve), SLIDER) => curve.slider()?,
            (Kind::Curve(curve), SLOT) => curve.slot()?,
            (Kind::Curve(curve), _) => curve.dyads(std::f64::consts::PI * u)[number]?,
            (_, FIRST_GIVEN..) => self.at_given(*self.given.get(number - FIRST_GIVEN)?, u)?,
            (_, SLOT) => self.slot([u, v])?,
            (Kind::Plane, _) => {
                let pivot = self.pivot(number, [u, v]);
                Dyad::from_homogeneous(&pivot, &self.forms.pin(&pivot)?)?
            }
            (Kind::Space, _) => {
                let (pivot, part) = if number == SLIDER { (normal(u), v) } else { (self.pivot(number, [u, v]), w) };
                Dyad::from_homogeneous(&pivot, &on_line(&self.forms, &pivot, part)?)?
            }
        };
        let is_finite = matches!(self.kind, Kind::Points(_));
        (is_finite || self.contains(&dyad) && self.is_exact(&dyad)).then_some(dyad)
    }

    /// Whether the pivot of a dyad is in the box that is asked for.
    pub fn contains(&self, dyad: &Dyad) -> bool {
        let Some(pivot) = dyad.pivot() else { return true };
        self.given.contains(&pivot)
            || self.pivots.is_none_or(|[low, high]| {
                (low.re..=high.re).contains(&pivot.re) && (low.im..=high.im).contains(&pivot.im)
            })
    }

    /// A pivot in the box, or the normal of a slider's line.
    fn pivot(&self, number: usize, [u, v]: [f64; 2]) -> Vector3<f64> {
        match self.pivots {
            _ if number == SLIDER => normal(u),
            Some([low, high]) => {
                Vector3::new(low.re + u * (high.re - low.re), low.im + v * (high.im - low.im), 1.0).normalize()
            }
            None => Vector3::new(reach(u), reach(v), 1.0).normalize(),
        }
    }

    /// Whether a dyad satisfies the equations of all poses, also of those that did not determine it.
    fn is_exact(&self, dyad: &Dyad) -> bool {
        /// The forms and the vectors have the size 1: of a double zero half of the digits are left.
        const MOST: f64 = 1e-10;
        let [pivot, pin] = dyad.homogeneous();
        self.forms.residual(&pivot, &pin) <= MOST
    }
}

/// The normal of a line, as a point at infinity.
fn normal(part: f64) -> Vector3<f64> {
    let normal = unit(std::f64::consts::PI * part);
    Vector3::new(normal.re, normal.im, 0.0)
}

/// A pin on the line that the equation of two poses leaves for a pivot; of the part 1 where it is at infinity.
fn on_line(forms: &Forms, pivot: &Vector3<f64>, part: f64) -> Option<Vector3<f64>> {
    let row = forms.rows(pivot).first().copied()?;
    let normal = Complex::new(row.x, row.y);
    let square = normal.norm_sqr();
    // The poses differ by a translation: there is no such line, or every pin is possible.
    if square <= 1e-20 * row.norm_squared() {
        return None;
    }
    let along = times_i(normal) / square.sqrt();
    if part >= 1.0 {
        return Some(Vector3::new(along.re, along.im, 0.0));
    }
    let pin = normal * (-row.z / square) + along * reach(part);
    Some(Vector3::new(pin.re, pin.im, 1.0))
}
