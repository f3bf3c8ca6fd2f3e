use std::fmt;

use super::{JointId, JointKind, Linkage};

/// The lengths of a four-bar linkage, seen from its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar {
    /// The frame: thesis p, McCarthy g.
    pub frame: f64,
    /// The crank: thesis r, McCarthy a.
    pub crank: f64,
    /// The coupler: thesis a, McCarthy h.
    pub coupler: f64,
    /// The rocker: thesis s, McCarthy b.
    pub rocker: f64,
}

/// Grashof's classes (Natesan, table 3.1), in the frame of the fixed link and with the crank as the driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FourBarClass {
    /// The crank is shortest, and turns fully; the rocker rocks.
    CrankRocker,
    /// The rocker is shortest, and turns fully; the crank rocks. In table 3.1 a crank rocker has the driver crank as its
    /// shortest link, so this one is its inversion, as in McCarthy's table 2.2.
    RockerCrank,
    /// The frame is shortest, and crank and rocker turn fully.
    DragLink,
    /// The coupler is shortest, and turns fully; crank and rocker rock.
    DoubleRocker,
    /// No link turns fully.
    TripleRocker,
    /// All links can lie on one line.
    ChangePoint,
}

impl FourBarClass {
    /// Every class.
    pub const ALL: [FourBarClass; 6] = [
        FourBarClass::CrankRocker,
        FourBarClass::RockerCrank,
        FourBarClass::DragLink,
        FourBarClass::DoubleRocker,
        FourBarClass::TripleRocker,
        FourBarClass::ChangePoint,
    ];

    /// The name in captions and tables.
    pub fn name(self) -> &'static str {
        match self {
            FourBarClass::CrankRocker => "crank-rocker",
            FourBarClass::RockerCrank => "rocker-crank",
            FourBarClass::DragLink => "drag-link",
            FourBarClass::DoubleRocker => "double-rocker",
            FourBarClass::TripleRocker => "triple-rocker",
            FourBarClass::ChangePoint => "change-point",
        }
    }
}

impl fmt::Display for FourBarClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FourBar {
    /// The four-bar in a linkage, if its moving joints are a crank, one dyad on crank pin and frame, rigid points, and
    /// parallelograms on these.
    ///
    /// In the frame of another link (`seen_from`), that link counts as the frame, the link opposite it as the
    /// coupler, and the link at the origin of `seen_from` as the crank.
    pub fn from_linkage(linkage: &Linkage) -> Option<FourBar> {
        let [o, a, b, c] = FourBar::pins(linkage)?;
        let length = |from: JointId, to: JointId| {
            let link =
                linkage.links.iter().find(|link| link.position(from).is_some() && link.position(to).is_some())?;
            Some((link.position(to)? - link.position(from)?).norm())
        };
        Some(FourBar { frame: length(o, c)?, crank: length(o, a)?, coupler: length(a, b)?, rocker: length(b, c)? })
    }

    /// The pins of the four-bar that [`FourBar::from_linkage`] finds: crank pivot, crank pin, rocker pin, rocker pivot.
    pub fn pins(linkage: &Linkage) -> Option<[JointId; 4]> {
        let mut crank = None;
        let mut dyad = None;
        for (id, joint) in linkage.joint_ids().zip(&linkage.joints) {
            match joint.kind {
                JointKind::Crank { pivot, .. } if crank.is_none() => crank = Some((id, pivot)),
                JointKind::Dyad { base, .. } if dyad.is_none() => dyad = Some((id, base)),
                JointKind::Fixed(_) | JointKind::Rigid { .. } | JointKind::Parallelogram { .. } => {}
                _ => return None,
            }
        }
        let ((a, o), (b, base)) = (crank?, dyad?);
        let c = match base {
            [x, c] | [c, x] if x == a => c,
            _ => return None,
        };
        linkage.links[0].position(c)?;
        let pins = [o, a, b, c];
        let Some([origin, end]) = linkage.seen_from else { return Some(pins) };
        // From the origin of `seen_from` around the loop, away from the joint on its x-axis.
        let start = pins.iter().position(|&pin| pin == origin)?;
        let [next, opposite, last] = [1, 2, 3].map(|k| pins[(start + k) % 4]);
        match end {
            end if end == last => Some([origin, next, opposite, last]),
            end if end == next => Some([origin, last, opposite, next]),
            _ => None,
        }
    }

