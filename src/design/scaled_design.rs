//! Designs: trials scaled to the required length or size.

use super::kind::{DrivenLinkage, LinkageKind};
use super::requirements::Requirements;
use super::search::FINE_SAMPLES;
use super::stroke::Stroke;
use super::trial::{Performance, Trial, first_traced_curve, performance};
use coupler_curves::family::{Family, StraightCriterion};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::FourBar;
use coupler_curves::measure::{Measure, StraightPortion};
use coupler_curves::motion::Sampling;
use coupler_curves::solve::{SolvedCell, Solver};

/// How the proportions of a linkage were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProportionOrigin {
    /// By search.
    Search,
    /// By [`LinkageKind::closed_condition`].
    ClosedCondition,
}

/// A linkage that meets the requirements, in the unit of the required straight length or size. If neither is given, the
/// unit is Natesan's: the crank of Evans's and Hoeken's linkages, the coupler of the others.
#[derive(Clone, Debug)]
pub struct Design {
    /// The linkage and its driver.
    pub driven_linkage: DrivenLinkage,
    /// How its proportions were found.
    pub origin: ProportionOrigin,
    /// A family of this linkage alone, with the criterion of its straight portion.
    pub family: Family,
    /// Its motion and its measures.
    pub solved_cell: SolvedCell,
    /// The tolerance: the greatest width of the strip of its straight portion, over its length.
    pub tolerance: f64,
    /// Its straight portion; inputs are those of the template.
    pub straight: StraightPortion,
    /// Its size, transmission angle and stroke.
    pub performance: Performance,
    /// The rotation of the driven link in the straight stroke, in degrees.
    pub swing: f64,
    /// The ratio of the greatest to the least speed of the coupler point in the straight stroke, at constant speed of
    /// the driven link.
    pub speed_ratio: f64,
    /// The positions of all joints a third into the straight stroke, where no joint of a symmetric linkage hides
    /// another; `None` if the stroke has no sample.
    pub pose: Option<Vec<Point>>,
    /// The number of crunodes of its curve.
    pub crunode_count: usize,
    /// Grashof's class.
    pub class: &'static str,
}

impl Design {
    /// Scales a trial to the requirements; `None` if it cannot be assembled, which does not happen to a trial.
    pub(super) fn from_trial(origin: ProportionOrigin, trial: &Trial, requirements: &Requirements) -> Option<Design> {
        let kind = trial.driven_linkage.kind;
        let template = kind.template()?;
        let scale = match (requirements.length, requirements.size) {
            (Some(length), _) => length / trial.length,
            (None, Some(size)) => size / trial.performance.size,
            (None, None) => 1.0,
        };
        let scaled =
            |name: &str, value: f64| if LinkageKind::is_length_parameter(name) { value * scale } else { value };
        let named = template
            .parameters
            .iter()
            .map(|parameter| parameter.name.clone())
            .zip(kind.template_values(&trial.proportions));
        let given: Vec<(String, f64)> = named.map(|(name, value)| (name.clone(), scaled(&name, value))).collect();
        let mut family = Family::single_cell(template, &given, Sampling::Samples(FINE_SAMPLES)).ok()?;
        family.straight = StraightCriterion::Tolerance(trial.tolerance);
        let solved = Solver::new(&family).solve(0)?;
        let curve = first_traced_curve(&solved.linkage, &solved.motion, trial.tolerance)?;
        let straight = curve.straight()?.clone();
        let figures = performance(trial.driven_linkage, &curve, &straight)?;
        let stroke = Stroke::from_portion(&curve, &straight)?;
        let third = stroke.sample_indices.get(stroke.sample_indices.len() / 3);
        let joints = solved.linkage.joint_ids();
        let pose = third.map(|&k| joints.map(|joint| curve.circuit.positions.point(joint, k)).collect());
        let crunode_count = curve.measure(Measure::CRUNODES).unwrap_or(0.0) as usize;
        let class = FourBar::from_linkage(&solved.linkage)?.class().name();
        Some(Design {
            driven_linkage: trial.driven_linkage,
            origin,
            tolerance: trial.tolerance,
            swing: stroke.swing(figures.input_link),
            speed_ratio: stroke.speed_ratio(figures.input_link),
            straight,
            pose,
            performance: figures,
            crunode_count,
            class,
            family,
            solved_cell: solved,
        })
    }

    /// The value of a parameter of its linkage, in the unit of the requirements.
    pub fn parameter(&self, name: &str) -> f64 {
        self.family.value(name, &self.solved_cell.cell)
    }

    /// The ratio of the time of the straight stroke to that of the return, at constant speed of the driven link; `None`
    /// if a rocker drives, which retraces its motion.
    pub fn time_ratio(&self) -> Option<f64> {
        self.performance.turn_fraction.map(|turn| turn / (1.0 - turn))
    }
}
