//! The names of the joints of a linkage.

use std::collections::HashMap;

/// The names of joints in the order written.
pub(super) struct JointNames<'v> {
    names: Vec<&'v str>,
    indices: HashMap<&'v str, usize>,
}

impl<'v> JointNames<'v> {
    pub fn new(names: Vec<&'v str>) -> JointNames<'v> {
        let indices = names.iter().copied().zip(0..).collect();
        JointNames { names, indices }
    }

    /// All names.
    pub fn all(&self) -> &[&'v str] {
        &self.names
    }

    /// The index of a joint by its name.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.indices.get(name).copied()
    }
}
