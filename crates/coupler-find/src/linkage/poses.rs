//! The poses of a linkage at places of a circuit.

use crate::complex::Complex;
use coupler_curves::linkage::{JointId, Linkage};
use coupler_curves::motion::{InputColumns, JointPositions};

/// Where positions of a round, or inputs, are on the passes of a circuit: of all circuits with these passes.
pub(super) struct Places {
    /// The number of positions.
    pub count: usize,
    /// Those on each pass that has any.
    pub of_passes: Vec<PassPlaces>,
}

/// Places on one pass.
pub(super) struct PassPlaces {
    /// The index of the pass.
    pub pass: usize,
    /// The numbers of the places among all, in the order of the inputs.
    pub numbers: Vec<usize>,
    /// The inputs there.
    pub inputs: InputColumns,
}

/// The joints of a linkage at some places.
pub(super) struct Poses<'a> {
    pub places: &'a Places,
    /// The positions of all joints on each pass.
    pub of_passes: Vec<JointPositions>,
}

impl Poses<'_> {
    /// The points of a joint; `None` if one of them is not defined.
    pub fn points(&self, joint: JointId) -> Option<Vec<Complex>> {
        let mut points = vec![Complex::new(f64::NAN, f64::NAN); self.places.count];
        for (on_pass, placed) in self.places.of_passes.iter().zip(&self.of_passes) {
            let of_joint = placed.x(joint).iter().zip(placed.y(joint));
            for (number, (x, y)) in on_pass.numbers.iter().zip(of_joint) {
                points[*number] = Complex::new(*x, *y);
            }
        }
        points.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(points)
    }

    /// Whether the links keep their lengths. A circuit on which no dyad is flat has the same passes then, up to what is between the places.
    pub fn are_closed(&self, linkage: &Linkage) -> bool {
        /// Of a length, for exact poses, and for those of a turn of a group, which may be off by some millionths.
        const ROUNDING: f64 = 1e-9;
        const INTERPOLATED: f64 = 1e-5;
        let part = if linkage.group.is_some() { INTERPOLATED } else { ROUNDING };
        self.of_passes.iter().all(|placed| placed.keep_lengths(linkage, part))
    }
}
