//! The look of a page: colours, weights, sizes and typeface.

mod named;

pub use named::NamedTheme;

use super::Paper;
use super::element::TextLine;
use super::typography::typeset;
use crate::scene::{Anchor, Color, MIN_TEXT_SIZE, Stroke, Typeface};
use coupler_curves::expression::MathText;
use coupler_curves::geometry::{Point, Vector};

/// The inks, weights and sizes of a page, in millimetres on tabloid paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    /// The colour of the paper.
    pub paper: Color,
    /// The colour of links, joints and titles.
    pub ink: Color,
    /// The colour of secondary text.
    pub grey: Color,
    /// The colour of the frame, of grids and of rules; the bodies of ternary links have a lighter tint of it.
    pub hairline: Color,
    /// The colours of curves, which differ in hue and in lightness; at least one.
    pub curve_inks: Vec<Color>,
    /// The weights and dashes of curves, by which curves in one ink differ; at least one.
    pub curve_styles: Vec<CurveStyle>,
    /// The typeface of all text.
    pub typeface: Typeface,
    /// The length of a dash as a fraction of the dash and its gap; more than 0 and at most 1.
    pub dash_fraction: f64,
    /// The distance of the border from the edge of the paper.
    pub border: f64,
    /// The distance of the contents from the border.
    pub margin: f64,
    /// The font size (em) of the title.
    pub title_size: f64,
    /// The font size of the source line and the folio.
    pub source_size: f64,
    /// The font size of captions.
    pub caption_size: f64,
    /// The font size of notes and of numbers in figures.
    pub note_size: f64,
    /// The weight of links.
    pub link_width: f64,
    /// The weight of curves.
    pub curve_width: f64,
    /// The weight of the circles of joints, the border and light curves.
    pub fine_width: f64,
    /// The weight of hairlines.
    pub hair_width: f64,
    /// The radius of a joint.
    pub joint_radius: f64,
}

/// The weight and the dashes of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveStyle {
    /// The weight as a multiple of [`Theme::curve_width`].
    pub width_factor: f64,
    /// The length of a dash as a multiple of [`Theme::dash_fraction`].
    pub dash_factor: f64,
}

impl CurveStyle {
    /// The style of curves that differ in ink only.
    pub const PLAIN: CurveStyle = CurveStyle { width_factor: 1.0, dash_factor: 1.0 };

    /// The styles of five greys: the darkest plain, the faintest broad, those between them with shorter and longer
    /// dashes. None is as broad as a link.
    const FOR_GREYS: [CurveStyle; 5] = [
        CurveStyle::PLAIN,
        CurveStyle { width_factor: 1.45, dash_factor: 1.0 },
        CurveStyle { width_factor: 1.25, dash_factor: 0.4 },
        CurveStyle { width_factor: 1.0, dash_factor: 1.5 },
        CurveStyle { width_factor: 1.4, dash_factor: 0.7 },
    ];
}

impl Default for Theme {
    /// Ink on cream paper.
    fn default() -> Theme {
        let [first, ..] = Theme::NAMED;
        (first.theme)()
    }
}

impl Theme {
    /// The theme scaled from tabloid to another paper, by 0.3 to 2; weights change by the square root, so that lines do
    /// not become too fine to print, no text is smaller than [`MIN_TEXT_SIZE`], and the border is where printers print.
    pub fn for_paper(&self, paper: Paper) -> Theme {
        /// The least distance of the border from the edge: so that what is outside it, such as the thumb index of a book, is not cut off.
        const MIN_BORDER: f64 = 5.0;
        let scale = (paper.width / 431.8).min(paper.height / 279.4).clamp(0.3, 2.0);
        let weight = scale.sqrt();
        let text = |size: f64| (size * scale).max(MIN_TEXT_SIZE);
        Theme {
            border: (self.border * scale).max(MIN_BORDER.min(self.border)),
            margin: self.margin * scale,
            title_size: text(self.title_size),
            source_size: text(self.source_size),
            caption_size: text(self.caption_size),
            note_size: text(self.note_size),
            link_width: self.link_width * weight,
            curve_width: self.curve_width * weight,
            fine_width: self.fine_width * weight,
            hair_width: self.hair_width * weight,
            joint_radius: self.joint_radius * weight,
            ..self.clone()
        }
    }

