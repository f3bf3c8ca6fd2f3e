//! Measures of a curve; each is a column of `cells.csv` and a name in `where`.

mod annulus;
mod class;
mod column;
mod crossings;
mod curve_segment;
mod dwell;
mod extreme;
mod four_bar_type;
mod input_range;
mod interpolation;
mod local_polynomial;
mod longest_straight;
mod path;
mod remez;
mod sampled_curve;
mod shape;
mod six_bar;
mod speed_ratio;
mod straight;
mod straightest;
mod strip;
mod swing;
mod symmetry;
mod symmetry_axis;
mod time_ratio;
mod transmission;

pub use column::{COLUMNS, Column, compute_columns, find_column};
pub use dwell::Dwell;
pub use path::cumulative_lengths;
pub use straight::{StraightCriterion, StraightPortion};
pub use symmetry::Symmetry;
pub use symmetry_axis::SymmetryAxis;
pub use transmission::transmission_angle;

use std::cell::OnceCell;
use std::rc::Rc;

use crate::linkage::{JointId, Linkage};
use crate::motion::{Circuit, Motion};
use curve_segment::CurveSegment;
use sampled_curve::SampledCurve;

/// The curve of a traced joint on a circuit. Intermediate results are computed once for all measures.
#[derive(Clone, Debug)]
pub struct TracedCurve<'a> {
    /// The linkage.
    pub linkage: &'a Linkage,
    /// The linkage's motion.
    pub motion: &'a Motion,
    /// The circuit, refined so that measures do not depend on the requested samples.
    pub circuit: &'a Circuit,
    /// The traced joint.
    pub joint: JointId,
    /// The criterion for the straight portion.
    pub straight_criterion: StraightCriterion,
    single_point_linkage: OnceCell<(Linkage, JointId)>,
    sampled_curve: OnceCell<Rc<SampledCurve>>,
    curve_segment: OnceCell<CurveSegment>,
    straight: OnceCell<Option<StraightPortion>>,
    dwell: OnceCell<Option<Dwell>>,
    symmetry: OnceCell<Option<Symmetry>>,
    transmission_angles: OnceCell<Option<[f64; 2]>>,
    cusp_count: OnceCell<usize>,
}

impl<'a> TracedCurve<'a> {
    /// The curve of a traced joint on a circuit of a linkage's motion.
    pub fn new(linkage: &'a Linkage, motion: &'a Motion, circuit: &'a Circuit, joint: JointId) -> TracedCurve<'a> {
        TracedCurve {
            linkage,
            motion,
            circuit: circuit.refined(linkage),
            joint,
            straight_criterion: StraightCriterion::default(),
            single_point_linkage: OnceCell::new(),
            sampled_curve: OnceCell::new(),
            curve_segment: OnceCell::new(),
            straight: OnceCell::new(),
            dwell: OnceCell::new(),
            symmetry: OnceCell::new(),
            transmission_angles: OnceCell::new(),
            cusp_count: OnceCell::new(),
        }
    }

    /// The same curve with another criterion for the straight portion.
    pub fn with_straight_criterion(self, criterion: StraightCriterion) -> TracedCurve<'a> {
        TracedCurve { straight_criterion: criterion, straight: OnceCell::new(), ..self }
    }

    /// The straight portion that meets the criterion.
    pub fn straight(&self) -> Option<&StraightPortion> {
        self.straight.get_or_init(|| straight::find_portion(self.curve_segment()?, self.straight_criterion)).as_ref()
    }

    /// The least and the greatest transmission angle, in degrees.
    fn transmission_angles(&self) -> Option<[f64; 2]> {
        *self.transmission_angles.get_or_init(|| transmission::transmission_angles(self))
    }

    /// The linkage without other traced points, and the joint in it: poses of it are faster to compute.
    fn single_point_linkage(&self) -> (&Linkage, JointId) {
        let (linkage, joint) = self.single_point_linkage.get_or_init(|| self.linkage.with_one_point(self.joint));
        (linkage, *joint)
    }

    /// The number of cusps.
    fn cusp_count(&self) -> usize {
        *self.cusp_count.get_or_init(|| shape::count_cusps(self))
    }

    /// The straight portion and the symmetry, if they have been computed, to be marked on pages.
    pub fn computed_marks(&self) -> (Option<StraightPortion>, Option<Symmetry>) {
        (self.straight.get().cloned().flatten(), self.symmetry.get().copied().flatten())
    }

    /// The symmetry of the curve; `None` for a point.
    pub fn symmetry(&self) -> Option<&Symmetry> {
        self.symmetry.get_or_init(|| symmetry::find_symmetry(self)).as_ref()
    }

    /// The best circular portion.
    pub fn dwell(&self) -> Option<&Dwell> {
        self.dwell.get_or_init(|| dwell::find_dwell(self.curve_segment()?)).as_ref()
    }

    /// The samples of the curve.
    fn sampled_curve(&self) -> &SampledCurve {
        self.sampled_curve.get_or_init(|| self.new_sampled_curve())
    }

    fn new_sampled_curve(&self) -> Rc<SampledCurve> {
        Rc::new(SampledCurve::from_circuit(self.circuit, self.joint, self.linkage.input()))
    }

