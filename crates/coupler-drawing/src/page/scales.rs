//! Scales as manifests and pages write them.

use super::marks::format_with_digits;
use super::plot::round_number_below;
use coupler_curves::family::LengthUnit;

/// A scale in millimetres to a unit, in three digits: of lengths with a unit as the ratio of a length on paper to one of the linkage, where
/// 1:2 is half the size, or else as the length of a unit on paper, `20 mm`.
pub fn format_scale(scale: f64, unit: Option<LengthUnit>) -> String {
    let digits = |number: f64| {
        let text = format_with_digits(number, 3);
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    match unit.map(|unit| scale / unit.millimetres()) {
        None => format!("{} mm", digits(scale)),
        Some(ratio) if ratio < 1.0 => format!("1:{}", digits(1.0 / ratio)),
        Some(ratio) => format!("{}:1", digits(ratio)),
    }
}

/// The greatest usual scale up to one, both in millimetres to a unit: 1, 2 or 5 times a power of ten, as a ratio of lengths that have a unit. From
/// 1e-12 to 1e12.
pub fn usual_scale_below(scale: f64, unit: Option<LengthUnit>) -> f64 {
    let unit = unit.map_or(1.0, LengthUnit::millimetres);
    unit * round_number_below(scale / unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_written_as_manifests_have_them() {
        use LengthUnit::{Inch, Metre, Millimetre};
        for (scale, unit, text, below, text_below) in [
            (20.0, None, "20 mm", 20.0, "20 mm"),
            (0.018_333, None, "0.0183 mm", 0.01, "0.01 mm"),
            (1.0, Some(Millimetre), "1:1", 1.0, "1:1"),
            (0.4, Some(Millimetre), "1:2.5", 0.2, "1:5"),
            (25.4, Some(Inch), "1:1", 25.4, "1:1"),
            (3.0, Some(Millimetre), "3:1", 2.0, "2:1"),
            (250.0, Some(Metre), "1:4", 200.0, "1:5"),
        ] {
            assert_eq!(format_scale(scale, unit), text);
            let usual = usual_scale_below(scale, unit);
            assert!((usual - below).abs() < 1e-12 * below, "{usual} for {scale}");
            assert_eq!(format_scale(usual, unit), text_below);
        }
    }
}
