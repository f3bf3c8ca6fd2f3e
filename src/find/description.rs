//! How near a curve is to a path and where it is placed, in words.

use coupler_curves::linkage::{FourBar, PlacedFourBar};
use coupler_curves::linkage_format::toml_number;
use coupler_curves::template::{ParameterKind, Template};
use coupler_find::{
    Deviation, LinkageAnswer, Mechanism, PlacedCurve, format_length as number, format_relative as relative,
};

/// How near a curve is to a target of a size: "E = 0.0052 S = 0.12, close".
pub fn deviation(deviation: &Deviation, size: f64) -> String {
    let quality = deviation.quality().name();
    format!("E = {} S = {}, {quality}", relative(deviation.rms_relative), number(deviation.rms, size))
}

/// The dimensions of a four-bar, formatted.
pub fn dimensions(mechanism: &Mechanism, format: impl Fn(f64) -> String) -> String {
    let PlacedFourBar { lengths: FourBar { frame, crank, coupler, rocker }, coupler_point, .. } = mechanism.four_bar;
    let values = [
        ("frame", frame),
        ("crank", crank),
        ("coupler", coupler),
        ("rocker", rocker),
        ("along", coupler_point.x),
        ("across", coupler_point.y),
    ];
    values.map(|(name, value)| format!("{name} = {}", format(value))).join(", ")
}

/// The parameters of a linkage, in six significant digits.
pub fn parameters(template: &Template, curve: &PlacedCurve, size: f64) -> String {
    let scale = if curve.is_scalable { size } else { 1.0 };
    values_in_words(template, &curve.values, scale)
}

/// The same of values, of which lengths have the unit 1.
pub fn named_values(template: &Template, values: &[f64]) -> String {
    values_in_words(template, values, 1.0)
}

fn values_in_words(template: &Template, values: &[f64], scale: f64) -> String {
    let values = template.parameters.iter().zip(values).map(|(parameter, value)| {
        let unit = if parameter.kind == ParameterKind::Length { scale } else { 1.0 };
        format!("{} = {}", parameter.name, number(*value, unit))
    });
    values.collect::<Vec<_>>().join(", ")
}

/// Where a curve is placed on a target of a size: "scale 2, turned by 30°, shifted by (1, 2)".
pub fn placement(curve: &PlacedCurve, size: f64) -> String {
    let placement = &curve.fit.placement;
    let mirrored = if placement.is_mirrored { "y mirrored, " } else { "" };
    format!(
        "{mirrored}scale {}, turned by {}°, shifted by ({}, {})",
        number(placement.scale(), placement.scale()),
        (1000.0 * placement.rotation_deg()).round() / 1000.0 + 0.0,
        number(placement.shift.re, size),
        number(placement.shift.im, size)
    )
}

/// The branch at the first point of the path, as it is numbered: 1 left, 2 right.
pub fn branch(answer: &LinkageAnswer) -> u8 {
    if answer.branch > 0 { 1 } else { 2 }
}

/// How near a curve is, and where it is placed with all digits, for a family that is drawn in its direction.
pub(super) fn exact_placement(curve: &PlacedCurve, size: f64) -> String {
    let placement = &curve.fit.placement;
    let [x, y] = [placement.shift.re, placement.shift.im].map(toml_number);
    let scaled = match curve.is_scalable {
        true => String::new(),
        false => format!("{} times as large and ", toml_number(placement.scale())),
    };
    let [trace, circuit] = curve.numbers;
    let deviation = deviation(&curve.fit.deviation, size);
    format!("{deviation}; on the path it is {scaled}shifted by ({x}, {y}); trace {trace}, circuit {circuit}")
}
