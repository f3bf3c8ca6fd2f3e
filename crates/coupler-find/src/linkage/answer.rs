//! What is found of the dimensions of a linkage.

use std::sync::Arc;

use coupler_curves::family::Family;
use coupler_curves::template::Orientation;

use super::placed_curve::PlacedCurve;

/// Dimensions of a linkage near a target.
#[derive(Clone, Debug)]
pub struct LinkageAnswer {
    /// The curve and the linkage on the target.
    pub curve: PlacedCurve,
    /// The branch at the first point of the target: the side of the first two-valued joint, 1 left or -1 right.
    pub branch: i8,
    /// The input at the first and at the last point of the target: degrees, or a length.
    pub inputs: [f64; 2],
    /// A family of this linkage only.
    pub family: Family,
}

impl LinkageAnswer {
    /// Its family in its direction on the target, and mirrored as there.
    pub fn placed_family(&self) -> Family {
        let placement = &self.curve.fit.placement;
        let mut family = self.family.clone();
        let template = Arc::make_mut(&mut family.template);
        template.orientation = Orientation::new(placement.is_mirrored, placement.rotation_deg());
        family
    }
}
