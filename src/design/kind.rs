//! The linkages a design is chosen from, their free proportions, and what is known of these in closed form.
//!
//! A proportion is told against the link that the thesis takes for unity: the crank of Evans's and Hoeken's linkages, the
//! coupler of the others. All are positive and are searched by their logarithms.

use std::sync::Arc;

use super::requirements::P_RANGE;
use coupler_curves::catalogue;
use coupler_curves::geometry::trig;
use coupler_curves::linkage::FourBarClass;
use coupler_curves::template::Template;

/// A linkage of chapter 10, and Hoeken's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LinkageKind {
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
pub enum Driver {
    /// A motor: a link that turns fully.
    Motor,
    /// A rocker that goes there and back.
    Rocker,
}

/// A linkage and what moves it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct DrivenLinkage {
    /// The linkage.
    pub kind: LinkageKind,
    /// What moves it.
    pub input: Driver,
}

impl DrivenLinkage {
    /// Every one there is. A motor drives the crank of Evans's and Hoeken's linkages and the coupler of Chebyshev's, which
    /// Natesan (10.1.1) calls a crank-rocker and is a double-rocker; its rockers may be driven too (4.2).
    pub const ALL: [DrivenLinkage; 6] = [
        DrivenLinkage { kind: LinkageKind::Evans, input: Driver::Motor },
        DrivenLinkage { kind: LinkageKind::Hoeken, input: Driver::Motor },
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Motor },
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Rocker },
        DrivenLinkage { kind: LinkageKind::Watt, input: Driver::Rocker },
        DrivenLinkage { kind: LinkageKind::Roberts, input: Driver::Rocker },
    ];
}

/// One of the free proportions of a linkage.
pub(super) struct Proportion {
    /// Its least and its greatest value.
    pub range: [f64; 2],
    /// The values a search begins with.
    pub start_values: Vec<f64>,
    /// The part of itself that a first step of it is.
    pub relative_step: f64,
    /// Whether it is told against the closed condition, and comes the nearer to 1 the straighter the line is to be.
    pub tends_to_1: bool,
}

impl LinkageKind {
    /// Every linkage.
    pub const ALL: [LinkageKind; 5] =
        [LinkageKind::Evans, LinkageKind::Hoeken, LinkageKind::Chebyshev, LinkageKind::Watt, LinkageKind::Roberts];

