//! Why a linkage cannot be assembled.

use std::fmt;

use super::limits::{MAX_ASSEMBLY_MODES, MAX_CIRCUIT_BYTES, MAX_SAMPLES};
use crate::text::{round_apart, round_to_six_digits};

/// Why a linkage cannot be assembled at all, or not over the whole input range requested.
///
/// Lengths are in the manifest's own unit; inputs are in degrees, or lengths where an actuator drives. Messages print
/// up to six significant digits.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AssemblyError {
    /// Positions, or powers of them that its measures are composed of, overflow or underflow.
    #[error("its lengths are too large or too small for double precision")]
    BeyondDoublePrecision,
    /// The program failed where it solved or measured the linkage, which is an error of the program.
    #[error("the program failed, which is an error of the program, please report it: {message}")]
    Failed {
        /// The message of the panic.
        message: String,
    },
    /// The sampling step is too short for the travel from one limit to the other.
    #[error("a step of {step} makes more than {MAX_SAMPLES} samples from one end to the other")]
    TooManySamples {
        /// The step.
        step: f64,
    },
    /// The positions on its circuits are too many to be computed.
    #[error(
        "its circuits, of which there are {circuits}, would take about {} MB, more than the limit of {} MB",
        bytes.div_ceil(1_000_000), MAX_CIRCUIT_BYTES / 1_000_000
    )]
    TooMuchMemory {
        /// The memory they would take, in bytes.
        bytes: usize,
        /// The number of circuits.
        circuits: usize,
    },
    /// The base of a dyad is longer than its links reach, at every input.
    #[error(
        "{joint} cannot be placed: {} and {} are {} or more apart, links of {} and {} reach {}",
        base[0], base[1], Apart(*least, lengths[0] + lengths[1]), Short(lengths[0]), Short(lengths[1]),
        Apart(lengths[0] + lengths[1], *least)
    )]
    BaseTooLong {
        /// The joint of the dyad.
        joint: String,
        /// The joints its links are on.
        base: [String; 2],
        /// The lengths of its links.
        lengths: [f64; 2],
        /// The least length of its base.
        least: f64,
    },
    /// The base of a dyad is shorter than the difference of its links, at every input.
    #[error(
        "{joint} cannot be placed: {} and {} are {} or less apart, links of {} and {} need {}",
        base[0], base[1], Apart(*greatest, (lengths[0] - lengths[1]).abs()), Short(lengths[0]), Short(lengths[1]),
        Apart((lengths[0] - lengths[1]).abs(), *greatest)
    )]
    BaseTooShort {
        /// The joint of the dyad.
        joint: String,
        /// The joints its links are on.
        base: [String; 2],
        /// The lengths of its links.
        lengths: [f64; 2],
        /// The greatest length of its base.
        greatest: f64,
    },
    /// The base of a dyad is never of a length that its links span, within the input range.
    #[error(
        "{joint} cannot be placed: links of {} and {} never span the distance of {} and {} in the range",
        Short(lengths[0]), Short(lengths[1]), base[0], base[1]
    )]
    BaseNeverSpanned {
        /// The joint of the dyad.
        joint: String,
        /// The joints its links are on.
        base: [String; 2],
        /// The lengths of its links.
        lengths: [f64; 2],
    },
    /// The two joints that a dyad is on coincide at every input.
    #[error("{joint} has no position: {} and {} coincide throughout", base[0], base[1])]
    CoincidentBase {
        /// The joint of the dyad.
        joint: String,
        /// The joints its links are on.
        base: [String; 2],
    },
    /// At one input two joints coincide, and a joint that is placed from them would be elsewhere before and after.
    #[error("the motion ends at an input of {input}: {} and {} coincide there, and {joint} would jump", base[0], base[1])]
    Jump {
        /// The joint.
        joint: String,
        /// The joints that coincide.
        base: [String; 2],
        /// The input, in degrees or as a length.
        input: f64,
    },
    /// At one input the position of a joint is undefined: joints from which it is placed coincide there, and come apart in no
    /// direction.
    #[error("{joint} has no position at an input of {input}, where joints that it is placed from coincide")]
    NoLimit {
        /// The joint.
        joint: String,
        /// The input, in degrees or as a length.
        input: f64,
    },
    /// The line of a slide stays out of reach of its link.
    #[error(
        "{joint} cannot be placed: its line stays {} or more from {base}, and the link of {} is too short",
        Apart(*distance, *length), Apart(*length, *distance)
    )]
    LineTooFar {
        /// The joint that slides.
        joint: String,
        /// The joint its link is on.
        base: String,
        /// The length of the link.
        length: f64,
        /// The least distance of the line from that joint.
        distance: f64,
    },
    /// The offset of a slot is greater than the distance of its pivot from the joint that slides through.
    #[error(
        "{joint} cannot be placed: {} and {} are {} or less apart, and the offset is {}",
        base[0], base[1], Apart(*greatest, *offset), Apart(*offset, *greatest)
    )]
    OffsetTooLong {
        /// The foot of the slot's line.
        joint: String,
        /// The pivot, and the joint that slides through.
        base: [String; 2],
        /// The greatest distance of those two.
        greatest: f64,
        /// The offset, without its sign.
        offset: f64,
    },
    /// No length of an actuator within the range places its joint.
    #[error("{joint} cannot be placed by an actuator of any length in the range")]
    ActuatorOutOfRange {
        /// The joint that the actuator drives.
        joint: String,
    },
    /// No input allows the assembly mode of the start.
    #[error("no input allows the sides requested at the start")]
    NoStart,
    /// The linkage cannot be assembled at the start.
    #[error("it cannot be assembled at the start, an input of {start}")]
    OpenAtStart {
        /// The input at the start.
        start: f64,
    },
    /// The start is not in the input range.
    #[error("its start, an input of {start}, is not in the requested range from {} to {}", range[0], range[1])]
    StartOutOfRange {
        /// The input at the start.
        start: f64,
        /// The input range, from and to.
        range: [f64; 2],
    },
    /// All circuits are requested, and there are more than [`MAX_ASSEMBLY_MODES`] assembly modes.
    #[error(
        "its first {dyads} dyads have {modes} assembly modes, and at most {MAX_ASSEMBLY_MODES} are solved: set `circuits` \
         to \"start\""
    )]
    TooManyModes {
        /// The number of dyads, in the order of their joints, that have too many assembly modes.
        dyads: usize,
        /// The number of their assembly modes with an input at which they close.
        modes: usize,
    },
    /// The circuit through the start pose passes through more than [`MAX_ASSEMBLY_MODES`] assembly modes.
    #[error(
        "the circuit passes through more than {MAX_ASSEMBLY_MODES} assembly modes: request a range of the input, or \
         remove dyads"
    )]
    TooManyModesOnCircuit,
    /// The links that no dyads place do not close at the start.
    #[error("its links do not close at the start, an input of {input}: a length misses by {}", Short(*gap))]
    GroupOpen {
        /// The input at the start.
        input: f64,
        /// By how much a length is missed, in the pose that is stated.
        gap: f64,
    },
    /// The driven link is held by a part that is rigid.
    #[error("its input cannot move: {} held in place, as a part of the links is rigid", were(joints))]
    InputHeld {
        /// The joint that is driven, and those that do not move with the others.
        joints: Vec<String>,
    },
    /// Links that no dyads place are closed by a joint on a gear.
    #[error("its links cannot be solved: they are closed by a joint on a gear, a slot or a yoke")]
    GroupOfGears,
    /// All circuits are requested of a linkage that dyads place by no input, and that has too many joints to find all its poses.
    #[error(
        "all of its circuits would be too many to find, as dyads place its joints by no input: set `circuits` to \"start\""
    )]
    TooManyPoses,
    /// The motion of links that no dyads place cannot be followed: there are other poses too close to it.
    #[error(
        "its motion cannot be followed at an input of {}: there its links can move in more than one way, or as good as",
        Short(*input)
    )]
    GroupNotFollowed {
        /// The input.
        input: f64,
    },
    /// The motion of links that no dyads place takes too many steps to follow, or leads to infinity.
    #[error("its motion takes too many steps to follow, or goes too far: from the start to an input of {}", Short(*input))]
    GroupTooLong {
        /// The input.
        input: f64,
    },
    /// The input does not reach all of the range: some of the motion is missing.
    #[error(
        "the input goes from {}{unit} only, of the requested {} to {}{unit}",
        Reached(*reached, *requested), requested[0], requested[1], unit = if *in_degrees { " deg" } else { "" }
    )]
    RangeNotReached {
        /// The least and the greatest input of the circuit.
        reached: [f64; 2],
        /// The input range requested, from and to.
        requested: [f64; 2],
        /// Whether inputs are in degrees; lengths otherwise.
        in_degrees: bool,
    },
}

