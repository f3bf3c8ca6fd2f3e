//! Measures of a curve; each is a column of `cells.csv` and a name in `where`.

mod annulus;
mod axis_motion;
mod circuit_function;
mod class;
mod column;
pub(crate) mod curve;
mod curve_ring;
mod curve_strip;
mod dwell;
mod every_nth;
mod four_bar_type;
mod input_range;
mod longest_near;
mod longest_straight;
mod maximum;
mod measures;
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
mod subject;
mod symmetry;
mod symmetry_axis;
mod touching;
mod transmission;
mod word_comparison;

pub use column::{COLUMNS, Column, compute_columns, find_column};
pub use dwell::Dwell;
pub use measures::{ALL, BOOLEANS, Boolean, Measure, Value, compute_all, compute_selected};
pub use output::output_limit_poses;
pub use path::cumulative_lengths;
pub use straight::{StraightCriterion, StraightPortion};
pub use subject::Subject;
pub use symmetry::Symmetry;
pub use symmetry_axis::SymmetryAxis;
pub use transmission::transmission_angle;
pub use word_comparison::parse_condition;

use std::cell::OnceCell;
use std::rc::Rc;

use crate::linkage::{Input, JointId, Linkage};
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

/// The input at which a portion of a curve begins: from 0 up to a period where the input turns fully.
fn start_input(curve: &TracedCurve, input: f64) -> f64 {
    match curve.linkage.input() {
        Input::Angle { turns } if curve.circuit.is_full_turn() => within_period(input, 360.0 * f64::from(turns)),
        _ => input,
    }
}

/// An input from 0 up to a period.
fn within_period(input: f64, period: f64) -> f64 {
    /// The accuracy with which starts of portions are found, in degrees.
    const SAME: f64 = 1e-6;
    let within = input.rem_euclid(period);
    if within > period - SAME { 0.0 } else { within }
}

/// A value, or 0 if it is no more than rounding.
fn without_rounding(value: f64, rounding: f64) -> f64 {
    if value.abs() <= rounding { 0.0 } else { value }
}
