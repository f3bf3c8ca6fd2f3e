use super::kind::{Arrangement, Kind};
use super::search::SAMPLES;
use super::stroke::Stroke;
use super::trial::{Figures, Trial, figures, number, subject};
use super::wishes::Wishes;
use coupler_curves::family::{Family, Straight};
use coupler_curves::geometry::Point;
use coupler_curves::linkage::FourBar;
use coupler_curves::measure::Portion;
use coupler_curves::motion::{Sampler, Sampling};
use coupler_curves::solve;
use coupler_curves::solve::Solved;

/// How a linkage's proportions were come by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// By search.
    Search,
    /// By [`Kind::condition`].
    Condition,
}

/// A linkage that meets the wishes, in their unit: that of the straight length or the size; where neither is given, the
/// thesis's, whose unit is the crank of Evans's and Hoeken's linkages and the coupler of the others.
#[derive(Clone, Debug)]
pub struct Design {
    /// The linkage and what moves it.
    pub arrangement: Arrangement,
    /// How its proportions were come by.
    pub origin: Origin,
    /// A family of it alone, which asks for its straight portion.
    pub family: Family,
    /// Its motion and its measures.
    pub solved: Solved,
    /// Its tolerance: no wider than this part of its length is the strip of its straight portion.
    pub tolerance: f64,
    /// Its straight portion; the input is the template's own.
    pub straight: Portion,
    /// Its size, transmission angle and stroke.
    pub figures: Figures,
    /// How far the driven link goes in the straight stroke, in degrees.
    pub swing: f64,
    /// The coupler point's greatest speed over its least in the straight stroke, the driven link turning evenly.
    pub unevenness: f64,
    /// Where all joints are a third into the straight stroke, where none of a symmetric linkage's hides another; `None` where
    /// the stroke is too short to have a sample in it.
    pub pose: Option<Vec<Point>>,
    /// How often its curve crosses itself.
    pub double_points: usize,
    /// Grashof's class.
    pub class: &'static str,
}

impl Design {
    /// A trial brought to size; `None` for one that does not assemble, which no trial is.
    pub(super) fn of(origin: Origin, trial: &Trial, wishes: &Wishes, sampler: &Sampler) -> Option<Design> {
        let kind = trial.arrangement.kind;
        let template = kind.template()?;
        let scale = match (wishes.length, wishes.size) {
            (Some(length), _) => length / trial.length,
            (None, Some(size)) => size / trial.figures.size,
            (None, None) => 1.0,
        };
        let scaled = |name: &str, value: f64| if Kind::is_length(name) { value * scale } else { value };
        let named = template.parameters.iter().map(|parameter| parameter.name.clone()).zip(kind.values(&trial.of));
        let given: Vec<(String, f64)> = named.map(|(name, value)| (name.clone(), scaled(&name, value))).collect();
        let mut family = Family::single(template, &given, Sampling::Samples(SAMPLES)).ok()?;
        family.straight = Straight::Tolerance(trial.tolerance);
        let solved = solve::solve(&family, sampler, 0)?;
        let measured = subject(&solved.linkage, &solved.motion, trial.tolerance)?;
        let straight = measured.straight()?.clone();
        let figures = figures(trial.arrangement, &measured, &straight)?;
        let stroke = Stroke::of(&measured, &straight)?;
        let third = stroke.samples.get(stroke.samples.len() / 3);
        let joints = 0..solved.linkage.joints.len();
        let pose = third.map(|&k| joints.map(|joint| measured.circuit.places.point(joint, k)).collect());
        let double_points = number(&measured, "crunodes").unwrap_or(0.0) as usize;
        let class = FourBar::of(&solved.linkage)?.class().name();
        Some(Design {
            arrangement: trial.arrangement,
            origin,
            tolerance: trial.tolerance,
            swing: stroke.swing(figures.driven),
            unevenness: stroke.unevenness(figures.driven),
            straight,
            pose,
            figures,
            double_points,
            class,
            family,
            solved,
        })
    }

    /// The value of a parameter of its linkage, in the wishes' unit.
    pub fn value(&self, name: &str) -> f64 {
        self.family.value(name, &self.solved.cell)
    }

    /// The time of the straight stroke over that of the way back, the driven link turning evenly; `None` where a rocker
    /// drives, which goes back as it came.
    pub fn time_ratio(&self) -> Option<f64> {
        self.figures.turn.map(|turn| turn / (1.0 - turn))
    }
}
