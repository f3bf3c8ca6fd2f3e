//! The linkages of straight-line synthesis, their free proportions, and the closed conditions on these.
//!
//! Proportions are relative to the link of length 1 in Natesan's thesis: the crank of Evans's and Hoeken's linkages,
//! the coupler of the others. All are positive, and the search varies their logarithms.

use std::sync::Arc;

use coupler_curves::catalogue;
use coupler_curves::geometry::trig;
use coupler_curves::linkage::FourBarClass;
use coupler_curves::template::Template;

/// A straight-line linkage: those of Natesan, chapter 10, and Hoeken's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LinkageKind {
    /// A crank-rocker, its coupler point beyond the rocker pin.
    Evans,
    /// Evans's linkage with equal coupler and rocker, and the coupler point as far beyond the rocker pin as that is
    /// from the crank pin.
    Hoeken,
    /// A double-rocker with crossed rockers, whose coupler turns fully.
    Chebyshev,
    /// A triple-rocker with crossed rockers; its curve is a figure eight.
    Watt,
    /// An open double- or triple-rocker, with its coupler point off the coupler line.
    Roberts,
}

/// What drives a linkage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Driver {
    /// A motor, on a link that turns fully.
    Motor,
    /// A rocker that oscillates.
    Rocker,
}

/// A linkage and its driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct DrivenLinkage {
    /// The linkage.
    pub kind: LinkageKind,
    /// Its driver.
    pub input: Driver,
}

impl DrivenLinkage {
    /// All combinations. A motor drives the crank of Evans's and Hoeken's linkages and the coupler of Chebyshev's.
    /// Natesan (10.1.1) calls the latter a crank-rocker, but it is a double-rocker; its rockers may be driven too
    /// (4.2).
    pub const ALL: [DrivenLinkage; 6] = [
        DrivenLinkage { kind: LinkageKind::Evans, input: Driver::Motor },
        DrivenLinkage { kind: LinkageKind::Hoeken, input: Driver::Motor },
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Motor },
        DrivenLinkage { kind: LinkageKind::Chebyshev, input: Driver::Rocker },
        DrivenLinkage { kind: LinkageKind::Watt, input: Driver::Rocker },
        DrivenLinkage { kind: LinkageKind::Roberts, input: Driver::Rocker },
    ];
}

/// The range of `p`, the frame over the unit link.
pub const P_RANGE: [f64; 2] = [1.02, 12.0];

/// A free proportion of a linkage.
pub(super) struct Proportion {
    /// The least and the greatest value.
    pub range: [f64; 2],
    /// The values of the initial sweep.
    pub start_values: Vec<f64>,
    /// The first step of the search, relative to the value.
    pub relative_step: f64,
    /// Whether it is relative to the closed condition, and tends to 1 as the tolerance becomes smaller.
    pub tends_to_1: bool,
}

impl LinkageKind {
    /// Every linkage.
    pub const ALL: [LinkageKind; 5] =
        [LinkageKind::Evans, LinkageKind::Hoeken, LinkageKind::Chebyshev, LinkageKind::Watt, LinkageKind::Roberts];

