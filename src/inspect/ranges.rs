//! What follows from the lengths of a linkage alone: the kind of a six-bar, the arc of the source's figure, the limits of
//! a rocker, the ranges of an inverted slider-crank.

use std::fmt::Write;

use coupler_curves::geometry::trig;
use coupler_curves::linkage::{BranchArc, FourBar, InvertedSliderCrank, KinematicChain, Linkage, SixBar};
use serde::Serialize;

use crate::format::format_significant;

/// The ranges of a linkage, in degrees and lengths.
pub(super) struct Ranges {
    six_bar: Option<SixBar>,
    arc: Option<BranchArc>,
    /// The crank angles at which the rocker of a four-bar reverses, from the frame line: with crank and coupler extended,
    /// and folded.
    rocker_limits_deg: Option<[Option<f64>; 2]>,
    slider: Option<SliderRanges>,
}

/// The ranges of an inverted slider-crank (McCarthy 2.2).
struct SliderRanges {
    crank_deg: [f64; 2],
    slide: [f64; 2],
    psi_deg: [f64; 2],
}

impl Ranges {
    pub(super) fn new(linkage: &Linkage) -> Ranges {
        let slider = InvertedSliderCrank::from_linkage(linkage).and_then(|slider| {
            Some(SliderRanges {
                crank_deg: slider.crank_range()?.map(trig::degrees),
                slide: slider.slide_range()?,
                psi_deg: slider.psi_range()?.map(trig::degrees),
            })
        });
        Ranges {
            six_bar: KinematicChain::from_linkage(linkage).and_then(|chain| chain.six_bar()),
            arc: linkage.motion_options.figure_arc,
            rocker_limits_deg: FourBar::from_linkage(linkage)
                .map(|four_bar| four_bar.rocker_limits().map(|limit| limit.map(trig::degrees))),
            slider,
        }
    }

    /// Appends a line for each of them but the kind of a six-bar.
    pub(super) fn append_text(&self, out: &mut String) {
        let deg = |value: f64| format!("{}°", format_significant(value, 10));
        // Writing to a string cannot fail.
        if let Some([extended, folded]) = self.rocker_limits_deg {
            let limits = [("extended", extended), ("folded", folded)];
            let reached: Vec<String> =
                limits.into_iter().filter_map(|(word, limit)| Some(format!("±{} ({word})", deg(limit?)))).collect();
            let list = if reached.is_empty() { "none".to_owned() } else { reached.join(", ") };
            let _ = writeln!(out, "limits of the rocker, by the crank's angle from the frame: {list}");
        }
        if let Some(BranchArc { input_deg: [from, to], branch }) = self.arc {
            let _ = writeln!(out, "arc of the source's figure: from {} to {} on branch {branch}", deg(from), deg(to));
        }
        if let Some(SliderRanges { crank_deg: [least, most], slide, psi_deg: [low, high] }) = self.slider {
            let crank =
                if least == 0.0 { "turns fully".to_owned() } else { format!("from {} to {}", deg(least), deg(most)) };
            let [short, long] = slide.map(|slide| format_significant(slide, 10));
            let psi = if high - low == 360.0 {
                "turns fully".to_owned()
            } else {
                format!("from {} to {}", deg(low), deg(high))
            };
            let _ = writeln!(
                out,
                "inverted slider-crank: crank theta {crank}, slide s from {short} to {long}, output psi {psi}; and the mirror image"
            );
        }
    }

    pub(super) fn six_bar_name(&self) -> Option<&'static str> {
        self.six_bar.map(|six_bar| six_bar.name())
    }

    pub(super) fn arc_json(&self) -> Option<ArcJson> {
        self.arc.map(|BranchArc { input_deg: [from, to], branch }| ArcJson { from, to, branch })
    }

    pub(super) fn rocker_limits_json(&self) -> Option<RockerLimitsJson> {
        self.rocker_limits_deg.map(|[extended, folded]| RockerLimitsJson { extended, folded })
    }

    pub(super) fn slider_json(&self) -> Option<SliderJson> {
        let ranges =
            |&SliderRanges { crank_deg, slide, psi_deg }: &SliderRanges| SliderJson { crank_deg, slide, psi_deg };
        self.slider.as_ref().map(ranges)
    }
}

/// The part of the motion that the source's figure shows, for `inspect --json`.
#[derive(Serialize)]
pub(super) struct ArcJson {
    from: f64,
    to: f64,
    branch: i8,
}

/// The limits of a rocker, for `inspect --json`.
#[derive(Serialize)]
pub(super) struct RockerLimitsJson {
    extended: Option<f64>,
    folded: Option<f64>,
}

/// The ranges of an inverted slider-crank, for `inspect --json`.
#[derive(Serialize)]
pub(super) struct SliderJson {
    crank_deg: [f64; 2],
    slide: [f64; 2],
    psi_deg: [f64; 2],
}
