//! The links of a linkage and the joints that connect them, and the kind of six-bar they form.

use std::fmt;

use super::{Closure, JointId, JointKind, Linkage};

/// The links of a linkage, and its full joints: revolute and sliding joints, each of which leaves two links one degree
/// of freedom.
///
/// A pin of n links counts as n - 1 joints: the link nearest to the fixed frame carries the others. A block that slides
/// in a slot on a pin, the block in the slot of a yoke, and the rod of an actuator are links too. Points at which no two
/// links meet are not joints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KinematicChain {
    /// The number of links, the ground included.
    pub link_count: usize,
    /// The index of the link at rest in the reported frame; see [`Linkage::ground`].
    pub ground: usize,
    /// For each joint, the indices of the two links that it connects. Indices below the number of [`Linkage::links`] are
    /// those of these links; the blocks and rods follow.
    pub joints: Vec<[usize; 2]>,
}

/// A six-bar of one degree of freedom whose loops cannot be separated, by its chain and its ground.
///
/// Six links with seven full joints have two ternary links. In Watt's chain these are joined to each other, in
/// Stephenson's they are not.
///
/// # Source
/// Norton, *Design of Machinery*, section 2.12, and McCarthy and Soh, *Geometric Design of Linkages*, which number the
/// inversions alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SixBar {
    /// Watt's chain with a binary link as its ground.
    WattI,
    /// Watt's chain with a ternary link as its ground: two four-bars in series.
    WattII,
    /// Stephenson's chain; the ground is one of the two binary links that are joined to both ternary links.
    StephensonI,
    /// Stephenson's chain; the ground is one of the two binary links that are joined to each other.
    StephensonII,
    /// Stephenson's chain with a ternary link as its ground: a dyad connects a coupler point with a third fixed pivot.
    StephensonIII,
}

impl KinematicChain {
    /// The chain of a linkage; `None` if it has gears or racks, whose contact is not a full joint, if a part slides along a line
    /// of two links, or if a pin of three links has two that are equally near to the fixed frame.
    pub fn from_linkage(linkage: &Linkage) -> Option<KinematicChain> {
        let is_on = |link: usize, joint: JointId| linkage.links[link].position(joint).is_some();
        let links = 0..linkage.links.len();
        let link_with = |joints: [JointId; 2]| links.clone().find(|&link| joints.iter().all(|&j| is_on(link, j)));
        // A sliding part is the first link that starts with its joint: links that are connected to it come later.
        let part_at = |joint: JointId| {
            links.clone().find(|&link| linkage.links[link].joints.first().is_some_and(|(first, _)| *first == joint))
        };
        // The links on each joint.
        let mut pins: Vec<Vec<usize>> = vec![Vec::new(); linkage.joints.len()];
        for (link, body) in linkage.links.iter().enumerate() {
            body.joints.iter().for_each(|(joint, _)| pins[joint.index()].push(link));
        }
        let mut slides: Vec<[usize; 2]> = Vec::new();
        let mut link_count = linkage.links.len();
        for (id, joint) in linkage.joint_ids().zip(&linkage.joints) {
            // A link that slides along another one, on a pin.
            let mut add_block = |pin: JointId, along: usize| {
                pins[pin.index()].push(link_count);
                slides.push([along, link_count]);
                link_count += 1;
            };
            match joint.kind {
                JointKind::Gear { .. } | JointKind::Rack { .. } => return None,
                JointKind::Slide { line, .. } | JointKind::DrivenSlider { line, .. } => {
                    slides.push([link_with(line)?, part_at(id)?])
                }
                JointKind::Yoke { from, line, .. } => {
                    let yoke = part_at(id)?;
                    add_block(from, yoke);
                    slides.push([link_with(line)?, yoke]);
                }
                JointKind::Slot { base: [pivot, through], .. } => {
                    let along = link_with([pivot, id])?;
                    match block_with_points(linkage, [pivot, through], id) {
                        Some(block) => slides.push([along, block]),
                        None => add_block(through, along),
                    }
                }
                JointKind::Piston { base: [_, pivot], .. } => {
                    // The cylinder is added directly after the crank, and the rod after the cylinder.
                    let cylinder = link_with([pivot, id])? + 1;
                    slides.push([cylinder, cylinder + 1]);
                }
                JointKind::Fixed(_)
                | JointKind::Crank { .. }
                | JointKind::Dyad { .. }
                | JointKind::Grouped { .. }
                | JointKind::Aligned { .. }
                | JointKind::Parallelogram { .. }
                | JointKind::Rigid { .. } => {}
            }
        }
        for closure in linkage.group.iter().flat_map(|group| &group.closures) {
            // Between its two joints an actuator has two links.
            if let Closure::Driven { joints } = *closure {
                for (end, joint) in joints.into_iter().enumerate() {
                    pins[joint.index()].push(link_count + end);
                }
                slides.push([link_count, link_count + 1]);
                link_count += 2;
            }
            if let Closure::OnLine { joint, line, .. } = *closure {
                // Its block is added after the links that it connects.
                let starts =
                    |link: &usize| linkage.links[*link].joints.first().is_some_and(|(first, _)| *first == joint);
                slides.push([link_with(line)?, links.clone().rev().find(starts)?]);
            }
        }
        pins.retain(|links| links.len() > 1);
        let distances = distances_from_frame(link_count, &pins, &slides);
        let mut joints = slides;
        for links in &pins {
            let carrier = carrier(links, &distances)?;
            joints.extend(links.iter().filter(|&&link| link != carrier).map(|&link| [carrier, link]));
        }
        let ground = links.clone().find(|&link| std::ptr::eq(&linkage.links[link], linkage.ground()))?;
        Some(KinematicChain { link_count, ground, joints })
    }