    /// Its name in the catalogue.
    pub fn id(self) -> &'static str {
        match self {
            LinkageKind::Evans => "evans",
            LinkageKind::Hoeken => "hoeken",
            LinkageKind::Chebyshev => "chebyshev",
            LinkageKind::Watt => "watt",
            LinkageKind::Roberts => "roberts",
        }
    }

    /// The closed condition on its proportions, and where it is from.
    pub fn closed_condition(self) -> &'static str {
        match self {
            LinkageKind::Evans | LinkageKind::Hoeken => "(8.10)",
            LinkageKind::Chebyshev => "(8.19)",
            // (8.19) makes a Watt linkage a Grashof one, which by (4.5) is none. Watt's own has its coupler square to both
            // rockers in mid-stroke.
            LinkageKind::Watt => "p^2 = (r + s)^2 + a^2",
            LinkageKind::Roberts => "p = 2 a, b = r",
        }
    }

    /// Its template; `None` only if the catalogue has lost it.
    pub(super) fn template(self) -> Option<Arc<Template>> {
        catalogue::find(self.id())
    }

    /// Whether a linkage of this class is of the kind (Natesan, chapter 4).
    pub(super) fn allows_class(self, class: FourBarClass) -> bool {
        match self {
            LinkageKind::Evans | LinkageKind::Hoeken => class == FourBarClass::CrankRocker,
            LinkageKind::Chebyshev => class == FourBarClass::DoubleRocker,
            LinkageKind::Watt => class == FourBarClass::TripleRocker,
            LinkageKind::Roberts => class == FourBarClass::DoubleRocker || class == FourBarClass::TripleRocker,
        }
    }

    /// Its free proportions, `p` always the first. The straighter the line is to be, the nearer its best proportions are to
    /// the closed condition: where a path bends as `x^4`, ripples as high as a part T of its length go with T^(2/3).
    pub(super) fn free_proportions(self, tolerance: f64) -> Vec<Proportion> {
        let spread = (0.1 * trig::pow(tolerance / 0.001, 2.0 / 3.0)).clamp(1e-4, 0.3);
        let about = |parts: &[f64], wide: &[f64]| {
            let mut values: Vec<f64> =
                parts.iter().map(|part| 1.0 + spread * part).chain(wide.iter().copied()).collect();
            values.sort_by(f64::total_cmp);
            Proportion { range: [0.3, 3.0], start_values: values, relative_step: 0.15 * spread, tends_to_1: true }
        };
        let frame = |values: &[f64]| Proportion {
            range: P_RANGE,
            start_values: values.to_vec(),
            relative_step: 0.08,
            tends_to_1: false,
        };
        let free = |range, values: &[f64]| Proportion {
            range,
            start_values: values.to_vec(),
            relative_step: 0.03,
            tends_to_1: false,
        };
        const NEAR: [f64; 7] = [-1.0, -0.5, -0.25, -0.1, 0.0, 0.3, 1.0];
        const FRAME: [f64; 10] = [1.1, 1.3, 1.6, 1.9, 2.2, 2.6, 3.2, 4.0, 5.0, 6.5];
        match self {
            LinkageKind::Evans => vec![
                frame(&[1.2, 1.6, 2.0, 2.6, 3.4, 4.5, 6.0]),
                about(&NEAR, &[0.75, 1.3]),
                free([0.2, 6.0], &[1.3, 1.65, 2.0, 2.3, 2.7]),
            ],
            LinkageKind::Hoeken => vec![frame(&FRAME), about(&NEAR, &[0.75, 1.3])],
            LinkageKind::Chebyshev => vec![frame(&FRAME), about(&NEAR, &[]), free([0.1, 0.9], &[0.5])],
            LinkageKind::Watt => vec![
                frame(&[1.5, 2.0, 2.6, 3.3, 4.2, 5.5, 7.0]),
                about(&[-1.0, -0.4, 0.0, 0.4, 1.0], &[]),
                free([0.2, 5.0], &[1.0, 1.8]),
                free([0.5, 1.5], &[0.93, 1.0, 1.07]),
            ],
            LinkageKind::Roberts => vec![
                frame(&[1.3, 1.6, 1.8, 2.0, 2.3, 2.7, 3.3]),
                // Longer rockers would hang the point far from a short coupler: they cannot be built stiff.
                free([1.01, 8.0], &[1.3, 1.8, 2.5, 3.5, 5.0, 7.0]),
                about(&NEAR, &[0.7, 0.8]),
            ],
        }
    }

    /// Proportions found at one tolerance as they are likely to be at another.
    pub(super) fn proportions_at_tolerance(self, of: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
        let share = trig::pow(to / from, 2.0 / 3.0);
        let all = self.free_proportions(to);
        of.iter().zip(all).map(|(&x, free)| if free.tends_to_1 { 1.0 + (x - 1.0) * share } else { x }).collect()
    }

    /// The symmetric linkage next to some proportions: its coupler point in the place that makes the curve symmetric, and
    /// of Watt's both rockers equal.
    pub(super) fn symmetric_proportions(self, of: &[f64]) -> Option<Vec<f64>> {
        match self {
            LinkageKind::Evans => Some(vec![of[0], of[1], 2.0]),
            LinkageKind::Chebyshev => Some(vec![of[0], of[1], 0.5]),
            LinkageKind::Watt => Some(vec![of[0], of[1], 1.0, 1.0]),
            LinkageKind::Hoeken | LinkageKind::Roberts => None,
        }
    }

    /// The template's values, the unit link 1, for some proportions.
    pub(super) fn template_values(self, of: &[f64]) -> Vec<f64> {
        let p = of[0];
        // (8.10) and (8.19).
        let straight = |p: f64| (1.0 + p) * (1.0 + p).sqrt() / 2.0;
        match self {
            LinkageKind::Evans => vec![p, 1.0, of[1] * straight(p), of[1] * straight(p), of[2]],
            LinkageKind::Hoeken => vec![p, 1.0, of[1] * straight(p)],
            LinkageKind::Chebyshev => vec![p, of[1] * straight(p), of[1] * straight(p), 1.0, of[2]],
            LinkageKind::Watt => {
                // Both rockers by their sum and quotient; the point divides the coupler as they do, inversely.
                let both = of[1] * (p * p - 1.0).sqrt();
                let (r, s) = (both / (1.0 + of[2]), both * of[2] / (1.0 + of[2]));
                vec![p, r, s, 1.0, of[3] * of[2] / (1.0 + of[2])]
            }
            LinkageKind::Roberts => {
                let r = of[1] * (p - 1.0) / 2.0;
                let height = of[2] * level_point_depth(p, r);
                vec![p, r, r, 1.0, (height * height + 0.25).sqrt()]
            }
        }
    }

    /// The proportions that the closed condition gives for a `p`: none, one, or a few to choose from.
    pub(super) fn closed_proportions(self, p: f64) -> Vec<Vec<f64>> {
        match self {
            LinkageKind::Evans => vec![vec![p, 1.0, 2.0]],
            LinkageKind::Hoeken => vec![vec![p, 1.0]],
            LinkageKind::Chebyshev => vec![vec![p, 1.0, 0.5]],
            LinkageKind::Watt => vec![vec![p, 1.0, 1.0, 1.0]],
            LinkageKind::Roberts if p == 2.0 => {
                let with = |r: f64| vec![p, 2.0 * r, (r * r - 0.25).sqrt() / level_point_depth(p, r)];
                (3..=15).map(|k| with(f64::from(k) / 4.0)).collect()
            }
            LinkageKind::Roberts => Vec::new(),
        }
    }

    /// Whether a parameter of its template is a length: `k` is a part of the coupler.
    pub(super) fn is_length_parameter(name: &str) -> bool {
        name != "k"
    }
}

/// How far below the coupler of a symmetric Roberts linkage the point is whose path is level without bend in the middle.
///
/// There the rockers, at equal slopes, meet in the instant centre; a point straight below it moves without bend where the
/// inflection circle is, whose diameter is by Euler and Savary `r^2 a p / ((p - a)^2 h)`, the coupler `h` above the frame.
fn level_point_depth(p: f64, r: f64) -> f64 {
    let half = (p - 1.0) / 2.0;
    let h = (r * r - half * half).max(0.0).sqrt();
    r * r * p / ((p - 1.0) * (p - 1.0) * h) - h / (p - 1.0)
}
