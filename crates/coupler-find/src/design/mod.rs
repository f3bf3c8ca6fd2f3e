//! The dimensions of any linkage by wishes on its measures.
//!
//! [`Wishes`] are conditions in the language of `where`, and expressions that are to be as great or as small as possible. A
//! [`DesignSpace`] says within which ranges parameters vary. Samples that fill the ranges evenly are measured, cheap measures first, and the
//! best are moved by an evolution strategy on the wishes' augmented Lagrangian, which needs no derivatives: extremes over a turn, such as the
//! worst transmission angle, have kinks where they are best. What must be equal is then met to rounding by the method of Levenberg and
//! Marquardt. With several goals the strategy runs for several weights, and the answers are those that no other one exceeds in all.

mod answer;
mod assessment;
mod axes;
mod evolution;
mod idle;
mod lagrangian;
mod measured;
mod merit;
mod polish;
mod run;
mod sample;
mod search;
mod space;
mod wish;

pub use answer::{DesignAnswer, DesignMiss, WishValue};
pub use search::{DesignOptions, DesignSearch};
pub use space::{DesignSpace, DesignSpaceError, RangeRequest};
pub use wish::{Direction, Goal, Wish, WishError, Wishes};
