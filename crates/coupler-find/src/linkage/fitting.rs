//! What a search for the dimensions of a linkage does with one sample, or with one refinement: each for itself, so that many can be done at once.

use super::aim::Aim;
use super::measured::Measured;
use super::refinement::{FINAL_ROUNDS, LinkageRefinement};
use super::sampled_space::{OnCircuit, SampledSpace};
use super::samples::{SampleCurve, SampleIndex, SampleShape};
use super::space::LinkageSpace;
use super::timed;

use crate::complex::Complex;
use crate::curve::fit::CurveFit;
use crate::curve::index::{CurveLookup, CurveShape};
use crate::curve_fit_options::CurveFitOptions;
use crate::deviation::Deviation;
use crate::matching::squares;
use crate::options::Options;
use crate::query::Query;
use crate::scatter::Scatter;
use crate::shape::spectrum::Transform;
use crate::target::{PathKind, Target};
use coupler_curves::geometry::Similarity;

/// A target that linkages with free parameters are fitted to.
pub(super) struct LinkageFitting {
    /// Its number among those of the search, from 0.
    number: usize,
    pub sampled: SampledSpace,
    aim: Aim,
    /// The same with few points of the target, for the beginning of a search.
    rough: Option<Aim>,
    query: Query,
    transform: Transform,
}

/// Dimensions of a linkage, and how the curve fits the target.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LinkageFit {
    /// The values of the parameters, in the unit of the target if the linkage is scalable.
    pub values: Vec<f64>,
    /// The numbers of the traced joint and of the circuit, from 1.
    pub curve: [usize; 2],
    /// Where the curve is on the target, and how near.
    pub fit: CurveFit,
    /// The branch at the first point of the target: the side of the first two-valued joint, 1 left or -1 right.
    pub branch: i8,
    /// The input at the first and at the last point of the target: degrees, or a length.
    pub inputs: [f64; 2],
}

/// The least part of a curve that may be like an open target before it is refined.
const LEAST_PORTION: f64 = 0.05;

impl LinkageFitting {
    /// The condition of the options must be one of the linkage's.
    pub fn new(number: usize, space: &LinkageSpace, target: &Target, options: &Options) -> LinkageFitting {
        LinkageFitting {
            number,
            sampled: SampledSpace::new(space, options.full_turn),
            aim: Aim::new(space, target, options),
            rough: None,
            query: Query::new(target.kind(), &target.normalized()),
            transform: Transform::new(),
        }
    }

    /// The same for linkages with a least transmission angle, in degrees, beginning with few points of the target.
    pub fn beginning_roughly(self, least_mu_deg: f64) -> LinkageFitting {
        let aim = self.aim.with_least_mu(least_mu_deg);
        LinkageFitting { rough: aim.with_few_points(), aim, ..self }
    }

    /// What a refinement begins with.
    fn first_aim(&self) -> &Aim {
        self.rough.as_ref().unwrap_or(&self.aim)
    }

    /// What a refinement aims at.
    fn aim_of(&self, refinement: &LinkageRefinement) -> &Aim {
        if refinement.has_few_points { self.first_aim() } else { &self.aim }
    }

    /// A refinement on all points of the target; `None` if it cannot be matched with them.
    pub fn on_all_points(&self, refinement: LinkageRefinement) -> Option<LinkageRefinement> {
        if refinement.has_few_points { refinement.on_all_points(&self.aim) } else { Some(refinement) }
    }

    /// The linkage and its parameters.
    pub fn space(&self) -> &LinkageSpace {
        &self.sampled.space
    }

    /// The curves of a parameter set that satisfy what does not depend on their place, without the condition: it may take long.
    pub fn curves(&self, sample: usize) -> Vec<(SampleCurve, SampleShape)> {
        let Some(values) = self.space().sample(sample) else { return Vec::new() };
        let mut found = Vec::new();
        for (OnCircuit { trace, circuit, traced }, points) in self.sampled.curves(&values) {
            let shape = match &self.aim.angles_deg {
                None => {
                    let is_open = !traced.circuit.is_closed;
                    points.map(|points| SampleShape::Free(CurveShape::of_polyline(&self.transform, &points, is_open)))
                }
                Some(_) => timed::best(&self.aim, &traced).map(|(_, place)| SampleShape::Timed(place.sum)),
            };
            let [linkage, sample, trace, circuit] = [self.number, sample, trace, circuit].map(|number| number as u32);
            let curve = SampleCurve { linkage, sample, trace, circuit };
            found.extend(shape.map(|shape| (curve, shape)));
        }
        found
    }

