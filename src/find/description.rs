//! How near a curve is to a path and where it is placed, in words.

use coupler_curves::find::{Quality, format_length as number, format_relative as relative};
use coupler_curves::linkage_format::toml_number;

use super::PlacedCurve;

/// How near a curve is to a target of a size: "E = 0.0052 S = 0.12, close".
pub fn deviation(PlacedCurve { fit, .. }: &PlacedCurve, size: f64) -> String {
    let quality = Quality::of(fit.rms_relative).name();
    format!("E = {} S = {}, {quality}", relative(fit.rms_relative), number(fit.rms, size))
}

/// Where a curve is placed on a target of a size: "scale 2, turned by 30°, shifted by (1, 2)".
pub fn placement(curve: &PlacedCurve, size: f64) -> String {
    let placement = &curve.fit.placement;
    let mirrored = if placement.is_mirrored { "y mirrored, " } else { "" };
    format!(
        "{mirrored}scale {}, turned by {}°, shifted by ({}, {})",
        number(placement.scale(), placement.scale()),
        (1000.0 * placement.rotation_deg()).round() / 1000.0 + 0.0,
        number(placement.shift.x, size),
        number(placement.shift.y, size)
    )
}

/// How near a curve is, and where it is placed with all digits, for a family that is drawn in its direction.
pub(super) fn exact_placement(curve: &PlacedCurve, size: f64) -> String {
    let placement = &curve.fit.placement;
    let [x, y] = [placement.shift.x, placement.shift.y].map(toml_number);
    let scaled = match curve.is_scalable {
        true => String::new(),
        false => format!("{} times as large and ", toml_number(placement.scale())),
    };
    let [trace, circuit] = curve.numbers;
    let deviation = deviation(curve, size);
    format!("{deviation}; on the path it is {scaled}shifted by ({x}, {y}); trace {trace}, circuit {circuit}")
}