    /// The theme for panels of a size in millimetres: text, joints and lines are smaller in small panels, down to a
    /// third, but no text is smaller than [`MIN_TEXT_SIZE`].
    pub fn for_panel_size(&self, panel: Vector) -> Theme {
        let scale =
            (panel.x / (12.0 * self.caption_size)).min(panel.y / (14.0 * self.caption_size)).clamp(1.0 / 3.0, 1.0);
        let weight = scale.sqrt();
        let text = |size: f64| (size * scale).max(MIN_TEXT_SIZE.min(size));
        Theme {
            caption_size: text(self.caption_size),
            note_size: text(self.note_size),
            joint_radius: self.joint_radius * weight,
            link_width: self.link_width * weight,
            curve_width: self.curve_width * weight,
            fine_width: self.fine_width * weight,
            ..self.clone()
        }
    }

    /// The theme for linkages whose shortest crank has a length in millimetres: joints and links are so small that it can
    /// be seen between its joints, down to a third; curves are finer by as much as links, so that they stay finer than these.
    pub(super) fn for_crank_length(&self, length: f64) -> Theme {
        /// The length of a crank in radii of its joints: a pivot has one and a half, so that half of the crank is seen.
        const CRANK_RADII: f64 = 5.0;
        let scale = (length / (CRANK_RADII * self.joint_radius)).clamp(1.0 / 3.0, 1.0);
        let weight = scale.sqrt();
        Theme {
            joint_radius: self.joint_radius * scale,
            link_width: self.link_width * weight,
            curve_width: self.curve_width * weight,
            fine_width: self.fine_width * weight,
            ..self.clone()
        }
    }

    /// A stroke with butt ends.
    pub fn stroke(&self, color: Color, width: f64) -> Stroke {
        Stroke { color, width, has_round_ends: false }
    }

    /// The size of the smallest text relative to that of notes.
    pub(super) const SMALL_PART: f64 = 0.75;

    /// The size of the smallest text, such as the numbers in figures.
    pub(super) fn small_size(&self) -> f64 {
        (Theme::SMALL_PART * self.note_size).max(MIN_TEXT_SIZE.min(self.note_size))
    }

    /// A line of mathematical text at a position of an area, in the theme's typeface.
    pub(super) fn math_line(&self, text: &MathText, at: Point, anchor: Anchor, size: f64, color: Color) -> TextLine {
        TextLine::from_math(text, self.typeface, at, anchor, size, color)
    }

    /// A line of text at a position of an area, in the theme's typeface and with the characters of typesetting.
    pub(super) fn text_line(&self, text: &str, at: Point, anchor: Anchor, size: f64, color: Color) -> TextLine {
        TextLine::new(&typeset(text), self.typeface, at, anchor, (size, color))
    }

    /// The ink of the k-th curve, from 0.
    pub fn curve_ink(&self, k: usize) -> Color {
        self.curve_inks[k % self.curve_inks.len()]
    }

    /// The ink of text that belongs to a curve: that of the curve, darker or lighter where it would be hard to read.
    pub(super) fn text_ink(&self, ink: Color) -> Color {
        /// The contrast that text needs on its background (WCAG 2.2, 1.4.3).
        const MIN_CONTRAST: f64 = 4.5;
        ink.with_contrast(self.paper, MIN_CONTRAST)
    }