    /// The kind of six-bar; `None` for another number of links or joints, and for six-bars with a part that does not
    /// move in itself, or that moves without the rest.
    pub fn six_bar(&self) -> Option<SixBar> {
        if self.link_count != 6 || self.joints.len() != 7 {
            return None;
        }
        let degree = |link: usize| self.joints.iter().flatten().filter(|&&joined| joined == link).count();
        let degrees: Vec<usize> = (0..self.link_count).map(degree).collect();
        let ternary: Vec<usize> = (0..self.link_count).filter(|&link| degrees[link] == 3).collect();
        let &[first, second] = &ternary[..] else { return None };
        if degrees.iter().any(|degree| *degree < 2) {
            return None;
        }
        let from_first = (0..self.joints.len()).filter(|&joint| self.joints[joint].contains(&first));
        let mut paths =
            from_first.map(|joint| self.binary_links(joint, [first, second])).collect::<Option<Vec<Vec<usize>>>>()?;
        paths.sort_by_key(Vec::len);
        let is_ternary = ternary.contains(&self.ground);
        match [0, 1, 2].map(|k| paths.get(k).map_or(0, Vec::len)) {
            [0, 2, 2] if is_ternary => Some(SixBar::WattII),
            [0, 2, 2] => Some(SixBar::WattI),
            [1, 1, 2] if is_ternary => Some(SixBar::StephensonIII),
            [1, 1, 2] if paths[2].contains(&self.ground) => Some(SixBar::StephensonII),
            [1, 1, 2] => Some(SixBar::StephensonI),
            _ => None,
        }
    }

    /// The binary links between two ternary links, in order from the first by way of a joint; `None` if they lead back
    /// to the first.
    fn binary_links(&self, joint: usize, [first, second]: [usize; 2]) -> Option<Vec<usize>> {
        let other_end = |joint: usize, link: usize| self.joints[joint].iter().copied().find(|&end| end != link);
        let (mut joint, mut link) = (joint, other_end(joint, first)?);
        let mut path = Vec::new();
        while link != second {
            if link == first || path.len() == self.link_count {
                return None;
            }
            path.push(link);
            joint = (0..self.joints.len()).find(|&next| next != joint && self.joints[next].contains(&link))?;
            link = other_end(joint, link)?;
        }
        Some(path)
    }
}

/// The link of a block that has points: those of the slot with the foot `foot`, which slides through the second joint.
fn block_with_points(linkage: &Linkage, [pivot, through]: [JointId; 2], foot: JointId) -> Option<usize> {
    let is_on_block = |joint: JointId| match linkage.joints[joint].kind {
        JointKind::Aligned { from, line, .. } => from == through && (line == [pivot, through] || line == [pivot, foot]),
        _ => false,
    };
    let point = linkage.joint_ids().find(|&joint| is_on_block(joint))?;
    linkage.links.iter().position(|link| link.position(point).is_some())
}

