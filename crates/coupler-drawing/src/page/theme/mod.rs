//! What a page looks like: colours, weights, sizes and typeface.

mod named;

pub use named::Named;

use super::Paper;
use super::element::Words;
use crate::scene::{Anchor, Color, Stroke, Typeface};
use coupler_curves::geometry::{Point, Vector};

/// The inks, weights and sizes of a page, in millimetres on tabloid paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    /// The paper's colour.
    pub paper: Color,
    /// Links, joints, titles.
    pub ink: Color,
    /// Secondary text.
    pub grey: Color,
    /// The frame line, the body of ternary links.
    pub hairline: Color,
    /// The inks of curves, told apart in colour and in lightness; one at least.
    pub curves: Vec<Color>,
    /// How curves are told apart besides by their inks; one at least.
    pub manners: Vec<Manner>,
    /// What all texts are set in.
    pub typeface: Typeface,
    /// The part that is drawn of the input a dash and its gap span, more than 0 and 1 at most.
    pub drawn: f64,
    /// The page's border and its distance from the paper's edge.
    pub border: f64,
    /// From the border to what stands in it.
    pub margin: f64,
    /// The em of the title.
    pub title: f64,
    /// The em of the source line and the folio.
    pub source: f64,
    /// The em of captions.
    pub caption: f64,
    /// The em of notes and of numbers beside figures.
    pub note: f64,
    /// The weight of links.
    pub link: f64,
    /// The weight of curves.
    pub curve: f64,
    /// The weight of joints' circles, the border and light curves.
    pub fine: f64,
    /// The weight of hairlines.
    pub hair: f64,
    /// The radius of a joint.
    pub joint: f64,
}

/// How a curve is told from another besides by its ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    /// Its weight, in times that of curves.
    pub weight: f64,
    /// The drawn part of its dashes, in times that of the theme.
    pub drawn: f64,
}

impl Manner {
    /// Curves as they are drawn where ink alone tells them apart.
    pub const PLAIN: Manner = Manner { weight: 1.0, drawn: 1.0 };

    /// Those of five greys: the darkest plain, the faintest broad, the others between them in shorter and longer dashes.
    const OF_GREYS: [Manner; 5] = [
        Manner::PLAIN,
        Manner { weight: 2.2, drawn: 1.0 },
        Manner { weight: 1.5, drawn: 0.4 },
        Manner { weight: 1.0, drawn: 1.5 },
        Manner { weight: 1.9, drawn: 0.7 },
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
    /// The theme on a paper: what is right on tabloid, smaller on smaller paper, but never too fine to print.
    pub fn for_paper(&self, paper: Paper) -> Theme {
        let scale = (paper.width / 431.8).min(paper.height / 279.4).clamp(0.3, 2.0);
        let weight = scale.sqrt();
        Theme {
            border: self.border * scale,
            margin: self.margin * scale,
            title: self.title * scale,
            source: self.source * scale,
            caption: self.caption * scale,
            note: self.note * scale,
            link: self.link * weight,
            curve: self.curve * weight,
            fine: self.fine * weight,
            hair: self.hair * weight,
            joint: self.joint * weight,
            ..self.clone()
        }
    }

    /// The theme for panels of a size: lettering, joints and links are smaller where panels are small, to a third.
    pub fn for_panels(&self, panel: Vector) -> Theme {
        let scale = (panel.x / (12.0 * self.caption)).min(panel.y / (14.0 * self.caption)).clamp(1.0 / 3.0, 1.0);
        let weight = scale.sqrt();
        Theme {
            caption: self.caption * scale,
            note: self.note * scale,
            joint: self.joint * weight,
            link: self.link * weight,
            curve: self.curve * weight,
            fine: self.fine * weight,
            ..self.clone()
        }
    }

    /// A stroke with ends cut square.
    pub fn stroke(&self, color: Color, width: f64) -> Stroke {
        Stroke { color, width, round: false }
    }

    /// A line of text at a place of an area, in the theme's typeface.
    pub(super) fn words(&self, text: &str, at: Point, anchor: Anchor, size: f64, color: Color) -> Words {
        Words::new(text, self.typeface, at, anchor, (size, color))
    }

    /// The ink of the k-th curve, from 0.
    pub fn curve_ink(&self, k: usize) -> Color {
        self.curves[k % self.curves.len()]
    }

    /// The manner of the k-th curve, from 0: curves that have one ink have different manners, where there are several.
    fn manner(&self, k: usize) -> Manner {
        self.manners[(k + k / self.curves.len()) % self.manners.len()]
    }

    /// The stroke of the k-th curve, from 0.
    pub fn curve_stroke(&self, k: usize) -> Stroke {
        self.stroke(self.curve_ink(k), self.curve * self.manner(k).weight)
    }

    /// The drawn part of the dashes of the k-th curve, from 0.
    pub fn curve_drawn(&self, k: usize) -> f64 {
        (self.drawn * self.manner(k).drawn).min(1.0)
    }

    /// An ink halfway to the paper.
    pub fn faded(&self, Color(r, g, b): Color) -> Color {
        let Color(pr, pg, pb) = self.paper;
        let half = |a: u8, b: u8| ((u16::from(a) + u16::from(b)) / 2) as u8;
        Color(half(r, pr), half(g, pg), half(b, pb))
    }
}
