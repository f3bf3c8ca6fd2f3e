//! The limits of the circuits of a linkage.

/// The most samples a circuit may have.
pub const MAX_SAMPLES: usize = 100_000;

/// The most memory that the circuits of a linkage, their curves and the rows of these in tables may take, in bytes.
pub const MAX_CIRCUIT_BYTES: usize = 240_000_000;

/// The size of a linkage, as the greatest magnitude of a coordinate of any joint: fourth powers of lengths, of which its measures
/// are composed, are numbers, and not infinite or 0.
pub const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// The greatest number of assembly modes, of those that can be assembled, that are searched.
pub const MAX_ASSEMBLY_MODES: usize = 512;
