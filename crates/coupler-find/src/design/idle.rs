//! Parameters that change nothing that is wished for.

use super::assessment::Assessment;
use super::measured::Meter;

/// The axes that change nothing that is wished for, which can keep their default.
pub(super) fn idle_axes(meter: &Meter) -> Vec<usize> {
    /// The samples on which it is tried, the changes of an axis, which are great, as counts change in steps; and the change of measures which
    /// is rounding.
    const SAMPLES: usize = 8;
    const CHANGES: [f64; 3] = [0.13, 0.37, 0.61];
    const ROUNDING: f64 = 1e-9;
    // Any parameter may move a path.
    if meter.is_of_paths() {
        return Vec::new();
    }
    let unlimited = |mut assessments: Vec<Assessment>| {
        assessments.iter_mut().for_each(|assessment| assessment.link_excess = 0.0);
        assessments
    };
    let assessed = |place: &[f64]| unlimited(meter.assess_at(place));
    let samples: Vec<(Vec<f64>, Vec<Assessment>)> =
        meter.assembled_samples(SAMPLES).into_iter().map(|place| (place.clone(), assessed(&place))).collect();
    let is_idle = |axis: &usize| {
        let changes = |(place, assessments)| CHANGES.map(|change| (place, assessments, change));
        samples.iter().map(|(place, assessments)| (place, assessments)).flat_map(changes).all(
            |(place, assessments, change)| {
                let mut moved: Vec<f64> = place.clone();
                moved[*axis] += change;
                let others = assessed(&moved);
                let alike = |(a, b): (&Assessment, &Assessment)| {
                    let numbers = |assessment: &Assessment| [&assessment.excesses[..], &assessment.goals].concat();
                    numbers(a).iter().zip(numbers(b)).all(|(a, b)| {
                        (a - b).abs() <= ROUNDING * a.abs().max(b.abs()) || a.is_nan() && b.is_nan() || *a == b
                    })
                };
                others.len() == assessments.len() && others.iter().zip(assessments).all(alike)
            },
        )
    };
    if samples.is_empty() { Vec::new() } else { (0..meter.space.axes.len()).filter(is_idle).collect() }
}
