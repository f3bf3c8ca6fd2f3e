//! Curves of the atlas by their shape, and how they fit a path.

use serde_json::{Value, json};

use coupler_curves::geometry::Point;
use coupler_find::{CurveFit, CurveFitOptions, CurveFitter, CurveIndex, CurveLookup, CurveShape, PathKind, Target};

use crate::finder::target_of;
use crate::request::GivenCurves;
use crate::response::Numbers;

/// The curves of a step of comparison with a closed path, and with an open one, some milliseconds of work.
const CURVES_PER_STEP: usize = 20_000;
const PORTIONS_PER_STEP: usize = 256;

/// A path to which curves are compared.
pub(crate) struct ShapeSearch {
    target: Target,
    fitter: CurveFitter,
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
        Ok(ShapeSearch { target, fitter, lookup })
    }

    /// The most curves of an index that are found; if these are more than are wanted, they are to be compared more closely.
    pub fn most(&self) -> usize {
        self.lookup.most()
    }

    /// Compares some curves of an index from one on: the next to compare; after the last of them, the numbers of those of all indexes so far
    /// that are most like the path, the likeliest first. The numbers of an index follow those of the ones before.
    pub fn compare(&mut self, index: &CurveIndex, from: usize, numbers: &mut Numbers) -> Value {
        let step = if self.target.kind() == PathKind::Closed { CURVES_PER_STEP } else { PORTIONS_PER_STEP };
        let to = from.saturating_add(step);
        self.lookup.compare(index, from..to);
        if to < index.len() {
            return json!({ "next": to });
        }
        self.lookup.end_index(index);
        json!({ "next": null, "numbers": numbers.array(self.lookup.found().map(|(_, number)| number as f64)) })
    }

    /// How much curves are like the path, compared more closely than in an index; NaN for those that are not.
    ///
    /// # Errors
    /// There are fewer points than counted.
    pub fn likenesses(&self, given: &GivenCurves, numbers: &mut Numbers) -> Result<Value, String> {
        let likeness = |(points, is_closed)| self.lookup.likeness(points, is_closed).unwrap_or(f64::NAN);
        Ok(json!({ "likenesses": numbers.array(given.curves()?.map(likeness)) }))
    }

    /// How a curve fits the path, or null; what of its shape does not depend on its place, size and direction.
    pub fn fit(&self, points: &[Point], is_closed: bool, numbers: &mut Numbers) -> Value {
        json!({
            "fit": self.fitter.fit(points, is_closed).map(|fit| fit_json(&fit, &self.target)),
            "invariants": numbers.array(CurveShape::new(points, is_closed).invariants()),
        })
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
