use super::MAX_DYADS;

/// Why a joint cannot be placed as described, at any input.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// One joint was given where two different joints are required.
    #[error("`{joint}` is placed from `{base}` and `{base}`, which are the same joint")]
    RepeatedJoint {
        /// The joint to place.
        joint: String,
        /// The joint given twice.
        base: String,
    },
    /// A rigid point is placed from joints of different links.
    #[error("`{joint}` needs a link with both `{}` and `{}`, but no link has both", base[0], base[1])]
    NoCommonLink {
        /// The joint to place.
        joint: String,
        /// The joints it is placed from.
        base: [String; 2],
    },
    /// A length is negative, zero or not finite.
    #[error("the length of `{joint}` must be positive, found {length}")]
    InvalidLength {
        /// The joint to place.
        joint: String,
        /// The length.
        length: f64,
    },
    /// The joints that define a direction coincide.
    #[error("`{joint}` is placed along the line from `{}` to `{}`, but these coincide", base[0], base[1])]
    NoDirection {
        /// The joint to place.
        joint: String,
        /// The joints that coincide.
        base: [String; 2],
    },
    /// Two distances and the distance of the joints they are measured from do not form a triangle.
    #[error("`{joint}` cannot be {} from one joint and {} from another {span} away", distances[0], distances[1])]
    NoTriangle {
        /// The joint to place.
        joint: String,
        /// Its distances.
        distances: [f64; 2],
        /// The distance of the joints they are measured from.
        span: f64,
    },
    /// A point is on a sliding link, and its two joints identify more than one.
    #[error("`{joint}` is ambiguous: more than one link slides on the line of `{}` and `{}`", base[0], base[1])]
    AmbiguousLink {
        /// The joint to place.
        joint: String,
        /// The joints it is placed from.
        base: [String; 2],
    },
    /// What should slide on a line is held by a joint of the link with that line.
    #[error("`{joint}` cannot slide: `{base}`, which holds it, is on the link with the line")]
    NothingSlides {
        /// The joint to place.
        joint: String,
        /// The joint that holds it.
        base: String,
    },
    /// The slot of a yoke is parallel to its guide.
    #[error("the slot of `{joint}` is parallel to its guide")]
    SlotParallelToGuide {
        /// The joint to place.
        joint: String,
    },
    /// A gear ratio is not of whole numbers from 1 to [`Error::MAX_GEAR_RATIO`] or their negatives.
    #[error("`{joint}` has the gear ratio {} to {}, but both must be whole numbers, from 1 to {} or their negatives in lowest terms", ratio[0], ratio[1], Error::MAX_GEAR_RATIO)]
    InvalidRatio {
        /// The joint to place.
        joint: String,
        /// The ratio.
        ratio: [f64; 2],
    },
    /// A rack whose pinion has no radius.
    #[error("the rack `{joint}` has a pinion of radius 0 and does not move")]
    NoPitchRadius {
        /// The joint to place.
        joint: String,
    },
    /// A linkage with a rack, which does not come back after turns of its pinion, without a range of the input.
    #[error(
        "the rack `{joint}` does not come back as its pinion turns: the linkage has no range of the input of less than {} turns",
        Error::MAX_RACK_TURNS
    )]
    RackWithoutRange {
        /// The joint.
        joint: String,
    },
    /// The output link is given by a joint that is neither a slider's nor a yoke's nor a rack's.
    #[error("`output_link` names `{joint}`, which is not a slider")]
    NotASlider {
        /// The joint.
        joint: String,
    },
    /// The output link is the one that is at rest.
    #[error("`output_link` names `{}` and `{}`, which are at rest", base[0], base[1])]
    OutputAtRest {
        /// The joints that it is given by.
        base: [String; 2],
    },
    /// More dyads than [`MAX_DYADS`].
    #[error("`{joint}` is one dyad too many: a linkage may have at most {MAX_DYADS}")]
    TooManyDyads {
        /// The joint to place.
        joint: String,
    },
}

impl Error {
    /// The greatest number in a gear ratio; a circuit may take that many turns.
    pub const MAX_GEAR_RATIO: u64 = 100;

    /// The range of the input of a linkage with a rack has fewer turns.
    pub const MAX_RACK_TURNS: u32 = 10;

    /// The joint that cannot be placed; `seen_from` where its joints define no frame, and `output_link` where its joints
    /// define no output.
    pub fn joint(&self) -> &str {
        match self {
            Error::RepeatedJoint { joint, .. }
            | Error::NoCommonLink { joint, .. }
            | Error::InvalidLength { joint, .. }
            | Error::NoDirection { joint, .. }
            | Error::NoTriangle { joint, .. }
            | Error::AmbiguousLink { joint, .. }
            | Error::NothingSlides { joint, .. }
            | Error::SlotParallelToGuide { joint }
            | Error::InvalidRatio { joint, .. }
            | Error::NoPitchRadius { joint }
            | Error::RackWithoutRange { joint }
            | Error::TooManyDyads { joint } => joint,
            Error::NotASlider { .. } | Error::OutputAtRest { .. } => "output_link",
        }
    }

    /// How to fix it, for `help:`.
    pub fn help(&self) -> &'static str {
        match self {
            Error::RepeatedJoint { .. } => "name two different joints",
            Error::NoCommonLink { .. } => {
                "name two joints of one link: two fixed ones, a crank's, or a dyad's and its base"
            }
            Error::InvalidLength { .. } => "give a length greater than 0",
            Error::NoDirection { .. } => "name two joints at different points",
            Error::NoTriangle { .. } => "give distances that form a triangle with it",
            Error::AmbiguousLink { .. } => {
                "give each of these links its own pivot, or its own second joint of the line"
            }
            Error::NothingSlides { .. } => "slide on a line of another link, or make one link of the two",
            Error::SlotParallelToGuide { .. } => "give an angle between 0 and 180 deg, as in angle = \"90 deg\"",
            Error::InvalidRatio { .. } => "write it like ratio = [2, 3]",
            Error::NoPitchRadius { .. } => "give a radius that is not 0",
            Error::RackWithoutRange { .. } => {
                "add the range to the [[linkage]], as in input = { from = \"0 deg\", to = \"270 deg\" }"
            }
            Error::NotASlider { .. } => {
                "name a joint with `slide`, `yoke` or `rack`, or two joints of the link, as in output_link = [\"C\", \"B\"]"
            }
            Error::OutputAtRest { .. } => "name two joints of a moving link",
            Error::TooManyDyads { .. } => "remove joints, or place some as points of links",
        }
    }
}
