//! A curve to be measured, with the results that several measures share.

use std::cell::{Cell, OnceCell};
use std::rc::Rc;

use super::budget::TooManySteps;
use super::circuit_function::{CircuitFunction, NoFunction, Quantity};
use super::curve::{ArcLength, Crossings, SmoothCurve, Stop};
use super::features::{CurveMoves, Dwell, InputTorque, StraightCriterion, StraightPortion, Symmetry};
use super::output::motion::OutputMotion;
use super::portion::{Row, SPACING};
use super::rounding::{within_period, without_rounding};
use crate::linkage::{Input, JointId, Linkage};
use crate::motion::{Circuit, Motion, NeighbourLinkages};

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
    neighbours: Option<Rc<NeighbourLinkages>>,
    pub(super) moves: OnceCell<Option<CurveMoves>>,
    single_point_linkage: OnceCell<(Linkage, JointId)>,
    extent: OnceCell<f64>,
    pub(super) straight: OnceCell<Result<Vec<StraightPortion>, TooManySteps>>,
    pub(super) dwell: OnceCell<Result<Option<Dwell>, TooManySteps>>,
    pub(super) symmetry: OnceCell<Option<Symmetry>>,
    pub(super) transmission_angles: OnceCell<Option<[f64; 2]>>,
    pub(super) circuit_results: CircuitResults,
    pub(super) cusp_count: OnceCell<usize>,
    smooth: OnceCell<Rc<SmoothCurve>>,
    row: OnceCell<Result<Option<Row>, TooManySteps>>,
    pub(super) max_curvature: OnceCell<Result<Option<f64>, TooManySteps>>,
    pub(super) wider_straight: [OnceCell<Result<Vec<StraightPortion>, TooManySteps>>; 2],
    pub(super) straight_half_turn: OnceCell<Result<Option<StraightPortion>, TooManySteps>>,
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
            neighbours: None,
            moves: OnceCell::new(),
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
            max_curvature: OnceCell::new(),
            wider_straight: Default::default(),
            straight_half_turn: OnceCell::new(),
            arc_length: OnceCell::new(),
            stops: OnceCell::new(),
            inflections: OnceCell::new(),
            crossings: OnceCell::new(),
        }
    }

    /// The curves of all traced joints on all circuits of a linkage's motion, in order of trace and circuit.
    pub fn all(linkage: &'a Linkage, motion: &'a Motion) -> impl Iterator<Item = TracedCurve<'a>> {
        let circuits: Vec<(&Circuit, CircuitResults)> =
            motion.circuits.iter().map(|circuit| (circuit, Default::default())).collect();
        linkage.traced.iter().flat_map(move |joint| {
            let curve = |(circuit, results): &(&'a Circuit, CircuitResults)| TracedCurve {
                circuit_results: results.clone(),
                ..TracedCurve::new(linkage, motion, circuit, *joint)
            };
            circuits.iter().map(curve).collect::<Vec<_>>()
        })
    }

    /// The same curve with another criterion for the straight portion.
    pub fn with_straight_criterion(self, criterion: StraightCriterion) -> TracedCurve<'a> {
        TracedCurve { straight_criterion: criterion, straight: OnceCell::new(), ..self }
    }

    /// The same curve of a linkage whose lengths may be off.
    #[must_use]
    pub fn with_neighbours(self, neighbours: Option<Rc<NeighbourLinkages>>) -> TracedCurve<'a> {
        TracedCurve { neighbours, moves: OnceCell::new(), ..self }
    }

    /// The linkages that differ in one length.
    pub(super) fn neighbours(&self) -> Option<&NeighbourLinkages> {
        self.neighbours.as_deref()
    }

    /// The greatest distance of two points of the curve.
    pub fn extent(&self) -> f64 {
        *self.extent.get_or_init(|| self.smooth().extent())
    }

    /// The curve as polynomials.
    pub(super) fn smooth(&self) -> &Rc<SmoothCurve> {
        let pieces =
            || Rc::new(SmoothCurve::new(self.circuit.pieces(self.linkage), self.joint, self.circuit.is_closed));
        self.smooth.get_or_init(pieces)
    }

    /// Its points, for the search for portions; `None` for a point, or what is one but for rounding.
    ///
    /// # Errors
    /// The search for its bends takes too many steps.
    pub(super) fn row(&self) -> Result<Option<&Row>, TooManySteps> {
        /// The extent at which a thousandth of a twentieth of it, the width of the narrowest strip that matters, is ten
        /// times the rounding.
        const SHAPELESS: f64 = 2e5;
        let has_shape = || self.extent() > SHAPELESS * self.smooth().rounding;
        let row = || if has_shape() { self.row_of_spacing(SPACING * self.extent()) } else { Ok(None) };
        self.row.get_or_init(row).as_ref().map(Option::as_ref).map_err(|error| *error)
    }

    /// Points of it, no further apart than `spacing`.
    ///
    /// # Errors
    /// The search for its bends takes too many steps.
    pub(super) fn row_of_spacing(&self, spacing: f64) -> Result<Option<Row>, TooManySteps> {
        /// The radius, in spacings, of a bend that points show as what it is.
        const RESOLVED: f64 = 4.0;
        let bends = self.smooth().bends(1.0 / (RESOLVED * spacing), self.stops())?;
        Ok(Row::new(self.smooth(), &bends, spacing))
    }

    /// Its length as a function of the place.
    pub(super) fn arc_length(&self) -> &ArcLength {
        self.arc_length.get_or_init(|| ArcLength::measure(self.smooth()))
    }

    /// The places where it stops.
    pub(super) fn stops(&self) -> &[Stop] {
        self.stops.get_or_init(|| self.smooth().stops())
    }

    /// The number of its inflections, and of places where it is not known whether there are two or none.
    pub(super) fn inflections(&self) -> (usize, usize) {
        *self.inflections.get_or_init(|| self.smooth().inflections(self.stops()))
    }

    /// The points where it crosses itself.
    pub(super) fn crossings(&self) -> &Crossings {
        self.crossings.get_or_init(|| self.smooth().crossings(self.stops()))
    }

    /// A quantity along the circuit; `None` if it is undefined somewhere, or too close to tell.
    pub(super) fn circuit_function<Q: Quantity>(&self, quantity: Q) -> Option<CircuitFunction<Q>> {
        let linkages = [self.linkage, self.single_point_linkage().0];
        let function = CircuitFunction::new(self.circuit, linkages, quantity);
        if let Err(NoFunction::TooCloseToTell) = function {
            self.circuit_results.0.has_function_too_close.set(true);
        }
        function.ok()
    }

    /// Whether measures have no value because they are too close to tell.
    pub(super) fn has_measures_too_close(&self) -> bool {
        // All functions along the circuit are those of these two.
        let has_dwell_too_close = self.output().is_some_and(|output| output.dwell().is_none());
        self.worst_transmission_angle();
        let has_portion_too_close = || {
            self.counted_straight().is_err()
                || (0..self.wider_straight.len()).any(|index| self.counted_wider_straight(index).is_err())
                || self.counted_half_turn().is_err()
                || self.counted_dwell().is_err()
        };
        has_dwell_too_close
            || self.circuit_results.0.has_function_too_close.get()
            || !self.arc_length().is_known()
            || self.crossings().is_cut_short
            || self.counted_max_curvature().is_err()
            || self.input_torque().is_err()
            || has_portion_too_close()
    }

    /// The linkage without other traced points, and the joint in it: poses of it are faster to compute.
    pub(super) fn single_point_linkage(&self) -> (&Linkage, JointId) {
        let (linkage, joint) = self.single_point_linkage.get_or_init(|| self.linkage.with_one_point(self.joint));
        (linkage, *joint)
    }

    /// The straight portion, the symmetry and the moves for errors of lengths, if they have been computed, to be marked on pages.
    pub fn computed_marks(&self) -> (Option<StraightPortion>, Option<Symmetry>, Option<CurveMoves>) {
        let straight = self.straight.get().and_then(|all| all.as_ref().ok()?.first().cloned());
        (straight, self.symmetry.get().copied().flatten(), self.moves.get().cloned().flatten())
    }
}

/// Results that do not depend on the traced joint, computed on first use. The curves of one circuit may share them.
#[derive(Clone, Debug, Default)]
pub(super) struct CircuitResults(pub(super) Rc<SharedResults>);

#[derive(Debug, Default)]
pub(super) struct SharedResults {
    pub output: OnceCell<Option<OutputMotion>>,
    pub worst_transmission_angle: OnceCell<Option<f64>>,
    pub input_torque: OnceCell<Result<Option<InputTorque>, TooManySteps>>,
    /// Whether a function along the circuit that has been asked for is too close to tell.
    pub has_function_too_close: Cell<bool>,
}

/// The input at which a portion of a curve begins: from 0 up to a period where the input turns fully.
pub(super) fn start_input(curve: &TracedCurve, input: f64) -> f64 {
    /// The accuracy of inputs, in degrees or units of length.
    const ROUNDING: f64 = 1e-12;
    match curve.linkage.input() {
        Input::Angle { turns } if curve.circuit.is_full_turn() => within_period(input, 360.0 * f64::from(turns)),
        _ => without_rounding(input, ROUNDING),
    }
}
