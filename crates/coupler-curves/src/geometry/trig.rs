//! Trigonometry and powers that give the same bits on every machine, through the `libm` crate.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

pub use libm::{acos, asin, atan2, cos, exp, hypot, log as ln, log10, pow, sin, tan};

/// Degrees to radians.
pub fn radians(deg: f64) -> f64 {
    deg * (PI / 180.0)
}

/// Radians to degrees.
pub fn degrees(rad: f64) -> f64 {
    rad * (180.0 / PI)
}

/// The cosine and the sine of an angle in degrees.
///
/// A multiple of 90 degrees is first subtracted, which is exact in binary and leaves at most 45 degrees, so that
/// quarter turns have exact zeros and ones and symmetric angles have exactly symmetric values. NaN for an angle that is
/// not finite.
pub fn cos_sin_deg(deg: f64) -> (f64, f64) {
    let turn = deg % 360.0;
    let turn = if turn < 0.0 { turn + 360.0 } else { turn };
    let quarter = ((turn + 45.0) / 90.0).floor();
    let rest = turn - 90.0 * quarter;
    let (c, s) = match rest.abs() {
        45.0 => (FRAC_1_SQRT_2, FRAC_1_SQRT_2.copysign(rest)),
        _ => (cos(radians(rest)), sin(radians(rest))),
    };
    match quarter as i64 {
        1 => (-s, c),
        2 => (-c, -s),
        3 => (s, -c),
        _ => (c, s),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        for (deg, expected) in [(0.0, (1.0, 0.0)), (90.0, (0.0, 1.0)), (180.0, (-1.0, 0.0)), (270.0, (0.0, -1.0))] {
            assert_eq!(cos_sin_deg(deg), expected);
            assert_eq!(cos_sin_deg(deg - 360.0), expected);
            assert_eq!(cos_sin_deg(deg + 720.0), expected);
        }
    }

    #[test]
    fn symmetric_angles_are_exactly_symmetric() {
        for k in 0..=180 {
            let (c, s) = cos_sin_deg(f64::from(k));
            assert_eq!(cos_sin_deg(f64::from(180 - k)), (-c, s));
            assert_eq!(cos_sin_deg(f64::from(360 - k)).0, c);
        }
    }

    #[test]
    fn every_angle_is_within_an_ulp_of_the_definition() {
        for k in -2000..2000 {
            let deg = f64::from(k) * 0.37;
            let (c, s) = cos_sin_deg(deg);
            // The reference loses digits in computing radians(deg): half an ulp of the angle, which is below 13.
            assert!((c - cos(radians(deg))).abs() < 4e-15 && (s - sin(radians(deg))).abs() < 4e-15, "{deg}");
            assert!((c * c + s * s - 1.0).abs() < 5e-16);
        }
    }
}
