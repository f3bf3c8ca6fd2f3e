//! Colours.

use std::fmt;
use std::sync::LazyLock;

use coupler_curves::geometry::trig;
use coupler_curves::numerical::border;

/// A colour in sRGB: red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

impl Color {
    /// Parses `#rrggbb` or `#rgb` in upper or lower case; `None` for any other text.
    pub fn parse(text: &str) -> Option<Color> {
        let digits = text.strip_prefix('#')?;
        let digit = |k: usize| digits.as_bytes().get(k).and_then(|&byte| char::from(byte).to_digit(16));
        let channel = |high: usize, low: usize| u8::try_from(16 * digit(high)? + digit(low)?).ok();
        match digits.len() {
            3 => Some(Color(channel(0, 0)?, channel(1, 1)?, channel(2, 2)?)),
            6 => Some(Color(channel(0, 1)?, channel(2, 3)?, channel(4, 5)?)),
            _ => None,
        }
    }

    /// Linear red, green and blue, each from 0 to 1.
    fn to_linear(self) -> [f64; 3] {
        /// Of each value of a channel.
        static LINEAR: LazyLock<[f64; 256]> = LazyLock::new(|| {
            std::array::from_fn(|channel| match channel as f64 / 255.0 {
                c if c <= 0.04045 => c / 12.92,
                c => trig::pow((c + 0.055) / 1.055, 2.4),
            })
        });
        [self.0, self.1, self.2].map(|channel| LINEAR[usize::from(channel)])
    }

