use super::{JointId, Linkage, Step};

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

/// Grashof's classes (Natesan, table 3.1), as seen from the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// A side link is shortest, and turns fully.
    CrankRocker,
    /// The frame is shortest, and both side links turn fully.
    DragLink,
    /// The coupler is shortest, and turns fully; both side links rock.
    DoubleRocker,
    /// No link turns fully.
    TripleRocker,
    /// All links can lie on one line.
    ChangePoint,
}

impl Class {
    /// Every class.
    pub const ALL: [Class; 5] =
        [Class::CrankRocker, Class::DragLink, Class::DoubleRocker, Class::TripleRocker, Class::ChangePoint];

    /// Its name in captions and tables.
    pub fn name(self) -> &'static str {
        match self {
            Class::CrankRocker => "crank-rocker",
            Class::DragLink => "drag-link",
            Class::DoubleRocker => "double-rocker",
            Class::TripleRocker => "triple-rocker",
            Class::ChangePoint => "change-point",
        }
    }
}

impl FourBar {
    /// The four-bar in a linkage, if its moving joints are a crank, one dyad on crank pin and frame, and rigid points.
    ///
    /// Seen from another link than the fixed one, that link is the frame, the link opposite it the coupler, and the
    /// crank the link at the origin of the view.
    pub fn of(linkage: &Linkage) -> Option<FourBar> {
        let mut crank = None;
        let mut dyad = None;
        for (id, joint) in linkage.joints.iter().enumerate() {
            match joint.step {
                Step::Crank { pivot, length } if crank.is_none() => crank = Some((id, pivot, length)),
                Step::Dyad { base, lengths, .. } if dyad.is_none() => dyad = Some((id, base, lengths)),
                Step::Fixed(_) | Step::Rigid { .. } => {}
                _ => return None,
            }
        }
        let ((a, o, crank), (b, base, lengths)) = (crank?, dyad?);
        let (c, coupler, rocker) = match base {
            [x, c] if x == a => (c, lengths[0], lengths[1]),
            [c, x] if x == a => (c, lengths[1], lengths[0]),
            _ => return None,
        };
        let fixed = &linkage.links[0];
        let frame = (fixed.place(c)? - fixed.place(o)?).norm();
        // The loop of links by the pins at their ends, and each link's length.
        let pins = [[o, c], [o, a], [a, b], [b, c]];
        let lengths = [frame, crank, coupler, rocker];
        let at = |from: JointId, to: JointId| (0..4).find(|&k| pins[k] == [from, to] || pins[k] == [to, from]);
        let Some([origin, end]) = linkage.seen_from else {
            return Some(FourBar { frame, crank, coupler, rocker });
        };
        let frame = at(origin, end)?;
        let crank = (0..4).find(|&k| k != frame && pins[k].contains(&origin))?;
        let rocker = (0..4).find(|&k| k != frame && pins[k].contains(&end))?;
        let coupler = 6 - frame - crank - rocker;
        Some(FourBar {
            frame: lengths[frame],
            crank: lengths[crank],
            coupler: lengths[coupler],
            rocker: lengths[rocker],
        })
    }

    /// Grashof's class. Lengths whose sums agree to within a few ulps make a change point: they are meant to be equal,
    /// and decimals such as 0.1 + 0.2 are not.
    pub fn class(self) -> Class {
        let FourBar { frame, crank, coupler, rocker } = self;
        let mut lengths = [frame, crank, coupler, rocker];
        lengths.sort_by(f64::total_cmp);
        let [shortest, la, lb, longest] = lengths;
        let excess = (longest - lb) - (la - shortest);
        if excess.abs() <= tolerance(longest + shortest + la + lb) {
            Class::ChangePoint
        } else if excess > 0.0 {
            Class::TripleRocker
        } else if frame == shortest {
            Class::DragLink
        } else if coupler == shortest {
            Class::DoubleRocker
        } else {
            Class::CrankRocker
        }
    }
}

/// Sums of lengths closer than this are equal: a few ulps of the sum of all four.
pub(crate) fn tolerance(sum: f64) -> f64 {
    4.0 * f64::EPSILON * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_are_those_of_the_table() {
        let class = |frame, crank, coupler, rocker| FourBar { frame, crank, coupler, rocker }.class();
        assert_eq!(class(2.0, 1.0, 2.59, 2.59), Class::CrankRocker, "Evans, figure 1");
        assert_eq!(class(2.0, 2.59, 1.0, 2.59), Class::DoubleRocker, "Chebyshev, figure 11");
        assert_eq!(class(4.0, 2.0, 1.0, 2.0), Class::TripleRocker, "Watt, figure 23");
        assert_eq!(class(2.0, 2.0, 1.0, 2.0), Class::DoubleRocker, "Roberts, figure 35");
        assert_eq!(class(3.0, 2.0, 1.0, 2.0), Class::ChangePoint, "Roberts, figure 36");
        assert_eq!(class(4.0, 2.0, 2.0, 2.0), Class::TripleRocker, "Roberts, figure 39");
        assert_eq!(class(1.0, 3.0, 3.0, 3.0), Class::DragLink);
        assert_eq!(class(0.1, 0.2, 0.3, 0.4), Class::ChangePoint, "0.1 + 0.4 and 0.2 + 0.3");
        assert_eq!(class(2.0, 2.0, 2.0, 2.0), Class::ChangePoint, "a rhombus");
    }
}
