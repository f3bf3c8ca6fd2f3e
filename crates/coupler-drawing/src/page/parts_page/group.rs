//! Parts of the same shape, which have one view and one row of the table.

use coupler_curves::parts::{Part, Parts};

/// Parts of the same shape.
pub(super) struct Group<'p> {
    /// The first of them.
    pub part: &'p Part,
    /// The names of all.
    pub names: Vec<&'p str>,
}

/// The parts, those of the same shape together.
pub(super) fn groups(parts: &Parts) -> Vec<Group<'_>> {
    let mut groups: Vec<Group> = Vec::new();
    for part in &parts.parts {
        match groups.iter_mut().find(|group| group.part.is_same_shape(part)) {
            Some(group) => group.names.push(&part.name),
            None => groups.push(Group { part, names: vec![&part.name] }),
        }
    }
    groups
}
