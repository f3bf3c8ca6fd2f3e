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

    /// Whether the links keep their lengths: where a linkage cannot be assembled, its joints are placed otherwise. A circuit on which no dyad
    /// is flat has the same passes then, up to what is between the places.
    pub fn are_closed(&self, linkage: &Linkage) -> bool {
        /// Relative to the square of the length of a link: of the length it is half as much.
        const ROUNDING: f64 = 2e-9;
        linkage.links.iter().all(|link| {
            let Some((first, from)) = link.joints.first() else { return true };
            link.joints[1..].iter().all(|(joint, to)| {
                let own = (to - from).norm_squared();
                let is_kept = |placed: &JointPositions| {
                    let [from, to] = [first, joint].map(|joint| placed.x(*joint).iter().zip(placed.y(*joint)));
                    from.zip(to).all(|((ax, ay), (bx, by))| {
                        let (dx, dy) = (bx - ax, by - ay);
                        let square = dx * dx + dy * dy;
                        (square - own).abs() <= ROUNDING * own.max(square)
                    })
                };
                self.of_passes.iter().all(is_kept)
            })
        })
    }
}