    /// The ink of a line by its place in an order, from 0 for the first line to 1 for the last.
    ///
    /// The inks go from the darkest to the lightest, from blue by way of red to gold, or in grey if those of curves are
    /// grey; on dark paper they begin with the lightest. The contrast of each with the paper is at least 3:1.
    pub fn ordered_ink(&self, place: f64) -> Color {
        /// The lightness of the first ink on light and on dark paper.
        const STARTS: [f64; 2] = [20.0, 92.0];
        /// Blue and gold, in degrees, by way of red; and the chroma, as far as sRGB has it.
        const HUES: [f64; 2] = [280.0, 440.0];
        const CHROMA: f64 = 70.0;
        /// A little more than the contrast of 3:1 that a line needs on its background.
        const MIN_CONTRAST: f64 = 3.1;
        let is_dark = self.paper.lightness() < 50.0;
        let start = STARTS[usize::from(is_dark)];
        // The luminance at that contrast is that of a grey.
        let greys = (0..=u8::MAX).map(|level| Color(level, level, level));
        let visible = greys.filter(|grey| {
            grey.contrast(self.paper) >= MIN_CONTRAST && (grey.luminance() > self.paper.luminance()) == is_dark
        });
        let faintest = visible.min_by(|a, b| a.contrast(self.paper).total_cmp(&b.contrast(self.paper)));
        let end = faintest.map_or(start, Color::lightness);
        let at = |[from, to]: [f64; 2]| from + place * (to - from);
        let is_grey = self.curve_inks.iter().all(|ink| *ink == ink.to_grey());
        Color::from_lightness_and_hue(at([start, end]), at(HUES), if is_grey { 0.0 } else { CHROMA })
    }

    /// The style of the k-th curve, from 0; curves in one ink differ in style if the theme has several styles.
    fn curve_style(&self, k: usize) -> CurveStyle {
        self.curve_styles[(k + k / self.curve_inks.len()) % self.curve_styles.len()]
    }

    /// The stroke of the k-th curve, from 0.
    pub fn curve_stroke(&self, k: usize) -> Stroke {
        self.stroke(self.curve_ink(k), self.curve_width * self.curve_style(k).width_factor)
    }

    /// The length of a dash of the k-th curve, from 0, as a fraction of the dash and its gap.
    pub fn curve_dash_fraction(&self, k: usize) -> f64 {
        (self.dash_fraction * self.curve_style(k).dash_factor).min(1.0)
    }

    /// An ink halfway to the paper.
    pub fn faded(&self, Color(r, g, b): Color) -> Color {
        let Color(pr, pg, pb) = self.paper;
        let half = |a: u8, b: u8| ((u16::from(a) + u16::from(b)) / 2) as u8;
        Color(half(r, pr), half(g, pg), half(b, pb))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_broader_than_curves_and_curves_than_hairlines() {
        for named in Theme::NAMED {
            let whole = (named.theme)();
            for theme in [whole.clone(), whole.for_crank_length(0.0), whole.for_panel_size(Vector::zeros())] {
                for k in 0..10 {
                    let curve = theme.curve_stroke(k).width;
                    assert!(theme.link_width > curve && curve > theme.hair_width, "{} {k}", named.name);
                }
            }
        }
    }

    #[test]
    fn text_is_legible_in_all_inks() {
        for named in Theme::NAMED {
            let theme = (named.theme)();
            let inks = theme.curve_inks.iter().map(|ink| theme.text_ink(*ink)).chain([theme.ink, theme.grey]);
            inks.for_each(|ink| assert!(ink.contrast(theme.paper) >= 4.5, "{} {ink}", named.name));
        }
    }

    #[test]
    fn ordered_inks_are_visible_and_monotonic_in_lightness() {
        for named in Theme::NAMED {
            let theme = (named.theme)();
            for count in [2, 5, 20] {
                let inks: Vec<Color> =
                    (0..count).map(|k| theme.ordered_ink(f64::from(k) / f64::from(count - 1))).collect();
                assert!(inks.iter().all(|ink| ink.contrast(theme.paper) >= 3.0), "{}: {inks:?}", named.name);
                let is_light = theme.paper.lightness() > 50.0;
                let step = |pair: &[Color]| (pair[0].lightness() < pair[1].lightness()) == is_light;
                assert!(inks.windows(2).all(step), "{}: {inks:?}", named.name);
                let least = if theme.curve_styles.len() > 1 { 1.4 } else { 4.0 };
                let difference = |pair: &[Color]| pair[0].difference(pair[1]) > least;
                assert!(inks.windows(2).all(difference), "{}: {inks:?}", named.name);
            }
        }
    }
}
