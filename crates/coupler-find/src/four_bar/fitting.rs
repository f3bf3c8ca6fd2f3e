//! What a search fits linkages to: the target with centroid 0 and size 1, and the constraints.

use crate::complex::{Complex, closed_length};
use crate::four_bar::curve_length::LengthLimit;
use crate::four_bar::index::SAMPLES;
use crate::four_bar::limits::Limits;
use crate::four_bar::matching::{Matching, nearest_samples};
use crate::four_bar::parameters::Parameters;
use crate::four_bar::pose::Pose;
use crate::four_bar::refinement::Refinement;
use crate::four_bar::timing::Timing;
use crate::options::Options;
use crate::shape::spectrum::directions;
use crate::target::{PathKind, Target};
use crate::timing::TimedPoints;

/// A target with the constraints of a search.
pub(crate) struct Fitting {
    pub target: Target,
    pub limits: Limits,
    /// The points of the target with centroid 0 and size 1, the length of their polyline, and that without noise.
    pub points: Vec<Complex>,
    polyline_length: f64,
    pub smooth_length: f64,
    /// The greatest length of a curve or of its portion.
    greatest_length: f64,
    /// The inputs of the points, forward and backward, if they are timed; and some points for where a linkage is placed at first.
    pub timing: Option<([Timing; 2], TimedPoints)>,
    /// The directions of the cranks of sampled circuits.
    directions: Vec<Complex>,
}

/// A linkage with its points that are matched with those of the target.
pub(crate) struct Fit {
    pub linkage: Parameters,
    pub matching: Matching,
    pub length_ratio: f64,
}

impl Fitting {
    pub fn new(target: &Target, options: &Options) -> Fitting {
        let placement = target.placement();
        let corner = |x: f64, y: f64| placement.preimage(Complex::new(x, y));
        let pivots = options.pivots.map(|b| [corner(b.min.x, b.min.y), corner(b.max.x, b.max.y)]);
        let directions = directions(SAMPLES);
        let greatest_length = target.greatest_length();
        // What is not refined is not shortened either.
        let has_limit = options.refine && target.kind() == PathKind::Closed;
        let limits = Limits {
            length: has_limit.then(|| LengthLimit::new(greatest_length, &directions)),
            full_turn: options.full_turn,
            max_link: options.max_link,
            pivots,
            condition: options.condition.clone(),
            placement,
        };
        let points = target.normalized();
        let timing = |angles_deg: &[f64]| (Timing::both(angles_deg), TimedPoints::new(&points, angles_deg));
        Fitting {
            polyline_length: target.polyline_length(),
            smooth_length: target.smooth_length(),
            greatest_length,
            timing: target.angles_deg().map(timing),
            directions,
            target: target.clone(),
            limits,
            points,
        }
    }

    /// Whether a linkage meets the condition on one of its circuits.
    pub fn may_begin(&self, linkage: &Parameters) -> bool {
        let circuits = linkage.circuits(&self.directions);
        circuits.iter().any(|circuit| circuit.first().is_some_and(|pose| self.limits.meets_condition(linkage, pose)))
    }

    /// Begins a refinement from a linkage near the limits, on the circuit and in the direction that are nearest to the target.
    pub fn begin(&self, linkage: &Parameters) -> Option<Refinement> {
        let allowed = |linkage: &Parameters| self.limits.nearest(linkage, linkage.frame >= linkage.crank);
        let refinement = match &self.timing {
            None => {
                let linkage = allowed(linkage)?;
                let poses = self.nearest_samples(&linkage)?;
                Refinement::new(self.shortened(linkage, &poses[0])?, &poses, &self.points, None)?
            }
            Some((both, target)) => {
                let (timing, linkage, poses) = Timing::placed_best(both, target, linkage, &self.directions)?;
                let linkage = self.shortened(allowed(&linkage)?, &poses[0])?;
                Refinement::new(linkage, &poses, &self.points, Some(timing))?
            }
        };
        Some(refinement).filter(|refinement| self.limits.meets_condition(&refinement.linkage, &refinement.poses[0]))
    }

    /// The linkage near another one whose curve on the circuit of a pose is not too long.
    fn shortened(&self, linkage: Parameters, pose: &Pose) -> Option<Parameters> {
        let shortened = self.limits.length.as_ref().and_then(|limit| limit.shortened(&linkage, pose));
        match shortened {
            Some(shortened) => self.limits.nearest(&shortened, shortened.frame >= shortened.crank),
            None => Some(linkage),
        }
    }

    /// The samples of a linkage that are matched with the target, on the circuit and in the direction that are nearest to it.
    fn nearest_samples(&self, linkage: &Parameters) -> Option<Vec<Pose>> {
        let mut best: Option<(f64, Vec<Pose>)> = None;
        for mut circuit in linkage.circuits(&self.directions) {
            for _ in 0..2 {
                let (sum, poses) = nearest_samples(linkage, &circuit, &self.points)?;
                if best.as_ref().is_none_or(|(least, _)| sum < *least) {
                    best = Some((sum, poses));
                }
                circuit.reverse();
            }
        }
        best.map(|(_, poses)| poses)
    }

    /// The matching of the target with the circuit of a refined linkage, in the direction that is nearer.
    pub fn matching(&self, refinement: &Refinement) -> Option<Matching> {
        let Refinement { linkage, poses, .. } = refinement;
        if let Some(timing) = refinement.timing() {
            return timing.matching(linkage, poses, &self.points);
        }
        let mut circuit = self.circuit_of(linkage, &poses[0]);
        let forward = Matching::new(linkage, &circuit, &self.points)?;
        circuit.reverse();
        let backward = Matching::new(linkage, &circuit, &self.points)?;
        Some(if backward.sum < forward.sum { backward } else { forward })
    }

    pub fn has_valid_length(&self, refinement: &Refinement) -> bool {
        match self.target.kind() {
            PathKind::Closed => self.whole_length(refinement) <= self.greatest_length,
            PathKind::Open => true,
            PathKind::Part => {
                let matching = self.matching(refinement);
                matching.is_some_and(|matching| matching.portion_length <= self.greatest_length)
            }
        }
    }

    /// The samples of the circuit that a pose is on.
    pub fn circuit_of(&self, linkage: &Parameters, pose: &Pose) -> Vec<Pose> {
        linkage.circuit_of(pose, &self.directions)
    }

    /// The length of the whole curve.
    fn whole_length(&self, Refinement { linkage, poses, .. }: &Refinement) -> f64 {
        closed_length(&linkage.curve(&self.circuit_of(linkage, &poses[0])))
    }

    /// How a refined linkage fits the target; `None` if it is not valid.
    pub fn fit(&self, refinement: &Refinement) -> Option<Fit> {
        let linkage = refinement.linkage;
        if !self.limits.are_satisfied(&linkage) {
            return None;
        }
        let matching = self.matching(refinement)?;
        let length = match self.target.kind() {
            PathKind::Closed => self.whole_length(refinement),
            PathKind::Open | PathKind::Part => matching.portion_length,
        };
        let length_ratio = length / self.polyline_length;
        (length <= self.greatest_length).then_some(Fit { linkage, matching, length_ratio })
    }
}
