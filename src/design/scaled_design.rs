use super::kind::{DrivenLinkage, LinkageKind};
use super::requirements::Requirements;
use super::search::FINE_SAMPLES;
use super::stroke::Stroke;
use super::trial::{Performance, Trial, first_traced_curve, number_value, performance};
use coupler_curves::family::{Family, StraightCriterion};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::FourBar;
use coupler_curves::measure::StraightPortion;
use coupler_curves::motion::{Sampler, Sampling};
use coupler_curves::solve;
use coupler_curves::solve::SolvedCell;

/// How a linkage's proportions were come by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProportionOrigin {
    /// By search.
    Search,
    /// By [`LinkageKind::closed_condition`].
    ClosedCondition,
}

/// A linkage that meets the wishes, in their unit: that of the straight length or the size; where neither is given, the
/// thesis's, whose unit is the crank of Evans's and Hoeken's linkages and the coupler of the others.
#[derive(Clone, Debug)]
pub struct Design {
    /// The linkage and what moves it.
    pub driven_linkage: DrivenLinkage,
    /// How its proportions were come by.
    pub origin: ProportionOrigin,
    /// A family of it alone, which asks for its straight portion.
    pub family: Family,
    /// Its motion and its measures.
    pub solved_cell: SolvedCell,
    /// Its tolerance: no wider than this part of its length is the strip of its straight portion.
    pub tolerance: f64,
    /// Its straight portion; the input is the template's own.
    pub straight: StraightPortion,
    /// Its size, transmission angle and stroke.
    pub performance: Performance,
    /// How far the driven link goes in the straight stroke, in degrees.
    pub swing: f64,
    /// The coupler point's greatest speed over its least in the straight stroke, the driven link turning evenly.
    pub speed_ratio: f64,
    /// Where all joints are a third into the straight stroke, where none of a symmetric linkage's hides another; `None` where
    /// the stroke is too short to have a sample in it.
    pub pose: Option<Vec<Point>>,
    /// How often its curve crosses itself.
    pub crunode_count: usize,
    /// Grashof's class.
    pub class: &'static str,
}

impl Design {
    /// A trial brought to size; `None` for one that does not assemble, which no trial is.
    pub(super) fn from_trial(
        origin: ProportionOrigin,
        trial: &Trial,
        wishes: &Requirements,
        sampler: &Sampler,
    ) -> Option<Design> {
        let kind = trial.driven_linkage.kind;
        let template = kind.template()?;
        let scale = match (wishes.length, wishes.size) {
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
        let solved = solve::solve_cell(&family, sampler, 0)?;
        let measured = first_traced_curve(&solved.linkage, &solved.motion, trial.tolerance)?;
        let straight = measured.straight()?.clone();
        let figures = performance(trial.driven_linkage, &measured, &straight)?;
        let stroke = Stroke::from_portion(&measured, &straight)?;
        let third = stroke.sample_indices.get(stroke.sample_indices.len() / 3);
        let joints = solved.linkage.joint_ids();
        let pose = third.map(|&k| joints.map(|joint| measured.circuit.positions.point(joint, k)).collect());
        let double_points = number_value(&measured, "crunodes").unwrap_or(0.0) as usize;
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
            crunode_count: double_points,
            class,
            family,
            solved_cell: solved,
        })
    }

    /// The value of a parameter of its linkage, in the wishes' unit.
    pub fn parameter(&self, name: &str) -> f64 {
        self.family.value(name, &self.solved_cell.cell)
    }

    /// The time of the straight stroke over that of the way back, the driven link turning evenly; `None` where a rocker
    /// drives, which goes back as it came.
    pub fn time_ratio(&self) -> Option<f64> {
        self.performance.turn_fraction.map(|turn| turn / (1.0 - turn))
    }
}
