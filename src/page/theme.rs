use super::Paper;
use crate::geometry::Vector;
use crate::scene::{Color, Stroke};

/// The inks, weights and sizes of a page, in millimetres.
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
    /// The inks of curves, told apart in colour and in lightness.
    pub curves: [Color; 5],
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

impl Theme {
    /// The theme for a paper: what is right on tabloid, smaller on smaller paper, but never too fine to print.
    pub fn for_paper(paper: Paper) -> Theme {
        let scale = (paper.width / 431.8).min(paper.height / 279.4).clamp(0.3, 2.0);
        let weight = scale.sqrt();
        Theme {
            paper: Color(0xff, 0xfd, 0xf8),
            ink: Color(0x11, 0x11, 0x11),
            grey: Color(0x55, 0x55, 0x55),
            hairline: Color(0xb4, 0xba, 0xc0),
            curves: [
                Color(0x8c, 0x2d, 0x19),
                Color(0x1f, 0x3d, 0x66),
                Color(0x2f, 0x6b, 0x3a),
                Color(0x5b, 0x2d, 0x82),
                Color(0x86, 0x66, 0x14),
            ],
            border: 8.0 * scale,
            margin: 8.0 * scale,
            title: 8.5 * scale,
            source: 3.8 * scale,
            caption: 3.7 * scale,
            note: 3.1 * scale,
            link: 0.7 * weight,
            curve: 0.4 * weight,
            fine: 0.3 * weight,
            hair: 0.15 * weight,
            joint: 0.9 * weight,
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

    /// The ink of the k-th curve, from 0.
    pub fn curve_ink(&self, k: usize) -> Color {
        self.curves[k % self.curves.len()]
    }

    /// An ink halfway to the paper.
    pub fn faded(&self, Color(r, g, b): Color) -> Color {
        let Color(pr, pg, pb) = self.paper;
        let half = |a: u8, b: u8| ((u16::from(a) + u16::from(b)) / 2) as u8;
        Color(half(r, pr), half(g, pg), half(b, pb))
    }
}
