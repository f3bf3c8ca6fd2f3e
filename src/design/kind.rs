//! The linkages a design is chosen from, their free proportions, and what is known of these in closed form.
//!
//! A proportion is told against the link that the thesis takes for unity: the crank of Evans's and Hoeken's linkages, the
//! coupler of the others. All are positive and are searched by their logarithms.

use std::sync::Arc;

use super::wishes::FRAMES;
use coupler_curves::catalogue;
use coupler_curves::geometry::trig;
use coupler_curves::linkage::Class;
use coupler_curves::template::Template;

/// A linkage of chapter 10, and Hoeken's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A crank-rocker, its coupler point beyond the rocker pin.
    Evans,
    /// Evans's with coupler and rocker equal and the coupler point as far again beyond the rocker pin.
    Hoeken,
    /// A double-rocker with crossed rockers, whose coupler turns fully.
    Chebyshev,
    /// A triple-rocker with crossed rockers: its curve is a figure of eight.
    Watt,
    /// An open double- or triple-rocker, its coupler point off the coupler's line.
    Roberts,
}

/// What moves a linkage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Input {
    /// A motor: a link that turns fully.
    Motor,
    /// A rocker that goes there and back.
    Rocker,
}

/// A linkage and what moves it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Arrangement {
    /// The linkage.
    pub kind: Kind,
    /// What moves it.
    pub input: Input,
}

impl Arrangement {
    /// Every one there is. A motor drives the crank of Evans's and Hoeken's linkages and the coupler of Chebyshev's, which
    /// Natesan (10.1.1) calls a crank-rocker and is a double-rocker; its rockers may be driven too (4.2).
    pub const ALL: [Arrangement; 6] = [
        Arrangement { kind: Kind::Evans, input: Input::Motor },
        Arrangement { kind: Kind::Hoeken, input: Input::Motor },
        Arrangement { kind: Kind::Chebyshev, input: Input::Motor },
        Arrangement { kind: Kind::Chebyshev, input: Input::Rocker },
        Arrangement { kind: Kind::Watt, input: Input::Rocker },
        Arrangement { kind: Kind::Roberts, input: Input::Rocker },
    ];
}

/// One of the free proportions of a linkage.
pub(super) struct Proportion {
    /// Its least and its greatest value.
    pub range: [f64; 2],
    /// The values a search begins with.
    pub values: Vec<f64>,
    /// The part of itself that a first step of it is.
    pub step: f64,
    /// Whether it is told against the closed condition, and comes the nearer to 1 the straighter the line is to be.
    pub nears_1: bool,
}

impl Kind {
    /// Every linkage.
    pub const ALL: [Kind; 5] = [Kind::Evans, Kind::Hoeken, Kind::Chebyshev, Kind::Watt, Kind::Roberts];

