//! What a search for a linkage aims at: the target with centroid 0 and size 1, and what the linkage must satisfy.

use super::circuit::Traced;
use super::space::LinkageSpace;
use crate::complex::Complex;
use crate::options::Options;
use crate::target::Target;
use crate::timing::TimedPoints;
use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Similarity, Vector};
use coupler_curves::linkage::{JointId, Linkage};
use coupler_curves::measure::{Measure, MeasureSet};
use coupler_curves::motion::poses;
use coupler_curves::solve::Solver;
use std::sync::Arc;

/// A target and the constraints of a search.
#[derive(Clone)]
pub(super) struct Aim {
    pub target: Target,
    /// The points of the target with centroid 0 and size 1, forward and backward.
    points: [Vec<Complex>; 2],
    pub polyline_length: f64,
    /// The greatest length of a curve or of its portion.
    pub greatest_length: f64,
    /// The input at the points of a timed target, from that at the first.
    pub angles_deg: Option<Vec<f64>>,
    /// The same for where a curve is placed at first.
    pub timed: Option<TimedPoints>,
    pub full_turn: bool,
    max_link: f64,
    /// The corners of the box of the fixed pivots.
    pivots: Option<[Complex; 2]>,
    condition: Option<CompiledExpression>,
    /// The least transmission angle, of linkages that have one, in degrees.
    least_mu_deg: f64,
    /// Whether it has only few of the points of the target.
    pub has_few_points: bool,
    template: Arc<coupler_curves::template::Template>,
}

/// The weight of what is beyond a limit, relative to a distance of all points: it is then beyond by far less than the margin.
pub(super) const WEIGHT: f64 = 30.0;

/// Limits are aimed at with a margin, in sizes of the target, so that they hold exactly in the end.
const MARGIN: f64 = 2e-4;

impl Aim {
    pub fn new(space: &LinkageSpace, target: &Target, options: &Options) -> Aim {
        let placement = target.placement();
        let corner = |x: f64, y: f64| placement.preimage(Complex::new(x, y));
        let forward = target.normalized();
        let timed = target.angles_deg().map(|angles| TimedPoints::new(&forward, angles));
        let backward = forward.iter().rev().copied().collect();
        Aim {
            points: [forward, backward],
            polyline_length: target.polyline_length(),
            greatest_length: target.greatest_length(),
            angles_deg: target.angles_deg().map(|angles| angles.iter().map(|angle| angle - angles[0]).collect()),
            timed,
            full_turn: options.full_turn,
            max_link: options.max_link,
            pivots: options.pivots.map(|b| [corner(b.min.x, b.min.y), corner(b.max.x, b.max.y)]),
            condition: options.condition.as_ref().and_then(|condition| condition.on(&space.template.id)).cloned(),
            least_mu_deg: 0.0,
            has_few_points: false,
            template: space.template.clone(),
            target: target.clone(),
        }
    }

    /// The same with a least transmission angle, of linkages that have one, in degrees.
    pub fn with_least_mu(mut self, least_mu_deg: f64) -> Aim {
        self.least_mu_deg = least_mu_deg;
        self
    }

    /// The same with few of the points of the target, evenly spread from the first to the last; `None` if it has few, or is timed.
    pub fn with_few_points(&self) -> Option<Aim> {
        /// So many tell the curves of linkages apart.
        const FEW: usize = 80;
        let count = self.points[0].len();
        let few = |points: &Vec<Complex>| (0..FEW).map(|k| points[k * (count - 1) / (FEW - 1)]).collect();
        let is_many = count > FEW + FEW / 4 && self.angles_deg.is_none();
        is_many.then(|| Aim {
            points: [few(&self.points[0]), few(&self.points[1])],
            has_few_points: true,
            ..self.clone()
        })
    }

    /// The points in the direction of positions, or against it.
    pub fn points_of(&self, is_reversed: bool) -> &[Complex] {
        &self.points[usize::from(is_reversed)]
    }

    /// The number of points.
    pub fn count(&self) -> f64 {
        self.points[0].len() as f64
    }

    /// By how much a placed linkage is beyond the limits of its links and pivots, in sizes of the target; a number for each, not negative.
    pub fn excesses(&self, traced: &Traced, placed: &Similarity) -> Vec<f64> {
        self.beyond(traced, placed, MARGIN)
    }