    /// The whole curve, for the search for portions; `None` if fewer than five of its samples have a defined position.
    fn curve_segment(&self) -> Option<&CurveSegment> {
        const MIN_SAMPLES: usize = 5;
        let whole = || CurveSegment::whole(self.sampled_curve.get_or_init(|| self.new_sampled_curve()).clone());
        (self.sampled_curve().points.len() >= MIN_SAMPLES).then(|| self.curve_segment.get_or_init(whole))
    }
}

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word.
    Word(&'static str),
    /// The measure does not apply.
    Missing,
}

/// A measure.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Measure {
    /// Its name: a column of `cells.csv` and a variable in `where`.
    pub name: &'static str,
    /// Its unit; empty for a word or a pure number.
    pub unit: &'static str,
    /// Whether it is a word and not a number: a word cannot be compared in `where`.
    pub is_word: bool,
    /// Its definition, as printed by `list measures`.
    pub definition: &'static str,
    /// Computes it.
    pub compute: fn(&TracedCurve) -> Value,
}

impl Measure {
    /// A measure that is a number.
    const fn number(
        name: &'static str,
        unit: &'static str,
        definition: &'static str,
        compute: fn(&TracedCurve) -> Value,
    ) -> Measure {
        Measure { name, unit, is_word: false, definition, compute }
    }
}

/// All measures, in the order of the columns.
pub static ALL: [Measure; 35] = [
    class::CLASS,
    four_bar_type::TYPE,
    four_bar_type::SHORTEST,
    six_bar::SIX_BAR,
    input_range::IS_FULL_TURN,
    input_range::INPUT_MIN,
    input_range::INPUT_MAX,
    swing::OUTPUT_SWING,
    transmission::MU_MIN,
    transmission::MU_MAX,
    time_ratio::TIME_RATIO,
    path::LENGTH,
    path::AREA,
    path::BOUNDING_BOX[0],
    path::BOUNDING_BOX[1],
    path::BOUNDING_BOX[2],
    path::BOUNDING_BOX[3],
    shape::CUSPS,
    shape::CRUNODES,
    shape::INFLECTIONS,
    symmetry::SYMMETRY,
    symmetry::AXIS,
    symmetry::RESIDUAL,
    shape::CURVATURE_MAX,
    speed_ratio::SPEED_RATIO,
    straight::MEASURES[0],
    straight::MEASURES[1],
    straight::MEASURES[2],
    straight::MEASURES[3],
    dwell::MEASURES[0],
    dwell::MEASURES[1],
    dwell::MEASURES[2],
    dwell::MEASURES[3],
    dwell::MEASURES[4],
    dwell::MEASURES[5],
];

/// A boolean name of `where`: true where a measure that is a word has a certain value, false where it has another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Boolean {
    /// Its name.
    pub name: &'static str,
    /// The name of the measure.
    pub measure: &'static str,
    /// The value of the measure for which it is true.
    pub word: &'static str,
}

/// All booleans.
pub static BOOLEANS: [Boolean; 7] = [
    Boolean::of_class("is_crank_rocker", "crank-rocker"),
    Boolean::of_class("is_rocker_crank", "rocker-crank"),
    Boolean::of_class("is_drag_link", "drag-link"),
    Boolean::of_class("is_double_rocker", "double-rocker"),
    Boolean::of_class("is_triple_rocker", "triple-rocker"),
    Boolean::of_class("is_change_point", "change-point"),
    Boolean { name: input_range::IS_FULL_TURN.name, measure: input_range::IS_FULL_TURN.name, word: input_range::YES },
];

impl Boolean {
    const fn of_class(name: &'static str, class: &'static str) -> Boolean {
        Boolean { name, measure: class::CLASS.name, word: class }
    }

    /// Its value as a number, 1 or 0, with the values of [`ALL`]; NaN if the measure does not apply.
    pub fn value(&self, values: &[Value]) -> f64 {
        match ALL.iter().zip(values).find(|(measure, _)| measure.name == self.measure) {
            Some((_, Value::Word(word))) => f64::from(u8::from(*word == self.word)),
            _ => f64::NAN,
        }
    }
}

/// Computes all measures of a curve, in the order of [`ALL`].
pub fn compute_all(curve: &TracedCurve) -> Vec<Value> {
    compute_selected(curve, |_| true)
}

/// Computes the selected measures of a curve, in the order of [`ALL`]; the others are [`Value::Missing`]. `is_selected`
/// is called with indices of [`ALL`].
pub fn compute_selected(curve: &TracedCurve, is_selected: impl Fn(usize) -> bool) -> Vec<Value> {
    let value =
        |(k, measure): (usize, &Measure)| if is_selected(k) { (measure.compute)(curve) } else { Value::Missing };
    ALL.iter().enumerate().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::FourBarClass;

    #[test]
    fn every_class_has_a_boolean() {
        for class in FourBarClass::ALL {
            let name = format!("is_{}", class.name().replace('-', "_"));
            let boolean = BOOLEANS.iter().find(|boolean| boolean.name == name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!((boolean.measure, boolean.word), ("class", class.name()));
        }
        for boolean in &BOOLEANS {
            assert!(ALL.iter().any(|measure| measure.name == boolean.measure && measure.is_word), "{boolean:?}");
        }
    }
}
