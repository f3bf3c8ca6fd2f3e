//! What is asked of the curves of an atlas, and what is found.

use coupler_find::{Answer, Deviation, Options, PlacedCurve, scaled_values};

use crate::manifest::Plan;

/// What the curves of an atlas must satisfy.
#[derive(Clone, Copy, Debug)]
pub struct AtlasQuery<'a> {
    /// The options; their condition is not used.
    pub options: &'a Options,
    /// A condition in the names of the families, as in `where` of a manifest.
    pub condition: Option<&'a str>,
    /// Whether position, size and rotation count.
    pub is_fixed: bool,
}

/// A curve of an atlas near a target.
#[derive(Clone, Debug)]
pub struct AtlasAnswer {
    /// The index of its family in the plan, and that of its cell in the family.
    pub place: [usize; 2],
    /// Its name, as `export` takes it: `evans:3.1.1`.
    pub name: String,
    /// The curve and its linkage on the target.
    pub curve: PlacedCurve,
    /// The four-bar that was refined from it, where it is one and comes nearer; the outline of `curve` is then that of the refined one.
    pub refined: Option<Answer>,
}

impl AtlasAnswer {
    /// How near it is: the refined one, if there is one.
    pub fn deviation(&self) -> &Deviation {
        self.refined.as_ref().map_or(&self.curve.fit.deviation, |answer| &answer.deviation)
    }

    /// The factor of the linkage's lengths that makes it as large as on the target; 1 if its dimensions do not scale.
    pub(super) fn factor(&self) -> f64 {
        if self.curve.is_scalable { self.curve.fit.placement.scale() } else { 1.0 }
    }

    /// The values of the parameters of its template, as large as on the target if its dimensions scale.
    pub fn scaled_values(&self, plan: &Plan) -> Vec<f64> {
        scaled_values(&plan.families[self.place[0]].family.template, &self.curve.values, self.factor())
    }
}