    /// The curves of an index that are most like the target, the likeliest first, at most so many.
    pub fn most_alike(&self, index: &SampleIndex, most: usize) -> Vec<SampleCurve> {
        if self.aim.angles_deg.is_some() {
            let mut sums = index.sums.clone();
            sums.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            return sums.iter().take(most).map(|(_, number)| index.curves[*number]).collect();
        }
        let options = CurveFitOptions { least_portion: LEAST_PORTION, ..CurveFitOptions::default() };
        let mut lookup = CurveLookup::new(&self.aim.target, options, most);
        lookup.compare(&index.shapes, 0..index.shapes.len());
        // The points of samples are not kept for a closer comparison.
        lookup.found().take(most).map(|(_, number)| index.curves[number]).collect()
    }

    /// Begins to refine a curve of a sample. `None` if it is not like the target anywhere, or does not satisfy the condition.
    pub fn begin(&self, curve: SampleCurve) -> Option<LinkageRefinement> {
        let values = self.space().sample(curve.sample as usize)?;
        let at = (curve.trace as usize, curve.circuit as usize);
        let mut curves = self.sampled.curves(&values).into_iter();
        let (OnCircuit { trace, traced, .. }, points) = curves.find(|(on, _)| (on.trace, on.circuit) == at)?;
        if !self.aim.meets_condition(&values, &traced) {
            return None;
        }
        if self.aim.angles_deg.is_some() {
            let (start, place) = timed::best(&self.aim, &traced)?;
            let followed = (place.is_reversed, start);
            return LinkageRefinement::timed(&self.aim, values, (trace, traced), place.placed, followed);
        }
        let placed = self.placed(&points?)?;
        LinkageRefinement::new(self.first_aim(), values, (trace, traced), placed)
    }

    /// Begins with a linkage that is placed on the target with its centroid at 0 and its size 1, on the circuit and with the traced joint whose curve is
    /// nearest to it.
    pub fn begin_at(&self, values: &[f64], placed: Similarity) -> Option<LinkageRefinement> {
        let curves = self.sampled.traced(values).into_iter().filter_map(|OnCircuit { trace, traced, .. }| {
            let may_begin = self.aim.meets_condition(values, &traced);
            may_begin.then(|| LinkageRefinement::new(self.first_aim(), values.to_vec(), (trace, traced), placed))?
        });
        curves.min_by(|a, b| a.mean_square().total_cmp(&b.mean_square()))
    }

    /// Begins again from dimensions near others, at random, with a number that chooses them.
    pub fn begin_near(&self, from: &LinkageRefinement, seed: u64, spread: f64) -> Option<LinkageRefinement> {
        let values = self.space().near(&from.values, &mut Scatter::new(seed), spread);
        let linkage = self.space().template().linkage(&values).ok().filter(|_| self.space().are_valid(&values))?;
        let state = &from.state;
        let traced = state.traced.followed(linkage).filter(|traced| !self.aim.full_turn || traced.is_full_turn())?;
        if !self.aim.meets_condition(&values, &traced) {
            return None;
        }
        match state.start {
            Some(start) => LinkageRefinement::timed(
                &self.aim,
                values,
                (from.trace, traced),
                state.placed,
                (from.is_reversed, start),
            ),
            None => LinkageRefinement::new(self.first_aim(), values, (from.trace, traced), state.placed),
        }
    }

    /// Moves the curve of a refinement without changing the linkage.
    pub fn place(&self, refinement: &mut LinkageRefinement, steps: usize) {
        refinement.place(self.space(), self.aim_of(refinement), steps);
    }

    /// Takes some steps of a refinement.
    pub fn advance(&self, refinement: &mut LinkageRefinement, steps: usize) {
        let aim = self.aim_of(refinement);
        refinement.advance(self.space(), aim, steps);
        refinement.match_again(aim, 2 * FINAL_ROUNDS / 3);
    }

    /// Whether the curve has no long detours from a closed target, and the portion none from a part.
    pub fn has_valid_length(&self, refinement: &LinkageRefinement) -> bool {
        let measured = Measured::new(&refinement.state.traced);
        measured.is_some_and(|measured| self.length(&measured, refinement) <= self.aim.greatest_length)
    }

