//! Measures of a curve; each is a column of `cells.csv` and a name in `where`.

mod annulus;
mod circuit_function;
mod class;
mod column;
mod curve;
mod curve_ring;
mod curve_strip;
mod dwell;
mod every_nth;
mod four_bar_type;
mod input_range;
mod longest_near;
mod longest_straight;
mod maximum;
mod output;
mod path;
mod portions;
mod remez;
mod row;
mod shape;
mod six_bar;
mod speed_ratio;
mod straight;
mod straightest;
mod strip;
mod symmetry;
mod symmetry_axis;
mod touching;
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
use curve::{ArcLength, Crossings, SmoothCurve, Stop};
use output::OutputMotion;
use row::Row;

/// The curve of a traced joint on a circuit. Intermediate results are computed once for all measures.
#[derive(Clone, Debug)]
pub struct TracedCurve<'a> {
    /// The linkage.
    pub linkage: &'a Linkage,
    /// The linkage's motion.
    pub motion: &'a Motion,
    /// The circuit. Measures do not depend on its samples.
    pub circuit: &'a Circuit,
    /// The traced joint.
    pub joint: JointId,
    /// The criterion for the straight portion.
    pub straight_criterion: StraightCriterion,
    single_point_linkage: OnceCell<(Linkage, JointId)>,
    extent: OnceCell<f64>,
    straight: OnceCell<Vec<StraightPortion>>,
    dwell: OnceCell<Option<Dwell>>,
    symmetry: OnceCell<Option<Symmetry>>,
    transmission_angles: OnceCell<Option<[f64; 2]>>,
    circuit_results: CircuitResults,
    cusp_count: OnceCell<usize>,
    smooth: OnceCell<Rc<SmoothCurve>>,
    row: OnceCell<Option<Row>>,
    wider_straight: [OnceCell<Vec<StraightPortion>>; 2],
    straight_half_turn: OnceCell<Option<StraightPortion>>,
    arc_length: OnceCell<ArcLength>,
    stops: OnceCell<Vec<Stop>>,
    inflections: OnceCell<(usize, usize)>,
    crossings: OnceCell<Crossings>,
}

impl<'a> TracedCurve<'a> {
    /// The curve of a traced joint on a circuit of a linkage's motion.
    pub fn new(linkage: &'a Linkage, motion: &'a Motion, circuit: &'a Circuit, joint: JointId) -> TracedCurve<'a> {
        TracedCurve {
            linkage,
            motion,
            circuit,
            joint,
            straight_criterion: StraightCriterion::default(),
            single_point_linkage: OnceCell::new(),
            extent: OnceCell::new(),
            straight: OnceCell::new(),
            dwell: OnceCell::new(),
            symmetry: OnceCell::new(),
            transmission_angles: OnceCell::new(),
            circuit_results: CircuitResults::default(),
            cusp_count: OnceCell::new(),
            smooth: OnceCell::new(),
            row: OnceCell::new(),
            wider_straight: Default::default(),
            straight_half_turn: OnceCell::new(),
            arc_length: OnceCell::new(),
            stops: OnceCell::new(),
            inflections: OnceCell::new(),
            crossings: OnceCell::new(),
        }
    }

    /// The same curve with another criterion for the straight portion.
    pub fn with_straight_criterion(self, criterion: StraightCriterion) -> TracedCurve<'a> {
        TracedCurve { straight_criterion: criterion, straight: OnceCell::new(), ..self }
    }

    /// The straight portion that meets the criterion.
    pub fn straight(&self) -> Option<&StraightPortion> {
        self.straight_portions().first()
    }

    /// The straight portions that meet the criterion equally well, such as both of a symmetrical curve.
    pub fn straight_portions(&self) -> &[StraightPortion] {
        let find = || straight::find_portions(self, self.straight_criterion);
        self.straight.get_or_init(find)
    }

    /// The greatest distance of two points of the curve.
    pub fn extent(&self) -> f64 {
        *self.extent.get_or_init(|| self.smooth().extent())
    }

    /// The least and the greatest transmission angle, in degrees.
    fn transmission_angles(&self) -> Option<[f64; 2]> {
        *self.transmission_angles.get_or_init(|| transmission::transmission_angles(self))
    }

    /// The curve as polynomials.
    fn smooth(&self) -> &Rc<SmoothCurve> {
        let pieces =
            || Rc::new(SmoothCurve::new(self.circuit.pieces(self.linkage), self.joint, self.circuit.is_closed));
        self.smooth.get_or_init(pieces)
    }

    /// Its points, for the search for portions; `None` for a point, or what is one but for rounding.
    fn row(&self) -> Option<&Row> {
        /// The extent at which a thousandth of a twentieth of it, the width of the narrowest strip that matters, is ten
        /// times the rounding.
        const SHAPELESS: f64 = 2e5;
        let has_shape = || self.extent() > SHAPELESS * self.smooth().rounding;
        let row = || has_shape().then(|| Row::new(self.smooth(), straight::SPACING * self.extent())).flatten();
        self.row.get_or_init(row).as_ref()
    }