    /// Its name in the catalogue.
    pub fn id(self) -> &'static str {
        match self {
            Kind::Evans => "evans",
            Kind::Hoeken => "hoeken",
            Kind::Chebyshev => "chebyshev",
            Kind::Watt => "watt",
            Kind::Roberts => "roberts",
        }
    }

    /// The closed condition on its proportions, and where it is from.
    pub fn condition(self) -> &'static str {
        match self {
            Kind::Evans | Kind::Hoeken => "(8.10)",
            Kind::Chebyshev => "(8.19)",
            // (8.19) makes a Watt linkage a Grashof one, which by (4.5) is none. Watt's own has its coupler square to both
            // rockers in mid-stroke.
            Kind::Watt => "p^2 = (r + s)^2 + a^2",
            Kind::Roberts => "p = 2 a, b = r",
        }
    }

    /// Its template; `None` only if the catalogue has lost it.
    pub(super) fn template(self) -> Option<Arc<Template>> {
        catalogue::find(self.id())
    }

    /// Whether a linkage of this class is of the kind (Natesan, chapter 4).
    pub(super) fn is_of(self, class: Class) -> bool {
        match self {
            Kind::Evans | Kind::Hoeken => class == Class::CrankRocker,
            Kind::Chebyshev => class == Class::DoubleRocker,
            Kind::Watt => class == Class::TripleRocker,
            Kind::Roberts => class == Class::DoubleRocker || class == Class::TripleRocker,
        }
    }

    /// Its free proportions, `p` always the first. The straighter the line is to be, the nearer its best proportions are to
    /// the closed condition: where a path bends as `x^4`, ripples as high as a part T of its length go with T^(2/3).
    pub(super) fn proportions(self, tolerance: f64) -> Vec<Proportion> {
        let spread = (0.1 * trig::pow(tolerance / 0.001, 2.0 / 3.0)).clamp(1e-4, 0.3);
        let about = |parts: &[f64], wide: &[f64]| {
            let mut values: Vec<f64> =
                parts.iter().map(|part| 1.0 + spread * part).chain(wide.iter().copied()).collect();
            values.sort_by(f64::total_cmp);
            Proportion { range: [0.3, 3.0], values, step: 0.15 * spread, nears_1: true }
        };
        let frame = |values: &[f64]| Proportion { range: FRAMES, values: values.to_vec(), step: 0.08, nears_1: false };
        let free = |range, values: &[f64]| Proportion { range, values: values.to_vec(), step: 0.03, nears_1: false };
        const NEAR: [f64; 7] = [-1.0, -0.5, -0.25, -0.1, 0.0, 0.3, 1.0];
        const FRAME: [f64; 10] = [1.1, 1.3, 1.6, 1.9, 2.2, 2.6, 3.2, 4.0, 5.0, 6.5];
        match self {
            Kind::Evans => vec![
                frame(&[1.2, 1.6, 2.0, 2.6, 3.4, 4.5, 6.0]),
                about(&NEAR, &[0.75, 1.3]),
                free([0.2, 6.0], &[1.3, 1.65, 2.0, 2.3, 2.7]),
            ],
            Kind::Hoeken => vec![frame(&FRAME), about(&NEAR, &[0.75, 1.3])],
            Kind::Chebyshev => vec![frame(&FRAME), about(&NEAR, &[]), free([0.1, 0.9], &[0.5])],
            Kind::Watt => vec![
                frame(&[1.5, 2.0, 2.6, 3.3, 4.2, 5.5, 7.0]),
                about(&[-1.0, -0.4, 0.0, 0.4, 1.0], &[]),
                free([0.2, 5.0], &[1.0, 1.8]),
                free([0.5, 1.5], &[0.93, 1.0, 1.07]),
            ],
            Kind::Roberts => vec![
                frame(&[1.3, 1.6, 1.8, 2.0, 2.3, 2.7, 3.3]),
                // Longer rockers would hang the point far from a short coupler: they cannot be built stiff.
                free([1.01, 8.0], &[1.3, 1.8, 2.5, 3.5, 5.0, 7.0]),
                about(&NEAR, &[0.7, 0.8]),
            ],
        }
    }

    /// Proportions found at one tolerance as they are likely to be at another.
    pub(super) fn carried(self, of: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
        let share = trig::pow(to / from, 2.0 / 3.0);
        let all = self.proportions(to);
        of.iter().zip(all).map(|(&x, free)| if free.nears_1 { 1.0 + (x - 1.0) * share } else { x }).collect()
    }

    /// The symmetric linkage next to some proportions: its coupler point in the place that makes the curve symmetric, and
    /// of Watt's both rockers equal.
    pub(super) fn symmetric(self, of: &[f64]) -> Option<Vec<f64>> {
        match self {
            Kind::Evans => Some(vec![of[0], of[1], 2.0]),
            Kind::Chebyshev => Some(vec![of[0], of[1], 0.5]),
            Kind::Watt => Some(vec![of[0], of[1], 1.0, 1.0]),
            Kind::Hoeken | Kind::Roberts => None,
        }
    }

    /// The template's values, the unit link 1, for some proportions.
    pub(super) fn values(self, of: &[f64]) -> Vec<f64> {
        let p = of[0];
        // (8.10) and (8.19).
        let straight = |p: f64| (1.0 + p) * (1.0 + p).sqrt() / 2.0;
        match self {
            Kind::Evans => vec![p, 1.0, of[1] * straight(p), of[1] * straight(p), of[2]],
            Kind::Hoeken => vec![p, 1.0, of[1] * straight(p)],
            Kind::Chebyshev => vec![p, of[1] * straight(p), of[1] * straight(p), 1.0, of[2]],
            Kind::Watt => {
                // Both rockers by their sum and quotient; the point divides the coupler as they do, inversely.
                let both = of[1] * (p * p - 1.0).sqrt();
                let (r, s) = (both / (1.0 + of[2]), both * of[2] / (1.0 + of[2]));
                vec![p, r, s, 1.0, of[3] * of[2] / (1.0 + of[2])]
            }
            Kind::Roberts => {
                let r = of[1] * (p - 1.0) / 2.0;
                let height = of[2] * level(p, r);
                vec![p, r, r, 1.0, (height * height + 0.25).sqrt()]
            }
        }
    }

    /// The proportions that the closed condition gives for a `p`: none, one, or a few to choose from.
    pub(super) fn closed(self, p: f64) -> Vec<Vec<f64>> {
        match self {
            Kind::Evans => vec![vec![p, 1.0, 2.0]],
            Kind::Hoeken => vec![vec![p, 1.0]],
            Kind::Chebyshev => vec![vec![p, 1.0, 0.5]],
            Kind::Watt => vec![vec![p, 1.0, 1.0, 1.0]],
            Kind::Roberts if p == 2.0 => {
                let with = |r: f64| vec![p, 2.0 * r, (r * r - 0.25).sqrt() / level(p, r)];
                (3..=15).map(|k| with(f64::from(k) / 4.0)).collect()
            }
            Kind::Roberts => Vec::new(),
        }
    }

    /// Whether a parameter of its template is a length: `k` is a part of the coupler.
    pub(super) fn is_length(name: &str) -> bool {
        name != "k"
    }
}

/// How far below the coupler of a symmetric Roberts linkage the point is whose path is level without bend in the middle.
///
/// There the rockers, at equal slopes, meet in the instant centre; a point straight below it moves without bend where the
/// inflection circle is, whose diameter is by Euler and Savary `r^2 a p / ((p - a)^2 h)`, the coupler `h` above the frame.
fn level(p: f64, r: f64) -> f64 {
    let half = (p - 1.0) / 2.0;
    let h = (r * r - half * half).max(0.0).sqrt();
    r * r * p / ((p - 1.0) * (p - 1.0) * h) - h / (p - 1.0)
}