impl AssemblyError {
    /// By how much lengths miss, relative to them: 0.1 if a link is a tenth too short. `None` where that is not the reason.
    pub fn relative_shortfall(&self) -> Option<f64> {
        let [missing, size] = match self {
            AssemblyError::BaseTooLong { lengths, least, .. } => [least - (lengths[0] + lengths[1]), *least],
            AssemblyError::BaseTooShort { lengths, greatest, .. } => {
                [(lengths[0] - lengths[1]).abs() - greatest, lengths[0].max(lengths[1])]
            }
            AssemblyError::LineTooFar { length, distance, .. } => [distance - length, *distance],
            AssemblyError::OffsetTooLong { greatest, offset, .. } => [offset - greatest, *offset],
            _ => return None,
        };
        Some(missing / size)
    }
}

/// "A, B are" or "A is".
fn were(joints: &[String]) -> String {
    format!("{} {}", joints.join(", "), if joints.len() == 1 { "is" } else { "are" })
}

/// Prints up to six significant digits.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", round_to_six_digits(self.0))
    }
}

/// Prints the first of two numbers that are compared, in as many digits as tell them apart, at least up to six significant ones.
struct Apart(f64, f64);

impl fmt::Display for Apart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", round_apart(self.0, self.1))
    }
}

/// Prints the ends of a range up to four decimals, or with all digits if those are of the range that was requested, which it is not.
struct Reached([f64; 2], [f64; 2]);

impl fmt::Display for Reached {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded = self.0.map(|end| (end * 1e4).round() / 1e4 + 0.0);
        let [from, to] = if rounded == self.1 { self.0 } else { rounded };
        write!(f, "{from} to {to}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_compared_differ() {
        let [joint, a, c] = ["B", "A", "C"].map(str::to_owned);
        let error = AssemblyError::BaseTooShort { joint, base: [a, c], lengths: [5.5, 3.0], greatest: 2.499_999_999_9 };
        let message = "B cannot be placed: A and C are 2.4999999999 or less apart, links of 5.5 and 3 need 2.5";
        assert_eq!(error.to_string(), message);
        let range =
            |reached| AssemblyError::RangeNotReached { reached, requested: [0.0, 30.0], in_degrees: true }.to_string();
        assert_eq!(
            range([0.0, 29.999_999]),
            "the input goes from 0 to 29.999999 deg only, of the requested 0 to 30 deg"
        );
        assert_eq!(range([1e-17, 29.5]), "the input goes from 0 to 29.5 deg only, of the requested 0 to 30 deg");
    }
}
