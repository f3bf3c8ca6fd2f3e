//! A linkage whose coupler is the body: a four-bar or a slider-crank, in the plane of the poses.

use std::sync::{Arc, LazyLock};

use super::body::{Placed, PoseSet};
use super::dyad::Dyad;
use super::pair::PosedDyad;
use crate::complex::{Complex, dot, length, times_i};
use crate::four_bar::mechanism::{Mechanism, placed_parameters};
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{FourBar, PlacedFourBar};
use coupler_curves::linkage_format;
use coupler_curves::template::Template;

/// A linkage that guides a body, whose point is its coupler point.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// A four-bar.
    FourBar(PlacedFourBar),
    /// A slider-crank.
    SliderCrank(PlacedSliderCrank),
}

/// A slider-crank at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSliderCrank {
    /// The pivot of the crank.
    pub pivot: Point,
    /// The lengths of the crank and of the coupler.
    pub lengths: [f64; 2],
    /// The direction of the slider's line in degrees from the x-axis, towards which the slider is ahead of the crank pin in the first pose.
    pub turn_deg: f64,
    /// How far the line is to the left of the pivot.
    pub offset: f64,
    /// The coupler point: along the coupler from the crank pin towards the slider, and to the left of it.
    pub coupler_point: Vector,
}

static SLIDER_CRANK: LazyLock<Arc<Template>> = LazyLock::new(|| {
    let templates = linkage_format::parse_templates(PlacedSliderCrank::TEMPLATE_TOML);
    Arc::new(templates.expect("the linkage is valid").remove(0))
});

impl PlacedSliderCrank {
    /// The linkage as the `[[linkage]]` of a manifest.
    pub const TEMPLATE_TOML: &'static str = include_str!("placed-slider-crank.toml");

    /// The linkage: a slider-crank anywhere in the plane.
    pub fn template() -> Arc<Template> {
        SLIDER_CRANK.clone()
    }
}

impl Guide {
    /// The linkage of two dyads, of which the first is the crank; `None` if that is a slider.
    pub(super) fn new(set: &PoseSet, first: &Placed, crank: &PosedDyad, follower: &PosedDyad) -> Option<Guide> {
        let Dyad::Revolute { pivot, .. } = crank.dyad else { return None };
        let [a, b] = [crank.pins[0], follower.pins[0]];
        let size = set.size();
        let rod = length(b - a);
        let point = (first.point - a) * (b - a).conj() / rod;
        let coupler_point = Vector::new(size * point.re, size * point.im);
        let arm = size * length(a - pivot);
        Some(match follower.dyad {
            Dyad::Revolute { pivot: other, .. } => Guide::FourBar(PlacedFourBar {
                pivots: [pivot, other].map(|z| set.place(z)),
                lengths: FourBar {
                    frame: size * length(other - pivot),
                    crank: arm,
                    coupler: size * rod,
                    rocker: size * length(b - other),
                },
                coupler_point,
            }),
            Dyad::Slider { normal, .. } => {
                let line = times_i(normal);
                let line = if dot(line, b - a) >= 0.0 { line } else { -line };
                Guide::SliderCrank(PlacedSliderCrank {
                    pivot: set.place(pivot),
                    lengths: [arm, size * rod],
                    turn_deg: trig::degrees(trig::atan2(line.im, line.re)),
                    offset: size * dot(times_i(line), b - pivot),
                    coupler_point,
                })
            }
        })
    }

    /// The linkage with its parameters.
    pub fn template(&self) -> Arc<Template> {
        match self {
            Guide::FourBar(_) => Mechanism::template(),
            Guide::SliderCrank(_) => PlacedSliderCrank::template(),
        }
    }

    /// The linkage as the `[[linkage]]` of a manifest.
    pub fn template_toml(&self) -> &'static str {
        match self {
            Guide::FourBar(_) => Mechanism::TEMPLATE_TOML,
            Guide::SliderCrank(_) => PlacedSliderCrank::TEMPLATE_TOML,
        }
    }

    /// The name of the linkage: `four-bar` or `slider-crank`.
    pub fn name(&self) -> &'static str {
        match self {
            Guide::FourBar(_) => "four-bar",
            Guide::SliderCrank(_) => "slider-crank",
        }
    }

    /// The parameters of [`Guide::template`].
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        match self {
            Guide::FourBar(four_bar) => placed_parameters(four_bar).to_vec(),
            Guide::SliderCrank(slider) => vec![
                ("crank", slider.lengths[0]),
                ("coupler", slider.lengths[1]),
                ("offset", slider.offset),
                ("along", slider.coupler_point.x),
                ("across", slider.coupler_point.y),
                ("x", slider.pivot.x),
                ("y", slider.pivot.y),
                ("turn", slider.turn_deg),
            ],
        }
    }

    /// The fixed pivots: of the crank and, of a four-bar, of the rocker.
    pub fn pivots(&self) -> Vec<Point> {
        match self {
            Guide::FourBar(four_bar) => four_bar.pivots.to_vec(),
            Guide::SliderCrank(slider) => vec![slider.pivot],
        }
    }

    /// The family of one cell, the linkage.
    pub fn family(&self) -> Option<Family> {
        let values: Vec<(String, f64)> =
            self.parameters().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        Family::single_cell(self.template(), &values, Sampling::Samples(360)).ok()
    }

    /// The direction of the coupler from that of the body, as a vector of the body.
    pub(super) fn coupler_of_body(crank: &PosedDyad, follower: &PosedDyad, first: &Placed) -> Complex {
        let of_body = (follower.pins[0] - crank.pins[0]) * first.direction.conj();
        of_body / length(of_body)
    }
}
