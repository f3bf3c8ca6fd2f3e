//! A linkage whose coupler is the body: a four-bar, a slider-crank or an inverted slider-crank, in the plane of the poses.

use std::sync::{Arc, LazyLock};

use super::body::{Placed, PoseSet};
use super::dyad::Dyad;
use super::pair::{PosedDyad, pins};
use crate::complex::{dot, length, times_i};
use crate::four_bar::mechanism::{Mechanism, placed_parameters};
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{FourBar, PlacedFourBar};
use coupler_curves::linkage_format;
use coupler_curves::template::Template;

/// The linkages that two dyads make, one of them a link, by what the other is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// A link.
    FourBar,
    /// A slider.
    SliderCrank,
    /// A slot, or a bar that slides on a block.
    InvertedSliderCrank,
}

/// A linkage that guides a body, whose point is its coupler point.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// A four-bar.
    FourBar(PlacedFourBar),
    /// A slider-crank.
    SliderCrank(PlacedSliderCrank),
    /// An inverted slider-crank: the coupler is a bar that slides on a block which turns about a pivot.
    InvertedSliderCrank(PlacedInvertedSliderCrank),
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

/// An inverted slider-crank at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedInvertedSliderCrank {
    /// The pivots of the crank and of the block.
    pub pivots: [Point; 2],
    /// The length of the crank.
    pub crank: f64,
    /// How far the pivot of the block is to the right of the coupler's line through the crank pin, in the direction that it has from the crank pin
    /// towards the block in the first pose.
    pub offset: f64,
    /// The coupler point: along that line from the crank pin, and to the left of it.
    pub coupler_point: Vector,
}

static SLIDER_CRANK: LazyLock<Arc<Template>> = LazyLock::new(|| template_of(Form::SliderCrank));
static INVERTED_SLIDER_CRANK: LazyLock<Arc<Template>> = LazyLock::new(|| template_of(Form::InvertedSliderCrank));

fn template_of(form: Form) -> Arc<Template> {
    let templates = linkage_format::parse_templates(form.template_toml());
    Arc::new(templates.expect("the linkage is valid").remove(0))
}

impl Form {
    pub const ALL: [Form; 3] = [Form::FourBar, Form::SliderCrank, Form::InvertedSliderCrank];

    /// That of a crank and another dyad.
    pub fn of(follower: &Dyad) -> Form {
        match follower {
            Dyad::Revolute { .. } => Form::FourBar,
            Dyad::Slider { .. } => Form::SliderCrank,
            Dyad::Slot { .. } => Form::InvertedSliderCrank,
        }
    }

    pub fn template(self) -> Arc<Template> {
        match self {
            Form::FourBar => Mechanism::template(),
            Form::SliderCrank => SLIDER_CRANK.clone(),
            Form::InvertedSliderCrank => INVERTED_SLIDER_CRANK.clone(),
        }
    }

    fn template_toml(self) -> &'static str {
        match self {
            Form::FourBar => Mechanism::TEMPLATE_TOML,
            Form::SliderCrank => include_str!("placed-slider-crank.toml"),
            Form::InvertedSliderCrank => include_str!("placed-inverted-slider-crank.toml"),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Form::FourBar => "four-bar",
            Form::SliderCrank => "slider-crank",
            Form::InvertedSliderCrank => "inverted-slider-crank",
        }
    }
}

impl Guide {
    /// The linkage of two dyads, of which the first is the crank; `None` if that is no link.
    pub(super) fn new(set: &PoseSet, first: &Placed, crank: &PosedDyad, follower: &PosedDyad) -> Option<Guide> {
        let Dyad::Revolute { pivot, .. } = crank.dyad else { return None };
        let [a, b] = pins(crank, follower, 0);
        let size = set.size();
        let rod = length(b - a);
        let along = (b - a) / rod;
        let point = (first.point - a) * along.conj();
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
            Dyad::Slot { pivot: other, .. } => {
                /// Of the sizes of the poses: the place of a foot so near the pivot is rounding, and so is the line's direction from there.
                const NO_OFFSET: f64 = 1e-9;
                let offset = -dot(times_i(along), other - a);
                Guide::InvertedSliderCrank(PlacedInvertedSliderCrank {
                    pivots: [pivot, other].map(|z| set.place(z)),
                    crank: arm,
                    offset: if offset.abs() <= NO_OFFSET { 0.0 } else { size * offset },
                    coupler_point,
                })
            }
        })
    }

    pub(super) fn form(&self) -> Form {
        match self {
            Guide::FourBar(_) => Form::FourBar,
            Guide::SliderCrank(_) => Form::SliderCrank,
            Guide::InvertedSliderCrank(_) => Form::InvertedSliderCrank,
        }
    }

    /// The linkage with its parameters, anywhere in the plane.
    pub fn template(&self) -> Arc<Template> {
        self.form().template()
    }

    /// The linkage as the `[[linkage]]` of a manifest.
    pub fn template_toml(&self) -> &'static str {
        self.form().template_toml()
    }

    /// The name of the linkage: `four-bar`, `slider-crank` or `inverted-slider-crank`.
    pub fn name(&self) -> &'static str {
        self.form().name()
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
            Guide::InvertedSliderCrank(PlacedInvertedSliderCrank { pivots: [o, c], crank, offset, coupler_point }) => {
                let frame = c - o;
                vec![
                    ("frame", frame.norm_squared().sqrt()),
                    ("crank", *crank),
                    ("offset", *offset),
                    ("along", coupler_point.x),
                    ("across", coupler_point.y),
                    ("x", o.x),
                    ("y", o.y),
                    ("turn", trig::degrees(trig::atan2(frame.y, frame.x))),
                ]
            }
        }
    }

    /// The fixed pivots: of the crank, and of the rocker or the block.
    pub fn pivots(&self) -> Vec<Point> {
        match self {
            Guide::FourBar(PlacedFourBar { pivots, .. })
            | Guide::InvertedSliderCrank(PlacedInvertedSliderCrank { pivots, .. }) => pivots.to_vec(),
            Guide::SliderCrank(slider) => vec![slider.pivot],
        }
    }

    /// The family of one cell, the linkage.
    pub fn family(&self) -> Option<Family> {
        let values: Vec<(String, f64)> =
            self.parameters().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        Family::single_cell(self.template(), &values, Sampling::Samples(360)).ok()
    }
}
