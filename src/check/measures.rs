//! When a measure has changed.
//!
//! A value is compared with what it is a part of: a length with the size of its curve, an angle with a degree, a ratio with one. A measure of where something
//! is, such as the input at which the longest straight portion begins, jumps where two places are equally good: it is compared only where the curve, or what
//! is longest, has changed.

use super::curve::relative_difference;
use crate::manifest::Tolerances;

/// What values of a measure are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    /// The value itself.
    Value,
    /// One, or one degree.
    One,
    /// The size of the curve.
    Size,
    /// Its square.
    Area,
    /// Its reciprocal.
    Curvature,
}

/// The measures that are numbers and have a scale other than their value, by the ends of their names.
const SCALES: [(&[&str], Scale); 4] = [
    (
        &[
            "_deg",
            "_share",
            "_ratio",
            "_ratio_min",
            "_ratio_max",
            "_advantage_min",
            "_advantage_max",
            "symmetry_residual",
            "sensitivity_max",
        ],
        Scale::One,
    ),
    (
        &[
            "length",
            "_deviation",
            "_radius",
            "_stroke",
            "_x",
            "_y",
            "_x_min",
            "_x_max",
            "_y_min",
            "_y_max",
            "_width",
            "_height",
            "output_min",
            "output_max",
        ],
        Scale::Size,
    ),
    (&["area"], Scale::Area),
    (&["curvature_max"], Scale::Curvature),
];

/// Measures of where something is, and the measure of what is there.
const PLACES: [(&str, &str); 9] = [
    ("straight_half_turn_start", "straight_half_turn_length"),
    ("straight_5_", "straight_5_length"),
    ("straight_10_", "straight_10_length"),
    ("straight_", "straight_length"),
    ("dwell_", "dwell_input"),
    ("output_dwell_start", "output_dwell"),
    ("torque_peak_", "torque_peak"),
    ("symmetry_deg", "symmetry_residual"),
    ("sensitivity_length", "sensitivity_max"),
];

/// Ends of the names of measures in [`PLACES`] that do not say where.
const NOT_PLACES: [&str; 3] = ["_length", "_share", "dwell_input_deg"];

/// The greatest residual of a curve that has an axis of symmetry: it is missing where it is greater.
const MAX_RESIDUAL: f64 = 0.01;

/// The values of a curve's measures, recorded and current, by their names.
pub(super) trait Values {
    /// The texts of a measure in both rows; `None` if not both have it.
    fn texts(&self, name: &str) -> Option<[&str; 2]>;
}

/// The relative change of a measure that is a number, which counts where it is more than the tolerance of the measure; infinite where only one has a value.
pub(super) fn change(name: &str, values: [f64; 2], size: f64) -> f64 {
    let ends = |ends: &[&str]| ends.iter().any(|end| name.ends_with(end));
    let scale = SCALES.iter().find(|(names, _)| ends(names)).map_or(Scale::Value, |(_, scale)| *scale);
    let least = match scale {
        Scale::Value => 0.0,
        Scale::One => 1.0,
        Scale::Size => size,
        Scale::Area => size * size,
        Scale::Curvature => 1.0 / size,
    };
    // A residual at the limit, above which it is missing, may be on either side.
    let values = if name == "symmetry_residual" {
        values.map(|own| if own.is_nan() { MAX_RESIDUAL } else { own })
    } else {
        values
    };
    relative_difference(values, least)
}

/// Whether a measure says where something is that has not changed, on a curve that has not moved; so its place is one of several that are equally good.
pub(super) fn is_place_of_equal(name: &str, values: &impl Values, size: f64, tolerances: &Tolerances) -> bool {
    let Some((_, what)) = PLACES.iter().find(|(start, _)| name.starts_with(start)) else { return false };
    if NOT_PLACES.iter().any(|end| name.ends_with(end)) || name == *what {
        return false;
    }
    // The name of an input has its unit.
    let names = [(*what).to_owned(), format!("{what}_deg"), format!("{what}_length")];
    let found = names.iter().find_map(|name| Some((name, values.texts(name)?)));
    let Some((what, texts)) = found else { return false };
    let numbers = texts.map(|text| text.parse().unwrap_or(f64::NAN));
    change(what, numbers, size) <= tolerances.of(what)
}

/// Whether a count is in doubt on either side, as `too_close` says.
pub(super) fn is_count_in_doubt(name: &str, values: &impl Values) -> bool {
    let is_count = ["crunodes", "inflections", "cusps"].contains(&name);
    is_count
        && values
            .texts("too_close")
            .is_some_and(|texts| texts.iter().any(|text| text.contains(name) || *text == "positions"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::measure::{ALL, Measure};

    /// Every measure that is a number and not a count is compared with something, but for those whose unit is any: forces, and errors by a tolerance.
    #[test]
    fn every_measure_has_a_scale() {
        let has_scale = |name: &str| SCALES.iter().any(|(ends, _)| ends.iter().any(|end| name.ends_with(end)));
        let without =
            ALL.iter().filter(|measure| !measure.is_word).flat_map(Measure::names).filter(|name| !has_scale(name));
        let expected = [
            "limit_positions",
            "toggles",
            "torque_peak",
            "torque_min",
            "torque_max",
            "tolerance_worst",
            "tolerance_rss",
            "cusps",
            "crunodes",
            "inflections",
        ];
        assert_eq!(without.collect::<Vec<_>>(), expected);
    }

    struct Two([&'static str; 2], [&'static str; 2]);

    impl Values for Two {
        fn texts(&self, name: &str) -> Option<[&str; 2]> {
            match name {
                "straight_length" => Some(self.0),
                "too_close" => Some(self.1),
                _ => None,
            }
        }
    }

    #[test]
    fn what_is_rounding_has_not_changed() {
        let tolerances = Tolerances::default();
        assert!(change("symmetry_residual", [1.0e-15, 1.08e-15], 3.0) < 1e-15);
        assert!(change("symmetry_residual", [f64::NAN, MAX_RESIDUAL * (1.0 - 1e-12)], 3.0) < 1e-9);
        assert!(change("symmetry_residual", [f64::NAN, 0.005], 3.0) > 1e-9);
        assert!(change("straight_length", [1.0, 1.001], 3.0) > 1e-4);
        assert_eq!(change("area", [f64::NAN, 1.0], 3.0), f64::INFINITY);
        // Of two equally long portions another is the first.
        let equal = Two(["1.25", "1.2500000000000002"], ["", "crunodes"]);
        assert!(is_place_of_equal("straight_start_deg", &equal, 1.0, &tolerances));
        assert!(!is_place_of_equal("straight_length", &equal, 1.0, &tolerances));
        assert!(!is_place_of_equal("straight_start_deg", &Two(["1.25", "1.26"], ["", ""]), 1.0, &tolerances));
        assert!(is_count_in_doubt("crunodes", &equal) && !is_count_in_doubt("inflections", &equal));
    }
}