/// The number of joints between the fixed frame, link 0, and each link; the largest number for one that is not
/// connected.
fn distances_from_frame(link_count: usize, pins: &[Vec<usize>], slides: &[[usize; 2]]) -> Vec<usize> {
    let mut distances = vec![usize::MAX; link_count];
    let mut reached = vec![0];
    let mut distance = 0;
    while !reached.is_empty() {
        reached.iter().for_each(|&link| distances[link] = distance);
        let at_joint = |links: &[usize]| links.iter().any(|link| reached.contains(link));
        let pinned = pins.iter().filter(|links| at_joint(links)).flatten();
        let sliding = slides.iter().filter(|links| at_joint(&links[..])).flatten();
        let mut next: Vec<usize> =
            pinned.chain(sliding).copied().filter(|&link| distances[link] == usize::MAX).collect();
        next.sort_unstable();
        next.dedup();
        reached = next;
        distance += 1;
    }
    distances
}

/// The link on a pin that the others are joined to; `None` if two of at least three are equally near to the frame.
fn carrier(links: &[usize], distances: &[usize]) -> Option<usize> {
    let nearest = links.iter().copied().min_by_key(|&link| distances[link])?;
    let has_rival = links.iter().any(|&link| link != nearest && distances[link] == distances[nearest]);
    (links.len() == 2 || !has_rival).then_some(nearest)
}

impl SixBar {
    /// The name in captions and tables.
    pub fn name(self) -> &'static str {
        match self {
            SixBar::WattI => "Watt I",
            SixBar::WattII => "Watt II",
            SixBar::StephensonI => "Stephenson I",
            SixBar::StephensonII => "Stephenson II",
            SixBar::StephensonIII => "Stephenson III",
        }
    }
}

impl fmt::Display for SixBar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn six_bar(ground: usize, joints: [[usize; 2]; 7]) -> Option<SixBar> {
        KinematicChain { link_count: 6, ground, joints: joints.to_vec() }.six_bar()
    }

    #[test]
    fn chains_are_named_by_their_ternary_links_and_their_ground() {
        // Links 0 and 1 are ternary; loops 0 2 3 1 and 0 4 5 1.
        let watt = [[0, 1], [0, 2], [2, 3], [3, 1], [0, 4], [4, 5], [5, 1]];
        let inversions: Vec<_> = (0..6).map(|ground| six_bar(ground, watt).unwrap().name()).collect();
        assert_eq!(inversions, ["Watt II", "Watt II", "Watt I", "Watt I", "Watt I", "Watt I"]);
        // Links 2 and 3 are joined to both, links 4 and 5 to each other.
        let stephenson = [[0, 2], [2, 1], [3, 0], [1, 3], [0, 4], [4, 5], [5, 1]];
        let inversions: Vec<_> = (0..6).map(|ground| six_bar(ground, stephenson).unwrap()).collect();
        use SixBar::{StephensonI, StephensonII, StephensonIII};
        let expected = [StephensonIII, StephensonIII, StephensonI, StephensonI, StephensonII, StephensonII];
        assert_eq!(inversions, expected);
    }

    #[test]
    fn chains_with_rigid_or_separate_parts_are_none() {
        // A triangle 0 1 2, which makes a four-bar with 3, 4 and 5.
        assert_eq!(six_bar(0, [[0, 1], [0, 2], [2, 1], [0, 3], [3, 4], [4, 5], [5, 1]]), None);
        // Two loops of four and three links that share link 0.
        assert_eq!(six_bar(0, [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [4, 5], [5, 0]]), None);
        // Two triangles, connected by a joint.
        assert_eq!(six_bar(0, [[0, 1], [0, 2], [2, 3], [3, 0], [1, 4], [4, 5], [5, 1]]), None);
        // A link that is joined once.
        assert_eq!(six_bar(0, [[0, 1], [0, 2], [2, 1], [0, 3], [3, 1], [3, 4], [2, 5]]), None);
    }
}