    /// The pins of the four-bar in a linkage, in the order of [`FourBar::pins`], if a joint is on its coupler.
    pub fn coupler_pins(linkage: &Linkage, joint: JointId) -> Option<[JointId; 4]> {
        let pins = FourBar::pins(linkage)?;
        let [_, a, b, _] = pins;
        let is_coupler = |link: &super::Link| [joint, a, b].iter().all(|&j| link.position(j).is_some());
        linkage.links.iter().any(is_coupler).then_some(pins)
    }

    /// McCarthy's type, by the signs of `g - a + h - b`, `g - a - h + b` and `h + b - g - a`: whether the input and the
    /// output have limits, and whether the range of a rocker with one limit is about 0 or about pi.
    ///
    /// # Source
    /// McCarthy and Soh, *Geometric Design of Linkages*, table 2.2.
    pub fn mccarthy_type(self) -> &'static str {
        let FourBar { frame: g, crank: a, coupler: h, rocker: b } = self;
        let tolerance = length_tolerance(g + a + h + b);
        let signs = [(g - a) + (h - b), (g - a) - (h - b), (h - a) - (g - b)];
        if signs.iter().any(|sign| sign.abs() <= tolerance) {
            return FourBarClass::ChangePoint.name();
        }
        match signs.map(|sign| sign > 0.0) {
            [true, true, true] => "crank-rocker",
            [true, false, false] => "rocker-crank",
            [false, false, true] => "double-crank",
            [false, true, false] => "double-rocker",
            [false, false, false] => "00 double-rocker",
            [true, true, false] => "0π double-rocker",
            [true, false, true] => "π0 double-rocker",
            [false, true, true] => "ππ double-rocker",
        }
    }

    /// Grashof's class. Lengths whose sums agree to within a few ulps count as equal and make a change-point linkage,
    /// for sums of decimals such as 0.1 + 0.2 are rounded.
    pub fn class(self) -> FourBarClass {
        let FourBar { frame, crank, coupler, rocker } = self;
        let mut lengths = [frame, crank, coupler, rocker];
        lengths.sort_by(f64::total_cmp);
        let [shortest, la, lb, longest] = lengths;
        let excess = (longest - lb) - (la - shortest);
        if excess.abs() <= length_tolerance(longest + shortest + la + lb) {
            FourBarClass::ChangePoint
        } else if excess > 0.0 {
            FourBarClass::TripleRocker
        } else if frame == shortest {
            FourBarClass::DragLink
        } else if coupler == shortest {
            FourBarClass::DoubleRocker
        } else if rocker == shortest {
            FourBarClass::RockerCrank
        } else {
            FourBarClass::CrankRocker
        }
    }
}

/// The tolerance to which sums of lengths count as equal: a few ulps of the sum of all four.
pub(crate) fn length_tolerance(sum: f64) -> f64 {
    4.0 * f64::EPSILON * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_match_the_thesis_table() {
        let class = |frame, crank, coupler, rocker| FourBar { frame, crank, coupler, rocker }.class();
        assert_eq!(class(2.0, 1.0, 2.59, 2.59), FourBarClass::CrankRocker, "Evans, figure 1");
        assert_eq!(class(2.0, 2.59, 1.0, 2.59), FourBarClass::DoubleRocker, "Chebyshev, figure 11");
        assert_eq!(class(4.0, 2.0, 1.0, 2.0), FourBarClass::TripleRocker, "Watt, figure 23");
        assert_eq!(class(2.0, 2.0, 1.0, 2.0), FourBarClass::DoubleRocker, "Roberts, figure 35");
        assert_eq!(class(3.0, 2.0, 1.0, 2.0), FourBarClass::ChangePoint, "Roberts, figure 36");
        assert_eq!(class(4.0, 2.0, 2.0, 2.0), FourBarClass::TripleRocker, "Roberts, figure 39");
        assert_eq!(class(1.0, 3.0, 3.0, 3.0), FourBarClass::DragLink);
        assert_eq!(class(2.0, 2.59, 2.59, 1.0), FourBarClass::RockerCrank, "Evans, driven by its rocker");
        assert_eq!(class(0.1, 0.2, 0.3, 0.4), FourBarClass::ChangePoint, "0.1 + 0.4 and 0.2 + 0.3");
        assert_eq!(class(2.0, 2.0, 2.0, 2.0), FourBarClass::ChangePoint, "a rhombus");
    }
}
