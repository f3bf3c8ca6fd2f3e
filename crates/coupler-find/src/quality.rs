//! How near a curve is to a target, in a word.

/// How near a curve is to a target, in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quality {
    /// E is at most 0.0001 of the target's size: no difference is seen in a drawing.
    Exact,
    /// At most 0.01: a line's width in a drawing as large as a hand.
    Close,
    /// At most 0.05.
    Fair,
    /// More than that.
    Poor,
}

impl Quality {
    /// The word for a deviation relative to the size of the target.
    pub fn of(rms_relative: f64) -> Quality {
        match rms_relative {
            ..=1e-4 => Quality::Exact,
            ..=0.01 => Quality::Close,
            ..=0.05 => Quality::Fair,
            _ => Quality::Poor,
        }
    }

    /// The word.
    pub fn name(self) -> &'static str {
        match self {
            Quality::Exact => "exact",
            Quality::Close => "close",
            Quality::Fair => "fair",
            Quality::Poor => "poor",
        }
    }
}
