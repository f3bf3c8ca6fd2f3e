//! A linkage with its cognates attached.

use super::{CognateError, Cognates, PlacedFourBar};
use crate::geometry::{Vector, complex_product};
use crate::linkage::{FourBar, Joint, JointId, JointKind, Link, Linkage};

impl Cognates {
    /// A linkage with its cognates attached, which are its chains.
    ///
    /// The cognates are attached by parallelograms and by triangles similar to the coupler's: the linkage moves as
    /// before, and all three couplers carry the coupler point `joint`. The new joints are Q, D, E, F and G, as in the
    /// catalogue's `cognates`. If `joint` is one of a grid of points, the others are removed from their link.
    ///
    /// # Errors
    /// As [`PlacedFourBar::from_linkage`] and [`Cognates::from_four_bar`].
    pub fn assemble(linkage: &Linkage, joint: JointId) -> Result<Linkage, CognateError> {
        let mut assembled = linkage.clone();
        let mut placed = PlacedFourBar::from_linkage(linkage, joint)?;
        // In the plane of the joints themselves, before the linkage is mirrored.
        placed.coupler_point.y *= linkage.placement.handedness();
        Cognates::from_four_bar(placed)?;
        let (Some([o, a, b, c]), lambda) = (FourBar::pins(linkage), placed.coupler_point / placed.lengths.coupler)
        else {
            return Err(CognateError::NotFourBar);
        };
        let rest = Vector::new(1.0, 0.0) - lambda;
        isolate_from_grid(&mut assembled, joint);
        let mut add = |name: &str, kind| {
            assembled.joints.push(Joint { name: name.to_owned(), kind });
            JointId::new(assembled.joints.len() - 1)
        };
        let rigid = |base, factor: Vector| JointKind::Rigid { base, along: factor.x, across: factor.y };
        let q = add("Q", rigid([o, c], lambda));
        let d = add("D", JointKind::Parallelogram { corners: [o, a, joint] });
        let e = add("E", rigid([d, joint], lambda));
        let f = add("F", JointKind::Parallelogram { corners: [c, b, joint] });
        let g = add("G", rigid([f, joint], rest));
        let on_frame = assembled.links.iter_mut().find_map(|link| {
            let (from, to) = (link.position(o)?, link.position(c)?);
            Some((from + complex_product(lambda, to - from), link))
        });
        if let Some((position, link)) = on_frame {
            link.joints.push((q, position));
        }
        let FourBar { crank, rocker, coupler, .. } = placed.lengths;
        let (near, far) = (placed.coupler_point.norm(), (rest * coupler).norm());
        let mut link = |joints: &[(JointId, Vector)]| assembled.links.push(Link { joints: joints.to_vec() });
        let zero = Vector::zeros();
        let along = |length: f64| Vector::new(length, 0.0);
        link(&[(o, zero), (d, along(near))]);
        link(&[(d, zero), (joint, along(crank)), (e, lambda * crank)]);
        link(&[(q, zero), (e, along(near / coupler * rocker))]);
        link(&[(c, zero), (f, along(far))]);
        link(&[(f, zero), (joint, along(rocker)), (g, rest * rocker)]);
        link(&[(q, zero), (g, along(far / coupler * crank))]);
        assembled.chains = vec![vec![o, d, joint, e, q], vec![c, f, joint, g, q]];
        Ok(assembled)
    }
}

/// Removes the other points of a grid from their link, and gives this one a distinct name.
fn isolate_from_grid(linkage: &mut Linkage, joint: JointId) {
    let name = linkage.joints[joint].name.clone();
    let grid: Vec<JointId> = linkage.joint_ids().filter(|&other| linkage.joints[other].name == name).collect();
    if let ([_, _, ..], Some(index)) = (&grid[..], grid.iter().position(|&other| other == joint)) {
        for link in &mut linkage.links {
            link.joints.retain(|(other, _)| *other == joint || !grid.contains(other));
        }
        linkage.joints[joint].name = format!("{name}{}", index + 1);
    }
}
