//! The linkages that a measure or a column is defined for.

use crate::linkage::{FourBar, Input, JointId, JointKind, KinematicChain, Linkage};

/// The linkages that a quantity is defined for. It depends on the joints of a linkage, not on its dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Every linkage.
    Any,
    /// A four-bar with four pins, whichever of its links is the frame.
    FourBar,
    /// A four-bar that is seen from its frame: McCarthy's angles are measured from there.
    FourBarOnFrame,
    /// An inverted slider-crank: a slot on the crank's pin, or an actuator that drives the crank.
    InvertedSliderCrank,
    /// A four-bar seen from its frame, or an inverted slider-crank.
    FourBarOrInvertedSliderCrank,
    /// A six-bar.
    SixBar,
    /// A linkage with a pin, a slider or a yoke that transmits a force to a link.
    WithDyad,
    /// A linkage with an output link.
    WithOutput,
    /// A linkage whose output link turns.
    WithTurningOutput,
    /// A linkage whose output is a slider.
    WithSlidingOutput,
    /// A linkage with a load.
    WithLoad,
    /// A linkage with a tolerance of its lengths.
    WithTolerance,
    /// A linkage driven by an angle.
    DrivenByAngle,
}

impl Subject {
    /// Whether the quantity is defined for a linkage.
    pub fn includes(self, linkage: &Linkage) -> bool {
        let is_four_bar_on_frame = || linkage.seen_from.is_none() && FourBar::from_linkage(linkage).is_some();
        match self {
            Subject::Any => true,
            Subject::FourBar => FourBar::from_linkage(linkage).is_some(),
            Subject::FourBarOnFrame => is_four_bar_on_frame(),
            Subject::InvertedSliderCrank => is_inverted_slider_crank(linkage),
            Subject::FourBarOrInvertedSliderCrank => is_four_bar_on_frame() || is_inverted_slider_crank(linkage),
            Subject::SixBar => KinematicChain::from_linkage(linkage).is_some_and(|chain| chain.six_bar().is_some()),
            Subject::WithDyad => linkage
                .joints
                .iter()
                .any(|joint| joint.kind.dyad().is_some() || matches!(joint.kind, JointKind::Yoke { .. })),
            Subject::WithOutput => linkage.output().is_some(),
            Subject::WithTurningOutput => linkage.output().is_some_and(|output| !output.is_slider()),
            Subject::WithSlidingOutput => linkage.output().is_some_and(|output| output.is_slider()),
            Subject::WithLoad => linkage.load.is_some(),
            Subject::WithTolerance => linkage.tolerance.is_some(),
            Subject::DrivenByAngle => linkage.input() != Input::Length,
        }
    }

    /// What it is defined for, in the plural, as in "`class` is defined for four-bars only".
    pub fn description(self) -> &'static str {
        match self {
            Subject::Any => "all linkages",
            Subject::FourBar => "four-bars",
            Subject::FourBarOnFrame => "four-bars that are seen from their frame",
            Subject::InvertedSliderCrank => "inverted slider-cranks",
            Subject::FourBarOrInvertedSliderCrank => {
                "four-bars that are seen from their frame, and inverted slider-cranks"
            }
            Subject::SixBar => "six-bars",
            Subject::WithDyad => "linkages with a link driven by a link",
            Subject::WithOutput => "linkages with an output link",
            Subject::WithTurningOutput => "linkages whose output link turns",
            Subject::WithSlidingOutput => "linkages whose output is a slider",
            Subject::WithLoad => "linkages with a `load`",
            Subject::WithTolerance => "linkages with a `tolerance`",
            Subject::DrivenByAngle => "linkages driven by an angle",
        }
    }
}

fn is_inverted_slider_crank(linkage: &Linkage) -> bool {
    let is_crank_pin = |joint: JointId| matches!(linkage.joints[joint].kind, JointKind::Crank { .. });
    let is_slot_or_actuator = |kind: &JointKind| match kind {
        JointKind::Slot { base: [_, pin], .. } => is_crank_pin(*pin),
        JointKind::Piston { .. } => true,
        _ => false,
    };
    linkage.seen_from.is_none() && linkage.joints.iter().any(|joint| is_slot_or_actuator(&joint.kind))
}