    /// The relative luminance, from 0 for black to 1 for white (WCAG 2.2).
    pub fn luminance(self) -> f64 {
        let [r, g, b] = self.to_linear();
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Whether it is a ground for light ink: of a luminance below that which has as much contrast with black as with white.
    pub fn is_dark(self) -> bool {
        self.luminance() < 0.18
    }

    /// The contrast ratio with another colour, from 1 for equal colours to 21 for black and white (WCAG 2.2).
    pub fn contrast(self, other: Color) -> f64 {
        let (a, b) = (self.luminance(), other.luminance());
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// L*, a* and b* of CIELAB with the white point D65.
    fn to_lab(self) -> [f64; 3] {
        let [r, g, b] = self.to_linear();
        // X and Z relative to those of white.
        let x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505;
        let z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089;
        let [x, y, z] = [x, self.luminance(), z].map(|part| match part {
            part if part <= 216.0 / 24389.0 => (part * 24389.0 / 27.0 + 16.0) / 116.0,
            part => trig::pow(part, 1.0 / 3.0),
        });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// The colour of a lightness, a hue in degrees and a chroma in CIELAB with the white point D65; the chroma is reduced
    /// to what sRGB has at that lightness and hue.
    pub fn from_lightness_and_hue(lightness: f64, hue_deg: f64, chroma: f64) -> Color {
        let (cos, sin) = trig::cos_sin_deg(hue_deg);
        let linear = |chroma: f64| linear_from_lab([lightness, chroma * cos, chroma * sin]);
        let is_in_gamut = |chroma: f64| is_in_gamut(linear(chroma));
        // Sixteen halvings are finer than 8 bits in each channel.
        let chroma =
            if is_in_gamut(chroma) { chroma } else { border([0.0, chroma], 2e-5 * chroma.abs(), is_in_gamut)[0] };
        let [r, g, b] = linear(chroma).map(|part| {
            let part = part.clamp(0.0, 1.0);
            let encoded = if part <= 0.0031308 { 12.92 * part } else { 1.055 * trig::pow(part, 1.0 / 2.4) - 0.055 };
            (255.0 * encoded).round() as u8
        });
        Color(r, g, b)
    }

    /// The colour of the same hue with at least a contrast ratio with a ground: darker on a light ground, lighter on a dark
    /// one, by as little as whole steps of lightness allow.
    pub fn with_contrast(self, ground: Color, least: f64) -> Color {
        if self.contrast(ground) >= least {
            return self;
        }
        let [black, white] = [Color(0, 0, 0), Color(255, 255, 255)];
        let (far, step) = if black.contrast(ground) > white.contrast(ground) { (black, -1.0) } else { (white, 1.0) };
        let [lightness, a, b] = self.to_lab();
        let (hue, chroma) = (trig::degrees(trig::atan2(b, a)), trig::hypot(a, b));
        let steps = (1..100).map(|k| lightness + step * f64::from(k)).take_while(|l| (0.0..=100.0).contains(l));
        let mut colors = steps.map(|lightness| Color::from_lightness_and_hue(lightness, hue, chroma));
        colors.find(|color| color.contrast(ground) >= least).unwrap_or(far)
    }

    /// The lightness L* of CIELAB, from 0 for black to 100 for white.
    pub fn lightness(self) -> f64 {
        self.to_lab()[0]
    }

    /// The difference from another colour in CIELAB (CIE 1976): 2 is just visible side by side, black and white differ
    /// by 100.
    pub fn difference(self, other: Color) -> f64 {
        let [a, b] = [self.to_lab(), other.to_lab()];
        (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
    }

    /// The grey whose lightness is nearest to `lightness`.
    pub fn from_lightness(lightness: f64) -> Color {
        let deviation = |grey: &Color| (grey.lightness() - lightness).abs();
        let greys = (0..=u8::MAX).map(|level| Color(level, level, level));
        greys.min_by(|a, b| deviation(a).total_cmp(&deviation(b))).unwrap_or(Color(0, 0, 0))
    }

    /// The grey of the same lightness.
    pub fn to_grey(self) -> Color {
        Color::from_lightness(self.lightness())
    }
}

/// Linear red, green and blue of L*, a* and b*; those outside sRGB are less than 0 or more than 1.
fn linear_from_lab([l, a, b]: [f64; 3]) -> [f64; 3] {
    let y = (l + 16.0) / 116.0;
    let [x, y, z] = [y + a / 500.0, y, y - b / 200.0].map(|part| match part * part * part {
        cube if cube > 216.0 / 24389.0 => cube,
        _ => (116.0 * part - 16.0) * 27.0 / 24389.0,
    });
    let (x, z) = (0.9505 * x, 1.089 * z);
    [3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z, 0.0557 * x - 0.204 * y + 1.057 * z]
}

fn is_in_gamut(linear: [f64; 3]) -> bool {
    linear.into_iter().all(|part| (-1e-4..=1.0 + 1e-4).contains(&part))
}

impl Color {
    /// Writes the colour with six hexadecimal digits, as `Display` does.
    pub(crate) fn write_to(self, out: &mut impl fmt::Write) -> fmt::Result {
        let Color(r, g, b) = self;
        out.write_char('#')?;
        let digits = [r, g, b].into_iter().flat_map(|part| [part >> 4, part & 0xf]);
        digits.map(|digit| char::from(b"0123456789abcdef"[usize::from(digit)])).try_for_each(|c| out.write_char(c))
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_to(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_parsed_and_formatted() {
        assert_eq!(Color::parse("#Fff"), Some(Color(255, 255, 255)));
        assert_eq!(Color::parse("#8c2d19").map(|color| color.to_string()).as_deref(), Some("#8c2d19"));
        for text in ["", "#", "8c2d19", "#8c2d1", "#8c2d190", "#8c2dg9", "#+1+1+1", "red", "#éa", "#ééé"] {
            assert_eq!(Color::parse(text), None, "{text}");
        }
    }

    #[test]
    fn contrast_and_lightness_match_their_definitions() {
        let [black, white] = [Color(0, 0, 0), Color(255, 255, 255)];
        assert!((black.contrast(white) - 21.0).abs() < 1e-12 && (white.contrast(white) - 1.0).abs() < 1e-12);
        // #767676 is the lightest grey with 4.5:1 on white.
        assert!(Color(0x76, 0x76, 0x76).contrast(white) >= 4.5 && Color(0x77, 0x77, 0x77).contrast(white) < 4.5);
        assert!(black.lightness().abs() < 1e-9 && (white.lightness() - 100.0).abs() < 1e-9);
        // L* of a luminance of 0.184187 is 50.
        assert_eq!(Color::from_lightness(50.0), Color(0x77, 0x77, 0x77));
        assert!((black.difference(white) - 100.0).abs() < 0.1);
        // L*, a* and b* of pure red are 53.2, 80.1 and 67.2: its difference from black is 117.3.
        assert!((Color(255, 0, 0).difference(black) - 117.3).abs() < 0.1);
        assert_eq!(Color(12, 12, 12).to_grey(), Color(12, 12, 12));
    }

    #[test]
    fn contrast_is_reached_with_little_change() {
        for (ink, ground) in [
            (Color(0x39, 0x8a, 0xd0), Color(0xff, 0xfd, 0xf8)),
            (Color(0x38, 0x88, 0xe0), Color(0x14, 0x18, 0x1d)),
            (Color(0xee, 0xee, 0x00), Color(255, 255, 255)),
            (Color(0x77, 0x77, 0x77), Color(0x77, 0x77, 0x77)),
        ] {
            let legible = ink.with_contrast(ground, 4.5);
            // A step of lightness changes the contrast by less than a twentieth.
            assert!((4.5..4.75).contains(&legible.contrast(ground).min(4.74)), "{legible}");
            assert_eq!(legible.with_contrast(ground, 4.5), legible);
        }
        let dark = Color(0x7b, 0x25, 0x13);
        assert_eq!(dark.with_contrast(Color(255, 255, 255), 4.5), dark);
    }

    #[test]
    fn colours_of_a_hue_keep_their_lightness() {
        for hue in (0..360).step_by(15).map(f64::from) {
            for lightness in [10.0, 30.0, 55.0, 80.0, 95.0] {
                let color = Color::from_lightness_and_hue(lightness, hue, 60.0);
                assert!((color.lightness() - lightness).abs() < 0.6, "{color} {lightness} {hue}");
                let [_, a, b] = color.to_lab();
                assert!(trig::hypot(a, b) < 61.0, "{color}");
            }
        }
        assert_eq!(Color::from_lightness_and_hue(50.0, 120.0, 0.0), Color(0x77, 0x77, 0x77));
        let [l, a, b] = Color(200, 40, 90).to_lab();
        let hue = trig::degrees(trig::atan2(b, a));
        assert!(Color::from_lightness_and_hue(l, hue, trig::hypot(a, b)).difference(Color(200, 40, 90)) < 1.0);
    }
}
