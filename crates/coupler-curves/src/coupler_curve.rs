//! The coupler curve of a four-bar, from its lengths to its points, measures and exports.

use crate::catalogue;
use crate::exchange::SelectedCurve;
use crate::family::{Family, ParameterErrors, Sampling};
use crate::geometry::Point;
use crate::linkage::{FourBar, Linkage};
use crate::measure::{self, Measure, MeasureKey, MeasureValue, StraightPortion, Value};
use crate::motion::{AssemblyError, Circuit};
use crate::solve::{MeasuredCurve, SolvedCell, Solver};

/// A coupler curve of a four-bar on one circuit, solved at 360 samples and measured.
///
/// Lengths are in the unit of the four-bar's links. The crank's pivot is the origin, the rocker's is on the positive
/// x-axis, and the input is the crank's angle from that axis, counter-clockwise.
///
/// ```
/// use coupler_curves::measure::Measure;
/// use coupler_curves::{FourBar, FourBarClass};
///
/// // Hoeken's linkage traces a nearly straight line by a point beyond the rocker pin.
/// let four_bar = FourBar { frame: 2.0, crank: 1.0, coupler: 2.5, rocker: 2.5 };
/// assert_eq!(four_bar.class(), FourBarClass::CrankRocker);
///
/// let curve = four_bar.coupler_curve(5.0, 0.0)?;
/// assert_eq!(curve.points().count(), 360);
/// assert!(curve.circuit().is_closed);
///
/// let straight = curve.straight_portion();
/// assert!(straight.is_some_and(|straight| straight.length > 1.1 && straight.deviation < 0.001 * straight.length));
///
/// assert_eq!(curve.measure(Measure::STRAIGHT_LENGTH), straight.map(|straight| straight.length));
/// assert_eq!(curve.measure(Measure::CLASS), Some("crank-rocker"));
///
/// // The crank pin's circle has no straight portion.
/// assert!(four_bar.coupler_curve(0.0, 0.0)?.straight_portion().is_none());
/// # Ok::<(), coupler_curves::CurveError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CouplerCurve {
    family: Family,
    source: String,
    /// The solved linkage with this curve only.
    solved: SolvedCell,
}

/// Why a four-bar has no coupler curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// A length is not positive and finite, or the coupler point is not finite.
    #[error(transparent)]
    Parameters(#[from] ParameterErrors),
    /// The links cannot be assembled.
    #[error(transparent)]
    Assembly(#[from] AssemblyError),
}

impl FourBar {
    /// The curve of a coupler point on the first circuit: the one that starts on branch 1, with the rocker pin to the
    /// left of the line from crank pin to rocker pivot.
    ///
    /// The point is `along` the coupler from the crank pin towards the rocker pin, and `across` it to the left, in the
    /// unit of the links.
    ///
    /// # Errors
    /// A length that is not positive, a value that is not finite, or links that cannot be assembled.
    pub fn coupler_curve(self, along: f64, across: f64) -> Result<CouplerCurve, CurveError> {
        // There is at least one curve where there is no error.
        self.coupler_curves(along, across).map(|mut curves| curves.swap_remove(0))
    }

    /// The curves of a coupler point on every circuit, at least one: those that start on branch 1 first, then by least
    /// input.
    ///
    /// # Errors
    /// As [`FourBar::coupler_curve`].
    pub fn coupler_curves(self, along: f64, across: f64) -> Result<Vec<CouplerCurve>, CurveError> {
        let FourBar { frame, crank, coupler, rocker } = self;
        let values = [
            ("frame", frame),
            ("crank", crank),
            ("coupler", coupler),
            ("rocker", rocker),
            ("along", along),
            ("across", across),
        ];
        let values = values.map(|(name, value)| (name.to_owned(), value));
        let template = catalogue::find("four-bar").expect("the catalogue has the four-bar");
        let source = template.source_line();
        let family = Family::single_cell(template, &values, Sampling::Samples(360))?;
        let solved = Solver::new(&family).solve(0).expect("a valid cell makes a linkage");
        if let Some(error) = &solved.motion.assembly_error {
            return Err(error.clone().into());
        }
        let curves = solved.curves.iter().map(|curve| CouplerCurve {
            family: family.clone(),
            source: source.clone(),
            solved: solved.with_curve(curve),
        });
        Ok(curves.collect())
    }
}

impl CouplerCurve {
    /// Its points in the order of the samples; a closed curve does not repeat the first.
    pub fn points(&self) -> impl Iterator<Item = Point> {
        self.circuit().points(self.measured().joint)
    }

    /// The crank's angle at each point, in degrees, continuous along the circuit.
    pub fn inputs_deg(&self) -> &[f64] {
        &self.circuit().inputs
    }

    /// The circuit it is traced on: passes, limit positions, positions of all joints.
    pub fn circuit(&self) -> &Circuit {
        self.solved.circuit(self.measured())
    }

    /// The linkage, joint by joint.
    pub fn linkage(&self) -> &Linkage {
        &self.solved.linkage
    }

    /// Its longest straight portion: within a strip no wider than 1/1000 of the portion's length. `None` if it has none, as a circle.
    pub fn straight_portion(&self) -> Option<&StraightPortion> {
        self.measured().straight.as_ref()
    }

    /// A measure of it or of its linkage; `None` where it does not apply.
    pub fn measure<T: MeasureValue>(&self, key: MeasureKey<T>) -> Option<T> {
        self.measured().measure(key)
    }

    /// Every measure with its value.
    pub fn measures(&self) -> impl Iterator<Item = (&'static Measure, Value)> {
        measure::ALL.iter().zip(self.measured().values.iter().copied())
    }

    /// The curve with its family and source, as the exchange formats and plates need it.
    pub fn selected(&self) -> SelectedCurve<'_> {
        SelectedCurve::new(&self.family, &self.source, self.solved.clone())
    }

    fn measured(&self) -> &MeasuredCurve {
        &self.solved.curves[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::FourBarClass;

    #[test]
    fn a_double_rocker_has_a_curve_on_each_of_two_circuits() {
        let four_bar = FourBar { frame: 2.0, crank: 2.59, coupler: 1.0, rocker: 2.59 };
        assert_eq!(four_bar.class(), FourBarClass::DoubleRocker);
        let curves = four_bar.coupler_curves(0.5, 0.0).unwrap();
        assert_eq!(curves.len(), 2);
        assert!(curves[0].points().next() != curves[1].points().next());
    }

    #[test]
    fn impossible_four_bars_are_typed_errors() {
        let short = FourBar { frame: 10.0, crank: 1.0, coupler: 2.0, rocker: 3.0 };
        let error = short.coupler_curve(1.0, 0.0).unwrap_err();
        assert!(matches!(error, CurveError::Assembly(AssemblyError::BaseTooLong { .. })), "{error}");
        let negative = FourBar { frame: 4.0, crank: -1.0, coupler: 3.0, rocker: 3.5 };
        let error = negative.coupler_curve(f64::NAN, 0.0).unwrap_err();
        let CurveError::Parameters(errors) = error else { panic!("{error}") };
        assert_eq!(errors.iter().count(), 2, "{errors}");
    }
}
