//! Indices of joints, links and dyads, each with a distinct type.

use std::ops::{Index, IndexMut};

/// Defines an index type, which also indexes slices and vectors.
macro_rules! index_type {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub struct $name(usize);

        impl $name {
            /// The id of an index.
            #[inline]
            pub const fn new(index: usize) -> $name {
                $name(index)
            }

            /// The index, from 0.
            #[inline]
            pub const fn index(self) -> usize {
                self.0
            }
        }

        impl<T> Index<$name> for [T] {
            type Output = T;

            #[inline]
            fn index(&self, id: $name) -> &T {
                &self[id.0]
            }
        }

        impl<T> IndexMut<$name> for [T] {
            #[inline]
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0]
            }
        }

        impl<T> Index<$name> for Vec<T> {
            type Output = T;

            #[inline]
            fn index(&self, id: $name) -> &T {
                &self[id.0]
            }
        }

        impl<T> IndexMut<$name> for Vec<T> {
            #[inline]
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.0]
            }
        }
    };
}

index_type! {
    /// A joint's index in [`Linkage::joints`](super::Linkage::joints).
    ///
    /// It also indexes a pose, and any other slice with an entry for each joint in that order.
    JointId
}

index_type! {
    /// A link's index in [`Linkage::links`](super::Linkage::links).
    LinkId
}

index_type! {
    /// A dyad's index among the dyads of a linkage, in the order of their joints; its bit in
    /// [`AssemblyMode`](super::AssemblyMode).
    DyadId
}

impl DyadId {
    /// The dyad whose joint is placed before those of the others.
    pub const FIRST: DyadId = DyadId(0);
}
