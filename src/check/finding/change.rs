use serde::Serialize;

/// What has changed since the atlas was recorded.
///
/// In JSON, `was` is the recorded value and `is` the current one.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Change {
    /// A file, or part of it, cannot be used.
    Damaged {
        /// Why.
        #[serde(rename = "wrong")]
        message: String,
    },
    /// The atlas was recorded by another version of the program, which may measure and draw differently.
    Outdated {
        /// The version that recorded it.
        #[serde(rename = "was")]
        recorded: String,
        /// The version of this program.
        #[serde(rename = "is")]
        current: String,
    },
    /// A file was edited after it was recorded.
    Altered,
    /// A file has other line endings than were recorded, or a byte order mark; this is not a difference.
    Rewritten,
    /// The manifest has a family that is not recorded.
    FamilyAdded,
    /// A recorded family is not in the manifest.
    FamilyRemoved,
    /// A family has another linkage or other columns.
    FamilyChanged {
        /// "the linkage" or "columns".
        what: String,
        /// The recorded value.
        #[serde(rename = "was")]
        recorded: String,
        /// The current value.
        #[serde(rename = "is")]
        current: String,
    },
    /// A cell is not recorded.
    CellAdded,
    /// A recorded cell no longer exists.
    CellRemoved,
    /// A cell is recorded under another number.
    CellRenumbered {
        /// Its recorded number.
        #[serde(rename = "was")]
        recorded: usize,
    },
    /// A parameter of a cell has another value.
    Parameter {
        /// The name of the parameter.
        name: String,
        /// The recorded value.
        #[serde(rename = "was")]
        recorded: f64,
        /// The current value.
        #[serde(rename = "is")]
        current: f64,
    },
    /// The status of a cell, or the reason for it, has changed.
    Status {
        /// The recorded value.
        #[serde(rename = "was")]
        recorded: String,
        /// The current value, with the reason.
        #[serde(rename = "is")]
        current: String,
    },
    /// A linkage has another class.
    Class {
        /// The recorded value.
        #[serde(rename = "was")]
        recorded: String,
        /// The current value.
        #[serde(rename = "is")]
        current: String,
    },
    /// One circuit has become several.
    CircuitSplit {
        /// The numbers of these circuits.
        into: Vec<usize>,
    },
    /// Several circuits have become one.
    CircuitJoined {
        /// The recorded numbers of these circuits.
        from: Vec<usize>,
    },
    /// A recorded circuit no longer exists.
    CircuitLost,
    /// A circuit is not recorded.
    CircuitAdded,
    /// A circuit is recorded in the opposite direction.
    CircuitReversed,
    /// A closed circuit is recorded from another sample.
    CircuitShifted {
        /// The number of samples between the two first samples.
        by: usize,
    },
    /// A circuit is recorded under another number.
    CircuitRenumbered {
        /// Its recorded number.
        #[serde(rename = "was")]
        recorded: usize,
    },
    /// A curve is sampled more or less often, or at other inputs.
    Samples {
        /// The number of recorded samples.
        #[serde(rename = "was")]
        recorded: usize,
        /// The current number of samples.
        #[serde(rename = "is")]
        current: usize,
        /// The numbers that are missing between recorded samples, the first few.
        missing: Vec<usize>,
        /// The Hausdorff distance of the curves: near zero if only the sampling has changed.
        #[serde(rename = "apart")]
        hausdorff_distance: f64,
    },
    /// Samples are on the other side of a two-valued joint.
    Branch {
        /// The first such sample.
        sample: usize,
        /// The input there.
        input: f64,
        /// The number of such samples.
        samples: usize,
        /// The recorded value.
        #[serde(rename = "was")]
        recorded: i64,
        /// The current value.
        #[serde(rename = "is")]
        current: i64,
    },
    /// A curve has moved.
    Moved(Displacement),
    /// A further column of `points.csv` has other values.
    Column {
        /// Its name.
        name: String,
        /// The sample at which it differs most.
        sample: usize,
        /// The recorded value.
        #[serde(rename = "was")]
        recorded: f64,
        /// The current value.
        #[serde(rename = "is")]
        current: f64,
    },
    /// A measure has another value.
    Measure {
        /// Its name.
        name: String,
        /// The recorded value.
        #[serde(rename = "was")]
        recorded: String,
        /// The current value.
        #[serde(rename = "is")]
        current: String,
        /// The relative difference; infinite for words and missing values.
        relative: f64,
    },
    /// A page would be drawn differently, though none of its curves has changed.
    Drawing,
    /// The family has more or fewer pages.
    Pages {
        /// The number of recorded pages.
        #[serde(rename = "was")]
        recorded: usize,
        /// The current number of pages.
        #[serde(rename = "is")]
        current: usize,
    },
    /// A page shows a curve away from its recorded points.
    DrawnOff {
        /// The greatest distance, in millimetres on paper.
        distance_mm: f64,
    },
}

/// How far the points of a curve have moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Displacement {
    /// The greatest distance a point has moved, in the unit of the manifest; infinite if its recorded or current
    /// position does not exist.
    pub distance: f64,
    /// That distance, relative to the size of the curve: the diagonal of its bounding box.
    pub relative: f64,
    /// The sample that has moved farthest.
    pub sample: usize,
    /// The input there: degrees, or an actuator's length.
    pub input: f64,
    /// Its recorded position.
    #[serde(rename = "was")]
    pub recorded: [f64; 2],
    /// Its current position.
    #[serde(rename = "is")]
    pub current: [f64; 2],
    /// The number of samples that have moved by more than the tolerance.
    #[serde(rename = "moved")]
    pub moved_samples: usize,
    /// The number of samples.
    #[serde(rename = "of")]
    pub total_samples: usize,
    /// The Hausdorff distance of the curves: near zero if points have only moved along the curve.
    #[serde(rename = "apart")]
    pub hausdorff_distance: f64,
}