    fn beyond(&self, traced: &Traced, placed: &Similarity, margin: f64) -> Vec<f64> {
        let linkage = &traced.linkage;
        let mut all = Vec::new();
        if self.max_link.is_finite() {
            let most = (self.max_link - margin).max(0.5 * self.max_link);
            let scale = placed.scale();
            all.extend(link_lengths(linkage).map(|longest| scale * longest - most));
        }
        if let Some([low, high]) = self.pivots {
            let margin = margin.min(0.25 * (high.re - low.re).min(high.im - low.im));
            for pivot in self.pivots_of(traced) {
                let z = placed.image(pivot);
                all.extend([low.re - z.re, z.re - high.re, low.im - z.im, z.im - high.im].map(|by| by + margin));
            }
        }
        all.iter().map(|excess| excess.max(0.0)).collect()
    }

    /// Whether a placed linkage is within the limits.
    pub fn is_within(&self, traced: &Traced, placed: &Similarity) -> bool {
        self.beyond(traced, placed, 0.0).iter().all(|excess| *excess <= 0.0)
    }

    fn pivots_of(&self, traced: &Traced) -> Vec<Complex> {
        let Some(pass) = traced.circuit.passes.first() else { return Vec::new() };
        let placed = poses(&traced.linkage, pass, &[pass.from.input.value]);
        let pivots = pivots_of(&traced.linkage).map(|joint| placed.point(joint, 0));
        pivots.map(|point| Complex::new(point.x, point.y)).collect()
    }

    /// Whether a linkage satisfies the condition with the curve of a circuit.
    pub fn meets_condition(&self, values: &[f64], traced: &Traced) -> bool {
        if self.condition.is_none() && self.least_mu_deg <= 0.0 {
            return true;
        }
        let names = self.template.parameters.iter().map(|parameter| parameter.name.clone());
        let given: Vec<(String, f64)> = names.zip(values.iter().copied()).collect();
        let Ok(mut family) = Family::single_cell(self.template.clone(), &given, Sampling::Samples(180)) else {
            return false;
        };
        let own = if self.least_mu_deg > 0.0 { MeasureSet::EMPTY.with(Measure::MU_WORST) } else { MeasureSet::EMPTY };
        let requested = self.condition.as_ref().map_or(own, |condition| own | family.measures_in(condition));
        let Some(solved) = Solver::new(&family).measuring(requested).solve(0) else { return false };
        family.filter.clone_from(&self.condition);
        solved.curves.iter().any(|curve| {
            let passes = &solved.circuit(curve).passes;
            let transmits =
                || curve.measure(Measure::MU_WORST).is_none_or(|mu: f64| mu.is_nan() || mu >= self.least_mu_deg);
            curve.joint == traced.joint
                && traced.is_on(passes)
                && transmits()
                && family.keeps(&solved.cell, &curve.values)
        })
    }
}

/// The joints of the link at rest that are on another one.
pub(super) fn pivots_of(linkage: &Linkage) -> impl Iterator<Item = JointId> {
    let ground = linkage.ground();
    let is_pivot = |joint: &JointId| {
        linkage.links.iter().any(|link| !std::ptr::eq(link, ground) && link.position(*joint).is_some())
    };
    ground.joints.iter().map(|(joint, _)| *joint).filter(is_pivot)
}

/// The greatest distance of two joints of a link.
pub(crate) fn longest_link(linkage: &Linkage) -> f64 {
    link_lengths(linkage).fold(0.0, f64::max)
}

/// How many times the longest link is as long as the shortest; links of one joint have no length.
pub(super) fn link_ratio(linkage: &Linkage) -> f64 {
    let lengths = || link_lengths(linkage).filter(|length| *length > 0.0);
    let least = lengths().fold(f64::INFINITY, f64::min);
    lengths().fold(1.0, |most: f64, length| most.max(length / least))
}

/// The greatest distance of two joints of each link. A joint of the frame that no other link has only gives a direction, at any distance.
fn link_lengths(linkage: &Linkage) -> impl Iterator<Item = f64> {
    let pivots: Vec<JointId> = pivots_of(linkage).collect();
    linkage.links.iter().map(move |link| {
        let is_ground = std::ptr::eq(link, linkage.ground());
        let joints = link.joints.iter().filter(|(joint, _)| !is_ground || pivots.contains(joint));
        let places: Vec<&Vector> = joints.map(|(_, place)| place).collect();
        let pairs = places.iter().enumerate().flat_map(|(k, a)| places[k + 1..].iter().map(move |b| (a, b)));
        pairs.map(|(a, b)| (*b - *a).norm_squared()).fold(0.0, f64::max).sqrt()
    })
}
