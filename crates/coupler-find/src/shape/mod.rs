//! What the shapes of curves are compared by, in any position, size and direction: harmonics of closed curves, points at equal distances along
//! open ones.

pub(crate) mod best;
pub(crate) mod close_portion;
pub(crate) mod compact;
pub(crate) mod spectrum;
pub(crate) mod stroke;
pub(crate) mod synthesis;
