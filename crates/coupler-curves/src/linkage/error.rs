use super::MAX_DYADS;

/// Why a joint cannot be placed the way it is described, whatever the input.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// Two joints are wanted and one was given twice.
    #[error("`{joint}` is placed from `{base}` and `{base}`, which are one joint")]
    RepeatedJoint {
        /// The joint to place.
        joint: String,
        /// The joint given twice.
        base: String,
    },
    /// A rigid point hangs on joints of different links.
    #[error("`{joint}` needs a link with both `{}` and `{}`, and no link has both", base[0], base[1])]
    NoCommonLink {
        /// The joint to place.
        joint: String,
        /// The joints it hangs on.
        base: [String; 2],
    },
    /// A length is negative, zero or not finite.
    #[error("the length {length} of `{joint}` is not positive")]
    InvalidLength {
        /// The joint to place.
        joint: String,
        /// The length.
        length: f64,
    },
    /// The joints that fix a direction coincide.
    #[error("`{joint}` has no direction to go by: `{}` and `{}` are one point", base[0], base[1])]
    NoDirection {
        /// The joint to place.
        joint: String,
        /// The joints that coincide.
        base: [String; 2],
    },
    /// Two distances and the link between them are no triangle.
    #[error("`{joint}` cannot be {} from one joint and {} from another {span} away", distances[0], distances[1])]
    NoTriangle {
        /// The joint to place.
        joint: String,
        /// Its distances.
        distances: [f64; 2],
        /// The distance of the joints they are taken from.
        span: f64,
    },
    /// A point is wanted of what slides, and more than one thing is known by the joints given.
    #[error("`{joint}` may be on more than one link that is known by `{}` and `{}`", base[0], base[1])]
    AmbiguousLink {
        /// The joint to place.
        joint: String,
        /// The joints it hangs on.
        base: [String; 2],
    },
    /// The slot of a yoke is parallel to its guide.
    #[error("the slot of `{joint}` lies along its guide")]
    SlotParallelToGuide {
        /// The joint to place.
        joint: String,
    },
    /// A gear ratio is no ratio of whole numbers from 1 to [`Error::MAX_GEAR_RATIO`].
    #[error("`{joint}` is geared {} to {}, and both must be whole numbers from 1 to {} or their negatives", ratio[0], ratio[1], Error::MAX_GEAR_RATIO)]
    InvalidRatio {
        /// The joint to place.
        joint: String,
        /// The ratio.
        ratio: [f64; 2],
    },
    /// More dyads than [`MAX_DYADS`].
    #[error("`{joint}` is one dyad more than the {MAX_DYADS} a linkage may have")]
    TooManyDyads {
        /// The joint to place.
        joint: String,
    },
}

impl Error {
    /// The greatest number in a gear ratio: a circuit takes as many turns.
    pub const MAX_GEAR_RATIO: u64 = 100;

    /// The joint that cannot be placed; `seen_from` where that names no link.
    pub fn joint(&self) -> &str {
        match self {
            Error::RepeatedJoint { joint, .. }
            | Error::NoCommonLink { joint, .. }
            | Error::InvalidLength { joint, .. }
            | Error::NoDirection { joint, .. }
            | Error::NoTriangle { joint, .. }
            | Error::AmbiguousLink { joint, .. }
            | Error::SlotParallelToGuide { joint }
            | Error::InvalidRatio { joint, .. }
            | Error::TooManyDyads { joint } => joint,
        }
    }

    /// The remedy.
    pub fn help(&self) -> &'static str {
        match self {
            Error::RepeatedJoint { .. } => "name two different joints",
            Error::NoCommonLink { .. } => {
                "name two joints of one link: two fixed ones, a crank's, or a dyad's and its base"
            }
            Error::InvalidLength { .. } => "give a length of more than 0",
            Error::NoDirection { .. } => "name two joints that are apart",
            Error::NoTriangle { .. } => "give distances that reach each other",
            Error::AmbiguousLink { .. } => "give each of them a pivot, or a second joint of its line, of its own",
            Error::SlotParallelToGuide { .. } => "give an angle between 0 and 180 deg, as in angle = \"90 deg\"",
            Error::InvalidRatio { .. } => "write it like ratio = [2, 3]",
            Error::TooManyDyads { .. } => "take joints away, or place some as points of links",
        }
    }
}