    /// The longest straight portion to one of the [`straight::WIDER_TOLERANCES`].
    fn wider_straight(&self, index: usize) -> Option<&StraightPortion> {
        let criterion = StraightCriterion::Tolerance(straight::WIDER_TOLERANCES[index]);
        self.wider_straight[index].get_or_init(|| straight::find_portions(self, criterion)).first()
    }

    /// The straightest portion over half a turn of the input.
    fn straight_half_turn(&self) -> Option<&StraightPortion> {
        self.straight_half_turn.get_or_init(|| straight::find_half_turn(self)).as_ref()
    }

    /// Its length as a function of the place.
    fn arc_length(&self) -> &ArcLength {
        self.arc_length.get_or_init(|| ArcLength::measure(self.smooth()))
    }

    /// The places where it stops.
    fn stops(&self) -> &[Stop] {
        self.stops.get_or_init(|| self.smooth().stops())
    }

    /// The number of its inflections, and of places where it is not known whether there are two or none.
    fn inflections(&self) -> (usize, usize) {
        *self.inflections.get_or_init(|| self.smooth().inflections(self.stops()))
    }

    /// The points where it crosses itself.
    fn crossings(&self) -> &Crossings {
        self.crossings.get_or_init(|| self.smooth().crossings(self.stops()))
    }

    /// The same curve with results that the curves of other joints on the circuit share.
    pub fn with_circuit_results(self, circuit_results: CircuitResults) -> TracedCurve<'a> {
        TracedCurve { circuit_results, ..self }
    }

    /// The motion of the output link; `None` if there is none.
    fn output(&self) -> Option<&OutputMotion> {
        self.circuit_results.0.output.get_or_init(|| OutputMotion::new(self)).as_ref()
    }

    /// The worst transmission angle, in degrees.
    fn worst_transmission_angle(&self) -> Option<f64> {
        *self.circuit_results.0.worst_transmission_angle.get_or_init(|| transmission::worst_angle(self))
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
        (self.straight.get().and_then(|all| all.first().cloned()), self.symmetry.get().copied().flatten())
    }

    /// The symmetry of the curve; `None` for a point.
    pub fn symmetry(&self) -> Option<&Symmetry> {
        self.symmetry.get_or_init(|| symmetry::find_symmetry(self)).as_ref()
    }

    /// The best circular portion.
    pub fn dwell(&self) -> Option<&Dwell> {
        let find = || dwell::find_dwell(self.row()?, self.extent(), self.arc_length().total());
        self.dwell.get_or_init(find).as_ref()
    }
}

/// Results that do not depend on the traced joint, computed on first use. The curves of one circuit may share them.
#[derive(Clone, Debug, Default)]
pub struct CircuitResults(Rc<SharedResults>);

#[derive(Debug, Default)]
struct SharedResults {
    output: OnceCell<Option<OutputMotion>>,
    worst_transmission_angle: OnceCell<Option<f64>>,
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
pub static ALL: [Measure; 62] = [
    class::CLASS,
    four_bar_type::TYPE,
    four_bar_type::SHORTEST,
    six_bar::SIX_BAR,
    input_range::IS_FULL_TURN,
    input_range::INPUT_MIN,
    input_range::INPUT_MAX,
    output::MIN,
    output::MAX,
    output::SWING,
    output::STROKE,
    transmission::MU_MIN,
    transmission::MU_MAX,
    transmission::MU_WORST,
    output::TIME_RATIO,
    output::DWELL,
    output::DWELL_START,
    output::TOGGLES,
    output::VELOCITY_RATIO_MIN,
    output::VELOCITY_RATIO_MAX,
    output::MECHANICAL_ADVANTAGE_MIN,
    output::MECHANICAL_ADVANTAGE_MAX,
    path::LENGTH,
    path::AREA,
    path::BOUNDING_BOX[0],
    path::BOUNDING_BOX[1],
    path::BOUNDING_BOX[2],
    path::BOUNDING_BOX[3],
    shape::CUSPS,
    shape::CRUNODES,
    shape::INFLECTIONS,
    shape::TOO_CLOSE,
    symmetry::SYMMETRY,
    symmetry::AXIS,
    symmetry::RESIDUAL,
    shape::CURVATURE_MAX,
    speed_ratio::SPEED_RATIO,
    straight::MEASURES[0],
    straight::MEASURES[1],
    straight::MEASURES[2],
    straight::MEASURES[3],
    straight::MEASURES[4],
    straight::MEASURES[5],
    straight::WIDER[0][0],
    straight::WIDER[0][1],
    straight::WIDER[0][2],
    straight::WIDER[0][3],
    straight::WIDER[0][4],
    straight::WIDER[1][0],
    straight::WIDER[1][1],
    straight::WIDER[1][2],
    straight::WIDER[1][3],
    straight::WIDER[1][4],
    straight::HALF_TURN[0],
    straight::HALF_TURN[1],
    straight::HALF_TURN[2],
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
