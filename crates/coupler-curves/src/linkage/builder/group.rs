//! Joints that no dyads place, and the links between them.

use super::{LinkageBuilder, check_length};
use crate::geometry::Point;
use crate::linkage::{Closure, DyadId, Error, Group, JointId, JointKind, Link};

impl LinkageBuilder {
    /// Adds a joint of the group, and says where it is at the start, in the frame of the fixed joints.
    pub fn grouped(&mut self, name: &str, at: Point) -> JointId {
        let id = self.add_joint(name, JointKind::Grouped { dyad: DyadId::FIRST });
        self.start_at(id, at);
        id
    }

    /// Says where a joint is at the start that an actuator drives, of a linkage with a group: it is one of its joints.
    pub fn start_at(&mut self, joint: JointId, at: Point) {
        self.group_mut().joints.push((joint, at));
    }

    /// Adds a link through two joints of which one is in the group; further joints are points of it.
    ///
    /// # Errors
    /// One joint given twice, a length that is not positive.
    pub fn grouped_bar(&mut self, joints: [JointId; 2], length: f64) -> Result<(), Error> {
        let name = self.joints[joints[1]].name.clone();
        self.check_distinct(&name, joints)?;
        check_length(&name, length)?;
        // The frame is the first link, also where its joints are added later.
        if self.links.is_empty() {
            self.links.push(Link { joints: Vec::new() });
        }
        self.add_bar(joints[0], joints[1], length);
        self.group_mut().closures.push(Closure::Distance { joints, length });
        Ok(())
    }

    /// Adds a joint that is placed already to the link through two others, at a place along the line from the first to
    /// the second, and to the left of it.
    ///
    /// # Errors
    /// One joint given twice, joints on no common link, joints that coincide.
    pub fn hold(&mut self, joint: JointId, base: [JointId; 2], place: [f64; 2]) -> Result<(), Error> {
        let name = self.joints[joint].name.clone();
        let (link, from, to) = self.require_common_link(&name, base)?;
        let span = (to - from).norm();
        let [along, across] = place.map(|own| own / span);
        let position = super::point_on_link([from, to], along, across);
        self.links[link].joints.push((joint, position));
        self.group_mut().closures.push(Closure::OnLink { joint, base, along, across });
        Ok(())
    }

    /// Makes the distance of two joints the input: an actuator is between them.
    pub fn drive(&mut self, joints: [JointId; 2]) {
        self.group_mut().closures.push(Closure::Driven { joints });
    }

    /// Makes a joint slide on the line `offset` to the left of two joints of a link.
    ///
    /// # Errors
    /// One joint given twice for the line, joints on no common link, joints that coincide.
    pub fn guide(&mut self, joint: JointId, line: [JointId; 2], offset: f64) -> Result<(), Error> {
        let name = self.joints[joint].name.clone();
        let (_, from, to) = self.require_common_link(&name, line)?;
        self.add_slider(joint, line);
        let length = (to - from).norm();
        self.group_mut().closures.push(Closure::OnLine { joint, line, length, offset });
        Ok(())
    }

    fn group_mut(&mut self) -> &mut Group {
        self.group.get_or_insert_with(|| Group { joints: Vec::new(), closures: Vec::new() })
    }
}
