//! Numbers read off a motion, one measure a file; each is a column of `cells.csv` and a name in `where`.

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
mod longest_straight;
mod path;
mod remez;
mod sampled_curve;
mod shape;
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

use std::cell::OnceCell;
use std::rc::Rc;

use crate::linkage::{FourBarClass, JointId, Linkage};
use crate::motion::{Circuit, Motion};
use curve_segment::CurveSegment;
use sampled_curve::SampledCurve;

/// What a measure is taken of: a traced joint on a circuit.
#[derive(Clone, Debug)]
pub struct TracedCurve<'a> {
    /// The linkage.
    pub linkage: &'a Linkage,
    /// All that it does.
    pub motion: &'a Motion,
    /// The circuit, by as many samples as tell of its curves: a measure is one of the curve, however few its samples are.
    pub circuit: &'a Circuit,
    /// The traced joint.
    pub joint: JointId,
    /// What is asked of its straight portion.
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
    /// A traced joint on a circuit of a linkage's motion.
    pub fn new(linkage: &'a Linkage, motion: &'a Motion, circuit: &'a Circuit, joint: JointId) -> TracedCurve<'a> {
        let (alone, trail, course, straight, dwell, symmetry, transmission, cusps) = Default::default();
        let (asked, circuit) = (StraightCriterion::default(), circuit.refined(linkage));
        TracedCurve {
            linkage,
            motion,
            circuit,
            joint,
            straight_criterion: asked,
            single_point_linkage: alone,
            sampled_curve: trail,
            curve_segment: course,
            straight,
            dwell,
            symmetry,
            transmission_angles: transmission,
            cusp_count: cusps,
        }
    }

    /// The same, of which another straight portion is wanted.
    pub fn with_straight_criterion(self, asked: StraightCriterion) -> TracedCurve<'a> {
        TracedCurve { straight_criterion: asked, straight: OnceCell::new(), ..self }
    }

    /// The straight portion asked for.
    pub fn straight(&self) -> Option<&StraightPortion> {
        self.straight.get_or_init(|| straight::find_portion(self.curve_segment()?, self.straight_criterion)).as_ref()
    }

    /// The least and the greatest transmission angle, in degrees.
    fn transmission_angles(&self) -> Option<[f64; 2]> {
        *self.transmission_angles.get_or_init(|| transmission::transmission_angles(self))
    }

    /// The linkage without other traced points, and the joint in it: what is asked at many inputs is asked of this.
    fn single_point_linkage(&self) -> (&Linkage, JointId) {
        let (linkage, joint) = self.single_point_linkage.get_or_init(|| self.linkage.with_one_point(self.joint));
        (linkage, *joint)
    }

    /// How often the path stands still and turns back.
    fn cusp_count(&self) -> usize {
        *self.cusp_count.get_or_init(|| shape::count_cusps(self))
    }

    /// What is marked on pages of what has been measured: its straight portion and its symmetry.
    pub fn computed_marks(&self) -> (Option<StraightPortion>, Option<Symmetry>) {
        (self.straight.get().cloned().flatten(), self.symmetry.get().copied().flatten())
    }

    /// Whether it is symmetrical, and about which line; `None` of a point.
    pub fn symmetry(&self) -> Option<&Symmetry> {
        self.symmetry.get_or_init(|| symmetry::find_symmetry(self)).as_ref()
    }

    /// The best circular portion.
    pub fn dwell(&self) -> Option<&Dwell> {
        self.dwell.get_or_init(|| dwell::find_dwell(self.curve_segment()?)).as_ref()
    }

    /// The curve, made once for all measures.
    fn sampled_curve(&self) -> &SampledCurve {
        self.sampled_curve.get_or_init(|| self.new_sampled_curve())
    }

    fn new_sampled_curve(&self) -> Rc<SampledCurve> {
        Rc::new(SampledCurve::from_circuit(self.circuit, self.joint, self.linkage.input()))
    }

    /// The curve as a row of points, made once for all portions; `None` where it has no place at most of its samples.
    fn curve_segment(&self) -> Option<&CurveSegment> {
        const FEWEST: usize = 5;
        let course = || CurveSegment::whole(self.sampled_curve.get_or_init(|| self.new_sampled_curve()).clone());
        (self.sampled_curve().points.len() >= FEWEST).then(|| self.curve_segment.get_or_init(course))
    }
}

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word.
    Word(&'static str),
    /// It does not apply.
    Missing,
}

/// A measure.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Its column.
    pub name: &'static str,
    /// Its unit; empty for a word or a pure number.
    pub unit: &'static str,
    /// Whether it is a word and not a number: a word cannot be compared in `where`.
    pub is_word: bool,
    /// What it is.
    pub definition: &'static str,
    /// How it is taken.
    pub compute: fn(&TracedCurve) -> Value,
}

impl Measure {
    /// A measure that is a number.
    const fn number(
        name: &'static str,
        unit: &'static str,
        definition: &'static str,
        take: fn(&TracedCurve) -> Value,
    ) -> Measure {
        Measure { name, unit, is_word: false, definition, compute: take }
    }
}

/// Every measure, in the order of the columns.
pub const ALL: [Measure; 33] = [
    class::CLASS,
    four_bar_type::TYPE,
    four_bar_type::SHORTEST,
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

/// A name that is true or false of a curve: `is_crank_rocker` and its like, by the word it asks for.
pub const BOOLEANS: [(&str, &str); 5] = [
    ("is_crank_rocker", "crank-rocker"),
    ("is_drag_link", "drag-link"),
    ("is_double_rocker", "double-rocker"),
    ("is_triple_rocker", "triple-rocker"),
    ("is_change_point", "change-point"),
];

/// Whether it is the measure, told by its place in [`ALL`], by which [`BOOLEANS`] are told.
pub fn defines_booleans(measure: usize) -> bool {
    ALL[measure].name == class::CLASS.name
}

/// Whether one of [`BOOLEANS`] holds, 1 or 0; not a number where there is no class.
pub fn bool_value(word: &str, values: &[Value]) -> f64 {
    match ALL.iter().zip(values).find(|(measure, _)| measure.name == class::CLASS.name) {
        Some((_, Value::Word(class))) => f64::from(u8::from(*class == word)),
        _ => f64::NAN,
    }
}

/// Every measure of a subject, in the order of [`ALL`].
pub fn compute_all(subject: &TracedCurve) -> Vec<Value> {
    compute_selected(subject, |_| true)
}

/// Some measures of a subject, told by their place in [`ALL`], in that order; the others are missing.
pub fn compute_selected(subject: &TracedCurve, is_wanted: impl Fn(usize) -> bool) -> Vec<Value> {
    let take = |(k, measure): (usize, &Measure)| if is_wanted(k) { (measure.compute)(subject) } else { Value::Missing };
    ALL.iter().enumerate().map(take).collect()
}

const _: () = assert!(BOOLEANS.len() == FourBarClass::ALL.len());

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_has_its_truth() {
        for class in FourBarClass::ALL {
            let truth =
                BOOLEANS.iter().find(|(_, word)| *word == class.name()).unwrap_or_else(|| panic!("{}", class.name()));
            assert_eq!(truth.0, format!("is_{}", class.name().replace('-', "_")));
        }
    }
}
