//! Curves of the atlas by their shape, and how they fit a path.

use serde_json::{Value, json};

use coupler_curves::geometry::Point;
use coupler_find::{CurveFit, CurveFitOptions, CurveFitter, CurveIndex, CurveLookup, PathKind, Target};

use crate::finder::target_of;
use crate::response::Numbers;

/// The curves of a step of comparison with a closed path, and with an open one, some milliseconds of work.
const CURVES_PER_STEP: usize = 20_000;
const PORTIONS_PER_STEP: usize = 256;

/// Adds curves to an index: their points one after another, the number of points of each, and whether they are closed.
///
/// # Errors
/// There are not as many of one as of the others.
pub(crate) fn add_curves(
    index: &mut CurveIndex,
    points: &[Point],
    counts: &[f64],
    closed: &[f64],
) -> Result<Value, String> {
    let mut rest = points;
    let mut next = |count: &f64| rest.split_off(..*count as usize);
    let curves: Option<Vec<&[Point]>> = counts.iter().map(&mut next).collect();
    let curves = curves.filter(|curves| curves.len() == closed.len()).ok_or("there are fewer points than counted")?;
    for (curve, closed) in curves.into_iter().zip(closed) {
        index.push(curve, *closed != 0.0);
    }
    Ok(json!({ "count": index.len() }))
}

/// A path to which curves are compared.
pub(crate) struct ShapeSearch {
    target: Target,
    options: CurveFitOptions,
    fitter: CurveFitter,
    wanted: usize,
    /// The curves that are most like it so far.
    lookup: CurveLookup,
}

impl ShapeSearch {
    /// Begins a search for a number of curves that are wanted; a portion of a curve has at least a part of its length.
    ///
    /// # Errors
    /// The points are no path.
    pub fn new(
        points: &[Point],
        kind: &str,
        may_be_mirrored: bool,
        least_portion: f64,
        wanted: usize,
    ) -> Result<ShapeSearch, String> {
        let target = target_of(points, kind)?;
        let options = CurveFitOptions { may_be_mirrored, least_portion, is_fixed: false };
        let fitter = CurveFitter::new(&target, options);
        let lookup = CurveLookup::new(&target, options, wanted);
        Ok(ShapeSearch { target, options, fitter, wanted, lookup })
    }

    /// The most curves of an index that are found; if these are more than are wanted, they are to be compared more closely.
    pub fn most(&self) -> usize {
        self.lookup.most()
    }

    /// Compares some curves of an index from one on, where 0 begins a comparison: the next to compare; after the last of them, the
    /// numbers of those that are most like the path, the likeliest first, and their likenesses.
    pub fn compare(&mut self, index: &CurveIndex, from: usize, numbers: &mut Numbers) -> Value {
        if from == 0 {
            self.lookup = CurveLookup::new(&self.target, self.options, self.wanted);
        }
        let step = if self.target.kind() == PathKind::Closed { CURVES_PER_STEP } else { PORTIONS_PER_STEP };
        let to = from.saturating_add(step);
        self.lookup.compare(index, from..to);
        if to < index.len() {
            return json!({ "next": to });
        }
        json!({
            "next": null,
            "numbers": numbers.array(self.lookup.found().map(|(_, number)| number as f64)),
            "likenesses": numbers.array(self.lookup.found().map(|(likeness, _)| likeness)),
        })
    }

    /// How much a curve is like the path, compared more closely than in an index, or null.
    pub fn likeness(&self, points: &[Point], is_closed: bool) -> Value {
        json!({ "likeness": self.lookup.likeness(points, is_closed) })
    }

    /// How a curve fits the path, or null.
    pub fn fit(&self, points: &[Point], is_closed: bool) -> Value {
        json!({ "fit": self.fitter.fit(points, is_closed).map(|fit| fit_json(&fit, &self.target)) })
    }
}

/// The deviation of a curve from points where both are, or null: as of an open path, whatever their lengths.
pub(crate) fn deviation(from: &[Point], points: &[Point], is_closed: bool) -> Result<Value, String> {
    let target = target_of(from, PathKind::Open.name())?;
    let fitter = CurveFitter::new(&target, CurveFitOptions { is_fixed: true, ..CurveFitOptions::default() });
    Ok(json!({ "fit": fitter.fit(points, is_closed).map(|fit| fit_json(&fit, &target)) }))
}

/// A fit with its deviations relative to the size of the path.
fn fit_json(fit: &CurveFit, target: &Target) -> Value {
    let placement = fit.placement;
    json!({
        "rms": fit.deviation.rms_relative,
        "quality": fit.deviation.quality().name(),
        "greatest": fit.deviation.greatest / target.size(),
        "similarity": {
            "mirror": placement.is_mirrored,
            "re": placement.factor.re,
            "im": placement.factor.im,
            "x": placement.shift.re,
            "y": placement.shift.im,
        },
        "from": if target.kind() == PathKind::Closed { 0.0 } else { fit.ends[0] },
        "to": if target.kind() == PathKind::Closed { 1.0 } else { fit.ends[1] },
    })
}