    /// How the curve of a refinement fits the target, with its size in the dimensions if it is scalable. `None` if it does not satisfy
    /// what is asked of it.
    pub fn fit(&self, refinement: &LinkageRefinement) -> Option<LinkageFit> {
        let Aim { target, full_turn, .. } = &self.aim;
        let size = target.size();
        let mut refinement = refinement.clone();
        let mut placed = refinement.state.placed;
        if self.space().is_scalable {
            let scale = placed.scale() * size;
            refinement.values = self.space().scaled(&refinement.values, scale);
            placed.factor /= scale;
        }
        let values = &refinement.values;
        let circuits = self.sampled.traced(values);
        let linkage = self.space().template().linkage(values).ok().filter(|_| self.space().are_valid(values))?;
        let own = &refinement.state.traced;
        let followed = if own.is_followed() { own.clone() } else { own.followed(linkage)? };
        let OnCircuit { circuit, traced, .. } = circuits.into_iter().find(|OnCircuit { trace, traced, .. }| {
            *trace == refinement.trace && followed.is_on(&traced.circuit.passes)
        })?;
        refinement.state = match refinement.state.start {
            Some(start) => self.aim.timed_state(traced, placed, refinement.is_reversed, start)?,
            None => {
                let (is_reversed, state) = self.aim.matched_either_way(&traced, placed, FINAL_ROUNDS)?;
                refinement.is_reversed = is_reversed;
                state
            }
        };
        let state = &refinement.state;
        let traced = &state.traced;
        let measured = Measured::new(traced)?;
        let own_length = self.length(&measured, &refinement);
        let is_valid = self.aim.is_within(traced, &placed)
            && (!full_turn || traced.is_full_turn())
            && self.aim.meets_condition(values, traced)
            && own_length <= self.aim.greatest_length;
        if !is_valid {
            return None;
        }
        let is_timed = state.start.is_some();
        let positions = [0, state.blocks.len() - 1].map(|k| state.blocks[k].foot.position);
        // Along the target: forward.
        let positions = if refinement.is_reversed && !is_timed { [positions[1], positions[0]] } else { positions };
        let places = positions.map(|position| match state.start {
            Some((pass, _)) => traced.position_of_input(pass, position),
            None => position,
        });
        let inputs = if is_timed { positions } else { places.map(|position| traced.input(position)) };
        let legs = if traced.circuit.is_closed { 1.0 } else { 2.0 };
        let parts = places.map(|position| legs * measured.length_at(position) / measured.whole());
        let round = legs * (parts[0].min(parts[1]) / legs).floor();
        let ends = parts.map(|part| part - round);
        let rms_relative = (state.sum / self.aim.count()).sqrt();
        let fit = CurveFit {
            placement: target.placement().after(&placed),
            deviation: Deviation {
                rms: size * rms_relative,
                rms_relative,
                greatest: size * self.greatest(&refinement),
                is_in_order: state.blocks.len() == self.aim.points_of(false).len(),
                length_ratio: own_length / self.aim.polyline_length,
            },
            ends,
            is_reversed: refinement.is_reversed,
        };
        let pass = traced.pass_of(places[0]);
        let branch = traced.linkage.dyad_ids().next().map_or(1, |dyad| traced.circuit.passes[pass].mode.sign(dyad));
        let curve = [refinement.trace + 1, circuit + 1];
        Some(LinkageFit { values: refinement.values.clone(), curve, fit, branch, inputs })
    }

    fn greatest(&self, refinement: &LinkageRefinement) -> f64 {
        let state = &refinement.state;
        let is_reversed = refinement.is_reversed && state.start.is_none();
        let points = self.aim.points_of(is_reversed);
        let at: Vec<Complex> = state.blocks.iter().map(|block| state.placed.image(block.foot.at)).collect();
        squares(points, &state.blocks, &at).into_iter().fold(0.0, f64::max).sqrt()
    }

    /// A curve where it is most like the target.
    fn placed(&self, points: &[Complex]) -> Option<Similarity> {
        let placed = match &self.query {
            Query::Whole(target, target_extent) => {
                let (spectrum, extent) = self.transform.spectrum(points);
                let likeness = self.transform.likeness(target, &spectrum);
                likeness.similarity(target_extent, &extent)
            }
            Query::Portion(stroke, _) => stroke.placement(points)?.1,
        };
        (placed.factor.norm_sqr().is_normal() && placed.shift.norm_sqr().is_finite()).then_some(placed)
    }

    /// The length of the placed curve, or of the portion from the first point to the last.
    fn length(&self, measured: &Measured, refinement: &LinkageRefinement) -> f64 {
        let state = &refinement.state;
        let own = match self.aim.target.kind() {
            PathKind::Closed => measured.whole(),
            PathKind::Open | PathKind::Part => {
                let positions = state.blocks.iter().map(|block| match state.start {
                    Some((pass, _)) => state.traced.position_of_input(pass, block.foot.position),
                    None => block.foot.position,
                });
                let lengths: Vec<f64> = positions.map(|position| measured.length_at(position)).collect();
                lengths.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum()
            }
        };
        state.placed.scale() * own
    }
}