    /// Its id in the catalogue.
    pub fn id(self) -> &'static str {
        match self {
            LinkageKind::Evans => "evans",
            LinkageKind::Hoeken => "hoeken",
            LinkageKind::Chebyshev => "chebyshev",
            LinkageKind::Watt => "watt",
            LinkageKind::Roberts => "roberts",
        }
    }

    /// The closed condition on its proportions: an equation of Natesan, or the condition itself.
    pub fn closed_condition(self) -> &'static str {
        match self {
            LinkageKind::Evans | LinkageKind::Hoeken => "(8.10)",
            LinkageKind::Chebyshev => "(8.19)",
            // With (8.19) a Watt linkage would be a Grashof linkage, which (4.5) excludes. Watt's own linkage has its
            // coupler perpendicular to both rockers in mid-stroke.
            LinkageKind::Watt => "p^2 = (r + s)^2 + a^2",
            LinkageKind::Roberts => "p = 2 a, b = r",
        }
    }

    /// Its template in the catalogue.
    pub(super) fn template(self) -> Option<Arc<Template>> {
        catalogue::find(self.id())
    }

    /// Whether a linkage of this kind may have this class (Natesan, chapter 4).
    pub(super) fn allows_class(self, class: FourBarClass) -> bool {
        match self {
            LinkageKind::Evans | LinkageKind::Hoeken => class == FourBarClass::CrankRocker,
            LinkageKind::Chebyshev => class == FourBarClass::DoubleRocker,
            LinkageKind::Watt => class == FourBarClass::TripleRocker,
            LinkageKind::Roberts => class == FourBarClass::DoubleRocker || class == FourBarClass::TripleRocker,
        }
    }

    /// Its free proportions, `p` first. The smaller the tolerance T, the nearer the best proportions are to the closed
    /// condition: where the path deviates from a line as `x^4`, they differ from it by terms of order T^(2/3).
    pub(super) fn free_proportions(self, tolerance: f64) -> Vec<Proportion> {
        let spread = (0.1 * trig::pow(tolerance / 0.001, 2.0 / 3.0)).clamp(1e-4, 0.3);
        let near_1 = |deviations: &[f64], others: &[f64]| {
            let mut values: Vec<f64> =
                deviations.iter().map(|deviation| 1.0 + spread * deviation).chain(others.iter().copied()).collect();
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
                near_1(&NEAR, &[0.75, 1.3]),
                free([0.2, 6.0], &[1.3, 1.65, 2.0, 2.3, 2.7]),
            ],
            LinkageKind::Hoeken => vec![frame(&FRAME), near_1(&NEAR, &[0.75, 1.3])],
            LinkageKind::Chebyshev => vec![frame(&FRAME), near_1(&NEAR, &[]), free([0.1, 0.9], &[0.5])],
            LinkageKind::Watt => vec![
                frame(&[1.5, 2.0, 2.6, 3.3, 4.2, 5.5, 7.0]),
                near_1(&[-1.0, -0.4, 0.0, 0.4, 1.0], &[]),
                free([0.2, 5.0], &[1.0, 1.8]),
                free([0.5, 1.5], &[0.93, 1.0, 1.07]),
            ],
            LinkageKind::Roberts => vec![
                frame(&[1.3, 1.6, 1.8, 2.0, 2.3, 2.7, 3.3]),
                // Longer rockers would place the point far from a short coupler, which cannot be built stiff.
                free([1.01, 8.0], &[1.3, 1.8, 2.5, 3.5, 5.0, 7.0]),
                near_1(&NEAR, &[0.7, 0.8]),
            ],
        }
    }

    /// Extrapolates proportions found at one tolerance to another.
    pub(super) fn proportions_at_tolerance(self, proportions: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
        let factor = trig::pow(to / from, 2.0 / 3.0);
        let all = self.free_proportions(to);
        proportions
            .iter()
            .zip(all)
            .map(|(&x, free)| if free.tends_to_1 { 1.0 + (x - 1.0) * factor } else { x })
            .collect()
    }

    /// The nearest proportions with a symmetric curve: those of the coupler point changed, and in Watt's linkage the
    /// rockers equal.
    pub(super) fn symmetric_proportions(self, proportions: &[f64]) -> Option<Vec<f64>> {
        match self {
            LinkageKind::Evans => Some(vec![proportions[0], proportions[1], 2.0]),
            LinkageKind::Chebyshev => Some(vec![proportions[0], proportions[1], 0.5]),
            LinkageKind::Watt => Some(vec![proportions[0], proportions[1], 1.0, 1.0]),
            LinkageKind::Hoeken | LinkageKind::Roberts => None,
        }
    }

    /// The values of the template's parameters for some proportions, with a unit link of length 1.
    pub(super) fn template_values(self, proportions: &[f64]) -> Vec<f64> {
        let p = proportions[0];
        // (8.10) and (8.19).
        let straight = |p: f64| (1.0 + p) * (1.0 + p).sqrt() / 2.0;
        match self {
            LinkageKind::Evans => {
                vec![p, 1.0, proportions[1] * straight(p), proportions[1] * straight(p), proportions[2]]
            }
            LinkageKind::Hoeken => vec![p, 1.0, proportions[1] * straight(p)],
            LinkageKind::Chebyshev => {
                vec![p, proportions[1] * straight(p), proportions[1] * straight(p), 1.0, proportions[2]]
            }
            LinkageKind::Watt => {
                // The proportions give the sum and the quotient of the rockers; the point divides the coupler in their
                // inverse ratio.
                let both = proportions[1] * (p * p - 1.0).sqrt();
                let (r, s) = (both / (1.0 + proportions[2]), both * proportions[2] / (1.0 + proportions[2]));
                vec![p, r, s, 1.0, proportions[3] * proportions[2] / (1.0 + proportions[2])]
            }
            LinkageKind::Roberts => {
                let r = proportions[1] * (p - 1.0) / 2.0;
                let height = proportions[2] * level_point_depth(p, r);
                vec![p, r, r, 1.0, (height * height + 0.25).sqrt()]
            }
        }
    }

    /// The proportions by the closed condition for a `p`: none, one, or several to choose from.
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

    /// Whether a parameter of a template is a length; `k` is a ratio.
    pub(super) fn is_length_parameter(name: &str) -> bool {
        name != "k"
    }
}

/// The depth below the coupler of a symmetric Roberts linkage at which the path of a point is level and has zero
/// curvature in mid-stroke.
///
/// There the rockers have equal slopes and meet in the instant centre. A point straight below it has zero curvature on
/// the inflection circle, whose diameter by Euler and Savary is `r^2 a p / ((p - a)^2 h)`, with the coupler `h` above
/// the frame.
fn level_point_depth(p: f64, r: f64) -> f64 {
    let half = (p - 1.0) / 2.0;
    let h = (r * r - half * half).max(0.0).sqrt();
    r * r * p / ((p - 1.0) * (p - 1.0) * h) - h / (p - 1.0)
}
